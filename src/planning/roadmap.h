#pragma once

#include <utility>
#include <vector>

#include "planning/edge_checker.h"
#include "planning/nearest_neighbors.h"
#include "planning/path_problem.h"
#include "planning/samplers.h"

namespace rex {

struct RoadmapOptions {
  int nodes = 500;     ///< valid configurations to find
  int neighbors = 10;  ///< k: each is to be joined to so many nearest; 0: as many as optimality asks for, e
                       ///< (1 + 1/d) log n (PRM*: Karaman and Frazzoli 2011)
  bool lazy =
      false;  ///< check nodes and edges only when a query comes through them (Bohlin and Kavraki 2000)
  Sampler sampler{};        ///< empty: uniform
  int maxSamples = 100000;  ///< proposals of the sampler, at most
};

/// Configurations all over a space and the free ways between them, made once to answer many queries. Slide
/// 4:31; Kavraki, Svestka, Latombe and Overmars 1996.
class Roadmap {
 public:
  /// Throws Error for options out of range, and as EdgeChecker. Fewer nodes than asked for, where the sampler
  /// finds no more, are no error: see nodes().
  Roadmap(const Space& space, AllValid allValid, double resolution, const RoadmapOptions& options, Rng& rng);

  int nodes() const { return points_.count(); }
  [[nodiscard]] Eigen::VectorXd node(int i) const { return points_.point(i); }
  /// Pairs of nodes that are joined; of a lazy roadmap, those not known to be blocked.
  [[nodiscard]] std::vector<std::pair<int, int>> edges() const;

  /// The shortest way along the roadmap, by A*, from start to goal, which become nodes of it. The problem
  /// must be that of the roadmap in all else. kBudgetSpent: there is no way in this roadmap. Trees stay
  /// empty. What a lazy roadmap learns, it keeps. Throws as requireSound.
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
