#include "cli/methods/filter_statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace rex::cli {

void FilterStatisticsBuilder::add(const FilterRun& run) {
  const auto steps = static_cast<std::size_t>(run.steps());
  assert(regular_.empty() || regular_.size() == steps);
  sums_.stepNees.resize(steps);
  regular_.resize(steps);
  const Eigen::Matrix3Xd errors = run.errors();
  const double position = errors.topRows<2>().squaredNorm(), heading = errors.row(2).squaredNorm();
  sums_.position += position;
  sums_.heading += heading;
  sums_.deadReckoning += (run.deadReckoning - run.truth).topRows<2>().squaredNorm();
  double nees = 0;
  int regular = 0;
  for (std::size_t t = 0; t < steps; ++t) {
    sums_.nis += run.updates[t].nis;
    sums_.innovations += run.updates[t].degrees;
    if (!std::isfinite(run.nees[t])) continue;
    nees += run.nees[t];
    ++regular;
    sums_.stepNees[t] += run.nees[t];
    ++regular_[t];
  }
  nees_ += nees;
  sums_.singular += run.steps() - regular;
  for (const FoundLandmark& one : run.map) {
    const Eigen::Vector2d found = one.belief.mean;
    sums_.map += one.landmark ? (found - run.landmarks.col(*one.landmark)).squaredNorm()
                              : (run.landmarks.colwise() - found).colwise().squaredNorm().minCoeff();
  }
  sums_.foundLandmarks += static_cast<int>(run.map.size());
  const double n = run.steps();
  sums_.runs.push_back({run.seed, std::sqrt(position / n), std::sqrt(heading / n), {}});
  if (regular > 0) sums_.runs.back().nees = nees / regular;
}

FilterStatistics FilterStatisticsBuilder::statistics() const {
  assert(!sums_.runs.empty());
  FilterStatistics result = sums_;
  const auto runs = static_cast<int>(sums_.runs.size());
  const double n = static_cast<double>(sums_.stepNees.size()) * runs;
  for (double* sum : {&result.position, &result.heading, &result.deadReckoning}) *sum = std::sqrt(*sum / n);
  result.map = std::sqrt(sums_.map / std::max(sums_.foundLandmarks, 1));
  const double regular = std::accumulate(regular_.begin(), regular_.end(), 0.);
  if (regular > 0) result.nees = nees_ / regular;
  result.stepBand = consistencyBand(runs, 3);
  int inside = 0;
  for (std::size_t t = 0; t < regular_.size(); ++t) {
    result.stepNees[t] /= std::max(regular_[t], 1);
    inside += regular_[t] == runs && result.stepNees[t] >= result.stepBand.lower &&
              result.stepNees[t] <= result.stepBand.upper;
  }
  result.insideBand = inside / static_cast<double>(regular_.size());
  if (sums_.innovations == 0) return result;
  // Innovations of a consistent filter are independent of each other, so all of them count.
  result.nis = sums_.nis / sums_.innovations;
  result.nisBand = consistencyBand(sums_.innovations, 1);
  return result;
}

}  // namespace rex::cli
