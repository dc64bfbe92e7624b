#include "course/clearances.h"

#include <limits>

#include "collision/contacts.h"
#include "course/simulator.h"
#include "kinematics/forward_kinematics.h"
#include "scene/model.h"

namespace rex {

Clearances clearances(const Simulator& simulator) {
  const Model& model = simulator.model();
  const ContactModel contacts(model);
  const BodyPoses poses = forwardKinematics(model, simulator.getJointAngles());
  const std::vector<Proxy> all = proxies(contacts, poses, std::numeric_limits<double>::infinity());
  const auto pairs = static_cast<Eigen::Index>(all.size());
  Clearances result{Eigen::VectorXd(pairs), Eigen::MatrixXd(pairs, model.nv())};
  for (Eigen::Index i = 0; i < pairs; ++i) {
    const Proxy& proxy = all[static_cast<std::size_t>(i)];
    result.y[i] = proxy.proximity.distance;
    result.J.row(i) = distanceJacobian(model, poses, proxy, contacts);
  }
  return result;
}

}  // namespace rex
