#include <algorithm>
#include <cmath>
#include <memory>

#include "bench/row.h"
#include "bench/stepping_peer.h"
#include "dynamics/energy.h"
#include "dynamics/stepper.h"
#include "support/planar_chain.h"

namespace rex::bench {
namespace {

struct Simulation {
  Simulation(const Robot& robot, Integrator integrator)
      : stepper(robot.model, {.integrator = integrator}),
        state{robot.Q.col(0), Eigen::VectorXd::Zero(robot.model.nv())},
        u(Eigen::VectorXd::Zero(robot.model.nv())) {}
  void step() { stepper.step(state, u, kStep); }

  Stepper stepper;
  State state;
  Eigen::VectorXd u;
};

Measurement timedSteps(const Robot& robot, Integrator integrator) {
  return timed([simulation = std::make_shared<Simulation>(robot, integrator)] { simulation->step(); });
}

// The largest change of energy of three links that swing freely for ten seconds, as a share of what they
// could have.
double drift(Integrator integrator) {
  const Model model = compile(swingScene());
  Stepper stepper(model, {.integrator = integrator});
  State state = initialState(model);
  double most = 0;
  for (int i = 0; i < 10000; ++i) {
    stepper.step(state, Eigen::Vector3d::Zero(), kStep);
    most = std::max(most, std::abs(energy(model, state.q, state.v).total()));
  }
  return most / PlanarChain::kEnergyScale;
}

Row driftRow(const std::string& name, Integrator integrator, double limit) {
  return {.name = name,
          .ours = [=] { return drift(integrator); },
          .peerName = "limit",
          .peer = [=] { return limit; },
          .target = 1,
          .unit = "%",
          .repetitions = 1};
}

}  // namespace

std::vector<Row> steppingRows() {
  const std::vector<Robot> all = robots();
  const Robot& arm = all.front();
  const auto mujoco = [&](PeerStep kind) {
    const std::function<void()> step = mujocoStep(arm, kind);
    return step ? timed(step) : Measurement();
  };
  return {
      {"step-rk4-arm7", timedSteps(arm, Integrator::kRungeKutta4), "MuJoCo RK4",
       mujoco(PeerStep::kRungeKutta4), 1. / 3},
      {"step-beeman-arm7", timedSteps(arm, Integrator::kBeeman), "MuJoCo Euler", mujoco(PeerStep::kEuler)},
      driftRow("drift-rk4-swing", Integrator::kRungeKutta4, 5.4e-8),
      driftRow("drift-beeman-swing", Integrator::kBeeman, 2e-5)};
}

}  // namespace rex::bench
