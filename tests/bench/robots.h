#pragma once

#include "bench/row.h"
#include "scene/model.h"

namespace rex::bench {

/// A robot, the body at its end, and postures to take in turn, one per column: KDL remembers its last one.
struct Robot {
  static constexpr int kPostures = 16;
  std::string name;
  Model model;
  BodyId tip;
  Eigen::MatrixXd Q;
};

/// An arm of seven hinges with the frames of a common industrial robot, "arm7"; and the humanoid of
/// data/robots, "man", with its hand.
[[nodiscard]] std::vector<Robot> robots();

/// Measures the work at one posture after the other, and at all postures at once, per posture. Empty without
/// work.
[[nodiscard]] Measurement timedInTurn(const std::function<void(int k)>& work);
[[nodiscard]] Measurement timedPerPosture(const std::function<void()>& work);

}  // namespace rex::bench
