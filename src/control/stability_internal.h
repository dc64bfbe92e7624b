#pragma once

#include <complex>

#include <Eigen/Core>

namespace rex::internal {

/// How far an eigenvalue is from being stable: beyond the imaginary axis, or beyond the unit circle.
double instability(std::complex<double> eigenvalue, bool isDiscrete);

/// The least change of A, in the spectral norm, that puts an eigenvalue on the axis (circle) where `near` is
/// closest to it.
double distanceToEdge(const Eigen::MatrixXd& A, std::complex<double> near, bool isDiscrete);

/// (Re M, -Im M; Im M, Re M), which acts on real parts above imaginary parts as M does.
Eigen::MatrixXd realForm(const Eigen::MatrixXcd& M);

/// The singular values of a complex matrix, falling; its real form has each of them twice.
Eigen::VectorXd singularValues(const Eigen::MatrixXcd& M);

/// How much rounding has changed a computed A of n rows and this norm, at most.
double roundingOf(Eigen::Index n, double norm);

}  // namespace rex::internal
