#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "grading/check.h"
#include "grading/evidence.h"

// What the checks ask, and what they show.

using rex::grading::Mistake;

/// The largest difference of two entries; infinite if the sizes differ.
inline double distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) return INFINITY;
  return a.size() == 0 ? 0 : (a - b).cwiseAbs().maxCoeff();
}

/// The question about the first mistake that explains `got`, or nothing.
inline std::string questionAbout(const Eigen::MatrixXd& got, double tolerance,
                                 const std::vector<Mistake>& mistakes) {
  for (const Mistake& mistake : mistakes)
    if (distance(got, mistake.value) <= tolerance) return mistake.name;
  return "";
}

/// Values as bars, with the wanted ones as dots and a ring where they differ most. If no bar shows that
/// difference, bars of it.
inline rex::grading::Evidence barsSeen(const std::string& title, const std::string& number,
                                       const Eigen::MatrixXd& got, const Eigen::MatrixXd& wanted) {
  if (got.size() != wanted.size() || got.size() == 0) return {};
  const double most = (got.reshaped() - wanted.reshaped()).cwiseAbs().maxCoeff();
  if (most > 0 && most < 0.01 * wanted.cwiseAbs().maxCoeff())
    return barsSeen(title + ", minus what was wanted", number, got.reshaped() - wanted.reshaped(),
                    Eigen::VectorXd::Zero(got.size()));
  const auto numbers = [](const Eigen::MatrixXd& M) {
    return std::vector<double>(M.data(), M.data() + M.size());
  };
  const rex::Series dots{.label = "wanted",
                         .y = numbers(wanted),
                         .style = rex::SeriesStyle::kPoints,
                         .marker = rex::Marker::kDot,
                         .size = 2,
                         .color = rex::grading::kWantedColor};
  Eigen::Index worst = 0;
  for (Eigen::Index i = 1; i < got.size(); ++i)
    if (std::abs(got.data()[i] - wanted.data()[i]) > std::abs(got.data()[worst] - wanted.data()[worst]))
      worst = i;
  return {.figures = {{.title = title,
                       .xLabel = number,
                       .yLabel = "value",
                       .series = {dots, rex::grading::wrongPoint("differs most", static_cast<double>(worst),
                                                                 got.data()[worst])},
                       .histograms = {{.label = "got", .heights = numbers(got)}}}}};
}
