#pragma once

#include <array>
#include <compare>
#include <span>
#include <vector>

#include "planning/neighbor_part.h"
#include "planning/space.h"

namespace rex {

/// The number of a point and its distance in the metric of the space.
struct Neighbor {
  double distance;
  int point;
  auto operator<=>(const Neighbor&) const = default;
};

/// Finds the nearest configurations of a tree or roadmap. Points are added one at a time to a tree of
/// bounding boxes that splits where they gather (Guttman 1984); a query among n points takes time like log n
/// in few dimensions. Eight boxes or points at once are compared in single precision, and in double precision
/// those that may be nearest. Results equal those of an exhaustive search; among equally near points the
/// first added comes first.
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
  // A leaf has up to kBucket points and the number ~k, another node up to kFan children and the number k.
  // Numbers lie in blocks of eight points or boxes, as the kernel wants them. Full leaves are split; a
  // subtree that has grown threefold is rebuilt, with kFill points in a leaf and kBuiltFan children.
  static constexpr int kBucket = 32, kFill = 28, kFan = 16, kBuiltFan = 8;
  struct Leaf {
    int count = 0;
    std::array<int, kBucket> points;
  };
  struct Node {
    int count = 0, points = 0,
        built = 0;  // children; points below, and how many there were when it was built
    std::array<int, kFan> children;
  };
  struct Query;
  struct Rows;

  std::size_t size() const { return static_cast<std::size_t>(space_.size()); }
  static bool isLeaf(int at) { return at < 0; }
  Leaf& leaf(int at) { return leaves_[static_cast<std::size_t>(~at)]; }
  const Leaf& leaf(int at) const { return leaves_[static_cast<std::size_t>(~at)]; }
  Node& node(int at) { return nodes_[static_cast<std::size_t>(at)]; }
  const Node& node(int at) const { return nodes_[static_cast<std::size_t>(at)]; }
  int child(int at, int i) const { return node(at).children[static_cast<std::size_t>(i)]; }
  const float* numbersOf(int leaf) const {
    return leafNumbers_.data() + static_cast<std::size_t>(~leaf) * kBucket * width_;
  }
  const float* boxesOf(int node) const {
    return boxes_.data() + static_cast<std::size_t>(node) * 2 * kFan * width_;
  }

  [[nodiscard]] Query scaled(const VectorArg& q) const;
  double distance2(const double* x, int point) const;
  int newLeaf();
  int newNode();
  void clear(int leaf);
  float& number(int leaf, int slot, std::size_t k);
  float& bound(int node, int i, std::size_t k, bool isUpper);
  void put(int leaf, const float* x, int point);
  void append(int node, int inside);
  void extend(int node, int i, const float* x);
  void enclose(int node, int i);
  int nearestChild(int node, const Query& query) const;
  void takeApart(int at, Rows& rows);
  int built(const Rows& rows, std::span<int> chosen, std::size_t most);
  void addChildren(int node, const Rows& rows, std::span<int> chosen, std::size_t children, std::size_t most);
  int rebuilt(int node);
  void splitLeaf(int node, int i);
  template <class Visit>
  void searchLeaf(int at, const Query& query, bool isForOne, double& reach2, float& reach,
                  const Visit& visit) const;
  template <class Visit>
  void search(const Query& query, double reach2, bool isForOne, const Visit& visit) const;

  Space space_;
  bool isLine_ = true;               // all parts are lines
  bool isStraight_ = true;           // those in single precision are
  std::vector<NeighborPart> parts_;  // in single precision
  std::size_t width_ = 0;            // numbers of a point in single precision
  float largest_ = 0;                // of these numbers and periods
  std::vector<double> points_;       // as added
  std::vector<double> scaled_;
  int root_ = -1;
  std::vector<Leaf> leaves_;
  std::vector<float> leafNumbers_;
  std::vector<Node> nodes_;
  std::vector<float> boxes_;
  std::vector<int> freeLeaves_, freeNodes_;
};

}  // namespace rex
