#include <algorithm>
#include <vector>

#include <Eigen/Geometry>

#include "geometry/rotation.h"
#include "physics/bullet_shape_internal.h"

namespace rex::internal {
namespace {

// Bullet rounds the edges of boxes and cylinders inwards by its margin, unless it computes exact contacts
// for the pair. A millimetre is as sharp as its search for nearest points allows.
constexpr double kMargin = 1e-3;

template <class Solid>
std::unique_ptr<btCollisionShape> withEdges(const Eigen::Vector3d& half) {
  auto solid = std::make_unique<Solid>(toBullet(half));
  solid->setMargin(std::min(kMargin, half.minCoeff() / 10));
  return solid;
}

std::unique_ptr<btConvexHullShape> hullOf(std::span<const Eigen::Vector3f> points, double radius) {
  auto hull = std::make_unique<btConvexHullShape>();
  for (const Eigen::Vector3f& point : points) hull->addPoint(toBullet(point.cast<double>()), false);
  hull->recalcLocalAabb();
  hull->setMargin(radius);
  return hull;
}

// Bullet has no ellipsoids but knows how to handle any convex solid that finds its support points. The margin
// is a ball around a smaller ellipsoid: exact at the ends of the axes, and within the margin elsewhere.
class BulletEllipsoid : public btConvexInternalShape {
 public:
  explicit BulletEllipsoid(const Eigen::Vector3d& half) {
    m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;
    const double margin = std::min(kMargin, half.minCoeff() / 10);
    m_implicitShapeDimensions = toBullet(half.array() - margin);
    m_collisionMargin = margin;
  }
  btVector3 localGetSupportingVertexWithoutMargin(const btVector3& direction) const override {
    const btVector3 scaled = m_implicitShapeDimensions * direction;
    const btScalar length = scaled.length();
    if (length == 0) return {m_implicitShapeDimensions.x(), 0, 0};
    return m_implicitShapeDimensions * scaled / length;
  }
  void batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* directions, btVector3* points,
                                                         int count) const override {
    for (int i = 0; i < count; ++i) points[i] = localGetSupportingVertexWithoutMargin(directions[i]);
  }
  // Never asked: bodies have the inertias of the model.
  void calculateLocalInertia(btScalar, btVector3& inertia) const override { inertia.setZero(); }
  const char* getName() const override { return "ellipsoid"; }
};

// Exactly the box: a core of eight corners, and the ball around each.
std::unique_ptr<btCollisionShape> roundedBox(const Eigen::Vector3d& half, double radius) {
  auto hull = std::make_unique<btConvexHullShape>();
  const Eigen::Vector3d core = half.array() - radius;
  for (int corner = 0; corner < 8; ++corner) {
    const btVector3 point((corner & 1) != 0 ? core.x() : -core.x(), (corner & 2) != 0 ? core.y() : -core.y(),
                          (corner & 4) != 0 ? core.z() : -core.z());
    hull->addPoint(point, false);
  }
  hull->recalcLocalAabb();
  hull->setMargin(radius);
  return hull;
}

}  // namespace

std::unique_ptr<btCollisionShape> bulletShape(const Shape& shape) {
  switch (shape.type) {
    case ShapeType::kBox:
      return withEdges<btBoxShape>(shape.extent / 2);
    case ShapeType::kSphere:
      return std::make_unique<btSphereShape>(shape.radius);
    case ShapeType::kCapsule:
      return std::make_unique<btCapsuleShapeZ>(shape.radius, shape.extent.z());
    case ShapeType::kCylinder:
      return withEdges<btCylinderShapeZ>({shape.radius, shape.radius, shape.extent.z() / 2});
    case ShapeType::kCone: {
      auto cone = std::make_unique<btConeShapeZ>(shape.radius, shape.extent.z());
      cone->setMargin(0);  // Bullet's cones grow by it
      return cone;
    }
    case ShapeType::kEllipsoid:
      return std::make_unique<BulletEllipsoid>(shape.extent / 2);
    case ShapeType::kRoundedBox:
      return roundedBox(shape.extent / 2, shape.radius);
    case ShapeType::kMesh:
    case ShapeType::kPointCloud:
    case ShapeType::kSphereSweptConvex: {
      const TriangleMesh& mesh = shape.hull.isEmpty() ? shape.mesh : shape.hull;
      const double radius = shape.type == ShapeType::kSphereSweptConvex ? shape.radius : 0;
      return mesh.isEmpty() ? nullptr : hullOf(mesh.positions(), radius);
    }
    case ShapeType::kMarker:
      break;
  }
  return nullptr;
}

namespace {

// Mass, first moment and inertia about the origin of a frame.
struct Lump {
  double mass = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  Eigen::Matrix3d I = Eigen::Matrix3d::Zero();
};

Lump lumpOf(const Link& link) {
  const double* const I = link.inertia;
  Lump lump{.mass = link.mass, .moment = Eigen::Map<const Eigen::Vector3d>(link.moment)};
  lump.I << I[0], I[1], I[2], I[1], I[3], I[4], I[2], I[4], I[5];
  return lump;
}

// The same quantities in frame P, given in L.
Lump moved(const Lump& lump, const Pose& X_PL) {
  const Eigen::Matrix3d P = skew(X_PL.p), C = skew(X_PL.R * lump.moment);
  Lump in{.mass = lump.mass, .moment = X_PL.R * lump.moment + lump.mass * X_PL.p};
  in.I = X_PL.R * lump.I * X_PL.R.transpose() - P * C - C * P - lump.mass * P * P;
  return in;
}

Pose poseOf(const Link& link, const Eigen::VectorXd& q) {
  const Eigen::Map<const Eigen::Matrix<double, 3, 4>> constant(link.X_PL);
  const Pose X{constant.leftCols<3>(), constant.col(3)};
  if (link.kind == Link::Kind::kQuaternion)
    return X * Pose{rotationFromQuaternion(q.segment<4>(link.qIndex)), Eigen::Vector3d::Zero()};
  const double x = link.ratio * q[link.qIndex] + link.offset;
  const bool turns = link.kind != Link::Kind::kSlider;
  const double way = turns ? link.pitch * x : x;
  return X * rotation(turns ? x : 0, Eigen::Vector3d::UnitZ()) * translation(0, 0, way);
}

double resistance(const Link& link, const Lump& lump) {
  if (link.kind == Link::Kind::kSlider) return lump.mass;
  if (link.kind == Link::Kind::kQuaternion) return lump.I.diagonal().minCoeff();
  return lump.I(2, 2) + link.pitch * link.pitch * lump.mass;
}

}  // namespace

std::vector<double> linkInertias(const Model& model) {
  std::vector<Lump> lumps;
  for (const Link& link : model.links()) lumps.push_back(lumpOf(link));
  std::vector<double> inertias(lumps.size());
  for (std::size_t i = lumps.size(); i-- > 0;) {
    const Link& link = model.links()[i];
    inertias[i] = resistance(link, lumps[i]);
    if (link.parent == Link::kNoParent) continue;
    const Lump below = moved(lumps[i], poseOf(link, model.initialPositions()));
    Lump& parent = lumps[static_cast<std::size_t>(link.parent)];
    parent.mass += below.mass;
    parent.moment += below.moment;
    parent.I += below.I;
  }
  return inertias;
}

}  // namespace rex::internal
