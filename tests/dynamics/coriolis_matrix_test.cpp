#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "dynamics/equations_of_motion.h"
#include "scene/state.h"
#include "support/expect_error.h"
#include "support/mass_matrix_by_jacobians.h"
#include "support/random_motion.h"

namespace rex::coriolis_matrix_test {

double largest(const Eigen::MatrixXd& M) { return M.cwiseAbs().maxCoeff(); }

// Column k is the derivative of M, column by column, along coordinate k of the way.
Eigen::MatrixXd massDerivatives(const Model& model, const Eigen::VectorXd& q, const Eigen::MatrixXd& ways) {
  const VectorFunction along = [&](const Eigen::VectorXd& x) {
    const Eigen::MatrixXd M = massMatrixByJacobians(model, integrate(model, q, ways * x));
    return Eigen::VectorXd(M.reshaped());
  };
  return numericJacobian(along, Eigen::VectorXd::Zero(ways.cols()));
}

class CoriolisMatrixOfRandomTree : public testing::TestWithParam<double> {};

TEST_P(CoriolisMatrixOfRandomTree, SplitsTheBiasAndTheRateOfTheMassMatrix) {
  Rng rng(311);
  for (int i = 0; i < 10; ++i) {
    const Model model = randomModel(rng, 13 + 2 * i, Followers::kSome);
    const int n = model.nv();
    const Eigen::VectorXd q = randomPositions(rng, model.nq()), way = rng.normalVector(n),
                          v = GetParam() * way;
    const Eigen::MatrixXd C = coriolisMatrix(model, q, v);
    const Eigen::VectorXd coriolis = biasForces(model, q, v, Eigen::Vector3d::Zero());
    EXPECT_LE(largest(C * v - coriolis), 1e-12 * largest(coriolis));
    const Eigen::MatrixXd rate = GetParam() * massDerivatives(model, q, way).reshaped(n, n);
    EXPECT_LE(largest(rate - C - C.transpose()), 1e-8 * largest(rate));
    EXPECT_EQ(largest(C) > 0, GetParam() > 0);
  }
}

INSTANTIATE_TEST_SUITE_P(AtZeroTinyAndRandom, CoriolisMatrixOfRandomTree, testing::Values(0., 1e-8, 1.));

// Trees whose coordinates are all plain.
TEST(CoriolisMatrix, IsThatOfChristoffelsSymbols) {
  Rng rng(312);
  for (int i = 0; i < 5; ++i) {
    SceneSpec spec = randomScene(rng, 14);
    for (JointSpec& joint : spec.joints) {
      if (joint.type == JointType::kBall) joint.type = JointType::kUniversal;
      if (joint.type == JointType::kFree) joint.type = JointType::kPlanarXYPhi;
    }
    const Model model = compile(spec);
    const int n = model.nv();
    ASSERT_EQ(model.nq(), n);
    const Eigen::VectorXd q = randomPositions(rng, n), v = rng.normalVector(n);
    const Eigen::MatrixXd derivatives = massDerivatives(model, q, Eigen::MatrixXd::Identity(n, n));
    const auto dM = [&](int row, int column, int k) { return derivatives(row + n * column, k); };
    Eigen::MatrixXd C = Eigen::MatrixXd::Zero(n, n);
    for (int row = 0; row < n; ++row)
      for (int column = 0; column < n; ++column)
        for (int k = 0; k < n; ++k)
          C(row, column) += (dM(row, column, k) + dM(row, k, column) - dM(column, k, row)) * v[k] / 2;
    EXPECT_LE(largest(C - coriolisMatrix(model, q, v)), 1e-8 * largest(C));
  }
}

TEST(CoriolisMatrix, NamesWrongSizes) {
  Rng rng(313);
  const Model model = compile(randomScene(rng, 3));
  EXPECT_REX_ERROR(coriolisMatrix(model, Eigen::VectorXd::Zero(2), Eigen::VectorXd::Zero(5)),
                   "joint velocities v: found a vector of size 5, wanted size 2");
}

}  // namespace rex::coriolis_matrix_test
