#pragma once

#include <array>
#include <map>
#include <vector>

#include "render/draw_list_internal.h"
#include "render/gl_program_internal.h"
#include "render/solid_mesh_internal.h"

namespace rex::internal {

/// Meshes on the side of OpenGL: the unit meshes in every detail, and the imported ones in use. They live as
/// long as the context.
class MeshStore {
 public:
  static constexpr int kTextureUnit = 2;

  explicit MeshStore(const GlFunctions& gl);
  /// Uploads the imported meshes of a picture that are new, and forgets those that several pictures in a row
  /// have done without.
  void prepare(const DrawList& list);
  /// Lets OpenGL leave out what faces away, but not of an imported surface, which may be open.
  void cullBackOf(const DrawItem& item) const;
  /// Puts the texture of an imported item into kTextureUnit.
  void bindTexture(const DrawItem& item) const;
  /// Draws one item with the current `program`, whose placement uniforms it sets. Imported meshes need
  /// prepare().
  void draw(const DrawItem& item, const GlProgram& program) const;
  [[nodiscard]] std::size_t importedCount() const { return imported_.size(); }

 private:
  struct Stored {
    GLuint vertexArray = 0;
    std::array<GLuint, 4> buffers{};
    std::vector<GLuint> textures{};
    GLsizei indexCount = 0;
  };
  struct Imported {
    TriangleMesh mesh;  // keeps its data, whose address is the key, from being used for another
    Stored stored;
    int picturesWithout = 0;
  };
  Stored upload(const SolidMesh& mesh) const;
  Stored upload(const TriangleMesh& mesh) const;
  GLuint upload(const Texture& texture) const;

  const GlFunctions* gl_;
  std::array<std::array<Stored, kSegments.size()>, 5> meshes_;  // [MeshKind][detail]
  std::map<const void*, Imported> imported_;
};

}  // namespace rex::internal
