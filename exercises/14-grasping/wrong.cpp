// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant length_forgotten> caught by: wrenches, all-wrenches
// mistake: torques in newton metres beside forces in newtons.
// ask: Is the torque not divided by length?
// <solution planarWrench>
const Eigen::Vector2d arm = p - center;
return {force.x(), force.y(), arm.x() * force.y() - arm.y() * force.x()};
// <solution spatialWrench>
wrench << force, (p - center).cross(force);

// <variant torque_about_the_origin> caught by: wrenches, all-wrenches
// mistake: takes the torque about the origin, whatever the center is.
// ask: Is it the torque about the origin instead of the center?
// <solution planarWrench>
return {force.x(), force.y(), (p.x() * force.y() - p.y() * force.x()) / length};
// <solution spatialWrench>
wrench << force, p.cross(force) / length;

// <variant torque_as_printed> caught by: wrenches, all-wrenches
// mistake: the product of slide 10:6 as it is printed, force x arm.
// ask: Is it force x arm? The torque is arm x force.
// <solution planarWrench>
const Eigen::Vector2d arm = p - center;
return {force.x(), force.y(), (force.x() * arm.y() - force.y() * arm.x()) / length};
// <solution spatialWrench>
wrench << force, force.cross(p - center) / length;

// <variant counts_its_calls> caught by: cones, any-cones
// mistake: counts its calls, as if the six questions about a cone came in a fixed order.
// <solution inCone>
static int asked = 0;
const int question = asked++ % 6;
return question == 0 || question == 3 || question == 4;

// <variant friction_is_an_angle> caught by: cones, any-cones, all-wrenches
// mistake: takes the friction for the half angle of the cone.
// <solution inCone>
if (force.norm() == 0) return true;
return std::acos(std::min(1., force.dot(finger.normal) / force.norm())) <= finger.friction + 1e-7;
// <solution pyramidEdges>
// in place of: forces.col(k) = n + finger.friction * (std::cos(angle) * a + std::sin(angle) * b);
forces.col(k) = n + std::tan(finger.friction) * (std::cos(angle) * a + std::sin(angle) * b);

// <variant friction_of_the_whole_force> caught by: cones, any-cones
// mistake: friction times the size of the force.
// ask: Is friction multiplied by the size of the force? Only its component along the normal counts.
// <solution inCone>
// in place of: return across <= finger.friction * along + 1e-9 * force.norm();
return along >= 0 && across <= finger.friction * force.norm() + 1e-9 * force.norm();

// <variant pulls_too> caught by: cones, any-cones
// mistake: forgets that a finger only pushes.
// ask: May the component along the normal be negative in your code? A finger only pushes.
// <solution inCone>
const double along = std::abs(force.dot(finger.normal));
return (force - force.dot(finger.normal) * finger.normal).norm() <=
       finger.friction * along + 1e-9 * force.norm();

// <variant tolerance_in_newtons> caught by: cones, any-cones
// mistake: the tolerance is in newtons instead of relative to the size of the force.
// ask: Is the tolerance in newtons? It should be relative to the size of the force.
// <solution inCone>
const double normal = force.dot(finger.normal), along = (force - normal * finger.normal).norm();
return along <= finger.friction * normal + 1e-9;

// <variant no_room_for_rounding> caught by: cones, any-cones
// mistake: compares without any tolerance.
// <solution inCone>
// in place of: return across <= finger.friction * along + 1e-9 * force.norm();
return across <= finger.friction * along;

// <variant both_edges_alike> caught by: cones, all-wrenches
// mistake: returns the same edge of a planar cone twice.
// ask: Is the same edge of a finger returned twice? The other one lies on the other side of the normal.
// <solution planarWrenches>
Eigen::Index column = 0;
for (const PlanarFinger& finger : fingers)
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d across(-finger.normal.y(), finger.normal.x());
    wrenches.col(column++) = planarWrench(finger.p, finger.normal + finger.friction * across, center, length);
  }

// <variant edge_by_edge> caught by: cones, all-wrenches
// mistake: the first edges of all fingers, then the second ones.
// <solution spatialWrenches>
Eigen::Index column = 0;
for (Eigen::Index k = 0; k < edges; ++k)
  for (const Finger& finger : fingers)
    wrenches.col(column++) = spatialWrench(finger.p, pyramidEdges(finger, edges).col(k), center, length);

// <variant axis_along_the_normal> caught by: cones, any-cones
// mistake: the first direction along the surface comes from the z axis, which may be the normal.
// <solution pyramidEdges>
// in place of: const Eigen::Vector3d least = std::abs(n.x()) < 0.6 ? ... const Eigen::Vector3d a =
const Eigen::Vector3d a = n.cross(Eigen::Vector3d::UnitZ()).normalized(), b = n.cross(a);

// <variant edges_of_integers> caught by: cones
// mistake: divides integers.
// <solution pyramidEdges>
// in place of: const double angle = 2 * std::numbers::pi * k / edges;
const double angle = 2 * std::numbers::pi * (k / edges);

// <variant pyramid_around_the_cone> caught by: cones, any-cones, all-wrenches
// shown by: cones
// mistake: a pyramid whose sides touch the cone, so that its edges lie outside.
// <solution pyramidEdges>
// in place of: const Eigen::Vector3d a = n.cross(least).normalized(), b = n.cross(a);
const Eigen::Vector3d a = n.cross(least).normalized(), b = n.cross(a);
const double radius = finger.friction / std::cos(std::numbers::pi / edges);
// in place of: forces.col(k) = n + finger.friction * (std::cos(angle) * a + std::sin(angle) * b);
forces.col(k) = n + radius * (std::cos(angle) * a + std::sin(angle) * b);

// <variant unit_edges> caught by: cones, any-cones, all-wrenches
// mistake: edges are as long as one newton, instead of their normal components.
// <solution pyramidEdges>
// in place of: forces.col(k) = n + finger.friction * (std::cos(angle) * a + std::sin(angle) * b);
forces.col(k) = (n + finger.friction * (std::cos(angle) * a + std::sin(angle) * b)).normalized();

// <variant direction_turned_round> caught by: verdicts, grasps
// mistake: the direction of an open grasp has the wrong sign.
// <solution judged>
// in place of: Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(d, n + d);  // so that U is square, however few
Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(d, n + d);
// in place of: if (values.s[d - 1] < 1e-9 * values.s[0]) return {false, ... const Eigen::VectorXd weights =
if (values.s[d - 1] < 1e-9 * values.s[0]) return {false, values.U.col(d - 1)};
const LinearSolution rest = minimizeLinear(wrenches, -wrenches.rowwise().sum(), Eigen::VectorXd::Ones(n));
if (rest.status != LinearStatus::kOptimal) return {false, rest.y.normalized()};
const Eigen::VectorXd weights = rest.x.array() + 1;

// <variant span_forgotten> caught by: verdicts, border
// mistake: accepts weights for zero, even if all wrenches lie in a plane.
// <solution judged>
const Eigen::Index n = wrenches.cols();
const LinearSolution rest = minimizeLinear(wrenches, -wrenches.rowwise().sum(), Eigen::VectorXd::Ones(n));
if (rest.status != LinearStatus::kOptimal) return {false, -rest.y.normalized()};
const Eigen::VectorXd weights = rest.x.array() + 1;
return {true, weights / weights.sum()};

// <variant span_is_enough> caught by: verdicts, grasps, border
// mistake: takes wrenches that span the space for closed, as if they could pull.
// <solution judged>
const Eigen::Index d = wrenches.rows(), n = wrenches.cols();
Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(d, n + d);
padded.leftCols(n) = wrenches;
const SingularValues values = svd(padded);
if (values.s[d - 1] < 1e-9 * values.s[0]) return {false, values.U.col(d - 1)};
return {true, Eigen::VectorXd::Constant(n, 1. / static_cast<double>(n))};

// <variant weights_of_zero> caught by: verdicts, grasps, border
// mistake: asks whether zero is in the hull, with weights that may be zero.
// <solution judged>
const Eigen::Index d = wrenches.rows(), n = wrenches.cols();
Eigen::MatrixXd A(d + 1, n);
A << wrenches, Eigen::RowVectorXd::Ones(n);
Eigen::VectorXd b = Eigen::VectorXd::Zero(d + 1);
b[d] = 1;
const LinearSolution inside = minimizeLinear(A, b, Eigen::VectorXd::Zero(n));
if (inside.status == LinearStatus::kOptimal) return {true, inside.x};
return {false, -inside.y.head(d).normalized()};

// <variant farthest_corner> caught by: reach, any-reach
// shown by: reach
// mistake: measures how far the corners lie along the direction, which is not how far the hull reaches.
// ask: Is it how far a corner lies along the direction? The hull ends before.
// <solution reachAlong>
return (wrenches.transpose() * direction).maxCoeff();

// <variant reaches_back> caught by: reach, any-reach
// shown by: reach
// mistake: -s * direction is in the hull.
// ask: Is it how far the hull reaches the other way, along -direction?
// <solution reachAlong>
// in place of: A.topRightCorner(d, 1) = -direction;
A.topRightCorner(d, 1) = direction;

// <variant weights_without_sum> caught by: reach, any-reach
// shown by: reach
// mistake: each weight at most one, instead of one for all together.
// ask: Is each weight at most one? All together sum to one.
// <solution reachAlong>
// in place of: Eigen::MatrixXd A = Eigen::MatrixXd::Zero(d + 1, n + 1);  // unknown: the weights, and then s
Eigen::MatrixXd A = Eigen::MatrixXd::Zero(d + n, 2 * n + 1);
// in place of: A.bottomLeftCorner(1, n).setOnes(); ... cost[n] = -1;
A.bottomLeftCorner(n, n).setIdentity();
A.block(d, n, n, n).setIdentity();
Eigen::VectorXd b = Eigen::VectorXd::Ones(d + n), cost = Eigen::VectorXd::Zero(2 * n + 1);
b.head(d).setZero();
cost[2 * n] = -1;

// <variant any_plane> caught by: radius, any-radius
// mistake: the nearest plane through three wrenches, whether it bounds the hull or cuts it.
// ask: Does the nearest plane cut the hull? Only planes that bound it count.
// <solution epsilonOf>
if (!judged(wrenches).closed) return 0;
double least = INFINITY;
for (Eigen::Index i = 0; i < wrenches.cols(); ++i)
  for (Eigen::Index j = 0; j < i; ++j)
    for (Eigen::Index k = 0; k < j; ++k) {
      const Eigen::Vector3d a = wrenches.col(i), b = wrenches.col(j), c = wrenches.col(k);
      const Eigen::Vector3d across = (b - a).cross(c - a);
      if (across.norm() > 1e-9) least = std::min(least, std::abs(across.normalized().dot(a)));
    }
return least;

// <variant calls_the_library> caught by: forbidden-call
// mistake: lets the library measure the quality.
// <solution headers>
#include "grasping/quality.h"
// <solution epsilonOf>
return graspQuality(wrenches).epsilon;

// <variant nearest_corner> caught by: radius, any-radius
// mistake: the distance of the nearest corner of the hull, instead of the nearest face.
// ask: Is it the distance of the nearest corner? A face may be nearer.
// <solution epsilonOf>
return judged(wrenches).closed ? wrenches.colwise().norm().minCoeff() : 0;

// <variant zero_may_be_outside> caught by: radius, any-radius
// mistake: the distance of the nearest face, even if zero is outside of the hull.
// <solution epsilonOf>
const Eigen::Index n = wrenches.cols();
double least = INFINITY;
for (Eigen::Index i = 0; i < n; ++i)
  for (Eigen::Index j = i + 1; j < n; ++j)
    for (Eigen::Index k = j + 1; k < n; ++k) {
      const Eigen::Vector3d a = wrenches.col(i), b = wrenches.col(j), c = wrenches.col(k);
      const Eigen::Vector3d across = (b - a).cross(c - a);
      if (across.norm() < 1e-12) continue;
      const Eigen::VectorXd heights = wrenches.transpose() * across.normalized();
      const double here = across.normalized().dot(a);
      if (heights.maxCoeff() < here + 1e-9 || heights.minCoeff() > here - 1e-9)
        least = std::min(least, std::abs(here));
    }
return least;

// <variant keeps_none> caught by: fewer, fewer-on-solids
// mistake: as it was handed out.
// <solution keptFingers>
return {};

// <variant all_at_once> caught by: fewer, fewer-on-solids
// mistake: finds the fingers that are redundant, and deletes all of them at once.
// ask: Are all fingers deleted at once that are redundant beside all others?
// <solution keptFingers>
const auto without = [&](int removed) {
  Eigen::MatrixXd some(wrenches.rows(), 0);
  for (std::size_t k = 0; k < finger.size(); ++k)
    if (finger[k] != removed) {
      some.conservativeResize(wrenches.rows(), some.cols() + 1);
      some.col(some.cols() - 1) = wrenches.col(static_cast<Eigen::Index>(k));
    }
  return some;
};
std::vector<int> kept;
if (!judged(wrenches).closed) return kept;
for (const int one : finger)
  if ((kept.empty() || kept.back() != one) && !judged(without(one)).closed) kept.push_back(one);
return kept;

// <variant one_wrench_of_each_finger> caught by: fewer, fewer-on-solids
// mistake: judges the first wrench of each finger alone.
// ask: Are all wrenches of each finger judged, or only one of them?
// <solution keptFingers>
// in place of: if (std::find(fingers.begin(), fingers.end(), finger[k]) != fingers.end()) { ... }
if ((k == 0 || finger[k] != finger[k - 1]) &&
    std::find(fingers.begin(), fingers.end(), finger[k]) != fingers.end()) {
  some.conservativeResize(wrenches.rows(), some.cols() + 1);
  some.col(some.cols() - 1) = wrenches.col(static_cast<Eigen::Index>(k));
}

// <variant deletes_until_open> caught by: fewer, fewer-on-solids
// mistake: stops at the first finger that is needed; later ones may be redundant.
// ask: Does the deletion end at the first finger that is needed? Later ones may be redundant.
// <solution keptFingers>
if (!judged(wrenches).closed) return {};
std::vector<int> kept = finger;
kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
Eigen::Index gone = 0;
while (kept.size() > 1) {
  Eigen::Index next = gone;
  while (finger[static_cast<std::size_t>(next)] == kept.front()) ++next;
  if (!judged(wrenches.rightCols(wrenches.cols() - next)).closed) return kept;
  kept.erase(kept.begin());
  gone = next;
}
return kept;

// <variant first_that_close> caught by: fewer, fewer-on-solids
// mistake: adds fingers one after the other until they hold, and does not check that all are needed.
// ask: Are fingers added until they hold? Of those, earlier ones may be redundant.
// <solution keptFingers>
std::vector<int> kept;
Eigen::MatrixXd some(wrenches.rows(), 0);
for (std::size_t k = 0; k < finger.size(); ++k) {
  if (kept.empty() || kept.back() != finger[k]) {
    if (some.cols() > 0 && judged(some).closed) return kept;
    kept.push_back(finger[k]);
  }
  some.conservativeResize(wrenches.rows(), some.cols() + 1);
  some.col(some.cols() - 1) = wrenches.col(static_cast<Eigen::Index>(k));
}
return judged(some).closed ? kept : std::vector<int>();

// <variant fingers_at_corners> caught by: places, any-places
// shown by: places
// mistake: puts fingers onto corners, where there is no normal.
// <solution search>
// in place of: const Eigen::Vector2d side = corners[(i + 1) % ... return {corners[i] + along / size * side,
const Eigen::Vector2d ahead = (corners[(i + 1) % corners.size()] - corners[i]).normalized();
return {corners[i], {-ahead.y(), ahead.x()}, friction};

// <variant normals_outward> caught by: places, any-places
// shown by: places
// mistake: normals point out of the object.
// <solution search>
// in place of: return {corners[i] + along / size * side, {-side.y() / size, side.x() / size}, friction};
return {corners[i] + along / size * side, {side.y() / size, -side.x() / size}, friction};

// <variant any_grasp_that_holds> caught by: any-places
// mistake: takes the first grasp with force closure.
// <solution bestGrasp>
Rng rng(7);
std::vector<PlanarFinger> grasp;
for (int draw = 0; draw < 10000; ++draw) {
  grasp.clear();
  for (int k = 0; k < count; ++k)
    grasp.push_back(fingerAlong(corners, rng.uniform(0, static_cast<double>(corners.size())), friction));
  if (epsilonOf(planarWrenches(grasp, center, length)) > 0) break;
}
return grasp;

// <variant normals_to_the_centre> caught by: any-places
// mistake: takes for the inward normal of an edge the one towards the centre of the object.
// <solution bestGrasp>
const auto n = static_cast<double>(corners.size());
const auto fingersAt = [&](const std::vector<double>& places) {
  std::vector<PlanarFinger> grasp;
  for (const double place : places) {
    PlanarFinger one = fingerAlong(corners, place, friction);
    if (one.normal.dot(center - one.p) < 0) one.normal *= -1;
    grasp.push_back(one);
  }
  return grasp;
};
Rng rng(7);
std::vector<double> best(static_cast<std::size_t>(count), 0.5), other = best;
double quality = -1;
for (int trial = 0; trial < 4000; ++trial) {
  for (std::size_t k = 0; k < other.size(); ++k)
    other[k] = trial % 2 == 0 ? rng.uniform(0, n) : best[k] + 0.1 * rng.normal();
  const double then = epsilonOf(planarWrenches(fingersAt(other), center, length));
  if (then > quality) best = other;
  quality = std::max(quality, then);
}
return fingersAt(best);
