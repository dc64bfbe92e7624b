#pragma once

#include <Eigen/Core>

#include "base/vector_arg.h"

namespace rex {

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

}  // namespace rex
