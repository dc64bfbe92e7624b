#pragma once

#include <vector>

#include <Eigen/Core>

#include "base/vector_arg.h"

namespace rex {

/// Which features of the past of m sensors a policy sees; each more makes some motions tellable that one
/// reading does not show, as velocities.
struct SensorHistoryOptions {
  int sensors = 1;
  double timeStep = .01;     ///< seconds between readings
  bool constant = false;     ///< a one, in front
  bool derivatives = false;  ///< dy/dt, by the last two readings
  std::vector<double>
      averages{};       ///< running averages of y, and of dy/dt if it is there, that keep such a share
  int pastActions = 0;  ///< u of so many steps before, the last first
};

/// Turns a stream of readings and actions into features, with the state that takes: copying it copies the
/// past. Their order: one; y; dy/dt; for each average that of y, then that of dy/dt; past actions.
class SensorHistory {
 public:
  /// Throws Error for no sensor, a time step that is not positive, averages outside [0, 1) and a negative
  /// number of actions.
  explicit SensorHistory(const SensorHistoryOptions& options);

  int size() const { return static_cast<int>(features_.size()); }
  /// Takes in a reading y of m numbers and gives the features, valid until the next call. At the first
  /// reading derivatives are zero and averages the reading. Throws Error for another size.
  const Eigen::VectorXd& observe(const VectorArg& y);
  /// Remembers the action taken after a reading; without it, past actions are zero.
  void act(double u);
  /// Forgets everything.
  void reset();

 private:
  SensorHistoryOptions options_;
  Eigen::VectorXd features_{}, signal_{};  // signal_: y and dy/dt
  Eigen::VectorXd actions_{};              // the last first
  bool isFirst_ = true;
};

}  // namespace rex
