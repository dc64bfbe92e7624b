#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "grading/evidence_parts.h"
#include "learning/dynamic_programming.h"
#include "learning/policy_values.h"

// What the checks show if values or policies are wrong.

/// The T-maze with a value in each of its states, as a number and a colour from `range`.
inline rex::Figure mazeFigure(const std::string& title, const Eigen::VectorXd& values,
                              const rex::AxisRange& range) {
  const std::vector<Eigen::Vector2d> places{{0, 0}, {-1, 1}, {1, 1}, {-1.5, 2}, {-.5, 2}, {.5, 2}, {1.5, 2}};
  rex::Figure figure{.title = title,
                     .xLabel = "left and right",
                     .yLabel = "junctions",
                     .colorLabel = "value",
                     .xRange = rex::AxisRange(-2, 2),
                     .yRange = rex::AxisRange(-.4, 2.5),
                     .colorRange = range,
                     .legend = rex::Legend::kNone,
                     .width = 560,
                     .height = 460};
  for (std::size_t child = 1; child < places.size(); ++child)
    figure.series.push_back(
        rex::grading::through(std::vector<Eigen::Vector2d>{places[(child - 1) / 2], places[child]},
                              rex::Series{.size = 2, .color = rex::Color{.6f, .62f, .65f}}));
  figure.series.push_back(rex::grading::through(
      places, rex::Series{.style = rex::SeriesStyle::kPoints, .marker = rex::Marker::kSquare, .size = 4}));
  figure.series.back().values.assign(values.begin(), values.end());
  for (std::size_t i = 0; i < places.size(); ++i)
    figure.notes.push_back({fmt::format("s{}: {:.3g}", i + 1, values[static_cast<Eigen::Index>(i)]),
                            places[i].x() + .12, places[i].y() + .12});
  return figure;
}

/// Values in the T-maze beside the wanted ones.
inline rex::grading::Evidence mazeSeen(const std::string& what, const Eigen::VectorXd& got,
                                       const Eigen::VectorXd& wanted) {
  if (got.size() != wanted.size()) return {};
  const double low = std::min(got.minCoeff(), wanted.minCoeff()),
               high = std::max({got.maxCoeff(), wanted.maxCoeff(), low + 1e-9});
  return {.figures = {mazeFigure(what + ": got", got, {low, high}),
                      mazeFigure(what + ": wanted", wanted, {low, high})}};
}

/// Values as bars, with the wanted ones as dots.
inline rex::grading::Evidence barsSeen(const std::string& title, const std::string& number,
                                       const Eigen::MatrixXd& got, const Eigen::MatrixXd& wanted) {
  const auto numbers = [](const Eigen::MatrixXd& M) {
    return std::vector<double>(M.data(), M.data() + M.size());
  };
  const rex::Series dots{.label = "wanted",
                         .y = numbers(wanted),
                         .style = rex::SeriesStyle::kPoints,
                         .marker = rex::Marker::kDot,
                         .size = 2,
                         .color = rex::grading::kWantedColor};
  return {.figures = {{.title = title,
                       .xLabel = number,
                       .yLabel = "value",
                       .series = {dots},
                       .histograms = {{.label = "got", .heights = numbers(got)}}}}};
}

/// The bounds on the errors of V_1, V_2, ..., with the bound that only the last should reach.
inline rex::grading::Evidence settlingSeen(const rex::Mdp& mdp, const std::vector<Eigen::VectorXd>& V,
                                           double tolerance) {
  const Eigen::VectorXd best = rex::policyIteration(mdp).V;
  rex::Series error = rex::grading::gotCurve("got: bound on the error of V_k");
  for (std::size_t k = 1; k < V.size(); ++k) {
    if (V[k].size() != best.size() || V[k - 1].size() != best.size()) return {};
    const double bound = mdp.discount / (1 - mdp.discount) * (V[k] - V[k - 1]).cwiseAbs().maxCoeff();
    if (!(bound > 0)) continue;
    error.x.push_back(static_cast<double>(k));
    error.y.push_back(bound);
  }
  if (error.y.empty()) return {};
  const double most = *std::max_element(error.y.begin(), error.y.end());
  rex::Figure figure{.title = "Value iteration until it ends",
                     .xLabel = "k",
                     .yLabel = "bound",
                     .logY = true,
                     .yRange = rex::AxisRange(tolerance / 5, 2 * std::max(most, tolerance)),
                     .series = {error}};
  figure.horizontalLines = {{.at = tolerance, .label = "wanted: only the last is at most this"}};
  return {.figures = {figure}};
}

/// The values of the policies, one after the other, averaged over the states.
inline rex::grading::Evidence policiesSeen(const rex::Mdp& mdp,
                                           const std::vector<std::vector<int>>& policies) {
  rex::Series worth = rex::grading::gotCurve("got");
  worth.style = rex::SeriesStyle::kLinesPoints;
  for (const std::vector<int>& actions : policies) {
    worth.x.push_back(static_cast<double>(worth.x.size()));
    worth.y.push_back(rex::policyValues(mdp, rex::policyOf(mdp, actions)).V.mean());
  }
  const double best = rex::policyIteration(mdp).V.mean();
  const double end = std::max(1., static_cast<double>(policies.size()) - 1);
  return {.figures = {
              {.title = "Policy iteration: each policy is better than the one before",
               .xLabel = "number of the policy",
               .yLabel = "value, mean over the states",
               .series = {worth, rex::grading::wantedCurve("wanted at the end", {0, end}, {best, best})}}}};
}

/// Two directions in the plane, from `from`.
inline rex::grading::Evidence arrowsSeen(const std::string& title, const Eigen::Vector2d& from,
                                         const Eigen::VectorXd& got, const Eigen::VectorXd& wanted) {
  if (got.size() != 2 || wanted.size() != 2) return {};
  const auto arrow = [&](const Eigen::VectorXd& to, rex::Series look) {
    look.style = rex::SeriesStyle::kLinesPoints;
    return rex::grading::through(std::vector<Eigen::Vector2d>{from, from + to}, look);
  };
  return {.figures = {{.title = title,
                       .xLabel = "beta_1",
                       .yLabel = "beta_2",
                       .equalAxes = true,
                       .series = {arrow(got, rex::grading::gotCurve("got")),
                                  arrow(wanted, rex::grading::wantedCurve("wanted"))}}}};
}
