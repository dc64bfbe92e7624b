#pragma once

#include <Eigen/Core>

namespace rex::bench {

/// The stabilizing X of 0 = A^T X + X A - X B B^T X + Q by SLICOT: SB02MD, the ordered Schur form of the
/// Hamiltonian matrix (Laub 1979), with its scaling. Throws std::runtime_error where SLICOT gives up.
[[nodiscard]] Eigen::MatrixXd careBySlicot(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B,
                                           const Eigen::MatrixXd& Q);

}  // namespace rex::bench
