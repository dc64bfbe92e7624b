#pragma once
// Cameras, and the boxes that they look at.
#include <limits>
#include <numbers>
#include <optional>

#include <Eigen/Core>

#include "geometry/pose.h"

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

/// A pinhole camera. Its frame C has x to the right, y up, and looks along -z, as in OpenGL.
struct Camera {
  Pose X_WC{};
  double verticalFov = std::numbers::pi / 5;  ///< full angle between the top and bottom of the picture, rad
  double nearPlane = 0.05;                    ///< metres; nothing nearer is drawn
  double farPlane = 100;                      ///< metres; nothing farther is drawn
};

/// A camera at `eye` with `target` in the middle of the picture and z up (x up if it looks straight up or
/// down). Both are in W, metres. Throws Error if they coincide or are not finite.
[[nodiscard]] Camera lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target);

/// From the front, the right and a little above: the view in which the course shows its robots.
inline const Eigen::Vector3d kDefaultView{1.2, -2.0, 0.9};

/// The nearest camera that sees all of `bounds`, with a margin and in the middle of a picture of
/// width / height = `aspect`. It is in `direction` (W, any length) from the scene, at least the scene's
/// radius away. Throws Error for empty or infinite bounds, a zero direction, or an aspect that is not
/// positive.
[[nodiscard]] Camera framing(const Bounds& bounds, const Eigen::Vector3d& direction, double aspect);

/// The image of a point in space: pixels from the left and from the top edge (0.5 is the middle of the
/// first pixel), and depth in metres along the camera's axis.
struct PixelPoint {
  double x = 0, y = 0, depth = 0;
};

/// The image of p_WQ (metres), which may lie outside the picture; none for a point that is not in front of
/// the camera.
[[nodiscard]] std::optional<PixelPoint> project(const Camera& camera, const Eigen::Vector3d& p_WQ, int width,
                                                int height);

/// OpenGL's clip coordinates of a homogeneous point in W, for a picture of width / height = `aspect`.
[[nodiscard]] Eigen::Matrix4d clipFromWorld(const Camera& camera, double aspect);

}  // namespace rex
