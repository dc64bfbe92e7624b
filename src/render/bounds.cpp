#include "render/bounds.h"

namespace rex {

bool Bounds::isEmpty() const { return (low.array() > high.array()).any(); }

Eigen::Vector3d Bounds::center() const { return (low + high) / 2; }

double Bounds::radius() const { return (high - low).norm() / 2; }

Eigen::Vector3d Bounds::corner(int i) const {
  return {(i & 1 ? high : low).x(), (i & 2 ? high : low).y(), (i & 4 ? high : low).z()};
}

void Bounds::include(const Eigen::Vector3d& point) {
  low = low.cwiseMin(point);
  high = high.cwiseMax(point);
}

}  // namespace rex
