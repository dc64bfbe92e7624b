#include "estimation/pose_graph.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/derivative_check.h"
#include "base/rng.h"
#include "estimation/g2o_file.h"
#include "estimation/kalman_filter.h"
#include "estimation/pose_edge_internal.h"
#include "geometry/pose.h"
#include "geometry/rotation.h"
#include "random_gaussian.h"
#include "street_graph.h"
#include "support/expect_error.h"
#include "support/paths.h"

namespace rex::pose_graph_test {

using internal::PlanarGraphTraits;
using internal::SpatialGraphTraits;
using test::planarMotion;
using test::streets;

constexpr PoseGraphObjective kObjectives[] = {PoseGraphObjective::kChi2, PoseGraphObjective::kSESync};

Pose randomPose(Rng& rng, double spread) {
  return {expSO3(spread * rng.normalVector(3)), spread * rng.normalVector(3)};
}

SpatialPoseGraph ball(int poses, double noise, Rng& rng) {
  std::vector<Pose> X;
  for (int i = 0; i < poses; ++i) {
    const double turn = .3 * i, height = 2. * i / poses - 1;
    const double radius = std::sqrt(1 - height * height);
    X.push_back({expSO3({.2 * i, .1 * i, turn}),
                 10 * Eigen::Vector3d(radius * std::cos(turn), radius * std::sin(turn), height)});
  }
  SpatialPoseGraph graph{std::vector<Pose>(X.size()), {}};
  graph.poses[0] = X[0];
  const auto measure = [&](std::size_t i, std::size_t j) {
    const Pose motion = X[i].inverse() * X[j];
    Matrix6d information = Matrix6d::Identity() / noise / noise;
    information.bottomRightCorner<3, 3>() *= 16;
    graph.edges.push_back(
        {static_cast<int>(i),
         static_cast<int>(j),
         {motion.R * expSO3(.5 * noise * rng.normalVector(3)), motion.p + noise * rng.normalVector(3)},
         information});
  };
  for (std::size_t i = 1; i < X.size(); ++i) measure(i - 1, i);
  for (std::size_t i = 0; i + 21 < X.size(); ++i) measure(i, i + 21);
  setOdometryPoses(graph);
  return graph;
}

// Every Jacobian of an edge against differences, at no error, at 1e-8 and at random.
TEST(PoseGraph, PlanarJacobiansAreDerivatives) {
  Rng rng(51);
  for (const PoseGraphObjective objective : kObjectives) {
    for (const double size : {0., 1e-8, 1.}) {
      PlanarPoseGraph graph{Eigen::Matrix3Xd(3, 3), {}};
      graph.poses.col(0).setZero();
      graph.poses.col(1) = rng.normalVector(3);
      graph.poses.col(2) = rng.normalVector(3);
      const Eigen::Vector3d exact = planarMotion(graph.poses.col(1), graph.poses.col(2));
      graph.edges.push_back({1, 2, exact + size * rng.normalVector(3), test::randomCovariance(3, rng)});
      const auto term = PlanarGraphTraits::term(graph, graph.edges[0], objective);
      Eigen::MatrixXd J(3, 6);
      J << term.Ji, term.Jj;
      const auto error = [&](const Eigen::VectorXd& delta) -> Eigen::VectorXd {
        PlanarPoseGraph moved = graph;
        PlanarGraphTraits::step(moved, delta);
        return PlanarGraphTraits::term(moved, moved.edges[0], objective).e;
      };
      const JacobianCheck check = checkJacobian(error, J, Eigen::VectorXd::Zero(6), 1e-7);
      EXPECT_TRUE(check.ok) << check.message;
    }
  }
}

TEST(PoseGraph, SpatialJacobiansAreDerivatives) {
  Rng rng(52);
  for (const double size : {0., 1e-8, .7}) {
    SpatialPoseGraph graph{{Pose{}, randomPose(rng, 1), randomPose(rng, 1)}, {}};
    const Pose exact = graph.poses[1].inverse() * graph.poses[2];
    graph.edges.push_back({1, 2, exact * randomPose(rng, size), test::randomCovariance(6, rng)});
    const auto term = SpatialGraphTraits::term(graph, graph.edges[0], PoseGraphObjective::kChi2);
    Eigen::MatrixXd J(6, 12);
    J << term.Ji, term.Jj;
    const auto error = [&](const Eigen::VectorXd& delta) -> Eigen::VectorXd {
      SpatialPoseGraph moved = graph;
      SpatialGraphTraits::step(moved, delta);
      return SpatialGraphTraits::term(moved, moved.edges[0], PoseGraphObjective::kChi2).e;
    };
    const JacobianCheck check = checkJacobian(error, J, Eigen::VectorXd::Zero(12), 1e-7);
    EXPECT_TRUE(check.ok) << check.message;
  }
}

// Motions that are rotations only to six digits, one after the other.
TEST(PoseGraph, OdometryKeepsRotations) {
  SpatialPoseGraph graph{std::vector<Pose>(400), {}};
  for (int i = 0; i < 399; ++i)
    graph.edges.push_back({i, i + 1, {(1 + 3e-7) * expSO3({.1, .2, .3}), {1, 0, 0}}});
  setOdometryPoses(graph);
  EXPECT_TRUE(isRotation(graph.poses[399].R, 1e-14));
}

// The objectives as their papers write them.
TEST(PoseGraph, CostsAreTheFormulas) {
  Rng rng(53);
  const PlanarPoseGraph graph = streets(60, .2, rng);
  double chi2 = 0, sesync = 0;
  for (const PlanarEdge& edge : graph.edges) {
    const auto R = [](double a) -> Eigen::Matrix2d { return Eigen::Rotation2Dd(a).toRotationMatrix(); };
    const Eigen::Vector3d xi = graph.poses.col(edge.from), xj = graph.poses.col(edge.to);
    const Eigen::Vector3d relative = planarMotion(xi, xj), e = planarMotion(edge.motion, relative);
    chi2 += e.dot(edge.information * e);
    const double tau = 2 / edge.information.topLeftCorner<2, 2>().inverse().trace();
    sesync += edge.information(2, 2) * (R(xj[2]) - R(xi[2]) * R(edge.motion[2])).squaredNorm() +
              tau * (xj.head<2>() - xi.head<2>() - R(xi[2]) * edge.motion.head<2>()).squaredNorm();
  }
  EXPECT_NEAR(poseGraphCost(graph), chi2, 1e-9 * chi2);
  EXPECT_NEAR(poseGraphCost(graph, {.objective = PoseGraphObjective::kSESync}), sesync, 1e-9 * sesync);

  const SpatialPoseGraph space = ball(40, .2, rng);
  sesync = 0;
  for (const SpatialEdge& edge : space.edges) {
    const Pose &X_i = space.poses[static_cast<std::size_t>(edge.from)],
               &X_j = space.poses[static_cast<std::size_t>(edge.to)];
    const double tau = 3 / edge.information.topLeftCorner<3, 3>().inverse().trace();
    const double kappa = 1.5 / edge.information.bottomRightCorner<3, 3>().inverse().trace();
    sesync += kappa * (X_j.R - X_i.R * edge.motion.R).squaredNorm() +
              tau * (X_j.p - X_i.p - X_i.R * edge.motion.p).squaredNorm();
  }
  EXPECT_NEAR(poseGraphCost(space, {.objective = PoseGraphObjective::kSESync}), sesync, 1e-9 * sesync);
}

// Along a line nothing turns, so that the graph is a linear-Gaussian problem: a smoother solves it, too.
TEST(PoseGraph, IsTheSmootherOnALine) {
  Rng rng(54);
  const int steps = 20;
  const auto number = [](double v) { return Eigen::MatrixXd::Constant(1, 1, v); };
  PlanarPoseGraph graph{Eigen::Matrix3Xd::Zero(3, steps + 1), {}};
  std::vector<Gaussian> filtered{{number(0), number(0)}};
  std::vector<LinearModel> walks;
  double x = 0;
  for (int t = 1; t <= steps; ++t) {
    const double move = 1 + .3 * rng.normal();
    x += move + .2 * rng.normal();
    graph.edges.push_back({t - 1, t, {move, 0, 0}, Eigen::Vector3d(25, 1, 1).asDiagonal()});
    walks.push_back({number(1), number(move), number(.04)});
    Gaussian belief = kalmanPredict(filtered.back(), walks.back());
    if (t % 3 == 0) {
      const double seen = x + .1 * rng.normal();
      graph.edges.push_back({0, t, {seen, 0, 0}, Eigen::Vector3d(100, 1, 1).asDiagonal()});
      belief = kalmanUpdate(belief, {number(1), number(0), number(.01)}, number(seen)).belief;
    }
    filtered.push_back(belief);
  }
  ASSERT_EQ(optimize(graph).status, PoseGraphStatus::kConverged);
  const std::vector<Gaussian> later = smoothed(filtered, walks);
  for (int t = 0; t <= steps; ++t)
    EXPECT_NEAR(graph.poses(0, t), later[static_cast<std::size_t>(t)].mean[0], 1e-10);
}

TEST(PoseGraph, ExactMotionsGiveTheTruth) {
  Rng rng(55);
  Eigen::Matrix3Xd truth;
  PlanarPoseGraph graph = streets(200, 1e-5, rng, &truth);
  for (Eigen::Index i = 1; i < graph.poses.cols(); ++i) graph.poses.col(i) = rng.normalVector(3);
  const PoseGraphResult result = optimize(graph);
  EXPECT_EQ(result.status, PoseGraphStatus::kConverged) << result.message;
  EXPECT_LT((graph.poses - truth).topRows<2>().cwiseAbs().maxCoeff(), 1e-3);
}

// Four corners of a square, each edge followed by a quarter turn: nothing but rounding is left to lower.
TEST(PoseGraph, GraphsThatFitExactlyConverge) {
  constexpr double kQuarter = std::numbers::pi / 2;
  for (const PoseGraphObjective objective : kObjectives)
    for (const double size : {1e-3, 1., 1e4})
      for (const bool chordal : {true, false}) {
        const PoseGraphOptions options{.objective = objective, .chordalStart = chordal};
        PlanarPoseGraph square{Eigen::Matrix3Xd::Zero(3, 4), {}};
        SpatialPoseGraph space{std::vector<Pose>(4), {}};
        for (int i = 0; i < 4; ++i) {
          square.edges.push_back({i, (i + 1) % 4, {size, 0, kQuarter}});
          space.edges.push_back({i, (i + 1) % 4, {expSO3({0, 0, kQuarter}), {size, 0, 0}}});
        }
        setOdometryPoses(square);
        setOdometryPoses(space);
        const PoseGraphResult planar = optimize(square, options), spatial = optimize(space, options);
        EXPECT_EQ(planar.status, PoseGraphStatus::kConverged) << planar.message;
        EXPECT_EQ(spatial.status, PoseGraphStatus::kConverged) << spatial.message;
        EXPECT_LE(planar.iterations, 2);
        EXPECT_LE(spatial.iterations, 2);
        EXPECT_LT((square.poses.col(2) - Eigen::Vector3d(size, size, 2 * kQuarter)).head<2>().norm(),
                  1e-14 * size);
        EXPECT_LT((space.poses[2].p - Eigen::Vector3d(size, size, 0)).norm(), 1e-14 * size);
      }
}

// Weights that no linear solution survives, and weights that a fixed anchor would drown.
TEST(PoseGraph, StartsWellWhateverTheWeights) {
  for (const double heavy : {1., 1e8, 1e17}) {
    PlanarPoseGraph chain{Eigen::Matrix3Xd::Zero(3, 4), {}};
    SpatialPoseGraph space{std::vector<Pose>(4), {}};
    for (int i = 0; i < 3; ++i) {
      const double weight = i == 0 ? 1 : heavy;
      chain.edges.push_back({i, i + 1, {1, 0, .1}, weight * Eigen::Matrix3d::Identity()});
      space.edges.push_back({i, i + 1, {expSO3({.1, 0, 0}), {1, 0, 0}}, weight * Matrix6d::Identity()});
    }
    setOdometryPoses(chain);
    setOdometryPoses(space);
    const Eigen::Matrix3Xd truth = chain.poses;
    const Pose last = space.poses[3];
    EXPECT_LT(optimize(chain).cost, 1e-28 * heavy);
    EXPECT_LT(optimize(space).cost, 1e-28 * heavy);
    EXPECT_LT((chain.poses - truth).norm(), 1e-9) << heavy;
    EXPECT_TRUE(isApprox(space.poses[3], last, 1e-9)) << heavy;
  }
  for (const double light : {1e-16, 1e-30}) {
    Rng rng(61);
    PlanarPoseGraph graph = streets(60, .05, rng), lighter = graph;
    for (PlanarEdge& edge : lighter.edges) edge.information *= light;
    const double cost = optimize(graph).cost;
    EXPECT_NEAR(optimize(lighter, {.maxIterations = 5}).cost, light * cost, 1e-6 * light * cost);
    EXPECT_LT((graph.poses - lighter.poses).cwiseAbs().maxCoeff(), 1e-3);
  }
}

// From odometry and from nonsense the same minimum is found; no small random step goes lower.
TEST(PoseGraph, FindsTheMinimumFromAnywhere) {
  Rng rng(56);
  for (const PoseGraphObjective objective : kObjectives) {
    PlanarPoseGraph graph = streets(300, .05, rng), lost = graph, odometry = graph;
    for (Eigen::Index i = 1; i < lost.poses.cols(); ++i) lost.poses.col(i) = 20 * rng.normalVector(3);
    const PoseGraphResult result = optimize(graph, {.objective = objective});
    ASSERT_EQ(result.status, PoseGraphStatus::kConverged) << result.message;
    EXPECT_LT(result.cost, .5 * result.initialCost);
    EXPECT_NEAR(optimize(lost, {.objective = objective}).cost, result.cost, 1e-9 * result.cost);
    EXPECT_NEAR(optimize(odometry, {.objective = objective, .chordalStart = false}).cost, result.cost,
                1e-9 * result.cost);
    for (int i = 0; i < 50; ++i) {
      PlanarPoseGraph moved = graph;
      PlanarGraphTraits::step(moved, 1e-4 * rng.normalVector(3 * 299));
      EXPECT_GT(poseGraphCost(moved, {.objective = objective}), result.cost);
    }
    SpatialPoseGraph space = ball(120, .1, rng), spaceLost = space, spaceOdometry = space;
    for (std::size_t i = 1; i < spaceLost.poses.size(); ++i) spaceLost.poses[i] = randomPose(rng, 3);
    const PoseGraphResult spatial = optimize(space, {.objective = objective});
    ASSERT_EQ(spatial.status, PoseGraphStatus::kConverged) << spatial.message;
    EXPECT_NEAR(optimize(spaceLost, {.objective = objective}).cost, spatial.cost, 1e-9 * spatial.cost);
    EXPECT_NEAR(optimize(spaceOdometry, {.objective = objective, .chordalStart = false}).cost, spatial.cost,
                1e-9 * spatial.cost);
  }
}

// What is best of all is known to be; what is only best around is not.
TEST(PoseGraph, ProvesThatItIsTheBest) {
  Rng rng(59);
  const PoseGraphOptions sesync{.objective = PoseGraphObjective::kSESync};
  PlanarPoseGraph graph = streets(300, .05, rng), lost = graph;
  const PoseGraphResult best = optimize(graph, sesync);
  EXPECT_LT(certifiedGap(graph), 1e-6 * best.cost);
  for (Eigen::Index i = 1; i < lost.poses.cols(); ++i) lost.poses.col(i) = 20 * rng.normalVector(3);
  PoseGraphOptions blind = sesync;
  blind.chordalStart = false;
  const PoseGraphResult trapped = optimize(lost, blind);
  ASSERT_GT(trapped.cost, 2 * best.cost) << "the start was to lead into a trap";
  EXPECT_GT(certifiedGap(lost), trapped.cost - best.cost);

  SpatialPoseGraph space = ball(120, .1, rng);
  const PoseGraphResult spatial = optimize(space, sesync);
  EXPECT_LT(certifiedGap(space), 1e-6 * spatial.cost);
  space.poses[5].R = space.poses[5].R * expSO3({0, 0, .1});
  EXPECT_GT(certifiedGap(space), poseGraphCost(space, sesync) - spatial.cost);
}

// At the minimum of another cost: golden number, found by trying one power of ten after the other.
TEST(PoseGraph, BoundsTheGapWithinAPowerOfTen) {
  Rng rng(1);
  PlanarPoseGraph graph = streets(3500, .05, rng);
  static_cast<void>(optimize(graph));
  EXPECT_NEAR(certifiedGap(graph), 92.6268, 1e-3);
}

// Where rotations or positions are not stationary the bound still holds: the cost of the best is no lower.
TEST(PoseGraph, ProvesNothingThatIsWrong) {
  const PoseGraphOptions sesync{.objective = PoseGraphObjective::kSESync};
  PlanarPoseGraph two{Eigen::Matrix3Xd::Zero(3, 2), {{0, 1, {1, 0, 0}}}};
  for (const double x : {3., -2., .5, 1.}) {
    two.poses(0, 1) = x;
    EXPECT_GE(certifiedGap(two), poseGraphCost(two, sesync)) << x;
  }
  EXPECT_LT(certifiedGap(two), 1e-10) << "1 m is the best";
  Rng rng(60);
  PlanarPoseGraph graph = streets(100, .05, rng);
  const double best = optimize(graph, sesync).cost;
  SpatialPoseGraph space = ball(80, .1, rng);
  const double spatial = optimize(space, sesync).cost;
  for (int i = 0; i < 30; ++i) {
    const double size = std::pow(10., -i / 6);
    PlanarPoseGraph moved = graph;
    SpatialPoseGraph away = space;
    moved.poses.col(7 + i) += size * rng.normalVector(3).cwiseProduct(Eigen::Vector3d(1, 1, i % 2));
    away.poses[static_cast<std::size_t>(7 + i)].p += size * rng.normalVector(3);
    const double excess = poseGraphCost(moved, sesync) - best;
    EXPECT_GE(certifiedGap(moved), excess) << size;
    EXPECT_GE(certifiedGap(away), poseGraphCost(away, sesync) - spatial) << size;
  }
  EXPECT_EQ(certifiedGap(PlanarPoseGraph{}), 0);
  EXPECT_EQ(certifiedGap(SpatialPoseGraph{}), 0);
  EXPECT_EQ(certifiedGap(PlanarPoseGraph{Eigen::Matrix3Xd::Zero(3, 1), {}}), 0);
  EXPECT_EQ(certifiedGap(SpatialPoseGraph{std::vector<Pose>(1), {}}), 0);
}

// Wrong closures spoil the chordal start: poses that were good already do not become worse by it.
TEST(PoseGraph, KeepsTheBetterStart) {
  for (const RobustKernel kernel :
       {RobustKernel::kHuber, RobustKernel::kCauchy, RobustKernel::kGemanMcClure}) {
    Rng rng(57);
    Eigen::Matrix3Xd truth;
    PlanarPoseGraph graph = streets(200, .02, rng, &truth);
    for (int i = 0; i < 5; ++i)
      graph.edges.push_back(
          {10 * i, 190 - 13 * i,
           planarMotion(truth.col(10 * i), truth.col(190 - 13 * i)) + Eigen::Vector3d(5, -4, 2),
           Eigen::Vector3d(2500, 2500, 1e4).asDiagonal()});
    PoseGraphOptions options{.kernel = kernel, .kernelSize = 3, .chordalStart = false, .maxIterations = 1000};
    const double reached = optimize(graph, options).cost;
    options.chordalStart = true;
    const PoseGraphResult again = optimize(graph, options);
    EXPECT_LE(again.cost, reached) << again.message;
  }
}

// A robust kernel leaves wrong loop closures aside, those that grow slowly enough (Huber's) in part.
TEST(PoseGraph, KernelsResistWrongClosures) {
  for (const RobustKernel kernel :
       {RobustKernel::kHuber, RobustKernel::kCauchy, RobustKernel::kGemanMcClure}) {
    Rng rng(57);
    Eigen::Matrix3Xd truth;
    PlanarPoseGraph graph = streets(200, .02, rng, &truth), plain;
    const bool isHuber = kernel == RobustKernel::kHuber;
    const double size = isHuber ? .1 : 1;
    for (int i = 0; i < 5; ++i) {
      const Eigen::Vector3d exact = planarMotion(truth.col(10 * i), truth.col(190 - 13 * i));
      graph.edges.push_back({10 * i, 190 - 13 * i, exact + size * Eigen::Vector3d(5, -4, 2),
                             Eigen::Vector3d(2500, 2500, 1e4).asDiagonal()});
    }
    plain = graph;
    ASSERT_EQ(optimize(plain).status, PoseGraphStatus::kConverged);
    const PoseGraphResult result = optimize(
        graph,
        {.kernel = kernel, .kernelSize = 3, .chordalStart = false, .maxIterations = 1000, .tolerance = 1e-9});
    EXPECT_EQ(result.status, PoseGraphStatus::kConverged) << result.message;
    const double error = (graph.poses - truth).topRows<2>().colwise().norm().maxCoeff();
    EXPECT_LT((isHuber ? 1.2 : 3.) * error, (plain.poses - truth).topRows<2>().colwise().norm().maxCoeff())
        << static_cast<int>(kernel) << ": " << result.message;
  }
}

TEST(PoseGraph, ExampleIsAsItIsMade) {
  Rng rng(7);
  const PlanarPoseGraph made = streets(400, .06, rng);
  const auto file = std::get<PlanarPoseGraph>(readG2o(homeFolder() / "data/graphs/streets.g2o").graph);
  EXPECT_LT((made.poses - file.poses).cwiseAbs().maxCoeff(), 1e-9);
  ASSERT_EQ(made.edges.size(), file.edges.size());
  for (std::size_t k = 0; k < made.edges.size(); ++k) {
    EXPECT_EQ(made.edges[k].from, file.edges[k].from);
    EXPECT_EQ(made.edges[k].to, file.edges[k].to);
    EXPECT_LT((made.edges[k].motion - file.edges[k].motion).norm(), 1e-9);
    EXPECT_LT((made.edges[k].information - file.edges[k].information).norm(), 1e-6);
  }
}

// Certified optima of two classic maps; chi2 from the file's poses and from odometry alone.
class ClassicMap : public testing::TestWithParam<const char*> {};

TEST_P(ClassicMap, ReachesTheCertifiedOptimum) {
  const std::filesystem::path folder = homeFolder() / "../shared/data/g2o";
  const std::string name = GetParam();
  if (!std::filesystem::exists(folder / (name + ".g2o")))
    GTEST_SKIP() << "needs the pose graph " << name << ".g2o";
  std::ifstream stream(folder / "optima.json");
  const nlohmann::json optima = nlohmann::json::parse(stream)["datasets"][name];
  const auto graph = std::get<PlanarPoseGraph>(readG2o(folder / (name + ".g2o")).graph);
  ASSERT_EQ(graph.poses.cols(), optima["n"].get<int>());
  ASSERT_EQ(graph.edges.size(), optima["m"].get<std::size_t>());
  PlanarPoseGraph odometry = graph;
  setOdometryPoses(odometry);
  if (optima.contains("chi2_g2o_at_file_initial")) {
    EXPECT_NEAR(poseGraphCost(graph), optima["chi2_g2o_at_file_initial"].get<double>(), 1e-6);
  }
  for (const bool chordal : {true, false}) {
    for (PlanarPoseGraph start : {graph, odometry}) {
      const PoseGraphResult chi2 = optimize(start, {.chordalStart = chordal});
      EXPECT_EQ(chi2.status, PoseGraphStatus::kConverged) << chi2.message;
      EXPECT_NEAR(chi2.cost / optima["chi2_g2o"].get<double>(), 1, 1e-9);
      const PoseGraphResult sesync =
          optimize(start, {.objective = PoseGraphObjective::kSESync, .chordalStart = chordal});
      EXPECT_EQ(sesync.status, PoseGraphStatus::kConverged) << sesync.message;
      EXPECT_NEAR(sesync.cost / optima["sesync"].get<double>(), 1, 1e-9);
      EXPECT_LT(certifiedGap(start), 1e-5 * sesync.cost);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(G2o, ClassicMap, testing::Values("intel", "CSAIL"));

// A building whose chi2 takes long from all starts, and the certified optimum of its other objective.
TEST(PoseGraph, ConvergesInTheParkingGarage) {
  const std::filesystem::path file = homeFolder() / "../shared/data/g2o/parking-garage.g2o";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "needs the pose graph parking-garage.g2o";
  const auto graph = std::get<SpatialPoseGraph>(readG2o(file).graph);
  SpatialPoseGraph odometry = graph;
  setOdometryPoses(odometry);
  std::vector<double> costs;
  for (const bool chordal : {true, false}) {
    for (SpatialPoseGraph start : {graph, odometry}) {
      const PoseGraphResult result = optimize(start, {.chordalStart = chordal});
      EXPECT_EQ(result.status, PoseGraphStatus::kConverged) << result.message;
      costs.push_back(result.cost);
    }
  }
  for (const double cost : costs) EXPECT_NEAR(cost / costs[0], 1, 1e-6);
  SpatialPoseGraph start = graph;
  const PoseGraphResult sesync = optimize(start, {.objective = PoseGraphObjective::kSESync});
  EXPECT_NEAR(sesync.cost, 1.2625, 5e-5) << sesync.message;
}

TEST(PoseGraph, SaysWhatIsWrong) {
  Rng rng(58);
  const PlanarPoseGraph good = streets(6, .1, rng);
  PlanarPoseGraph bad = good;
  bad.edges[2].to = 9;
  EXPECT_REX_ERROR(optimize(bad), "edge 2 from pose 2 to pose 9: found pose 9, wanted 0 to 5");
  bad = good;
  bad.edges[2].to = 2;
  EXPECT_REX_ERROR(poseGraphCost(bad),
                   "edge 2 from pose 2 to pose 2: found one pose, wanted two different ones");
  bad = good;
  bad.edges[1].information(0, 0) = -1;
  EXPECT_REX_ERROR(optimize(bad), "edge 1 from pose 1 to pose 2: information: found the eigenvalue -1");
  bad = good;
  bad.edges[1].motion[2] = std::nan("");
  EXPECT_REX_ERROR(optimize(bad), "edge 1 from pose 1 to pose 2: motion: found numbers that are not a pose");
  bad = good;
  bad.edges.erase(bad.edges.begin() + 2);
  EXPECT_REX_ERROR(optimize(bad), "pose graph: pose 3: found no edges that join it to pose 0");
  EXPECT_REX_ERROR(setOdometryPoses(bad), "pose graph: pose 3: found no edges that join it to pose 0");
  bad = good;
  bad.poses(0, 4) = INFINITY;
  EXPECT_REX_ERROR(optimize(bad), "pose 4: found numbers that are not finite");
  SpatialPoseGraph space = ball(30, .1, rng);
  space.poses[3].R *= 2;
  EXPECT_REX_ERROR(optimize(space), "pose 3: found numbers that are not a pose");
  bad = good;
  EXPECT_REX_ERROR(optimize(bad, {.kernelSize = 0}),
                   "size of the robust kernel: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(optimize(bad, {.maxIterations = -1}), "iterations: found -1, wanted 0 or more");
  EXPECT_REX_ERROR(optimize(bad, {.tolerance = -1}),
                   "tolerance: found -1, wanted a finite number, 0 or more");
  EXPECT_REX_ERROR(optimize(bad, {.kernelSize = INFINITY}), "size of the robust kernel: found inf");
  EXPECT_REX_ERROR(optimize(bad, {.tolerance = INFINITY}), "tolerance: found inf");
  EXPECT_REX_ERROR(poseGraphCost(bad, {.kernelSize = -1}), "size of the robust kernel: found -1");
  EXPECT_REX_ERROR(poseGraphCost(SpatialPoseGraph{}, {.kernelSize = 0}),
                   "size of the robust kernel: found 0");
  bad.edges[1].information(0, 1) = 1;
  EXPECT_REX_ERROR(optimize(bad), "edge 1 from pose 1 to pose 2: information: found 1 at (0, 1) and 0");
  bad = good;
  const PoseGraphResult spent = optimize(bad, {.maxIterations = 0});
  EXPECT_EQ(spent.status, PoseGraphStatus::kBudgetSpent);
  EXPECT_THAT(optimize(bad, {.maxIterations = 1}).message,
              testing::HasSubstr("converged after 1 iteration: cost"));
  EXPECT_THAT(spent.message,
              testing::HasSubstr("stopped after 0 iterations, the limit, before it converged"));
}

}  // namespace rex::pose_graph_test
