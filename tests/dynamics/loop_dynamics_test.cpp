#include "dynamics/loop_dynamics.h"

#include <array>
#include <cmath>

#include "base/rng.h"
#include "dynamics/energy.h"
#include "dynamics/equations_of_motion.h"
#include "support/expect_error.h"
#include "support/four_bar.h"

namespace rex::loop_dynamics_test {

using Eigen::Vector3d;
using Eigen::VectorXd;

class LoopDynamics : public ::testing::Test {
 protected:
  // At this angle of the crank, which turns with this speed.
  State stateAt(double angle, double speed) const {
    const VectorXd q = bar_.closedForm(angle);
    const Eigen::MatrixXd motion = loopMotions(model_, loops_, q);
    return {q, motion.col(0) * (speed / motion(0, 0))};
  }

  FourBar bar_;
  Model model_ = compile(bar_.scene());
  std::vector<TaskMap> loops_ = pinTasks(model_);
};

// By Lagrange's equation in the angle of the crank alone, with the closed form of all others.
TEST_F(LoopDynamics, IsThatOfOneAngle) {
  const Lagrangian lagrangian = [&](const VectorXd& angle, const VectorXd& speed) {
    constexpr double kStep = 1e-5;
    const VectorXd q = bar_.closedForm(angle[0]),
                   v = speed[0] * (bar_.closedForm(angle[0] + kStep) - bar_.closedForm(angle[0] - kStep)) /
                       (2 * kStep);
    const Energy of = energy(model_, q, v);
    return of.kinetic - of.potential;
  };
  Rng rng(1);
  for (int k = 0; k < 10; ++k) {
    const VectorXd angle = VectorXd::Constant(1, rng.uniform(-3, 3)),
                   speed = VectorXd::Constant(1, rng.uniform(-3, 3)), zero = VectorXd::Zero(1),
                   one = VectorXd::Ones(1);
    const double torque = rng.uniform(-2, 2), idle = eulerLagrangeForce(lagrangian, angle, speed, zero)[0],
                 inertia = eulerLagrangeForce(lagrangian, angle, speed, one)[0] - idle;
    const State state = stateAt(angle[0], speed[0]);
    const LoopMotion motion = loopDynamics(model_, state, loops_, Vector3d(torque, 0, 0));
    EXPECT_NEAR(motion.a[0], (torque - idle) / inertia, 1e-3 * (1 + std::abs(motion.a[0]))) << k;
    // Forces of the pin do no work, and none of them leaves the plane.
    const TaskValue at = stackLoops(model_, loops_, state.q);
    EXPECT_NEAR(motion.forces.dot(at.J * state.v), 0, 1e-9) << k;
    EXPECT_NEAR(motion.forces[1], 0, 1e-9) << k;
  }
}

TEST_F(LoopDynamics, KeepsEnergyAndLoops) {
  State state = stateAt(1, 2);
  const auto total = [&] {
    const Energy of = energy(model_, state.q, state.v);
    return of.kinetic + of.potential;
  };
  const double before = total();
  constexpr double kStep = 2e-3;
  const auto slope = [&](const State& at) { return loopDynamics(model_, at, loops_, Vector3d::Zero()).a; };
  const auto moved = [](const State& from, const VectorXd& v, const VectorXd& a, double h) {
    return State{from.q + h * v, from.v + h * a, from.time + h};
  };
  for (int k = 0; k < 1000; ++k) {  // Runge and Kutta
    const VectorXd a1 = slope(state);
    const State s2 = moved(state, state.v, a1, kStep / 2);
    const VectorXd a2 = slope(s2);
    const State s3 = moved(state, s2.v, a2, kStep / 2);
    const VectorXd a3 = slope(s3);
    const State s4 = moved(state, s3.v, a3, kStep);
    const VectorXd a4 = slope(s4);
    state = closedState(
        model_,
        moved(state, (state.v + 2 * s2.v + 2 * s3.v + s4.v) / 6, (a1 + 2 * a2 + 2 * a3 + a4) / 6, kStep),
        loops_);
  }
  EXPECT_NEAR(total(), before, 1e-6 * std::abs(before));
  EXPECT_LT(stackLoops(model_, loops_, state.q).y.norm(), 1e-11);
  EXPECT_GT(std::abs(state.q[0] - 1), 1) << "it moves";
}

// Baumgarte's errors fade as y'' + 2 b y' + b^2 y = 0 says.
TEST_F(LoopDynamics, StabilisesWhatIsNotClosed) {
  State state = stateAt(1, 1);
  state.q[2] += 0.01;
  constexpr double kRate = 10;
  const TaskValue at = stackLoops(model_, loops_, state.q);
  const LoopMotion motion = loopDynamics(model_, state, loops_, Vector3d::Zero(), {.stabilisation = kRate});
  constexpr double kStep = 1e-4;
  const auto errorAfter = [&](double t) {
    const VectorXd q = state.q + t * state.v + t * t / 2 * motion.a;
    return stackLoops(model_, loops_, q).y;
  };
  const VectorXd second = (errorAfter(kStep) - 2 * at.y + errorAfter(-kStep)) / (kStep * kStep);
  const VectorXd wanted = -2 * kRate * (at.J * state.v) - kRate * kRate * at.y;
  EXPECT_GT(wanted.norm(), 0.1);
  EXPECT_LT((second - wanted).norm(), 1e-4 * wanted.norm());
}

// A closed state takes the nearest velocities, in the metric of kinetic energy: what is taken off stores no
// energy together with what is left.
TEST_F(LoopDynamics, ClosesWithTheLeastChangeOfEnergy) {
  State state = stateAt(.5, 1);
  state.v += Vector3d(.1, -.2, .3);
  state.q += Vector3d(0, .01, .02);
  const State closed = closedState(model_, state, loops_);
  const VectorXd off = state.v - closed.v;
  EXPECT_LT((stackLoops(model_, loops_, closed.q).J * closed.v).norm(), 1e-10);
  const auto kinetic = [&](const VectorXd& v) { return energy(model_, closed.q, v).kinetic; };
  EXPECT_NEAR(kinetic(state.v), kinetic(closed.v) + kinetic(off), 1e-10);
}

// By calling it once for each unit of force; without loops it is forward dynamics, too.
TEST_F(LoopDynamics, RespondsToForcesAsItSays) {
  const State state = stateAt(1, 2);
  for (const std::span<const TaskMap> loops : {std::span<const TaskMap>(loops_), {}}) {
    const LoopResponse response = loopResponse(model_, state.q, loops);
    const LoopMotion idle = loopDynamics(model_, state, loops, Vector3d::Zero());
    ASSERT_EQ(response.forces_u.rows(), idle.forces.size());
    for (int i = 0; i < 3; ++i) {
      const LoopMotion pushed = loopDynamics(model_, state, loops, Vector3d::Unit(i));
      EXPECT_LT((pushed.a - idle.a - response.a_u.col(i)).norm(), 1e-9 * response.a_u.norm()) << i;
      EXPECT_LT((pushed.forces - idle.forces - response.forces_u.col(i)).norm(), 1e-9) << i;
    }
  }
}

TEST_F(LoopDynamics, WithoutLoopsIsForwardDynamics) {
  const State state{Vector3d(.1, .2, .3), Vector3d(1, 2, 3)};
  const LoopMotion motion = loopDynamics(model_, state, {}, Vector3d(1, 0, 0));
  EXPECT_EQ(motion.forces.size(), 0);
  EXPECT_LT((inverseDynamics(model_, state.q, state.v, motion.a) - Vector3d(1, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(closedState(model_, state, {}).v, state.v);
}

TEST_F(LoopDynamics, NamesWhatIsWrong) {
  const State state = stateAt(1, 1);
  EXPECT_REX_ERROR(loopDynamics(model_, state, loops_, Vector3d::Zero(), {.stabilisation = -1}),
                   "stabilisation of loops: found -1");
  const std::array far{pinTask(model_.body("rocker"), {.7, 0, 0}, kWorld, {9, 0, 0})};
  EXPECT_REX_ERROR(closedState(model_, state, far), "loops of the mechanism: found no step closes the loops");
}

}  // namespace rex::loop_dynamics_test
