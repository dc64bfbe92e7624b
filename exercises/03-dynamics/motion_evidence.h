#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "approach_checks.h"
#include "course/film.h"
#include "grading/evidence.h"
#include "grading/signal.h"

// What the checks show when a motion is wrong.

inline std::vector<double> timesOf(std::size_t steps) {
  std::vector<double> times;
  for (std::size_t i = 0; i < steps; ++i) times.push_back(kTau * static_cast<double>(i));
  return times;
}

/// The remaining share of the way to a goal over time, with the requirements: near the goal from T on, and
/// some overshoot if it should oscillate.
inline rex::grading::Evidence approachSeen(const Approach& approach, Regime regime, double T) {
  const std::vector<double> times = timesOf(approach.size());
  const double end = times.empty() ? T : std::max(times.back(), 1.5 * T);
  rex::Figure figure{.title = "The remaining share of the way",
                     .xLabel = "time [s]",
                     .yLabel = "distance from the goal / distance at the start"};
  figure.series = {rex::grading::gotCurve("got", times, approach),
                   rex::grading::wantedCurve("wanted at the end", {0, end}, {0, 0})};
  figure.bands = {{.label = "wanted from T on: within 1 %",
                   .x = {T, end},
                   .low = {-.01, -.01},
                   .high = {.01, .01},
                   .color = rex::grading::kWantedColor}};
  if (regime == Regime::kOscillatory)
    figure.bands.push_back({.label = "wanted: turns back in this band",
                            .x = {0, end},
                            .low = {-.6, -.6},
                            .high = {-.03, -.03},
                            .color = rex::Color{0.0f, 0.62f, 0.45f}});
  figure.verticalLines = {{.at = T, .label = "T"}};
  return {.figures = {figure}};
}

/// Numbers over time, one for each step, with the wanted or largest allowed value.
inline rex::Figure curveOf(const std::string& title, const std::string& quantity,
                           const std::vector<double>& got, double wanted) {
  return {.title = title,
          .xLabel = "time [s]",
          .yLabel = quantity,
          .series = {rex::grading::gotCurve("got", timesOf(got.size()), got)},
          .horizontalLines = {{.at = wanted, .label = "wanted"}}};
}

/// The same for a signal over time.
inline rex::Figure curveOf(const std::string& title, const std::string& quantity,
                           const rex::grading::Signal& got, double wanted) {
  std::vector<double> values;
  for (const Eigen::VectorXd& value : got.values) values.push_back(value[0]);
  return curveOf(title, quantity, values, wanted);
}

/// A film of the postures beside the wanted ones, or beside a single wanted one. Every third step is shown.
inline rex::grading::Evidence filmed(const rex::Simulator& S, const std::vector<Eigen::VectorXd>& got,
                                     const std::vector<Eigen::VectorXd>& wanted) {
  constexpr std::size_t kStride = 3;
  std::vector<Eigen::VectorXd> shown, beside;
  for (std::size_t i = 0; i < got.size(); i += kStride) {
    shown.push_back(got[i]);
    beside.push_back(wanted[std::min(i, wanted.size() - 1)]);
  }
  rex::Film film = rex::grading::withWanted(rex::makeFilm(S, shown, {}), rex::makeFilm(S, beside, {}));
  for (std::size_t i = 0; i < film.size(); ++i) film[i].time = kTau * static_cast<double>(kStride * i);
  const double end = film.empty() ? 0 : film.back().time;
  return {.film = std::move(film), .moment = end};
}
