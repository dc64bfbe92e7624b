#include <cassert>
#include <cstddef>
#include <span>

#include "render/mesh_store_internal.h"

namespace rex::internal {
namespace {

template <typename T>
void fill(const GlFunctions& gl, GLenum target, GLuint buffer, std::span<const T> values) {
  gl.BindBuffer(target, buffer);
  gl.BufferData(target, static_cast<GLsizeiptr>(values.size_bytes()), values.data(), GL_STATIC_DRAW);
}

void describeAttribute(const GlFunctions& gl, GLuint index, std::size_t stride, std::size_t offset,
                       GLint numbers = 3) {
  gl.EnableVertexAttribArray(index);
  gl.VertexAttribPointer(index, numbers, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                         reinterpret_cast<const void*>(offset));
}

const void* keyOf(const TriangleMesh& mesh) { return mesh.positions().data(); }

}  // namespace

MeshStore::MeshStore(const GlFunctions& gl) : gl_(&gl) {
  auto& [boxes, capsules, cylinders, roundedBoxes, cones] = meshes_;
  boxes.fill(upload(makeBoxMesh()));
  for (std::size_t detail = 0; detail < kSegments.size(); ++detail) {
    capsules[detail] = upload(makeCapsuleMesh(kSegments[detail]));
    cylinders[detail] = upload(makeCylinderMesh(kSegments[detail]));
    roundedBoxes[detail] = upload(makeRoundedBoxMesh(kSegments[detail]));
    cones[detail] = upload(makeConeMesh(kSegments[detail]));
  }
}

MeshStore::Stored MeshStore::upload(const SolidMesh& mesh) const {
  Stored stored{.indexCount = static_cast<GLsizei>(mesh.indices.size())};
  gl_->GenVertexArrays(1, &stored.vertexArray);
  gl_->BindVertexArray(stored.vertexArray);
  gl_->GenBuffers(2, stored.buffers.data());
  fill<MeshVertex>(*gl_, GL_ARRAY_BUFFER, stored.buffers[0], mesh.vertices);
  fill<std::uint16_t>(*gl_, GL_ELEMENT_ARRAY_BUFFER, stored.buffers[1], mesh.indices);
  describeAttribute(*gl_, 0, sizeof(MeshVertex), offsetof(MeshVertex, position));
  describeAttribute(*gl_, 1, sizeof(MeshVertex), offsetof(MeshVertex, normal));
  describeAttribute(*gl_, 2, sizeof(MeshVertex), offsetof(MeshVertex, end));
  return stored;
}

// Attribute 2, `end`, stays off and so is zero.
MeshStore::Stored MeshStore::upload(const TriangleMesh& mesh) const {
  Stored stored;
  gl_->GenVertexArrays(1, &stored.vertexArray);
  gl_->BindVertexArray(stored.vertexArray);
  gl_->GenBuffers(static_cast<GLsizei>(stored.buffers.size()), stored.buffers.data());
  fill(*gl_, GL_ARRAY_BUFFER, stored.buffers[0], mesh.positions());
  describeAttribute(*gl_, 0, sizeof(Eigen::Vector3f), 0);
  fill(*gl_, GL_ARRAY_BUFFER, stored.buffers[1], mesh.normals());
  describeAttribute(*gl_, 1, sizeof(Eigen::Vector3f), 0);
  fill(*gl_, GL_ELEMENT_ARRAY_BUFFER, stored.buffers[2], mesh.triangles());
  if (mesh.paint().textures.empty()) return stored;
  fill<Eigen::Vector2f>(*gl_, GL_ARRAY_BUFFER, stored.buffers[3], mesh.paint().points);
  describeAttribute(*gl_, 3, sizeof(Eigen::Vector2f), 0, 2);
  for (const Texture& texture : mesh.paint().textures) stored.textures.push_back(upload(texture));
  return stored;
}

GLuint MeshStore::upload(const Texture& texture) const {
  GLuint id = 0;
  gl_->GenTextures(1, &id);
  gl_->ActiveTexture(GL_TEXTURE0 + kTextureUnit);
  gl_->BindTexture(GL_TEXTURE_2D, id);
  gl_->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, texture.width, texture.height, 0, GL_RGB, GL_UNSIGNED_BYTE,
                  texture.rgb.data());
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    gl_->TexParameteri(GL_TEXTURE_2D, axis, GL_REPEAT);
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_->GenerateMipmap(GL_TEXTURE_2D);
  gl_->ActiveTexture(GL_TEXTURE0);
  return id;
}

void MeshStore::prepare(const DrawList& list) {
  constexpr int kMostWithout = 8;
  for (auto& [key, imported] : imported_) ++imported.picturesWithout;
  for (const auto* items : {&list.opaque, &list.translucent}) {
    for (const DrawItem& item : *items) {
      if (item.mesh != MeshKind::kImported) continue;
      const auto [found, isNew] = imported_.try_emplace(keyOf(item.imported));
      if (isNew) found->second = {item.imported, upload(item.imported)};
      found->second.picturesWithout = 0;
    }
  }
  for (auto it = imported_.begin(); it != imported_.end();) {
    if (it->second.picturesWithout <= kMostWithout) {
      ++it;
      continue;
    }
    const Stored& stored = it->second.stored;
    gl_->DeleteVertexArrays(1, &stored.vertexArray);
    gl_->DeleteBuffers(static_cast<GLsizei>(stored.buffers.size()), stored.buffers.data());
    gl_->DeleteTextures(static_cast<GLsizei>(stored.textures.size()), stored.textures.data());
    it = imported_.erase(it);
  }
}

void MeshStore::cullBackOf(const DrawItem& item) const {
  (item.mesh == MeshKind::kImported ? gl_->Disable : gl_->Enable)(GL_CULL_FACE);
}

void MeshStore::bindTexture(const DrawItem& item) const {
  const auto found = imported_.find(keyOf(item.imported));
  assert(found != imported_.end() && item.texture);
  gl_->ActiveTexture(GL_TEXTURE0 + kTextureUnit);
  gl_->BindTexture(GL_TEXTURE_2D, found->second.stored.textures[*item.texture]);
  gl_->ActiveTexture(GL_TEXTURE0);
}

void MeshStore::draw(const DrawItem& item, const GlProgram& program) const {
  program.set("R_WS", item.X_WS.R);
  program.set("p_WS", item.X_WS.p);
  program.set("halfSize", item.halfSize);
  program.set("stretch", item.stretch);
  if (item.mesh == MeshKind::kImported) {
    const auto found = imported_.find(keyOf(item.imported));
    assert(found != imported_.end());
    gl_->BindVertexArray(found->second.stored.vertexArray);
    const std::size_t first = item.firstTriangle * sizeof(TriangleMesh::Triangle);
    gl_->DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * item.triangleCount), GL_UNSIGNED_INT,
                      reinterpret_cast<const void*>(first));
    return;
  }
  const Stored& mesh = meshes_[static_cast<std::size_t>(item.mesh)][item.detail];
  gl_->BindVertexArray(mesh.vertexArray);
  gl_->DrawElements(GL_TRIANGLES, mesh.indexCount, GL_UNSIGNED_SHORT, nullptr);
}

}  // namespace rex::internal
