#pragma once

#include <optional>

#include "render/camera.h"
#include "render/depth_image.h"
#include "render/frame_buffer_internal.h"
#include "render/mesh_store_internal.h"
#include "render/picture.h"

namespace rex::internal {

/// The part of the ground that is drawn: to its rim it has faded out. Metres, in W.
struct GroundDisc {
  Eigen::Vector3d center;
  double radius;
};

/// None for a picture without ground or with one of its own, see checkerHeight(), and for a camera not above
/// it.
[[nodiscard]] std::optional<GroundDisc> visibleGround(const Picture& picture, const Camera& camera);

/// The same pixels twice.
struct SensorImages {
  DepthImage depth;
  SegmentationImage segmentation;
};

/// Draws how far away everything is and what it is, without light and without smooth edges.
class SensorPass {
 public:
  /// Throws Error when OpenGL cannot make a picture this large.
  SensorPass(const GlFunctions& gl, int width, int height);

  /// Solids count whether opaque or translucent; other items of the list do not.
  [[nodiscard]] SensorImages draw(const DrawList& list, const Picture& picture, const Camera& camera,
                                  const MeshStore& meshes) const;

 private:
  void drawGround(const Picture& picture, const Camera& camera, const Eigen::Matrix4d& clip) const;
  [[nodiscard]] SensorImages read() const;

  const GlFunctions* gl_;
  int width_, height_;
  FrameBuffer frame_;
  GlProgram solid_, ground_;
  GLuint noVertices_ = 0;
};

}  // namespace rex::internal
