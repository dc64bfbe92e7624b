#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/camera.h"
#include "render/gl_program_internal.h"
#include "render/picture.h"

namespace rex::internal {

/// A corner of a flat overlay quad: normalised device coordinates, and where it lies seen from the start of
/// its stroke: (along, across) in pixels. The stroke has round ends at `first` and `last` along; what lies
/// farther than its half width from the line between them is not covered.
struct OverlayVertex {
  std::array<float, 3> position;
  std::array<float, 2> offset;
  float first, last, halfWidth;
  std::array<std::uint8_t, 4> color;
};

/// Quads (four corners each: 0 1 2 and 2 1 3 are triangles) for lines and discs of constant width in pixels,
/// because core OpenGL has neither: polylines, line sets, axes, markers, point sets and point clouds. They
/// lie 1 % nearer to the camera than their points, so that a line on a surface is not half inside it.
/// Replaces what `mesh` held.
void makeOverlayMesh(const Picture& picture, const Camera& camera, int width, int height,
                     std::vector<OverlayVertex>& mesh);

/// Whether a solid is drawn as lines or points: markers, point clouds, and meshes without triangles.
[[nodiscard]] bool isOverlay(const Solid& solid);

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
