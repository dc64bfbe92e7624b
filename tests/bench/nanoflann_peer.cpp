#include "bench/nanoflann_peer.h"

#include <memory>
#include <stdexcept>

#include <nanoflann.hpp>

namespace rex::bench {
namespace {

// Points as nanoflann asks for them.
template <int kDimension>
struct Cloud {
  Eigen::Matrix<double, kDimension, Eigen::Dynamic> points;
  std::size_t count = 0;
  Cloud(const Eigen::MatrixXd& all, std::size_t known) : points(all), count(known) {}
  std::size_t kdtree_get_point_count() const { return count; }
  double kdtree_get_pt(std::size_t point, std::size_t i) const {
    return points(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(point));
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
template <class T>
int nearestIn(const T& tree, const double* question) {
  std::size_t found = 0;
  double squared = 0;
  nanoflann::KNNResultSet<double> result(1);
  result.init(&found, &squared);
  tree.findNeighbors(result, question, nanoflann::SearchParams());
  return static_cast<int>(found);
}

template <int kDimension>
NeighborPeer peerOf(const Eigen::MatrixXd& points, const Eigen::MatrixXd& questions) {
  using Metric = nanoflann::L2_Simple_Adaptor<double, Cloud<kDimension>>;
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<Metric, Cloud<kDimension>, kDimension>;
  using GrowingTree = nanoflann::KDTreeSingleIndexDynamicAdaptor<Metric, Cloud<kDimension>, kDimension>;
  const auto count = static_cast<std::size_t>(points.cols());
  const auto cloud = std::make_shared<const Cloud<kDimension>>(points, count);
  const auto tree = std::make_shared<Tree>(kDimension, *cloud);
  tree->buildIndex();
  const auto nearest = [cloud, tree, questions](Eigen::Index k) {
    return nearestIn(*tree, questions.col(k).data());
  };
  const auto grow = [=] {
    Cloud<kDimension> growing{cloud->points, 0};
    GrowingTree index(kDimension, growing, {}, count);
    int sum = 0;
    for (unsigned k = 0; k < count; ++k) {
      ++growing.count;
      index.addPoints(k, k);
      sum += nearestIn(index, questions.col(k % questions.cols()).data());
    }
    return sum;
  };
  return {nearest, grow};
}

}  // namespace

NeighborPeer nanoflannPeer(const Eigen::MatrixXd& points, const Eigen::MatrixXd& questions) {
  if (points.rows() == 3) return peerOf<3>(points, questions);
  if (points.rows() == 7) return peerOf<7>(points, questions);
  if (points.rows() == 12) return peerOf<12>(points, questions);
  throw std::logic_error("nanoflann's peer knows 3, 7 and 12 dimensions");
}

}  // namespace rex::bench
