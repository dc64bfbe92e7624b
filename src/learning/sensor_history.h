#pragma once

#include <vector>

#include <Eigen/Core>

#include "base/require.h"

namespace rex {

/// Which features of the past of m sensors a policy sees. They make quantities observable that one reading
/// does not show, such as velocities.
struct SensorHistoryOptions {
  int sensors = 1;
  double timeStep = .01;           ///< seconds between readings
  bool constant = false;           ///< whether a one comes first
  bool derivatives = false;        ///< dy/dt, from the last two readings
  std::vector<double> averages{};  ///< decay factors of running averages of y, and of dy/dt if used
  int pastActions = 0;             ///< number of past actions u, the last one first
};

/// Turns a stream of readings and actions into features. It holds their history, and copying it copies the
/// history. Order of the features: one; y; dy/dt; for each average that of y, then that of dy/dt; past
/// actions.
class SensorHistory {
 public:
  /// Throws Error for no sensor, a time step that is not positive, averages outside [0, 1) and a negative
  /// number of actions.
  explicit SensorHistory(const SensorHistoryOptions& options);

  int size() const { return static_cast<int>(features_.size()); }
  /// Takes a reading y (m) and returns the features, valid until the next call. At the first reading
  /// derivatives are zero and averages equal the reading. Throws Error for another size.
  const Eigen::VectorXd& observe(const VectorArg& y);
  /// Records the action taken after a reading. If it is never called, past actions are zero.
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
