#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "planning/nearest_neighbors.h"
#include "planning/path_problem.h"
#include "planning/samplers.h"

namespace rex {

struct RoadmapOptions {
  int nodes = 500;     ///< valid configurations to find
  int neighbors = 10;  ///< k: each node is connected to its k nearest; 0: as many as optimality requires, e
                       ///< (1 + 1/d) log n (PRM*: Karaman and Frazzoli 2011)
  bool lazy = false;   ///< check nodes and edges only when a query uses them (Bohlin and Kavraki 2000)
  Sampler sampler{};   ///< empty: uniform
  int maxSamples = 100000;           ///< the most proposals taken from the sampler
  std::function<bool()> isTimeUp{};  ///< true ends sampling and joining early; empty: never
};

/// Configurations all over a space and the free edges between them, built once to answer many queries.
/// Slide 4:31; Kavraki, Svestka, Latombe and Overmars 1996.
class Roadmap {
 public:
  /// Throws Error for options out of range, and like EdgeChecker. If the sampler finds fewer nodes than
  /// requested, that is not an error: see nodes().
  Roadmap(const Space& space, AllValid allValid, double resolution, const RoadmapOptions& options, Rng& rng);

  int nodes() const { return points_.count(); }
  [[nodiscard]] Eigen::VectorXd node(int i) const { return points_.point(i); }
  /// Pairs of connected nodes; for a lazy roadmap, those not known to be blocked.
  [[nodiscard]] std::vector<std::pair<int, int>> edges() const;

  /// The shortest path on the roadmap, by A*, from start to goal, which become nodes. Everything else in
  /// the problem must be that of the roadmap. kBudgetSpent: this roadmap contains no path. Trees stay
  /// empty. A lazy roadmap keeps what it learns. Throws like requireSound.
  [[nodiscard]] PathResult query(const PathProblem& problem);

 private:
  enum class Known { kUnchecked, kFree, kBlocked };
  struct Edge {
    int a, b;
    double length;
    Known known;
  };

  int addNode(const VectorArg& q, Known known);
  void join(int node);
  [[nodiscard]] std::vector<int> shortestWay(int from, int to) const;
  bool isFree(const std::vector<int>& way);

  Space space_;
  RoadmapOptions options_;
  EdgeChecker checker_;
  NearestNeighbors points_;
  std::vector<Known> knownNodes_;
  std::vector<Edge> edges_;
  std::vector<std::vector<int>> edgesOf_;  // of each node, places in edges_
};

}  // namespace rex
