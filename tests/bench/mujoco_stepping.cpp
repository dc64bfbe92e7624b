#include <memory>
#include <stdexcept>

#include <mujoco/mujoco.h>

#include "bench/mujoco_model.h"
#include "bench/stepping_peer.h"
#include "dynamics/stepper.h"

namespace rex::bench {
namespace {

struct DataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

struct Simulation {
  Simulation(const Robot& robot, PeerStep kind) : model(loadMujoco(mujocoXml(robot.model))) {
    model->opt.integrator = kind == PeerStep::kRungeKutta4 ? mjINT_RK4 : mjINT_EULER;
    model->opt.timestep = kStep;
    model->opt.disableflags |= mjDSBL_CONTACT;
    data.reset(mj_makeData(model.get()));
    start = robot.Q.col(0);
    reset();
  }
  void reset() {
    mj_resetData(model.get(), data.get());
    Eigen::Map<Eigen::VectorXd>(data->qpos, model->nq) = start;
  }
  // An arm without friction swings ever faster under Euler's steps: it begins anew after a second.
  void step() {
    if (data->time > 1) reset();
    mj_step(model.get(), data.get());
  }

  Eigen::VectorXd start;
  MujocoModel model;
  std::unique_ptr<mjData, DataDeleter> data;
};

// After a tenth of a second. A chain's joints stand in the same order on both sides.
void requireSameMotion(const Robot& robot, Simulation& mujoco) {
  Stepper stepper(robot.model);
  State state{robot.Q.col(0), Eigen::VectorXd::Zero(robot.model.nv())};
  for (int i = 0; i < 100; ++i) {
    stepper.step(state, Eigen::VectorXd::Zero(robot.model.nv()), kStep);
    mujoco.step();
  }
  const Eigen::Map<const Eigen::VectorXd> q(mujoco.data->qpos, mujoco.model->nq);
  if (!((q - state.q).cwiseAbs().maxCoeff() < 1e-10))
    throw std::logic_error(robot.name + ": MuJoCo moves otherwise than ours");
}

}  // namespace

std::function<void()> mujocoStep(const Robot& robot, PeerStep kind) {
  const auto mujoco = std::make_shared<Simulation>(robot, kind);
  if (kind == PeerStep::kRungeKutta4) requireSameMotion(robot, *mujoco);
  return [mujoco] { mujoco->step(); };
}

}  // namespace rex::bench
