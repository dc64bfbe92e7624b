#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "course/simulator.h"
#include "grading/check.h"
#include "grading/evidence.h"
#include "plans.h"

// The checks of part 5, a hand within limits.

inline RateBounds trueBounds(const ArmLimits& limits, const Eigen::VectorXd& q, double tau) {
  RateBounds bounds{-limits.rateMax, limits.rateMax};
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const double reach = tau * limits.rateMax[i];
    for (const bool isUpper : {false, true}) {
      const double way = (isUpper ? limits.qMax : limits.qMin)[i] - q[i];
      double& bound = (isUpper ? bounds.upper : bounds.lower)[i];
      bound = way >= reach ? limits.rateMax[i] : way <= -reach ? -limits.rateMax[i] : way / tau;
    }
  }
  return bounds;
}

/// Joints that are far from their limits, about to reach one, and beyond one by less or more than a step.
struct LimitedPosture {
  ArmLimits limits;
  Eigen::VectorXd q;
};
inline LimitedPosture randomLimitedPosture(Eigen::Index n, double tau, rex::Rng& rng) {
  const Eigen::VectorXd most = roundedMatrix(n, 1, .5, rng).array() + 1,
                        rate = roundedMatrix(n, 1, .8, rng).array() + 1.2;
  LimitedPosture p{{-most, most, rate}, roundedMatrix(n, 1, .2, rng)};
  constexpr std::array kStepsInside{0., .3, .6, -.4, -2.5};
  for (Eigen::Index i = 0; i < n; ++i) {
    const bool isHigh = rng.index(2) == 1;
    if (i % 5 == 0)
      (isHigh ? p.limits.qMax : p.limits.qMin)[i] = isHigh ? kNoLimit : -kNoLimit;
    else
      p.q[i] = (isHigh ? 1 : -1) * (most[i] - kStepsInside[static_cast<std::size_t>(i % 5)] * tau * rate[i]);
  }
  return p;
}

inline void bounds(rex::grading::Check& check, Student& student, Eigen::Index n, double tau) {
  const auto [limits, q] = randomLimitedPosture(n, tau, check.rng());
  check.input(
      "limits and a posture",
      {{"qMin", limits.qMin}, {"qMax", limits.qMax}, {"rateMax", limits.rateMax}, {"q", q}, {"tau", tau}});
  const RateBounds got = student.rateBounds(limits, q, tau), right = trueBounds(limits, q, tau);
  check.shape("lower of rateBounds", got.lower, n, 1);
  check.shape("upper of rateBounds", got.upper, n, 1);
  check.near("upper of rateBounds", got.upper, right.upper, 1e-9);
  check.near("lower of rateBounds", got.lower, right.lower, 1e-9);
}

inline Quadratic trueRateCost(const HandTask& task) {
  const Eigen::Index n = task.J.cols();
  return measuredQuadratic(n + 1, [&](const Eigen::VectorXd& z) {
    const Eigen::VectorXd error = task.J * z.head(n) - z[n] * task.v;
    return error.dot(task.W * error) + task.damping * z.head(n).squaredNorm() +
           task.slowness * (1 - z[n]) * (1 - z[n]);
  });
}

/// z between bounds; the share s between two numbers.
inline Eigen::VectorXd ratesWithin(const Quadratic& cost, const RateBounds& rates, double least,
                                   double most) {
  Eigen::VectorXd lower(cost.g.size()), upper(cost.g.size());
  lower << rates.lower, least;
  upper << rates.upper, most;
  return boundedMinimum(cost, lower, upper);
}

/// The full speed by the damped pseudo-inverse, and its rates cut off by the bounds.
inline Eigen::VectorXd cutRates(const HandTask& task, const RateBounds& rates) {
  const Eigen::MatrixXd damped = task.J * task.J.transpose() + task.damping * rex::inverse(task.W);
  Eigen::VectorXd z(task.J.cols() + 1);
  z << within(task.J.transpose() * rex::solve(damped, task.v), rates.lower, rates.upper), 1;
  return z;
}

inline void costsOfRates(rex::grading::Check& check, Student& student, const HandTask& task) {
  const Eigen::Index n = task.J.cols();
  const Quadratic got = student.rateCost(task), right = trueRateCost(task);
  check.shape("H of rateCost", got.H, n + 1, n + 1);
  check.shape("g of rateCost", got.g, n + 1, 1);
  check.near("H of rateCost", got.H, right.H, 1e-8 * right.H.cwiseAbs().maxCoeff());
  check.near("g of rateCost", got.g, -2 * task.slowness * Eigen::VectorXd::Unit(n + 1, n),
             1e-8 * (1 + task.slowness));
}

inline void rates(rex::grading::Check& check, Student& student, const HandTask& task,
                  const LimitedPosture& at, double tau) {
  const auto& [limits, q] = at;
  const rex::grading::InputValue J("J", task.J), v("v", task.v), W("W", task.W),
      damping("damping", task.damping), slowness("slowness", task.slowness), qMin("qMin", limits.qMin),
      qMax("qMax", limits.qMax), rateMax("rateMax", limits.rateMax);
  check.input("a task and limits", {J, v, W, damping, slowness, qMin, qMax, rateMax, {"q", q}, {"tau", tau}});
  costsOfRates(check, student, task);
  const Eigen::Index n = q.size();
  const Eigen::VectorXd got = student.limitedRates(task, limits, q, tau);
  const Quadratic cost = trueRateCost(task);
  const RateBounds bounds = trueBounds(limits, q, tau), fast{-limits.rateMax, limits.rateMax};
  const Eigen::VectorXd free = -rex::solve(cost.H, cost.g);
  Eigen::VectorXd lower(n + 1), upper(n + 1);
  lower << bounds.lower, 0;
  upper << bounds.upper, 1;
  // All rates by one factor, until each is within its bounds.
  double factor = 1;
  for (Eigen::Index i = 0; i < n; ++i)
    factor = std::min(factor, std::max(0., (free[i] > 0 ? upper[i] : lower[i]) / free[i]));
  check.near("z of limitedRates", got, ratesWithin(cost, bounds, 0, 1), 1e-4,
             {{"Are the limits forgotten?", free},
              {"Is it the pseudo-inverse, cut off? If one joint is at its bound, the others can help.",
               cutRates(task, bounds)},
              {"Is it the minimum without bounds, cut off?", within(free, lower, upper)},
              {"Are all rates made smaller together? Those that are not at a bound can help.", factor * free},
              {"Does the hand never slow down? s may be less than 1.", ratesWithin(cost, bounds, 1, 1)},
              {"Do only the limits of speed count?", ratesWithin(cost, fast, 0, 1)},
              {"Does the share s have no bounds?", ratesWithin(cost, bounds, -kNoLimit, kNoLimit)}});
}

/// A random hand that has to be fast, and weights for which H has a condition of at most 3000.
inline HandTask randomHandTask(Eigen::Index d, Eigen::Index n, rex::Rng& rng) {
  HandTask task{roundedMatrix(d, n, 1, rng), roundedMatrix(d, 1, 1.5, rng), roundedWeights(d, .2, rng), .01,
                .2};
  while (conditionOf(trueRateCost(task).H) > 3000) task.damping *= 2;
  return task;
}

inline void boundsOfSteps(rex::grading::Check& check, Student& student) {
  check.forEachCase(5, [&](int i) { bounds(check, student, 5 + i, .1); });
}

inline void ratesOfHands(rex::grading::Check& check, Student& student) {
  // Two equal joints, one of them slow; then the other has to return, and takes the hand along.
  const HandTask both{Eigen::RowVector2d(1, 1), Eigen::VectorXd::Ones(1), Eigen::MatrixXd::Constant(1, 1, 3.),
                      .01, .1};
  const Eigen::Vector2d far(3, 3);
  rates(check, student, both, {{-far, far, Eigen::Vector2d(.2, 1)}, Eigen::Vector2d(0, 0)}, .1);
  for (const double back : {-4., 4.})
    rates(check, student, both, {{-far, far, Eigen::Vector2d(2, .1)}, Eigen::Vector2d(back, 0)}, .1);
  check.forEachCase(5, [&](int i) {
    rex::Rng& rng = check.rng();
    rates(check, student, randomHandTask(2, 3 + i, rng), randomLimitedPosture(3 + i, .1, rng), .1);
  });
}

/// A line for a point of a body of a robot.
struct Line {
  std::string robot, body;
  Eigen::Vector3d rel;
  ArmLimits limits{};
  Eigen::VectorXd q{};
  Eigen::Vector3d goal{};
  double pace = .02, tau = .05;
  int T = 60;
};

inline Arm armOf(const Line& line) {
  return [S = rex::Simulator(line.robot), body = line.body,
          rel = line.rel](const Eigen::VectorXd& q) mutable -> Hand {
    S.setJointAngles(q);
    return {S.kinematicsPos(body, rel), S.jacobianPos(body, rel)};
  };
}

enum class Habit { kNone, kBlind, kByTheClock, kNoTime, kFirstJacobian, kCutOff };

inline Eigen::MatrixXd tracedBy(const Line& line, Habit habit) {
  const Arm arm = armOf(line);
  const Eigen::Index n = line.q.size();
  Eigen::MatrixXd Q(n, line.T + 1);
  Q.col(0) = line.q;
  const Hand first = arm(line.q);
  const Eigen::Vector3d way = line.goal - first.p;
  double r = 0;
  for (int t = 0; t < line.T; ++t) {
    const Hand now = arm(Q.col(t));
    const double asked = std::min(1 - r, line.pace);
    Eigen::VectorXd v = first.p + (r + asked) * way - now.p;
    if (habit == Habit::kBlind) v = asked * way;
    if (habit != Habit::kNoTime) v /= line.tau;
    const HandTask task{
        .J = habit == Habit::kFirstJacobian ? first.J : now.J, .v = v, .W = Eigen::Matrix3d::Identity()};
    const RateBounds bounds = trueBounds(line.limits, Q.col(t), line.tau);
    const Eigen::VectorXd z =
        habit == Habit::kCutOff ? cutRates(task, bounds) : ratesWithin(trueRateCost(task), bounds, 0, 1);
    Q.col(t + 1) = Q.col(t) + line.tau * z.head(n);
    r += (habit == Habit::kByTheClock ? 1 : z[n]) * asked;
  }
  return Q;
}

inline void traces(rex::grading::Check& check, Student& student, const Line& line) {
  const rex::grading::InputValue point("point", line.rel), qMin("qMin", line.limits.qMin),
      qMax("qMax", line.limits.qMax), rateMax("rateMax", line.limits.rateMax), q("q", line.q),
      goal("goal", line.goal), pace("pace", line.pace), tau("tau", line.tau), T("T", line.T);
  check.input(line.robot + ", '" + line.body + "'", {point, qMin, qMax, rateMax, q, goal, pace, tau, T});
  const Arm arm = armOf(line);
  const Eigen::MatrixXd got =
                            student.traced(arm, line.limits, line.q, line.goal, line.pace, line.tau, line.T),
                        right = tracedBy(line, Habit::kNone);
  check.shape("postures of traced", got, right.rows(), right.cols());
  const auto shown = check.show([&] {
    const auto path = [&](rex::Series series, const Eigen::MatrixXd& postures) {
      for (const auto& posture : postures.colwise()) {
        const Eigen::VectorXd p = arm(posture).p;
        series.add(p[1], p[2]);
      }
      return series;
    };
    const std::vector<rex::Series> paths{path(rex::grading::gotCurve("got"), got),
                                         path(rex::grading::wantedCurve("wanted"), right)};
    return rex::grading::Evidence{
        .figures = {rex::planeFigure({.title = "The hand, from the side", .series = paths})}};
  });
  check.near("postures of traced", got, right, 1e-3,
             {{"Is v a distance? A velocity is a distance divided by tau.", tracedBy(line, Habit::kNoTime)},
              {"Does the next point come although the hand was slower? The line has to wait: r grows by s.",
               tracedBy(line, Habit::kByTheClock)},
              {"Is v always along the line? If the hand has left it, v has to lead back.",
               tracedBy(line, Habit::kBlind)},
              {"Is J that of the first posture?", tracedBy(line, Habit::kFirstJacobian)},
              {"Is it the pseudo-inverse, cut off?", tracedBy(line, Habit::kCutOff)}},
             "rad");
}

inline void tracesDown(rex::grading::Check& check, Student& student) {
  const Eigen::Vector3d most(1.8, 1.3, 1.3);
  traces(check, student,
         {.robot = "arm3.ors",
          .body = "eff",
          .rel = {0, 0, .15},
          .limits = {-most, most, Eigen::Vector3d::Ones()},
          .q = Eigen::Vector3d(-.5, -.2, -.2),
          .goal = {0, -.4, .6},
          .pace = .025});
}
