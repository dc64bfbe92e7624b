#include "scene/scene_meshes.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "scene/mesh_reader.h"

namespace rex {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

TriangleMesh moved(const TriangleMesh& mesh, const Vector3d& by) {
  std::vector<Vector3f> positions;
  for (const Vector3f& p : mesh.positions()) positions.push_back((p.cast<double>() + by).cast<float>());
  return {std::move(positions),
          {mesh.normals().begin(), mesh.normals().end()},
          {mesh.triangles().begin(), mesh.triangles().end()},
          {mesh.parts().begin(), mesh.parts().end()}};
}

// Of the distinct places: how often a sharp edge splits a vertex does not count.
Vector3d meanPlace(const TriangleMesh& mesh) {
  std::vector<Vector3f> places(mesh.positions().begin(), mesh.positions().end());
  const auto before = [](const Vector3f& a, const Vector3f& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  std::sort(places.begin(), places.end(), before);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  Vector3d sum = Vector3d::Zero();
  for (const Vector3f& place : places) sum += place.cast<double>();
  return sum / static_cast<double>(places.size());
}

struct CenteredMesh {
  TriangleMesh mesh;
  Vector3d center;  // where its origin was moved to
};

CenteredMesh readCentered(const std::filesystem::path& file, double scale, bool recenter) {
  const TriangleMesh mesh = readMesh(file, scale);
  if (!recenter) return {mesh, Vector3d::Zero()};
  const Vector3d center = meanPlace(mesh);
  return {moved(mesh, -center), center};
}

class Loader {
 public:
  explicit Loader(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void load(ShapeSpec& shape) {
    if (!usesMesh(shape.shape.type) || !shape.shape.mesh.isEmpty()) return;
    const std::string thing = fmt::format("shape '{}'", shape.name);
    if (shape.meshFile.empty())
      throw Error({.what = thing + ": attribute 'mesh' is missing",
                   .where = shape.where,
                   .wanted = "the file of its mesh, in single quotes"});
    const std::filesystem::path file = folder_ / shape.meshFile;
    try {
      const CenteredMesh& known = read(file, shape.meshScale, shape.shape.type == ShapeType::kMesh);
      shape.shape.mesh = known.mesh;
      shape.X_BS.p += shape.X_BS.R * known.center;
    } catch (const Error& error) {
      ErrorParts parts = error.parts();
      parts.what = fmt::format("{}: mesh '{}': {}", thing, file.string(), parts.what);
      parts.where = shape.where;
      throw Error(parts);
    }
  }

 private:
  // Shapes with the same file share its mesh.
  const CenteredMesh& read(const std::filesystem::path& file, double scale, bool recenter) {
    const auto key = std::tuple(file.string(), scale, recenter);
    const auto found = read_.find(key);
    return found != read_.end() ? found->second
                                : read_.emplace(key, readCentered(file, scale, recenter)).first->second;
  }

  std::filesystem::path folder_;
  std::map<std::tuple<std::string, double, bool>, CenteredMesh> read_;
};

}  // namespace

void loadMeshes(SceneSpec& spec, const std::filesystem::path& folder) {
  Loader loader(folder);
  for (ShapeSpec& shape : spec.worldShapes) loader.load(shape);
  for (BodySpec& body : spec.bodies)
    for (ShapeSpec& shape : body.shapes) loader.load(shape);
}

}  // namespace rex
