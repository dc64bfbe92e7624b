#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "tree_evidence.h"

// Part 2: one step of a tree.

/// The number of the node for which a distance from the target is least.
using Distance = std::function<double(const Eigen::VectorXd&)>;
inline int leastBy(const std::vector<Eigen::VectorXd>& nodes, const Distance& distance) {
  int least = 0;
  for (int i = 1; i < static_cast<int>(nodes.size()); ++i)
    if (distance(nodes[static_cast<std::size_t>(i)]) < distance(nodes[static_cast<std::size_t>(least)]))
      least = i;
  return least;
}

inline void nearestFits(rex::grading::Check& check, Student& student,
                        const std::vector<Eigen::VectorXd>& nodes, const Eigen::VectorXd& target) {
  check.input(fmt::format("{} nodes, d = {}", nodes.size(), target.size()),
              {{"nodes, in columns", nodesOf(nodes)}, {"target", target}});
  const int got = student.nearestNode(nodes, target), wanted = nearestOf(nodes, target);
  const auto shown = check.show([&] { return nearestSeen(nodes, target, got, wanted); });
  const auto first = check.ask("Is it always the first node? Each has to be looked at.", got == 0);
  const auto last = check.ask("Is it the last node that is nearer than one before?",
                              got == static_cast<int>(nodes.size()) - 1);
  const auto by = [&](const char* question, const Distance& distance) {
    return check.suspect(question, leastBy(nodes, distance));
  };
  const auto farthest =
      by("Is it the farthest node?", [&](const Eigen::VectorXd& q) { return -(q - target).norm(); });
  const auto sum = by("Is the distance the sum of the differences? Wanted is the length |qa - qb|.",
                      [&](const Eigen::VectorXd& q) { return (q - target).cwiseAbs().sum(); });
  const auto signs = by("Is the distance the sum of the differences? Wanted is the length |qa - qb|.",
                        [&](const Eigen::VectorXd& q) { return (q - target).sum(); });
  const auto largest = by("Is the distance the largest of the differences? Wanted is the length |qa - qb|.",
                          [&](const Eigen::VectorXd& q) { return (q - target).cwiseAbs().maxCoeff(); });
  check.near("number of the node by nearestNode", got, wanted, 0);
}

inline void stepTowardsFits(rex::grading::Check& check, Student& student, const Eigen::VectorXd& from,
                            const Eigen::VectorXd& target, double stepSize) {
  const auto step = [&](const Eigen::VectorXd& start, double size) {
    check.input("a step", {{"from", start}, {"target", target}, {"stepSize", size}});
    return student.stepTowards(start, target, size);
  };
  const Eigen::VectorXd along = target - from;
  const auto at = [&](double share) -> Eigen::VectorXd { return from + share * along; };
  const double share = stepSize / along.norm();
  {
    check.near(
        "stepTowards a target that is farther away than stepSize", step(from, stepSize), at(share), 1e-12,
        {{"Is it the target, however far away?", target},
         {"Is there no step?", from},
         {"Is it the step alone, without `from`?", at(share) - from},
         {"Is the difference multiplied by stepSize without being divided by its length?", at(stepSize)},
         {"Is the step taken away from the target?", at(-share)},
         {"Does the step start at the target?", at(1 - share)}});
  }
  const double large = 2 * along.norm();
  const Eigen::VectorXd near = step(from, large);
  const auto beyond = check.suspect("Does the step go beyond the target? It stops there.", at(2));
  const auto none = check.suspect("Is there no step?", from);
  const auto rounded =
      check.ask("Is it the target up to rounding? Wanted is `target` itself, to the last bit.",
                near.size() == target.size() && near.isApprox(target, 1e-12));
  check.near("stepTowards a target that is nearer than stepSize", near, target, 0);
  check.near("stepTowards from the target to itself", step(target, 0.1), target, 0);
}

/// Targets relative to their box: 0 at lower, 1 at upper. `share` of all draws were the aim.
struct Draws {
  Eigen::MatrixXd others{};
  double share = 0;
};

inline Draws drawn(rex::grading::Check& check, Student& student, const SearchSettings& settings,
                   const Eigen::VectorXd& aim, int n, rex::Rng& given) {
  std::vector<Eigen::VectorXd> others;
  for (int i = 0; i < n; ++i) {
    const Eigen::VectorXd target = student.drawTarget(settings, aim, check.split(given.next()));
    check.shape("target of drawTarget", target, aim.size(), 1);
    if (target != aim)
      others.emplace_back((target - settings.lower).cwiseQuotient(settings.upper - settings.lower));
  }
  return {nodesOf(others), 1 - static_cast<double>(others.size()) / n};
}

inline void drawsAreInTheBox(rex::grading::Check& check, const Eigen::MatrixXd& others,
                             const SearchSettings& settings) {
  bool isUnit = true, isShifted = true;
  for (Eigen::Index k = 0; k < others.cols(); ++k)
    for (int i = 0; i < 3; ++i) {
      const double size = settings.upper[i] - settings.lower[i],
                   raw = settings.lower[i] + others(i, k) * size;
      isUnit = isUnit && raw >= 0 && raw <= 1;
      isShifted = isShifted && raw >= 0 && raw <= size;
    }
  const auto unit = check.ask("Are the numbers from [0, 1)? The box has other bounds.", isUnit);
  const auto shift = check.ask("Is it the size of the box, without its lower corner?", isShifted);
  check.atLeast("smallest coordinate of a target of drawTarget, with 0 at lower", others.minCoeff(), 0);
  check.atMost("largest coordinate of a target of drawTarget, with 1 at upper", others.maxCoeff(), 1);
}

/// The targets are in the box, and uniform. Statistics must be within 5.5 standard deviations, which fails
/// for one correct answer in 25 million.
inline void drawsAreUniform(rex::grading::Check& check, const Eigen::MatrixXd& others,
                            const SearchSettings& settings) {
  const auto shown = check.show([&] { return drawsSeen(others); });
  drawsAreInTheBox(check, others, settings);
  const double count = static_cast<double>(others.cols()), sigmas = 5.5, width = 1 / std::sqrt(12);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& one : others.colwise()) mean += one / count;
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const auto& one : others.colwise()) {
    const Eigen::Vector3d off = one - mean;
    squares += off * off.transpose() / count;
  }
  const auto deviation = [&](int i) { return std::sqrt(squares(i, i)); };
  const Eigen::Vector3d deviations(deviation(0), deviation(1), deviation(2));
  const auto always = check.ask("Is it the same target in each call? All randomness comes from rng.",
                                deviations.maxCoeff() < 1e-9);
  check.near("standard deviations of the targets of drawTarget, in sizes of the box", deviations,
             Eigen::Vector3d::Constant(width), sigmas / std::sqrt(15 * count));
  check.near("means of the targets of drawTarget, from 0 at lower to 1 at upper", mean,
             Eigen::Vector3d::Constant(.5), sigmas * width / std::sqrt(count));
  const Eigen::Vector3d correlations(12 * squares(0, 1), 12 * squares(0, 2), 12 * squares(1, 2));
  const auto one =
      check.ask("Does one random number serve for all coordinates?", correlations.minCoeff() > .9);
  check.near("correlations of the coordinates of the targets of drawTarget", correlations,
             Eigen::Vector3d::Zero(), sigmas / std::sqrt(count));
}

inline void checkSampler(rex::grading::Check& check, Student& student, double goalBias, int n,
                         rex::Rng& given) {
  const Eigen::Vector3d lower(-1, 2, -0.5), upper(1, 2.5, 6), aim(7, 8, 9);
  const SearchSettings settings{lower, upper, 0.1, goalBias, 1000};
  check.input(fmt::format("{} draws", n),
              {{"lower", lower}, {"upper", upper}, {"aim", aim}, {"goalBias", goalBias}});
  const Draws draws = drawn(check, student, settings, aim, n, given);
  const double tolerance = 5.5 * std::sqrt(goalBias * (1 - goalBias) / n);
  {
    const auto never = check.ask("Is the aim never drawn?", draws.share == 0);
    const auto always = check.ask("Is it always the aim?", draws.share == 1);
    const auto other = check.ask("Is the aim drawn with the probability 1 - goalBias?",
                                 std::abs(draws.share - 1 + goalBias) <= tolerance + .02);
    check.near("share of the aim in the draws of drawTarget", draws.share, goalBias, tolerance);
  }
  if (draws.others.cols() == 0) return;
  drawsAreUniform(check, draws.others, settings);
  const rex::remote::SplitRng rng = check.split(given.next());
  const auto outside = check.ask("Is there other randomness, as from rand()? All randomness comes from rng.");
  check.that("drawTarget gives the same target with the same rng",
             student.drawTarget(settings, aim, rng) == student.drawTarget(settings, aim, rng));
}

/// What lies between the nearest node and the new one.
enum class Way { kFree, kEndBlocked, kOnlyMiddleBlocked };

/// A step towards a target, from the nearest node of a tree in the plane to q.
struct Step {
  Tree tree{};
  Eigen::VectorXd target{}, q{};
  int parent = 0;
  const Eigen::VectorXd& from() const { return tree.nodes[static_cast<std::size_t>(parent)]; }
};

inline Step randomStep(const PlaneWorld& world, Way wanted, double stepSize, rex::Rng& rng) {
  const EdgeTest isFree = freeIn(world);
  Step step;
  for (int i = 0;; ++i) {
    if (i % 100 == 0) step.tree = wildTree(world, 60, rng);  // not every tree has nodes beside a wall
    step.target = rng.uniformVector(2, 0, 1);
    step.parent = nearestOf(step.tree.nodes, step.target);
    const Eigen::VectorXd along = step.target - step.from();
    step.q = step.from() + std::min(1., stepSize / along.norm()) * along;
    const Way way = isFree(step.from(), step.q) ? Way::kFree
                    : isFree(step.q, step.q)    ? Way::kOnlyMiddleBlocked
                                                : Way::kEndBlocked;
    if (way == wanted) break;
  }
  step.tree.costs.clear();
  return step;
}

inline void stepsWell(rex::grading::Check& check, Student& student, const PlaneWorld& world, Way wanted) {
  const double stepSize = check.rng().uniform(0.08, 0.15);
  const Step step = randomStep(world, wanted, stepSize, check.rng());
  EdgeRecord record(freeIn(world), 2);
  check.input(
      "a tree of 60 nodes in the unit square with walls and discs",
      {{"target", step.target}, {"nearest node", step.parent}, {"at", step.from()}, {"stepSize", stepSize}});
  const std::optional<NewNode> got = student.rrtStep(step.tree, step.target, stepSize, record.test());
  const auto shown = check.show([&] {
    return edgeSeen("A step towards a random target", world, step.tree,
                    got ? PlaneEdge{got->parent, got->q} : PlaneEdge{},
                    wanted == Way::kFree ? PlaneEdge{step.parent, step.q} : PlaneEdge{});
  });
  askedWell(check, "rrtStep", record);
  if (wanted != Way::kFree) {
    const auto how = askAboutEdge(check, record, step.from(), step.q);
    return check.that(wanted == Way::kEndBlocked
                          ? "rrtStep gives no node, since the new one is in an obstacle"
                          : "rrtStep gives no node, since an obstacle is in the way",
                      !got.has_value());
  }
  check.that("rrtStep gives a node, since the edge is free", got.has_value());
  check.near("parent of the new node of rrtStep", got->parent, step.parent, 0);
  check.near("new node of rrtStep", got->q, step.q, 1e-12,
             {{"Is it the target, however far away?", step.target}}, "m");
  const auto really = askAboutEdge(check, record, step.from(), got->q);
  check.that("rrtStep calls edgeFree for the new edge", record.wasFree(step.from(), got->q));
}
