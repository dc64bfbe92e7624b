#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "estimation/pose_edge_internal.h"
#include "estimation/pose_graph.h"

// With Y = [t_1 .. t_n, R_1 .. R_n] the cost is f(Y) = tr(Y M Y^T). With any symmetric multipliers Lambda_i
// and S = M - diag(0, Lambda_i), all poses Y' have f(Y') = tr(Y' S Y'^T) + sum tr Lambda_i, since rotations
// are orthonormal. Where S + eps on the rotations is positive definite, f(Y') is therefore no less than sum
// tr Lambda_i - eps d n. The multipliers are the symmetric parts of R_i^T (Y M)_i, which are those of the
// minimum at the minimum; f(Y) - sum tr Lambda_i is what positions add: sum t_i . (Y M)_i, zero where they
// are stationary. Position 0 is left out: moving all poses costs nothing. Landmarks are positions without
// rotations, and come last.
namespace rex {
namespace {

template <int D>
struct IsotropicEdge {
  int from, to;
  Eigen::Matrix<double, D, D> R;
  Eigen::Matrix<double, D, 1> t;
  internal::IsotropicWeights weights;
};

template <int D>
class Certificate {
 public:
  using Rotation = Eigen::Matrix<double, D, D>;
  using Position = Eigen::Matrix<double, D, 1>;

  Certificate(std::vector<Rotation> R, const std::vector<Position>& t,
              const Eigen::Matrix<double, D, Eigen::Dynamic>& landmarks = {})
      : R_(std::move(R)),
        first_((1 + D) * static_cast<int>(R_.size()) - 1),
        size_(first_ + static_cast<int>(landmarks.cols())) {
    Y_.resize(D, size_);
    if (size_ > first_) Y_.rightCols(size_ - first_) = landmarks.colwise() - t[0];
    for (std::size_t i = 0; i < R_.size(); ++i) {
      if (i > 0) Y_.col(position(static_cast<int>(i))) = t[i] - t[0];
      Y_.template middleCols<D>(rotation(static_cast<int>(i))) = R_[i];
    }
  }

  void add(const IsotropicEdge<D>& edge) {
    // |R_j - R_i R_ij|^2, then |t_j - t_i - R_i t_ij|^2: squares of Y times a few columns.
    for (int k = 0; k < D; ++k) {
      Column column;
      column.emplace_back(rotation(edge.to) + k, 1);
      for (int l = 0; l < D; ++l) column.emplace_back(rotation(edge.from) + l, -edge.R(l, k));
      addSquare(column, edge.weights.rotation);
    }
    Column column;
    if (edge.to > 0) column.emplace_back(position(edge.to), 1);
    if (edge.from > 0) column.emplace_back(position(edge.from), -1);
    for (int l = 0; l < D; ++l) column.emplace_back(rotation(edge.from) + l, -edge.t[l]);
    addSquare(column, edge.weights.translation);
  }

  void addSighting(int pose, int landmark, const Position& seen, double weight) {
    Column column = {{first_ + landmark, 1}};
    if (pose > 0) column.emplace_back(position(pose), -1);
    for (int l = 0; l < D; ++l) column.emplace_back(rotation(pose) + l, -seen[l]);
    addSquare(column, weight);
  }

  double gap() {
    Eigen::SparseMatrix<double> S(size_, size_);
    S.setFromTriplets(entries_.begin(), entries_.end());
    const Eigen::MatrixXd YM = Y_ * S.selfadjointView<Eigen::Lower>();
    double atPositions = Y_.rightCols(size_ - first_).cwiseProduct(YM.rightCols(size_ - first_)).sum();
    for (std::size_t i = 0; i < R_.size(); ++i) {
      const int at = rotation(static_cast<int>(i));
      if (i > 0) atPositions += Y_.col(at - 1).dot(YM.col(at - 1));
      const Rotation multiplier = R_[i].transpose() * YM.template middleCols<D>(at);
      for (int c = 0; c < D; ++c)
        for (int r = c; r < D; ++r) S.coeffRef(at + r, at + c) -= 0.5 * (multiplier(r, c) + multiplier(c, r));
    }
    S.makeCompressed();
    const double scale = Eigen::VectorXd(S.diagonal()).cwiseAbs().maxCoeff();
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor;
    factor.analyzePattern(S);
    for (double share = 1e-13; share < 1e-2; share *= 10) {
      Eigen::SparseMatrix<double> shifted = S;
      for (std::size_t i = 0; i < R_.size(); ++i)
        for (int k = 0; k < D; ++k)
          shifted.coeffRef(rotation(static_cast<int>(i)) + k, rotation(static_cast<int>(i)) + k) +=
              share * scale;
      factor.factorize(shifted);
      if (factor.info() == Eigen::Success && factor.vectorD().minCoeff() > 0)
        return std::max(atPositions, 0.) + share * scale * D * static_cast<double>(R_.size());
    }
    return std::numeric_limits<double>::infinity();
  }

 private:
  using Column = std::vector<std::pair<int, double>>;
  static int position(int pose) { return (1 + D) * pose - 1; }
  static int rotation(int pose) { return (1 + D) * pose; }
  void addSquare(const Column& column, double weight) {
    for (const auto& [r, a] : column)
      for (const auto& [c, b] : column)
        if (r >= c) entries_.emplace_back(r, c, weight * a * b);
  }

  std::vector<Rotation> R_;
  int first_, size_;  // the first landmark, and all
  Eigen::Matrix<double, D, Eigen::Dynamic> Y_;
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace

double certifiedGap(const PlanarPoseGraph& graph) {
  internal::requireSound(graph);
  internal::requireConnected(graph);
  if (internal::PlanarGraphTraits::nodes(graph) < 2) return 0;
  std::vector<Eigen::Matrix2d> R;
  std::vector<Eigen::Vector2d> t;
  for (const auto& pose : graph.poses.colwise()) {
    R.push_back(internal::planarRotation(pose[2]));
    t.push_back(pose.head<2>());
  }
  Certificate<2> certificate(std::move(R), t, graph.landmarks);
  for (const PlanarEdge& edge : graph.edges)
    certificate.add({edge.from, edge.to, internal::planarRotation(edge.motion[2]), edge.motion.head<2>(),
                     internal::isotropic(edge)});
  for (const LandmarkEdge& edge : graph.sightings)
    certificate.addSighting(edge.pose, edge.landmark, edge.position, internal::isotropic(edge).translation);
  return certificate.gap();
}

double certifiedGap(const SpatialPoseGraph& graph) {
  internal::requireSound(graph);
  internal::requireConnected(graph);
  if (graph.poses.size() < 2) return 0;
  std::vector<Eigen::Matrix3d> R;
  std::vector<Eigen::Vector3d> t;
  for (const Pose& pose : graph.poses) {
    R.push_back(pose.R);
    t.push_back(pose.p);
  }
  Certificate<3> certificate(std::move(R), t);
  for (const SpatialEdge& edge : graph.edges)
    certificate.add({edge.from, edge.to, edge.motion.R, edge.motion.p, internal::isotropic(edge)});
  return certificate.gap();
}

}  // namespace rex
