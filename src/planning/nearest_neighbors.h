#pragma once

#include <compare>
#include <vector>

#include "planning/space.h"

namespace rex {

/// The number of a point and its distance in the metric of the space.
struct Neighbor {
  double distance;
  int point;
  auto operator<=>(const Neighbor&) const = default;
};

/// Finds the nearest configurations of a tree or roadmap. Points are added one at a time to a k-d tree with
/// bounding boxes that splits where they gather (Friedman, Bentley and Finkel 1977); a query among n points
/// takes time like log n in few dimensions. Results equal those of an exhaustive search; among equally near
/// points the first added comes first.
class NearestNeighbors {
 public:
  explicit NearestNeighbors(Space space);

  int count() const { return static_cast<int>(points_.size() / size()); }
  /// Numbers of the points: 0, 1, 2, ... in the order they are added. Throws Error for a wrong size or
  /// numbers that are not finite, saying which.
  int add(const VectorArg& q);
  /// Point i, valid until the next add().
  [[nodiscard]] Eigen::Map<const Eigen::VectorXd> point(int i) const;

  /// The nearest point. Throws Error if there is none, and like add().
  [[nodiscard]] int nearest(const VectorArg& q) const;
  /// The `most` nearest points, or all if there are fewer, nearest first; none for most <= 0. Throws like
  /// add().
  [[nodiscard]] std::vector<int> nearest(const VectorArg& q, int most) const;
  /// All points at most `radius` away, nearest first. Throws like add(), and for a radius that is negative
  /// or not a number.
  [[nodiscard]] std::vector<int> within(const VectorArg& q, double radius) const;
  /// The same into the caller's storage, in unspecified order.
  void within(const VectorArg& q, double radius, std::vector<Neighbor>& out) const;

 private:
  // A leaf holds up to kBucket points, any other node two nodes. Distances are computed for kChunk points
  // at once.
  static constexpr int kBucket = 64, kChunk = 8;
  struct Node {
    int left = -1, right = -1;  // a leaf has none
    int count = 0;              // points below
    int bucket = -1;            // of a leaf
  };
  struct Bucket {
    std::vector<double> numbers;  // chunk after chunk: number i of point k of a chunk at [i * kChunk + k]
    std::vector<int> points;
  };

  Node& node(int i) { return nodes_[static_cast<std::size_t>(i)]; }
  const Node& node(int i) const { return nodes_[static_cast<std::size_t>(i)]; }
  double* box(int i) { return boxes_.data() + 2 * static_cast<std::size_t>(i) * size(); }
  const double* box(int i) const { return boxes_.data() + 2 * static_cast<std::size_t>(i) * size(); }
  std::size_t size() const { return static_cast<std::size_t>(space_.size()); }
  bool isLeaf(int i) const { return node(i).left < 0; }
  std::size_t place(std::size_t i, std::size_t slot) const {
    return (slot / kChunk * size() + i) * kChunk + slot % kChunk;
  }
  bool isFull(int i) const { return node(i).count > kBucket; }

  [[nodiscard]] Eigen::VectorXd scaled(const VectorArg& q) const;
  int newLeaf();
  void put(int leaf, const double* x, int point);
  void grow(int at, const double* x);
  int branchFor(const Node& at, const double* x) const;
  void split(int at);
  double boxDistance2(int at, const double* x) const;
  double chunkDistances2(const double* numbers, const double* x, double* distances) const;
  template <class Visit>
  void searchLeaf(int leaf, const double* x, double& reach2, const Visit& visit) const;
  template <class Visit>
  void search(const double* x, double reach2, const Visit& visit) const;

  Space space_;
  bool isFlat_;                  // all parts are lines or circles
  std::vector<double> periods_;  // of the scaled circle of each part; infinite for other parts
  std::vector<double> points_;   // as added
  std::vector<double> boxes_;    // lower corners, then upper ones, of each node's scaled points
  std::vector<Node> nodes_;
  std::vector<Bucket> buckets_;
};

}  // namespace rex
