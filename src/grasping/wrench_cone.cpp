#include "grasping/wrench_cone.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "grasping/wrench_cone_internal.h"

namespace rex {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

void requireReference(const WrenchReference& reference) {
  requireFinite("wrenches: reference point", reference.p_OR);
  requirePositive("wrenches: length", reference.length, kMetres);
}

VectorXd wrenchAt(const Eigen::Vector3d& p_OC, const Eigen::Vector3d& force,
                  const WrenchReference& reference) {
  VectorXd wrench(6);
  wrench << force, (p_OC - reference.p_OR).cross(force) / reference.length;
  return wrench;
}

VectorXd wrenchAt(const Eigen::Vector2d& p_OC, const Eigen::Vector2d& force,
                  const WrenchReference& reference) {
  const Eigen::Vector2d arm = p_OC - reference.p_OR.head<2>();
  return Eigen::Vector3d(force.x(), force.y(),
                         (arm.x() * force.y() - arm.y() * force.x()) / reference.length);
}

template <class AnyContact>
std::vector<WrenchCone> conesOf(std::span<const AnyContact> contacts, const WrenchReference& reference) {
  requireReference(reference);
  std::vector<WrenchCone> cones;
  for (const AnyContact& contact : contacts) {
    try {
      requireValid(contact);
    } catch (const Error& error) {
      ErrorParts parts = error.parts();
      parts.what = fmt::format("contact {}{}", cones.size(), parts.what.substr(std::size("contact") - 1));
      throw Error(parts);
    }
    const auto R_OC = contactFrame(contact);
    WrenchCone cone;
    cone.friction = contact.friction;
    cone.normal = wrenchAt(contact.p_OC, R_OC.col(0), reference);
    cone.tangents.resize(cone.normal.size(), R_OC.cols() - 1);
    for (Eigen::Index k = 0; k < cone.tangents.cols(); ++k)
      cone.tangents.col(k) = wrenchAt(contact.p_OC, R_OC.col(k + 1), reference);
    cones.push_back(std::move(cone));
  }
  return cones;
}

// One column per edge.
MatrixXd edgesOf(const WrenchCone& cone, int edges) {
  if (cone.friction == 0) return cone.normal;
  const bool isPlanar = cone.tangents.cols() == 1;
  MatrixXd tangential(cone.tangents.cols(), isPlanar ? 2 : edges);
  if (isPlanar) {
    tangential << cone.friction, -cone.friction;
  } else {
    const VectorXd angle = VectorXd::LinSpaced(edges, 0, edges - 1) * (2 * std::numbers::pi / edges);
    tangential << cone.friction * angle.array().cos().matrix().transpose(),
        cone.friction * angle.array().sin().matrix().transpose();
  }
  return (cone.tangents * tangential).colwise() + cone.normal;
}

}  // namespace

VectorXd WrenchCone::lowest(const VectorArg& direction) const {
  const VectorXd along = tangents.transpose() * direction;
  const double size = along.norm();
  return size > 0 ? VectorXd(normal - tangents * along * (friction / size)) : normal;
}

std::vector<WrenchCone> wrenchCones(std::span<const Contact> contacts, const WrenchReference& reference) {
  return conesOf(contacts, reference);
}

std::vector<WrenchCone> wrenchCones(std::span<const PlanarContact> contacts,
                                    const WrenchReference& reference) {
  return conesOf(contacts, reference);
}

VectorXd weightWrench(double mass, const Eigen::Vector3d& p_OM, const Eigen::Vector3d& gravity_O,
                      const WrenchReference& reference) {
  requireReference(reference);
  requireFinite("weight: mass", mass);
  requireFinite("weight: centre of mass", p_OM);
  requireFinite("weight: gravity", gravity_O);
  return wrenchAt(p_OM, mass * gravity_O, reference);
}

WrenchSet primitiveWrenches(std::span<const WrenchCone> cones, int edges) {
  requireCount("edges of a friction pyramid", edges, 3);
  internal::requireCones(cones);
  std::vector<MatrixXd> blocks;
  WrenchSet set;
  for (std::size_t i = 0; i < cones.size(); ++i) {
    blocks.push_back(edgesOf(cones[i], edges));
    set.contact.insert(set.contact.end(), static_cast<std::size_t>(blocks.back().cols()),
                       static_cast<int>(i));
  }
  set.wrenches.resize(cones.empty() ? 0 : cones[0].normal.size(),
                      static_cast<Eigen::Index>(set.contact.size()));
  Eigen::Index column = 0;
  for (const MatrixXd& block : blocks) {
    set.wrenches.middleCols(column, block.cols()) = block;
    column += block.cols();
  }
  return set;
}

namespace internal {

void requireCones(std::span<const WrenchCone> cones) {
  for (std::size_t i = 0; i < cones.size(); ++i) {
    const WrenchCone& cone = cones[i];
    requireSize(fmt::format("wrench cone {}: normal", i), cone.normal.size(), cones[0].normal.size());
    if (cone.normal.size() == 0 || cone.tangents.rows() != cone.normal.size() || cone.tangents.cols() < 1 ||
        cone.tangents.cols() > 2 || cone.tangents.cols() != cones[0].tangents.cols())
      throw Error(
          {.what = fmt::format("wrench cone {}: tangents", i),
           .found = fmt::format("{} x {}", cone.tangents.rows(), cone.tangents.cols()),
           .wanted = "as many rows as the normal has, and one or two columns, as many as cone 0 has"});
    requireFinite(fmt::format("wrench cone {}: normal", i), cone.normal);
    for (Eigen::Index k = 0; k < cone.tangents.cols(); ++k)
      requireFinite(fmt::format("wrench cone {}: tangents", i), VectorXd(cone.tangents.col(k)));
    requireNotNegative(fmt::format("wrench cone {}: friction", i), cone.friction);
  }
}

}  // namespace internal
}  // namespace rex
