#pragma once

#include <filesystem>
#include <string>

#include "render/camera.h"

namespace rex::cli {

/// The axis of W along which a robot faces: -y in .ors files, as the course's robots do; +x by the convention
/// of ROS (REP 103) in URDF and all other formats.
enum class Facing { kMinusY, kPlusX };

/// What the ending of a scene's file says about it.
[[nodiscard]] Facing facingOf(const std::filesystem::path& file);

/// Where `--camera TEXT` stands: "front", "back", "left", "right" or "top" of a robot, or "default", the same
/// direction for all; "x,y,z", a direction from the scene; or "x,y,z@x,y,z", the eye and what it looks at,
/// metres.
class View {
 public:
  /// Throws UsageError naming the nearest view, or what cannot be read.
  explicit View(const std::string& text, Facing facing = Facing::kMinusY);

  /// The text, and the axis on which a named view stands: "front (from +x)".
  [[nodiscard]] const std::string& label() const { return label_; }

  /// The camera; the views without an eye see all of `bounds`. Throws as framing() and lookAt().
  [[nodiscard]] Camera camera(const Bounds& bounds, double aspect) const;
  /// The point it looks at, W, metres: the target next to an eye, else the middle of `bounds`.
  [[nodiscard]] Eigen::Vector3d target(const Bounds& bounds) const {
    return hasEye_ ? target_ : bounds.center();
  }
  /// From what is seen to the camera, W, any length.
  [[nodiscard]] Eigen::Vector3d direction() const { return direction_; }

 private:
  std::string label_;
  bool hasEye_ = false;
  Eigen::Vector3d direction_ = kDefaultView;
  Eigen::Vector3d eye_ = Eigen::Vector3d::Zero(), target_ = Eigen::Vector3d::Zero();
};

}  // namespace rex::cli
