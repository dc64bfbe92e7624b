#include "grasping/object_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr double kEdge = 1e-12;  // how far outside its edges a triangle still counts as hit, as a share of it

void requireLength(const char* what, ShapeType type, double size) {
  requirePositive(fmt::format("surface: {} of the {}", what, toString(type)), size, kMetres);
}

Vector3d onUnitSphere(Rng& rng) {
  const double z = rng.uniform(-1, 1), angle = rng.uniform(0, 2 * pi), r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

// Both solutions t of |x + t d| = radius, if there are any.
template <class Vector>
std::vector<double> rootsOf(const Vector& x, const Vector& d, double radius) {
  const double a = d.squaredNorm();
  if (a < 1e-24) return {};
  const double middle = -x.dot(d) / a;
  const double left = radius * radius - (x + middle * d).squaredNorm();
  if (left < 0) return {};
  const double way = std::sqrt(left / a);
  return {middle - way, middle + way};
}

}  // namespace

ObjectSurface::ObjectSurface(const Shape& shape) : type_(shape.type) {
  switch (shape.type) {
    case ShapeType::kBox: {
      for (int i = 0; i < 3; ++i) requireLength("edge", type_, shape.extent[i]);
      half_ = shape.extent / 2;
      addBox();
      break;
    }
    case ShapeType::kSphere:
      requireLength("radius", type_, radius_ = shape.radius);
      break;
    case ShapeType::kCapsule:
    case ShapeType::kCylinder:
    case ShapeType::kCone:
      requireLength("radius", type_, radius_ = shape.radius);
      if (shape.extent.z() != 0 || type_ != ShapeType::kCapsule)
        requireLength("length", type_, shape.extent.z());
      half_.z() = shape.extent.z() / 2;
      break;
    case ShapeType::kMesh:
      addMesh(shape.mesh);
      break;
    case ShapeType::kRoundedBox:
    case ShapeType::kEllipsoid:
    case ShapeType::kSphereSweptConvex:
    case ShapeType::kPointCloud:
    case ShapeType::kMarker:
      throw Error({.what = "surface of a shape",
                   .found = std::string(toString(type_)),
                   .wanted = "a box, sphere, capsule, cylinder, cone or mesh"});
  }
  if (isRound()) areas_ = roundAreas();
}

bool ObjectSurface::isRound() const { return triangles_.empty(); }

void ObjectSurface::addTriangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d across = (b - a).cross(c - a);
  const double area = across.norm() / 2;
  if (!(area > 0)) return;
  triangles_.push_back({a, b - a, c - a, across / (2 * area)});
  areas_.push_back(this->area() + area);
}

void ObjectSurface::addBox() {
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1., -1.}) {
      // u, v and the normal are a right-handed frame.
      const Vector3d n = sign * half_[axis] * Vector3d::Unit(axis);
      const int second = (axis + 1) % 3, third = (axis + 2) % 3;
      const Vector3d u = half_[second] * Vector3d::Unit(second),
                     v = sign * half_[third] * Vector3d::Unit(third);
      addTriangle(n - u - v, n + u - v, n + u + v);
      addTriangle(n - u - v, n + u + v, n - u + v);
    }
}

void ObjectSurface::addMesh(const TriangleMesh& mesh) {
  const auto at = [&](std::uint32_t i) { return Vector3d(mesh.positions()[i].cast<double>()); };
  for (const auto& [a, b, c] : mesh.triangles()) addTriangle(at(a), at(b), at(c));
  if (triangles_.empty())
    throw Error({.what = "surface of a mesh",
                 .found = fmt::format("{} triangles without area", mesh.triangles().size()),
                 .wanted = "triangles"});
}

// Both round ends together, or the base of a cone; then the straight side.
std::vector<double> ObjectSurface::roundAreas() const {
  if (type_ == ShapeType::kCone) {
    const double base = pi * radius_ * radius_;
    return {base, base + pi * radius_ * std::hypot(radius_, 2 * half_.z())};
  }
  const double ends = (type_ == ShapeType::kCylinder ? 2 : 4) * pi * radius_ * radius_;
  return {ends, ends + 4 * pi * radius_ * half_.z()};
}

double ObjectSurface::area() const { return areas_.empty() ? 0 : areas_.back(); }

std::vector<SurfacePoint> ObjectSurface::sample(Rng& rng, int count) const {
  requireCount("surface: number of points", count, 0);
  std::vector<SurfacePoint> points;
  for (int k = 0; k < count; ++k) points.push_back(isRound() ? sampleRound(rng) : sampleTriangle(rng));
  return points;
}

SurfacePoint ObjectSurface::sampleTriangle(Rng& rng) const {
  const auto found = std::upper_bound(areas_.begin(), areas_.end() - 1, rng.uniform() * area());
  const Triangle& triangle = triangles_[static_cast<std::size_t>(found - areas_.begin())];
  double u = rng.uniform(), v = rng.uniform();
  if (u + v > 1) u = 1 - u, v = 1 - v;
  return {triangle.corner + u * triangle.edge1 + v * triangle.edge2, triangle.normal};
}

// On a disk or the side of a cone, the area within a share of the radius is the square of that share.
SurfacePoint ObjectSurface::sampleCone(Rng& rng) const {
  const bool onBase = rng.uniform() * area() < areas_[0];
  const double angle = rng.uniform(0, 2 * pi), share = std::sqrt(rng.uniform());
  const Vector3d out(std::cos(angle), std::sin(angle), 0), z = Vector3d::UnitZ();
  if (onBase) return {share * radius_ * out - half_.z() * z, -z};
  const Vector3d normal = 2 * half_.z() * out + radius_ * z;
  return {share * radius_ * out + (1 - 2 * share) * half_.z() * z, normal.normalized()};
}

SurfacePoint ObjectSurface::sampleRound(Rng& rng) const {
  if (type_ == ShapeType::kCone) return sampleCone(rng);
  if (rng.uniform() * area() >= areas_[0]) {
    const double angle = rng.uniform(0, 2 * pi), z = rng.uniform(-half_.z(), half_.z());
    const Vector3d n(std::cos(angle), std::sin(angle), 0);
    return {radius_ * n + z * Vector3d::UnitZ(), n};
  }
  const Vector3d n = onUnitSphere(rng);
  if (type_ != ShapeType::kCylinder)
    return {radius_ * n + std::copysign(half_.z(), n.z()) * Vector3d::UnitZ(), n};
  const double r = radius_ * std::sqrt(rng.uniform());
  const Vector3d end = std::copysign(1, n.z()) * Vector3d::UnitZ();
  return {r * Vector3d(n.x(), n.y(), 0).normalized() + half_.z() * end, end};
}

std::vector<LineHit> ObjectSurface::hits(const Vector3d& p_OQ, const Vector3d& direction_O) const {
  requireFinite("surface: start of the line", p_OQ);
  requireFinite("surface: direction of the line", direction_O);
  if (std::abs(direction_O.norm() - 1) > 1e-6)
    throw Error({.what = "surface: length of the direction",
                 .found = fmt::format("{}", direction_O.norm()),
                 .wanted = "1"});
  std::vector<LineHit> hits = isRound() ? roundHits(p_OQ, direction_O) : triangleHits(p_OQ, direction_O);
  std::stable_sort(hits.begin(), hits.end(), [](const LineHit& a, const LineHit& b) { return a.t < b.t; });
  return hits;
}

// Moeller and Trumbore, 1997, from both sides.
std::vector<LineHit> ObjectSurface::triangleHits(const Vector3d& p, const Vector3d& d) const {
  std::vector<LineHit> hits;
  for (const Triangle& triangle : triangles_) {
    const Vector3d across = d.cross(triangle.edge2);
    const double volume = across.dot(triangle.edge1);
    if (std::abs(d.dot(triangle.normal)) < kEdge) continue;
    const Vector3d from = p - triangle.corner;
    const double u = across.dot(from) / volume;
    if (u < -kEdge || u > 1 + kEdge) continue;
    const Vector3d beside = from.cross(triangle.edge1);
    const double v = beside.dot(d) / volume;
    if (v < -kEdge || u + v > 1 + kEdge) continue;
    hits.push_back({beside.dot(triangle.edge2) / volume, triangle.normal});
  }
  return hits;
}

// The side is where x^2 + y^2 = k^2 (h - z)^2 below the tip at h: a t^2 + 2 b t + c = 0.
std::vector<LineHit> ObjectSurface::coneHits(const Vector3d& p, const Vector3d& d) const {
  std::vector<LineHit> hits;
  const double h = half_.z(), k = radius_ / (2 * h), below = h - p.z();
  const double a = d.head<2>().squaredNorm() - k * k * d.z() * d.z(),
               b = p.head<2>().dot(d.head<2>()) + k * k * below * d.z(),
               c = p.head<2>().squaredNorm() - k * k * below * below;
  const double left = b * b - a * c, q = -(b + std::copysign(std::sqrt(std::max(left, 0.)), b));
  const auto addSide = [&](double t) {
    const Vector3d at = p + t * d;
    if (!std::isfinite(t) || std::abs(at.z()) > h) return;
    const Vector3d out(at.x(), at.y(), 0);
    hits.push_back({t, (2 * h * out.stableNormalized() + radius_ * Vector3d::UnitZ()).normalized()});
  };
  if (left >= 0 && q != 0) addSide(c / q);
  if (left >= 0 && a != 0) addSide(q / a);
  const double t = (-h - p.z()) / d.z();
  if (d.z() != 0 && (p + t * d).head<2>().norm() < radius_) hits.push_back({t, -Vector3d::UnitZ()});
  return hits;
}

std::vector<LineHit> ObjectSurface::roundHits(const Vector3d& p, const Vector3d& d) const {
  if (type_ == ShapeType::kCone) return coneHits(p, d);
  std::vector<LineHit> hits;
  const double h = half_.z();
  if (h > 0)
    for (const double t : rootsOf<Vector2d>(p.head<2>(), d.head<2>(), radius_))
      if (const Vector3d at = p + t * d; std::abs(at.z()) <= h)
        hits.push_back({t, Vector3d(at.x(), at.y(), 0) / radius_});
  for (const double sign : {1., -1.}) {
    const Vector3d end = sign * h * Vector3d::UnitZ();
    if (type_ == ShapeType::kCylinder) {
      const double t = (end.z() - p.z()) / d.z();
      if (d.z() != 0 && (p + t * d).head<2>().norm() < radius_) hits.push_back({t, sign * Vector3d::UnitZ()});
      continue;
    }
    for (const double t : rootsOf<Vector3d>(p - end, d, radius_))
      if (const Vector3d n = (p + t * d - end) / radius_; sign > 0 ? n.z() >= 0 : n.z() < 0)
        if (h == 0 || std::abs((p + t * d).z()) > h) hits.push_back({t, n});
  }
  return hits;
}

namespace {

using Eigen::Vector3d;

void requireOptions(int tries, const AntipodalOptions& options) {
  requireCount("antipodal grasps: tries", tries, 0);
  requirePositive("antipodal grasps: friction", options.friction);
  requirePositive("antipodal grasps: largest width", options.maxWidth, kMetres);
}

// Evenly over the section of the friction cone.
Vector3d directionInCone(const Contact& contact, Rng& rng) {
  const double r = contact.friction * std::sqrt(rng.uniform());
  const double angle = rng.uniform(0, 2 * std::numbers::pi);
  return (contactFrame(contact) * Vector3d(1, r * std::cos(angle), r * std::sin(angle))).normalized();
}

}  // namespace

AntipodalGrasps sampleAntipodal(const ObjectSurface& surface, Rng& rng, int tries,
                                const AntipodalOptions& options) {
  requireOptions(tries, options);
  AntipodalGrasps result{.grasps = {}, .tries = tries};
  const double near = 1e-9 * std::sqrt(surface.area());
  const double steepest = 1 / std::sqrt(1 + options.friction * options.friction);
  for (const SurfacePoint& point : surface.sample(rng, tries)) {
    const Contact a{point.p_OQ, -point.normal_O, options.friction};
    const Vector3d direction = directionInCone(a, rng);
    const std::vector<LineHit> hits = surface.hits(a.p_OC, direction);
    const auto other = std::find_if(hits.begin(), hits.end(), [&](const LineHit& h) { return h.t > near; });
    if (other == hits.end() || direction.dot(other->normal_O) < steepest) {
      ++result.notOpposite;
      continue;
    }
    if (other->t > options.maxWidth) {
      ++result.tooWide;
      continue;
    }
    const double open = (options.maxWidth - other->t) / 2;
    const bool isBlocked = std::any_of(hits.begin(), hits.end(), [&](const LineHit& h) {
      return (h.t < -near && h.t >= -open) || (h.t > other->t + near && h.t <= other->t + open);
    });
    if (isBlocked) {
      ++result.blocked;
      continue;
    }
    const Contact b{a.p_OC + other->t * direction, -other->normal_O, options.friction};
    result.grasps.push_back({a, b, other->t});
  }
  return result;
}

std::vector<Contact> contactsAt(const std::vector<SurfacePoint>& points, double friction) {
  std::vector<Contact> contacts;
  for (const SurfacePoint& point : points) {
    contacts.push_back({point.p_OQ, -point.normal_O, friction});
    requireValid(contacts.back());
  }
  return contacts;
}

}  // namespace rex
