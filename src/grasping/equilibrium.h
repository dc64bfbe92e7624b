#pragma once

#include <optional>
#include <span>
#include <string>

#include "grasping/wrench_cone.h"

namespace rex {

/// kUndecided: the load lies so near to the border that rounding decides.
enum class EquilibriumStatus { kHeld, kNotHeld, kUndecided };

/// Whether contacts hold a load, with the forces that do, or the direction that gives way.
struct Equilibrium {
  EquilibriumStatus status = EquilibriumStatus::kUndecided;
  /// kHeld: what each contact exerts, in its own contactFrame(), newtons: along the normal, then the
  /// tangents. 3 x contacts, in the plane 2 x contacts; the normal forces have the least sum. Else empty.
  Eigen::MatrixXd forces_C{};
  /// kNotHeld, d: a unit vector along which the load pushes more than all contacts together can push back;
  /// without contacts that of the load. Else empty.
  Eigen::VectorXd direction{};
  /// kHeld: what is left of the load, newtons. kNotHeld: by how much the load wins along `direction`.
  double residual = 0;
  std::string message{};
};

/// Contact forces within exact friction cones that balance `load` (d, see weightWrench()): slide 10:7. No
/// normal force is larger than `maxNormalForce` (newtons), if there is one. Linear programs on edges, which
/// are added where the cones give more, to 1e-9 of the load. Throws Error as primitiveWrenches(), for a load
/// of another size or not finite, and a limit that is not positive.
[[nodiscard]] Equilibrium equilibrium(std::span<const WrenchCone> cones, const VectorArg& load,
                                      std::optional<double> maxNormalForce = {});

/// kBounded: `factor` times the load is the most that can be held. kUnbounded: any multiple.
enum class LoadStatus { kBounded, kUnbounded, kUndecided };

/// How many times the load can be held.
struct LargestLoad {
  LoadStatus status = LoadStatus::kUndecided;
  double factor = 0;            ///< of kBounded; zero if the load cannot be held at all
  Eigen::MatrixXd forces_C{};   ///< of kBounded: those that hold this multiple, as in Equilibrium
  Eigen::VectorXd direction{};  ///< of kBounded, d, unit: what gives way first
  std::string message{};
};

/// The largest multiple of `load` that contacts hold, with normal forces of at most `maxNormalForce` newtons
/// each if there is a limit. Throws as equilibrium(), and for a load of zero.
[[nodiscard]] LargestLoad largestLoad(std::span<const WrenchCone> cones, const VectorArg& load,
                                      std::optional<double> maxNormalForce = {});

}  // namespace rex
