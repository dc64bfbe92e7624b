#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include "collision/proximity.h"
#include "collision/rigid_parts_internal.h"
#include "kinematics/forward_kinematics.h"
#include "scene/model.h"
#include "scene/state.h"

namespace rex::internal {

/// All coordinates 0, all quaternions the identity.
[[nodiscard]] inline Eigen::VectorXd referencePosture(const Model& model) {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(model.nq());
  forEachQuaternion(model, [&](int iq, int) { q[iq] = 1; });
  return q;
}

namespace {

constexpr double kSamePlace = 1e-9;  // metres: origins of joints that count as one

std::size_t placeOf(BodyId body) { return static_cast<std::size_t>(body); }

// Finds the neighbours of parts.
class Neighbourhood {
 public:
  Neighbourhood(const Model& model, const RigidParts& parts)
      : model_(model),
        parts_(parts),
        poses_(forwardKinematics(model, referencePosture(model))),
        hasContact_(model.bodies().size()),
        isFrame_(model.bodies().size(), true) {
    for (std::size_t i = 0; i < isFrame_.size(); ++i)
      if (model.bodies()[i].mass > 0) isFrame_[placeOf(parts.part(BodyId{static_cast<int>(i)}))] = false;
    for (const ModelShape& shape : model.shapes()) {
      isFrame_[placeOf(parts.part(shape.body))] = false;
      if (shape.contact) hasContact_[placeOf(shape.body)] = true;
    }
  }

  // The next part towards the world from the one that `carrier` carries. Parts that are only a frame
  // between two joints at one position are skipped.
  std::optional<BodyId> above(BodyId carrier) const {
    for (;;) {
      const Joint& joint = model_[model_[carrier].joint];
      if (joint.type == JointType::kFree) return {};
      const BodyId part = parts_.part(joint.parent);
      if (part == kWorld) return fixedNeighbour(joint.parent);
      if (!isFrame_[placeOf(part)] || !areInOnePlace(model_[model_[part].joint], joint)) return part;
      carrier = part;
    }
  }

  // Bodies fixed in the world may be far apart: only the body that carries the joint counts, or the next
  // one towards the world that has a shape in contact.
  BodyId fixedNeighbour(BodyId body) const {
    while (!hasContact_[placeOf(body)] && body != kWorld && model_[body].parent != kWorld)
      body = model_[body].parent;
    return body;
  }

 private:
  bool areInOnePlace(const Joint& upper, const Joint& lower) const {
    const Eigen::Vector3d p_WM = poses_[upper.child] * upper.X_MC.inverse().p;
    const Eigen::Vector3d p_WF = poses_[lower.parent] * lower.X_PF.p;
    return (p_WM - p_WF).norm() <= kSamePlace;
  }

  const Model& model_;
  const RigidParts& parts_;
  BodyPoses poses_;
  std::vector<bool> hasContact_;  // of each body
  std::vector<bool> isFrame_;     // of each part: it has neither mass nor shapes
};

}  // namespace

bool isFixed(const Joint& joint) { return joint.nv == 0 || joint.ratio == 0; }

RigidParts::RigidParts(const Model& model)
    : parts_(model.bodies().size(), kWorld),
      freeJoints_(model.bodies().size(), kNoJoint),
      above_(model.bodies().size()) {
  for (std::size_t i = 1; i < parts_.size(); ++i) {
    const Body& body = model.bodies()[i];
    const bool hasJoint = body.joint != kNoJoint;
    const bool moves = hasJoint && !isFixed(model[body.joint]);
    parts_[i] = moves ? BodyId{static_cast<int>(i)} : part(body.parent);
    const bool isFree = hasJoint && model[body.joint].type == JointType::kFree;
    freeJoints_[i] = isFree ? body.joint : freeJoint(body.parent);
  }
  findNeighbours(model);
}

void RigidParts::findNeighbours(const Model& model) {
  const Neighbourhood neighbourhood(model, *this);
  for (std::size_t i = 1; i < parts_.size(); ++i)
    if (placeOf(parts_[i]) == i) above_[i] = neighbourhood.above(parts_[i]);
  const auto end = [&](BodyId body) {
    return part(body) == kWorld ? neighbourhood.fixedNeighbour(body) : part(body);
  };
  for (const Pin& pin : model.pins()) pinned_.emplace(std::minmax(end(pin.a), end(pin.b)));
}

bool RigidParts::arePinned(BodyId a, BodyId b) const {
  return pinned_.contains(std::minmax(node(a), node(b)));
}

bool RigidParts::areNeighbours(BodyId a, BodyId b) const {
  const auto hangsOn = [&](BodyId child, BodyId parent) {
    return part(child) != kWorld && above_[placeOf(part(child))] == node(parent);
  };
  return hangsOn(a, b) || hangsOn(b, a) || arePinned(a, b);
}

namespace {

using Eigen::Vector3d;

constexpr double kRounding = 1e-12;

double sizeOf(const Vector3d& angular, const Vector3d& linear) { return 1 + angular.norm() + linear.norm(); }

}  // namespace

CoupledMotion::CoupledMotion(const Model& model) : model_(model) {
  isCoupled_ = std::ranges::any_of(model.joints(), [](const Joint& joint) { return joint.mimics; });
  if (!isCoupled_) return;
  poses_ = forwardKinematics(model, referencePosture(model));
  for (const Joint& joint : model.joints()) addTwists(joint);
}

// Seen from the world, a joint at x moves by exp(twist 1 x1) exp(twist 2 x2) ..., because in the reference
// posture all of its coordinates are 0, or the offset of the joint.
void CoupledMotion::addTwists(const Joint& joint) {
  std::vector<Twist>& twists = twists_.emplace_back();
  for (int i = 0; i < joint.nv; ++i) {
    const DegreeOfFreedom& freedom = joint.freedoms[static_cast<std::size_t>(i)];
    const bool isOfParent = freedom.frame == DegreeOfFreedom::Frame::kParent;
    const Pose& X_WB = poses_[isOfParent ? joint.parent : joint.child];
    const Vector3d angular = X_WB.R * freedom.angular;
    const Twist twist{joint.qIndex + i, angular, X_WB.R * freedom.linear + X_WB.p.cross(angular),
                      joint.nq == joint.nv};
    if (!twist.isPlain || !isZero(twist)) twists.push_back(twist);
  }
}

bool CoupledMotion::isZero(const Twist& twist) {
  return twist.angular.norm() <= kRounding && twist.linear.norm() <= kRounding;
}

// Whether their Lie bracket is zero.
bool CoupledMotion::commute(const Twist& one, const Twist& other) {
  if (!one.isPlain || !other.isPlain) return false;
  const double small = kRounding * sizeOf(one.angular, one.linear) * sizeOf(other.angular, other.linear);
  return one.angular.cross(other.angular).norm() <= small &&
         (one.angular.cross(other.linear) - other.angular.cross(one.linear)).norm() <= small;
}

// X_AB = X_A X(twists) X_B with constants at both ends.
std::vector<CoupledMotion::Twist> CoupledMotion::twistsBetween(BodyId a, BodyId b) const {
  std::vector<Twist> upwards, downwards;
  const auto climb = [&](BodyId& body, std::vector<Twist>& way) {
    if (const JointId joint = model_[body].joint; joint != kNoJoint) {
      const std::vector<Twist>& own = twists_[static_cast<std::size_t>(joint)];
      way.insert(way.end(), own.rbegin(), own.rend());
    }
    body = model_[body].parent;
  };
  while (a != b) a > b ? climb(a, upwards) : climb(b, downwards);  // parents come before children
  for (Twist& twist : upwards) {
    twist.angular = -twist.angular;
    twist.linear = -twist.linear;
  }
  upwards.insert(upwards.end(), downwards.rbegin(), downwards.rend());
  return upwards;
}

// exp(A x) ... exp(B x) = exp((A + B) x) ... if B commutes with A and with everything between them.
bool CoupledMotion::mergeOnce(std::vector<Twist>& twists) {
  for (auto one = twists.begin(); one != twists.end(); ++one) {
    for (auto other = one + 1; other != twists.end(); ++other) {
      if (other->coordinate != one->coordinate) continue;
      if (!std::all_of(one, other, [&](const Twist& between) { return commute(*other, between); })) continue;
      const double size = std::max(sizeOf(one->angular, one->linear), sizeOf(other->angular, other->linear));
      one->angular += other->angular;
      one->linear += other->linear;
      twists.erase(other);
      if (one->angular.norm() <= kRounding * size && one->linear.norm() <= kRounding * size)
        twists.erase(one);
      return true;
    }
  }
  return false;
}

bool CoupledMotion::cancels(BodyId a, BodyId b) const {
  if (!isCoupled_) return false;
  std::vector<Twist> twists = twistsBetween(a, b);
  const auto isAlone = [&](const Twist& one) {
    return std::ranges::count(twists, one.coordinate, &Twist::coordinate) == 1;
  };
  if (std::ranges::any_of(twists, isAlone)) return false;
  while (mergeOnce(twists)) {
  }
  return twists.empty();
}

namespace {

using Eigen::Vector3d;

// A shape at its pose, and its axis-aligned bounding box.
struct Standing {
  int shape;
  BodyId body;
  Pose X_WS;
  Vector3d low, high;
};

std::vector<Standing> standing(const Model& model) {
  const BodyPoses poses = forwardKinematics(model, model.initialPositions());
  std::vector<Standing> all;
  for (std::size_t i = 0; i < model.shapes().size(); ++i) {
    const ModelShape& shape = model.shapes()[i];
    if (!takesPart(shape) || (usesMesh(shape.shape.type) && shape.shape.mesh.isEmpty())) continue;
    const Pose X_WS = poses[shape.body] * shape.X_BS;
    const Vector3d half = X_WS.R.cwiseAbs() * halfBounds(shape.shape);
    all.push_back({static_cast<int>(i), shape.body, X_WS, X_WS.p - half, X_WS.p + half});
  }
  return all;
}

// The axis along which the boxes are spread most, so that few of them overlap along it.
int widestAxis(const std::vector<Standing>& all) {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Standing& one : all) {
    low = low.cwiseMin(one.X_WS.p);
    high = high.cwiseMax(one.X_WS.p);
  }
  int axis = 0;
  if (!all.empty()) (high - low).maxCoeff(&axis);
  return axis;
}

// Where joints with limits are in the middle of them, and the others at home: 0, where many robots start, is
// at an end of the limits, or beyond, and folds them into themselves.
Eigen::VectorXd middlePositions(const Model& model) {
  Eigen::VectorXd q = model.initialPositions();
  for (Eigen::Index i = 0; i < q.size(); ++i)
    if (const double middle = (model.lowerLimits()[i] + model.upperLimits()[i]) / 2; std::isfinite(middle))
      q[i] = middle;
  return q;
}

}  // namespace

std::vector<HomeOverlap> homeOverlaps(
    const Model& model, double tolerance,
    const std::function<bool(const ModelShape&, const ModelShape&)>& isAsked) {
  const auto shapeOf = [&](const Standing& one) -> const ModelShape& {
    return model.shapes()[static_cast<std::size_t>(one.shape)];
  };
  std::vector<Standing> all = standing(model);
  const int axis = widestAxis(all);
  std::ranges::sort(all, {}, [&](const Standing& one) { return std::pair(one.low[axis], one.shape); });
  std::vector<HomeOverlap> found;
  for (auto a = all.begin(); a != all.end(); ++a) {
    for (auto b = a + 1; b != all.end() && b->low[axis] < a->high[axis]; ++b) {
      const bool isNear =
          (a->low.array() < b->high.array()).all() && (b->low.array() < a->high.array()).all();
      if (!isNear || a->body == b->body || !isAsked(shapeOf(*a), shapeOf(*b))) continue;
      const Standing& first = a->shape < b->shape ? *a : *b;
      const Standing& second = a->shape < b->shape ? *b : *a;
      const double depth =
          -proximity(shapeOf(first).shape, first.X_WS, shapeOf(second).shape, second.X_WS).distance;
      if (depth > tolerance) found.push_back({{first.shape, second.shape}, depth});
    }
  }
  const BodyPoses middle = forwardKinematics(model, middlePositions(model));
  std::erase_if(found, [&](const HomeOverlap& one) {
    const auto &a = model.shapes()[static_cast<std::size_t>(one.pair.a)],
               &b = model.shapes()[static_cast<std::size_t>(one.pair.b)];
    return !(proximity(a.shape, middle[a.body] * a.X_BS, b.shape, middle[b.body] * b.X_BS).distance <
             -tolerance);
  });
  std::ranges::sort(found, {}, [](const HomeOverlap& one) { return std::pair(one.pair.a, one.pair.b); });
  return found;
}

}  // namespace rex::internal
