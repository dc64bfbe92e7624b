#pragma once

#include <cmath>
#include <string>

#include "grading/check.h"
#include "interface.h"
#include "task_checks.h"

// Part 4: pairs of tasks, and what must hold for a step with strict priority.

struct TwoTasks {
  Eigen::MatrixXd J1;
  Eigen::VectorXd dy1;
  Eigen::MatrixXd J2;
  Eigen::VectorXd dy2;
};

inline TwoTasks randomTasks(rex::Rng& rng, int d1, int d2, int n) {
  return {randomMatrix(rng, d1, n), rng.normalVector(d1), randomMatrix(rng, d2, n), rng.normalVector(d2)};
}

/// Tasks that contradict each other. Each row of J1 sees one joint, and J2 combines these rows by whole
/// numbers, so that J2 N1 is zero without rounding errors.
inline TwoTasks exactTasks(rex::Rng& rng, int d1, int d2, int n) {
  TwoTasks tasks = randomTasks(rng, d1, d2, n);
  tasks.J1.setZero();
  for (int i = 0; i < d1; ++i) tasks.J1(i, n - 1 - i) = rng.index(2) == 0 ? 1 : -2;
  Eigen::MatrixXd combined(d2, d1);
  for (double& entry : combined.reshaped()) entry = 1 + rng.index(3);
  tasks.J2 = combined * tasks.J1;
  return tasks;
}

/// The second task is left out if the first leaves it no freedom.
inline Eigen::VectorXd wantedStep(const TwoTasks& tasks) {
  const Eigen::VectorXd first = rex::leastSquares(tasks.J1, tasks.dy1);
  const Eigen::MatrixXd free = nullspace(tasks.J1);
  Eigen::MatrixXd J = tasks.J2 * free;
  J = (J.array().abs() < 1e-9).select(0, J);  // the rounding errors of a row that the first task has, too
  if (J.size() == 0 || J.norm() == 0) return first;
  return first + free * rex::leastSquares(J, tasks.dy2 - tasks.J2 * first);
}

inline Eigen::VectorXd stepOf(rex::grading::Check& check, Student& student, const TwoTasks& tasks) {
  const Eigen::VectorXd dq = student.priorityStep(tasks.J1, tasks.dy1, tasks.J2, tasks.dy2);
  check.shape("dq of priorityStep", dq, tasks.J1.cols(), 1);
  return dq;
}

/// How accurate steps are: a regularisation of 1e-10 turns rounding errors into relative ones of up to 4e-3
/// (2000 random pairs).
inline constexpr double kRegularised = 5e-3;

inline void firstIsFulfilled(rex::grading::Check& check, const TwoTasks& tasks, const Eigen::VectorXd& dq,
                             double limit = kRegularised) {
  const Eigen::VectorXd missing = tasks.J1.transpose() * (tasks.J1 * dq - tasks.dy1);
  const double scale = tasks.J1.squaredNorm() * wantedStep(tasks).norm();
  check.atMost("relative gradient of the error of the first task",
               missing.norm() / (scale + (tasks.J1.transpose() * tasks.dy1).norm()), limit);
}

inline void secondIsAsGoodAsItCan(rex::grading::Check& check, const TwoTasks& tasks,
                                  const Eigen::VectorXd& dq) {
  const Eigen::MatrixXd free = nullspace(tasks.J1);
  const Eigen::VectorXd missing = tasks.J2 * dq - tasks.dy2;
  check.atMost(
      "relative gradient of the error of the second task in the directions that the first leaves free",
      (free.transpose() * tasks.J2.transpose() * missing).norm() /
          (tasks.J2.squaredNorm() * wantedStep(tasks).norm() + tasks.J2.norm() * tasks.dy2.norm()),
      kRegularised);
}

inline void isTheShortest(rex::grading::Check& check, const TwoTasks& tasks, const Eigen::VectorXd& dq) {
  Eigen::MatrixXd both(tasks.J1.rows() + tasks.J2.rows(), dq.size());
  both << tasks.J1, tasks.J2;
  check.atMost("part of dq of priorityStep that neither task asks for, relative to the wanted dq",
               (nullspace(both).transpose() * dq).norm() /
                   (wantedStep(tasks).norm() + tasks.dy2.norm() / tasks.J2.norm()),
               kRegularised);
}

inline void describe(rex::grading::Check& check, const std::string& name, const TwoTasks& tasks) {
  check.input(name, {{"J1", tasks.J1}, {"dy1", tasks.dy1}, {"J2", tasks.J2}, {"dy2", tasks.dy2}});
}

/// Tasks whose first one can be fulfilled. In `exact` ones, nothing is rounded.
inline void firstComesFirst(rex::grading::Check& check, Student& student, const TwoTasks& tasks,
                            bool isExact) {
  const Eigen::VectorXd dq = stepOf(check, student, tasks), got = tasks.J1 * dq;
  const Eigen::VectorXd first = rex::leastSquares(tasks.J1, tasks.dy1);
  // Inverses may be regularised, so that no single answer shows a mistake.
  const Eigen::VectorXd both = first + rex::leastSquares(tasks.J2, tasks.dy2 - tasks.J2 * first);
  const auto rounding = check.ask(
      "dq is more than a million times too long: are rounding errors of J2 N1 taken for freedom to move? "
      "Singular values below 1e-9 of the largest of J1 or J2 count as zero.",
      dq.norm() > 1e6 * wantedStep(tasks).norm());
  const auto all =
      check.ask("Does the second task move all joints, and not only in the nullspace of the first?",
                (got - tasks.J1 * both).cwiseAbs().maxCoeff() < kRegularised);
  const auto weighted = check.ask("Are the tasks only weighted? Then the second disturbs the first a little.",
                                  isExact && (got - tasks.dy1).norm() < 0.05);
  check.near("J1 dq, with dq of priorityStep", got, tasks.dy1, isExact ? 1e-6 : kRegularised);
}

/// Tasks that can both be fulfilled.
inline void secondComesSecond(rex::grading::Check& check, Student& student, const TwoTasks& tasks) {
  const Eigen::VectorXd dq = stepOf(check, student, tasks);
  const Eigen::VectorXd first = rex::leastSquares(tasks.J1, tasks.dy1);
  const Eigen::MatrixXd free = nullspace(tasks.J1), N = free * free.transpose();
  const auto isAlong = [&](const Eigen::VectorXd& then) {
    return (tasks.J2 * (dq - first - then)).cwiseAbs().maxCoeff() < kRegularised;
  };
  const Eigen::VectorXd left = tasks.dy2 - tasks.J2 * first;
  check.near("J1 dq, with dq of priorityStep", tasks.J1 * dq, tasks.dy1, kRegularised);
  const auto other = check.ask(
      "Is J2# that of J2? In the nullspace of the first task, it is J2 N1 that counts.",
      isAlong(N * rex::leastSquares(tasks.J2, tasks.dy2)) || isAlong(N * rex::leastSquares(tasks.J2, left)));
  const auto again =
      check.ask("Does the second task get all of dy2, also what the first step has already done of it?",
                isAlong(free * rex::leastSquares(tasks.J2 * free, tasks.dy2)));
  check.near("J2 dq, with dq of priorityStep", tasks.J2 * dq, tasks.dy2, kRegularised);
  isTheShortest(check, tasks, dq);
}
