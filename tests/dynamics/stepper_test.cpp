#include "dynamics/stepper.h"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "dynamics/energy.h"
#include "dynamics/forward_dynamics.h"
#include "geometry/rotation.h"
#include "kinematics/forward_kinematics.h"
#include "support/allocations.h"
#include "support/expect_error.h"
#include "support/planar_chain.h"
#include "support/random_motion.h"

namespace rex::stepper_test {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Integrator kAll[] = {Integrator::kEuler, Integrator::kSemiImplicitEuler, Integrator::kRungeKutta4,
                               Integrator::kBeeman, Integrator::kLeapfrog};

int orderOf(Integrator integrator) {
  switch (integrator) {
    case Integrator::kRungeKutta4:
    case Integrator::kBeeman:
      return 4;
    case Integrator::kLeapfrog:
      return 2;
    case Integrator::kEuler:
    case Integrator::kSemiImplicitEuler:
      break;
  }
  return 1;
}

State after(const Model& model, State state, double seconds, int steps, const StepperOptions& options) {
  Stepper stepper(model, options);
  const Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(model.nv(), -1, 1);
  for (int i = 0; i < steps; ++i) stepper.step(state, u, seconds / steps);
  return state;
}

double distance(const Model& model, const State& a, const State& b) {
  return difference(model, a.q, b.q).norm() + (a.v - b.v).norm();
}

// Trees with every type of joint, some with quaternions, against very fine steps of Runge and Kutta.
TEST(Stepper, ErrorsShrinkWithTheirOrderOnAllJoints) {
  Rng rng(3);
  for (int tree = 0; tree < 3; ++tree) {
    const Model model = compile(randomScene(rng, 13));
    State start{randomPositions(rng, model.nq()), 0.5 * rng.normalVector(model.nv())};
    const double seconds = 0.2;
    const State fine = after(model, start, seconds, 800, {});
    for (const Integrator integrator : kAll) {
      const int steps = orderOf(integrator) == 4 ? 50 : 100;
      const auto error = [&](int n) {
        return distance(model, fine, after(model, start, seconds, n, {.integrator = integrator}));
      };
      const double order = std::log2(error(steps) / error(2 * steps));
      EXPECT_NEAR(order, orderOf(integrator), 0.3) << "tree " << tree << " integrator " << int(integrator);
    }
  }
}

// A top that is as thick one way as the other, thrown: its centre of mass flies a parabola, its axis circles
// about the angular momentum L (Landau and Lifshitz, Mechanics, section 33).
struct ThrownTop {
  static constexpr double kAcross = 0.02, kAlong = 0.05, kMass = 0.8;
  Eigen::Vector3d p_BBcm{0.1, -0.2, 0.3};
  Model model = compile(spec());
  State start = initialState(model);

  ThrownTop() {
    start.q << 0.1, 0.2, 0.3, Eigen::Vector4d(0.5, -0.7, 0.3, 0.4).normalized();
    start.v << 1, -2, 4, 3, -2, 5;
  }
  SceneSpec spec() const {
    BodySpec body{.name = "top", .X_WB = {}, .mass = kMass};
    body.p_BBcm = p_BBcm;
    body.inertia = Eigen::Vector3d(kAcross, kAcross, kAlong).asDiagonal();
    const JointSpec joint{
        .name = "free", .parent = "world", .child = "top", .type = JointType::kFree, .X_PF = {}, .X_MC = {}};
    return {.name = "top", .bodies = {body}, .joints = {joint}, .worldShapes = {}};
  }
  Pose at(double t) const {
    const Eigen::Matrix3d R = rotationFromQuaternion(start.q.tail<4>());
    const Eigen::Vector3d w = start.v.tail<3>();
    const Eigen::Vector3d L = R * Eigen::Vector3d(kAcross * w[0], kAcross * w[1], kAlong * w[2]);
    const double spin = w[2] * (1 - kAlong / kAcross);
    Pose X;
    X.R = expSO3(t / kAcross * L) * R * expSO3(t * spin * Eigen::Vector3d::UnitZ());
    X.p = start.q.head<3>() + R * p_BBcm + t * (start.v.head<3>() + R * w.cross(p_BBcm)) +
          t * t / 2 * earthGravity() - X.R * p_BBcm;
    return X;
  }
  double error(Integrator integrator, int steps) const {
    State state = start;
    Stepper stepper(model, {.integrator = integrator});
    for (int i = 0; i < steps; ++i) stepper.step(state, Eigen::VectorXd::Zero(6), 0.5 / steps);
    const Pose got = forwardKinematics(model, state.q)[BodyId{1}], wanted = at(0.5);
    EXPECT_NEAR(state.q.tail<4>().norm(), 1, 1e-15);
    return (got.p - wanted.p).norm() + (got.R - wanted.R).norm();
  }
};

TEST(Stepper, ThrowsATopAsItsClosedForm) {
  const ThrownTop top;
  for (const Integrator integrator : kAll) {
    const int steps = orderOf(integrator) == 1 ? 1000 : 200;
    const double error = top.error(integrator, steps), half = top.error(integrator, 2 * steps);
    EXPECT_NEAR(std::log2(error / half), orderOf(integrator), 0.3) << int(integrator);
  }
  EXPECT_LT(top.error(Integrator::kRungeKutta4, 1000), 1e-9);
  EXPECT_LT(top.error(Integrator::kBeeman, 1000), 1e-8);
}

// Two kilograms that a slider lets move up and down.
Model stone(double mass = 2, double damping = 0) {
  BodySpec body{.name = "stone", .X_WB = {}, .mass = mass};
  JointSpec joint{.name = "fall",
                  .parent = "world",
                  .child = "stone",
                  .type = JointType::kSlider,
                  .X_PF = {},
                  .X_MC = {}};
  joint.axis = Eigen::Vector3d::UnitZ();
  joint.damping = damping;
  return compile({.name = "fall", .bodies = {body}, .joints = {joint}, .worldShapes = {}});
}

TEST(Stepper, IsExactWhereTheForceIsConstant) {
  const Model model = stone();
  for (const Integrator integrator : {Integrator::kRungeKutta4, Integrator::kBeeman, Integrator::kLeapfrog}) {
    State state = initialState(model);
    Stepper stepper(model, {.integrator = integrator});
    for (int i = 0; i < 100; ++i) stepper.step(state, Eigen::VectorXd::Constant(1, 3), 0.01);
    EXPECT_NEAR(state.v[0], 1.5 - 9.81, 1e-12);
    EXPECT_NEAR(state.q[0], (1.5 - 9.81) / 2, 1e-12);
    EXPECT_NEAR(state.time, 1, 1e-12);
  }
}

TEST(Stepper, EulersDifferInTheVelocityTheyMoveBy) {
  const Model model = compile(swingScene());
  const Eigen::VectorXd q = Eigen::Vector3d(.1, .2, .3), v = Eigen::Vector3d(1, 2, 3),
                        u = Eigen::Vector3d::Zero();
  const Eigen::VectorXd a = forwardDynamics(model, q, v, u);
  State old{q, v}, renewed{q, v};
  Stepper(model, {.integrator = Integrator::kEuler}).step(old, u, 0.1);
  Stepper(model, {.integrator = Integrator::kSemiImplicitEuler}).step(renewed, u, 0.1);
  EXPECT_LT((old.v - v - 0.1 * a).norm(), 1e-12);
  EXPECT_EQ(old.v, renewed.v);
  EXPECT_LT((old.q - q - 0.1 * v).norm(), 1e-14);
  EXPECT_LT((renewed.q - q - 0.1 * renewed.v).norm(), 1e-14);
}

TEST(Stepper, LeapfrogGoesBackTheWayItCame) {
  Rng rng(5);
  for (int tree = 0; tree < 5; ++tree) {
    const Model model = compile(randomScene(rng, 13));
    const State start{integrate(model, randomPositions(rng, model.nq()), Eigen::VectorXd::Zero(model.nv())),
                      0.5 * rng.normalVector(model.nv())};
    const Eigen::VectorXd u = rng.normalVector(model.nv());
    Stepper stepper(model, {.integrator = Integrator::kLeapfrog});
    State state = start;
    for (int i = 0; i < 10; ++i) stepper.step(state, u, 0.005);
    EXPECT_GT(distance(model, start, state), 0.01);
    for (int i = 0; i < 10; ++i) stepper.step(state, u, -0.005);
    EXPECT_LT(distance(model, start, state), 1e-12) << "tree " << tree;
    EXPECT_NEAR(state.time, 0, 1e-15);
  }
}

// After a jump of q, v, u or h it goes on like one that is new.
TEST(Stepper, BeemanStartsAgainAtJumps) {
  const Model model = compile(swingScene());
  const StepperOptions options{.integrator = Integrator::kBeeman};
  const Eigen::VectorXd u = Eigen::Vector3d(1, 0, -1);
  const auto jump = [&](int what, State& state, Eigen::VectorXd& force, double& h) {
    if (what == 0) state.q[1] += 1e-9;
    if (what == 1) state.v[2] -= 1e-9;
    if (what == 2) force[0] += 1e-9;
    if (what == 3) h *= 1.5;
  };
  for (int what = 0; what < 6; ++what) {
    Stepper stepper(model, options);
    State state = initialState(model);
    Eigen::VectorXd force = u;
    double h = 0.01;
    for (int i = 0; i < 10; ++i) stepper.step(state, force, h);
    jump(what, state, force, h);
    if (what == 4) stepper.reset();
    Stepper fresh(model, options);
    if (what == 5) {
      stepper.setWrenches({{.body = model.body("link2"), .force_W = {0, 0, 1}}});
      fresh.setWrenches({{.body = model.body("link2"), .force_W = {0, 0, 1}}});
    }
    State other = state;
    for (int i = 0; i < 10; ++i) {
      stepper.step(state, force, h);
      fresh.step(other, force, h);
      ASSERT_EQ(state.q, other.q) << what;
      ASSERT_EQ(state.v, other.v) << what;
    }
  }
}

TEST(Stepper, BeemanStartsLikeRungeKuttaAndThenGoesItsWay) {
  const Model model = compile(swingScene());
  Stepper beeman(model, {.integrator = Integrator::kBeeman}), rungeKutta(model);
  State a = initialState(model), b = a;
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(a.v, b.v) << i;
    beeman.step(a, Eigen::Vector3d::Zero(), 0.01);
    rungeKutta.step(b, Eigen::Vector3d::Zero(), 0.01);
  }
  EXPECT_NE(a.v, b.v);
  EXPECT_LT((a.v - b.v).norm(), 1e-4);
}

TEST(Stepper, CopiesGoOnAlike) {
  const Model model = compile(swingScene());
  Stepper stepper(model, {.integrator = Integrator::kBeeman});
  State state = initialState(model);
  const Eigen::VectorXd u = Eigen::Vector3d::Zero();
  for (int i = 0; i < 5; ++i) stepper.step(state, u, 0.01);
  State other = state, third = state;
  Stepper copy = stepper, assigned(model);
  assigned = copy;
  stepper.step(state, u, 0.01);
  copy.step(other, u, 0.01);
  EXPECT_EQ(state.v, other.v);
  assigned.step(third, u, 0.01);
  EXPECT_EQ(state.v, third.v);
  Stepper moved = std::move(stepper);
  moved.step(state, u, 0.01);
  copy.step(other, u, 0.01);
  EXPECT_EQ(state.v, other.v);
}

#ifndef __SANITIZE_ADDRESS__
TEST(Stepper, AllocatesNothing) {
  Rng rng(8);
  const Model plain = randomModel(rng, 13, Followers::kNone),
              mimicking = randomModel(rng, 16, Followers::kSome);
  for (const Model& model : {plain, mimicking}) {
    for (const Integrator integrator : kAll) {
      Stepper stepper(
          model,
          {.integrator = integrator, .jointForces = {.friction = true, .limitStiffness = 1}, .noise = 1e-3});
      stepper.setWrenches({{.body = BodyId{7}, .force_W = {1, 2, 3}}});
      State state{randomPositions(rng, model.nq()), 0.1 * rng.normalVector(model.nv())};
      const Eigen::VectorXd u = Eigen::VectorXd::Zero(model.nv());
      const auto steps = [&] {
        stepper.step(state, u, 0.001, rng);  // a jump for Beeman's
        for (int i = 0; i < 4; ++i) stepper.step(state, u, 0.001);
      };
      steps();
      const long before = allocations();
      steps();
      EXPECT_EQ(allocations(), before) << int(integrator);
    }
  }
}
#endif

TEST(Stepper, NoiseHasItsVariance) {
  const Model model = compile(swingScene());
  const double h = 0.04, noise = 0.5;
  Stepper stepper(model, {.gravity_W = Eigen::Vector3d::Zero(), .noise = noise});
  constexpr int kSeeds = 4000;
  double sum = 0, squares = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed));
    State state = initialState(model);
    stepper.step(state, Eigen::Vector3d::Zero(), h, rng);
    EXPECT_EQ(state.q, initialState(model).q) << "noise moves v only";
    sum += state.v.sum();
    squares += state.v.squaredNorm();
  }
  const double count = 3. * kSeeds, variance = h * noise * noise;
  EXPECT_NEAR(sum / count, 0, 4 * std::sqrt(variance / count));
  EXPECT_NEAR(squares / count, variance, 4 * variance * std::sqrt(2 / count));
}

TEST(Stepper, NoiseHasASeed) {
  const Model model = compile(swingScene());
  const auto end = [&](std::uint64_t seed, double noise) {
    Rng rng(seed);
    Stepper stepper(model, {.noise = noise});
    State state = initialState(model);
    for (int i = 0; i < 20; ++i) stepper.step(state, Eigen::Vector3d::Zero(), 0.01, rng);
    return Eigen::VectorXd(state.v);
  };
  EXPECT_EQ(end(1, 0.1), end(1, 0.1));
  EXPECT_NE(end(1, 0.1), end(2, 0.1));
  EXPECT_EQ(end(1, 0), end(2, 0));
  Rng used(1), fresh(1);
  State state = initialState(model);
  Stepper(model).step(state, Eigen::Vector3d::Zero(), 0.01, used);
  EXPECT_EQ(used.state(), fresh.state());
}

class StepperErrors : public testing::TestWithParam<Integrator> {
 protected:
  // The step must fail with that text and leave everything as it was.
  void expectError(State state, const Eigen::VectorXd& u, double h, const std::string& text) {
    const State before = state;
    EXPECT_REX_ERROR(stepper_.step(state, u, h), text);
    Rng rng(1);
    EXPECT_REX_ERROR(stepper_.step(state, u, h, rng), text);
    EXPECT_EQ(rng.state(), Rng(1).state());
    const auto bytes = [](const Eigen::VectorXd& x) {
      return std::string(reinterpret_cast<const char*>(x.data()),
                         static_cast<std::size_t>(x.size()) * sizeof(double));
    };
    EXPECT_EQ(bytes(state.q), bytes(before.q));
    EXPECT_EQ(bytes(state.v), bytes(before.v));
    EXPECT_EQ(bytes(Eigen::VectorXd::Constant(1, state.time)),
              bytes(Eigen::VectorXd::Constant(1, before.time)));
  }

  Model model_ = compile(swingScene());
  State start_ = initialState(model_);
  Eigen::VectorXd u_ = Eigen::VectorXd::Zero(3);
  Stepper stepper_{model_, {.integrator = GetParam(), .noise = 1}};
};

TEST_P(StepperErrors, RefuseStepsThatAreNone) {
  for (const double h : {0., kInfinity, -kInfinity, std::nan("")})
    expectError(start_, u_, h, "time step: found ");
  if (GetParam() == Integrator::kLeapfrog) {
    expectError(start_, u_, 0, "time step: found 0 s, wanted a finite number of seconds other than 0");
  } else {
    expectError(start_, u_, -0.1, "time step: found -0.1 s, wanted a positive, finite number of seconds");
  }
}

TEST_P(StepperErrors, RefuseWrongSizes) {
  expectError(start_, Eigen::VectorXd::Zero(2), 0.01,
              "joint forces u: found a vector of size 2, wanted size 3");
  State state = start_;
  state.q.resize(4);
  state.q.setZero();
  expectError(state, u_, 0.01, "joint positions q: found a vector of size 4, wanted size 3");
  state = start_;
  state.v.resize(0);
  expectError(state, u_, 0.01, "joint velocities v: found a vector of size 0, wanted size 3");
}

TEST_P(StepperErrors, RefuseNumbersThatAreNotFinite) {
  for (const double bad : {std::nan(""), kInfinity, -kInfinity}) {
    State state = start_;
    state.q[1] = bad;
    expectError(state, u_, 0.01, "joint positions q: number 1, of joint 'hinge1': found ");
    state = start_;
    state.v[2] = bad;
    expectError(state, u_, 0.01, "joint velocities v: number 2, of joint 'hinge2': found ");
    Eigen::VectorXd u = u_;
    u[0] = bad;
    expectError(start_, u, 0.01, "joint forces u: number 0, of joint 'hinge0': found ");
    state = start_;
    state.time = bad;
    expectError(state, u_, 0.01, "time of the state: found ");
  }
}

// Gains of a wrong sign.
TEST_P(StepperErrors, ReportWhatGrowsWithoutBounds) {
  State state = start_;
  std::string message;
  try {
    for (int i = 0; i < 10000; ++i) {
      u_ = 100 * state.v;
      stepper_.step(state, u_, 0.1);
    }
  } catch (const Error& error) {
    message = error.what();
  }
  const auto unbounded = testing::HasSubstr("': its motion grows without bounds at ");
  EXPECT_THAT(message, testing::StartsWith("joint 'hinge"));
  if (GetParam() == Integrator::kLeapfrog) {
    EXPECT_THAT(message, testing::AnyOf(unbounded, testing::HasSubstr("': its acceleration in the middle")));
  } else {
    EXPECT_THAT(message, unbounded);
  }
  EXPECT_TRUE(state.v.allFinite());
  expectError(state, u_, 0.1, message);
}

TEST_P(StepperErrors, ReportSpeedsBeyondLight) {
  State state = start_;
  state.time = 1.5;
  state.v[1] = 3e8;
  expectError(
      state, u_, 0.25,
      "joint 'hinge1': its motion grows without bounds at 1.75 s: found a velocity of 3e+08, wanted less "
      "than the speed of light: take shorter steps or smaller forces");
  Eigen::VectorXd u = u_;
  u[2] = 1e300;
  state = start_;
  expectError(state, u, 1, "its motion grows without bounds at 1 s: found a velocity of ");
}

std::string nameOf(const testing::TestParamInfo<Integrator>& integrator) {
  constexpr const char* kNames[] = {"Euler", "SemiImplicitEuler", "RungeKutta4", "Beeman", "Leapfrog"};
  return kNames[static_cast<int>(integrator.param)];
}

INSTANTIATE_TEST_SUITE_P(All, StepperErrors, testing::ValuesIn(kAll), nameOf);

TEST(Stepper, ReportsPositionsThatOverflow) {
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(1);
  Stepper stepper(stone(), {.gravity_W = Eigen::Vector3d::Zero()});
  State state{1e308 * one, 1e8 * one};
  EXPECT_REX_ERROR(stepper.step(state, 0 * one, 1e301),
                   "joint 'fall': its motion grows without bounds at 1e+301 s: found a position of inf");
}

// Numbers that are too large only with the noise.
TEST_P(StepperErrors, ReportNoiseBeyondLight) {
  for (const double noise : {1e12, 1e308}) {
    Stepper stepper(model_, {.integrator = GetParam(), .noise = noise});
    State state = start_;
    Rng rng(1);
    EXPECT_REX_ERROR(stepper.step(state, u_, 0.01, rng),
                     "': its motion grows without bounds at 0.01 s: found a velocity of ");
    EXPECT_EQ(rng.state(), Rng(1).state());
    EXPECT_EQ(state.q, start_.q);
    EXPECT_EQ(state.v, start_.v);
    EXPECT_EQ(state.time, 0);
  }
}

// Damping so strong that the mean velocity cannot be found one guess after the other.
TEST(Stepper, LeapfrogReportsStepsItCannotTake) {
  Stepper stepper(stone(2, 400), {.integrator = Integrator::kLeapfrog, .jointForces = {.friction = true}});
  State state = initialState(stone());
  stepper.step(state, Eigen::VectorXd::Zero(1), 0.005);
  const State before = state;
  EXPECT_REX_ERROR(
      stepper.step(state, Eigen::VectorXd::Zero(1), 0.01),
      "joint 'fall': its acceleration in the middle of the leapfrog step to 0.015 s does not converge: "
      "found a step of 0.01 s, wanted a shorter one");
  EXPECT_EQ(state.v, before.v);
}

// Of two stones side by side, the second is the one that is damped.
TEST(Stepper, LeapfrogNamesTheJointThatChangesMost) {
  SceneSpec spec{.name = "stones", .bodies = {}, .joints = {}, .worldShapes = {}};
  for (const char* name : {"light", "damped"}) {
    spec.bodies.push_back({.name = name, .X_WB = {}, .mass = 2});
    spec.joints.push_back({.name = std::string(name) + "Fall",
                           .parent = "world",
                           .child = name,
                           .type = JointType::kSlider,
                           .X_PF = {},
                           .X_MC = {}});
  }
  spec.joints[1].damping = 404;
  const Model model = compile(spec);
  State state = initialState(model);
  state.v.setOnes();
  Stepper stepper(model, {.integrator = Integrator::kLeapfrog, .jointForces = {.friction = true}});
  EXPECT_REX_ERROR(
      stepper.step(state, Eigen::Vector2d::Zero(), 0.01),
      "joint 'dampedFall': its acceleration in the middle of the leapfrog step to 0.01 s does not converge");
}

TEST(Stepper, NamesWhatMovesNoMass) {
  for (const Integrator integrator : kAll) {
    const Model model = stone(0);
    State state = initialState(model);
    EXPECT_REX_ERROR(Stepper(model, {.integrator = integrator}).step(state, Eigen::VectorXd::Zero(1), 0.01),
                     "joint 'fall' moves no mass: wanted some: give body 'stone' a mass");
  }
}

TEST(Stepper, RefusesOptionsThatAreNone) {
  const Model model = compile(swingScene());
  for (const double noise : {-1., kInfinity, std::nan("")})
    EXPECT_REX_ERROR(Stepper(model, {.noise = noise}), "noise: found ");
  EXPECT_REX_ERROR(Stepper(model, {.noise = -1}), "noise: found -1, wanted a finite number, 0 or more");
  EXPECT_REX_ERROR(Stepper(model, {.gravity_W = {0, std::nan(""), 0}}),
                   "gravity: number 1: found nan, wanted a finite number");
}

TEST(Stepper, RefusesQuaternionsThatAreZero) {
  const ThrownTop top;
  State state = top.start;
  state.q.tail<4>().setZero();
  for (const Integrator integrator : kAll) {
    Stepper stepper(top.model, {.integrator = integrator});
    EXPECT_REX_ERROR(stepper.step(state, Eigen::VectorXd::Zero(6), 0.01), "quaternion");
  }
}

TEST(Stepper, StepsWorldsInWhichNothingMoves) {
  const Model model = compile({.name = "still",
                               .bodies = {{.name = "rock", .X_WB = {}, .mass = 1}},
                               .joints = {},
                               .worldShapes = {}});
  for (const Integrator integrator : kAll) {
    State state = initialState(model);
    Stepper(model, {.integrator = integrator}).step(state, Eigen::VectorXd(), 0.5);
    EXPECT_EQ(state.time, 0.5);
  }
}

}  // namespace rex::stepper_test
