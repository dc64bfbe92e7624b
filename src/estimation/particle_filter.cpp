#include "estimation/particle_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "base/cpu_lanes.h"
#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"
#include "estimation/gaussian.h"
#include "estimation/kalman_filter.h"
#include "estimation/kalman_filter_internal.h"
#include "estimation/weights_kernel_internal.h"

namespace rex {
namespace {

constexpr int kChunk = 64;

void requireOptions(const ParticleFilterOptions& options, Eigen::Index stateSize) {
  const auto require = [](bool isRight, const char* what, double found, const char* wanted) {
    if (!isRight) throw Error({.what = what, .found = fmt::format("{:g}", found), .wanted = wanted});
  };
  require(options.threshold >= 0 && options.threshold <= 1, "resampling threshold", options.threshold,
          "0 to 1");
  require(options.most >= options.fewest, "most particles", options.most, "at least the fewest");
  requireCount("fewest particles", options.fewest, 1);
  requirePositive("error of the adaptive count", options.error);
  if (options.cellSize.size() == 0) return;
  requireSize("sizes of cells", options.cellSize.size(), stateSize);
  requireNotNegative("sizes of cells", options.cellSize);
}

double largestFrom(double least, const double* numbers, Eigen::Index count) {
  return kernelFor<internal::WeightsKernel>(cpuLanes()).largest(numbers, count, least);
}

void requireNumbers(const Eigen::MatrixXd& states, Eigen::Index first = 0) {
  constexpr double kLeast = std::numeric_limits<double>::lowest();
  if (!std::isnan(largestFrom(kLeast, states.data(), states.size()))) return;
  for (Eigen::Index i = 0; i < states.cols(); ++i)
    if (!states.col(i).allFinite())
      throw Error(
          {.what = fmt::format("state of particle {}", first + i), .found = "numbers that are not finite"});
}

// The largest log weight.
double requireLogWeights(const Eigen::VectorXd& logWeights) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double largest = largestFrom(-kInfinity, logWeights.data(), logWeights.size());
  if (!std::isnan(largest)) return largest;
  for (Eigen::Index i = 0; i < logWeights.size(); ++i) {
    if (logWeights[i] < kInfinity) continue;
    throw Error({.what = fmt::format("log weight of particle {}", i),
                 .found = fmt::format("{:g}", std::abs(logWeights[i])),
                 .wanted = "a number, or minus infinity"});
  }
  return largest;
}

// The cell that a state lies in.
std::vector<double> cellOf(const VectorArg& state, const Eigen::VectorXd& size) {
  std::vector<double> cell;
  for (Eigen::Index i = 0; i < size.size(); ++i)
    if (size[i] > 0) cell.push_back(std::floor(state[i] / size[i]));
  return cell;
}

}  // namespace

Particles sampledParticles(const Gaussian& gaussian, int count, Rng& rng) {
  requireCount("particles", count, 1);
  requireFinite("mean", gaussian.mean);
  requireCovariance("covariance", gaussian.covariance, gaussian.mean.size());
  const Eigen::MatrixXd root = covarianceRoot(gaussian.covariance);
  const Eigen::Index n = gaussian.mean.size();
  Particles particles{Eigen::MatrixXd(n, count), Eigen::VectorXd::Constant(count, 1.0 / count)};
  for (int i = 0; i < count; ++i)
    particles.states.col(i) = gaussian.mean + root * rng.normalVector(static_cast<int>(n));
  return particles;
}

Gaussian sampleMoments(const Particles& particles) {
  requireSize("weights", particles.weights.size(), particles.states.cols());
  const Eigen::VectorXd weights = particles.weights / particles.weights.sum();
  const Eigen::VectorXd mean = particles.states * weights;
  const Eigen::MatrixXd offsets = particles.states.colwise() - mean;
  return {mean, symmetrized(offsets * weights.asDiagonal() * offsets.transpose())};
}

ParticleFilter::ParticleFilter(Particles particles, ParticleFilterOptions options)
    : particles_(std::move(particles)), options_(std::move(options)) {
  requireOptions(options_, particles_.states.rows());
  if (particles_.states.cols() == 0)
    throw Error({.what = "particles", .found = "none", .wanted = "one or more"});
  requireSize("weights", particles_.weights.size(), particles_.states.cols());
  requireNumbers(particles_.states);
  (void)effectiveSampleSize(particles_.weights);  // throws for invalid weights
  particles_.weights /= particles_.weights.sum();
}

bool ParticleFilter::shouldResample() const {
  const double count = static_cast<double>(particles_.weights.size());
  return options_.threshold >= 1 || effectiveSampleSize(particles_.weights) < options_.threshold * count;
}

void ParticleFilter::gather(const std::vector<int>& parents) {
  const Eigen::Index n = particles_.states.rows();
  next_.resize(n, static_cast<Eigen::Index>(parents.size()));
  double* child = next_.data();
  const double* states = particles_.states.data();
  if (n == 3) {  // a pose in the plane: no inner loop
    for (const int parent : parents) {
      const double* state = states + 3 * static_cast<std::ptrdiff_t>(parent);
      child[0] = state[0];
      child[1] = state[1];
      child[2] = state[2];
      child += 3;
    }
    return;
  }
  for (const int parent : parents) child = std::copy_n(states + n * parent, n, child);
}

// Keeps drawing until the number of occupied cells requires no more particles.
void ParticleFilter::proposeAdaptively(const MotionSampler& propose, Rng& rng) {
  std::set<std::vector<double>> cells;
  chunk_.resize(particles_.states.rows(), options_.most);
  logWeights_.setZero(options_.most);
  int count = 0;
  for (int wanted = options_.fewest; count < wanted;) {
    const int size = std::min(kChunk, wanted - count);
    resample(particles_.weights, size, Resampling::kMultinomial, rng, parents_);
    gather(parents_);
    propose(next_, logWeights_.segment(count, size), rng);
    requireNumbers(next_, count);
    for (int k = 0; k < size; ++k) cells.insert(cellOf(next_.col(k), options_.cellSize));
    chunk_.middleCols(count, size) = next_;
    count += size;
    const int enough = adaptiveSampleSize(static_cast<int>(cells.size()), options_.error);
    wanted = std::clamp(enough, options_.fewest, options_.most);
  }
  next_ = chunk_.leftCols(count);
  logWeights_.conservativeResize(count);
  logWeights_.array() -= std::log(static_cast<double>(count));
}

ParticleStep ParticleFilter::step(const MotionSampler& propose, const LogLikelihood& weigh, Rng& rng) {
  ParticleStep report;
  const bool isAdaptive = options_.cellSize.size() > 0;
  report.resampled = isAdaptive || shouldResample();
  if (isAdaptive) {
    proposeAdaptively(propose, rng);
  } else {
    const int count = static_cast<int>(particles_.weights.size());
    if (report.resampled) {
      resample(particles_.weights, count, options_.resampling, rng, parents_);
      gather(parents_);
      logWeights_.setConstant(count, -std::log(static_cast<double>(count)));
    } else {
      next_ = particles_.states;
      logWeights_ = particles_.weights.array().log();
    }
    propose(next_, logWeights_, rng);
    requireNumbers(next_);
  }
  proposed_ = logWeights_;
  weigh(next_, logWeights_);
  double largest = requireLogWeights(logWeights_);
  report.lost = std::isinf(largest);
  if (report.lost) {
    logWeights_ = std::isinf(proposed_.maxCoeff()) ? proposed_.setZero() : proposed_;
    largest = logWeights_.maxCoeff();
  }
  std::swap(particles_.states, next_);
  Eigen::VectorXd& weights = particles_.weights;
  weights.resize(logWeights_.size());
  const auto kernel = kernelFor<internal::WeightsKernel>(cpuLanes());
  const double sum = kernel.exponentials(logWeights_.data(), largest, weights.size(), weights.data());
  report.logEvidence = report.lost ? -std::numeric_limits<double>::infinity() : largest + std::log(sum);
  report.effectiveSize = 1 / kernel.divide(weights.data(), sum, weights.size(), weights.data()).squared;
  return report;
}

namespace {

void requireFunction(const char* what, const NonlinearModel& model) {
  if (!model.g) throw Error({.what = what, .found = "no function g"});
}

}  // namespace

MotionSampler motionProposal(NonlinearModel transition) {
  requireFunction("transition", transition);
  requireCovariance("transition: covariance of the noise", transition.W, transition.W.rows());
  const Eigen::MatrixXd root = covarianceRoot(transition.W);
  return [transition = std::move(transition), root](Eigen::Ref<Eigen::MatrixXd> X,
                                                    Eigen::Ref<Eigen::VectorXd>, Rng& rng) {
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      const Eigen::VectorXd next = transition.g(X.col(i));
      requireSize("next state", next.size(), X.rows());
      requireSize("noise of the transition", root.rows(), X.rows());
      X.col(i) = next + root * rng.normalVector(static_cast<int>(X.rows()));
    }
  };
}

LogLikelihood observationWeights(NonlinearModel observation, const VectorArg& y) {
  requireFunction("observation model", observation);
  requireFinite("observation", y);
  requireCovariance("observation model: covariance of the noise", observation.W, y.size(),
                    Definiteness::kPositive);
  const Eigen::MatrixXd root = Eigen::LLT<Eigen::MatrixXd>(observation.W).matrixL();
  return [observation = std::move(observation), root, y = Eigen::VectorXd(y)](
             const MatrixArg& X, Eigen::Ref<Eigen::VectorXd> logWeights) {
    const auto L = root.triangularView<Eigen::Lower>();
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      const Eigen::VectorXd expected = observation.g(X.col(i));
      requireSize("expected observation", expected.size(), y.size());
      logWeights[i] -= 0.5 * L.solve(difference(observation, y, expected)).squaredNorm();
    }
  };
}

MotionSampler observedProposal(NonlinearModel transition, NonlinearModel observation, const VectorArg& y) {
  requireFunction("transition", transition);
  requireFunction("observation model", observation);
  requireFinite("observation", y);
  requireCovariance("transition: covariance of the noise", transition.W, transition.W.rows(),
                    Definiteness::kPositive);
  requireCovariance("observation model: covariance of the noise", observation.W, y.size(),
                    Definiteness::kPositive);
  return [transition = std::move(transition), observation = std::move(observation), y = Eigen::VectorXd(y)](
             Eigen::Ref<Eigen::MatrixXd> X, Eigen::Ref<Eigen::VectorXd> logWeights, Rng& rng) {
    const auto sensor = definiteFactor("observation model: covariance of the noise", observation.W);
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      // For the model along its tangent, p(next | state) / p(next | state, y) is p(y | state) / p(y | next).
      const Gaussian motion{transition.g(X.col(i)), transition.W};
      requireSize("next state", motion.mean.size(), X.rows());
      const KalmanUpdate seen = extendedUpdate(motion, observation, y);
      const Eigen::VectorXd offset =
          covarianceRoot(seen.belief.covariance) * rng.normalVector(static_cast<int>(X.rows()));
      const Eigen::VectorXd next = seen.belief.mean + offset;
      const Eigen::VectorXd error =
          seen.innovation - linearized(observation, motion.mean).C * (next - motion.mean);
      logWeights[i] += seen.logLikelihood - internal::logNormal(sensor, error);
      X.col(i) = next;
    }
  };
}

}  // namespace rex
