#include "scene/mesh_reader.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <assimp/Importer.hpp>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "geometry/welded_mesh.h"

namespace rex {
namespace {

namespace fs = std::filesystem;
using Eigen::Matrix4d;
using Index = std::uint32_t;

const std::vector<std::string> kEndings = {".stl", ".obj", ".ply", ".dae", ".gltf", ".glb", ".off"};

[[noreturn]] void fail(const fs::path& file, std::string what, std::string found, std::string wanted = "",
                       std::vector<std::string> nearest = {}) {
  throw Error(
      {std::move(what), {.file = file.string()}, std::move(found), std::move(wanted), std::move(nearest)});
}

std::string endingOf(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; });
  return ending;
}

std::vector<std::string> namesBeside(const fs::path& file) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(file.has_parent_path() ? file.parent_path() : ".", ignored))
    names.push_back(entry.path().filename().string());
  return names;
}

void requireReadable(const fs::path& file, double scale) {
  constexpr std::uintmax_t kLargestFile = 256u << 20;
  if (!(scale > 0) || !std::isfinite(scale))
    fail(file, "scale of the mesh", fmt::format("{}", scale), "a positive number");
  const std::string ending = endingOf(file);
  if (std::find(kEndings.begin(), kEndings.end(), ending) == kEndings.end())
    fail(file, "not a kind of mesh file that rex reads",
         ending.empty() ? "no ending" : fmt::format("'{}'", ending),
         fmt::format("{}", fmt::join(kEndings, ", ")), nearestNames(ending, kEndings));
  std::error_code problem;
  if (!fs::is_regular_file(file, problem))
    fail(file, "cannot read the mesh file", "", "a file",
         nearestNames(file.filename().string(), namesBeside(file)));
  const std::uintmax_t size = fs::file_size(file, problem);
  if (size > kLargestFile)
    fail(file, "mesh file too large", fmt::format("{} bytes", size), "at most 256 MiB");
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

// All meshes of a file, as its nodes place them, in one.
class Collector {
 public:
  Collector(const fs::path& file, const aiScene& scene, double scale)
      : file_(file), scene_(scene), scale_(scale) {
    const std::string ending = endingOf(file);
    linearLight_ = ending == ".gltf" || ending == ".glb";
    if (scene.mRootNode != nullptr) addNode(*scene.mRootNode, Matrix4d::Identity());
  }

  TriangleMesh mesh() && {
    if (positions_.empty()) fail(file_, "mesh", "no vertices", "some");
    if (triangles_.empty()) return {std::move(positions_), {}, {}};
    TriangleMesh mesh = weldedMesh(positions_, triangles_, parts_);
    if (mesh.isEmpty())
      fail(file_, "mesh", fmt::format("{} triangles, none of which has an area", triangles_.size()),
           "a surface");
    return mesh;
  }

 private:
  void addNode(const aiNode& node, const Matrix4d& parent) {
    const Matrix4d placed = parent * matrixOf(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) addMesh(*scene_.mMeshes[node.mMeshes[i]], placed);
    for (unsigned i = 0; i < node.mNumChildren; ++i) addNode(*node.mChildren[i], placed);
  }

  void addMesh(const aiMesh& mesh, const Matrix4d& placed) {
    constexpr std::size_t kMost = 10'000'000;
    const std::size_t first = positions_.size();
    if (first + mesh.mNumVertices > 3 * kMost || triangles_.size() + mesh.mNumFaces > kMost)
      fail(file_, "mesh too large", "more than ten million triangles", "fewer");
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
    constexpr double kLargest = 1e9;
    const Eigen::Vector3d p = scale_ * (placed * Eigen::Vector4d(v.x, v.y, v.z, 1)).head<3>();
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > kLargest)
      fail(file_, "mesh", fmt::format("vertex {} at ({}, {}, {})", positions_.size(), p.x(), p.y(), p.z()),
           "finite numbers up to 1e9");
    positions_.push_back(p.cast<float>());
  }

  const fs::path& file_;
  const aiScene& scene_;
  double scale_;
  bool linearLight_;  // glTF counts colours in light, all others as a screen shows them
  std::vector<Eigen::Vector3f> positions_;
  std::vector<TriangleMesh::Triangle> triangles_;
  std::vector<TriangleMesh::Part> parts_;
};

}  // namespace

TriangleMesh readMesh(const fs::path& file, double scale) {
  requireReadable(file, scale);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file.string(), aiProcess_Triangulate);
  if (scene == nullptr) fail(file, "cannot read the mesh file", importer.GetErrorString(), "a mesh");
  return Collector(file, *scene, scale).mesh();
}

}  // namespace rex
