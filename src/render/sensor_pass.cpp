#include <algorithm>
#include <limits>

#include "render/own_ground_internal.h"
#include "render/sensor_pass_internal.h"
#include "render/shaders_internal.h"

namespace rex::internal {

std::optional<GroundDisc> visibleGround(const Picture& picture, const Camera& camera) {
  const Ground& plane = picture.ground;
  if (!plane.visible || camera.X_WC.p.z() <= plane.height) return std::nullopt;
  const Bounds scene = plane.scene.isEmpty() ? bounds(picture) : plane.scene;
  const std::optional<double> height = checkerHeight(picture, scene);
  if (!height) return std::nullopt;
  const Eigen::Vector3d middle = scene.isEmpty() ? Eigen::Vector3d::Zero() : scene.center();
  const double radius = scene.isEmpty() ? 1 : scene.radius();
  return GroundDisc{{middle.x(), middle.y(), *height}, std::max(6 * radius, 4 * plane.cell)};
}

namespace {

// OpenGL provides 1 / depth, because it interpolates with it.
constexpr const char* kSolidFragment = R"(#version 330 core
uniform float id;
out vec2 seen;
void main() { seen = vec2(1.0 / gl_FragCoord.w, id); }
)";

constexpr const char* kGroundFragment = R"(#version 330 core
uniform vec3 groundCenter;
uniform float groundRadius, id;
in vec2 ground;
out vec2 seen;
void main() {
  if (distance(ground, groundCenter.xy) > groundRadius) discard;
  seen = vec2(1.0 / gl_FragCoord.w, id);
}
)";

}  // namespace

SensorPass::SensorPass(const GlFunctions& gl, int width, int height)
    : gl_(&gl),
      width_(width),
      height_(height),
      frame_(gl, width, height, {.colors = GL_RG32F}),
      solid_(gl, solidShader(false).vertex, kSolidFragment),
      ground_(gl, groundShader(false).vertex, kGroundFragment) {
  gl.GenVertexArrays(1, &noVertices_);
}

SensorImages SensorPass::draw(const DrawList& list, const Picture& picture, const Camera& camera,
                              const MeshStore& meshes) const {
  const Eigen::Matrix4d clip = clipFromWorld(camera, static_cast<double>(width_) / height_);
  frame_.bind();
  gl_->Enable(GL_DEPTH_TEST);
  gl_->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  solid_.use();
  solid_.set("clipFromWorld", clip);
  for (const std::vector<DrawItem>* items : {&list.opaque, &list.translucent})
    for (const DrawItem& item : *items) {
      if (item.solid < 0) continue;
      solid_.set("id", item.solid);
      meshes.cullBackOf(item);
      meshes.draw(item, solid_);
    }
  gl_->Disable(GL_CULL_FACE);
  drawGround(picture, camera, clip);
  return read();
}

void SensorPass::drawGround(const Picture& picture, const Camera& camera, const Eigen::Matrix4d& clip) const {
  const std::optional<GroundDisc> disc = visibleGround(picture, camera);
  if (!disc) return;
  ground_.use();
  ground_.set("clipFromWorld", clip);
  ground_.set("groundCenter", disc->center);
  ground_.set("groundRadius", disc->radius);
  ground_.set("id", SegmentationImage::kGround);
  gl_->BindVertexArray(noVertices_);
  gl_->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

SensorImages SensorPass::read() const {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  SensorImages images{{width_, height_}, {width_, height_}};
  const std::vector<std::array<float, 2>> pairs = frame_.readPairs();
  images.depth.metres.reserve(pairs.size());
  images.segmentation.id.reserve(pairs.size());
  for (int y = height_ - 1; y >= 0; --y)
    for (int x = 0; x < width_; ++x) {
      const auto [metres, id] = pairs[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + x];
      const bool seen = metres > 0;  // the picture starts with zeros
      images.depth.metres.push_back(seen ? metres : kFar);
      images.segmentation.id.push_back(seen ? static_cast<std::int32_t>(id) : SegmentationImage::kNothing);
    }
  return images;
}

}  // namespace rex::internal
