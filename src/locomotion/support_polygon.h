#pragma once

#include <string>

#include <Eigen/Core>

#include "base/vector_arg.h"

namespace rex {

/// What the points of contact span. Only on a polygon can a robot rest in spite of small pushes.
enum class SupportShape { kNone, kPoint, kLine, kPolygon };

/// The hull of all contacts on flat, level ground, seen from above (slide 11:7).
struct SupportPolygon {
  SupportShape shape = SupportShape::kNone;
  /// 2 x k, x and y in W, metres: counter-clockwise, a billionth of the size or more apart, and each turning
  /// by more than a billionth of a radian; of a line its ends.
  Eigen::Matrix2Xd corners{};
  double area = 0;        ///< m^2
  std::string message{};  ///< where it is not a polygon: what the contacts lack
};

/// Contacts (2 x N, x and y in W, metres) in any order, also several in one place; none give kNone. What is
/// thinner than a billionth of its length is a line. Throws Error for a number that is not finite.
[[nodiscard]] SupportPolygon supportPolygon(const Eigen::Ref<const Eigen::Matrix2Xd>& contacts);

/// Where a point lies in a support polygon.
struct SupportMargin {
  bool isInside = false;  ///< by the margin that was asked for, or more; never without a polygon
  /// Metres to the boundary: negative outside; on a line or a point 0, beside them negative; without any
  /// contact minus infinity.
  double margin = 0;
  Eigen::Vector2d nearest = Eigen::Vector2d::Zero();  ///< of the boundary, x and y in W
  std::string message{};                              ///< "inside by 0.02 m", or why not
};

/// The margin of `point` (x and y in W, metres) in `support`. Of the centre of mass it tells static
/// stability (slide 11:7), of the zero moment point dynamic stability (slide 11:11). Throws Error for a point
/// that is not finite, and a negative wantedMargin.
[[nodiscard]] SupportMargin supportMargin(const SupportPolygon& support, const Eigen::Vector2d& point,
                                          double wantedMargin = 0);

}  // namespace rex
