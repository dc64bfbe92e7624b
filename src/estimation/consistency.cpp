#include "estimation/consistency.h"

#include <cmath>
#include <numbers>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "geometry/pose.h"
#include "geometry/rotation.h"

namespace rex {
namespace {

// Regularised lower incomplete gamma function: a series below its bend, a continued fraction above
// (Abramowitz and Stegun 6.5.29 and 6.5.31).
double lowerGamma(double a, double x) {
  if (x <= 0) return 0;
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (double n = a + 1; std::abs(term) > 1e-17 * sum; ++n) sum += term *= x / n;
    return front * sum;
  }
  // Lentz's method.
  double b = x + 1 - a, c = 1e300, d = 1 / b, fraction = d;
  for (int i = 1; i < 10000; ++i) {
    const double factor = -i * (i - a);
    b += 2;
    d = 1 / (factor * d + b);
    c = b + factor / c;
    fraction *= c * d;
    if (std::abs(c * d - 1) < 1e-16) break;
  }
  return 1 - front * fraction;
}

void requireProbability(double probability) {
  if (probability > 0 && probability < 1) return;
  throw Error(
      {.what = "probability", .found = fmt::format("{:g}", probability), .wanted = "between 0 and 1"});
}

void requireSteps(long estimated, long wanted, int steps) {
  requireSize("estimated poses", estimated, wanted);
  if (steps > 0 && steps < wanted) return;
  throw Error({.what = "steps of the relative error",
               .found = fmt::format("{}", steps),
               .wanted = fmt::format("1 to {}", wanted - 1)});
}

}  // namespace

double estimationErrorSquared(const Gaussian& belief, const VectorArg& truth, std::span<const int> angles) {
  requireSize("truth", truth.size(), belief.mean.size());
  requireFinite("truth", truth);
  Eigen::VectorXd near = truth;
  for (const int i : angles) {
    if (i < 0 || i >= truth.size())
      throw Error({.what = "angle among the numbers",
                   .found = fmt::format("number {}", i),
                   .wanted = fmt::format("0 to {}", truth.size() - 1)});
    near[i] = belief.mean[i] + wrapAngle(truth[i] - belief.mean[i]);
  }
  return squaredMahalanobis(belief, near);
}

double chiSquareProbability(double x, double degrees) {
  requirePositive("degrees of freedom", degrees);
  if (std::isnan(x)) requireFinite("chi-square number", x);
  return std::isinf(x) ? (x > 0 ? 1 : 0) : lowerGamma(degrees / 2, x / 2);
}

double chiSquareQuantile(double probability, double degrees) {
  requirePositive("degrees of freedom", degrees);
  requireProbability(probability);
  double low = 0, high = degrees + 10;
  while (chiSquareProbability(high, degrees) < probability) high *= 2;
  for (int i = 0; i < 200 && high - low > 1e-15 * high; ++i) {
    const double middle = (low + high) / 2;
    (chiSquareProbability(middle, degrees) < probability ? low : high) = middle;
  }
  return (low + high) / 2;
}

ConsistencyBand consistencyBand(double runs, double degrees, double probability) {
  if (!(runs >= 1)) throw Error({.what = "runs", .found = fmt::format("{:g}", runs), .wanted = "at least 1"});
  requireProbability(probability);
  // The sum of the runs is chi-square, too.
  const double tail = (1 - probability) / 2;
  return {chiSquareQuantile(tail, runs * degrees) / runs, chiSquareQuantile(1 - tail, runs * degrees) / runs};
}

double absoluteTrajectoryError(const MatrixArg& estimate, const MatrixArg& truth) {
  requireSize("estimated positions", estimate.cols(), truth.cols());
  requireSize("coordinates of an estimated position", estimate.rows(), truth.rows());
  if (truth.cols() == 0)
    throw Error({.what = "trajectory", .found = "no positions", .wanted = "one or more"});
  const Eigen::Index d = truth.rows();
  // The best shift lets the middles coincide, the best rotation follows from the correlation (Umeyama 1991).
  const Eigen::VectorXd middle = estimate.rowwise().mean(), wanted = truth.rowwise().mean();
  const Eigen::MatrixXd from = estimate.colwise() - middle, to = truth.colwise() - wanted;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(to * from.transpose(),
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::MatrixXd U = svd.matrixU();
  const Eigen::MatrixXd& V = svd.matrixV();
  if (U.determinant() * V.determinant() < 0) U.col(d - 1) *= -1;
  const Eigen::MatrixXd R = U * V.transpose(), error = to - R * from;
  return std::sqrt(error.squaredNorm() / static_cast<double>(truth.cols()));
}

RelativeError relativePoseError(std::span<const Pose> estimate, std::span<const Pose> truth, int steps) {
  requireSteps(static_cast<long>(estimate.size()), static_cast<long>(truth.size()), steps);
  const std::size_t k = static_cast<std::size_t>(steps), count = truth.size() - k;
  double translation = 0, rotation = 0;
  for (std::size_t t = 0; t < count; ++t) {
    const Pose error =
        (truth[t].inverse() * truth[t + k]).inverse() * (estimate[t].inverse() * estimate[t + k]);
    translation += error.p.squaredNorm();
    rotation += logSE3({error.R, Eigen::Vector3d::Zero()}).tail<3>().squaredNorm();
  }
  const double n = static_cast<double>(count);
  return {std::sqrt(translation / n), std::sqrt(rotation / n)};
}

RelativeError relativePoseError(const MatrixArg& estimate, const MatrixArg& truth, int steps) {
  requireSize("coordinates of an estimated pose", estimate.rows(), 3);
  requireSize("coordinates of a pose", truth.rows(), 3);
  const auto posesOf = [](const MatrixArg& planar) {
    std::vector<Pose> poses;
    for (Eigen::Index t = 0; t < planar.cols(); ++t)
      poses.push_back(translation(planar(0, t), planar(1, t), 0) *
                      rotation(planar(2, t), Eigen::Vector3d::UnitZ()));
    return poses;
  };
  return relativePoseError(posesOf(estimate), posesOf(truth), steps);
}

}  // namespace rex
