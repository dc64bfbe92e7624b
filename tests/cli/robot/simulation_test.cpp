#include "cli/robot/simulation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "scene/ors_reader.h"
#include "support/paths.h"

namespace rex::cli::simulation_test {

const Model kArm = compile(readOrs(sourcePath("data/robots/pegArm.ors")).spec);

SimulationPlan fall() {
  return {.start = {kArm.initialPositions(), Eigen::Vector3d(0, 1, 0)}, .steps = 1000};
}

TEST(Simulation, KeepsTheEnergyOfAFreeArm) {
  const std::vector<Moment> moments = simulate(kArm, fall());
  ASSERT_EQ(moments.size(), 1001u);
  EXPECT_EQ(moments.front().state.q, kArm.initialPositions());
  EXPECT_NEAR(moments.back().state.time, 1, 1e-12);
  double fastest = 0;
  for (const Moment& moment : moments) {
    EXPECT_NEAR(moment.energy.total(), moments.front().energy.total(), 1e-9);
    const Energy again = energy(kArm, moment.state.q, moment.state.v);
    EXPECT_EQ(moment.energy.kinetic, again.kinetic);
    EXPECT_EQ(moment.energy.potential, again.potential);
    fastest = std::max(fastest, moment.state.v.norm());
  }
  EXPECT_GT(fastest, 2);
}

TEST(Simulation, HoldsThePosture) {
  SimulationPlan plan = fall();
  plan.isHeld = true;
  const State last = simulate(kArm, plan).back().state;
  EXPECT_LT((last.q - plan.start.q).norm(), 1e-3);
  EXPECT_LT(last.v.norm(), 1e-2);
  plan.start.v.setZero();
  for (const Moment& moment : simulate(kArm, plan)) EXPECT_LT((moment.state.q - plan.start.q).norm(), 1e-9);
}

TEST(Simulation, TakesItsNoiseFromTheSeed) {
  SimulationPlan plan = fall();
  plan.stepper.noise = 0.5;
  const Eigen::VectorXd once = simulate(kArm, plan).back().state.q;
  EXPECT_EQ(simulate(kArm, plan).back().state.q, once);
  plan.seed = 1;
  EXPECT_NE(simulate(kArm, plan).back().state.q, once);
}

// Bullet's steps are of first order: near the fine steps of Runge and Kutta for a while, and held alike.
TEST(Simulation, FallsInAWorldWithContactsToo) {
  SimulationPlan plan = fall();
  plan.steps = 200;
  const State fine = simulate(kArm, plan).back().state;
  plan.physics = {.jointLimits = false, .jointFriction = false};
  const State bullet = simulate(kArm, plan).back().state;
  EXPECT_NEAR(bullet.time, fine.time, 1e-12);
  EXPECT_GT((fine.q - plan.start.q).norm(), 0.1);
  EXPECT_LT((bullet.q - fine.q).norm(), 0.02);
  EXPECT_NE(bullet.q, fine.q);
  plan.isHeld = true, plan.steps = 1000;
  EXPECT_LT((simulate(kArm, plan).back().state.q - plan.start.q).norm(), 5e-3);
}

TEST(Simulation, IsShownAtTheRateOfAFilm) {
  std::vector<Moment> moments;
  for (int i = 0; i <= 100; ++i)
    moments.push_back({.state = {Eigen::Vector3d::Constant(i), {}}, .energy = {}});
  const Motion motion = motionOf(moments, 0.01, 30);
  ASSERT_EQ(motion.times.size(), 31u);
  EXPECT_EQ(motion.times[1], 1. / 30);
  EXPECT_EQ(motion.postures[0][0], 0);
  EXPECT_EQ(motion.postures[1][0], 3);
  EXPECT_EQ(motion.postures[2][0], 7);
  EXPECT_EQ(motion.postures[30][0], 100);
  EXPECT_EQ(motionOf(moments, 0.0001, 30).postures.size(), 1u);
}

}  // namespace rex::cli::simulation_test
