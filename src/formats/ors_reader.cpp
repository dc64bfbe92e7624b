#include "formats/ors_reader.h"

#include <map>
#include <unordered_map>
#include <unordered_set>

#include <fmt/format.h>

#include "base/text.h"
#include "formats/ors_attributes_internal.h"
#include "formats/ors_node_list_internal.h"
#include "formats/ors_parts_internal.h"
#include "formats/scene_meshes.h"
#include "geometry/mesh_mass.h"

namespace rex {
namespace {

using ors::Attributes;
using ors::Node;
using ors::Place;

[[noreturn]] void fail(const Place& where, std::string what, std::string found, std::string wanted,
                       std::vector<std::string> nearest = {}) {
  throw Error({std::move(what), where, std::move(found), std::move(wanted), std::move(nearest)});
}

// [ixx iyy izz] or [ixx iyy izz ixy ixz iyz].
Eigen::Matrix3d inertiaMatrix(const Eigen::VectorXd& entries) {
  Eigen::Matrix3d I = entries.head<3>().asDiagonal();
  if (entries.size() == 6) {
    I(0, 1) = I(1, 0) = entries[3];
    I(0, 2) = I(2, 0) = entries[4];
    I(1, 2) = I(2, 1) = entries[5];
  }
  return I;
}

std::optional<Eigen::Matrix3d> readInertia(const Attributes& attributes, Diagnostics& notes) {
  const auto entries = attributes.row("inertia", {3, 6});
  if (!entries) return std::nullopt;
  const Eigen::Matrix3d I = inertiaMatrix(*entries);
  const InertiaFault fault = inertiaFault(I);
  if (fault == InertiaFault::kNegative)
    attributes.fail("inertia", "a negative principal moment", "principal moments >= 0");
  if (fault == InertiaFault::kTriangle) {
    attributes.note("inertia", "is physically impossible: one principal moment exceeds the sum of the others",
                    Severity::kWarning, notes);
  }
  return I;
}

BodyKind readKind(const Attributes& attributes) {
  constexpr ors::Choice kKinds[] = {{0, "dynamic"}, {1, "kinematic"}, {2, "static"}};
  constexpr BodyKind kMeaning[] = {BodyKind::kDynamic, BodyKind::kKinematic, BodyKind::kStatic};
  if (attributes.flag("fixed") || attributes.flag("static")) return BodyKind::kStatic;
  if (attributes.flag("kinematic")) return BodyKind::kKinematic;
  return kMeaning[attributes.choice("dyntype", kKinds).value_or(0)];
}

const std::vector<std::string>& bodyAttributes() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names = {"X",        "pose",  "mass",   "com",       "inertia",
                                      "buoyancy", "fixed", "static", "kinematic", "dyntype"};
    names.insert(names.end(), ors::shapeAttributes().begin(), ors::shapeAttributes().end());
    return names;
  }();
  return kNames;
}

class Reader {
 public:
  /// Without `assets` no file is read.
  Reader(SceneFile& file, const Assets* assets, const ReadOptions& options)
      : file_(file), assets_(assets), options_(options) {}

  void read(const ors::Graph& graph) {
    firstOfName_.reserve(graph.size());
    bodyOfNode_.reserve(graph.size());
    for (const Node& node : graph) {
      if (node.keys.empty()) {
        fail(node.where, "a value without a name", ors::describe(node.value),
             "'{' on the line of its body, shape or joint");
      }
      const std::string& role = node.keys.front().text;
      if (role == "body") {
        readBody(node);
      } else if (role == "shape") {
        readShape(node);
      } else if (role == "joint") {
        readJoint(node);
      } else if (role == "pin") {
        readPin(node);
      } else if (role == "collisions") {
        readCollisions(node);
      } else if (role == "urdf" || role == "mjcf") {
        readRobot(node, role);
      } else {
        fail(node.where, "unknown statement", fmt::format("'{}'", role),
             "'body', 'shape', 'joint', 'pin', 'urdf', 'mjcf' or 'collisions'",
             nearestNames(role, {"body", "shape", "joint", "pin", "urdf", "mjcf", "collisions", "Include",
                                 "ChDir", "Delete", "Edit"}));
      }
    }
    if (robots_ > 0 && !hasRule_) file_.spec.collisionRule = CollisionRule::kAllButNeighbours;
    for (const Waiting& joint : waiting_) readAttributes(joint);
    for (const Waiting& joint : followers_) checkMimic(joint);
  }

  bool hasRobots() const { return robots_ > 0; }

 private:
  static std::string nameOf(const Node& node) { return node.keys.size() > 1 ? node.keys.back().text : ""; }
  static std::string called(const char* role, const std::string& name) {
    return name.empty() ? role : fmt::format("{} '{}'", role, name);
  }

  static std::string bodiesOf(const Node& node) {
    return fmt::format("{} {}", node.parents.size(), node.parents.size() == 1 ? "body" : "bodies");
  }

  // The index of the body that is meant; empty: the world.
  std::optional<std::size_t> bodyOf(const ors::Word& parent, const std::string& owner,
                                    const char* role) const {
    if (parent.node) {
      if (worldNodes_.contains(*parent.node)) return std::nullopt;
      if (const auto body = bodyOfNode_.find(*parent.node); body != bodyOfNode_.end()) return body->second;
      fail(parent.where, fmt::format("{}: {}", owner, role),
           fmt::format("{}, which is not a body", parent.text), "the number of statements back to a body");
    }
    const auto found = firstOfName_.find(parent.text);
    if (found != firstOfName_.end()) return found->second;
    if (parent.text == kWorldName) return std::nullopt;
    std::vector<std::string> names = {kWorldName};
    for (const BodySpec& body : file_.spec.bodies) names.push_back(body.name);
    fail(parent.where, fmt::format("{}: unknown {}", owner, role), fmt::format("'{}'", parent.text),
         "the name of an earlier body", ors::nearestOfMany(parent.text, std::move(names)));
  }

  void readBody(const Node& node) {
    const std::string name = nameOf(node);
    if (name.empty()) fail(node.where, "body without a name", "", "'body NAME { ... }'");
    const std::string owner = called("body", name);
    if (!node.parents.empty()) fail(node.parents[0].where, owner, "parents", "none: joints connect bodies");
    const Attributes attributes(node, owner);
    attributes.noteUnknown(bodyAttributes(), file_.notes);
    attributes.noteWords({"fixed", "static", "kinematic", "contact", "hidden"}, file_.notes);
    BodySpec body;
    body.name = name;
    body.where = node.where;
    body.X_WB = attributes.pose(attributes.has("pose") ? "pose" : "X").value_or(Pose{});
    body.mass = attributes.number("mass").value_or(0);
    if (body.mass < 0) attributes.fail("mass", fmt::format("{}", body.mass), "a mass >= 0 kg");
    if (const auto com = attributes.row("com", {3})) body.p_BBcm = *com;
    body.inertia = readInertia(attributes, file_.notes);
    if (body.inertia && !body.inertia->isZero(0) && body.mass == 0 && file_.notes.size() < ors::kMostNotes)
      file_.notes.push_back(
          {attributes.where("inertia"), owner + ": an inertia without mass; it is kept", Severity::kWarning});
    body.buoyancy = attributes.number("buoyancy").value_or(0);
    attributes.noteFlags({"fixed", "static", "kinematic"}, file_.notes);
    body.kind = readKind(attributes);
    if (attributes.has("type")) {
      body.shapes.push_back(ors::readShape(attributes, name, node.where, file_.notes));
    } else {
      noteNoShape(attributes);
    }
    if (name == kWorldName) return becomeWorld(std::move(body), node.id, attributes);
    bodyOfNode_.emplace(node.id, file_.spec.bodies.size());
    const bool isFirst = firstOfName_.emplace(name, file_.spec.bodies.size()).second;
    if (!isFirst && file_.notes.size() < ors::kMostNotes)
      file_.notes.push_back({node.where, owner + ": a second body of this name: references mean the first"});
    file_.spec.bodies.push_back(std::move(body));
  }

  // A body called "world", as old scenes have one, is the world itself. What hangs on it later is placed by
  // its pose.
  void becomeWorld(BodySpec body, int node, const Attributes& attributes) {
    worldNodes_.insert(node);
    X_WO_ = body.X_WB;
    for (const char* name : {"mass", "com", "inertia", "buoyancy", "kinematic"})
      if (attributes.has(name))
        attributes.note(name, "is ignored: the world itself does not move", Severity::kWarning, file_.notes);
    for (ShapeSpec& shape : body.shapes) addToWorld(std::move(shape));
  }

  void addToWorld(ShapeSpec shape) {
    shape.X_BS = X_WO_ * shape.X_BS;
    file_.spec.worldShapes.push_back(std::move(shape));
  }

  void noteNoShape(const Attributes& attributes) {
    for (const char* name : {"size", "rel", "mesh", "meshscale", "color", "contact", "hidden"}) {
      if (!attributes.has(name)) continue;
      attributes.note(name, "is ignored: without 'type' the body has no shape", Severity::kWarning,
                      file_.notes);
      return;
    }
  }

  void readShape(const Node& node) {
    const std::string name = nameOf(node);
    const Attributes attributes(node, called("shape", name));
    if (node.parents.size() > 1) {
      fail(node.parents[1].where, attributes.owner(), fmt::format("{} parents", node.parents.size()),
           "one body, or none");
    }
    attributes.noteUnknown(ors::shapeAttributes(), file_.notes);
    attributes.noteWords({"contact", "hidden"}, file_.notes);
    std::optional<std::size_t> body;
    if (!node.parents.empty()) body = bodyOf(node.parents[0], attributes.owner(), "parent");
    ShapeSpec shape = ors::readShape(attributes, name, node.where, file_.notes);
    if (!body) return addToWorld(std::move(shape));
    file_.spec.bodies[*body].shapes.push_back(std::move(shape));
  }

  void readJoint(const Node& node) {
    std::string name = nameOf(node);
    if (node.parents.size() != 2)
      fail(node.where, called("joint", name), bodiesOf(node), "two: joint NAME (FROM TO) {...}");
    if (file_.spec.joints.size() == ors::kMostJoints)
      fail(node.where, "too many joints", "", fmt::format("at most {}", ors::kMostJoints));
    if (name.empty()) name = nameOf(node.parents[0]) + ">" + nameOf(node.parents[1]);
    const Attributes attributes(node, called("joint", name));
    JointSpec joint;
    joint.name = name;
    joint.where = node.where;
    ors::JointSurroundings around;
    joint.parent = connect(node.parents[0], attributes.owner(), "parent", around.X_WP);
    joint.child = connect(node.parents[1], attributes.owner(), "child", around.X_WC);
    if (joint.child == kWorldName)
      fail(node.parents[1].where, attributes.owner(), "the world as the body that moves", "a body");
    if (joint.parent == joint.child) {
      fail(node.parents[1].where, attributes.owner(), fmt::format("'{}' attached to itself", joint.child),
           "two different bodies");
    }
    const std::string mimic = ors::readMimic(attributes);
    const Waiting waiting{&node, file_.spec.joints.size(), around};
    if (!mimic.empty()) followers_.push_back(waiting);
    const bool mustWait = !mimic.empty() && !jointOfName_.contains(mimic);
    jointOfName_.emplace(std::move(name), file_.spec.joints.size());
    file_.spec.joints.push_back(std::move(joint));
    if (mustWait) {
      waiting_.push_back(waiting);
    } else {
      readAttributes(waiting);
    }
  }

  void readPin(const Node& node) {
    if (node.keys.size() > 1)
      fail(node.keys[1].where, "pin", fmt::format("'{}'", node.keys[1].text),
           "'pin (A B) { ... }': it has no name");
    if (node.parents.size() != 2) fail(node.where, "pin", bodiesOf(node), "two: pin (A B) {...}");
    const Attributes attributes(node, fmt::format("pin ({} {})", node.parents[0].text, node.parents[1].text));
    attributes.noteUnknown({"A", "B"}, file_.notes);
    Pose unused;
    PinSpec pin{.a = connect(node.parents[0], attributes.owner(), "body", unused),
                .b = connect(node.parents[1], attributes.owner(), "body", unused),
                .where = node.where};
    if (pin.a == pin.b) fail(node.parents[1].where, attributes.owner(), "one body", "two different bodies");
    if (const auto A = attributes.row("A", {3})) pin.p_AP = *A;
    if (const auto B = attributes.row("B", {3})) pin.p_BQ = *B;
    if (pin.a == kWorldName) pin.p_AP = X_WO_ * pin.p_AP;
    if (pin.b == kWorldName) pin.p_BQ = X_WO_ * pin.p_BQ;
    if (file_.spec.pins.size() == ors::kMostJoints)
      fail(node.where, "too many pins", "", fmt::format("at most {}", ors::kMostJoints));
    file_.spec.pins.push_back(std::move(pin));
  }

  void readCollisions(const Node& node) {
    if (node.keys.size() > 1)
      fail(node.keys[1].where, "collisions", fmt::format("'{}'", node.keys[1].text),
           "'collisions { ... }' or 'collisions (A B) { ... }'");
    if (node.parents.empty()) return readCollisionRule(Attributes(node, "collisions"));
    std::string names = node.parents[0].text;
    for (std::size_t i = 1; i < node.parents.size(); ++i) names += " " + node.parents[i].text;
    const Attributes attributes(node, fmt::format("collisions ({})", names));
    if (node.parents.size() > 2)
      fail(node.parents[2].where, attributes.owner(), bodiesOf(node), "two, or one for all its pairs");
    attributes.noteUnknown({"on", "off", "reason"}, file_.notes);
    Pose unused;
    CollisionChoice choice{.a = connect(node.parents[0], attributes.owner(), "body", unused), .b = {}};
    if (node.parents.size() == 2) choice.b = connect(node.parents[1], attributes.owner(), "body", unused);
    if (choice.a == choice.b)
      fail(node.parents[1].where, attributes.owner(), "one body", "two different bodies");
    choice.mayCollide = attributes.flag("on");
    if (choice.mayCollide == attributes.flag("off"))
      fail(node.where, attributes.owner(), choice.mayCollide ? "'on' and 'off'" : "neither 'on' nor 'off'",
           "one of them");
    choice.reason = attributes.text("reason", "a word or \"text\"").value_or("");
    choice.where = node.where;
    file_.spec.collisionChoices.push_back(std::move(choice));
  }

  void readCollisionRule(const Attributes& attributes) {
    attributes.noteUnknown({"rule"}, file_.notes);
    std::vector<std::string> known;
    for (const CollisionRule rule : {CollisionRule::kFourGenerations, CollisionRule::kAllButNeighbours}) {
      known.emplace_back(toString(rule));
      if (attributes.text("rule", "the name of a rule") != known.back()) continue;
      file_.spec.collisionRule = rule;
      hasRule_ = true;
      return;
    }
    const std::string found = attributes.text("rule", "").value_or("");
    fail(attributes.where("rule"), "collisions: attribute 'rule'",
         found.empty() ? "nothing" : fmt::format("'{}'", found), fmt::format("{} or {}", known[0], known[1]),
         nearestNames(found, known));
  }

  // A robot of another file, with a prefix to its names, on a body or in the world.
  void readRobot(const Node& node, const std::string& format) {
    const Attributes attributes(node, called(format.c_str(), nameOf(node)));
    const std::string& owner = attributes.owner();
    if (node.parents.size() > 1)
      fail(node.parents[1].where, owner, fmt::format("{} parents", node.parents.size()), "one body, or none");
    attributes.noteUnknown({"file", "prefix", "X", "pose"}, file_.notes);
    attributes.noteWords({}, file_.notes);
    if (++robots_ > ors::kMostRobots)
      fail(node.where, "too many robots", "",
           fmt::format("at most {} statements 'urdf' or 'mjcf'", ors::kMostRobots));
    ors::RobotPlace place{.pairsBefore = pairs_};
    place.prefix = attributes.text("prefix", "a word or \"text\"").value_or("");
    place.X_PR = attributes.pose(attributes.has("pose") ? "pose" : "X").value_or(Pose{});
    if (!node.parents.empty()) {
      Pose unused;
      place.parent = connect(node.parents[0], owner, "parent", unused);
    }
    if (place.parent == kWorldName) place.X_PR = X_WO_ * place.X_PR;
    const SceneSpec& robot = robotOf(attributes, format, node.where, place.folder);
    if (!robot.bodies.empty()) bodyOfNode_.emplace(node.id, file_.spec.bodies.size());
    SceneSpec placed = ors::placedRobot(robot, place);
    pairs_ = ors::pairsIn(placed, pairs_);
    add(std::move(placed), node, owner);
  }

  // The scene in a file, which is read once.
  const SceneSpec& robotOf(const Attributes& attributes, const std::string& format, const Place& where,
                           std::filesystem::path& folder) {
    const std::string what = attributes.owner() + ": file";
    const auto file = attributes.file("file");
    const char* const ending = format == "mjcf" ? ".xml" : ".urdf";
    if (!file)
      fail(where, attributes.owner() + ": attribute 'file' is missing", "",
           fmt::format("file='ROBOT{}'", ending));
    const Place at = attributes.where("file");
    if (endingOf(file->path) != ending)
      fail(at, what, fmt::format("'{}'", file->path), fmt::format("a {} file", ending));
    if (!assets_)
      fail(at, what, "a scene that was given as text",
           "no robots from other files: only scenes in files can have them");
    folder = assets_->folder();
    const std::filesystem::path path = assets_->find(file->path, at, what);
    const auto [known, isNew] = robotOfFile_.try_emplace(path.string());
    if (isNew) {
      SceneFile robot = readScene(path, {.assetRoot = assets_->root(),
                                         .allowMissingMeshes = options_.allowMissingMeshes,
                                         .strict = options_.strict,
                                         .upAxis = options_.upAxis});
      for (Diagnostic& one : robot.notes)
        if (file_.notes.size() < ors::kMostNotes) file_.notes.push_back(std::move(one));
      known->second = std::move(robot.spec);
    }
    return known->second;
  }

  // Takes over a robot whose names must be new.
  void add(SceneSpec robot, const Node& node, const std::string& owner) {
    const auto failAtSecond = [&](const char* kind, const std::string& name, const SourceLocation& first) {
      fail(node.where, fmt::format("{}: a second {} '{}'", owner, kind, name), "",
           fmt::format("another prefix: the first is at {}", toString(first)));
    };
    SceneSpec& spec = file_.spec;
    for (BodySpec& body : robot.bodies) {
      const auto [first, isNew] = firstOfName_.emplace(body.name, spec.bodies.size());
      if (!isNew) failAtSecond("body", body.name, spec.bodies[first->second].where);
      spec.bodies.push_back(std::move(body));
    }
    for (JointSpec& joint : robot.joints) {
      const auto [first, isNew] = jointOfName_.emplace(joint.name, spec.joints.size());
      if (!isNew) failAtSecond("joint", joint.name, spec.joints[first->second].where);
      if (spec.joints.size() == ors::kMostJoints)
        fail(node.where, "too many joints", "", fmt::format("at most {}", ors::kMostJoints));
      spec.joints.push_back(std::move(joint));
    }
    const auto parent = node.parents.empty() ? std::nullopt : bodyOf(node.parents[0], owner, "parent");
    std::vector<ShapeSpec>& shapes = parent ? spec.bodies[*parent].shapes : spec.worldShapes;
    for (ShapeSpec& shape : robot.worldShapes) shapes.push_back(std::move(shape));
    for (CollisionChoice& choice : robot.collisionChoices) spec.collisionChoices.push_back(std::move(choice));
    for (PostureSpec& posture : robot.postures) spec.postures.push_back(std::move(posture));
    if (spec.pins.size() + robot.pins.size() > ors::kMostJoints)
      fail(node.where, "too many pins", "", fmt::format("at most {}", ors::kMostJoints));
    for (PinSpec& pin : robot.pins) spec.pins.push_back(std::move(pin));
  }

  // A joint whose attributes are not read yet, because it may follow a joint that comes later.
  struct Waiting {
    const Node* node;
    std::size_t index;
    ors::JointSurroundings around;
  };

  void readAttributes(Waiting joint) {
    const Attributes attributes = attributesOf(joint);
    const auto followed = jointOfName_.find(ors::readMimic(attributes));
    if (followed != jointOfName_.end() && followed->second != joint.index)
      joint.around.followed = &file_.spec.joints[followed->second];
    JointSpec& read = file_.spec.joints[joint.index];
    ors::readJoint(attributes, joint.around, read, file_.notes);
    if (read.parent == kWorldName) read.X_PF = X_WO_ * read.X_PF;
  }

  Attributes attributesOf(const Waiting& joint) const {
    return {*joint.node, called("joint", file_.spec.joints[joint.index].name)};
  }

  void checkMimic(const Waiting& follower) const {
    const Attributes attributes = attributesOf(follower);
    const JointSpec& joint = file_.spec.joints[follower.index];
    const auto leader = jointOfName_.find(joint.mimic);
    if (leader != jointOfName_.end())
      return ors::requireLeader(attributes, joint, file_.spec.joints[leader->second]);
    std::vector<std::string> names;
    for (const JointSpec& other : file_.spec.joints)
      if (&other != &joint) names.push_back(other.name);
    fail(attributes.where("mimic"), attributes.owner() + ": attribute 'mimic': unknown joint",
         fmt::format("'{}'", joint.mimic), "the name of a joint", nearestNames(joint.mimic, names));
  }

  // The name by which a joint refers to the body. Sets X_WB to the pose of the body.
  std::string connect(const ors::Word& parent, const std::string& owner, const char* role, Pose& X_WB) const {
    const auto index = bodyOf(parent, owner, role);
    if (!index) {
      X_WB = X_WO_;
      return kWorldName;
    }
    const BodySpec& body = file_.spec.bodies[*index];
    if (firstOfName_.at(body.name) != *index) {
      fail(parent.where, owner, fmt::format("{}, a further body '{}'", parent.text, body.name),
           "the first body of its name");
    }
    X_WB = body.X_WB;
    return body.name;
  }

  // As it appears in the generated name of a joint.
  std::string nameOf(const ors::Word& parent) const {
    if (parent.node && worldNodes_.contains(*parent.node)) return kWorldName;
    const auto body = parent.node ? bodyOfNode_.find(*parent.node) : bodyOfNode_.end();
    return body == bodyOfNode_.end() ? parent.text : file_.spec.bodies[body->second].name;
  }

  SceneFile& file_;
  const Assets* assets_;
  const ReadOptions& options_;
  std::size_t robots_ = 0;                        // statements 'urdf'
  std::map<std::string, SceneSpec> robotOfFile_;  // by file of the statement
  bool hasRule_ = false;                          // of collisions
  std::vector<Waiting> waiting_, followers_;
  std::unordered_map<std::string, std::size_t> firstOfName_, jointOfName_;
  std::unordered_map<int, std::size_t> bodyOfNode_;
  std::unordered_set<int> worldNodes_;  // bodies that are the world itself
  Pose X_WO_{};                         // where the last of these is
  int pairs_ = 0;                       // of masks, in robots so far
};

SceneFile read(std::string_view text, const std::string& name, const Assets* assets,
               const ReadOptions& options) {
  SceneFile file;
  file.spec.name = name;
  file.spec.collisionRule = CollisionRule::kFourGenerations;
  try {
    ors::Document document = ors::parseGraph(text, name, assets, &file.notes);
    file.notes = std::move(document.notes);
    if (document.nodes.empty())
      file.notes.push_back({{name, 1, 1}, "no statement: the scene is empty", Severity::kWarning});
    Reader reader(file, assets, options);
    reader.read(document.nodes);
    if (document.isOneFile && !reader.hasRobots()) file.text = text;
    if (assets) loadMeshes(file, *assets, options);
    return file;
  } catch (const Error&) {
    if (options.notesOfFailure) *options.notesOfFailure = std::move(file.notes);
    throw;
  }
}

}  // namespace

SceneFile parseOrs(std::string_view text, const std::string& name, const ReadOptions& options) {
  return read(text, name, nullptr, options);
}

SceneFile readOrs(const std::filesystem::path& file, const ReadOptions& options) {
  const Assets assets(file, options.assetRoot);
  return read(readSceneText(file), file.string(), &assets, options);
}

}  // namespace rex
