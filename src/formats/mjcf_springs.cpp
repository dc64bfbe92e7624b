#include <algorithm>
#include <utility>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "formats/mjcf_parts_internal.h"
#include "scene/model.h"

namespace rex::mjcf {
namespace {

// All bodies and joints of a scene, each joint with coordinates of its own.
Model uncoupled(const SceneSpec& spec) {
  SceneSpec bare{.name = spec.name, .bodies = spec.bodies, .joints = spec.joints, .worldShapes = {}};
  for (BodySpec& body : bare.bodies) body.shapes.clear();
  for (JointSpec& joint : bare.joints) {
    joint.mimic.clear();
    joint.lower.resize(0);
    joint.upper.resize(0);
  }
  return compile(bare);
}

// How a freedom moves the point that is at the world's origin, and turns what hangs on it.
struct Twist {
  int column;
  Eigen::Vector3d linear, angular;
};

std::vector<Twist> twistsOf(const Joint& joint, const Pose& X_WP, const Pose& X_WC) {
  std::vector<Twist> twists;
  for (int i = 0; i < joint.nv; ++i) {
    const DegreeOfFreedom& freedom = joint.freedoms[static_cast<std::size_t>(i)];
    const Pose& X_WF = freedom.frame == DegreeOfFreedom::Frame::kParent ? X_WP : X_WC;
    const Eigen::Vector3d angular = X_WF.R * freedom.angular;
    twists.push_back({joint.vIndex + i, X_WF.R * freedom.linear + X_WF.p.cross(angular), angular});
  }
  return twists;
}

// M where the joints start. The module dynamics is not there yet, and M is needed once.
Eigen::MatrixXd massMatrixAtStart(const Model& model) {
  const std::size_t count = model.bodies().size();
  std::vector<Pose> X_WB(count);
  std::vector<std::vector<Twist>> twists(count);  // of all joints above
  Eigen::MatrixXd M = model.armature().asDiagonal();
  for (std::size_t i = 1; i < count; ++i) {
    const Body& body = model.bodies()[i];
    const auto parent = static_cast<std::size_t>(body.parent);
    twists[i] = twists[parent];
    if (body.joint == kNoJoint) {
      X_WB[i] = X_WB[parent] * body.X_PB;
    } else {
      const Joint& joint = model[body.joint];
      const double* const q = model.initialPositions().data() + joint.qIndex;
      X_WB[i] = X_WB[parent] * joint.X_PF * jointMotion(joint.type, joint.axis, joint.pitch, q) * joint.X_MC;
      for (const Twist& one : twistsOf(joint, X_WB[parent], X_WB[i])) twists[i].push_back(one);
    }
    const Eigen::Vector3d center = X_WB[i] * body.p_BBcm;
    const Eigen::Matrix3d I = X_WB[i].R * body.I_BBcm_B * X_WB[i].R.transpose();
    for (const Twist& one : twists[i]) {
      const Eigen::Vector3d p = body.mass * (one.linear + one.angular.cross(center)), L = I * one.angular;
      for (const Twist& other : twists[i])
        M(other.column, one.column) +=
            p.dot(other.linear + other.angular.cross(center)) + L.dot(other.angular);
    }
  }
  return M;
}

}  // namespace

void setSprings(BodyTree& tree, Reading& reading) {
  if (tree.springDampers.empty()) return;
  const Model model = uncoupled(tree.spec);
  const Eigen::LLT<Eigen::MatrixXd> factors(massMatrixAtStart(model));
  const auto specOf = [&](const std::string& name) -> JointSpec& {
    return tree.spec.joints[tree.jointOfName.at(name)];
  };
  if (factors.info() != Eigen::Success) {
    const std::string& first = tree.springDampers.front().first;
    return reading.forgive({.what = fmt::format("joint '{}': springdamper", first),
                            .where = specOf(first).where,
                            .found = "joints that move no mass",
                            .wanted = "masses, which say how strong springs are"},
                           "it is left out", Difference::kMotion);
  }
  const Eigen::VectorXd mobility =
      factors.solve(Eigen::MatrixXd::Identity(model.nv(), model.nv())).diagonal();
  for (const auto& [name, springDamper] : tree.springDampers) {
    JointSpec& spec = specOf(name);
    const auto joint = std::ranges::find(model.joints(), name, &Joint::name);
    const double inertia = joint->nv / mobility.segment(joint->vIndex, joint->nv).sum();
    const double time = springDamper[0], ratio = springDamper[1];
    if (tree.hasSprings) spec.stiffness = inertia / (time * time * ratio * ratio);
    if (tree.hasDampers) spec.damping = 2 * inertia / time;
  }
}

}  // namespace rex::mjcf
