#pragma once

#include <string>

#include <Eigen/Core>

#include "base/vector_arg.h"

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

}  // namespace rex
