#include "scene/mesh_reader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <span>

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

std::string whyUnreadable(const fs::path& file) {
  std::error_code problem;
  switch (fs::status(file, problem).type()) {
    case fs::file_type::regular:
      return {};
    case fs::file_type::not_found:
      return "no such file";
    case fs::file_type::directory:
      return "a folder";
    default:
      return problem ? problem.message() : "a device";
  }
}

void requireReadable(const fs::path& file, const Eigen::Vector3d& scale) {
  constexpr std::uintmax_t kLargestFile = 256u << 20;
  if (!scale.allFinite() || (scale.array() == 0).any())
    fail(file, "scale of the mesh", fmt::format("({}, {}, {})", scale.x(), scale.y(), scale.z()),
         "finite numbers other than 0");
  const std::string ending = endingOf(file);
  if (std::find(kEndings.begin(), kEndings.end(), ending) == kEndings.end())
    fail(file, "not a kind of mesh file that rex reads",
         ending.empty() ? "no ending" : fmt::format("'{}'", ending),
         fmt::format("{}", fmt::join(kEndings, ", ")), nearestNames(ending, kEndings));
  if (const std::string obstacle = whyUnreadable(file); !obstacle.empty())
    fail(file, "cannot read the mesh file", obstacle, "a file",
         nearestNames(file.filename().string(), namesBeside(file)));
  std::error_code problem;
  const std::uintmax_t size = fs::file_size(file, problem);
  if (size > kLargestFile)
    fail(file, "mesh file too large", fmt::format("{} bytes", size), "at most 256 MiB");
}

// The JSON of a glTF file; of a binary one, its first part.
std::string_view jsonOf(std::string_view bytes, bool binary) {
  constexpr std::size_t kHead = 20;
  if (!binary || bytes.size() < kHead) return bytes;
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, sizeof(length));
  return bytes.substr(kHead, length);
}

// How deep the text of a file is nested at most.
struct Depth {
  std::size_t brackets = 0;
  std::size_t nodes = 0;
};

// Of glTF nodes it counts all that have others below them, which stand side by side in the text.
Depth depthOfJson(std::string_view json) {
  Depth depth;
  std::size_t open = 0;
  for (std::size_t i = 0; i < json.size(); ++i) {
    if (json[i] == '{' || json[i] == '[') depth.brackets = std::max(depth.brackets, ++open);
    if ((json[i] == '}' || json[i] == ']') && open > 0) --open;
    if (json[i] != '"') continue;
    const std::size_t start = ++i;
    while (i < json.size() && json[i] != '"') i += json[i] == '\\' ? 2 : 1;
    if (json.substr(start, i - start) == "children") ++depth.nodes;
  }
  return depth;
}

Depth depthOfCollada(std::string_view xml) {
  Depth depth;
  std::size_t open = 0;
  for (std::size_t at = xml.find('<'); at < xml.size(); at = xml.find('<', at)) {
    const std::string_view tag = xml.substr(at, xml.find('>', at) - at);
    at += tag.size();
    if (tag.starts_with("</node")) open -= open > 0 ? 1 : 0;
    if (tag.starts_with("<node") && !tag.ends_with('/')) depth.nodes = std::max(depth.nodes, ++open);
  }
  return depth;
}

// assimp follows brackets and nodes by recursion, and deep ones to the end of the stack.
void requireShallow(const fs::path& file) {
  constexpr std::size_t kMostBrackets = 100, kMostNodes = 5'000;
  const std::string ending = endingOf(file);
  if (ending != ".gltf" && ending != ".glb" && ending != ".dae") return;
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  const Depth depth = ending == ".dae" ? depthOfCollada(bytes) : depthOfJson(jsonOf(bytes, ending == ".glb"));
  if (depth.brackets > kMostBrackets)
    fail(file, "mesh file", fmt::format("{} brackets in each other", depth.brackets),
         fmt::format("at most {}", kMostBrackets));
  if (depth.nodes > kMostNodes)
    fail(file, "mesh file", fmt::format("{} nodes below each other", depth.nodes),
         fmt::format("at most {}", kMostNodes));
}

// assimp's own work on a mesh trusts its indices.
void requireIndices(const fs::path& file, const aiScene& scene) {
  for (const aiMesh* mesh : std::span(scene.mMeshes, scene.mNumMeshes))
    for (const aiFace& face : std::span(mesh->mFaces, mesh->mNumFaces))
      for (const unsigned corner : std::span(face.mIndices, face.mNumIndices))
        if (corner >= mesh->mNumVertices)
          fail(file, "mesh", fmt::format("a face with corner {}", corner),
               fmt::format("indices below {}, the number of vertices", mesh->mNumVertices));
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
  Collector(const fs::path& file, const aiScene& scene, const Eigen::Vector3d& scale)
      : file_(file), scene_(scene), scale_(scale) {
    const std::string ending = endingOf(file);
    linearLight_ = ending == ".gltf" || ending == ".glb";
    addNodes();
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
  // Each node before its children, without recursion: a chain may be thousands long.
  void addNodes() {
    std::vector<std::pair<const aiNode*, Matrix4d>> waiting;  // with the place of the parent
    if (scene_.mRootNode != nullptr) waiting.emplace_back(scene_.mRootNode, Matrix4d::Identity());
    while (!waiting.empty()) {
      const auto [node, parent] = waiting.back();
      waiting.pop_back();
      const Matrix4d placed = parent * matrixOf(node->mTransformation);
      for (unsigned i = 0; i < node->mNumMeshes; ++i) addMesh(*scene_.mMeshes[node->mMeshes[i]], placed);
      for (unsigned i = node->mNumChildren; i > 0; --i) waiting.emplace_back(node->mChildren[i - 1], placed);
    }
  }

  void addMesh(const aiMesh& mesh, const Matrix4d& placed) {
    constexpr std::size_t kMost = 10'000'000;
    const std::size_t first = positions_.size();
    if (first + mesh.mNumVertices > 3 * kMost || triangles_.size() + mesh.mNumFaces > kMost)
      fail(file_, "mesh too large", "more than ten million triangles", "fewer");
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) addVertex(mesh.mVertices[i], placed);
    TriangleMesh::Part part{.color = colorOf(*scene_.mMaterials[mesh.mMaterialIndex], linearLight_),
                            .firstTriangle = static_cast<Index>(triangles_.size())};
    const bool mirrored = placed.topLeftCorner<3, 3>().determinant() * scale_.prod() < 0;
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
    const Eigen::Vector3d p = scale_.cwiseProduct((placed * Eigen::Vector4d(v.x, v.y, v.z, 1)).head<3>());
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > kLargest)
      fail(file_, "mesh", fmt::format("vertex {} at ({}, {}, {})", positions_.size(), p.x(), p.y(), p.z()),
           "finite numbers up to 1e9");
    positions_.push_back(p.cast<float>());
  }

  const fs::path& file_;
  const aiScene& scene_;
  Eigen::Vector3d scale_;
  bool linearLight_;  // glTF counts colours in light, all others as a screen shows them
  std::vector<Eigen::Vector3f> positions_;
  std::vector<TriangleMesh::Triangle> triangles_;
  std::vector<TriangleMesh::Part> parts_;
};

}  // namespace

TriangleMesh readMesh(const fs::path& file, const Eigen::Vector3d& scale) {
  requireReadable(file, scale);
  requireShallow(file);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file.string(), 0);
  if (scene != nullptr) {
    requireIndices(file, *scene);
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  }
  if (scene == nullptr) fail(file, "cannot read the mesh file", importer.GetErrorString(), "a mesh");
  return Collector(file, *scene, scale).mesh();
}

}  // namespace rex
