#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scene/mjcf_parts_internal.h"

namespace rex::mjcf {
namespace {

const std::vector<std::string> kJointWords = {"hinge", "slide", "ball", "free"};
constexpr JointType kTypesOfMjcf[] = {JointType::kHinge, JointType::kSlider, JointType::kBall,
                                      JointType::kFree};

Eigen::Vector3d jointAxis(const Styled& styled) {
  const Tag& giver = styled.giver("axis");
  if (!giver.has("axis")) return Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d axis = giver.numbers("axis", 3);
  const double length = axis.stableNorm();
  if (!(length > 1e-100 && length < 1e100))
    giver.failAt("axis", xml::quoted(giver.text("axis")), "a direction");
  return axis / length;
}

double coordinate(const JointSpec& joint, double given, const Compiler& compiler) {
  return joint.type == JointType::kHinge ? compiler.angle(given) : given;
}

void readRange(const Styled& styled, const Compiler& compiler, JointSpec& joint) {
  if (!isLimited(styled, "limited", "range", compiler)) return;
  const Tag& giver = styled.giver("range");
  if (positionCount(joint.type) != 1) {
    giver.ignore(
        fmt::format("the range of a <joint> of type '{}'", joint.type == JointType::kBall ? "ball" : "free"));
    return;
  }
  const Eigen::VectorXd range = giver.numbers("range", 2);
  if (range[0] > range[1]) {
    giver.forgiveAt("range", xml::quoted(giver.text("range")), "a lower limit that is not above the upper",
                    "the joint has no range");
    return;
  }
  joint.lower = Eigen::VectorXd::Constant(1, coordinate(joint, range[0], compiler));
  joint.upper = Eigen::VectorXd::Constant(1, coordinate(joint, range[1], compiler));
}

void readForceRange(const Styled& styled, const Compiler& compiler, JointSpec& joint) {
  if (positionCount(joint.type) != 1) return;
  if (!isLimited(styled, "actuatorfrclimited", "actuatorfrcrange", compiler)) return;
  const Eigen::VectorXd range = styled.giver("actuatorfrcrange").numbers("actuatorfrcrange", 2);
  joint.maxEffort = range.cwiseAbs().maxCoeff();
}

double slowing(const Styled& styled, const char* attribute) {
  return styled.giver(attribute).notNegative(attribute, 0);
}

}  // namespace

const Known& knownOfJoint() {
  static const Known kKnown = {
      {"name", "class", "type", "pos", "axis", "range", "limited", "ref", "damping", "frictionloss",
       "actuatorfrcrange", "actuatorfrclimited"},
      {},
      {},
      {"group", "springdamper", "stiffness", "springref", "armature", "margin", "solreflimit", "solimplimit",
       "solreffriction", "solimpfriction", "user", "actuatorgravcomp"}};
  return kKnown;
}

JointSpec readBodyJoint(const Styled& styled, const Compiler& compiler) {
  const Tag& tag = styled.own();
  JointSpec joint;
  if (tag.has("name")) joint.name = tag.nameIn("name");
  joint.where = tag.where();
  const Tag& typed = styled.giver("type");
  joint.type = kTypesOfMjcf[typed.has("type") ? choice(typed, "type", kJointWords) : 0];
  joint.damping = slowing(styled, "damping");
  joint.friction = slowing(styled, "frictionloss");
  readRange(styled, compiler, joint);
  if (joint.type == JointType::kFree) return joint;
  const Tag& placed = styled.giver("pos");
  const Pose X_BF{Eigen::Matrix3d::Identity(),
                  placed.has("pos") ? Eigen::Vector3d(placed.numbers("pos", 3)) : Eigen::Vector3d::Zero()};
  joint.X_PF = X_BF;
  joint.X_MC = X_BF.inverse();
  if (joint.type == JointType::kBall) return joint;
  joint.axis = jointAxis(styled);
  const double ref = coordinate(joint, styled.number("ref", 0), compiler);
  if (ref != 0) {
    joint.q0 = Eigen::VectorXd::Constant(1, ref);
    joint.X_MC = jointMotion(joint.type, joint.axis, 0, &ref).inverse() * joint.X_MC;
  }
  readForceRange(styled, compiler, joint);
  return joint;
}

}  // namespace rex::mjcf
