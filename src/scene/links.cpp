#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Geometry>

#include "geometry/rotation.h"
#include "scene/links_internal.h"

namespace rex::internal {
namespace {

using StepKind = MotionStep::Kind;
using Matrix34 = Eigen::Matrix<double, 3, 4>;

// The movement between two fixed frames: X = X_before * movement * X_after.
void setMotion(const JointMovement& movement, const Pose& X_before, const Pose& X_after, MotionStep& step) {
  const auto set = [](double* numbers, const Eigen::Matrix3d& R, const Eigen::Vector3d& p) {
    Eigen::Map<Matrix34>{numbers} << R, p;
  };
  const Eigen::Vector3d& a = movement.axis;
  const Pose X = X_before * X_after;
  switch (movement.kind) {
    case StepKind::kFixed:
      set(step.constant, X.R, X.p);
      return;
    case StepKind::kSlider:
      set(step.constant, X.R, X.p);
      set(step.first, Eigen::Matrix3d::Zero(), X_before.R * a);
      return;
    case StepKind::kQuaternion:
      set(step.constant, X_before.R, X_before.p);
      set(step.first, X_after.R, X_after.p);
      return;
    case StepKind::kHinge:
      // Rodrigues' formula turns by a a^T + cos x (1 - a a^T) + sin x [a]x.
      const Eigen::Matrix3d along = X_before.R * a * a.transpose();
      const Eigen::Matrix3d across = X_before.R - along, around = X_before.R * skew(a);
      set(step.constant, along * X_after.R, along * X_after.p + X_before.p);
      set(step.first, across * X_after.R, across * X_after.p);
      set(step.second, around * X_after.R, around * X_after.p);
      return;
  }
}

void append(const Joint& joint, std::vector<MotionStep>& steps) {
  const int child = static_cast<int>(joint.child);
  const JointMovements all = movements(joint);
  for (const JointMovement& movement : all) {
    const bool isFirst = &movement == all.begin(), isLast = &movement + 1 == all.end();
    steps.push_back({.kind = movement.kind,
                     .from = isFirst ? static_cast<int>(joint.parent) : child,
                     .to = child,
                     .qIndex = joint.qIndex + movement.coordinate,
                     .ratio = joint.ratio,
                     .offset = joint.offset});
    setMotion(movement, isFirst ? joint.X_PF : Pose{}, isLast ? joint.X_MC : Pose{}, steps.back());
  }
}

}  // namespace

std::vector<MotionStep> motionSteps(const Model& model) {
  std::vector<MotionStep> steps;
  for (int i = 1; i < static_cast<int>(model.bodies().size()); ++i) {
    const Body& body = model[BodyId{i}];
    if (body.joint != kNoJoint) {
      append(model[body.joint], steps);
      continue;
    }
    steps.push_back({.from = static_cast<int>(body.parent), .to = i});
    setMotion({StepKind::kFixed}, body.X_PB, Pose{}, steps.back());
  }
  return steps;
}

namespace {

using Kind = Link::Kind;

// A frame fixed in a link, or in the world.
struct Place {
  int link = Link::kNoParent;
  Pose X_LA{};
};

// A frame with that z axis; the axes of joints are aligned with z.
Pose frameAlong(const Eigen::Vector3d& z) {
  const Eigen::Vector3d x = z.unitOrthogonal();
  Pose X;
  X.R << x, z.cross(x), z;
  return X;
}

// The kind of link for a movement; a turn with a rise is a screw. Empty for what is not a link of its own.
std::optional<Kind> kindOf(const JointMovement& movement, bool hasRise) {
  switch (movement.kind) {
    case JointMovement::Kind::kFixed:
      return {};
    case JointMovement::Kind::kHinge:
      return hasRise ? Kind::kScrew : Kind::kHinge;
    case JointMovement::Kind::kSlider:
      return movement.isRise ? std::nullopt : std::optional(Kind::kSlider);
    case JointMovement::Kind::kQuaternion:
      return Kind::kQuaternion;
  }
  return {};
}

// Appends the links of a joint. Returns where its child is attached.
Place append(const Joint& joint, const Place& parent, std::vector<Link>& links) {
  Place at{parent.link, parent.X_LA * joint.X_PF};
  const JointMovements all = movements(joint);
  for (const JointMovement& movement : all) {
    const bool hasRise = &movement + 1 != all.end() && (&movement + 1)->isRise;
    const std::optional<Kind> kind = kindOf(movement, hasRise);
    if (!kind) continue;
    Link link{.kind = *kind,
              .parent = at.link,
              .body = static_cast<int>(joint.child),
              .qIndex = joint.qIndex + movement.coordinate,
              .vIndex = joint.vIndex + movement.coordinate,
              .ratio = joint.ratio,
              .offset = joint.offset};
    if (link.kind == Kind::kScrew) link.pitch = joint.pitch / (2 * std::numbers::pi);
    link.armature = joint.ratio * joint.ratio * joint.armature;
    const Pose X_AL = link.kind == Kind::kQuaternion ? Pose{} : frameAlong(movement.axis);
    const Pose X_PL = at.X_LA * X_AL;
    Eigen::Map<Eigen::Matrix<double, 3, 4>>{link.X_PL} << X_PL.R, X_PL.p;
    at = {static_cast<int>(links.size()), X_AL.inverse()};
    links.push_back(link);
  }
  return {at.link, at.X_LA * joint.X_MC};
}

void addMass(const Body& body, const Pose& X_LB, Link& link) {
  const Eigen::Vector3d c = X_LB * body.p_BBcm;
  const Eigen::Matrix3d C = skew(c);
  const Eigen::Matrix3d I = X_LB.R * body.I_BBcm_B * X_LB.R.transpose() - body.mass * C * C;
  link.mass += body.mass;
  Eigen::Map<Eigen::Vector3d>{link.moment} += body.mass * c;
  const double sixOfI[] = {I(0, 0), I(0, 1), I(0, 2), I(1, 1), I(1, 2), I(2, 2)};
  for (int i = 0; i < 6; ++i) link.inertia[i] += sixOfI[i];
}

// Bounds of a subtree: its mass, and the trace of its inertia about the origin of its root, if the distances
// from one origin to the next add up. Roots of the trace are norms of how far all mass is away, times
// sqrt(2), so they keep to the triangle inequality.
struct Reach {
  double mass = 0, inertia = 0;
  void add(const Reach& below, double distance) {
    const double root = std::sqrt(below.inertia) + distance * std::sqrt(2 * below.mass);
    mass += below.mass;
    inertia += root * root;
  }
};

void setLargestInertias(std::vector<Link>& links) {
  std::vector<Reach> reaches(links.size());
  for (std::size_t i = links.size(); i-- > 0;) {
    Link& link = links[i];
    Reach& reach = reaches[i];
    const double* I = link.inertia;
    reach.add({link.mass, I[0] + I[3] + I[5]}, 0);
    const double turning = reach.inertia, moving = reach.mass;
    link.largestInertia = link.kind == Kind::kSlider ? moving : turning + link.pitch * link.pitch * moving;
    link.largestInertia += link.armature;
    if (link.parent == Link::kNoParent) continue;
    const Eigen::Vector3d p_PL = Eigen::Map<const Eigen::Vector3d>(link.X_PL + 9);
    reaches[static_cast<std::size_t>(link.parent)].add(reach, p_PL.norm());
  }
}

}  // namespace

std::vector<Link> links(const Model& model) {
  std::vector<Link> links;
  std::vector<Place> places(model.bodies().size());
  for (std::size_t i = 1; i < places.size(); ++i) {
    const Body& body = model.bodies()[i];
    const Place& parent = places[static_cast<std::size_t>(body.parent)];
    if (body.joint == kNoJoint) {
      places[i] = {parent.link, parent.X_LA * body.X_PB};
    } else {
      places[i] = append(model[body.joint], parent, links);
    }
    if (places[i].link != Link::kNoParent)
      addMass(body, places[i].X_LA, links[static_cast<std::size_t>(places[i].link)]);
  }
  setLargestInertias(links);
  return links;
}

}  // namespace rex::internal
