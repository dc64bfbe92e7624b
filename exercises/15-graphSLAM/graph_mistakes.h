#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "base/derivative_check.h"
#include "grading/check.h"
#include "graph_checks.h"

// What the checks of graphs ask about if a usual mistake explains a wrong value.

/// b - a with the opposite rotation, or none at all.
inline Eigen::Vector3d turnedWrongly(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double factor) {
  const double c = std::cos(factor * a[2]), s = std::sin(factor * a[2]), x = b[0] - a[0], y = b[1] - a[1];
  return {c * x + s * y, c * y - s * x, byTurns(b[2] - a[2])};
}

inline void wrapsAngle(rex::grading::Check& check, double got, double angle) {
  const double wanted = byTurns(angle), turn = 2 * std::numbers::pi;
  check.input("an angle", {{"angle", angle}});
  check.near("angle of wrapped", got, wanted, 1e-9,
             {{"Is one turn at most taken off, or added? The angle may be off by several.",
               angle > 0 ? angle - turn : angle + turn},
              {"Is the angle between 0 and a whole turn? Wanted is one between -pi and pi.",
               wanted < 0 ? wanted + turn : wanted},
              {"Is the angle wrapped to half turns?", std::remainder(angle, turn / 2)}},
             "rad");
}

inline void seesFrom(rex::grading::Check& check, const Eigen::Vector3d& got, const Eigen::Vector3d& a,
                     const Eigen::Vector3d& b) {
  check.input("two poses", {{"a", a}, {"b", b}});
  const Eigen::Vector3d wanted = relative(a, b);
  const double turns = 2 * std::numbers::pi * std::round((got[2] - wanted[2]) / (2 * std::numbers::pi));
  check.near("pose of seenFrom", got, wanted, 1e-9,
             {{"Is the heading not wrapped?", wanted + Eigen::Vector3d(0, 0, turns)},
              {"Is the way from a to b rotated the wrong way?", turnedWrongly(a, b, -1)},
              {"Is the way from a to b left in the axes of the world?", turnedWrongly(a, b, 0)},
              {"Is it a as seen from b?", relative(b, a)},
              {"Is it the pose that, seen from a, is b?", onward(a, b)}},
             "m, rad");
}

inline void errs(rex::grading::Check& check, const Eigen::Vector3d& got, const Eigen::Vector3d& i,
                 const Eigen::Vector3d& j, const Eigen::Vector3d& z, const Eigen::Vector3d& wanted) {
  check.input("an edge", {{"i", i}, {"j", j}, {"z", z}});
  const Eigen::Vector3d seen = relative(i, j);
  const double turns = 2 * std::numbers::pi * std::round((got[2] - wanted[2]) / (2 * std::numbers::pi));
  check.near("error of edgeError", got, wanted, 1e-9,
             {{"Is the heading not wrapped?", wanted + Eigen::Vector3d(0, 0, turns)},
              {"Is it z as seen from j, in place of j as seen from z?", relative(seen, z)},
              {"Is z forgotten?", seen},
              {"Is i seen from j? z is that of j as seen from i.", relative(z, relative(j, i))}},
             "m, rad");
}

inline void derivativesFit(rex::grading::Check& check, const EdgeJacobians& got, const Eigen::MatrixXd& byI,
                           const Eigen::MatrixXd& byJ, const Eigen::Vector3d& i, const Eigen::Vector3d& z) {
  const auto turnedBack = [&](const Eigen::MatrixXd& J, double angle) -> Eigen::MatrixXd {
    Eigen::MatrixXd R = Eigen::MatrixXd::Identity(3, 3);
    R.topLeftCorner(2, 2) << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    return R * J;
  };
  Eigen::MatrixXd opposite = byI, still = byI;
  opposite.col(2).head(2) *= -1;
  still.col(2).head(2).setZero();
  const auto jumps =
      check.ask("Is the difference of two headings not wrapped? It may jump by a whole turn.",
                std::max(got.byI.row(2).cwiseAbs().maxCoeff(), got.byJ.row(2).cwiseAbs().maxCoeff()) > 100);
  const char* ofJ =
      "Does it have the sign of the derivative by pose i? Where j moves, the error moves along.";
  const char* ofZ = "Is z left out of the rotation? The error is in the axes of where z puts j.";
  check.near("byI of edgeJacobians", got.byI, byI, 1e-5,
             {{"Does the heading of pose i move nothing but the heading? Pose j goes around it.", still},
              {"Does the derivative by the heading of pose i have the wrong sign?", opposite},
              {"Are byI and byJ exchanged?", byJ},
              {ofZ, turnedBack(byI, z[2])},
              {"Is the heading of pose i left out of the rotation?", turnedBack(byI, i[2])}});
  check.near("byJ of edgeJacobians", got.byJ, byJ, 1e-5,
             {{ofJ, -byJ},
              {"Are byI and byJ exchanged?", byI},
              {ofZ, turnedBack(byJ, z[2])},
              {"Is the heading of pose i left out of the rotation?", turnedBack(byJ, i[2])}});
}

/// The same map with edges that all have the unit matrix as information, or only its diagonal.
inline PoseMap withInformation(PoseMap map, bool isDiagonal) {
  for (MeasuredEdge& edge : map.edges) {
    const Eigen::Matrix3d full = edge.information;
    edge.information.setIdentity();
    if (isDiagonal) edge.information.diagonal() = full.diagonal();
  }
  return map;
}

inline void describe(rex::grading::Check& check, const PoseMap& map, const std::vector<double>& weights) {
  const auto count = static_cast<Eigen::Index>(map.edges.size());
  Eigen::MatrixXd poses(3, static_cast<Eigen::Index>(map.poses.size())), ends(2, count), motions(3, count),
      informations(3, 3 * count), given(1, count);
  for (std::size_t k = 0; k < map.poses.size(); ++k) poses.col(static_cast<Eigen::Index>(k)) = map.poses[k];
  for (Eigen::Index k = 0; k < count; ++k) {
    const MeasuredEdge& edge = map.edges[static_cast<std::size_t>(k)];
    ends.col(k) << edge.from, edge.to;
    motions.col(k) = edge.motion;
    informations.middleCols(3 * k, 3) = edge.information;
    given(0, k) = weights.empty() ? 1 : weights[static_cast<std::size_t>(k)];
  }
  check.input("a random map, one column for each pose or edge", {{"poses", poses},
                                                                 {"from and to", ends},
                                                                 {"motions", motions},
                                                                 {"informations", informations},
                                                                 {"weights", given}});
}

inline void costFits(rex::grading::Check& check, double got, const PoseMap& map) {
  describe(check, map, {});
  const double wanted = trueCost(map);
  double roots = 0;
  for (const MeasuredEdge& edge : map.edges) roots += std::sqrt(trueCost({map.poses, {edge}}));
  check.near("cost of mapCost", got, wanted, 1e-9 * wanted,
             {{"Is only the diagonal of the information used?", trueCost(withInformation(map, true))},
              {"Is it the root of the cost?", std::sqrt(wanted)},
              {"Are roots of e^T Omega e added up?", roots}});
}

/// H and b of a map, by finite differences.
struct Equations {
  Eigen::MatrixXd H;
  Eigen::VectorXd b;
};

inline Equations equationsOf(const PoseMap& map, const std::vector<double>& weights) {
  const Eigen::VectorXd x = numbersOf(map.poses), r = weightedErrors(map, weights, x);
  const Eigen::MatrixXd J =
      rex::numericJacobian([&](const Eigen::VectorXd& at) { return weightedErrors(map, weights, at); }, x);
  return {J.transpose() * J, J.transpose() * r};
}

inline void equationsFit(rex::grading::Check& check, const Eigen::MatrixXd& H, const Eigen::VectorXd& b,
                         const PoseMap& map, const std::vector<double>& weights) {
  const Equations wanted = equationsOf(map, weights),
                  alike = equationsOf(map, std::vector<double>(weights.size(), 1)),
                  plain = equationsOf(withInformation(map, false), weights);
  Eigen::MatrixXd apart = wanted.H, upper = wanted.H, lower = wanted.H, held = wanted.H;
  for (Eigen::Index row = 0; row < apart.rows(); ++row)
    for (Eigen::Index col = 0; col < apart.cols(); ++col) {
      if (row / 3 != col / 3) apart(row, col) = 0;
      if (row > col) upper(row, col) = 0;
      if (row < col) lower(row, col) = 0;
      if (row < 3 || col < 3) held(row, col) = 0;
    }
  const Eigen::MatrixXd mirrored = 2 * apart - wanted.H;
  const auto shown = check.show([&]() -> rex::grading::Evidence {
    return {.figures = {rex::grading::comparison("H, the rows that differ most", H, wanted.H)}};
  });
  const char *ofWeights = "Are the weights of the edges left out?",
             *ofInformation = "Is the information of the edges left out?";
  check.near("H of normalEquations", H, wanted.H, 1e-5 * wanted.H.norm(),
             {{ofInformation, plain.H},
              {ofWeights, alike.H},
              {"Have the blocks between the two poses of an edge the wrong sign?", mirrored},
              {"Does H lack the half below its diagonal?", upper},
              {"Does H lack the half above its diagonal?", lower},
              {"Is pose 0 already taken out? H is that of all poses.", held}});
  const auto right = check.show(
      [&]() -> rex::grading::Evidence { return {.figures = {rex::grading::comparison("b", b, wanted.b)}}; });
  check.near("b of normalEquations", b, wanted.b, 1e-5 * wanted.b.norm(),
             {{ofInformation, plain.b}, {ofWeights, alike.b}});
}

/// The step by a dense solver, with pose 0 held.
inline Eigen::VectorXd denseStep(const Equations& equations, double damping, bool isScaled = false) {
  const Eigen::Index n = equations.b.size() - 3;
  Eigen::MatrixXd H = equations.H.bottomRightCorner(n, n);
  for (Eigen::Index k = 0; k < n; ++k) H(k, k) += isScaled ? damping * H(k, k) : damping;
  const Eigen::VectorXd right = -equations.b.tail(n);
  Eigen::VectorXd step = Eigen::VectorXd::Zero(n + 3);
  step.tail(n) = rex::solve(H, right);
  return step;
}

inline void checkStep(rex::grading::Check& check, const Eigen::VectorXd& got, const PoseMap& map,
                      const std::vector<double>& weights, double damping) {
  const Equations equations = equationsOf(map, weights);
  const Eigen::Index n = equations.b.size() - 3;
  const Eigen::VectorXd wanted = denseStep(equations, damping);
  const auto others = [&](const Eigen::VectorXd& step) -> Eigen::MatrixXd { return step.tail(n); };
  check.near("step of pose 0 by gaussNewtonStep", got.head(3), Eigen::Vector3d::Zero(), 1e-9);
  check.near("step of the other poses by gaussNewtonStep", others(got), others(wanted),
             1e-5 * (1 + wanted.norm()),
             {{"Is the damping left out?", others(denseStep(equations, 0))},
              {"Is the diagonal of H multiplied? The damping is added to it.",
               others(denseStep(equations, damping, true))},
              {"Is the damping added twice?", others(denseStep(equations, 2 * damping))}});
}

/// What could have led to poses that cost too much, if anything.
inline std::string questionAboutPoses(const PoseMap& map, const Adjusted& got, double end, double least) {
  if (end <= least * (1 + 1e-6) + 1e-12) return "";
  const Poses start = map.poses;
  Eigen::VectorXd moved = numbersOf(got.poses) - numbersOf(start);
  for (Eigen::Index k = 2; k < moved.size(); k += 3) moved[k] = byTurns(moved[k]);
  if (moved.norm() < 1e-9) return "Do the poses stay as they are?";
  const Eigen::VectorXd first = denseStep(equationsOf(map, std::vector<double>(map.edges.size(), 1)), 0);
  const bool isAlong = moved.dot(first) > (1 - 1e-6) * moved.norm() * first.norm();
  if (isAlong)
    return "Are the equations set up only once? Errors and derivatives change with the poses: they have to "
           "be "
           "computed again after each step.";
  if (got.costs.size() > 190) return "Are the steps too short? 200 of them have to be enough.";
  if (end < 1.1 * least)
    return "Does it stop too early? The cost still falls by more than a millionth of itself.";
  return "";
}
