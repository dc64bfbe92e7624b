#include "estimation/fast_slam.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/LU>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"
#include "estimation/fast_slam_internal.h"
#include "estimation/gaussian.h"
#include "estimation/pose_edge_internal.h"

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
  const LandmarkPlace place = landmarkPosition(sensor, pose, y);
  return {place.landmark, place.Jy * sensor.W * place.Jy.transpose()};
}

double updateBelief(const LandmarkSensor& sensor, const Eigen::Vector3d& pose, const Eigen::Vector2d& y,
                    LandmarkBelief& landmark) {
  const LandmarkView view = landmarkView(sensor, pose, landmark.mean);
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
    const LandmarkView view = landmarkView(sensor, mean, one.landmark->mean);
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

namespace rex {

FastSlam::FastSlam(const Eigen::Vector3d& pose, const LandmarkSensor& sensor, const FastSlamOptions& options)
    : sensor_(sensor), options_(options) {
  internal::requireFastSlam(pose, sensor, options.particles, options.threshold);
  poses_ = pose.replicate(1, options.particles);
  weights_.setConstant(options.particles, 1.0 / options.particles);
  maps_.resize(static_cast<std::size_t>(options.particles) * static_cast<std::size_t>(room_));
}

Gaussian FastSlam::landmark(int particle, int i) const {
  internal::requireParticle(particle, weights_.size());
  if (i < 0 || i >= landmarks_)
    throw Error({.what = "landmark",
                 .found = fmt::format("{}", i),
                 .wanted = fmt::format("0 to {}", landmarks_ - 1)});
  const LandmarkBelief& one = maps_[static_cast<std::size_t>(particle) * static_cast<std::size_t>(room_) +
                                    static_cast<std::size_t>(i)];
  return {one.mean, one.covariance};
}

Gaussian FastSlam::landmark(int i) const {
  Gaussian mixture{Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero()};
  for (int k = 0; k < weights_.size(); ++k) mixture.mean += weights_[k] * landmark(k, i).mean;
  for (int k = 0; k < weights_.size(); ++k) {
    const Gaussian one = landmark(k, i);
    const Eigen::Vector2d offset = one.mean - mixture.mean;
    mixture.covariance += weights_[k] * (one.covariance + offset * offset.transpose());
  }
  return mixture;
}

Eigen::Vector3d FastSlam::meanPose() const { return internal::meanPoseOf(poses_, weights_); }

void FastSlam::makeRoom(int landmarks) {
  if (landmarks <= room_) return;
  const std::size_t before = static_cast<std::size_t>(room_);
  while (room_ < landmarks) room_ *= 2;
  const std::size_t after = static_cast<std::size_t>(room_),
                    count = static_cast<std::size_t>(weights_.size());
  std::vector<LandmarkBelief> wider(count * after);
  for (std::size_t k = 0; k < count; ++k)
    std::copy_n(maps_.begin() + static_cast<std::ptrdiff_t>(k * before), before,
                wider.begin() + static_cast<std::ptrdiff_t>(k * after));
  maps_ = std::move(wider);
}

void FastSlam::resampleParticles(Rng& rng) {
  const std::vector<int> parents =
      resampled(weights_, static_cast<int>(weights_.size()), Resampling::kSystematic, rng);
  Eigen::Matrix3Xd poses(3, poses_.cols());
  std::vector<LandmarkBelief> maps(maps_.size());
  const std::size_t room = static_cast<std::size_t>(room_);
  for (std::size_t k = 0; k < parents.size(); ++k) {
    const std::size_t parent = static_cast<std::size_t>(parents[k]);
    poses.col(static_cast<Eigen::Index>(k)) = poses_.col(parents[k]);
    std::copy_n(maps_.begin() + static_cast<std::ptrdiff_t>(parent * room), landmarks_,
                maps.begin() + static_cast<std::ptrdiff_t>(k * room));
  }
  poses_ = std::move(poses);
  maps_ = std::move(maps);
  weights_.setConstant(1.0 / static_cast<double>(weights_.size()));
}

Eigen::VectorXd FastSlam::advance(const PoseTransition& transition, std::span<const LandmarkSighting> known,
                                  std::span<const LandmarkSighting> fresh, int landmarks, Rng& rng) {
  makeRoom(landmarks);
  const internal::PoseNoise noise{transition.noise, covarianceRoot(transition.noise)};
  Eigen::VectorXd logWeights = weights_.array().log();
  std::vector<internal::LandmarkSeen> seen(options_.observedProposal ? known.size() : 0);
  for (Eigen::Index k = 0; k < weights_.size(); ++k) {
    const Eigen::Vector3d predicted = transition.mean(poses_.col(k));
    requireFinite("next pose", predicted);
    for (std::size_t i = 0; i < seen.size(); ++i) seen[i] = {&at(k, known[i].landmark), known[i].y};
    const auto [pose, logWeight] = internal::drawPose(sensor_, predicted, noise, seen, rng);
    poses_.col(k) = pose;
    logWeights[k] += logWeight;
    for (const LandmarkSighting& sighting : known)
      logWeights[k] += internal::updateBelief(sensor_, pose, sighting.y, at(k, sighting.landmark));
    int count = landmarks_;
    for (const LandmarkSighting& sighting : fresh) {
      if (sighting.landmark == count) {
        at(k, sighting.landmark) = internal::firstBelief(sensor_, pose, sighting.y);
        ++count;
      } else {
        logWeights[k] += internal::updateBelief(sensor_, pose, sighting.y, at(k, sighting.landmark));
      }
    }
    if (std::isnan(logWeights[k])) logWeights[k] = -std::numeric_limits<double>::infinity();
  }
  landmarks_ = landmarks;
  return logWeights;
}

FastSlamStep FastSlam::step(const PoseTransition& transition, std::span<const LandmarkSighting> sightings,
                            Rng& rng) {
  internal::requireTransition(
      transition, options_.observedProposal ? Definiteness::kPositive : Definiteness::kSemidefinite);
  int next = landmarks_;
  std::vector<LandmarkSighting> known, fresh;
  for (const LandmarkSighting& sighting : sightings) {
    requireFinite("sighting", sighting.y);
    if (sighting.landmark < 0 || sighting.landmark > next)
      throw Error({.what = "observed landmark",
                   .found = fmt::format("{}", sighting.landmark),
                   .wanted = fmt::format("at least 0, at most {}, which is a new one", next)});
    if (sighting.landmark < landmarks_) {
      known.push_back(sighting);
    } else {
      fresh.push_back(sighting);
      if (sighting.landmark == next) ++next;
    }
  }
  // On a copy: maps are not changed by sightings that no particle explains, and an exception changes nothing.
  FastSlam moved(*this);
  const Eigen::VectorXd logWeights = moved.advance(transition, known, fresh, next, rng);
  const double largest = logWeights.maxCoeff();
  FastSlamStep report;
  report.lost = !std::isfinite(largest);
  if (report.lost) {
    moved = *this;
    (void)moved.advance(transition, {}, {}, landmarks_, rng);
  } else {
    moved.weights_ = (logWeights.array() - largest).exp();
    moved.weights_ /= moved.weights_.sum();
  }
  *this = std::move(moved);
  report.effectiveSize = effectiveSampleSize(weights_);
  report.resampled = report.effectiveSize < options_.threshold * static_cast<double>(weights_.size());
  if (report.resampled) resampleParticles(rng);
  return report;
}

}  // namespace rex
