#include "scene/joint_movements.h"

#include <numbers>

namespace rex {

std::vector<JointMovement> movements(const Joint& joint) {
  using Kind = MotionStep::Kind;
  const auto turn = [](int coordinate, const Eigen::Vector3d& axis) {
    return JointMovement{Kind::kHinge, coordinate, axis};
  };
  const auto move = [](int coordinate, const Eigen::Vector3d& way) {
    return JointMovement{Kind::kSlider, coordinate, way};
  };
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                        z = Eigen::Vector3d::UnitZ();
  switch (joint.type) {
    case JointType::kRigid:
      return {{Kind::kFixed}};
    case JointType::kHinge:
      return {turn(0, joint.axis)};
    case JointType::kSlider:
      return {move(0, joint.axis)};
    case JointType::kScrew:
      return {turn(0, joint.axis), move(0, joint.pitch / (2 * std::numbers::pi) * joint.axis)};
    case JointType::kCylindrical:
      return {turn(0, joint.axis), move(1, joint.axis)};
    case JointType::kPlanarXY:
      return {move(0, x), move(1, y)};
    case JointType::kTranslation3:
      return {move(0, x), move(1, y), move(2, z)};
    case JointType::kPlanarXYPhi:
      return {move(0, x), move(1, y), turn(2, z)};
    case JointType::kPlanarPhiXY:
      return {turn(0, z), move(1, x), move(2, y)};
    case JointType::kUniversal:
      return {turn(0, x), turn(1, y)};
    case JointType::kBall:
      return {{Kind::kQuaternion}};
    case JointType::kFree:
      return {move(0, x), move(1, y), move(2, z), {Kind::kQuaternion, 3}};
  }
  return {};
}

}  // namespace rex
