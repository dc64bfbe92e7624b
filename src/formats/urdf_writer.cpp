#include "formats/urdf_writer.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "formats/ors_writer_internal.h"
#include "formats/urdf_expansion_internal.h"
#include "scene/model.h"

namespace rex {
namespace {

namespace fs = std::filesystem;
using namespace urdf;

constexpr double kWide = 1e9;  // means "no limit", which URDF cannot express

// URDF identifies things by their names.
void requireNames(const SceneSpec& spec) {
  const auto requireName = [](const auto& thing, const char* what) {
    if (thing.name.empty()) throw Error({.what = what, .where = thing.where, .wanted = "a name"});
  };
  std::unordered_map<std::string, SourceLocation> first;
  for (const BodySpec& body : spec.bodies) requireName(body, "a body without a name");
  for (const JointSpec& joint : spec.joints) {
    requireName(joint, "a joint without a name");
    const auto [at, isNew] = first.emplace(joint.name, joint.where);
    if (isNew) continue;
    const std::string place = toString(at->second);
    throw Error(
        {.what = fmt::format("two joints '{}'", joint.name),
         .where = joint.where,
         .wanted = "a name of its own" + (place.empty() ? "" : fmt::format(": the first is at {}", place))});
  }
}

// Joints refer to the first body of a name, so the others can be renamed.
SceneSpec withOwnNames(SceneSpec spec, Losses& losses) {
  std::unordered_set<std::string> given, taken;
  std::unordered_map<std::string, int> lastNumbers;
  for (const BodySpec& body : spec.bodies) given.insert(body.name);
  for (BodySpec& body : spec.bodies) {
    if (taken.insert(body.name).second) continue;
    losses.add("bodies whose name was taken got a number", body.name, body.where);
    int& number = lastNumbers.try_emplace(body.name, 1).first->second;
    std::string name;
    do name = fmt::format("{}_{}", body.name, ++number);
    while (given.contains(name));
    body.name = name;
    given.insert(name);
    taken.insert(name);
  }
  return spec;
}

// A solid of a kind that URDF has, in the frame of the shape.
struct Solid {
  Pose X_SG;
  const char* tag;
  Markup::Attributes sizes;
};

class UrdfWriter {
 public:
  UrdfWriter(const SceneSpec& spec, fs::path folder, Losses losses)
      : model_(compile(spec)),
        folder_(std::move(folder)),
        losses_(std::move(losses)),
        spec_(expand(spec, losses_)) {
    for (const BodySpec& body : spec.bodies)
      if (body.kind != BodyKind::kDynamic) losses_.add("kinds of bodies are left out", body.name, body.where);
    for (const JointSpec& joint : spec.joints) noteLosses(joint);
    for (const PinSpec& pin : spec.pins)
      losses_.add("pins are left out: the loops that they close are open", pin.a, pin.where);
    noteCollisions(spec);
  }

  UrdfText write() {
    const std::string name = fs::path(spec_.name).stem().string();
    markup_.open("robot", {{"name", name.empty() ? "scene" : name}});
    if (needsWorld()) writeWorld();
    for (const BodySpec& body : spec_.bodies) writeLink(body);
    for (const JointSpec& joint : spec_.joints) writeJoint(joint);
    markup_.close("robot");
    return {std::move(markup_.text), losses_.take()};
  }

 private:
  void noteCollisions(const SceneSpec& spec) {
    for (const CollisionChoice& choice : spec.collisionChoices)
      losses_.add("collision settings are left out: they belong in an SRDF", choice.a, choice.where);
    const auto noteMasks = [&](const std::vector<ShapeSpec>& shapes, const std::string& owner) {
      for (const ShapeSpec& shape : shapes)
        if (shape.contact && shape.mask != ContactMask{})
          losses_.add("contype, conaffinity and pairs of shapes are left out", owner, shape.where);
    };
    noteMasks(spec.worldShapes, kWorldName);
    for (const BodySpec& body : spec.bodies) noteMasks(body.shapes, body.name);
    const auto touches = [](const ShapeSpec& shape) { return shape.contact; };
    if (spec.collisionRule != CollisionRule::kFourGenerations) return;
    for (const BodySpec& body : spec.bodies)
      if (std::any_of(body.shapes.begin(), body.shapes.end(), touches))
        losses_.add("bodies within four generations may collide when the file is read again", body.name,
                    body.where);
  }

  void noteLosses(const JointSpec& joint) {
    if (joint.q0.size() > 0 && joint.q0 != jointCoordinates(joint.type, joint.axis, Pose{}))
      losses_.add("initial coordinates are left out", joint.name, joint.where);
    const bool isWhole = joint.type == JointType::kPlanarXYPhi || joint.type == JointType::kFree;
    if (isWhole && (joint.lower.size() > 0 || joint.upper.size() > 0))
      losses_.add("limits of planar and free joints are left out", joint.name, joint.where);
    if (joint.type == JointType::kRigid) return;
    if (joint.armature != 0) losses_.add("armatures of joints are left out", joint.name, joint.where);
    if (joint.stiffness != 0) losses_.add("springs of joints are left out", joint.name, joint.where);
  }

  bool needsWorld() const {
    const auto isOnWorld = [](const JointSpec& joint) { return joint.parent == kWorldName; };
    return spec_.bodies.empty() || !spec_.worldShapes.empty() ||
           std::any_of(spec_.joints.begin(), spec_.joints.end(), isOnWorld);
  }

  void writeWorld() {
    markup_.open("link", {{"name", kWorldName}});
    for (const ShapeSpec& shape : spec_.worldShapes) writeShape(shape, kWorldName);
    markup_.close("link");
  }

  void writeLink(const BodySpec& body) {
    markup_.open("link", {{"name", body.name}});
    if (body.mass > 0 || (body.inertia && !body.inertia->isZero(0))) {
      const Body& known = model_[model_.body(body.name)];
      writeInertial(known.mass, known.p_BBcm, known.I_BBcm_B);
      if (known.buoyancy != 0) losses_.add("buoyancies of bodies are left out", body.name, body.where);
    }
    for (const ShapeSpec& shape : body.shapes) writeShape(shape, body.name);
    markup_.close("link");
  }

  void writeInertial(double mass, const Eigen::Vector3d& p_BBcm, const Eigen::Matrix3d& I) {
    markup_.open("inertial");
    markup_.origin({Eigen::Matrix3d::Identity(), p_BBcm});
    markup_.empty("mass", {{"value", numeral(mass)}});
    markup_.empty("inertia", {{"ixx", numeral(I(0, 0))},
                              {"ixy", numeral(I(0, 1))},
                              {"ixz", numeral(I(0, 2))},
                              {"iyy", numeral(I(1, 1))},
                              {"iyz", numeral(I(1, 2))},
                              {"izz", numeral(I(2, 2))}});
    markup_.close("inertial");
  }

  void writeShape(const ShapeSpec& shape, const std::string& owner) {
    const std::string name = shape.name.empty() ? owner : shape.name;
    if (!shape.visible && !shape.contact)
      return losses_.add("shapes neither drawn nor touched are left out", name, shape.where);
    const std::vector<Solid> solids = solidsOf(shape, name);
    for (const char* tag : {"visual", "collision"}) {
      const bool visible = tag == std::string_view("visual");
      if (!(visible ? shape.visible : shape.contact)) continue;
      for (const Solid& solid : solids) {
        markup_.open(tag, {{"name", name == owner ? "" : name}});
        markup_.origin(shape.X_BS * solid.X_SG);
        markup_.open("geometry");
        markup_.empty(solid.tag, solid.sizes);
        markup_.close("geometry");
        if (visible) writeMaterial(shape.color);
        markup_.close(tag);
      }
    }
  }

  // The solids of URDF that make up a shape.
  std::vector<Solid> solidsOf(const ShapeSpec& shape, const std::string& name) {
    const Shape& s = shape.shape;
    const auto lose = [&](const char* kind) { losses_.add(kind, name, shape.where); };
    const auto leaveOut = [&](const char* kind) {
      lose(kind);
      return std::vector<Solid>{};
    };
    const std::string radius = numeral(s.radius), length = numeral(s.extent.z());
    const Pose top = translation(0, 0, s.extent.z() / 2), bottom = top.inverse();
    if (shape.meshMissing) return meshOf(shape);
    if (!hasSize(s)) return leaveOut("shapes without size are left out");
    switch (s.type) {
      case ShapeType::kRoundedBox:
        lose("rounded boxes became boxes");
        [[fallthrough]];
      case ShapeType::kBox:
        return {{{}, "box", {{"size", numeral(s.extent)}}}};
      case ShapeType::kSphere:
        return {{{}, "sphere", {{"radius", radius}}}};
      case ShapeType::kCylinder:
        return {{{}, "cylinder", {{"radius", radius}, {"length", length}}}};
      case ShapeType::kCone:
        throw Error({.what = fmt::format("shape '{}'", name),
                     .where = shape.where,
                     .found = "a cone, which URDF lacks",
                     .wanted = "a cylinder or a mesh"});
      case ShapeType::kCapsule:
        lose("capsules became cylinders and spheres");
        if (s.extent.z() == 0) return {{{}, "sphere", {{"radius", radius}}}};
        return {{{}, "cylinder", {{"radius", radius}, {"length", length}}},
                {top, "sphere", {{"radius", radius}}},
                {bottom, "sphere", {{"radius", radius}}}};
      case ShapeType::kEllipsoid:
        return leaveOut("ellipsoids are left out");
      case ShapeType::kPointCloud:
        return leaveOut("point clouds are left out");
      case ShapeType::kSphereSweptConvex:
        lose("sphere-swept meshes became meshes");
        [[fallthrough]];
      case ShapeType::kMesh:
        if (shape.meshFile.empty() && shape.meshPath.empty())
          return leaveOut("meshes without a file are left out");
        return meshOf(shape);
      case ShapeType::kMarker:
        return leaveOut("markers are left out");
    }
    return {};
  }

  static bool hasSize(const Shape& s) {
    if (s.type == ShapeType::kBox || s.type == ShapeType::kRoundedBox || s.type == ShapeType::kEllipsoid)
      return s.extent.minCoeff() > 0;
    if (s.type == ShapeType::kCylinder) return s.radius > 0 && s.extent.z() > 0;
    if (s.type == ShapeType::kSphere || s.type == ShapeType::kCapsule) return s.radius > 0;
    return true;
  }

  std::vector<Solid> meshOf(const ShapeSpec& shape) const {
    const PlacedMesh placed = placedMesh(shape, true);
    return {{{placed.R_SM, Eigen::Vector3d::Zero()},
             "mesh",
             {{"filename", fileOf(shape)}, {"scale", numeral(placed.scale)}}}};
  }

  std::string fileOf(const ShapeSpec& shape) const {
    if (shape.meshPath.empty()) return shape.meshFile;
    return folder_.empty() ? shape.meshPath.generic_string()
                           : fs::proximate(shape.meshPath, folder_).generic_string();
  }

  // Materials of one name must agree, so the name is the colour.
  void writeMaterial(const Eigen::Vector4d& color) {
    const std::string rgba = numeral(color.cwiseMax(0).cwiseMin(1));
    markup_.open("material", {{"name", rgba}});
    markup_.empty("color", {{"rgba", rgba}});
    markup_.close("material");
  }

  static bool hasLimit(const JointSpec& joint) {
    const auto finite = [](const Eigen::VectorXd& v) { return v.size() == 1 && std::isfinite(v[0]); };
    return finite(joint.lower) || finite(joint.upper);
  }

  static std::string typeOf(const JointSpec& joint) {
    const bool turnsOn = joint.type == JointType::kHinge && !hasLimit(joint);
    return turnsOn ? "continuous" : std::string(urdfWord(joint.type));
  }

  void writeJoint(const JointSpec& joint) {
    const bool isRigid = joint.type == JointType::kRigid;
    markup_.open("joint", {{"name", joint.name}, {"type", typeOf(joint)}});
    markup_.origin(joint.X_PF);
    markup_.empty("parent", {{"link", joint.parent}});
    markup_.empty("child", {{"link", joint.child}});
    if (!isRigid && joint.type != JointType::kFree) markup_.empty("axis", {{"xyz", numeral(joint.axis)}});
    if (!isRigid) writeLimit(joint);
    if (!isRigid && (joint.damping != 0 || joint.friction != 0))
      markup_.empty("dynamics", {{"damping", numeral(joint.damping)}, {"friction", numeral(joint.friction)}});
    if (!isRigid && !joint.mimic.empty())
      markup_.empty("mimic", {{"joint", joint.mimic},
                              {"multiplier", numeral(joint.mimicRatio)},
                              {"offset", numeral(joint.mimicOffset)}});
    markup_.close("joint");
  }

  void writeLimit(const JointSpec& joint) {
    const auto bounded = [&](double value) {
      if (std::isfinite(value)) return numeral(value);
      losses_.add("missing limits became 1e9", joint.name, joint.where);
      return numeral(std::copysign(kWide, value));
    };
    const auto at = [](const Eigen::VectorXd& v, double none) { return v.size() > 0 ? v[0] : none; };
    const std::string type = typeOf(joint);
    if (type == "revolute" || type == "prismatic") {
      markup_.empty("limit", {{"lower", bounded(at(joint.lower, -HUGE_VAL))},
                              {"upper", bounded(at(joint.upper, HUGE_VAL))},
                              {"velocity", bounded(joint.maxVelocity)},
                              {"effort", bounded(joint.maxEffort)}});
    } else if (std::isfinite(joint.maxVelocity) || std::isfinite(joint.maxEffort)) {
      markup_.empty("limit",
                    {{"velocity", bounded(joint.maxVelocity)}, {"effort", bounded(joint.maxEffort)}});
    }
  }

  const Model model_;
  fs::path folder_;
  Losses losses_;
  SceneSpec spec_;
  Markup markup_;
};

}  // namespace

UrdfText writeUrdf(const SceneSpec& spec, const std::filesystem::path& folder) {
  requireNames(spec);
  Losses losses;
  const SceneSpec named = withOwnNames(spec, losses);
  UrdfText urdf = UrdfWriter(named, folder, std::move(losses)).write();
  requireReadable(urdf.text, ".urdf");
  return urdf;
}

}  // namespace rex
