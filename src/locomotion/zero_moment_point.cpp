#include "locomotion/zero_moment_point.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/require.h"
#include "dynamics/centroidal.h"
#include "kinematics/center_of_mass.h"

namespace rex {
namespace {

using Eigen::Vector2d;

void requireFiniteMotion(const CenterMotion& at) {
  requireFinite("inverted pendulum: position c", at.c);
  requireFinite("inverted pendulum: velocity v", at.v);
}

}  // namespace

double InvertedPendulum::omega() const {
  requirePositive("inverted pendulum: height", height);
  requirePositive("inverted pendulum: g", g);
  return std::sqrt(g / height);
}

Vector2d InvertedPendulum::acceleration(const Vector2d& c, const Vector2d& p) const {
  requireFinite("inverted pendulum: position c", c);
  requireFinite("inverted pendulum: zero moment point p", p);
  return omega() * omega() * (c - p);
}

Vector2d InvertedPendulum::zmp(const Vector2d& c, const Vector2d& acceleration) const {
  requireFinite("inverted pendulum: position c", c);
  requireFinite("inverted pendulum: acceleration", acceleration);
  return c - acceleration / (omega() * omega());
}

CenterMotion InvertedPendulum::after(const CenterMotion& start, const Vector2d& p, double t) const {
  requireFiniteMotion(start);
  requireFinite("inverted pendulum: zero moment point p", p);
  requireFinite("inverted pendulum: time t", t);
  const double w = omega();
  // The growing and the decaying part: cosh and sinh lose the small one in the large one.
  const Vector2d grows = (start.c - p + start.v / w) / 2, decays = (start.c - p - start.v / w) / 2;
  const double up = std::exp(w * t), down = std::exp(-w * t);
  return {.c = p + up * grows + down * decays, .v = w * (up * grows - down * decays)};
}

Vector2d InvertedPendulum::capturePoint(const CenterMotion& at) const {
  requireFiniteMotion(at);
  return at.c + at.v / omega();
}

Vector2d InvertedPendulum::orbitalEnergy(const CenterMotion& at, const Vector2d& p) const {
  requireFiniteMotion(at);
  requireFinite("inverted pendulum: zero moment point p", p);
  return (at.v.array().square() - omega() * omega() * (at.c - p).array().square()) / 2;
}

namespace {

using Eigen::Vector3d;

// From force and torque about the origin of W. `scale` is the size of the forces: next to it, an upward force
// of 1e-12 is rounding.
ZeroMomentPoint zmpOf(const Vector3d& force, const Vector3d& torque, double groundHeight, double scale) {
  ZeroMomentPoint zmp{.force_W = force};
  if (!(force.z() > 1e-12 * scale)) {
    zmp.message =
        fmt::format("no zero moment point: the ground would have to push upwards with {:.6g} N", force.z());
    return zmp;
  }
  zmp.exists = true;
  zmp.p_W = {(groundHeight * force.x() - torque.y()) / force.z(),
             (groundHeight * force.y() + torque.x()) / force.z(), groundHeight};
  zmp.moment = torque.z() - zmp.p_W.cross(force).z();
  return zmp;
}

}  // namespace

ZeroMomentPoint zmpOfMotion(const Model& model, const VectorArg& q, const VectorArg& v, const VectorArg& a,
                            double groundHeight, const Vector3d& gravity_W) {
  requireFinite("zero moment point: ground height", groundHeight);
  requireFinite("zero moment point: joint positions q", q);
  requireFinite("zero moment point: joint velocities v", v);
  requireFinite("zero moment point: joint accelerations a", a);
  requireFinite("zero moment point: gravity", gravity_W);
  const BodyPoses poses = forwardKinematics(model, q);
  const Vector3d center = centerOfMass(model, poses), weight = model.mass() * gravity_W;
  const MomentumRate rate = momentumRate(model, poses, v, a);
  return zmpOf(rate.force - weight, rate.torque - center.cross(weight), groundHeight, weight.norm());
}

ZeroMomentPoint zmpOfContacts(std::span<const ContactForce> contacts, double groundHeight) {
  requireFinite("zero moment point: ground height", groundHeight);
  Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();
  double scale = 0;
  for (const ContactForce& contact : contacts) {
    requireFinite("zero moment point: position of a contact", contact.p_WC);
    requireFinite("zero moment point: force of a contact", contact.force_W);
    force += contact.force_W;
    torque += contact.p_WC.cross(contact.force_W);
    scale += contact.force_W.norm();
  }
  return zmpOf(force, torque, groundHeight, scale);
}

SupportMargin staticStability(const Model& model, const VectorArg& q, const SupportPolygon& support,
                              double wantedMargin) {
  const Vector3d center = centerOfMass(model, forwardKinematics(model, q));
  return supportMargin(support, center.head<2>(), wantedMargin);
}

}  // namespace rex
