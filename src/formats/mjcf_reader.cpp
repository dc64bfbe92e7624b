#include "formats/mjcf_reader.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/text.h"
#include "formats/mjcf_parts_internal.h"
#include "formats/scene_meshes.h"
#include "geometry/rotation.h"

namespace rex::mjcf {
namespace {

const std::vector<std::string> kOrientations = {"quat", "axisangle", "euler", "xyaxes", "zaxis"};

[[noreturn]] void failAtDirection(const Tag& tag, const char* attribute, const char* wanted) {
  tag.failAt(attribute, xml::quoted(tag.text(attribute)), wanted);
}

Eigen::Vector3d direction(const Tag& tag, const char* attribute, const Eigen::Vector3d& given,
                          const char* wanted = "a direction") {
  constexpr double kTiny = 1e-100;
  const double length = given.stableNorm();
  if (!(length > kTiny && length < 1 / kTiny)) failAtDirection(tag, attribute, wanted);
  return given / length;
}

Eigen::Matrix3d fromAxes(const Tag& tag) {
  const char* wanted = "two directions that are not parallel";
  const Eigen::VectorXd given = tag.numbers("xyaxes", 6);
  const Eigen::Vector3d x = direction(tag, "xyaxes", given.head<3>(), wanted);
  const Eigen::Vector3d along = direction(tag, "xyaxes", given.tail<3>(), wanted);
  const Eigen::Vector3d rest = along - x * x.dot(along);
  if (!(rest.norm() > 1e-12)) failAtDirection(tag, "xyaxes", wanted);
  Eigen::Matrix3d R;
  R.col(0) = x;
  R.col(1) = rest.normalized();
  R.col(2) = R.col(0).cross(R.col(1));
  return R;
}

Eigen::Matrix3d orientationBy(const std::string& attribute, const Tag& tag, const Compiler& compiler) {
  if (attribute == "euler") return rotationFromEuler(tag.numbers("euler", 3), compiler);
  if (attribute == "xyaxes") return fromAxes(tag);
  if (attribute == "zaxis") return rotationFromZ(direction(tag, "zaxis", tag.numbers("zaxis", 3)));
  const Eigen::Vector4d given = tag.numbers(attribute.c_str(), 4);
  if (attribute == "axisangle")
    return rotationAboutAxis(compiler.angle(given[3]),
                             direction(tag, "axisangle", given.head<3>(), "a direction and an angle"));
  const double length = given.stableNorm();
  if (!(length > 1e-100 && length < 1e100)) failAtDirection(tag, "quat", "a quaternion w x y z");
  return rotationFromQuaternion(given / length);
}

// The attributes of the tag itself override its defaults.
Eigen::Matrix3d orientationOf(const Styled& styled, const Compiler& compiler) {
  const std::string* only = nullptr;
  for (const bool ofOwn : {true, false}) {
    for (const std::string& name : kOrientations) {
      const Tag& giver = ofOwn ? styled.own() : styled.giver(name.c_str());
      if (!giver.has(name)) continue;
      if (only)
        giver.fail(giver.where(name.c_str()), "two orientations", fmt::format("'{}' and '{}'", *only, name),
                   "one");
      only = &name;
    }
    if (only) break;
  }
  if (!only) return Eigen::Matrix3d::Identity();
  return orientationBy(*only, styled.giver(only->c_str()), compiler);
}

double notLessThanZero(const Tag& tag, const char* attribute, double otherwise) {
  return std::max(0., tag.number(attribute, otherwise));
}

void readEulerOrder(const Tag& tag, Compiler& compiler) {
  if (!tag.has("eulerseq")) return;
  const std::string& order = tag.text("eulerseq");
  if (order.size() != 3 || order.find_first_not_of("xyzXYZ") != std::string::npos)
    tag.failAt("eulerseq", xml::quoted(order), "three letters from x, y, z, X, Y and Z");
  compiler.eulerOrder = order;
}

void readCoordinates(const Tag& tag, Compiler& compiler) {
  if (!tag.has("coordinate")) return;
  compiler.global = choice(tag, "coordinate", {"local", "global"}) == 1;
  if (compiler.global)
    tag.warn(tag.where("coordinate"),
             "global coordinates, which MuJoCo no longer supports: a body without 'pos' has the frame of the "
             "world");
}

void readGroups(const Tag& tag, Compiler& compiler) {
  if (!tag.has("inertiagrouprange")) return;
  const Eigen::VectorXd groups = tag.numbers("inertiagrouprange", 2);
  const Eigen::VectorXd bounded = groups.cwiseMax(-1e6).cwiseMin(1e6);
  compiler.leastGroup = static_cast<int>(std::ceil(bounded[0]));
  compiler.mostGroup = static_cast<int>(std::floor(bounded[1]));
}

}  // namespace

double Compiler::angle(double given) const { return degrees ? given * std::numbers::pi / 180 : given; }

void readCompiler(const Tag& given, Compiler& compiler) {
  using Inertia = Compiler::Inertia;
  const Tag tag = given.of("<compiler>");
  tag.expect(knownOf("compiler"));
  readCoordinates(tag, compiler);
  if (tag.has("angle")) compiler.degrees = choice(tag, "angle", {"radian", "degree"}) == 1;
  const auto readFlag = [&](const char* name, bool& value) {
    if (tag.has(name)) value = flag(tag, name);
  };
  readFlag("autolimits", compiler.autolimits);
  readFlag("strippath", compiler.stripsPaths);
  readFlag("balanceinertia", compiler.balancesMoments);
  readFlag("fitaabb", compiler.fitsBounds);
  readFlag("alignfree", compiler.alignsFree);
  if (tag.has("exactmeshinertia"))
    compiler.meshInertia = flag(tag, "exactmeshinertia") ? MeshInertia::kExact : MeshInertia::kLegacy;
  readEulerOrder(tag, compiler);
  for (const char* name : {"assetdir", "meshdir"})
    if (tag.has(name)) compiler.meshFolder = tag.text(name);
  if (tag.has("inertiafromgeom")) {
    constexpr Inertia kMeaning[] = {Inertia::kGiven, Inertia::kFromGeoms, Inertia::kEither};
    compiler.inertia = kMeaning[choice(tag, "inertiafromgeom", {"false", "true", "auto"})];
  }
  readGroups(tag, compiler);
  compiler.leastMass = notLessThanZero(tag, "boundmass", compiler.leastMass);
  compiler.leastMoment = notLessThanZero(tag, "boundinertia", compiler.leastMoment);
  if (tag.has("settotalmass")) {
    const double total = tag.number("settotalmass");
    compiler.totalMass = total > 0 ? std::optional(total) : std::nullopt;
  }
}

Eigen::Matrix3d rotationFromEuler(const Eigen::Vector3d& angles, const Compiler& compiler) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  for (int i = 0; i < 3; ++i) {
    const char axis = compiler.eulerOrder[static_cast<std::size_t>(i)];
    const bool turnsAlong = axis >= 'x';
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis - (turnsAlong ? 'x' : 'X'));
    const Eigen::Matrix3d turn = rotationAboutAxis(compiler.angle(angles[i]), unit);
    R = turnsAlong ? Eigen::Matrix3d(R * turn) : Eigen::Matrix3d(turn * R);
  }
  return R;
}

Pose poseOf(const Styled& tag, const Compiler& compiler) {
  Pose X;
  const Tag& giver = tag.giver("pos");
  if (giver.has("pos")) X.p = giver.numbers("pos", 3);
  X.R = orientationOf(tag, compiler);
  return X;
}

Eigen::Matrix3d rotationFromZ(const Eigen::Vector3d& direction) {
  Eigen::Vector3d axis(-direction.y(), direction.x(), 0);
  const double sine = axis.norm();
  if (sine < 1e-10 * std::abs(direction.z())) axis = Eigen::Vector3d::UnitX();
  return rotationAboutAxis(std::atan2(sine, direction.z()), axis);
}

std::size_t choice(const Tag& tag, const char* attribute, const std::vector<std::string>& words) {
  const std::string& word = tag.text(attribute);
  const auto found = std::find(words.begin(), words.end(), word);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  const std::string wanted =
      fmt::format("{} or {}", join(std::span(words).first(words.size() - 1), ", "), words.back());
  tag.fail(tag.where(attribute), fmt::format("attribute '{}'", attribute), xml::quoted(word), wanted,
           nearestNames(word, words));
}

bool flag(const Tag& tag, const char* attribute) { return choice(tag, attribute, {"false", "true"}) == 1; }

bool isLimited(const Styled& tag, const char* limited, const char* range, const Compiler& compiler) {
  const Tag& giver = tag.giver(limited);
  const std::size_t said = giver.has(limited) ? choice(giver, limited, {"false", "true", "auto"}) : 2;
  if (said < 2) return said == 1;
  if (!tag.has(range)) return false;
  if (!compiler.autolimits)
    tag.own().remark(fmt::format("{} of <{}> has no effect: autolimits is off, and {} is not given", range,
                                 tag.own().name(), limited));
  return compiler.autolimits;
}

}  // namespace rex::mjcf

namespace rex {
namespace {

using namespace mjcf;

// The sections with that name in all files.
std::vector<Tag> named(const std::vector<Tag>& sections, const char* name) {
  std::vector<Tag> found;
  for (const Tag& tag : sections)
    if (tag.name() == name) found.push_back(tag);
  return found;
}

// What the flags of <option> leave of a model.
struct Switches {
  bool equality = true, friction = true, limits = true, contacts = true;
  bool dampers = true, springs = true;
};

void readFlags(const Tag& tag, Switches& switches) {
  tag.expect(knownOf("flag"));
  const auto isOff = [&](const char* name) {
    return tag.has(name) && choice(tag, name, {"disable", "enable"}) == 0;
  };
  const bool constrains = !isOff("constraint"), resists = !isOff("passive");
  switches.equality = switches.equality && constrains && !isOff("equality");
  switches.friction = switches.friction && constrains && !isOff("frictionloss");
  switches.limits = switches.limits && constrains && !isOff("limit");
  switches.contacts = switches.contacts && constrains && !isOff("contact");
  switches.dampers = switches.dampers && resists && !isOff("damper");
  switches.springs = switches.springs && resists && !isOff("spring");
  for (const char* name : {"gravity", "clampctrl", "actuation"})
    if (isOff(name)) tag.leaveOut(name, Difference::kMotion);
  if (isOff("filterparent")) tag.leaveOut("filterparent", Difference::kContact);
  if (tag.has("override") && !isOff("override")) tag.leaveOut("override", Difference::kContact);
}

void readOption(const Tag& given, Switches& switches) {
  const Tag tag = given.of("<option>");
  tag.expect(knownOf("option"));
  const Eigen::Vector3d usual(0, 0, -9.81);
  if (tag.has("gravity") && !tag.numbers("gravity", 3).isApprox(usual, 1e-9))
    tag.warn(tag.where("gravity"), "rex always computes with a gravity of 9.81 m/s^2 along -z",
             Difference::kMotion);
  for (const char* fluid : {"density", "viscosity"})
    if (tag.number(fluid, 0) != 0) tag.leaveOut(fluid, Difference::kMotion);
  for (const Tag& flags : tag.children("flag")) readFlags(flags, switches);
}

void apply(const Switches& switches, BodyTree& tree, Notes& notes) {
  for (urdf::ReadJoint& read : tree.joints) {
    JointSpec& joint = read.spec;
    if (!switches.friction) joint.friction = 0;
    if (!switches.dampers) joint.damping = 0;
    if (!switches.springs) joint.stiffness = 0;
    if (switches.limits) continue;
    joint.lower.resize(0);
    joint.upper.resize(0);
  }
  tree.hasSprings = switches.springs;
  tree.hasDampers = switches.dampers;
  if (switches.contacts) return;
  notes.remark({tree.spec.name}, "<flag> disables contact: nothing touches");
  for (FitInTree& fit : tree.fits) fit.fit.contact = false;
  for (ShapeSpec& shape : tree.spec.worldShapes) shape.contact = false;
  for (BodySpec& body : tree.spec.bodies)
    for (ShapeSpec& shape : body.shapes) shape.contact = false;
}

// One warning for all joints that start outside their ranges.
void noteStarts(const std::vector<urdf::ReadJoint>& joints, Notes& notes) {
  const JointSpec* first = nullptr;
  int count = 0;
  for (const auto& [joint, parentAt, childAt, mimicAt] : joints) {
    if (joint.lower.size() == 0) continue;
    const double start = joint.q0.size() > 0 ? joint.q0[0] : 0;
    if (start >= joint.lower[0] && start <= joint.upper[0]) continue;
    if (count++ == 0) first = &joint;
  }
  if (count == 0) return;
  const std::string others = count == 1   ? ""
                             : count == 2 ? ", and so does another joint"
                                          : fmt::format(", and so do {} other joints", count - 1);
  notes.warn(first->where, fmt::format("joint '{}' starts outside its range, {:.4g} to {:.4g}{}", first->name,
                                       first->lower[0], first->upper[0], others));
}

constexpr std::size_t kLargestModel = 8u << 20;  // bytes

// How a model is read, and those that it attaches.
struct ModelSource {
  const Assets* assets;  // null: files are not read
  const ReadOptions& options;
  Diagnostics& notes;  // of meshes, and of models that are attached
  int depth = 0;       // of a model that is attached to others
};

BodyTree readOther(const Tag& model, const Files& files, const ModelSource& source);

// A model as text; its bodies have no masses yet.
BodyTree readModel(Files& files, const std::string& name, Compiler& compiler, const ModelSource& source) {
  const std::vector<Tag> sections = files.children(files.root(), knownOf("mujoco"));
  for (const Tag& tag : named(sections, "compiler")) readCompiler(tag, compiler);
  Switches switches;
  for (const Tag& tag : named(sections, "option")) readOption(tag, switches);
  Defaults defaults;
  for (const Tag& tag : named(sections, "default")) defaults.read(tag, files);
  MjcfAssets assets;
  assets.readOther = [&](const Tag& model) { return readOther(model, files, source); };
  for (const Tag& tag : named(sections, "asset"))
    readAssets(tag.of("<asset>"), files, defaults, compiler, assets);
  BodyTree tree = readTree(named(sections, "worldbody"), files, defaults, compiler, assets);
  tree.spec.name = name;
  for (const Tag& tag : named(sections, "deformable"))
    static_cast<void>(files.children(tag.of("<deformable>"), knownOf("deformable")));
  readTendons(named(sections, "tendon"), files, defaults, compiler, tree);
  readActuators(named(sections, "actuator"), files, defaults, compiler, tree);
  if (switches.equality) readEqualities(named(sections, "equality"), files, defaults, compiler, tree);
  readContacts(named(sections, "contact"), files, tree);
  readKeyframes(named(sections, "keyframe"), files, tree);
  apply(switches, tree, files.main().notes);
  if (source.depth == 0) {
    if (switches.contacts) noteUntouchable(tree, files.main().notes);
    forbidNeighbours(tree);
  }
  urdf::keepTargetsMovable(tree.joints, files.main());
  noteStarts(tree.joints, files.main().notes);
  for (const urdf::ReadJoint& joint : tree.joints) tree.spec.joints.push_back(joint.spec);
  return tree;
}

void joinNotes(Diagnostics& notes, const Diagnostics& more) {
  notes.insert(notes.end(), more.begin(), more.end());
}

// A model with its meshes and masses.
BodyTree readWhole(Files& files, const std::string& name, const ModelSource& source) {
  Compiler compiler;
  BodyTree tree = readModel(files, name, compiler, source);
  if (source.assets) {
    SceneFile scene;
    scene.spec = std::move(tree.spec);
    try {
      loadMeshes(scene, *source.assets, source.options, MeshMaterials::kIgnored);
    } catch (const Error&) {
      joinNotes(source.notes, scene.notes);
      throw;
    }
    joinNotes(source.notes, scene.notes);
    tree.spec = std::move(scene.spec);
  }
  fitGeoms(tree, compiler, files.main());
  setMasses(tree, compiler, files.main());
  alignFreeBodies(tree, files.main());
  setSprings(tree, files.main());
  return tree;
}

// The file's own folder may be the root, but what it names must not lie above that.
BodyTree readOther(const Tag& model, const Files& files, const ModelSource& source) {
  constexpr int kDeepest = 8;
  if (!files.areRead())
    model.failAt("file", "a scene that was given as text", "no <model>: only models in files attach others");
  if (source.depth == kDeepest)
    model.failAt("file", fmt::format("level {} of models that attach others", kDeepest + 1),
                 fmt::format("at most {}", kDeepest));
  const std::string path = files.find(model.nameIn("file"), model).string();
  const std::string text = readSceneText(path, kLargestModel);
  const Assets assets(path, files.assets().root());
  Files own(text, path, &assets, source.options.strict);
  BodyTree tree = readWhole(own, path, {&assets, source.options, source.notes, source.depth + 1});
  joinNotes(source.notes, own.takeNotes());
  return tree;
}

void refuseFreeBase(const std::string& name, const ReadOptions& options) {
  if (!options.freeBase) return;
  throw Error({.what = "a free base",
               .where = {name},
               .found = "a model of MuJoCo",
               .wanted = "a <freejoint/> in its first body instead"});
}

SceneFile readModelFile(std::string_view text, const std::string& name, const Assets* assets,
                        const ReadOptions& options) {
  refuseFreeBase(name, options);
  Files files(text, name, assets, options.strict);
  SceneFile scene;
  Diagnostics more;
  try {
    scene.spec = readWhole(files, name, {assets, options, more}).spec;
  } catch (const Error&) {
    if (options.notesOfFailure) {
      joinNotes(*options.notesOfFailure, files.takeNotes());
      joinNotes(*options.notesOfFailure, more);
    }
    throw;
  }
  scene.notes = files.takeNotes();
  joinNotes(scene.notes, more);
  return scene;
}

}  // namespace

SceneFile parseMjcf(std::string_view text, const std::string& name, const ReadOptions& options) {
  return readModelFile(text, name, nullptr, options);
}

SceneFile readMjcf(const std::filesystem::path& file, const ReadOptions& options) {
  const Assets assets(file, options.assetRoot);
  return readModelFile(readSceneText(file, kLargestModel), file.string(), &assets, options);
}

}  // namespace rex
