#pragma once

#include <string>

#include "render/camera.h"

namespace rex::cli {

/// Where `--camera TEXT` stands: "front", "back", "left", "right", "top" or "default" (of a robot that looks
/// along -y, as the course's do); "x,y,z", a direction from the scene; or "x,y,z@x,y,z", the eye and what it
/// looks at, metres.
class View {
 public:
  /// Throws UsageError naming the nearest view, or what cannot be read.
  explicit View(const std::string& text);

  /// The camera; the views without an eye see all of `bounds`. Throws as framing() and lookAt().
  [[nodiscard]] Camera camera(const Bounds& bounds, double aspect) const;
  /// The point it looks at, W, metres: the target next to an eye, else the middle of `bounds`.
  [[nodiscard]] Eigen::Vector3d target(const Bounds& bounds) const {
    return hasEye_ ? target_ : bounds.center();
  }
  /// From what is seen to the camera, W, any length.
  [[nodiscard]] Eigen::Vector3d direction() const { return direction_; }

 private:
  bool hasEye_ = false;
  Eigen::Vector3d direction_ = kDefaultView;
  Eigen::Vector3d eye_ = Eigen::Vector3d::Zero(), target_ = Eigen::Vector3d::Zero();
};

}  // namespace rex::cli
