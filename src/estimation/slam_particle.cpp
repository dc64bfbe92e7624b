#include <cmath>

#include <Eigen/LU>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"
#include "estimation/covariance.h"
#include "estimation/slam_particle_internal.h"

namespace rex::internal {

void requireFastSlam(const Eigen::Vector3d& pose, const LandmarkSensor& sensor, int particles,
                     double threshold) {
  requireFinite("pose", pose);
  requireCovariance("covariance of the sensor", sensor.W, 2, Definiteness::kPositive);
  requireCount("particles", particles, 1);
  requireThreshold(threshold);
}

void requireThreshold(double threshold) {
  if (!(threshold >= 0 && threshold <= 1))
    throw Error(
        {.what = "resampling threshold", .found = fmt::format("{:g}", threshold), .wanted = "0 to 1"});
}

void requireParticle(int particle, Eigen::Index count) {
  if (particle < 0 || particle >= count)
    throw Error({.what = "particle",
                 .found = fmt::format("{}", particle),
                 .wanted = fmt::format("0 to {}", count - 1)});
}

Eigen::Vector3d meanPoseOf(const Eigen::Matrix3Xd& poses, const Eigen::VectorXd& weights) {
  Eigen::Vector3d mean = poses * weights;
  mean[2] = std::atan2(poses.row(2).array().sin().matrix().dot(weights),
                       poses.row(2).array().cos().matrix().dot(weights));
  return mean;
}

Eigen::Matrix2d sightingCovariance(const LandmarkSensor& sensor, const LandmarkView& view,
                                   const Eigen::Matrix3d& P, const LandmarkBelief& landmark) {
  return view.Jx * P * view.Jx.transpose() + view.Jl * landmark.covariance * view.Jl.transpose() + sensor.W;
}

LandmarkBelief firstBelief(const LandmarkSensor& sensor, const Eigen::Vector3d& pose,
                           const Eigen::Vector2d& y) {
  const LandmarkPlace place = placeOf(sensor, pose, y);
  return {place.landmark, place.Jy * sensor.W * place.Jy.transpose()};
}

double updateBelief(const LandmarkSensor& sensor, const Eigen::Vector3d& pose, const Eigen::Vector2d& y,
                    LandmarkBelief& landmark) {
  const LandmarkView view = viewOf(sensor, pose, landmark.mean);
  const Eigen::Vector2d error = innovation(sensor, y, view.y);
  const Eigen::Matrix2d S = view.Jl * landmark.covariance * view.Jl.transpose() + sensor.W;
  const Eigen::Matrix2d K = landmark.covariance * view.Jl.transpose() * S.inverse();
  landmark.mean += K * error;
  const Eigen::Matrix2d less = landmark.covariance - K * S * K.transpose();
  landmark.covariance = 0.5 * (less + less.transpose());
  return relativeLogNormal<2>(error, S);
}

PoseDraw drawPose(const LandmarkSensor& sensor, const Eigen::Vector3d& predicted, const PoseNoise& noise,
                  std::span<const LandmarkSeen> seen, Rng& rng) {
  if (seen.empty()) return {predicted + noise.root * rng.normalVector(3), 0};
  Eigen::Vector3d mean = predicted;
  Eigen::Matrix3d P = noise.covariance;
  for (const LandmarkSeen& one : seen) {
    const LandmarkView view = viewOf(sensor, mean, one.landmark->mean);
    const Eigen::Matrix2d S = sightingCovariance(sensor, view, P, *one.landmark);
    const Eigen::Matrix<double, 3, 2> K = P * view.Jx.transpose() * S.inverse();
    mean += K * innovation(sensor, one.y, view.y);
    P = (P - K * S * K.transpose()).eval();
    P = (0.5 * (P + P.transpose())).eval();
  }
  const Eigen::Vector3d next = mean + covarianceRoot(P) * rng.normalVector(3);
  return {next,
          relativeLogNormal<3>(next - predicted, noise.covariance) - relativeLogNormal<3>(next - mean, P)};
}

}  // namespace rex::internal
