#include "planning/control_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"
#include "planning/car_curves.h"
#include "planning/rrt_internal.h"
#include "systems/motion_model.h"

namespace rex {
namespace {

std::string listed(const VectorArg& x) {
  return fmt::format("({:.4g})", fmt::join(x.begin(), x.end(), ", "));
}

void requireSound(const ControlSystem& system, const ControlTreeOptions& options) {
  if (!system.motion)
    throw Error({.what = "control system",
                 .found = "no motion",
                 .wanted = "a function that gives the state after a motion"});
  requireSize("upper bounds of controls", system.upper.size(), system.lower.size());
  requirePositive("shortest duration of controls", options.shortest, kSeconds);
  requirePositive("longest duration of controls", options.longest, kSeconds);
  if (options.shortest > options.longest)
    throw Error({.what = "shortest duration of controls",
                 .found = fmt::format("{:g} s", options.shortest),
                 .wanted = fmt::format("at most the longest, {:g} s", options.longest)});
  requirePositive("time between checks of a motion", options.checkEvery, kSeconds);
  requireCount("trials of controls", options.trials, 1);
  requireCount("number of samples", options.maxSamples, 1);
  requireNotNegative("tolerance of a goal", options.tolerance);
  if (!(options.goalBias >= 0 && options.goalBias <= 1))
    throw Error({.what = "goal bias of a tree",
                 .found = fmt::format("{:g}", options.goalBias),
                 .wanted = "a number from 0 to 1"});
}

class ControlTree {
 public:
  ControlTree(const ControlSystem& system, const PathProblem& problem, const ControlTreeOptions& options,
              Rng& rng)
      : system_(system),
        problem_(problem),
        options_(options),
        rng_(rng),
        tree_(system.space, problem.start),
        edges_(1) {}

  ControlPath grow() {
    if (distance(problem_.start, problem_.goal) <= options_.tolerance) goal_ = 0;
    if (goal_ < 0) tryGoal(0);
    Eigen::VectorXd target(system_.space.size());
    while (goal_ < 0 && samples_ < options_.maxSamples) {
      ++samples_;
      if (rng_.uniform() < options_.goalBias)
        target = problem_.goal;
      else
        system_.space.sample(rng_, target);
      extend(target);
    }
    return finish();
  }

 private:
  double distance(const VectorArg& from, const VectorArg& to) const {
    if (!system_.distance) return system_.space.distance(from, to);
    const double distance = system_.distance(from, to);
    if (std::isnan(distance)) {
      throw Error({.what = fmt::format("distance from {} to {}", listed(from), listed(to)),
                   .found = "not a number",
                   .wanted = "a number, 0 or more"});
    }
    return distance;
  }

  // A tree of neighbours helps only if the distance is the metric of the space.
  int nearest(const VectorArg& target) const {
    if (!system_.distance) return tree_.points().nearest(target);
    std::pair<double, int> best{std::numeric_limits<double>::infinity(), 0};
    for (int i = 0; i < tree_.count(); ++i)
      best = std::min(best, {distance(tree_.points().point(i), target), i});
    return best.second;
  }

  Eigen::VectorXd move(const VectorArg& x, const VectorArg& u, double seconds) const {
    Eigen::VectorXd next = system_.motion(x, u, seconds);
    requireSize("state after a motion", next.size(), system_.space.size());
    if (!next.allFinite()) {
      throw Error({.what = fmt::format("motion from {} by {}", listed(x), listed(u)),
                   .found = "a number that is not finite",
                   .wanted = "a state"});
    }
    return next;
  }

  // A step from the tree towards a target, if nothing is in the way.
  void extend(const Eigen::VectorXd& target) {
    const int from = options_.towardsTargets ? nearest(target) : rng_.index(tree_.count());
    const Eigen::VectorXd x = tree_.points().point(from);
    if (!system_.steer || !options_.towardsTargets) {
      static_cast<void>(follow(from, {shot(x, target)}));
      return;
    }
    const int node = follow(from, shortened(steered(x, target), drawnDuration()));
    if (node >= 0 && goal_ < 0) tryGoal(node);
  }

  // All the way to the goal.
  void tryGoal(int from) {
    if (system_.steer && options_.towardsTargets)
      static_cast<void>(follow(from, steered(tree_.points().point(from), problem_.goal)));
  }

  double drawnDuration() { return rng_.uniform(options_.shortest, options_.longest); }

  // The best of some random controls.
  HeldControl shot(const Eigen::VectorXd& x, const Eigen::VectorXd& target) {
    HeldControl best;
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < (options_.towardsTargets ? options_.trials : 1); ++i) {
      const Eigen::VectorXd share = rng_.uniformVector(static_cast<int>(system_.lower.size()), 0, 1);
      const HeldControl one{system_.lower + share.cwiseProduct(system_.upper - system_.lower),
                            drawnDuration()};
      const double distance = this->distance(move(x, one.u, one.seconds), target);
      if (i > 0 && distance >= nearest) continue;
      nearest = distance;
      best = one;
    }
    return best;
  }

  std::vector<HeldControl> steered(const Eigen::VectorXd& x, const Eigen::VectorXd& target) const {
    std::vector<HeldControl> controls = system_.steer(x, target);
    for (const HeldControl& one : controls) {
      requireSize("control that steers", one.u.size(), system_.lower.size());
      const bool isWithin =
          (one.u.array() >= system_.lower.array()).all() && (one.u.array() <= system_.upper.array()).all();
      if (isWithin && std::isfinite(one.seconds) && one.seconds >= 0) continue;
      throw Error({.what = fmt::format("steering from {} to {}", listed(x), listed(target)),
                   .found = fmt::format("{} for {:g} s", listed(one.u), one.seconds),
                   .wanted = fmt::format("controls from {} to {}, for 0 s or more", listed(system_.lower),
                                         listed(system_.upper))});
    }
    return controls;
  }

  // What of it happens in that time.
  static std::vector<HeldControl> shortened(std::vector<HeldControl> controls, double seconds) {
    for (std::size_t i = 0; i < controls.size(); ++i) {
      if (controls[i].seconds >= seconds) {
        controls[i].seconds = seconds;
        controls.resize(i + 1);
      } else {
        seconds -= controls[i].seconds;
      }
    }
    return controls;
  }

  // The end of a motion from x; nothing if something is in the way.
  std::optional<Eigen::VectorXd> driven(const Eigen::VectorXd& x, const HeldControl& one) {
    constexpr long kMostAtOnce = 32;
    const long checks = static_cast<long>(std::ceil(one.seconds / options_.checkEvery));
    Eigen::MatrixXd states = x;
    for (long done = 0; done < checks; done += states.cols()) {
      states.resize(x.size(), std::min(kMostAtOnce, checks - done));
      for (Eigen::Index k = 0; k < states.cols(); ++k)
        states.col(k) =
            move(x, one.u, one.seconds * static_cast<double>(done + k + 1) / static_cast<double>(checks));
      asked_ += states.cols();
      if (!problem_.allValid(states)) return std::nullopt;
    }
    return states.rightCols<1>();
  }

  // Applies controls and adds a node after each. Returns the last one, or -1 if there is none or something is
  // in the way; then nothing is added.
  int follow(int from, std::vector<HeldControl> controls) {
    std::erase_if(controls, [](const HeldControl& one) { return one.seconds == 0; });
    std::vector<Eigen::VectorXd> states{tree_.points().point(from)};
    for (const HeldControl& one : controls) {
      const std::optional<Eigen::VectorXd> end = driven(states.back(), one);
      if (!end) return -1;
      states.push_back(*end);
    }
    for (std::size_t i = 0; i < controls.size() && goal_ < 0; ++i) {
      from = tree_.add(states[i + 1], from);
      edges_.push_back(controls[i]);
      if (distance(states[i + 1], problem_.goal) <= options_.tolerance) goal_ = from;
    }
    return controls.empty() ? -1 : from;
  }

  ControlPath finish() {
    ControlPath path;
    PathResult& found = path.found;
    found.samples = samples_;
    found.asked = asked_;
    found.trees.push_back(tree_.drawn());
    const bool isFound = goal_ >= 0;
    found.message = fmt::format("{} after {} samples: {} nodes, {} states checked",
                                isFound ? "found a path" : "no path", samples_, tree_.count(), asked_);
    if (isFound) {
      found.status = PathStatus::kFound;
      found.path = tree_.wayTo(goal_);
      found.length = pathLength(system_.space, found.path);
      for (int at = goal_; at > 0; at = tree_.parent(at))
        path.controls.push_back(edges_[static_cast<std::size_t>(at)]);
      std::reverse(path.controls.begin(), path.controls.end());
    }
    path.edges = std::move(edges_);
    return path;
  }

  const ControlSystem& system_;
  const PathProblem& problem_;
  const ControlTreeOptions& options_;
  Rng& rng_;
  internal::SearchTree tree_;
  std::vector<HeldControl> edges_;  // that led to each node
  int goal_ = -1;                   // the node that reached it
  int samples_ = 0;
  long asked_ = 0;
};

}  // namespace

ControlSystem controlSystem(const MotionModel& model, const Space& space, const VectorArg& lower,
                            const VectorArg& upper) {
  requireSize("space of a motion model", space.size(), model.states);
  requireSize("lower bounds of controls", lower.size(), model.controls);
  requireSize("upper bounds of controls", upper.size(), model.controls);
  if (!model.f)
    throw Error({.what = "motion model", .found = "no function f", .wanted = "the state after a motion"});
  return {.space = space, .lower = lower, .upper = upper, .motion = model.f};
}

ControlPath growControlTree(const ControlSystem& system, const PathProblem& problem,
                            const ControlTreeOptions& options, Rng& rng) {
  requireSound(system, options);
  rex::requireSound(problem);
  return ControlTree(system, problem, options, rng).grow();
}

namespace {

constexpr Unit kSpeedUnit{"m/s", "metres per second"};

using CurveBetween = Curve (*)(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);
using LengthBetween = double (*)(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);

ControlSystem steeredCar(const Space& space, const Car& car, double slowest, double speed, CurveBetween curve,
                         LengthBetween length) {
  requireSize("space of a car", space.size(), 3);
  requirePositive("speed of a car", speed, kSpeedUnit);
  requirePositive("wheelbase of a car", car.wheelbase, kMetres);
  const double radius = car.turningRadius();
  requirePositive("turning radius", radius, kMetres);
  return {.space = space,
          .lower = Eigen::Vector2d(slowest, -car.maxSteering),
          .upper = Eigen::Vector2d(speed, car.maxSteering),
          .motion = [car](const VectorArg& x, const VectorArg& u, double seconds) -> Eigen::VectorXd {
            return driveCar(car, x, u, seconds);
          },
          .distance = [=](const VectorArg& from, const VectorArg& to) { return length(from, to, radius); },
          .steer = [=](const VectorArg& from,
                       const VectorArg& to) { return controlsAlong(curve(from, to, radius), car, speed); }};
}

}  // namespace

std::vector<HeldControl> controlsAlong(const Curve& curve, const Car& car, double speed) {
  requirePositive("speed of a car", speed, kSpeedUnit);
  // Rounding alone may ask for a little more than the largest angle.
  const double steering = std::min(car.maxSteering, std::atan(car.wheelbase / curve.radius()));
  if (curve.radius() < (1 - 1e-9) * car.turningRadius())
    throw Error(
        {.what = "radius of a curve",
         .found = fmt::format("{:g} m", curve.radius()),
         .wanted = fmt::format("at least the turning radius of the car, {:g} m", car.turningRadius())});
  std::vector<HeldControl> controls;
  for (const CurveSegment& segment : curve.segments()) {
    const double side = segment.steering == Steering::kLeft    ? steering
                        : segment.steering == Steering::kRight ? -steering
                                                               : 0;
    controls.push_back(
        {Eigen::Vector2d(segment.length < 0 ? -speed : speed, side), std::abs(segment.length) / speed});
  }
  return controls;
}

ControlSystem dubinsCar(const Space& space, const Car& car, double speed) {
  return steeredCar(space, car, 0, speed, dubinsCurve, dubinsLength);
}

ControlSystem reedsSheppCar(const Space& space, const Car& car, double speed) {
  return steeredCar(space, car, -speed, speed, reedsSheppCurve, reedsSheppLength);
}

}  // namespace rex
