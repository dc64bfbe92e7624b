// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant metric_forgotten> caught by: inverse, nullspace-any-size
// mistake: All joints cost the same, whatever W says.
// ask: Is W missing?
// <solution regularisedInverse>
const Eigen::MatrixXd same = Eigen::MatrixXd::Identity(W.rows(), W.cols());
return solve(precision * J.transpose() * J + same, precision* J.transpose());

// <variant metric_inverted> caught by: inverse, nullspace-any-size
// mistake: divides by what joints cost.
// ask: Is it the inverse of W?
// <solution regularisedInverse>
return solve(precision * J.transpose() * J + inverse(W), precision* J.transpose());

// <variant precision_forgotten> caught by: inverse, nullspace-any-size
// mistake: Every task is as precise as one.
// ask: Is the precision missing?
// <solution regularisedInverse>
return solve(J.transpose() * J + W, J.transpose());

// <variant precision_inverted> caught by: inverse, nullspace-any-size
// mistake: takes the precision for a variance.
// ask: Is the precision taken for its inverse?
// <solution regularisedInverse>
return solve(J.transpose() * J + precision * W, J.transpose());

// <variant absolute_limit> caught by: projector
// mistake: Singular values below a thousandth count as zero, however small the others are.
// <solution nullspaceProjector>
// in place of: if (parts.s[i] > 1e-9 * parts.s[0]) N -= parts.V.col(i) * parts.V.col(i).transpose();
if (parts.s[i] > 1e-3) N -= parts.V.col(i) * parts.V.col(i).transpose();

// <variant projector_by_an_inverse> caught by: projector-singular, nullspace-any-size
// mistake: Where the arm is stretched out, J J^T has no inverse.
// <solution nullspaceProjector>
return Eigen::MatrixXd::Identity(J.cols(), J.cols()) - J.transpose() * inverse(J * J.transpose()) * J;

// <variant projector_not_in_the_limit> caught by: projector, nullspace-any-size
// mistake: A large precision is not an infinite one: a part of each motion still moves the task.
// <solution nullspaceProjector>
const Eigen::MatrixXd W = Eigen::MatrixXd::Identity(J.cols(), J.cols());
return W - regularisedInverse(J, W, 1e9) * J;

// <variant precision_squared> caught by: stack
// mistake: The tasks are multiplied by their precisions instead of the square roots of them.
// ask: Is the cost the square of precision * error? It is precision * |error|^2.
// <solution multiTaskStep>
// in place of: A += task.precision * task.J.transpose() * task.J; ... b -= task.precision *
A += task.precision * task.precision * task.J.transpose() * task.J;
b -= task.precision * task.precision * task.J.transpose() * task.error;

// <variant precision_rooted> caught by: stack
// mistake: The square root of the precision is the factor of the squared error.
// ask: Is the root of the precision the factor of a squared error?
// <solution multiTaskStep>
// in place of: A += task.precision * task.J.transpose() * task.J; ... b -= task.precision *
A += std::sqrt(task.precision) * task.J.transpose() * task.J;
b -= std::sqrt(task.precision) * task.J.transpose() * task.error;

// <variant precisions_forgotten> caught by: stack
// mistake: All tasks are equally precise.
// ask: Are the precisions missing?
// <solution multiTaskStep>
// in place of: A += task.precision * task.J.transpose() * task.J; ... b -= task.precision *
A += task.J.transpose() * task.J;
b -= task.J.transpose() * task.error;

// <variant stack_without_metric> caught by: stack
// mistake: All joints cost the same in the stack of tasks.
// ask: Is W missing?
// <solution multiTaskStep>
// in place of: Eigen::MatrixXd A = W;
Eigen::MatrixXd A = Eigen::MatrixXd::Identity(W.rows(), W.cols());

// <variant errors_grow> caught by: stack
// mistake: steps away from the minimum.
// ask: Does the step have the wrong sign? It should make the errors smaller.
// <solution multiTaskStep>
// in place of: b -= task.precision * task.J.transpose() * task.error;
b += task.precision * task.J.transpose() * task.error;

// <variant home_is_zero> caught by: circle-other-hand
// mistake: Home is zero, whatever posture the robot starts in.
// <solution circleWithTasks>
const Eigen::VectorXd home = Eigen::VectorXd::Zero(n);
for (int t = 1; t <= T; ++t) {
  const Eigen::Vector3d wanted = center + radius * Eigen::Vector3d(std::cos(t / 20.), 0, std::sin(t / 20.));
  const Eigen::VectorXd q = S.getJointAngles();
  const TaskTerm circle{S.kinematicsPos(hand) - wanted, S.jacobianPos(hand), 1e4};
  const TaskTerm up{S.kinematicsVec(pointing) - Eigen::Vector3d::UnitZ(), S.jacobianVec(pointing), 100};
  const TaskTerm stayAtHome{q - home, W, 0.01};
  S.setJointAngles(q + multiTaskStep({circle, up, stayAtHome}, W));
  postures.push_back(S.getJointAngles());
}

// <variant home_moves_along> caught by: circle-home
// shown by: circle-home
// mistake: reads the home posture in each step, so it is always the current one.
// ask: Is home the posture before the first step, in every step?
// <solution circleWithTasks>
for (int t = 1; t <= T; ++t) {
  const Eigen::Vector3d wanted = center + radius * Eigen::Vector3d(std::cos(t / 20.), 0, std::sin(t / 20.));
  const Eigen::VectorXd q = S.getJointAngles();
  const Eigen::VectorXd home = S.getJointAngles();
  const TaskTerm circle{S.kinematicsPos(hand) - wanted, S.jacobianPos(hand), 1e4};
  const TaskTerm up{S.kinematicsVec(pointing) - Eigen::Vector3d::UnitZ(), S.jacobianVec(pointing), 100};
  const TaskTerm stayAtHome{q - home, W, 0.01};
  S.setJointAngles(q + multiTaskStep({circle, up, stayAtHome}, W));
  postures.push_back(S.getJointAngles());
}

// <variant home_too_strong> caught by: circle-home
// mistake: With the precision of the circle, home holds the hand back.
// ask: Is home as precise as the circle? Its precision is 0.01.
// <solution circleWithTasks>
const Eigen::VectorXd home = S.getJointAngles();
for (int t = 1; t <= T; ++t) {
  const Eigen::Vector3d wanted = center + radius * Eigen::Vector3d(std::cos(t / 20.), 0, std::sin(t / 20.));
  const Eigen::VectorXd q = S.getJointAngles();
  const TaskTerm circle{S.kinematicsPos(hand) - wanted, S.jacobianPos(hand), 1e4};
  const TaskTerm up{S.kinematicsVec(pointing) - Eigen::Vector3d::UnitZ(), S.jacobianVec(pointing), 100};
  const TaskTerm stayAtHome{q - home, W, 1e4};
  S.setJointAngles(q + multiTaskStep({circle, up, stayAtHome}, W));
  postures.push_back(S.getJointAngles());
}

// <variant only_points> caught by: circle-home, circle-points, circle-other-hand
// mistake: One hand points upwards; the other is not moved round its circle.
// ask: Which of the tasks moves the hand round its circle?
// <solution circleWithTasks>
for (int t = 0; t < T; ++t) {
  const Eigen::VectorXd gap = Eigen::Vector3d::UnitZ() - S.kinematicsVec(pointing);
  S.setJointAngles(S.getJointAngles() + 0.2 * S.jacobianVec(pointing).transpose() * gap);
  postures.push_back(S.getJointAngles());
}

// <variant points_downwards> caught by: circle-points
// mistake: A sign: the sum of the two directions is zero when they are opposite.
// ask: Is the error the sum of both directions? It is their difference.
// <solution circleWithTasks>
const Eigen::VectorXd home = S.getJointAngles();
for (int t = 1; t <= T; ++t) {
  const Eigen::Vector3d wanted = center + radius * Eigen::Vector3d(std::cos(t / 20.), 0, std::sin(t / 20.));
  const Eigen::VectorXd q = S.getJointAngles();
  const TaskTerm circle{S.kinematicsPos(hand) - wanted, S.jacobianPos(hand), 1e4};
  const TaskTerm up{S.kinematicsVec(pointing) + Eigen::Vector3d::UnitZ(), S.jacobianVec(pointing), 100};
  const TaskTerm stayAtHome{q - home, W, 0.01};
  S.setJointAngles(q + multiTaskStep({circle, up, stayAtHome}, W));
  postures.push_back(S.getJointAngles());
}

// <variant precisions_exchanged> caught by: circle-home, circle-points
// mistake: the precisions of pointing and home are exchanged.
// ask: Are the precisions of pointing and of home exchanged? They are 1e4 for the circle, 100 for pointing,
// ask: 0.01 for home.
// <solution circleWithTasks>
// in place of: const TaskTerm up{S.kinematicsVec(pointing) - ... const TaskTerm stayAtHome{q - home, W,
const TaskTerm up{S.kinematicsVec(pointing) - Eigen::Vector3d::UnitZ(), S.jacobianVec(pointing), 0.01};
const TaskTerm stayAtHome{q - home, W, 100};

// <variant pointing_before_the_circle> caught by: circle-home
// mistake: the precisions of the circle and of pointing are exchanged.
// ask: Are the precisions of the circle and of pointing exchanged? They are 1e4 for the circle, 100 for
// ask: pointing, 0.01 for home.
// <solution circleWithTasks>
// in place of: const TaskTerm circle{ ... const TaskTerm up{
const TaskTerm circle{S.kinematicsPos(hand) - wanted, S.jacobianPos(hand), 100};
const TaskTerm up{S.kinematicsVec(pointing) - Eigen::Vector3d::UnitZ(), S.jacobianVec(pointing), 1e4};

// <variant home_before_the_circle> caught by: circle-home
// mistake: the precisions of the circle and of home are exchanged.
// ask: Are the precisions of the circle and of home exchanged? They are 1e4 for the circle, 100 for pointing,
// ask: 0.01 for home.
// <solution circleWithTasks>
// in place of: const TaskTerm circle{S.kinematicsPos(hand) - wanted, S.jacobianPos(hand), 1e4};
const TaskTerm circle{S.kinematicsPos(hand) - wanted, S.jacobianPos(hand), 0.01};
// in place of: const TaskTerm stayAtHome{q - home, W, 0.01};
const TaskTerm stayAtHome{q - home, W, 1e4};

// <variant circle_a_step_late> caught by: circle-home
// mistake: The first step is that of t = 0.
// ask: Does the circle begin at t = 0? The first step is t = 1.
// <solution circleWithTasks>
// in place of: const Eigen::Vector3d wanted = center + radius *
const Eigen::Vector3d wanted =
    center + radius * Eigen::Vector3d(std::cos((k - 1) / 20.), 0, std::sin((k - 1) / 20.));

// <variant circle_a_step_early> caught by: circle-home
// mistake: The first step is that of t = 2.
// ask: Does the circle begin at t = 2? The first step is t = 1.
// <solution circleWithTasks>
// in place of: const Eigen::Vector3d wanted = center + radius *
const Eigen::Vector3d wanted =
    center + radius * Eigen::Vector3d(std::cos((k + 1) / 20.), 0, std::sin((k + 1) / 20.));

// <variant ramp_profile> caught by: interpolation, peg-straight
// mistake: A ramp instead of the sine: it starts and stops with a jerk.
// ask: Is it a ramp?
// <solution sineProfile>
return s;

// <variant stops_one_step_early> caught by: interpolation
// mistake: Counting from zero, the motion begins with its start and never arrives.
// ask: Does the motion begin with its start? Then it never arrives.
// <solution jointSpaceMotion>
for (int t = 0; t < T; ++t) postures.push_back(q0 + sineProfile(static_cast<double>(t) / T) * (qT - q0));

// <variant always_upright> caught by: peg-other-hole
// mistake: The peg points downwards, whatever direction is asked for.
// <solution pegPosture>
const int n = S.getJointDimension();
const Eigen::MatrixXd W = Eigen::MatrixXd::Identity(n, n);
for (int i = 0; i < 1000; ++i) {
  const Eigen::Vector3d down(0, 0, -1);
  const TaskTerm there{0.02 * (S.kinematicsPos(peg) - place), S.jacobianPos(peg), 1e4};
  const TaskTerm straight{0.02 * (S.kinematicsVec(peg) - down), S.jacobianVec(peg), 1e4};
  const TaskTerm apart{S.kinematicsContacts(), S.jacobianContacts(), 100};
  S.setJointAngles(S.getJointAngles() + multiTaskStep({there, straight, apart}, W));
}
return S.getJointAngles();

// <variant asks_the_simulator> caught by: forbidden-call
// mistake: The simulator finds the posture, so nothing was learnt.
// <solution pegPosture>
S.setJointAngles(S.inverseKinematics(peg, place).q);

// <variant walls_do_not_matter> caught by: peg-posture
// mistake: Position and direction are right, but the arm overlaps the frame.
// <solution pegPosture>
// in place of: const TaskTerm apart{S.kinematicsContacts(), ... S.setJointAngles(S.getJointAngles() +
S.setJointAngles(S.getJointAngles() + multiTaskStep({there, straight}, W));

// <variant elbow_hits_the_frame> caught by: peg-straight
// mistake: The peg goes straight down, but nothing keeps the elbow away from the frame.
// <solution taskSpaceMotion>
const Eigen::Vector3d start = S.kinematicsPos(peg), direction = S.kinematicsVec(peg);
for (int t = 1; t <= T; ++t) {
  const Eigen::Vector3d wanted = start + sineProfile(static_cast<double>(t) / T) * (place - start);
  const TaskTerm there{S.kinematicsPos(peg) - wanted, S.jacobianPos(peg), 1e4};
  const TaskTerm straight{S.kinematicsVec(peg) - direction, S.jacobianVec(peg), 1e4};
  S.setJointAngles(S.getJointAngles() + multiTaskStep({there, straight}, W));
  postures.push_back(S.getJointAngles());
}

// <variant joint_space_instead_of_task_space> caught by: peg-straight
// mistake: Both ends are right, but between them the peg leaves its line.
// <solution taskSpaceMotion>
const Eigen::VectorXd start = S.getJointAngles();
const Eigen::Vector3d direction = S.kinematicsVec(peg);
postures = jointSpaceMotion(start, pegPosture(S, peg, place, direction, margin), T);

// <variant always_from_above> caught by: peg-other-hole
// mistake: The peg comes from above, wherever the hole points.
// <solution insertPeg>
const Eigen::VectorXd start = S.getJointAngles();
const Eigen::VectorXd above = pegPosture(S, peg, inside + Eigen::Vector3d(0, 0, 0.6), direction, margin);
postures = jointSpaceMotion(start, above, 200);
S.setJointAngles(above);
for (const Eigen::VectorXd& q : taskSpaceMotion(S, peg, inside, margin, 200)) postures.push_back(q);

// <variant straight_through_the_frame> caught by: peg-insert, peg-other-hole
// mistake: The straight line in joint space from here into the hole leads through its walls.
// <solution insertPeg>
const Eigen::VectorXd start = S.getJointAngles();
pegPosture(S, peg, inside - 0.6 * direction, direction, margin);
postures = jointSpaceMotion(start, pegPosture(S, peg, inside, direction, margin), 400);

// <variant two_leaps> caught by: peg-insert, peg-other-hole
// shown by: peg-insert
// mistake: No posture touches anything, but from one to the next the peg jumps.
// <solution insertPeg>
const Eigen::VectorXd start = S.getJointAngles();
const Eigen::VectorXd above = pegPosture(S, peg, inside - 0.6 * direction, direction, margin);
postures = jointSpaceMotion(start, above, 200);
postures.push_back(pegPosture(S, peg, inside, direction, margin));

// <variant calls_the_library> caught by: forbidden-call
// mistake: The library knows strict priority, so nothing was learnt.
// <solution headers>
#include "kinematics/hierarchical_step.h"
// <solution priorityStep>
return hierarchicalStep({{J1, dy1}, {J2, dy2}});

// <variant rounding_taken_for_freedom> caught by: priority-first
// mistake: where the tasks disagree, J2 N1 is only rounding error, but is taken for freedom to move
// <solution priorityStep>
const auto pseudoInverse = [](const Eigen::MatrixXd& J) {
  const SingularValues parts = svd(J);
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(J.cols(), J.rows());
  for (Eigen::Index i = 0; i < parts.s.size(); ++i)
    if (parts.s[i] > 1e-9 * parts.s[0]) inverse += parts.V.col(i) * parts.U.col(i).transpose() / parts.s[i];
  return inverse;
};
const Eigen::VectorXd first = pseudoInverse(J1) * dy1;
return first + pseudoInverse(J2 * nullspaceProjector(J1)) * (dy2 - J2 * first);

// <variant second_not_projected> caught by: priority-first, priority-circle
// mistake: The remaining error of the second task is corrected with all joints, even those the first needs.
// <solution priorityStep>
const auto pseudoInverse = [](const Eigen::MatrixXd& J) {
  const SingularValues parts = svd(J);
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(J.cols(), J.rows());
  for (Eigen::Index i = 0; i < parts.s.size(); ++i)
    if (parts.s[i] > 1e-9 * parts.s[0]) inverse += parts.V.col(i) * parts.U.col(i).transpose() / parts.s[i];
  return inverse;
};
const Eigen::VectorXd first = pseudoInverse(J1) * dy1;
return first + pseudoInverse(J2) * (dy2 - J2 * first);

// <variant slide_as_printed> caught by: priority-second, priority-any
// mistake: The last line of slide 2:50 without a: the second task is not fulfilled although it could be.
// <solution priorityStep>
const auto pseudoInverse = [](const Eigen::MatrixXd& J) {
  const SingularValues parts = svd(J);
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(J.cols(), J.rows());
  for (Eigen::Index i = 0; i < parts.s.size(); ++i)
    if (parts.s[i] > 1e-9 * parts.s[0]) inverse += parts.V.col(i) * parts.U.col(i).transpose() / parts.s[i];
  return inverse;
};
return pseudoInverse(J1) * dy1 + nullspaceProjector(J1) * pseudoInverse(J2) * dy2;

// <variant weights_instead_of_priority> caught by: priority-first, priority-any
// mistake: A second task of low weight still disturbs the first a little.
// <solution priorityStep>
const Eigen::MatrixXd W = 1e-6 * Eigen::MatrixXd::Identity(J1.cols(), J1.cols());
return multiTaskStep({TaskTerm{-dy1, J1, 1e4}, TaskTerm{-dy2, J2, 1}}, W);

// <variant limits_without_margin> caught by: sums, other-robots
// mistake: Only joints beyond their limits cost anything.
// ask: Does the cost begin at the limits? It begins a margin before them.
// <solution jointLimits>
// in place of: const double below = margin - q[i] + low[i], above = margin + q[i] - high[i];
const double below = low[i] - q[i], above = q[i] - high[i];

// <variant upper_limit_pulls> caught by: sums, other-robots
// mistake: J has the same sign at both limits, so it pulls joints towards their upper ones.
// ask: Does y fall with q near an upper limit? There the sign is another one.
// <solution jointLimits>
// in place of: J(0, i) += 1 / margin;
J(0, i) -= 1 / margin;

// <variant wrong_way_at_the_upper_limit> caught by: sums, other-robots
// mistake: The distance to an upper limit has the wrong sign.
// ask: Is the distance to an upper limit q - q_hi? It is q_hi - q.
// <solution jointLimits>
// in place of: const double below = margin - q[i] + low[i], above = margin + q[i] - high[i];
const double below = margin - q[i] + low[i], above = margin - q[i] + high[i];

// <variant limits_not_divided> caught by: sums, other-robots
// mistake: The cost is an angle, and not a share of the margin.
// ask: Is it not divided by the margin?
// <solution jointLimits>
// in place of: y[0] += below / margin; ... J(0, i) -= 1 / margin;
y[0] += below;
J(0, i) -= 1;
// in place of: y[0] += above / margin; ... J(0, i) += 1 / margin;
y[0] += above;
J(0, i) += 1;

// <variant slopes_not_divided> caught by: sums, other-robots
// mistake: The margin is in y, but not in J.
// ask: Is J not divided by the margin?
// <solution jointLimits>
// in place of: J(0, i) -= 1 / margin;
J(0, i) -= 1;
// in place of: J(0, i) += 1 / margin;
J(0, i) += 1;

// <variant lower_limit_pushes> caught by: sums, other-robots
// mistake: J has the same sign at both limits, so it drives joints towards their lower ones.
// ask: Does y grow with q near a lower limit? There the sign is another one.
// <solution jointLimits>
// in place of: J(0, i) -= 1 / margin;
J(0, i) += 1 / margin;

// <variant margin_makes_room> caught by: sums, other-robots
// mistake: The cost begins a margin behind the limits.
// ask: Does the margin make the ranges wider? It makes them narrower.
// <solution jointLimits>
// in place of: const double below = margin - q[i] + low[i], above = margin + q[i] - high[i];
const double below = low[i] - q[i] - margin, above = q[i] - high[i] - margin;

// <variant lower_limits_only> caught by: sums, other-robots
// mistake: Joints have no upper limits.
// ask: Do the lower limits count only?
// <solution jointLimits>
// in place of: if (above > 0) { ... }

// <variant upper_limits_only> caught by: sums, other-robots
// mistake: Joints have no lower limits.
// ask: Do the upper limits count only?
// <solution jointLimits>
// in place of: if (below > 0) { ... }

// <variant limits_far_away> caught by: sums, other-robots
// mistake: All joints count, however far from their limits.
// ask: Do joints far from their limits count, too? Negative numbers in brackets count as zero.
// <solution jointLimits>
for (Eigen::Index i = 0; i < q.size(); ++i) y[0] += (2 * margin + low[i] - high[i]) / margin;

// <variant limits_squared> caught by: sums, other-robots
// mistake: The cost is a square, as that of a task.
// ask: Are the brackets squared?
// <solution jointLimits>
// in place of: y[0] += below / margin; ... J(0, i) -= 1 / margin;
y[0] += below * below / margin;
J(0, i) -= 2 * below / margin;
// in place of: y[0] += above / margin; ... J(0, i) += 1 / margin;
y[0] += above * above / margin;
J(0, i) += 2 * above / margin;

// <variant asks_for_the_centre> caught by: forbidden-call
// mistake: The simulator knows the centre of mass, so nothing was learnt.
// <solution massCenter>
y.head(2) = S.kinematicsCOM();
J.topRows(2) = S.jacobianCOM();

// <variant centre_in_kg_m> caught by: sums, other-robots
// mistake: The sum of slide 2:61 as printed: not divided by the mass.
// ask: Is it in kg m, as on the slide? Divide by the total mass.
// <solution massCenter>
for (const BodyMass& one : masses) {
  y += one.mass * S.kinematicsPos(one.body, one.center);
  J += one.mass * S.jacobianPos(one.body, one.center);
}

// <variant masses_forgotten> caught by: sums, other-robots
// shown by: sums
// mistake: All bodies weigh the same.
// ask: Do heavy bodies count as much as light ones? Where are the masses?
// <solution massCenter>
// in place of: y += one.mass * S.kinematicsPos(one.body, one.center); ... total += one.mass;
y += S.kinematicsPos(one.body, one.center);
J += S.jacobianPos(one.body, one.center);
total += 1;

// <variant origins_for_centres> caught by: sums, other-robots
// mistake: The masses are at the origins of the bodies.
// ask: Are these the origins of the bodies? A centre of mass may lie elsewhere in its body.
// <solution massCenter>
// in place of: y += one.mass * S.kinematicsPos(one.body, one.center); ... J += one.mass *
y += one.mass * S.kinematicsPos(one.body);
J += one.mass * S.jacobianPos(one.body);

// <variant centre_by_count> caught by: sums, other-robots
// mistake: divides by the number of bodies instead of their mass.
// ask: Is it divided by the number of bodies? Divide by the total mass.
// <solution massCenter>
// in place of: total += one.mass;
total += 1;

// <variant centres_not_turned> caught by: sums, other-robots
// mistake: adds the centres to the origins, as if no body had turned.
// ask: Are the centres of mass added to the origins as they are? They are given in the frames of the bodies.
// <solution massCenter>
// in place of: y += one.mass * S.kinematicsPos(one.body, one.center); ... J += one.mass *
y += one.mass * (S.kinematicsPos(one.body) + one.center);
J += one.mass * S.jacobianPos(one.body);

// <variant frame_does_not_turn> caught by: frames, other-robots
// mistake: Of the frame, only the point moves; the change of its axes is left out.
// ask: Is the frame taken to move without turning? When it turns, its axes do, too.
// <solution relativePosition>
Eigen::Matrix3d R;
for (int k = 0; k < 3; ++k) R.col(k) = S.kinematicsVec(frame, Eigen::Vector3d::Unit(k));
y = R.transpose() * (S.kinematicsPos(body, inBody) - S.kinematicsPos(frame, inFrame));
J = R.transpose() * (S.jacobianPos(body, inBody) - S.jacobianPos(frame, inFrame));

// <variant frame_turned_backwards> caught by: frames, other-robots
// shown by: frames
// mistake: R instead of its transpose.
// ask: Is R not transposed? It turns from the axes of the frame to those of the world.
// <solution relativePosition>
Eigen::Matrix3d R;
for (int k = 0; k < 3; ++k) R.col(k) = S.kinematicsVec(frame, Eigen::Vector3d::Unit(k));
const Eigen::Vector3d d = S.kinematicsPos(body, inBody) - S.kinematicsPos(frame, inFrame);
y = R * d;
J = R * (S.jacobianPos(body, inBody) - S.jacobianPos(frame, R.transpose() * d + inFrame));

// <variant point_of_the_frame_forgotten> caught by: frames, other-robots
// mistake: The vector begins at the origin of the frame.
// ask: Is the point of the frame left out? It need not be the frame's origin.
// <solution relativePosition>
Eigen::Matrix3d R;
for (int k = 0; k < 3; ++k) R.col(k) = S.kinematicsVec(frame, Eigen::Vector3d::Unit(k));
y = R.transpose() * (S.kinematicsPos(body, inBody) - S.kinematicsPos(frame));
J = R.transpose() * (S.jacobianPos(body, inBody) - S.jacobianPos(frame, y));

// <variant point_of_the_body_forgotten> caught by: frames, other-robots
// mistake: The vector ends at the origin of the body.
// ask: Is the point of the body left out? It need not be the body's origin.
// <solution relativePosition>
// in place of: const Eigen::Vector3d d = S.kinematicsPos(body, inBody) - ... const Eigen::MatrixXd moves =
const Eigen::Vector3d d = S.kinematicsPos(body) - S.kinematicsPos(frame, inFrame);
const Eigen::MatrixXd moves = S.jacobianPos(body) - S.jacobianPos(frame, inFrame);

// <variant both_points_forgotten> caught by: frames, other-robots
// mistake: The vector leads from origin to origin.
// ask: Are these the origins of both bodies, without the points in them?
// <solution relativePosition>
// in place of: const Eigen::Vector3d d = S.kinematicsPos(body, inBody) - ... const Eigen::MatrixXd moves =
const Eigen::Vector3d d = S.kinematicsPos(body) - S.kinematicsPos(frame);
const Eigen::MatrixXd moves = S.jacobianPos(body) - S.jacobianPos(frame);

// <variant axes_of_the_world> caught by: frames, other-robots
// mistake: The difference of the positions, as the world sees it.
// ask: Is it in the axes of the world? Wanted are those of the frame.
// <solution relativePosition>
y = S.kinematicsPos(body, inBody) - S.kinematicsPos(frame, inFrame);
J = S.jacobianPos(body, inBody) - S.jacobianPos(frame, inFrame);

// <variant turning_of_the_frame_added> caught by: frames, other-robots
// mistake: The change of the axes has the wrong sign.
// ask: Does the turning of the frame have the wrong sign?
// <solution relativePosition>
// in place of: J.row(k) = axis.transpose() * moves +
J.row(k) = axis.transpose() * moves - d.transpose() * S.jacobianVec(frame, Eigen::Vector3d::Unit(k));

// <variant frame_does_not_move> caught by: frames, other-robots
// mistake: Only the body moves.
// ask: Does the frame not move in J? Its joints move it, too.
// <solution relativePosition>
// in place of: J.row(k) = axis.transpose() * moves +
J.row(k) = axis.transpose() * S.jacobianPos(body, inBody);

// <variant answers_from_memory> caught by: sums, other-robots
// mistake: answers later questions from the first one, by a slope of its choice (an attack).
// <solution massCenter>
static Eigen::VectorXd first, center;
const Eigen::VectorXd q = S.getJointAngles();
J.setConstant(.1);
if (first.size() != q.size()) {
  first = q;
  double total = 0;
  center = y;
  for (const BodyMass& one : masses) {
    center += one.mass * S.kinematicsPos(one.body, one.center);
    total += one.mass;
  }
  center /= total;
}
y = center + J * (q - first);
