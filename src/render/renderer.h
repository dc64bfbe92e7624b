#pragma once

#include <memory>
#include <string>

#include "render/camera.h"
#include "render/depth_image.h"
#include "render/gl_context.h"
#include "render/image.h"
#include "render/picture.h"

namespace rex {

/// Anti-aliasing of solid edges (lines and points are always smooth): none; by colour contrast in the
/// finished picture, for films; by four samples per pixel, for stills.
enum class AntiAliasing { kNone, kFxaa, kMsaa4 };

/// That of frames of a film: in motion, the best one would look no different.
inline constexpr AntiAliasing kFilmAntiAliasing = AntiAliasing::kFxaa;

/// Settings for drawing pictures; their content is a Picture.
struct RendererOptions {
  int width = 640;  ///< pixels, 1 to 8192
  int height = 480;
  AntiAliasing antiAliasing = AntiAliasing::kMsaa4;
  bool shadow = true;
  Color backgroundTop{0.93f, 0.95f, 0.97f};
  Color backgroundBottom{0.995f, 0.995f, 0.995f};
  GlOptions gl{};
};

/// A picture in a film. It may show nothing, as when the whole scene is out of view.
struct DrawnFrame {
  Image image{};
  bool showsSomething = false;  ///< a solid, line or point, or anything if the picture has none of them
};

/// Throws Error for a size out of range.
void requireValid(const RendererOptions& options);

/// Draws pictures without a window, by OpenGL in software. The same picture gives the same bytes. Only one
/// thread may use it at a time, but each call may come from a different one.
class Renderer {
 public:
  /// Throws Error as requireValid() and makeGlContext().
  explicit Renderer(const RendererOptions& options = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Throws Error as requireDrawable(); for a camera with an invalid pose, planes or angle; if none of the
  /// solids, lines and points is visible, whatever the ground and text show; and, for a picture without
  /// any, if each row of the image has a single colour.
  [[nodiscard]] Image draw(const Picture& picture, const Camera& camera);
  /// The same for a film, in which a frame may show nothing: then the result says so, and nothing is thrown.
  [[nodiscard]] DrawnFrame drawFrame(const Picture& picture, const Camera& camera);

  /// The depth of the nearest solid or the ground in the middle of each pixel. Translucent solids count;
  /// lines, points, arrows, ellipsoids and text do not. Round solids are rounder than in a picture, by up
  /// to half a pixel. An empty view is no error. Throws Error as requireDrawable(), and for cameras as
  /// draw().
  [[nodiscard]] DepthImage drawDepth(const Picture& picture, const Camera& camera);
  /// The index of that solid. Otherwise as drawDepth().
  [[nodiscard]] SegmentationImage drawSegmentation(const Picture& picture, const Camera& camera);

  /// Backend, OpenGL version, renderer and anti-aliasing in use, on one line.
  [[nodiscard]] std::string describe() const;
  [[nodiscard]] const RendererOptions& options() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rex
