#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "estimation/pose_edge_internal.h"
#include "estimation/pose_graph.h"

// With Y = [t_1 .. t_n, R_1 .. R_n] the cost is tr(Y M Y^T). At its minimum Y M = [0, Lambda_i R_i ..] with
// symmetric multipliers, S = M - diag(0, Lambda_i) is positive semidefinite, and for all other poses the cost
// is higher by tr(Y' S Y'^T). Where S + eps on the rotations is positive definite, it is lower by no more
// than eps |R_1 .. R_n|^2 = eps d n. Position 0 is left out: moving all poses costs nothing.
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

  Certificate(std::vector<Rotation> R, const std::vector<Position>& t)
      : R_(std::move(R)), size_((1 + D) * static_cast<int>(R_.size()) - 1) {
    Y_.resize(D, size_);
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

  double gap() {
    Eigen::SparseMatrix<double> S(size_, size_);
    S.setFromTriplets(entries_.begin(), entries_.end());
    const Eigen::MatrixXd YM = Y_ * S.selfadjointView<Eigen::Lower>();
    for (std::size_t i = 0; i < R_.size(); ++i) {
      const int at = rotation(static_cast<int>(i));
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
        return share * scale * D * static_cast<double>(R_.size());
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
  int size_;
  Eigen::Matrix<double, D, Eigen::Dynamic> Y_;
  std::vector<Eigen::Triplet<double>> entries_;
};

Eigen::Matrix2d rotationOf(double angle) {
  return (Eigen::Matrix2d() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle))
      .finished();
}

}  // namespace

double certifiedGap(const PlanarPoseGraph& graph) {
  internal::requireSound(graph);
  internal::requireConnected(graph);
  std::vector<Eigen::Matrix2d> R;
  std::vector<Eigen::Vector2d> t;
  for (const auto& pose : graph.poses.colwise()) {
    R.push_back(rotationOf(pose[2]));
    t.push_back(pose.head<2>());
  }
  Certificate<2> certificate(std::move(R), t);
  for (const PlanarEdge& edge : graph.edges)
    certificate.add(
        {edge.from, edge.to, rotationOf(edge.motion[2]), edge.motion.head<2>(), internal::isotropic(edge)});
  return certificate.gap();
}

double certifiedGap(const SpatialPoseGraph& graph) {
  internal::requireSound(graph);
  internal::requireConnected(graph);
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
