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
  explicit Simulation(const Robot& robot) : model(loadMujoco(mujocoXml(robot.model))) {
    model->opt.integrator = mjINT_RK4;
    model->opt.timestep = kStep;
    model->opt.disableflags |= mjDSBL_CONTACT;
    data.reset(mj_makeData(model.get()));
    Eigen::Map<Eigen::VectorXd>(data->qpos, model->nq) = robot.Q.col(0);
  }
  void step() { mj_step(model.get(), data.get()); }

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

std::function<void()> mujocoStep(const Robot& robot) {
  const auto mujoco = std::make_shared<Simulation>(robot);
  requireSameMotion(robot, *mujoco);
  return [mujoco] { mujoco->step(); };
}

}  // namespace rex::bench
