#include "estimation/ekf_slam.h"

#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "base/cpu_lanes.h"
#include "base/derivative_check.h"
#include "base/rng.h"
#include "estimation/consistency.h"
#include "estimation/kalman_filter.h"
#include "estimation/rank_two_kernel_internal.h"
#include "random_gaussian.h"
#include "slam_world.h"
#include "support/expect_error.h"

namespace rex::ekf_slam_test {

using Kind = LandmarkSensor::Kind;
constexpr Kind kKinds[] = {Kind::kCartesian, Kind::kRangeBearing};
const Gaussian kStart{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};

TEST(LandmarkSensor, JacobiansAreDerivatives) {
  Rng rng(61);
  for (const Kind kind : kKinds) {
    const LandmarkSensor sensor{.kind = kind};
    for (const double size : {0., 1e-8, 2.}) {
      Eigen::VectorXd z(5);
      z << size * rng.normalVector(3), Eigen::Vector2d(3, -1) + size * rng.normalVector(2);
      const LandmarkView view = landmarkView(sensor, z.head<3>(), z.tail<2>());
      Eigen::MatrixXd J(2, 5);
      J << view.Jx, view.Jl;
      const auto look = [&](const Eigen::VectorXd& at) -> Eigen::VectorXd {
        return innovation(sensor, landmarkView(sensor, at.head<3>(), at.tail<2>()).y, view.y);
      };
      const JacobianCheck seen = checkJacobian(look, J, z, 1e-7);
      EXPECT_TRUE(seen.ok) << seen.message;
      const LandmarkPlace place = landmarkPosition(sensor, z.head<3>(), view.y);
      EXPECT_LT((place.landmark - z.tail<2>()).norm(), 1e-12)
          << "landmarkPosition is the inverse of landmarkView";
      J << place.Jx, place.Jy;
      z.tail<2>() = view.y;
      const auto put = [&](const Eigen::VectorXd& at) -> Eigen::VectorXd {
        return landmarkPosition(sensor, at.head<3>(), at.tail<2>()).landmark;
      };
      const JacobianCheck placed = checkJacobian(put, J, z, 1e-7);
      EXPECT_TRUE(placed.ok) << placed.message;
    }
  }
  EXPECT_REX_ERROR(landmarkView({.kind = Kind::kRangeBearing}, {1, 2, 0}, {1, 2}),
                   "landmark seen by range and bearing: found a distance of 0 m");
}

// The same steps by the plain filter on the whole vector, with dense Jacobians.
TEST(EkfSlam, IsTheExtendedFilterOfThePoseAndAllLandmarks) {
  for (const Kind kind : kKinds) {
    Rng rng(62);
    test::SlamWorld world(kind, 40, rng);  // more than there is room for at first
    EkfSlam slam(kStart, world.sensor);
    Gaussian dense = kStart;
    for (int t = 0; t < 12; ++t) {
      world.drive(rng);
      const PoseTransition move = world.transition();
      slam.predict(move);
      const Eigen::Index n = dense.mean.size();
      Eigen::MatrixXd A = Eigen::MatrixXd::Identity(n, n), Q = Eigen::MatrixXd::Zero(n, n);
      A.topLeftCorner<3, 3>() = move.jacobian(dense.mean.head<3>());
      Q.topLeftCorner<3, 3>() = move.noise;
      dense.mean.head<3>() = move.mean(dense.mean.head<3>());
      dense.covariance = A * dense.covariance * A.transpose() + Q;
      for (int i = 0; i < std::min(40, 10 * (t + 1)); ++i) {
        const Eigen::Vector2d y = world.look(static_cast<std::size_t>(i), rng);
        const bool isNew = i == slam.landmarks();
        EXPECT_EQ(slam.observe(i, y).isNew, isNew);
        const Eigen::Index size = dense.mean.size();
        if (isNew) {
          const LandmarkPlace place = landmarkPosition(world.sensor, dense.mean.head<3>(), y);
          Eigen::MatrixXd F = Eigen::MatrixXd::Zero(size + 2, size);
          F.topRows(size).setIdentity();
          F.bottomLeftCorner<2, 3>() = place.Jx;
          Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(size + 2, size + 2);
          noise.bottomRightCorner<2, 2>() = place.Jy * world.sensor.W * place.Jy.transpose();
          Eigen::VectorXd mean(size + 2);
          mean << dense.mean, place.landmark;
          dense = {mean, F * dense.covariance * F.transpose() + noise};
        } else {
          const NonlinearModel see{
              .g = [&](const Eigen::VectorXd& z) -> Eigen::VectorXd {
                return landmarkView(world.sensor, z.head<3>(), z.segment<2>(3 + 2 * i)).y;
              },
              .jacobian =
                  [&](const Eigen::VectorXd& z) {
                    const LandmarkView view =
                        landmarkView(world.sensor, z.head<3>(), z.segment<2>(3 + 2 * i));
                    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(2, z.size());
                    H.leftCols<3>() = view.Jx;
                    H.middleCols<2>(3 + 2 * i) = view.Jl;
                    return H;
                  },
              .W = world.sensor.W,
              .difference = [&](const Eigen::VectorXd& a, const Eigen::VectorXd& b) -> Eigen::VectorXd {
                return innovation(world.sensor, a, b);
              }};
          dense = extendedUpdate(dense, see, y).belief;
        }
      }
      const Gaussian joint = slam.joint();
      ASSERT_EQ(joint.mean.size(), dense.mean.size());
      EXPECT_LT((joint.mean - dense.mean).cwiseAbs().maxCoeff(), 1e-9);
      EXPECT_LT((joint.covariance - dense.covariance).cwiseAbs().maxCoeff(), 1e-9);
    }
    EXPECT_LT((slam.landmark(3).mean - slam.joint().mean.segment<2>(9)).norm(), 1e-15);
    EXPECT_LT((slam.pose().covariance - slam.joint().covariance.topLeftCorner<3, 3>()).norm(), 1e-15);
  }
}

// NEES of the pose over 50 runs, averaged at each time, lies in its band nearly always.
TEST(EkfSlam, IsConsistent) {
  for (const Kind kind : kKinds) {
    Rng rng(63);
    const int runs = 50, steps = 30;
    Eigen::VectorXd nees = Eigen::VectorXd::Zero(steps);
    double mapError = 0;
    for (int run = 0; run < runs; ++run) {
      test::SlamWorld world(kind, 6, rng);
      EkfSlam slam(kStart, world.sensor);
      for (int t = 0; t < steps; ++t) {
        world.drive(rng);
        slam.predict(world.transition());
        for (std::size_t i = 0; i < 6; ++i) slam.observe(static_cast<int>(i), world.look(i, rng));
        const int angles[] = {2};
        nees[t] += estimationErrorSquared(slam.pose(), world.x, angles) / runs;
      }
      for (int i = 0; i < 6; ++i)
        mapError += (slam.landmark(i).mean - world.landmarks[static_cast<std::size_t>(i)]).norm() / 6 / runs;
    }
    const ConsistencyBand band = consistencyBand(runs, 3);
    const auto inside = ((nees.array() > band.lower) && (nees.array() < band.upper)).count();
    EXPECT_GE(inside, static_cast<long>(.8 * steps)) << nees.transpose();
    EXPECT_LT(mapError, .6);
  }
}

TEST(EkfSlam, FindsOutWhichLandmarkItSees) {
  for (const Kind kind : kKinds) {
    Rng rng(64);
    test::SlamWorld world(kind, 0, rng);
    world.sensor.W *= .1;
    for (int i = 0; i < 12; ++i)
      world.landmarks.push_back(8 * Eigen::Vector2d(std::cos(i * .52), std::sin(i * .52)));
    EkfSlam slam(kStart, world.sensor);
    std::vector<int> nameOf(12, -1);
    for (int t = 0; t < 40; ++t) {
      world.drive(rng);
      slam.predict(world.transition());
      std::vector<Eigen::Vector2d> ys;
      for (std::size_t k = 0; k < 12; ++k)
        ys.push_back(world.look((k * 5 + static_cast<std::size_t>(t)) % 12, rng));
      const auto updates = slam.observe(ys);
      for (std::size_t k = 0; k < 12; ++k) {
        if (!updates[k]) continue;
        int& name = nameOf[(k * 5 + static_cast<std::size_t>(t)) % 12];
        if (name < 0) name = updates[k]->landmark;
        EXPECT_EQ(updates[k]->landmark, name);
      }
    }
    EXPECT_EQ(slam.landmarks(), 12);
  }
}

// An exact sensor after a wide prior leaves no digit of the variances: that is said, and changes nothing.
TEST(EkfSlam, RefusesCovariancesThatRoundingSpoils) {
  for (const Kind kind : kKinds) {
    EkfSlam slam({Eigen::Vector3d::Zero(), 1e4 * Eigen::Matrix3d::Identity()},
                 {.kind = kind, .W = 1e-10 * Eigen::Matrix2d::Identity()});
    int refused = 0;
    Rng rng(65);
    for (int i = 0; i < 3; ++i) slam.observe(i, {30 + 20 * i, .5 * i});
    for (int i = 0; i < 60; ++i) {
      const Gaussian before = slam.joint();
      try {
        slam.observe(i % 3, Eigen::Vector2d(30 + 20 * (i % 3), .5 * (i % 3)) + 1e-5 * rng.normalVector(2));
      } catch (const Error& error) {
        ++refused;
        EXPECT_THAT(error.what(), testing::HasSubstr("covariance "));
        EXPECT_EQ(slam.joint().mean, before.mean);
        EXPECT_EQ(slam.joint().covariance, before.covariance);
      }
      ASSERT_GT(slam.joint().covariance.diagonal().minCoeff(), 0) << i;
    }
    EXPECT_GT(refused, 0);
  }
}

TEST(EkfSlam, LeavesOutWhatAnotherObservationTook) {
  EkfSlam slam(kStart, {.W = .01 * Eigen::Matrix2d::Identity()});
  slam.observe(0, {5, 0});
  const std::vector<Eigen::Vector2d> ys{{5.05, 0}, {5, 0}};
  const auto updates = slam.observe(ys);
  EXPECT_FALSE(updates[0]);
  ASSERT_TRUE(updates[1]);
  EXPECT_EQ(updates[1]->landmark, 0);
  EXPECT_EQ(slam.landmarks(), 1);
}

TEST(EkfSlam, SaysWhatIsWrong) {
  EkfSlam slam(kStart, {});
  EXPECT_REX_ERROR(EkfSlam({Eigen::Vector2d(0, 0), Eigen::Matrix2d::Zero()}, {}),
                   "pose: found a vector of size 2, wanted size 3");
  EXPECT_REX_ERROR(EkfSlam(kStart, {.W = Eigen::Matrix2d::Zero()}),
                   "covariance of the sensor: found the eigenvalue 0");
  EXPECT_REX_ERROR(slam.observe(1, {0, 0}),
                   "observed landmark: found 1, wanted at least 0, at most 0, which is a new one");
  EXPECT_REX_ERROR(slam.observe(0, {0, std::nan("")}), "observation: number 1: found nan");
  EXPECT_REX_ERROR(slam.landmark(0), "landmark: found 0");
  const std::vector<Eigen::Vector2d> ys{{1, 1}};
  EXPECT_REX_ERROR(slam.observe(ys, {.same = 0}),
                   "association gates: found same 0, different 18.42, wanted 0 < same <= different");
  EXPECT_REX_ERROR(slam.observe(ys, {.same = 9, .different = 3}), "association gates: found same 9");
  EXPECT_REX_ERROR(slam.observe(ys, {.same = std::nan("")}), "association gates: found same nan");
  EXPECT_REX_ERROR(landmarkPosition({.kind = Kind::kRangeBearing}, {0, 0, 0}, {0, 1}),
                   "range of a new landmark: found 0 m, wanted a positive, finite number of metres");
  EXPECT_REX_ERROR(slam.predict({}), "transition: found no function for its mean");
  EXPECT_REX_ERROR(slam.predict({.mean = [](const Eigen::Vector3d& x) { return x; }}),
                   "transition: found no function for its derivative");
  PoseTransition move{
      .mean = [](const Eigen::Vector3d& x) -> Eigen::Vector3d { return x / 0; },
      .jacobian = [](const Eigen::Vector3d&) -> Eigen::Matrix3d { return Eigen::Matrix3d::Identity(); }};
  EXPECT_REX_ERROR(slam.predict(move), "next pose: number 0: found nan");
  move.mean = [](const Eigen::Vector3d& x) { return x; };
  move.jacobian = [](const Eigen::Vector3d&) -> Eigen::Matrix3d {
    return Eigen::Matrix3d::Constant(INFINITY);
  };
  EXPECT_REX_ERROR(slam.predict(move), "derivative of the transition: found entries that are not finite");
}

class RankTwoInLanes : public testing::TestWithParam<int> {};

// Against Eigen, to the bit, and above the diagonal nothing changes.
TEST_P(RankTwoInLanes, SubtractTwoSquaresFromTheLowerTriangle) {
  if (GetParam() > cpuLanes()) GTEST_SKIP() << "this CPU has no AVX2";
  Rng rng(5);
  for (const int n : {1, 2, 3, 8, 23}) {
    const Eigen::MatrixXd before = rng.normalVector(30 * n).reshaped(30, n);
    const Eigen::VectorXd u = rng.normalVector(n), v = rng.normalVector(n);
    Eigen::MatrixXd after = before;
    kernelFor<internal::RankTwoKernel>(GetParam()).subtract(u.data(), v.data(), n, after.data(), 30);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < 30; ++i) {
        const bool isChanged = i >= j && i < n;
        EXPECT_EQ(after(i, j), isChanged ? before(i, j) - (u[j] * u[i] + v[j] * v[i]) : before(i, j));
      }
  }
}

INSTANTIATE_TEST_SUITE_P(OneTwoAndFour, RankTwoInLanes, testing::Values(1, 2, 4));

}  // namespace rex::ekf_slam_test
