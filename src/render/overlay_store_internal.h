#pragma once

#include "render/gl_functions_internal.h"
#include "render/overlay_mesh_internal.h"

namespace rex::internal {

/// The overlay of the present picture on the side of OpenGL. Its buffers grow and are used again.
class OverlayStore {
 public:
  explicit OverlayStore(const GlFunctions& gl);
  /// Replaces what was loaded by the lines and points of `picture`.
  void load(const Picture& picture, const Camera& camera, int width, int height);
  [[nodiscard]] bool isEmpty() const { return mesh_.empty(); }
  /// Draws it with the current program, that of overlayShader().
  void draw() const;

 private:
  void growIndices();

  const GlFunctions* gl_;
  GLuint vertexArray_ = 0, vertices_ = 0, indices_ = 0;
  std::size_t indexedQuads_ = 0;
  std::vector<OverlayVertex> mesh_;
};

}  // namespace rex::internal
