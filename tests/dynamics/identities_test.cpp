// Laws that hold for every tree, on a thousand random ones with joints of all types; that forward dynamics
// undoes inverse dynamics is in forward_dynamics_test.cpp.
#include <set>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "dynamics/energy.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/forward_dynamics.h"
#include "dynamics/stepper.h"
#include "scene/state.h"
#include "support/random_motion.h"

namespace rex::identities_test {

constexpr int kTrees = 1000;

double largest(const Eigen::MatrixXd& M) { return M.cwiseAbs().maxCoeff(); }

// Calls law(model, motion, rng) for each tree.
template <class Law>
void expectForAllTrees(int seed, const Law& law) {
  Rng rng(static_cast<std::uint64_t>(seed));
  std::set<JointType> types;
  for (int i = 0; i < kTrees; ++i) {
    SCOPED_TRACE("tree " + std::to_string(i) + " of seed " + std::to_string(seed));
    const Model model = randomModel(rng, 2 + i % 29, i % 4 == 0 ? Followers::kSome : Followers::kNone);
    for (const Joint& joint : model.joints()) types.insert(joint.type);
    if (model.nv() == 0) continue;
    const RandomMotion at(rng, model);
    law(model, at, rng);
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_EQ(types.size(), std::size(kAllJointTypes));
}

TEST(Identities, MassMatrixIsSymmetricAndPositive) {
  expectForAllTrees(371, [](const Model& model, const RandomMotion& at, Rng&) {
    const Eigen::MatrixXd M = massMatrix(model, at.q);
    EXPECT_EQ(M, M.transpose());
    EXPECT_EQ(M.llt().info(), Eigen::Success);
  });
}

TEST(Identities, ColumnsOfTheMassMatrixAreInverseDynamics) {
  expectForAllTrees(372, [](const Model& model, const RandomMotion& at, Rng&) {
    const Eigen::MatrixXd M = massMatrix(model, at.q);
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(model.nv()), G = gravityForces(model, at.q);
    for (int i = 0; i < model.nv(); ++i) {
      const Eigen::VectorXd column =
          inverseDynamics(model, at.q, rest, Eigen::VectorXd::Unit(model.nv(), i)) - G;
      EXPECT_LE(largest(M.col(i) - column), 1e-12 * (largest(M) + largest(G))) << i;
    }
  });
}

TEST(Identities, RateOfTheMassMatrixLessTwoCIsSkew) {
  expectForAllTrees(373, [](const Model& model, const RandomMotion& at, Rng&) {
    const VectorFunction along = [&](const Eigen::VectorXd& time) {
      return Eigen::VectorXd(massMatrix(model, integrate(model, at.q, time[0] * at.v)).reshaped());
    };
    const int n = model.nv();
    const Eigen::MatrixXd rate = numericJacobian(along, Eigen::VectorXd::Zero(1)).reshaped(n, n);
    const Eigen::MatrixXd left = rate - 2 * coriolisMatrix(model, at.q, at.v);
    EXPECT_LE(largest(left + left.transpose()), 1e-7 * (largest(rate) + largest(massMatrix(model, at.q))));
  });
}

TEST(Identities, PowerIsTheRateOfEnergy) {
  expectForAllTrees(374, [](const Model& model, const RandomMotion& at, Rng& rng) {
    const Eigen::VectorXd a = 3 * rng.normalVector(model.nv());
    const EnergyGradient gradient = energyGradient(model, at.q, at.v);
    const auto rate = [&](const Eigen::VectorXd& acceleration) {
      return gradient.byPosition.dot(at.v) + gradient.byVelocity.dot(acceleration);
    };
    const Eigen::VectorXd u = inverseDynamics(model, at.q, at.v, a);
    const double scale = u.norm() * at.v.norm() + gradient.byPosition.norm() * at.v.norm();
    EXPECT_NEAR(rate(a), u.dot(at.v), 1e-11 * scale);
    EXPECT_NEAR(rate(forwardDynamics(model, at.q, at.v, u)), u.dot(at.v), 1e-9 * scale);
  });
}

// Two steps, and the work of constant forces by Simpson's rule.
TEST(Identities, SteppingGainsTheWorkDone) {
  expectForAllTrees(375, [](const Model& model, const RandomMotion& at, Rng& rng) {
    const Eigen::VectorXd u = 10 * rng.normalVector(model.nv());
    const double h = 1e-4;
    Stepper stepper(model);
    State state{at.q, at.v};
    double work = h / 3 * u.dot(state.v);
    stepper.step(state, u, h);
    work += h / 3 * 4 * u.dot(state.v);
    stepper.step(state, u, h);
    work += h / 3 * u.dot(state.v);
    const Energy start = energy(model, at.q, at.v), end = energy(model, state.q, state.v);
    EXPECT_NEAR(end.total() - start.total(), work, 1e-9 * (start.kinetic + std::abs(start.potential)));
    EXPECT_NE(end.kinetic, start.kinetic);
  });
}

}  // namespace rex::identities_test
