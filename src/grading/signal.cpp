#include "grading/signal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "grading/evidence.h"

namespace rex::grading {
namespace {

std::vector<Eigen::Index> largest(const Eigen::VectorXd& excess) {
  constexpr std::size_t kMost = 4;
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(excess.size()));
  std::iota(rows.begin(), rows.end(), 0);
  std::stable_sort(rows.begin(), rows.end(), [&](auto a, auto b) { return excess[a] > excess[b]; });
  rows.resize(std::min(rows.size(), kMost));
  std::sort(rows.begin(), rows.end());
  return rows;
}

// One component, where it is finite.
Series curveOf(Series curve, const std::vector<double>& at, const std::vector<Eigen::VectorXd>& values,
               Eigen::Index row) {
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (!std::isfinite(values[i][row])) continue;
    curve.add(at[i], values[i][row]);
  }
  return curve;
}

}  // namespace

void Signal::add(double place, const Eigen::VectorXd& value) {
  at.push_back(place);
  values.push_back(value);
}

void Signal::add(double place, double value) { add(place, Eigen::VectorXd::Constant(1, value)); }

Signal overSteps(const std::vector<Eigen::VectorXd>& values) {
  Signal signal{.values = values};
  signal.at.resize(values.size());
  std::iota(signal.at.begin(), signal.at.end(), 1.0);
  return signal;
}

Breaches findBreaches(const std::vector<Eigen::VectorXd>& beyond) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Breaches breaches{.most = -kInfinity,
                    .ofComponents = Eigen::VectorXd::Constant(beyond.front().size(), -kInfinity)};
  for (std::size_t i = 0; i < beyond.size(); ++i) {
    const Eigen::VectorXd excess = beyond[i].array().isNaN().select(kInfinity, beyond[i]);
    breaches.ofComponents = breaches.ofComponents.cwiseMax(excess);
    const double here = excess.maxCoeff();
    if (!breaches.first && here > 0) breaches.first = i;
    if (here <= breaches.most) continue;
    breaches.most = here;
    breaches.worst = i;
  }
  return breaches;
}

std::string placeText(const Signal& signal, std::size_t i) {
  const std::size_t bracket = signal.axis.find(" [");
  if (bracket == std::string::npos) return fmt::format("{} {:.6g}", signal.axis, signal.at[i]);
  const std::string unit = signal.axis.substr(bracket + 2, signal.axis.find(']') - bracket - 2);
  return fmt::format("{} {:.6g} {}", signal.axis.substr(0, bracket), signal.at[i], unit);
}

Figure signalFigure(const std::string& title, const Signal& signal,
                    const std::vector<Eigen::VectorXd>& wanted, const Eigen::VectorXd& excess,
                    std::size_t first, std::string_view unit) {
  Figure figure{
      .title = title, .xLabel = signal.axis, .yLabel = fmt::format("value [{}]", unit.empty() ? "1" : unit)};
  for (const Eigen::Index row : largest(excess)) {
    const std::string name = excess.size() > 1 ? fmt::format("entry {}, ", row) : "";
    Series got = curveOf(gotCurve(name + "got"), signal.at, signal.values, row);
    if (got.x.empty()) continue;
    if (excess.size() > 1) got.color.reset();  // each has its own
    figure.series.push_back(std::move(got));
    if (!wanted.empty())
      figure.series.push_back(curveOf(wantedCurve(name + "wanted"), signal.at, wanted, row));
  }
  if (figure.series.size() > 2) figure.legend = Legend::kOutside;
  figure.verticalLines = {wrongFrom(signal.at[first])};
  return figure;
}

}  // namespace rex::grading
