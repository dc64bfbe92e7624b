#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/sin_cos.h"
#include "dynamics/forward_dynamics.h"
#include "dynamics/held_motion_internal.h"
#include "geometry/rotation.h"
#include "scene/coordinates.h"

namespace rex::internal {
namespace {

// m/s, or rad/s at one metre from the axis. Nothing moves faster, so any larger value is a numerical failure
// and would soon overflow.
constexpr double kSpeedOfLight = 299792458;

// Visits the parts of q and v that lie between quaternions: from, to, and how many numbers.
template <class Visit>
void forEachPlainPart(const std::vector<HeldMotion::QuaternionPlace>& quaternions, Eigen::Index nv,
                      const Visit& visit) {
  Eigen::Index iq = 0, iv = 0;
  for (const HeldMotion::QuaternionPlace& at : quaternions) {
    visit(iq, iv, at.vIndex - iv);
    iq = at.qIndex + 4;
    iv = at.vIndex + 3;
  }
  visit(iq, iv, nv - iv);
}

Quaternion turnBy(const Eigen::Vector3d& rotationVector) {
  const double angle = rotationVector.norm();
  const SinCos<double> half = sinCos(angle / 2);
  Quaternion turn;
  turn << half.cosine, (angle > 0 ? half.sine / angle : 0.5) * rotationVector;
  return turn;
}

}  // namespace

HeldMotion::HeldMotion(const Model& model, const Eigen::Vector3d& gravity_W, const JointForces& jointForces)
    : model_(model),
      gravity_W_(gravity_W),
      jointForces_(jointForces),
      u_(Eigen::VectorXd::Zero(model.nv())),
      forces_(Eigen::VectorXd::Zero(model.nv())),
      added_(Eigen::VectorXd::Zero(model.nv())) {
  forEachQuaternion(model, [&](int iq, int iv) { quaternions_.push_back({iq, iv}); });
}

void HeldMotion::hold(const VectorArg& u, double time) {
  u_ = u;
  time_ = time;
}

void HeldMotion::accelerate(const Eigen::VectorXd& q, const Eigen::VectorXd& v, Eigen::VectorXd& a) {
  requireBounded(q, v);
  forces_ = u_;
  if (jointForces_.any()) {
    jointForces(model_, q, v, jointForces_, added_);
    forces_ += added_;
  }
  if (!wrenches_.empty()) {
    forwardKinematics(model_, q, workspace_.poses);
    wrenchForces(model_, workspace_.poses, wrenches_, workspace_, added_);
    forces_ += added_;
  }
  forwardDynamics(model_, q, v, forces_, gravity_W_, workspace_, a);
}

void HeldMotion::rate(const Eigen::VectorXd& q, const Eigen::VectorXd& v, Eigen::VectorXd& dq) const {
  forEachPlainPart(quaternions_, v.size(), [&](Eigen::Index iq, Eigen::Index iv, Eigen::Index count) {
    dq.segment(iq, count) = v.segment(iv, count);
  });
  for (const QuaternionPlace& at : quaternions_) {
    Quaternion w;
    w << 0, v.segment<3>(at.vIndex);
    dq.segment<4>(at.qIndex) = 0.5 * quaternionProduct(q.segment<4>(at.qIndex), w);
  }
}

void HeldMotion::move(Eigen::VectorXd& q, const Eigen::VectorXd& d) const {
  forEachPlainPart(quaternions_, d.size(), [&](Eigen::Index iq, Eigen::Index iv, Eigen::Index count) {
    q.segment(iq, count) += d.segment(iv, count);
  });
  for (const QuaternionPlace& at : quaternions_) {
    q.segment<4>(at.qIndex) = quaternionProduct(q.segment<4>(at.qIndex), turnBy(d.segment<3>(at.vIndex)));
  }
  normalize(q);
}

void HeldMotion::normalize(Eigen::VectorXd& q) const {
  for (const QuaternionPlace& at : quaternions_) q.segment<4>(at.qIndex).normalize();
}

void HeldMotion::requireBounded(const Eigen::VectorXd& q, const Eigen::VectorXd& v) const {
  const auto fail = [&](const std::string& joint, const char* what, double value) {
    throw Error({.what = fmt::format("joint '{}': its motion grows without bounds at {:g} s", joint, time_),
                 .found = fmt::format("a {} of {:g}", what, value),
                 .wanted = "less than the speed of light: take shorter steps or smaller forces"});
  };
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (!(std::abs(v[i]) < kSpeedOfLight)) fail(jointOfVelocity(model_, i).name, "velocity", v[i]);
  for (Eigen::Index i = 0; i < q.size(); ++i)
    if (!std::isfinite(q[i])) fail(jointOfPosition(model_, i).name, "position", q[i]);
}

}  // namespace rex::internal
