#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "geometry/facet_hull.h"
#include "grading/check.h"
#include "grading/evidence_parts.h"
#include "grasping/closure.h"
#include "grasping/quality.h"
#include "interface.h"
#include "objects.h"

// What the checks require of contacts, verdicts and quality.

inline std::string text(double value) {
  std::string digits = std::to_string(value);
  digits.erase(digits.find_last_not_of('0') + 1);
  return digits.back() == '.' ? digits + '0' : digits;
}

/// The wrenches of the library for the same fingers.
inline Eigen::MatrixXd wrenchesOf(const std::vector<PlanarFinger>& fingers, const Eigen::Vector2d& center,
                                  double length) {
  std::vector<rex::PlanarContact> contacts;
  for (const PlanarFinger& one : fingers) contacts.push_back({one.p, one.normal, one.friction});
  const auto cones = rex::wrenchCones(contacts, {.p_OR = {center.x(), center.y(), 0}, .length = length});
  return rex::primitiveWrenches(cones).wrenches;
}

inline rex::WrenchSet wrenchesOf(const std::vector<Finger>& fingers, int edges, const Eigen::Vector3d& center,
                                 double length) {
  std::vector<rex::Contact> contacts;
  for (const Finger& finger : fingers) contacts.push_back({finger.p, finger.normal, finger.friction});
  return rex::primitiveWrenches(rex::wrenchCones(contacts, {.p_OR = center, .length = length}), edges);
}

/// The torque about the centre is the power of the force if the object turns about it at one radian per
/// second: force times velocity of p.
inline void planarWrenchFits(rex::grading::Check& check, Student& student, const Eigen::Vector2d& p,
                             const Eigen::Vector2d& force, const Eigen::Vector2d& center, double length) {
  check.input("p = (" + text(p.x()) + ", " + text(p.y()) + "), force (" + text(force.x()) + ", " +
              text(force.y()) + "), center (" + text(center.x()) + ", " + text(center.y()) + "), length " +
              text(length));
  const Eigen::Vector3d wrench = student.planarWrench(p, force, center, length);
  check.shape("planar wrench", wrench, 3, 1);
  check.near("force of a planar wrench", wrench.head<2>(), force, 1e-12, "N");
  const Eigen::Vector2d velocity(center.y() - p.y(), p.x() - center.x());
  const double torque = velocity.dot(force) / length;
  check.near("torque / length of a planar wrench", wrench[2], torque, 1e-10 * (1 + std::abs(torque)), "N");
}

inline void spatialWrenchFits(rex::grading::Check& check, Student& student, rex::Rng& rng) {
  const Eigen::Vector3d p = rng.normalVector(3), force = rng.normalVector(3), center = rng.normalVector(3);
  const double length = rng.uniform(0.1, 2);
  check.input("random p, force and center, length " + text(length));
  const Eigen::VectorXd wrench = student.spatialWrench(p, force, center, length);
  check.shape("spatial wrench", wrench, 6, 1);
  check.near("force of a spatial wrench", wrench.head(3), force, 1e-12, "N");
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d velocity = Eigen::Vector3d::Unit(axis).cross(p - center);
    check.near("torque / length of a spatial wrench", wrench[3 + axis], velocity.dot(force) / length, 1e-9,
               "N");
  }
}

/// The forces along the edges of a pyramid, seen along the normal, with the circle on which they should lie.
inline rex::grading::Evidence edgesSeen(const Finger& finger, const Eigen::MatrixXd& forces) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const Eigen::Matrix3d R = Eigen::Quaterniond::FromTwoVectors(finger.normal, up).toRotationMatrix();
  rex::Series circle = rex::grading::wantedCurve("rim of the cone"), edges = rex::grading::gotCurve("yours");
  for (int i = 0; i <= 96; ++i) {
    const double angle = 2 * std::numbers::pi * i / 96;
    circle.x.push_back(finger.friction * std::cos(angle));
    circle.y.push_back(finger.friction * std::sin(angle));
  }
  edges = rex::grading::through(Eigen::MatrixXd(R * forces).colwise(), edges);
  edges.style = rex::SeriesStyle::kPoints;
  edges.marker = rex::Marker::kDot;
  edges.size = 2;
  return {.figures = {{.title = "Edges of a pyramid, seen along the normal",
                       .xLabel = "along the surface [N]",
                       .yLabel = "along the surface [N]",
                       .equalAxes = true,
                       .legend = rex::Legend::kOutside,
                       .series = {edges, circle}}},
          .film = {}};
}

/// The columns are forces of one newton along the normal, on the cone, at equal angles: that many points on
/// a circle form a regular polygon if no two of them are nearer than in one.
inline void areEdges(rex::grading::Check& check, const Finger& finger, const Eigen::MatrixXd& forces,
                     int edges) {
  check.shape("edges of a pyramid", forces, 3, edges);
  const auto shown = check.show([&] { return edgesSeen(finger, forces); });
  for (Eigen::Index k = 0; k < edges; ++k) {
    const double along = finger.normal.dot(forces.col(k));
    check.near("normal component of an edge", along, 1, 1e-9, "N");
    check.near("component of an edge along the surface", (forces.col(k) - along * finger.normal).norm(),
               finger.friction, 1e-9, "N");
  }
  const double side = 2 * finger.friction * std::sin(std::numbers::pi / edges);
  for (Eigen::Index k = 0; k < edges; ++k)
    for (Eigen::Index i = 0; i < k; ++i)
      check.atLeast("distance of two edges, minus that of neighbours",
                    (forces.col(k) - forces.col(i)).norm() - side, -1e-8, "N");
}

/// Forces one per cent inside and outside of the cone, a pulling force, and none at all; shuffled, so that
/// counting calls does not help.
inline void coneFits(rex::grading::Check& check, Student& student, rex::Rng& rng) {
  const Finger finger = randomFinger(rng, rng.uniform(0.3, 1.3)), smooth{finger.p, finger.normal, 0};
  const Eigen::Vector3d any = randomDirection(rng, 3), across = finger.normal.cross(any).normalized();
  const auto force = [&](double angle) {
    return Eigen::Vector3d(rng.uniform(0.1, 30) *
                           (std::cos(angle) * finger.normal + std::sin(angle) * across));
  };
  const double limit = std::atan(finger.friction);
  const std::string friction = "friction " + text(finger.friction);
  struct Question {
    std::string input, property;
    Finger finger;
    Eigen::Vector3d force;
    bool isInside;
  };
  std::vector<Question> questions{
      {friction + ", a force at 0.99 times the angle of the cone", "a force within the cone can be exerted",
       finger, force(0.99 * limit), true},
      {friction + ", a force at 1.01 times the angle of the cone",
       "a force outside the cone cannot be exerted", finger, force(1.01 * limit), false},
      {friction + ", a force that pulls", "a finger cannot pull", finger, -force(rng.uniform(0, 0.5 * limit)),
       false},
      {friction + ", no force", "a finger can let go", finger, Eigen::Vector3d::Zero(), true},
      {"no friction", "a smooth finger pushes along its normal", smooth, force(0), true},
      {"no friction", "a smooth finger pushes along its normal only", smooth, force(0.01), false}};
  for (std::size_t k = questions.size(); k > 0; --k) {
    std::swap(questions[k - 1], questions[static_cast<std::size_t>(rng.index(static_cast<int>(k)))]);
    const Question& one = questions[k - 1];
    check.input(one.input);
    check.that(one.property, student.inCone(one.finger, one.force) == one.isInside);
  }
}

/// Checks that the proof holds, whatever the verdict is.
inline void isProven(rex::grading::Check& check, const Eigen::MatrixXd& W, const Verdict& verdict) {
  const Eigen::VectorXd sizes = W.colwise().norm().transpose();
  if (!verdict.closed) {
    check.shape("direction that proves an open grasp", verdict.proof, W.rows(), 1);
    check.near("length of the direction that proves an open grasp", verdict.proof.norm(), 1, 1e-9);
    check.atLeast("smallest component of a wrench along the direction that proves an open grasp",
                  (W.transpose() * verdict.proof).cwiseQuotient(sizes).minCoeff(), -1e-8);
    return;
  }
  check.shape("weights that prove force closure", verdict.proof, W.cols(), 1);
  check.near("sum of the weights that prove force closure", verdict.proof.sum(), 1, 1e-9);
  check.atLeast("smallest weight that proves force closure", verdict.proof.minCoeff(), 1e-6);
  check.atMost("weighted sum of the wrenches, relative to the longest",
               (W * verdict.proof).norm() / sizes.maxCoeff(), 1e-8);
  check.that("wrenches with force closure span the space", rex::forceClosure(W).rank == W.rows());
}

inline void judgedRightly(rex::grading::Check& check, Student& student, const Eigen::MatrixXd& W) {
  isProven(check, W, student.judged(W));
}

/// Whether W is not near the border between open and closed.
inline bool isClear(const Eigen::MatrixXd& W) {
  const rex::Closure closure = rex::forceClosure(W);
  if (closure.status == rex::ClosureStatus::kUndecided) return false;
  if (closure.status == rex::ClosureStatus::kClosed) return closure.weights.minCoeff() > 1e-4;
  const Eigen::VectorXd sizes = W.colwise().norm().transpose();
  return closure.rank < W.rows() ||
         (W.transpose() * closure.direction).cwiseQuotient(sizes).minCoeff() > 1e-3;
}

/// Random wrenches with force closure: zero is well within their hull.
inline Eigen::MatrixXd closedWrenches(rex::Rng& rng, int d, int count) {
  for (;;) {
    Eigen::MatrixXd W(d, count);
    for (Eigen::Index k = 0; k < count; ++k) W.col(k) = rng.uniform(0.5, 2) * randomDirection(rng, d);
    if (rex::graspQuality(W).epsilon > 0.01) return W;
  }
}

/// Facet by facet: the first plane of the hull that the ray meets.
inline double reachOf(const rex::FacetHull& hull, const Eigen::VectorXd& direction) {
  double reach = INFINITY;
  for (Eigen::Index f = 0; f < hull.offsets.size(); ++f)
    if (const double rise = hull.normals.col(f).dot(direction); rise > 1e-12)
      reach = std::min(reach, hull.offsets[f] / rise);
  return reach;
}

/// The hull of wrenches with two entries, and how far it reaches.
inline rex::grading::Evidence reachSeen(const Eigen::MatrixXd& W, const Eigen::VectorXd& direction,
                                        double got, double wanted) {
  const rex::FacetHull hull = rex::facetHull(W);
  rex::Region inside{.label = "hull of the wrenches"};
  for (int i = 0; i < 720; ++i) {
    const double angle = std::numbers::pi * i / 360;
    const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
    inside.x.push_back(reachOf(hull, ray) * ray.x());
    inside.y.push_back(reachOf(hull, ray) * ray.y());
  }
  const Eigen::Vector2d far = std::clamp(got, -5 * wanted, 5 * wanted) * direction,
                        right = wanted * direction;
  rex::Series arrow = rex::grading::gotCurve("s * direction, yours", {0, far.x()}, {0, far.y()});
  rex::Series line = rex::grading::wantedCurve("wanted", {0, right.x()}, {0, right.y()});
  for (rex::Series* series : {&arrow, &line}) series->style = rex::SeriesStyle::kLinesPoints;
  return {.figures = {{.title = "How far the hull reaches",
                       .xLabel = "first entry of a wrench [N]",
                       .yLabel = "second entry [N]",
                       .equalAxes = true,
                       .legend = rex::Legend::kOutside,
                       .series = {arrow, line},
                       .regions = {inside}}},
          .film = {}};
}

inline void reachIs(rex::grading::Check& check, Student& student, const Eigen::MatrixXd& W,
                    const Eigen::VectorXd& direction, double wanted) {
  const double got = student.reachAlong(W, direction);
  if (W.rows() != 2) return check.near("how far the hull reaches", got, wanted, 1e-6, "N");
  const auto shown = check.show([&] { return reachSeen(W, direction, got, wanted); });
  check.near("how far the hull reaches", got, wanted, 1e-6, "N");
}

inline void reachFits(rex::grading::Check& check, Student& student, const Eigen::MatrixXd& W,
                      const Eigen::VectorXd& direction) {
  reachIs(check, student, W, direction, reachOf(rex::facetHull(W), direction));
}

inline void radiusFits(rex::grading::Check& check, Student& student, const Eigen::MatrixXd& W) {
  check.near("radius of the ball", student.epsilonOf(W), rex::graspQuality(W).epsilon,
             1e-6 * W.colwise().norm().maxCoeff(), "N");
}

/// The wrenches of those fingers.
inline Eigen::MatrixXd partOf(const Eigen::MatrixXd& W, const std::vector<int>& finger,
                              const std::vector<int>& kept) {
  std::vector<Eigen::Index> columns;
  for (std::size_t at = 0; at < finger.size(); ++at)
    if (std::ranges::count(kept, finger[at]) > 0) columns.push_back(static_cast<Eigen::Index>(at));
  return W(Eigen::all, columns);
}

/// Closed, and provable with weights that are large enough for a Verdict.
inline bool isProvablyClosed(const Eigen::MatrixXd& W) {
  const rex::Closure closure = rex::forceClosure(W);
  return closure.status == rex::ClosureStatus::kClosed && closure.weights.minCoeff() > 1e-5;
}

/// The fingers kept have force closure, and none of them is redundant.
inline void keepsTheNeeded(rex::grading::Check& check, Student& student, const Eigen::MatrixXd& W,
                           const std::vector<int>& finger) {
  const std::vector<int> kept = student.keptFingers(W, finger);
  check.that("fingers are in ascending order, each once",
             std::ranges::adjacent_find(kept, std::greater_equal<>()) == kept.end());
  check.that("fingers kept are among those given",
             std::ranges::all_of(kept, [&](int one) { return std::ranges::count(finger, one) > 0; }));
  using enum rex::ClosureStatus;
  if (rex::forceClosure(W).status == kOpen || (kept.empty() && !isProvablyClosed(W)))
    return check.that("no finger of an open grasp is kept", kept.empty());
  check.that("the fingers kept have force closure",
             rex::forceClosure(partOf(W, finger, kept)).status != kOpen);
  for (const int one : kept) {
    std::vector<int> others = kept;
    std::erase(others, one);
    check.that("each finger kept is needed", !isProvablyClosed(partOf(W, finger, others)));
  }
}
