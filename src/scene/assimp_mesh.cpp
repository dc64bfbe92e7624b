#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

#include <Eigen/LU>
#include <assimp/BaseImporter.h>
#include <assimp/Importer.hpp>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "base/lower_case.h"
#include "geometry/welded_mesh.h"
#include "scene/assimp_mesh_internal.h"
#include "scene/mesh_folder_internal.h"
#include "scene/mesh_limits_internal.h"

namespace rex::mesh {
namespace {

using Eigen::Matrix4d;
using Index = std::uint32_t;

// assimp's own work on a mesh trusts its indices.
void requireFaces(const std::string& name, const aiScene& scene) {
  std::size_t triangles = 0;
  for (const aiMesh* mesh : std::span(scene.mMeshes, scene.mNumMeshes))
    for (const aiFace& face : std::span(mesh->mFaces, mesh->mNumFaces)) {
      for (const unsigned corner : std::span(face.mIndices, face.mNumIndices))
        if (corner >= mesh->mNumVertices)
          fail(name, "mesh", fmt::format("a face with corner {}", corner),
               fmt::format("indices below {}, the number of vertices", mesh->mNumVertices));
      if (face.mNumIndices > kMostCorners)
        fail(name, "mesh", fmt::format("a face with {} corners", face.mNumIndices),
             fmt::format("at most {}", kMostCorners));
      triangles += face.mNumIndices - std::min(face.mNumIndices, 2u);
    }
  requireTriangles(triangles, name);
}

float fromLinearLight(float c) {
  return c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f;
}

// None for the material that stands for none.
std::optional<Eigen::Vector4f> colorOf(const aiMaterial& material, bool linearLight) {
  aiString name;
  aiColor4D c;
  if (material.Get(AI_MATKEY_NAME, name) != AI_SUCCESS || name == aiString(AI_DEFAULT_MATERIAL_NAME))
    return {};
  if (material.Get(AI_MATKEY_BASE_COLOR, c) != AI_SUCCESS) {
    if (material.Get(AI_MATKEY_COLOR_DIFFUSE, c) != AI_SUCCESS) return {};
    material.Get(AI_MATKEY_OPACITY, c.a);
  }
  // Written so that what is not a number becomes 0.
  const auto inRange = [](float x) { return x > 0 ? std::min(x, 1.f) : 0.f; };
  Eigen::Vector4f color(inRange(c.r), inRange(c.g), inRange(c.b), inRange(c.a));
  if (linearLight) color.head<3>() = color.head<3>().unaryExpr(&fromLinearLight).eval();
  return color;
}

Matrix4d matrixOf(const aiMatrix4x4& m) {
  Matrix4d matrix;
  matrix << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4;
  return matrix;
}

// To z up, from y up: that is glTF's way, and assimp's for DAE, where it has turned what points elsewhere.
Matrix4d fromYUp() {
  Matrix4d turn;
  turn << 1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1;
  return turn;
}

// All meshes of a file, as its nodes place them, in one.
class Collector {
 public:
  Collector(const std::string& name, const aiScene& scene) : name_(name), scene_(scene) {
    const std::string ending = endingOf(name);
    linearLight_ = ending == ".gltf" || ending == ".glb";
    addNodes(linearLight_ || ending == ".dae" ? fromYUp() : Matrix4d(Matrix4d::Identity()));
  }

  TriangleMesh mesh() && {
    if (positions_.empty()) fail(name_, "mesh", "no vertices", "some");
    if (triangles_.empty()) return {std::move(positions_), {}, {}};
    TriangleMesh mesh = weldedMesh(positions_, triangles_, parts_);
    if (mesh.isEmpty())
      fail(name_, "mesh", fmt::format("{} triangles, none of which has an area", triangles_.size()),
           "a surface");
    return mesh;
  }

 private:
  // Each node before its children, without recursion: a chain may be thousands long.
  void addNodes(const Matrix4d& top) {
    std::vector<std::pair<const aiNode*, Matrix4d>> waiting;  // with the place of the parent
    if (scene_.mRootNode != nullptr) waiting.emplace_back(scene_.mRootNode, top);
    while (!waiting.empty()) {
      const auto [node, parent] = waiting.back();
      waiting.pop_back();
      const Matrix4d placed = parent * matrixOf(node->mTransformation);
      for (unsigned i = 0; i < node->mNumMeshes; ++i) addMesh(*scene_.mMeshes[node->mMeshes[i]], placed);
      for (unsigned i = node->mNumChildren; i > 0; --i) waiting.emplace_back(node->mChildren[i - 1], placed);
    }
  }

  void addMesh(const aiMesh& mesh, const Matrix4d& placed) {
    const std::size_t first = positions_.size();
    requireTriangles(triangles_.size() + mesh.mNumFaces, name_);
    requireCount(first + mesh.mNumVertices, name_);
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) addVertex(mesh.mVertices[i], placed);
    TriangleMesh::Part part{.color = colorOf(*scene_.mMaterials[mesh.mMaterialIndex], linearLight_),
                            .firstTriangle = static_cast<Index>(triangles_.size())};
    const bool mirrored = placed.topLeftCorner<3, 3>().determinant() < 0;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices != 3) continue;
      TriangleMesh::Triangle corners{};
      for (int k = 0; k < 3; ++k) corners[k] = static_cast<Index>(first + face.mIndices[k]);
      if (mirrored) std::swap(corners[1], corners[2]);
      triangles_.push_back(corners);
    }
    part.triangleCount = static_cast<Index>(triangles_.size()) - part.firstTriangle;
    if (part.triangleCount > 0) parts_.push_back(part);
  }

  void addVertex(const aiVector3D& v, const Matrix4d& placed) {
    const Eigen::Vector3d p = (placed * Eigen::Vector4d(v.x, v.y, v.z, 1)).head<3>();
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > kLargestCoordinate)
      fail(name_, "mesh", fmt::format("vertex {} at ({}, {}, {})", positions_.size(), p.x(), p.y(), p.z()),
           "finite numbers up to 1e6");
    positions_.push_back(p.cast<float>());
  }

  const std::string& name_;
  const aiScene& scene_;
  bool linearLight_;  // glTF counts colours in light, all others as a screen shows them
  std::vector<Eigen::Vector3f> positions_;
  std::vector<TriangleMesh::Triangle> triangles_;
  std::vector<TriangleMesh::Part> parts_;
};

// assimp tries its other readers on a file that the one for its ending declines, and what a file must not
// hold is known for one kind only.
void keepReadersOf(const std::string& ending, Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    const aiImporterDesc* const about = importer.GetImporterInfo(i);
    if (about != nullptr &&
        (" " + std::string(about->mFileExtensions) + " ").find(" " + ending.substr(1) + " ") !=
            std::string::npos)
      continue;
    const std::unique_ptr<Assimp::BaseImporter> reader(importer.GetImporter(i));
    importer.UnregisterLoader(reader.get());
  }
}

}  // namespace

TriangleMesh readByAssimp(std::string_view bytes, const std::string& name,
                          const std::filesystem::path& folder) {
  const std::string alias = "mesh" + endingOf(name);
  Assimp::Importer importer;
  keepReadersOf(endingOf(name), importer);
  importer.SetIOHandler(new MeshFolder(alias, bytes, folder));  // which deletes it
  const aiScene* scene = importer.ReadFile(alias, 0);
  if (scene != nullptr) {
    requireFaces(name, *scene);
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  }
  if (scene == nullptr) fail(name, "cannot read the mesh file", importer.GetErrorString(), "a mesh");
  return Collector(name, *scene).mesh();
}

}  // namespace rex::mesh
