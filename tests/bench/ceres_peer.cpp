#include "bench/ceres_peer.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <ceres/ceres.h>

namespace rex::bench {
namespace {

// The error of an edge and its derivatives, times a root of its information.
class EdgeError : public ceres::SizedCostFunction<3, 3, 3> {
 public:
  explicit EdgeError(const PlanarEdge& edge)
      : motion_(edge.motion),
        R_motion_(Eigen::Rotation2Dd(edge.motion[2]).toRotationMatrix()),
        root_(Eigen::LLT<Eigen::Matrix3d>(edge.information).matrixU()) {}

  bool Evaluate(double const* const* poses, double* residual, double** jacobians) const override {
    const Eigen::Map<const Eigen::Vector3d> a(poses[0]), b(poses[1]);
    const double c = std::cos(a[2]), s = std::sin(a[2]);
    Eigen::Matrix2d R_T, turned;  // the transpose of a's rotation, and its derivative by the heading
    R_T << c, s, -s, c;
    turned << -s, c, -c, -s;
    const Eigen::Vector2d way = b.head<2>() - a.head<2>();
    Eigen::Vector3d error;
    error << R_motion_.transpose() * (R_T * way - motion_.head<2>()),
        std::remainder(b[2] - a[2] - motion_[2], 2 * M_PI);
    Eigen::Map<Eigen::Vector3d>{residual} = root_ * error;
    if (jacobians == nullptr) return true;
    using RowMajor = Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
    Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
    J.topLeftCorner<2, 2>() = R_motion_.transpose() * R_T;
    J(2, 2) = 1;
    if (jacobians[1] != nullptr) RowMajor{jacobians[1]} = root_ * J;
    J = -J;
    J.topRightCorner<2, 1>() = R_motion_.transpose() * (turned * way);
    if (jacobians[0] != nullptr) RowMajor{jacobians[0]} = root_ * J;
    return true;
  }

 private:
  Eigen::Vector3d motion_;
  Eigen::Matrix2d R_motion_;
  Eigen::Matrix3d root_;
};

}  // namespace

double optimizeByCeres(PlanarPoseGraph& graph) {
  ceres::Problem problem;
  for (const PlanarEdge& edge : graph.edges) {
    problem.AddResidualBlock(new EdgeError(edge), nullptr, graph.poses.col(edge.from).data(),
                             graph.poses.col(edge.to).data());
  }
  problem.SetParameterBlockConstant(graph.poses.col(0).data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.initial_trust_region_radius = 1e16;  // as good as no damping: fewest iterations on these maps
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-10;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return 2 * summary.final_cost;
}

}  // namespace rex::bench
