#include "scene/scene_meshes.h"

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "geometry/convex_hull.h"
#include "scene/mesh_reader.h"
#include "scene/opaque_mesh_internal.h"
#include "scene/scaled_mesh.h"

namespace rex {
namespace {

constexpr std::size_t kMostFiles = 4096;
constexpr std::size_t kMostVerticesTogether = 6'000'000;           // 300 MB
constexpr std::size_t kMostPixelsTogether = std::size_t{1} << 26;  // of textures, 200 MB

// Meshes that were not found: one warning for each package or folder.
class Missing {
 public:
  void add(const ShapeSpec& shape, const ErrorParts& reason) {
    const auto [owner, name] = split(shape.meshFile);
    const auto same = [&owner = owner](const Group& group) { return group.owner == owner; };
    auto group = std::find_if(groups_.begin(), groups_.end(), same);
    if (group == groups_.end()) group = groups_.insert(groups_.end(), {owner, name, shape.where, reason, {}});
    group->files.insert(shape.meshFile);
  }

  void addNotes(Diagnostics& notes) const {
    for (const Group& group : groups_) {
      const std::size_t count = group.files.size();
      const std::string which = count == 1
                                    ? fmt::format("mesh '{}' of {} was not found", group.first, group.owner)
                                    : fmt::format("{} meshes of {} were not found, the first is '{}'", count,
                                                  group.owner, group.first);
      const std::string guess = group.reason.nearest.empty()
                                    ? ""
                                    : fmt::format(" (did you mean '{}'?)", group.reason.nearest.front());
      notes.push_back({group.where,
                       fmt::format("{}{}; boxes of 0.1 m replace what is missing; wanted {}", which, guess,
                                   group.reason.wanted),
                       Severity::kWarning});
    }
  }

 private:
  struct Group {
    std::string owner, first;
    SourceLocation where;
    ErrorParts reason;
    std::set<std::string> files;
  };

  // The package or folder, and the path in it.
  static std::pair<std::string, std::string> split(const std::string& file) {
    constexpr std::string_view kPackage = "package://";
    const std::size_t slash = file.starts_with(kPackage) ? file.find('/', kPackage.size()) : file.rfind('/');
    if (slash == std::string::npos) return {"the folder of the scene", file};
    return {file.starts_with(kPackage) ? file.substr(0, slash) : fmt::format("'{}'", file.substr(0, slash)),
            file.substr(slash + 1)};
  }

  std::vector<Group> groups_;
};

class Loader {
 public:
  Loader(const Assets& assets, const ReadOptions& options, Diagnostics& notes)
      : assets_(assets),
        allowMissing_(options.allowMissingMeshes),
        strict_(options.strict),
        textures_(options.textures),
        notes_(notes) {}

  void load(ShapeSpec& shape) {
    if (!usesMesh(shape.shape.type)) return;
    if (shape.shape.mesh.isEmpty()) readMeshOf(shape);
    const bool needsHull = shape.contact && !shape.meshMissing && shape.shape.hull.isEmpty();
    if (needsHull) shape.shape.hull = hullOf(shape);
  }

  void noteMissing() const { missing_.addNotes(notes_); }

 private:
  void readMeshOf(ShapeSpec& shape) {
    const std::string thing = fmt::format("shape '{}'", shape.name);
    if (shape.meshFile.empty())
      throw Error({.what = thing + ": attribute 'mesh' is missing",
                   .where = shape.where,
                   .wanted = "the file of its mesh, in single quotes"});
    if (!find(shape, thing + ": mesh")) return;
    try {
      shape.shape.mesh = read(shape);
    } catch (const Error& error) {
      ErrorParts parts = error.parts();
      parts.what = fmt::format("{}: mesh '{}': {}", thing, shape.meshPath.string(), parts.what);
      parts.where = shape.where;
      throw Error(parts);
    }
  }

  // Whether the file exists. If it does not and missing files are allowed, a box replaces the shape.
  bool find(ShapeSpec& shape, const std::string& what) {
    const auto [known, isNew] = paths_.try_emplace(shape.meshFile);
    if (paths_.size() > kMostFiles)
      throw Error({.what = what,
                   .where = shape.where,
                   .found = fmt::format("mesh file number {}", paths_.size()),
                   .wanted = fmt::format("at most {} different ones in a scene", kMostFiles)});
    if (isNew) {
      try {
        known->second = assets_.find(shape.meshFile, shape.where, what);
      } catch (const Error& error) {
        if (!allowMissing_) throw;
        missing_.add(shape, error.parts());
      }
    }
    shape.meshPath = known->second;
    shape.meshMissing = known->second.empty();
    if (shape.meshMissing) shape.shape = {.type = ShapeType::kBox, .extent = Eigen::Vector3d::Constant(0.1)};
    return !shape.meshMissing;
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

  // Shapes with the same file share its mesh, those with the same scale share the scaled one.
  const TriangleMesh& read(const ShapeSpec& shape) {
    const Eigen::Vector3d& scale = shape.meshScale;
    const std::string name = shape.meshPath.string();
    const auto [known, isNew] = scaled_.try_emplace({name, {scale.x(), scale.y(), scale.z()}});
    if (!isNew) return known->second;
    const auto [whole, isFirst] = read_.try_emplace(name);
    if (isFirst) whole->second = seen(fromFile(shape), shape);
    known->second = scaledMesh(whole->second, scale, name);
    if (isFirst) count(whole->second);
    if (known->second != whole->second) count(known->second);
    return known->second;
  }

  TriangleMesh fromFile(const ShapeSpec& shape) {
    if (!textures_) return readMesh(shape.meshPath);
    const TexturedMesh read = readTexturedMesh(shape.meshPath);
    if (!read.missing.empty()) {
      const std::size_t more = read.missing.size() - 1;
      notes_.push_back({shape.where,
                        fmt::format("shape '{}': mesh '{}': {}; its colour is drawn instead{}", shape.name,
                                    shape.meshPath.string(), read.missing.front(),
                                    more > 0 ? fmt::format(", as it is for {} more", more) : ""),
                        Severity::kWarning});
    }
    for (const Texture& texture : read.mesh.paint().textures) countPixels(texture.rgb.size() / 3);
    return read.mesh;
  }

  void countPixels(std::size_t pixels) {
    pixels_ += pixels;
    if (pixels_ > kMostPixelsTogether)
      throw Error({.what = "all textures so far",
                   .found = fmt::format("{} pixels", pixels_),
                   .wanted = fmt::format("at most {} in a scene", kMostPixelsTogether)});
  }

  // MeshLab's "Tr 1" and Collada's transparency of 0 occur in files of robots that are meant to be visible:
  // some programs write opacity instead of transparency.
  TriangleMesh seen(const TriangleMesh& mesh, const ShapeSpec& shape) {
    if (!hasInvisiblePart(mesh)) return mesh;
    const ErrorParts fault = {
        .what = "a material", .found = "full transparency", .wanted = "one that can be seen"};
    if (strict_) throw Error(fault);
    notes_.push_back({shape.where,
                      fmt::format("shape '{}': mesh '{}': {}; it is drawn opaque", shape.name,
                                  shape.meshPath.string(), Error(fault).what()),
                      Severity::kWarning});
    return withoutInvisibleParts(mesh);
  }

  // A short scene can request many large meshes, or one mesh in many sizes.
  void count(const TriangleMesh& mesh) {
    vertices_ += mesh.positions().size();
    if (vertices_ > kMostVerticesTogether)
      throw Error(
          {.what = "all meshes so far",
           .found = fmt::format("{} vertices", vertices_),
           .wanted = fmt::format("at most {} in all files and scales of a scene", kMostVerticesTogether)});
  }

  using Key = std::pair<std::string, std::array<double, 3>>;
  const Assets& assets_;
  bool allowMissing_, strict_, textures_;
  Diagnostics& notes_;
  Missing missing_;
  std::size_t vertices_ = 0, pixels_ = 0;
  std::map<std::string, std::filesystem::path> paths_;  // where files were found; empty for missing ones
  std::map<std::string, TriangleMesh> read_;
  std::map<Key, TriangleMesh> scaled_;
  std::deque<std::pair<TriangleMesh, TriangleMesh>> hulls_;
};

}  // namespace

void loadMeshes(SceneFile& scene, const Assets& assets, const ReadOptions& options) {
  Loader loader(assets, options, scene.notes);
  for (ShapeSpec& shape : scene.spec.worldShapes) loader.load(shape);
  for (BodySpec& body : scene.spec.bodies)
    for (ShapeSpec& shape : body.shapes) loader.load(shape);
  loader.noteMissing();
}

}  // namespace rex
