#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include <immintrin.h>

#include "base/cpu_lanes.h"
#include "base/rng.h"
#include "bench/row.h"
#include "estimation/ekf_slam.h"
#include "estimation/pose_graph.h"
#include "estimation/street_graph.h"
#ifdef REX_WITH_CERES
#include "bench/ceres_peer.h"
#endif

namespace rex::bench {
namespace {

// The best map of a robot that drove so many streets, with the bound of how much better another could be: the
// peer has no such bound.
Row poseGraphRow(int poses, double target) {
  Rng rng(1);
  const auto graph = std::make_shared<const PlanarPoseGraph>(test::streets(poses, 0.05, rng));
  const auto ours = [graph] {
    PlanarPoseGraph moved = *graph;
    const double cost = optimize(moved).cost;
    if (!(certifiedGap(moved) < 0.1 * cost)) throw std::logic_error("the map is not proved to be good");
    return cost;
  };
  Row row{.name = "pose-graph-" + std::to_string(poses),
          .ours = timed([=] { (void)ours(); }),
          .peerName = "Ceres",
          .target = target,
          .unit = "ms",
          .repetitions = 5};
#ifdef REX_WITH_CERES
  const auto peer = [graph] {
    PlanarPoseGraph moved = *graph;
    return optimizeByCeres(moved);
  };
  if (std::abs(ours() - peer()) > 1e-6 * peer()) throw std::logic_error("not the map that Ceres finds");
  row.peer = timed([=] { (void)peer(); });
#endif
  return row;
}

// The lower triangle minus u u^T + v v^T in one pass, four numbers at once.
__attribute__((target("avx2"))) void plainRankTwoUpdate(const Eigen::VectorXd& u, const Eigen::VectorXd& v,
                                                        Eigen::MatrixXd& matrix) {
  const Eigen::Index n = matrix.rows();
  for (Eigen::Index j = 0; j < n; ++j) {
    const __m256d uj = _mm256_set1_pd(u[j]), vj = _mm256_set1_pd(v[j]);
    double* column = matrix.data() + j * n;
    Eigen::Index i = j;
    for (; i + 4 <= n; i += 4) {
      const __m256d square = _mm256_add_pd(_mm256_mul_pd(uj, _mm256_loadu_pd(u.data() + i)),
                                           _mm256_mul_pd(vj, _mm256_loadu_pd(v.data() + i)));
      _mm256_storeu_pd(column + i, _mm256_sub_pd(_mm256_loadu_pd(column + i), square));
    }
    for (; i < n; ++i) column[i] -= u[j] * u[i] + v[j] * v[i];
  }
}

// An update of 500 landmarks and a pose by one sighting, against what it cannot do without: a symmetric
// update of that covariance by two columns.
Row slamUpdateRow() {
  constexpr int kLandmarks = 500;
  Rng rng(2);
  const auto slam = std::make_shared<EkfSlam>(
      Gaussian{Eigen::Vector3d::Zero(), 0.01 * Eigen::Matrix3d::Identity()}, LandmarkSensor{});
  for (int i = 0; i < kLandmarks; ++i) slam->observe(i, 20 * Eigen::Vector2d(rng.normalVector(2)));
  const auto sighted = std::make_shared<int>(0);
  const auto ours = timed([=] {
    const int i = *sighted = (*sighted + 1) % kLandmarks;
    slam->observe(i, slam->landmark(i).mean);
  });
  const Eigen::Index n = 3 + 2 * kLandmarks;
  const auto covariance = std::make_shared<Eigen::MatrixXd>(Eigen::MatrixXd::Identity(n, n));
  const Eigen::VectorXd u = 1e-9 * Eigen::VectorXd::Random(n), v = 1e-9 * Eigen::VectorXd::Random(n);
  Row row{.name = "ekf-slam-500", .ours = ours, .peerName = "plain AVX2 pass", .target = 1.4, .unit = "us"};
  if (cpuLanes() == 4) row.peer = timed([=] { plainRankTwoUpdate(u, v, *covariance); });
  return row;
}

}  // namespace

std::vector<Row> estimationRows() {  // As large as the well-known maps of Manhattan and of a city.
  return {poseGraphRow(3500, 0.5), poseGraphRow(10000, 0.45), slamUpdateRow()};
}

}  // namespace rex::bench
