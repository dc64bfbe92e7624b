#pragma once

#include <cmath>
#include <vector>

#include "exercise.h"
#include "grading/check.h"
#include "grading/evidence.h"
#include "interface.h"
#include "planning/phase_space.h"
#include "tree_checks.h"

// Part 6: motions with the least effort, against the library's; there is exactly one such motion.

struct Transfer {
  Eigen::Vector2d from, to;
  double T;
};

inline Transfer randomTransfer(rex::Rng& rng) {
  return {rng.uniformVector(2, -3, 3), rng.uniformVector(2, -3, 3), rng.uniform(0.5, 4)};
}

/// The force at 21 times of the motion.
inline void forceFits(rex::grading::Check& check, Student& student, const Transfer& x) {
  constexpr int kPieces = 20;
  rex::grading::Signal got{.axis = "time [s]"};
  std::vector<Eigen::VectorXd> wanted;
  bool isBack = true, isOpposite = true, isConstant = true;
  for (int i = 0; i <= kPieces; ++i) {
    const double t = x.T * i / kPieces;
    got.add(t, student.forceAt(x.from, x.to, x.T, t));
    wanted.emplace_back(Eigen::VectorXd::Constant(1, rex::leastEffortForce(x.from, x.to, x.T, t)));
  }
  const double first = wanted.front()[0], last = wanted.back()[0],
               scale = 1e-8 * (1 + std::abs(first) + std::abs(last));
  for (std::size_t i = 0; i <= kPieces; ++i) {
    isBack = isBack && std::abs(got.values[i][0] - wanted[kPieces - i][0]) <= scale;
    isOpposite = isOpposite && std::abs(got.values[i][0] + wanted[i][0]) <= scale;
    isConstant = isConstant && std::abs(got.values[i][0] - got.values[0][0]) <= scale;
  }
  const auto back = check.ask("Is it the force at T - t? A push at time t moves the end by T - t.", isBack);
  const auto opposite = check.ask("Does the force have the opposite sign?", isOpposite);
  const auto constant = check.ask("Is the force the same all the time? It changes linearly.", isConstant);
  const auto noDrift = check.ask(
      "Is the drift T v left out? Without any force the point does not stay where it is.",
      std::abs(got.values[0][0] -
               rex::leastEffortForce(x.from + Eigen::Vector2d(-x.T * x.from[1], 0), x.to, x.T, 0)) <= scale);
  check.nearAlong("force of forceAt", got, wanted, scale, "N");
}

inline void effortFits(rex::grading::Check& check, Student& student, const Transfer& x) {
  check.input("a motion", {{"from", x.from}, {"to", x.to}, {"T", x.T}});
  forceFits(check, student, x);
  const Eigen::Vector2d along = x.to - x.from, missing = along - Eigen::Vector2d(x.T * x.from[1], 0);
  const double wanted = rex::leastEffort(x.from, x.to, x.T), u = rex::leastEffortForce(x.from, x.to, x.T, 0);
  const char* const euclid = "Is it the length of the difference? What looks near may need much effort.";
  check.near("effort", student.effort(x.from, x.to, x.T), wanted, 1e-8 * (1 + wanted + u * u * x.T),
             {{euclid, along.norm()},
              {euclid, along.squaredNorm()},
              {euclid, along.squaredNorm() / x.T},
              {"Is it the root? The effort is the integral of u^2.", std::sqrt(wanted)},
              {"Are `from` and `to` exchanged?", rex::leastEffort(x.to, x.from, x.T)},
              {"Is it half of the integral?", wanted / 2},
              {"Is it u^2 T for the first u? The force changes with time.", u * u * x.T},
              {"Is G^-1 left out? The effort is d^T G^-1 d.", missing.squaredNorm()}},
             "N^2 s");
}

/// States, the motion that is wanted from one of them, and the step that was returned.
inline rex::grading::Evidence phaseSeen(const Eigen::Matrix2Xd& states, const Transfer& x, double tau,
                                        const PhaseNode& got, int wanted) {
  rex::Series motion = rex::grading::wantedCurve("wanted");
  for (int i = 0; i <= 50; ++i) {
    const Eigen::Vector2d at = rex::leastEffortState(states.col(wanted), x.to, x.T, tau * i / 50);
    motion.add(at[0], at[1]);
  }
  rex::Figure figure{.title = "A step in phase space",
                     .xLabel = "position [m]",
                     .yLabel = "velocity [m/s]",
                     .legend = rex::Legend::kOutside};
  figure.series = {
      rex::dots(states, {.label = "states", .size = 2, .color = rex::Color{.5f, .5f, .5f}}), motion,
      rex::dots(x.to,
                {.label = "target", .marker = rex::Marker::kCross, .size = 2, .color = rex::Color{0, 0, 0}})};
  if (got.parent >= 0 && got.parent < states.cols())
    figure.series.push_back(rex::through({states.col(got.parent), got.x}, rex::grading::gotCurve("got")));
  return {.figures = {figure}};
}

/// A step of tau seconds from the state that needs the least effort.
inline void phaseStepFits(rex::grading::Check& check, Student& student,
                          const std::vector<Eigen::Vector2d>& states, const Transfer& x, double tau) {
  std::size_t best = 0, nearest = 0;
  Eigen::Matrix2Xd columns(2, static_cast<Eigen::Index>(states.size()));
  for (std::size_t k = 0; k < states.size(); ++k) {
    columns.col(static_cast<Eigen::Index>(k)) = states[k];
    if (rex::leastEffort(states[k], x.to, x.T) < rex::leastEffort(states[best], x.to, x.T)) best = k;
    if ((states[k] - x.to).norm() < (states[nearest] - x.to).norm()) nearest = k;
  }
  check.input(states.size() == 1 ? "a step from one state" : "a step from one of several states",
              {{"states, in columns", columns}, {"target", x.to}, {"T", x.T}, {"tau", tau}});
  const PhaseNode node = student.phaseStep(states, x.to, x.T, tau);
  const Eigen::Vector2d& from = states[best];
  const auto shown = check.show([&] { return phaseSeen(columns, x, tau, node, static_cast<int>(best)); });
  {
    check.near("parent of phaseStep: the number of the state", node.parent, static_cast<double>(best), 0,
               {{"Is it the nearest state in the picture? Wanted is that with the least effort.",
                 static_cast<double>(nearest)}});
  }
  const double u = rex::leastEffortForce(from, x.to, x.T, 0);
  const Eigen::Vector2d wanted = rex::leastEffortState(from, x.to, x.T, tau);
  check.near("state x of phaseStep", node.x, wanted, 1e-8 * (1 + x.T * x.T),
             {{"Is it one step of Euler's method? The motion is known exactly.",
               Eigen::Vector2d(from[0] + tau * from[1], from[1] + tau * u)},
              {"Is the force left out?", Eigen::Vector2d(from[0] + tau * from[1], from[1])},
              {"Is it the whole motion? Wanted is the state after tau seconds.", x.to}});
}
