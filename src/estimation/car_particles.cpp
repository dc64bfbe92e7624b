#include "estimation/car_particles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <Eigen/LU>

#include "base/cpu_lanes.h"
#include "base/error.h"
#include "base/normal_stream.h"
#include "base/require.h"
#include "estimation/car_particles_kernel_internal.h"
#include "estimation/covariance.h"

namespace rex {
namespace {

using Kernel = internal::CarParticlesKernel;

constexpr int kStateSize = 3;
constexpr Eigen::Index kChunk = 256;  // particles whose noise stays in the nearest cache

void requireMotion(const CarMotion& motion) {
  requireFinite("time step of the car", motion.tau, kSeconds);
  requirePositive("wheelbase of the car", motion.wheelbase, kMetres);
  requireNotNegative("deviations of the car's motion", motion.deviations);
}

internal::Sighting sightingOf(const LandmarkSensor& sensor, const Eigen::Vector2d& landmark,
                              const Eigen::Vector2d& seen) {
  const Eigen::Matrix2d information = sensor.W.inverse();
  return {{landmark[0], landmark[1]},
          {seen[0], seen[1]},
          {information(0, 0), information(0, 1), information(1, 1)}};
}

}  // namespace

Propose carProposal(const CarMotion& motion, const Eigen::Vector2d& u) {
  requireMotion(motion);
  requireFinite("control of the car", u);
  const double distance = motion.tau * u[0];
  const internal::CarStep step{distance,
                               distance / motion.wheelbase * std::tan(u[1]),
                               {motion.deviations[0], motion.deviations[1], motion.deviations[2]}};
  return [step](Eigen::Ref<Eigen::MatrixXd> X, Eigen::Ref<Eigen::VectorXd>, Rng& rng) {
    requireSize("state of the car", X.rows(), kStateSize);
    const auto kernel = kernelFor<Kernel>(cpuLanes());
    NormalStream stream(rng);
    std::array<double, kStateSize * kChunk> normals;
    for (Eigen::Index first = 0; first < X.cols(); first += kChunk) {
      const Eigen::Index count = std::min(kChunk, X.cols() - first);
      stream.fill(std::span(normals).first(static_cast<std::size_t>(kStateSize * count)));
      kernel.move(step, normals.data(), X.col(first).data(), X.outerStride(), count);
    }
  };
}

Weigh landmarkWeights(const LandmarkSensor& sensor, const Eigen::Matrix2Xd& landmarks, const VectorArg& y) {
  requireSize("sightings", y.size(), landmarks.size());
  requireFinite("sightings", y);
  requireFinite("landmarks", landmarks.reshaped());
  (void)definiteFactor("noise of the sightings", sensor.W);
  std::vector<internal::Sighting> sightings;
  for (Eigen::Index k = 0; k < landmarks.cols(); ++k)
    sightings.push_back(sightingOf(sensor, landmarks.col(k), y.segment<2>(2 * k)));
  if (sensor.kind == LandmarkSensor::Kind::kCartesian)
    return [sightings](const MatrixArg& X, Eigen::Ref<Eigen::VectorXd> logWeights) {
      requireSize("state of the car", X.rows(), kStateSize);
      kernelFor<Kernel>(cpuLanes())
          .weigh(sightings.data(), static_cast<long>(sightings.size()), X.data(), X.outerStride(), X.cols(),
                 logWeights.data());
    };
  return [sensor, landmarks, y = Eigen::VectorXd(y), information = Eigen::Matrix2d(sensor.W.inverse())](
             const MatrixArg& X, Eigen::Ref<Eigen::VectorXd> logWeights) {
    requireSize("state of the car", X.rows(), kStateSize);
    for (Eigen::Index i = 0; i < X.cols(); ++i)
      for (Eigen::Index k = 0; k < landmarks.cols(); ++k) {
        const LandmarkView view = viewOf(sensor, X.col(i), landmarks.col(k));
        const Eigen::Vector2d error = innovation(sensor, y.segment<2>(2 * k), view.y);
        logWeights[i] -= 0.5 * error.dot(information * error);
      }
  };
}

}  // namespace rex
