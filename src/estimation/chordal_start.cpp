#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/LU>
#include <Eigen/SVD>

#include "estimation/block_cholesky_internal.h"
#include "estimation/pose_edge_internal.h"

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
