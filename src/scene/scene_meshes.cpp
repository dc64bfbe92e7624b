#include "scene/scene_meshes.h"

#include <array>
#include <deque>
#include <map>

#include <fmt/format.h>

#include "geometry/convex_hull.h"
#include "scene/mesh_reader.h"

namespace rex {
namespace {

class Loader {
 public:
  Loader(const Assets& assets, bool allowMissing, Diagnostics& notes)
      : assets_(assets), allowMissing_(allowMissing), notes_(notes) {}

  void load(ShapeSpec& shape) {
    if (!usesMesh(shape.shape.type)) return;
    if (shape.shape.mesh.isEmpty()) readMeshOf(shape);
    if (shape.contact) shape.shape.hull = hullOf(shape);
  }

 private:
  void readMeshOf(ShapeSpec& shape) {
    const std::string thing = fmt::format("shape '{}'", shape.name);
    if (shape.meshFile.empty())
      throw Error({.what = thing + ": attribute 'mesh' is missing",
                   .where = shape.where,
                   .wanted = "the file of its mesh, in single quotes"});
    if (!find(shape, thing + ": mesh")) return;
    try {
      shape.shape.mesh = read(shape.meshPath, shape.meshScale);
    } catch (const Error& error) {
      ErrorParts parts = error.parts();
      parts.what = fmt::format("{}: mesh '{}': {}", thing, shape.meshPath.string(), parts.what);
      parts.where = shape.where;
      throw Error(parts);
    }
  }

  // Whether the file is there; if not, and that may be, a marker takes the place of the shape.
  bool find(ShapeSpec& shape, const std::string& what) {
    constexpr double kMarkerSize = 0.1;
    try {
      shape.meshPath = assets_.find(shape.meshFile, shape.where, what);
      return true;
    } catch (const Error& error) {
      if (!allowMissing_) throw;
      ErrorParts parts = error.parts();
      parts.where = {};
      notes_.push_back(
          {shape.where, fmt::format("{}; a marker stands for it", Error(parts).what()), Severity::kWarning});
      shape.shape = {.type = ShapeType::kMarker, .extent = Eigen::Vector3d::Constant(kMarkerSize)};
      shape.contact = false;
      return false;
    }
  }

  // Shapes with the same mesh share its hull.
  const TriangleMesh& hullOf(const ShapeSpec& shape) {
    const TriangleMesh& mesh = shape.shape.mesh;
    for (const auto& [known, hull] : hulls_)
      if (known == mesh) return hull;
    try {
      return hulls_.emplace_back(mesh, convexHull(mesh)).second;
    } catch (const Error& error) {
      ErrorParts parts = error.parts();
      parts.what = fmt::format("shape '{}': mesh in contact: {}", shape.name, parts.what);
      parts.where = shape.where;
      parts.wanted += ": a coarser mesh for contact, or none";
      throw Error(parts);
    }
  }

  // Shapes with the same file share its mesh.
  const TriangleMesh& read(const std::filesystem::path& file, const Eigen::Vector3d& scale) {
    const Key key(file.string(), {scale.x(), scale.y(), scale.z()});
    const auto found = read_.find(key);
    return found != read_.end() ? found->second : read_.emplace(key, readMesh(file, scale)).first->second;
  }

  using Key = std::pair<std::string, std::array<double, 3>>;
  const Assets& assets_;
  bool allowMissing_;
  Diagnostics& notes_;
  std::map<Key, TriangleMesh> read_;
  std::deque<std::pair<TriangleMesh, TriangleMesh>> hulls_;
};

}  // namespace

void loadMeshes(SceneFile& scene, const Assets& assets, bool allowMissing) {
  Loader loader(assets, allowMissing, scene.notes);
  for (ShapeSpec& shape : scene.spec.worldShapes) loader.load(shape);
  for (BodySpec& body : scene.spec.bodies)
    for (ShapeSpec& shape : body.shapes) loader.load(shape);
}

}  // namespace rex
