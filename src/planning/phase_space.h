#pragma once

#include <Eigen/Core>

namespace rex {

/// The least effort, integral of u^2, that brings a unit point mass from one (position, velocity) to
/// another in exactly that time: d^T G^-1 d with d = target - (q + T v, v) and G = [T^3/3 T^2/2; T^2/2 T].
/// A distance in phase space, exercise 12.7.2; with free time it tends to zero (erratum 28). Throws Error
/// for a duration that is not positive, and numbers that are not finite.
[[nodiscard]] double leastEffort(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double duration);

/// The force at time t of that motion: it changes linearly in time. Throws like leastEffort.
[[nodiscard]] double leastEffortForce(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double duration,
                                      double t);

/// (position, velocity) at time t of that motion: a cubic. Throws like leastEffort.
[[nodiscard]] Eigen::Vector2d leastEffortState(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                               double duration, double t);

}  // namespace rex
