#pragma once

#include <optional>
#include <span>
#include <string>

#include "grasping/wrench_cone.h"

namespace rex {

/// kUndecided: the load is so close to the boundary that rounding decides.
enum class EquilibriumStatus { kHeld, kNotHeld, kUndecided };

/// Whether contacts hold a load, with the forces that do so or the direction in which the object yields.
struct Equilibrium {
  EquilibriumStatus status = EquilibriumStatus::kUndecided;
  /// kHeld: the force of each contact in its contactFrame(), newtons: along the normal, then the tangents.
  /// 3 x contacts, in the plane 2 x contacts. The sum of normal forces is minimal. Empty otherwise.
  Eigen::MatrixXd forces_C{};
  /// kNotHeld, d: a unit vector along which the load exceeds what all contacts together can counteract;
  /// without contacts, the direction of the load. Empty otherwise.
  Eigen::VectorXd direction{};
  /// kHeld: the unbalanced rest of the load, newtons. kNotHeld: the excess of the load along `direction`.
  double residual = 0;
  std::string message{};
};

/// Contact forces within exact friction cones that balance `load` (d, see weightWrench()): slide 10:7. No
/// normal force exceeds `maxNormalForce` (newtons), if given. Solved by linear programs on edges of the
/// cones; edges are added until the result is accurate to 1e-9 of the load. Throws Error like
/// primitiveWrenches(), for a load of the wrong size or not finite, and a limit that is not positive.
[[nodiscard]] Equilibrium equilibrium(std::span<const WrenchCone> cones, const VectorArg& load,
                                      std::optional<double> maxNormalForce = {});

/// kBounded: `factor` times the load is the most that can be held. kUnbounded: any multiple.
enum class LoadStatus { kBounded, kUnbounded, kUndecided };

/// How many times the load can be held.
struct LargestLoad {
  LoadStatus status = LoadStatus::kUndecided;
  double factor = 0;            ///< kBounded: the multiple; zero if the load cannot be held at all
  Eigen::MatrixXd forces_C{};   ///< kBounded: the forces that hold this multiple, as in Equilibrium
  Eigen::VectorXd direction{};  ///< kBounded, d: the unit direction that yields first
  std::string message{};
};

/// The largest multiple of `load` that contacts hold, with normal forces of at most `maxNormalForce`
/// newtons each if there is a limit. Throws like equilibrium(), and for a load of zero.
[[nodiscard]] LargestLoad largestLoad(std::span<const WrenchCone> cones, const VectorArg& load,
                                      std::optional<double> maxNormalForce = {});

}  // namespace rex
