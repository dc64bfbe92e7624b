#include <array>
#include <cstring>
#include <type_traits>

#include "scene/assimp_mesh_internal.h"
#include "scene/isolated_mesh_internal.h"
#include "scene/mesh_limits_internal.h"

namespace rex::mesh {
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
