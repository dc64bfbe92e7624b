#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "formats/mjcf_parts_internal.h"

namespace rex::mjcf {
namespace {

constexpr std::size_t kMostJoints = 1000, kDeepestBody = 100, kMostPieces = 32'768, kMostReplicas = 10'000;

// A body as it is in the file, before all names are known.
struct BodyNode {
  Tag tag;
  Pose X_PB{};
  std::string name{};  // empty: none
  std::vector<BodyJoint> joints{};
  std::vector<Geom> geoms{};
  std::optional<MassProperties> given{};
  std::optional<Eigen::Matrix3d> givenAxes{};
  double buoyancy = 0;
  bool aligns = false;                         // see alignFreeBodies()
  std::shared_ptr<const BodyTree> attached{};  // instead of all this
  std::vector<BodyNode> children{};
};

Eigen::Matrix3d givenMoments(const Tag& tag, double mass, const Pose& X_BI) {
  Eigen::Matrix3d I = Eigen::Matrix3d::Zero();
  if (tag.has("fullinertia")) {
    const Eigen::VectorXd full = tag.numbers("fullinertia", 6);
    I << full[0], full[3], full[4], full[3], full[1], full[5], full[4], full[5], full[2];
    if (tag.has("diaginertia") || !X_BI.R.isIdentity(0))
      tag.fail(tag.where("fullinertia"), "attribute 'fullinertia'",
               tag.has("diaginertia") ? "'diaginertia' as well" : "an orientation as well", "one of them");
  } else if (tag.has("diaginertia")) {
    I = Eigen::Vector3d(tag.numbers("diaginertia", 3)).asDiagonal();
  } else if (mass > 0) {
    tag.forgive(tag.where(), "attribute 'diaginertia' or 'fullinertia' is missing", "", "",
                "the inertia counts as 0");
  }
  return urdf::judgedMoments(tag, I, mass);
}

MassProperties readInertial(const Tag& tag, const Compiler& compiler) {
  MassProperties given;
  if (!tag.has("pos")) tag.forgive(tag.where(), "attribute 'pos' is missing", "", "", "it counts as 0 0 0");
  const Pose X_BI = poseOf(Styled(tag), compiler);
  given.mass = tag.notNegative("mass");
  given.p_BBcm = X_BI.p;
  const Eigen::Matrix3d I = givenMoments(tag, given.mass, X_BI);
  if (given.mass == 0 && !I.isZero(0))
    tag.forgive(tag.where("mass"), "an inertia without mass", "0", "a mass > 0 kg", "the body has neither");
  if (given.mass > 0) given.I_BBcm_B = X_BI.R * I * X_BI.R.transpose();
  return given;
}

// Reads the tags of all bodies.
class NodeReader {
 public:
  NodeReader(Files& files, const Defaults& defaults, const Compiler& compiler, const MjcfAssets& assets)
      : files_(files), defaults_(defaults), compiler_(compiler), assets_(assets) {}

  void readWorld(const Tag& section, BodyNode& world) {
    collect(section.of("<worldbody>"), knownOf("worldbody"), {}, defaults_.main(), world, 0);
  }
  const std::unordered_map<std::string, SourceLocation>& bodies() const { return bodies_; }
  const std::unordered_map<std::string, SourceLocation>& joints() const { return joints_; }
  std::unordered_map<std::string, std::vector<std::string>> takeReplicas() { return std::move(replicas_); }

 private:
  static bool isWorld(const BodyNode& body) { return body.name == kWorldName; }

  // Reads the contents of a tag. X_BF is the frame around it, seen from the body.
  void collect(const Tag& tag, const Known& known, const Pose& X_BF, const DefaultClass& style,
               BodyNode& body, std::size_t depth) {
    if (depth > kDeepestBody)
      tag.fail(tag.where(), "nested too deep", fmt::format("level {}", depth),
               fmt::format("at most {}", kDeepestBody));
    for (const Tag& child : files_.children(tag, known)) {
      if (child.name() == "body") body.children.push_back(readBody(child, X_BF, style, depth + 1));
      if (child.name() == "frame") collectFrame(child, X_BF, style, body, depth + 1);
      if (child.name() == "replicate") collectReplicas(child, X_BF, style, body, depth + 1);
      if (child.name() == "attach") body.children.push_back(readAttached(child, X_BF));
      if (child.name() == "inertial") readGiven(child, X_BF, body);
      if (child.name() == "geom") readBodyGeom(child, X_BF, style, body);
      if (child.name() == "joint" || child.name() == "freejoint") readMotion(child, X_BF, style, body);
    }
  }

  BodyNode readBody(const Tag& given, const Pose& X_PF, const DefaultClass& around, std::size_t depth) {
    BodyNode body{given};
    if (given.has("name")) {
      body.name = nameOf(given);
      body.tag = given.of(fmt::format("body '{}'", body.name));
      if (isWorld(body)) body.tag.failAt("name", "the name of the world itself", "another name");
      requireNew(body.tag, "body", body.name, bodies_);
    } else {
      body.tag = given.of("<body>");
    }
    // With global coordinates X_PF is X_PW; a body without a pose then has the frame of the world.
    const Pose X_FB = poseOf(Styled(body.tag), compiler_);
    body.X_PB = X_PF * X_FB;
    const Pose X_BF = compiler_.global ? X_FB.inverse() : Pose{};
    body.buoyancy = given.number("gravcomp", 0);
    collect(body.tag, knownOf("body"), X_BF, defaults_.named(body.tag, "childclass", around), body, depth);
    return body;
  }

  void collectFrame(const Tag& tag, const Pose& X_BF, const DefaultClass& style, BodyNode& body,
                    std::size_t depth) {
    const Pose X_BG = X_BF * poseOf(Styled(tag), compiler_);
    collect(tag, knownOf("frame"), X_BG, defaults_.named(tag, "childclass", style), body, depth);
  }

  // Each replica stands in the frame of the one before; those of inner tags have the inner number first.
  void collectReplicas(const Tag& tag, const Pose& X_BF, const DefaultClass& style, BodyNode& body,
                       std::size_t depth) {
    const double count = tag.number("count");
    if (!(count >= 1 && count == std::floor(count)))
      tag.failAt("count", xml::quoted(tag.text("count")), "a whole number > 0");
    Pose X_step;
    if (tag.has("offset")) X_step.p = tag.numbers("offset", 3);
    if (tag.has("euler")) X_step.R = rotationFromEuler(tag.numbers("euler", 3), compiler_);
    const std::string around = suffix_, separator = tag.has("sep") ? tag.text("sep") : "";
    const int digits = static_cast<int>(fmt::format("{}", count).size());
    Pose X_BR = X_BF;
    for (int i = 0; i < count; ++i) {
      if (++replicaCount_ > kMostReplicas)
        tag.fail(tag.where(), "too many replicas", "", fmt::format("at most {}", kMostReplicas));
      suffix_ = fmt::format("{}{:0{}}{}", separator, i, digits, around);
      collect(tag, knownOf("replicate"), X_BR, defaults_.named(tag, "childclass", style), body, depth);
      X_BR = X_BR * X_step;
    }
    suffix_ = around;
  }

  // The model is in the frame around the tag.
  BodyNode readAttached(const Tag& tag, const Pose& X_PF) {
    tag.expect(knownOf("attach"));
    const std::string& name = tag.nameIn("model");
    const auto model = assets_.models.find(name);
    if (model == assets_.models.end()) {
      std::vector<std::string> known;
      for (const auto& [other, unused] : assets_.models) known.push_back(other);
      std::ranges::sort(known);
      tag.fail(tag.where("model"), "unknown model", xml::quoted(name), "the name of a <model>",
               nearestNames(name, known));
    }
    if (!model->second.tree)
      model->second.tree = std::make_shared<const BodyTree>(assets_.readOther(model->second.tag));
    const std::string prefix = tag.text("prefix");
    const Rename renamed = [&](const std::string& inner) { return prefix + inner + suffix_; };
    BodyTree part = partToAttach(*model->second.tree, tag, renamed);
    attachedJoints_ += part.joints.size();
    attachedBodies_ += part.spec.bodies.size();
    if (attachedJoints_ > kMostJoints || attachedBodies_ > kMostReplicas)
      tag.fail(tag.where(), "too many bodies and joints of attached models", "",
               fmt::format("at most {} and {}", kMostReplicas, kMostJoints));
    for (const BodySpec& body : part.spec.bodies) requireNew(tag, "body", body.name, bodies_);
    for (const urdf::ReadJoint& joint : part.joints) requireNew(tag, "joint", joint.spec.name, joints_);
    BodyNode node{tag, X_PF};
    node.attached = std::make_shared<const BodyTree>(std::move(part));
    return node;
  }

  // The name of a thing, in a replica with its number.
  std::string nameOf(const Tag& tag) {
    const std::string& name = tag.nameIn("name");
    if (suffix_.empty()) return name;
    std::vector<std::string>& suffixes = replicas_[name];
    if (std::ranges::count(suffixes, suffix_) == 0) suffixes.push_back(suffix_);
    return name + suffix_;
  }

  void readGiven(const Tag& tag, const Pose& X_BF, BodyNode& body) const {
    tag.expect(knownOf("inertial"));
    refuseOnWorld(tag, body);
    if (body.given) tag.fail(tag.where(), "a second one", "", "one");
    if (compiler_.inertia == Compiler::Inertia::kFromGeoms && !tag.has("pos")) {
      tag.warn(tag.where(), "is ignored: inertiafromgeom asks for the mass of the geoms");
      return;
    }
    MassProperties given = readInertial(tag, compiler_);
    if (tag.has("diaginertia")) body.givenAxes = X_BF.R * poseOf(Styled(tag), compiler_).R;
    given.p_BBcm = X_BF * given.p_BBcm;
    given.I_BBcm_B = X_BF.R * given.I_BBcm_B * X_BF.R.transpose();
    body.given = given;
  }

  void readBodyGeom(const Tag& given, const Pose& X_BF, const DefaultClass& style, BodyNode& body) {
    const Tag tag = given.has("name") ? given.of(fmt::format("geom '{}'", given.nameIn("name"))) : given;
    tag.expect(knownOf("geom"));
    const Styled styled(tag, defaults_.named(tag, "class", style), Kind::kGeom);
    Geom geom = readGeom(styled, isWorld(body), compiler_, assets_);
    // Those with more than one are height fields.
    if (geom.shapes.size() > 1) pieces_ += geom.shapes.size();
    if (pieces_ > kMostPieces)
      tag.fail(tag.where(), "too many pieces of height fields", "", fmt::format("at most {}", kMostPieces));
    if (tag.has("name")) geom.name = nameOf(tag);
    for (ShapeSpec& shape : geom.shapes) shape.X_BS = X_BF * shape.X_BS;
    if (geom.solid) geom.solid->X_BS = X_BF * geom.solid->X_BS;
    body.geoms.push_back(std::move(geom));
  }

  void readMotion(const Tag& given, const Pose& X_BF, const DefaultClass& style, BodyNode& body) {
    refuseOnWorld(given, body);
    const Tag tag = given.has("name") ? given.of(fmt::format("joint '{}'", given.nameIn("name"))) : given;
    BodyJoint one;
    JointSpec& joint = one.spec;
    if (tag.name() == "freejoint") {
      tag.expect(knownOf("freejoint"));
      joint.type = JointType::kFree;
    } else {
      tag.expect(knownOf("joint"));
      one = readBodyJoint(Styled(tag, defaults_.named(tag, "class", style), Kind::kJoint), compiler_);
    }
    joint.where = tag.where();
    const std::size_t aligns = tag.has("align") ? choice(tag, "align", {"false", "true", "auto"}) : 2;
    body.aligns = joint.type == JointType::kFree && (aligns < 2 ? aligns == 1 : compiler_.alignsFree);
    if (joint.type != JointType::kFree) {
      joint.X_PF = X_BF * joint.X_PF;
      joint.X_MC = joint.X_MC * X_BF.inverse();
    }
    if (tag.has("name")) {
      joint.name = nameOf(tag);
      requireNew(tag, "joint", joint.name, joints_);
    }
    body.joints.push_back(std::move(one));
  }

  static void refuseOnWorld(const Tag& tag, const BodyNode& body) {
    if (isWorld(body))
      tag.fail(tag.where(), "on the world", "", "bodies and geoms: the world itself does not move");
  }

  static void requireNew(const Tag& tag, const char* kind, const std::string& name,
                         std::unordered_map<std::string, SourceLocation>& known) {
    const auto [first, isNew] = known.emplace(name, tag.where());
    if (!isNew)
      tag.fail(tag.where("name"), fmt::format("a second {} of this name", kind), "",
               fmt::format("a name of its own: the first is at {}", toString(first->second)));
  }

  Files& files_;
  const Defaults& defaults_;
  const Compiler& compiler_;
  const MjcfAssets& assets_;
  std::unordered_map<std::string, SourceLocation> bodies_, joints_;  // that have names
  std::size_t pieces_ = 0;                                           // of height fields
  std::unordered_map<std::string, std::vector<std::string>> replicas_{};
  std::string suffix_{};  // of names in the replica in hand
  std::size_t replicaCount_ = 0, attachedJoints_ = 0, attachedBodies_ = 0;
};

// Names for things without a name.
class FreeNames {
 public:
  explicit FreeNames(const std::unordered_map<std::string, SourceLocation>& given) {
    for (const auto& [name, where] : given) taken_.emplace(name, 1);
  }
  std::string take(const std::string& base) {
    const auto [first, isNew] = taken_.try_emplace(base, 1);
    if (isNew) return base;
    for (int& count = first->second;;) {
      std::string name = fmt::format("{}_{}", base, ++count);
      if (!taken_.contains(name)) return remembered(std::move(name));
    }
  }

 private:
  std::string remembered(std::string name) {
    taken_.emplace(name, 1);
    return name;
  }
  std::unordered_map<std::string, int> taken_;
};

// Makes a scene of the bodies.
class TreeMaker {
 public:
  explicit TreeMaker(const NodeReader& names) : bodyNames_(names.bodies()), jointNames_(names.joints()) {}

  BodyTree make(BodyNode world) {
    takeGeoms(world, kWorldName, {}, nullptr);
    for (BodyNode& body : world.children) add(body, kWorldName);
    return std::move(tree_);
  }

 private:
  void add(BodyNode& node, const std::string& parent) {
    if (node.attached) return graft(node.tag, *node.attached, parent, node.X_PB, tree_);
    if (node.name.empty()) node.name = bodyNames_.take("body");
    hang(node, parent);
    BodyInFile inFile{.body = tree_.spec.bodies.size() - 1,
                      .parent = parent,
                      .joints = node.joints.size(),
                      .given = node.given,
                      .givenAxes = node.givenAxes,
                      .aligns = node.aligns,
                      .hasGeoms = !node.geoms.empty()};
    tree_.spec.bodies.back().buoyancy = node.buoyancy;
    takeGeoms(node, node.name, inFile.body, &inFile.solids);
    tree_.bodies.push_back(std::move(inFile));
    for (BodyNode& child : node.children) add(child, node.name);
  }

  // Adds the body with its joints, and a massless body between consecutive ones.
  void hang(BodyNode& node, const std::string& parent) {
    requireFree(node, parent);
    std::vector<BodyJoint> joints = node.joints;
    if (joints.empty() && parent == kWorldName) return addBody(node.name, node, node.X_PB);
    if (joints.empty()) joints.emplace_back().spec.type = JointType::kRigid;
    std::string above = parent;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      JointSpec& joint = joints[i].spec;
      nameJoint(joint, above, node.name);
      const bool isLast = i + 1 == joints.size();
      joint.child = isLast ? node.name : bodyNames_.take(fmt::format("{}_{}", node.name, joint.name));
      joint.parent = std::exchange(above, joint.child);
      if (joint.type == JointType::kFree) {
        joint.q0 = joint.springReference = jointCoordinates(JointType::kFree, joint.axis, node.X_PB);
      } else if (i == 0) {
        joint.X_PF = node.X_PB * joint.X_PF;
      }
      if (joint.type == JointType::kRigid) joint.where = node.tag.where();
      addBody(joint.child, node, {});
      if (joints[i].springDamper) tree_.springDampers.emplace_back(joint.name, *joints[i].springDamper);
      addJoint(node, std::move(joint));
    }
  }

  static void requireFree(const BodyNode& node, const std::string& parent) {
    for (const BodyJoint& one : node.joints) {
      if (one.spec.type != JointType::kFree) continue;
      if (parent != kWorldName)
        node.tag.fail(one.spec.where, "a free joint", fmt::format("a body on '{}'", parent),
                      "a body on the world");
      if (node.joints.size() > 1)
        node.tag.fail(one.spec.where, "a free joint", fmt::format("{} joints", node.joints.size()),
                      "no other joint");
    }
  }

  void nameJoint(JointSpec& joint, const std::string& parent, const std::string& body) {
    if (!joint.name.empty()) return;
    const bool isOfTwo = joint.type == JointType::kRigid || joint.type == JointType::kFree;
    joint.name = jointNames_.take(isOfTwo ? fmt::format("{}>{}", parent, body) : body + "_joint");
  }

  void addBody(const std::string& name, const BodyNode& node, const Pose& X_WB) {
    BodySpec body;
    body.name = name;
    body.X_WB = X_WB;
    body.where = node.tag.where();
    tree_.bodyOfName.emplace(name, tree_.spec.bodies.size());
    tree_.spec.bodies.push_back(std::move(body));
  }

  void addJoint(const BodyNode& node, JointSpec joint) {
    if (tree_.joints.size() == kMostJoints)
      node.tag.fail(joint.where, "too many joints", "",
                    fmt::format("at most {}, including those of bodies that do not move", kMostJoints));
    tree_.jointOfName.emplace(joint.name, tree_.joints.size());
    tree_.joints.push_back({std::move(joint), {}, {}, {}});
  }

  void takeGeoms(BodyNode& node, const std::string& name, const std::optional<std::size_t>& body,
                 std::vector<Solid>* solids) {
    std::vector<ShapeSpec>& shapes = tree_.shapesOf(body);
    for (Geom& geom : node.geoms) {
      const GeomInTree at{body, shapes.size(), geom.shapes.size()};
      FitInTree fit{.at = at};
      if (geom.solid && geom.solid->kind == Solid::Kind::kMesh) geom.solid->mesh = shapes.size();
      if (geom.solid && solids) {
        fit.solid = solids->size();
        solids->push_back(*std::move(geom.solid));
      }
      for (ShapeSpec& shape : geom.shapes) {
        if (shape.name.empty()) shape.name = name;
        shapes.push_back(std::move(shape));
      }
      if (!geom.name.empty()) tree_.geomOfName.emplace(geom.name, at);
      if (!geom.fit || at.count == 0) continue;
      fit.fit = *geom.fit;
      tree_.fits.push_back(fit);
    }
  }

  BodyTree tree_;
  FreeNames bodyNames_, jointNames_;
};

}  // namespace

BodyTree readTree(const std::vector<Tag>& worldbodies, Files& files, const Defaults& defaults,
                  const Compiler& compiler, const MjcfAssets& assets) {
  NodeReader reader(files, defaults, compiler, assets);
  BodyNode world{files.root(), {}, kWorldName};
  for (const Tag& section : worldbodies) reader.readWorld(section, world);
  BodyTree tree = TreeMaker(reader).make(std::move(world));
  tree.replicas = reader.takeReplicas();
  return tree;
}

}  // namespace rex::mjcf
