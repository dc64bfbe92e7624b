#include "render/picture.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "geometry/rotation.h"
#include "kinematics/forward_kinematics.h"
#include "scene/model.h"

namespace rex {
namespace {

// Beyond this many metres, single precision, in which OpenGL computes, is too coarse to show anything.
constexpr double kLargestNumber = 1e9;

bool isUsable(double number) { return std::abs(number) <= kLargestNumber; }

bool isUsable(const Eigen::Vector3d& p) { return p.allFinite() && p.cwiseAbs().maxCoeff() <= kLargestNumber; }

bool isUsable(const Pose& X) { return X.R.allFinite() && isUsable(X.p); }

bool isUsable(const Color& c) {
  return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b) && std::isfinite(c.a);
}

void require(bool good, const std::string& thing, const char* found, const char* wanted) {
  if (!good) throw Error({.what = thing, .found = found, .wanted = wanted});
}

void requireUsable(bool usable, const std::string& thing) {
  require(usable, thing, "a number that is not finite, or beyond 1e9", "finite numbers");
}

void requireSolid(const Solid& solid, std::size_t index) {
  const std::string thing =
      solid.name.empty() ? fmt::format("solid {}", index) : fmt::format("solid '{}'", solid.name);
  requireUsable(isUsable(solid.X_WS), thing + ", pose");
  require(isRotation(solid.X_WS.R), thing + ", pose", "a matrix that is not a rotation",
          "orthonormal axes, right-handed");
  requireUsable(isUsable(solid.color), thing + ", color");
  requireUsable(isUsable(solid.shape.extent) && isUsable(solid.shape.radius), thing + ", size");
  require(solid.shape.extent.minCoeff() >= 0 && solid.shape.radius >= 0, thing + ", size",
          "a negative length", "lengths of at least 0");
  if (!usesMesh(solid.shape.type)) return;
  require(!solid.shape.mesh.isEmpty(), thing, "a mesh without vertices", "one as returned by readMesh()");
  requireUsable(isUsable(solid.shape.mesh.halfBounds()), thing + ", mesh");
}

void requireStroke(const Color& color, double size, const std::string& thing) {
  requireUsable(isUsable(color), thing + ", color");
  require(isUsable(size) && size > 0, thing, "a size in pixels that is not positive", "a positive one");
}

void requirePoints(const std::vector<Eigen::Vector3d>& points, const Color& color, double size,
                   const std::string& thing) {
  for (std::size_t k = 0; k < points.size(); ++k)
    if (!isUsable(points[k])) requireUsable(false, fmt::format("{}, point {}", thing, k));
  requireStroke(color, size, thing);
}

void requireLineSet(const LineSet& lines, const std::string& thing) {
  for (std::size_t k = 0; k < lines.segments.size(); ++k) {
    const auto& [from, to] = lines.segments[k];
    if (!isUsable(from) || !isUsable(to)) requireUsable(false, fmt::format("{}, segment {}", thing, k));
  }
  requireStroke(lines.color, lines.width, thing);
}

void requireText(const Color& color, double scale, const std::string& thing) {
  requireUsable(isUsable(color), thing + ", color");
  require(scale > 0 && scale <= 100, thing, "a strange scale", "above 0, at most 100");
}

Bounds boundsOfMesh(const Solid& solid) {
  const bool isSwept = solid.shape.type == ShapeType::kSphereSweptConvex;
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(isSwept ? solid.shape.radius : 0);
  Bounds box;
  for (const Eigen::Vector3f& p : solid.shape.mesh.positions()) box.include(solid.X_WS * p.cast<double>());
  return {box.low - margin, box.high + margin};
}

}  // namespace

Bounds bounds(const Solid& solid) {
  // A mesh may lie to one side of its frame, so that a box about the origin would be far too large.
  if (!solid.shape.mesh.isEmpty() && usesMesh(solid.shape.type)) return boundsOfMesh(solid);
  const Eigen::Vector3d half = solid.X_WS.R.cwiseAbs() * halfBounds(solid.shape);
  Bounds box;
  box.include(solid.X_WS.p - half);
  box.include(solid.X_WS.p + half);
  return box;
}

Bounds bounds(const Picture& picture) {
  Bounds box;
  for (const Solid& solid : picture.solids) {
    const Bounds one = bounds(solid);
    box.include(one.low);
    box.include(one.high);
  }
  for (const Polyline& line : picture.polylines)
    for (const Eigen::Vector3d& point : line.points) box.include(point);
  for (const LineSet& lines : picture.lineSets)
    for (const auto& [from, to] : lines.segments) box.include(from), box.include(to);
  for (const PointSet& set : picture.pointSets)
    for (const Eigen::Vector3d& point : set.points) box.include(point);
  for (const Axes& axes : picture.axes) {
    box.include(axes.X_WF.p);
    for (int i = 0; i < 3; ++i) box.include(axes.X_WF.p + axes.size * axes.X_WF.R.col(i));
  }
  for (const Arrow& arrow : picture.arrows) {
    box.include(arrow.from);
    box.include(arrow.to);
  }
  for (const Ellipsoid& ellipsoid : picture.ellipsoids) {
    const Eigen::Matrix3d axes = ellipsoid.X_WE.R * ellipsoid.radii.asDiagonal();
    const Eigen::Vector3d half = axes.rowwise().norm();
    box.include(ellipsoid.X_WE.p - half);
    box.include(ellipsoid.X_WE.p + half);
  }
  for (const Label& label : picture.labels) box.include(label.p_WQ);
  return box;
}

void requireDrawable(const Picture& picture) {
  for (std::size_t i = 0; i < picture.solids.size(); ++i) requireSolid(picture.solids[i], i);
  for (std::size_t i = 0; i < picture.polylines.size(); ++i) {
    const Polyline& line = picture.polylines[i];
    requirePoints(line.points, line.color, line.width, fmt::format("polyline {}", i));
  }
  for (std::size_t i = 0; i < picture.lineSets.size(); ++i)
    requireLineSet(picture.lineSets[i], fmt::format("line set {}", i));
  for (std::size_t i = 0; i < picture.pointSets.size(); ++i) {
    const PointSet& set = picture.pointSets[i];
    requirePoints(set.points, set.color, set.size, fmt::format("point set {}", i));
  }
  for (const Axes& axes : picture.axes)
    requireUsable(isUsable(axes.X_WF) && isUsable(axes.size), fmt::format("axes '{}'", axes.name));
  for (std::size_t i = 0; i < picture.arrows.size(); ++i) {
    const Arrow& arrow = picture.arrows[i];
    const std::string thing = fmt::format("arrow {}", i);
    requireUsable(isUsable(arrow.from) && isUsable(arrow.to) && isUsable(arrow.color), thing);
    require(isUsable(arrow.radius) && arrow.radius > 0, thing, "a radius that is not positive",
            "a positive one");
  }
  for (std::size_t i = 0; i < picture.ellipsoids.size(); ++i) {
    const Ellipsoid& ellipsoid = picture.ellipsoids[i];
    const std::string thing = fmt::format("ellipsoid {}", i);
    requireUsable(isUsable(ellipsoid.X_WE) && isUsable(ellipsoid.radii) && isUsable(ellipsoid.color), thing);
    require(ellipsoid.radii.minCoeff() >= 0, thing, "a negative radius", "radii of at least 0");
  }
  for (const Label& label : picture.labels) {
    requireUsable(isUsable(label.p_WQ), fmt::format("label '{}', point", label.text));
    requireText(label.color, label.scale, fmt::format("label '{}'", label.text));
  }
  for (const Caption& caption : picture.captions)
    requireText(caption.color, caption.scale, fmt::format("caption '{}'", caption.text));
  const Ground& ground = picture.ground;
  const bool usableScene =
      ground.scene.isEmpty() || (isUsable(ground.scene.low) && isUsable(ground.scene.high));
  requireUsable(isUsable(ground.height) && usableScene && isUsable(ground.light) && isUsable(ground.dark),
                "ground");
  require(isUsable(ground.cell) && ground.cell > 0, "ground", "a cell that is not positive",
          "a positive edge length");
  require(isUsable(picture.toLight) && picture.toLight.norm() > 0, "light", "no direction",
          "a finite vector to the light");
}

Ellipsoid covarianceEllipsoid(const Eigen::Vector3d& mean, const Eigen::Matrix3d& covariance, double sigmas,
                              const Color& color) {
  constexpr double kRounding = 1e-9;  // of the largest entry
  const auto fail = [](std::string found, const char* wanted) {
    return Error({.what = "covariance ellipsoid", .found = std::move(found), .wanted = wanted});
  };
  if (!mean.allFinite() || !covariance.allFinite())
    throw fail("a mean or covariance that is not finite", "finite numbers");
  requirePositive("covariance ellipsoid: sigmas", sigmas);
  const double rounding = kRounding * covariance.cwiseAbs().maxCoeff();
  if ((covariance - covariance.transpose()).cwiseAbs().maxCoeff() > rounding)
    throw fail("a covariance that is not symmetric", "a symmetric one");
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance);
  const Eigen::Vector3d variances = eigen.eigenvalues();
  if (variances.minCoeff() < -rounding)
    throw fail(fmt::format("a variance of {} along one axis", variances.minCoeff()), "variances >= 0");
  Ellipsoid ellipsoid{.X_WE = {.R = eigen.eigenvectors(), .p = mean}, .color = color};
  ellipsoid.X_WE.R.col(2) = ellipsoid.X_WE.R.col(0).cross(ellipsoid.X_WE.R.col(1));
  ellipsoid.radii = sigmas * variances.cwiseMax(0).cwiseSqrt();
  return ellipsoid;
}

std::vector<Solid> placedSolids(const Model& model, const BodyPoses& poses) {
  const auto isVisible = [](const ModelShape& shape) { return shape.visible; };
  const bool showsAll = std::none_of(model.shapes().begin(), model.shapes().end(), isVisible);
  std::vector<Solid> solids;
  for (const ModelShape& shape : model.shapes()) {
    if (!shape.visible && !showsAll) continue;
    if (usesMesh(shape.shape.type) && shape.shape.mesh.isEmpty()) continue;
    const Eigen::Vector4f c = shape.color.cast<float>();
    solids.push_back({.shape = shape.shape,
                      .X_WS = poses[shape.body] * shape.X_BS,
                      .color = {c[0], c[1], c[2], c[3]},
                      .name = shape.name});
  }
  return solids;
}

std::optional<double> groundHeight(const Model& model, const BodyPoses& poses) {
  std::optional<double> height;
  for (const ModelShape& shape : model.shapes()) {
    if (!shape.ground) continue;
    const Pose X_WS = poses[shape.body] * shape.X_BS;
    const double top = X_WS.p.z() + X_WS.R.row(2).cwiseAbs().dot(halfBounds(shape.shape));
    height = std::max(height.value_or(top), top);
  }
  return height;
}

Picture scenePicture(const Model& model, const BodyPoses& poses) {
  Picture picture{.solids = placedSolids(model, poses)};
  if (const std::optional<double> height = groundHeight(model, poses)) {
    picture.ground.height = *height;
    return picture;
  }
  const Bounds all = bounds(picture);
  if (!all.isEmpty()) picture.ground.height = std::min(0., all.low.z());
  return picture;
}

}  // namespace rex
