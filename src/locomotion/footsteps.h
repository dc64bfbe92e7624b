#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/require.h"

namespace rex {

/// What the contact points span. Only on a polygon can a robot withstand small pushes.
enum class SupportShape { kNone, kPoint, kLine, kPolygon };

/// The hull of all contacts on flat, level ground, seen from above (slide 11:7).
struct SupportPolygon {
  SupportShape shape = SupportShape::kNone;
  /// 2 x k, x and y in W, metres: counter-clockwise, at least a billionth of the size apart, and each
  /// turning by more than a billionth of a radian. For a line its ends.
  Eigen::Matrix2Xd corners{};
  double area = 0;        ///< m^2
  std::string message{};  ///< if it is not a polygon: what the contacts lack
};

/// The hull of contacts (2 x N, x and y in W, metres), in any order and possibly repeated; without any,
/// kNone. A hull thinner than a billionth of its length counts as a line. Throws Error for a number that is
/// not finite.
[[nodiscard]] SupportPolygon supportPolygon(const Eigen::Ref<const Eigen::Matrix2Xd>& contacts);

/// The margin of a point in a support polygon.
struct SupportMargin {
  bool isInside = false;  ///< by at least the wanted margin; never without a polygon
  /// Metres to the boundary, negative outside. For a line or a point: 0 on it, negative off it. Minus
  /// infinity without contacts.
  double margin = 0;
  Eigen::Vector2d nearest{0, 0};  ///< on the boundary, x and y in W
  std::string message{};          ///< "inside by 0.02 m", or why not
};

/// The margin of `point` (x and y in W, metres) in `support`. For the centre of mass it shows static
/// stability (slide 11:7), for the zero moment point dynamic stability (slide 11:11). Throws Error for a
/// point that is not finite, and a negative wantedMargin.
[[nodiscard]] SupportMargin supportMargin(const SupportPolygon& support, const Eigen::Vector2d& point,
                                          double wantedMargin = 0);

enum class Side { kLeft, kRight };

/// A foot flat on the ground: the centre of its sole in W, and its heading.
struct Footstep {
  Side side = Side::kLeft;
  Eigen::Vector2d p{0, 0};  ///< metres
  double yaw = 0;           ///< radians about z, 0 along x; modulo a full turn
};

/// A rectangular sole, metres.
struct Sole {
  double length = 0.24, width = 0.11;
};

/// The footsteps of a walk and their timing. Footsteps 0 and 1 are where both feet stand at first. From 2
/// on, sides alternate: step i moves the foot that stood on footstep i - 2.
struct WalkPlan {
  std::vector<Footstep> footsteps{};
  Sole sole{};
  double doubleSupport = 0.2;  ///< seconds on both feet before each step
  double singleSupport = 0.7;  ///< seconds of each step on one foot
  double rest = 1.6;           ///< seconds on both feet before the first and after the last step
};

/// Steps of equal length straight along x. The feet start on both sides of the origin, `width` apart. The
/// left foot steps first, and the last step brings both side by side (a single one steps on the spot).
/// Throws Error for a count below 1, a width that is not positive, and a length that is not finite.
[[nodiscard]] std::vector<Footstep> straightFootsteps(int count, double length, double width);

/// The feet and the zero moment point at one time of the walk.
struct WalkPhase {
  Footstep left{}, right{};         ///< for the foot in the air: where it lifted off
  std::optional<Footstep> swing{};  ///< where the foot in the air lands; empty on both feet
  double share = 0;                 ///< the fraction of the phase that has passed, 0 to 1
  /// Where the zero moment point should be, metres: the centre of the stance foot. On both feet it moves
  /// uniformly from one centre to the other; at the ends of the walk it starts and ends between the feet.
  Eigen::Vector2d zmp{0, 0};
};

/// How long the walk takes, seconds. Throws Error for fewer than two footsteps, sides that do not
/// alternate, sizes and times that are not positive, and numbers that are not finite, naming the footstep.
[[nodiscard]] double duration(const WalkPlan& plan);
/// The phase at time t, seconds, with t clamped to [0, duration()]. Throws like duration().
[[nodiscard]] WalkPhase phaseAt(const WalkPlan& plan, double t);
/// The hull of the soles on the ground in this phase.
[[nodiscard]] SupportPolygon supportPolygon(const WalkPhase& phase, const Sole& sole);

/// phaseAt().zmp at 0, step, 2 step, ... to the end: 2 x N. Throws like duration(), and for a step that is
/// not positive or gives more than a million columns.
[[nodiscard]] Eigen::Matrix2Xd zmpReference(const WalkPlan& plan, double step);

}  // namespace rex
