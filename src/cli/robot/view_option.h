#pragma once

#include <filesystem>
#include <string>

#include "render/camera.h"

namespace rex::cli {

/// The axis of W that a robot faces: -y in .ors files, like the course's robots; +x in URDF and all other
/// formats, by the ROS convention (REP 103).
enum class Facing { kMinusY, kPlusX };

/// The facing that the extension of a scene's file implies.
[[nodiscard]] Facing facingOf(const std::filesystem::path& file);

/// The position of `--camera TEXT`: "front", "back", "left", "right" or "top" of a robot, or "default", the
/// same direction for all; "x,y,z", a direction from the scene; or "x,y,z@x,y,z", the eye and its target,
/// metres.
class View {
 public:
  /// Throws UsageError naming the nearest view, or what cannot be parsed.
  explicit View(const std::string& text, Facing facing = Facing::kMinusY);

  /// The text and, for a named view, the axis from which it looks: "front (from +x)".
  [[nodiscard]] const std::string& label() const { return label_; }

  /// The camera; views without an eye show all of `bounds`. Throws like framing() and lookAt().
  [[nodiscard]] Camera camera(const Bounds& bounds, double aspect) const;
  /// The point it looks at, in W, metres: the given target, else the centre of `bounds`.
  [[nodiscard]] Eigen::Vector3d target(const Bounds& bounds) const {
    return hasEye_ ? target_ : bounds.center();
  }
  /// From the target to the camera, in W, of any length.
  [[nodiscard]] Eigen::Vector3d direction() const { return direction_; }

 private:
  std::string label_;
  bool hasEye_ = false;
  Eigen::Vector3d direction_ = kDefaultView;
  Eigen::Vector3d eye_{0, 0, 0}, target_{0, 0, 0};
};

}  // namespace rex::cli
