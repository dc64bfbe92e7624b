#include "formats/ors_writer.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"
#include "formats/ors_attributes_internal.h"
#include "formats/ors_writer_internal.h"
#include "formats/scene_file.h"
#include "geometry/rotation.h"

namespace rex {

void requireReadable(const std::string& text, const std::string& ending) {
  try {
    static_cast<void>(parseScene(text, "again" + ending));
  } catch (const Error& error) {
    ErrorParts parts = error.parts();
    parts.what = fmt::format("written as {}, it could not be read back: {}", ending, parts.what);
    parts.where = {};  // in a text that nobody sees
    throw Error(std::move(parts));
  }
}

}  // namespace rex

namespace rex::ors {
namespace {

constexpr double kExact = 1e-15;

std::string joined(const Eigen::Ref<const Eigen::VectorXd>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + numberText(value);
  return text;
}

// The number without its last digits, if they are only rounding error.
double neat(double value) {
  const double rounded = std::round(value * 1e9) / 1e9;
  return std::abs(rounded - value) <= kExact ? rounded : value;
}

// R as a rotation about one coordinate axis, if it is one; in round degrees if they are exact enough.
std::optional<std::string> degreesText(const Eigen::Matrix3d& R) {
  constexpr double kDegree = std::numbers::pi / 180;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i);
    const double degrees = std::atan2(R(k, j), R(j, j)) / kDegree;
    for (const double candidate : {std::round(degrees * 1e6) / 1e6, degrees}) {
      const Eigen::Matrix3d turned = rotationAboutAxis(candidate * kDegree, axis);
      if ((turned - R).cwiseAbs().maxCoeff() <= kExact)
        return fmt::format("d({} {})", numberText(candidate), joined(axis));
    }
  }
  return std::nullopt;
}

// In round numbers if they are exact enough.
std::string quaternionText(const Eigen::Matrix3d& R) {
  const Quaternion q = quaternionFromRotation(R);
  const Quaternion rounded = (q * 1e6).array().round() / 1e6;
  const bool isExact = (rotationFromQuaternion(rounded) - R).cwiseAbs().maxCoeff() <= kExact;
  return fmt::format("q({})", joined(isExact ? rounded : q));
}

}  // namespace

std::string numberText(double value) {
  return value == 0 ? "0" : fmt::format("{}", value);  // not "-0"
}

std::string arrayText(const Eigen::Ref<const Eigen::VectorXd>& values) { return "[" + joined(values) + "]"; }

std::string poseText(const Pose& X) {
  std::string text = "<T";
  const Eigen::Vector3d p = X.p.unaryExpr(&neat);
  if (!p.isZero(0)) text += " t(" + joined(p) + ")";
  if (!isApprox({X.R, {0, 0, 0}}, Pose{}, kExact))
    text += " " + degreesText(X.R).value_or(quaternionText(X.R));
  return text + ">";
}

}  // namespace rex::ors

namespace rex {
namespace {

using ors::arrayText;
using ors::numberText;
using ors::poseText;

using Parts = std::vector<std::string>;  // the attributes of a statement

constexpr std::size_t kWidestColumn = 32;
constexpr double kInertiaPerMass = 0.2;  // what compile() takes when only a mass is given

bool isName(const std::string& name) {
  return !name.empty() && name.size() <= ors::kLongestWord &&
         name.find_first_of(" \t\r\n,;()[]{}=!<\"'#") == std::string::npos && name[0] != '>' &&
         name[0] != '-' && !name.starts_with("//") && !name.starts_with("/*");
}

void requireName(const char* role, const std::string& name, const SourceLocation& where) {
  if (isName(name)) return;
  throw Error(
      {.what = fmt::format("{} '{}': not a name in .ors", role, name),
       .where = where,
       .found = fmt::format("'{}'", name),
       .wanted = fmt::format("a word of at most {} bytes without blanks and any of ,;()[]{{}}=!<>\"'#-, "
                             "not starting with // or /*",
                             ors::kLongestWord)});
}

std::string quotedFile(const std::string& what, const std::string& file, const SourceLocation& where) {
  if (file.empty() || file.size() > ors::kLongestWord || file.find('\'') != std::string::npos) {
    throw Error({.what = what + ": mesh",
                 .where = where,
                 .found = file.empty() ? "no file" : fmt::format("'{}'", file),
                 .wanted = "a file whose name has at most 256 bytes and no '"});
  }
  return fmt::format("'{}'", file);
}

bool isIdentity(const Pose& X) { return isApprox(X, Pose{}, 0); }

std::string typeName(ShapeType type) {
  switch (type) {
    case ShapeType::kBox:
      return "ST_box";
    case ShapeType::kSphere:
      return "ST_sphere";
    case ShapeType::kCapsule:
      return "ST_capsule";
    case ShapeType::kMesh:
      return "ST_mesh";
    case ShapeType::kCylinder:
      return "ST_cylinder";
    case ShapeType::kCone:
      return "ST_cone";
    case ShapeType::kMarker:
      return "ST_marker";
    case ShapeType::kPointCloud:
      return "ST_pointCloud";
    case ShapeType::kSphereSweptConvex:
      return "ST_ssCvx";
    case ShapeType::kRoundedBox:
      return "ST_ssBox";
    case ShapeType::kEllipsoid:
      return "ST_ellipsoid";
  }
  return "";
}

// 'X', 'Y' or 'Z' if the axis points along it, else '\0'.
char letterOf(const Eigen::Vector3d& axis) {
  for (int i = 0; i < 3; ++i)
    if (axis[i] > 0 && axis[(i + 1) % 3] == 0 && axis[(i + 2) % 3] == 0) return "XYZ"[i];
  return '\0';
}

// Hinges and sliders are named after their axis. If it is none of x, y, z, they are named after x and have
// an attribute 'axis'.
bool isCalledAfterAxis(JointType type) { return type == JointType::kHinge || type == JointType::kSlider; }

std::string typeName(const JointSpec& joint) {
  std::string name(orsWord(joint.type));
  const char letter = letterOf(joint.axis);
  if (isCalledAfterAxis(joint.type)) name += letter ? letter : 'X';
  return name;
}

bool needsAxis(const JointSpec& joint) {
  const char letter = letterOf(joint.axis);
  return hasAxis(joint.type) && letter != 'X' && !(isCalledAfterAxis(joint.type) && letter);
}

std::string numbersText(const Eigen::VectorXd& values) {
  return values.size() == 1 ? numberText(values[0]) : arrayText(values);
}

// A joint with the name that the reader generates needs no name.
std::string jointHead(const JointSpec& joint) {
  const bool isDefault = joint.name.empty() || joint.name == joint.parent + ">" + joint.child;
  if (!isDefault) requireName("joint", joint.name, joint.where);
  return fmt::format("joint {}({} {})", isDefault ? "" : joint.name + " ", joint.parent, joint.child);
}

void addType(const JointSpec& joint, Parts& parts) {
  const std::string type = typeName(joint);
  // A joint that mimics and has no type gets the type of the joint it follows.
  if (type != "hingeX" || !joint.mimic.empty()) parts.push_back("type=" + type);
  if (needsAxis(joint)) parts.push_back("axis=" + arrayText(joint.axis));
  if (joint.type == JointType::kScrew) parts.push_back("pitch=" + numberText(joint.pitch));
}

void addLimits(const JointSpec& joint, Parts& parts) {
  const int n = positionCount(joint.type);
  if (joint.lower.size() > 0 || joint.upper.size() > 0) {
    Eigen::Matrix2Xd limits(2, n);
    limits.row(0).setConstant(-kUnlimited);
    limits.row(1).setConstant(kUnlimited);
    if (joint.lower.size() > 0) limits.row(0) = joint.lower;
    if (joint.upper.size() > 0) limits.row(1) = joint.upper;
    parts.push_back("limits=" + arrayText(limits.reshaped()));
  }
  if (std::isfinite(joint.maxVelocity) || std::isfinite(joint.maxEffort))
    parts.push_back("ctrl_limits=" + arrayText(Eigen::Vector2d(joint.maxVelocity, joint.maxEffort)));
}

void addNumber(const char* name, double value, double usual, Parts& parts) {
  if (value != usual) parts.push_back(fmt::format("{}={}", name, numberText(value)));
}

void addMimic(const JointSpec& joint, Parts& parts) {
  if (joint.mimic.empty()) return;
  const bool isWord = std::isalpha(static_cast<unsigned char>(joint.mimic[0])) != 0 &&
                      joint.mimic != "true" && joint.mimic != "false";
  parts.push_back(isWord ? "mimic=" + joint.mimic : fmt::format("mimic=\"{}\"", joint.mimic));
  addNumber("mimic_ratio", joint.mimicRatio, 1, parts);
  addNumber("mimic_offset", joint.mimicOffset, 0, parts);
}

Parts jointParts(const JointSpec& joint) {
  Parts parts;
  addType(joint, parts);
  if (!isIdentity(joint.X_PF)) parts.push_back("A=" + poseText(joint.X_PF));
  if (!isIdentity(joint.X_MC)) parts.push_back("B=" + poseText(joint.X_MC));
  if (joint.start() != jointCoordinates(joint.type, joint.axis, Pose{}))
    parts.push_back("q=" + numbersText(joint.q0));
  addLimits(joint, parts);
  addMimic(joint, parts);
  addNumber("damping", joint.damping, 0, parts);
  addNumber("friction", joint.friction, 0, parts);
  addNumber("armature", joint.armature, 0, parts);
  addNumber("stiffness", joint.stiffness, 0, parts);
  if (joint.stiffness != 0 && joint.springReference.size() > 0)
    parts.push_back("spring_reference=" + numbersText(joint.springReference));
  return parts;
}

Parts bodyParts(const BodySpec& body) {
  Parts parts;
  if (!isIdentity(body.X_WB)) parts.push_back("X=" + poseText(body.X_WB));
  addNumber("mass", body.mass, 0, parts);
  if (!body.p_BBcm.isZero(0)) parts.push_back("com=" + arrayText(body.p_BBcm));
  const Eigen::Matrix3d usual = kInertiaPerMass * body.mass * Eigen::Matrix3d::Identity();
  if (body.inertia && *body.inertia != usual) {
    const Eigen::Matrix3d& I = *body.inertia;
    Eigen::VectorXd entries(6);
    entries << I.diagonal(), I(0, 1), I(0, 2), I(1, 2);
    parts.push_back("inertia=" + arrayText(entries.tail(3).isZero(0) ? entries.head(3).eval() : entries));
  }
  addNumber("buoyancy", body.buoyancy, 0, parts);
  if (body.kind == BodyKind::kStatic) parts.emplace_back("fixed");
  if (body.kind == BodyKind::kKinematic) parts.emplace_back("kinematic");
  return parts;
}

// Texts hold neither control characters nor quotes, and no more bytes than a word.
std::string textOf(const std::string& reason) {
  std::string text = reason.substr(0, ors::kLongestWord);
  for (char& c : text) {
    if (c == '"') c = '\'';
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return text;
}

// One line, or two columns of several.
struct Line {
  std::string head;
  Parts parts;
};

std::string linesText(const std::vector<Line>& lines) {
  std::size_t width = 0;
  for (const Line& line : lines)
    if (line.head.size() <= kWidestColumn) width = std::max(width, line.head.size());
  std::string text;
  for (const Line& line : lines)
    text += fmt::format("{:{}} {{ {}{}}}\n", line.head, width, join(line.parts, " "),
                        line.parts.empty() ? "" : " ");
  return text;
}

class Writer {
 public:
  explicit Writer(const std::filesystem::path& folder) : folder_(folder) {}

  std::string write(const SceneSpec& spec) {
    std::vector<Line> shapes, bodies, joints;
    for (const ShapeSpec& shape : spec.worldShapes) shapes.push_back({shapeHead(shape), shapeParts(shape)});
    for (const BodySpec& body : spec.bodies) addBody(body, bodies);
    for (const JointSpec& joint : spec.joints) joints.push_back({jointHead(joint), jointParts(joint)});
    const std::vector<Line> pins = pinLines(spec), collisions = collisionLines(spec);
    std::string text;
    for (const std::vector<Line>& group : {shapes, bodies, joints, pins, collisions}) {
      if (!text.empty() && !group.empty()) text += "\n";
      text += linesText(group);
    }
    return text;
  }

 private:
  static std::vector<Line> pinLines(const SceneSpec& spec) {
    std::vector<Line> lines;
    for (const PinSpec& pin : spec.pins)
      lines.push_back({fmt::format("pin ({} {})", pin.a, pin.b),
                       {"A=" + arrayText(pin.p_AP), "B=" + arrayText(pin.p_BQ)}});
    return lines;
  }

  // Scenes of the format have the rule of the course unless they say otherwise.
  static std::vector<Line> collisionLines(const SceneSpec& spec) {
    std::vector<Line> lines;
    if (spec.collisionRule != CollisionRule::kFourGenerations)
      lines.push_back({"collisions", {fmt::format("rule={}", toString(spec.collisionRule))}});
    for (const CollisionChoice& choice : spec.collisionChoices) {
      Parts parts = {choice.mayCollide ? "on" : "off"};
      if (!choice.reason.empty()) parts.push_back(fmt::format("reason=\"{}\"", textOf(choice.reason)));
      lines.push_back({fmt::format("collisions ({}{}{})", choice.a, choice.b.empty() ? "" : " ", choice.b),
                       std::move(parts)});
    }
    return lines;
  }

  // Nothing in a file refers to a shape by its name, so it can do without one that the format lacks.
  static std::string shapeHead(const ShapeSpec& shape) {
    return isName(shape.name) ? "shape " + shape.name : "shape";
  }

  // The first shape is written as part of the body if it has the same name.
  void addBody(const BodySpec& body, std::vector<Line>& lines) {
    requireName("body", body.name, body.where);
    if (body.name == "world") {
      throw Error({.what = "body 'world'",
                   .where = body.where,
                   .found = "the name of the world itself",
                   .wanted = "another name"});
    }
    // A name means the first body that has it; the shapes of any other refer to their body by counting
    // back.
    const bool isFirst = names_.insert(body.name).second;
    Line line{"body " + body.name, bodyParts(body)};
    const std::size_t own = !body.shapes.empty() && body.shapes[0].name == body.name ? 1 : 0;
    if (own == 1) {
      const Parts parts = shapeParts(body.shapes[0]);
      line.parts.insert(line.parts.end(), parts.begin(), parts.end());
    }
    lines.push_back(std::move(line));
    for (std::size_t i = own; i < body.shapes.size(); ++i) {
      const ShapeSpec& shape = body.shapes[i];
      const std::string parent = isFirst ? body.name : fmt::format("-{}", i - own + 1);
      lines.push_back({fmt::format("{} ({})", shapeHead(shape), parent), shapeParts(shape)});
    }
  }

  Parts shapeParts(const ShapeSpec& shape) const {
    const Shape usual;
    Parts parts = {"type=" + typeName(shape.meshMissing ? ShapeType::kMesh : shape.shape.type)};
    // What stands for a missing mesh is not part of the scene.
    const bool isUsual = shape.shape.extent == usual.extent && shape.shape.radius == usual.radius;
    if (!isUsual && !shape.meshMissing) {
      Eigen::Vector4d size;
      size << shape.shape.extent, shape.shape.radius;
      parts.push_back("size=" + arrayText(size.head(shape.shape.radius == 0 ? 3 : 4)));
    }
    const Pose X_BS = shape.X_BS * Pose{placedMesh(shape, false).R_SM, Eigen::Vector3d::Zero()};
    if (!isIdentity(X_BS)) parts.push_back("rel=" + poseText(X_BS));
    if (shape.color != ShapeSpec().color)
      parts.push_back("color=" + arrayText(shape.color.head(shape.color[3] == 1 ? 3 : 4)));
    if (shape.contact) parts.emplace_back("contact");
    addMask(shape.mask, parts);
    if (!shape.visible) parts.emplace_back("hidden");
    addMesh(shape, parts);
    return parts;
  }

  static void addMask(const ContactMask& mask, Parts& parts) {
    const Eigen::Vector2d bits(mask.type, mask.affinity);
    if (bits != Eigen::Vector2d::Ones()) parts.push_back("contact_bits=" + arrayText(bits));
    if (mask.pairs.empty()) return;
    const Eigen::VectorXi pairs = Eigen::VectorXi::Map(mask.pairs.data(), std::ssize(mask.pairs));
    parts.push_back("contact_pairs=" + arrayText(pairs.cast<double>()));
  }

  void addMesh(const ShapeSpec& shape, Parts& parts) const {
    if (!usesMesh(shape.shape.type) && shape.meshFile.empty()) return;
    const std::string what = fmt::format("shape '{}'", shape.name);
    parts.push_back("mesh=" + quotedFile(what, meshFile(shape), shape.where));
    const Eigen::Vector3d scale = placedMesh(shape, false).scale;
    if (scale == Eigen::Vector3d::Ones()) return;
    const bool isUniform = scale == Eigen::Vector3d::Constant(scale[0]);
    parts.push_back("meshscale=" + (isUniform ? numberText(scale[0]) : arrayText(scale)));
  }

  std::string meshFile(const ShapeSpec& shape) const {
    if (shape.meshPath.empty() || folder_.empty()) return shape.meshFile;
    return std::filesystem::proximate(shape.meshPath, folder_).generic_string();
  }

  const std::filesystem::path& folder_;
  std::set<std::string> names_;
};

}  // namespace

std::string writeOrs(const SceneSpec& spec, const std::filesystem::path& folder) {
  std::string text = Writer(folder).write(spec);
  requireReadable(text, ".ors");
  return text;
}

}  // namespace rex
