#include <cstring>

#include <gtest/gtest.h>

#include "base/cpu_lanes.h"
#include "dynamics/dynamics_batch_internal.h"
#include "dynamics/forward_dynamics.h"
#include "support/allocations.h"
#include "support/expect_error.h"
#include "support/random_motion.h"

namespace rex::dynamics_batch_test {

// States in columns, with something given for each; some angles are too large for the polynomials of kernels.
struct Columns {
  Columns(Rng& rng, const Model& model, int count)
      : Q(model.nq(), count), V(model.nv(), count), given(model.nv(), count), result(model.nv(), count) {
    for (int k = 0; k < count; ++k) {
      Q.col(k) = randomPositions(rng, model.nq());
      V.col(k) = rng.normalVector(model.nv());
      given.col(k) = rng.normalVector(model.nv());
    }
    for (int i = 0; i < count; ++i) Q(rng.index(model.nq()), rng.index(count)) *= 1e6;
  }
  Eigen::MatrixXd Q, V, given, result;
};

bool haveSameBits(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)) == 0;
}

// Batched by so many lanes, against one state after the other.
class BatchOfLanes : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    if (GetParam() > cpuLanes()) GTEST_SKIP() << "this CPU has no AVX2";
  }
  const Eigen::Vector3d gravity_W{1, 2, -9};
  DynamicsWorkspace workspace;
};

TEST_P(BatchOfLanes, ForcesHaveTheBitsOfOne) {
  Rng rng(41);
  const auto kernel = kernelFor<internal::InverseDynamicsKernel>(GetParam());
  for (const int count : {1, 7, 8, 9, 21, 3}) {
    const Model model = randomModel(rng, 30 + count % 5, Followers::kSome);
    Columns all(rng, model, count);
    internal::inverseDynamicsBatch(kernel, model, all.Q, all.V, all.given, gravity_W, workspace, all.result);
    for (int k = 0; k < count; ++k) {
      ASSERT_TRUE(haveSameBits(
          all.result.col(k), inverseDynamics(model, all.Q.col(k), all.V.col(k), all.given.col(k), gravity_W)))
          << "column " << k << " of " << count;
    }
  }
}

TEST_P(BatchOfLanes, AccelerationsHaveTheBitsOfOne) {
  Rng rng(42);
  const auto kernel = kernelFor<internal::ForwardDynamicsKernel>(GetParam());
  for (const int count : {1, 7, 8, 9, 21, 3}) {
    const Model model = randomModel(rng, 30 + count % 5, count == 9 ? Followers::kSome : Followers::kNone);
    Columns all(rng, model, count);
    internal::forwardDynamicsBatch(kernel, model, all.Q, all.V, all.given, gravity_W, workspace, all.result);
    for (int k = 0; k < count; ++k) {
      ASSERT_TRUE(haveSameBits(
          all.result.col(k), forwardDynamics(model, all.Q.col(k), all.V.col(k), all.given.col(k), gravity_W)))
          << "column " << k << " of " << count;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OneTwoAndFour, BatchOfLanes, testing::Values(1, 2, 4));

TEST(DynamicsBatch, TakesNoStates) {
  Rng rng(43);
  const Model model = randomModel(rng, 10, Followers::kNone);
  Columns none(rng, model, 0);
  DynamicsWorkspace workspace;
  inverseDynamicsBatch(model, none.Q, none.V, none.given, earthGravity(), workspace, none.result);
  forwardDynamicsBatch(model, none.Q, none.V, none.given, earthGravity(), workspace, none.result);
  EXPECT_EQ(none.result.cols(), 0);
}

TEST(DynamicsBatch, NamesWrongSizesAndZeroQuaternions) {
  Rng rng(44);
  const Model model = compile(randomScene(rng, 12));
  const int nq = model.nq(), nv = model.nv();
  const Eigen::Vector3d g = earthGravity();
  Columns all(rng, model, 3);
  const Eigen::MatrixXd low = Eigen::MatrixXd::Zero(5, 3), narrow = Eigen::MatrixXd::Zero(nv, 2);
  Eigen::MatrixXd& out = all.result;
  Eigen::MatrixXd lowOut = low, narrowOut = narrow;
  DynamicsWorkspace w;
  for (const auto solve : {&inverseDynamicsBatch, &forwardDynamicsBatch}) {
    EXPECT_REX_ERROR((solve(model, low, all.V, all.given, g, w, out), 0),
                     "joint positions Q, a column: found a vector of size 5, wanted size 29");
    EXPECT_REX_ERROR((solve(model, all.Q, low, all.given, g, w, out), 0),
                     "joint velocities V, a column: found a vector of size 5, wanted size 27");
    EXPECT_REX_ERROR((solve(model, all.Q, narrow, all.given, g, w, out), 0),
                     "joint velocities V, columns: found a vector of size 2, wanted size 3");
    EXPECT_REX_ERROR((solve(model, Eigen::MatrixXd::Zero(nq, 3), all.V, all.given, g, w, out), 0),
                     "quaternion: found (0, 0, 0, 0), wanted finite numbers, not all zero");
  }
  EXPECT_REX_ERROR((inverseDynamicsBatch(model, all.Q, all.V, low, g, w, out), 0),
                   "joint accelerations A, a column: found a vector of size 5, wanted size 27");
  EXPECT_REX_ERROR((inverseDynamicsBatch(model, all.Q, all.V, all.given, g, w, narrowOut), 0),
                   "joint forces U, columns: found a vector of size 2, wanted size 3");
  EXPECT_REX_ERROR((forwardDynamicsBatch(model, all.Q, all.V, narrow, g, w, out), 0),
                   "joint forces U, columns: found a vector of size 2, wanted size 3");
  EXPECT_REX_ERROR((forwardDynamicsBatch(model, all.Q, all.V, all.given, g, w, lowOut), 0),
                   "joint accelerations A, a column: found a vector of size 5, wanted size 27");
}

// A body that has lost its mass, in each kind of model.
TEST(DynamicsBatch, NamesTheBodyThatNeedsMass) {
  Rng rng(45);
  SceneSpec spec = randomScene(rng, 2);
  spec.bodies[1].mass = 0;
  spec.bodies[1].inertia.reset();
  const Model model = compile(spec);
  Columns all(rng, model, 20);
  DynamicsWorkspace w;
  EXPECT_REX_ERROR((forwardDynamicsBatch(model, all.Q, all.V, all.given, earthGravity(), w, all.result), 0),
                   "joint 'j1' moves no mass: wanted some: give body 'b1' a mass");
}

#ifndef __SANITIZE_ADDRESS__
TEST(DynamicsBatch, AllocatesOnlyAtFirst) {
  Rng rng(46);
  const Model model = randomModel(rng, 30, Followers::kNone);
  Columns all(rng, model, 20);
  DynamicsWorkspace workspace;
  const auto work = [&] {
    inverseDynamicsBatch(model, all.Q, all.V, all.given, earthGravity(), workspace, all.result);
    forwardDynamicsBatch(model, all.Q, all.V, all.given, earthGravity(), workspace, all.result);
  };
  const long before = allocations();
  work();
  const long first = allocations();
  work();
  EXPECT_GT(first, before);
  EXPECT_EQ(allocations(), first);
}
#endif

}  // namespace rex::dynamics_batch_test
