#include "collision/contacts.h"

#include <algorithm>

#include "base/require.h"
#include "kinematics/jacobians.h"

namespace rex {
namespace {

Eigen::Vector3d inBody(const Pose& X_WB, const Eigen::Vector3d& p_W) {
  return X_WB.R.transpose() * (p_W - X_WB.p);
}

// Adds weight times the derivative of the pair's distance to `row` (1 x nv); J is storage for 3 x nv numbers.
void addDistanceDerivative(const Model& model, const BodyPoses& poses, const Proxy& proxy,
                           const ContactModel& contacts, double weight, Eigen::Matrix3Xd& J,
                           Eigen::MatrixXd& row) {
  J.resize(3, model.nv());
  const Eigen::RowVector3d direction = weight * proxy.proximity.normal_W.transpose();
  const BodyId a = contacts.body(proxy.pair.a), b = contacts.body(proxy.pair.b);
  positionJacobian(model, poses, a, inBody(poses[a], proxy.proximity.p_WA), J);
  row.noalias() += direction * J;
  positionJacobian(model, poses, b, inBody(poses[b], proxy.proximity.p_WB), J);
  row.noalias() -= direction * J;
}

// NaN if the distance is NaN, because std::max then returns its first argument.
double costOf(const Proxy& proxy, double margin) {
  return std::max(1 - proxy.proximity.distance / margin, 0.);
}

}  // namespace

Eigen::RowVectorXd distanceJacobian(const Model& model, const BodyPoses& poses, const Proxy& proxy,
                                    const ContactModel& contacts) {
  Eigen::MatrixXd row = Eigen::MatrixXd::Zero(1, model.nv());
  Eigen::Matrix3Xd J;
  addDistanceDerivative(model, poses, proxy, contacts, 1, J, row);
  return row;
}

double contactCost(const ContactModel& contacts, const BodyPoses& poses, double margin) {
  requirePositive("margin of contact costs", margin, kMetres);
  double cost = 0;
  for (const Proxy& proxy : proxies(contacts, poses, margin)) cost += costOf(proxy, margin);
  return cost;
}

TaskMap contactTask(ContactModel contacts, double margin) {
  requirePositive("margin of contact costs", margin, kMetres);
  return [contacts = std::move(contacts), margin, storage = ProxyStorage(), J = Eigen::Matrix3Xd()](
             const Posture& at, TaskValue& value) mutable {
    value.y.setZero(1);
    value.J.setZero(1, at.model.nv());
    proxies(contacts, at.poses, margin, storage);
    for (const Proxy& proxy : storage.near) {
      value.y[0] += costOf(proxy, margin);
      addDistanceDerivative(at.model, at.poses, proxy, contacts, -1 / margin, J, value.J);
    }
  };
}

}  // namespace rex
