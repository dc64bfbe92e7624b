#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include "formats/mjcf_parts_internal.h"
#include "geometry/convex_hull.h"
#include "geometry/mesh_mass.h"

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

namespace {

Eigen::Matrix3d steiner(const Eigen::Vector3d& p) {
  return p.squaredNorm() * Eigen::Matrix3d::Identity() - p * p.transpose();
}

// A scene given as text has no meshes.
void requireMesh(const Solid& solid, const std::vector<ShapeSpec>& shapes) {
  if (!solid.mesh || shapes[*solid.mesh].meshMissing || !shapes[*solid.mesh].shape.mesh.isEmpty()) return;
  throw Error({.what = "<geom>: the mass of a mesh",
               .where = solid.where,
               .found = "a scene that was given as text",
               .wanted = "an <inertial> of the body, or the model in a file"});
}

TriangleMesh hullOf(const ShapeSpec& shape) {
  if (!shape.shape.hull.isEmpty()) return shape.shape.hull;
  try {
    return convexHull(shape.shape.mesh);
  } catch (const Error& error) {
    ErrorParts parts = error.parts();
    parts.what = fmt::format("mesh '{}': inertia=\"convex\": {}", shape.meshFile, parts.what);
    parts.where = shape.where;
    throw Error(parts);
  }
}

// Weighs what geoms add to bodies, and each mesh once.
class Weigher {
 public:
  explicit Weigher(Reading& reading) : reading_(reading) {}

  MassProperties operator()(const std::vector<Solid>& solids, const std::vector<ShapeSpec>& shapes) {
    std::vector<MassProperties> parts;
    MassProperties all;
    for (const Solid& solid : solids) {
      const MassProperties& part = parts.emplace_back(inBody(solid, shapes));
      all.mass += part.mass;
      all.p_BBcm += part.mass * part.p_BBcm;
    }
    if (!(all.mass > 0)) return {};
    all.p_BBcm /= all.mass;
    for (const MassProperties& part : parts)
      all.I_BBcm_B += part.I_BBcm_B + part.mass * steiner(part.p_BBcm - all.p_BBcm);
    return all;
  }

 private:
  struct Weighed {
    TriangleMesh mesh;
    MeshInertia inertia;
    MassProperties all;
  };

  // Zero for a mesh that encloses no volume.
  MassProperties inBody(const Solid& solid, const std::vector<ShapeSpec>& shapes) {
    requireMesh(solid, shapes);
    MassProperties all = solid.mesh ? ofMesh(solid, shapes[*solid.mesh]) : ofDensityOne(solid);
    if (!(all.mass > 0)) {
      const char* const why = solid.mesh && shapes[*solid.mesh].meshMissing
                                  ? "<geom>: the mesh is missing, so it weighs nothing"
                                  : "<geom>: the mesh encloses no volume, so it weighs nothing";
      reading_.notes.warn(solid.where, why);
      return {};
    }
    const double factor = solid.mass ? *solid.mass / all.mass : solid.density;
    all.mass *= factor;
    all.I_BBcm_B = factor * solid.X_BS.R * all.I_BBcm_B * solid.X_BS.R.transpose();
    all.p_BBcm = solid.X_BS * all.p_BBcm;
    return all;
  }

  MassProperties ofMesh(const Solid& solid, const ShapeSpec& shape) {
    const TriangleMesh& mesh = shape.shape.mesh;
    for (const Weighed& known : weighed_)
      if (known.mesh == mesh && known.inertia == solid.inertia) return known.all;
    const MassProperties all = massOfMesh(shape, solid.inertia);
    weighed_.push_back({mesh, solid.inertia, all});
    const bool hasVolume = solid.inertia != MeshInertia::kConvex && solid.inertia != MeshInertia::kShell;
    if (hasVolume && all.mass > 0) judge(solid, shape, all.mass);
    return all;
  }

  // Says how far the volume of an open mesh is in doubt, and if a closed one weighs more than it encloses.
  // Holes count that change what is enclosed: a crack between edges that do not match has no area.
  void judge(const Solid& solid, const ShapeSpec& shape, double volume) {
    constexpr double kLeast = 1e-3;
    const double enclosed = meshMass(shape.shape.mesh, MeshMassRule::kEnclosed).mass;
    const std::optional<double> closed = volumeWithoutHoles(shape.shape.mesh);
    if (closed && std::abs(*closed - enclosed) >= kLeast * std::max(std::abs(*closed), enclosed)) {
      const double doubt = std::abs(volume - *closed) / volume;
      reading_.notes.warn(
          shape.where,
          fmt::format(
              "mesh '{}': the surface has holes, or triangles with the wrong side out, so its volume is "
              "uncertain by {:.{}f} %: {:.4g} m^3 by inertia=\"{}\", {:.4g} m^3 with all holes closed",
              shape.meshFile, 100 * doubt, doubt < .1 ? 1 : 0, volume, wordOf(solid.inertia), *closed));
    } else if (!solid.mass && volume - enclosed >= kLeast * volume) {
      reading_.notes.remark(shape.where,
                            "a mesh that is not convex weighs more than it encloses, as in MuJoCo, where "
                            "inertia=\"legacy\" is the default of <mesh>; \"exact\" counts what it encloses");
    }
  }

  Reading& reading_;
  std::vector<Weighed> weighed_;
};

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

MassProperties massOfMesh(const ShapeSpec& shape, MeshInertia inertia) {
  constexpr MeshMassRule kRules[] = {MeshMassRule::kEnclosed, MeshMassRule::kEnclosed,
                                     MeshMassRule::kUnsigned, MeshMassRule::kShell};
  return meshMass(inertia == MeshInertia::kConvex ? hullOf(shape) : shape.shape.mesh,
                  kRules[static_cast<int>(inertia)]);
}

void setMasses(BodyTree& tree, const Compiler& compiler, Reading& reading) {
  Weigher weigh(reading);
  for (BodyInFile& one : tree.bodies) {
    BodySpec& body = tree.spec.bodies[one.body];
    MassProperties all = one.given.value_or(MassProperties{});
    one.isWeighed = weighsByGeoms(one, compiler);
    if (one.isWeighed) all = weigh(one.solids, body.shapes);
    body.mass = std::max(all.mass, compiler.leastMass);
    if (body.mass == 0) continue;
    body.p_BBcm = all.p_BBcm;
    Eigen::Matrix3d I = bounded(all.I_BBcm_B, compiler);
    if (one.isWeighed)
      I = urdf::judgedMoments(reading, body.where, fmt::format("body '{}': its geoms", body.name), I,
                              body.mass);
    body.inertia = (I + I.transpose()) / 2;
  }
  if (compiler.totalMass) scaleTo(*compiler.totalMass, tree);
}

namespace {

using Eigen::Vector3d;

// The principal axes of a mesh in its own frame, x that of the largest moment, and the half edges of the box
// of the same density that has its inertia.
struct Principal {
  Pose X_MP;
  Vector3d half;
};

Principal principalOf(const MassProperties& mesh) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(mesh.I_BBcm_B);
  const Vector3d moments = solver.eigenvalues().reverse();
  Principal all{{solver.eigenvectors().rowwise().reverse(), mesh.p_BBcm}, Vector3d::Zero()};
  if (all.X_MP.R.determinant() < 0) all.X_MP.R.col(2) *= -1;
  for (int i = 0; i < 3; ++i)
    all.half[i] = std::sqrt(std::max(0., 6 * (moments.sum() - 2 * moments[i]) / mesh.mass)) / 2;
  return all;
}

// A solid, and its pose in the frame of the mesh. Sizes as MuJoCo has them.
struct Fitted {
  Pose X_MS;
  Vector3d size;
};

// MuJoCo's capsule is longer than the box: its straight half is that of the box less half of the radius.
Fitted byInertia(Solid::Kind kind, const Principal& principal) {
  const Vector3d& half = principal.half;
  const double radius = (half.x() + half.y()) / 2;
  switch (kind) {
    case Solid::Kind::kSphere:
      return {principal.X_MP, {half.sum() / 3, 0, 0}};
    case Solid::Kind::kCapsule:
      return {principal.X_MP, {radius, std::max(0., half.z() - radius / 2), 0}};
    case Solid::Kind::kCylinder:
      return {principal.X_MP, {radius, half.z(), 0}};
    case Solid::Kind::kBox:
    case Solid::Kind::kEllipsoid:
    case Solid::Kind::kMesh:
      break;
  }
  return {principal.X_MP, half};
}

// Around all vertices, along the principal axes.
Fitted byBounds(Solid::Kind kind, const Principal& principal, const TriangleMesh& mesh) {
  std::vector<Vector3d> points;
  Vector3d low = Vector3d::Constant(HUGE_VAL), high = -low;
  const Pose X_PM = principal.X_MP.inverse();
  for (const Eigen::Vector3f& vertex : mesh.positions()) {
    points.emplace_back(X_PM * vertex.cast<double>());
    low = low.cwiseMin(points.back());
    high = high.cwiseMax(points.back());
  }
  const Vector3d center = (low + high) / 2;
  double radius = 0, reach = 0, half = 0;
  for (Vector3d& point : points) {
    point -= center;
    radius = std::max(radius, point.head<2>().norm());
    reach = std::max(reach, point.norm());
  }
  for (const Vector3d& point : points) {
    const double cap = std::sqrt(std::max(0., radius * radius - point.head<2>().squaredNorm()));
    half = std::max(half, std::abs(point.z()) - (kind == Solid::Kind::kCapsule ? cap : 0));
  }
  const Pose X_MS = principal.X_MP * Pose{Eigen::Matrix3d::Identity(), center};
  if (kind == Solid::Kind::kSphere) return {X_MS, {reach, 0, 0}};
  if (kind == Solid::Kind::kCapsule || kind == Solid::Kind::kCylinder) return {X_MS, {radius, half, 0}};
  return {X_MS, high - center};
}

Shape shapeOfFit(Solid::Kind kind, const Vector3d& size) {
  switch (kind) {
    case Solid::Kind::kSphere:
      return {.type = ShapeType::kSphere, .extent = Vector3d::Zero(), .radius = size[0]};
    case Solid::Kind::kCapsule:
      return {.type = ShapeType::kCapsule, .extent = {0, 0, 2 * size[1]}, .radius = size[0]};
    case Solid::Kind::kCylinder:
      return {.type = ShapeType::kCylinder, .extent = {0, 0, 2 * size[1]}, .radius = size[0]};
    case Solid::Kind::kEllipsoid:
      return {.type = ShapeType::kEllipsoid, .extent = 2 * size};
    case Solid::Kind::kBox:
    case Solid::Kind::kMesh:
      break;
  }
  return {.type = ShapeType::kBox, .extent = 2 * size};
}

}  // namespace

void fitGeoms(BodyTree& tree, const Compiler& compiler, Reading& reading) {
  for (const FitInTree& one : tree.fits) {
    ShapeSpec& shape = tree.shapesOf(one.at.body)[one.at.first];
    shape.contact = one.fit.contact;
    if (shape.meshMissing || shape.shape.mesh.isEmpty()) continue;
    const TriangleMesh mesh = shape.shape.mesh;
    const MassProperties properties = massOfMesh(shape, one.fit.inertia);
    if (!(properties.mass > 0)) {
      reading.notes.warn(shape.where, "<geom>: the mesh to fit encloses no volume, so nothing touches it");
      shape.contact = false;
      continue;
    }
    const Principal principal = principalOf(properties);
    Fitted fitted =
        compiler.fitsBounds ? byBounds(one.fit.kind, principal, mesh) : byInertia(one.fit.kind, principal);
    fitted.size *= one.fit.scale;
    shape.X_BS = shape.X_BS * fitted.X_MS;
    shape.shape = shapeOfFit(one.fit.kind, fitted.size);
    shape.meshFile.clear();
    shape.meshPath.clear();
    shape.meshScale.setOnes();
    if (!one.solid) continue;
    const auto body = std::ranges::find(tree.bodies, one.at.body, &BodyInFile::body);
    Solid& solid = body->solids[*one.solid];
    solid.kind = one.fit.kind;
    solid.size = fitted.size;
    solid.X_BS = shape.X_BS;
    solid.mesh.reset();
  }
}

}  // namespace rex::mjcf
