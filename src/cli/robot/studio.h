#pragma once

#include <string>
#include <vector>

#include "cli/robot/render_plan.h"
#include "render/bounds.h"
#include "render/contact_sheet.h"
#include "render/image.h"
#include "render/picture.h"
#include "render/renderer.h"

namespace rex::cli {

/// Draws pictures of one scene according to a plan, with several cameras side by side.
class Studio {
 public:
  /// `scene` bounds everything that will be seen. Throws Error like Renderer.
  Studio(const RenderPlan& plan, const Bounds& scene);

  /// The renderer and the views, on one line.
  [[nodiscard]] std::string describe() const;
  /// Draws a picture, with all cameras turned by `angle` (rad, counterclockwise) about the vertical through
  /// their targets. Throws Error like View::camera() and Renderer::drawFrame(), and Interrupted.
  [[nodiscard]] Image draw(const Picture& picture, double angle = 0);
  /// Whether any part of the scene has been visible so far; always true for depth and segmentation images.
  [[nodiscard]] bool sawSomething() const { return sawSomething_; }
  /// Throws UsageError unless sawSomething().
  void requireSomethingSeen() const;

 private:
  Image drawFrom(const Picture& picture, const Camera& camera);

  RenderPlan plan_;
  Bounds scene_;
  Renderer renderer_;
  bool sawSomething_ = false;
};

/// The pictures (at least one) in rows of three with their captions, at full size.
[[nodiscard]] Image sheetOf(const std::vector<KeyFrame>& pictures);

/// The box that contains `scene` for any rotation about the vertical through its centre.
[[nodiscard]] Bounds turningBox(const Bounds& scene);

}  // namespace rex::cli
