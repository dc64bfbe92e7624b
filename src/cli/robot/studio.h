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

/// Draws pictures of one scene as a plan asks for, those of several cameras side by side.
class Studio {
 public:
  /// `scene` is all that will be seen. Throws Error as Renderer.
  Studio(const RenderPlan& plan, const Bounds& scene);

  /// The renderer and the views, on one line.
  [[nodiscard]] std::string describe() const;
  /// All cameras may be turned by `angle` (rad, counterclockwise) about the vertical through what they look
  /// at. Throws Error as View::camera() and Renderer::drawFrame(), and Interrupted.
  [[nodiscard]] Image draw(const Picture& picture, double angle = 0);
  /// Whether anything of the scene was seen so far; of depth and segmentation images, always.
  [[nodiscard]] bool sawSomething() const { return sawSomething_; }
  /// Throws UsageError unless it was.
  void requireSomethingSeen() const;

 private:
  Image drawFrom(const Picture& picture, const Camera& camera);

  RenderPlan plan_;
  Bounds scene_;
  Renderer renderer_;
  bool sawSomething_ = false;
};

/// The pictures in rows of three with their captions, none shrunk; at least one.
[[nodiscard]] Image sheetOf(const std::vector<KeyFrame>& pictures);

/// The box that holds `scene` however it is turned about the vertical through its middle.
[[nodiscard]] Bounds turningBox(const Bounds& scene);

}  // namespace rex::cli
