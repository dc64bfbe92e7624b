#include "dynamics/joint_springs.h"

#include "base/error.h"
#include "geometry/rotation.h"

namespace rex {
namespace {

// Calls visit(joint, stretch) for each joint with a spring.
template <class Visit>
void forEachSpring(const Model& model, const VectorArg& q, const Visit& visit) {
  requireSize("joint positions q", q.size(), model.nq());
  if (!model.hasSprings()) return;
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 7, 1> own;
  for (const Joint& joint : model.joints()) {
    if (joint.stiffness == 0 || joint.nv == 0) continue;
    own = joint.ratio * q.segment(joint.qIndex, joint.nq).array() + joint.offset;
    visit(joint, springStretch(joint, own));
  }
}

}  // namespace

SpringStretch springStretch(const Joint& joint, const VectorArg& q) {
  if (joint.nq == joint.nv) return q - joint.springReference;
  const int plain = joint.nq - 4;
  SpringStretch stretch(joint.nv);
  stretch.head(plain) = q.head(plain) - joint.springReference.head(plain);
  const Eigen::Matrix3d R0 = rotationFromQuaternion(joint.springReference.tail<4>());
  stretch.tail<3>() = logSO3(R0.transpose() * rotationFromQuaternion(q.tail<4>()));
  return stretch;
}

void addSpringForces(const Model& model, const VectorArg& q, Eigen::Ref<Eigen::VectorXd> u) {
  requireSize("joint forces u", u.size(), model.nv());
  forEachSpring(model, q, [&](const Joint& joint, const SpringStretch& stretch) {
    u.segment(joint.vIndex, joint.nv) -= joint.ratio * joint.stiffness * stretch;
  });
}

Eigen::VectorXd springForces(const Model& model, const VectorArg& q) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.nv());
  addSpringForces(model, q, u);
  return u;
}

double springEnergy(const Model& model, const VectorArg& q) {
  double energy = 0;
  forEachSpring(model, q, [&](const Joint& joint, const SpringStretch& stretch) {
    energy += 0.5 * joint.stiffness * stretch.squaredNorm();
  });
  return energy;
}

}  // namespace rex
