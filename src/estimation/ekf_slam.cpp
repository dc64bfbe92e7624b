#include "estimation/ekf_slam.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "base/cpu_lanes.h"
#include "base/error.h"
#include "base/require.h"
#include "estimation/gaussian.h"
#include "estimation/kalman_filter_internal.h"
#include "estimation/pose_edge_internal.h"
#include "estimation/rank_two_kernel_internal.h"

namespace rex {
namespace {

constexpr int kFirstRoom = 3 + 2 * 16;

}  // namespace

void internal::requireTransition(const PoseTransition& transition, Definiteness noise) {
  if (!transition.mean) throw Error({.what = "transition", .found = "no function for its mean"});
  requireCovariance("transition: covariance of the noise", transition.noise, 3, noise);
}

EkfSlam::EkfSlam(const Gaussian& pose, const LandmarkSensor& sensor)
    : sensor_(sensor), mean_(kFirstRoom), covariance_(kFirstRoom, kFirstRoom), gain_(kFirstRoom, 2) {
  requireSize("pose", pose.mean.size(), 3);
  internal::requireBelief(pose);
  requireCovariance("covariance of the sensor", sensor.W, 2, Definiteness::kPositive);
  mean_.head<3>() = pose.mean;
  covariance_.topLeftCorner<3, 3>() = pose.covariance;
}

Gaussian EkfSlam::pose() const {
  return {mean_.head<3>(), covariance_.topLeftCorner<3, 3>().selfadjointView<Eigen::Lower>()};
}

Gaussian EkfSlam::landmark(int i) const {
  if (i < 0 || i >= landmarks_)
    throw Error({.what = "landmark",
                 .found = fmt::format("{}", i),
                 .wanted = fmt::format("0 to {}", landmarks_ - 1)});
  const int at = 3 + 2 * i;
  return {mean_.segment<2>(at), covariance_.block<2, 2>(at, at).selfadjointView<Eigen::Lower>()};
}

Gaussian EkfSlam::joint() const {
  return {mean_.head(size()), covariance_.topLeftCorner(size(), size()).selfadjointView<Eigen::Lower>()};
}

void EkfSlam::predict(const PoseTransition& transition) {
  internal::requireTransition(transition, Definiteness::kSemidefinite);
  if (!transition.jacobian) throw Error({.what = "transition", .found = "no function for its derivative"});
  const Eigen::Vector3d next = transition.mean(poseMean());
  const Eigen::Matrix3d A = transition.jacobian(poseMean());
  requireFinite("next pose", next);
  if (!A.allFinite())
    throw Error({.what = "derivative of the transition", .found = "entries that are not finite"});
  mean_.head<3>() = next;
  const Eigen::Matrix3d P = covariance_.topLeftCorner<3, 3>().selfadjointView<Eigen::Lower>();
  const Eigen::Matrix3d moved = A * P * A.transpose() + transition.noise;
  covariance_.topLeftCorner<3, 3>() = 0.5 * (moved + moved.transpose());
  const int rest = 2 * landmarks_;
  // Row by row, in place.
  for (int i = 3; i < 3 + rest; ++i) {
    const Eigen::RowVector3d row = covariance_.block<1, 3>(i, 0);
    covariance_.block<1, 3>(i, 0) = row * A.transpose();
  }
}

EkfSlam::Innovation EkfSlam::innovate(int landmark, const Eigen::Vector2d& y) const {
  const int at = 3 + 2 * landmark;
  Innovation result;
  result.view = landmarkView(sensor_, poseMean(), mean_.segment<2>(at));
  result.error = innovation(sensor_, y, result.view.y);
  const Eigen::Matrix3d P_xx = covariance_.topLeftCorner<3, 3>().selfadjointView<Eigen::Lower>();
  const Eigen::Matrix2d P_ll = covariance_.block<2, 2>(at, at).selfadjointView<Eigen::Lower>();
  const Eigen::Matrix<double, 2, 3> P_lx = covariance_.block<2, 3>(at, 0);
  const Eigen::Matrix2d cross = result.view.Jl * P_lx * result.view.Jx.transpose();
  result.S = result.view.Jx * P_xx * result.view.Jx.transpose() + cross + cross.transpose() +
             result.view.Jl * P_ll * result.view.Jl.transpose() + sensor_.W;
  result.S = (0.5 * (result.S + result.S.transpose())).eval();
  const Eigen::LLT<Eigen::Matrix2d> factor(result.S);
  if (!result.S.allFinite() || factor.info() != Eigen::Success)
    requireCovariance("covariance of the innovation", result.S, 2, Definiteness::kPositive);
  result.squared = factor.matrixL().solve(result.error).squaredNorm();
  result.cost = result.squared + 2 * factor.matrixLLT().diagonal().array().log().sum();
  return result;
}

void EkfSlam::add(const Eigen::Vector2d& y) {
  const int at = size();
  if (at + 2 > mean_.size()) {
    const Eigen::Index room = 2 * mean_.size();
    mean_.conservativeResize(room);
    covariance_.conservativeResize(room, room);
    gain_.resize(room, 2);
  }
  const LandmarkPlace place = landmarkPosition(sensor_, poseMean(), y);
  mean_.segment<2>(at) = place.landmark;
  const Eigen::Matrix3d P_xx = covariance_.topLeftCorner<3, 3>().selfadjointView<Eigen::Lower>();
  covariance_.block<2, 3>(at, 0) = place.Jx * P_xx;
  for (int i = 3; i < at; ++i)
    covariance_.block<2, 1>(at, i) = place.Jx * covariance_.block<1, 3>(i, 0).transpose();
  const Eigen::Matrix2d P_ll =
      place.Jx * P_xx * place.Jx.transpose() + place.Jy * sensor_.W * place.Jy.transpose();
  covariance_.block<2, 2>(at, at) = 0.5 * (P_ll + P_ll.transpose());
  ++landmarks_;
}

void EkfSlam::update(int landmark, const Innovation& innovation) {
  const int n = size(), at = 3 + 2 * landmark;
  // P H^T L^-T with S = L L^T: the covariance loses the square of it. H has entries for the pose and this
  // landmark only; above the diagonal P is read from below.
  auto U = gain_.topRows(n);
  const Eigen::Matrix<double, 3, 2> Hx = innovation.view.Jx.transpose();
  const Eigen::Matrix2d Hl = innovation.view.Jl.transpose();
  const Eigen::Matrix3d P_xx = covariance_.topLeftCorner<3, 3>().selfadjointView<Eigen::Lower>();
  U.topRows<3>() = P_xx * Hx + covariance_.block<2, 3>(at, 0).transpose() * Hl;
  U.bottomRows(n - 3).noalias() = covariance_.block(3, 0, n - 3, 3) * Hx;
  U.middleRows(3, at - 3).noalias() += covariance_.block(at, 3, 2, at - 3).transpose() * Hl;
  const Eigen::Matrix2d P_ll = covariance_.block<2, 2>(at, at).selfadjointView<Eigen::Lower>();
  U.middleRows<2>(at) += P_ll * Hl;
  U.bottomRows(n - at - 2).noalias() += covariance_.block(at + 2, at, n - at - 2, 2) * Hl;
  const Eigen::LLT<Eigen::Matrix2d> factor(innovation.S);
  factor.matrixU().solveInPlace<Eigen::OnTheRight>(U);
  requireVariances(n);
  mean_.head(n).noalias() += U * factor.matrixL().solve(innovation.error);
  kernelFor<internal::RankTwoKernel>(cpuLanes())
      .subtract(U.col(0).data(), U.col(1).data(), n, covariance_.data(), covariance_.outerStride());
}

// Cancellation leaves no digits if the sensor is far more precise than the prior.
void EkfSlam::requireVariances(int n) const {
  for (int i = 0; i < n; ++i) {
    const double before = covariance_(i, i), after = before - gain_.row(i).squaredNorm();
    if (after > 0 || (before == 0 && after == 0)) continue;
    throw Error({.what = fmt::format("covariance after the observation: variance {}", i),
                 .found = fmt::format("{:g}, from {:g} before", after, before),
                 .wanted = "a positive number: the sensor's noise is too small compared to it"});
  }
}

LandmarkUpdate EkfSlam::observe(int landmark, const Eigen::Vector2d& y) {
  requireFinite("observation", y);
  if (landmark < 0 || landmark > landmarks_) {
    throw Error({.what = "observed landmark",
                 .found = fmt::format("{}", landmark),
                 .wanted = fmt::format("at least 0, at most {}, which is a new one", landmarks_)});
  }
  if (landmark == landmarks_) {
    add(y);
    return {landmark, true, 0};
  }
  const Innovation innovation = innovate(landmark, y);
  update(landmark, innovation);
  return {landmark, false, innovation.squared};
}

std::vector<std::optional<LandmarkUpdate>> EkfSlam::observe(std::span<const Eigen::Vector2d> ys,
                                                            const AssociationGates& gates) {
  if (!(gates.same > 0 && gates.same <= gates.different))
    throw Error({.what = "association gates",
                 .found = fmt::format("same {:g}, different {:g}", gates.same, gates.different),
                 .wanted = "0 < same <= different"});
  for (const Eigen::Vector2d& y : ys) requireFinite("observation", y);
  struct Pair {
    double cost;
    std::size_t observation;
    int landmark;
  };
  std::vector<Pair> pairs;
  std::vector<double> nearest(ys.size(), std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < ys.size(); ++k) {
    for (int i = 0; i < landmarks_; ++i) {
      const Innovation innovation = innovate(i, ys[k]);
      nearest[k] = std::min(nearest[k], innovation.squared);
      if (innovation.squared <= gates.same) pairs.push_back({innovation.cost, k, i});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.cost < b.cost; });
  std::vector<std::optional<LandmarkUpdate>> result(ys.size());
  std::vector<bool> isTaken(static_cast<std::size_t>(landmarks_), false);
  for (const Pair& pair : pairs) {
    if (result[pair.observation] || isTaken[static_cast<std::size_t>(pair.landmark)]) continue;
    isTaken[static_cast<std::size_t>(pair.landmark)] = true;
    result[pair.observation] = observe(pair.landmark, ys[pair.observation]);
  }
  for (std::size_t k = 0; k < ys.size(); ++k)
    if (!result[k] && nearest[k] > gates.different) result[k] = observe(landmarks_, ys[k]);
  return result;
}

}  // namespace rex
