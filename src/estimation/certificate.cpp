#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/SVD>

#include "estimation/block_cholesky_internal.h"
#include "estimation/pose_edge_internal.h"
#include "estimation/pose_graph.h"

// Two linear least-squares problems (Carlone, Tron, Daniilidis and Dellaert 2015): the rotations as free
// matrices, which are then made rotations, and the positions that fit these. Pose 0 is given in both.
namespace rex::internal {
namespace {

// Rows w (x_j - M x_i - b) = 0 for vectors x_1.. of one size, several right-hand sides at once. M is square
// of Size; if no M turns anything, Size is 1 and the coordinates are right-hand sides.
template <int Size, int Columns>
class LinearGraph {
 public:
  using Matrix = Eigen::Matrix<double, Size, Size>;
  using Value = Eigen::Matrix<double, Size, Columns>;

  LinearGraph(const std::shared_ptr<const BlockPattern>& pattern, const Value& first)
      : first_(first), heaviest_(static_cast<std::size_t>(pattern->nodes()) + 1, 0), H_(pattern) {
    rhs_.setZero(Size * pattern->nodes(), Columns);
  }

  void add(int i, int j, double w, const Matrix& M, const Value& b) {
    for (const int pose : {i, j}) {
      double& heaviest = heaviest_[static_cast<std::size_t>(pose)];
      heaviest = std::max(heaviest, w);
    }
    if (j > 0) H_.diagonal(j - 1) += w * Matrix::Identity();
    const Matrix wM_T = w * M.transpose();
    if (i > 0) H_.diagonal(i - 1) += wM_T * M;
    if (i > 0 && j > 0) H_.add(j - 1, i - 1, -w * M);
    const Value known = (i == 0 ? Value(M * first_) : Value::Zero()) - (j == 0 ? first_ : Value::Zero()) + b;
    if (j > 0) rhs_.middleRows(Size * (j - 1), Size) += w * known;
    if (i > 0) rhs_.middleRows(Size * (i - 1), Size) -= wM_T * known;
  }

  // Ties pose i to its present value, so weakly that it only matters for poses whose edges weigh nothing.
  // Call it after add().
  void anchor(int i, const Value& value) {
    const double heaviest = heaviest_[static_cast<std::size_t>(i)], w = heaviest > 0 ? 1e-14 * heaviest : 1;
    H_.diagonal(i - 1) += w * Matrix::Identity();
    rhs_.middleRows(Size * (i - 1), Size) += w * value;
  }

  // One row of blocks for each node but the first; empty if rounding left nothing to solve.
  Eigen::MatrixXd solve() {
    if (!H_.factorize(0)) return {};
    Eigen::MatrixXd values = H_.solve(rhs_);
    if (!values.allFinite()) values.resize(0, 0);
    return values;
  }

 private:
  Value first_;
  std::vector<double> heaviest_;  // weight of the edges of each pose
  Eigen::MatrixXd rhs_;
  BlockCholesky<Size> H_;
};

using Scalar = Eigen::Matrix<double, 1, 1>;
const Scalar kUnturned(1.0);

}  // namespace

void setChordalPoses(PlanarPoseGraph& graph, const std::shared_ptr<const BlockPattern>& pattern) {
  const int poses = PlanarGraphTraits::poses(graph);
  Eigen::Matrix3Xd start = graph.poses;
  // First columns of the rotations, as (cos, sin): R_j e = R_i R_ij e turns that of i by the angle.
  LinearGraph<2, 1> rotations(pattern, planarRotation(start(2, 0)).col(0));
  for (const PlanarEdge& edge : graph.edges)
    rotations.add(edge.from, edge.to, isotropic(edge).rotation, planarRotation(edge.motion[2]),
                  Eigen::Vector2d::Zero());
  for (int i = 1; i < poses; ++i) rotations.anchor(i, planarRotation(start(2, i)).col(0));
  const auto landmarks = static_cast<int>(graph.landmarks.cols());
  for (int i = 0; i < landmarks; ++i) rotations.anchor(poses + i, Eigen::Vector2d::Zero());  // they have none
  const Eigen::MatrixXd headings = rotations.solve();
  if (headings.size() == 0) return;
  for (int i = 1; i < poses; ++i) start(2, i) = std::atan2(headings(2 * i - 1, 0), headings(2 * i - 2, 0));
  LinearGraph<1, 2> positions(pattern, start.col(0).head<2>().transpose());
  for (const PlanarEdge& edge : graph.edges)
    positions.add(edge.from, edge.to, isotropic(edge).translation, kUnturned,
                  (planarRotation(start(2, edge.from)) * edge.motion.head<2>()).transpose());
  for (const LandmarkEdge& edge : graph.sightings)
    positions.add(edge.pose, poses + edge.landmark, isotropic(edge).translation, kUnturned,
                  (planarRotation(start(2, edge.pose)) * edge.position).transpose());
  for (int i = 1; i < poses; ++i) positions.anchor(i, start.col(i).head<2>().transpose());
  for (int i = 0; i < landmarks; ++i) positions.anchor(poses + i, graph.landmarks.col(i).transpose());
  const Eigen::MatrixXd found = positions.solve();
  if (found.size() == 0) return;
  start.topRightCorner(2, poses - 1) = found.topRows(poses - 1).transpose();
  graph.poses = std::move(start);
  graph.landmarks = found.bottomRows(landmarks).transpose();
}

void setChordalPoses(SpatialPoseGraph& graph, const std::shared_ptr<const BlockPattern>& pattern) {
  const int poses = SpatialGraphTraits::poses(graph);
  std::vector<Pose> start = graph.poses;
  const auto at = [&](int i) -> Pose& { return start[static_cast<std::size_t>(i)]; };
  // Transposed rotations: R_j^T = R_ij^T R_i^T.
  LinearGraph<3, 3> rotations(pattern, at(0).R.transpose());
  for (const SpatialEdge& edge : graph.edges)
    rotations.add(edge.from, edge.to, isotropic(edge).rotation, edge.motion.R.transpose(),
                  Eigen::Matrix3d::Zero());
  for (int i = 1; i < poses; ++i) rotations.anchor(i, at(i).R.transpose());
  const Eigen::MatrixXd free = rotations.solve();
  if (free.size() == 0) return;
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(3, 3, Eigen::ComputeFullU | Eigen::ComputeFullV);
  for (int i = 1; i < poses; ++i) {
    const Eigen::MatrixXd M = free.middleRows<3>(3 * (i - 1)).transpose();
    svd.compute(M);
    Eigen::Matrix3d U = svd.matrixU();
    const Eigen::Matrix3d V = svd.matrixV();
    if (U.determinant() * V.determinant() < 0) U.col(2) = -U.col(2);
    at(i).R = U * V.transpose();
  }
  LinearGraph<1, 3> positions(pattern, at(0).p.transpose());
  for (const SpatialEdge& edge : graph.edges)
    positions.add(edge.from, edge.to, isotropic(edge).translation, kUnturned,
                  (at(edge.from).R * edge.motion.p).transpose());
  for (int i = 1; i < poses; ++i) positions.anchor(i, at(i).p.transpose());
  const Eigen::MatrixXd found = positions.solve();
  if (found.size() == 0) return;
  for (int i = 1; i < poses; ++i) at(i).p = found.row(i - 1).transpose();
  graph.poses = std::move(start);
}

}  // namespace rex::internal

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
