#include "learning/sensor_history.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {

SensorHistory::SensorHistory(const SensorHistoryOptions& options) : options_(options) {
  requireCount("sensors", options.sensors, 1);
  requirePositive("time step", options.timeStep, kSeconds);
  requireCount("past actions", options.pastActions, 0);
  for (const double keep : options.averages)
    if (!(keep >= 0 && keep < 1))
      throw Error({.what = "share that an average keeps",
                   .found = fmt::format("{:g}", keep),
                   .wanted = "a number in [0, 1)"});
  const Eigen::Index signals = (options.derivatives ? 2 : 1) * options.sensors;
  const auto averages = static_cast<Eigen::Index>(options.averages.size());
  signal_.setZero(signals);
  actions_.setZero(options.pastActions);
  features_.setZero((options.constant ? 1 : 0) + signals * (1 + averages) + options.pastActions);
}

const Eigen::VectorXd& SensorHistory::observe(const VectorArg& y) {
  const Eigen::Index m = options_.sensors, signals = signal_.size();
  requireSize("reading of the sensors", y.size(), m);
  if (options_.derivatives && !isFirst_) signal_.tail(m) = (y - signal_.head(m)) / options_.timeStep;
  signal_.head(m) = y;
  Eigen::Index place = 0;
  if (options_.constant) features_[place++] = 1;
  features_.segment(place, signals) = signal_;
  for (const double keep : options_.averages) {
    place += signals;
    auto average = features_.segment(place, signals);
    if (isFirst_) average = signal_;
    average += (1 - keep) * (signal_ - average);
  }
  features_.tail(actions_.size()) = actions_;
  isFirst_ = false;
  return features_;
}

void SensorHistory::act(double u) {
  for (Eigen::Index i = actions_.size() - 1; i > 0; --i) actions_[i] = actions_[i - 1];
  if (actions_.size() > 0) actions_[0] = u;
}

void SensorHistory::reset() {
  features_.setZero();
  signal_.setZero();
  actions_.setZero();
  isFirst_ = true;
}

}  // namespace rex
