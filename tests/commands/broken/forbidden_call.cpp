#include "exercise.h"
#include "geometry/rotation.h"
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double a) {
  return (rex::rotationAboutAxis(a, Eigen::Vector3d::UnitZ()) * Eigen::Vector3d(p.x(), p.y(), 0)).head<2>();
}
int main() {}
