#pragma once

#include <Eigen/Cholesky>

#include "estimation/kalman_filter.h"

namespace rex::internal {

/// log N(error | 0, A), with the factorisation of A.
double logNormal(const Eigen::LLT<Eigen::MatrixXd>& factor, const VectorArg& error);

/// Fills all of an update but its belief, from the innovation and its covariance; returns the gain
/// `cross` S^-1, with `cross` the covariance of state and observation. Throws Error for a singular S.
Eigen::MatrixXd weighInnovation(const Eigen::MatrixXd& cross, KalmanUpdate& update);

/// Throws Error unless belief and observation are what a filter can use.
void requireBelief(const Gaussian& belief);
void requireObservation(const VectorArg& y, Eigen::Index wanted);

}  // namespace rex::internal
