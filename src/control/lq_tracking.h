#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace rex {

/// One step of a time-varying linear quadratic problem, such as a linearisation or the tracking of a path:
/// x_{t+1} = A x + B u + c, with the cost x^T Q x + u^T R u + 2 u^T S x + 2 q^T x + 2 r^T u.
struct LqStage {
  Eigen::MatrixXd A{};  ///< n x n
  Eigen::MatrixXd B{};  ///< n x m
  Eigen::VectorXd c{};  ///< empty: 0; the same for all below
  Eigen::MatrixXd Q{};  ///< n x n
  Eigen::MatrixXd R{};  ///< m x m
  Eigen::MatrixXd S{};  ///< m x n
  Eigen::VectorXd q{};
  Eigen::VectorXd r{};
};

/// The policy u_t = k[t] - K[t] x_t and its cost-to-go.
struct LqPolicy {
  bool isSolved = false;             ///< false: the cost of some control has no minimum
  std::vector<Eigen::MatrixXd> K{};  ///< for steps 0 to N - 1
  std::vector<Eigen::VectorXd> k{};
  std::vector<Eigen::MatrixXd> P{};  ///< cost from t on: x^T P x + 2 p^T x + constant; for times 0 to N
  std::vector<Eigen::VectorXd> p{};
  int stage = -1;  ///< the stage that failed
  std::string message{};
};

/// Solves Bellman's equation backward from x^T F x + 2 f^T x (slide 8:14). `damping` is added to the
/// diagonal of each control's weight. Only the symmetric parts of Q, R and F are used. Throws Error for
/// sizes that do not fit and entries that are not finite, naming the stage, if there are no stages, and for
/// a negative damping.
[[nodiscard]] LqPolicy solveLq(const std::vector<LqStage>& stages, const Eigen::MatrixXd& F,
                               const Eigen::VectorXd& f, double damping = 0);

/// The stages for tracking `path` (N + 1 states r_t, one per column) with a constant system at the cost sum
/// (x_t - r_t)^T Q (x_t - r_t) + u_t^T R u_t (slide 8:13). The last column is for the final cost, with f =
/// -F r_N. Throws Error if the sizes of the path or Q do not fit A.
[[nodiscard]] std::vector<LqStage> trackingStages(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B,
                                                  const Eigen::MatrixXd& Q, const Eigen::MatrixXd& R,
                                                  const Eigen::MatrixXd& path);

}  // namespace rex
