#include "scene/ors_reader.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "geometry/rotation.h"
#include "scene/ors_graph_internal.h"
#include "scene/scene_meshes.h"

namespace rex {
namespace {

using ors::Graph;
using ors::Node;

// Attributes of one body, shape or joint, with typed access. Notes the ones nobody asked for.
class Attributes {
 public:
  Attributes(const Node& node, std::string owner) : node_(node), owner_(std::move(owner)) {
    if (const Graph* graph = std::get_if<Graph>(&node.value)) {
      graph_ = graph;
    } else if (const bool* flag = std::get_if<bool>(&node.value); !flag || !*flag) {
      fail(node.valueWhere, owner_, ors::describe(node.value), "{attributes} on the line of its name");
    }
  }

  // The first node that has `name` among its keys.
  const Node* find(std::string_view name) const {
    for (const Node& attribute : *graph_) {
      for (const ors::Word& key : attribute.keys) {
        if (key.text == name) return &attribute;
      }
    }
    return nullptr;
  }

  // `contact`, `contact=true` or a key that shares another's value: true. `contact!`, `contact=false`: false.
  bool flag(std::string_view name) const {
    const Node* attribute = find(name);
    if (!attribute) return false;
    const bool* value = std::get_if<bool>(&attribute->value);
    return !value || *value;
  }

  template <class T>
  std::optional<T> get(std::string_view name, const char* wanted) const {
    const Node* attribute = find(name);
    if (!attribute) return std::nullopt;
    if (const T* value = std::get_if<T>(&attribute->value)) return *value;
    fail(attribute->valueWhere, fmt::format("{}: attribute '{}'", owner_, name),
         ors::describe(attribute->value), wanted);
  }

  std::optional<double> number(std::string_view name) const { return get<double>(name, "a number"); }
  std::optional<Pose> pose(std::string_view name) const { return get<Pose>(name, "a pose <T ...>"); }

  // One row of numbers, whose count must be one of `counts`.
  std::optional<Eigen::VectorXd> vector(std::string_view name, std::initializer_list<int> counts) const {
    std::string wanted = "an array of";
    for (const int count : counts)
      wanted += fmt::format("{}{}", count == *counts.begin() ? " " : " or ", count);
    const auto array = get<Eigen::MatrixXd>(name, wanted.c_str());
    if (!array) return std::nullopt;
    if (array->rows() > 1 || std::find(counts.begin(), counts.end(), array->size()) == counts.end()) {
      fail(find(name)->valueWhere, fmt::format("{}: attribute '{}'", owner_, name), ors::describe(*array),
           wanted + " numbers");
    }
    return Eigen::VectorXd(array->reshaped());
  }

  SourceLocation where(std::string_view name) const {
    const Node* attribute = find(name);
    return attribute ? attribute->valueWhere : node_.where;
  }
  const std::string& owner() const { return owner_; }

  void noteUnknown(const std::vector<std::string>& known, Diagnostics& notes) const {
    for (const Node& attribute : *graph_) {
      for (const ors::Word& key : attribute.keys) {
        if (std::find(known.begin(), known.end(), key.text) != known.end()) continue;
        std::string text = fmt::format("{}: unknown attribute '{}' is ignored", owner_, key.text);
        if (const auto nearest = nearestNames(key.text, known); !nearest.empty() && key.text.size() > 1) {
          text += fmt::format(" (did you mean '{}'?)", nearest.front());
        }
        notes.push_back({key.where, text});
      }
    }
  }

  [[noreturn]] static void fail(const SourceLocation& where, std::string what, std::string found,
                                std::string wanted, std::vector<std::string> nearest = {}) {
    throw Error({std::move(what), where, std::move(found), std::move(wanted), std::move(nearest)});
  }

 private:
  inline static const Graph kEmpty;
  const Node& node_;
  std::string owner_;
  const Graph* graph_ = &kEmpty;
};

// A number or a name from a table whose index is the number.
template <std::size_t N>
int tableIndex(const Attributes& attributes, std::string_view attribute,
               const std::array<const char*, N>& names, int fallback) {
  const Node* node = attributes.find(attribute);
  if (!node) return fallback;
  if (const double* number = std::get_if<double>(&node->value); number && *number >= 0 && *number < N) {
    const int index = static_cast<int>(*number);
    if (*number == index && *names[static_cast<std::size_t>(index)]) return index;
  }
  std::vector<std::string> known;
  for (std::size_t i = 0; i < N; ++i) {
    if (*names[i]) known.emplace_back(names[i]);
  }
  std::string word;
  if (const auto* text = std::get_if<std::string>(&node->value)) {
    word = *text;
    for (std::size_t i = 0; i < N; ++i) {
      if (*names[i] && word == names[i]) return static_cast<int>(i);
    }
  }
  Attributes::fail(node->valueWhere, fmt::format("{}: unknown {}", attributes.owner(), attribute),
                   ors::describe(node->value),
                   fmt::format("a number from 0 to {} or a name such as '{}'", N - 1, names[0]),
                   nearestNames(word, known));
}

const std::vector<std::string> kShapeAttributes = {"type",    "size", "rel",      "color",
                                                   "contact", "mesh", "meshscale"};
const std::vector<std::string> kBodyAttributes = {"X",     "pose",   "mass",      "inertia",
                                                  "fixed", "static", "kinematic", "dyntype"};
const std::vector<std::string> kJointAttributes = {
    "A", "from",   "B",           "to",     "BinvA", "Q",     "type",  "axis",
    "q", "limits", "ctrl_limits", "ctrl_H", "mimic", "fixed", "agent", "gains"};

ShapeSpec readShape(const Attributes& attributes, std::string name, const SourceLocation& where) {
  constexpr std::array<const char*, 10> kTypes = {"ST_box",      "ST_sphere", "ST_capsule", "ST_mesh",
                                                  "ST_cylinder", "ST_marker", "",           "ST_pointCloud",
                                                  "ST_ssCvx",    "ST_ssBox"};
  constexpr std::array<ShapeType, 10> kMeaning = {
      ShapeType::kBox,       ShapeType::kSphere,     ShapeType::kCapsule,
      ShapeType::kMesh,      ShapeType::kCylinder,   ShapeType::kMarker,
      ShapeType::kBox,       ShapeType::kPointCloud, ShapeType::kSphereSweptConvex,
      ShapeType::kRoundedBox};
  ShapeSpec spec;
  spec.name = std::move(name);
  spec.where = where;
  const int type = tableIndex(attributes, "type", kTypes, -1);
  if (type < 0)
    Attributes::fail(where, attributes.owner() + ": attribute 'type' is missing", "", "type=0 .. type=9");
  spec.shape.type = kMeaning[static_cast<std::size_t>(type)];
  if (const auto size = attributes.vector("size", {3, 4})) {
    spec.shape.extent = size->head<3>();
    spec.shape.radius = size->size() == 4 ? (*size)[3] : 0;
    if (size->minCoeff() < 0) {
      Attributes::fail(attributes.where("size"), attributes.owner() + ": attribute 'size'",
                       fmt::format("{}", size->minCoeff()), "lengths that are not negative");
    }
  }
  spec.X_BS = attributes.pose("rel").value_or(Pose{});
  if (const auto color = attributes.vector("color", {3, 4})) spec.color.head(color->size()) = *color;
  spec.contact = attributes.flag("contact");
  if (const auto mesh = attributes.get<ors::FileName>("mesh", "a file name in single quotes"))
    spec.meshFile = mesh->path;
  spec.meshScale.setConstant(attributes.number("meshscale").value_or(1));
  return spec;
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

class Reader {
 public:
  explicit Reader(std::string name) { file_.spec.name = std::move(name); }

  SceneFile read(const Graph& graph) {
    for (const Node& node : graph) {
      if (node.keys.empty()) {
        Attributes::fail(node.where, "a value without a name", ors::describe(node.value),
                         "'{' on the line of its body, shape or joint");
      }
      const std::string& role = node.keys.front().text;
      if (role == "body") {
        readBody(node);
      } else if (role == "shape") {
        readShapeNode(node);
      } else if (role == "joint") {
        readJoint(node);
      } else {
        refuse(node, role);
      }
    }
    return std::move(file_);
  }

 private:
  [[noreturn]] static void refuse(const Node& node, const std::string& role) {
    static const std::vector<std::string> kDirectives = {"Include", "ChDir", "Delete", "Edit", "Merge"};
    if (std::find(kDirectives.begin(), kDirectives.end(), role) != kDirectives.end()) {
      Attributes::fail(node.where, fmt::format("statement '{}' is not supported yet", role), "",
                       "'body', 'shape' or 'joint'");
    }
    Attributes::fail(node.where, "unknown statement", fmt::format("'{}'", role), "'body', 'shape' or 'joint'",
                     nearestNames(role, {"body", "shape", "joint"}));
  }

  static std::string nameOf(const Node& node) { return node.keys.size() > 1 ? node.keys.back().text : ""; }

  std::vector<std::string> bodyNames() const {
    std::vector<std::string> names;
    for (const BodySpec& body : file_.spec.bodies) names.push_back(body.name);
    return names;
  }

  // The index of the first body called so.
  std::size_t parentBody(const ors::Word& parent, const std::string& owner) const {
    const std::vector<std::string> names = bodyNames();
    const auto found = std::find(names.begin(), names.end(), parent.text);
    if (found == names.end()) {
      Attributes::fail(parent.where, owner + ": unknown parent", fmt::format("'{}'", parent.text),
                       "the name of an earlier body", nearestNames(parent.text, names));
    }
    return static_cast<std::size_t>(found - names.begin());
  }

  void readBody(const Node& node) {
    const std::string name = nameOf(node);
    if (name.empty()) Attributes::fail(node.where, "body without a name", "", "'body NAME { ... }'");
    if (!node.parents.empty()) {
      Attributes::fail(node.parents[0].where, fmt::format("body '{}'", name), "parents",
                       "none: joints connect bodies");
    }
    const Attributes attributes(node, fmt::format("body '{}'", name));
    BodySpec body;
    body.name = name;
    body.where = node.where;
    body.X_WB = attributes.pose("X").value_or(Pose{});
    if (const auto pose = attributes.pose("pose")) body.X_WB = *pose;
    body.mass = attributes.number("mass").value_or(0);
    if (body.mass < 0) {
      Attributes::fail(attributes.where("mass"), attributes.owner() + ": attribute 'mass'",
                       fmt::format("{}", body.mass), "a mass >= 0 kg");
    }
    if (const auto inertia = attributes.vector("inertia", {3, 6})) body.inertia = inertiaMatrix(*inertia);
    body.kind = bodyKind(attributes);
    std::vector<std::string> known = kBodyAttributes;
    known.insert(known.end(), kShapeAttributes.begin(), kShapeAttributes.end());
    attributes.noteUnknown(known, file_.notes);
    if (attributes.find("type")) {
      body.shapes.push_back(readShape(attributes, name, node.where));
    }
    file_.spec.bodies.push_back(std::move(body));
  }

  static BodyKind bodyKind(const Attributes& attributes) {
    if (attributes.flag("fixed") || attributes.flag("static")) return BodyKind::kStatic;
    if (attributes.flag("kinematic")) return BodyKind::kKinematic;
    constexpr std::array<const char*, 3> kKinds = {"dynamic", "kinematic", "static"};
    constexpr std::array<BodyKind, 3> kMeaning = {BodyKind::kDynamic, BodyKind::kKinematic,
                                                  BodyKind::kStatic};
    return kMeaning[static_cast<std::size_t>(tableIndex(attributes, "dyntype", kKinds, 0))];
  }

  void readShapeNode(const Node& node) {
    const std::string name = nameOf(node);
    const Attributes attributes(node, name.empty() ? "shape" : fmt::format("shape '{}'", name));
    if (node.parents.size() > 1) {
      Attributes::fail(node.parents[1].where, attributes.owner(),
                       fmt::format("{} parents", node.parents.size()), "one body, or none");
    }
    attributes.noteUnknown(kShapeAttributes, file_.notes);
    ShapeSpec shape = readShape(attributes, name, node.where);
    if (node.parents.empty()) {
      file_.spec.worldShapes.push_back(std::move(shape));
    } else {
      file_.spec.bodies[parentBody(node.parents[0], attributes.owner())].shapes.push_back(std::move(shape));
    }
  }

  void readJoint(const Node& node) {
    std::string name = nameOf(node);
    if (node.parents.size() != 2) {
      Attributes::fail(node.where, name.empty() ? "joint" : fmt::format("joint '{}'", name),
                       fmt::format("{} bodies", node.parents.size()), "two: joint NAME (FROM TO) {...}");
    }
    if (name.empty()) name = node.parents[0].text + ">" + node.parents[1].text;
    const Attributes attributes(node, fmt::format("joint '{}'", name));
    for (const ors::Word& parent : node.parents) static_cast<void>(parentBody(parent, attributes.owner()));
    attributes.noteUnknown(kJointAttributes, file_.notes);
    JointSpec joint;
    joint.name = std::move(name);
    joint.parent = node.parents[0].text;
    joint.child = node.parents[1].text;
    joint.where = node.where;
    readJointType(attributes, joint);
    readJointFrames(attributes, joint);
    readJointStart(attributes, joint);
    readJointLimits(attributes, joint);
    if (const auto agent = attributes.number("agent"); agent && *agent != 0) {
      file_.notes.push_back(
          {attributes.where("agent"),
           attributes.owner() + ": attribute 'agent' is ignored: one agent moves all joints"});
    }
    file_.spec.joints.push_back(std::move(joint));
  }

  static void readJointType(const Attributes& attributes, JointSpec& joint) {
    constexpr std::array<const char*, 15> kTypes = {
        "hingeX",     "hingeY",    "hingeZ", "transX",   "transY",     "transZ", "transXY", "trans3",
        "transXYPhi", "universal", "rigid",  "quatBall", "phiTransXY", "glue",   "free"};
    constexpr std::array<JointType, 15> kMeaning = {
        JointType::kHinge,       JointType::kHinge,     JointType::kHinge,    JointType::kSlider,
        JointType::kSlider,      JointType::kSlider,    JointType::kPlanarXY, JointType::kTranslation3,
        JointType::kPlanarXYPhi, JointType::kUniversal, JointType::kRigid,    JointType::kBall,
        JointType::kPlanarPhiXY, JointType::kRigid,     JointType::kFree};
    const int type = tableIndex(attributes, "type", kTypes, 0);
    joint.type = attributes.flag("fixed") ? JointType::kRigid : kMeaning[static_cast<std::size_t>(type)];
    joint.axis = Eigen::Vector3d::Unit(type < 6 ? type % 3 : 0);
    if (const auto mimic = attributes.get<std::string>("mimic", "the name of a joint")) joint.mimic = *mimic;
  }

  static void readJointFrames(const Attributes& attributes, JointSpec& joint) {
    joint.X_PF = attributes.pose("A").value_or(Pose{});
    if (const auto from = attributes.pose("from")) joint.X_PF = *from;
    if (attributes.flag("BinvA")) joint.X_MC = joint.X_PF.inverse();
    if (const auto B = attributes.pose("B")) joint.X_MC = *B;
    if (const auto to = attributes.pose("to")) joint.X_MC = *to;
    if (const auto axis = attributes.vector("axis", {3})) {
      if (!(axis->norm() > 0))
        Attributes::fail(attributes.where("axis"), attributes.owner() + ": attribute 'axis'", "a zero vector",
                         "a direction");
      const Pose f{rotationBetween(Eigen::Vector3d::UnitX(), axis->head<3>()), Eigen::Vector3d::Zero()};
      joint.X_PF = joint.X_PF * f;
      joint.X_MC = f.inverse() * joint.X_MC;
    }
    if (attributes.find("X")) {
      Attributes::fail(attributes.where("X"), attributes.owner() + ": attribute 'X' is not supported yet", "",
                       "'A' and 'B'");
    }
  }

  static void readJointStart(const Attributes& attributes, JointSpec& joint) {
    const auto Q = attributes.pose("Q");
    const auto q = attributes.number("q");
    if (joint.type ==
        JointType::kRigid) {  // nothing moves: both become part of the fixed pose, q as a turn about x
      joint.X_PF = joint.X_PF * Q.value_or(Pose{}) * rotation(q.value_or(0), Eigen::Vector3d::UnitX());
      return;
    }
    if (Q) joint.q0 = jointCoordinates(joint.type, joint.axis, *Q);
    if (q) {
      if (positionCount(joint.type) != 1) {
        Attributes::fail(
            attributes.where("q"), attributes.owner() + ": attribute 'q'", "a number",
            fmt::format("Q=<T ...>, because this joint has {} coordinates", positionCount(joint.type)));
      }
      joint.q0 = Eigen::VectorXd::Constant(1, *q);
    }
  }

  static void readJointLimits(const Attributes& attributes, JointSpec& joint) {
    const int n = positionCount(joint.type);
    const auto limits = attributes.vector("limits", {2 * n});
    if (!limits) return;
    joint.lower.resize(n);
    joint.upper.resize(n);
    for (int i = 0; i < n; ++i) {
      joint.lower[i] = (*limits)[2 * i];
      joint.upper[i] = (*limits)[2 * i + 1];
      if (joint.lower[i] > joint.upper[i]) {
        Attributes::fail(attributes.where("limits"), attributes.owner() + ": attribute 'limits'",
                         fmt::format("{} > {}", joint.lower[i], joint.upper[i]),
                         "pairs 'low high' with low <= high");
      }
    }
  }

  SceneFile file_;
};

}  // namespace

SceneFile parseOrs(std::string_view text, const std::string& name) {
  return Reader(name).read(ors::parseGraph(text, name));
}

SceneFile readOrs(const std::filesystem::path& file, const ReadOptions& options) {
  SceneFile scene = parseOrs(readSceneText(file), file.string());
  loadMeshes(scene, Assets(file, options.assetRoot), options.allowMissingMeshes);
  return scene;
}

}  // namespace rex
