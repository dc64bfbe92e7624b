#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace rex {

/// One step of a linear quadratic problem that changes with time, as follows from a linearisation or a path
/// to follow: x_{t+1} = A x + B u + c, at a cost of x^T Q x + u^T R u + 2 u^T S x + 2 q^T x + 2 r^T u.
struct LqStage {
  Eigen::MatrixXd A{};  ///< n x n
  Eigen::MatrixXd B{};  ///< n x m
  Eigen::VectorXd c{};  ///< empty: 0, as all below
  Eigen::MatrixXd Q{};  ///< n x n
  Eigen::MatrixXd R{};  ///< m x m
  Eigen::MatrixXd S{};  ///< m x n
  Eigen::VectorXd q{};
  Eigen::VectorXd r{};
};

/// u_t = k[t] - K[t] x_t, and what it leaves to pay.
struct LqPolicy {
  bool isSolved = false;             ///< false: the cost of some control has no minimum
  std::vector<Eigen::MatrixXd> K{};  ///< of steps 0 to N - 1
  std::vector<Eigen::VectorXd> k{};
  std::vector<Eigen::MatrixXd> P{};  ///< cost from t on: x^T P x + 2 p^T x + constant; of times 0 to N
  std::vector<Eigen::VectorXd> p{};
  int stage = -1;  ///< where it failed
  std::string message{};
};

/// Bellman's equation backward from x^T F x + 2 f^T x (slide 8:14). `damping` is added to the diagonal of
/// each control's weight. Throws Error for sizes that do not fit and entries that are not finite, naming the
/// stage, without stages, and for a negative damping. Of Q, R and F only the symmetric parts count.
[[nodiscard]] LqPolicy solveLq(const std::vector<LqStage>& stages, const Eigen::MatrixXd& F,
                               const Eigen::VectorXd& f, double damping = 0);

/// The stages of following `path` (one state per column, N + 1 of them) at sum (x_t - r_t)^T Q (x_t - r_t) +
/// u_t^T R u_t for a constant system (slide 8:13); the last column belongs to F and f = -F r_N. Throws
/// Error where the path or Q have other sizes than A.
[[nodiscard]] std::vector<LqStage> trackingStages(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B,
                                                  const Eigen::MatrixXd& Q, const Eigen::MatrixXd& R,
                                                  const Eigen::MatrixXd& path);

}  // namespace rex
