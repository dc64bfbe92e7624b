#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include "scene/mjcf_parts_internal.h"

namespace rex::mjcf {
namespace {

constexpr double kPi = std::numbers::pi;

Eigen::Matrix3d steiner(const Eigen::Vector3d& p) {
  return p.squaredNorm() * Eigen::Matrix3d::Identity() - p * p.transpose();
}

// For density 1, about the centre and along the axes of the solid.
MassProperties diagonal(double mass, const Eigen::Vector3d& moments) {
  return {mass, Eigen::Vector3d::Zero(), moments.asDiagonal()};
}

MassProperties ellipsoid(const Eigen::Vector3d& halfAxes) {
  const double mass = 4. / 3 * kPi * halfAxes.prod();
  const Eigen::Vector3d squares = halfAxes.cwiseAbs2();
  return diagonal(mass, mass / 5 * (Eigen::Vector3d::Constant(squares.sum()) - squares));
}

MassProperties box(const Eigen::Vector3d& halfEdges) {
  const double mass = 8 * halfEdges.prod();
  const Eigen::Vector3d squares = halfEdges.cwiseAbs2();
  return diagonal(mass, mass / 3 * (Eigen::Vector3d::Constant(squares.sum()) - squares));
}

MassProperties cylinder(double radius, double half) {
  const double mass = kPi * radius * radius * 2 * half;
  const double across = mass * (radius * radius / 4 + half * half / 3);
  return diagonal(mass, {across, across, mass * radius * radius / 2});
}

// A cylinder and two half balls, whose centres of mass are 3/8 of the radius beyond its ends.
MassProperties capsule(double radius, double half) {
  const MassProperties middle = cylinder(radius, half);
  const double caps = 4. / 3 * kPi * radius * radius * radius, ball = .4 * caps * radius * radius;
  const double across = ball + caps * half * (half + .75 * radius);
  return diagonal(middle.mass + caps, middle.I_BBcm_B.diagonal() + Eigen::Vector3d(across, across, ball));
}

MassProperties ofDensityOne(const Solid& solid, const std::vector<ShapeSpec>& shapes) {
  const double r = solid.size[0];
  switch (solid.kind) {
    case Solid::Kind::kSphere:
      return ellipsoid(Eigen::Vector3d::Constant(r));
    case Solid::Kind::kCapsule:
      return capsule(r, solid.size[1]);
    case Solid::Kind::kCylinder:
      return cylinder(r, solid.size[1]);
    case Solid::Kind::kBox:
      return box(solid.size);
    case Solid::Kind::kEllipsoid:
      return ellipsoid(solid.size);
    case Solid::Kind::kMesh:
      return propertiesOfMesh(shapes[*solid.mesh].shape.mesh);
  }
  return {};
}

// A scene given as text has no meshes.
void requireMesh(const Solid& solid, const std::vector<ShapeSpec>& shapes) {
  if (!solid.mesh || shapes[*solid.mesh].meshMissing || !shapes[*solid.mesh].shape.mesh.isEmpty()) return;
  throw Error({.what = "<geom>: the mass of a mesh",
               .where = solid.where,
               .found = "a scene that was given as text",
               .wanted = "an <inertial> of the body, or the model in a file"});
}

// The mass properties in the frame of the body; zero for a mesh that encloses no volume.
MassProperties inBody(const Solid& solid, const std::vector<ShapeSpec>& shapes, Reading& reading) {
  requireMesh(solid, shapes);
  MassProperties all = ofDensityOne(solid, shapes);
  if (!(all.mass > 0)) {
    const char* const why = solid.mesh && shapes[*solid.mesh].meshMissing
                                ? "<geom>: the mesh is missing, so it weighs nothing"
                                : "<geom>: the mesh encloses no volume, so it weighs nothing";
    reading.notes.warn(solid.where, why);
    return {};
  }
  const double factor = solid.mass ? *solid.mass / all.mass : solid.density;
  all.mass *= factor;
  all.I_BBcm_B = factor * solid.X_BS.R * all.I_BBcm_B * solid.X_BS.R.transpose();
  all.p_BBcm = solid.X_BS * all.p_BBcm;
  return all;
}

// Raises moments to the least one, and makes them equal if no body can have them.
Eigen::Matrix3d bounded(const Eigen::Matrix3d& I, const Compiler& compiler) {
  if (compiler.leastMoment == 0 && !compiler.balancesMoments) return I;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(I);
  Eigen::Vector3d moments = principal.eigenvalues().cwiseMax(compiler.leastMoment);
  if (compiler.balancesMoments && moments[0] + moments[1] < moments[2]) moments.setConstant(moments.mean());
  const Eigen::Matrix3d& R = principal.eigenvectors();
  return R * moments.asDiagonal() * R.transpose();
}

bool weighsByGeoms(const BodyInFile& body, const Compiler& compiler) {
  if (compiler.inertia == Compiler::Inertia::kGiven) return false;
  return !body.given || (compiler.inertia == Compiler::Inertia::kFromGeoms && !body.solids.empty());
}

void scaleTo(double total, BodyTree& tree) {
  double mass = 0;
  for (const BodySpec& body : tree.spec.bodies) mass += body.mass;
  if (!(mass > 0)) return;
  for (BodySpec& body : tree.spec.bodies) {
    body.mass *= total / mass;
    if (body.inertia) *body.inertia *= total / mass;
  }
}

}  // namespace

MassProperties propertiesOfMesh(const TriangleMesh& mesh) {
  double six = 0;  // times the volume
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (const TriangleMesh::Triangle& corners : mesh.triangles()) {
    Eigen::Matrix3d T;
    for (int i = 0; i < 3; ++i)
      T.col(i) = mesh.positions()[corners[static_cast<std::size_t>(i)]].cast<double>();
    const double weight = T.determinant();
    const Eigen::Vector3d sum = T.rowwise().sum();
    six += weight;
    first += weight * sum;
    second += weight * (T * T.transpose() + sum * sum.transpose());
  }
  MassProperties all;
  all.mass = six / 6;
  if (!(all.mass > 0)) return {};
  all.p_BBcm = first / (4 * six);
  const Eigen::Matrix3d covariance = second / 120;  // the integral of x x^T
  const Eigen::Matrix3d I = covariance.trace() * Eigen::Matrix3d::Identity() - covariance;
  all.I_BBcm_B = I - all.mass * steiner(all.p_BBcm);
  return all;
}

MassProperties propertiesOf(const std::vector<Solid>& solids, const std::vector<ShapeSpec>& shapes,
                            Reading& reading) {
  std::vector<MassProperties> parts;
  MassProperties all;
  for (const Solid& solid : solids) {
    const MassProperties& part = parts.emplace_back(inBody(solid, shapes, reading));
    all.mass += part.mass;
    all.p_BBcm += part.mass * part.p_BBcm;
  }
  if (!(all.mass > 0)) return {};
  all.p_BBcm /= all.mass;
  for (const MassProperties& part : parts)
    all.I_BBcm_B += part.I_BBcm_B + part.mass * steiner(part.p_BBcm - all.p_BBcm);
  return all;
}

void setMasses(BodyTree& tree, const Compiler& compiler, Reading& reading) {
  for (const BodyInFile& one : tree.bodies) {
    BodySpec& body = tree.spec.bodies[one.body];
    MassProperties all = one.given.value_or(MassProperties{});
    if (weighsByGeoms(one, compiler)) all = propertiesOf(one.solids, body.shapes, reading);
    body.mass = std::max(all.mass, compiler.leastMass);
    if (body.mass == 0) continue;
    body.p_BBcm = all.p_BBcm;
    const Eigen::Matrix3d I = bounded(all.I_BBcm_B, compiler);
    body.inertia = (I + I.transpose()) / 2;
  }
  if (compiler.totalMass) scaleTo(*compiler.totalMass, tree);
}

}  // namespace rex::mjcf
