#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "course/film.h"
#include "grading/check.h"
#include "grading/evidence.h"
#include "interface.h"
#include "task_checks.h"

// Part 2: what must hold for a motion, and on the circle.

using Motion = std::vector<Eigen::VectorXd>;

inline const Eigen::Vector3d kTarget(-0.2, -0.4, 1.1), kUp(0, 0, 1);

inline rex::Simulator at(const rex::Simulator& S, const Eigen::VectorXd& q) {
  rex::SimulatorDescription description = S.description();
  description.q = q;
  return rex::Simulator(description);
}

// There are `count` postures, each of n finite numbers.
inline void checkPostures(rex::grading::Check& check, const Motion& motion, int count, int n) {
  check.near("number of postures", static_cast<double>(motion.size()), count, 0);
  for (const Eigen::VectorXd& q : motion) check.shape("posture", q, n, 1);
}

struct Circle {
  std::string hand;
  Eigen::Vector3d center;
  double radius;
  std::string pointing;
};

inline const Circle kCircle{"handR", kTarget, 0.2, "handL"};

inline Motion circleOf(rex::grading::Check& check, Student& student, const rex::Simulator& S,
                       const Circle& circle, int T) {
  const Motion motion =
      student.circleWithTasks(S.description(), circle.hand, circle.center, circle.radius, circle.pointing, T);
  checkPostures(check, motion, T, S.getJointDimension());
  return motion;
}

// f(S, t) from step `first` on.
template <class F>
rex::grading::Signal along(const rex::Simulator& S, const Motion& motion, int first, const F& f) {
  rex::grading::Signal signal;
  rex::Simulator moved = S;
  for (int t = first; t <= static_cast<int>(motion.size()); ++t) {
    moved.setJointAngles(motion[static_cast<std::size_t>(t) - 1]);
    signal.add(t, f(moved, t));
  }
  return signal;
}

// The motion as a film of at most some 300 frames, with the path in the world that the body should follow.
inline rex::grading::Evidence seen(const rex::Simulator& S, const std::string& body, const Motion& motion,
                                   const std::vector<Eigen::Vector3d>& path = {}) {
  const std::size_t stride = 1 + motion.size() / 300;
  Motion shown;
  for (std::size_t t = 0; t < motion.size(); t += stride) shown.push_back(motion[t]);
  rex::Film film = rex::makeFilm(S, shown, {.traces = {body}, .paths = {path}});
  for (rex::Frame& frame : film)
    if (!path.empty()) frame.picture.captions.push_back({.text = "grey: the wanted path"});
  return {.film = std::move(film)};
}

// 2e-4 m is usual: the home task pulls the hand off its circle in proportion to the precisions.
inline void tracks(rex::grading::Check& check, const rex::Simulator& S, const Circle& circle,
                   const Motion& motion, double most = 2e-3) {
  const auto wanted = [&](int t) -> Eigen::Vector3d {
    return circle.center + circle.radius * Eigen::Vector3d(std::cos(t / 20.), 0, std::sin(t / 20.));
  };
  const auto error = [&](const rex::Simulator& moved, int t) {
    return (moved.kinematicsPos(circle.hand) - wanted(t)).norm();
  };
  const auto shown = check.show([&] {
    std::vector<Eigen::Vector3d> path;
    for (int t = 0; t < 126; ++t) path.push_back(wanted(t));
    return seen(S, circle.hand, motion, path);
  });
  check.atMostAlong("distance of " + circle.hand + " from its point on the circle, in circleWithTasks",
                    along(S, motion, 20, error), most, "m");
}

inline void staysAtHome(rex::grading::Check& check, const rex::Simulator& S, const Motion& motion) {
  const Eigen::VectorXd atFirst = S.getJointAngles();
  const auto away = [&](const rex::Simulator& moved, int) {
    return (moved.getJointAngles() - atFirst).cwiseAbs().maxCoeff();
  };
  const auto shown = check.show([&] {
    rex::grading::Evidence evidence = seen(S, "handR", motion);
    evidence.film = rex::grading::withWanted(evidence.film, rex::makeFilm(S, Motion{atFirst}, {}));
    return evidence;
  });
  check.atMostAlong("largest deviation of a joint from its home angle, in circleWithTasks",
                    along(S, motion, 1, away), 2.2, "rad");
}

inline void pointsUpwards(rex::grading::Check& check, const rex::Simulator& S, const Circle& circle,
                          const Motion& motion) {
  const auto axis = [&](const rex::Simulator& moved, int) { return moved.kinematicsVec(circle.pointing); };
  const rex::grading::Signal got = along(S, motion, 100, axis);
  const auto shown = check.show([&] { return seen(S, circle.pointing, motion); });
  check.nearAlong("z axis of " + circle.pointing + ", in circleWithTasks", got,
                  Motion(got.values.size(), kUp), 0.05);
}
