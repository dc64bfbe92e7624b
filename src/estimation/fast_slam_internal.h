#pragma once

#include <span>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "estimation/landmark_sensor.h"

namespace rex {

class Rng;

/// What all kinds of SLAM with particles share: poses that are drawn, and beliefs of landmarks.
namespace internal {

/// An observation and the landmark of a particle that it belongs to.
struct LandmarkSeen {
  const LandmarkBelief* landmark = nullptr;
  Eigen::Vector2d y{0, 0};
};

/// log N(error | 0, S) without the constant -size/2 log(2 pi); not a number unless S is definite.
template <int Size>
double relativeLogNormal(const Eigen::Matrix<double, Size, 1>& error,
                         const Eigen::Matrix<double, Size, Size>& S) {
  const Eigen::LLT<Eigen::Matrix<double, Size, Size>> factor(S);
  return -0.5 * factor.matrixL().solve(error).squaredNorm() -
         factor.matrixLLT().diagonal().array().log().sum();
}

/// Throws Error for a pose that is not finite, a sensor whose W is not definite, and options out of range.
void requireFastSlam(const Eigen::Vector3d& pose, const LandmarkSensor& sensor, int particles,
                     double threshold);
void requireThreshold(double threshold);
void requireParticle(int particle, Eigen::Index count);

/// The mean of weighted poses, with headings averaged on the circle.
[[nodiscard]] Eigen::Vector3d meanPoseOf(const Eigen::Matrix3Xd& poses, const Eigen::VectorXd& weights);

/// The covariance of an observation of the landmark, from a pose whose covariance is P.
[[nodiscard]] Eigen::Matrix2d sightingCovariance(const LandmarkSensor& sensor, const LandmarkView& view,
                                                 const Eigen::Matrix3d& P, const LandmarkBelief& landmark);

/// The belief after the first observation.
[[nodiscard]] LandmarkBelief firstBelief(const LandmarkSensor& sensor, const Eigen::Vector3d& pose,
                                         const Eigen::Vector2d& y);
/// Updates the belief; returns the log expected likelihood of slide 7:41, up to the constant of
/// relativeLogNormal.
double updateBelief(const LandmarkSensor& sensor, const Eigen::Vector3d& pose, const Eigen::Vector2d& y,
                    LandmarkBelief& landmark);

/// How a pose is proposed: a Gaussian around the pose that the motion predicts.
struct PoseNoise {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero(), root = Eigen::Matrix3d::Zero();
};
/// A draw and the log weight that it adds.
struct PoseDraw {
  Eigen::Vector3d pose{0, 0, 0};
  double logWeight = 0;
};
/// Draws from the motion, or if anything is seen, from the motion corrected by one sighting after the other
/// along its tangent (FastSLAM 2; Montemerlo et al. 2003); the noise must then be definite.
[[nodiscard]] PoseDraw drawPose(const LandmarkSensor& sensor, const Eigen::Vector3d& predicted,
                                const PoseNoise& noise, std::span<const LandmarkSeen> seen, Rng& rng);

}  // namespace internal
}  // namespace rex
