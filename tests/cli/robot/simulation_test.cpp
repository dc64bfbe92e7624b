#include "cli/robot/simulation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "control/computed_torque.h"
#include "dynamics/centroidal.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/forward_dynamics.h"
#include "formats/ors_reader.h"
#include "formats/scene_file.h"
#include "support/paths.h"

namespace rex::cli::simulation_test {

const Model kArm = compile(readOrs(sourcePath("data/robots/pegArm.ors")).spec);

std::vector<Moment> momentsOf(const Model& model, const SimulationPlan& plan) {
  std::vector<Moment> moments;
  simulate(model, plan, [&](const Moment& moment) { moments.push_back(moment); });
  return moments;
}

SimulationPlan fall() {
  return {.start = {kArm.initialPositions(), Eigen::Vector3d(0, 1, 0)}, .steps = 1000};
}

TEST(Simulation, KeepsTheEnergyOfAFreeArm) {
  const std::vector<Moment> moments = momentsOf(kArm, fall());
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
  plan.hold = Hold::kExact;
  const State last = momentsOf(kArm, plan).back().state;
  EXPECT_LT((last.q - plan.start.q).norm(), 1e-3);
  EXPECT_LT(last.v.norm(), 1e-2);
  plan.start.v.setZero();
  for (const Moment& moment : momentsOf(kArm, plan)) EXPECT_LT((moment.state.q - plan.start.q).norm(), 1e-9);
}

// The energy of a solver with too long steps, against the motions above and below, which have none of it.
TEST(Simulation, StopsWhenTheSolverMakesEnergy) {
  SimulationPlan plan = fall();
  plan.stepper.integrator = Integrator::kEuler, plan.tau = 0.05, plan.steps = 10000;
  std::vector<Moment> moments;
  const std::optional<EnergyGain> gain =
      simulate(kArm, plan, [&](const Moment& moment) { moments.push_back(moment); });
  ASSERT_TRUE(gain);
  EXPECT_LT(moments.size(), 10000u);
  const Moment& grown = moments[moments.size() - 2];
  EXPECT_EQ(gain->time, grown.state.time);
  double lowest = INFINITY, deepest = 0;
  for (const Moment& moment : moments) {
    if (&moment <= &grown) lowest = std::min(lowest, moment.energy.total());
    deepest = std::max(deepest, moments[0].energy.potential - moment.energy.potential);
  }
  EXPECT_NEAR(gain->gained, grown.energy.total() - lowest, 1e-9);
  EXPECT_NEAR(gain->given, moments[0].energy.kinetic + deepest, 1e-9);
  EXPECT_GT(gain->gained, 2 * gain->given);
}

TEST(Simulation, KnowsWhatTorquesAndNoiseGive) {
  SimulationPlan plan = fall();
  plan.start.v.setZero();
  plan.stepper.noise = 3;
  EXPECT_FALSE(simulate(kArm, plan, [](const Moment&) {})) << "noise";
  plan.stepper.noise = 0;
  plan.torques = TorqueTable{.nv = 3, .columns = {0}, .times = {0}, .rows = {{20}}};
  double most = 0;
  const std::optional<EnergyGain> gain =
      simulate(kArm, plan, [&](const Moment& moment) { most = std::max(most, moment.energy.kinetic); });
  EXPECT_GT(most, 20);
  EXPECT_FALSE(gain) << "torques";
}

TEST(Simulation, TakesItsNoiseFromTheSeed) {
  SimulationPlan plan = fall();
  plan.stepper.noise = 0.5;
  const Eigen::VectorXd once = momentsOf(kArm, plan).back().state.q;
  EXPECT_EQ(momentsOf(kArm, plan).back().state.q, once);
  plan.seed = 1;
  EXPECT_NE(momentsOf(kArm, plan).back().state.q, once);
}

// Bullet's steps are of first order: near the fine steps of Runge and Kutta for a while, and held alike.
TEST(Simulation, FallsInAWorldWithContactsToo) {
  SimulationPlan plan = fall();
  plan.steps = 200;
  const State fine = momentsOf(kArm, plan).back().state;
  plan.physics = {.jointLimits = false, .jointFriction = false};
  const State bullet = momentsOf(kArm, plan).back().state;
  EXPECT_NEAR(bullet.time, fine.time, 1e-12);
  EXPECT_GT((fine.q - plan.start.q).norm(), 0.1);
  EXPECT_LT((bullet.q - fine.q).norm(), 0.02);
  EXPECT_NE(bullet.q, fine.q);
  plan.hold = Hold::kExact, plan.steps = 1000;
  EXPECT_LT((momentsOf(kArm, plan).back().state.q - plan.start.q).norm(), 5e-3);
}

// A dog in the air: its centre of mass falls as a stone, while its joints stay.
TEST(Simulation, HoldsJointsButNeverAFreeBase) {
  const Model dog =
      compile(readScene(sourcePath("data/robots/quadruped/quadruped.urdf"), {.freeBase = true}).spec);
  ASSERT_TRUE(hasFloatingBase(dog));
  EXPECT_FALSE(hasFloatingBase(kArm));
  SimulationPlan plan{.start = initialState(dog), .steps = 300};
  for (int i = 6; i < dog.nv(); ++i) plan.start.q[i + 1] = i % 3 == 1 ? 0.5 : -0.4;
  plan.start.v[4] = 2;
  plan.hold = Hold::kExact;
  const std::vector<Moment> moments = momentsOf(dog, plan);
  const State &first = moments.front().state, &last = moments.back().state;
  const Centroidal before = centroidal(dog, forwardKinematics(dog, first.q), first.v),
                   after = centroidal(dog, forwardKinematics(dog, last.q), last.v);
  const Eigen::Vector3d stone = 0.3 * before.velocity + Eigen::Vector3d(0, 0, -9.81 / 2 * 0.3 * 0.3);
  EXPECT_LT((after.center - before.center - stone).norm(), 1e-6);
  EXPECT_LT((last.q - first.q).tail(dog.nq() - 7).norm(), 1e-2);
  for (const Hold hold : {Hold::kExact, Hold::kGravity, Hold::kPd}) {
    const Eigen::VectorXd u = Holder(dog, hold, first.q, earthGravity(), 1e-3).forces(last);
    EXPECT_EQ(u.head(6).norm(), 0);
    EXPECT_GT(u.tail(12).norm(), 0);
  }
  // By the equation of motion: with these forces, joints accelerate as springs of mass one would.
  const Eigen::VectorXd u = Holder(dog, Hold::kExact, first.q, earthGravity(), 1e-3).forces(last);
  const Eigen::VectorXd a = forwardDynamics(dog, last.q, last.v, u),
                        wanted = followReference(dog, last, standAt(dog, first.q), pdGains(1, 0.1, 1));
  EXPECT_LT((a - wanted).tail(12).norm(), 1e-6 * (1 + wanted.norm()));
}

TEST(Simulation, GravityIsHeldAndSpringsAloneSag) {
  SimulationPlan plan = fall();
  plan.start.v.setZero();
  plan.steps = 2000;
  plan.hold = Hold::kGravity;
  EXPECT_LT((momentsOf(kArm, plan).back().state.q - plan.start.q).norm(), 1e-9);
  plan.hold = Hold::kPd;
  const State last = momentsOf(kArm, plan).back().state;
  EXPECT_LT(last.v.norm(), 1e-3);
  const Eigen::VectorXd stiffness = massMatrix(kArm, plan.start.q).diagonal() / (0.1 * 0.1);
  const Eigen::VectorXd springs = stiffness.cwiseProduct(plan.start.q - last.q);
  EXPECT_LT((springs - gravityForces(kArm, last.q)).norm(), 1e-2 * springs.norm());
  EXPECT_GT(springs.norm(), 0.1);
  plan.physics.emplace();
  plan.hold = Hold::kGravity;
  EXPECT_LT((momentsOf(kArm, plan).back().state.q - plan.start.q).norm(), 1e-6);
}

TEST(Simulation, MotorsHoldWhatHasAMotor) {
  SceneSpec spec = readScene(sourcePath("data/robots/quadruped/quadruped.urdf"), {.freeBase = true}).spec;
  JointSpec ball;
  ball.name = "tail";
  ball.parent = "torso";
  ball.child = "tail";
  ball.type = JointType::kBall;
  spec.bodies.push_back({.name = "tail", .X_WB = {}, .mass = 0.1});
  spec.joints.push_back(ball);
  const Model model = compile(spec);
  const Holder holder(model, Hold::kMotor, model.initialPositions(), earthGravity(), 1e-3);
  EXPECT_EQ(holder.unheld(), std::vector<std::string>{"tail"});
  EXPECT_EQ(holder.forces(initialState(model)).norm(), 0);
  const std::vector<Motor> motors = holder.motors(Eigen::VectorXd::Zero(model.nv()));
  int held = 0;
  for (const Motor& motor : motors) {
    if (motor.kind != Motor::Kind::kPosition) continue;
    ++held;
    EXPECT_GT(motor.maxForce, 0);
  }
  EXPECT_EQ(held, 12);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(motors[static_cast<std::size_t>(i)].kind, Motor::Kind::kForce);
}

// Second opinion: the stepper, driven by hand.
TEST(Simulation, TakesTorquesFromATable) {
  SimulationPlan plan = fall();
  plan.steps = 100;
  plan.start.time = 7;
  plan.torques = {.nv = 3, .columns = {2, 0}, .times = {0.02, 0.05}, .rows = {{3, 1}, {-1, 2}}};
  Stepper stepper(kArm, plan.stepper);
  State state = plan.start;
  for (int i = 0; i < 100; ++i) {
    Eigen::Vector3d u(0, 0, 0);
    if (i >= 20) u = Eigen::Vector3d(1, 0, 3);
    if (i >= 50) u = Eigen::Vector3d(2, 0, -1);
    stepper.step(state, u, 1e-3);
  }
  EXPECT_LT((momentsOf(kArm, plan).back().state.q - state.q).norm(), 1e-12);
  EXPECT_EQ(plan.torques->at(0.019).norm(), 0);
  EXPECT_EQ(plan.torques->at(100), Eigen::Vector3d(2, 0, -1));
}

TEST(Simulation, IsShownAtTheRateOfAFilm) {
  FilmPostures film(0.01, 100, 30);
  for (int i = 0; i <= 100; ++i) film.add(Eigen::Vector3d::Constant(i));
  const Motion& motion = film.motion();
  ASSERT_EQ(motion.times.size(), 31u);
  EXPECT_EQ(motion.times[1], 1. / 30);
  EXPECT_EQ(motion.postures[0][0], 0);
  EXPECT_EQ(motion.postures[1][0], 3);
  EXPECT_EQ(motion.postures[2][0], 7);
  EXPECT_EQ(motion.postures[30][0], 100);
  FilmPostures brief(0.0001, 100, 30), coarse(0.5, 2, 30);
  for (int i = 0; i <= 100; ++i) brief.add(Eigen::Vector3d::Constant(i));
  EXPECT_EQ(brief.motion().postures.size(), 1u);
  for (int i = 0; i <= 2; ++i) coarse.add(Eigen::Vector3d::Constant(i));
  ASSERT_EQ(coarse.motion().postures.size(), 31u);
  EXPECT_EQ(coarse.motion().postures[7][0], 0);
  EXPECT_EQ(coarse.motion().postures[8][0], 1);
}

}  // namespace rex::cli::simulation_test
