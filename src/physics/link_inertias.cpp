#include <vector>

#include <Eigen/Geometry>

#include "geometry/rotation.h"
#include "physics/link_inertias_internal.h"

namespace rex::internal {
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
