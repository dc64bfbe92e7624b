#include "scene/scene_meshes.h"

#include <array>
#include <map>

#include <fmt/format.h>

#include "scene/mesh_reader.h"

namespace rex {
namespace {

class Loader {
 public:
  explicit Loader(const Assets& assets) : assets_(assets) {}

  void load(ShapeSpec& shape) {
    if (!usesMesh(shape.shape.type) || !shape.shape.mesh.isEmpty()) return;
    const std::string thing = fmt::format("shape '{}'", shape.name);
    if (shape.meshFile.empty())
      throw Error({.what = thing + ": attribute 'mesh' is missing",
                   .where = shape.where,
                   .wanted = "the file of its mesh, in single quotes"});
    shape.meshPath = assets_.find(shape.meshFile, shape.where, thing + ": mesh");
    try {
      shape.shape.mesh = read(shape.meshPath, shape.meshScale);
    } catch (const Error& error) {
      ErrorParts parts = error.parts();
      parts.what = fmt::format("{}: mesh '{}': {}", thing, shape.meshPath.string(), parts.what);
      parts.where = shape.where;
      throw Error(parts);
    }
  }

 private:
  // Shapes with the same file share its mesh.
  const TriangleMesh& read(const std::filesystem::path& file, const Eigen::Vector3d& scale) {
    const Key key(file.string(), {scale.x(), scale.y(), scale.z()});
    const auto found = read_.find(key);
    return found != read_.end() ? found->second : read_.emplace(key, readMesh(file, scale)).first->second;
  }

  using Key = std::pair<std::string, std::array<double, 3>>;
  const Assets& assets_;
  std::map<Key, TriangleMesh> read_;
};

}  // namespace

void loadMeshes(SceneFile& scene, const Assets& assets) {
  Loader loader(assets);
  for (ShapeSpec& shape : scene.spec.worldShapes) loader.load(shape);
  for (BodySpec& body : scene.spec.bodies)
    for (ShapeSpec& shape : body.shapes) loader.load(shape);
}

}  // namespace rex
