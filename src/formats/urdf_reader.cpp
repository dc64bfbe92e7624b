#include "formats/urdf_reader.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "base/text.h"
#include "formats/assets_internal.h"
#include "formats/scene_meshes.h"
#include "formats/srdf.h"
#include "formats/urdf_parts_internal.h"

namespace rex::urdf {
namespace {

// The part of an element that xacro must process first.
struct Xacro {
  SourceLocation where;
  std::string found;
};

std::optional<Xacro> xacroIn(const xml::Document& document, const xml::Element& element) {
  if (element.name.starts_with("xacro:"))
    return Xacro{document.where(element.at), fmt::format("<{}>", element.name)};
  for (const xml::Attribute& attribute : element.attributes) {
    if (attribute.name.starts_with("xacro:"))
      return Xacro{document.where(attribute.at), xml::quoted(attribute.name)};
    const std::size_t at = std::min(attribute.value.find("${"), attribute.value.find("$("));
    if (at != std::string::npos)
      return Xacro{document.where(attribute, at), xml::quoted(std::string_view(attribute.value).substr(at))};
  }
  for (const xml::Element& child : element.children)
    if (std::optional<Xacro> found = xacroIn(document, child)) return found;
  return {};
}

}  // namespace

void refuseXacro(const xml::Document& document, const std::string& format) {
  const std::optional<Xacro> xacro = xacroIn(document, document.root);
  if (!xacro) return;
  throw Error({.what = fmt::format("this is xacro, not yet {}", format),
               .where = xacro->where,
               .found = xacro->found,
               .wanted = fmt::format("plain {}: run 'xacro FILE > robot.{}' and read that", format,
                                     lowerCase(format))});
}

}  // namespace rex::urdf

namespace rex {
namespace {

using namespace urdf;

constexpr std::size_t kMostJoints = 1000;

const std::vector<std::string> kIgnored = {"transmission", "gazebo", "ros2_control", "sensor"};

void refuseMore(const xml::Document& document, const char* name, std::size_t most) {
  std::size_t count = 0;
  const xml::Element* tooMuch = nullptr;
  for (const xml::Element& element : document.root.children)
    if (element.name == name && ++count == most + 1) tooMuch = &element;
  if (!tooMuch) return;
  throw Error({.what = fmt::format("<robot>: too many <{}>", name),
               .where = document.where(tooMuch->at),
               .found = fmt::format("{}", count),
               .wanted = fmt::format("at most {}", most)});
}

Tag robotTag(Reading& reading) {
  const xml::Document& document = reading.document;
  if (document.root.name != "robot") {
    throw Error({.what = "not a URDF robot",
                 .where = document.where(document.root.at),
                 .found = fmt::format("<{}>", document.root.name),
                 .wanted = "<robot>",
                 .nearest = nearestNames(document.root.name, {"robot"})});
  }
  static const Known kKnown = {{"name", "version"}, {"link", "joint", "material"}, kIgnored};
  const Tag robot(reading, document.root, "<robot>");
  robot.expect(kKnown);
  if (!robot.has("name")) robot.warn(robot.where(), "attribute 'name' is missing");
  refuseMore(document, "joint", kMostJoints);
  refuseMore(document, "link", kMostJoints + 1);
  return robot;
}

// In a robot that has masses, a link that has none although there is something of it is doubtful; as a root
// it is usual.
void noteMassless(const std::vector<Tag>& links, const SceneSpec& spec, std::size_t root) {
  if (std::ranges::none_of(spec.bodies, [](const BodySpec& link) { return link.mass > 0; })) return;
  for (std::size_t i = 0; i < links.size(); ++i)
    if (i != root && links[i].children("inertial").empty() && !spec.bodies[i].shapes.empty())
      links[i].remark("a link with shapes but without <inertial> has no mass");
}

// A root called "world" is the world itself.
void becomeWorld(SceneSpec& spec, std::size_t root, Notes& notes) {
  BodySpec& world = spec.bodies[root];
  if (world.mass > 0 || world.inertia) notes.ignore(world.where, "the <inertial> of the link 'world'");
  spec.worldShapes = std::move(world.shapes);
  spec.bodies.erase(spec.bodies.begin() + static_cast<std::ptrdiff_t>(root));
}

void freeRoot(SceneSpec& spec, const BodySpec& root) {
  const std::string name = fmt::format("{}>{}", kWorldName, root.name);
  const auto same = [&](const JointSpec& joint) { return joint.name == name; };
  const auto taken = std::find_if(spec.joints.begin(), spec.joints.end(), same);
  if (taken != spec.joints.end())
    throw Error({.what = "joint of the free base",
                 .where = taken->where,
                 .found = fmt::format("another joint '{}'", name),
                 .wanted = "another name for that joint"});
  JointSpec joint;
  joint.name = name;
  joint.parent = kWorldName;
  joint.child = root.name;
  joint.type = JointType::kFree;
  joint.where = root.where;
  spec.joints.insert(spec.joints.begin(), std::move(joint));
}

void placeRoot(SceneSpec& spec, std::size_t root, bool freeBase, Notes& notes) {
  const bool isWorld = spec.bodies[root].name == kWorldName;
  if (isWorld && freeBase) {
    throw Error({.what = "a free base",
                 .where = spec.bodies[root].where,
                 .found = "the root 'world', which holds the robot",
                 .wanted = "a root of another name, or a joint of type 'floating' below 'world'"});
  }
  if (isWorld) becomeWorld(spec, root, notes);
  if (freeBase) freeRoot(spec, spec.bodies[root]);
}

void append(Diagnostics& notes, const Diagnostics& more) {
  notes.insert(notes.end(), more.begin(), more.end());
}

SceneSpec readRobot(Reading& reading, const std::string& name, bool freeBase) {
  const Tag robot = robotTag(reading);
  const Materials materials = readMaterials(robot);
  SceneSpec spec;
  spec.name = name;
  std::vector<ReadJoint> joints;
  const std::vector<Tag> links = robot.children("link");
  for (const Tag& link : links) spec.bodies.push_back(readLink(link.of("<link>"), materials));
  for (const Tag& joint : robot.children("joint")) joints.push_back(readJoint(joint.of("<joint>")));
  const std::size_t root = requireTree(spec.bodies, joints, robot.where(), reading);
  keepTargetsMovable(joints, reading);
  noteMassless(links, spec, root);
  for (ReadJoint& joint : joints) spec.joints.push_back(std::move(joint.spec));
  placeRoot(spec, root, freeBase, reading.notes);
  return spec;
}

// The SRDF is named like the robot unless another one is given, and lies beside it or, as in packages of
// MoveIt, in ../srdf.
void readChoices(const std::filesystem::path& robot, const std::filesystem::path& given, SceneFile& scene) {
  if (!given.empty()) return readSrdf(given, scene);
  const std::filesystem::path beside = std::filesystem::path(robot).replace_extension(".srdf");
  for (const auto& file : {beside, internal::folderOf(robot) / ".." / "srdf" / beside.filename()})
    if (internal::obstacleAt(file) != internal::kNoSuchFile) return readSrdf(file, scene);
}

}  // namespace

void urdf::noteSkippedBlanks(Reading& reading) {
  if (const std::uint32_t at = reading.document.declarationAt; at > 0)
    reading.notes.warn(reading.document.where(at),
                       "not well-formed XML: blanks before the declaration; they are skipped");
}

SceneFile parseUrdf(std::string_view text, const std::string& name, const ReadOptions& options) {
  const xml::Document document = xml::parse(text, name, !options.strict);
  refuseXacro(document, "URDF");
  Reading reading{document, options.strict};
  noteSkippedBlanks(reading);
  try {
    SceneSpec spec = readRobot(reading, name, options.freeBase);
    return {std::move(spec), reading.notes.take(), std::string(text)};
  } catch (const Error&) {
    if (options.notesOfFailure) append(*options.notesOfFailure, reading.notes.take());
    throw;
  }
}

SceneFile readUrdf(const std::filesystem::path& file, const ReadOptions& options) {
  constexpr std::size_t kLargest = 8u << 20;
  SceneFile scene = parseUrdf(readSceneText(file, kLargest), file.string(), options);
  try {
    readChoices(file, options.srdf, scene);
    loadMeshes(scene, Assets(file, options.assetRoot, !options.strict), options);
  } catch (const Error&) {
    if (options.notesOfFailure) append(*options.notesOfFailure, scene.notes);
    throw;
  }
  return scene;
}

}  // namespace rex
