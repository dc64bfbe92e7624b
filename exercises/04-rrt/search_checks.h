#pragma once

#include <string>
#include <vector>

#include <Eigen/QR>

#include "collision/motion_clearance.h"
#include "interface.h"
#include "peg_problem.h"
#include "tree_evidence.h"

// Parts 3 to 5: searches in the plane and for the arm, and shorter paths.

/// The labels of the generators that students get.
inline rex::Rng generatorsOf(rex::grading::Check& check) { return check.rng().split(7); }

inline void describe(rex::grading::Check& check, const std::string& world, const PlaneProblem& problem,
                     const SearchSettings& settings) {
  check.input(world, {{"start", problem.start},
                      {"goal", problem.goal},
                      {"stepSize", settings.stepSize},
                      {"goalBias", settings.goalBias},
                      {"maxSamples", settings.maxSamples}});
}

inline void wayFits(rex::grading::Check& check, Student& student, int count) {
  const Path way = randomPath(count, check.rng());
  const TreeWithWay made = treeAround(way, check.rng());
  check.input("a tree", {{"nodes, in columns", nodesOf(made.tree.nodes)},
                         {"parents", numbersOf(made.tree.parents)},
                         {"node", made.last}});
  const Path got = student.wayFromRoot(made.tree, made.last);
  const auto shown = check.show([&] { return pathSeen(got, way); });
  isPath(check, "wayFromRoot", got, way);
}

inline void joinFits(rex::grading::Check& check, Student& student, int count, bool meets) {
  rex::Rng& rng = check.rng();
  const int split = 1 + rng.index(count - 2);
  const Path whole = randomPath(count, rng);
  const Path first(whole.begin(), whole.begin() + split + 1);
  const Path second(whole.rbegin(), whole.rend() - split - (meets ? 0 : 1));
  const TreeWithWay one = treeAround(first, rng), other = treeAround(second, rng);
  check.input(meets ? "a and b are the same configuration" : "a and b are different configurations",
              {{"nodes of fromStart", nodesOf(one.tree.nodes)},
               {"its parents", numbersOf(one.tree.parents)},
               {"a", one.last},
               {"nodes of fromGoal", nodesOf(other.tree.nodes)},
               {"its parents", numbersOf(other.tree.parents)},
               {"b", other.last}});
  const Path got = student.joinedPath(one.tree, one.last, other.tree, other.last);
  const auto shown = check.show([&] { return pathSeen(got, whole); });
  const auto isJoined = [&](Path path, const Path& rest) {
    path.insert(path.end(), rest.begin(), rest.end());
    return got == path;
  };
  const auto twice = check.ask("Is the node where the trees meet there twice? It belongs to both.",
                               meets && isJoined(first, {second.rbegin(), second.rend()}));
  const auto notTurned =
      check.ask("Is the path of the second tree not reversed? It leads to the goal.",
                isJoined(first, second) || isJoined(first, {second.begin() + 1, second.end()}) ||
                    isJoined(first, {second.begin(), second.end() - 1}));
  isPath(check, "joinedPath", got, whole);
}

inline void backwardIsSound(rex::grading::Check& check, const TreeSearch& search, const PlaneProblem& problem,
                            const SearchSettings& settings, const EdgeRecord& record,
                            const EdgeTest& isFree) {
  askedWell(check, "growBackward", record);
  isTree(check, "growBackward", search.tree, problem.goal, true, settings.maxSamples + 1);
  edgesAreSound(check, "growBackward", search.tree, settings.stepSize, record, isFree,
                [&](std::size_t here) { return treesSeen(problem, {search.tree}, search.path, 0, here); });
  const auto shown = check.show([&] { return treesSeen(problem, {search.tree}, search.path); });
  pathIsSound(check, "growBackward", search.path, problem.start, problem.goal, settings.stepSize, record,
              isFree);
  pathIsOfTrees(check, "growBackward", {search.path.begin() + 1, search.path.end()}, {search.tree});
}

inline void growsBackward(rex::grading::Check& check, Student& student, const std::string& world,
                          const PlaneProblem& problem, rex::Rng& given) {
  const SearchSettings settings = inThePlane(0.06, 0.1, 20000);
  describe(check, world, problem, settings);
  const EdgeTest isFree = freeIn(problem.world);
  EdgeRecord record(isFree, 2);
  const TreeSearch search =
      student.growBackward(problem.start, problem.goal, settings, record.test(), check.split(given.next()));
  backwardIsSound(check, search, problem, settings, record, isFree);
}

/// A search with eighty steps from root to start. There are no obstacles, so that each target gives a node.
struct OpenSearch {
  PlaneProblem problem{};
  TreeSearch search{};
};

inline OpenSearch searchInTheOpen(rex::grading::Check& check, Student& student, double goalBias,
                                  rex::Rng& given) {
  const Eigen::VectorXd start = check.rng().uniformVector(2, -1, 1);
  const double angle = check.rng().uniform(-4, 4);
  OpenSearch open{{{}, start, start + 8 * Eigen::Vector2d(std::cos(angle), std::sin(angle))}};
  const SearchSettings settings{Eigen::Vector2d(-20, -20), Eigen::Vector2d(20, 20), 0.1, goalBias, 4000};
  describe(check, "no obstacles, a box from (-20, -20) to (20, 20)", open.problem, settings);
  const EdgeTest isFree = [](const Eigen::VectorXd&, const Eigen::VectorXd&) { return true; };
  EdgeRecord record(isFree, 2);
  open.search =
      student.growBackward(start, open.problem.goal, settings, record.test(), check.split(given.next()));
  backwardIsSound(check, open.search, open.problem, settings, record, isFree);
  return open;
}

/// Over 30 seeds, four searches have 230 nodes with a standard deviation of 23 for the low bias, and 130 with
/// one of 4 for the high one. A fixed bias of 0.2 gives 172, one of 0.5 gives 115, whatever bias is required.
inline void aimsAtTheStart(rex::grading::Check& check, Student& student, rex::Rng& given) {
  std::vector<OpenSearch> rare, often;
  for (int i = 0; i < 8; ++i) rare.push_back(searchInTheOpen(check, student, 0.1, given));
  for (int i = 0; i < 4; ++i) often.push_back(searchInTheOpen(check, student, 0.4, given));
  const auto meanOf = [](const std::vector<OpenSearch>& searches) {
    double sum = 0;
    for (const OpenSearch& one : searches) sum += static_cast<double>(one.search.tree.nodes.size());
    return sum / static_cast<double>(searches.size());
  };
  const auto fits = [&](double goalBias, const std::vector<OpenSearch>& searches, double least, double most) {
    check.input(fmt::format("{} searches without obstacles, with 80 steps from the goal to the start",
                            searches.size()),
                {{"goalBias", goalBias}});
    const std::string property =
        fmt::format("mean number of nodes in the trees of growBackward with goalBias = {}", goalBias);
    const auto shown = check.show([&] {
      rex::Figure figure{
          .title = "Nodes of each search, and their mean", .xLabel = "search", .yLabel = "nodes"};
      rex::Histogram sizes{.label = "got"};
      for (const OpenSearch& one : searches)
        sizes.heights.push_back(static_cast<double>(one.search.tree.nodes.size()));
      figure.histograms = {sizes};
      figure.horizontalLines = {
          {.at = least, .label = "wanted: mean of at least"},
          {.at = most, .label = "wanted: mean of at most"},
          {.at = meanOf(searches), .label = "mean", .color = rex::grading::kWrongColor}};
      return rex::grading::Evidence{.figures = {figure}};
    });
    check.atLeast(property, meanOf(searches), least);
    check.atMost(property, meanOf(searches), most);
  };
  const auto fixed =
      check.ask("Is the goalBias of the settings ignored? There are as many nodes with 0.1 as with 0.4.",
                std::abs(meanOf(rare) / meanOf(often) - 1) < .15);
  fits(0.1, rare, 150, 340);
  fits(0.4, often, 105, 155);
}

/// The arm as students see it in the checks: its joint angles are rotated at random, q = R (joint angles).
/// That preserves distances and straight lines, and makes postures recorded beforehand useless.
struct TurnedArm {
  explicit TurnedArm(rex::Rng& rng) : goal(7) {
    R = Eigen::HouseholderQR<Eigen::MatrixXd>(rng.normalVector(49).reshaped(7, 7)).householderQ();
    goal = R * kInTheHole;
  }
  EdgeTest test(const EdgeTest& isFree) const {
    return [isFree, R = R](const Eigen::VectorXd& qa, const Eigen::VectorXd& qb) {
      return isFree(R.transpose() * qa, R.transpose() * qb);
    };
  }
  Eigen::VectorXd joints(const Eigen::VectorXd& q) const {
    return q.size() == 7 ? Eigen::VectorXd(R.transpose() * q) : q;
  }

  Eigen::MatrixXd R;
  Eigen::VectorXd goal;
};

inline EdgeTest contactFreeEdges(const rex::Simulator& S) {
  return [&S](const Eigen::VectorXd& qa, const Eigen::VectorXd& qb) {
    return rex::motionClearance(S.model(), rex::ContactModel(S.model()), qa, qb, 1e-3) > 0;
  };
}

/// A search for the arm.
struct ArmSearch {
  const rex::Simulator& S;
  const TurnedArm& arm;
  EdgeRecord record;
  EdgeTest isFree;

  void treeIsSound(rex::grading::Check& check, const std::string& function, const Tree& tree,
                   const Eigen::VectorXd& root) const {
    isTree(check, function, tree, root, true, kNodesPerTarget * kArmSettings.maxSamples);
    edgesAreSound(check, function, tree, kArmSettings.stepSize, record, isFree, [&](std::size_t here) {
      const auto parent = static_cast<std::size_t>(tree.parents.at(here));
      return armEdgeSeen(S, arm.joints(tree.nodes[parent]), arm.joints(tree.nodes[here]));
    });
  }
  void pathFits(rex::grading::Check& check, const std::string& function, const Path& path,
                const std::vector<Tree>& trees, bool isBackward) const {
    const auto shown = check.show([&] {
      Path joints;
      for (const Eigen::VectorXd& q : path) joints.push_back(arm.joints(q));
      return armPathSeen(S, joints, kInTheHole, kArmSettings.stepSize, contactFreeEdges(S));
    });
    for (const EdgeTest& test : {isFree, arm.test(contactFreeEdges(S))})
      pathIsSound(check, function, path, kZero, arm.goal, kArmSettings.stepSize, record, test);
    pathIsOfTrees(check, function, {path.begin() + (isBackward ? 1 : 0), path.end()}, trees);
  }
};

/// The length of the shortened path, which must be free, have the same ends and not be longer; 1 mm shorter
/// if the path `isClearlyLonger` than necessary.
inline double shortenedLength(rex::grading::Check& check, Student& student, const PlaneProblem& problem,
                              const Path& path, bool isClearlyLonger, rex::Rng& given) {
  EdgeRecord record(freeIn(problem.world), 2);
  const Path better = student.shortened(path, record.test(), check.split(given.next()));
  const auto shown = check.show([&] { return shortenedSeen(problem, path, better); });
  askedWell(check, "shortened", record);
  // Pieces of free edges are free, up to the last digits.
  pathIsSound(check, "shortened", better, problem.start, problem.goal, 2, record,
              freeIn(problem.world, 1e-9));
  const auto same = check.ask("Is the path returned as it was?", better == path);
  check.atMost("length of the path of shortened", lengthOf(better),
               lengthOf(path) + (isClearlyLonger ? -1e-3 : 1e-9), "m");
  return lengthOf(better);
}

/// A jagged path that could be straight.
inline Path jaggedLine(const PlaneProblem& problem, rex::Rng& rng) {
  Path path{problem.start};
  for (int k = 1; k < 12; ++k)
    path.emplace_back(problem.start + k / 12. * (problem.goal - problem.start) +
                      rng.uniformVector(2, -0.06, 0.06));
  path.push_back(problem.goal);
  return path;
}

inline void describe(rex::grading::Check& check, const std::string& world, const Path& path) {
  check.input(world, {{"path, in columns", nodesOf(path)}});
}
