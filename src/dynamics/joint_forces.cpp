#include "dynamics/joint_forces.h"

#include <cmath>

#include "base/error.h"
#include "base/require.h"
#include "scene/coordinates.h"

namespace rex {
namespace {

// A joint that mimics moves at `ratio` times v, and its force acts on v with that lever.
void addFriction(const Model& model, const VectorArg& v, double frictionSpeed,
                 Eigen::Ref<Eigen::VectorXd> u) {
  for (const Joint& joint : model.joints()) {
    for (int i = joint.vIndex; i < joint.vIndex + joint.nv; ++i) {
      const double rate = joint.ratio * v[i];
      u[i] -= joint.ratio * (joint.damping * rate + joint.friction * std::tanh(rate / frictionSpeed));
    }
  }
}

void addLimits(const Model& model, const VectorArg& q, const VectorArg& v, const JointForces& forces,
               Eigen::Ref<Eigen::VectorXd> u) {
  forEachPlainCoordinate(model, [&](int iq, int iv, const DegreeOfFreedom&) {
    const double below = model.lowerLimits()[iq] - q[iq], above = q[iq] - model.upperLimits()[iq];
    if (below > 0) u[iv] += forces.limitStiffness * below - forces.limitDamping * v[iv];
    if (above > 0) u[iv] -= forces.limitStiffness * above + forces.limitDamping * v[iv];
  });
}

}  // namespace

void requireValid(const JointForces& forces) {
  requirePositive("joint forces: friction speed", forces.frictionSpeed);
  requireNotNegative("joint forces: limit stiffness", forces.limitStiffness);
  requireNotNegative("joint forces: limit damping", forces.limitDamping);
}

void jointForces(const Model& model, const VectorArg& q, const VectorArg& v, const JointForces& forces,
                 Eigen::Ref<Eigen::VectorXd> u) {
  requireSize("joint positions q", q.size(), model.nq());
  requireSize("joint velocities v", v.size(), model.nv());
  requireSize("joint forces u", u.size(), model.nv());
  requireValid(forces);
  u.setZero();
  if (forces.friction) addFriction(model, v, forces.frictionSpeed, u);
  if (forces.limitStiffness > 0 || forces.limitDamping > 0) addLimits(model, q, v, forces, u);
}

Eigen::VectorXd jointForces(const Model& model, const VectorArg& q, const VectorArg& v,
                            const JointForces& forces) {
  Eigen::VectorXd u(model.nv());
  jointForces(model, q, v, forces, u);
  return u;
}

}  // namespace rex
