#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "estimation/block_cholesky_internal.h"
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

using internal::BlockCholesky;
using internal::BlockPattern;

template <int D>
struct IsotropicEdge {
  int from, to;
  Eigen::Matrix<double, D, D> R;
  Eigen::Matrix<double, D, 1> t;
  internal::IsotropicWeights weights;
};

// Node i holds position and rotation of pose i as columns of Y, or a landmark; what a node lacks is 1 on the
// diagonal of S and 0 in Y.
template <int D>
class Certificate {
 public:
  using Rotation = Eigen::Matrix<double, D, D>;
  using Position = Eigen::Matrix<double, D, 1>;

  Certificate(std::vector<Rotation> R, const std::vector<Position>& t,
              const std::shared_ptr<const BlockPattern>& pattern,
              const Eigen::Matrix<double, D, Eigen::Dynamic>& landmarks = {})
      : R_(std::move(R)), S_(pattern) {
    Y_.setZero(kSize * pattern->nodes(), D);
    for (std::size_t i = 0; i < R_.size(); ++i) {
      const int at = kSize * static_cast<int>(i);
      Y_.row(at) = (t[i] - t[0]).transpose();
      Y_.template middleRows<D>(at + 1) = R_[i].transpose();
    }
    for (Eigen::Index i = 0; i < landmarks.cols(); ++i)
      Y_.row(kSize * (poses() + i)) = (landmarks.col(i) - t[0]).transpose();
  }

  // |R_j - R_i R_ij|^2, then |t_j - t_i - R_i t_ij|^2: squares of Y times A and B, of the nodes i and j.
  void add(const IsotropicEdge<D>& edge) {
    Block A = Block::Zero(), B = Block::Zero();
    A.template bottomRightCorner<D, D>() = -edge.R;
    B.template bottomRightCorner<D, D>().setIdentity();
    addSquare(edge.from, A, edge.to, B, edge.weights.rotation);
    addDifference(edge.from, edge.to, edge.t, edge.weights.translation);
  }

  void addSighting(int pose, int landmark, const Position& seen, double weight) {
    addDifference(pose, poses() + landmark, seen, weight);
  }

  double gap() {
    const Eigen::MatrixXd MY = S_.times(Y_);
    double atPositions = 0, scale = 0;
    for (int i = 0; i < S_.pattern().nodes(); ++i) {
      Block& S = S_.diagonal(i);
      const Position t = Y_.row(kSize * i).transpose(), gradient = MY.row(kSize * i).transpose();
      atPositions += t.dot(gradient);
      if (i < poses()) {
        const Rotation R_T = Y_.template middleRows<D>(kSize * i + 1),
                       G_T = MY.template middleRows<D>(kSize * i + 1), multiplier = R_T * G_T.transpose();
        S.template bottomRightCorner<D, D>() -= 0.5 * (multiplier + multiplier.transpose());
      }
      scale = std::max(scale, S.diagonal().cwiseAbs().maxCoeff());
    }
    for (int i = 0; i < S_.pattern().nodes(); ++i) {
      if (i == 0) S_.diagonal(i)(0, 0) = scale;
      if (i >= poses()) S_.diagonal(i).template bottomRightCorner<D, D>().diagonal().setConstant(scale);
    }
    // The smallest power of ten that will do, by bisection: at a minimum of this very cost the first one
    // tried.
    int refused = kLeastShare - 1, enough = kMostShare + 1;
    for (int share = kLeastShare; refused + 1 < enough; share = (refused + enough) / 2)
      (isDefinite(std::pow(10, share) * scale) ? enough : refused) = share;
    if (enough > kMostShare) return std::numeric_limits<double>::infinity();
    return std::max(atPositions, 0.) + std::pow(10, enough) * scale * D * static_cast<double>(R_.size());
  }

 private:
  static constexpr int kSize = 1 + D;
  using Block = Eigen::Matrix<double, kSize, kSize>;

  static constexpr int kLeastShare = -13, kMostShare = -3;  // powers of ten of the largest entry

  int poses() const { return static_cast<int>(R_.size()); }
  // S + eps on the rotations.
  bool isDefinite(double eps) {
    for (int i = 0; i < poses(); ++i)
      S_.diagonal(i).template bottomRightCorner<D, D>().diagonal().array() += eps - raised_;
    raised_ = eps;
    return S_.factorize(0);
  }
  void addDifference(int i, int j, const Position& t, double weight) {
    Block A = Block::Zero(), B = Block::Zero();
    A(0, 0) = -1;
    A.template bottomLeftCorner<D, 1>() = -t;
    B(0, 0) = 1;
    // Position 0 is left out.
    if (i == 0) A(0, 0) = 0;
    if (j == 0) B(0, 0) = 0;
    addSquare(i, A, j, B, weight);
  }
  void addSquare(int i, const Block& A, int j, const Block& B, double weight) {
    const Block wA = weight * A, wB = weight * B;
    S_.diagonal(i) += wA * A.transpose();
    S_.diagonal(j) += wB * B.transpose();
    S_.add(i, j, wA * B.transpose());
  }

  std::vector<Rotation> R_;
  BlockCholesky<kSize> S_;
  Eigen::MatrixXd Y_;  // transposed
  double raised_ = 0;  // what isDefinite() has added
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
  Certificate<2> certificate(std::move(R), t, internal::patternOf<internal::PlanarGraphTraits>(graph, 0),
                             graph.landmarks);
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
  Certificate<3> certificate(std::move(R), t, internal::patternOf<internal::SpatialGraphTraits>(graph, 0));
  for (const SpatialEdge& edge : graph.edges)
    certificate.add({edge.from, edge.to, edge.motion.R, edge.motion.p, internal::isotropic(edge)});
  return certificate.gap();
}

}  // namespace rex
