#include <cstddef>

#include "render/mesh_store_internal.h"

namespace rex::internal {
namespace {

void describeAttribute(const GlFunctions& gl, GLuint index, GLint size, std::size_t offset) {
  gl.EnableVertexAttribArray(index);
  gl.VertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, sizeof(MeshVertex),
                         reinterpret_cast<const void*>(offset));
}

}  // namespace

MeshStore::MeshStore(const GlFunctions& gl) : gl_(&gl) {
  auto& [boxes, capsules, cylinders] = meshes_;
  boxes.fill(upload(makeBoxMesh()));
  for (std::size_t detail = 0; detail < kSegments.size(); ++detail) {
    capsules[detail] = upload(makeCapsuleMesh(kSegments[detail]));
    cylinders[detail] = upload(makeCylinderMesh(kSegments[detail]));
  }
}

MeshStore::Stored MeshStore::upload(const SolidMesh& mesh) const {
  Stored stored;
  gl_->GenVertexArrays(1, &stored.vertexArray);
  gl_->BindVertexArray(stored.vertexArray);
  std::array<GLuint, 2> buffers{};
  gl_->GenBuffers(2, buffers.data());
  gl_->BindBuffer(GL_ARRAY_BUFFER, buffers[0]);
  gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.vertices.size() * sizeof(MeshVertex)),
                  mesh.vertices.data(), GL_STATIC_DRAW);
  gl_->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
  gl_->BufferData(GL_ELEMENT_ARRAY_BUFFER,
                  static_cast<GLsizeiptr>(mesh.indices.size() * sizeof(std::uint16_t)), mesh.indices.data(),
                  GL_STATIC_DRAW);
  describeAttribute(*gl_, 0, 3, offsetof(MeshVertex, position));
  describeAttribute(*gl_, 1, 3, offsetof(MeshVertex, normal));
  describeAttribute(*gl_, 2, 1, offsetof(MeshVertex, end));
  stored.indexCount = static_cast<GLsizei>(mesh.indices.size());
  return stored;
}

void MeshStore::draw(const DrawItem& item, const GlProgram& program) const {
  program.set("R_WS", item.X_WS.R);
  program.set("p_WS", item.X_WS.p);
  program.set("halfSize", item.halfSize);
  program.set("stretch", item.stretch);
  const Stored& mesh = meshes_[static_cast<std::size_t>(item.mesh)][item.detail];
  gl_->BindVertexArray(mesh.vertexArray);
  gl_->DrawElements(GL_TRIANGLES, mesh.indexCount, GL_UNSIGNED_SHORT, nullptr);
}

}  // namespace rex::internal
