#include <memory>
#include <stdexcept>

#include "bench/kinematics_peer.h"
#include "bench/row.h"
#include "kinematics/jacobians.h"

namespace rex::bench {
namespace {

// Ours, with the storage a hot loop keeps.
struct Workspace {
  explicit Workspace(Robot r) : robot(std::move(r)), J(6, robot.model.nv()) {}

  void forwardKinematics(int k) { rex::forwardKinematics(robot.model, robot.Q.col(k), poses); }
  void jacobian(int k) {
    forwardKinematics(k);
    poseJacobian(robot.model, poses, robot.tip, Eigen::Vector3d::Zero(), J);
  }
  void forwardKinematicsBatch() { rex::forwardKinematicsBatch(robot.model, robot.Q, poseBatch); }
  void jacobianBatch() {
    forwardKinematicsBatch();
    positionJacobianBatch(robot.model, poseBatch, robot.tip, Eigen::Vector3d::Zero(), jacobians);
    angularJacobianBatch(robot.model, poseBatch, robot.tip, angularJacobians);
  }

  Robot robot;
  BodyPoses poses;
  PoseBatch poseBatch;
  JacobianBatch jacobians, angularJacobians;
  Matrix6Xd J;
};

}  // namespace

void requireAgreement(const std::string& what, const Eigen::MatrixXd& ours, const Eigen::MatrixXd& theirs) {
  if (ours.rows() == theirs.rows() && ours.cols() == theirs.cols() &&
      (ours - theirs).cwiseAbs().maxCoeff() < 1e-10)
    return;
  throw std::logic_error(what + " differ from ours");
}

std::vector<Row> kinematicsRows() {
  std::vector<Row> rows;
  for (Robot& robot : robots()) {
    const KinematicsPeer kdl = kdlPeer(robot);
    const auto ours = std::make_shared<Workspace>(std::move(robot));
    const auto fk = timedInTurn([ours](int k) { ours->forwardKinematics(k); });
    const auto jacobian = timedInTurn([ours](int k) { ours->jacobian(k); });
    const auto fkBatch = timedPerPosture([ours] { ours->forwardKinematicsBatch(); });
    const auto jacobianBatch = timedPerPosture([ours] { ours->jacobianBatch(); });
    const std::string on = "-" + ours->robot.name;
    rows.push_back({"fk" + on, fk, "KDL", timedInTurn(kdl.forwardKinematics), 0.35});
    // Of the man, KDL computes one chain, and we place all bodies: no target.
    const std::optional<double> target = on == "-man" ? std::nullopt : std::optional(0.2);
    rows.push_back({"jacobian" + on, jacobian, "KDL", timedInTurn(kdl.jacobian), target});
    rows.push_back({"fk-batch" + on, fkBatch, "KDL", timedInTurn(kdl.forwardKinematics), 0.1});
    rows.push_back({"jacobian-batch" + on, jacobianBatch, "KDL", timedInTurn(kdl.jacobian)});
  }
  return rows;
}

}  // namespace rex::bench
