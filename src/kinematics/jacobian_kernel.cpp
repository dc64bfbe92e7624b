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

inline bool isZero(const double* v) { return ((bitsOf(v[0]) | bitsOf(v[1]) | bitsOf(v[2])) << 1) == 0; }

template <class T, int kCount>
void addTwist(const double* X_WF, const double* angular, const double* linear, const double* p_WQ,
              double* column) {
  const bool onlyTurns = isZero(linear);
  for (int k = 0; k < kCount; k += kLanesOf<T>) {
    const KernelPose<T> X = loadPose<T>(X_WF + k, kCount);
    const Vec3<T> axis = X.R * broadcastVec3<T>(angular);
    Vec3<T> velocity = cross(axis, loadVec3<T>(p_WQ + k, kCount) - X.p);
    if (!onlyTurns) velocity = velocity + X.R * broadcastVec3<T>(linear);
    double* const turn = column + 3 * kCount;
    storeVec3(loadVec3<T>(column + k, kCount) + velocity, column + k, kCount);
    storeVec3(loadVec3<T>(turn + k, kCount) + axis, turn + k, kCount);
  }
}

#ifdef __AVX__
void addTwistInLanes(const double* X_WF, const double* angular, const double* linear, const double* p_WQ,
                     double* column) {
  const PoseColumns X = loadColumns(X_WF);
  const Quad axis = turned(X, angular);
  Quad velocity = crossColumns(axis, Quad(Quad::Numbers{p_WQ[0], p_WQ[1], p_WQ[2], 0}) - X.p);
  if (!isZero(linear)) velocity = velocity + turned(X, linear);
  const Quad::Numbers at = load<Quad>(column + 2).numbers;
  const Quad turn = __builtin_shufflevector(at, at, 1, 2, 3, 3);
  storePair(load<Quad>(column) + velocity, turn + axis, column);
}
#endif

template <class T, int kCount>
JacobianKernel::Functions functions() {
  return {&point<T, kCount>, &addVelocity<T, kCount>, &addTwist<T, kCount>, &addAngular<T, kCount>};
}

}  // namespace

template <int kLanes>
JacobianKernel JacobianKernel::compiled() {
  Functions one = functions<double, 1>();
#ifdef __AVX__
  one.addTwist = &addTwistInLanes;
#endif
  return {one, functions<InLanes<kLanes>, kBlock>()};
}
template JacobianKernel JacobianKernel::compiled<REX_LANES>();

}  // namespace rex::internal
