#include "locomotion/walk_controller.h"

#include <cmath>

#include "locomotion/humanoid.h"

namespace rex::walk_controller_test {

using Eigen::Vector2d;

constexpr double kHeight = .8, kGain = 3;

struct Standing {
  Humanoid robot{};
  WalkPlan plan{.footsteps = straightFootsteps(2, .2, .19)};
  double omega = InvertedPendulum{.height = kHeight}.omega();

  // What the controller does on both feet if the whole robot moves with v, m/s.
  [[nodiscard]] WalkControl movingWith(const Vector2d& v) const {
    State state = initialState(robot.model);
    state.q = robot.home(plan);
    state.v[robot.model[robot.model[robot.legs.trunk].joint].vIndex] = v.x();
    state.v[robot.model[robot.model[robot.legs.trunk].joint].vIndex + 1] = v.y();
    WalkController controller(robot.model, robot.legs, plan, state.q, {.captureGain = kGain});
    return controller.control(state, {200, 200});
  }
};

// By hand: the capture point of a robot that moves with v is v / omega ahead, and p = p_ref + (1 + k / omega)
// (xi - xi_ref).
TEST(WalkController, AnswersTheCapturePointByTheZeroMomentPoint) {
  const Standing standing;
  const WalkControl rest = standing.movingWith({0, 0});
  EXPECT_EQ(rest.forces.status, QuadraticStatus::kOptimal);
  EXPECT_LT(rest.captureError.norm(), .005);
  for (const Vector2d& v : {Vector2d(.1, 0), Vector2d(-.05, .12)}) {
    const WalkControl now = standing.movingWith(v);
    const Vector2d ahead = now.captureError - rest.captureError;
    EXPECT_LT((ahead - v / standing.omega).norm(), 1e-9);
    EXPECT_LT((now.plannedZmp - rest.plannedZmp).norm(), 1e-12);
    EXPECT_LT((now.zmp - rest.zmp - (1 + kGain / standing.omega) * ahead).norm(), 1e-9);
  }
}

// No ground reaction acts beyond the soles, 0.24 m long: the demand ends a centimetre before their toes.
TEST(WalkController, KeepsTheZeroMomentPointWithinTheSoles) {
  const Standing standing;
  const WalkControl now = standing.movingWith({3, 0});
  EXPECT_NEAR(now.zmp.x(), standing.plan.footsteps[0].p.x() + standing.plan.sole.length / 2 - .01, 1e-3);
  EXPECT_LT(std::abs(now.zmp.y()), .01);
}

}  // namespace rex::walk_controller_test
