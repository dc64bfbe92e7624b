#include <memory>

#include "base/rng.h"
#include "bench/dynamics_peer.h"
#include "bench/row.h"
#include "control/robot_steps.h"
#include "dynamics/dynamics_batch.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/forward_dynamics.h"

namespace rex::bench {
namespace {

// Ours, with the storage a hot loop keeps.
struct Workspace {
  explicit Workspace(MovingRobot r)
      : robot(std::move(r)),
        steps(robot.model, kStepSeconds),
        M(robot.model.nv(), robot.model.nv()),
        result(robot.model.nv()),
        results(robot.model.nv(), Robot::kPostures) {}

  void inverseDynamics(int k) {
    rex::inverseDynamics(robot.model, robot.Q.col(k), robot.V.col(k), robot.A.col(k), gravity_W, memory,
                         result);
  }
  void forwardDynamics(int k) {
    rex::forwardDynamics(robot.model, robot.Q.col(k), robot.V.col(k), robot.U.col(k), gravity_W, memory,
                         result);
  }
  void massMatrix(int k) { rex::massMatrix(robot.model, robot.Q.col(k), memory, M); }
  void inverseDynamicsDerivatives(int k) {
    rex::inverseDynamicsDerivatives(robot.model, robot.Q.col(k), robot.V.col(k), robot.A.col(k), gravity_W,
                                    memory, derivatives);
  }
  void stepDerivatives(int k) { (void)steps.derivative(robot.state(k), robot.U.col(k)); }
  void inverseDynamicsBatch() {
    rex::inverseDynamicsBatch(robot.model, robot.Q, robot.V, robot.A, gravity_W, memory, results);
  }
  void forwardDynamicsBatch() {
    rex::forwardDynamicsBatch(robot.model, robot.Q, robot.V, robot.U, gravity_W, memory, results);
  }

  MovingRobot robot;
  RobotSteps steps;
  Eigen::Vector3d gravity_W = earthGravity();
  DynamicsWorkspace memory;
  Eigen::MatrixXd M;
  Eigen::VectorXd result;
  Eigen::MatrixXd results;
  InverseDynamicsDerivatives derivatives;
};
using Ours = std::shared_ptr<Workspace>;

void addInverseDynamics(const Ours& ours, const DynamicsPeer& mujoco, std::vector<Row>& rows) {
  const auto theirs = timedInTurn(mujoco.inverseDynamics);
  const std::string on = "-" + ours->robot.name;
  rows.push_back(
      {"rnea" + on, timedInTurn([ours](int k) { ours->inverseDynamics(k); }), "MuJoCo", theirs, 0.3});
  rows.push_back(
      {"rnea-batch" + on, timedPerPosture([ours] { ours->inverseDynamicsBatch(); }), "MuJoCo", theirs, 0.08});
}

void addMassMatrix(const Ours& ours, const DynamicsPeer& mujoco, std::vector<Row>& rows) {
  rows.push_back({"crba-" + ours->robot.name, timedInTurn([ours](int k) { ours->massMatrix(k); }), "MuJoCo",
                  timedInTurn(mujoco.massMatrix), ours->robot.name == "man" ? 0.3 : 0.4});
}

void addForwardDynamics(const Ours& ours, const DynamicsPeer& mujoco, std::vector<Row>& rows) {
  const auto theirs = timedInTurn(mujoco.forwardDynamics);
  const std::string on = "-" + ours->robot.name;
  rows.push_back({"forward-dynamics" + on, timedInTurn([ours](int k) { ours->forwardDynamics(k); }), "MuJoCo",
                  theirs, 0.5});
  rows.push_back({"forward-dynamics-batch" + on, timedPerPosture([ours] { ours->forwardDynamicsBatch(); }),
                  "MuJoCo", theirs, 0.14});
}

// Those of inverse dynamics against inverse dynamics alone; those of a step against MuJoCo's differences,
// which are not asked for derivatives by forces.
void addDerivatives(const Ours& ours, const DynamicsPeer& mujoco, std::vector<Row>& rows) {
  const std::string on = "-" + ours->robot.name;
  rows.push_back({"rnea-derivatives" + on,
                  timedInTurn([ours](int k) { ours->inverseDynamicsDerivatives(k); }), "rnea" + on,
                  timedInTurn([ours](int k) { ours->inverseDynamics(k); }),
                  ours->robot.name == "man" ? 6. : 4.});
  rows.push_back({"step-derivatives" + on, timedInTurn([ours](int k) { ours->stepDerivatives(k); }), "MuJoCo",
                  timedInTurn(mujoco.stepDerivatives), 0.3});
}

}  // namespace

std::vector<MovingRobot> movingRobots() {
  Rng rng(2);
  std::vector<MovingRobot> all;
  for (Robot& robot : robots()) {
    const int nv = robot.model.nv();
    const auto columns = [&] {
      return Eigen::MatrixXd::NullaryExpr(nv, Robot::kPostures, [&] { return rng.normal(); });
    };
    all.push_back({std::move(robot), columns(), columns(), columns()});
  }
  return all;
}

std::vector<Row> dynamicsRows() {
  std::vector<Row> rows;
  for (MovingRobot& robot : movingRobots()) {
    const DynamicsPeer mujoco = mujocoDynamicsPeer(robot);
    const Ours ours = std::make_shared<Workspace>(std::move(robot));
    addInverseDynamics(ours, mujoco, rows);
    addMassMatrix(ours, mujoco, rows);
    addForwardDynamics(ours, mujoco, rows);
    addDerivatives(ours, mujoco, rows);
  }
  return rows;
}

}  // namespace rex::bench
