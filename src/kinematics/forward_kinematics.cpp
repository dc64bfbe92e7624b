#include "kinematics/forward_kinematics.h"

#include "kinematics/sin_cos_internal.h"

namespace rex {
namespace {

bool movesLinearly(const Joint& joint) {
  return joint.type == JointType::kHinge || joint.type == JointType::kSlider;
}

// Of a joint with one coordinate, which may follow another joint.
double coordinate(const Joint& joint, const double* q) {
  return joint.ratio * q[joint.qIndex] + joint.offset;
}

Pose motion(const Joint& joint, const double* q) {
  if (joint.nq != 1) return jointMotion(joint.type, joint.axis, joint.pitch, q + joint.qIndex);
  const double value = coordinate(joint, q);
  return jointMotion(joint.type, joint.axis, joint.pitch, &value);
}

// The numbers that LinearMotion speaks of, parked in the first two places of the child's p. In a pass of its
// own: sines do not depend on one another, poses do, and mixed each sine would be waited for.
void parkLinearFactors(std::span<const Joint> joints, const double* q, std::vector<Pose>& X_WB) {
  for (const Joint& joint : joints) {
    if (!movesLinearly(joint)) continue;
    const double value = coordinate(joint, q);
    const auto [second, first] = joint.type == JointType::kHinge ? sinCos(value) : SinCos{0, value};
    X_WB[static_cast<std::size_t>(joint.child)].p.head<2>() << first, second;
  }
}

// Row by row, because Eigen's product of small matrices takes twice as long.
void placeLinearly(const LinearMotion& motion, const Pose& X_WP, Pose& X_WC) {
  const double first = X_WC.p[0], second = X_WC.p[1];
  const LinearMotion::Matrix34 X_PC = motion.constant + first * motion.first + second * motion.second;
  const Eigen::RowVector4d x = X_PC.row(0), y = X_PC.row(1), z = X_PC.row(2);
  for (int i = 0; i < 3; ++i) {
    const Eigen::RowVector4d row = X_WP.R(i, 0) * x + X_WP.R(i, 1) * y + X_WP.R(i, 2) * z;
    X_WC.R.row(i) = row.head<3>();
    X_WC.p[i] = row[3] + X_WP.p[i];
  }
}

}  // namespace

void forwardKinematics(const Model& model, const VectorArg& q, BodyPoses& out) {
  requireSize("joint positions q", q.size(), model.nq());
  out.X_WB.resize(model.bodies().size());
  parkLinearFactors(model.joints(), q.data(), out.X_WB);
  Pose* next = out.X_WB.data();
  for (const Body& body : model.bodies()) {
    Pose& X_WB = *next++;
    if (body.joint == kNoJoint) {
      X_WB = body.X_PB;  // roots hang on the world
      continue;
    }
    const Joint& joint = model[body.joint];
    const Pose& X_WP = out[body.parent];
    if (movesLinearly(joint)) {
      placeLinearly(joint.motion, X_WP, X_WB);
    } else {
      X_WB = X_WP * joint.X_PF * motion(joint, q.data()) * joint.X_MC;
    }
  }
}

BodyPoses forwardKinematics(const Model& model, const VectorArg& q) {
  BodyPoses poses;
  forwardKinematics(model, q, poses);
  return poses;
}

}  // namespace rex
