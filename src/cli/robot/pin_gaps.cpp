#include "cli/robot/pin_gaps.h"

#include "kinematics/forward_kinematics.h"

namespace rex::cli {

Eigen::VectorXd pinGaps(const Model& model, const VectorArg& q) {
  const BodyPoses poses = forwardKinematics(model, q);
  Eigen::VectorXd gaps(static_cast<Eigen::Index>(model.pins().size()));
  for (Eigen::Index i = 0; i < gaps.size(); ++i) {
    const Pin& pin = model.pins()[static_cast<std::size_t>(i)];
    gaps[i] = (poses[pin.a] * pin.p_AP - poses[pin.b] * pin.p_BQ).norm();
  }
  return gaps;
}

}  // namespace rex::cli
