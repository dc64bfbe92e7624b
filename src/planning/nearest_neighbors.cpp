#include "planning/nearest_neighbors.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/cpu_lanes.h"
#include "base/error.h"
#include "base/require.h"
#include "planning/neighbor_kernel_internal.h"

namespace rex {
namespace {

using Kind = SpacePart::Kind;

constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr float kEndlessFloat = std::numeric_limits<float>::infinity();
constexpr float kFar = 3e38f;
constexpr int kBlock = 8;  // points, or boxes, side by side
// Of a stack of branches: at most five sixths of a node's points are below one of its children.
constexpr std::size_t kMostOpen = 2048;
constexpr int kGrowth = 3;  // of a subtree until it is rebuilt

const internal::NeighborKernel& neighborKernel() {
  static const auto kernel = kernelFor<internal::NeighborKernel>(cpuLanes());
  return kernel;
}

int blocksOf(int count) { return (count + kBlock - 1) / kBlock; }

// The squared chord between two angles in [-pi, pi].
double squaredChord(const SpacePart& part, double a, double b) {
  const double chord = 2 * part.weight * std::sin((a - b) / 2);
  return chord * chord;
}

std::vector<int> pointsOf(std::vector<Neighbor> neighbors) {
  std::sort(neighbors.begin(), neighbors.end());
  std::vector<int> points;
  for (const Neighbor& neighbor : neighbors) points.push_back(neighbor.point);
  return points;
}

}  // namespace

// A configuration in the scaled coordinates, and bounds of what single precision does to distances from it:
// the square is at most (1 + relative) times that in double precision, plus absolute.
struct NearestNeighbors::Query {
  Eigen::VectorXd x;
  std::vector<float> rounded;
  float largest = 0;
  internal::NeighborParts parts{};
  double relative = 0, absolute = 0;

  // The squared distance in single precision that no point within the squared distance exceeds.
  float widened(double distance2) const {
    const double wide = distance2 * (1 + relative) + absolute;
    return wide < 1e37 ? static_cast<float>(wide * (1 + 1e-6)) : kEndlessFloat;
  }
};

NearestNeighbors::NearestNeighbors(Space space) : space_(std::move(space)) {
  for (const SpacePart& part : space_.parts()) {
    isLine_ = isLine_ && part.kind == Kind::kLine;
    if (part.kind == Kind::kCircle) {
      parts_.push_back({NeighborPart::Kind::kCircle, static_cast<float>(2 * std::numbers::pi * part.weight)});
      largest_ = std::max(largest_, parts_.back().period);
    } else if (part.kind == Kind::kQuaternion) {
      parts_.push_back({NeighborPart::Kind::kQuaternion});
    } else {
      parts_.insert(parts_.end(), part.kind == Kind::kChord ? 2 : 1, {});
    }
    width_ += static_cast<std::size_t>(part.kind == Kind::kChord ? 2 : coordinateCount(part.kind));
  }
  isStraight_ = width_ == parts_.size() && largest_ == 0;
}

// The coordinates times their weights, except for chords; angles are first wrapped to [-pi, pi].
NearestNeighbors::Query NearestNeighbors::scaled(const VectorArg& q) const {
  requireSize("configuration", q.size(), space_.size());
  requireFinite("configuration", q);
  Query query{.x = q, .rounded = std::vector<float>(width_)};
  Eigen::Index i = 0;
  float* rounded = query.rounded.data();
  for (const SpacePart& part : space_.parts()) {
    const bool isAngle = part.kind == Kind::kCircle || part.kind == Kind::kChord;
    double& x = query.x[i];
    if (isAngle && std::abs(x) > std::numbers::pi) x = std::remainder(x, 2 * std::numbers::pi);
    if (part.kind == Kind::kChord) {
      *rounded++ = static_cast<float>(part.weight * std::cos(x));
      *rounded++ = static_cast<float>(part.weight * std::sin(x));
      ++i;
    } else {
      for (const Eigen::Index end = i + coordinateCount(part.kind); i < end; ++i)
        *rounded++ = static_cast<float>(query.x[i] *= part.weight);
    }
  }
  query.largest = largest_;
  for (const float one : query.rounded) query.largest = std::max(query.largest, std::abs(one));
  // Each number is off by 2^-24 of the largest, and so is each sum or difference on a circle. The root of the
  // sum of the squares is off by less than E = 2^-21 largest sqrt(width), and (d + E)^2 <= d^2 (1 + c) +
  // E^2 (1 + 1/c).
  const double width = static_cast<double>(width_), error = 0x1p-21 * query.largest;
  constexpr double kShare = 0x1p-20;
  query.relative = kShare + width * 0x1p-22;
  query.absolute = width * error * error * (1 + 1 / kShare);
  query.parts = {parts_.data(), static_cast<int>(parts_.size()), static_cast<int>(width_), isStraight_};
  return query;
}

// Points in single precision, one after the other.
struct NearestNeighbors::Rows {
  std::vector<float> numbers;
  std::vector<int> points;
};

int NearestNeighbors::newLeaf() {
  if (!freeLeaves_.empty()) {
    const int at = freeLeaves_.back();
    freeLeaves_.pop_back();
    clear(at);
    return at;
  }
  leaves_.emplace_back();
  leafNumbers_.resize(leafNumbers_.size() + kBucket * width_, kFar);
  return ~(static_cast<int>(leaves_.size()) - 1);
}

int NearestNeighbors::newNode() {
  if (!freeNodes_.empty()) {
    const int at = freeNodes_.back();
    freeNodes_.pop_back();
    node(at) = {};
    return at;
  }
  nodes_.emplace_back();
  boxes_.resize(boxes_.size() + 2 * kFan * width_, 0);
  return static_cast<int>(nodes_.size()) - 1;
}

void NearestNeighbors::clear(int at) {
  leaf(at).count = 0;
  std::fill_n(&number(at, 0, 0), kBucket * width_, kFar);
}

// Number k of the point in a slot of a leaf. Empty slots are far away.
float& NearestNeighbors::number(int at, int slot, std::size_t k) {
  const auto block = static_cast<std::size_t>(~at * (kBucket / kBlock) + slot / kBlock);
  return leafNumbers_[(block * width_ + k) * kBlock + static_cast<std::size_t>(slot % kBlock)];
}

// Number k of a child's box: the lower one, or the upper one.
float& NearestNeighbors::bound(int at, int i, std::size_t k, bool isUpper) {
  const auto block = static_cast<std::size_t>(at * (kFan / kBlock) + i / kBlock);
  return boxes_[((2 * block + isUpper) * width_ + k) * kBlock + static_cast<std::size_t>(i % kBlock)];
}

void NearestNeighbors::put(int at, const float* x, int point) {
  Leaf& to = leaf(at);
  for (std::size_t k = 0; k < width_; ++k) number(at, to.count, k) = x[k];
  to.points[static_cast<std::size_t>(to.count++)] = point;
}

void NearestNeighbors::append(int at, int inside) {
  Node& to = node(at);
  to.children[static_cast<std::size_t>(to.count)] = inside;
  enclose(at, to.count++);
}

void NearestNeighbors::extend(int at, int i, const float* x) {
  for (std::size_t k = 0; k < width_; ++k) {
    bound(at, i, k, false) = std::min(bound(at, i, k, false), x[k]);
    bound(at, i, k, true) = std::max(bound(at, i, k, true), x[k]);
  }
}

// Sets the box of a child to what is in it.
void NearestNeighbors::enclose(int at, int i) {
  const int inside = child(at, i);
  const int count = isLeaf(inside) ? leaf(inside).count : node(inside).count;
  for (std::size_t k = 0; k < width_; ++k) {
    float lower = kEndlessFloat, upper = -kEndlessFloat;
    for (int j = 0; j < count; ++j) {
      lower = std::min(lower, isLeaf(inside) ? number(inside, j, k) : bound(inside, j, k, false));
      upper = std::max(upper, isLeaf(inside) ? number(inside, j, k) : bound(inside, j, k, true));
    }
    bound(at, i, k, false) = lower;
    bound(at, i, k, true) = upper;
  }
}

// The nearest child, the first of equals.
int NearestNeighbors::nearestChild(int at, const Query& query) const {
  std::array<float, kFan> distances;
  neighborKernel().ofBoxes(query.parts, boxesOf(at), blocksOf(node(at).count), query.rounded.data(),
                           distances.data());
  return static_cast<int>(std::min_element(distances.begin(), distances.begin() + node(at).count) -
                          distances.begin());
}

// Moves the points below a node or leaf to the end of `rows`.
void NearestNeighbors::takeApart(int at, Rows& rows) {
  if (!isLeaf(at)) {
    for (int i = 0; i < node(at).count; ++i) takeApart(child(at, i), rows);
    freeNodes_.push_back(at);
    return;
  }
  for (int slot = 0; slot < leaf(at).count; ++slot)
    for (std::size_t k = 0; k < width_; ++k) rows.numbers.push_back(number(at, slot, k));
  rows.points.insert(rows.points.end(), leaf(at).points.begin(), leaf(at).points.begin() + leaf(at).count);
  freeLeaves_.push_back(at);
}

// A leaf or node of some rows, with at most `most` leaves below.
int NearestNeighbors::built(const Rows& rows, std::span<int> chosen, std::size_t most) {
  const std::size_t leaves = std::min(most, (chosen.size() + kFill - 1) / kFill);
  if (leaves <= 1) {
    const int at = newLeaf();
    for (const int row : chosen)
      put(at, rows.numbers.data() + static_cast<std::size_t>(row) * width_,
          rows.points[static_cast<std::size_t>(row)]);
    return at;
  }
  const int at = newNode();
  node(at).points = node(at).built = static_cast<int>(chosen.size());
  std::size_t below = 1;
  while (below * kBuiltFan < leaves) below *= kBuiltFan;
  addChildren(at, rows, chosen, (leaves + below - 1) / below, below);
  return at;
}

// Divides the rows across the longest sides of their boxes into children with at most `most` leaves each.
void NearestNeighbors::addChildren(int at, const Rows& rows, std::span<int> chosen, std::size_t children,
                                   std::size_t most) {
  if (children == 1) return append(at, built(rows, chosen, most));
  const auto number = [&](int row, std::size_t k) {
    return rows.numbers[static_cast<std::size_t>(row) * width_ + k];
  };
  std::vector<float> lower(width_, kEndlessFloat), upper(width_, -kEndlessFloat);
  for (const int row : chosen)
    for (std::size_t k = 0; k < width_; ++k) {
      lower[k] = std::min(lower[k], number(row, k));
      upper[k] = std::max(upper[k], number(row, k));
    }
  std::size_t side = 0;
  for (std::size_t k = 1; k < width_; ++k)
    if (upper[k] - lower[k] > upper[side] - lower[side]) side = k;
  const std::size_t left = children / 2, middle = chosen.size() * left / children;
  std::nth_element(
      chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(middle), chosen.end(),
      [&](int a, int b) { return std::pair(number(a, side), a) < std::pair(number(b, side), b); });
  addChildren(at, rows, chosen.first(middle), left, most);
  addChildren(at, rows, chosen.subspan(middle), children - left, most);
}

// The same points in a balanced tree.
int NearestNeighbors::rebuilt(int at) {
  Rows rows;
  takeApart(at, rows);
  std::vector<int> all(rows.points.size());
  std::iota(all.begin(), all.end(), 0);
  return built(rows, all, all.size());
}

// Puts half of the points of a full leaf into another.
void NearestNeighbors::splitLeaf(int at, int i) {
  Rows rows;
  takeApart(child(at, i), rows);
  std::vector<int> all(rows.points.size());
  std::iota(all.begin(), all.end(), 0);
  Node& parent = node(at);
  std::swap(parent.children[static_cast<std::size_t>(i)],
            parent.children[static_cast<std::size_t>(--parent.count)]);
  enclose(at, i);
  addChildren(at, rows, all, 2, 1);
}

int NearestNeighbors::add(const VectorArg& q) {
  const Query query = scaled(q);
  const int point = count();
  points_.insert(points_.end(), q.begin(), q.end());
  scaled_.insert(scaled_.end(), query.x.begin(), query.x.end());
  largest_ = query.largest;
  if (leaves_.empty()) root_ = newLeaf();
  int parent = -1, i = 0;
  const auto replace = [&](int by) {
    return parent < 0 ? root_ = by : node(parent).children[static_cast<std::size_t>(i)] = by;
  };
  int at = root_;
  while (!isLeaf(at) || leaf(at).count == kBucket) {
    if (isLeaf(at)) {
      if (parent < 0 || node(parent).count == kFan) {
        const int between = newNode();
        node(between).points = node(between).built = kBucket;
        append(between, at);
        replace(between);
        parent = between;
        i = 0;
        ++node(parent).points;
      }
      splitLeaf(parent, i);
    } else {
      if (node(at).points >= kGrowth * node(at).built) at = replace(rebuilt(at));
      ++node(at).points;
      parent = at;
    }
    i = nearestChild(parent, query);
    extend(parent, i, query.rounded.data());
    at = child(parent, i);
  }
  put(at, query.rounded.data(), point);
  return point;
}

Eigen::Map<const Eigen::VectorXd> NearestNeighbors::point(int i) const {
  return {points_.data() + static_cast<std::size_t>(i) * size(), space_.size()};
}

// The squared distance of x from a point.
double NearestNeighbors::distance2(const double* x, int point) const {
  const double* y = scaled_.data() + static_cast<std::size_t>(point) * size();
  double sum = 0;
  if (isLine_) {
    for (std::size_t i = 0; i < size(); ++i) sum += (x[i] - y[i]) * (x[i] - y[i]);
    return sum;
  }
  for (const SpacePart& part : space_.parts()) {
    if (part.kind == Kind::kQuaternion) {
      double same = 0, opposite = 0;
      for (int k = 0; k < 4; ++k) {
        same += (x[k] - y[k]) * (x[k] - y[k]);
        opposite += (x[k] + y[k]) * (x[k] + y[k]);
      }
      sum += std::min(same, opposite);
    } else if (part.kind == Kind::kChord) {
      sum += squaredChord(part, *x, *y);
    } else {
      const double gap = std::abs(*x - *y);
      const double way =
          part.kind == Kind::kCircle ? std::min(gap, 2 * std::numbers::pi * part.weight - gap) : gap;
      sum += way * way;
    }
    x += coordinateCount(part.kind);
    y += coordinateCount(part.kind);
  }
  return sum;
}

// Calls visit(squared distance, point) for the points of a leaf within reach; each call returns the new
// reach.
template <class Visit>
void NearestNeighbors::searchLeaf(int at, const Query& query, bool isForOne, double& reach2, float& reach,
                                  const Visit& visit) const {
  const Leaf& from = leaf(at);
  const int blocks = blocksOf(from.count);
  std::array<float, kBucket> distances;
  const float least =
      neighborKernel().ofPoints(query.parts, numbersOf(at), blocks, query.rounded.data(), distances.data());
  if (least > reach) return;
  // Points that single precision cannot confuse with the nearest of the leaf are farther than it.
  const float narrow = isForOne ? std::min(reach, query.widened(query.widened(least))) : reach;
  auto near = neighborKernel().within(distances.data(), blocks, narrow) & ~0ull >> (64 - from.count);
  for (; near != 0; near &= near - 1) {
    const int point = from.points[static_cast<std::size_t>(std::countr_zero(near))];
    const double exact = distance2(query.x.data(), point);
    if (exact > reach2) continue;
    reach2 = visit(exact, point);
    reach = query.widened(reach2);
  }
}

// Calls visit(squared distance, point) for all points that may be within the squared distance that it
// returned last, near branches first. If it is for one point, those farther than others may be left out.
template <class Visit>
void NearestNeighbors::search(const Query& query, double reach2, bool isForOne, const Visit& visit) const {
  if (leaves_.empty()) return;
  struct Branch {
    float bound;  // of squared distances
    int at;
  };
  std::array<Branch, kMostOpen> open;
  std::size_t count = 0;
  open[count++] = {0, root_};
  float reach = query.widened(reach2);
  while (count > 0) {
    const Branch branch = open[--count];
    if (branch.bound > reach) continue;
    if (isLeaf(branch.at)) {
      searchLeaf(branch.at, query, isForOne, reach2, reach, visit);
      continue;
    }
    const Node& from = node(branch.at);
    std::array<float, kFan> distances;
    neighborKernel().ofBoxes(query.parts, boxesOf(branch.at), blocksOf(from.count), query.rounded.data(),
                             distances.data());
    const std::size_t first = count;
    for (std::size_t i = 0; i < static_cast<std::size_t>(from.count); ++i) {
      if (distances[i] > reach) continue;
      std::size_t slot = count++;
      for (; slot > first && open[slot - 1].bound < distances[i]; --slot) open[slot] = open[slot - 1];
      open[slot] = {distances[i], from.children[i]};
    }
  }
}

int NearestNeighbors::nearest(const VectorArg& q) const {
  const Query query = scaled(q);
  if (count() == 0)
    throw Error({.what = "nearest neighbour", .found = "no points", .wanted = "at least one"});
  Neighbor best{kEndless, 0};
  search(query, best.distance, true, [&](double distance2, int point) {
    best = std::min(best, {distance2, point});
    return best.distance;
  });
  return best.point;
}

std::vector<int> NearestNeighbors::nearest(const VectorArg& q, int most) const {
  const Query query = scaled(q);
  std::vector<Neighbor> heap;
  const auto limit = static_cast<std::size_t>(std::max(0, most));
  if (limit == 0) return {};
  search(query, kEndless, false, [&](double distance2, int point) {
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
  const Query query = scaled(q);
  requireNotNegativeOrInfinite("radius around a configuration", radius);
  out.clear();
  search(query, radius * radius, false, [&](double distance2, int point) {
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
