#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "formats/ors_parts_internal.h"
#include "geometry/rotation.h"

namespace rex::ors {
namespace {

// Screw and cylindrical joints are an extension of ours and have no numbers.
constexpr Choice kJointWords[] = {{0, "hingeX"},      {1, "hingeY"},    {2, "hingeZ"},  {3, "transX"},
                                  {4, "transY"},      {5, "transZ"},    {6, "transXY"}, {7, "trans3"},
                                  {8, "transXYPhi"},  {9, "universal"}, {10, "rigid"},  {11, "quatBall"},
                                  {12, "phiTransXY"}, {13, "glue"},     {14, "free"},   {-1, "screw"},
                                  {-1, "cylindrical"}};
constexpr JointType kJointTypes[] = {
    JointType::kHinge,       JointType::kHinge,     JointType::kHinge,    JointType::kSlider,
    JointType::kSlider,      JointType::kSlider,    JointType::kPlanarXY, JointType::kTranslation3,
    JointType::kPlanarXYPhi, JointType::kUniversal, JointType::kRigid,    JointType::kBall,
    JointType::kPlanarPhiXY, JointType::kRigid,     JointType::kFree,     JointType::kScrew,
    JointType::kCylindrical};
static_assert(std::size(kJointWords) == std::size(kJointTypes));
constexpr Alias kOfUrdf[] = {{"prismatic", "transX"},  {"revolute", "hingeX"}, {"continuous", "hingeX"},
                             {"fixed", "rigid"},       {"floating", "free"},   {"planar", "transXYPhi"},
                             {"spherical", "quatBall"}};
constexpr double kNear = 1e-4;         // files may give six digits
constexpr std::size_t kAlongAxes = 6;  // the first types turn about or move along x, y, z

void readType(const Attributes& attributes, const JointSpec* followed, JointSpec& joint) {
  const std::size_t type = attributes.choice("type", kJointWords, kOfUrdf).value_or(0);
  joint.type = kJointTypes[type];
  if (type < kAlongAxes) joint.axis = Eigen::Vector3d::Unit(static_cast<int>(type) % 3);
  if (followed && !attributes.has("type")) {
    joint.type = followed->type;
    joint.axis = followed->axis;
    joint.pitch = followed->pitch;
  }
  const auto pitch = attributes.number("pitch");
  if (pitch) joint.pitch = *pitch;
  if (!pitch && !followed && joint.type == JointType::kScrew) {
    throw Error({.what = attributes.owner() + ": attribute 'pitch' is missing",
                 .where = attributes.where("type"),
                 .wanted = "metres per turn of the screw"});
  }
}

void readFrames(const Attributes& attributes, const JointSurroundings& around, JointSpec& joint,
                Diagnostics& notes) {
  const auto A = attributes.has("from") ? attributes.pose("from") : attributes.pose("A");
  const auto B = attributes.has("to") ? attributes.pose("to") : attributes.pose("B");
  joint.X_PF = A.value_or(Pose{});
  joint.X_MC = B ? *B : attributes.flag("BinvA") ? joint.X_PF.inverse() : Pose{};
  if (const auto X_WF = attributes.pose("X")) {
    if (isApprox(joint.X_PF, Pose{}, 0) && isApprox(joint.X_MC, Pose{}, 0)) {
      joint.X_PF = around.X_WP.inverse() * *X_WF;
      joint.X_MC = X_WF->inverse() * around.X_WC;
    } else {
      attributes.note("X", "is ignored: the joint has A or B", Severity::kNote, notes);
    }
  }
  if (const auto axis = attributes.row("axis", {3})) {
    if (axis->isZero(0)) attributes.fail("axis", "a zero vector", "a direction");
    const Pose X_FT{rotationBetween(Eigen::Vector3d::UnitX(), *axis), Eigen::Vector3d::Zero()};
    joint.X_PF = joint.X_PF * X_FT;
    joint.X_MC = X_FT.inverse() * joint.X_MC;
  }
}

// Coordinates of the joint; empty if they are not given.
Eigen::VectorXd readCoordinates(const Attributes& attributes, const char* name, const JointSpec& joint) {
  const auto q = attributes.row(name, {positionCount(joint.type)});
  if (!q) return {};
  const bool hasQuaternion = positionCount(joint.type) != velocityCount(joint.type);
  const double length = hasQuaternion ? q->tail<4>().norm() : 1;
  if (!(length > 0) || !std::isfinite(length)) {
    attributes.fail(name, fmt::format("a quaternion of length {}", length),
                    "a quaternion w x y z that can be normalised");
  }
  return *q;
}

void readStart(const Attributes& attributes, JointSpec& joint, Diagnostics& notes) {
  const auto Q = attributes.pose("Q");
  if (joint.type == JointType::kRigid) {
    // Nothing moves: both become part of the fixed pose, q as a turn about x.
    const double q = attributes.number("q").value_or(0);
    joint.X_PF = joint.X_PF * Q.value_or(Pose{}) * rotation(q, Eigen::Vector3d::UnitX());
    return;
  }
  if (Q) {
    joint.q0 = jointCoordinates(joint.type, joint.axis, *Q);
    const Pose X_FM = jointMotion(joint.type, joint.axis, joint.pitch, joint.q0.data());
    if (!isApprox(X_FM, *Q, kNear) && !attributes.flag("fixed")) {
      attributes.note("Q", "is not a motion of this joint: only the part that the joint can perform counts",
                      Severity::kWarning, notes);
    }
  }
  if (const Eigen::VectorXd q = readCoordinates(attributes, "q", joint); q.size() > 0) joint.q0 = q;
}

void readLimits(const Attributes& attributes, JointSpec& joint) {
  const int n = positionCount(joint.type);
  if (const Node* limits = n == 0 ? attributes.find("limits") : nullptr)
    attributes.fail("limits", describe(limits->value), "none: a rigid joint does not move");
  if (const auto limits = attributes.row("limits", {2 * n}, true)) {
    const auto pairs = limits->reshaped(2, n);
    joint.lower = pairs.row(0);
    joint.upper = pairs.row(1);
    for (int i = 0; i < n; ++i) {
      if (joint.lower[i] > joint.upper[i]) {
        attributes.fail("limits", fmt::format("{} > {}", joint.lower[i], joint.upper[i]),
                        "pairs 'low high' with low <= high");
      }
    }
  }
  if (const auto limits = attributes.row("ctrl_limits", {2, 3}, true)) {
    if (limits->minCoeff() < 0)
      attributes.fail("ctrl_limits", fmt::format("{}", limits->minCoeff()),
                      "the largest velocity and effort, both >= 0");
    joint.maxVelocity = (*limits)[0];
    joint.maxEffort = (*limits)[1];
  }
}

void noteUseless(const Attributes& attributes, const JointSpec& joint, Diagnostics& notes) {
  for (const char* name : {"mimic_ratio", "mimic_offset"})
    if (joint.mimic.empty() && attributes.has(name))
      attributes.note(name, "is ignored: without 'mimic' the joint follows no other", Severity::kWarning,
                      notes);
  if (attributes.size("stiffness").value_or(0) == 0 && attributes.has("spring_reference"))
    attributes.note("spring_reference", "is ignored: without 'stiffness' the joint has no spring",
                    Severity::kWarning, notes);
  if (joint.type != JointType::kScrew && attributes.has("pitch"))
    attributes.note("pitch", "is ignored: only a screw has one", Severity::kWarning, notes);
}

void noteStrangeAngles(const Attributes& attributes, const JointSpec& joint, Diagnostics& notes) {
  constexpr double kMost = 4 * std::numbers::pi;
  if (joint.type != JointType::kHinge) return;
  const auto isStrange = [](const Eigen::VectorXd& q) {
    return std::any_of(q.begin(), q.end(), [](double x) { return std::isfinite(x) && std::abs(x) > kMost; });
  };
  for (const auto& [name, isSo] : {std::pair("limits", isStrange(joint.lower) || isStrange(joint.upper)),
                                   std::pair("q", isStrange(joint.q0))}) {
    if (isSo)
      attributes.note(name, "is more than two turns: degrees? Angles are radians", Severity::kWarning, notes);
  }
}

void noteStartOutside(const Attributes& attributes, const JointSpec& joint, Diagnostics& notes) {
  if (joint.q0.size() == 0 || joint.lower.size() == 0) return;
  for (Eigen::Index i = 0; i < joint.q0.size(); ++i) {
    if (joint.q0[i] >= joint.lower[i] - kNear && joint.q0[i] <= joint.upper[i] + kNear) continue;
    attributes.note(attributes.has("q") ? "q" : "Q",
                    fmt::format("starts outside the limits: {} is not in {} .. {}", joint.q0[i],
                                joint.lower[i], joint.upper[i]),
                    Severity::kWarning, notes);
    return;
  }
}

// The joint no longer moves: its start becomes part of its frame.
void fix(const Attributes& attributes, JointSpec& joint) {
  const bool isFree = joint.type != JointType::kRigid;
  const auto Q = isFree && !attributes.has("q") ? attributes.pose("Q") : std::nullopt;
  const Eigen::VectorXd q = joint.start();
  joint.X_PF = joint.X_PF * (Q ? *Q : jointMotion(joint.type, joint.axis, joint.pitch, q.data()));
  joint.type = JointType::kRigid;
  for (Eigen::VectorXd* values : {&joint.q0, &joint.lower, &joint.upper, &joint.springReference})
    values->resize(0);
}

}  // namespace

std::string readMimic(const Attributes& attributes) {
  return attributes.text("mimic", "the name of a joint").value_or("");
}

// The same rules as in compile(), which does not know about attributes.
void requireLeader(const Attributes& attributes, const JointSpec& joint, const JointSpec& leader) {
  const int count = positionCount(joint.type);
  if (!leader.mimic.empty()) {
    attributes.fail("mimic", fmt::format("'{}', which mimics '{}'", leader.name, leader.mimic),
                    "a joint that mimics no other");
  }
  if (count == 1 && positionCount(leader.type) == 1) return;
  if (joint.type != leader.type) {
    attributes.fail("mimic", fmt::format("'{}', a joint of type {}", leader.name, toString(leader.type)),
                    count == 1 ? "a joint with one coordinate"
                               : fmt::format("a joint of type {}, like this one", toString(joint.type)));
  }
  const std::string wanted = fmt::format("none, because the joint has {} coordinates", count);
  if (joint.mimicRatio != 1) attributes.fail("mimic_ratio", fmt::format("{}", joint.mimicRatio), wanted);
  if (joint.mimicOffset != 0) attributes.fail("mimic_offset", fmt::format("{}", joint.mimicOffset), wanted);
}

void readJoint(const Attributes& attributes, const JointSurroundings& around, JointSpec& joint,
               Diagnostics& notes) {
  static const std::vector<std::string> kKnown = {"A",
                                                  "from",
                                                  "B",
                                                  "to",
                                                  "BinvA",
                                                  "Q",
                                                  "X",
                                                  "type",
                                                  "axis",
                                                  "q",
                                                  "pitch",
                                                  "limits",
                                                  "ctrl_limits",
                                                  "ctrl_H",
                                                  "mimic",
                                                  "mimic_ratio",
                                                  "mimic_offset",
                                                  "fixed",
                                                  "damping",
                                                  "friction",
                                                  "armature",
                                                  "stiffness",
                                                  "spring_reference",
                                                  "agent",
                                                  "gains",
                                                  "m"};
  attributes.noteUnknown(kKnown, notes);
  attributes.noteWords({"fixed", "BinvA"}, notes);
  joint.mimic = readMimic(attributes);
  joint.mimicRatio = attributes.number("mimic_ratio").value_or(1);
  joint.mimicOffset = attributes.number("mimic_offset").value_or(0);
  readType(attributes, around.followed, joint);
  noteUseless(attributes, joint, notes);
  readFrames(attributes, around, joint, notes);
  readStart(attributes, joint, notes);
  readLimits(attributes, joint);
  noteStartOutside(attributes, joint, notes);
  noteStrangeAngles(attributes, joint, notes);
  attributes.noteFlags({"fixed", "BinvA"}, notes);
  joint.damping = attributes.size("damping").value_or(0);
  joint.friction = attributes.size("friction").value_or(0);
  joint.armature = attributes.size("armature").value_or(0);
  joint.stiffness = attributes.size("stiffness").value_or(0);
  if (joint.stiffness > 0 && positionCount(joint.type) > 0)
    joint.springReference = readCoordinates(attributes, "spring_reference", joint);
  if (attributes.flag("fixed")) fix(attributes, joint);
  if (attributes.number("agent").value_or(0) != 0)
    attributes.note("agent", "is ignored: one agent moves all joints", Severity::kNote, notes);
  if (attributes.has("gains"))
    attributes.note("gains", "is ignored: controllers are written in programs", Severity::kNote, notes);
}

namespace {

class Placer {
 public:
  explicit Placer(const RobotPlace& place) : place_(place) {}

  void rename(std::string& name) const { name = place_.prefix + name; }
  void renameBody(std::string& name) const {
    name = name == kWorldName ? place_.parent : place_.prefix + name;
  }

  void place(ShapeSpec& shape) const {
    if (!shape.name.empty()) rename(shape.name);
    for (int& pair : shape.mask.pairs) pair += place_.pairsBefore;
    if (!shape.meshPath.empty())
      shape.meshFile = std::filesystem::proximate(shape.meshPath, place_.folder).generic_string();
  }

  void place(JointSpec& joint) const {
    rename(joint.name);
    rename(joint.child);
    if (joint.parent == kWorldName) joint.X_PF = place_.X_PR * joint.X_PF;
    renameBody(joint.parent);
    if (!joint.mimic.empty()) rename(joint.mimic);
  }

  JointSpec weld(const BodySpec& root) const {
    JointSpec joint;
    joint.name = fmt::format("{}>{}", place_.parent, root.name);
    joint.parent = place_.parent;
    joint.child = root.name;
    joint.type = JointType::kRigid;
    joint.X_PF = place_.X_PR * root.X_WB;
    joint.where = root.where;
    return joint;
  }

 private:
  const RobotPlace& place_;
};

}  // namespace

SceneSpec placedRobot(SceneSpec robot, const RobotPlace& place) {
  const Placer placer(place);
  for (ShapeSpec& shape : robot.worldShapes) {
    placer.place(shape);
    shape.X_BS = place.X_PR * shape.X_BS;
  }
  std::unordered_set<std::string> moved;
  for (JointSpec& joint : robot.joints) {
    placer.place(joint);
    moved.insert(joint.child);
  }
  std::vector<JointSpec> welds;
  for (BodySpec& body : robot.bodies) {
    placer.rename(body.name);
    for (ShapeSpec& shape : body.shapes) placer.place(shape);
    if (moved.contains(body.name)) continue;
    if (place.parent == kWorldName) {
      body.X_WB = place.X_PR * body.X_WB;
    } else {
      welds.push_back(placer.weld(body));
      body.X_WB = {};
    }
  }
  robot.joints.insert(robot.joints.begin(), welds.begin(), welds.end());
  for (CollisionChoice& choice : robot.collisionChoices) {
    placer.renameBody(choice.a);
    if (!choice.b.empty()) placer.renameBody(choice.b);
  }
  for (PinSpec& pin : robot.pins) {
    for (const auto& [body, point] : {std::pair{&pin.a, &pin.p_AP}, std::pair{&pin.b, &pin.p_BQ}}) {
      if (*body == kWorldName) *point = place.X_PR * *point;
      placer.renameBody(*body);
    }
  }
  for (PostureSpec& posture : robot.postures) {
    posture.name.insert(posture.name.find(':') + 1, place.prefix);
    for (auto& [joint, coordinates] : posture.joints) placer.rename(joint);
  }
  return robot;
}

int pairsIn(const SceneSpec& robot, int least) {
  const auto look = [&](const std::vector<ShapeSpec>& shapes) {
    for (const ShapeSpec& shape : shapes)
      for (const int pair : shape.mask.pairs) least = std::max(least, pair + 1);
  };
  look(robot.worldShapes);
  for (const BodySpec& body : robot.bodies) look(body.shapes);
  return least;
}

namespace {

constexpr int kRetiredBox = 6;

constexpr Choice kShapeWords[] = {{0, "ST_box"},     {1, "ST_sphere"},     {2, "ST_capsule"},
                                  {3, "ST_mesh"},    {4, "ST_cylinder"},   {5, "ST_marker"},
                                  {kRetiredBox, ""}, {7, "ST_pointCloud"}, {8, "ST_ssCvx"},
                                  {9, "ST_ssBox"},   {10, "ST_cone"},      {11, "ST_ellipsoid"}};
constexpr ShapeType kShapeTypes[] = {
    ShapeType::kBox,        ShapeType::kSphere,     ShapeType::kCapsule,
    ShapeType::kMesh,       ShapeType::kCylinder,   ShapeType::kMarker,
    ShapeType::kRoundedBox, ShapeType::kPointCloud, ShapeType::kSphereSweptConvex,
    ShapeType::kRoundedBox, ShapeType::kCone,       ShapeType::kEllipsoid};

ShapeType readType(const Attributes& attributes, const Place& where, Diagnostics& notes) {
  const auto type = attributes.choice("type", kShapeWords);
  if (!type) {
    throw Error({.what = attributes.owner() + ": attribute 'type' is missing",
                 .where = where,
                 .wanted = "type=0 .. type=11"});
  }
  if (kShapeWords[*type].number == kRetiredBox)
    attributes.note("type", "6 is retired: read as ST_ssBox, a rounded box", Severity::kNote, notes);
  return kShapeTypes[*type];
}

// Whether the fourth number of the size matters, so that leaving it out is probably a mistake.
bool hasRadius(ShapeType type) {
  return type == ShapeType::kSphere || type == ShapeType::kCapsule || type == ShapeType::kCylinder ||
         type == ShapeType::kCone || type == ShapeType::kRoundedBox;
}

void readSize(const Attributes& attributes, Shape& shape, Diagnostics& notes) {
  const auto size = attributes.row("size", {3, 4});
  if (!size && hasRadius(shape.type) && shape.type != ShapeType::kRoundedBox)
    attributes.note("size", "is missing: the radius, its fourth number, is 0", Severity::kWarning, notes);
  if (!size) return;
  shape.extent = size->head<3>();
  shape.radius = size->size() == 4 ? (*size)[3] : 0;
  if (size->minCoeff() < 0)
    attributes.fail("size", fmt::format("{}", size->minCoeff()), "lengths that are not negative");
  if (size->size() == 3 && hasRadius(shape.type))
    attributes.note("size", "has three numbers: the radius, its fourth, is 0", Severity::kWarning, notes);
}

// Whole numbers from 0 to `most`.
Eigen::VectorXd wholeNumbers(const Attributes& attributes, const char* name,
                             std::initializer_list<int> counts, double most) {
  const Eigen::VectorXd all = attributes.row(name, counts).value_or(Eigen::VectorXd());
  for (const double number : all)
    if (!(number >= 0 && number <= most && number == std::floor(number)))
      attributes.fail(name, fmt::format("{}", number), fmt::format("whole numbers from 0 to {:.0f}", most));
  return all;
}

ContactMask readMask(const Attributes& attributes) {
  ContactMask mask;
  const Eigen::VectorXd bits = wholeNumbers(attributes, "contact_bits", {2}, 4294967295.);
  if (bits.size() == 2)
    mask.type = static_cast<std::uint32_t>(bits[0]), mask.affinity = static_cast<std::uint32_t>(bits[1]);
  for (const double pair : wholeNumbers(attributes, "contact_pairs", {}, 1e6))
    mask.pairs.push_back(static_cast<int>(pair));
  return mask;
}

void noteNoMesh(const Attributes& attributes, ShapeType type, Diagnostics& notes) {
  for (const char* name : {"mesh", "meshscale"})
    if (!usesMesh(type) && attributes.has(name))
      attributes.note(name, "is ignored: a shape of this type has no mesh", Severity::kWarning, notes);
}

}  // namespace

const std::vector<std::string>& shapeAttributes() {
  static const std::vector<std::string> kNames = {"type",
                                                  "size",
                                                  "rel",
                                                  "color",
                                                  "contact",
                                                  "contact_bits",
                                                  "contact_pairs",
                                                  "mesh",
                                                  "meshscale",
                                                  "hidden",
                                                  "swiftfile",
                                                  "coloredBox",
                                                  "rel_includes_mesh_center"};
  return kNames;
}

ShapeSpec readShape(const Attributes& attributes, std::string name, const Place& where, Diagnostics& notes) {
  ShapeSpec spec;
  spec.name = std::move(name);
  spec.shape.type = readType(attributes, where, notes);
  noteNoMesh(attributes, spec.shape.type, notes);
  spec.where = attributes.where(usesMesh(spec.shape.type) ? "mesh" : "size");
  readSize(attributes, spec.shape, notes);
  spec.X_BS = attributes.pose("rel").value_or(Pose{});
  attributes.noteFlags({"contact", "hidden"}, notes);
  if (const auto color = attributes.row("color", {3, 4})) {
    for (const double part : *color)
      if (part < 0 || part > 1) attributes.fail("color", fmt::format("{}", part), "numbers from 0 to 1");
    spec.color.head(color->size()) = *color;
  }
  spec.contact = attributes.flag("contact");
  spec.mask = readMask(attributes);
  spec.visible = !attributes.flag("hidden");
  if (const auto mesh = attributes.file("mesh")) spec.meshFile = mesh->path;
  if (const auto scale = attributes.row("meshscale", {1, 3}))
    spec.meshScale = scale->size() == 1 ? Eigen::Vector3d::Constant((*scale)[0]) : scale->head<3>().eval();
  return spec;
}

}  // namespace rex::ors
