// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant half_of_the_angle> caught by: rotation-matrix
// shown by: rotation-matrix
// mistake: Takes half of the angle, as in quaternions.
// ask: Is it a rotation by half of the angle? Only quaternions have halves.
// <solution rotationMatrix>
const double c = std::cos(angle / 2), s = std::sin(angle / 2);
return c * Eigen::Matrix3d::Identity() + s * skew(axis) + (1 - c) * axis * axis.transpose();

// <variant other_sense> caught by: rotation-matrix
// mistake: Turns clockwise.
// ask: Is the sense of rotation wrong? (0, 0, 1) turns x to y.
// <solution rotationMatrix>
const double c = std::cos(angle), s = std::sin(angle);
return c * Eigen::Matrix3d::Identity() - s * skew(axis) + (1 - c) * axis * axis.transpose();

// <variant axis_left_out> caught by: rotation-matrix
// mistake: Leaves out the part along the axis.
// ask: Is the part along the axis left out, (1 - cos) w w^T?
// <solution rotationMatrix>
const double c = std::cos(angle), s = std::sin(angle);
return c * Eigen::Matrix3d::Identity() + s * skew(axis);

// <variant two_forms_mixed> caught by: rotation-matrix
// mistake: Begins like one form of the formula and ends like the other.
// ask: Are two forms of the formula mixed? With [w]x^2 the first term is the identity alone.
// <solution rotationMatrix>
const double c = std::cos(angle), s = std::sin(angle);
return c * Eigen::Matrix3d::Identity() + s * skew(axis) + (1 - c) * skew(axis) * skew(axis);

// <variant calls_the_library> caught by: forbidden-call
// mistake: Lets the library do it.
// <solution rotationMatrix>
return rotation(angle, axis).R;

// <variant by_acos> caught by: rotation-edges
// mistake: The textbook's formula, which divides by the sine of the angle.
// ask: Is the angle nearly pi here? What is left of R - R^T, and what of R + R^T?
// <solution rotationVector>
const Eigen::Vector3d twice(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
const double angle = std::acos(std::clamp((R.trace() - 1) / 2, -1., 1.));
return angle == 0 ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(angle / (2 * std::sin(angle)) * twice);

// <variant by_asin> caught by: rotation-vector, rotation-edges
// mistake: Takes the angle from the sine alone, which ends at a quarter turn.
// ask: Is asin used, which ends at a quarter turn?
// <solution rotationVector>
const Eigen::Vector3d twice(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
const double s = twice.norm() / 2;
return s == 0 ? twice : Eigen::Vector3d(std::asin(std::min(s, 1.)) / s * twice / 2);

// <variant not_halved> caught by: rotation-vector
// mistake: Forgets that R - R^T holds twice the sine.
// ask: Is R - R^T not halved?
// <solution rotationVector>
const Eigen::Vector3d twice(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
const double angle = std::acos(std::clamp((R.trace() - 1) / 2, -1., 1.));
return angle / std::sin(angle) * twice;

// <variant axis_alone> caught by: rotation-vector
// mistake: Returns the axis without the angle.
// ask: Is it the axis alone? Its length has to be the angle.
// <solution rotationVector>
return Eigen::Vector3d(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1)).normalized();

// <variant as_printed> caught by: quaternions
// mistake: Believes slide 2:10.
// ask: Is the cross product that of slide 2:10? It has its factors in the wrong order.
// <solution composed>
// in place of: product << a[0] * b[0] - u.dot(v), a[0] * v + b[0] * u + u.c
product << a[0] * b[0] - u.dot(v), a[0] * v + b[0] * u + v.cross(u);

// <variant scalar_last> caught by: quaternions
// mistake: Takes the last number for the scalar.
// ask: Is the scalar the last of the four numbers? Here it is the first.
// <solution composed>
const Eigen::Vector3d u = a.head<3>(), v = b.head<3>();
Eigen::Vector4d product;
product << a[3] * v + b[3] * u + u.cross(v), a[3] * b[3] - u.dot(v);
return product;

// <variant own_scalars> caught by: quaternions
// mistake: Multiplies each vector part by its own scalar.
// ask: Is each vector part multiplied by its own scalar? Each goes with the other one.
// <solution composed>
// in place of: product << a[0] * b[0] - u.dot(v), a[0] * v + b[0] * u + u.c
product << a[0] * b[0] - u.dot(v), a[0] * u + b[0] * v + u.cross(v);

// <variant longer_way> caught by: interpolation
// shown by: interpolation
// mistake: Does not ask which of b and -b is nearer.
// ask: Does it take the longer way? One of b and -b is nearer to a.
// <solution between>
const double arc = std::acos(std::clamp(a.dot(b), -1., 1.));
if (arc < 1e-9 || arc > 3.14159) return a;
return (std::sin((1 - share) * arc) * a + std::sin(share * arc) * b) / std::sin(arc);

// <variant straight_line> caught by: interpolation
// shown by: interpolation
// mistake: Interpolates linearly and normalises.
// ask: Is it linear interpolation, normalised? Its speed is not constant.
// <solution between>
const Eigen::Vector4d end = a.dot(b) < 0 ? Eigen::Vector4d(-b) : b;
return ((1 - share) * a + share * end).normalized();

// <variant divides_by_zero> caught by: interpolation
// mistake: Divides by the sine of the arc, even if it is 0.
// <solution between>
const Eigen::Vector4d end = a.dot(b) < 0 ? Eigen::Vector4d(-b) : b;
const double arc = std::acos(std::min(a.dot(end), 1.));
return (std::sin((1 - share) * arc) * a + std::sin(share * arc) * end) / std::sin(arc);

// <variant about_fixed_axes> caught by: euler-matrix
// shown by: euler-matrix
// mistake: Multiplies in the reverse order: rotations about fixed axes.
// ask: Are the factors in the reverse order? A rotation about an axis of the turned frame stands to the
// ask: right.
// <solution eulerMatrix>
// in place of: if (convention == Convention::k313) return a ... return about(2, 0) * about(1, 1) * about
if (convention == Convention::k313) return about(2, 2) * about(0, 1) * about(2, 0);
return about(0, 2) * about(1, 1) * about(2, 0);

// <variant reverse_angles> caught by: euler-matrix
// mistake: Takes the angles as roll, pitch, yaw.
// ask: Are the angles in the reverse order? The first one turns first.
// <solution eulerMatrix>
// in place of: if (convention == Convention::k313) return a ... return about(2, 0) * about(1, 1) * about
if (convention == Convention::k313) return about(2, 2) * about(0, 1) * about(2, 0);
return about(2, 2) * about(1, 1) * about(0, 0);

// <variant conventions_exchanged> caught by: euler-matrix
// mistake: Takes one convention for the other.
// ask: Is it the other convention?
// <solution eulerMatrix>
// in place of: if (convention == Convention::k313) return about(2, 0) * abo
if (convention != Convention::k313) return about(2, 0) * about(0, 1) * about(2, 2);

// <variant second_about_y> caught by: euler-matrix
// mistake: Turns about z, y, z: 3-2-3.
// ask: Is the second rotation about another axis?
// <solution eulerMatrix>
// in place of: if (convention == Convention::k313) return a ... return about(2, 0) * about(1, 1) * about
return about(2, 0) * about(1, 1) * (convention == Convention::k313 ? about(2, 2) : about(0, 2));

// <variant quadrants_lost> caught by: euler-angles, euler-locked
// mistake: Takes atan of a quotient.
// ask: Are the quadrants lost? atan2 knows them.
// <solution eulerAngles>
if (convention == Convention::k313)
  return {std::atan(-R(0, 2) / R(1, 2)), std::acos(R(2, 2)), std::atan(R(2, 0) / R(2, 1))};
return {std::atan(R(1, 0) / R(0, 0)), -std::asin(R(2, 0)), std::atan(R(2, 1) / R(2, 2))};

// <variant sign_of_cosine> caught by: euler-angles
// mistake: Forgets the minus in the first angle of 3-1-3.
// ask: Does the second argument of the first atan2 have the wrong sign?
// <solution eulerAngles>
if (convention == Convention::k313)
  return {std::atan2(R(0, 2), R(1, 2)), std::acos(R(2, 2)), std::atan2(R(2, 0), R(2, 1))};
return {std::atan2(R(1, 0), R(0, 0)), -std::asin(R(2, 0)), std::atan2(R(2, 1), R(2, 2))};

// <variant lock_forgotten> caught by: euler-locked
// mistake: Knows no gimbal lock: divides rounding errors.
// ask: Is the third angle computed from entries that are 0 up to rounding?
// <solution eulerAngles>
const double s = std::hypot(R(0, 2), R(1, 2)), c = std::hypot(R(0, 0), R(1, 0));
if (convention == Convention::k313)
  return {std::atan2(R(0, 2), -R(1, 2)), std::atan2(s, R(2, 2)), std::atan2(R(2, 0), R(2, 1))};
return {std::atan2(R(1, 0), R(0, 0)), std::atan2(-R(2, 0), c), std::atan2(R(2, 1), R(2, 2))};

// <variant pitch_by_asin> caught by: euler-locked
// mistake: Takes pitch from asin, which is nan beyond 1.
// ask: Is asin or acos used? An entry of R may be 1 + 2e-16 by rounding.
// <solution eulerAngles>
// in place of: if (c < 1e-6) return
if (c < 1e-6) return {std::atan2(-R(0, 1), R(1, 1)), std::asin(-R(2, 0)), 0};

// <variant axes_unmoved> caught by: euler-axes
// shown by: euler-axes
// mistake: Leaves the axes where they are at zero.
// ask: Are the axes not turned by the rotations before them?
// <solution turningAxes>
const bool zxz = convention == Convention::k313;
Eigen::Matrix3d A;
A << Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Unit(zxz ? 0 : 1), Eigen::Vector3d::Unit(zxz ? 2 : 0);
return A;

// <variant second_axis_unmoved> caught by: euler-axes
// mistake: Leaves the second axis where it is at zero.
// ask: Is each axis that of the frame as the rotations before it left the frame?
// <solution turningAxes>
// in place of: A << Eigen::Vector3d::UnitZ(), eulerMatrix( ... eulerMatrix(convention, angles).col(zxz
A << Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Unit(zxz ? 0 : 1),
    eulerMatrix(convention, angles).col(zxz ? 2 : 0);

// <variant axes_of_the_body> caught by: euler-axes
// mistake: Gives the axes in the turned frame.
// ask: Are the axes given in the turned frame? Wanted are world coordinates.
// <solution turningAxes>
const bool zxz = convention == Convention::k313;
Eigen::Matrix3d A;
A << Eigen::Vector3d::UnitZ(), eulerMatrix(convention, {angles[0], 0, 0}).col(zxz ? 0 : 1),
    eulerMatrix(convention, angles).col(zxz ? 2 : 0);
return eulerMatrix(convention, angles).transpose() * A;

// <variant axes_all_turned> caught by: euler-axes
// mistake: Turns every axis by the whole rotation.
// ask: Is every axis turned by all rotations? Only those before it turn it.
// <solution turningAxes>
const bool zxz = convention == Convention::k313;
Eigen::Matrix3d A;
A << Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Unit(zxz ? 0 : 1), Eigen::Vector3d::Unit(zxz ? 2 : 0);
return eulerMatrix(convention, angles) * A;

// <variant axis_that_is_left> caught by: euler-axes
// shown by: euler-axes
// mistake: Returns the axis that occurs twice.
// ask: Is it the axis that occurs twice? Rates of the angles can turn about it.
// <solution lostAxis>
return turningAxes(convention, angles).col(2);

// <variant axis_of_pitch> caught by: euler-axes
// mistake: Returns the axis of the second rotation.
// ask: Is it the axis of the second rotation? The frame still turns about it.
// <solution lostAxis>
return turningAxes(convention, angles).col(1);

// <variant rates_in_place_of_axis> caught by: euler-axes
// mistake: Returns the rates that turn nothing.
// ask: Is it the direction of rates that turn nothing, in place of the axis?
// <solution lostAxis>
return svd(turningAxes(convention, angles)).V.col(2);

// <variant position_negated> caught by: transforms
// mistake: Negates the position, but does not turn it.
// ask: Is the position only negated? It has to be turned as well.
// <solution inverted>
const Eigen::Matrix3d R_BA = X_AB.topLeftCorner(3, 3).transpose();
return transform(R_BA, -X_AB.topRightCorner(3, 1));

// <variant position_not_negated> caught by: transforms
// mistake: Turns the position, but does not negate it.
// ask: Is the position turned, but not negated?
// <solution inverted>
const Eigen::Matrix3d R_BA = X_AB.topLeftCorner(3, 3).transpose();
return transform(R_BA, R_BA* X_AB.topRightCorner(3, 1));

// <variant transposed_transform> caught by: transforms
// mistake: Transposes the whole matrix.
// ask: Is the whole matrix transposed? Only R is.
// <solution inverted>
return X_AB.transpose();

// <variant other_way_round> caught by: transforms
// mistake: Gives A as seen from B.
// ask: Is it A as seen from B?
// <solution seenFrom>
return inverted(X_WB) * X_WA;

// <variant factors_exchanged> caught by: transforms
// mistake: Multiplies in the wrong order.
// ask: Are the factors in the wrong order?
// <solution seenFrom>
return X_WB * inverted(X_WA);

// <variant always_about_x> caught by: end
// mistake: Turns about x, as slide 2:16 does.
// ask: Is the axis always x, as on slide 2:16?
// <solution jointMotion>
if (joint.kind == JointKind::kPrismatic) return transform(Eigen::Matrix3d::Identity(), {q, 0, 0});
return transform(rotationMatrix({1, 0, 0}, q), {0, 0, 0});

// <variant joint_in_its_parent> caught by: end
// mistake: Puts the joint into its parent, too.
// ask: Is X_PJ contained? It is not part of the motion.
// <solution jointMotion>
if (joint.kind == JointKind::kPrismatic)
  return joint.X_PJ * transform(Eigen::Matrix3d::Identity(), q* joint.axis);
return joint.X_PJ * transform(rotationMatrix(joint.axis, q), {0, 0, 0});

// <variant end_frame_forgotten> caught by: end, end-robots
// shown by: end
// mistake: Stops at the last joint.
// ask: Is X_ME left out, the frame of the end in that of the last joint?
// <solution endPose>
Eigen::Matrix4d X = Eigen::Matrix4d::Identity();
int i = 0;
for (const ChainJoint& joint : chain.joints) X = X * joint.X_PJ * jointMotion(joint, q[i++]);
return X;

// <variant moves_too_early> caught by: end, end-robots
// mistake: Moves each joint before it is where it belongs.
// ask: Is the motion of each joint before its X_PJ? The joint is where X_PJ says, and moves then.
// <solution endPose>
Eigen::Matrix4d X = Eigen::Matrix4d::Identity();
int i = 0;
for (const ChainJoint& joint : chain.joints) X = X * jointMotion(joint, q[i++]) * joint.X_PJ;
return X * chain.X_ME;

// <variant reverse_product> caught by: end, end-robots
// mistake: Multiplies from the left.
// ask: Are the factors in the reverse order?
// <solution endPose>
Eigen::Matrix4d X = Eigen::Matrix4d::Identity();
int i = 0;
for (const ChainJoint& joint : chain.joints) X = joint.X_PJ * jointMotion(joint, q[i++]) * X;
return chain.X_ME * X;

// <variant joint_at_the_origin> caught by: columns, jacobian-robots
// shown by: columns
// mistake: Forgets p_i.
// ask: Is p_i left out? A joint turns everything about itself, not about the origin of the world.
// <solution pointJacobian>
// in place of: for (const auto& [a, at, turns] : jointLines(chain, q)) J.co
for (const auto& [a, at, turns] : jointLines(chain, q)) J.col(i++) = turns ? a.cross(p).eval() : a;

// <variant cross_product_reversed> caught by: columns, jacobian-robots
// mistake: Exchanges the factors of the cross product.
// ask: Is the cross product the wrong way round?
// <solution pointJacobian>
// in place of: for (const auto& [a, at, turns] : jointLines(chain, q)) J.co
for (const auto& [a, at, turns] : jointLines(chain, q)) J.col(i++) = turns ? (p - at).cross(a).eval() : a;

// <variant point_at_the_end> caught by: columns, jacobian-robots
// mistake: Takes the origin of the end for the point.
// ask: Is it the Jacobian of the origin of E? The point is at p_E.
// <solution pointJacobian>
// in place of: const Eigen::Vector3d p = (endPose(chain, q) * p_E.homogeneo
const Eigen::Vector3d p = endPose(chain, q).topRightCorner(3, 1) + 0 * p_E;

// <variant sliding_joint_turns> caught by: columns
// mistake: Treats sliding joints like turning ones.
// ask: Do prismatic joints turn, too? Their columns are their axes.
// <solution pointJacobian>
// in place of: for (const auto& [a, at, turns] : jointLines(chain, q)) J.co
for (const auto& [a, at, turns] : jointLines(chain, q)) J.col(i++) = a.cross(p - at);

// <variant sliding_joint_stays> caught by: columns
// mistake: Lets sliding joints move nothing.
// ask: Are the columns of prismatic joints zero?
// <solution pointJacobian>
// in place of: for (const auto& [a, at, turns] : jointLines(chain, q)) J.co
for (const auto& [a, at, turns] : jointLines(chain, q)) J.col(i++) = (turns ? 1 : 0) * a.cross(p - at);

// <variant axis_in_its_own_frame> caught by: columns, jacobian-robots
// mistake: Does not turn the axis into the world.
// ask: Are the axes left in the frames of their joints?
// <solution pointJacobian>
const Eigen::Vector3d p = (endPose(chain, q) * p_E.homogeneous()).head<3>();
for (int i = 0; i < J.cols(); ++i) {
  const auto& [X, kind, a] = chain.joints[static_cast<std::size_t>(i)];
  const Eigen::Vector3d arm = p - jointLines(chain, q)[static_cast<std::size_t>(i)].p;
  J.col(i) = kind == JointKind::kRevolute ? a.cross(arm).eval() : a;
}

// <variant vector_not_turned> caught by: columns, jacobian-robots
// mistake: Takes v_E for a vector in the world.
// ask: Is v_E not turned into the axes of the world?
// <solution vectorJacobian>
int i = 0;
for (const auto& [a, at, turns] : jointLines(chain, q)) J.col(i++) = (turns ? 1 : 0) * a.cross(v_E);

// <variant vector_like_a_point> caught by: columns, jacobian-robots
// mistake: Treats the vector like a point.
// ask: Is the vector treated like a point? Where a joint is does not matter to directions.
// <solution vectorJacobian>
const Eigen::Vector3d v = (endPose(chain, q) * v_E.homogeneous()).head<3>();
int i = 0;
for (const auto& [a, at, turns] : jointLines(chain, q)) J.col(i++) = (turns ? 1 : 0) * a.cross(v - at);

// <variant sliding_joint_turns_vector> caught by: columns
// mistake: Lets sliding joints turn the vector.
// ask: Do prismatic joints turn the vector? They only move it.
// <solution vectorJacobian>
// in place of: for (const auto& [a, at, turns] : jointLines(chain, q)) J.co
for (const auto& [a, at, turns] : jointLines(chain, q)) J.col(i++) = a.cross(v);

// <variant one_sided> caught by: differences
// shown by: differences
// mistake: One-sided differences with a step that suits central ones.
// ask: Is the difference one-sided? Its error is h times half of the second derivative.
// <solution differences>
const double h = 1e-5;
for (int i = 0; i < x.size(); ++i) {
  const Eigen::VectorXd move = h * Eigen::VectorXd::Unit(x.size(), i);
  J.col(i) = (f(x + move) - f(x)) / h;
}

// <variant divided_by_h> caught by: differences
// mistake: Divides the central difference by h.
// ask: Is the difference of f at x + h and x - h divided by h, not 2 h?
// <solution differences>
const double h = 1e-5;
for (int i = 0; i < x.size(); ++i) {
  const Eigen::VectorXd move = h * Eigen::VectorXd::Unit(x.size(), i);
  J.col(i) = (f(x + move) - f(x - move)) / h;
}

// <variant step_too_small> caught by: differences
// mistake: Chooses the step as small as can be.
// ask: Is h too small, or too large? Compare what is cut off with what is rounded.
// <solution differences>
// in place of: // Central differences: an error of h^2 from ... const double h = 1e-5;
const double h = 1e-12;

// <variant not_rooted> caught by: ellipsoid
// shown by: ellipsoid
// mistake: Takes the eigenvalues of J J^T for the radii.
// ask: Are the eigenvalues of J J^T not rooted?
// <solution manipulability>
const SingularValues parts = svd(J * J.transpose());
return {parts.U, parts.s, std::sqrt(parts.s.prod())};

// <variant determinant_not_rooted> caught by: ellipsoid
// mistake: Forgets the root of the measure.
// ask: Is the determinant not rooted?
// <solution manipulability>
const SingularValues parts = svd(J);
return {parts.U, parts.s, parts.s.prod() * parts.s.prod()};

// <variant mean_radius> caught by: ellipsoid
// mistake: Takes the mean radius for the measure.
// ask: Is it sqrt(det(J J^T)), the product of the radii?
// <solution manipulability>
const SingularValues parts = svd(J);
return {parts.U, parts.s, parts.s.mean()};

// <variant ascending> caught by: ellipsoid
// mistake: Begins with the shortest axis.
// ask: Is the shortest radius the first? The longest has to be.
// <solution manipulability>
const SingularValues parts = svd(J);
return {parts.U.rowwise().reverse(), parts.s.reverse(), parts.s.prod()};

// <variant axes_as_rows> caught by: ellipsoid
// mistake: Returns the axes as rows.
// ask: Are the axes rows? They are columns.
// <solution manipulability>
const SingularValues parts = svd(J);
return {parts.U.transpose(), parts.s, parts.s.prod()};

// <variant velocity_not_turned> caught by: screw, screw-chain
// mistake: Moves along v all the time, though v turns.
// ask: Is the position v q? The velocity turns with the body.
// <solution screwMotion>
return transform(screw.w.norm() > 0 ? rotationMatrix(screw.w, q) : Eigen::Matrix3d::Identity(), q* screw.v);

// <variant about_the_position> caught by: screw, screw-chain
// mistake: Takes v for the position of the axis.
// ask: Is v the position of the axis?
// <solution screwMotion>
if (screw.w.norm() < 1e-12) return transform(Eigen::Matrix3d::Identity(), q* screw.v);
const Eigen::Matrix3d R = rotationMatrix(screw.w, q);
return transform(R, screw.v - R * screw.v);

// <variant velocity_of_the_axis> caught by: screw-chain
// shown by: screw-chain
// mistake: Takes w x p for the velocity of the origin.
// ask: Is v = w x p? The origin moves the other way.
// <solution screwsOf>
auto screw = screws.begin();
for (const auto& [a, p, turns] : jointLines(chain, Eigen::VectorXd::Zero(9)))
  *screw++ = turns ? Screw{a, a.cross(p)} : Screw{0 * a, a};

// <variant position_for_velocity> caught by: screw-chain
// mistake: Takes the position of the joint for v.
// ask: Is v the position of the joint?
// <solution screwsOf>
auto screw = screws.begin();
for (const auto& [a, p, turns] : jointLines(chain, Eigen::VectorXd::Zero(9)))
  *screw++ = turns ? Screw{a, p} : Screw{0 * a, a};

// <variant first_joint_first> caught by: screw-chain
// shown by: screw-chain
// mistake: Moves the first joint first.
// ask: Does the first joint move first? Then the axes of the others are elsewhere.
// <solution endPoseByScrews>
for (int i = 0; i < q.size(); ++i) X = screwMotion(screws[static_cast<std::size_t>(i)], q[i]) * X;

// <variant start_in_the_middle> caught by: screw-chain
// mistake: Multiplies the screws to the right of X_WE0.
// ask: Does X_WE0 come first? The screws are those of the world.
// <solution endPoseByScrews>
for (int i = 0; i < q.size(); ++i) X = X * screwMotion(screws[static_cast<std::size_t>(i)], q[i]);

// <variant test_accepts_everything> caught by: rotation-test
// mistake: Accepts every function.
// <solution passesRotationTest>
return candidate(Eigen::Vector3d::UnitX(), 1).allFinite();

// <variant test_of_lengths> caught by: rotation-test
// mistake: Tests only whether lengths and right angles are kept.
// <solution passesRotationTest>
for (int i = 0; i < 3; ++i) {
  const Eigen::Matrix3d R = candidate(Eigen::Vector3d::Unit(i), 1);
  if ((R * R.transpose() - Eigen::Matrix3d::Identity()).norm() > 1e-11) return false;
}
return true;

// <variant test_by_equality> caught by: rotation-test
// mistake: Wants the very numbers of its own rotationMatrix().
// <solution passesRotationTest>
for (double angle = -3; angle <= 3; angle += 0.25)
  for (int i = 0; i < 3; ++i)
    if (candidate(Eigen::Vector3d::Unit(i), angle) != rotationMatrix(Eigen::Vector3d::Unit(i), angle))
      return false;
return true;

// <variant test_without_zero> caught by: rotation-test
// mistake: Never tries the angle 0.
// <solution passesRotationTest>
// in place of: std::vector<double> turns = {0, 1e-5, -1e-5, pi, -pi};
std::vector<double> turns = {1e-5, -1e-5, pi, -pi};
// in place of: for (double angle = -3; angle <= 3; angle += 0.25) turns.push_back(angle);
for (double angle = -3.1; angle <= 3; angle += 0.25) turns.push_back(angle);

// <variant test_blind_to_nan> caught by: rotation-test
// mistake: Takes what is not a number for right, as no comparison with it holds.
// <solution passesRotationTest>
// in place of: if (!(off < 1e-11)) return false;
if (off > 1e-11) return false;
