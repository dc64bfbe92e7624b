#include "estimation/scan_matching.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "scanned_halls.h"
#include "support/expect_error.h"

namespace rex::scan_matching_test {

using std::numbers::pi;
using test::planarMotion;

constexpr double kNoise = 0.02;
const Eigen::Vector3d kFirst(2, 3, 0.3), kSecond(2.5, 3.3, 0.8);

// The error of a motion as PlanarEdge counts it.
Eigen::Vector3d errorOf(const Eigen::Vector3d& motion, const Eigen::Vector3d& truth) {
  return planarMotion(truth, motion);
}

Eigen::Matrix2Xd moved(const Eigen::Matrix2Xd& points, const Eigen::Vector3d& motion) {
  Eigen::Matrix2d R;
  R << std::cos(motion[2]), -std::sin(motion[2]), std::sin(motion[2]), std::cos(motion[2]);
  return (R * points).colwise() + motion.head<2>();
}

// The same walls met by the same rays: then points lie on points, and the motion is exact.
TEST(ScanMatching, FindsKnownMotionsOfTheSamePoints) {
  Rng rng(3);
  const Eigen::Matrix2Xd points = test::scanOf(test::room(), test::scannerOf(180, 10), kFirst, 0, rng);
  for (int i = 0; i < 30; ++i) {
    const Eigen::Vector3d truth(rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-pi, pi));
    const Eigen::Vector3d guess = truth + rng.uniformVector(3, -.08, .08);
    const ScanMatch match = alignScans(moved(points, truth), points, guess);
    ASSERT_EQ(match.status, ScanMatchStatus::kConverged) << match.message;
    EXPECT_LT(errorOf(match.motion, truth).norm(), 1e-3);
    EXPECT_LT(match.residual, 0.01);
    EXPECT_GT(match.overlap, 0.99);
    EXPECT_EQ(match.unseen, Eigen::Vector3d::Zero());
  }
}

// Deviations of the results over noise against the information, entry by entry of the covariance: 4
// deviations of a sample of 400.
TEST(ScanMatching, InformationIsThatOfTheScatterOverNoise) {
  Rng rng(5);
  const Eigen::Vector3d truth = planarMotion(kFirst, kSecond);
  const RangeScanner scanner = test::scannerOf(180, 10);
  constexpr int kRuns = 400;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero(), predicted = scatter;
  double nees = 0;
  for (int i = 0; i < kRuns; ++i) {
    const auto first = test::scanOf(test::room(), scanner, kFirst, kNoise, rng),
               second = test::scanOf(test::room(), scanner, kSecond, kNoise, rng);
    const ScanMatch match = alignScans(first, second, truth + rng.uniformVector(3, -.1, .1));
    ASSERT_EQ(match.status, ScanMatchStatus::kConverged) << match.message;
    const Eigen::Vector3d e = errorOf(match.motion, truth);
    scatter += e * e.transpose() / kRuns;
    predicted += match.information.inverse() / kRuns;
    nees += e.dot(match.information * e) / 3 / kRuns;
  }
  EXPECT_NEAR(nees, 1, 0.25);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(scatter(r, c), predicted(r, c),
                  4 * std::sqrt(2. / kRuns) * std::sqrt(predicted(r, r) * predicted(c, c)))
          << r << " " << c;
}

// Trying all motions on a grid of 1 cm and 0.5 degrees, by the distances to the walls themselves: nothing
// near by fits better than what was found.
TEST(ScanMatching, NoMotionOfAGridFitsBetter) {
  Rng rng(7);
  const Eigen::Vector3d truth = planarMotion(kFirst, kSecond);
  const RangeScanner scanner = test::scannerOf(180, 10);
  const auto first = test::scanOf(test::room(), scanner, kFirst, kNoise, rng),
             second = test::scanOf(test::room(), scanner, kSecond, kNoise, rng);
  const Building room = test::room();
  const auto distance = [&](const Eigen::Vector3d& motion) {
    const Eigen::Matrix2Xd points = moved(moved(second, motion), kFirst);
    double sum = 0;
    for (Eigen::Index k = 0; k < points.cols(); ++k) {
      double nearest = 1;
      for (const Eigen::Vector4d& wall : room.walls) {
        const Eigen::Vector2d a = wall.head<2>(), w = wall.tail<2>() - a, p = points.col(k) - a;
        nearest = std::min(nearest, (p - std::clamp(p.dot(w) / w.squaredNorm(), 0., 1.) * w).norm());
      }
      sum += std::min(nearest * nearest, 0.01);
    }
    return sum;
  };
  const ScanMatch match = alignScans(first, second, truth + Eigen::Vector3d(.1, -.1, .1));
  Eigen::Vector3d best = truth;
  for (int x = -8; x <= 8; ++x)
    for (int y = -8; y <= 8; ++y)
      for (int turn = -8; turn <= 8; ++turn) {
        const Eigen::Vector3d trial = truth + Eigen::Vector3d(.01 * x, .01 * y, pi / 360 * turn);
        if (distance(trial) < distance(best)) best = trial;
      }
  EXPECT_LT((match.motion - best).head<2>().norm(), 0.02);
  EXPECT_LT(std::abs(match.motion[2] - best[2]), pi / 360);
}

TEST(ScanMatching, SearchesWhereTheGuessIsFarOff) {
  Rng rng(9);
  const Eigen::Vector3d truth = planarMotion(kFirst, kSecond);
  const RangeScanner scanner = test::scannerOf(180, 10);
  int bySearch = 0, alone = 0;
  for (int i = 0; i < 40; ++i) {
    const auto first = test::scanOf(test::room(), scanner, kFirst, kNoise, rng),
               second = test::scanOf(test::room(), scanner, kSecond, kNoise, rng);
    const Eigen::Vector3d guess =
        truth + Eigen::Vector3d(rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-1.5, 1.5));
    if (errorOf(searchAlignment(first, second, guess, {2, 1.5}).motion, truth).norm() < 0.03) ++bySearch;
    if (errorOf(alignScans(first, second, guess).motion, truth).norm() < 0.03) ++alone;
  }
  EXPECT_EQ(bySearch, 40);
  EXPECT_LT(alone, 20) << "then this shows nothing";
}

// Between two parallel walls: the way along them is that of the guess, and the information knows nothing of
// it.
TEST(ScanMatching, NamesTheWayAlongACorridor) {
  Rng rng(11);
  const Building corridor{{{-50, 0, 50, 0}, {-50, 2, 50, 2}}};
  const RangeScanner scanner = test::scannerOf(180, 10);
  const Eigen::Vector3d first(0, 1, .2), second(.3, 1.1, .3);
  const auto p = test::scanOf(corridor, scanner, first, kNoise, rng),
             q = test::scanOf(corridor, scanner, second, kNoise, rng);
  const Eigen::Vector3d truth = planarMotion(first, second);
  const ScanMatch match = alignScans(p, q, truth + Eigen::Vector3d(.1, .1, -.05));
  EXPECT_EQ(match.status, ScanMatchStatus::kUnobservable);
  EXPECT_THAT(match.message,
              testing::HasSubstr("the scans do not determine the motion along x, y, heading = (0.9"));
  const Eigen::Vector3d along(std::cos(.2), -std::sin(.2), 0);  // seen from the first pose
  EXPECT_NEAR(std::abs(match.unseen.dot(along)), 1, 1e-3);
  const Eigen::Vector3d e = match.motion - truth;
  EXPECT_NEAR(e.dot(along), Eigen::Vector3d(.1, .1, 0).dot(along), .02) << "the guess stays";
  EXPECT_NEAR(e[1] * along[0] - e[0] * along[1], 0, .01) << "across, the scans tell";
  EXPECT_NEAR(e[2], 0, .01);
  Eigen::Vector3d inEdge = along;  // the error of an edge is seen from the second pose
  inEdge.head<2>() << std::cos(.3), -std::sin(.3);
  EXPECT_LT(inEdge.dot(match.information * inEdge),
            1e-2 * (match.information(0, 0) + match.information(1, 1)));
  EXPECT_NEAR(match.information.selfadjointView<Eigen::Lower>().eigenvalues()[0], 0,
              1e-9 * match.information.trace());
}

// In the middle of a round tower no turn can be seen.
TEST(ScanMatching, NamesTheTurnInATower) {
  Rng rng(13);
  Eigen::VectorXd ranges = Eigen::VectorXd::Constant(360, 3) + kNoise * rng.normalVector(360);
  const Eigen::Matrix2Xd points = scanPoints(test::scannerOf(360, 10), ranges);
  const ScanMatch match = alignScans(points, points, {.05, -.03, .2});
  EXPECT_EQ(match.status, ScanMatchStatus::kUnobservable) << match.message;
  EXPECT_GT(match.unseen[2], .99);
  EXPECT_NEAR(match.motion[2], .2, .01);
}

TEST(ScanMatching, SaysWhenThereIsTooLittle) {
  Rng rng(15);
  const Eigen::Matrix2Xd points = test::scanOf(test::room(), test::scannerOf(180, 10), kFirst, 0, rng);
  const Eigen::Vector3d guess(.1, .2, .3);
  for (const Eigen::Matrix2Xd& few : {Eigen::Matrix2Xd(2, 0), Eigen::Matrix2Xd(points.leftCols(2))}) {
    for (const ScanMatch& match : {alignScans(points, few, guess), alignScans(few, points, guess),
                                   searchAlignment(points, few, guess)}) {
      EXPECT_EQ(match.status, ScanMatchStatus::kTooFewPoints);
      EXPECT_EQ(match.motion, guess);
      EXPECT_EQ(match.information, Eigen::Matrix3d::Zero());
      EXPECT_THAT(match.message, testing::HasSubstr("at least 3 are needed"));
    }
  }
  const ScanMatch apart = alignScans(points, points, {100, 0, 0});
  EXPECT_EQ(apart.status, ScanMatchStatus::kTooFewPoints);
  EXPECT_THAT(apart.message, testing::HasSubstr("0 of 180 points lie near a straight wall"));
  Eigen::Matrix2Xd cloud(2, 100);  // no walls at all
  for (int k = 0; k < 100; ++k) cloud.col(k) = rng.uniformVector(2, -.2, .2);
  EXPECT_EQ(alignScans(cloud, cloud, {0, 0, 0}).status, ScanMatchStatus::kTooFewPoints);
}

TEST(ScanMatching, SaysWhenTheBudgetIsSpent) {
  Rng rng(17);
  const Eigen::Matrix2Xd points = test::scanOf(test::room(), test::scannerOf(180, 10), kFirst, 0, rng);
  const ScanMatch match = alignScans(points, points, {.2, .2, .2}, {.maxIterations = 1});
  EXPECT_EQ(match.status, ScanMatchStatus::kBudgetSpent);
  EXPECT_EQ(match.iterations, 1);
  EXPECT_THAT(match.message, testing::HasSubstr("not converged in 1 iterations"));
}

TEST(ScanMatching, LeavesOutRaysThatMetNothing) {
  const RangeScanner scanner{.angles = {0, pi / 2, pi}, .maxRange = 5};
  const Eigen::Matrix2Xd points = scanPoints(scanner, Eigen::Vector3d(2, 5, 1));
  ASSERT_EQ(points.cols(), 2);
  EXPECT_NEAR((points.col(0) - Eigen::Vector2d(2, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((points.col(1) - Eigen::Vector2d(-1, 0)).norm(), 0, 1e-15);
  EXPECT_REX_ERROR(scanPoints(scanner, Eigen::Vector2d(1, 2)), "ranges");
}

TEST(ScanMatching, RefusesWhatIsNotSound) {
  Eigen::Matrix2Xd points = Eigen::Matrix2Xd::Random(2, 10), broken = points;
  broken(1, 4) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REX_ERROR(alignScans(broken, points, {0, 0, 0}), "reference scan: point 4: number 1");
  EXPECT_REX_ERROR(alignScans(points, broken, {0, 0, 0}), "moving scan: point 4");
  EXPECT_REX_ERROR(alignScans(points, points, {0, std::numeric_limits<double>::infinity(), 0}),
                   "guess of the motion: number 1: found inf");
  EXPECT_REX_ERROR(alignScans(points, points, {0, 0, 0}, {.deviation = 0}),
                   "matching scans: deviation: found 0 m, wanted a positive, finite number of metres");
  EXPECT_REX_ERROR(alignScans(points, points, {0, 0, 0}, {.maxGap = 0}), "matching scans: maxGap: found 0 m");
  EXPECT_REX_ERROR(alignScans(points, points, {0, 0, 0}, {.leastShare = -1}),
                   "matching scans: leastShare: found -1, wanted a positive, finite number");
  EXPECT_REX_ERROR(alignScans(points, points, {0, 0, 0}, {.maxIterations = 0}),
                   "matching scans: maxIterations: found 0, wanted at least 1");
  EXPECT_REX_ERROR(alignScans(points, points, {0, 0, 0}, {.maxDistance = -1}),
                   "matching scans: maxDistance: found -1 m");
  EXPECT_REX_ERROR(searchAlignment(points, points, {0, 0, 0}, {21, 1}), "window of a search");
  EXPECT_REX_ERROR(searchAlignment(points, points, {0, 0, 0}, {1, -1}), "window of a search");
}

}  // namespace rex::scan_matching_test
