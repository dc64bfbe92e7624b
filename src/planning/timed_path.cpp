#include "planning/timed_path.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "base/require.h"

namespace rex {

TimedPath::TimedPath(PathCurve curve, std::vector<Interval> intervals, std::vector<double> squares)
    : curve_(std::move(curve)), intervals_(std::move(intervals)), squares_(std::move(squares)) {
  assert(intervals_.empty() || squares_.size() == intervals_.size() + 1);
  for (std::size_t i = 0; i < intervals_.size(); ++i) {
    const double way = intervals_[i].to - intervals_[i].from;
    places_.push_back(places_.back() + way);
    times_.push_back(times_.back() + 2 * way / (std::sqrt(squares_[i]) + std::sqrt(squares_[i + 1])));
  }
}

MotionPoint TimedPath::at(double t) const {
  requireFinite("time on a path", t);
  if (intervals_.empty()) {
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(curve_.start.size());
    return {curve_.start, rest, rest};
  }
  const double time = std::clamp(t, 0., duration());
  const auto next = std::upper_bound(times_.begin() + 1, times_.end() - 1, time);
  const auto i = static_cast<std::size_t>(next - times_.begin()) - 1;
  const Interval& interval = intervals_[i];
  const double way = interval.to - interval.from, past = time - times_[i];
  const double speed = std::sqrt(squares_[i]), growth = (squares_[i + 1] - squares_[i]) / (2 * way);
  double s = interval.from + past * (speed + growth * past / 2), rate = speed + growth * past;
  if (time >= times_[i + 1]) s = interval.to, rate = std::sqrt(squares_[i + 1]);
  CurvePoint point;
  curve_.pieces[interval.piece].at(std::clamp(s, interval.from, interval.to), point);
  return {point.q, rate * point.dq, growth * point.dq + rate * rate * point.ddq};
}

}  // namespace rex
