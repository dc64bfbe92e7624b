#include "scene/state.h"

#include <fmt/format.h>

#include "base/error.h"
#include "geometry/rotation.h"

namespace rex {

State initialState(const Model& model) {
  return {model.initialPositions(), Eigen::VectorXd::Zero(model.nv()), 0};
}

Eigen::VectorXd integrate(const Model& model, const VectorArg& q, const VectorArg& v) {
  requireSize("joint positions q", q.size(), model.nq());
  requireSize("joint velocities v", v.size(), model.nv());
  Eigen::VectorXd next = q;
  forEachPlainCoordinate(model, [&](int iq, int iv, const DegreeOfFreedom&) { next[iq] += v[iv]; });
  forEachQuaternion(model, [&](int iq, int iv) {
    const Quaternion before = q.segment<4>(iq);
    const Quaternion turn = quaternionFromRotation(expSO3(v.segment<3>(iv)));
    next.segment<4>(iq) = quaternionProduct(before.normalized(), turn).normalized();
  });
  return next;
}

Eigen::VectorXd difference(const Model& model, const VectorArg& q0, const VectorArg& q1) {
  requireSize("joint positions q0", q0.size(), model.nq());
  requireSize("joint positions q1", q1.size(), model.nq());
  Eigen::VectorXd v(model.nv());
  forEachPlainCoordinate(model, [&](int iq, int iv, const DegreeOfFreedom&) { v[iv] = q1[iq] - q0[iq]; });
  forEachQuaternion(model, [&](int iq, int iv) {
    const Eigen::Matrix3d R0 = rotationFromQuaternion(q0.segment<4>(iq));
    const Eigen::Matrix3d R1 = rotationFromQuaternion(q1.segment<4>(iq));
    v.segment<3>(iv) = logSO3(R0.transpose() * R1);
  });
  return v;
}

namespace {

std::vector<std::string> coordinateNames(const Model& model, int all, int Joint::*first, int Joint::*count) {
  std::vector<std::string> names(static_cast<std::size_t>(all));
  for (const Joint& joint : model.joints())
    for (int i = 0; i < joint.*count && !joint.mimics; ++i)
      names[static_cast<std::size_t>(joint.*first + i)] =
          joint.name + (joint.*count > 1 ? fmt::format(" [{}]", i) : "");
  return names;
}

}  // namespace

std::vector<std::string> positionNames(const Model& model) {
  return coordinateNames(model, model.nq(), &Joint::qIndex, &Joint::nq);
}

std::vector<std::string> velocityNames(const Model& model) {
  return coordinateNames(model, model.nv(), &Joint::vIndex, &Joint::nv);
}

}  // namespace rex
