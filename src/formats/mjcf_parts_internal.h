#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "formats/mjcf_files_internal.h"
#include "formats/mjcf_schema_internal.h"
#include "formats/scene_file.h"
#include "formats/urdf_parts_internal.h"
#include "geometry/mesh_mass.h"

// The steps of reading a MuJoCo model. All throw Error with the place.
namespace rex::mjcf {

/// How meshes weigh: by their convex hull, by what they enclose, by MuJoCo's old rule, which counts more than
/// that unless they are convex, or as shells.
enum class MeshInertia { kConvex, kExact, kLegacy, kShell };
[[nodiscard]] const char* wordOf(MeshInertia inertia);

/// What <compiler> says of the whole model.
struct Compiler {
  enum class Inertia { kFromGeoms, kGiven, kEither };
  bool degrees = true;     ///< angles in the file
  bool global = false;     ///< places in bodies are those in the world; MuJoCo before 2.3.4 knew that
  bool autolimits = true;  ///< a range that is given counts unless `limited` forbids it
  Inertia inertia = Inertia::kEither;
  int leastGroup = 0, mostGroup = 5;  ///< of the geoms that weigh something
  std::string eulerOrder = "xyz";     ///< small letters: axes that turn along, capitals: fixed ones
  std::string meshFolder{};
  bool stripsPaths = false;               ///< of meshes, only the name counts
  double leastMass = 0, leastMoment = 0;  ///< of each body, kg and kg m^2; moments are principal ones
  std::optional<double> totalMass{};      ///< to which all masses are scaled
  bool balancesMoments = false;           ///< makes impossible inertias spherical
  bool alignsFree = false;                ///< see alignFreeBodies(), for bodies that do not say it themselves
  bool fitsBounds = false;                ///< geoms are fitted to the bounds of meshes, not to their inertias
  MeshInertia meshInertia = MeshInertia::kLegacy;  ///< of meshes that do not say it themselves

  double angle(double given) const;
};
void readCompiler(const Tag& tag, Compiler& compiler);

/// The pose by `pos` and one of `quat`, `axisangle`, `euler`, `xyaxes` and `zaxis`.
[[nodiscard]] Pose poseOf(const Styled& tag, const Compiler& compiler);
/// The smallest turn that takes z to a direction; of the opposite one, about x.
[[nodiscard]] Eigen::Matrix3d rotationFromZ(const Eigen::Vector3d& direction);
/// The turn by three angles of the file, about the axes that `eulerseq` names.
[[nodiscard]] Eigen::Matrix3d rotationFromEuler(const Eigen::Vector3d& angles, const Compiler& compiler);

/// The place of a word among those that an attribute may have.
[[nodiscard]] std::size_t choice(const Tag& tag, const char* attribute,
                                 const std::vector<std::string>& words);
/// "true" or "false".
[[nodiscard]] bool flag(const Tag& tag, const char* attribute);
/// Whether a range counts: as `limited` says, or else if it is given.
[[nodiscard]] bool isLimited(const Styled& tag, const char* limited, const char* range,
                             const Compiler& compiler);

/// A <mesh>: that of a file, or one that is given in the tag, scaled already.
struct MeshAsset {
  std::string file;
  TriangleMesh mesh{}, hull{};
  Eigen::Vector3d scale{1, 1, 1};
  Pose X_SM{};  ///< where it stands in the frame of its geom, by refpos and refquat
  MeshInertia inertia = MeshInertia::kLegacy;
  SourceLocation where{};
};
/// A height field: what is drawn, and the convex pieces that are touched. Empty in a scene given as text, if
/// its heights are in a file.
struct HeightField {
  TriangleMesh drawn{};
  std::vector<TriangleMesh> pieces{};
};
struct BodyTree;
/// The meshes, height fields and colours that geoms name, and the models that <attach> names.
struct MjcfAssets {
  /// A model that is read when it is first attached.
  struct Other {
    Tag tag;
    std::shared_ptr<const BodyTree> tree{};
  };
  mutable std::unordered_map<std::string, Other> models;
  /// Reads a <model>, with the masses of its bodies.
  std::function<BodyTree(const Tag&)> readOther{};
  std::unordered_map<std::string, MeshAsset> meshes;
  std::unordered_map<std::string, HeightField> heightFields;
  std::unordered_map<std::string, Eigen::Vector4d> colors;
};
/// The mesh that `vertex` and `face` or `builtin` give; empty without these.
[[nodiscard]] TriangleMesh meshInTag(const Tag& tag);
/// Where refpos and refquat put a mesh, whose `scale` becomes that along its own axes: MuJoCo scales what is
/// turned.
[[nodiscard]] Pose placeOfMesh(const Tag& tag, Eigen::Vector3d& scale);
/// The numbers of `rgba`, each from 0 to 1; empty if it is not given.
[[nodiscard]] std::optional<Eigen::Vector4d> colorOf(const Styled& styled);
void readAssets(const Tag& tag, Files& files, const Defaults& defaults, const Compiler& compiler,
                MjcfAssets& assets);
/// A <hfield> of the assets, with its heights from the tag or a file. Warns if its pieces are coarse.
[[nodiscard]] HeightField readHeightField(const Tag& tag, const Files& files, const Compiler& compiler);

/// What a geom adds to its body: a solid of mass or density, the half sizes as MuJoCo has them.
struct Solid {
  enum class Kind { kSphere, kCapsule, kCylinder, kBox, kEllipsoid, kMesh };
  Kind kind = Kind::kSphere;
  Eigen::Vector3d size{0, 0, 0};
  Pose X_BS{};
  std::optional<double> mass{};       ///< kg
  double density = 1000;              ///< kg / m^3, or of a shell kg / m^2
  bool isShell = false;               ///< but for meshes, whose inertia says it
  std::optional<std::size_t> mesh{};  ///< which shape of the body has it
  MeshInertia inertia{};              ///< of a mesh
  SourceLocation where{};
};
/// The mass properties for density 1, in the frame of the solid, which is no mesh.
[[nodiscard]] MassProperties ofDensityOne(const Solid& solid);
/// The same of the mesh of a shape.
[[nodiscard]] MassProperties massOfMesh(const ShapeSpec& shape, MeshInertia inertia);

/// A geom that becomes a solid as large as its mesh. Until fitGeoms() its shape is the mesh, not in contact.
struct GeomFit {
  Solid::Kind kind = Solid::Kind::kSphere;
  MeshInertia inertia = MeshInertia::kLegacy;  ///< of the mesh
  double scale = 1;
  bool contact = true;  ///< of the shape that it becomes
};
/// A <geom>: shapes unless rex has none like it, and a solid if it weighs something. Names that
/// are missing are given later.
struct Geom {
  std::vector<ShapeSpec> shapes{};
  std::optional<Solid> solid{};
  std::optional<GeomFit> fit{};
  std::string name{};  ///< empty: none
};
[[nodiscard]] Geom readGeom(const Styled& tag, bool isOnWorld, const Compiler& compiler,
                            const MjcfAssets& assets);

/// A <joint> of a body: X_PF and X_MC are as if the parent's frame were that of the body where the joint is
/// at `ref`. A missing name is given later.
struct BodyJoint {
  JointSpec spec{};
  /// Time (seconds) and ratio, both > 0, which give stiffness and damping when all masses are there.
  std::optional<Eigen::Vector2d> springDamper{};
};
[[nodiscard]] BodyJoint readBodyJoint(const Styled& tag, const Compiler& compiler);

/// A body of the file; its mass follows when all meshes are there.
struct BodyInFile {
  std::size_t body = 0;  ///< in the spec
  std::string parent{};
  std::size_t joints = 0;
  std::optional<MassProperties> given{};
  std::optional<Eigen::Matrix3d> givenAxes{};  ///< those of `diaginertia`, in the body
  std::vector<Solid> solids{};                 ///< as far as they count
  bool isWeighed = false;                      ///< by its solids, set by setMasses()
  bool aligns = false;    ///< its frame becomes that of its inertia if it has no children
  bool hasGeoms = false;  ///< also such as make no shapes
};
/// The shapes of a geom, of a body by its place in the spec, or of the world.
struct GeomInTree {
  std::optional<std::size_t> body{};
  std::size_t first = 0, count = 0;
};
/// A fit of a shape of a body, or of the world, whose solid, if it has one, is `solid` of BodyInFile::solids.
struct FitInTree {
  GeomInTree at{};
  std::optional<std::size_t> solid{};
  GeomFit fit{};
};
/// All bodies. Where one has several joints, bodies without mass stand between these.
struct BodyTree {
  SceneSpec spec{};
  std::vector<urdf::ReadJoint> joints{};
  std::vector<BodyInFile> bodies{};
  std::unordered_map<std::string, std::size_t> jointOfName{}, bodyOfName{};
  std::unordered_map<std::string, GeomInTree> geomOfName{};
  std::vector<FitInTree> fits{};
  /// BodyJoint::springDamper of joints by their names, and what <flag> leaves of those.
  std::vector<std::pair<std::string, Eigen::Vector2d>> springDampers{};
  bool hasSprings = true, hasDampers = true;
  /// The joints on each <fixed> tendon, with their coefficients.
  std::unordered_map<std::string, std::vector<std::pair<std::string, double>>> tendons{};
  /// What follows the names that stand in a <replicate>, once for each replica.
  std::unordered_map<std::string, std::vector<std::string>> replicas{};
  std::string suffix{};  ///< of the replica that names mean first

  /// A name as that of a thing of these: the one of the replica, or the plain one.
  template <class Things>
  std::string seen(const std::string& name, const Things& things) const {
    return things.contains(name + suffix) ? name + suffix : name;
  }
  /// Calls visit() once for each replica of the things that a tag names, or once.
  template <class Visit>
  void forEachReplica(const Tag& tag, const Visit& visit) {
    for (const char* attribute : {"joint", "joint1", "joint2", "body1", "body2", "geom1", "geom2"}) {
      const auto found = tag.has(attribute) ? replicas.find(tag.text(attribute)) : replicas.end();
      if (found == replicas.end()) continue;
      for (const std::string& one : found->second) {
        suffix = one;
        visit();
      }
      suffix.clear();
      return;
    }
    visit();
  }

  /// The shapes of a body, or of the world.
  std::vector<ShapeSpec>& shapesOf(const std::optional<std::size_t>& body) {
    return body ? spec.bodies[*body].shapes : spec.worldShapes;
  }
};
/// The new name of a body, joint, geom, tendon or key of a model that is attached.
using Rename = std::function<std::string(const std::string&)>;
/// The part of a model that an <attach> names, with new names. Its world stands for what it is attached to.
[[nodiscard]] BodyTree partToAttach(const BodyTree& whole, const Tag& tag, const Rename& renamed);
/// Hangs such a part on a body of the tree, or on the world; X_PF places its world there.
void graft(const Tag& tag, BodyTree part, const std::string& parent, const Pose& X_PF, BodyTree& tree);

[[nodiscard]] BodyTree readTree(const std::vector<Tag>& worldbodies, Files& files, const Defaults& defaults,
                                const Compiler& compiler, const MjcfAssets& assets);

/// Replaces each fitted geom by the solid with the inertia of its mesh, or with `fitaabb` its bounds, as
/// MuJoCo does.
void fitGeoms(BodyTree& tree, const Compiler& compiler, Reading& reading);

/// Gives all bodies their masses.
void setMasses(BodyTree& tree, const Compiler& compiler, Reading& reading);

/// Moves the frames of free bodies without children that are to be aligned to their centres of mass, along
/// the axes of their inertias, as MuJoCo does. To be called when the bodies have their masses.
void alignFreeBodies(BodyTree& tree, Reading& reading);

/// Makes springs and dampers of the attributes `springdamper`, by the inertia that each joint meets where all
/// start, as MuJoCo does. To be called when the bodies have their masses.
void setSprings(BodyTree& tree, Reading& reading);

/// <tendon>: what joints hang on which.
void readTendons(const std::vector<Tag>& sections, Files& files, const Defaults& defaults,
                 const Compiler& compiler, BodyTree& tree);
/// <actuator>: how strong joints are. <equality>: which follow others, and what is pinned to what.
void readActuators(const std::vector<Tag>& sections, Files& files, const Defaults& defaults,
                   const Compiler& compiler, BodyTree& tree);
void readEqualities(const std::vector<Tag>& sections, Files& files, const Defaults& defaults,
                    const Compiler& compiler, BodyTree& tree);
/// The joint of the tree that an attribute names.
[[nodiscard]] JointSpec& jointIn(const Tag& tag, const char* attribute, BodyTree& tree);
/// The tags <connect>, and <weld>, which become three pins.
void readPins(const std::vector<Tag>& tags, const Defaults& defaults, const Compiler& compiler,
              BodyTree& tree);
/// The name of a body of the tree, or "world".
[[nodiscard]] std::string bodyIn(const Tag& tag, const char* attribute, const BodyTree& tree);
/// <contact>: who may not collide, and which geoms may (<pair>).
void readContacts(const std::vector<Tag>& sections, Files& files, BodyTree& tree);

/// <keyframe>: the postures of its keys, called "key:NAME".
void readKeyframes(const std::vector<Tag>& sections, Files& files, BodyTree& tree);

/// Warns of bodies with geoms that can touch nothing in this scene, or nothing that is added to it.
void noteUntouchable(BodyTree& tree, Notes& notes);
/// Forbids those between which there are several joints: bodies between joints hide that they are neighbours.
void forbidNeighbours(BodyTree& tree);

}  // namespace rex::mjcf
