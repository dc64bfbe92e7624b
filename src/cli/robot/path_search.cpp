#include "cli/robot/path_search.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <ctime>

#include <fmt/format.h>

#include "base/error.h"
#include "base/interruption.h"
#include "base/rng.h"
#include "cli/terminal.h"
#include "planning/path_spline.h"
#include "planning/roadmap.h"
#include "planning/robot_problem.h"
#include "planning/rrt.h"
#include "planning/smooth_path.h"

namespace rex::cli {
namespace {

constexpr int kShortcuts = 200;
constexpr int kNeighbors = 10;  // per node of a PRM

double cpuTime() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// Counts the configurations that a planner checks, and lets the user interrupt it.
AllValid watched(AllValid allValid, long& checks, std::atomic<long>& shown) {
  constexpr int kSeldom = 256;  // calls between looks at the signals, each of which costs a tenth of a call
  return [allValid = std::move(allValid), &checks, &shown, calls = 0](const MatrixArg& Q) mutable {
    if (++calls % kSeldom == 0) {
      throwIfInterrupted();
      shown = checks;
    }
    checks += Q.cols();
    return allValid(Q);
  };
}

PathGraph graphOf(PathTree tree) {
  PathGraph graph{.nodes = std::move(tree.nodes)};
  for (std::size_t i = 0; i < tree.parents.size(); ++i)
    if (tree.parents[i] >= 0) graph.edges.emplace_back(tree.parents[i], static_cast<int>(i));
  return graph;
}

PathResult growTrees(const PathProblem& problem, const PathSearch& search, Rng& rng, FoundPath& found) {
  const RrtOptions options{.stepSize = search.step, .maxSamples = search.samples};
  PathResult result = search.planner == Planner::kRrt          ? growRrt(problem, options, rng)
                      : search.planner == Planner::kRrtConnect ? connectRrts(problem, options, rng)
                                                               : growRrtStar(problem, {options}, rng);
  found.samples = result.samples;
  for (PathTree& tree : result.trees) found.explored.push_back(graphOf(std::move(tree)));
  return result;
}

PathResult askRoadmap(const PathProblem& problem, const PathSearch& search, Rng& rng, FoundPath& found) {
  Roadmap roadmap(problem.space, problem.allValid, problem.resolution,
                  {.nodes = search.samples,
                   .neighbors = search.planner == Planner::kPrmStar ? 0 : kNeighbors,
                   .lazy = search.planner == Planner::kLazyPrm,
                   .maxSamples = search.samples,
                   .isTimeUp = problem.isTimeUp},
                  rng);
  PathResult result = roadmap.query(problem);
  found.samples = search.samples;
  PathGraph graph{.nodes = Eigen::MatrixXd(problem.space.size(), roadmap.nodes()), .edges = roadmap.edges()};
  for (int i = 0; i < roadmap.nodes(); ++i) graph.nodes.col(i) = roadmap.node(i);
  found.explored.push_back(std::move(graph));
  return result;
}

}  // namespace

const std::vector<std::pair<std::string, Planner>>& plannerNames() {
  static const std::vector<std::pair<std::string, Planner>> names{
      {"rrt", Planner::kRrt},
      {"rrt-connect", Planner::kRrtConnect},
      {"rrt-star", Planner::kRrtStar},
      {"prm", Planner::kPrm},
      {"prm-star", Planner::kPrmStar},
      {"lazy-prm", Planner::kLazyPrm},
      {"hybrid-astar", Planner::kHybridAStar},
      {"optimize", Planner::kOptimize},
      {"optimize-penalty", Planner::kOptimizePenalty},
      {"optimize-barrier", Planner::kOptimizeBarrier}};
  return names;
}

const std::string& toString(Planner planner) {
  return std::ranges::find(plannerNames(), planner, &std::pair<std::string, Planner>::second)->first;
}

bool drawsSamples(Planner planner) { return planner < Planner::kHybridAStar; }

bool growsTrees(Planner planner) {
  return planner == Planner::kRrt || planner == Planner::kRrtConnect || planner == Planner::kRrtStar;
}

void requireClear(const char* option, const VectorArg& q, const Model& model, const ContactModel& contacts,
                  const AllValid& allValid, double margin) {
  if (allValid(q)) return;
  constexpr double kLeastMargin = 1e-4, kSpare = 0.99;
  const NearestContact nearest = nearestContact(model, contacts, q);
  // The margin that would do, in one digit.
  const double most = kSpare * nearest.distance;
  const double digit = std::pow(10, std::floor(std::log10(std::max(most, kLeastMargin))));
  const std::string instead = most >= kLeastMargin && most < margin
                                  ? fmt::format("; --margin {:g} would do", std::floor(most / digit) * digit)
                                  : "";
  throw UsageError({.what = option,
                    .found = escapeForTerminal(nearest.text),
                    .wanted = fmt::format("all shapes {:g} m apart, the --margin{}", margin, instead)});
}

void requireClearEnds(const PathTask& task, double margin) {
  const PathProblem& problem = task.problem;
  requireClear("--start", problem.start, task.model, task.contacts, problem.allValid, margin);
  requireClear("--goal", problem.goal, task.model, task.contacts, problem.allValid, margin);
}

FoundPath searchPath(const PathTask& task, const PathSearch& search, std::uint64_t seed) {
  const Space& space = task.problem.space;
  FoundPath found{.seed = seed};
  PathProblem problem = task.problem;
  std::atomic<long> checks = 0;
  problem.allValid = watched(task.problem.allValid, found.checks, checks);
  const double begin = cpuTime();
  problem.isTimeUp = [&] {
    found.isTimeUp = found.isTimeUp || cpuTime() - begin > search.timeLimit;
    return found.isTimeUp;
  };
  const ProgressLine progress([&] {
    return fmt::format("searching: {} configurations checked, at most {:g} s", checks.load(),
                       search.timeLimit);
  });
  Rng rng(seed);
  PathResult result = growsTrees(search.planner) ? growTrees(problem, search, rng, found)
                                                 : askRoadmap(problem, search, rng, found);
  const double planned = cpuTime();
  found.planningTime = planned - begin;
  for (const PathGraph& graph : found.explored) found.nodes += static_cast<int>(graph.nodes.cols());
  if (result.status != PathStatus::kFound) return found;
  found.plannedLength = result.length;
  found.curve =
      search.smooth ? smoothCurve(problem, result.path, kShortcuts, rng) : straightCurve(space, result.path);
  found.smoothingTime = cpuTime() - planned;
  found.path = sampled(found.curve, kChordTolerance);
  found.length = pathLength(space, found.path);
  found.clearance = pathClearance(task.model, task.contacts, space, found.path, kClearanceTolerance);
  return found;
}

int FoundPaths::successes() const {
  return static_cast<int>(std::ranges::count_if(all, &FoundPath::isFound));
}

FoundPaths searchPaths(const PathTask& task, const PathSearch& search, std::uint64_t firstSeed, int count) {
  FoundPaths found{.all = {searchPath(task, search, firstSeed)}};
  for (int i = 1; i < count; ++i) {
    FoundPath next = searchPath(task, search, firstSeed + static_cast<std::uint64_t>(i));
    const FoundPath& best = found.shortest();
    const bool isBetter = next.isFound() && (!best.isFound() || next.length < best.length);
    (isBetter ? found.all[found.best] : next).explored.clear();
    found.all.push_back(std::move(next));
    if (isBetter) found.best = found.all.size() - 1;
  }
  return found;
}

}  // namespace rex::cli
