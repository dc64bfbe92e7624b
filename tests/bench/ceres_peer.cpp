#include "bench/ceres_peer.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <ceres/ceres.h>

namespace rex::bench {
namespace {

// The error of an edge, times a root of its information.
struct EdgeError {
  Eigen::Vector3d motion;
  Eigen::Matrix3d root;

  template <class T>
  bool operator()(const T* a, const T* b, T* residual) const {
    using std::cos, std::sin, std::floor;
    const T c = cos(a[2]), s = sin(a[2]), x = b[0] - a[0], y = b[1] - a[1];
    const T dx = c * x + s * y - motion[0], dy = -s * x + c * y - motion[1];
    const double cm = std::cos(motion[2]), sm = std::sin(motion[2]);
    const T angle = b[2] - a[2] - motion[2];
    Eigen::Matrix<T, 3, 1> e(cm * dx + sm * dy, -sm * dx + cm * dy,
                             angle - 2 * M_PI * floor((angle + M_PI) / (2 * M_PI)));
    Eigen::Map<Eigen::Matrix<T, 3, 1>>{residual} = root.cast<T>() * e;
    return true;
  }
};

}  // namespace

double optimizeByCeres(PlanarPoseGraph& graph) {
  ceres::Problem problem;
  for (const PlanarEdge& edge : graph.edges) {
    const Eigen::Matrix3d root = Eigen::LLT<Eigen::Matrix3d>(edge.information).matrixU();
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<EdgeError, 3, 3, 3>(new EdgeError{edge.motion, root}), nullptr,
        graph.poses.col(edge.from).data(), graph.poses.col(edge.to).data());
  }
  problem.SetParameterBlockConstant(graph.poses.col(0).data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-10;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return 2 * summary.final_cost;
}

}  // namespace rex::bench
