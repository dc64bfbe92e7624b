#include <algorithm>
#include <cassert>

#include <Eigen/Geometry>

#include "render/shaders_internal.h"
#include "render/shadow_map_internal.h"

namespace rex::internal {
namespace {

constexpr int kMapSize = 1024;

// Rows: two directions perpendicular to the light, and the one towards it.
Eigen::Matrix3d lightAxes(const Eigen::Vector3d& toLight) {
  Eigen::Matrix3d R_LW;
  R_LW.row(2) = toLight.normalized();
  R_LW.row(0) = R_LW.row(2).transpose().unitOrthogonal();
  R_LW.row(1) = Eigen::Vector3d(R_LW.row(2)).cross(Eigen::Vector3d(R_LW.row(0)));
  return R_LW;
}

// Whether two items cast the same shadow.
bool castAlike(const DrawItem& a, const DrawItem& b) {
  return a.mesh == b.mesh && a.detail == b.detail && a.X_WS.R == b.X_WS.R && a.X_WS.p == b.X_WS.p &&
         a.halfSize == b.halfSize && a.stretch == b.stretch && a.imported == b.imported &&
         a.firstTriangle == b.firstTriangle && a.triangleCount == b.triangleCount;
}

}  // namespace

ShadowView fitShadowView(const std::vector<DrawItem>& casters, const Eigen::Vector3d& toLight, int mapSize) {
  ShadowView view;
  if (casters.empty()) return view;
  const Eigen::Matrix3d R_LW = lightAxes(toLight);
  Bounds box;
  for (const DrawItem& item : casters) {
    const Eigen::Vector3d middle = R_LW * item.X_WS.p,
                          half = (R_LW * item.X_WS.R).cwiseAbs() * halfExtent(item);
    box.include(middle - half);
    box.include(middle + half);
  }
  // An empty rim, which represents everything outside, and some depth for casters that are flat along the
  // light.
  Eigen::Vector3d size = box.high - box.low;
  size += Eigen::Vector3d::Constant(4 * size.head<2>().maxCoeff() / mapSize);
  view.texel = size.head<2>().maxCoeff() / mapSize;
  const Eigen::Vector3d scale = size.cwiseInverse().cwiseProduct(Eigen::Vector3d(2, 2, -2));
  view.clipFromWorld.topLeftCorner<3, 3>() = scale.asDiagonal() * R_LW;
  view.clipFromWorld.topRightCorner<3, 1>() = -scale.cwiseProduct(box.center());
  return view;
}

ShadowMap::ShadowMap(const GlFunctions& gl)
    : gl_(&gl), program_(gl, depthShader().vertex, depthShader().fragment) {
  GLuint texture = 0;
  gl.GenTextures(1, &texture);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT16, kMapSize, kMapSize, 0, GL_DEPTH_COMPONENT,
                GL_UNSIGNED_SHORT, nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  gl.GenFramebuffers(1, &framebuffer_);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture, 0);
  gl.DrawBuffer(GL_NONE);
  gl.ReadBuffer(GL_NONE);
  // OpenGL 3.3 promises that a depth texture of this format and size can be drawn into.
  assert(gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
}

ShadowView ShadowMap::draw(const std::vector<DrawItem>& casters, const Eigen::Vector3d& toLight,
                           const MeshStore& meshes) {
  const ShadowView view = fitShadowView(casters, toLight, kMapSize);
  std::vector<DrawItem> items = casters;
  for (DrawItem& item : items) item.detail = std::min(item.detail, detailFor(radiusOf(item) / view.texel));
  if (drawnToLight_ == toLight && std::ranges::equal(items, drawn_, castAlike)) return view;
  gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_->Viewport(0, 0, kMapSize, kMapSize);
  gl_->Clear(GL_DEPTH_BUFFER_BIT);
  program_.use();
  program_.set("shadowClipFromWorld", view.clipFromWorld);
  for (const DrawItem& item : items) {
    meshes.cullBackOf(item);  // what is nearest to the light faces it
    meshes.draw(item, program_);
  }
  gl_->Disable(GL_CULL_FACE);
  drawnToLight_ = toLight;
  drawn_ = std::move(items);
  return view;
}

}  // namespace rex::internal
