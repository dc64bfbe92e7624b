#include <algorithm>
#include <numbers>
#include <unordered_map>
#include <unordered_set>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "geometry/rotation.h"
#include "scene/urdf_expansion_internal.h"

namespace rex::urdf {
namespace {

const std::string kWorldName = "world";

[[noreturn]] void fail(const JointSpec& joint, const std::string& what, const std::string& wanted) {
  throw Error(
      {.what = fmt::format("joint '{}': {}", joint.name, what), .where = joint.where, .wanted = wanted});
}

// A link of the chain that stands for a joint: what is appended to its name, and how it moves.
struct Part {
  const char* suffix;
  JointType type;
  Eigen::Vector3d axis;
};

std::vector<Part> partsOf(const JointSpec& joint) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                        z = Eigen::Vector3d::UnitZ();
  constexpr JointType kTurn = JointType::kHinge, kMove = JointType::kSlider;
  switch (joint.type) {
    case JointType::kScrew:
      return {{"", kTurn, joint.axis}, {"_rise", kMove, joint.axis}};
    case JointType::kCylindrical:
      return {{"_turn", kTurn, joint.axis}, {"_slide", kMove, joint.axis}};
    case JointType::kPlanarXY:
      return {{"_x", kMove, x}, {"_y", kMove, y}};
    case JointType::kTranslation3:
      return {{"_x", kMove, x}, {"_y", kMove, y}, {"_z", kMove, z}};
    case JointType::kPlanarPhiXY:
      return {{"_phi", kTurn, z}, {"_x", kMove, x}, {"_y", kMove, y}};
    case JointType::kUniversal:
      return {{"_x", kTurn, x}, {"_y", kTurn, y}};
    case JointType::kPlanarXYPhi:
      return {{"", joint.type, z}};
    case JointType::kBall:
      fail(joint, "URDF has no ball joint", "three hinges, say");
    default:
      return {{"", joint.type, joint.axis}};
  }
}

// Moves X_MC to the other side of the motion, where the motion allows it: all of its rotation, and of its
// way what the motion does not turn.
bool absorbChildFrame(JointSpec& joint) {
  const Pose X = joint.X_MC;
  if (X.R.isIdentity(0) && X.p.isZero(0)) return true;
  const Eigen::Vector3d seen = X.R.transpose() * joint.axis;
  const bool can = [&] {
    switch (joint.type) {
      case JointType::kHinge:
        return joint.axis.normalized().cross(X.p).norm() <= 1e-15;
      case JointType::kPlanarXYPhi:
        return X.p.isZero(0) &&
               rotationBetween(Eigen::Vector3d::UnitZ(), seen).isApprox(X.R.transpose(), 1e-14);
      default:
        return joint.type != JointType::kFree;
    }
  }();
  if (!can) return false;
  joint.X_PF = joint.X_PF * X;
  joint.axis = seen;
  joint.X_MC = Pose{};
  return true;
}

class Expansion {
 public:
  Expansion(const SceneSpec& spec, Losses& losses) : spec_(spec), losses_(losses) {
    bodyNames_.insert(kWorldName);
    for (const BodySpec& body : spec.bodies) bodyNames_.insert(body.name);
    for (const JointSpec& joint : spec.joints) jointNames_.insert(joint.name);
    for (const JointSpec& joint : spec.joints)
      for (const Part& part : partsOf(joint))
        partNames_[joint.name].push_back(*part.suffix ? unique(jointNames_, joint.name + part.suffix)
                                                      : joint.name);
  }

  SceneSpec expand() {
    result_.name = spec_.name;
    result_.bodies = spec_.bodies;
    result_.worldShapes = spec_.worldShapes;
    hangRoots();
    for (const JointSpec& joint : spec_.joints) addJoint(joint);
    return std::move(result_);
  }

 private:
  static std::string unique(std::unordered_set<std::string>& taken, std::string name) {
    while (!taken.insert(name).second) name += "_";
    return name;
  }

  void hangRoots() {
    std::unordered_set<std::string> moved;
    bool needsWorld = !spec_.worldShapes.empty();
    for (const JointSpec& joint : spec_.joints) {
      moved.insert(joint.child);
      needsWorld = needsWorld || joint.parent == kWorldName;
    }
    std::vector<const BodySpec*> roots;
    for (const BodySpec& body : spec_.bodies)
      if (!moved.contains(body.name)) roots.push_back(&body);
    const auto isAtHome = [](const BodySpec* root) { return isApprox(root->X_WB, Pose{}, 0); };
    if (!needsWorld && roots.size() == 1 && isAtHome(roots[0])) return;
    for (const BodySpec* root : roots)
      addRigid(unique(jointNames_, kWorldName + ">" + root->name), kWorldName, root->name, root->X_WB);
  }

  void addRigid(const std::string& name, const std::string& parent, const std::string& child, const Pose& X) {
    JointSpec joint;
    joint.name = name;
    joint.parent = parent;
    joint.child = child;
    joint.type = JointType::kRigid;
    joint.X_PF = X;
    result_.joints.push_back(joint);
  }

  std::string addMassless(const std::string& name) {
    result_.bodies.push_back({.name = unique(bodyNames_, name), .X_WB = {}});
    return result_.bodies.back().name;
  }

  // Part i of a joint: its own coordinate and limits, without place and parent.
  JointSpec partOf(const JointSpec& joint, const Part& part, std::size_t i) const {
    JointSpec made = joint;
    made.name = partNames_.at(joint.name)[i];
    made.type = part.type;
    made.axis = part.axis;
    made.X_PF = i == 0 ? joint.X_PF : Pose{};
    if (!joint.mimic.empty()) made.mimic = partNames_.at(joint.mimic)[i];
    const auto index = static_cast<Eigen::Index>(i);
    if (positionCount(part.type) == 1 && joint.lower.size() > index)
      made.lower = joint.lower.segment(index, 1);
    if (positionCount(part.type) == 1 && joint.upper.size() > index)
      made.upper = joint.upper.segment(index, 1);
    return made;
  }

  // How a screw moves along its axis: with its turn.
  JointSpec riseOf(const JointSpec& screw, const Part& part) const {
    const double rise = screw.pitch / (2 * std::numbers::pi);
    JointSpec made = screw;
    made.name = partNames_.at(screw.name)[1];
    made.type = part.type;
    made.X_PF = Pose{};
    if (screw.mimic.empty()) made.mimic = screw.name;
    made.mimicRatio = screw.mimicRatio * rise;
    made.mimicOffset = screw.mimicOffset * rise;
    made.lower.resize(0);
    made.upper.resize(0);
    made.maxVelocity = screw.maxVelocity * std::abs(rise);
    made.maxEffort = JointSpec{}.maxEffort;
    made.damping = made.friction = 0;
    return made;
  }

  void addJoint(const JointSpec& joint) {
    const bool isWhole = joint.type == JointType::kPlanarXYPhi || joint.type == JointType::kFree;
    if (isWhole && !joint.mimic.empty())
      fail(joint, "URDF has no mimic of joints with several coordinates", "none");
    const std::vector<Part> parts = partsOf(joint);
    if (parts.size() > 1)
      losses_.add("joints of types that URDF lacks became chains", joint.name, joint.where);
    std::string parent = joint.parent;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const bool isRise = joint.type == JointType::kScrew && i == 1;
      JointSpec made = isRise ? riseOf(joint, parts[i]) : partOf(joint, parts[i], i);
      made.parent = parent;
      if (i + 1 < parts.size()) {
        made.X_MC = Pose{};
        parent = made.child = addMassless(made.name);
        result_.joints.push_back(std::move(made));
      } else {
        addLast(std::move(made));
      }
    }
  }

  void addLast(JointSpec joint) {
    const std::string child = joint.child;
    const Pose X_MC = joint.X_MC;
    if (absorbChildFrame(joint)) {
      result_.joints.push_back(std::move(joint));
      return;
    }
    joint.child = addMassless(child + "_joint");
    joint.X_MC = Pose{};
    const std::string moved = joint.child;
    result_.joints.push_back(std::move(joint));
    addRigid(unique(jointNames_, moved), moved, child, X_MC);
  }

  const SceneSpec& spec_;
  Losses& losses_;
  SceneSpec result_;
  std::unordered_set<std::string> bodyNames_, jointNames_;
  std::unordered_map<std::string, std::vector<std::string>> partNames_;
};

}  // namespace

void Losses::add(const std::string& kind, const std::string& name, const SourceLocation& where) {
  const auto same = [&](const Loss& loss) { return loss.kind == kind; };
  const auto found = std::find_if(losses_.begin(), losses_.end(), same);
  if (found != losses_.end()) {
    ++found->count;
  } else {
    losses_.push_back({kind, name, where, 1});
  }
}

Diagnostics Losses::take() const {
  Diagnostics notes;
  for (const Loss& loss : losses_) {
    const std::string names = loss.count == 1 ? fmt::format("'{}'", loss.first)
                                              : fmt::format("{}, first '{}'", loss.count, loss.first);
    notes.push_back({loss.where, fmt::format("{}: {}", loss.kind, names)});
  }
  return notes;
}

SceneSpec expand(const SceneSpec& spec, Losses& losses) { return Expansion(spec, losses).expand(); }

}  // namespace rex::urdf
