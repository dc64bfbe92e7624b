#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "planning/path_problem.h"
#include "support/expect_error.h"

namespace rex::edge_checker_test {

const Space kLine = Space::box(Eigen::VectorXd::Constant(1, -1e300), Eigen::VectorXd::Constant(1, 1e300));

Eigen::VectorXd at(double x) { return Eigen::VectorXd::Constant(1, x); }

AllValid unless(double from, double to) {
  return eachColumn([=](const VectorArg& q) { return q[0] < from || q[0] > to; });
}

TEST(EdgeChecker, AsksForTheEndAndPointsNoFartherApartThanItsResolution) {
  for (const double length : {.05, .1, .75, 1., 3.14159, 20.}) {
    std::vector<double> asked{0};
    const AllValid record = eachColumn([&](const VectorArg& q) {
      asked.push_back(q[0]);
      return true;
    });
    EdgeChecker edges(kLine, record, .1);
    EXPECT_TRUE(edges.isValid(at(0), at(length)));
    EXPECT_EQ(edges.asked(), static_cast<long>(asked.size()) - 1);
    EXPECT_EQ(edges.asked(), std::ceil(length / .1));
    std::sort(asked.begin(), asked.end());
    EXPECT_EQ(asked.back(), length);
    for (std::size_t i = 1; i < asked.size(); ++i) EXPECT_LE(asked[i] - asked[i - 1], .1 + 1e-12);
  }
}

TEST(EdgeChecker, MeetsAnObstacleWhereverItStands) {
  for (double x = .01; x < 1; x += .013) {
    EdgeChecker edges(kLine, unless(x, x + .0101), .01);
    EXPECT_FALSE(edges.isValid(at(0), at(1))) << x;
    EXPECT_TRUE(edges.isValid(at(0), at(x - .001))) << x;
  }
}

// A wall in the middle of a way, which is not to be missed because its points were too many to count.
TEST(EdgeChecker, RefusesAWayOfTooManyPoints) {
  EdgeChecker fine(kLine, unless(.4, .6), 1e-10);
  EXPECT_REX_ERROR(fine.isValid(at(0), at(1)),
                   "resolution of a path check: 1e-10 on a way of length 1: found 1e+10 points, wanted a "
                   "coarser one: at most 1e+08 points");
  EXPECT_EQ(fine.asked(), 0);
  EdgeChecker coarse(kLine, unless(.4, .6), 2);
  EXPECT_REX_ERROR(coarse.isValid(at(0), at(1e200)), "2 on a way of length inf: found no finite distance");
  EXPECT_REX_ERROR(coarse.isValid(at(0), at(std::nan(""))), "found no finite distance");
  EXPECT_REX_ERROR(EdgeChecker(kLine, unless(.4, .6), 0), "resolution of a path check: found 0");
}

// The chord from a point to the opposite one is shorter than the way.
TEST(EdgeChecker, LooksAtPointsThatAreNearAlsoOnTheCircle) {
  const Space space({{.kind = SpacePart::Kind::kChord}});
  std::vector<double> asked{0};
  const AllValid all = [&](const MatrixArg& Q) {
    for (const double angle : Q.row(0)) asked.push_back(angle);
    return true;
  };
  EdgeChecker checker(space, all, .1);
  EXPECT_TRUE(checker.isValid(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Constant(1, 3.1)));
  std::sort(asked.begin(), asked.end());
  for (std::size_t i = 1; i < asked.size(); ++i)
    EXPECT_LE(2 * std::sin((asked[i] - asked[i - 1]) / 2), .1 + 1e-12);
}

}  // namespace rex::edge_checker_test
