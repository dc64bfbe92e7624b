#pragma once

#include "render/depth_image.h"
#include "render/frame_buffer_internal.h"
#include "render/mesh_store_internal.h"
#include "render/segmentation_image.h"

namespace rex::internal {

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
