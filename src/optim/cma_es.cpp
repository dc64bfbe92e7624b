#include "optim/cma_es.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

void requireOption(const char* what, int found, int least, int most) {
  if (found == 0 || (found >= least && found <= most)) return;
  throw Error({.what = what,
               .found = fmt::format("{}", found),
               .wanted = fmt::format("{} to {}, or 0 for the default", least, most)});
}

void requireDeviations(double least, double most) {
  if (!(least >= 1e-100 && most <= 1e100))
    throw Error({.what = "CMA-ES: deviations",
                 .found = fmt::format("{:g}", least >= 1e-100 ? most : least),
                 .wanted = "positive numbers, from 1e-100 to 1e+100"});
  if (most > 1e7 * least)
    throw Error({.what = "CMA-ES: deviations",
                 .found = fmt::format("{:g} and {:g}", least, most),
                 .wanted = "numbers within a factor of 1e+07: scale the coordinates"});
}

// Sums over a few columns at a time fit on the stack, and their result does not depend on the machine's
// caches.
constexpr Eigen::Index kColumns = 32;

// C += factor * Y Y^T, lower triangle.
void addOuterProducts(Eigen::MatrixXd& C, const MatrixArg& Y, double factor) {
  for (Eigen::Index i = 0; i < Y.cols(); i += kColumns)
    C.selfadjointView<Eigen::Lower>().rankUpdate(Y.middleCols(i, std::min(kColumns, Y.cols() - i)), factor);
}

}  // namespace

CmaEs::CmaEs(const VectorArg& mean, const VectorArg& deviations, const CmaOptions& options)
    : mean_(mean), sigma_(1) {
  const Eigen::Index n = mean.size();
  if (n == 0) throw Error({.what = "CMA-ES: start", .found = "no numbers", .wanted = "one or more"});
  requireSize("CMA-ES: deviations", deviations.size(), n);
  requireFinite("CMA-ES: start", mean);
  requireFinite("CMA-ES: deviations", deviations);
  requireDeviations(deviations.minCoeff(), deviations.maxCoeff());
  sigma_ = deviations.maxCoeff();
  D_ = deviations / sigma_;
  C_ = D_.cwiseAbs2().asDiagonal();
  B_.setIdentity(n, n);
  sigmaPath_.setZero(n), covariancePath_.setZero(n);
  result_.x = mean;
  setConstants(options);

  Z_.resize(n, lambda()), Y_.resize(n, lambda());
  step_.resize(n), rotated_.resize(n), whitened_.resize(n);
  order_.resize(static_cast<std::size_t>(lambda()));
  solver_.compute(C_);  // allocates now, and leaves nothing undefined to copy
}

// Table 1 of the tutorial.
void CmaEs::setConstants(const CmaOptions& options) {
  const double n = dimension();
  requireOption("CMA-ES: lambda", options.lambda, 2, 10'000'000);
  const int lambda = options.lambda > 0 ? options.lambda : 4 + static_cast<int>(3 * std::log(n));
  requireOption("CMA-ES: mu", options.mu, 1, lambda);
  mu_ = options.mu > 0 ? options.mu : lambda / 2;
  if (options.decompositionGap < 0)
    throw Error({.what = "CMA-ES: generations from one decomposition to the next",
                 .found = fmt::format("{}", options.decompositionGap),
                 .wanted = "at least 1, or 0 for the default"});

  const double middle = options.mu > 0 ? mu_ + 0.5 : (lambda + 1) / 2.;
  weights_.resize(lambda);
  for (int i = 0; i < lambda; ++i) weights_[i] = std::log(middle) - std::log(i + 1.);
  auto good = weights_.head(mu_), bad = weights_.tail(lambda - mu_);
  mueff_ = good.sum() * good.sum() / good.squaredNorm();
  const double mueffBad = bad.isZero(0) ? 0 : bad.sum() * bad.sum() / bad.squaredNorm();

  cSigma_ = (mueff_ + 2) / (n + mueff_ + 5);
  dSigma_ = 1 + 2 * std::max(0., std::sqrt((mueff_ - 1) / (n + 1)) - 1) + cSigma_;
  cc_ = (4 + mueff_ / n) / (n + 4 + 2 * mueff_ / n);
  c1_ = 2 / ((n + 1.3) * (n + 1.3) + mueff_);
  cmu_ = std::min(1 - c1_ - 1e-8, 2 * (mueff_ - 2 + 1 / mueff_) / ((n + 2) * (n + 2) + mueff_));
  chiN_ = std::sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n));  // E |N(0, I)|

  good /= good.sum();
  if (!options.active || bad.isZero(0) || cmu_ <= 0) {
    bad.setZero();
  } else {
    bad *= std::min({1 + c1_ / cmu_, 1 + 2 * mueffBad / (mueff_ + 2), (1 - c1_ - cmu_) / (n * cmu_)}) /
           bad.cwiseAbs().sum();
  }
  const double usualGap = 1 / (10 * n * (c1_ + cmu_));
  gap_ = options.decompositionGap > 0 ? options.decompositionGap : std::max(1, static_cast<int>(usualGap));
}

void CmaEs::sample(Eigen::Ref<Eigen::MatrixXd> X, Rng& rng) {
  requireSize("CMA-ES: coordinates of samples", X.rows(), dimension());
  requireSize("CMA-ES: samples", X.cols(), lambda());
  decompose();
  for (Eigen::Index i = 0; i < Z_.cols(); ++i)
    for (Eigen::Index k = 0; k < Z_.rows(); ++k) Z_(k, i) = sigma_ * D_[k] * rng.normal();
  for (Eigen::Index i = 0; i < Z_.cols(); i += kColumns) {
    const Eigen::Index count = std::min(kColumns, Z_.cols() - i);
    X.middleCols(i, count).noalias() = B_ * Z_.middleCols(i, count);
  }
  X.colwise() += mean_;
}

void CmaEs::update(const MatrixArg& X, const VectorArg& values) {
  requireSize("CMA-ES: coordinates of samples", X.rows(), dimension());
  requireSize("CMA-ES: samples", X.cols(), lambda());
  requireSize("CMA-ES: values", values.size(), lambda());
  if (!X.allFinite()) throw Error({.what = "CMA-ES: samples", .found = "numbers that are not finite"});
  decompose();
  const long invalid = result_.invalid;
  for (Eigen::Index i = 0; i < X.cols(); ++i) result_.add(X.col(i), values[i]);
  ++result_.iterations;
  if (result_.invalid - invalid == lambda()) return;
  rank(X, values);
  moveMean();
  adaptStepSize();
  adaptCovariance();
}

void CmaEs::step(Eigen::MatrixXd& samples, Eigen::VectorXd& values, Rng& rng) {
  if (values.size() == 0) {
    samples.resize(dimension(), lambda());
    values.setZero(lambda());
  } else {
    update(samples, values);
  }
  sample(samples, rng);
}

void CmaEs::rank(const MatrixArg& X, const VectorArg& values) {
  const auto key = [&](int i) {
    return std::isfinite(values[i]) ? values[i] : std::numeric_limits<double>::infinity();
  };
  std::iota(order_.begin(), order_.end(), 0);
  std::ranges::sort(order_, [&](int a, int b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  for (Eigen::Index i = 0; i < X.cols(); ++i)
    Y_.col(i) = (X.col(order_[static_cast<std::size_t>(i)]) - mean_) / sigma_;
}

void CmaEs::moveMean() {
  step_.noalias() = Y_.leftCols(mu_) * weights_.head(mu_);
  mean_ += sigma_ * step_;
}

void CmaEs::adaptStepSize() {
  rotated_.noalias() = B_.transpose() * step_;
  rotated_.array() /= D_.array();
  whitened_.noalias() = B_ * rotated_;  // C^-1/2 step
  sigmaPath_ = (1 - cSigma_) * sigmaPath_ + std::sqrt(cSigma_ * (2 - cSigma_) * mueff_) * whitened_;
  sigma_ *= std::exp(cSigma_ / dSigma_ * (sigmaPath_.norm() / chiN_ - 1));
  sigma_ = std::clamp(sigma_, 1e-150, 1e150);  // for callers whose loops do not check whether to end
}

void CmaEs::adaptCovariance() {
  const double n = dimension();
  // While sigma still grows fast, the path would stretch C far too much.
  const double age = 1 - std::pow(1 - cSigma_, 2 * generation());
  const bool isStalled = sigmaPath_.norm() >= (1.4 + 2 / (n + 1)) * chiN_ * std::sqrt(age);
  covariancePath_ *= 1 - cc_;
  if (!isStalled) covariancePath_ += std::sqrt(cc_ * (2 - cc_) * mueff_) * step_;

  for (Eigen::Index i = 0; i < mu_; ++i) Y_.col(i) *= std::sqrt(weights_[i]);
  for (Eigen::Index i = mu_; i < Y_.cols() && weights_[Y_.cols() - 1] < 0; ++i) {
    // A bad sample counts as if it were as far away as usual, so that C stays definite.
    rotated_.noalias() = B_.transpose() * Y_.col(i);
    const double squaredLength = (rotated_.array() / D_.array()).square().sum();
    Y_.col(i) *= std::sqrt(-weights_[i] * n / (squaredLength + 1e-8));
  }
  const double missing = isStalled ? c1_ * cc_ * (2 - cc_) : 0;
  C_ *= 1 + missing - c1_ - cmu_ * weights_.sum();
  addOuterProducts(C_, Y_.leftCols(mu_), cmu_);
  if (weights_[Y_.cols() - 1] < 0) addOuterProducts(C_, Y_.rightCols(Y_.cols() - mu_), -cmu_);
  addOuterProducts(C_, covariancePath_, c1_);
  C_.triangularView<Eigen::StrictlyUpper>() = C_.transpose();
}

void CmaEs::decompose() {
  if (generation() - decomposedAt_ < gap_) return;
  decomposedAt_ = generation();
  solver_.compute(C_);
  B_ = solver_.eigenvectors();
  D_ = solver_.eigenvalues();
  const double largest = std::clamp(D_.maxCoeff(), 1e-200, 1e100), least = 1e-15 * largest;
  const bool isSound = D_.minCoeff() >= least && D_.maxCoeff() <= largest;
  D_ = D_.cwiseMax(least).cwiseMin(largest).cwiseSqrt();
  // If C is too thin for doubles, bad samples would soon give it a negative eigenvalue.
  if (!isSound) C_ = B_ * D_.cwiseAbs2().asDiagonal() * B_.transpose();
}

namespace {

constexpr std::size_t kLongestMemory = 20'000;

}  // namespace

CmaTermination::CmaTermination(const CmaEs& es, const CmaLimits& limits)
    : limits_(limits), firstSigma_(es.sigma()), firstAxis_(es.sigma() * es.axisLengths().maxCoeff()) {
  if (!(limits.target < std::numeric_limits<double>::infinity()))
    throw Error({.what = "CMA-ES: target",
                 .found = fmt::format("{:g}", limits.target),
                 .wanted = "a number below infinity"});
  requireCount("CMA-ES: budget of evaluations", limits.maxEvaluations, 1);
  requirePositive("CMA-ES: smallest step", limits.smallestStep);
  requirePositive("CMA-ES: smallest difference", limits.smallestDifference);
  requirePositiveOrInfinite("CMA-ES: largest condition", limits.largestCondition);
  requirePositiveOrInfinite("CMA-ES: largest growth", limits.largestGrowth);
  const double generations = std::ceil(30. * es.dimension() / es.lambda());
  flatSpan_ = 10 + static_cast<std::size_t>(generations);
  stagnationSpan_ = std::min(kLongestMemory, 120 + static_cast<std::size_t>(generations));
  bests_.reserve(2 * kLongestMemory), medians_.reserve(2 * kLongestMemory);
  sorted_.reserve(std::max(kLongestMemory, static_cast<std::size_t>(es.lambda())));
  moved_.resize(es.dimension());
}

std::optional<SearchStatus> CmaTermination::check(const CmaEs& es, const VectorArg& values) {
  const SearchResult& result = es.result();
  if (result.value <= limits_.target) return SearchStatus::kTargetReached;
  if (result.evaluations + es.lambda() > limits_.maxEvaluations) return SearchStatus::kBudgetSpent;
  if (!values.array().isFinite().any()) return {};  // nothing was learnt
  remember(values);
  const double step = limits_.smallestStep * firstSigma_;
  if (es.sigma() * std::sqrt(es.covariance().diagonal().maxCoeff()) < step &&
      es.sigma() * es.path().cwiseAbs().maxCoeff() < step)
    return SearchStatus::kSmallSteps;
  if (isFlat(values)) return SearchStatus::kFlat;
  if (hasNoEffect(es)) return SearchStatus::kNoEffect;
  const double longest = es.axisLengths().maxCoeff(), shortest = es.axisLengths().minCoeff();
  if (longest * longest > limits_.largestCondition * shortest * shortest)
    return SearchStatus::kIllConditioned;
  if (es.sigma() * longest > limits_.largestGrowth * firstAxis_) return SearchStatus::kDiverged;
  if (isStagnating(es.generation())) return SearchStatus::kStagnated;
  return {};
}

void CmaTermination::remember(const VectorArg& values) {
  sorted_.clear();
  for (const double value : values)
    if (std::isfinite(value)) sorted_.push_back(value);
  const auto middle = sorted_.begin() + static_cast<std::ptrdiff_t>(sorted_.size() / 2);
  std::ranges::nth_element(sorted_, middle);
  for (auto* history : {&bests_, &medians_}) {
    if (history->size() < 2 * kLongestMemory) continue;
    history->erase(history->begin(), history->begin() + static_cast<std::ptrdiff_t>(kLongestMemory));
  }
  medians_.push_back(*middle);
  bests_.push_back(*std::min_element(sorted_.begin(), middle + 1));
}

bool CmaTermination::isFlat(const VectorArg& values) const {
  if (bests_.size() < flatSpan_ || !values.allFinite()) return false;
  const auto [low, high] =
      std::minmax_element(bests_.end() - static_cast<std::ptrdiff_t>(flatSpan_), bests_.end());
  return std::max(*high, values.maxCoeff()) - std::min(*low, values.minCoeff()) < limits_.smallestDifference;
}

// A tenth of a deviation along one of the axes in turn, and a fifth along every coordinate.
bool CmaTermination::hasNoEffect(const CmaEs& es) {
  const Eigen::Index axis = es.generation() % es.dimension();
  moved_ = es.mean() + 0.1 * es.sigma() * es.axisLengths()[axis] * es.axes().col(axis);
  if (moved_ == es.mean()) return true;
  moved_ = es.mean() + 0.2 * es.sigma() * es.covariance().diagonal().cwiseSqrt();
  return (moved_.array() == es.mean().array()).any();
}

double CmaTermination::windowMedian(const std::vector<double>& history, std::size_t from, std::size_t count) {
  const auto begin = history.begin() + static_cast<std::ptrdiff_t>(from);
  sorted_.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
  const auto middle = sorted_.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::ranges::nth_element(sorted_, middle);
  return *middle;
}

// Whether, over the last fifth of all generations, the first 30 % were as good as the last 30 %. Looking only
// now and then keeps the cost low.
bool CmaTermination::isStagnating(int generation) {
  const std::size_t all = bests_.size();
  const std::size_t fifth = static_cast<std::size_t>(generation) / 5;
  const std::size_t span = std::clamp(fifth, stagnationSpan_, kLongestMemory);
  if (all < span || generation % 20 != 0) return false;
  const std::size_t part = 3 * span / 10;
  for (const auto* history : {&bests_, &medians_})
    if (windowMedian(*history, all - part, part) < windowMedian(*history, all - span, part)) return false;
  return true;
}

}  // namespace rex
