#include "scene/mjcf_reader.h"

#include <algorithm>

#include <fmt/format.h>

#include "scene/mjcf_parts_internal.h"
#include "scene/scene_meshes.h"

namespace rex {
namespace {

using namespace mjcf;

const Known& knownOfModel() {
  static const Known kKnown = {
      {"model"},
      {"include", "compiler", "option", "default", "asset", "worldbody", "actuator", "equality", "contact"},
      {"size", "visual", "statistic", "custom", "deformable", "tendon", "sensor", "keyframe", "extension"}};
  return kKnown;
}

// The sections with that name in all files.
std::vector<Tag> named(const std::vector<Tag>& sections, const char* name) {
  std::vector<Tag> found;
  for (const Tag& tag : sections)
    if (tag.name() == name) found.push_back(tag);
  return found;
}

void noteOption(const Tag& given) {
  const Tag tag = given.of("<option>");
  tag.ignore("<option>");
  const Eigen::Vector3d usual(0, 0, -9.81);
  if (tag.has("gravity") && !tag.numbers("gravity", 3).isApprox(usual, 1e-9))
    tag.warn(tag.where("gravity"), "rex always computes with a gravity of 9.81 m/s^2 along -z");
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

// A model as text; its bodies have no masses yet.
BodyTree readModel(Files& files, const std::string& name, Compiler& compiler) {
  const std::vector<Tag> sections = files.children(files.root(), knownOfModel());
  for (const Tag& tag : named(sections, "compiler")) readCompiler(tag, compiler);
  for (const Tag& tag : named(sections, "option")) noteOption(tag);
  Defaults defaults;
  for (const Tag& tag : named(sections, "default")) defaults.read(tag, files);
  MjcfAssets assets;
  for (const Tag& tag : named(sections, "asset"))
    readAssets(tag.of("<asset>"), files, defaults, compiler, assets);
  BodyTree tree = readTree(named(sections, "worldbody"), files, defaults, compiler, assets);
  tree.spec.name = name;
  readActuators(named(sections, "actuator"), files, defaults, compiler, tree);
  readEqualities(named(sections, "equality"), files, defaults, compiler, tree);
  readContacts(named(sections, "contact"), files, tree);
  noteUntouchable(tree, files.main().notes);
  chooseNeighbours(tree);
  urdf::keepTargetsMovable(tree.joints, files.main());
  noteStarts(tree.joints, files.main().notes);
  for (const urdf::ReadJoint& joint : tree.joints) tree.spec.joints.push_back(joint.spec);
  return tree;
}

void joinNotes(Diagnostics& notes, const Diagnostics& more) {
  notes.insert(notes.end(), more.begin(), more.end());
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
  try {
    Compiler compiler;
    BodyTree tree = readModel(files, name, compiler);
    scene.spec = std::move(tree.spec);
    if (assets) loadMeshes(scene, *assets, options);
    tree.spec = std::move(scene.spec);
    fitGeoms(tree, compiler, files.main());
    setMasses(tree, compiler, files.main());
    scene.spec = std::move(tree.spec);
  } catch (const Error&) {
    if (options.notesOfFailure) {
      joinNotes(*options.notesOfFailure, files.takeNotes());
      joinNotes(*options.notesOfFailure, scene.notes);
    }
    throw;
  }
  Diagnostics notes = files.takeNotes();
  joinNotes(notes, scene.notes);
  scene.notes = std::move(notes);
  return scene;
}

}  // namespace

SceneFile parseMjcf(std::string_view text, const std::string& name, const ReadOptions& options) {
  return readModelFile(text, name, nullptr, options);
}

SceneFile readMjcf(const std::filesystem::path& file, const ReadOptions& options) {
  constexpr std::size_t kLargest = 8u << 20;
  const Assets assets(file, options.assetRoot);
  return readModelFile(readSceneText(file, kLargest), file.string(), &assets, options);
}

}  // namespace rex
