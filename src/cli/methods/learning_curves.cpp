#include "cli/methods/learning_curves.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rex::cli {
namespace {

constexpr double kLeast = 1e-20;
constexpr int kPoints = 400;

double valueAt(const LearningCurve& curve, double evaluations) {
  const auto after = std::ranges::upper_bound(curve.evaluations, evaluations);
  const auto i = std::max<std::ptrdiff_t>(0, after - curve.evaluations.begin() - 1);
  return std::max(kLeast, curve.values[static_cast<std::size_t>(i)]);
}

}  // namespace

Figure figureOf(const std::vector<LearningCurve>& curves, double target, const std::string& title) {
  assert(!curves.empty());
  double first = 0, last = 0;
  for (const LearningCurve& curve : curves) {
    first = std::max(first, curve.evaluations.front());
    last = std::max(last, curve.evaluations.back());
  }
  Figure figure{.title = title, .xLabel = "evaluations [1]", .yLabel = "best value [1]", .logY = true};
  Series median{.label = "median"};
  Band band{.label = "worst to best"};
  std::vector<double> values(curves.size());
  for (int i = 0; i < kPoints; ++i) {
    const double x = first + (last - first) * i / (kPoints - 1);
    std::ranges::transform(curves, values.begin(), [&](const LearningCurve& one) { return valueAt(one, x); });
    std::ranges::sort(values);
    median.x.push_back(x);
    median.y.push_back(values[values.size() / 2]);
    band.x.push_back(x);
    band.low.push_back(values.front());
    band.high.push_back(values.back());
  }
  if (curves.size() > 1) {
    figure.bands = {std::move(band)};
  } else {
    median.label.clear();
  }
  figure.series = {std::move(median)};
  if (target > kLeast) figure.horizontalLines = {{.at = target, .label = "target"}};
  return figure;
}

}  // namespace rex::cli
