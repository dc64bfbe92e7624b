#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include "geometry/convex_hull.h"
#include "geometry/mesh_mass.h"
#include "scene/mjcf_parts_internal.h"

namespace rex::mjcf {
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
  for (const BodyInFile& one : tree.bodies) {
    BodySpec& body = tree.spec.bodies[one.body];
    MassProperties all = one.given.value_or(MassProperties{});
    const bool isWeighed = weighsByGeoms(one, compiler);
    if (isWeighed) all = weigh(one.solids, body.shapes);
    body.mass = std::max(all.mass, compiler.leastMass);
    if (body.mass == 0) continue;
    body.p_BBcm = all.p_BBcm;
    Eigen::Matrix3d I = bounded(all.I_BBcm_B, compiler);
    if (isWeighed)
      I = urdf::judgedMoments(reading, body.where, fmt::format("body '{}': its geoms", body.name), I,
                              body.mass);
    body.inertia = (I + I.transpose()) / 2;
  }
  if (compiler.totalMass) scaleTo(*compiler.totalMass, tree);
}

}  // namespace rex::mjcf
