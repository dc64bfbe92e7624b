#include <algorithm>
#include <cstddef>

#include "render/overlay_store_internal.h"

namespace rex::internal {

OverlayStore::OverlayStore(const GlFunctions& gl) : gl_(&gl) {
  gl.GenVertexArrays(1, &vertexArray_);
  gl.GenBuffers(1, &vertices_);
  gl.GenBuffers(1, &indices_);
  gl.BindVertexArray(vertexArray_);
  gl.BindBuffer(GL_ARRAY_BUFFER, vertices_);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  const auto attribute = [&](GLuint index, GLint size, GLenum type, std::size_t offset) {
    gl.EnableVertexAttribArray(index);
    gl.VertexAttribPointer(index, size, type, type == GL_FLOAT ? GL_FALSE : GL_TRUE, sizeof(OverlayVertex),
                           reinterpret_cast<const void*>(offset));
  };
  attribute(0, 3, GL_FLOAT, offsetof(OverlayVertex, position));
  attribute(1, 2, GL_FLOAT, offsetof(OverlayVertex, offset));
  attribute(2, 3, GL_FLOAT, offsetof(OverlayVertex, first));
  attribute(3, 4, GL_UNSIGNED_BYTE, offsetof(OverlayVertex, color));
}

void OverlayStore::load(const Picture& picture, const Camera& camera, int width, int height) {
  makeOverlayMesh(picture, camera, width, height, mesh_);
  if (mesh_.empty()) return;
  gl_->BindVertexArray(vertexArray_);
  gl_->BindBuffer(GL_ARRAY_BUFFER, vertices_);
  gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh_.size() * sizeof(mesh_[0])), mesh_.data(),
                  GL_STREAM_DRAW);
  if (mesh_.size() / 4 > indexedQuads_) growIndices();
}

void OverlayStore::draw() const {
  gl_->BindVertexArray(vertexArray_);
  gl_->DrawElements(GL_TRIANGLES, static_cast<GLsizei>(mesh_.size() / 4 * 6), GL_UNSIGNED_INT, nullptr);
}

void OverlayStore::growIndices() {
  indexedQuads_ = std::max(mesh_.size() / 4, 2 * indexedQuads_);
  std::vector<std::uint32_t> indices;
  indices.reserve(6 * indexedQuads_);
  for (std::uint32_t quad = 0; quad < indexedQuads_; ++quad)
    for (const std::uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) indices.push_back(4 * quad + corner);
  gl_->BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(indices[0])),
                  indices.data(), GL_STATIC_DRAW);
}

}  // namespace rex::internal
