#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "grading/check.h"

// What the checks ask.

/// What a mistake makes of a value, and what to ask whoever gets that.
struct Mistake {
  const char* question;
  Eigen::MatrixXd value;
};

inline Eigen::MatrixXd single(double number) { return Eigen::MatrixXd::Constant(1, 1, number); }

/// While the returned object is alive, near() asks about the first mistake that explains `got`.
[[nodiscard]] inline auto suspectAmong(rex::grading::Check& check, const Eigen::MatrixXd& got,
                                       double tolerance, const std::vector<Mistake>& mistakes) {
  for (const auto& [question, value] : mistakes)
    if (value.rows() == got.rows() && value.cols() == got.cols() &&
        (got - value).cwiseAbs().maxCoeff() <= tolerance)
      return check.suspect(question, got);
  return check.suspect("", {});
}

/// While the returned object is alive, any requirement asks the question, unless it is empty.
[[nodiscard]] inline auto askThat(rex::grading::Check& check, const std::string& question) {
  return check.ask(question, !question.empty());
}
