#pragma once

#include <span>
#include <string>

#include "control/operational_space.h"

namespace rex {

/// A contact where the surroundings hold a robot, such as a fingertip on a table: the value of a map does not
/// accelerate, J a + J' v = 0.
struct OperationalContact {
  std::string name{};  ///< for messages
  TaskMap map{};
  /// That the surroundings should exert, d: newtons for rows in metres, positive where it pushes the value
  /// up; empty: whatever it takes to stay there.
  Eigen::VectorXd force{};
};

/// prioritisedForces() of a robot in contact. With the force f of all contacts, M a + F = u + J^T f, both a
/// and f are affine in u; so the wanted forces are the highest level, and the tasks come below them. Where
/// the surroundings can only push, or slip, is for the caller to know: loopDynamics() of the same maps gives
/// f. Khatib, IEEE J. Robotics and Automation, 1987, section VI. Throws Error as prioritisedForces(), and for
/// a force of the wrong size or that is not finite.
[[nodiscard]] Eigen::VectorXd forcesInContact(const Model& model, const State& state,
                                              std::span<const OperationalContact> contacts,
                                              std::span<const OperationalTask> tasks,
                                              const OperationalSpaceOptions& options = {});

}  // namespace rex
