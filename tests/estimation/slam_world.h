#pragma once

#include <cmath>
#include <vector>

#include "base/rng.h"
#include "estimation/ekf_slam.h"

namespace rex::test {

/// The car of exercise 12.9 among landmarks: it drives circles and sees all of them.
struct SlamWorld {
  LandmarkSensor sensor;
  double deviation = .03;  ///< of the motion, in each number
  Eigen::Vector2d u{.1, .2};
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector2d> landmarks;

  SlamWorld(LandmarkSensor::Kind kind, int count, Rng& rng) {
    sensor.kind = kind;
    sensor.W = kind == LandmarkSensor::Kind::kCartesian ? Eigen::Vector2d(.25, .25).asDiagonal()
                                                        : Eigen::Vector2d(.04, .0004).asDiagonal();
    for (int i = 0; i < count; ++i) landmarks.push_back(10 * Eigen::Vector2d(rng.normal(), rng.normal()));
  }
  PoseTransition transition() const {
    const Eigen::Vector2d control = u;
    return {.mean =
                [control](const Eigen::Vector3d& at) {
                  return Eigen::Vector3d(at[0] + control[0] * std::cos(at[2]),
                                         at[1] + control[0] * std::sin(at[2]),
                                         at[2] + control[0] / 2 * std::tan(control[1]));
                },
            .jacobian =
                [control](const Eigen::Vector3d& at) {
                  Eigen::Matrix3d A = Eigen::Matrix3d::Identity();
                  A(0, 2) = -control[0] * std::sin(at[2]);
                  A(1, 2) = control[0] * std::cos(at[2]);
                  return A;
                },
            .noise = deviation * deviation * Eigen::Matrix3d::Identity()};
  }
  void drive(Rng& rng) { x = transition().mean(x) + deviation * rng.normalVector(3); }
  Eigen::Vector2d look(std::size_t i, Rng& rng) const {
    return landmarkView(sensor, x, landmarks[i]).y +
           sensor.W.diagonal().cwiseSqrt().cwiseProduct(Eigen::Vector2d(rng.normalVector(2)));
  }
};

}  // namespace rex::test
