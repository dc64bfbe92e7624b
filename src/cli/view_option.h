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

 private:
  bool hasEye_ = false;
  Eigen::Vector3d direction_ = kDefaultView;  // without an eye
  Eigen::Vector3d eye_ = Eigen::Vector3d::Zero(), target_ = Eigen::Vector3d::Zero();
};

}  // namespace rex::cli
