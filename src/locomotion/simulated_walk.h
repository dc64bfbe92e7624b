#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/rng.h"
#include "locomotion/walk_controller.h"
#include "physics/physics_world.h"

namespace rex {

/// Adds a floor of square tiles to a scene (metres): their tops are at heights uniform in [0, unevenness),
/// and it reaches a metre beyond all footsteps. Throws Error like duration(), for an unevenness that is
/// negative, a tile that is not positive, and more than 100 000 tiles.
void addUnevenFloor(SceneSpec& scene, const WalkPlan& plan, double unevenness, double tile, Rng& rng);

/// The forces of the world's shapes on all bodies during an inner step of h seconds that caused `contacts`:
/// what force sensors at the contacts would measure, N.
[[nodiscard]] std::vector<ContactForce> groundForces(const Model& model,
                                                     std::span<const PhysicsContact> contacts, double h);

/// A push at the origin of the trunk, with constant force.
struct TrunkPush {
  double time = 0, duration = 0.1;     ///< seconds
  Eigen::Vector3d impulse_W{0, 0, 0};  ///< N s
};

struct SimulatedWalkOptions {
  WalkControlOptions control{};
  PhysicsOptions physics{};
  double step = 0.002;  ///< seconds between two commands of the controller, whole milliseconds
  double startAbove =
      0;  ///< the robot is let go this high above where it would stand on level ground, metres
  std::vector<TrunkPush> pushes{};
};

/// What is measured at the end of a step of the controller.
struct WalkMeasurement {
  double time = 0;
  Eigen::VectorXd q{};
  ZeroMomentPoint measured{};  ///< from the contact forces, on z = 0
  double margin = 0;           ///< of the measured point in the hull of the contacts, metres
  FootLoads loads{};
  WalkControl control{};  ///< without its forces
};

/// A walk in the simulated world.
struct SimulatedWalk {
  bool falls = false;              ///< touched the ground not only with its feet, sank, or found no torques
  double time = 0;                 ///< when it ended, seconds
  std::string message{};           ///< why it fell
  State state{};                   ///< at the end
  double largestEffort = 0;        ///< as a fraction of the limits
  double largestCaptureError = 0;  ///< metres
  double rmsZmpError = 0;          ///< measured minus planned, metres
  double largestResidual = 0;      ///< of the quadratic programs
  std::vector<WalkMeasurement> samples{};
};

/// A robot walks by WalkController in a PhysicsWorld. It starts at rest with `home` (nq), its soles on z =
/// startAbove. Only joint forces within the limits of effort, gravity, contacts and the pushes act on it. The
/// walk ends with the plan or when the robot falls. Throws Error like WalkController and PhysicsWorld, for a
/// step that is not a whole number of milliseconds, and pushes that do not last, are not finite, or do not
/// happen whole within the walk.
[[nodiscard]] SimulatedWalk simulateWalk(const Model& model, const Legs& legs, const WalkPlan& plan,
                                         const VectorArg& home, const SimulatedWalkOptions& options = {});

/// The largest impulse (N s) of a push in direction `direction_W` at `time` (seconds) after which the robot
/// still walks on, by bisection up to `resolution`; it is assumed that it falls after all larger ones. `most`
/// if it survives that, 0 if it falls anyway. Throws Error like simulateWalk(), and for numbers that are not
/// positive.
[[nodiscard]] double largestPush(const Model& model, const Legs& legs, const WalkPlan& plan,
                                 const VectorArg& home, const Eigen::Vector3d& direction_W, double time,
                                 double most, double resolution, const SimulatedWalkOptions& options = {});

}  // namespace rex
