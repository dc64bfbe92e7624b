#pragma once

#include <memory>
#include <string>

#include "render/camera.h"
#include "render/depth_image.h"
#include "render/gl_context.h"
#include "render/image.h"
#include "render/picture.h"
#include "render/segmentation_image.h"

namespace rex {

/// Anti-aliasing of solid edges (lines and points are always smooth): none; by colour contrast in the
/// finished picture, for films; by four samples per pixel, for stills.
enum class AntiAliasing { kNone, kFxaa, kMsaa4 };

/// How pictures are made; what they show is a Picture.
struct RendererOptions {
  int width = 640;  ///< pixels, 1 to 8192
  int height = 480;
  AntiAliasing antiAliasing = AntiAliasing::kMsaa4;
  bool shadow = true;
  Color backgroundTop{0.93f, 0.95f, 0.97f};
  Color backgroundBottom{0.995f, 0.995f, 0.995f};
  GlOptions gl{};
};

/// A picture in a film: it may show nothing, as when all of the scene is far away.
struct DrawnFrame {
  Image image{};
  bool showsSomething = false;  ///< a solid, line or point; of a picture with none of them, anything
};

/// Throws Error for a size out of range.
void requireValid(const RendererOptions& options);

/// Draws pictures without a window, by OpenGL in software. The same picture gives the same bytes.
/// To be used by one thread at a time, which may be another one for each call.
class Renderer {
 public:
  /// Throws Error as requireValid() and makeGlContext().
  explicit Renderer(const RendererOptions& options = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Throws Error as requireDrawable(); for a camera whose pose, planes or angle make no sense; when none of
  /// the solids, lines and points is seen, whatever the ground and text show; and, for a picture without
  /// any, when all rows of the image are of one colour.
  [[nodiscard]] Image draw(const Picture& picture, const Camera& camera);
  /// The same for a film, of which one frame may show nothing: then it says so instead of throwing.
  [[nodiscard]] DrawnFrame drawFrame(const Picture& picture, const Camera& camera);

  /// How far the nearest solid or the ground is in the middle of each pixel. Translucent solids count; lines,
  /// points, arrows, ellipsoids and text do not. Round solids are rounder than in a picture, by up to half a
  /// pixel. Nothing in view is not an error. Throws Error as requireDrawable(), and for a camera as draw().
  [[nodiscard]] DepthImage drawDepth(const Picture& picture, const Camera& camera);
  /// Which solid that is. Otherwise as drawDepth().
  [[nodiscard]] SegmentationImage drawSegmentation(const Picture& picture, const Camera& camera);

  /// Backend, OpenGL version, renderer and anti-aliasing in use, on one line.
  [[nodiscard]] std::string describe() const;
  [[nodiscard]] const RendererOptions& options() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rex
