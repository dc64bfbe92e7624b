#include "estimation/gaussian.h"

#include <cmath>
#include <string>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <fmt/format.h>

#include "base/derivative_check.h"
#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"
#include "estimation/kalman_filter_internal.h"

namespace rex {
namespace {

constexpr double kAsymmetry = 1e-9;

// The largest value that an entry of a semidefinite matrix can have, and hence the scale of its rounding.
double sizeOf(const MatrixArg& A, Eigen::Index i, Eigen::Index j) {
  return std::sqrt(std::abs(A(i, i))) * std::sqrt(std::abs(A(j, j)));
}

void requireSymmetric(const std::string& what, const MatrixArg& A) {
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    for (Eigen::Index i = 0; i < j; ++i) {
      if (std::abs(A(i, j) - A(j, i)) <= kAsymmetry * sizeOf(A, i, j)) continue;
      throw Error(
          {.what = what,
           .found = fmt::format("{:g} at ({}, {}) and {:g} at ({}, {})", A(i, j), i, j, A(j, i), j, i),
           .wanted = "a symmetric matrix"});
    }
  }
}

// The least eigenvalue of the matrix scaled to a unit diagonal, so that large variances do not hide small
// ones.
double leastCorrelation(const MatrixArg& A) {
  const Eigen::VectorXd scale = A.diagonal().unaryExpr([](double v) { return v > 0 ? 1 / std::sqrt(v) : 1; });
  const Eigen::MatrixXd scaled = scale.asDiagonal() * A * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .minCoeff();
}

Eigen::MatrixXd withoutNegativeEigenvalues(const Eigen::MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  const Eigen::MatrixXd& V = solver.eigenvectors();
  const Eigen::MatrixXd scaled = V * solver.eigenvalues().cwiseMax(0).asDiagonal();
  const Eigen::MatrixXd nearest = scaled * V.transpose();
  return 0.5 * (nearest + nearest.transpose());
}

[[noreturn]] void refuse(const std::string& what, double eigenvalue, Definiteness wanted) {
  throw Error({.what = what,
               .found = fmt::format("the eigenvalue {:g}", eigenvalue),
               .wanted = wanted == Definiteness::kPositive ? "a positive definite matrix"
                                                           : "no negative eigenvalue"});
}

}  // namespace

void requireCovariance(std::string_view what, const MatrixArg& A, Eigen::Index size, Definiteness wanted) {
  const std::string name(what);
  if (A.rows() != size || A.cols() != size) {
    throw Error({.what = name,
                 .found = fmt::format("a {} x {} matrix", A.rows(), A.cols()),
                 .wanted = fmt::format("{} x {}", size, size)});
  }
  if (size == 0) return;
  if (!A.allFinite()) throw Error({.what = name, .found = "entries that are not finite"});
  requireSymmetric(name, A);
  const Eigen::LLT<Eigen::MatrixXd> factor(A);
  // A factorisation decides at a fraction of the cost whether eigenvalues must be computed.
  if (factor.info() == Eigen::Success && isDefinite(factor, A)) return;
  const double least = leastCorrelation(A);
  if (wanted == Definiteness::kPositive || A.diagonal().minCoeff() < 0 || least < -kAsymmetry)
    refuse(name,
           Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues().minCoeff(),
           wanted);
}

bool isDefinite(const Eigen::LLT<Eigen::MatrixXd>& factor, const MatrixArg& A) {
  // A pivot that may be only rounding of its diagonal entry counts as zero.
  const double rounding = 4e-16 * static_cast<double>(A.rows());
  const auto pivots = factor.matrixLLT().diagonal().array().square();
  return factor.info() == Eigen::Success && (pivots > rounding * A.diagonal().array()).all() &&
         pivots.isFinite().all();
}

Eigen::LLT<Eigen::MatrixXd> definiteFactor(std::string_view what, const MatrixArg& A) {
  Eigen::LLT<Eigen::MatrixXd> factor(A);
  // It only reads the lower triangle, hence requireSymmetric().
  if (A.rows() == A.cols() && A.allFinite() && isDefinite(factor, A)) {
    requireSymmetric(std::string(what), A);
    return factor;
  }
  requireCovariance(what, A, A.rows(), Definiteness::kPositive);
  return factor;  // for a compiler that does not see that the line before throws
}

Eigen::MatrixXd symmetrized(const MatrixArg& A) { return 0.5 * (A + A.transpose()); }

Eigen::MatrixXd nearestSemidefinite(const MatrixArg& A) {
  const Eigen::MatrixXd nearest = withoutNegativeEigenvalues(A);
  // Rounding of large entries may leave small ones negative: once more with a unit diagonal.
  const double rounding = 1e-14 * nearest.diagonal().cwiseAbs().maxCoeff();
  const Eigen::VectorXd root =
      nearest.diagonal().unaryExpr([&](double v) { return v > rounding ? std::sqrt(v) : 0; });
  const Eigen::VectorXd inverse = root.unaryExpr([](double v) { return v > 0 ? 1 / v : 0; });
  const Eigen::MatrixXd scaled = inverse.asDiagonal() * nearest * inverse.asDiagonal();
  return root.asDiagonal() * withoutNegativeEigenvalues(scaled) * root.asDiagonal();
}

Eigen::MatrixXd covarianceRoot(const MatrixArg& A) {
  const Eigen::LLT<Eigen::MatrixXd> factor(A);
  if (isDefinite(factor, A)) return factor.matrixL();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

namespace {

void requireGaussian(const Gaussian& x, Definiteness wanted = Definiteness::kSemidefinite) {
  requireFinite("mean", x.mean);
  requireCovariance("covariance", x.covariance, x.mean.size(), wanted);
}

}  // namespace

CanonicalGaussian toCanonical(const Gaussian& x) {
  requireGaussian(x, Definiteness::kPositive);
  const auto factor = definiteFactor("covariance", x.covariance);
  const auto identity = Eigen::MatrixXd::Identity(x.mean.size(), x.mean.size());
  return {factor.solve(x.mean), symmetrized(factor.solve(identity))};
}

Gaussian toNormal(const CanonicalGaussian& x) {
  requireFinite("coefficient a", x.a);
  requireCovariance("precision", x.A, x.a.size(), Definiteness::kPositive);
  const auto factor = definiteFactor("precision", x.A);
  const auto identity = Eigen::MatrixXd::Identity(x.a.size(), x.a.size());
  return {factor.solve(x.a), symmetrized(factor.solve(identity))};
}

double logDensity(const Gaussian& gaussian, const VectorArg& x) {
  requireGaussian(gaussian, Definiteness::kPositive);
  requireSize("point", x.size(), gaussian.mean.size());
  return internal::logNormal(definiteFactor("covariance", gaussian.covariance), x - gaussian.mean);
}

double squaredMahalanobis(const Gaussian& gaussian, const VectorArg& x) {
  requireGaussian(gaussian, Definiteness::kPositive);
  requireSize("point", x.size(), gaussian.mean.size());
  const Eigen::VectorXd error = x - gaussian.mean;
  const Eigen::VectorXd weighted = definiteFactor("covariance", gaussian.covariance).solve(error);
  return error.dot(weighted);
}

Eigen::VectorXd sample(const Gaussian& gaussian, Rng& rng) {
  requireGaussian(gaussian);
  return gaussian.mean +
         covarianceRoot(gaussian.covariance) * rng.normalVector(static_cast<int>(gaussian.mean.size()));
}

GaussianProduct multiplied(const Gaussian& a, const Gaussian& b) {
  requireGaussian(a);
  requireGaussian(b);
  requireSize("mean of the second Gaussian", b.mean.size(), a.mean.size());
  const auto factor = definiteFactor("sum of the covariances", a.covariance + b.covariance);
  const Eigen::MatrixXd gain = factor.solve(a.covariance).transpose();  // A (A + B)^-1
  GaussianProduct product;
  product.gaussian.mean = a.mean + gain * (b.mean - a.mean);
  product.gaussian.covariance = symmetrized(gain * b.covariance);
  product.logFactor = internal::logNormal(factor, a.mean - b.mean);
  return product;
}

CanonicalGaussian multiplied(const CanonicalGaussian& a, const CanonicalGaussian& b) {
  requireFinite("coefficient a", a.a);
  requireFinite("coefficient b", b.a);
  requireSize("coefficient b", b.a.size(), a.a.size());
  requireCovariance("precision A", a.A, a.a.size());
  requireCovariance("precision B", b.A, a.a.size());
  return {a.a + b.a, a.A + b.A};
}

Gaussian propagated(const Gaussian& y, const MatrixArg& F, const VectorArg& f, const MatrixArg& Q) {
  requireGaussian(y);
  requireSize("columns of F", F.cols(), y.mean.size());
  requireSize("offset f", f.size(), F.rows());
  requireCovariance("noise Q", Q, F.rows());
  const Eigen::MatrixXd A = F, moved = A * y.covariance * A.transpose();
  return {f + F * y.mean, symmetrized(moved + Q)};
}

GaussianProduct pulledBack(const Gaussian& y, const MatrixArg& F, const VectorArg& f) {
  requireGaussian(y);
  requireSize("rows of F", F.rows(), y.mean.size());
  requireSize("columns of F", F.cols(), y.mean.size());
  requireSize("offset f", f.size(), y.mean.size());
  const Eigen::FullPivLU<Eigen::MatrixXd> factor(F);
  if (!factor.isInvertible())
    throw Error({.what = "transformation F",
                 .found = fmt::format("rank {}", factor.rank()),
                 .wanted = fmt::format("an invertible matrix, of rank {}", F.rows())});
  const Eigen::MatrixXd inverse = factor.inverse();
  const double logFactor = -factor.matrixLU().diagonal().cwiseAbs().array().log().sum();
  return {{inverse * (y.mean - f), symmetrized(inverse * y.covariance * inverse.transpose())}, logFactor};
}

Gaussian marginal(const Gaussian& joint, int first, int count) {
  requireGaussian(joint);
  if (first < 0 || count < 0 || count > joint.mean.size() - first) {
    throw Error({.what = "marginal",
                 .found = fmt::format("{} numbers from {} on", count, first),
                 .wanted = fmt::format("numbers within 0 to {}", joint.mean.size() - 1)});
  }
  return {joint.mean.segment(first, count), joint.covariance.block(first, first, count, count)};
}

Gaussian conditional(const Gaussian& joint, const VectorArg& firstNumbers) {
  requireGaussian(joint);
  requireFinite("given numbers", firstNumbers);
  const Eigen::Index n = firstNumbers.size(), m = joint.mean.size() - n;
  if (m < 0) requireSize("given numbers", n, joint.mean.size());
  const auto factor = definiteFactor("covariance of the given numbers", joint.covariance.topLeftCorner(n, n));
  const Eigen::MatrixXd cross = joint.covariance.topRightCorner(n, m);
  const Eigen::MatrixXd gain = factor.solve(cross).transpose(), lost = gain * cross;
  const Eigen::MatrixXd reduced = joint.covariance.bottomRightCorner(m, m) - lost;
  return {joint.mean.tail(m) + gain * (firstNumbers - joint.mean.head(n)), symmetrized(reduced)};
}

void requireModel(const char* what, const LinearModel& model, Eigen::Index n) {
  const std::string name(what);
  requireSize(name + ": columns of the matrix", model.C.cols(), n);
  requireSize(name + ": offset", model.c.size(), model.C.rows());
  requireFinite(name + ": offset", model.c);
  if (!model.C.allFinite()) throw Error({.what = name + ": matrix", .found = "entries that are not finite"});
  requireCovariance(name + ": covariance of the noise", model.W, model.C.rows());
}

Eigen::VectorXd difference(const NonlinearModel& model, const Eigen::VectorXd& y1,
                           const Eigen::VectorXd& y2) {
  requireSize("value of the model", y1.size(), y2.size());
  const Eigen::VectorXd result = model.difference ? model.difference(y1, y2) : Eigen::VectorXd(y1 - y2);
  requireSize("difference of values of the model", result.size(), y2.size());
  requireFinite("difference of values of the model", result);
  return result;
}

LinearModel linearized(const NonlinearModel& model, const VectorArg& x) {
  if (!model.g) throw Error({.what = "model", .found = "no function g"});
  const Eigen::VectorXd point = x, value = model.g(point);
  requireFinite("value of the model", value);
  LinearModel tangent;
  if (model.jacobian) {
    tangent.C = model.jacobian(point);
  } else {
    // Differences to the value here are small, so that angles cannot jump.
    tangent.C = numericJacobian(
        [&](const Eigen::VectorXd& at) -> Eigen::VectorXd { return difference(model, model.g(at), value); },
        point);
  }
  if (tangent.C.rows() != value.size())
    throw Error({.what = "Jacobian of the model",
                 .found = fmt::format("{} rows", tangent.C.rows()),
                 .wanted = fmt::format("{}, one for each value of the model", value.size())});
  requireSize("columns of the Jacobian of the model", tangent.C.cols(), x.size());
  tangent.c = value - tangent.C * x;
  tangent.W = model.W;
  requireModel("model", tangent, x.size());
  return tangent;
}

}  // namespace rex
