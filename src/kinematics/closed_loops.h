#pragma once

#include <span>
#include <string>
#include <vector>

#include "kinematics/task_maps.h"

namespace rex {

// Mechanisms whose bodies form loops: a tree of joints, and task maps that must be zero where the loops are
// closed (slide 2:15; Featherstone, Rigid Body Dynamics Algorithms, chapter 8). Any map will do, these are
// the usual ones. Rows may depend on each other, as the third one of hinges in a plane does.

/// p_WP - p_WQ (3), metres, of two points fixed in bodies or the world: zero where a ball joint holds them
/// together, or a hinge of a planar mechanism.
[[nodiscard]] TaskMap pinTask(BodyId a, const Eigen::Vector3d& p_AP, BodyId b, const Eigen::Vector3d& p_BQ);

/// (|p_WP - p_WQ|^2 - length^2) / (2 length), metres: zero where a rod without mass, with a ball joint at
/// either end, connects them. Throws Error for a length that is not positive and finite.
[[nodiscard]] TaskMap rodTask(BodyId a, const Eigen::Vector3d& p_AP, BodyId b, const Eigen::Vector3d& p_BQ,
                              double length);

/// A pinTask() for each of Model::pins(), in their order.
[[nodiscard]] std::vector<TaskMap> pinTasks(const Model& model);

/// The value of all maps and their Jacobian, one below the other.
[[nodiscard]] TaskValue stackLoops(const Model& model, std::span<const TaskMap> loops, const VectorArg& q);

/// A posture with closed loops, or the one that came closest.
struct ClosedPosture {
  enum class Status {
    kClosed,
    kStuck,  ///< no step brings the ends closer: the loops cannot be closed from here
    kIterationLimit
  };
  Status status = Status::kIterationLimit;
  Eigen::VectorXd q{};
  double error = 0;  ///< the largest entry of the maps, metres or as they are
  int iterations = 0;
  std::string message{};
};

/// The posture near q at which all maps are zero, by damped Newton steps of least length. `driven` lists
/// entries of v that stay fixed, such as those of motors. Throws Error
/// for a q of the wrong size and for a `driven` that is no entry of v.
[[nodiscard]] ClosedPosture assemble(const Model& model, std::span<const TaskMap> loops, const VectorArg& q,
                                     std::span<const int> driven = {});

/// How a mechanism can move at q: nv x f, orthonormal velocities that keep the loops closed, where f is its
/// mobility there. Singular values below 1e-9 of the largest count as zero.
[[nodiscard]] Eigen::MatrixXd loopMotions(const Model& model, std::span<const TaskMap> loops,
                                          const VectorArg& q);

}  // namespace rex
