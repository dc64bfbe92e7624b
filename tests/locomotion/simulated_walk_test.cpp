#include "locomotion/simulated_walk.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "locomotion/humanoid.h"
#include "support/expect_error.h"

namespace rex::simulated_walk_test {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kUnevenness = 0.005;

// A humanoid on a floor whose tiles are up to half a centimetre high.
Humanoid onFloor(const WalkPlan& plan, int seed, double unevenness = kUnevenness) {
  SceneSpec scene = Humanoid::scene();
  Rng rng(static_cast<std::uint64_t>(seed));
  addUnevenFloor(scene, plan, unevenness, 0.1, rng);
  return Humanoid(scene);
}

SimulatedWalk walked(const WalkPlan& plan, int seed, const SimulatedWalkOptions& options = {}) {
  const Humanoid robot = onFloor(plan, seed);
  SimulatedWalkOptions above = options;
  above.startAbove = kUnevenness;
  return simulateWalk(robot.model, robot.legs, plan, robot.home(plan), above);
}

// Two seconds on both feet.
WalkPlan standing() { return {.footsteps = straightFootsteps(1, 0, .19), .rest = .9}; }
WalkPlan standingOnly() {
  WalkPlan plan = standing();
  plan.footsteps.resize(2);
  return plan;
}

TEST(SimulatedWalk, StandsOnItsFeetAlone) {
  const SimulatedWalk walk = walked(standingOnly(), 5);
  ASSERT_FALSE(walk.falls) << walk.message;
  EXPECT_NEAR(walk.time, 2, 1e-9);
  const double weight = Humanoid().model.mass() * 9.81;
  const WalkMeasurement& end = walk.samples.back();
  EXPECT_NEAR(end.measured.force_W.z(), weight, .01 * weight);
  EXPECT_NEAR(end.loads.left + end.loads.right, weight, .01 * weight);
  EXPECT_LT(end.measured.force_W.head<2>().norm(), .01 * weight);
  EXPECT_GT(end.margin, .02);
  EXPECT_LT(walk.largestEffort, .3);
}

// On an uneven floor the measured zero moment point follows the plan and stays on the soles. A long run takes
// 20 steps on 50 floors, and prints the numbers for those who cite them.
TEST(SimulatedWalk, WalksOnUnevenFloors) {
  const char* const asked = std::getenv("REX_WALK_FLOORS");
  const int floors = asked == nullptr ? 1 : std::atoi(asked), steps = asked == nullptr ? 4 : 20;
  const WalkPlan plan{.footsteps = straightFootsteps(steps, .2, .19), .rest = 1};
  double captureError = 0, zmpError = 0, effort = 0;
  int falls = 0;
  const double friction = PhysicsOptions{}.friction;
  for (int seed = 0; seed < floors; ++seed) {
    const SimulatedWalk walk = walked(plan, seed);
    falls += walk.falls;
    captureError = std::max(captureError, walk.largestCaptureError);
    zmpError = std::max(zmpError, walk.rmsZmpError);
    effort = std::max(effort, walk.largestEffort);
    EXPECT_FALSE(walk.falls) << "seed " << seed << " " << walk.message;
    EXPECT_NEAR(walk.time, duration(plan), 1e-6);
    EXPECT_LT(walk.largestResidual, 1e-8);
    EXPECT_NEAR(walk.state.q[0], walk.samples.front().q[0] + .2 * (steps - 1), .03);
    bool wasOnOneFoot = false;
    for (const WalkMeasurement& sample : walk.samples) {
      // Contacts lie up to half a centimetre above the plane of the zero moment point.
      EXPECT_GT(sample.margin, -friction * kUnevenness) << sample.time;
      wasOnOneFoot |= sample.loads.left == 0 && sample.loads.right > 400;
    }
    EXPECT_TRUE(wasOnOneFoot);
  }
  EXPECT_LT(captureError, .03);
  EXPECT_LT(zmpError, .03);
  EXPECT_LT(effort, .8);
  std::printf(
      "%d of %d walks of %d steps without a fall: capture point off by at most %.4f m, zero moment point by "
      "%.4f m rms, efforts up to %.2f of their limits\n",
      floors - falls, floors, steps, captureError, zmpError, effort);
}

// The ground reaction from the contacts is the rate of the momenta minus gravity, by closed form from what
// the state does in a millisecond.
TEST(SimulatedWalk, MeasuresTheZmpOfItsMotion) {
  const WalkPlan plan{.footsteps = straightFootsteps(1, .1, .19), .rest = .4};
  const Humanoid robot = onFloor(plan, 2);
  const Model& model = robot.model;
  PhysicsWorld world(model);
  State state = initialState(model);
  state.q = robot.home(plan);
  state.q[2] += kUnevenness;
  world.setState(state);
  WalkController controller(model, robot.legs, plan, state.q);
  std::vector<Motor> motors(static_cast<std::size_t>(model.nv()));
  FootLoads loads;
  int compared = 0;
  for (int i = 0; i < 1400; ++i) {
    const State before = world.state();
    if (i % 2 == 0) {
      const WholeBodyForces forces = controller.control(before, loads).forces;
      ASSERT_EQ(forces.status, QuadraticStatus::kOptimal);
      for (std::size_t k = 0; k < motors.size(); ++k) motors[k].target = forces.u[static_cast<int>(k)];
      world.setMotors(motors);
    }
    world.step(1e-3);
    const State after = world.state();
    const std::vector<PhysicsContact> contacts = world.contacts();
    const std::vector<ContactForce> forces = groundForces(model, contacts, 1e-3);
    loads = {};
    for (const PhysicsContact& contact : contacts) {
      const BodyId body =
          model.shapes()[static_cast<std::size_t>(std::max(contact.shapeA, contact.shapeB))].body;
      (body == robot.legs.leftFoot ? loads.left : loads.right) += contact.impulse / 1e-3;
    }
    const ZeroMomentPoint measured = zmpOfContacts(forces);
    if (i < 200 || !measured.exists || measured.force_W.z() < 100) continue;
    const ZeroMomentPoint motion = zmpOfMotion(model, before.q, before.v, (after.v - before.v) / 1e-3);
    ASSERT_TRUE(motion.exists) << i;
    EXPECT_LT((measured.p_W - motion.p_W).norm(), 2e-3) << i;
    EXPECT_LT((measured.force_W - motion.force_W).norm(), .01 * motion.force_W.norm() + 2) << i;
    ++compared;
  }
  EXPECT_GT(compared, 1000);
}

// A push from the side while a foot is in the air: the next foot lands farther out, and the rest of the plan
// with it.
TEST(SimulatedWalk, StepsAsideWhenPushed) {
  const WalkPlan plan{.footsteps = straightFootsteps(3, .1, .19), .rest = .8};
  SimulatedWalkOptions options;
  options.pushes = {{.time = 1.2, .impulse_W = {0, 25, 0}}};
  const SimulatedWalk walk = walked(plan, 3, options);
  EXPECT_FALSE(walk.falls) << walk.message;
  EXPECT_GT(walk.samples.back().control.displacement.y(), .02);
  options.control.adjustsSteps = false;
  EXPECT_TRUE(walked(plan, 3, options).falls);
}

TEST(SimulatedWalk, FallsWhenPushedTooHard) {
  SimulatedWalkOptions options;
  options.pushes = {{.time = .3, .impulse_W = {0, 60, 0}}};
  const SimulatedWalk walk = walked(standingOnly(), 0, options);
  EXPECT_TRUE(walk.falls);
  EXPECT_LT(walk.time, 2);
  EXPECT_THAT(walk.message, testing::MatchesRegex("falls at .* s: '.*' touches the ground"));
  options.pushes.front().impulse_W.y() = 400;  // beyond the edge of the floor
  EXPECT_THAT(walked(standingOnly(), 0, options).message, testing::HasSubstr("the trunk has sunk too low"));
}

// Nothing but its motors holds it up.
// Bisected, and both ends of what is searched.
TEST(SimulatedWalk, FindsTheLargestPush) {
  WalkPlan plan = standingOnly();
  plan.rest = .5;
  const Humanoid robot = onFloor(plan, 0, 0);
  const auto largest = [&](double most, const SimulatedWalkOptions& options = {}) {
    return largestPush(robot.model, robot.legs, plan, robot.home(plan), {0, 2, 0}, .2, most, 20, options);
  };
  const double impulse = largest(160);
  EXPECT_GT(impulse, 10);
  EXPECT_LT(impulse, 150);
  EXPECT_EQ(largest(5), 5);
  EXPECT_EQ(largest(160, {.pushes = {{.time = .1, .impulse_W = {300, 0, 0}}}}), 0);
}

TEST(SimulatedWalk, FallsWithoutStrength) {
  SceneSpec scene = Humanoid::scene();
  for (JointSpec& joint : scene.joints) joint.maxEffort *= .05;
  Rng rng(0);
  addUnevenFloor(scene, standingOnly(), 0, 1, rng);
  const Humanoid weak(scene);
  EXPECT_TRUE(simulateWalk(weak.model, weak.legs, standingOnly(), weak.home(standingOnly())).falls);
}

TEST(SimulatedWalk, IsTheSameForTheSameSeed) {
  WalkPlan plan = standingOnly();
  plan.rest = .2;
  const SimulatedWalk first = walked(plan, 7), again = walked(plan, 7), other = walked(plan, 8);
  EXPECT_EQ(first.state.q, again.state.q);
  EXPECT_EQ(first.state.v, again.state.v);
  EXPECT_NE(first.state.q, other.state.q);
}

TEST(SimulatedWalk, FloorsAreAsUnevenAsSaid) {
  SceneSpec scene;
  Rng rng(4);
  const WalkPlan plan{.footsteps = straightFootsteps(2, .3, .2)};
  addUnevenFloor(scene, plan, .01, .1, rng);
  double low = 1, high = 0, west = 0, east = 0;
  for (const ShapeSpec& shape : scene.worldShapes) {
    const double top = shape.X_BS.p.z() + shape.shape.extent.z() / 2;
    low = std::min(low, top);
    high = std::max(high, top);
    west = std::min(west, shape.X_BS.p.x() - .05);
    east = std::max(east, shape.X_BS.p.x() + .05);
  }
  EXPECT_GE(low, 0);
  EXPECT_LT(low, .001);
  EXPECT_LT(high, .01);
  EXPECT_GT(high, .009);
  EXPECT_NEAR(west, -1, 1e-9);
  EXPECT_GE(east, 1.3);
  EXPECT_REX_ERROR(addUnevenFloor(scene, plan, -1, .1, rng), "uneven floor: unevenness: found -1");
  EXPECT_REX_ERROR(addUnevenFloor(scene, plan, 0, 0, rng), "uneven floor: tile: found 0");
  EXPECT_REX_ERROR(addUnevenFloor(scene, plan, 0, 1e-3, rng), "wanted at most 100000");
  EXPECT_REX_ERROR(addUnevenFloor(scene, {}, 0, .1, rng), "walk: footsteps: found 0");
}

TEST(SimulatedWalk, SaysWhatIsWrong) {
  const WalkPlan plan = standingOnly();
  const Humanoid robot;
  const VectorXd home = robot.start;
  const auto with = [&](const SimulatedWalkOptions& options) {
    return simulateWalk(robot.model, robot.legs, plan, home, options);
  };
  EXPECT_REX_ERROR(with({.step = .0015}),
                   "simulated walk: step: found 0.0015 s, wanted a whole number of milli");
  EXPECT_REX_ERROR(with({.step = 0}), "simulated walk: step: found 0 s");
  EXPECT_REX_ERROR(with({.startAbove = -1}),
                   "simulated walk: height above the ground at the start: found -1");
  EXPECT_REX_ERROR(with({.pushes = {{.time = NAN}}}), "simulated walk: time of a push: found nan s");
  EXPECT_REX_ERROR(with({.pushes = {{.time = -.01}}}), "time of a push: found -0.01 s, wanted 0 to 1.9 s");
  EXPECT_REX_ERROR(with({.pushes = {{.time = 1.95}}}), "time of a push: found 1.95 s, wanted 0 to 1.9 s");
  EXPECT_REX_ERROR(with({.pushes = {{.duration = 0}}}), "simulated walk: duration of a push: found 0");
  EXPECT_REX_ERROR(with({.pushes = {{.impulse_W = {0, NAN, 0}}}}),
                   "simulated walk: impulse of a push: number 1: found nan");
  EXPECT_REX_ERROR(groundForces(robot.model, {}, 0), "ground forces: step: found 0");
  const auto pushed = [&](const Vector3d& direction, double most, double resolution) {
    return largestPush(robot.model, robot.legs, plan, home, direction, 1, most, resolution);
  };
  EXPECT_REX_ERROR(pushed({0, 0, 0}, 1, 1), "largest push: direction: found 0");
  EXPECT_REX_ERROR(pushed({1, 0, 0}, 0, 1), "largest push: most: found 0");
  EXPECT_REX_ERROR(pushed({1, 0, 0}, 1, 0), "largest push: resolution: found 0");

  const auto controller = [&](const VectorXd& q, const WalkControlOptions& options) {
    return WalkController(robot.model, robot.legs, plan, q, options);
  };
  EXPECT_REX_ERROR(controller(VectorXd::Zero(3), {}), "walk controller: home: found a vector of size 3");
  EXPECT_REX_ERROR(controller(home * NAN, {}), "walk controller: home: number 0: found nan");
  EXPECT_REX_ERROR(controller(home, {.lift = 0}), "walk controller: lift: found 0");
  EXPECT_REX_ERROR(controller(home, {.captureGain = 0}),
                   "walk controller: gain of the capture point: found 0");
}

}  // namespace rex::simulated_walk_test
