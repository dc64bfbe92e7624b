#include "estimation/scan_weights.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "estimation/range_scan_internal.h"

namespace rex {

ScanLookup::ScanLookup(const OccupancyMap& map, const RangeScanner& scanner, double cell, int headings)
    : scanner_(scanner) {
  requirePositive("lookup of scans: size of a cell", cell, kMetres);
  requireCount("lookup of scans: headings", headings, 1);
  const Eigen::Vector2d cells = (map.cellSize() / cell * Eigen::Array2d(map.width(), map.height())).ceil();
  constexpr double kMost = 1e7;
  if (const double poses = cells.prod() * headings; poses > kMost)
    throw Error({.what = "lookup of scans: poses",
                 .found = fmt::format("{:g}", poses),
                 .wanted = fmt::format("at most {:g}", kMost)});
  grid_.lower.resize(3);
  grid_.lower << map.origin(), -std::numbers::pi;
  grid_.size = Eigen::Vector3d(cell, cell, 2 * std::numbers::pi / headings);
  grid_.counts.resize(3);
  grid_.counts << static_cast<int>(cells.x()), static_cast<int>(cells.y()), headings;
  grid_.angles = {2};
  for (int i = 0; i < grid_.cells(); ++i) {
    const Eigen::Vector2i at = map.cellAt(grid_.center(i).head<2>());
    if (map.contains(at[0], at[1]) && map.logOdds(at[0], at[1]) < 0) free_.push_back(i);
  }
  if (free_.empty())
    throw Error({.what = "lookup of scans",
                 .found = fmt::format("no free cell of the map at steps of {:g} m", cell),
                 .wanted = "one or more"});
  const auto rays = static_cast<Eigen::Index>(scanner.angles.size());
  expected_.resize(rays, static_cast<Eigen::Index>(free_.size()));
  Eigen::VectorXd ranges(rays);
  for (std::size_t k = 0; k < free_.size(); ++k) {
    map.scan(scanner, grid_.center(free_[k]), ranges);
    expected_.col(static_cast<Eigen::Index>(k)) = ranges.cast<float>();
  }
}

StateDensity ScanLookup::anywhere() const {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(grid_.cells());
  weights(free_).setOnes();
  return gridDensity(grid_, weights);
}

StateDensity ScanLookup::given(const VectorArg& ranges, double deviation, double temper) const {
  constexpr float kMost = 3;  // standard deviations
  internal::requireRanges(scanner_, ranges);
  requirePositive("lookup of scans: deviation", deviation, kMetres);
  requirePositive("lookup of scans: temper", temper);
  const Eigen::ArrayXf scaled = (ranges / deviation).cast<float>().array();
  const float inverse = static_cast<float>(1 / deviation);
  Eigen::VectorXd squares(expected_.cols());
  for (Eigen::Index k = 0; k < expected_.cols(); ++k)
    squares[k] = (inverse * expected_.col(k).array() - scaled).abs().min(kMost).square().sum();
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(grid_.cells());
  weights(free_) = (-0.5 / temper * (squares.array() - squares.minCoeff())).exp();
  return gridDensity(grid_, weights);
}

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

LogLikelihood scanWeights(const OccupancyMap& map, RangeScanner scanner, const VectorArg& ranges,
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
