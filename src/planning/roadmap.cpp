#include "planning/roadmap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"

namespace rex {
namespace {

void requireSound(const RoadmapOptions& options) {
  requireCount("nodes of a roadmap", options.nodes, 1);
  requireCount("number of samples", options.maxSamples, 1);
  if (options.neighbors < 0)
    throw Error({.what = "neighbours in a roadmap",
                 .found = fmt::format("{}", options.neighbors),
                 .wanted = "at least 1, or 0 for PRM*"});
}

int dimensionOf(const Space& space) {
  int dimension = 0;
  for (const SpacePart& part : space.parts()) dimension += part.kind == SpacePart::Kind::kQuaternion ? 3 : 1;
  return dimension;
}

}  // namespace

Roadmap::Roadmap(const Space& space, AllValid allValid, double resolution, const RoadmapOptions& options,
                 Rng& rng)
    : space_(space), options_(options), checker_(space, std::move(allValid), resolution), points_(space) {
  requireSound(options);
  if (!options_.sampler) options_.sampler = uniformSampler(space);
  Eigen::VectorXd q(space.size());
  const auto isTimeUp = [&] { return options.isTimeUp && options.isTimeUp(); };
  for (int i = 0; i < options.maxSamples && nodes() < options.nodes && !isTimeUp(); ++i) {
    if (!options_.sampler(rng, q)) continue;
    if (options.lazy)
      addNode(q, Known::kUnchecked);
    else if (checker_.isValid(q))
      addNode(q, Known::kFree);
  }
  for (int node = 0; node < nodes() && !isTimeUp(); ++node) join(node);
}

int Roadmap::addNode(const VectorArg& q, Known known) {
  knownNodes_.push_back(known);
  edgesOf_.emplace_back();
  return points_.add(q);
}

// Edges from a node to those nearest to it.
void Roadmap::join(int node) {
  const double starred = std::numbers::e * (1 + 1. / dimensionOf(space_)) * std::log(nodes());
  const int neighbors =
      options_.neighbors > 0 ? options_.neighbors : std::max(1, static_cast<int>(std::ceil(starred)));
  const Eigen::VectorXd q = points_.point(node);
  std::vector<int>& own = edgesOf_[static_cast<std::size_t>(node)];
  for (const int other : points_.nearest(q, neighbors + 1)) {
    const bool isJoined = std::any_of(own.begin(), own.end(), [&](int edge) {
      const auto& [a, b, length, known] = edges_[static_cast<std::size_t>(edge)];
      return a == other || b == other;
    });
    if (other == node || isJoined) continue;
    const Eigen::VectorXd p = points_.point(other);
    if (!options_.lazy && !checker_.isValid(q, p)) continue;
    own.push_back(static_cast<int>(edges_.size()));
    edgesOf_[static_cast<std::size_t>(other)].push_back(static_cast<int>(edges_.size()));
    edges_.push_back({node, other, space_.distance(q, p), options_.lazy ? Known::kUnchecked : Known::kFree});
  }
}

std::vector<std::pair<int, int>> Roadmap::edges() const {
  std::vector<std::pair<int, int>> pairs;
  for (const Edge& edge : edges_)
    if (edge.known != Known::kBlocked) pairs.emplace_back(edge.a, edge.b);
  return pairs;
}

// A* without what is known to be blocked. Returns the edges, the last one first; empty if there is no path.
std::vector<int> Roadmap::shortestWay(int from, int to) const {
  const auto count = static_cast<std::size_t>(nodes());
  std::vector<double> cost(count, std::numeric_limits<double>::infinity());
  std::vector<int> via(count, -1);
  const Eigen::VectorXd goal = points_.point(to);
  using Open = std::pair<double, int>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  const auto reach = [&](int node, double newCost, int edge) {
    const auto i = static_cast<std::size_t>(node);
    if (newCost >= cost[i] || knownNodes_[i] == Known::kBlocked) return;
    cost[i] = newCost;
    via[i] = edge;
    open.emplace(newCost + space_.distance(points_.point(node), goal), node);
  };
  reach(from, 0, -1);
  while (!open.empty() && open.top().second != to) {
    const int node = open.top().second;
    open.pop();
    for (const int index : edgesOf_[static_cast<std::size_t>(node)]) {
      const Edge& edge = edges_[static_cast<std::size_t>(index)];
      if (edge.known == Known::kBlocked) continue;
      reach(edge.a == node ? edge.b : edge.a, cost[static_cast<std::size_t>(node)] + edge.length, index);
    }
  }
  std::vector<int> way;
  for (int at = to; via[static_cast<std::size_t>(at)] >= 0;) {
    const int index = via[static_cast<std::size_t>(at)];
    way.push_back(index);
    const Edge& edge = edges_[static_cast<std::size_t>(index)];
    at = edge.a == at ? edge.b : edge.a;
  }
  return way;
}

// Checks the parts of a path that are not known yet; stops at the first that is blocked.
bool Roadmap::isFree(const std::vector<int>& way) {
  for (const int index : way) {
    const Edge& edge = edges_[static_cast<std::size_t>(index)];
    for (const int node : {edge.a, edge.b}) {
      Known& known = knownNodes_[static_cast<std::size_t>(node)];
      if (known == Known::kUnchecked)
        known = checker_.isValid(points_.point(node)) ? Known::kFree : Known::kBlocked;
      if (known == Known::kBlocked) return false;
    }
  }
  for (const int index : way) {
    Edge& edge = edges_[static_cast<std::size_t>(index)];
    if (edge.known == Known::kUnchecked) {
      const bool isValid = checker_.isValid(points_.point(edge.a), points_.point(edge.b));
      edge.known = isValid ? Known::kFree : Known::kBlocked;
    }
    if (edge.known == Known::kBlocked) return false;
  }
  return true;
}

PathResult Roadmap::query(const PathProblem& problem) {
  rex::requireSound(problem);
  const long before = checker_.asked();
  const int start = addNode(problem.start, Known::kFree), goal = addNode(problem.goal, Known::kFree);
  join(start);
  join(goal);
  std::vector<int> way = shortestWay(start, goal);
  while (!way.empty() && !isFree(way)) {
    way.clear();
    if (!problem.isTimeUp || !problem.isTimeUp()) way = shortestWay(start, goal);
  }
  PathResult result;
  result.asked = checker_.asked() - before;
  if (way.empty()) {
    result.message = fmt::format("no path in a roadmap of {} nodes and {} edges", nodes(), edges().size());
    return result;
  }
  result.status = PathStatus::kFound;
  result.path.resize(space_.size(), static_cast<Eigen::Index>(way.size()) + 1);
  int at = goal;
  for (Eigen::Index k = result.path.cols() - 1; k >= 0; --k) {
    result.path.col(k) = points_.point(at);
    if (k == 0) break;
    const Edge& edge =
        edges_[static_cast<std::size_t>(way[static_cast<std::size_t>(result.path.cols() - 1 - k)])];
    at = edge.a == at ? edge.b : edge.a;
  }
  result.length = pathLength(space_, result.path);
  result.message = fmt::format("a path over {} nodes of {}, {} configurations checked", result.path.cols(),
                               nodes(), result.asked);
  return result;
}

}  // namespace rex
