#include <cmath>
#include <numbers>

#include "scene/mjcf_parts_internal.h"

namespace rex::mjcf {
namespace {

constexpr double kPi = std::numbers::pi;

// About the centre and along the axes of the solid.
MassProperties diagonal(double mass, const Eigen::Vector3d& moments) {
  return {mass, Eigen::Vector3d::Zero(), moments.asDiagonal()};
}

// Of a solid whose second moments of mass along its axes these are.
MassProperties fromSeconds(double mass, const Eigen::Vector3d& seconds) {
  return diagonal(mass, Eigen::Vector3d::Constant(seconds.sum()) - seconds);
}

MassProperties ellipsoid(const Eigen::Vector3d& halfAxes) {
  const double mass = 4. / 3 * kPi * halfAxes.prod();
  return fromSeconds(mass, mass / 5 * halfAxes.cwiseAbs2());
}

MassProperties box(const Eigen::Vector3d& halfEdges) {
  const double mass = 8 * halfEdges.prod();
  return fromSeconds(mass, mass / 3 * halfEdges.cwiseAbs2());
}

MassProperties cylinder(double radius, double half) {
  const double mass = kPi * radius * radius * 2 * half;
  const double across = mass * radius * radius / 4;
  return fromSeconds(mass, {across, across, mass * half * half / 3});
}

// A cylinder and two half balls, whose centres of mass are 3/8 of the radius beyond its ends.
MassProperties capsule(double radius, double half) {
  const MassProperties middle = cylinder(radius, half);
  const double caps = 4. / 3 * kPi * radius * radius * radius, ball = .4 * caps * radius * radius;
  const double across = ball + caps * half * (half + .75 * radius);
  return diagonal(middle.mass + caps, middle.I_BBcm_B.diagonal() + Eigen::Vector3d(across, across, ball));
}

MassProperties sphereShell(double radius) {
  const double mass = 4 * kPi * radius * radius, second = mass * radius * radius / 3;
  return fromSeconds(mass, {second, second, second});
}

// MuJoCo's approximation: Thomsen's formula for the area, and the moments of a layer between two ellipsoids
// whose half axes differ by a micrometre.
MassProperties ellipsoidShell(const Eigen::Vector3d& halfAxes) {
  constexpr double kPower = 1.6075, kLayer = 1e-6;
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += std::pow(halfAxes[i] * halfAxes[(i + 1) % 3], kPower);
  const double area = 4 * kPi * std::pow(sum / 3, 1 / kPower);
  const MassProperties inner = ellipsoid(halfAxes), outer = ellipsoid(halfAxes.array() + kLayer);
  const Eigen::Matrix3d layer = outer.I_BBcm_B - inner.I_BBcm_B;
  return {area, Eigen::Vector3d::Zero(), area / (outer.mass - inner.mass) * layer};
}

// Of each face, half its area lies one half edge away, and it spreads over the two others as a plate.
MassProperties boxShell(const Eigen::Vector3d& halfEdges) {
  const Eigen::Vector3d squares = halfEdges.cwiseAbs2();
  Eigen::Vector3d seconds = Eigen::Vector3d::Zero();
  double mass = 0;
  for (int i = 0; i < 3; ++i) {
    const double faces = 8 * halfEdges[(i + 1) % 3] * halfEdges[(i + 2) % 3];
    mass += faces;
    for (int k = 0; k < 3; ++k) seconds[k] += faces * squares[k] / (k == i ? 1 : 3);
  }
  return fromSeconds(mass, seconds);
}

// Without its two discs.
MassProperties tube(double radius, double half) {
  const double mass = 4 * kPi * radius * half, across = mass * radius * radius / 2;
  return fromSeconds(mass, {across, across, mass * half * half / 3});
}

MassProperties cylinderShell(double radius, double half) {
  const MassProperties side = tube(radius, half);
  const double discs = 2 * kPi * radius * radius, second = discs * radius * radius / 4;
  const MassProperties ends = fromSeconds(discs, {second, second, discs * half * half});
  return {side.mass + discs, side.p_BBcm, side.I_BBcm_B + ends.I_BBcm_B};
}

// A tube and two half spheres, whose centres of mass are half the radius beyond its ends.
MassProperties capsuleShell(double radius, double half) {
  const MassProperties side = tube(radius, half), caps = sphereShell(radius);
  const double shifted = caps.mass * half * (half + radius);
  MassProperties all{side.mass + caps.mass, side.p_BBcm, side.I_BBcm_B + caps.I_BBcm_B};
  all.I_BBcm_B.diagonal().head<2>().array() += shifted;
  return all;
}

}  // namespace

MassProperties ofDensityOne(const Solid& solid) {
  const double r = solid.size[0], half = solid.size[1];
  switch (solid.kind) {
    case Solid::Kind::kSphere:
      return solid.isShell ? sphereShell(r) : ellipsoid(Eigen::Vector3d::Constant(r));
    case Solid::Kind::kCapsule:
      return solid.isShell ? capsuleShell(r, half) : capsule(r, half);
    case Solid::Kind::kCylinder:
      return solid.isShell ? cylinderShell(r, half) : cylinder(r, half);
    case Solid::Kind::kBox:
      return solid.isShell ? boxShell(solid.size) : box(solid.size);
    case Solid::Kind::kEllipsoid:
      return solid.isShell ? ellipsoidShell(solid.size) : ellipsoid(solid.size);
    case Solid::Kind::kMesh:
      break;  // weighed by its triangles
  }
  return {};
}

}  // namespace rex::mjcf
