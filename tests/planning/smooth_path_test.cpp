#include "planning/smooth_path.h"

#include <gtest/gtest.h>

#include "base/rng.h"
#include "planning/path_problem.h"
#include "planning/rrt.h"
#include "planning/wall.h"
#include "support/expect_error.h"

namespace rex::smooth_path_test {

void expectValid(const PathProblem& problem, const Eigen::MatrixXd& path) {
  EdgeChecker edges(problem.space, problem.allValid, problem.resolution);
  EXPECT_EQ(path.col(0), problem.start);
  EXPECT_EQ(path.rightCols(1), problem.goal);
  for (Eigen::Index k = 1; k < path.cols(); ++k) EXPECT_TRUE(edges.isValid(path.col(k - 1), path.col(k)));
}

// The largest turn between two pieces of a path, radians.
double sharpestCorner(const Eigen::MatrixXd& path) {
  double sharpest = 0;
  for (Eigen::Index k = 1; k + 1 < path.cols(); ++k) {
    const Eigen::VectorXd a = path.col(k) - path.col(k - 1), b = path.col(k + 1) - path.col(k);
    if (a.norm() == 0 || b.norm() == 0) continue;
    sharpest = std::max(sharpest, std::acos(std::min(1., a.dot(b) / (a.norm() * b.norm()))));
  }
  return sharpest;
}

TEST(SmoothPath, ShortcutsComeNearTheShortest) {
  const PathProblem problem = wallWithHole(2, .1);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Rng rng(seed);
    const PathResult found = connectRrts(problem, {.stepSize = .1}, rng);
    ASSERT_EQ(found.status, PathStatus::kFound);
    double last = found.length;
    Eigen::MatrixXd path = found.path;
    for (int rounds = 0; rounds < 4; ++rounds) {
      path = shortcut(problem, path, 100, rng);
      expectValid(problem, path);
      EXPECT_LE(pathLength(problem.space, path), last + 1e-12);
      last = pathLength(problem.space, path);
    }
    EXPECT_LT(last, 1.05 * 1.089949);
  }
}

TEST(SmoothPath, RoundsCornersWhereThereIsRoom) {
  const PathProblem problem = wallWithHole(2, .3);
  Rng rng(3);
  const PathResult found = connectRrts(problem, {.stepSize = .1}, rng);
  const Eigen::MatrixXd path = shortcut(problem, found.path, 200, rng);
  const Eigen::MatrixXd round = roundCorners(problem, path, 5);
  expectValid(problem, round);
  EXPECT_LE(pathLength(problem.space, round), pathLength(problem.space, path) + 1e-12);
  Eigen::MatrixXd corner(2, 3);
  corner << .1, .3, .3, .1, .1, .4;
  EXPECT_NEAR(sharpestCorner(corner), M_PI / 2, 1e-12);
  EXPECT_LT(sharpestCorner(roundCorners(problem, corner, 5)), .1) << "nothing is in the way";
}

TEST(SmoothPath, RefusesWhatIsNoPath) {
  const PathProblem problem = wallWithHole(2, .3);
  Rng rng(1);
  EXPECT_REX_ERROR(static_cast<void>(shortcut(problem, Eigen::MatrixXd(2, 0), 1, rng)),
                   "path: found no configurations, wanted at least one");
  EXPECT_REX_ERROR(static_cast<void>(roundCorners(problem, Eigen::MatrixXd::Zero(3, 2), 1)),
                   "configurations of a path: found a vector of size 3, wanted size 2");
}

}  // namespace rex::smooth_path_test
