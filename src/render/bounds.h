#pragma once

#include <limits>

#include <Eigen/Core>

namespace rex {

/// An axis-aligned box in W, metres; initially empty and enlarged by include().
struct Bounds {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;

  [[nodiscard]] bool isEmpty() const { return (low.array() > high.array()).any(); }
  [[nodiscard]] Eigen::Vector3d center() const { return (low + high) / 2; }
  /// Half the length of its diagonal, metres: the radius of the sphere around it.
  [[nodiscard]] double radius() const { return (high - low).norm() / 2; }
  /// Corner i = 0..7; bit 0 of i chooses high x, bit 1 high y, bit 2 high z.
  [[nodiscard]] Eigen::Vector3d corner(int i) const {
    return {(i & 1 ? high : low).x(), (i & 2 ? high : low).y(), (i & 4 ? high : low).z()};
  }

  void include(const Eigen::Vector3d& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
};

}  // namespace rex
