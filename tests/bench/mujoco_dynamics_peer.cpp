#include <memory>
#include <stdexcept>

#include <mujoco/mujoco.h>

#include "bench/dynamics_peer.h"
#include "bench/mujoco_model.h"
#include "control/robot_steps.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/forward_dynamics.h"

namespace rex::bench {
namespace {

struct DataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

// Only the calls that lead to the result: mj_forward would also look for contacts, cameras and tendons.
struct Simulation {
  explicit Simulation(const MovingRobot& robot)
      : model(loadMujoco(mujocoXml(robot.model))), data(mj_makeData(model.get())), result(model->nv) {
    Q.resize(model->nq, Robot::kPostures);
    V = A = U = Eigen::MatrixXd(model->nv, Robot::kPostures);
    for (const Joint& joint : robot.model.joints()) {
      const int id = mj_name2id(model.get(), mjOBJ_JOINT, joint.name.c_str());
      const int column = model->jnt_dofadr[id];
      Q.row(model->jnt_qposadr[id]) = robot.Q.row(joint.qIndex);
      V.row(column) = robot.V.row(joint.vIndex);
      A.row(column) = robot.A.row(joint.vIndex);
      U.row(column) = robot.U.row(joint.vIndex);
      columns.push_back(column);
    }
    model->opt.timestep = kStepSeconds;
    byState.resize(2 * model->nv, 2 * model->nv);
  }

  void setState(int k) {
    Eigen::Map<Eigen::VectorXd>(data->qpos, Q.rows()) = Q.col(k);
    Eigen::Map<Eigen::VectorXd>(data->qvel, V.rows()) = V.col(k);
  }
  void inverseDynamics(int k) {
    setState(k);
    Eigen::Map<Eigen::VectorXd>(data->qacc, A.rows()) = A.col(k);
    mj_kinematics(model.get(), data.get());
    mj_comPos(model.get(), data.get());
    mj_comVel(model.get(), data.get());
    mj_rne(model.get(), data.get(), 1, result.data());
  }
  void massMatrix(int k) {
    setState(k);
    mj_kinematics(model.get(), data.get());
    mj_comPos(model.get(), data.get());
    mj_crb(model.get(), data.get());
  }
  void forwardDynamics(int k) {
    massMatrix(k);
    mj_factorM(model.get(), data.get());
    mj_comVel(model.get(), data.get());
    mj_rne(model.get(), data.get(), 0, data->qfrc_bias);
    bias = Eigen::Map<Eigen::VectorXd>(data->qfrc_bias, U.rows());
    bias = U.col(k) - bias;
    mj_solveM(model.get(), data.get(), result.data(), bias.data(), 1);
  }

  // Of (q, v) after a step, by (q, v) before; differences to one side cost half.
  void stepDerivatives(int k, bool isCentral) {
    setState(k);
    Eigen::Map<Eigen::VectorXd>(data->qfrc_applied, U.rows()) = U.col(k);
    mjd_transitionFD(model.get(), data.get(), 1e-6, isCentral, byState.data(), nullptr, nullptr, nullptr);
  }

  MujocoModel model;
  std::unique_ptr<mjData, DataDeleter> data;
  Eigen::MatrixXd Q, V, A, U;  // the states in MuJoCo's order
  Eigen::VectorXd bias, result;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> byState;
  std::vector<int> columns;  // theirs, for each of ours
};

void requireAgreement(const std::string& what, const Eigen::VectorXd& ours, const Eigen::VectorXd& theirs,
                      double tolerance = 1e-9) {
  if ((ours - theirs).lpNorm<Eigen::Infinity>() <= tolerance * ours.lpNorm<Eigen::Infinity>()) return;
  throw std::logic_error(what + " differ from ours");
}

void requireSameResults(const MovingRobot& robot, Simulation& mujoco, int k) {
  mujoco.inverseDynamics(k);
  requireAgreement(robot.name + ": MuJoCo forces",
                   inverseDynamics(robot.model, robot.Q.col(k), robot.V.col(k), robot.A.col(k)),
                   mujoco.result(mujoco.columns));
  mujoco.massMatrix(k);
  Eigen::MatrixXd M(robot.model.nv(), robot.model.nv());  // symmetric: rows or columns first is the same
  mj_fullM(mujoco.model.get(), M.data(), mujoco.data->qM);
  requireAgreement(robot.name + ": MuJoCo mass matrix", massMatrix(robot.model, robot.Q.col(k)).reshaped(),
                   M(mujoco.columns, mujoco.columns).reshaped());
  mujoco.forwardDynamics(k);
  requireAgreement(robot.name + ": MuJoCo accelerations",
                   forwardDynamics(robot.model, robot.Q.col(k), robot.V.col(k), robot.U.col(k)),
                   mujoco.result(mujoco.columns));
  mujoco.stepDerivatives(k, true);
  std::vector<int> both = mujoco.columns;
  for (const int column : mujoco.columns) both.push_back(column + robot.model.nv());
  const MotionJacobians step =
      RobotSteps(robot.model, kStepSeconds).derivative(robot.state(k), robot.U.col(k));
  requireAgreement(robot.name + ": MuJoCo derivatives of a step", step.A.reshaped(),
                   Eigen::MatrixXd(mujoco.byState(both, both)).reshaped(), 1e-6);
}

}  // namespace

DynamicsPeer mujocoDynamicsPeer(const MovingRobot& robot) {
  const auto mujoco = std::make_shared<Simulation>(robot);
  for (int k = 0; k < Robot::kPostures; ++k) requireSameResults(robot, *mujoco, k);
  return {.inverseDynamics = [mujoco](int k) { mujoco->inverseDynamics(k); },
          .massMatrix = [mujoco](int k) { mujoco->massMatrix(k); },
          .forwardDynamics = [mujoco](int k) { mujoco->forwardDynamics(k); },
          .stepDerivatives = [mujoco](int k) { mujoco->stepDerivatives(k, false); }};
}

}  // namespace rex::bench
