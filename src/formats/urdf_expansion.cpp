#include <algorithm>
#include <numbers>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/error.h"
#include "formats/urdf_expansion_internal.h"
#include "formats/xml_reader_internal.h"
#include "geometry/rotation.h"

namespace rex::urdf {
namespace {

// XML lacks some characters, and bytes that are not UTF-8.
void requireXml(const std::string& text, const std::string& markup) {
  try {
    static_cast<void>(xml::parse(fmt::format("<a b=\"{}\"/>", markup), "name"));
  } catch (const Error&) {
    throw Error({.what = "a name in URDF",
                 .found = xml::quoted(text),
                 .wanted = "characters that XML allows, in UTF-8"});
  }
}

std::string escaped(const std::string& text) {
  std::string result;
  bool isPlain = true;
  for (const char c : text) {
    const bool isControl = static_cast<unsigned char>(c) < 0x20;
    isPlain = isPlain && !isControl && static_cast<unsigned char>(c) < 0x7f;
    if (isControl || c == '&' || c == '<' || c == '>' || c == '"') {
      result += fmt::format("&#{};", static_cast<int>(c));
    } else {
      result += c;
    }
  }
  if (!isPlain) requireXml(text, result);
  return result;
}

}  // namespace

std::string numeral(double number) {
  return fmt::format("{}", number + 0.0);  // no -0
}

std::string numeral(const Eigen::VectorXd& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : " ") + numeral(number);
  return text;
}

void Markup::close(const char* tag) {
  --depth_;
  text += fmt::format("{:{}}</{}>\n", "", 2 * depth_, tag);
}

void Markup::origin(const Pose& X) {
  if (X.R.isIdentity(0) && X.p.isZero(0)) return;
  empty("origin", {{"xyz", numeral(X.p)}, {"rpy", numeral(rollPitchYawFromRotation(X.R))}});
}

void Markup::line(const char* tag, const Attributes& attributes, const char* end) {
  text += fmt::format("{:{}}<{}", "", 2 * depth_, tag);
  for (const auto& [name, value] : attributes)
    if (!value.empty()) text += fmt::format(" {}=\"{}\"", name, escaped(value));
  text += end;
  text += '\n';
}

namespace {

[[noreturn]] void fail(const JointSpec& joint, const std::string& what, const std::string& wanted) {
  throw Error(
      {.what = fmt::format("joint '{}': {}", joint.name, what), .where = joint.where, .wanted = wanted});
}

// A link of the chain that replaces a joint: what is appended to its name, and how it moves.
struct Part {
  std::string_view suffix{};
  JointType type{};
  Eigen::Vector3d axis{};
  bool isRise = false;  ///< of a screw
};

std::vector<Part> partsOf(const JointSpec& joint) {
  const JointMovements all = movements(joint.type, joint.axis, joint.pitch);
  if (!urdfWord(joint.type).empty())
    return {{"", joint.type, hasAxis(joint.type) ? joint.axis : Eigen::Vector3d::UnitZ()}};
  std::vector<Part> parts;
  for (const JointMovement& one : all) {
    switch (one.kind) {
      case JointMovement::Kind::kFixed:
      case JointMovement::Kind::kQuaternion:
        fail(joint, fmt::format("URDF has no {} joint", toString(joint.type)), "three hinges, for example");
      case JointMovement::Kind::kHinge:
        parts.push_back({one.part, JointType::kHinge, one.axis});
        break;
      case JointMovement::Kind::kSlider:
        parts.push_back({one.part, JointType::kSlider, one.isRise ? joint.axis : one.axis, one.isRise});
        break;
    }
  }
  return parts;
}

// Moves X_MC to the other side of the motion if the motion allows it: its whole rotation, and the part of
// its translation that the motion does not rotate.
bool absorbChildFrame(JointSpec& joint) {
  const Pose X = joint.X_MC;
  if (X.R.isIdentity(0) && X.p.isZero(0)) return true;
  const Eigen::Vector3d seen = X.R.transpose() * joint.axis;
  const bool can = [&] {
    if (joint.type == JointType::kHinge) return joint.axis.normalized().cross(X.p).norm() <= 1e-15;
    if (joint.type == JointType::kPlanarXYPhi)
      return X.p.isZero(0) &&
             rotationBetween(Eigen::Vector3d::UnitZ(), seen).isApprox(X.R.transpose(), 1e-14);
    return joint.type != JointType::kFree;
  }();
  if (!can) return false;
  joint.X_PF = joint.X_PF * X;
  joint.axis = seen;
  joint.X_MC = Pose{};
  return true;
}

JointSpec withMotion(const JointSpec& joint, const Part& part) {
  JointSpec made = joint;
  made.type = part.type;
  made.axis = part.axis;
  return made;
}

std::size_t lengthOf(const JointSpec& joint) {
  const std::vector<Part> parts = partsOf(joint);
  JointSpec last = withMotion(joint, parts.back());
  return parts.size() + (absorbChildFrame(last) ? 0 : 1);
}

// Coordinates are numbered breadth-first. So chains at the same depth that carry moving joints must have
// the same length: then bodies and joints at one depth stay at one depth, in their old order.
class Levels {
 public:
  Levels() = default;
  explicit Levels(const SceneSpec& spec) {
    for (const JointSpec& joint : spec.joints) incoming_[joint.child] = &joint;
    for (const JointSpec& joint : spec.joints)
      if (positionCount(joint.type) > 0) markCarriers(joint.parent);
    lengths_.resize(spec.joints.size() + 1, 1);
    for (const JointSpec& joint : spec.joints) {
      std::size_t& longest = lengths_[depthOf(joint)];
      if (carriers_.contains(joint.child)) longest = std::max(longest, lengthOf(joint));
    }
  }

  // How many links are missing from a chain of this length at a joint to `child`.
  std::size_t missing(const std::string& child, std::size_t depth, std::size_t length) const {
    return carriers_.contains(child) ? lengths_[depth] - length : 0;
  }

  // The depth of a joint in the tree. A root counts as if a joint attached it to the world.
  std::size_t depthOf(const JointSpec& joint) const {
    std::size_t depth = 0;
    for (const JointSpec* at = &joint; at && at->parent != kWorldName; ++depth) {
      const auto above = incoming_.find(at->parent);
      at = above == incoming_.end() ? nullptr : above->second;
    }
    return depth;
  }

 private:
  void markCarriers(const std::string& body) {
    for (const std::string* at = &body; carriers_.insert(*at).second;) {
      const auto above = incoming_.find(*at);
      if (above == incoming_.end()) return;
      at = &above->second->parent;
    }
  }

  std::unordered_map<std::string, const JointSpec*> incoming_;  // by the body that it moves
  std::unordered_set<std::string> carriers_;                    // bodies below which something moves
  std::vector<std::size_t> lengths_;                            // of chains, by depth
};

class Expansion {
 public:
  Expansion(const SceneSpec& spec, Losses& losses) : spec_(spec), losses_(losses) {
    bodyNames_.insert(kWorldName);
    for (const BodySpec& body : spec.bodies) bodyNames_.insert(body.name);
    for (const JointSpec& joint : spec.joints) jointNames_.insert(joint.name);
    for (const JointSpec& joint : spec.joints)
      for (const Part& part : partsOf(joint))
        partNames_[joint.name].push_back(
            part.suffix.empty() ? joint.name
                                : unique(jointNames_, fmt::format("{}{}", joint.name, part.suffix)));
  }

  SceneSpec expand() {
    result_.name = spec_.name;
    result_.bodies = spec_.bodies;
    result_.worldShapes = spec_.worldShapes;
    levels_ = Levels(spec_);
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
    for (const BodySpec* root : roots) {
      JointSpec joint =
          rigid(unique(jointNames_, std::string(kWorldName) + ">" + root->name), kWorldName, root->X_WB);
      joint.child = root->name;
      addLast(std::move(joint), levels_.missing(root->name, 0, 1));
    }
  }

  static JointSpec rigid(const std::string& name, const std::string& parent, const Pose& X) {
    JointSpec joint;
    joint.name = name;
    joint.parent = parent;
    joint.type = JointType::kRigid;
    joint.X_PF = X;
    return joint;
  }

  std::string addMassless(const std::string& name) {
    result_.bodies.push_back({.name = unique(bodyNames_, name), .X_WB = {}});
    return result_.bodies.back().name;
  }

  // Part i of a joint: its own coordinate and limits, without pose and parent.
  JointSpec partOf(const JointSpec& joint, const Part& part, std::size_t i) const {
    JointSpec made = withMotion(joint, part);
    made.name = partNames_.at(joint.name)[i];
    made.X_PF = i == 0 ? joint.X_PF : Pose{};
    if (!joint.mimic.empty()) made.mimic = partNames_.at(joint.mimic)[i];
    const auto index = static_cast<Eigen::Index>(i);
    if (positionCount(part.type) == 1 && joint.lower.size() > index)
      made.lower = joint.lower.segment(index, 1);
    if (positionCount(part.type) == 1 && joint.upper.size() > index)
      made.upper = joint.upper.segment(index, 1);
    return made;
  }

  // The translation of a screw along its axis, which follows its turn.
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
    const bool isWhole = !urdfWord(joint.type).empty();
    if (isWhole && positionCount(joint.type) > 1 && !joint.mimic.empty())
      fail(joint, "URDF has no mimic of joints with several coordinates", "none");
    const std::vector<Part> parts = partsOf(joint);
    if (parts.size() > 1)
      losses_.add("joints of types that URDF lacks became chains", joint.name, joint.where);
    std::string parent = joint.parent;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      JointSpec made = parts[i].isRise ? riseOf(joint, parts[i]) : partOf(joint, parts[i], i);
      made.parent = parent;
      if (i + 1 < parts.size()) {
        made.X_MC = Pose{};
        parent = made.child = addMassless(made.name);
        result_.joints.push_back(std::move(made));
      } else {
        addLast(std::move(made), levels_.missing(joint.child, levels_.depthOf(joint), lengthOf(joint)));
      }
    }
  }

  // Adds the last joint, with massless links that carry the frame on the child if it needs one, and that
  // fill up the chain.
  void addLast(JointSpec joint, std::size_t fillers) {
    const std::string child = joint.child;
    Pose X_MC = joint.X_MC;
    if (absorbChildFrame(joint)) {
      X_MC = Pose{};
    } else {
      ++fillers;
    }
    joint.X_MC = Pose{};
    for (; fillers > 0; --fillers) {
      const std::string moved = joint.child = addMassless(child + "_joint");
      result_.joints.push_back(std::move(joint));
      joint = rigid(unique(jointNames_, moved), moved, std::exchange(X_MC, Pose{}));
    }
    joint.child = child;
    result_.joints.push_back(std::move(joint));
  }

  const SceneSpec& spec_;
  Losses& losses_;
  SceneSpec result_;
  Levels levels_;
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
