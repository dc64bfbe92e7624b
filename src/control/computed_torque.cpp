#include "control/computed_torque.h"

#include "base/require.h"

namespace rex {

Eigen::VectorXd computedTorque(const Model& model, const State& state, const Reference& reference,
                               const PdGains& gains, const Eigen::Vector3d& gravity_W) {
  requireFinite("gravity", gravity_W);
  return inverseDynamics(model, state.q, state.v, followReference(model, state, reference, gains), gravity_W);
}

}  // namespace rex
