#include "estimation/fast_slam.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"
#include "estimation/covariance.h"
#include "estimation/pose_transition_internal.h"

namespace rex {
namespace {

// log N(error | 0, S) without its constant.
template <int Size>
double logNormal(const Eigen::Matrix<double, Size, 1>& error, const Eigen::Matrix<double, Size, Size>& S) {
  const Eigen::LLT<Eigen::Matrix<double, Size, Size>> factor(S);
  return -0.5 * factor.matrixL().solve(error).squaredNorm() -
         factor.matrixLLT().diagonal().array().log().sum();
}

}  // namespace

FastSlam::FastSlam(const Eigen::Vector3d& pose, const LandmarkSensor& sensor, const FastSlamOptions& options)
    : sensor_(sensor), options_(options) {
  requireFinite("pose", pose);
  requireCovariance("covariance of the sensor", sensor.W, 2, Definiteness::kPositive);
  requireCount("particles", options.particles, 1);
  if (!(options.threshold >= 0 && options.threshold <= 1))
    throw Error({.what = "resampling threshold",
                 .found = fmt::format("{:g}", options.threshold),
                 .wanted = "0 to 1"});
  poses_ = pose.replicate(1, options.particles);
  weights_.setConstant(options.particles, 1.0 / options.particles);
  maps_.resize(static_cast<std::size_t>(options.particles) * static_cast<std::size_t>(room_));
}

Gaussian FastSlam::landmark(int particle, int i) const {
  if (particle < 0 || particle >= weights_.size())
    throw Error({.what = "particle",
                 .found = fmt::format("{}", particle),
                 .wanted = fmt::format("0 to {}", weights_.size() - 1)});
  if (i < 0 || i >= landmarks_)
    throw Error({.what = "landmark",
                 .found = fmt::format("{}", i),
                 .wanted = fmt::format("0 to {}", landmarks_ - 1)});
  const Landmark& one = maps_[static_cast<std::size_t>(particle) * static_cast<std::size_t>(room_) +
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

Eigen::Vector3d FastSlam::meanPose() const {
  Eigen::Vector3d mean = poses_ * weights_;
  mean[2] = std::atan2(poses_.row(2).array().sin().matrix().dot(weights_),
                       poses_.row(2).array().cos().matrix().dot(weights_));
  return mean;
}

void FastSlam::makeRoom(int landmarks) {
  if (landmarks <= room_) return;
  const std::size_t before = static_cast<std::size_t>(room_);
  while (room_ < landmarks) room_ *= 2;
  const std::size_t after = static_cast<std::size_t>(room_),
                    count = static_cast<std::size_t>(weights_.size());
  std::vector<Landmark> wider(count * after);
  for (std::size_t k = 0; k < count; ++k)
    std::copy_n(maps_.begin() + static_cast<std::ptrdiff_t>(k * before), before,
                wider.begin() + static_cast<std::ptrdiff_t>(k * after));
  maps_ = std::move(wider);
}

void FastSlam::resampleParticles(Rng& rng) {
  const std::vector<int> parents =
      resampled(weights_, static_cast<int>(weights_.size()), Resampling::kSystematic, rng);
  Eigen::Matrix3Xd poses(3, poses_.cols());
  std::vector<Landmark> maps(maps_.size());
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

double FastSlam::drawPose(Eigen::Index particle, const PoseTransition& transition,
                          const Eigen::Matrix3d& root, std::span<const LandmarkSighting> known, Rng& rng) {
  const Eigen::Vector3d predicted = transition.mean(poses_.col(particle));
  requireFinite("next pose", predicted);
  if (!options_.observedProposal || known.empty()) {
    poses_.col(particle) = predicted + root * rng.normalVector(3);
    return 0;
  }
  // The motion corrected by one sighting after the other, each along its tangent.
  Eigen::Vector3d mean = predicted;
  Eigen::Matrix3d P = transition.noise;
  for (const LandmarkSighting& sighting : known) {
    const Landmark& one = at(particle, sighting.landmark);
    const LandmarkView view = viewOf(sensor_, mean, one.mean);
    const Eigen::Matrix2d S =
        view.Jx * P * view.Jx.transpose() + view.Jl * one.covariance * view.Jl.transpose() + sensor_.W;
    const Eigen::Matrix<double, 3, 2> K = P * view.Jx.transpose() * S.inverse();
    mean += K * innovation(sensor_, sighting.y, view.y);
    P = (P - K * S * K.transpose()).eval();
    P = (0.5 * (P + P.transpose())).eval();
  }
  const Eigen::Vector3d next = mean + covarianceRoot(P) * rng.normalVector(3);
  poses_.col(particle) = next;
  return logNormal<3>(next - predicted, transition.noise) - logNormal<3>(next - mean, P);
}

double FastSlam::seeLandmark(Eigen::Index particle, const LandmarkSighting& sighting, bool isNew) {
  Landmark& one = at(particle, sighting.landmark);
  const Eigen::Vector3d pose = poses_.col(particle);
  if (isNew) {
    const LandmarkPlace place = placeOf(sensor_, pose, sighting.y);
    one = {place.landmark, place.Jy * sensor_.W * place.Jy.transpose()};
    return 0;
  }
  const LandmarkView view = viewOf(sensor_, pose, one.mean);
  const Eigen::Vector2d error = innovation(sensor_, sighting.y, view.y);
  const Eigen::Matrix2d S = view.Jl * one.covariance * view.Jl.transpose() + sensor_.W;
  const Eigen::Matrix2d K = one.covariance * view.Jl.transpose() * S.inverse();
  const double logWeight = logNormal<2>(error, S);  // the expected likelihood of slide 7:41
  one.mean += K * error;
  const Eigen::Matrix2d less = one.covariance - K * S * K.transpose();
  one.covariance = 0.5 * (less + less.transpose());
  return logWeight;
}

Eigen::VectorXd FastSlam::advance(const PoseTransition& transition, std::span<const LandmarkSighting> known,
                                  std::span<const LandmarkSighting> fresh, int landmarks, Rng& rng) {
  makeRoom(landmarks);
  const Eigen::Matrix3d root = covarianceRoot(transition.noise);
  Eigen::VectorXd logWeights = weights_.array().log();
  for (Eigen::Index k = 0; k < weights_.size(); ++k) {
    logWeights[k] += drawPose(k, transition, root, known, rng);
    for (const LandmarkSighting& sighting : known) logWeights[k] += seeLandmark(k, sighting, false);
    int seen = landmarks_;
    for (const LandmarkSighting& sighting : fresh) {
      const bool isNew = sighting.landmark == seen;
      if (isNew) ++seen;
      logWeights[k] += seeLandmark(k, sighting, isNew);
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
