#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "course/film.h"
#include "grading/check.h"
#include "grading/evidence.h"
#include "interface.h"

// Parts 2 and 3: the step of inverse kinematics, and the motions that are made of it.

inline const Eigen::Vector3d kTarget(-0.2, -0.4, 1.1);
inline constexpr double kSigma = 0.01;

inline rex::Simulator at(const rex::Simulator& S, const Eigen::VectorXd& q) {
  rex::SimulatorDescription description = S.description();
  description.q = q;
  return rex::Simulator(description);
}

// By another way than the normal equations: from the singular values of J.
inline Eigen::VectorXd minimumOf(const Eigen::MatrixXd& J, const Eigen::VectorXd& dy, double sigma) {
  const rex::SingularValues parts = rex::svd(J);
  const Eigen::ArrayXd s = parts.s.array(), along = (parts.U.transpose() * dy).array();
  return parts.V * (s * along / (s.square() + sigma * sigma)).matrix();
}

// The tolerance leaves room for the normal equations, which cost digits.
inline void isTheMinimum(rex::grading::Check& check, const std::string& property, const Eigen::VectorXd& dq,
                         const Eigen::MatrixXd& J, const Eigen::VectorXd& dy, double sigma) {
  check.shape(property, dq, J.cols(), 1);
  const Eigen::VectorXd minimum = minimumOf(J, dy, sigma);
  const auto bare = check.suspect("Is the term sigma^2 |dq|^2 missing?", minimumOf(J, dy, 1e-9));
  const auto rooted = check.suspect("Is sigma not squared?", minimumOf(J, dy, std::sqrt(sigma)));
  const double along = dq.dot(J.transpose() * dy) / (dq.norm() * (J.transpose() * dy).norm());
  const auto downhill =
      check.ask("It points along J^T dy: the transpose alone is no inverse.", along > 1 - 1e-9);
  check.near(property, dq, minimum, 1e-7 * minimum.norm(), "rad");
}

inline Eigen::Vector3d placeAt(const rex::Simulator& S, const std::string& body, const Eigen::VectorXd& q) {
  return at(S, q).kinematicsPos(body);
}

using Motion = std::vector<Eigen::VectorXd>;

// There are `count` postures, each of n finite numbers.
inline void checkPostures(rex::grading::Check& check, const Motion& motion, int count, int n) {
  check.near("number of postures", static_cast<double>(motion.size()), count, 0);
  for (const Eigen::VectorXd& q : motion) check.shape("posture", q, n, 1);
}

using Place = std::function<Eigen::Vector3d(int step)>;

// The motion as a film, with the wanted position of the body at each step.
inline rex::grading::Evidence seen(const rex::Simulator& S, const std::string& body, const Motion& motion,
                                   const Place& wanted) {
  std::vector<Eigen::Vector3d> way;
  for (int t = 1; t <= static_cast<int>(motion.size()); ++t) way.push_back(wanted(t));
  rex::Film film = rex::makeFilm(S, motion, {.traces = {body}, .paths = {way}});
  for (std::size_t i = 0; i < film.size(); ++i)
    film[i].picture.pointSets.push_back({.points = {way[i]}, .color = {.8f, .1f, .12f}, .size = 9});
  return {.film = std::move(film)};
}

// The distance of the body from its wanted position, from step `first` on.
inline rex::grading::Signal distance(const rex::Simulator& S, const std::string& body, const Motion& motion,
                                     int first, const Place& wanted) {
  rex::grading::Signal signal;
  for (int t = first; t <= static_cast<int>(motion.size()); ++t)
    signal.add(t, (placeAt(S, body, motion[static_cast<std::size_t>(t) - 1]) - wanted(t)).norm());
  return signal;
}

inline double largest(const rex::grading::Signal& signal) {
  double value = 0;
  for (const Eigen::VectorXd& one : signal.values) value = std::max(value, one[0]);
  return value;
}

struct ErrorAfter {
  int step;
  double error;
};

// Two mistakes: steps with the Jacobian of the first posture, and with its position or with the present one.
inline Motion fromTheFirstPosture(const rex::Simulator& S, double alpha, int steps, bool presentPosition) {
  const Eigen::MatrixXd J = S.jacobianPos("handR");
  rex::Simulator moving = S;
  Motion motion;
  Eigen::VectorXd q = S.getJointAngles();
  for (int t = 0; t < steps; ++t) {
    const rex::Simulator& from = presentPosition ? moving : S;
    q += alpha * minimumOf(J, kTarget - from.kinematicsPos("handR"), kSigma);
    moving.setJointAngles(q);
    motion.push_back(q);
  }
  return motion;
}

inline rex::grading::Evidence errorSeen(const rex::Simulator& S, const Motion& motion,
                                        const rex::grading::Signal& got,
                                        const std::vector<ErrorAfter>& known) {
  rex::Figure figure{
      .title = "Distance of handR from the target", .xLabel = "step", .yLabel = "distance [m]"};
  figure.series = {rex::grading::gotCurve("got", got.at), rex::grading::wantedCurve("wanted")};
  for (const Eigen::VectorXd& value : got.values) figure.series[0].y.push_back(value[0]);
  for (const auto& [step, error] : known) figure.series[1].add(step, error);
  rex::grading::Evidence evidence = seen(S, "handR", motion, [](int) { return kTarget; });
  evidence.moment = evidence.film[static_cast<std::size_t>(known.front().step) - 1].time;
  evidence.figures = {std::move(figure)};
  return evidence;
}

inline void errorSequence(rex::grading::Check& check, Student& student, double alpha, int steps,
                          const std::vector<ErrorAfter>& known) {
  const rex::Simulator S("man.ors");
  check.input("man.ors, handR to (-0.2, -0.4, 1.1), sigma 0.01, alpha " +
              std::string(alpha == 1 ? "1" : "0.1"));
  const Motion motion = student.smallSteps(S.description(), "handR", kTarget, alpha, kSigma, steps);
  checkPostures(check, motion, steps, S.getJointDimension());
  const rex::grading::Signal got = distance(S, "handR", motion, 1, [](int) { return kTarget; });
  const auto shown = check.show([&] { return errorSeen(S, motion, got, known); });
  const double start = (S.kinematicsPos("handR") - kTarget).norm();
  const auto unmoved =
      check.suspect("The hand is where it started: is S never moved, or the posture kept before the step?",
                    Eigen::MatrixXd::Constant(1, 1, start));
  const Motion frozen = fromTheFirstPosture(S, alpha, steps, false),
               stale = fromTheFirstPosture(S, alpha, steps, true);
  const auto same = check.ask("All postures are the same: does every step begin where the first one did?",
                              motion.front() == motion.back());
  for (const auto& [step, error] : known) {
    const auto errorIn = [&, t = static_cast<std::size_t>(step) - 1](const Motion& other) {
      return Eigen::MatrixXd::Constant(1, 1, (placeAt(S, "handR", other[t]) - kTarget).norm());
    };
    const auto never =
        check.suspect("All steps are those of the first posture: is S moved after each?", errorIn(frozen));
    const auto once =
        check.suspect("Is the Jacobian that of the first posture in all steps?", errorIn(stale));
    check.near("distance of handR from the target after step " + std::to_string(step) + " of smallSteps",
               got.values[static_cast<std::size_t>(step) - 1][0], error, 1e-4 + 1e-3 * error, "m");
  }
}

inline void fullSteps(rex::grading::Check& check, Student& student) {
  errorSequence(check, student, 1, 6, {{1, 0.1750}, {2, 0.0297}, {3, 0.0015}, {4, 4e-6}});
}

inline void stepsOfATenth(rex::grading::Check& check, Student& student) {
  errorSequence(check, student, 0.1, 100, {{1, 0.3041}, {10, 0.1179}, {50, 0.0018}, {100, 9e-6}});
}

inline void followsTheLine(rex::grading::Check& check, Student& student, const rex::Simulator& S,
                           const std::string& body, const Eigen::Vector3d& target, int T, double tolerance) {
  const Eigen::Vector3d first = S.kinematicsPos(body);
  const Motion motion = student.straightLine(S.description(), body, target, kSigma, T);
  checkPostures(check, motion, T, S.getJointDimension());
  const auto onLine = [&](int t) -> Eigen::Vector3d {
    return first + static_cast<double>(t) / T * (target - first);
  };
  const auto shown = check.show([&] { return seen(S, body, motion, onLine); });
  const auto atOnce =
      check.ask("Is the body sent to the far target at once, in every step?",
                (placeAt(S, body, motion[4]) - target).norm() < 0.3 * (first - target).norm());
  check.atMostAlong("distance of " + body + " from the moving target, in straightLine",
                    distance(S, body, motion, 1, onLine), tolerance, "m");
}

inline void followsTheCircle(rex::grading::Check& check, Student& student, const rex::Simulator& S,
                             const std::string& body, const Eigen::Vector3d& center, double radius, int T,
                             int approach, double tolerance) {
  const Motion motion = student.circle(S.description(), body, center, radius, kSigma, T);
  checkPostures(check, motion, T, S.getJointDimension());
  const auto onCircle = [&](int t) -> Eigen::Vector3d {
    return center + radius * Eigen::Vector3d(std::cos(t / 20.), 0, std::sin(t / 20.));
  };
  const auto flat = [&](int t) -> Eigen::Vector3d {
    return center + radius * Eigen::Vector3d(std::cos(t / 20.), std::sin(t / 20.), 0);
  };
  const auto fits = [&](const Place& place) {
    return largest(distance(S, body, motion, approach, place)) <= tolerance;
  };
  const auto shown = check.show([&] { return seen(S, body, motion, onCircle); });
  const auto lies =
      check.ask("Does your circle lie in the plane of x and y? Wanted is that of x and z.", fits(flat));
  const auto late = check.ask("Is the point on the circle that of one step earlier?",
                              fits([&](int t) { return onCircle(t - 1); }));
  check.atMostAlong("distance of " + body + " from its point on the circle, in circle",
                    distance(S, body, motion, approach, onCircle), tolerance, "m");
}
