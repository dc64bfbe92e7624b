#pragma once

#include <optional>
#include <vector>

#include "locomotion/support_polygon.h"

namespace rex {

enum class Side { kLeft, kRight };

/// A foot flat on the ground: the middle of its sole in W, and where it points.
struct Footstep {
  Side side = Side::kLeft;
  Eigen::Vector2d p = Eigen::Vector2d::Zero();  ///< metres
  double yaw = 0;                               ///< radians about z, 0 along x; whole turns do not count
};

/// A rectangular sole, metres.
struct Sole {
  double length = 0.24, width = 0.11;
};

/// Where a walk sets its feet, and how long it takes over that. Footsteps 0 and 1 are where both feet stand
/// at first; from 2 on each sets the foot anew that stands further back in the list, sides in turn.
struct WalkPlan {
  std::vector<Footstep> footsteps{};
  Sole sole{};
  double doubleSupport = 0.2;  ///< seconds on both feet before each step
  double singleSupport = 0.7;  ///< seconds of each step on one foot
  double rest = 1.6;           ///< seconds on both feet before the first and after the last step
};

/// Steps of equal length straight along x: both feet start beside the origin, the left one `width` / 2 to
/// its left, the left one steps first, and the last step brings both side by side (the only one steps on the
/// spot). Throws Error for a count below 1, a width that is not positive, and a length that is not finite.
[[nodiscard]] std::vector<Footstep> straightFootsteps(int count, double length, double width);

/// What stands where at a time of the walk.
struct WalkPhase {
  Footstep left{}, right{};         ///< of the foot in the air: where it left
  std::optional<Footstep> swing{};  ///< where the foot in the air goes; none on both feet
  double share = 0;                 ///< of the phase that has passed, 0 to 1
  /// Where the zero moment point should be, metres: the middle of the foot that stands; on both feet it
  /// moves evenly between the middles, at the ends of the walk it starts and ends between the feet.
  Eigen::Vector2d zmp = Eigen::Vector2d::Zero();
};

/// How long the walk takes, seconds. Throws Error for fewer than two footsteps, sides that do not take turns,
/// sizes and times that are not positive, and numbers that are not finite, naming the footstep.
[[nodiscard]] double duration(const WalkPlan& plan);
/// The phase at time t, seconds: before 0 and after duration() those of both ends. Throws as
/// duration().
[[nodiscard]] WalkPhase phaseAt(const WalkPlan& plan, double t);
/// The hull of the soles that stand on the ground in this phase.
[[nodiscard]] SupportPolygon supportOf(const WalkPhase& phase, const Sole& sole);

/// phaseAt().zmp at 0, step, 2 step, ... to the end: 2 x N. Throws as duration(), and for a step that is not
/// positive or gives more than a million columns.
[[nodiscard]] Eigen::Matrix2Xd zmpReference(const WalkPlan& plan, double step);

}  // namespace rex
