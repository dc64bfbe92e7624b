// What motion without friction or forces keeps: "use energy conservation to measure".
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "dynamics/energy.h"
#include "dynamics/stepper.h"
#include "formats/ors_reader.h"
#include "support/paths.h"
#include "support/planar_chain.h"
#include "support/runge_kutta.h"

namespace rex::stepper_energy_test {

// The largest change of energy in each of `spans` equal spans of time, relative to `scale` joules.
std::vector<double> drifts(const Model& model, State state, const StepperOptions& options, double h,
                           int steps, double scale, int spans = 1) {
  Stepper stepper(model, options);
  const Eigen::VectorXd u = Eigen::VectorXd::Zero(model.nv());
  const double start = energy(model, state.q, state.v).total();
  std::vector<double> largest(static_cast<std::size_t>(spans), 0);
  for (int i = 0; i < steps; ++i) {
    stepper.step(state, u, h);
    const double change = std::abs(energy(model, state.q, state.v).total() - start) / scale;
    double& most = largest[static_cast<std::size_t>(i / (steps / spans))];
    most = std::max(most, change);
  }
  return largest;
}

double swingDrift(Integrator integrator) {
  const Model model = compile(swingScene());
  return drifts(model, initialState(model), {.integrator = integrator}, 1e-3, 10000,
                PlanarChain::kEnergyScale)[0];
}

TEST(StepperEnergy, SwingsFreelyWithoutLoss) {
  EXPECT_LE(swingDrift(Integrator::kRungeKutta4), 5.4e-8);
  EXPECT_LE(swingDrift(Integrator::kBeeman), 2e-5);
  EXPECT_LE(swingDrift(Integrator::kLeapfrog), 3e-4);
  EXPECT_LE(swingDrift(Integrator::kSemiImplicitEuler), 3e-2);
  EXPECT_GT(swingDrift(Integrator::kEuler), 3e-2) << "the script's Euler gains energy";
}

TEST(StepperEnergy, SwingsAsItsClosedForm) {
  const Model model = compile(swingScene());
  for (const Integrator integrator : {Integrator::kRungeKutta4, Integrator::kBeeman}) {
    State state = initialState(model);
    PlanarChain::Vector6 chain = PlanarChain::Vector6::Zero();
    Stepper stepper(model, {.integrator = integrator});
    for (int i = 0; i < 1000; ++i) {
      stepper.step(state, Eigen::Vector3d::Zero(), 1e-3);
      for (int k = 0; k < 2; ++k) chain = rungeKutta4Step(PlanarChain::derivative, chain, 5e-4);
      ASSERT_LT((chainAngles(state.q) - chain.head<3>()).norm(), 1e-6) << state.time;
      ASSERT_LT((chainAngles(state.v) - chain.tail<3>()).norm(), 1e-5) << state.time;
    }
    EXPECT_GT(chain.head<3>().norm(), 1);
  }
}

// One link, from 1 rad to the side of hanging down: some sixty swings.
TEST(StepperEnergy, OneLinkSwingsForLong) {
  SceneSpec spec = swingScene();
  spec.bodies.resize(1);
  spec.joints.resize(1);
  const Model model = compile(spec);
  State start = initialState(model);
  start.q[0] = -0.6;
  const auto overTime = [&](Integrator integrator) {
    return drifts(model, start, {.integrator = integrator}, 0.01, 10000, 9.81, 10);
  };
  for (const auto& [integrator, most] :
       {std::pair(Integrator::kSemiImplicitEuler, 5e-3), std::pair(Integrator::kLeapfrog, 1e-4)}) {
    const std::vector<double> drift = overTime(integrator);
    for (const double one : drift) {
      EXPECT_LT(one, most);
      EXPECT_LT(one, 1.01 * drift[0]) << "it does not grow";
    }
  }
  const std::vector<double> euler = overTime(Integrator::kEuler);
  EXPECT_GT(euler.back(), 3 * euler.front());
}

TEST(StepperEnergy, LeapfrogDoesNotDrift) {
  const Model model = compile(readOrs(sourcePath("data/robots/arm3.ors")).spec);
  const double scale = energy(model, model.initialPositions(), Eigen::Vector3d::Zero()).potential;
  const std::vector<double> drift =
      drifts(model, initialState(model), {.integrator = Integrator::kLeapfrog}, 2e-3, 50000, scale, 10);
  EXPECT_LT(*std::max_element(drift.begin(), drift.end()), 5e-5);
  EXPECT_LT(drift.back(), 2 * drift.front()) << "errors come and go";
}

class CourseScenes : public testing::TestWithParam<const char*> {};

TEST_P(CourseScenes, KeepTheirEnergy) {
  const Model model = compile(readOrs(sourcePath("data/robots") / (std::string(GetParam()) + ".ors")).spec);
  Rng rng(4);
  const State start{model.initialPositions(), 0.5 * rng.normalVector(model.nv())};
  const auto drift = [&](Integrator integrator) {
    return drifts(model, start, {.integrator = integrator}, 1e-3, 300, 1)[0];
  };
  EXPECT_LT(drift(Integrator::kRungeKutta4), 1e-10);
  EXPECT_LT(drift(Integrator::kBeeman), 1e-8);
  EXPECT_LT(drift(Integrator::kLeapfrog), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(All, CourseScenes, testing::Values("man", "pegArm", "pegArm2", "arm3", "pegInAHole"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace rex::stepper_energy_test
