#include "course/car_view.h"

#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "base/vector_arg.h"
#include "estimation/covariance.h"

namespace rex {
namespace {

constexpr double kFarthest = 1e9;  // metres, as in a Picture
constexpr double kWidest = 50;

void requireNumbers(const std::string& what, const VectorArg& numbers) {
  requireFinite(what, numbers);
  for (Eigen::Index i = 0; i < numbers.size(); ++i)
    if (std::abs(numbers[i]) > kFarthest)
      throw Error({.what = fmt::format("{}: number {}", what, i),
                   .found = fmt::format("{:g}", numbers[i]),
                   .wanted = fmt::format("at most {:g}", kFarthest)});
}

void requireColumns(const std::string& what, const MatrixArg& columns) {
  if (columns.size() == 0 || columns.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kFarthest) return;
  for (Eigen::Index i = 0; i < columns.cols(); ++i)
    requireNumbers(fmt::format("{} {}", what, i), columns.col(i));
}

void requireBeliefs(const char* what, const std::vector<PlanarGaussian>& beliefs) {
  for (std::size_t i = 0; i < beliefs.size(); ++i) {
    const std::string name = fmt::format("{} {}", what, i);
    requireNumbers(name, beliefs[i].mean);
    requireCovariance(name, beliefs[i].covariance, 2);
    requireNumbers(name + ", deviations", beliefs[i].covariance.diagonal().cwiseMax(0).cwiseSqrt());
  }
}

}  // namespace

void requireDrawable(const CarView& view) {
  if (view.car) requireNumbers("car", *view.car);
  if (view.estimate) requireNumbers("estimate of the car", *view.estimate);
  requireColumns("landmark", view.landmarks);
  requireColumns("particle", view.particles);
  requireColumns("sighting", view.sightings);
  requireColumns("dot of the scan", view.scan);
  for (const Way& way : view.ways) {
    requireColumns("way '" + way.name + "', point", way.points);
    if (!(way.width > 0 && way.width <= kWidest))
      throw Error({.what = "way '" + way.name + "', width",
                   .found = fmt::format("{:g}", way.width),
                   .wanted = fmt::format("more than 0, at most {:g} pixels", kWidest)});
  }
  if (view.weights.size() > 0) {
    requireSize("weights of particles", view.weights.size(), view.particles.cols());
    requireNotNegative("weights of particles", view.weights);
    requireNumbers("weights of particles", view.weights);
  }
  requireBeliefs("belief of a pose", view.poseBeliefs);
  requireBeliefs("belief of a landmark", view.landmarkBeliefs);
  requirePositive("sigmas", view.sigmas);
  requirePositive("scale of the car", view.carScale);
  if (view.sightings.cols() > 0 && !view.car && !view.estimate)
    throw Error({.what = "sightings", .found = "no car and no estimate", .wanted = "one that sees them"});
}

}  // namespace rex
