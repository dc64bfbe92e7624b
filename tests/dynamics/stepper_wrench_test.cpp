// Steps under pushes from outside.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "dynamics/energy.h"
#include "dynamics/stepper.h"
#include "kinematics/forward_kinematics.h"
#include "support/expect_error.h"
#include "support/planar_chain.h"
#include "support/random_motion.h"

namespace rex::stepper_wrench_test {

constexpr Integrator kAll[] = {Integrator::kEuler, Integrator::kSemiImplicitEuler, Integrator::kRungeKutta4,
                               Integrator::kBeeman, Integrator::kLeapfrog};
constexpr Integrator kFourthOrder[] = {Integrator::kRungeKutta4, Integrator::kBeeman};

// A rod that turns about z, pulled along x at its tip, half a metre from the hinge: a pendulum whose gravity
// is the pull.
struct PulledRod {
  static constexpr double kInertia = 0.2, kReach = 0.5, kPull = 3, kStart = 1.5;
  Model model = compile(spec());
  State state = initialState(model);

  PulledRod() { state.q[0] = kStart; }
  static SceneSpec spec() {
    BodySpec rod{.name = "rod", .X_WB = {}, .mass = 1};
    rod.inertia = Eigen::Vector3d(1, 1, kInertia).asDiagonal();
    JointSpec hinge{.name = "hinge", .parent = "world", .child = "rod", .X_PF = {}, .X_MC = {}};
    hinge.axis = Eigen::Vector3d::UnitZ();
    return {.name = "rod", .bodies = {rod}, .joints = {hinge}, .worldShapes = {}};
  }
  State after(double seconds, int steps, Integrator integrator) const {
    Stepper stepper(model, {.integrator = integrator});
    stepper.setWrenches({{.body = model.body("rod"), .p_BQ = {kReach, 0, 0}, .force_W = {kPull, 0, 0}}});
    State end = state;
    for (int i = 0; i < steps; ++i) stepper.step(end, Eigen::VectorXd::Zero(1), seconds / steps);
    return end;
  }
};

double order(double error, double errorOfHalf) { return std::log2(std::abs(error / errorOfHalf)); }

// A quarter of its period, a complete elliptic integral, after it was let go it passes the x axis (Landau and
// Lifshitz, Mechanics, section 11).
TEST(StepperWrench, PulledRodSwingsAsAPendulum) {
  const PulledRod rod;
  const double torque = PulledRod::kPull * PulledRod::kReach;
  const double quarter =
      std::sqrt(PulledRod::kInertia / torque) * std::comp_ellint_1(std::sin(PulledRod::kStart / 2));
  const double speed = -std::sqrt(2 * torque * (1 - std::cos(PulledRod::kStart)) / PulledRod::kInertia);
  for (const Integrator integrator : kFourthOrder) {
    const State coarse = rod.after(quarter, 100, integrator), fine = rod.after(quarter, 200, integrator);
    EXPECT_LT(std::abs(fine.q[0]), 1e-7);
    EXPECT_NEAR(order(coarse.q[0], fine.q[0]), 4, 0.3) << int(integrator);
    EXPECT_NEAR(fine.v[0], speed, 1e-6);
  }
}

// dE/dt = force . velocity, so that a constant force adds its product with the way of its point.
TEST(StepperWrench, AddsItsWorkToTheEnergy) {
  const Model model = compile(swingScene());
  const Wrench wrench{.body = model.body("link2"), .p_BQ = {1, 0.1, 0.2}, .force_W = {4, 1, 9}};
  for (const Integrator integrator : kFourthOrder) {
    const auto excess = [&](int steps) {
      State state = initialState(model);
      Stepper stepper(model, {.integrator = integrator});
      stepper.setWrenches({wrench});
      const auto balance = [&] {
        const Eigen::Vector3d p = forwardKinematics(model, state.q)[wrench.body] * wrench.p_BQ;
        return energy(model, state.q, state.v).total() - wrench.force_W.dot(p);
      };
      const double before = balance();
      for (int i = 0; i < steps; ++i) stepper.step(state, Eigen::Vector3d::Zero(), 0.5 / steps);
      EXPECT_GT(energy(model, state.q, state.v).kinetic, 1);
      return balance() - before;
    };
    EXPECT_LT(std::abs(excess(400)), 1e-6);
    EXPECT_GT(order(excess(200), excess(400)), 3.7) << int(integrator);
  }
}

// Weights as wrenches on centres of mass, on all joints, also those that mimic.
TEST(StepperWrench, WeightsMoveAsGravityDoes) {
  Rng rng(72);
  const Model model = randomModel(rng, 20, Followers::kSome);
  const State start{randomPositions(rng, model.nq()), 0.3 * rng.normalVector(model.nv())};
  std::vector<Wrench> weights;
  for (int b = 1; b < static_cast<int>(model.bodies().size()); ++b)
    weights.push_back({.body = BodyId{b},
                       .p_BQ = model[BodyId{b}].p_BBcm,
                       .force_W = model[BodyId{b}].mass * earthGravity()});
  for (const Integrator integrator : kAll) {
    const JointForces limits{.limitStiffness = 1};
    Stepper falling(model, {.integrator = integrator, .jointForces = limits});
    Stepper pushed(model,
                   {.integrator = integrator, .gravity_W = Eigen::Vector3d::Zero(), .jointForces = limits});
    pushed.setWrenches(weights);
    State a = start, b = start;
    const Eigen::VectorXd u = rng.normalVector(model.nv());
    for (int i = 0; i < 10; ++i) falling.step(a, u, 1e-3), pushed.step(b, u, 1e-3);
    EXPECT_LT((a.q - b.q).norm() + (a.v - b.v).norm(), 1e-9 * (1 + a.v.norm())) << int(integrator);
    EXPECT_GT((a.v - start.v).norm(), 1e-3);
  }
}

TEST(StepperWrench, PushesUntilTheNext) {
  const PulledRod rod;
  Stepper stepper(rod.model), quiet(rod.model);
  stepper.setWrenches({{.body = rod.model.body("rod"), .torque_W = {0, 0, 2}}});
  Stepper copy = stepper;
  State state = rod.state;
  copy.step(state, Eigen::VectorXd::Zero(1), 0.1);
  EXPECT_NEAR(state.v[0], 0.1 * 2 / PulledRod::kInertia, 1e-12) << "a copy is pushed, too";
  stepper.setWrenches({});
  state = rod.state;
  stepper.step(state, Eigen::VectorXd::Zero(1), 0.1);
  EXPECT_EQ(state.v[0], 0);
}

TEST(StepperWrench, RefusesWrenchesThatAreNone) {
  const PulledRod rod;
  Stepper stepper(rod.model);
  const auto set = [&](Wrench wrench) {
    stepper.setWrenches({{.body = rod.model.body("rod"), .force_W = {1, 2, 3}}, wrench});
  };
  for (const int body : {-1, 2})
    EXPECT_REX_ERROR(set({.body = BodyId{body}}), "body of a wrench: found number " + std::to_string(body) +
                                                      ", wanted one of the 2 bodies of the model");
  const Eigen::Vector3d bad(0, std::numeric_limits<double>::quiet_NaN(), 0);
  const BodyId body = rod.model.body("rod");
  for (const Wrench& wrench : {Wrench{.body = body, .p_BQ = bad}, Wrench{.body = body, .force_W = bad},
                               Wrench{.body = body, .torque_W = bad}})
    EXPECT_REX_ERROR(
        set(wrench),
        "wrench on body 'rod': found a number that is not finite, wanted a finite point, force and torque");
  State state = rod.state;
  stepper.step(state, Eigen::VectorXd::Zero(1), 0.1);
  EXPECT_EQ(state.v[0], 0) << "none was set";
}

}  // namespace rex::stepper_wrench_test
