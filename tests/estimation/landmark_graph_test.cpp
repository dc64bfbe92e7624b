// Pose graphs with landmarks.
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "base/rng.h"
#include "estimation/gaussian.h"
#include "estimation/pose_edge_internal.h"
#include "estimation/pose_graph.h"
#include "random_gaussian.h"
#include "street_graph.h"
#include "support/expect_error.h"

namespace rex::landmark_graph_test {

using internal::PlanarGraphTraits;

constexpr PoseGraphObjective kObjectives[] = {PoseGraphObjective::kChi2, PoseGraphObjective::kSESync};

// Streets with lamps, each seen from all poses within 3 m.
PlanarPoseGraph lamps(int poses, int landmarks, double noise, Rng& rng) {
  Eigen::Matrix3Xd X;
  PlanarPoseGraph graph = test::streets(poses, noise, rng, &X);
  graph.landmarks.setZero(2, landmarks);
  for (int l = 0; l < landmarks; ++l) {
    const int beside = l * (poses - 1) / std::max(1, landmarks - 1);
    const Eigen::Vector2d lamp = X.col(beside).head<2>() + rng.normalVector(2);
    for (int i = 0; i < poses; ++i) {
      const Eigen::Vector2d seen = Eigen::Rotation2Dd(-X(2, i)) * (lamp - X.col(i).head<2>());
      if (i != beside && seen.norm() > 3) continue;
      const Eigen::MatrixXd covariance = noise * noise * test::randomCovariance(2, rng);
      graph.sightings.push_back(
          {i, l, seen + covariance.llt().matrixL() * rng.normalVector(2), symmetrized(covariance.inverse())});
    }
  }
  setOdometryPoses(graph);
  return graph;
}

TEST(LandmarkGraph, JacobiansAreDerivatives) {
  Rng rng(71);
  for (const PoseGraphObjective objective : kObjectives) {
    PlanarPoseGraph graph{Eigen::Matrix3Xd(3, 2), {}, Eigen::Matrix2Xd(2, 1), {}};
    graph.poses.col(0).setZero();
    graph.poses.col(1) = rng.normalVector(3);
    graph.landmarks.col(0) = rng.normalVector(2);
    graph.sightings.push_back({1, 0, rng.normalVector(2), test::randomCovariance(2, rng)});
    const auto term = PlanarGraphTraits::termAt(graph, 0, objective);
    EXPECT_EQ(PlanarGraphTraits::ends(graph, 0), std::pair(1, 2));
    Eigen::MatrixXd J(2, 6);
    J << term.Ji.topRows<2>(), term.Jj.topRows<2>();
    const auto error = [&](const Eigen::VectorXd& delta) -> Eigen::VectorXd {
      PlanarPoseGraph moved = graph;
      PlanarGraphTraits::step(moved, delta);
      return PlanarGraphTraits::termAt(moved, 0, objective).e.head<2>();
    };
    const JacobianCheck check = checkJacobian(error, J, Eigen::VectorXd::Zero(6), 1e-7);
    EXPECT_TRUE(check.ok) << check.message;
    EXPECT_EQ(term.e[2], 0);
  }
}

// All errors one after the other, each times the root of its information, as the formulas say.
Eigen::VectorXd residuals(const PlanarPoseGraph& graph) {
  std::vector<double> all;
  const auto append = [&](const Eigen::VectorXd& e, const Eigen::MatrixXd& information) {
    const Eigen::VectorXd weighed = information.llt().matrixU() * e;
    all.insert(all.end(), weighed.begin(), weighed.end());
  };
  for (const PlanarEdge& edge : graph.edges)
    append(test::planarMotion(edge.motion,
                              test::planarMotion(graph.poses.col(edge.from), graph.poses.col(edge.to))),
           edge.information);
  for (const LandmarkEdge& edge : graph.sightings) {
    const Eigen::Vector3d x = graph.poses.col(edge.pose);
    append(Eigen::Rotation2Dd(-x[2]) * (graph.landmarks.col(edge.landmark) - x.head<2>()) - edge.position,
           edge.information);
  }
  return Eigen::Map<Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

PlanarPoseGraph moved(const PlanarPoseGraph& graph, const Eigen::VectorXd& x) {
  PlanarPoseGraph result = graph;
  const Eigen::Index n = 3 * (graph.poses.cols() - 1);
  result.poses.rightCols(graph.poses.cols() - 1) += x.head(n).reshaped(3, graph.poses.cols() - 1);
  result.landmarks += x.tail(x.size() - n).reshaped(2, graph.landmarks.cols());
  return result;
}

// Gauss and Newton's steps on dense equations, with differences for derivatives.
TEST(LandmarkGraph, FindsWhatDenseStepsFind) {
  Rng rng(72);
  PlanarPoseGraph graph = lamps(30, 8, .05, rng), dense = graph;
  const PoseGraphResult result = optimize(graph);
  ASSERT_EQ(result.status, PoseGraphStatus::kConverged) << result.message;
  EXPECT_NEAR(poseGraphCost(dense), residuals(dense).squaredNorm(), 1e-9 * result.initialCost);
  const Eigen::Index size = 3 * 29 + 2 * 8;
  for (int step = 0; step < 12; ++step) {
    const Eigen::VectorXd r = residuals(dense);
    Eigen::MatrixXd J(r.size(), size);
    constexpr double h = 1e-6;
    for (Eigen::Index i = 0; i < size; ++i)
      J.col(i) = (residuals(moved(dense, h * Eigen::VectorXd::Unit(size, i))) -
                  residuals(moved(dense, -h * Eigen::VectorXd::Unit(size, i)))) /
                 (2 * h);
    dense = moved(dense, -(J.transpose() * J).ldlt().solve(J.transpose() * r));
  }
  EXPECT_NEAR(result.cost, residuals(dense).squaredNorm(), 1e-8 * result.cost);
  EXPECT_LT((graph.landmarks - dense.landmarks).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((graph.poses - dense.poses).topRows<2>().cwiseAbs().maxCoeff(), 1e-6);
}

TEST(LandmarkGraph, FindsTheMinimumFromAnywhere) {
  Rng rng(73);
  for (const PoseGraphObjective objective : kObjectives) {
    PlanarPoseGraph graph = lamps(200, 40, .05, rng), lost = graph, odometry = graph;
    for (auto pose : lost.poses.rightCols(199).colwise()) pose = 20 * rng.normalVector(3);
    lost.landmarks.setRandom();
    const PoseGraphResult result = optimize(graph, {.objective = objective});
    ASSERT_EQ(result.status, PoseGraphStatus::kConverged) << result.message;
    EXPECT_LT(result.cost, .5 * result.initialCost);
    EXPECT_NEAR(optimize(lost, {.objective = objective}).cost, result.cost, 1e-9 * result.cost);
    EXPECT_NEAR(optimize(odometry, {.objective = objective, .chordalStart = false}).cost, result.cost,
                1e-9 * result.cost);
    for (int i = 0; i < 50; ++i) {
      PlanarPoseGraph other = graph;
      PlanarGraphTraits::step(other, 1e-4 * rng.normalVector(3 * 239));
      EXPECT_GT(poseGraphCost(other, {.objective = objective}), result.cost);
    }
  }
}

// Landmarks count in the proof: moved ones cost, and the bound covers what they cost.
TEST(LandmarkGraph, ProvesThatItIsTheBest) {
  Rng rng(74);
  const PoseGraphOptions sesync{.objective = PoseGraphObjective::kSESync};
  PlanarPoseGraph graph = lamps(100, 20, .05, rng);
  const double best = optimize(graph, sesync).cost;
  EXPECT_LT(certifiedGap(graph), 1e-6 * best);
  for (int i = 0; i < 20; ++i) {
    PlanarPoseGraph other = graph;
    other.landmarks.col(i) += std::pow(10., -i / 4) * rng.normalVector(2);
    EXPECT_GE(certifiedGap(other), poseGraphCost(other, sesync) - best);
  }
}

TEST(LandmarkGraph, TakesNearestInformation) {
  Rng rng(75);
  for (int i = 0; i < 200; ++i) {
    const Eigen::VectorXd scale = (2 * rng.normalVector(3)).array().exp();
    const Eigen::MatrixXd A =
        scale.asDiagonal() * symmetrized(test::randomMatrix(3, 3, rng)) * scale.asDiagonal();
    const Eigen::MatrixXd nearest = nearestSemidefinite(A);
    EXPECT_NO_THROW(requireCovariance("nearest", nearest, 3));
    // The rest is negative and orthogonal to it: the conditions of a projection onto a cone (Moreau).
    const Eigen::MatrixXd rest = nearest - A;
    EXPECT_NO_THROW(requireCovariance("rest", nearestSemidefinite(rest), 3));
    EXPECT_LT((rest - nearestSemidefinite(rest)).norm(), 1e-9 * A.norm());
    EXPECT_LT(std::abs((nearest * rest).trace()), 1e-9 * A.squaredNorm());
  }
}

TEST(LandmarkGraph, SaysWhatIsWrong) {
  Rng rng(76);
  const PlanarPoseGraph good = lamps(6, 2, .1, rng);
  PlanarPoseGraph bad = good;
  bad.sightings[0].landmark = 5;
  EXPECT_REX_ERROR(optimize(bad), "sighting 0 of landmark 5 from pose 0: found landmark 5, wanted 0 to 1");
  bad = good;
  bad.sightings[0].pose = 9;
  EXPECT_REX_ERROR(poseGraphCost(bad), "from pose 9: found pose 9, wanted 0 to 5");
  bad = good;
  bad.sightings[0].position[0] = NAN;
  EXPECT_REX_ERROR(optimize(bad), ": position: found numbers that are not finite");
  bad = good;
  bad.sightings[0].information(0, 0) = -1;
  EXPECT_REX_ERROR(optimize(bad), ": information: found the eigenvalue");
  bad = good;
  bad.landmarks(0, 1) = INFINITY;
  EXPECT_REX_ERROR(optimize(bad), "landmark 1: found numbers that are not finite");
  bad = good;
  bad.landmarks.conservativeResize(2, 3);
  bad.landmarks.col(2).setZero();
  EXPECT_REX_ERROR(optimize(bad), "pose graph: landmark 2: found no pose that sees it, wanted one or more");
  bad = good;
  bad.landmarks.resize(2, 0);
  EXPECT_REX_ERROR(optimize(bad), "found landmark 0, wanted none: the graph has none");
}

}  // namespace rex::landmark_graph_test
