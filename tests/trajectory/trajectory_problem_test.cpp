#include <cmath>

#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "trajectory/motion_terms.h"
#include "trajectory/trajectory_optimizer.h"

namespace rex::trajectory_problem_test {

using Eigen::MatrixXd;

TEST(TrajectoryProblem, KnowsItsSizes) {
  const TrajectoryProblem problem({velocityTerm(), jerkTerm()}, MatrixXd::Zero(2, 3), 10, 0.5);
  EXPECT_EQ(problem.n(), 2);
  EXPECT_EQ(problem.steps(), 10);
  EXPECT_EQ(problem.tau(), 0.5);
  EXPECT_EQ(problem.order(), 3);
}

TEST(TrajectoryProblem, MovesTerms) {
  const TrajectoryTerm term = as(TermKind::kEquality, at(velocityTerm(), 3));
  EXPECT_EQ(term.kind, TermKind::kEquality);
  EXPECT_EQ(term.first, 3);
  EXPECT_EQ(term.last, 3);
  EXPECT_EQ(during(term, 1, 2).first, 1);
  EXPECT_EQ(during(term, 1, 2).last, 2);
}

TEST(TrajectoryProblem, SaysWhatIsWrong) {
  const MatrixXd prefix = MatrixXd::Zero(1, 1);
  EXPECT_REX_ERROR(TrajectoryProblem({}, MatrixXd(1, 0), 3),
                   "prefix of a trajectory: found no numbers, wanted one finite configuration or more");
  EXPECT_REX_ERROR(TrajectoryProblem({}, MatrixXd::Constant(1, 1, std::nan("")), 3),
                   "prefix of a trajectory: found a number that is not finite");
  EXPECT_REX_ERROR(TrajectoryProblem({}, prefix, 0), "steps of a trajectory: found 0, wanted at least 1");
  EXPECT_REX_ERROR(TrajectoryProblem({}, prefix, 3, 0),
                   "time of a step: found 0 s, wanted a positive, finite number of seconds");
  EXPECT_REX_ERROR(TrajectoryProblem({{.name = "empty"}}, prefix, 3),
                   "term 'empty': function: found none, wanted one");
  EXPECT_REX_ERROR(TrajectoryProblem({accelerationTerm()}, prefix, 3),
                   "term 'acceleration': order: found 2, wanted 0 to 1, the length of the prefix");
  EXPECT_REX_ERROR(TrajectoryProblem({at(velocityTerm(), 3)}, prefix, 3),
                   "term 'velocity': steps: found 3 to 3, wanted a range within 0 to 2");
  EXPECT_REX_ERROR(TrajectoryProblem({during(velocityTerm(), 2, 1)}, prefix, 3), "found 2 to 1");
  EXPECT_REX_ERROR(TrajectoryProblem({during(velocityTerm(), -1, 1)}, prefix, 3), "found -1 to 1");
}

}  // namespace rex::trajectory_problem_test
