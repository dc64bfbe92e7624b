#include <algorithm>
#include <memory>

#include <mujoco/mujoco.h>

#include "bench/kinematics_peer.h"
#include "bench/mujoco_model.h"
#include "kinematics/center_of_mass.h"
#include "kinematics/jacobians.h"

namespace rex::bench {
namespace {

// MuJoCo writes matrices by rows.
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct DataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

struct Simulation {
  explicit Simulation(const Robot& robot)
      : model(loadMujoco(mujocoXml(robot.model))), data(mj_makeData(model.get())) {
    J.setZero(3, model->nv);
    J_angular = J;
    tip = mj_name2id(model.get(), mjOBJ_BODY, robot.model[robot.tip].name.c_str());
    Q.resize(model->nq, Robot::kPostures);
    for (const Joint& joint : robot.model.joints()) {
      const int id = mj_name2id(model.get(), mjOBJ_JOINT, joint.name.c_str());
      Q.row(model->jnt_qposadr[id]) = robot.Q.row(joint.qIndex);
      columns.push_back(model->jnt_dofadr[id]);
    }
  }

  void forwardKinematics(int k) {
    std::copy_n(Q.col(k).data(), Q.rows(), data->qpos);
    mj_kinematics(model.get(), data.get());
  }
  void jacobian(int k) {
    forwardKinematics(k);
    mj_comPos(model.get(), data.get());
    mj_jac(model.get(), data.get(), J.data(), J_angular.data(), data->xpos + 3 * tip, tip);
  }
  void centerOfMassJacobian(int k) {
    forwardKinematics(k);
    mj_comPos(model.get(), data.get());
    mj_jacSubtreeCom(model.get(), data.get(), J.data(), 0);
  }

  MujocoModel model;
  std::unique_ptr<mjData, DataDeleter> data;
  Eigen::MatrixXd Q;  // the postures in MuJoCo's order
  RowMajor J, J_angular;
  int tip = 0;
  std::vector<int> columns;  // theirs, for each of ours
};

void requireSameResults(const Robot& robot, Simulation& mujoco, int k) {
  const BodyPoses poses = forwardKinematics(robot.model, robot.Q.col(k));
  mujoco.forwardKinematics(k);
  for (std::size_t i = 1; i < poses.X_WB.size(); ++i) {
    const int id = mj_name2id(mujoco.model.get(), mjOBJ_BODY, robot.model.bodies()[i].name.c_str());
    requireAgreement(robot.name + ": MuJoCo positions", poses.X_WB[i].p,
                     Eigen::Map<const Eigen::Vector3d>(mujoco.data->xpos + 3 * id));
    requireAgreement(robot.name + ": MuJoCo rotations", poses.X_WB[i].R,
                     Eigen::Map<const RowMajor>(mujoco.data->xmat + 9 * id, 3, 3));
  }
  mujoco.jacobian(k);
  requireAgreement(robot.name + ": MuJoCo Jacobian",
                   positionJacobian(robot.model, poses, robot.tip, Eigen::Vector3d::Zero()),
                   mujoco.J(Eigen::all, mujoco.columns));
  requireAgreement(robot.name + ": MuJoCo Jacobian of rotations",
                   angularJacobian(robot.model, poses, robot.tip),
                   mujoco.J_angular(Eigen::all, mujoco.columns));
  mujoco.centerOfMassJacobian(k);
  requireAgreement(robot.name + ": MuJoCo centre of mass", centerOfMass(robot.model, poses),
                   Eigen::Map<const Eigen::Vector3d>(mujoco.data->subtree_com));
  requireAgreement(robot.name + ": MuJoCo centre-of-mass Jacobian", centerOfMassJacobian(robot.model, poses),
                   mujoco.J(Eigen::all, mujoco.columns));
}

}  // namespace

KinematicsPeer mujocoPeer(const Robot& robot) {
  const auto mujoco = std::make_shared<Simulation>(robot);
  for (int k = 0; k < Robot::kPostures; ++k) requireSameResults(robot, *mujoco, k);
  return {.forwardKinematics = [mujoco](int k) { mujoco->forwardKinematics(k); },
          .jacobian = [mujoco](int k) { mujoco->jacobian(k); },
          .centerOfMassJacobian = [mujoco](int k) { mujoco->centerOfMassJacobian(k); }};
}

}  // namespace rex::bench
