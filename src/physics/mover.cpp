#include <Eigen/Eigenvalues>

#include "physics/bullet_math_internal.h"
#include "physics/mover_internal.h"

namespace rex::internal {

BulletLink bulletLink(const Body& body) {
  const Eigen::Matrix3d& I = body.I_BBcm_B;
  if (I.isDiagonal(0)) return {{Eigen::Matrix3d::Identity(), body.p_BBcm}, body.mass, toBullet(I.diagonal())};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(I);
  Eigen::Matrix3d R = axes.eigenvectors();
  if (R.determinant() < 0) R.col(0) = -R.col(0);
  return {{R, body.p_BBcm}, body.mass, toBullet(axes.eigenvalues())};
}

}  // namespace rex::internal
