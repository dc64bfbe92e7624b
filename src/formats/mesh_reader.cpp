#include "formats/mesh_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <type_traits>

#include <Eigen/LU>
#include <assimp/BaseImporter.h>
#include <assimp/Importer.hpp>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "formats/assets_internal.h"
#include "formats/mesh_folder_internal.h"
#include "formats/mesh_limits_internal.h"
#include "formats/mesh_reader_internal.h"
#include "formats/texture_reader_internal.h"
#include "geometry/welded_mesh.h"

namespace rex::mesh {
namespace {

using Eigen::Matrix4d;
using Index = std::uint32_t;

// assimp's own post-processing trusts the indices of a mesh.
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

// Empty for the default material, which stands for no material, and for others than the `known`, if given.
std::optional<Eigen::Vector4f> colorOf(const aiMaterial& material, bool linearLight,
                                       const std::set<std::string>* known) {
  aiString name;
  aiColor4D c;
  if (material.Get(AI_MATKEY_NAME, name) != AI_SUCCESS || name == aiString(AI_DEFAULT_MATERIAL_NAME))
    return {};
  if (known != nullptr && !known->contains(name.C_Str())) return {};
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

// From y up to z up: glTF has y up, and so does what assimp reads from DAE, which it turns if necessary.
Matrix4d fromYUp() {
  Matrix4d turn;
  turn << 1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1;
  return turn;
}

// Of a Collada file, from its axes to z up. assimp turns to y up at the root, whose matrix holds nothing else
// but the unit.
Eigen::Matrix3d turnOf(const std::string& name, const aiScene& scene) {
  if (endingOf(name) != ".dae" || scene.mRootNode == nullptr) return Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d M = (fromYUp() * matrixOf(scene.mRootNode->mTransformation)).topLeftCorner<3, 3>();
  const Eigen::Matrix3d turn = (M / M.cwiseAbs().maxCoeff()).array().round();
  const bool isTurn = (turn * turn.transpose()).isIdentity() && turn.determinant() > 0;
  return isTurn ? turn : Eigen::Matrix3d::Identity();
}

// The textures of a file, each read once.
class Textures {
 public:
  Textures(const aiScene& scene, const MeshFolder& folder) : scene_(scene), folder_(folder) {}

  // The texture of a material. Also empty if the texture cannot be read, which is noted.
  std::optional<Index> of(const aiMaterial& material) {
    aiString path;
    if (material.GetTexture(aiTextureType_BASE_COLOR, 0, &path) != AI_SUCCESS &&
        material.GetTexture(aiTextureType_DIFFUSE, 0, &path) != AI_SUCCESS)
      return {};
    const auto [known, isNew] = known_.try_emplace(path.C_Str());
    if (isNew) {
      try {
        known->second = add(known->first);
      } catch (const Error& error) {
        missing_.emplace_back(error.what());
      }
    }
    return known->second;
  }

  std::vector<Texture> takeTextures() { return std::move(textures_); }
  std::vector<std::string> takeMissing() { return std::move(missing_); }

 private:
  static constexpr std::size_t kMostTextures = 64, kMostPixelsTogether = 2 * kMostTexturePixels;

  Index add(const std::string& path) {
    const std::string what = path.starts_with('*') ? "a texture inside the file" : "texture '" + path + "'";
    if (known_.size() > kMostTextures)
      throw Error({.what = what,
                   .found = "too many textures",
                   .wanted = fmt::format("at most {} in a file", kMostTextures)});
    textures_.push_back(readTexture(bytesOf(path, what), what));
    pixels_ += textures_.back().rgb.size() / 3;
    if (pixels_ > kMostPixelsTogether) {
      textures_.pop_back();
      throw Error({.what = what,
                   .found = fmt::format("{} pixels of textures so far", pixels_),
                   .wanted = fmt::format("at most {} in a file", kMostPixelsTogether)});
    }
    return static_cast<Index>(textures_.size() - 1);
  }

  std::string bytesOf(const std::string& path, const std::string& what) const {
    if (const aiTexture* inside = scene_.GetEmbeddedTexture(path.c_str())) {
      if (inside->mHeight == 0) return {reinterpret_cast<const char*>(inside->pcData), inside->mWidth};
      throw Error({.what = what, .found = "uncompressed pixels", .wanted = "PNG or JPEG"});
    }
    std::string name = path;
    std::replace(name.begin(), name.end(), '\\', '/');  // from other systems
    if (std::optional<std::string> content = folder_.contentOf(name.c_str())) return *std::move(content);
    throw Error({.what = what,
                 .found = "no such file of at most 16 MiB",
                 .wanted = "one in the folder of the mesh or in a subfolder"});
  }

  const aiScene& scene_;
  const MeshFolder& folder_;
  std::map<std::string, std::optional<Index>> known_;
  std::vector<Texture> textures_;
  std::vector<std::string> missing_;
  std::size_t pixels_ = 0;
};

// All meshes of a file in one, placed as its nodes say.
class Collector {
 public:
  // Leaves out textures if `textures` is null.
  Collector(const std::string& name, const aiScene& scene, const MeshFolder& folder, Textures* textures)
      : name_(name), scene_(scene), textures_(textures) {
    const std::string ending = endingOf(name);
    if (ending == ".obj") materials_ = &folder.materials();
    linearLight_ = ending == ".gltf" || ending == ".glb";
    addNodes(linearLight_ || ending == ".dae" ? fromYUp() : Matrix4d(Matrix4d::Identity()));
  }

  TriangleMesh mesh() && {
    if (positions_.empty()) fail(name_, "mesh", "no vertices", "some");
    if (triangles_.empty()) return {std::move(positions_), {}, {}};
    TriangleMesh::Paint paint;
    const bool isPainted =
        std::ranges::any_of(parts_, [](const TriangleMesh::Part& part) { return part.texture.has_value(); });
    if (isPainted) paint = {std::move(points_), textures_->takeTextures()};
    TriangleMesh mesh = weldedMesh(positions_, triangles_, parts_, kCreaseAngle, std::move(paint));
    if (mesh.isEmpty())
      fail(name_, "mesh", fmt::format("{} triangles, none of which has an area", triangles_.size()),
           "a surface");
    return mesh;
  }

 private:
  // Each node before its children, without recursion: a chain may be thousands long.
  void addNodes(const Matrix4d& top) {
    std::vector<std::pair<const aiNode*, Matrix4d>> waiting;  // with the pose of the parent
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
    const aiMaterial& material = *scene_.mMaterials[mesh.mMaterialIndex];
    TriangleMesh::Part part{.color = colorOf(material, linearLight_, materials_),
                            .firstTriangle = static_cast<Index>(triangles_.size())};
    if (textures_ != nullptr) paintPart(part, mesh, material);
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

  void paintPart(TriangleMesh::Part& part, const aiMesh& mesh, const aiMaterial& material) {
    const bool hasPoints = mesh.HasTextureCoords(0);
    if (hasPoints) part.texture = textures_->of(material);
    if (part.texture && !linearLight_)
      part.color = Eigen::Vector4f(1, 1, 1, part.color ? (*part.color)[3] : 1);
    if (part.texture && !part.color) part.color = Eigen::Vector4f::Ones();
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D at = hasPoints ? mesh.mTextureCoords[0][i] : aiVector3D();
      const bool isUsable = std::isfinite(at.x) && std::isfinite(at.y);
      points_.emplace_back(isUsable ? Eigen::Vector2f(at.x, at.y) : Eigen::Vector2f::Zero());
    }
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
  Textures* textures_;
  const std::set<std::string>* materials_ = nullptr;  // of OBJ files, those whose library is there
  bool linearLight_;  // glTF counts colours in light, all others as a screen shows them
  std::vector<Eigen::Vector3f> positions_;
  std::vector<TriangleMesh::Triangle> triangles_;
  std::vector<TriangleMesh::Part> parts_;
  std::vector<Eigen::Vector2f> points_;  // texture coordinates, one for each position
};

// If the reader for the ending declines a file, assimp tries its other readers. But what a file must not
// hold is checked for the kind of its ending only.
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

TexturedMesh readByAssimp(std::string_view bytes, const std::string& name,
                          const std::filesystem::path& folder, bool textures) {
  const std::string alias = "mesh" + endingOf(name);
  Assimp::Importer importer;
  keepReadersOf(endingOf(name), importer);
  const auto files = new MeshFolder(alias, bytes, folder);
  importer.SetIOHandler(files);  // which deletes it
  const aiScene* scene = importer.ReadFile(alias, 0);
  if (scene != nullptr) {
    requireFaces(name, *scene);
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  }
  if (scene == nullptr) fail(name, "cannot read the mesh file", importer.GetErrorString(), "a mesh");
  const Eigen::Matrix3d turn = turnOf(name, *scene);
  if (!textures) return {Collector(name, *scene, *files, nullptr).mesh(), {}, turn};
  Textures painted(*scene, *files);
  TriangleMesh mesh = Collector(name, *scene, *files, &painted).mesh();
  return {std::move(mesh), painted.takeMissing(), turn};
}

namespace {

// A mesh as it is passed between processes: for each of its lists a count, then the elements as they lie in
// memory.
void addCount(std::string& bytes, std::uint64_t count) {
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
}

template <class T>
void addList(std::string& bytes, std::span<const T> list) {
  addCount(bytes, list.size());
  bytes.append(reinterpret_cast<const char*>(list.data()), list.size_bytes());
}

std::string toBytes(const TexturedMesh& read) {
  constexpr std::size_t kCounts = 4 * sizeof(std::uint64_t);
  const TriangleMesh& mesh = read.mesh;
  std::string bytes;
  bytes.reserve(kCounts + mesh.positions().size_bytes() + mesh.normals().size_bytes() +
                mesh.triangles().size_bytes() + mesh.parts().size_bytes());
  addList(bytes, mesh.positions());
  addList(bytes, mesh.normals());
  addList(bytes, mesh.triangles());
  addList(bytes, mesh.parts());
  addList(bytes, std::span(mesh.paint().points));
  addCount(bytes, mesh.paint().textures.size());
  for (const auto& [width, height, rgb] : mesh.paint().textures) {
    addList<int>(bytes, std::array{width, height});
    addList(bytes, std::span(rgb));
  }
  addCount(bytes, read.missing.size());
  for (const std::string& one : read.missing) addList<char>(bytes, one);
  addList(bytes, std::span<const double>(read.turn.data(), 9));
  return bytes;
}

// Trusts no count: a process that a file has corrupted may send anything.
std::uint64_t takeCount(std::string_view& bytes) {
  std::uint64_t count = 0;
  if (bytes.size() < sizeof count) {
    bytes = {};
    return 0;
  }
  std::memcpy(&count, bytes.data(), sizeof count);
  bytes.remove_prefix(sizeof count);
  return count;
}

template <class T>
std::vector<T> takeList(std::string_view& bytes) {
  const std::uint64_t count = takeCount(bytes);
  if (count > bytes.size() / sizeof(T)) return {};
  std::vector<T> list(count);
  if (count > 0) std::memcpy(static_cast<void*>(list.data()), bytes.data(), count * sizeof(T));
  bytes.remove_prefix(count * sizeof(T));
  return list;
}

TexturedMesh fromBytes(std::string_view bytes) {
  auto positions = takeList<Eigen::Vector3f>(bytes);
  auto normals = takeList<Eigen::Vector3f>(bytes);
  auto triangles = takeList<TriangleMesh::Triangle>(bytes);
  auto parts = takeList<TriangleMesh::Part>(bytes);
  TriangleMesh::Paint paint{.points = takeList<Eigen::Vector2f>(bytes)};
  for (std::uint64_t left = takeCount(bytes); left > 0 && !bytes.empty(); --left) {
    std::vector<int> size = takeList<int>(bytes);
    size.resize(2);
    paint.textures.push_back({size[0], size[1], takeList<std::uint8_t>(bytes)});
  }
  std::vector<std::string> missing;
  for (std::uint64_t left = takeCount(bytes); left > 0 && !bytes.empty(); --left) {
    const std::vector<char> text = takeList<char>(bytes);
    missing.emplace_back(text.begin(), text.end());
  }
  const std::vector<double> turn = takeList<double>(bytes);
  return {
      {std::move(positions), std::move(normals), std::move(triangles), std::move(parts), std::move(paint)},
      std::move(missing),
      turn.size() == 9 ? Eigen::Matrix3d(turn.data()) : Eigen::Matrix3d::Identity()};
}

const char* complaint(IsolatedEnd end) {
  switch (end) {
    case IsolatedEnd::kTookTooLong:
      return "one that assimp does not finish reading";
    case IsolatedEnd::kOutOfMemory:
      return "one for which assimp needs too much memory";
    case IsolatedEnd::kCrashed:
    case IsolatedEnd::kReturned:
      break;
  }
  return "one on which assimp crashes";
}

}  // namespace

TexturedMesh readIsolated(std::string_view bytes, const std::string& name,
                          const std::filesystem::path& folder, const IsolationLimits& limits, bool textures) {
  const auto read = [&] { return toBytes(readByAssimp(bytes, name, folder, textures)); };
  const IsolatedResult result = callIsolated(read, limits);
  if (result.end != IsolatedEnd::kReturned)
    fail(name, "cannot read the mesh file", complaint(result.end),
         "a mesh, e.g. the same one saved by another program or as STL");
  return fromBytes(result.bytes);
}

}  // namespace rex::mesh

namespace rex {
namespace {

namespace fs = std::filesystem;
using mesh::fail;

std::string whyUnreadable(const fs::path& file) {
  std::error_code problem;
  const fs::file_type type = fs::status(file, problem).type();
  if (type == fs::file_type::regular) return {};
  if (type == fs::file_type::not_found) return "no such file";
  if (type == fs::file_type::directory) return "a folder";
  return problem ? problem.message() : "a device";
}

std::string readBytes(const fs::path& file) {
  if (const std::string obstacle = whyUnreadable(file); !obstacle.empty())
    fail(file.string(), "cannot read the mesh file", obstacle, "a file",
         nearestNames(file.filename().string(), internal::namesBeside(file)));
  std::error_code problem;
  const std::uintmax_t size = fs::file_size(file, problem);
  mesh::requireSize(size, file.string());
  std::string bytes(size, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!stream) fail(file.string(), "cannot read the mesh file", "a file that cannot be opened", "a file");
  return bytes;
}

// Ten times what good files take, plus four seconds for slow machines: not every file on which assimp never
// returns is recognised beforehand. A glTF file keeps most of its data, and all textures, in other files.
IsolationLimits limitsFor(std::size_t bytes, const std::string& name, bool textures) {
  IsolationLimits limits;
  if (endingOf(name) != ".gltf" && !textures) limits.cpuSeconds = 4 + static_cast<double>(bytes >> 22);
  return limits;
}

TexturedMesh meshOf(std::string_view bytes, const std::string& name, const fs::path& folder, bool textures) {
  mesh::requireSize(bytes.size(), name);
  if (endingOf(name) == ".msh") return {mesh::readMsh(bytes, name), {}};
  mesh::requireHarmless(bytes, name);
  return mesh::readIsolated(bytes, name, folder, limitsFor(bytes.size(), name, textures), textures);
}

TexturedMesh meshOf(const fs::path& file, bool textures) {
  static_cast<void>(mesh::largestFile(file.string()));  // the ending first, then the file
  return meshOf(readBytes(file), file.string(), internal::folderOf(file), textures);
}

}  // namespace

TexturedMesh mesh::readFile(const fs::path& file, bool textures) { return meshOf(file, textures); }

TriangleMesh readMesh(const fs::path& file) { return meshOf(file, false).mesh; }

TexturedMesh readTexturedMesh(const fs::path& file) { return meshOf(file, true); }

TriangleMesh parseMesh(std::string_view bytes, const std::string& name) {
  return meshOf(bytes, name, {}, false).mesh;
}

}  // namespace rex
