#include "render/renderer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "geometry/rotation.h"
#include "render/draw_list_internal.h"
#include "render/frame_buffer_internal.h"
#include "render/gl_program_internal.h"
#include "render/mesh_store_internal.h"
#include "render/overlay_store_internal.h"
#include "render/picture_text_internal.h"
#include "render/sensor_pass_internal.h"
#include "render/shaders_internal.h"
#include "render/shadow_map_internal.h"

namespace rex::internal {

/// Tells whether any of what is drawn under its eyes reaches the picture.
class Visibility {
 public:
  explicit Visibility(const GlFunctions& gl);

  /// Forgets the picture before.
  void start() { used_ = 0; }
  /// Calls `draw` and notes whether the depth test lets a sample of it pass. Not nested; at most three times
  /// after start().
  template <typename Draw>
  void watch(const Draw& draw) {
    assert(used_ < queries_.size());
    gl_->BeginQuery(GL_ANY_SAMPLES_PASSED, queries_[used_++]);
    draw();
    gl_->EndQuery(GL_ANY_SAMPLES_PASSED);
  }
  /// Whether any sample passed since start().
  [[nodiscard]] bool anySeen() const;

 private:
  const GlFunctions* gl_;
  std::array<GLuint, 3> queries_{};
  std::size_t used_ = 0;
};

Visibility::Visibility(const GlFunctions& gl) : gl_(&gl) {
  gl.GenQueries(static_cast<GLsizei>(queries_.size()), queries_.data());
}

bool Visibility::anySeen() const {
  bool seen = false;
  for (std::size_t i = 0; i < used_; ++i) {
    GLuint samples = 0;
    gl_->GetQueryObjectuiv(queries_[i], GL_QUERY_RESULT, &samples);
    seen |= samples > 0;
  }
  return seen;
}

}  // namespace rex::internal

namespace rex {
namespace {

using internal::DrawItem;
using internal::DrawList;
using internal::GlFunctions;
using internal::GlProgram;
using internal::ShaderSource;

constexpr int kLargestImage = 8192;  // pixels
constexpr int kSamples = 4;          // per pixel, of AntiAliasing::kMsaa4

const RendererOptions& checked(const RendererOptions& options) {
  requireValid(options);
  return options;
}

void requireUsable(const Camera& camera) {
  const bool finite = camera.X_WC.R.allFinite() && camera.X_WC.p.allFinite();
  if (!finite)
    throw Error({.what = "camera", .found = "a pose that is not finite", .wanted = "finite numbers"});
  if (!isRotation(camera.X_WC.R))
    throw Error({.what = "camera",
                 .found = "a pose whose matrix is not a rotation",
                 .wanted = "orthonormal axes, right-handed"});
  if (!(camera.verticalFov > 0 && camera.verticalFov < 3.1))
    throw Error({.what = "camera",
                 .found = fmt::format("a vertical field of view of {} rad", camera.verticalFov),
                 .wanted = "between 0 and 3.1"});
  if (!(camera.nearPlane > 0 && camera.farPlane > camera.nearPlane && std::isfinite(camera.farPlane)))
    throw Error({.what = "camera",
                 .found = fmt::format("near {} m, far {} m", camera.nearPlane, camera.farPlane),
                 .wanted = "0 < near < far"});
}

// The wanted anti-aliasing, or the best that the driver supports.
AntiAliasing supported(const GlFunctions& gl, AntiAliasing wanted) {
  GLint most = 1;
  gl.GetIntegerv(GL_MAX_SAMPLES, &most);
  return wanted == AntiAliasing::kMsaa4 && most < kSamples ? AntiAliasing::kFxaa : wanted;
}

GlProgram makeProgram(const GlFunctions& gl, const ShaderSource& source) {
  return {gl, source.vertex, source.fragment};
}

GlFunctions currentFunctions(GlContext& context) {
  context.makeCurrent();
  return internal::loadGlFunctions(context);
}

// The background changes from row to row only, so a picture of nothing has rows of one colour. (A single
// column does not show that.)
bool showsNothing(const Image& image) {
  if (image.width == 1) return false;
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* row = image.pixel(0, y);
    if (!std::equal(row + 3, row + 3 * image.width, row)) return false;
  }
  return true;
}

// Whether there is more than ground and text. A polyline of one point draws nothing.
bool hasScene(const Picture& picture, const DrawList& list) {
  const auto any = [](const auto& things, const auto& isDrawn) {
    return std::any_of(things.begin(), things.end(), isDrawn);
  };
  return !list.opaque.empty() || !list.translucent.empty() || !picture.axes.empty() ||
         any(picture.polylines, [](const Polyline& line) { return line.points.size() > 1; }) ||
         any(picture.lineSets, [](const LineSet& lines) { return !lines.segments.empty(); }) ||
         any(picture.pointSets, [](const PointSet& set) { return !set.points.empty(); }) ||
         any(picture.solids, internal::isOverlay);
}

// Directs OpenGL calls of this thread to a context, and releases the context at the end, so that another
// thread can use it.
class CurrentContext {
 public:
  explicit CurrentContext(GlContext& context) : context_(context) { context.makeCurrent(); }
  ~CurrentContext() { context_.letGo(); }
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;

 private:
  GlContext& context_;
};

}  // namespace

void requireValid(const RendererOptions& options) {
  const auto inRange = [](int size) { return size >= 1 && size <= kLargestImage; };
  if (!inRange(options.width) || !inRange(options.height))
    throw Error({.what = "picture size",
                 .found = fmt::format("{} x {}", options.width, options.height),
                 .wanted = fmt::format("1 to {} pixels each way", kLargestImage)});
}

// All OpenGL objects belong to the context and end with it.
struct Renderer::Impl {
  explicit Impl(const RendererOptions& wanted);
  struct Drawing {
    Image image{};
    bool hasScene = false, sceneSeen = false;
  };
  Drawing draw(const Picture& picture, const Camera& camera);
  internal::SensorImages drawSensors(const Picture& picture, const Camera& camera);
  void setLight(const GlProgram& program, const Picture& picture, const internal::ShadowView& shadow) const;
  void setBackground(const GlProgram& program) const;
  void drawBackground() const;
  void drawGround(const Picture& picture, const Camera& camera, const internal::ShadowView& shadow) const;
  void drawSolids(const DrawList& list, const Picture& picture, const Camera& camera,
                  const internal::ShadowView& shadow);
  void drawOverlay(const Picture& picture, const Camera& camera);
  Eigen::Matrix4d clip(const Camera& camera) const {
    return clipFromWorld(camera, static_cast<double>(options.width) / options.height);
  }

  RendererOptions options;
  std::unique_ptr<GlContext> context;
  GlFunctions gl;
  AntiAliasing antiAliasing;
  internal::FrameBuffer frame;
  internal::MeshStore meshes;
  internal::ShadowMap shadowMap;
  internal::Visibility visibility;
  GlProgram background, ground, solid, overlay;
  std::optional<GlProgram> textured;  // made when first needed, as the sensors
  std::optional<internal::Fxaa> fxaa;
  std::optional<internal::SensorPass> sensors;  // made when first asked for
  internal::OverlayStore overlayStore;
  GLuint noVertices = 0;
};

Renderer::Impl::Impl(const RendererOptions& wanted)
    : options(checked(wanted)),
      context(makeGlContext(options.gl)),
      gl(currentFunctions(*context)),
      antiAliasing(supported(gl, options.antiAliasing)),
      frame(gl, options.width, options.height,
            {.samples = antiAliasing == AntiAliasing::kMsaa4 ? kSamples : 1,
             .twoStages = antiAliasing == AntiAliasing::kFxaa}),
      meshes(gl),
      shadowMap(gl),
      visibility(gl),
      background(makeProgram(gl, internal::backgroundShader())),
      ground(makeProgram(gl, internal::groundShader(options.shadow))),
      solid(makeProgram(gl, internal::solidShader(options.shadow))),
      overlay(makeProgram(gl, internal::overlayShader())),
      overlayStore(gl) {
  if (antiAliasing == AntiAliasing::kFxaa) fxaa.emplace(gl);
  gl.GenVertexArrays(1, &noVertices);
  gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  internal::requireNoGlError(gl, "setting up");
}

void Renderer::Impl::setLight(const GlProgram& program, const Picture& picture,
                              const internal::ShadowView& shadow) const {
  program.set("toLight", Eigen::Vector3d(picture.toLight.normalized()));
  if (!options.shadow) return;
  program.set("shadowClipFromWorld", shadow.clipFromWorld);
  program.set("shadowTexel", shadow.texel);
}

void Renderer::Impl::setBackground(const GlProgram& program) const {
  program.set("backgroundTop", options.backgroundTop);
  program.set("backgroundBottom", options.backgroundBottom);
  program.set("pictureHeight", options.height);
}

// Drawn after everything that hides it, so that each pixel is shaded once.
void Renderer::Impl::drawBackground() const {
  background.use();
  setBackground(background);
  gl.BindVertexArray(noVertices);
  gl.DepthFunc(GL_LEQUAL);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  gl.DepthFunc(GL_LESS);
}

void Renderer::Impl::drawGround(const Picture& picture, const Camera& camera,
                                const internal::ShadowView& shadow) const {
  const Ground& plane = picture.ground;
  const std::optional<internal::GroundDisc> disc = internal::visibleGround(picture, camera);
  if (!disc) return;
  ground.use();
  setLight(ground, picture, shadow);
  setBackground(ground);
  ground.set("clipFromWorld", clip(camera));
  ground.set("groundCenter", disc->center);
  ground.set("groundRadius", disc->radius);
  ground.set("groundCell", plane.cell);
  ground.set("groundLight", plane.light);
  ground.set("groundDark", plane.dark);
  gl.BindVertexArray(noVertices);
  gl.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void Renderer::Impl::drawSolids(const DrawList& list, const Picture& picture, const Camera& camera,
                                const internal::ShadowView& shadow) {
  const auto isTextured = [](const DrawItem& item) { return item.texture.has_value(); };
  const bool anyTextured =
      std::ranges::any_of(list.opaque, isTextured) || std::ranges::any_of(list.translucent, isTextured);
  const auto draw = [&](const DrawItem& item, float opacity) {
    const GlProgram& program = item.texture ? *textured : solid;
    if (anyTextured) program.use();
    if (item.texture) meshes.bindTexture(item);
    Color color = item.color;
    color.a = opacity;
    program.set("solidColor", color);
    meshes.draw(item, program);
  };
  const auto prepare = [&](const GlProgram& program) {
    program.use();
    setLight(program, picture, shadow);
    program.set("clipFromWorld", clip(camera));
    program.set("eye", camera.X_WC.p);
  };
  if (anyTextured) {
    if (!textured) textured.emplace(makeProgram(gl, internal::solidShader(options.shadow, true)));
    prepare(*textured);
    textured->setTexture("surface", internal::MeshStore::kTextureUnit);
  }
  prepare(solid);
  visibility.watch([&] {
    for (const DrawItem& item : list.opaque) {
      meshes.cullBackOf(item);
      draw(item, 1);
    }
  });
  gl.Disable(GL_CULL_FACE);
  drawGround(picture, camera, shadow);
  drawBackground();
  solid.use();
  gl.Enable(GL_CULL_FACE);
  gl.Enable(GL_BLEND);
  gl.DepthMask(GL_FALSE);
  visibility.watch([&] {
    for (const DrawItem& item : list.translucent) {
      const float side = 1 - std::sqrt(1 - item.color.a);  // far and near side together have its opacity
      for (const GLenum hidden : {GL_FRONT, GL_BACK}) {
        gl.CullFace(hidden);
        draw(item, side);
      }
    }
  });
  gl.DepthMask(GL_TRUE);
  gl.Disable(GL_BLEND);
  gl.Disable(GL_CULL_FACE);
}

void Renderer::Impl::drawOverlay(const Picture& picture, const Camera& camera) {
  constexpr double kHiddenOpacity = 0.3;
  overlayStore.load(picture, camera, options.width, options.height);
  if (overlayStore.isEmpty()) return;
  overlay.use();
  gl.Enable(GL_BLEND);
  gl.Disable(GL_MULTISAMPLE);  // it is smooth anyway, and this halves the cost
  gl.DepthMask(GL_FALSE);
  visibility.watch([&] {
    for (const bool hidden : {true, false}) {
      gl.DepthFunc(hidden ? GL_GREATER : GL_LEQUAL);
      overlay.set("opacity", hidden ? kHiddenOpacity : 1.0);
      overlayStore.draw();
    }
  });
  gl.Enable(GL_MULTISAMPLE);
  gl.DepthMask(GL_TRUE);
  gl.DepthFunc(GL_LESS);
  gl.Disable(GL_BLEND);
}

Renderer::Impl::Drawing Renderer::Impl::draw(const Picture& picture, const Camera& camera) {
  requireDrawable(picture);
  requireUsable(camera);
  const CurrentContext current(*context);
  const DrawList list = internal::makeDrawList(picture, camera, options.height);
  meshes.prepare(list);

  gl.Enable(GL_DEPTH_TEST);
  internal::ShadowView shadow;
  if (options.shadow) shadow = shadowMap.draw(list.opaque, picture.toLight, meshes);
  frame.bind();
  gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  visibility.start();
  drawSolids(list, picture, camera, shadow);
  if (fxaa) fxaa->smooth(frame);
  drawOverlay(picture, camera);

  Drawing drawing{
      .image = frame.read(), .hasScene = hasScene(picture, list), .sceneSeen = visibility.anySeen()};
  internal::drawPictureText(drawing.image, picture, camera);
  return drawing;
}

internal::SensorImages Renderer::Impl::drawSensors(const Picture& picture, const Camera& camera) {
  constexpr int kFiner = 8;  // than in a picture: round solids are off by a sixteenth of a pixel at most
  requireDrawable(picture);
  requireUsable(camera);
  const CurrentContext current(*context);
  if (!sensors) sensors.emplace(gl, options.width, options.height);
  const DrawList list = internal::makeDrawList(picture, camera, kFiner * options.height);
  meshes.prepare(list);
  return sensors->draw(list, picture, camera, meshes);
}

Renderer::Renderer(const RendererOptions& options) : impl_(std::make_unique<Impl>(options)) {
  impl_->context->letGo();
}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Image Renderer::draw(const Picture& picture, const Camera& camera) {
  Impl::Drawing drawing = impl_->draw(picture, camera);
  if (drawing.hasScene && !drawing.sceneSeen)
    throw Error({.what = "the picture shows nothing of the scene",
                 .found = "all solids, lines and points outside it",
                 .wanted = "a camera that sees some of them; see framing()"});
  if (!drawing.hasScene && showsNothing(drawing.image))
    throw Error({.what = "the picture is blank",
                 .found = "nothing that stands out from the background",
                 .wanted = "a solid, line, point, text or the ground in view"});
  return std::move(drawing.image);
}

DrawnFrame Renderer::drawFrame(const Picture& picture, const Camera& camera) {
  Impl::Drawing drawing = impl_->draw(picture, camera);
  const bool shows = drawing.hasScene ? drawing.sceneSeen : !showsNothing(drawing.image);
  return {std::move(drawing.image), shows};
}

DepthImage Renderer::drawDepth(const Picture& picture, const Camera& camera) {
  return impl_->drawSensors(picture, camera).depth;
}

SegmentationImage Renderer::drawSegmentation(const Picture& picture, const Camera& camera) {
  return impl_->drawSensors(picture, camera).segmentation;
}

std::string Renderer::describe() const {
  const CurrentContext current(*impl_->context);
  const auto text = [&](GLenum what) { return reinterpret_cast<const char*>(impl_->gl.GetString(what)); };
  const char* smooth = impl_->antiAliasing == AntiAliasing::kMsaa4  ? "4 samples per pixel"
                       : impl_->antiAliasing == AntiAliasing::kNone ? "no anti-aliasing"
                       : impl_->options.antiAliasing == AntiAliasing::kMsaa4
                           ? "FXAA (4 samples are not supported)"
                           : "FXAA";
  return fmt::format("{}, OpenGL {}, {}, {}", impl_->context->describe(), text(GL_VERSION), text(GL_RENDERER),
                     smooth);
}

const RendererOptions& Renderer::options() const { return impl_->options; }

}  // namespace rex
