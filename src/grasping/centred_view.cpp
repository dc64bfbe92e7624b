#include <algorithm>

#include <Eigen/Geometry>

#include "geometry/rotation.h"
#include "grasping/centred_view_internal.h"

namespace rex::internal {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRounding = 4e-15;       // of the point of a contact, if torques are taken far from it
constexpr double kLeastRounding = 1e-12;  // contacts are known no better than this

// The point p of a contact, from the reference point and in its units of length: the torques p x f of all
// axes f of the contact give it.
Vector3d pointOf(const WrenchCone& cone) {
  MatrixXd axes(cone.normal.size(), 1 + cone.tangents.cols());
  axes << cone.normal, cone.tangents;
  Vector3d p = Vector3d::Zero();
  for (const auto& w : axes.colwise())
    if (w.size() == 6)
      p += Vector3d(w.head<3>()).cross(Vector3d(w.tail<3>())) / 2;
    else
      p.head<2>() += w[2] * Vector2d(w[1], -w[0]);
  return p;
}

// The map that moves the reference point to c and divides torques by the length.
MatrixXd movedTo(const Vector3d& c, double length, Index size) {
  MatrixXd map = MatrixXd::Identity(size, size);
  if (size == 6) {
    map.bottomLeftCorner<3, 3>() = -skew(c) / length;
    map.bottomRightCorner<3, 3>() /= length;
  } else {
    map.row(2) << c.y() / length, -c.x() / length, 1 / length;
  }
  return map;
}

}  // namespace

CentredView centredView(std::span<const WrenchCone> cones) {
  const Index size = cones[0].normal.size(), tangents = cones[0].tangents.cols();
  if (!(size == 6 && tangents == 2) && !(size == 3 && tangents == 1))
    return {.map = MatrixXd::Identity(size, size), .rounding = kLeastRounding};
  Matrix3Xd points(3, static_cast<Index>(cones.size()));
  for (std::size_t i = 0; i < cones.size(); ++i) points.col(static_cast<Index>(i)) = pointOf(cones[i]);
  const Vector3d middle = points.rowwise().mean();
  const double far = middle.norm();
  double spread = (points.colwise() - middle).colwise().norm().maxCoeff();
  if (!(spread > kRounding * far)) spread = far > 0 ? far : 1;  // all at one point, up to rounding
  return {.map = movedTo(middle, spread, size),
          .rounding = std::max(kLeastRounding, kRounding * far / spread)};
}

}  // namespace rex::internal
