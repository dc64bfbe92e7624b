// Laws that every planner keeps, over a thousand seeds in worlds of random balls. Planners see the balls
// grown by half the resolution, so that what they check in points is clear of the true ones all along: by
// the distance of a ball from a segment in closed form, or of an arc in many points.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "planning/control_tree.h"
#include "planning/roadmap.h"
#include "planning/rrt.h"
#include "planning/smooth_path.h"
#include "systems/car.h"

namespace rex::planner_laws_test {

// A twentieth of them will do where sanitizers make everything slow.
#ifdef __SANITIZE_ADDRESS__
constexpr int kSeeds = 50;
#else
constexpr int kSeeds = 1000;
#endif
constexpr double kResolution = .05, kStepSize = .25;
constexpr int kMaxSamples = 250;

struct Ball {
  Eigen::VectorXd centre;
  double radius;
};

struct World {
  std::vector<Ball> balls;
  PathProblem problem;
};

// Balls between start and goal in a space whose numbers are lines from 0 to 1, angles or quaternions.
World randomWorld(const Space& space, const VectorArg& start, const VectorArg& goal, Rng& rng) {
  std::vector<Ball> balls;
  while (balls.size() < 4) {
    Ball ball{Eigen::VectorXd(space.size()), rng.uniform(.1, .3)};
    space.sample(rng, ball.centre);
    const double apart = std::min(space.distance(ball.centre, start), space.distance(ball.centre, goal));
    if (apart > ball.radius + kResolution) balls.push_back(ball);
  }
  const auto isValid = [space, balls](const VectorArg& q) {
    return std::all_of(balls.begin(), balls.end(), [&](const Ball& ball) {
      return space.distance(q, ball.centre) > ball.radius + kResolution / 2;
    });
  };
  return {balls, {space, eachColumn(isValid), start, goal, kResolution}};
}

// The unit square and cube, 4-D; a square with a heading, and a cube with a rotation and a knob: they count a
// tenth.
World randomWorld(std::uint64_t seed) {
  using Kind = SpacePart::Kind;
  Rng rng(1000 + seed);
  const int kind = static_cast<int>(seed % 5);
  if (kind == 4) {
    const SpacePart side{.lower = 0, .upper = 1};
    const Space space(
        {side, side, side, {.kind = Kind::kQuaternion, .weight = .1}, {.kind = Kind::kChord, .weight = .1}});
    Eigen::VectorXd start(8), goal(8);
    start << .05, .05, .05, 1, 0, 0, 0, 1;
    goal << .95, .95, .95, -.6, 0, .8, 0, -2;
    return randomWorld(space, start, goal, rng);
  }
  const int dimension = kind == 3 ? 3 : 2 + kind;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(dimension), one = Eigen::VectorXd::Ones(dimension);
  const Space space = kind == 3 ? Space::se2({0, 0}, {1, 1}, .1) : Space::box(zero, one);
  return randomWorld(space, .05 * one, .95 * one, rng);
}

double weightOf(const World& world, Eigen::Index i) {
  return world.problem.space.parts()[static_cast<std::size_t>(i)].weight;
}
bool isAngle(const World& world, Eigen::Index i) {
  return world.problem.space.parts()[static_cast<std::size_t>(i)].kind == SpacePart::Kind::kCircle;
}
bool hasRotation(const World& world) { return world.problem.start.size() == 8; }

// Of worlds with a rotation and a knob.
Eigen::VectorXd rotationMetric(const VectorArg& a, const VectorArg& b) {
  const Eigen::Vector4d r = a.segment<4>(3), s = b.segment<4>(3);
  return Eigen::Vector3d((a - b).head(3).norm(), .1 * std::min((r - s).norm(), (r + s).norm()),
                         .2 * std::sin((a[7] - b[7]) / 2));
}

// From a to b as planners go, in coordinates whose lengths are those of the metric.
Eigen::VectorXd wayBetween(const World& world, const VectorArg& a, const VectorArg& b) {
  if (hasRotation(world)) return rotationMetric(a, b);
  Eigen::VectorXd way = b - a;
  for (Eigen::Index i = 0; i < way.size(); ++i) {
    if (isAngle(world, i)) way[i] -= 2 * M_PI * std::round(way[i] / (2 * M_PI));
    way[i] *= weightOf(world, i);
  }
  return way;
}

// At points that are near each other: arcs are no lines in the coordinates of the metric.
double distanceFromArc(const VectorArg& a, const VectorArg& b, const Eigen::VectorXd& centre) {
  constexpr int kPoints = 16;
  const Eigen::Quaterniond from(a[3], a[4], a[5], a[6]), to(b[3], b[4], b[5], b[6]);
  const double turn = std::remainder(b[7] - a[7], 2 * M_PI);
  double least = std::numeric_limits<double>::infinity();
  Eigen::VectorXd q(8);
  for (int i = 0; i <= kPoints; ++i) {
    const double t = static_cast<double>(i) / kPoints;
    const Eigen::Quaterniond at = from.slerp(t, to);
    q << (1 - t) * a.head(3) + t * b.head(3), at.w(), at.vec(), a[7] + t * turn;
    least = std::min(least, rotationMetric(q, centre).norm());
  }
  return least;
}

// Of a ball's centre from the way, also from where its heading is a turn more or less.
double distanceFromWay(const World& world, const VectorArg& a, const VectorArg& b,
                       const Eigen::VectorXd& centre) {
  if (hasRotation(world)) return distanceFromArc(a, b, centre);
  const Eigen::VectorXd way = wayBetween(world, a, b);
  double least = std::numeric_limits<double>::infinity();
  for (const int turns : {-2, -1, 0, 1, 2}) {
    Eigen::VectorXd to = centre - a;
    for (Eigen::Index i = 0; i < to.size(); ++i)
      to[i] = weightOf(world, i) * (to[i] + (isAngle(world, i) ? 2 * M_PI * turns : 0));
    const double t = way.isZero() ? 0 : std::clamp(to.dot(way) / way.squaredNorm(), 0., 1.);
    least = std::min(least, (to - t * way).norm());
  }
  return least;
}

bool isClear(const World& world, const VectorArg& a, const VectorArg& b) {
  return std::all_of(world.balls.begin(), world.balls.end(), [&](const Ball& ball) {
    return distanceFromWay(world, a, b, ball.centre) > ball.radius;
  });
}

bool isInside(const World& world, const VectorArg& q) {
  const Eigen::Index lines = hasRotation(world) ? 3 : q.size();
  for (Eigen::Index i = 0; i < lines; ++i)
    if (!isAngle(world, i) && (q[i] < 0 || q[i] > 1)) return false;
  return !hasRotation(world) || std::abs(q.segment<4>(3).norm() - 1) < 1e-12;
}

double expectClearWay(const World& world, const Eigen::MatrixXd& path) {
  EXPECT_EQ(path.col(0), world.problem.start);
  EXPECT_EQ(path.rightCols<1>(), world.problem.goal);
  double length = 0;
  for (Eigen::Index k = 1; k < path.cols(); ++k) {
    EXPECT_TRUE(isInside(world, path.col(k)));
    EXPECT_TRUE(isClear(world, path.col(k - 1), path.col(k))) << "piece " << k;
    length += wayBetween(world, path.col(k - 1), path.col(k)).norm();
  }
  return length;
}

void expectPath(const World& world, const PathResult& result) {
  if (result.status == PathStatus::kBudgetSpent) {
    EXPECT_EQ(result.path.cols(), 0);
    EXPECT_EQ(result.length, 0);
    return;
  }
  EXPECT_NEAR(result.length, expectClearWay(world, result.path), 1e-12);
  EXPECT_GE(result.asked, result.path.cols() - 1);
}

// Every node hangs on the root by clear edges; parents come before children unless they were exchanged.
void expectTree(const World& world, const PathTree& tree, bool mayBeRewired) {
  const Eigen::Index count = tree.nodes.cols();
  ASSERT_EQ(static_cast<std::size_t>(count), tree.parents.size());
  EXPECT_EQ(tree.parents[0], -1);
  for (Eigen::Index k = 1; k < count; ++k) {
    const int parent = tree.parents[static_cast<std::size_t>(k)];
    ASSERT_GE(parent, 0);
    ASSERT_LT(parent, mayBeRewired ? count : k);
    EXPECT_TRUE(isInside(world, tree.nodes.col(k)));
    EXPECT_TRUE(isClear(world, tree.nodes.col(parent), tree.nodes.col(k))) << "node " << k;
    EXPECT_LE(wayBetween(world, tree.nodes.col(parent), tree.nodes.col(k)).norm(), kStepSize + 1e-12);
    Eigen::Index steps = 0;
    for (int at = parent; at >= 0 && steps <= count; at = tree.parents[static_cast<std::size_t>(at)]) ++steps;
    EXPECT_LE(steps, count) << "a cycle";
  }
}

using Planner = std::function<PathResult(const PathProblem&, Rng&)>;

void expectSameAgain(const Planner& planner, const World& world, std::uint64_t seed,
                     const PathResult& result) {
  Rng rng(seed);
  const PathResult again = planner(world.problem, rng);
  EXPECT_EQ(again.path, result.path);
  EXPECT_EQ(again.asked, result.asked);
  EXPECT_EQ(again.message, result.message);
  ASSERT_EQ(again.trees.size(), result.trees.size());
  for (std::size_t i = 0; i < again.trees.size(); ++i) {
    EXPECT_EQ(again.trees[i].nodes, result.trees[i].nodes);
    EXPECT_EQ(again.trees[i].parents, result.trees[i].parents);
  }
}

void expectTreeLaws(const Planner& planner, std::size_t trees, bool mayBeRewired, double share) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const World world = randomWorld(seed);
    Rng rng(seed);
    const PathResult result = planner(world.problem, rng);
    expectPath(world, result);
    ASSERT_EQ(result.trees.size(), trees);
    for (const PathTree& tree : result.trees) expectTree(world, tree, mayBeRewired);
    EXPECT_LE(result.samples, kMaxSamples);
    const bool isFound = result.status == PathStatus::kFound;
    EXPECT_TRUE(isFound || result.samples == kMaxSamples);
    found += isFound ? 1 : 0;
    if (seed % 10 == 0) expectSameAgain(planner, world, seed, result);
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(found, share * kSeeds);
}

constexpr RrtOptions kGrowth{.stepSize = kStepSize, .goalBias = .1, .maxSamples = kMaxSamples};

TEST(PlannerLaws, HoldForRrt) {
  expectTreeLaws([](const auto& problem, Rng& rng) { return growRrt(problem, kGrowth, rng); }, 1, false, .6);
}

TEST(PlannerLaws, HoldForRrtConnect) {
  expectTreeLaws([](const auto& problem, Rng& rng) { return connectRrts(problem, kGrowth, rng); }, 2, false,
                 .9);
}

TEST(PlannerLaws, HoldForRrtStar) {
  const auto star = [](int samples) -> Planner {
    return [=](const auto& problem, Rng& rng) {
      RrtOptions growth = kGrowth;
      growth.maxSamples = samples;
      return growRrtStar(problem, {.growth = growth}, rng);
    };
  };
  expectTreeLaws(star(kMaxSamples), 1, true, .6);
  // Of the same seed a larger budget continues what the smaller one began.
  for (std::uint64_t seed = 0; seed < kSeeds; seed += 5) {
    const World world = randomWorld(seed);
    Rng few(seed), many(seed);
    const PathResult early = star(kMaxSamples / 2)(world.problem, few);
    const PathResult late = star(kMaxSamples)(world.problem, many);
    if (early.status == PathStatus::kBudgetSpent) continue;
    ASSERT_EQ(late.status, PathStatus::kFound);
    EXPECT_LE(late.length, early.length + 1e-12) << seed;
  }
}

void expectRoadmap(const World& world, const Roadmap& roadmap, const RoadmapOptions& options) {
  EXPECT_LE(roadmap.nodes(), options.nodes + 2);
  for (int i = 0; i < roadmap.nodes(); ++i) EXPECT_TRUE(isInside(world, roadmap.node(i)));
  std::set<std::pair<int, int>> seen;
  for (const auto& [a, b] : roadmap.edges()) {
    EXPECT_NE(a, b);
    EXPECT_TRUE(seen.emplace(std::minmax(a, b)).second) << "the edge " << a << " " << b << " is there twice";
    EXPECT_TRUE(options.lazy || isClear(world, roadmap.node(a), roadmap.node(b)));
  }
}

// All its pieces are edges.
void expectOnRoadmap(const Roadmap& roadmap, const Eigen::MatrixXd& path) {
  const auto edges = roadmap.edges();
  for (Eigen::Index k = 1; k < path.cols(); ++k) {
    EXPECT_TRUE(std::any_of(edges.begin(), edges.end(), [&](const auto& edge) {
      const Eigen::VectorXd a = roadmap.node(edge.first), b = roadmap.node(edge.second);
      return (a == path.col(k - 1) && b == path.col(k)) || (b == path.col(k - 1) && a == path.col(k));
    }));
  }
}

void expectRoadmapLaws(const RoadmapOptions& options) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const World world = randomWorld(seed);
    const PathProblem& problem = world.problem;
    const auto made = [&] {
      Rng rng(seed);
      return Roadmap(problem.space, problem.allValid, problem.resolution, options, rng);
    };
    Roadmap roadmap = made();
    const PathResult result = roadmap.query(problem);
    expectPath(world, result);
    expectRoadmap(world, roadmap, options);
    expectOnRoadmap(roadmap, result.path);
    found += result.status == PathStatus::kFound ? 1 : 0;
    if (seed % 10 == 0) {
      EXPECT_EQ(made().query(problem).path, result.path);
    }
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(found, .8 * kSeeds);
}

TEST(PlannerLaws, HoldForRoadmaps) { expectRoadmapLaws({.nodes = 80, .neighbors = 8}); }
TEST(PlannerLaws, HoldForLazyRoadmaps) { expectRoadmapLaws({.nodes = 80, .neighbors = 8, .lazy = true}); }
TEST(PlannerLaws, HoldForStarredRoadmaps) { expectRoadmapLaws({.nodes = 80, .neighbors = 0}); }

// Along arcs: their chords get longer in sum when more points come between.
double lengthOfWays(const Space& space, const Eigen::MatrixXd& path) {
  double length = 0;
  for (Eigen::Index k = 1; k < path.cols(); ++k) length += space.wayLength(path.col(k - 1), path.col(k));
  return length;
}

TEST(PlannerLaws, HoldForSmoothing) {
  int found = 0, shorter = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const World world = randomWorld(seed);
    Rng rng(seed);
    const PathResult result = connectRrts(world.problem, kGrowth, rng);
    if (result.status != PathStatus::kFound) continue;
    ++found;
    const Eigen::MatrixXd cut = shortcut(world.problem, result.path, 30, rng);
    const double length = expectClearWay(world, cut);
    EXPECT_LE(length, result.length + 1e-12);
    const Eigen::MatrixXd round = roundCorners(world.problem, cut, 3);
    expectClearWay(world, round);
    EXPECT_LE(lengthOfWays(world.problem.space, round), lengthOfWays(world.problem.space, cut) + 1e-12);
    shorter += length < .99 * result.length ? 1 : 0;
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(found, .9 * kSeeds);
  EXPECT_GT(shorter, .5 * found);
}

// A car between balls in the plane: between two checks it drives less than the resolution.
TEST(PlannerLaws, HoldForControlTrees) {
  const Car car{.wheelbase = .1, .maxSteering = .6};
  const ControlSystem system{
      .space = Space::se2({0, 0}, {1, 1}, .1),
      .lower = Eigen::Vector2d(-.4, -.6),
      .upper = Eigen::Vector2d(.4, .6),
      .motion = [car](const VectorArg& x, const VectorArg& u, double seconds) -> Eigen::VectorXd {
        return driveCar(car, x, u, seconds);
      }};
  const ControlTreeOptions options{.shortest = .3,
                                   .checkEvery = .125,
                                   .trials = 3,
                                   .goalBias = .2,
                                   .tolerance = .2,
                                   .maxSamples = kMaxSamples};
  int found = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    World world = randomWorld(5 * seed);
    PathProblem& problem = world.problem;
    problem.space = system.space;
    problem.start = Eigen::Vector3d(.05, .05, .7);
    problem.goal = Eigen::Vector3d(.95, .95, .7);
    const auto gap = [balls = world.balls](const VectorArg& q) {
      double least = std::numeric_limits<double>::infinity();
      for (const Ball& ball : balls) least = std::min(least, (q.head(2) - ball.centre).norm() - ball.radius);
      return least;
    };
    problem.allValid = eachColumn([gap](const VectorArg& q) { return gap(q) > kResolution / 2; });
    Rng rng(seed), again(seed);
    const ControlPath path = growControlTree(system, problem, options, rng);
    const PathTree& tree = path.found.trees.at(0);
    for (std::size_t k = 1; k < tree.parents.size(); ++k)
      ASSERT_TRUE(tree.parents[k] >= 0 && tree.parents[k] < static_cast<int>(k));
    EXPECT_LE(path.found.samples, kMaxSamples);
    ASSERT_EQ(static_cast<Eigen::Index>(path.controls.size()),
              std::max<Eigen::Index>(0, path.found.path.cols() - 1));
    if (seed % 10 == 0) {
      EXPECT_EQ(growControlTree(system, problem, options, again).found.path, path.found.path);
    }
    if (path.found.status != PathStatus::kFound) continue;
    ++found;
    EXPECT_EQ(path.found.path.col(0), problem.start);
    EXPECT_LE(system.space.distance(path.found.path.rightCols<1>(), problem.goal), options.tolerance);
    Eigen::Index at = 0;
    for (const auto& [u, seconds] : path.controls) {
      const Eigen::VectorXd x = path.found.path.col(at++);
      EXPECT_TRUE((u.array().abs() <= system.upper.array()).all());
      for (int i = 0; i <= 40; ++i) EXPECT_GT(gap(driveCar(car, x, u, seconds * i / 40)), 0);
      EXPECT_LT((driveCar(car, x, u, seconds) - path.found.path.col(at)).norm(), 1e-12);
    }
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(found, .3 * kSeeds);
}

}  // namespace rex::planner_laws_test
