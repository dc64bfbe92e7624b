#include "planning/nearest_neighbors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

using Kind = SpacePart::Kind;
constexpr std::size_t kUsualDepth = 64;  // of a search; deeper ones take more memory

constexpr double kEndless = std::numeric_limits<double>::infinity();

// The squared chord between two angles in [-pi, pi].
double squaredChord(const SpacePart& part, double a, double b) {
  const double chord = 2 * part.weight * std::sin((a - b) / 2);
  return chord * chord;
}

// The squared distance of x from an interval on a line that closes up after `period`.
double squaredGap(double x, double lower, double upper, double period = kEndless) {
  const double gap = std::max({lower - x, x - upper, 0.});
  const double shorter = std::min(gap, period - (upper - lower) - gap);
  return shorter * shorter;
}

// Adds the squared distances of x from points on such a line.
template <class Lanes>
inline void addSquaredGaps(double x, const double* points, double period, Lanes& sum) {
  const Lanes gap = x - Lanes::Map(points);
  if (period < kEndless)
    sum += gap.abs().min(period - gap.abs()).square();
  else
    sum += gap.square();
}

std::vector<int> pointsOf(std::vector<Neighbor> neighbors) {
  std::sort(neighbors.begin(), neighbors.end());
  std::vector<int> points;
  for (const Neighbor& neighbor : neighbors) points.push_back(neighbor.point);
  return points;
}

}  // namespace

NearestNeighbors::NearestNeighbors(Space space) : space_(std::move(space)), isFlat_(true) {
  for (const SpacePart& part : space_.parts()) {
    isFlat_ = isFlat_ && (part.kind == Kind::kLine || part.kind == Kind::kCircle);
    periods_.push_back(part.kind == Kind::kCircle ? 2 * std::numbers::pi * part.weight : kEndless);
  }
}

// The coordinates times their weights, except for chords; angles are first wrapped to [-pi, pi].
Eigen::VectorXd NearestNeighbors::scaled(const VectorArg& q) const {
  requireSize("configuration", q.size(), space_.size());
  requireFinite("configuration", q);
  Eigen::VectorXd x = q;
  Eigen::Index i = 0;
  for (const SpacePart& part : space_.parts()) {
    const int count = sizeOf(part.kind);
    const bool isAngle = part.kind == Kind::kCircle || part.kind == Kind::kChord;
    if (isAngle && std::abs(x[i]) > std::numbers::pi) x[i] = std::remainder(x[i], 2 * std::numbers::pi);
    if (part.kind != Kind::kChord) x.segment(i, count) *= part.weight;
    i += count;
  }
  return x;
}

int NearestNeighbors::newLeaf() {
  nodes_.push_back({.bucket = static_cast<int>(buckets_.size())});
  buckets_.push_back({std::vector<double>(size() * kBucket), {}});
  boxes_.insert(boxes_.end(), size(), kEndless);
  boxes_.insert(boxes_.end(), size(), -kEndless);
  return static_cast<int>(nodes_.size()) - 1;
}

void NearestNeighbors::put(int leaf, const double* x, int point) {
  Bucket& bucket = buckets_[static_cast<std::size_t>(node(leaf).bucket)];
  const std::size_t slot = bucket.points.size();
  for (std::size_t i = 0; i < size(); ++i) bucket.numbers[place(i, slot)] = x[i];
  bucket.points.push_back(point);
}

void NearestNeighbors::grow(int at, const double* x) {
  ++node(at).count;
  double* lower = box(at);
  for (std::size_t i = 0; i < size(); ++i) {
    lower[i] = std::min(lower[i], x[i]);
    lower[size() + i] = std::max(lower[size() + i], x[i]);
  }
}

// The branch whose box has to grow less; if both are equal, the one with fewer points.
int NearestNeighbors::branchFor(const Node& at, const double* x) const {
  const auto growth = [&](int branch) {
    const double *lower = box(branch), *upper = lower + size();
    double sum = 0;
    for (std::size_t i = 0; i < size(); ++i) sum += std::max({lower[i] - x[i], x[i] - upper[i], 0.});
    return sum;
  };
  const double left = growth(at.left), right = growth(at.right);
  if (left != right) return left < right ? at.left : at.right;
  return node(at.left).count <= node(at.right).count ? at.left : at.right;
}

// Halves a full leaf across the side on which its box is longest.
void NearestNeighbors::split(int at) {
  const double *lower = box(at), *upper = lower + size();
  std::size_t longest = 0;
  for (std::size_t i = 1; i < size(); ++i)
    if (upper[i] - lower[i] > upper[longest] - lower[longest]) longest = i;
  const Bucket full = std::exchange(buckets_[static_cast<std::size_t>(node(at).bucket)], Bucket{});
  std::array<int, kBucket> order;
  for (int k = 0; k < kBucket; ++k) order[static_cast<std::size_t>(k)] = k;
  const auto key = [&](int k) {
    return std::pair(full.numbers[place(longest, static_cast<std::size_t>(k))], k);
  };
  std::nth_element(order.begin(), order.begin() + kBucket / 2, order.end(),
                   [&](int a, int b) { return key(a) < key(b); });
  const int left = newLeaf(), right = newLeaf();
  Eigen::VectorXd x(space_.size());
  for (int k = 0; k < kBucket; ++k) {
    const auto slot = static_cast<std::size_t>(order[static_cast<std::size_t>(k)]);
    for (std::size_t i = 0; i < size(); ++i) x[static_cast<Eigen::Index>(i)] = full.numbers[place(i, slot)];
    const int leaf = k < kBucket / 2 ? left : right;
    grow(leaf, x.data());
    put(leaf, x.data(), full.points[slot]);
  }
  node(at).left = left;
  node(at).right = right;
}

int NearestNeighbors::add(const VectorArg& q) {
  const Eigen::VectorXd x = scaled(q);
  const int point = count();
  points_.insert(points_.end(), q.begin(), q.end());
  if (nodes_.empty()) newLeaf();
  int at = 0;
  for (grow(at, x.data()); !isLeaf(at) || isFull(at); grow(at, x.data())) {
    if (isLeaf(at)) split(at);
    at = branchFor(node(at), x.data());
  }
  put(at, x.data(), point);
  return point;
}

Eigen::Map<const Eigen::VectorXd> NearestNeighbors::point(int i) const {
  return {points_.data() + static_cast<std::size_t>(i) * size(), space_.size()};
}

// The squared distance of x from the box of a node: at most that from any point below it.
double NearestNeighbors::boxDistance2(int at, const double* x) const {
  const double *lower = box(at), *upper = lower + size();
  double sum = 0;
  if (isFlat_) {
    for (std::size_t i = 0; i < size(); ++i) sum += squaredGap(x[i], lower[i], upper[i], periods_[i]);
    return sum;
  }
  std::size_t i = 0;
  for (std::size_t p = 0; p < periods_.size(); ++p) {
    const SpacePart& part = space_.parts()[p];
    if (part.kind == Kind::kQuaternion) {
      double same = 0, opposite = 0;
      for (std::size_t k = i; k < i + 4; ++k) {
        same += squaredGap(x[k], lower[k], upper[k]);
        opposite += squaredGap(-x[k], lower[k], upper[k]);
      }
      sum += std::min(same, opposite);
    } else if (part.kind != Kind::kChord) {
      sum += squaredGap(x[i], lower[i], upper[i], periods_[p]);
    } else if (x[i] < lower[i] || x[i] > upper[i]) {
      sum += std::min(squaredChord(part, x[i], lower[i]), squaredChord(part, x[i], upper[i]));
    }
    i += static_cast<std::size_t>(sizeOf(part.kind));
  }
  return sum;
}

// Writes the squared distances of x from the points of a chunk. Returns the smallest, or less: unused entries
// are zeros, not points.
double NearestNeighbors::chunkDistances2(const double* numbers, const double* x, double* distances) const {
  using Lanes = Eigen::Array<double, kChunk, 1>;
  const auto lanes = [numbers](std::size_t i) { return Lanes::Map(numbers + i * kChunk); };
  Lanes sum = Lanes::Zero();
  if (isFlat_) {
    for (std::size_t i = 0; i < size(); ++i) addSquaredGaps(x[i], numbers + i * kChunk, periods_[i], sum);
    Lanes::Map(distances) = sum;
    return sum.minCoeff();
  }
  std::size_t i = 0;
  for (std::size_t p = 0; p < periods_.size(); ++p) {
    const SpacePart& part = space_.parts()[p];
    if (part.kind == Kind::kQuaternion) {
      Lanes same = Lanes::Zero(), opposite = Lanes::Zero();
      for (std::size_t k = i; k < i + 4; ++k) {
        same += (x[k] - lanes(k)).square();
        opposite += (x[k] + lanes(k)).square();
      }
      sum += same.min(opposite);
    } else if (part.kind != Kind::kChord) {
      addSquaredGaps(x[i], numbers + i * kChunk, periods_[p], sum);
    } else {
      for (int k = 0; k < kChunk; ++k) sum[k] += squaredChord(part, x[i], lanes(i)[k]);
    }
    i += static_cast<std::size_t>(sizeOf(part.kind));
  }
  Lanes::Map(distances) = sum;
  return sum.minCoeff();
}

// Calls visit(squared distance, point) for the points of a leaf within reach; each call returns the new
// reach.
template <class Visit>
void NearestNeighbors::searchLeaf(int leaf, const double* x, double& reach2, const Visit& visit) const {
  const Bucket& bucket = buckets_[static_cast<std::size_t>(node(leaf).bucket)];
  std::array<double, kChunk> distances;
  for (std::size_t first = 0; first < bucket.points.size(); first += kChunk) {
    if (chunkDistances2(bucket.numbers.data() + first * size(), x, distances.data()) > reach2) continue;
    const std::size_t count = std::min<std::size_t>(kChunk, bucket.points.size() - first);
    for (std::size_t k = 0; k < count; ++k)
      if (distances[k] <= reach2) reach2 = visit(distances[k], bucket.points[first + k]);
  }
}

// Calls visit(squared distance, point) for all points that may be within the squared distance that it
// returned last, near branches first.
template <class Visit>
void NearestNeighbors::search(const double* x, double reach2, const Visit& visit) const {
  if (nodes_.empty()) return;
  struct Branch {
    double bound;  // of squared distances
    int node;
  };
  std::vector<Branch> open;  // postponed
  Branch at{0, 0};
  for (;;) {
    while (!isLeaf(at.node)) {
      Branch near{boxDistance2(node(at.node).left, x), node(at.node).left};
      Branch far{boxDistance2(node(at.node).right, x), node(at.node).right};
      if (far.bound < near.bound) std::swap(near, far);
      if (open.empty()) open.reserve(kUsualDepth);
      if (far.bound <= reach2) open.push_back(far);
      at = near;
    }
    if (at.bound <= reach2) searchLeaf(at.node, x, reach2, visit);
    while (!open.empty() && open.back().bound > reach2) open.pop_back();
    if (open.empty()) return;
    at = open.back();
    open.pop_back();
  }
}

int NearestNeighbors::nearest(const VectorArg& q) const {
  const Eigen::VectorXd x = scaled(q);
  if (count() == 0)
    throw Error({.what = "nearest neighbour", .found = "no points", .wanted = "at least one"});
  Neighbor best{kEndless, 0};
  search(x.data(), best.distance, [&](double distance2, int point) {
    best = std::min(best, {distance2, point});
    return best.distance;
  });
  return best.point;
}

std::vector<int> NearestNeighbors::nearest(const VectorArg& q, int most) const {
  const Eigen::VectorXd x = scaled(q);
  std::vector<Neighbor> heap;
  const auto limit = static_cast<std::size_t>(std::max(0, most));
  if (limit == 0) return {};
  search(x.data(), kEndless, [&](double distance2, int point) {
    heap.push_back({distance2, point});
    std::push_heap(heap.begin(), heap.end());
    if (heap.size() > limit) {
      std::pop_heap(heap.begin(), heap.end());
      heap.pop_back();
    }
    return heap.size() < limit ? kEndless : heap.front().distance;
  });
  return pointsOf(std::move(heap));
}

void NearestNeighbors::within(const VectorArg& q, double radius, std::vector<Neighbor>& out) const {
  const Eigen::VectorXd x = scaled(q);
  requireNotNegativeOrInfinite("radius around a configuration", radius);
  out.clear();
  search(x.data(), radius * radius, [&](double distance2, int point) {
    out.push_back({std::sqrt(distance2), point});
    return radius * radius;
  });
}

std::vector<int> NearestNeighbors::within(const VectorArg& q, double radius) const {
  std::vector<Neighbor> found;
  within(q, radius, found);
  return pointsOf(std::move(found));
}

}  // namespace rex
