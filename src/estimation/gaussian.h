#pragma once

#include <functional>
#include <string_view>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "base/require.h"

namespace rex {

enum class Definiteness { kPositive, kSemidefinite };

/// Throws Error unless A is square of `size`, finite, symmetric and positive definite (or semidefinite),
/// saying which entry or eigenvalue is wrong; `what` names A. Deviations up to 1e-9, relative to the
/// variances of an entry, are tolerated.
void requireCovariance(std::string_view what, const MatrixArg& A, Eigen::Index size,
                       Definiteness wanted = Definiteness::kSemidefinite);

/// Whether the factorisation of A succeeded with pivots above rounding errors.
[[nodiscard]] bool isDefinite(const Eigen::LLT<Eigen::MatrixXd>& factor, const MatrixArg& A);
/// The factorisation of a covariance. Throws Error like requireCovariance unless it is definite in that
/// sense.
[[nodiscard]] Eigen::LLT<Eigen::MatrixXd> definiteFactor(std::string_view what, const MatrixArg& A);

/// (A + A^T) / 2: restores symmetry lost by rounding.
[[nodiscard]] Eigen::MatrixXd symmetrized(const MatrixArg& A);

/// The positive semidefinite matrix nearest to a symmetric A in the Frobenius norm: negative eigenvalues
/// become 0 (Higham 1988).
[[nodiscard]] Eigen::MatrixXd nearestSemidefinite(const MatrixArg& A);

/// Some S with S S^T = A for a semidefinite A; eigenvalues that are negative by rounding count as zero.
[[nodiscard]] Eigen::MatrixXd covarianceRoot(const MatrixArg& A);

class Rng;

/// N(x | mean, covariance), the normal form of slide 6:27. Functions of Gaussians throw Error for sizes
/// that do not fit, and for invalid covariances (see requireCovariance). Where an inverse is needed, the
/// covariance must be positive definite.
struct Gaussian {
  Eigen::VectorXd mean{};
  Eigen::MatrixXd covariance{};
};

/// N[x | a, A], the canonical form: the precision A is the inverse of the covariance, and a = A mean. Slide
/// 6:27, equation 2.
struct CanonicalGaussian {
  Eigen::VectorXd a{};
  Eigen::MatrixXd A{};
};

[[nodiscard]] CanonicalGaussian toCanonical(const Gaussian& x);
[[nodiscard]] Gaussian toNormal(const CanonicalGaussian& x);

/// log N(x | mean, covariance), with the determinant (slides 6:26 and 6:33, corrected).
[[nodiscard]] double logDensity(const Gaussian& gaussian, const VectorArg& x);
/// (x - mean)^T covariance^-1 (x - mean).
[[nodiscard]] double squaredMahalanobis(const Gaussian& gaussian, const VectorArg& x);
[[nodiscard]] Eigen::VectorXd sample(const Gaussian& gaussian, Rng& rng);

/// A Gaussian in x times exp(logFactor).
struct GaussianProduct {
  Gaussian gaussian{};
  double logFactor = 0;
};

/// N(x | a, A) N(x | b, B) as a Gaussian in x times N(a | b, A + B). Slide 6:28. One covariance may be
/// semidefinite; their sum must be definite.
[[nodiscard]] GaussianProduct multiplied(const Gaussian& a, const Gaussian& b);
/// The same in canonical form, without its factor: a + b, A + B.
[[nodiscard]] CanonicalGaussian multiplied(const CanonicalGaussian& a, const CanonicalGaussian& b);

/// The distribution of f + F y + noise with covariance Q. Slide 6:28, propagation.
[[nodiscard]] Gaussian propagated(const Gaussian& y, const MatrixArg& F, const VectorArg& f,
                                  const MatrixArg& Q);
/// N(F x + f | a, A) as a Gaussian in x times 1 / |F|. Slide 6:28, transformation. Throws Error for a
/// singular F.
[[nodiscard]] GaussianProduct pulledBack(const Gaussian& y, const MatrixArg& F, const VectorArg& f);

/// The distribution of `count` entries from `first` on.
[[nodiscard]] Gaussian marginal(const Gaussian& joint, int first, int count);
/// The distribution of the last entries given the first: N(y | b + C^T A^-1 (x - a), B - C^T A^-1 C). Slide
/// 6:28.
[[nodiscard]] Gaussian conditional(const Gaussian& joint, const VectorArg& firstNumbers);

/// A linear Gaussian model y ~ N(C x + c, W): either of the next state given the state (A, a, Q) or of the
/// observation given the state (C, c, W). Slide 7:26.
struct LinearModel {
  Eigen::MatrixXd C{};  ///< m x n
  Eigen::VectorXd c{};  ///< m
  Eigen::MatrixXd W{};  ///< m x m, the covariance of the noise
};

/// Throws Error for sizes that do not fit together or a state of size n, and a W that is not a covariance;
/// `what` names the model.
void requireModel(const char* what, const LinearModel& model, Eigen::Index n);

/// y ~ N(g(x), W). Slide 7:28.
struct NonlinearModel {
  std::function<Eigen::VectorXd(const Eigen::VectorXd& x)> g{};
  /// The Jacobian of g at x, m x n. Empty: central differences with one extrapolation (numericJacobian).
  std::function<Eigen::MatrixXd(const Eigen::VectorXd& x)> jacobian{};
  Eigen::MatrixXd W{};
  /// y1 - y2 if values of g are or contain angles. Empty: the plain difference.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& y1, const Eigen::VectorXd& y2)> difference{};
};

/// y1 - y2 as the model defines it. Throws Error for sizes that differ and numbers that are not finite.
[[nodiscard]] Eigen::VectorXd difference(const NonlinearModel& model, const Eigen::VectorXd& y1,
                                         const Eigen::VectorXd& y2);

/// The model linearised at x: C = jacobian, C x + c = g(x). Throws Error for a model without g, values that
/// are not finite, and as requireModel.
[[nodiscard]] LinearModel linearized(const NonlinearModel& model, const VectorArg& x);

}  // namespace rex
