#include "estimation/loop_closing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "scanned_halls.h"
#include "support/expect_error.h"

namespace rex::loop_closing_test {

using test::planarMotion;

// How far the motion of a loop is from what it was.
double errorOf(const LoopCandidate& loop, const Eigen::Matrix3Xd& truth) {
  return planarMotion(planarMotion(truth.col(loop.from), truth.col(loop.to)), loop.match.motion).norm();
}

int falseLoops(const LoopClosing& closing, const Eigen::Matrix3Xd& truth) {
  int count = 0;
  for (const LoopCandidate& loop : closing.candidates)
    if (loop.verdict == LoopVerdict::kAccepted && errorOf(loop, truth) > 0.3) ++count;
  return count;
}

// Measured over 24 seeds: the error of the map falls to a twenty-first at most, to a ninetieth in the median.
TEST(LoopClosing, MapErrorFallsByALargeFactor) {
  for (const int seed : {0, 1, 4, 17}) {
    Rng rng(seed);
    const test::Walk walk = test::walkAround(test::hall(), seed % 2 ? 2 : 1.5, rng);
    const LoopClosing closing = closeLoops(walk.odometry, walk.scans);
    EXPECT_EQ(falseLoops(closing, walk.truth), 0) << seed;
    EXPECT_GE(closing.accepted, 20) << seed;
    PlanarPoseGraph graph = closing.graph;
    EXPECT_EQ(optimize(graph).status, PoseGraphStatus::kConverged);
    const double before = test::mapError(walk.odometry.poses, walk.truth);
    EXPECT_GT(before, 1) << seed;
    EXPECT_LT(test::mapError(graph.poses, walk.truth), before / 10) << seed;
  }
}

// Two rooms with the same things in them, side by side on a corridor.
Building lookAlikeRooms() {
  Building building;
  for (const double x : {0., 4.2}) {
    building.addBox(x + 0.6, 0, 0.9, 0.7);
    building.addBox(x + 3.2, 2.5, 0.6, 0.8);
    building.walls.insert(building.walls.end(), {{x, 0, x + 4.2, 0},
                                                 {x, 0, x, 5},
                                                 {x + 4.2, 0, x + 4.2, 5},
                                                 {x, 5, x + 1.6, 5},
                                                 {x + 2.8, 5, x + 4.2, 5}});
  }
  building.walls.insert(building.walls.end(),
                        {{0, 5, 0, 7.5}, {0, 7.5, 8.4, 7.5}, {8.4, 5, 8.4, 7.5}, {5, 7.5, 5.5, 6.8}});
  return building;
}

// From the first room into the second, and back into the first, with bad odometry.
test::Walk throughBothRooms(Rng& rng) {
  std::vector<Eigen::Vector2d> way;
  const auto visit = [&](double x) {
    for (const auto& [dx, dy] : {std::array{2.2, 6.2},
                                 {2.2, 5.},
                                 {2.1, 3.6},
                                 {1.2, 3.2},
                                 {1., 2.},
                                 {2., 1.6},
                                 {2.8, 1.5},
                                 {2.4, 2.8},
                                 {2.2, 4.},
                                 {2.2, 5.},
                                 {2.2, 6.2}})
      way.emplace_back(x + dx, dy);
  };
  visit(0), visit(4.2), visit(0);
  test::Walk walk;
  walk.truth.resize(3, static_cast<Eigen::Index>(way.size()));
  const Eigen::Vector3d deviations(.15, .15, .06);
  const RangeScanner scanner = test::scannerOf(120, 8);
  double heading = 0;
  for (std::size_t k = 0; k < way.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    heading += rng.uniform(-.3, .3);
    walk.truth.col(column) << way[k].x() + rng.uniform(-.2, .2), way[k].y() + rng.uniform(-.1, .1), heading;
    walk.scans.push_back(test::scanOf(lookAlikeRooms(), scanner, walk.truth.col(column), .02, rng));
    if (k == 0) continue;
    const Eigen::Vector3d motion = planarMotion(walk.truth.col(column - 1), walk.truth.col(column)) +
                                   deviations.cwiseProduct(rng.normalVector(3));
    walk.odometry.edges.push_back({static_cast<int>(k) - 1, static_cast<int>(k), motion,
                                   deviations.cwiseAbs2().cwiseInverse().asDiagonal()});
  }
  walk.odometry.poses = walk.truth;
  setOdometryPoses(walk.odometry);
  return walk;
}

const LoopOptions kInRooms{.radius = 5, .leastGap = 6, .candidates = 4};

// Overconfident odometry contradicts true loops. To odometry without confidence, false loops are likely, too.
TEST(LoopClosing, SaysWhyNot) {
  using enum LoopVerdict;
  for (const auto& [trust, reason] : {std::pair{1., kAccepted}, {100., kUnlikely}, {0.03, kInconsistent}}) {
    std::map<LoopVerdict, int> counts;
    for (const std::uint64_t seed : {0, 1, 2, 3}) {
      Rng rng(seed);
      test::Walk walk = throughBothRooms(rng);
      for (auto& edge : walk.odometry.edges) edge.information *= trust;
      const LoopClosing closing = closeLoops(walk.odometry, walk.scans, kInRooms);
      EXPECT_EQ(std::ranges::count(closing.candidates, kAccepted, &LoopCandidate::verdict), closing.accepted);
      for (const LoopCandidate& loop : closing.candidates) {
        ++counts[loop.verdict];
        EXPECT_LE(loop.from + kInRooms.leastGap, loop.to);
        EXPECT_EQ(loop.reason.empty(), loop.verdict == kAccepted);
        if (loop.verdict != kAccepted) continue;
        EXPECT_GE(loop.match.overlap, kInRooms.leastOverlap);
        EXPECT_LE(loop.mahalanobis, kInRooms.bound);
      }
    }
    for (const auto verdict : {kNoMatch, kLittleOverlap, reason}) EXPECT_GT(counts[verdict], 5) << trust;
  }
}

TEST(LoopClosing, TakesNoRoomForOneThatLooksAlike) {
  // Scans alone do not tell the rooms apart.
  Rng noise(20);
  const RangeScanner scanner = test::scannerOf(120, 8);
  const ScanMatch alike =
      searchAlignment(test::scanOf(lookAlikeRooms(), scanner, {1.2, 3, 0}, .02, noise),
                      test::scanOf(lookAlikeRooms(), scanner, {5.6, 3, .2}, .02, noise), {0, 0, 0});
  EXPECT_EQ(alike.status, ScanMatchStatus::kConverged);
  EXPECT_GT(alike.overlap, LoopOptions{}.leastOverlap);
  for (int seed = 0; seed < 5; ++seed) {
    Rng rng(seed);
    const test::Walk walk = throughBothRooms(rng);
    const LoopClosing closing = closeLoops(walk.odometry, walk.scans, kInRooms);
    EXPECT_EQ(falseLoops(closing, walk.truth), 0) << seed;
    EXPECT_GE(closing.accepted, 3) << seed;
    PlanarPoseGraph graph = closing.graph;
    optimize(graph);
    EXPECT_LT(test::mapError(graph.poses, walk.truth), test::mapError(walk.odometry.poses, walk.truth) / 3)
        << seed;
  }
}

// Wrong loops that nobody filtered: the robust kernel leaves the map as it is without them.
TEST(LoopClosing, RobustKernelCopesWithWrongLoops) {
  Rng rng(6);
  const test::Walk walk = test::walkAround(test::hall(), 1.5, rng);
  PlanarPoseGraph graph = closeLoops(walk.odometry, walk.scans).graph, plain = graph;
  for (int i = 0; i < 5; ++i)
    plain.edges.push_back({10 + i, 60 + i, {.1, .05, .02}, 1e4 * Eigen::Matrix3d::Identity()});
  PlanarPoseGraph robust = plain;
  optimize(graph);
  optimize(plain);
  PoseGraphOptions options;
  options.kernel = RobustKernel::kGemanMcClure;
  options.kernelSize = 5;
  options.chordalStart = false;  // it knows no kernel
  robust.poses = graph.poses;
  robust.poses.row(0) += .05 * rng.normalVector(static_cast<int>(robust.poses.cols())).transpose();
  robust.poses.col(0) = graph.poses.col(0);
  optimize(robust, options);
  EXPECT_GT(test::mapError(plain.poses, walk.truth), 1);
  EXPECT_LT(test::mapError(robust.poses, graph.poses), 0.02);
}

TEST(AgreeingSet, IsTheLargestOnSmallGraphs) {
  Rng rng(8);
  for (int run = 0; run < 60; ++run) {
    // A clique of 6 among ten with a few other pairs: a larger one cannot be.
    Eigen::Matrix<bool, -1, -1> agree = Eigen::Matrix<bool, -1, -1>::Identity(10, 10);
    for (int a = 0; a < 10; ++a)
      for (int b = 0; b < a; ++b) agree(a, b) = agree(b, a) = (a < 6 && b < 6) || rng.uniform() < .2;
    const std::vector<int> set = agreeingSet(agree);
    for (const int a : set)
      for (const int b : set) EXPECT_TRUE(agree(a, b));
    // All subsets.
    std::size_t largest = 0;
    for (int subset = 0; subset < 1024; ++subset) {
      bool isClique = true;
      std::size_t size = 0;
      for (int a = 0; a < 10; ++a) {
        if (!(subset >> a & 1)) continue;
        ++size;
        for (int b = 0; b < a; ++b) isClique = isClique && (!(subset >> b & 1) || agree(a, b));
      }
      if (isClique) largest = std::max(largest, size);
    }
    EXPECT_EQ(set.size(), largest);
  }
  EXPECT_TRUE(agreeingSet(Eigen::Matrix<bool, -1, -1>(0, 0)).empty());
  EXPECT_REX_ERROR(agreeingSet(Eigen::Matrix<bool, -1, -1>(2, 3)), "agreeing set");
}

TEST(LoopClosing, RefusesWhatIsNotSound) {
  Rng rng(10);
  const test::Walk walk = test::walkAround(test::hall(), 0.25, rng);
  EXPECT_REX_ERROR(closeLoops(walk.odometry, {}), "closing loops: scans");
  PlanarPoseGraph graph = walk.odometry;
  graph.edges.pop_back();
  EXPECT_REX_ERROR(closeLoops(graph, walk.scans), "graph of odometry");
  graph = walk.odometry;
  std::swap(graph.edges[2].from, graph.edges[2].to);
  EXPECT_REX_ERROR(closeLoops(graph, walk.scans), "closing loops: edge 2: found one from 3 to 2");
  graph = walk.odometry;
  graph.edges[3].information(0, 0) = 0;
  EXPECT_REX_ERROR(closeLoops(graph, walk.scans), "not positive definite");
  LoopOptions options;
  options.leastGap = 1;
  EXPECT_REX_ERROR(closeLoops(walk.odometry, walk.scans, options), "closing loops: options");
}

// Nothing is seen along a corridor: what little rounding leaves there must not make an information negative.
TEST(LoopClosing, GraphOfACorridorCanBeOptimized) {
  const Building corridor{{{-50, -1, 50, -1}, {-50, 1, 50, 1}}};
  const RangeScanner scanner = test::scannerOf(180, 8);
  Rng rng(61);
  for (int k = 0; k < 30; ++k) {
    PlanarPoseGraph walk;
    walk.poses = Eigen::Matrix3Xd::Zero(3, 4);
    std::vector<Eigen::Matrix2Xd> scans;
    for (int i = 0; i < 4; ++i) {
      walk.poses.col(i) << 0.5 * i, 0, (i % 2 == 0 ? 0. : rng.uniform(-1, 1));
      scans.push_back(test::scanOf(corridor, scanner, walk.poses.col(i), 0, rng));
    }
    for (int i = 0; i + 1 < 4; ++i) {
      PlanarEdge edge{.from = i, .to = i + 1};
      const double c = std::cos(walk.poses(2, i)), s = std::sin(walk.poses(2, i));
      const Eigen::Vector3d d = walk.poses.col(i + 1) - walk.poses.col(i);
      edge.motion << c * d[0] + s * d[1], c * d[1] - s * d[0], d[2];
      edge.information = 100 * Eigen::Matrix3d::Identity();
      walk.edges.push_back(edge);
    }
    PlanarPoseGraph graph = closeLoops(walk, scans).graph;
    EXPECT_NO_THROW((void)optimize(graph)) << k;
  }
}

}  // namespace rex::loop_closing_test
