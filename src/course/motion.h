#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Core>

#include "course/pictures.h"
#include "course/simulator.h"

namespace rex {

/// How moveTo() finds its way.
struct MoveOptions {
  double clearance = 0.01;  ///< between all shapes that may collide, metres
  double timeLimit = 10;    ///< of the search, seconds of processor time
  double velocity = 1;      ///< limit for joints without one, rad/s or m/s
  double ramp = 0.5;        ///< seconds in which each joint reaches its velocity limit from rest
  std::uint64_t seed = 1;   ///< the same seed finds the same path, unless the time limit ends the search
};

/// What moveTo() did.
struct Move {
  bool isFound = false;   ///< whether there was a path; without one the robot did not move
  double duration = 0;    ///< seconds
  double clearance = 0;   ///< proven along the whole path, metres; infinite if nothing may collide
  std::string message{};  ///< what was explored, or why there is no motion
};

/// Moves the robot from its posture to `goal` (n numbers), past all obstacles and as fast as the limits of
/// its joints allow: RRT-Connect, shortcuts, a spline and its fastest timing, as `rex plan` does. The
/// recording gets 30 postures per second, so that writeVideo() and writeReplay() show the motion in real
/// time. Throws Error for a wrong size, a start or goal beyond the limits or not clear, and as
/// kinematicsContacts().
[[nodiscard]] Move moveTo(Simulator& simulator, const Eigen::VectorXd& goal, const MoveOptions& options = {});

}  // namespace rex
