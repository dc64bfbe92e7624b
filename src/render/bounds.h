#pragma once

#include <limits>

#include <Eigen/Core>

namespace rex {

/// An axis-aligned box in W, metres; initially empty and enlarged by include().
struct Bounds {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;

  [[nodiscard]] bool isEmpty() const;
  [[nodiscard]] Eigen::Vector3d center() const;
  /// Half the length of its diagonal, metres: the radius of the sphere around it.
  [[nodiscard]] double radius() const;
  /// Corner i = 0..7; bit 0 of i chooses high x, bit 1 high y, bit 2 high z.
  [[nodiscard]] Eigen::Vector3d corner(int i) const;

  void include(const Eigen::Vector3d& point);
};

}  // namespace rex
