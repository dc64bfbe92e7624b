#include "scene/joint_type.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "geometry/rotation.h"

namespace rex {
namespace {

using Kind = JointMovement::Kind;
using Reordered = JointReversal::Coordinate;

// What a movement turns about or moves along: an axis of F, the axis of the joint, or that axis scaled by
// the rise of a screw.
enum class Way { kX, kY, kZ, kAxis, kRise };

struct Step {
  Kind kind = Kind::kFixed;
  int coordinate = 0;
  Way way = Way::kX;
  const char* part = "";
};

constexpr Step turn(int coordinate, Way way, const char* part = "") {
  return {Kind::kHinge, coordinate, way, part};
}
constexpr Step move(int coordinate, Way way, const char* part = "") {
  return {Kind::kSlider, coordinate, way, part};
}
constexpr Step quaternion(int coordinate) { return {.kind = Kind::kQuaternion, .coordinate = coordinate}; }

/// All that is known about a joint type. Its translations are adjacent: no rotation comes between them.
struct Row {
  const char *name, *ors, *urdf = "";
  std::array<Step, 4> steps{};             ///< up to the first that is fixed
  std::optional<JointType> reversed{};     ///< as JointReversal says; empty: the same
  std::array<Reordered, 4> coordinates{};  ///< of JointReversal
  bool halfTurn = false;  ///< its X_FC is half a turn about x - y, which maps x to -y and y to -x
};

// The table of joint types. If one is missing, the compiler points here.
constexpr Row rowOf(JointType type) {
  using enum JointType;
  using enum Way;
  switch (type) {
    case kRigid:
      return {.name = "rigid", .ors = "rigid", .urdf = "fixed"};
    case kHinge:
      return {.name = "hinge", .ors = "hinge", .urdf = "revolute", .steps = {turn(0, kAxis)}};
    case kSlider:
      return {.name = "slider", .ors = "trans", .urdf = "prismatic", .steps = {move(0, kAxis)}};
    case kScrew:
      return {.name = "screw", .ors = "screw", .steps = {turn(0, kAxis), move(0, kRise, "_rise")}};
    case kCylindrical:
      return {.name = "cylindrical",
              .ors = "cylindrical",
              .steps = {turn(0, kAxis, "_turn"), move(1, kAxis, "_slide")}};
    case kPlanarXY:
      return {.name = "planarXY",
              .ors = "transXY",
              .steps = {move(0, kX, "_x"), move(1, kY, "_y")},
              .coordinates = {{{0, -1}, {1, -1}}}};
    case kTranslation3:
      return {.name = "translation3",
              .ors = "trans3",
              .steps = {move(0, kX, "_x"), move(1, kY, "_y"), move(2, kZ, "_z")},
              .coordinates = {{{0, -1}, {1, -1}, {2, -1}}}};
    case kPlanarXYPhi:
      return {.name = "planarXYPhi",
              .ors = "transXYPhi",
              .urdf = "planar",
              .steps = {move(0, kX, "_x"), move(1, kY, "_y"), turn(2, kZ, "_phi")},
              .reversed = kPlanarPhiXY,
              .coordinates = {{{2, -1}, {0, -1}, {1, -1}}}};
    case kPlanarPhiXY:
      return {.name = "planarPhiXY",
              .ors = "phiTransXY",
              .steps = {turn(0, kZ, "_phi"), move(1, kX, "_x"), move(2, kY, "_y")},
              .reversed = kPlanarXYPhi,
              .coordinates = {{{1, -1}, {2, -1}, {0, -1}}}};
    case kUniversal:
      return {.name = "universal",
              .ors = "universal",
              .steps = {turn(0, kX, "_x"), turn(1, kY, "_y")},
              .coordinates = {{{1, 1}, {0, 1}}},
              .halfTurn = true};
    case kBall:
      return {.name = "ball",
              .ors = "quatBall",
              .steps = {quaternion(0)},
              .coordinates = {{{0, 1}, {1, -1}, {2, -1}, {3, -1}}}};
    case kFree:
      return {.name = "free",
              .ors = "free",
              .urdf = "floating",
              .steps = {move(0, kX, "_x"), move(1, kY, "_y"), move(2, kZ, "_z"), quaternion(3)}};
  }
  return {};
}

Eigen::Vector3d directionOf(Way way, const Eigen::Vector3d& axis, double pitch) {
  switch (way) {
    case Way::kAxis:
      return axis;
    case Way::kRise:
      return pitch / (2 * std::numbers::pi) * axis;
    case Way::kX:
    case Way::kY:
    case Way::kZ:
      return Eigen::Vector3d::Unit(static_cast<int>(way));
  }
  return Eigen::Vector3d::Zero();
}

// The number of positions or of velocities, depending on how many a quaternion counts as.
int coordinateCount(JointType type, int ofQuaternion) {
  int count = 0;
  for (const Step& step : rowOf(type).steps)
    if (step.kind != Kind::kFixed)
      count = std::max(count, step.coordinate + (step.kind == Kind::kQuaternion ? ofQuaternion : 1));
  return count;
}

// Signed angle, in (-pi, pi], of the part of R that turns about the unit vector a.
double angleAbout(const Eigen::Vector3d& a, const Eigen::Matrix3d& R) {
  const Quaternion q = quaternionFromRotation(R);
  return wrapAngle(2 * std::atan2(a.dot(q.tail<3>()), q[0]));
}

// Sets the angle of one turn, or the angles of two turns about perpendicular axes a and b.
void setAngles(const JointMovements& all, const Eigen::Matrix3d& R, Eigen::VectorXd& q) {
  const JointMovement *first = nullptr, *second = nullptr;
  for (const JointMovement& one : all)
    if (one.kind == Kind::kHinge) (first == nullptr ? first : second) = &one;
  if (first == nullptr) return;
  const Eigen::Vector3d& a = first->axis;
  if (second == nullptr) {
    q[first->coordinate] = angleAbout(a, R);
    return;
  }
  const Eigen::Vector3d &b = second->axis, normal = a.cross(b);
  q[first->coordinate] = std::atan2(normal.dot(R * b), b.dot(R * b));
  q[second->coordinate] = std::atan2(a.dot(R * normal), a.dot(R * a));
}

}  // namespace

std::string_view toString(JointType type) { return rowOf(type).name; }

std::string_view orsWord(JointType type) { return rowOf(type).ors; }

std::string_view urdfWord(JointType type) { return rowOf(type).urdf; }

int positionCount(JointType type) { return coordinateCount(type, 4); }

int velocityCount(JointType type) { return coordinateCount(type, 3); }

bool hasAxis(JointType type) {
  const Step first = rowOf(type).steps[0];
  return first.kind != Kind::kFixed && first.way == Way::kAxis;
}

JointMovements movements(JointType type, const Eigen::Vector3d& axis, double pitch) {
  JointMovements all;
  for (const Step& step : rowOf(type).steps)
    if (step.kind != Kind::kFixed)
      all.append({.kind = step.kind,
                  .coordinate = step.coordinate,
                  .axis = directionOf(step.way, axis, pitch),
                  .isRise = step.way == Way::kRise,
                  .part = step.part});
  if (all.size() == 0) all.append({});
  return all;
}

JointReversal reversalOf(JointType type) {
  const Row row = rowOf(type);
  JointReversal reversal{.type = row.reversed.value_or(type), .coordinates = row.coordinates};
  if (row.halfTurn) reversal.X_FC = rotation(std::numbers::pi, {1, -1, 0});
  if (row.coordinates[0].sign != 0) reversal.count = positionCount(type);
  return reversal;
}

Pose jointMotion(JointType type, const Eigen::Vector3d& axis, double pitch, const double* q) {
  Pose X_FM;
  for (const JointMovement& one : movements(type, axis.normalized(), pitch)) {
    const double* its = q + one.coordinate;
    switch (one.kind) {
      case Kind::kFixed:
        break;
      case Kind::kHinge:
        X_FM.R *= rotationAboutAxis(*its, one.axis);
        break;
      case Kind::kSlider:
        X_FM.p += X_FM.R * (*its * one.axis);
        break;
      case Kind::kQuaternion:
        X_FM.R *= rotationFromQuaternion(Quaternion(its));
        break;
    }
  }
  return X_FM;
}

Eigen::VectorXd jointCoordinates(JointType type, const Eigen::Vector3d& axis, const Pose& X_FM) {
  Eigen::VectorXd q(positionCount(type));
  const JointMovements all = movements(type, axis.normalized(), 0);
  setAngles(all, X_FM.R, q);
  Eigen::Matrix3d R_before = Eigen::Matrix3d::Identity();
  for (const JointMovement& one : all) {
    if (one.kind == Kind::kQuaternion) q.segment<4>(one.coordinate) = quaternionFromRotation(X_FM.R);
    if (one.kind == Kind::kHinge) R_before *= rotationAboutAxis(q[one.coordinate], one.axis);
    if (one.kind == Kind::kSlider && !one.isRise)
      q[one.coordinate] = one.axis.dot(R_before.transpose() * X_FM.p);
  }
  return q;
}

}  // namespace rex
