#include <cstring>

#include <gtest/gtest.h>

#include "base/cpu_lanes.h"
#include "kinematics/forward_kinematics_internal.h"
#include "kinematics/jacobians.h"
#include "kinematics/jacobians_internal.h"
#include "support/allocations.h"
#include "support/expect_error.h"
#include "support/random_scene.h"

namespace rex::batch_test {

// A tree with every joint type several times, some of them followers of others.
Model randomModel(Rng& rng, int bodies = 40) {
  SceneSpec spec = randomScene(rng, bodies);
  addDetails(rng, spec);
  for (BodySpec& body : spec.bodies) body.shapes.clear();
  spec.worldShapes.clear();
  return compile(spec);
}

// Some of the angles are too large for the polynomials of the kernel.
Eigen::MatrixXd randomColumns(Rng& rng, const Model& model, int count) {
  Eigen::MatrixXd Q(model.nq(), count);
  for (auto q : Q.colwise()) q = randomPositions(rng, model.nq());
  for (int i = 0; i < count; ++i) Q(rng.index(model.nq()), rng.index(count)) *= 1e6;
  return Q;
}

template <class Matrix>
bool haveSameBits(const Matrix& a, const Matrix& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)) == 0;
}

// Batched by so many lanes, against one configuration after the other.
class BatchOfLanes : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    if (GetParam() > cpuLanes()) GTEST_SKIP() << "this CPU has no AVX2";
  }
};

TEST_P(BatchOfLanes, PosesHaveTheBitsOfOne) {
  Rng rng(61);
  PoseBatch batch;
  for (const int count : {1, 7, 8, 9, 21, 20, 3}) {
    const Model model = randomModel(rng, 30 + count % 5);
    const Eigen::MatrixXd Q = randomColumns(rng, model, count);
    const auto kernel = kernelFor<internal::ForwardKinematicsKernel>(GetParam());
    internal::forwardKinematicsBatch(kernel, model, Q, batch);
    ASSERT_EQ(batch.count(), count);
    ASSERT_EQ(batch.bodies(), static_cast<int>(model.bodies().size()));
    for (int k = 0; k < count; ++k) {
      const BodyPoses poses = forwardKinematics(model, Q.col(k));
      for (int i = 0; i < batch.bodies(); ++i) {
        const Pose X_WB = batch.pose(BodyId{i}, k);
        ASSERT_TRUE(haveSameBits(X_WB.R, poses[BodyId{i}].R)) << "body " << i << " of configuration " << k;
        ASSERT_TRUE(haveSameBits(X_WB.p, poses[BodyId{i}].p)) << "body " << i << " of configuration " << k;
      }
    }
  }
}

TEST_P(BatchOfLanes, JacobiansHaveTheBitsOfOne) {
  Rng rng(62);
  PoseBatch batch;
  JacobianBatch linear, angular;
  for (const int count : {1, 8, 11}) {
    const Model model = randomModel(rng);
    const Eigen::MatrixXd Q = randomColumns(rng, model, count);
    forwardKinematicsBatch(model, Q, batch);
    const auto kernel = kernelFor<internal::JacobianKernel>(GetParam());
    const Eigen::Vector3d p_BQ = rng.normalVector(3);
    for (int i = 0; i < batch.bodies(); ++i) {
      const BodyId body{i};
      internal::positionJacobianBatch(kernel, model, batch, body, p_BQ, linear);
      internal::angularJacobianBatch(kernel, model, batch, body, angular);
      ASSERT_EQ(linear.count(), count);
      for (int k = 0; k < count; ++k) {
        const BodyPoses poses = forwardKinematics(model, Q.col(k));
        ASSERT_TRUE(haveSameBits(linear.jacobian(k), positionJacobian(model, poses, body, p_BQ))) << i;
        ASSERT_TRUE(haveSameBits(angular.jacobian(k), angularJacobian(model, poses, body))) << i;
        const Matrix6Xd both = poseJacobian(model, poses, body, p_BQ);
        Eigen::MatrixXd larger = Eigen::MatrixXd::Ones(8, model.nv());
        poseJacobian(model, poses, body, p_BQ, larger.middleRows<6>(1));
        ASSERT_EQ(larger.middleRows<6>(1), both) << i;
        ASSERT_TRUE(larger.row(0).isOnes(0) && larger.row(7).isOnes(0)) << i;
        ASSERT_TRUE(haveSameBits(linear.jacobian(k), Eigen::Matrix3Xd(both.topRows<3>()))) << i;
        ASSERT_TRUE(haveSameBits(angular.jacobian(k), Eigen::Matrix3Xd(both.bottomRows<3>()))) << i;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OneTwoAndFour, BatchOfLanes, testing::Values(1, 2, 4));

// The kernels know no joint types, jointMotion() does.
TEST(ForwardKinematicsBatch, FollowsTheMotionOfEachJointType) {
  Rng rng(63);
  for (int i = 0; i < 10; ++i) {
    const Model model = randomModel(rng);
    const Eigen::VectorXd q = randomPositions(rng, model.nq());
    const BodyPoses poses = forwardKinematics(model, q);
    EXPECT_TRUE(isApprox(poses[kWorld], Pose{}, 0));
    for (std::size_t b = 1; b < model.bodies().size(); ++b) {
      const Body& body = model.bodies()[b];
      if (body.joint == kNoJoint) {
        EXPECT_TRUE(isApprox(poses.X_WB[b], body.X_PB, 0));
        continue;
      }
      const Joint& joint = model[body.joint];
      Eigen::VectorXd own = q.segment(joint.qIndex, joint.nq);
      if (joint.nq == 1) own[0] = joint.ratio * own[0] + joint.offset;
      const Pose X_FM = jointMotion(joint.type, joint.axis, joint.pitch, own.data());
      const Pose X_WB = poses[joint.parent] * joint.X_PF * X_FM * joint.X_MC;
      EXPECT_TRUE(isApprox(poses.X_WB[b], X_WB, 1e-12)) << joint.name;
    }
  }
}

TEST(PoseBatch, PadsItsLastBlockWithTheLastConfiguration) {
  Rng rng(64);
  const Model model = randomModel(rng);
  PoseBatch batch;
  forwardKinematicsBatch(model, randomColumns(rng, model, 11), batch);
  ASSERT_EQ(batch.blocks(), 2);
  const BodyId last{batch.bodies() - 1};
  const auto numbers = batch.block(1, last);
  const Pose X_WB = batch.pose(last, 10);
  for (int i = 0; i < 12; ++i) {
    for (int lane = 2; lane < PoseBatch::kLanes; ++lane) {
      EXPECT_EQ(numbers[static_cast<std::size_t>(PoseBatch::kLanes * i + lane)],
                i < 9 ? X_WB.R.data()[i] : X_WB.p[i - 9]);
    }
  }
}

TEST(PoseBatch, HoldsNoConfigurationWhereThereIsNone) {
  Rng rng(65);
  const Model model = randomModel(rng);
  PoseBatch batch;
  JacobianBatch jacobians;
  forwardKinematicsBatch(model, Eigen::MatrixXd(model.nq(), 0), batch);
  positionJacobianBatch(model, batch, kWorld, Eigen::Vector3d::Zero(), jacobians);
  EXPECT_EQ(batch.count() + batch.blocks() + jacobians.count() + jacobians.blocks(), 0);
  EXPECT_EQ(batch.bodies(), static_cast<int>(model.bodies().size()));
  EXPECT_EQ(jacobians.columns(), model.nv());
}

TEST(PoseBatch, TakesNoBodies) {
  PoseBatch poses;
  poses.resize(0, 20);
  EXPECT_EQ(poses.bodies(), 0);
  EXPECT_EQ(poses.count(), 20);
  poses.resize(1, 20);
  for (int k = 0; k < 20; ++k) EXPECT_EQ(poses.pose(kWorld, k).R, Eigen::Matrix3d::Identity());
}

TEST(PoseBatch, NamesWrongSizesAndZeroQuaternions) {
  Rng rng(66);
  const Model model = compile(randomScene(rng, 12));
  PoseBatch batch;
  EXPECT_REX_ERROR(forwardKinematicsBatch(model, Eigen::MatrixXd::Zero(5, 3), batch),
                   "joint positions, a column of Q: found a vector of size 5, wanted size 29");
  EXPECT_REX_ERROR(forwardKinematicsBatch(model, Eigen::MatrixXd::Zero(model.nq(), 3), batch),
                   "quaternion: found (0, 0, 0, 0), wanted finite numbers, not all zero");
  EXPECT_REX_ERROR(forwardKinematics(model, Eigen::VectorXd::Zero(model.nq())),
                   "quaternion: found (0, 0, 0, 0), wanted finite numbers, not all zero");
}

#ifndef __SANITIZE_ADDRESS__
TEST(PoseBatch, AllocatesOnlyAtFirst) {
  Rng rng(67);
  const Model model = randomModel(rng);
  const Eigen::MatrixXd Q = randomColumns(rng, model, 20);
  const BodyId tip{static_cast<int>(model.bodies().size()) - 1};
  PoseBatch batch;
  BodyPoses poses;
  JacobianBatch jacobians;
  Eigen::Matrix3Xd J(3, model.nv());
  const auto work = [&] {
    forwardKinematicsBatch(model, Q, batch);
    positionJacobianBatch(model, batch, tip, Eigen::Vector3d::Ones(), jacobians);
    angularJacobianBatch(model, batch, tip, jacobians);
    forwardKinematics(model, Q.col(0), poses);
    positionJacobian(model, poses, tip, Eigen::Vector3d::Ones(), J);
    angularJacobian(model, poses, tip, J);
  };
  const long before = allocations();
  work();
  const long first = allocations();
  work();
  EXPECT_GT(first, before);
  EXPECT_EQ(allocations(), first);
}
#endif

}  // namespace rex::batch_test
