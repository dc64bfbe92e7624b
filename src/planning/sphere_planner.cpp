#include "planning/sphere_planner.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "planning/samplers.h"
#include "planning/sphere_world_internal.h"

namespace rex {
namespace {

using internal::SphereCount;
using internal::SphereKernel;
using PostureF = Eigen::VectorXf;

// Nodes of a tree, in blocks of eight for the search of the nearest.
class SphereTree {
 public:
  SphereTree(const SphereKernel& kernel, const PostureF& root) : kernel_(kernel), n_(root.size()) {
    add(root, -1);
  }

  int size() const { return static_cast<int>(parents_.size()); }
  int parent(int i) const { return parents_[static_cast<std::size_t>(i)]; }
  void get(int i, PostureF& q) const {
    for (Eigen::Index j = 0; j < n_; ++j) q[j] = points_[place(i, j)];
  }
  int add(const PostureF& q, int parent) {
    constexpr float kFarAway = 1e15f;
    const int i = size();
    if (i % 8 == 0) points_.resize(points_.size() + static_cast<std::size_t>(8 * n_), kFarAway);
    for (Eigen::Index j = 0; j < n_; ++j) points_[place(i, j)] = q[j];
    parents_.push_back(parent);
    return i;
  }
  int nearest(const PostureF& q, float& distance) const {
    const int found = kernel_.nearest(points_.data(), size(), static_cast<int>(n_), q.data(), distance);
    distance = std::sqrt(distance);
    return found;
  }

 private:
  std::size_t place(int i, Eigen::Index j) const {
    return static_cast<std::size_t>((i / 8 * n_ + j) * 8 + i % 8);
  }

  const SphereKernel& kernel_;
  Eigen::Index n_;
  std::vector<float> points_;
  std::vector<int> parents_;
};

// The branch from the root to a node.
std::vector<PostureF> branchTo(const SphereTree& tree, int node, Eigen::Index n) {
  std::vector<PostureF> postures;
  for (PostureF q(n); node >= 0; node = tree.parent(node)) {
    tree.get(node, q);
    postures.push_back(q);
  }
  std::reverse(postures.begin(), postures.end());
  return postures;
}

class SphereSearch {
 public:
  SphereSearch(const SphereWorld::Data& world, const VectorArg& start, const VectorArg& goal)
      : world_(world),
        start_(start.cast<float>()),
        goal_(goal.cast<float>()),
        lower_(world.robot.lowerLimits().cast<float>()),
        width_((world.robot.upperLimits() - world.robot.lowerLimits()).cast<float>()) {}

  // Tries again and again until so many blocks are checked; the path from start to goal, or none.
  std::vector<PostureF> run(Halton& halton, float range, long blocks) {
    if (isFree(start_, goal_)) return {start_, goal_};
    constexpr float kRanges[] = {1, 0.5f, 2};
    // Steps so short that every target is too far check nothing: then no other target would do.
    long checked = 0;
    for (std::size_t i = 0, idle = 0; count_.blocks < blocks && idle < std::size(kRanges); ++i) {
      idle = count_.blocks == checked ? idle + 1 : 0;
      checked = count_.blocks;
      const long all = std::min(blocks, count_.blocks + kFirstTry * static_cast<long>(i + 1));
      std::vector<PostureF> path = grow(halton, range * kRanges[i % std::size(kRanges)], all);
      if (!path.empty()) return path;
    }
    return {};
  }

  long blocks() const { return count_.blocks; }
  int samples() const { return samples_; }

 private:
  static constexpr long kFirstTry = 4000;  // blocks
  // Farther from the tree than so many steps, targets pull only at its rim.
  static constexpr float kFarthest = 5;

  bool isFree(const PostureF& from, const PostureF& to) {
    return world_.kernel.isFree(world_.scene, from.data(), to.data(), count_);
  }

  // Grows trees until they meet, or so many blocks are checked.
  std::vector<PostureF> grow(Halton& halton, float range, long blocks) {
    SphereTree trees[2] = {{world_.kernel, start_}, {world_.kernel, goal_}};
    PostureF target(start_.size()), near(start_.size());
    for (int far = 0; count_.blocks < blocks && far < kMostFarInARow; ++samples_) {
      const int side = trees[0].size() <= trees[1].size() ? 0 : 1;
      halton.next(target);
      target = lower_ + target.cwiseProduct(width_);
      float distance;
      const int nearest = trees[side].nearest(target, distance);
      ++far;
      if (distance > kFarthest * range) continue;
      far = 0;
      trees[side].get(nearest, near);
      if (distance > range) target = near + (target - near) * (range / distance);
      if (!isFree(near, target)) continue;
      const int node = trees[side].add(target, nearest);
      const int met = connect(trees[1 - side], target, range);
      if (met < 0) continue;
      std::vector<PostureF> path = branchTo(trees[0], side == 0 ? node : met, start_.size());
      const std::vector<PostureF> rest = branchTo(trees[1], side == 0 ? met : node, start_.size());
      path.insert(path.end(), rest.rbegin(), rest.rend());
      return path;
    }
    return {};
  }

  // Grows the tree to the target in steps; its node next to the target if it gets there, otherwise -1.
  int connect(SphereTree& tree, const PostureF& target, float range) {
    float distance;
    int at = tree.nearest(target, distance);
    PostureF from(target.size());
    tree.get(at, from);
    const int steps = std::max(1, static_cast<int>(std::ceil(distance / range)));
    const PostureF step = (target - from) / static_cast<float>(steps);
    for (int i = 1; i <= steps; ++i) {
      const PostureF to = i < steps ? PostureF(from + step) : target;
      if (!isFree(from, to)) return -1;
      if (i < steps) at = tree.add(to, at);
      from = to;
    }
    return at;
  }

  static constexpr int kMostFarInARow = 10000;

  const SphereWorld::Data& world_;
  PostureF start_, goal_, lower_, width_;
  SphereCount count_;
  int samples_ = 0;
};

// Shortens a path in place.
class Shortening {
 public:
  Shortening(const SphereWorld::Data& world, std::vector<PostureF>& path) : world_(world), path_(path) {}

  void run() {
    constexpr int kRounds = 60, kMostFailures = 15;
    leaveOut();
    Halton halton(2);
    int failures = 0;
    for (int i = 0; i < kRounds && failures < kMostFailures && path_.size() > 2; ++i) {
      Eigen::Vector2f ways;
      halton.next(ways);
      failures = goStraight(ways.minCoeff(), ways.maxCoeff()) ? 0 : failures + 1;
    }
    leaveOut();
  }

 private:
  struct Point {
    std::size_t segment;
    PostureF q;
  };

  bool isFree(const PostureF& from, const PostureF& to) {
    return world_.kernel.isFree(world_.scene, from.data(), to.data(), count_);
  }

  // Goes straight from each posture to the last one that can be reached.
  void leaveOut() {
    for (std::size_t i = 0; i + 2 < path_.size(); ++i) {
      std::size_t j = path_.size() - 1;
      while (j > i + 1 && !isFree(path_[i], path_[j])) --j;
      erase(i + 1, j);
    }
  }

  // Goes straight between two points of the path, as fractions of its length.
  bool goStraight(float from, float to) {
    lengths_.clear();
    float length = 0;
    for (std::size_t i = 1; i < path_.size(); ++i)
      lengths_.push_back(length += (path_[i] - path_[i - 1]).norm());
    const Point a = pointAt(from * length), b = pointAt(to * length);
    if (a.segment == b.segment || !isFree(a.q, b.q)) return false;
    path_[a.segment + 1] = a.q;
    if (b.segment == a.segment + 1) {
      path_.insert(path_.begin() + static_cast<std::ptrdiff_t>(a.segment + 2), b.q);
    } else {
      path_[b.segment] = b.q;
      erase(a.segment + 2, b.segment);
    }
    return true;
  }

  void erase(std::size_t first, std::size_t end) {
    path_.erase(path_.begin() + static_cast<std::ptrdiff_t>(first),
                path_.begin() + static_cast<std::ptrdiff_t>(end));
  }

  Point pointAt(float way) const {
    const std::size_t i = static_cast<std::size_t>(
        std::lower_bound(lengths_.begin(), lengths_.end() - 1, way) - lengths_.begin());
    const float before = i == 0 ? 0 : lengths_[i - 1];
    const float fraction = std::clamp((way - before) / std::max(lengths_[i] - before, 1e-9f), 0.0f, 1.0f);
    return {i, path_[i] + fraction * (path_[i + 1] - path_[i])};
  }

  const SphereWorld::Data& world_;
  std::vector<PostureF>& path_;
  std::vector<float> lengths_;  // from the start to the end of each segment
  SphereCount count_;
};

Eigen::MatrixXd withEnds(const std::vector<PostureF>& path, const VectorArg& start, const VectorArg& goal) {
  Eigen::MatrixXd result(start.size(), static_cast<Eigen::Index>(path.size()));
  for (std::size_t i = 0; i < path.size(); ++i)
    result.col(static_cast<Eigen::Index>(i)) = path[i].cast<double>();
  result.col(0) = start;
  result.col(result.cols() - 1) = goal;
  return result;
}

void requireFree(const SphereWorld& world, const Space& space, const char* what, const VectorArg& q) {
  space.require(what, q);
  if (!world.isFree(q))
    throw Error(
        {.what = what,
         .found = fmt::format("a posture in which shapes overlap or are nearer than {:.2g} m", world.slack()),
         .wanted = "a free one"});
}

}  // namespace

PathResult planSpheres(const SphereWorld& world, const VectorArg& start, const VectorArg& goal,
                       const SpherePlanOptions& options) {
  requirePositive("range", options.range);
  requireCount("first point", options.firstPoint, 1);
  requireCount("budget", options.budget, 1);
  const SphereRobot& robot = world.data().robot;
  const Space space = Space::box(robot.lowerLimits(), robot.upperLimits());
  requireFree(world, space, "start", start);
  requireFree(world, space, "goal", goal);
  SphereSearch search(world.data(), start, goal);
  Halton halton(robot.nq(), options.firstPoint);
  const std::vector<PostureF> path =
      search.run(halton, static_cast<float>(options.range), options.budget / 8);
  PathResult result{.samples = search.samples(), .asked = 8 * search.blocks()};
  if (path.empty()) {
    result.message = fmt::format("no path was found within {} postures", options.budget);
    return result;
  }
  result.status = PathStatus::kFound;
  result.path = withEnds(path, start, goal);
  result.length = pathLength(space, result.path);
  return result;
}

Eigen::MatrixXd shortenPath(const SphereWorld& world, const MatrixArg& path) {
  requireSize("postures of a path", path.rows(), world.data().scene.coordinates);
  if (path.cols() < 2)
    throw Error({.what = "path", .found = fmt::format("{} postures", path.cols()), .wanted = "at least two"});
  std::vector<PostureF> postures;
  for (Eigen::Index k = 0; k < path.cols(); ++k) postures.push_back(path.col(k).cast<float>());
  Shortening(world.data(), postures).run();
  return withEnds(postures, path.col(0), path.col(path.cols() - 1));
}

}  // namespace rex
