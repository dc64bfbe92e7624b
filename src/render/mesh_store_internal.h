#pragma once

#include <array>

#include "render/draw_list_internal.h"
#include "render/gl_program_internal.h"
#include "render/solid_mesh_internal.h"

namespace rex::internal {

/// The unit meshes on the side of OpenGL, in every detail. They live as long as the context.
class MeshStore {
 public:
  explicit MeshStore(const GlFunctions& gl);
  /// Draws one item with the current `program`, whose placement uniforms it sets.
  void draw(const DrawItem& item, const GlProgram& program) const;

 private:
  struct Stored {
    GLuint vertexArray = 0;
    GLsizei indexCount = 0;
  };
  Stored upload(const SolidMesh& mesh) const;

  const GlFunctions* gl_;
  std::array<std::array<Stored, kSegments.size()>, 3> meshes_;  // [MeshKind][detail]
};

}  // namespace rex::internal
