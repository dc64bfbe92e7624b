#include <fmt/format.h>

#include "base/error.h"
#include "physics/elementary_moves_internal.h"

namespace rex::internal {

std::vector<ElementaryMove> elementaryMoves(const Joint& joint) {
  const auto turn = [](const Eigen::Vector3d& axis) {
    return ElementaryMove{ElementaryMove::Kind::kTurn, axis};
  };
  const auto slide = [](const Eigen::Vector3d& axis) {
    return ElementaryMove{ElementaryMove::Kind::kSlide, axis};
  };
  const ElementaryMove ball{ElementaryMove::Kind::kBall};
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                        z = Eigen::Vector3d::UnitZ();
  switch (joint.type) {
    case JointType::kRigid:
      return {ElementaryMove{}};
    case JointType::kHinge:
      return {turn(joint.axis)};
    case JointType::kSlider:
      return {slide(joint.axis)};
    case JointType::kCylindrical:
      return {turn(joint.axis), slide(joint.axis)};
    case JointType::kPlanarXY:
      return {slide(x), slide(y)};
    case JointType::kTranslation3:
      return {slide(x), slide(y), slide(z)};
    case JointType::kPlanarXYPhi:
      return {slide(x), slide(y), turn(z)};
    case JointType::kPlanarPhiXY:
      return {turn(z), slide(x), slide(y)};
    case JointType::kUniversal:
      return {turn(x), turn(y)};
    case JointType::kBall:
      return {ball};
    case JointType::kFree:
      return {slide(x), slide(y), slide(z), ball};
    case JointType::kScrew:
      break;
  }
  throw Error({.what = fmt::format("physics: joint '{}'", joint.name),
               .found = "a screw",
               .wanted = "a hinge, a slider or a cylindrical joint: screws move in dynamics only"});
}

}  // namespace rex::internal
