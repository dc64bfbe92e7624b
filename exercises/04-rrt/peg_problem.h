#pragma once

#include <numbers>

#include "collision/contacts.h"
#include "exercise.h"
#include "planning/path_problem.h"
#include "planning/robot_problem.h"

// The arm with the peg, on its way from q = 0 into the hole. Used by show.cpp and by the grader.

inline const Eigen::VectorXd kZero = Eigen::VectorXd::Zero(7);
inline const Eigen::VectorXd kInTheHole =
    (Eigen::VectorXd(7) << 0.945499, 0.431195, -1.97155, 0.623969, 2.22355, -0.665206, -1.48356).finished();

inline const SearchSettings kArmSettings{Eigen::VectorXd::Constant(7, -2 * std::numbers::pi),
                                         Eigen::VectorXd::Constant(7, 2 * std::numbers::pi), 0.1, 0.1, 25000};

/// Most searches succeed within 10000 targets, but 14 of 600 from both sides find nothing within 25000, and
/// so do 2 of 300 backward searches. Restarting helps: six in a row fail less than once in 10^9.
inline constexpr int kArmTries = 6;

/// Edges of the arm are tested in steps of 0.05; they are free if everything is 0.02 m apart. Between two
/// steps nothing comes that much nearer.
inline EdgeTest freeForArm(const rex::Simulator& S) {
  const rex::Space space = rex::Space::box(kArmSettings.lower, kArmSettings.upper);
  rex::EdgeChecker checker(space, rex::contactFree(S.model(), rex::ContactModel(S.model()), 0.02), 0.05);
  return [checker](const Eigen::VectorXd& qa, const Eigen::VectorXd& qb) mutable {
    return checker.isValid(qa, qb);
  };
}
