#include "geometry/kernel_math.h"
#include "kinematics/jacobian_kernel_internal.h"

namespace rex::internal {
namespace {

template <class T, int kCount>
void point(const double* X_WB, const double* p_BQ, double* p_WQ) {
  for (int k = 0; k < kCount; k += kLanesOf<T>) {
    const KernelPose<T> X = loadPose<T>(X_WB + k, kCount);
    storeVec3(X.R * broadcastVec3<T>(p_BQ) + X.p, p_WQ + k, kCount);
  }
}

template <class T, int kCount>
void addVelocity(const double* X_WF, const double* angular, const double* linear, const double* p_WQ,
                 double* column) {
  for (int k = 0; k < kCount; k += kLanesOf<T>) {
    const KernelPose<T> X = loadPose<T>(X_WF + k, kCount);
    const Vec3<T> axis = X.R * broadcastVec3<T>(angular), way = X.R * broadcastVec3<T>(linear);
    const Vec3<T> velocity = cross(axis, loadVec3<T>(p_WQ + k, kCount) - X.p) + way;
    storeVec3(loadVec3<T>(column + k, kCount) + velocity, column + k, kCount);
  }
}

template <class T, int kCount>
void addAngular(const double* X_WF, const double* angular, double* column) {
  for (int k = 0; k < kCount; k += kLanesOf<T>) {
    const Vec3<T> axis = loadPose<T>(X_WF + k, kCount).R * broadcastVec3<T>(angular);
    storeVec3(loadVec3<T>(column + k, kCount) + axis, column + k, kCount);
  }
}

template <class T, int kCount>
JacobianKernel::Functions functions() {
  return {&point<T, kCount>, &addVelocity<T, kCount>, &addAngular<T, kCount>};
}

}  // namespace

template <int kLanes>
JacobianKernel JacobianKernel::compiled() {
  return {functions<double, 1>(), functions<InLanes<kLanes>, kBlock>()};
}
template JacobianKernel JacobianKernel::compiled<REX_LANES>();

}  // namespace rex::internal
