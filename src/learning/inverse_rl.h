#pragma once

#include <string>
#include <vector>

#include "base/require.h"
#include "learning/mdp.h"

namespace rex {

/// sum_t discount^t E phi(s_t) of a policy: k numbers. `features` is k x states, `start` a distribution
/// over states. Throws like discountedVisits, and for features with the wrong number of states or that are
/// not finite.
[[nodiscard]] Eigen::VectorXd featureExpectations(const Mdp& mdp, const MatrixArg& policy,
                                                  const MatrixArg& features, const VectorArg& start);

/// The same estimated as the mean over demonstrations, each the states of one episode. Throws Error without
/// demonstrations, for unknown states, and for a discount outside [0, 1].
[[nodiscard]] Eigen::VectorXd featureExpectations(const std::vector<std::vector<int>>& demonstrations,
                                                  const MatrixArg& features, double discount);

struct InverseRlOptions {
  double tolerance = 1e-6;  ///< for the margin, relative to the norm of the teacher's expectations
  int maxIterations = 100;
};

enum class InverseRlStatus {
  kMatched,      ///< a mixture of the policies has the teacher's expectations, within the tolerance
  kUnmatched,    ///< no policy does: the teacher is better than all under w, or its few episodes were lucky
  kNotConverged  ///< all iterations are used up
};

struct InverseRlResult {
  InverseRlStatus status = InverseRlStatus::kNotConverged;
  Eigen::VectorXd w{};  ///< k: R(s) = w^T phi(s), from the last margin above the tolerance
  std::vector<Eigen::MatrixXd> policies{};  ///< the candidates; the first is uniform
  Eigen::VectorXd shares{};                 ///< weights of the mixture of them nearest to the teacher; sum 1
  Eigen::VectorXd expectations{};           ///< k: of the mixture
  std::vector<double> margins{};            ///< one for each iteration, not increasing
  std::string message{};
};

/// Rewards that explain a teacher, slides 9:12 and 9:13 (Abbeel and Ng 2004): alternately finds the weights
/// w that separate the teacher's expectations most from all candidates, and adds the optimal policy under w
/// as a candidate. For every true w of length one, the value of the mixture equals the teacher's within the
/// last margin. The rewards of `mdp` are not used. Throws like featureExpectations, and for a discount of
/// one.
[[nodiscard]] InverseRlResult inverseRl(const Mdp& mdp, const MatrixArg& features, const VectorArg& start,
                                        const VectorArg& teacher, const InverseRlOptions& options = {});

/// The maximum margin between a teacher and all candidates.
struct MarginResult {
  /// The point in the candidates' hull nearest to the teacher, as convex weights: >= 0, sum 1.
  Eigen::VectorXd shares{};
  Eigen::VectorXd w{};  ///< unit vector from that point to the teacher; zero if the teacher is in the hull
  double margin = 0;    ///< min_i w^T (teacher - candidate_i): the distance to the hull
  int iterations = 0;
  bool converged = false;
};

/// The quadratic programme of slide 9:13: max xi with w^T teacher >= w^T candidate_i + xi for each i and
/// |w| <= 1. Its dual is the nearest point in the hull of the candidates (one per column), found with an
/// active set of corners (Wolfe 1976). Throws Error without candidates, for sizes that do not fit, and for
/// numbers that are not finite.
[[nodiscard]] MarginResult maxMargin(const VectorArg& teacher, const MatrixArg& candidates,
                                     int maxIterations = 1000);

}  // namespace rex
