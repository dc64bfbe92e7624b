#pragma once

#include <fmt/format.h>

#include "base/error.h"
#include "kinematics/task_map.h"
#include "trajectory/trajectory_problem.h"

namespace rex::internal {

/// Throws Error for a model whose q is more than plain numbers, which differences of q do not describe.
inline void requirePlain(const Model& model) {
  if (model.nq() == model.nv()) return;
  throw Error({.what = "model of a trajectory",
               .found = "joints with quaternions",
               .wanted = "hinges, sliders and other joints of plain numbers"});
}

/// A robot in one posture after another: room for terms to work in.
class WindowPosture {
 public:
  explicit WindowPosture(const Model& model) : model_(model) {}

  [[nodiscard]] const Model& model() const { return model_; }
  /// Moves it to (1 - share) a + share b.
  Posture moveTo(const VectorArg& a, const VectorArg& b, double share) {
    if (a.size() != model_.nq()) requireSize("configurations of a trajectory", a.size(), model_.nq());
    q_ = (1 - share) * a + share * b;
    forwardKinematics(model_, q_, poses_);
    return {model_, q_, poses_};
  }

 private:
  Model model_;
  Eigen::VectorXd q_;
  BodyPoses poses_;
};

}  // namespace rex::internal
