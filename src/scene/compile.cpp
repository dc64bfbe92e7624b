#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/text.h"
#include "geometry/mesh_mass.h"
#include "scene/links_internal.h"
#include "scene/model.h"

namespace rex {
namespace {

// The inertia if only a mass is given, that of a solid sphere of 0.7 m radius: see share/doc/scenes.md.
constexpr double kInertiaPerMass = 0.2;

[[noreturn]] void fail(const SourceLocation& where, std::string what, std::string found, std::string wanted,
                       std::vector<std::string> nearest = {}) {
  throw Error({std::move(what), where, std::move(found), std::move(wanted), std::move(nearest)});
}

bool isFinite(const Pose& X) { return X.R.allFinite() && X.p.allFinite(); }

// Whether it makes no difference which of two movements comes first.
bool commute(const JointMovement& a, const JointMovement& b) {
  using Kind = JointMovement::Kind;
  if (a.kind == Kind::kQuaternion || b.kind == Kind::kQuaternion) return false;
  return (a.kind == Kind::kSlider && b.kind == Kind::kSlider) || a.axis.cross(b.axis).isZero(1e-12);
}

// The twists of a joint: kParent stands for its frame F, kChild for its frame M. Each twist is constant in
// one of the two; if it is constant in both, M leads to cheaper Jacobians.
std::array<DegreeOfFreedom, 6> freedomsOf(const JointMovements& all) {
  std::array<DegreeOfFreedom, 6> freedoms{};
  for (const JointMovement& one : all) {
    const bool mayBeLast =
        std::all_of(&one + 1, all.end(), [&](const auto& later) { return commute(one, later); });
    const auto set = [&](int coordinate, const Eigen::Vector3d& axis,
                         Eigen::Vector3d DegreeOfFreedom::*part) {
      DegreeOfFreedom& freedom = freedoms[static_cast<std::size_t>(coordinate)];
      freedom.*part = axis;
      freedom.frame = mayBeLast ? DegreeOfFreedom::Frame::kChild : DegreeOfFreedom::Frame::kParent;
    };
    switch (one.kind) {
      case JointMovement::Kind::kFixed:
        break;
      case JointMovement::Kind::kHinge:
        set(one.coordinate, one.axis, &DegreeOfFreedom::angular);
        break;
      case JointMovement::Kind::kSlider:
        set(one.coordinate, one.axis, &DegreeOfFreedom::linear);
        break;
      case JointMovement::Kind::kQuaternion:
        for (int i = 0; i < 3; ++i)
          set(one.coordinate + i, Eigen::Vector3d::Unit(i), &DegreeOfFreedom::angular);
        break;
    }
  }
  return freedoms;
}

// The same twist seen from a body in which its frame has the pose X.
DegreeOfFreedom seenThrough(const Pose& X, const DegreeOfFreedom& freedom) {
  const Eigen::Vector3d angular = X.R * freedom.angular;
  return {angular, X.R * freedom.linear - angular.cross(X.p), freedom.frame};
}

// The tree of a scene: indices into the spec, checked.
struct Tree {
  std::vector<int> bodyOrder;  // breadth-first: bodies without joint, on a joint of the world, ...
  std::vector<int> incoming;   // per body of the spec: its joint, or -1
  std::map<std::string, int> firstBodyByName;  // of the spec
};

class TreeBuilder {
 public:
  explicit TreeBuilder(const SceneSpec& spec) : spec_(spec) {}

  Tree build() {
    for (std::size_t i = 0; i < spec_.bodies.size(); ++i)
      tree_.firstBodyByName.emplace(spec_.bodies[i].name, static_cast<int>(i));
    tree_.incoming.assign(spec_.bodies.size(), -1);
    outgoing_.resize(spec_.bodies.size());
    checkJointNames();
    for (std::size_t j = 0; j < spec_.joints.size(); ++j) connect(static_cast<int>(j));
    order();
    return std::move(tree_);
  }

 private:
  void checkJointNames() const {
    std::map<std::string, const JointSpec*> seen;
    for (const JointSpec& joint : spec_.joints) {
      const auto [first, isNew] = seen.emplace(joint.name, &joint);
      if (!isNew) {
        fail(joint.where, fmt::format("duplicate joint '{}'", joint.name), "",
             fmt::format("a name of its own: the first is at {}", toString(first->second->where)));
      }
    }
  }

  int bodyIndex(const std::string& name, const JointSpec& joint, const char* role) const {
    const auto found = tree_.firstBodyByName.find(name);
    if (found != tree_.firstBodyByName.end()) return found->second;
    std::vector<std::string> known;
    for (const BodySpec& body : spec_.bodies) known.push_back(body.name);
    fail(joint.where, fmt::format("joint '{}': unknown {}", joint.name, role), fmt::format("'{}'", name),
         "the name of a body", nearestNames(name, known));
  }

  void connect(int j) {
    const JointSpec& joint = spec_.joints[static_cast<std::size_t>(j)];
    const int child = bodyIndex(joint.child, joint, "child");
    std::vector<int>& siblings =
        joint.parent == kWorldName
            ? ofWorld_
            : outgoing_[static_cast<std::size_t>(bodyIndex(joint.parent, joint, "parent"))];
    int& incoming = tree_.incoming[static_cast<std::size_t>(child)];
    if (incoming >= 0) {
      fail(joint.where,
           fmt::format("joint '{}': body '{}' is already attached to a joint", joint.name, joint.child),
           fmt::format("joint '{}'", spec_.joints[static_cast<std::size_t>(incoming)].name),
           "one joint leading to each body");
    }
    incoming = j;
    siblings.push_back(child);
  }

  void order() {
    std::vector<int>& order = tree_.bodyOrder;
    for (std::size_t i = 0; i < spec_.bodies.size(); ++i) {
      if (tree_.incoming[i] < 0) order.push_back(static_cast<int>(i));
    }
    order.insert(order.end(), ofWorld_.begin(), ofWorld_.end());
    for (std::size_t next = 0; next < order.size(); ++next) {
      const std::vector<int>& children = outgoing_[static_cast<std::size_t>(order[next])];
      order.insert(order.end(), children.begin(), children.end());
    }
    if (order.size() < spec_.bodies.size()) failAtLoop();
  }

  // Every body that was not reached descends from a loop: walk upwards until a body is met again.
  [[noreturn]] void failAtLoop() const {
    std::vector<bool> reached(spec_.bodies.size());
    for (const int i : tree_.bodyOrder) reached[static_cast<std::size_t>(i)] = true;
    int at = static_cast<int>(std::find(reached.begin(), reached.end(), false) - reached.begin());
    std::vector<int> path;
    while (std::find(path.begin(), path.end(), at) == path.end()) {
      path.push_back(at);
      const JointSpec& joint =
          spec_.joints[static_cast<std::size_t>(tree_.incoming[static_cast<std::size_t>(at)])];
      at = tree_.firstBodyByName.at(joint.parent);
    }
    path.erase(path.begin(), std::find(path.begin(), path.end(), at));
    std::string loop;
    for (auto i = path.rbegin(); i != path.rend(); ++i)
      loop += spec_.bodies[static_cast<std::size_t>(*i)].name + " > ";
    loop += spec_.bodies[static_cast<std::size_t>(path.back())].name;
    const JointSpec& closing =
        spec_.joints[static_cast<std::size_t>(tree_.incoming[static_cast<std::size_t>(path.front())])];
    fail(closing.where, fmt::format("joint '{}': joints form a loop", closing.name), loop, "a tree");
  }

  const SceneSpec& spec_;
  Tree tree_;
  std::vector<std::vector<int>> outgoing_;  // per body: children in the order of their joints
  std::vector<int> ofWorld_;                // the same for the world
};

void checkBody(const BodySpec& body) {
  const std::string what = fmt::format("body '{}'", body.name);
  if (body.name == kWorldName) fail(body.where, what, "the name of the world itself", "another name");
  if (!isFinite(body.X_WB))
    fail(body.where, what + ": pose", "a number that is not finite", "finite numbers");
  if (!(body.mass >= 0) || !std::isfinite(body.mass))
    fail(body.where, what + ": mass", fmt::format("{}", body.mass), "a finite mass >= 0 kg");
  if (!body.p_BBcm.allFinite())
    fail(body.where, what + ": centre of mass", "a number that is not finite", "finite numbers");
  if (!std::isfinite(body.buoyancy))
    fail(body.where, what + ": buoyancy", fmt::format("{}", body.buoyancy), "a finite number");
  if (!body.inertia) return;
  if (!body.inertia->allFinite() || !body.inertia->isApprox(body.inertia->transpose()))
    fail(body.where, what + ": inertia", "", "a finite symmetric matrix");
  if (inertiaFault(*body.inertia) == InertiaFault::kNegative)
    fail(body.where, what + ": inertia", "a negative principal moment", "principal moments >= 0");
}

void checkShape(const ShapeSpec& shape) {
  const Shape& s = shape.shape;
  if (!isFinite(shape.X_BS) || !s.extent.allFinite() || !(s.extent.minCoeff() >= 0) || !(s.radius >= 0) ||
      !std::isfinite(s.radius)) {
    fail(shape.where, fmt::format("shape '{}'", shape.name), "", "a finite pose, finite sizes >= 0");
  }
  if (s.type == ShapeType::kRoundedBox && s.radius > s.extent.minCoeff() / 2) {
    fail(shape.where, fmt::format("shape '{}': radius of the rounded edges", shape.name),
         fmt::format("{} m", s.radius),
         fmt::format("at most half of the shortest edge, {} m", s.extent.minCoeff() / 2));
  }
  for (const double part : shape.color) {
    if (!(part >= 0 && part <= 1))
      fail(shape.where, fmt::format("shape '{}': colour", shape.name), fmt::format("{}", part),
           "numbers from 0 to 1");
  }
}

void checkJoint(const JointSpec& joint) {
  const std::string what = fmt::format("joint '{}'", joint.name);
  const int n = positionCount(joint.type);
  if (!isFinite(joint.X_PF) || !isFinite(joint.X_MC))
    fail(joint.where, what + ": frames", "a number that is not finite", "finite numbers");
  if (!std::isfinite(joint.axis.norm()) || joint.axis.norm() == 0)
    fail(joint.where, what + ": axis", "a zero or non-finite vector", "a direction");
  const auto requireNumber = [&](double number, const char* name, bool isRight, const char* wanted) {
    if (!isRight) fail(joint.where, fmt::format("{}: {}", what, name), fmt::format("{}", number), wanted);
  };
  requireNumber(joint.pitch, "pitch", std::isfinite(joint.pitch), "metres per turn");
  requireNumber(joint.maxVelocity, "largest velocity", joint.maxVelocity >= 0, "a number >= 0");
  requireNumber(joint.maxEffort, "largest effort", joint.maxEffort >= 0, "a number >= 0");
  requireNumber(joint.damping, "damping", joint.damping >= 0 && std::isfinite(joint.damping),
                "a number >= 0");
  requireNumber(joint.friction, "friction", joint.friction >= 0 && std::isfinite(joint.friction),
                "a number >= 0");
  requireNumber(joint.armature, "armature", joint.armature >= 0 && std::isfinite(joint.armature),
                "a number >= 0");
  requireNumber(joint.stiffness, "stiffness", joint.stiffness >= 0 && std::isfinite(joint.stiffness),
                "a number >= 0");
  requireNumber(joint.mimicRatio, "ratio", std::isfinite(joint.mimicRatio), "a finite number");
  requireNumber(joint.mimicOffset, "offset", std::isfinite(joint.mimicOffset), "a finite number");
  const auto checkCount = [&](const Eigen::VectorXd& values, const char* name) {
    if (values.size() != 0 && values.size() != n) {
      fail(joint.where, fmt::format("{}: {}", what, name), fmt::format("{} numbers", values.size()),
           fmt::format("{}", n));
    }
    if (values.hasNaN()) fail(joint.where, fmt::format("{}: {}", what, name), "nan", "numbers");
  };
  checkCount(joint.q0, "initial coordinates");
  checkCount(joint.lower, "lower limits");
  checkCount(joint.upper, "upper limits");
  checkCount(joint.springReference, "reference of the spring");
  if (!joint.q0.allFinite()) fail(joint.where, what + ": initial coordinates", "inf", "finite numbers");
  if (!joint.springReference.allFinite())
    fail(joint.where, what + ": reference of the spring", "inf", "finite numbers");
  for (Eigen::Index i = 0; i < std::min(joint.lower.size(), joint.upper.size()); ++i) {
    if (joint.lower[i] > joint.upper[i])
      fail(joint.where, what + ": limits", fmt::format("{} > {}", joint.lower[i], joint.upper[i]),
           "lower <= upper");
  }
}

Eigen::VectorXd springReferenceOf(const JointSpec& spec) {
  Eigen::VectorXd q = spec.springReference;
  if (q.size() == 0) return jointCoordinates(spec.type, spec.axis, Pose{});
  if (positionCount(spec.type) == velocityCount(spec.type)) return q;
  if (!(q.tail<4>().norm() > 1e-9))
    fail(spec.where, fmt::format("joint '{}': reference of the spring", spec.name),
         "a quaternion of length zero", "another one");
  q.tail<4>().normalize();
  return q;
}

Joint makeJoint(const JointSpec& spec, BodyId parent, BodyId child) {
  Joint joint;
  joint.name = spec.name;
  joint.type = spec.type;
  joint.parent = parent;
  joint.child = child;
  joint.X_PF = spec.X_PF;
  joint.X_MC = spec.X_MC;
  joint.axis = spec.axis.normalized();
  joint.pitch = spec.pitch;
  joint.maxVelocity = spec.maxVelocity;
  joint.maxEffort = spec.maxEffort;
  joint.damping = spec.damping;
  joint.friction = spec.friction;
  joint.armature = spec.armature;
  joint.stiffness = spec.stiffness;
  joint.nq = positionCount(spec.type);
  joint.nv = velocityCount(spec.type);
  joint.springReference = springReferenceOf(spec);
  const Pose X_CM = spec.X_MC.inverse();
  const auto freedoms = freedomsOf(movements(spec.type, joint.axis, spec.pitch));
  std::transform(freedoms.begin(), freedoms.begin() + joint.nv, joint.freedoms.begin(),
                 [&](const DegreeOfFreedom& f) {
                   return seenThrough(f.frame == DegreeOfFreedom::Frame::kParent ? spec.X_PF : X_CM, f);
                 });
  return joint;
}

void addSubtreeMasses(std::vector<Body>& bodies) {
  for (auto body = bodies.rbegin(); body != bodies.rend(); ++body) {
    body->subtreeMass += body->mass;
    if (body + 1 != bodies.rend())
      bodies[static_cast<std::size_t>(body->parent)].subtreeMass += body->subtreeMass;
  }
}

void append(Eigen::VectorXd& all, const Eigen::VectorXd& more) {
  all.conservativeResize(all.size() + more.size());
  all.tail(more.size()) = more;
}

// Start, limits and number of all coordinates; sets the indices of the joints that have their own.
struct Coordinates {
  Eigen::VectorXd q0, lower, upper;
  int nv = 0;
};

// The nq limits of a joint on one side: those of the spec, or `none` for each.
Eigen::VectorXd limitsOf(const Eigen::VectorXd& given, int nq, double none) {
  return given.size() > 0 ? given : Eigen::VectorXd::Constant(nq, none);
}

Coordinates indexCoordinates(std::vector<Joint>& joints, const std::vector<const JointSpec*>& specs) {
  Coordinates all;
  for (std::size_t j = 0; j < specs.size(); ++j) {
    const JointSpec& spec = *specs[j];
    if (!spec.mimic.empty()) continue;
    Joint& joint = joints[j];
    joint.qIndex = static_cast<int>(all.q0.size());
    joint.vIndex = all.nv;
    all.nv += joint.nv;
    append(all.q0, spec.start());
    append(all.lower, limitsOf(spec.lower, joint.nq, -kUnlimited));
    append(all.upper, limitsOf(spec.upper, joint.nq, kUnlimited));
  }
  return all;
}

// Joints with one coordinate follow one another at any ratio. Those with several follow only their own
// type, without ratio or offset.
bool canFollow(const JointSpec& follower, const JointSpec& target) {
  if (!target.mimic.empty()) return false;
  if (positionCount(follower.type) == 1 && positionCount(target.type) == 1) return true;
  return follower.type == target.type && follower.mimicRatio == 1 && follower.mimicOffset == 0;
}

// Narrows the limits of the followed coordinate such that the limits of the follower hold, too.
void narrowLimits(const JointSpec& spec, const Joint& joint, Coordinates& all) {
  if (joint.ratio == 0) return;  // it stands still
  const auto followed = [&](const Eigen::VectorXd& own) {
    return Eigen::VectorXd((own.array() - joint.offset) / joint.ratio);
  };
  Eigen::VectorXd lower = followed(limitsOf(spec.lower, joint.nq, -kUnlimited));
  Eigen::VectorXd upper = followed(limitsOf(spec.upper, joint.nq, kUnlimited));
  if (joint.ratio < 0) lower.swap(upper);
  for (int i = 0; i < joint.nq; ++i) {
    double& least = all.lower[joint.qIndex + i];
    double& most = all.upper[joint.qIndex + i];
    least = std::max(least, lower[i]);
    most = std::min(most, upper[i]);
    if (least <= most) continue;
    fail(spec.where, fmt::format("joint '{}': limits", spec.name),
         fmt::format("joint '{}' has no position left: {:.6g} > {:.6g}", spec.mimic, least, most),
         "limits that both joints can satisfy");
  }
}

// Gives each joint that mimics the indices of its target.
void shareCoordinates(std::vector<Joint>& joints, const std::vector<const JointSpec*>& specs,
                      Coordinates& all) {
  for (std::size_t j = 0; j < specs.size(); ++j) {
    const JointSpec& spec = *specs[j];
    if (spec.mimic.empty()) continue;
    const auto target = std::find_if(specs.begin(), specs.end(),
                                     [&](const JointSpec* other) { return other->name == spec.mimic; });
    if (target == specs.end() || !canFollow(spec, **target)) {
      std::vector<std::string> known;
      for (const JointSpec* other : specs)
        if (other != &spec && canFollow(spec, *other)) known.push_back(other->name);
      fail(spec.where, fmt::format("joint '{}': mimic", spec.name), fmt::format("'{}'", spec.mimic),
           "a joint that mimics no other, with one coordinate like this one, or of the same type and with "
           "ratio "
           "1 and offset 0",
           nearestNames(spec.mimic, known));
    }
    const Joint& followed = joints[static_cast<std::size_t>(target - specs.begin())];
    Joint& joint = joints[j];
    joint.mimics = joint.nq > 0;  // a rigid joint has no coordinate to share
    joint.qIndex = followed.qIndex;
    joint.vIndex = followed.vIndex;
    joint.ratio = spec.mimicRatio;
    joint.offset = spec.mimicOffset;
    for (DegreeOfFreedom& freedom : joint.freedoms) {
      freedom.angular *= spec.mimicRatio;
      freedom.linear *= spec.mimicRatio;
    }
    narrowLimits(spec, joint, all);
  }
}

// What the armatures add to the diagonal of the mass matrix.
Eigen::VectorXd armatureOf(const std::vector<Joint>& joints, int nv) {
  Eigen::VectorXd armature = Eigen::VectorXd::Zero(nv);
  for (const Joint& joint : joints)
    armature.segment(joint.vIndex, joint.nv).array() += joint.ratio * joint.ratio * joint.armature;
  return armature;
}

using BodyNames = std::unordered_map<std::string, BodyId>;

// Throws Error if no body has the name.
BodyId bodyNamed(const std::string& name, const BodyNames& bodyByName, const SourceLocation& where,
                 const char* owner) {
  if (name == kWorldName) return kWorld;
  if (const auto found = bodyByName.find(name); found != bodyByName.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [other, body] : bodyByName) known.push_back(other);
  std::sort(known.begin(), known.end());
  fail(where, fmt::format("{}: unknown body", owner), fmt::format("'{}'", name), "the name of a body",
       nearestNames(name, known));
}

// Throws Error for unknown names, and if both bodies of a pair are the same.
PairChoice resolved(const CollisionChoice& choice, const BodyNames& bodyByName) {
  constexpr const char* kOwner = "collision settings";
  PairChoice pair{.a = bodyNamed(choice.a, bodyByName, choice.where, kOwner),
                  .mayCollide = choice.mayCollide,
                  .reason = choice.reason};
  if (choice.b.empty()) return pair;
  pair.b = bodyNamed(choice.b, bodyByName, choice.where, kOwner);
  if (*pair.b == pair.a)
    fail(choice.where, "collision settings: a pair", fmt::format("'{}' twice", choice.a), "two bodies");
  return pair;
}

// The same.
Pin resolved(const PinSpec& pin, const BodyNames& bodyByName) {
  const Pin found{.a = bodyNamed(pin.a, bodyByName, pin.where, "pin"),
                  .b = bodyNamed(pin.b, bodyByName, pin.where, "pin"),
                  .p_AP = pin.p_AP,
                  .p_BQ = pin.p_BQ};
  if (found.a == found.b) fail(pin.where, "pin", fmt::format("'{}' twice", pin.a), "two bodies");
  if (!pin.p_AP.allFinite() || !pin.p_BQ.allFinite())
    fail(pin.where, "pin: point", "a number that is not finite", "finite numbers");
  return found;
}

// Joints that mimic have no coordinates of their own: those that a posture gives them are left out.
NamedPosture resolved(const PostureSpec& posture, const std::vector<Joint>& joints,
                      const Eigen::VectorXd& start) {
  NamedPosture found{posture.name, start};
  for (const auto& [name, coordinates] : posture.joints) {
    const auto joint = std::ranges::find(joints, name, &Joint::name);
    const std::string owner = fmt::format("posture '{}'", posture.name);
    if (joint == joints.end())
      fail(posture.where, owner + ": unknown joint", fmt::format("'{}'", name), "the name of a joint");
    if (coordinates.size() != joint->nq || !coordinates.allFinite())
      fail(posture.where, fmt::format("{}: joint '{}'", owner, name),
           fmt::format("{} numbers", coordinates.size()), fmt::format("{} finite numbers", joint->nq));
    if (joint->mimics) continue;
    found.q.segment(joint->qIndex, joint->nq) = coordinates;
    if (joint->nq == joint->nv) continue;
    auto turn = found.q.segment<4>(joint->qIndex + joint->nq - 4);
    if (!(turn.norm() > 1e-9))
      fail(posture.where, fmt::format("{}: joint '{}'", owner, name), "a quaternion of length zero",
           "another one");
    turn.normalize();
  }
  return found;
}

}  // namespace

Model compile(const SceneSpec& spec) {
  std::for_each(spec.bodies.begin(), spec.bodies.end(), checkBody);
  std::for_each(spec.joints.begin(), spec.joints.end(), checkJoint);
  const Tree tree = TreeBuilder(spec).build();

  Model model;
  model.name_ = spec.name;
  model.bodies_.push_back(Body{.name = kWorldName});
  const auto addShape = [&](const ShapeSpec& shape, BodyId body) {
    checkShape(shape);
    model.shapes_.push_back({.name = shape.name,
                             .body = body,
                             .X_BS = shape.X_BS,
                             .shape = shape.shape,
                             .color = shape.color,
                             .contact = shape.contact && !shape.meshMissing,
                             .visible = shape.visible,
                             .mask = shape.mask,
                             .ground = shape.ground});
  };
  for (const ShapeSpec& shape : spec.worldShapes) addShape(shape, kWorld);

  std::vector<const JointSpec*> jointSpecs;
  std::vector<BodyId> idOfSpec(spec.bodies.size());
  for (const int index : tree.bodyOrder) {
    const BodySpec& bodySpec = spec.bodies[static_cast<std::size_t>(index)];
    const BodyId id{static_cast<int>(model.bodies_.size())};
    idOfSpec[static_cast<std::size_t>(index)] = id;
    Body body{.name = bodySpec.name,
              .X_PB = bodySpec.X_WB,
              .mass = bodySpec.mass,
              .p_BBcm = bodySpec.p_BBcm,
              .buoyancy = bodySpec.buoyancy,
              .kind = bodySpec.kind};
    body.I_BBcm_B = bodySpec.inertia.value_or(kInertiaPerMass * bodySpec.mass * Eigen::Matrix3d::Identity());
    if (const int j = tree.incoming[static_cast<std::size_t>(index)]; j >= 0) {
      const JointSpec& jointSpec = spec.joints[static_cast<std::size_t>(j)];
      if (jointSpec.parent != kWorldName)
        body.parent = idOfSpec[static_cast<std::size_t>(tree.firstBodyByName.at(jointSpec.parent))];
      body.joint = JointId{static_cast<int>(model.joints_.size())};
      body.X_PB = Pose{};
      model.joints_.push_back(makeJoint(jointSpec, body.parent, id));
      jointSpecs.push_back(&jointSpec);
    }
    for (const ShapeSpec& shape : bodySpec.shapes) addShape(shape, id);
    model.bodies_.push_back(std::move(body));
  }

  addSubtreeMasses(model.bodies_);
  model.mass_ = model.bodies_.front().subtreeMass;
  Coordinates coordinates = indexCoordinates(model.joints_, jointSpecs);
  shareCoordinates(model.joints_, jointSpecs, coordinates);
  model.motionSteps_ = internal::motionSteps(model);
  model.links_ = internal::links(model);
  model.q0_ = std::move(coordinates.q0);
  model.lower_ = std::move(coordinates.lower);
  model.upper_ = std::move(coordinates.upper);
  model.nv_ = coordinates.nv;
  model.armature_ = armatureOf(model.joints_, model.nv_);
  model.hasSprings_ = std::ranges::any_of(
      model.joints_, [](const Joint& joint) { return joint.nv > 0 && joint.stiffness > 0; });
  model.hasBuoyancy_ = std::ranges::any_of(
      model.bodies_, [](const Body& body) { return body.buoyancy != 0 && body.mass > 0; });
  for (const auto& [name, index] : tree.firstBodyByName)
    model.bodyByName_.emplace(name, idOfSpec[static_cast<std::size_t>(index)]);
  model.fileOrder_ = std::move(idOfSpec);
  model.collisionRule_ = spec.collisionRule;
  for (const CollisionChoice& choice : spec.collisionChoices)
    model.collisionChoices_.push_back(resolved(choice, model.bodyByName_));
  for (const PinSpec& pin : spec.pins) model.pins_.push_back(resolved(pin, model.bodyByName_));
  for (const PostureSpec& posture : spec.postures)
    model.postures_.push_back(resolved(posture, model.joints_, model.q0_));
  return model;
}

const Eigen::VectorXd& Model::posture(std::string_view name) const {
  const auto found = std::ranges::find(postures_, name, &NamedPosture::name);
  if (found != postures_.end()) return found->q;
  std::vector<std::string> names;
  for (const NamedPosture& one : postures_) names.push_back(one.name);
  throw Error({.what = fmt::format("scene '{}' has no posture '{}'", name_, name),
               .wanted = names.empty() ? "" : join(names, ", "),
               .nearest = nearestNames(name, names)});
}

BodyId Model::body(std::string_view name) const {
  if (name == kWorldName) return kWorld;
  if (const auto found = bodyByName_.find(std::string(name)); found != bodyByName_.end())
    return found->second;
  std::vector<std::string> known;
  for (const ModelShape& shape : shapes_) {
    if (!shape.name.empty() && shape.name == name) return shape.body;
    known.push_back(shape.name);
  }
  for (const Body& body : bodies_) known.push_back(body.name);
  throw Error({.what = fmt::format("scene '{}' has no body '{}'", name_, name),
               .nearest = nearestNames(name, known)});
}

}  // namespace rex
