#include "formats/scene_meshes.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <deque>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "formats/assets_internal.h"
#include "formats/mesh_reader_internal.h"
#include "formats/scaled_mesh.h"
#include "geometry/convex_hull.h"
#include "geometry/triangle_mesh.h"

namespace rex {

/// Whether a part has a colour with an alpha of 0, so that it would not be seen.
[[nodiscard]] bool hasInvisiblePart(const TriangleMesh& mesh);

/// The same mesh with an alpha of 1 where it is 0.
[[nodiscard]] TriangleMesh withoutInvisibleParts(const TriangleMesh& mesh);

/// The same mesh in one part, without a colour or a texture.
[[nodiscard]] TriangleMesh withoutColors(const TriangleMesh& mesh);

namespace {

bool isInvisible(const TriangleMesh::Part& part) { return part.color && (*part.color)[3] == 0; }

}  // namespace

bool hasInvisiblePart(const TriangleMesh& mesh) {
  return std::any_of(mesh.parts().begin(), mesh.parts().end(), isInvisible);
}

TriangleMesh withoutInvisibleParts(const TriangleMesh& mesh) {
  std::vector<TriangleMesh::Part> parts(mesh.parts().begin(), mesh.parts().end());
  for (TriangleMesh::Part& part : parts)
    if (isInvisible(part)) (*part.color)[3] = 1;
  return {{mesh.positions().begin(), mesh.positions().end()},
          {mesh.normals().begin(), mesh.normals().end()},
          {mesh.triangles().begin(), mesh.triangles().end()},
          std::move(parts),
          mesh.paint()};
}

TriangleMesh withoutColors(const TriangleMesh& mesh) {
  return {{mesh.positions().begin(), mesh.positions().end()},
          {mesh.normals().begin(), mesh.normals().end()},
          {mesh.triangles().begin(), mesh.triangles().end()}};
}

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
    constexpr std::string_view kScheme = "package://";
    const std::size_t slash = file.starts_with(kScheme) ? file.find('/', kScheme.size()) : file.rfind('/');
    if (slash == std::string::npos) return {"the folder of the scene", file};
    return {file.starts_with(kScheme) ? file.substr(0, slash) : fmt::format("'{}'", file.substr(0, slash)),
            file.substr(slash + 1)};
  }

  std::vector<Group> groups_;
};

// Packages that were found above the asset root.
class FromAbove {
 public:
  void add(const ShapeSpec& shape, const std::filesystem::path& file) {
    const std::string package = shape.meshFile.substr(0, shape.meshFile.find('/', std::strlen("package://")));
    if (packages_.insert(package).second) found_.push_back({shape.where, package, file.string()});
  }

  void addNotes(Diagnostics& notes) const {
    for (const auto& [where, package, file] : found_)
      notes.push_back(
          {where, fmt::format("{} was found above the asset root: its first mesh is {}", package, file)});
  }

 private:
  struct Found {
    SourceLocation where;
    std::string package, file;
  };
  std::set<std::string> packages_;
  std::vector<Found> found_;
};

// Collada files that have an up axis other than z, so that the two readings differ.
class Turned {
 public:
  void add(const ShapeSpec& shape) {
    if (files_.empty()) first_ = &shape;
    files_.insert(shape.meshPath.string());
  }

  void addNote(bool ignored, Diagnostics& notes) const {
    if (files_.empty()) return;
    const std::size_t more = files_.size() - 1;
    const std::string others = more == 0 ? "" : fmt::format(" and of {} more", more);
    // The axis that the turn takes to z.
    int axis = 0;
    first_->meshTurn.row(2).cwiseAbs().maxCoeff(&axis);
    notes.push_back(
        {first_->where,
         fmt::format("the up axis of the Collada file '{}' is {}; that{} is {}; --up-axis={} is the "
                     "other reading",
                     first_->meshFile, "xyz"[axis], others,
                     ignored ? "ignored, as in ROS" : "respected: the mesh is turned to z up",
                     ignored ? "respected" : "ignored"),
         Severity::kNote});
  }

 private:
  const ShapeSpec* first_ = nullptr;
  std::set<std::string> files_;
};

class Loader {
 public:
  Loader(const Assets& assets, const ReadOptions& options, MeshMaterials materials, Diagnostics& notes)
      : assets_(assets),
        allowMissing_(options.allowMissingMeshes),
        strict_(options.strict),
        textures_(options.textures),
        upAxis_(options.upAxis),
        materials_(materials),
        notes_(notes) {}

  void load(ShapeSpec& shape) {
    if (!usesMesh(shape.shape.type)) return;
    if (upAxis_ != UpAxis::kAsUsual && shape.shape.mesh.isEmpty())
      shape.ignoresUpAxis = upAxis_ == UpAxis::kIgnored;
    if (shape.shape.mesh.isEmpty()) readMeshOf(shape);
    const bool needsHull = shape.contact && !shape.meshMissing && shape.shape.hull.isEmpty();
    if (needsHull) shape.shape.hull = hullOf(shape);
  }

  void addNotes() const {
    missing_.addNotes(notes_);
    fromAbove_.addNotes(notes_);
    for (const bool ignored : {true, false}) turned_[ignored].addNote(ignored, notes_);
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
        if (!internal::isInside(known->second, assets_.root())) fromAbove_.add(shape, known->second);
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

  // Shapes with the same file share its mesh, those that are also turned and scaled alike the result.
  const TriangleMesh& read(ShapeSpec& shape) {
    const Eigen::Vector3d& scale = shape.meshScale;
    const std::string name = shape.meshPath.string();
    const auto [file, isFirst] = files_.try_emplace(name);
    if (isFirst) {
      file->second = fromFile(shape);
      file->second.mesh = seen(file->second.mesh, shape);
      count(file->second.mesh);
    }
    const TriangleMesh& whole = file->second.mesh;
    shape.meshTurn = file->second.turn;
    const bool isTurned = !shape.meshTurn.isIdentity(0);
    if (isTurned) turned_[shape.ignoresUpAxis].add(shape);
    const bool turnsBack = isTurned && shape.ignoresUpAxis;
    const auto [known, isNew] = placed_.try_emplace({name, turnsBack, {scale.x(), scale.y(), scale.z()}});
    if (!isNew) return known->second;
    known->second =
        scaledMesh(turnsBack ? turnedMesh(whole, shape.meshTurn.transpose()) : whole, scale, name);
    if (known->second != whole) count(known->second);
    return known->second;
  }

  TexturedMesh fromFile(const ShapeSpec& shape) {
    TexturedMesh read = mesh::readFile(shape.meshPath, textures_ && materials_ == MeshMaterials::kUsed);
    if (!read.missing.empty()) {
      const std::size_t more = read.missing.size() - 1;
      notes_.push_back({shape.where,
                        fmt::format("shape '{}': mesh '{}': {}; its colour is drawn instead{}", shape.name,
                                    shape.meshPath.string(), read.missing.front(),
                                    more > 0 ? fmt::format(", as it is for {} more", more) : ""),
                        Severity::kWarning});
    }
    for (const Texture& texture : read.mesh.paint().textures) countPixels(texture.rgb.size() / 3);
    return read;
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
    if (materials_ == MeshMaterials::kIgnored) return withoutColors(mesh);
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

  using Key = std::tuple<std::string, bool, std::array<double, 3>>;  // file, turned back, scale
  const Assets& assets_;
  bool allowMissing_, strict_, textures_;
  UpAxis upAxis_;
  MeshMaterials materials_;
  Diagnostics& notes_;
  Missing missing_;
  FromAbove fromAbove_;
  std::array<Turned, 2> turned_;  // by whether the up axis is ignored
  std::size_t vertices_ = 0, pixels_ = 0;
  std::map<std::string, std::filesystem::path> paths_;  // where files were found; empty for missing ones
  std::map<std::string, TexturedMesh> files_;
  std::map<Key, TriangleMesh> placed_;
  std::deque<std::pair<TriangleMesh, TriangleMesh>> hulls_;
};

}  // namespace

void loadMeshes(SceneFile& scene, const Assets& assets, const ReadOptions& options, MeshMaterials materials) {
  Loader loader(assets, options, materials, scene.notes);
  for (ShapeSpec& shape : scene.spec.worldShapes) loader.load(shape);
  for (BodySpec& body : scene.spec.bodies)
    for (ShapeSpec& shape : body.shapes) loader.load(shape);
  loader.addNotes();
}

}  // namespace rex
