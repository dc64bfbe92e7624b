// Postures held by springs, dampers and motors: the gains against closed forms, and robots that must stay.
#include "live/hold.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "dynamics/energy.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/stepper.h"
#include "formats/scene_file.h"
#include "formats/urdf_reader.h"
#include "scene/state.h"
#include "support/four_bar.h"
#include "support/paths.h"

namespace rex::hold_test {

using Eigen::VectorXd;

// Two hinges about the same axis, as in a wrist: the first body is a light ring, the second carries the tool.
Model wrist(double ring, double tool, double effort) {
  const auto link = [](const std::string& name, double inertia) {
    return fmt::format(
        "<link name='{}'><inertial><mass value='1'/><inertia ixx='{}' iyy='1' izz='1' ixy='0' ixz='0' "
        "iyz='0'/>"
        "</inertial></link>",
        name, inertia);
  };
  const auto joint = [&](const std::string& parent, const std::string& child) {
    return fmt::format(
        "<joint name='{}' type='revolute'><parent link='{}'/><child link='{}'/><axis xyz='1 0 0'/>"
        "<limit effort='{}' velocity='100' lower='-3' upper='3'/></joint>",
        child, parent, child, effort);
  };
  return compile(parseUrdf("<robot name='wrist'><link name='base'/>" + link("ring", ring) +
                               link("tool", tool) + joint("base", "ring") + joint("ring", "tool") +
                               "</robot>",
                           "wrist.urdf")
                     .spec);
}

double energyOf(const Model& model, const State& state) { return energy(model, state.q, state.v).total(); }

TEST(Holder, SuitsTheMassThatAJointCarries) {
  const double ring = 1e-3, tool = 0.1, tau = 1e-9;
  const Model model = wrist(ring, tool, 1000);
  const Holder holder(model, Hold::kPd, VectorXd::Zero(2), {0, 0, 0}, tau);
  const VectorXd masses = Eigen::Vector2d(ring + tool, tool);
  const double k = 1 / (kHoldWave * kHoldWave), d = 2 / kHoldWave;
  for (int i = 0; i < 2; ++i) {
    State state = initialState(model);
    state.q[i] = 0.1;
    VectorXd wanted = VectorXd::Zero(2);
    wanted[i] = -0.1 * k * masses[i];
    EXPECT_LT((holder.forces(state) - wanted).norm(), 1e-5 * wanted.norm());
    state.q[i] = 0, state.v[i] = 0.5;
    wanted[i] = -0.5 * d * masses[i];
    EXPECT_LT((holder.forces(state) - wanted).norm(), 1e-5 * wanted.norm());
  }
}

// Explicit dampers for M_ii would multiply the speed of the ring by 1 - 2 tau (ring + tool) / (ring wave) per
// step.
TEST(Holder, StaysStableAtAnyStep) {
  for (const Hold hold : {Hold::kPd, Hold::kGravity}) {
    for (const double tau : {1e-4, 1e-3, 1e-2, 0.1}) {
      const Model model = wrist(1e-4, 0.1, 1e6);
      const Holder holder(model, hold, VectorXd::Zero(2), {0, 0, 0}, tau);
      State state = initialState(model);
      state.v = Eigen::Vector2d(1, -2);
      const double most = energyOf(model, state);
      for (int k = 0; k * tau < 3; ++k) {
        // The rule of PhysicsWorld: v first, then q with the new v.
        const VectorXd u = holder.forces(state);
        state.v += tau * massMatrix(model, state.q).llt().solve(u);
        state.q += tau * state.v;
      }
      EXPECT_LT(energyOf(model, state), 1e-6 * most) << toString(hold) << ", steps of " << tau;
    }
  }
}

TEST(Holder, IsNoStrongerThanTheJoints) {
  const Model model = wrist(1e-3, 0.1, 0.25);
  for (const Hold hold : {Hold::kPd, Hold::kGravity}) {
    const Holder holder(model, hold, VectorXd::Zero(2), earthGravity(), 1e-3);
    State state = initialState(model);
    state.q = Eigen::Vector2d(2, -2);
    state.v = Eigen::Vector2d(50, 0);
    EXPECT_EQ(holder.forces(state).cwiseAbs().maxCoeff(), 0.25);
  }
}

TEST(Holder, NamesAJointThatMovesNoMass) {
  const Model model = compile(parseUrdf("<robot name='r'><link name='base'/><link name='light'/>"
                                        "<joint name='j' type='continuous'><parent link='base'/>"
                                        "<child link='light'/></joint></robot>",
                                        "r.urdf")
                                  .spec);
  try {
    static_cast<void>(Holder(model, Hold::kPd, VectorXd::Zero(1), earthGravity(), 1e-3));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("'j'"), std::string::npos) << error.what();
  }
}

// The farthest that a joint gets from its posture in 10 s in steps of 1 ms, and the most that energy grows.
struct Held {
  double away = 0, gained = 0;
};
Held hold(const Model& model, const VectorXd& q, Hold how, double seconds = 10) {
  const Holder holder(model, how, q, earthGravity(), 1e-3);
  PhysicsWorld world(model);
  State state{q, VectorXd::Zero(model.nv())};
  world.setState(state);
  double lowest = energyOf(model, state);
  Held held;
  for (int k = 0; k < 1000 * seconds; ++k) {
    world.setMotors(holder.motors(holder.forces(state)));
    world.step(1e-3);
    state = world.state();
    const VectorXd away = difference(model, q, state.q);
    for (const Joint& joint : model.joints())
      if (joint.type != JointType::kFree && !joint.mimics)
        held.away = std::max(held.away, away.segment(joint.vIndex, joint.nv).lpNorm<Eigen::Infinity>());
    held.gained = std::max(held.gained, energyOf(model, state) - lowest);
    lowest = std::min(lowest, energyOf(model, state));
  }
  return held;
}

// A heavy rocker moved by a light crank, whose loop the prediction does not know.
TEST(Holder, HoldsALightCrankInALoop) {
  const FourBar bar;
  SceneSpec spec = bar.scene();
  spec.bodies[0].mass *= 1e-3, *spec.bodies[0].inertia *= 1e-3;  // the crank
  spec.bodies[1].mass *= 20, *spec.bodies[1].inertia *= 20;
  const Model model = compile(spec);
  const Held pd = hold(model, bar.closedForm(1), Hold::kPd);
  EXPECT_LT(pd.away, 0.2);
  EXPECT_LT(pd.gained, 0.1);
  EXPECT_LT(hold(model, bar.closedForm(1), Hold::kMotor).away, 1e-3);
}

TEST(Holder, HoldsPublishedRobots) {
  int count = 0;
  for (const char* name :
       {"tiago", "talos_left_arm", "icub_reduced", "kuka_iiwa", "go2_description", "bolt"}) {
    const auto file = sharedPath(fmt::format("data/urdf/{}.urdf", name));
    if (!std::filesystem::exists(file)) continue;
    ++count;
    const Model model = compile(readScene(file, {.allowMissingMeshes = true}).spec);
    VectorXd q = model.initialPositions();
    for (const Joint& joint : model.joints()) {
      const int i = joint.qIndex;
      if (joint.nq == 1) q[i] = std::clamp(q[i], model.lowerLimits()[i], model.upperLimits()[i]);
    }
    for (const Hold how : {Hold::kPd, Hold::kGravity, Hold::kMotor}) {
      const Held held = hold(model, q, how, count == 1 ? 10 : 3);
      EXPECT_LT(held.away, how == Hold::kPd ? 0.4 : 1e-4) << name << ", " << toString(how);
      EXPECT_LT(held.gained, 0.01) << name << ", " << toString(how);
    }
  }
  if (count == 0) GTEST_SKIP() << "no files in ../shared/data/urdf";
}

}  // namespace rex::hold_test
