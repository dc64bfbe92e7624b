#include "estimation/scan_weights.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "estimation/range_scan_internal.h"

namespace rex {
namespace {

void requireModel(const BeamModel& model) {
  requirePositive("beam model: deviation", model.deviation, kMetres);
  if (!(model.temper >= 1) || !std::isfinite(model.temper))
    throw Error(
        {.what = "beam model: temper", .found = fmt::format("{:g}", model.temper), .wanted = "1 or more"});
  const double sum = model.bell + model.none + model.any;
  if (!(model.bell >= 0 && model.none >= 0 && model.any > 0 && std::abs(sum - 1) < 1e-9))
    throw Error({.what = "beam model: shares",
                 .found = fmt::format("bell {:g}, none {:g}, any {:g}", model.bell, model.none, model.any),
                 .wanted = "a positive share of any, and a sum of 1"});
}

}  // namespace

Weigh scanWeights(const OccupancyMap& map, RangeScanner scanner, const VectorArg& ranges,
                  const BeamModel& model) {
  requireModel(model);
  internal::requireRanges(scanner, ranges);
  return [&map, scanner = std::move(scanner), read = Eigen::VectorXd(ranges), model](
             const MatrixArg& X, Eigen::Ref<Eigen::VectorXd> logWeights) {
    const double height = model.bell / (model.deviation * std::sqrt(2 * std::numbers::pi));
    const double floor = model.any / scanner.maxRange;
    Eigen::VectorXd expected(read.size());
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      map.scan(scanner, X.col(i), expected);
      double sum = 0;
      for (Eigen::Index k = 0; k < read.size(); ++k) {
        const double error = (read[k] - expected[k]) / model.deviation;
        // A reading without an echo has a probability of its own, spread here over the width of the bell.
        const double none = read[k] >= scanner.maxRange ? model.none / model.deviation : 0;
        sum += std::log(height * std::exp(-0.5 * error * error) + none + floor);
      }
      logWeights[i] += sum / model.temper;
    }
  };
}

}  // namespace rex
