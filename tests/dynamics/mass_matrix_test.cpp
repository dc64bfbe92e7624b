#include <gtest/gtest.h>

#include "base/cpu_lanes.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/kernel_room_internal.h"
#include "dynamics/kernels_internal.h"
#include "formats/ors_reader.h"
#include "support/allocations.h"
#include "support/expect_error.h"
#include "support/mass_matrix_by_jacobians.h"
#include "support/paths.h"
#include "support/random_motion.h"

namespace rex::mass_matrix_test {

TEST(MassMatrix, IsTheSumOverJacobians) {
  Rng rng(351);
  for (int i = 0; i < 50; ++i) {
    const Model model = randomModel(rng, 2 + i, Followers::kSome);
    const Eigen::VectorXd q = randomPositions(rng, model.nq());
    const Eigen::MatrixXd M = massMatrix(model, q), wanted = massMatrixByJacobians(model, q);
    EXPECT_LE((M - wanted).norm(), 1e-12 * wanted.norm());
    EXPECT_EQ(M, M.transpose());
  }
}

TEST(MassMatrix, IsExactlyZeroBetweenBranches) {
  const Model model = compile(readOrs(sourcePath("data/robots/man.ors")).spec);
  Rng rng(352);
  const Eigen::VectorXd q = rng.normalVector(model.nq());
  const Eigen::MatrixXd M = massMatrix(model, q), wanted = massMatrixByJacobians(model, q);
  EXPECT_EQ((M.array() == 0).count(), (wanted.array() == 0).count());
  EXPECT_GT((M.array() == 0).count(), model.nv() * model.nv() / 4);
}

// About the world's origin, inertias of 1e12 kg m^2 would take turns in being subtracted.
TEST(MassMatrix, IsExactFarAway) {
  Rng rng(353);
  SceneSpec spec = randomScene(rng, 14);
  spec.joints.insert(
      spec.joints.begin(),
      {.name = "base", .parent = "world", .child = "b0", .type = JointType::kFree, .X_PF = {}, .X_MC = {}});
  const Model model = compile(spec);
  Eigen::VectorXd q = randomPositions(rng, model.nq());
  const Eigen::MatrixXd near = massMatrix(model, q);
  q.head<3>() += Eigen::Vector3d(1e6, -2e6, 5e5);
  EXPECT_LE((massMatrix(model, q) - near).norm(), 1e-8 * near.norm());
}

TEST(MassMatrix, FillsAPartOfAMatrixAndAllocatesNothing) {
  Rng rng(354);
  const Model model = randomModel(rng, 40, Followers::kSome);
  const int n = model.nv();
  const Eigen::VectorXd q = randomPositions(rng, model.nq());
  const Eigen::MatrixXd wanted = massMatrix(model, q);
  Eigen::MatrixXd all = Eigen::MatrixXd::Constant(n + 3, n + 2, 7);
  DynamicsWorkspace workspace;
  massMatrix(model, q, workspace, all.block(1, 1, n, n));
  const long before = allocations();
  massMatrix(model, q, workspace, all.block(1, 1, n, n));
  EXPECT_EQ(allocations(), before);
  EXPECT_EQ(all.block(1, 1, n, n), wanted);
  all.block(1, 1, n, n).setConstant(7);
  EXPECT_EQ(all, Eigen::MatrixXd::Constant(n + 3, n + 2, 7)) << "what lies around it";
}

TEST(MassMatrix, HasTheSameBitsInAllLanes) {
  Rng rng(357);
  for (int i = 0; i < 20; ++i) {
    const Model model = randomModel(rng, 2 + 2 * i, Followers::kSome);
    const Eigen::VectorXd q = randomPositions(rng, model.nq());
    const Eigen::MatrixXd wanted = massMatrix(model, q);
    for (int lanes = 1; lanes <= cpuLanes(); lanes *= 2) {
      const auto kernel = kernelFor<internal::MassMatrixKernel>(lanes);
      Eigen::MatrixXd M(model.nv(), model.nv());
      DynamicsWorkspace workspace;
      kernel.one(model.links().data(), static_cast<int>(model.links().size()), q.data(),
                 internal::roomFor(kernel, model, 1, workspace), M.data(), M.outerStride(), model.nv());
      M.diagonal() += model.armature();
      EXPECT_EQ(M, wanted) << lanes;
    }
  }
}

TEST(MassMatrix, OfASceneThatCannotMoveIsEmpty) {
  SceneSpec spec;
  spec.bodies = {{.name = "rock", .X_WB = {}, .mass = 1}};
  EXPECT_EQ(massMatrix(compile(spec), Eigen::VectorXd()).size(), 0);
}

TEST(EquationOfMotion, HoldsBothTerms) {
  Rng rng(355);
  const Model model = randomModel(rng, 30, Followers::kSome);
  const Eigen::VectorXd q = randomPositions(rng, model.nq()), v = rng.normalVector(model.nv());
  const Eigen::VectorXd a = rng.normalVector(model.nv());
  const EquationOfMotion motion = equationOfMotion(model, q, v);
  const Eigen::VectorXd u = inverseDynamics(model, q, v, a);
  EXPECT_LE((motion.M * a + motion.F - u).norm(), 1e-12 * u.norm());
}

#ifndef __SANITIZE_ADDRESS__
TEST(EquationOfMotion, AllocatesOnlyAtFirst) {
  Rng rng(357);
  const Model model = randomModel(rng, 30, Followers::kSome);
  const Eigen::VectorXd q = randomPositions(rng, model.nq()), v = rng.normalVector(model.nv());
  DynamicsWorkspace workspace;
  EquationOfMotion motion;
  const long before = allocations();
  equationOfMotion(model, q, v, earthGravity(), workspace, motion);
  const long first = allocations();
  motion.M.setZero();
  motion.F.setZero();
  equationOfMotion(model, q, v, earthGravity(), workspace, motion);
  EXPECT_GT(first, before);
  EXPECT_EQ(allocations(), first);
  EXPECT_EQ(motion.M, massMatrix(model, q));
  EXPECT_EQ(motion.F, biasForces(model, q, v));
}
#endif

TEST(MassMatrix, NamesWrongSizes) {
  Rng rng(356);
  const Model model = compile(randomScene(rng, 3));
  const Eigen::VectorXd two = Eigen::VectorXd::Zero(2), five = Eigen::VectorXd::Zero(5);
  DynamicsWorkspace workspace;
  Eigen::MatrixXd tall(3, 2), wide(2, 3);
  EXPECT_REX_ERROR(massMatrix(model, five), "joint positions q: found a vector of size 5, wanted size 2");
  EXPECT_REX_ERROR(massMatrix(model, two, workspace, tall),
                   "rows of the mass matrix M: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(massMatrix(model, two, workspace, wide),
                   "columns of the mass matrix M: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(equationOfMotion(model, two, five),
                   "joint velocities v: found a vector of size 5, wanted size 2");
}

}  // namespace rex::mass_matrix_test
