#include "grasping/contact.h"

#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

template <class AnyContact>
void requireAny(const AnyContact& contact) {
  requireFinite("contact: position", contact.p_OC);
  requireFinite("contact: normal", contact.normal_O);
  requireNotNegative("contact: friction", contact.friction);
  const double length = contact.normal_O.norm();
  if (std::abs(length - 1) > 1e-6)
    throw Error({.what = "contact: length of the normal", .found = fmt::format("{}", length), .wanted = "1"});
}

}  // namespace

void requireValid(const Contact& contact) { requireAny(contact); }
void requireValid(const PlanarContact& contact) { requireAny(contact); }

Eigen::Matrix3d contactFrame(const Contact& contact) {
  const Eigen::Vector3d n = contact.normal_O.normalized();
  int across = 0;
  n.cwiseAbs().minCoeff(&across);
  const Eigen::Vector3d tangent = n.cross(Eigen::Vector3d::Unit(across)).normalized();
  Eigen::Matrix3d R_OC;
  R_OC << n, tangent, n.cross(tangent);
  return R_OC;
}

Eigen::Matrix2d contactFrame(const PlanarContact& contact) {
  const Eigen::Vector2d n = contact.normal_O.normalized();
  Eigen::Matrix2d R_OC;
  R_OC << n, Eigen::Vector2d(-n.y(), n.x());
  return R_OC;
}

}  // namespace rex
