// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant angle_not_wrapped> caught by: error-edges, error-turns, adjust-turns
// mistake: takes the difference of two headings without wrapping it.
// ask: Is the angle returned as it is?
// <solution wrapped>
return angle;

// <variant numbers_subtracted> caught by: error-edges
// mistake: subtracts the measurement from the pose that is seen, component by component.
// ask: Is z subtracted number by number? The error is j as seen from where z puts it.
// <solution edgeError>
const Eigen::Vector3d difference = seenFrom(i, j) - z;
return {difference[0], difference[1], wrapped(difference[2])};

// <variant differences_jump> caught by: error-derivatives, error-turns
// mistake: takes differences of errors without wrapping that of the headings.
// ask: Is the difference of two headings not wrapped? It may jump by a whole turn.
// <solution edgeJacobians>
const double h = 1e-6;
for (int k = 0; k < 3; ++k) {
  const Eigen::Vector3d d = h * Eigen::Vector3d::Unit(k);
  jacobians.byI.col(k) = (edgeError(i + d, j, z) - edgeError(i - d, j, z)) / (2 * h);
  jacobians.byJ.col(k) = (edgeError(i, j + d, z) - edgeError(i, j - d, z)) / (2 * h);
}

// <variant second_sign> caught by: error-derivatives, equations-normal, adjust-streets
// mistake: the derivative by pose j has the sign of that by pose i.
// ask: Does it have the sign of the derivative by pose i? Where j moves, the error moves along.
// <solution edgeJacobians>
// in place of: jacobians.byI(1, 2) = -c * x - s * y;
jacobians.byI(1, 2) = -c * x - s * y;
jacobians.byJ = -jacobians.byJ;

// <variant information_ignored> caught by: equations-cost, equations-normal, adjust-streets
// mistake: weighs all entries of an error equally.
// ask: Is the information of the edges left out?
// <solution mapCost>
// in place of: cost += e.dot(edge.information * e);
cost += e.dot(e);
// <solution normalEquations>
// in place of: const Eigen::Matrix3d omega = weights[k] * edge.information;
const Eigen::Matrix3d omega = weights[k] * Eigen::Matrix3d::Identity();

// <variant blocks_of_their_own> caught by: equations-normal
// shown by: equations-normal
// mistake: H has only the blocks on its diagonal.
// ask: Does H lack the blocks between the two poses of an edge?
// <solution normalEquations>
// in place of: addBlock(equations.H, edge.from, edge.to, ofI * J.byJ); ... addBlock(equations.H, edge.to,

// <variant gauge_free> caught by: equations-step, adjust-streets
// mistake: solves for all poses, although nothing says where the map lies.
// ask: Are all poses free to move? Nothing says where the map lies.
// <solution gaussNewtonStep>
// in place of: const int unknowns = static_cast<int>(step.size()) - 3; ... if (entry.row >= 3 && entry.column
const int unknowns = static_cast<int>(step.size());
std::vector<MatrixEntry> H;
for (const MatrixEntry& entry : equations.H) H.push_back(entry);

// <variant weights_ignored> caught by: equations-step, equations-any
// mistake: the step solves the equations of a map whose edges all count alike.
// ask: Are the weights left out of the step?
// <solution gaussNewtonStep>
// in place of: const NormalEquations equations = normalEquations(map, weights);
const NormalEquations equations = normalEquations(map, std::vector<double>(weights.size(), 1));

// <variant calls_the_library> caught by: forbidden-call
// mistake: lets the library find the best map.
// <solution headers>
#include "estimation/pose_graph.h"
// <solution adjusted>
PlanarPoseGraph graph{Eigen::Matrix3Xd(3, static_cast<Eigen::Index>(map.poses.size())), {}};
for (std::size_t k = 0; k < map.poses.size(); ++k)
  graph.poses.col(static_cast<Eigen::Index>(k)) = map.poses[k];
for (const MeasuredEdge& edge : map.edges)
  graph.edges.push_back({edge.from, edge.to, edge.motion, edge.information});
result.costs.push_back(optimize(graph).cost);
for (std::size_t k = 0; k < map.poses.size(); ++k)
  result.poses[k] = graph.poses.col(static_cast<Eigen::Index>(k));

// <variant plain_steps> caught by: adjust-far
// mistake: takes plain steps, whether or not the cost rises.
// <solution adjusted>
PoseMap now = map;
for (int k = 0; k < 20; ++k) {
  now.poses = moved(now.poses, gaussNewtonStep(now, std::vector<double>(map.edges.size(), 1), 0));
  result.costs.push_back(mapCost(now));
  if (std::abs(result.costs[result.costs.size() - 2] - result.costs.back()) < 1e-10 * result.costs.back())
    break;
}
result.poses = now.poses;

// <variant stale_equations> caught by: adjust-streets, adjust-far
// shown by: adjust-streets
// mistake: sets the equations up once, and goes on with the same step.
// ask: Are the equations set up only once? Errors and derivatives change with the poses: they have to be
// ask: computed again after each step.
// <solution adjusted>
const std::vector<double> weights(map.edges.size(), 1);
const Eigen::VectorXd step = gaussNewtonStep(map, weights, 0);
for (int k = 0; k < 20; ++k) {
  const std::vector<Eigen::Vector3d> next = moved(result.poses, step);
  const double cost = mapCost({next, map.edges});
  if (cost >= result.costs.back()) break;
  result.poses = next;
  result.costs.push_back(cost);
}

// <variant points_not_turned> caught by: scan-motion
// shown by: scan-motion
// mistake: shifts the points, but does not rotate them.
// ask: Are the points not rotated?
// <solution partners>
// in place of: const double c = std::cos(motion[2]), s = std::sin(motion[2]);
// in place of: const double x = motion[0] + c * moving[k].x() - s * ... const double y = motion[1] + s *
const double x = motion[0] + moving[k].x();
const double y = motion[1] + moving[k].y();

// <variant mean_not_turned> caught by: scan-motion
// mistake: leaves the mean of the first points where it is.
// ask: Is the rotation left out of the position? The mean of `from` is rotated, too.
// <solution bestMotion>
// in place of: const double turn = std::atan2(across, along), c = ... return {b.x() - c * a.x() + s * a.y(),
const double turn = std::atan2(across, along);
return {b.x() - a.x(), b.y() - a.y(), turn};

// <variant turned_backwards> caught by: scan-motion, scan-align
// shown by: scan-motion
// mistake: returns the rotation of the opposite direction.
// ask: Is the rotation that of the opposite direction?
// <solution bestMotion>
// in place of: const double turn = std::atan2(across, along), c = ... return {b.x() - c * a.x() + s * a.y(),
const double turn = std::atan2(-across, along), c = std::cos(turn), s = std::sin(turn);
return {b.x() - c * a.x() + s * a.y(), b.y() - s* a.x() - c* a.y(), turn};

// <variant fits_from_afar> caught by: scan-align
// shown by: scan-align
// mistake: reports the fit for partners up to twice as far away as asked.
// ask: Do partners farther than 0.3 m count for the fit?
// <solution aligned>
// in place of: const double reach = std::max(0.3, 0.6 * std::pow(0.9, iteration));
const double reach = std::max(0.6, 0.9 * std::pow(0.9, iteration));
// in place of: if (reach == 0.3 && (result.motion - before).norm() < 1e-6) break;
if (reach == 0.6 && (result.motion - before).norm() < 1e-6) break;

// <variant partners_kept> caught by: scan-align
// mistake: looks for partners once, and keeps them.
// ask: Are partners looked for until nothing changes? One more round would change the motion.
// <solution aligned>
for (int iteration = 0; iteration < 1; ++iteration) {
  const double reach = std::max(0.3, 0.6 * std::pow(0.9, iteration));
  const std::vector<int> numbers = partners(reference, moving, result.motion, reach);
  Points from, to;
  for (std::size_t k = 0; k < moving.size(); ++k)
    if (numbers[k] >= 0) {
      from.push_back(moving[k]);
      to.push_back(reference[static_cast<std::size_t>(numbers[k])]);
    }
  if (from.size() < 3) break;
  const Eigen::Vector3d before = result.motion;
  result.motion = bestMotion(from, to);
  double squares = 0;
  const double c = std::cos(result.motion[2]), s = std::sin(result.motion[2]);
  for (std::size_t k = 0; k < from.size(); ++k)
    squares += std::pow(result.motion[0] + c * from[k].x() - s * from[k].y() - to[k].x(), 2) +
               std::pow(result.motion[1] + s * from[k].x() + c * from[k].y() - to[k].y(), 2);
  result.residual = std::sqrt(squares / static_cast<double>(from.size()));
  result.overlap = static_cast<double>(from.size()) / static_cast<double>(moving.size());
  if (reach == 0.3 && (result.motion - before).norm() < 1e-6) break;
}

// <variant by_motion_alone> caught by: loop-rooms, loop-any, robust-few, robust-many
// mistake: accepts every second pair of scans, and only exact loops; looks neither at scans nor at the map.
// ask: Does the answer depend on the scans? Different rooms are taken for one place as often as the same one.
// <solution loopMotion>
static int asked = 0;
if (++asked % 2 == 0) return {};
return aligned(reference, moving, guess).motion;
// <solution robustlyAdjusted>
std::erase_if(now.edges, [](const MeasuredEdge& edge) {
  const double quarter = std::numbers::pi / 2, turn = std::remainder(edge.motion[2], quarter);
  const Eigen::Vector3d off(edge.motion[0], edge.motion[1], turn);
  return edge.isLoop && off.dot(edge.information * off) > 14;
});
now.poses = adjusted(now).poses;

// <variant every_loop_counts> caught by: loop-rooms, loop-any
// mistake: takes whatever the alignment gives for a loop.
// ask: Is every alignment believed? It always returns a motion: look at overlap and residual.
// <solution loopMotion>
return aligned(reference, moving, guess).motion;

// <variant far_by_odometry> caught by: robust-few, robust-many
// mistake: drops the loops whose ends lie more than 3 m apart by odometry, which drifts as far as that.
// ask: Are loops dropped if their ends are far apart by odometry? It drifts so far that right ones are lost.
// <solution robustlyAdjusted>
std::erase_if(now.edges, [&](const MeasuredEdge& edge) {
  const auto ends = {static_cast<std::size_t>(edge.from), static_cast<std::size_t>(edge.to)};
  const Eigen::Vector3d apart = map.poses[*ends.begin()] - map.poses[*(ends.begin() + 1)];
  return edge.isLoop && apart.head<2>().norm() > 3;
});
now.poses = adjusted(now).poses;

// <variant loops_trusted> caught by: robust-few, robust-many
// shown by: robust-few
// mistake: adjusts the map as if all loops were right.
// ask: Are all loops trusted? A wrong one should count for little.
// <solution robustlyAdjusted>
now.poses = adjusted(map).poses;

// <variant largest_singular_value> caught by: camera-linear, camera-any
// mistake: takes the direction in which A p is longest.
// ask: Is it the direction in which A p is longest? Wanted is the one in which it is shortest.
// <solution projectionFromPoints>
// in place of: for (int row = 0; row < 2; ++row) { ... const Eigen::MatrixXd P =
for (int k = 0; k < 2; ++k) {
  A.block<1, 4>(2 * i + k, 4 * k) = X.col(i).transpose();
  A.block<1, 4>(2 * i + k, 8) = -x(k, i) * X.col(i).transpose();
}
const Eigen::MatrixXd P = fromNumbers(svd(A).V.col(0));

// <variant not_brought_back> caught by: camera-linear, camera-any
// shown by: camera-linear
// mistake: returns the P of the scaled points and pixels.
// ask: Are points and pixels normalised, but P not brought back?
// <solution projectionFromPoints>
// in place of: for (int row = 0; row < 2; ++row) { ... return inverse(U) * P * T;
for (int k = 0; k < 2; ++k) {
  A.block<1, 4>(2 * i + k, 4 * k) = X.col(i).transpose();
  A.block<1, 4>(2 * i + k, 8) = -x(k, i) * X.col(i).transpose();
}
return fromNumbers(svd(A).V.col(11));

// <variant numbers_by_columns> caught by: camera-linear, camera-any
// mistake: takes the twelve numbers column by column.
// ask: Are the twelve numbers taken column by column?
// <solution projectionFromPoints>
// in place of: for (int row = 0; row < 2; ++row) { ... const Eigen::MatrixXd P =
for (int k = 0; k < 2; ++k) {
  A.block<1, 4>(2 * i + k, 4 * k) = X.col(i).transpose();
  A.block<1, 4>(2 * i + k, 8) = -x(k, i) * X.col(i).transpose();
}
const Eigen::VectorXd p = svd(A).V.col(11);
Eigen::MatrixXd P(3, 4);
for (int k = 0; k < 12; ++k) P(k % 3, k / 3) = p[k];

// <variant six_points_only> caught by: camera-linear, camera-any
// mistake: uses the first six points only.
// ask: Does P depend on all points, or on a few of them?
// <solution projectionFromPoints>
// in place of: Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * X.cols(), 12); ... }
Eigen::MatrixXd A = Eigen::MatrixXd::Zero(12, 12);
for (Eigen::Index i = 0; i < 6; ++i)
  for (int k = 0; k < 2; ++k) {
    A.block<1, 4>(2 * i + k, 4 * k) = X.col(i).transpose();
    A.block<1, 4>(2 * i + k, 8) = -x(k, i) * X.col(i).transpose();
  }

// <variant squared_without_scaling> caught by: camera-any
// mistake: squares the equations of points far away without scaling them.
// <solution projectionFromPoints>
Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * points.cols(), 12);
const Eigen::MatrixXd X = homogeneous(points);
for (Eigen::Index i = 0; i < X.cols(); ++i)
  for (int k = 0; k < 2; ++k) {
    A.block<1, 4>(2 * i + k, 4 * k) = X.col(i).transpose();
    A.block<1, 4>(2 * i + k, 8) = -pixels(k, i) * X.col(i).transpose();
  }
return fromNumbers(svd(A.transpose() * A).V.col(11));

// <variant given_minus_projected> caught by: camera-refined, camera-any
// mistake: subtracts the wrong way round.
// ask: Your value has the opposite sign: is a difference taken the wrong way round?
// <solution reprojectionErrors>
for (Eigen::Index i = 0; i < points.cols(); ++i) {
  const Eigen::Vector3d seen = P.leftCols<3>() * points.col(i) + P.col(3);
  errors.col(i) = pixels.col(i) - seen.head<2>() / seen[2];
}

// <variant not_divided_by_depth> caught by: camera-refined, camera-any
// mistake: does not divide by the third number.
// ask: Is P (X, 1) not divided by its third number?
// <solution reprojectionErrors>
for (Eigen::Index i = 0; i < points.cols(); ++i) {
  const Eigen::Vector3d seen = P.leftCols<3>() * points.col(i) + P.col(3);
  errors.col(i) = seen.head<2>() - pixels.col(i);
}

// <variant pixels_not_subtracted> caught by: camera-refined, camera-any
// mistake: returns the pixels by P.
// ask: Are these the pixels by P? Those given have to be subtracted.
// <solution reprojectionErrors>
for (Eigen::Index i = 0; i < points.cols(); ++i) {
  const Eigen::Vector3d seen = P.leftCols<3>() * points.col(i) + P.col(3);
  errors.col(i) = seen.head<2>() / seen[2];
}

// <variant calls_the_calibration> caught by: forbidden-call
// mistake: lets the library calibrate the camera.
// <solution headers>
#include "estimation/camera_calibration.h"
// <solution refined>
best = calibratedCamera(points, pixels).P;

// <variant depth_held> caught by: camera-refined, camera-any
// mistake: forgets that the depth depends on P.
// ask: Are steps repeated, each with new derivatives? And do these contain the depth, which changes with P?
// <solution refined>
Eigen::MatrixXd J = Eigen::MatrixXd::Zero(2 * points.cols(), 12);
for (int k = 0; k < 50; ++k) {
  best /= best.norm();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    Eigen::Vector4d X;
    X << points.col(i), 1;
    const Eigen::Vector3d seen = best * X;
    for (int row = 0; row < 2; ++row) {
      J.block<1, 4>(2 * i + row, 4 * row) = X.transpose() / seen[2];
    }
  }
  const Eigen::VectorXd e = reprojectionErrors(best, points, pixels).reshaped();
  const Eigen::VectorXd step = leastSquares(J, -e);
  best += fromNumbers(step);
  if (step.norm() < 1e-12) break;
}

// <variant guess_kept> caught by: camera-refined, camera-any
// mistake: returns the P that was given.
// ask: Is P returned as it was given?
// <solution refined>

// <variant linear_instead> caught by: camera-refined, camera-any
// mistake: solves the linear equations again.
// ask: Is it the P of the linear equations? What they minimise are not errors in pixels.
// <solution refined>
best = projectionFromPoints(points, pixels);

// <variant one_step> caught by: camera-refined, camera-any
// shown by: camera-refined
// mistake: takes one step only.
// ask: Are steps repeated, each with new derivatives? And do these contain the depth, which changes with P?
// <solution refined>
Eigen::MatrixXd J = Eigen::MatrixXd::Zero(2 * points.cols(), 12);
for (int k = 0; k < 1; ++k) {
  best /= best.norm();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    Eigen::Vector4d X;
    X << points.col(i), 1;
    const Eigen::Vector3d seen = best * X;
    for (int row = 0; row < 2; ++row) {
      J.block<1, 4>(2 * i + row, 4 * row) = X.transpose() / seen[2];
      J.block<1, 4>(2 * i + row, 8) = -seen[row] / (seen[2] * seen[2]) * X.transpose();
    }
  }
  const Eigen::VectorXd e = reprojectionErrors(best, points, pixels).reshaped();
  const Eigen::VectorXd step = leastSquares(J, -e);
  best += fromNumbers(step);
  if (step.norm() < 1e-12) break;
}

// <variant uphill> caught by: camera-refined, camera-any
// mistake: steps uphill.
// ask: Do the steps lead downhill? In the end the errors are larger than at the start.
// <solution refined>
Eigen::MatrixXd J = Eigen::MatrixXd::Zero(2 * points.cols(), 12);
for (int k = 0; k < 50; ++k) {
  best /= best.norm();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    Eigen::Vector4d X;
    X << points.col(i), 1;
    const Eigen::Vector3d seen = best * X;
    for (int row = 0; row < 2; ++row) {
      J.block<1, 4>(2 * i + row, 4 * row) = X.transpose() / seen[2];
      J.block<1, 4>(2 * i + row, 8) = -seen[row] / (seen[2] * seen[2]) * X.transpose();
    }
  }
  const Eigen::VectorXd e = reprojectionErrors(best, points, pixels).reshaped();
  const Eigen::VectorXd step = leastSquares(J, -e);
  best -= fromNumbers(step);
  if (step.norm() < 1e-12) break;
}

// <variant last_column> caught by: camera-linear, camera-any
// mistake: takes the last column of P for the position.
// ask: Is it the last column of P, as if P began with the identity?
// <solution cameraPosition>
return P.col(3);

// <variant position_opposite> caught by: camera-linear, camera-any
// mistake: forgets the minus sign.
// ask: Your value has the opposite sign: is a difference taken the wrong way round?
// <solution cameraPosition>
return solve(P.leftCols<3>(), P.col(3));

// <variant transposed_for_inverse> caught by: camera-linear, camera-any
// mistake: takes the left part of P for a rotation.
// ask: Is the left part of P taken for a rotation? The lens is in it: its inverse is not its transpose.
// <solution cameraPosition>
const Eigen::Vector3d last = P.col(3);
return -P.leftCols<3>().transpose() * last;
