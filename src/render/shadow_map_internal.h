#pragma once

#include <optional>
#include <vector>

#include "render/mesh_store_internal.h"

namespace rex::internal {

/// How a shader finds the shadow of a point.
struct ShadowView {
  Eigen::Matrix4d clipFromWorld = Eigen::Matrix4d::Identity();
  double texel = 0;  ///< edge length of a map pixel, metres
};

/// The parallel projection along the light that just holds `casters`.
[[nodiscard]] ShadowView fitShadowView(const std::vector<DrawItem>& casters, const Eigen::Vector3d& toLight,
                                       int mapSize);

/// Depths seen from the light, in texture unit 0, compared and filtered by OpenGL. Lit outside the map.
class ShadowMap {
 public:
  explicit ShadowMap(const GlFunctions& gl);
  /// Makes it the map of these casters. Draws nothing where they are those of the last time, as in all frames
  /// of a walk around one posture, and from all cameras. May leave the map's framebuffer bound.
  ShadowView draw(const std::vector<DrawItem>& casters, const Eigen::Vector3d& toLight,
                  const MeshStore& meshes);

 private:
  const GlFunctions* gl_;
  GlProgram program_;
  GLuint framebuffer_ = 0;
  std::optional<Eigen::Vector3d> drawnToLight_;  // none: the map is empty
  std::vector<DrawItem> drawn_;
};

}  // namespace rex::internal
