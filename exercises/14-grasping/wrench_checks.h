#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "geometry/facet_hull.h"
#include "grading/check.h"
#include "grading/evidence.h"
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

inline void torqueIs(rex::grading::Check& check, const std::string& function, const Eigen::MatrixXd& got,
                     const Eigen::MatrixXd& wanted) {
  check.near("torque / length of " + function, got, wanted, 1e-10 * (1 + wanted.cwiseAbs().maxCoeff()), "N");
}

/// The torque about the centre is the power of the force if the object turns about it at one radian per
/// second: force times velocity of p.
inline void planarWrenchFits(rex::grading::Check& check, Student& student, const Eigen::Vector2d& p,
                             const Eigen::Vector2d& force, const Eigen::Vector2d& center, double length) {
  check.input("a force in the plane", {{"p", p}, {"force", force}, {"center", center}, {"length", length}});
  const Eigen::Vector3d wrench = student.planarWrench(p, force, center, length);
  check.shape("planarWrench", wrench, 3, 1);
  check.near("force of planarWrench", wrench.head<2>(), force, 1e-12, "N");
  const Eigen::Vector2d velocity(center.y() - p.y(), p.x() - center.x());
  const Eigen::MatrixXd torque = Eigen::MatrixXd::Constant(1, 1, velocity.dot(force) / length);
  torqueIs(check, "planarWrench", wrench.tail<1>(), torque);
}

inline void spatialWrenchFits(rex::grading::Check& check, Student& student, rex::Rng& rng) {
  const Eigen::Vector3d p = rng.normalVector(3), force = rng.normalVector(3), center = rng.normalVector(3);
  const double length = rng.uniform(0.1, 2);
  check.input("a force in space", {{"p", p}, {"force", force}, {"center", center}, {"length", length}});
  const Eigen::VectorXd wrench = student.spatialWrench(p, force, center, length);
  check.shape("spatialWrench", wrench, 6, 1);
  check.near("force of spatialWrench", wrench.head(3), force, 1e-12, "N");
  Eigen::Vector3d torque;
  for (int axis = 0; axis < 3; ++axis)
    torque[axis] = Eigen::Vector3d::Unit(axis).cross(p - center).dot(force) / length;
  torqueIs(check, "spatialWrench", wrench.tail(3), torque);
}

/// The forces along the edges of a pyramid, seen along the normal, with the circle on which they should lie.
inline rex::grading::Evidence edgesSeen(const Finger& finger, const Eigen::MatrixXd& forces) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const Eigen::Matrix3d R = Eigen::Quaterniond::FromTwoVectors(finger.normal, up).toRotationMatrix();
  rex::Series circle = rex::grading::wantedCurve("rim of the cone"), edges = rex::grading::gotCurve("yours");
  for (int i = 0; i <= 96; ++i) {
    const double angle = 2 * std::numbers::pi * i / 96;
    circle.add(finger.friction * std::cos(angle), finger.friction * std::sin(angle));
  }
  edges = rex::dots(Eigen::MatrixXd(R * forces), edges);
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
                     int edges, const std::string& function = "pyramidEdges") {
  const double mu = finger.friction;
  const auto parallel = check.ask(
      "From which axis do you take a direction along the surface? Here it may be parallel to the normal.",
      finger.normal.cwiseAbs().maxCoeff() == 1);
  check.shape(function, forces, 3, edges);
  // Edges begin anywhere on the circle, so that no single answer shows a mistake.
  const auto number = [](double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
  const auto units =
      check.suspect("Are the edges unit vectors? Their normal components should be one newton.",
                    number(std::cos(std::atan(mu))));
  for (Eigen::Index k = 0; k < edges; ++k)
    check.near("normal component of an edge of " + function, finger.normal.dot(forces.col(k)), 1, 1e-9, "N");
  const auto shown = check.show([&] { return edgesSeen(finger, forces); });
  const auto angle = check.suspect("Is the friction taken for an angle? It is the tangent of that angle.",
                                   number(std::tan(mu)));
  const auto around =
      check.suspect("Is the pyramid around the cone? It should be inside, with its edges on the cone.",
                    number(mu / std::cos(std::numbers::pi / edges)));
  for (const Eigen::Vector3d force : forces.colwise())
    check.near("component along the surface, of an edge of " + function,
               (force - force.dot(finger.normal) * finger.normal).norm(), mu, 1e-9, "N");
  double nearest = 2 * mu;
  for (Eigen::Index k = 0; k < edges; ++k)
    for (Eigen::Index i = 0; i < k; ++i) nearest = std::min(nearest, (forces.col(k) - forces.col(i)).norm());
  const auto same = check.ask("Are all edges the same? With integers, k / edges is 0.",
                              (forces.colwise() - forces.col(0)).cwiseAbs().maxCoeff() < 1e-9);
  check.atLeast("distance of the two nearest edges of " + function, nearest,
                2 * mu * std::sin(std::numbers::pi / edges) - 1e-8, "N");
}

/// Forces one per cent inside and outside of the cone, a pulling force, and none at all; shuffled, so that
/// counting calls does not help, but for a tiny force: it comes after those whose size is not to blame.
inline void coneFits(rex::grading::Check& check, Student& student, rex::Rng& rng) {
  const Finger finger = randomFinger(rng, rng.uniform(0.3, 1.3)), smooth{finger.p, finger.normal, 0};
  const Eigen::Vector3d any = randomDirection(rng, 3), across = finger.normal.cross(any).normalized();
  const auto force = [&](double angle) {
    return Eigen::Vector3d(rng.uniform(0.1, 30) *
                           (std::cos(angle) * finger.normal + std::sin(angle) * across));
  };
  const double limit = std::atan(finger.friction);
  struct Question {
    std::string input, property;
    Finger finger;
    Eigen::Vector3d force;
    bool isInside;
  };
  std::vector<Question> questions{
      {"a force at 0.99 times the angle of the cone", "inCone() is true for a force within the cone", finger,
       force(0.99 * limit), true},
      {"a force at 1.01 times the angle of the cone", "inCone() is false for a force outside of the cone",
       finger, force(1.01 * limit), false},
      {"a force that pulls", "inCone() is false for a force that pulls", finger,
       -force(rng.uniform(0, 0.5 * limit)), false},
      {"no force", "inCone() is true for no force", finger, Eigen::Vector3d::Zero(), true},
      {"no friction, along the normal", "inCone() is true for a smooth finger that pushes along its normal",
       smooth, force(0), true},
      {"no friction, 0.01 rad from the normal", "inCone() is false for a smooth finger that pushes aside",
       smooth, force(0.01), false}};
  for (std::size_t k = questions.size(); k > 0; --k)
    std::swap(questions[k - 1], questions[static_cast<std::size_t>(rng.index(static_cast<int>(k)))]);
  questions.push_back({"a tiny force at 1.01 times the angle of the cone",
                       "inCone() is false for a tiny force outside of the cone", finger,
                       1e-9 * force(1.01 * limit), false});
  for (const Question& one : questions) {
    const auto exact = check.ask(
        "Is there room for rounding? A force along the normal may have a part of 1e-17 N along the surface.",
        one.isInside && one.finger.friction == 0);
    check.input(one.input,
                {{"friction", one.finger.friction}, {"normal", one.finger.normal}, {"force", one.force}});
    check.that(one.property, student.inCone(one.finger, one.force) == one.isInside);
  }
}

/// Checks that the verdict is right, and that its proof holds.
inline void judgedRightly(rex::grading::Check& check, Student& student, const Eigen::MatrixXd& W) {
  const Verdict verdict = student.judged(W);
  const Eigen::VectorXd sizes = W.colwise().norm().transpose(), &proof = verdict.proof;
  const rex::Closure closure = rex::forceClosure(W);
  const bool weighs = verdict.closed && proof.size() == W.cols() && proof.allFinite() &&
                      proof.minCoeff() > -1e-8 && (W * proof).norm() <= 1e-8 * sizes.maxCoeff();
  {
    const auto flat = check.ask("Do the wrenches span the space? Weights alone do not prove that.",
                                weighs && closure.rank < W.rows());
    const auto zero = check.ask("Are some of your weights zero? All have to be positive.",
                                weighs && closure.rank == W.rows());
    const auto spans = check.ask(
        "The weighted sum of the wrenches is not zero, or a weight is negative: is it "
        "enough for you that the wrenches span the space?",
        verdict.closed && !weighs && closure.rank == W.rows());
    if (closure.status == rex::ClosureStatus::kOpen)
      check.that("judged() finds that these wrenches have no force closure", !verdict.closed);
  }
  if (closure.status == rex::ClosureStatus::kClosed)
    check.that("judged() finds that these wrenches have force closure", verdict.closed);
  if (!verdict.closed) {
    check.shape("direction u of judged", proof, W.rows(), 1);
    check.near("length of the direction u of judged", proof.norm(), 1, 1e-9);
    const Eigen::VectorXd along = (W.transpose() * proof).cwiseQuotient(sizes);
    const auto turned = check.ask("Does u have the wrong sign?", along.maxCoeff() <= 1e-8);
    check.atLeast("smallest u.w of judged, for unit wrenches w", along.minCoeff(), -1e-8);
    return;
  }
  check.shape("weights of judged", proof, W.cols(), 1);
  check.near("sum of the weights of judged", proof.sum(), 1, 1e-9);
  check.atLeast("smallest weight of judged", proof.minCoeff(), 1e-6);
  check.near("weighted sum of the wrenches, with the weights of judged", W * proof,
             Eigen::VectorXd::Zero(W.rows()), 1e-8 * sizes.maxCoeff());
  check.that("wrenches with force closure span the space", closure.rank == W.rows());
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
    inside.add(reachOf(hull, ray) * ray.x(), reachOf(hull, ray) * ray.y());
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

inline void reachIs(rex::grading::Check& check, Student& student, const std::string& name,
                    const Eigen::MatrixXd& W, const Eigen::VectorXd& direction, double wanted) {
  check.input(name, {{"wrenches", W}, {"direction", direction}});
  const double got = student.reachAlong(W, direction);
  if (W.rows() != 2) return check.near("reachAlong", got, wanted, 1e-6, "N");
  const auto shown = check.show([&] { return reachSeen(W, direction, got, wanted); });
  check.near("reachAlong", got, wanted, 1e-6, "N");
}

inline void reachFits(rex::grading::Check& check, Student& student, const std::string& name,
                      const Eigen::MatrixXd& W, const Eigen::VectorXd& direction) {
  reachIs(check, student, name, W, direction, reachOf(rex::facetHull(W), direction));
}

inline void radiusIs(rex::grading::Check& check, Student& student, const std::string& name,
                     const Eigen::MatrixXd& W, double wanted) {
  check.input(name, {{"wrenches", W}});
  const double got = student.epsilonOf(W);
  const auto outside =
      check.ask("Is zero inside the hull? Without force closure the radius is 0.", wanted == 0);
  check.near("epsilonOf", got, wanted, 1e-6 * W.colwise().norm().maxCoeff(), "N");
}

inline void radiusFits(rex::grading::Check& check, Student& student, const std::string& name,
                       const Eigen::MatrixXd& W) {
  radiusIs(check, student, name, W, rex::graspQuality(W).epsilon);
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
inline void keepsTheNeeded(rex::grading::Check& check, Student& student, const std::string& name,
                           const Eigen::MatrixXd& W, const std::vector<int>& finger) {
  check.input(name, {{"wrenches", W}});
  const std::vector<int> kept = student.keptFingers(W, finger);
  std::string list;
  for (const int one : kept) list += (list.empty() ? "" : ", ") + std::to_string(one);
  check.input(check.input() + "; fingers kept: " + (list.empty() ? "none" : list));
  check.that("fingers of keptFingers() are in ascending order, each once",
             std::ranges::adjacent_find(kept, std::greater_equal<>()) == kept.end());
  check.that("fingers of keptFingers() are among those given",
             std::ranges::all_of(kept, [&](int one) { return std::ranges::count(finger, one) > 0; }));
  using enum rex::ClosureStatus;
  if (rex::forceClosure(W).status == kOpen || (kept.empty() && !isProvablyClosed(W)))
    return check.that("keptFingers() is empty if all fingers have no force closure", kept.empty());
  const auto without = [&](std::vector<int> fingers, int removed) {
    std::erase(fingers, removed);
    return partOf(W, finger, fingers);
  };
  const bool holds = rex::forceClosure(partOf(W, finger, kept)).status != kOpen;
  const bool haveSeveral = std::ranges::adjacent_find(finger) != finger.end();
  {
    const auto columns =
        check.ask("Nothing was found to hold: are all wrenches of each finger judged, or only one of them?",
                  kept.empty() && haveSeveral);
    check.that("the fingers of keptFingers() have force closure", holds);
  }
  for (const int one : kept)
    check.that("finger " + std::to_string(one) + " of keptFingers() is needed",
               !isProvablyClosed(without(kept, one)));
}
