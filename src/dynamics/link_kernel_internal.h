#pragma once

#include "base/lane_math.h"
#include "geometry/kernel_math.h"
#include "scene/link.h"

namespace rex::internal {

/// What kernels of dynamics are called with, for n states at once: q[k], v[k] and given[k] point to the
/// numbers of state k, and result[k] to where its result goes.
struct DynamicsTask {
  const Link* links;
  int linkCount, nv;
  const double* gravity_W;
  const double* const* q;
  const double* const* v;
  const double* const* given;
  double* const* result;
  void* memory;                     ///< as many numbers as the kernel says
  static constexpr int kBlock = 8;  ///< states in a block
};

}  // namespace rex::internal

// What kernels of dynamics share; see base/pack.h for why all is anonymous.
namespace rex {
namespace {

template <class T>
inline Mat3<T> transposed(const Mat3<T>& m) {
  return {{m.c0.x, m.c1.x, m.c2.x}, {m.c0.y, m.c1.y, m.c2.y}, {m.c0.z, m.c1.z, m.c2.z}};
}
template <class T>
inline Mat3<T> operator+(const Mat3<T>& a, const Mat3<T>& b) {
  return {a.c0 + b.c0, a.c1 + b.c1, a.c2 + b.c2};
}
/// [v]x m.
template <class T>
inline Mat3<T> cross(const Vec3<T>& v, const Mat3<T>& m) {
  return {cross(v, m.c0), cross(v, m.c1), cross(v, m.c2)};
}
/// v x z
template <class T>
inline Vec3<T> crossZ(const Vec3<T>& v) {
  return {v.y, -v.x, T(0.0)};
}

/// A symmetric matrix.
template <class T>
struct Sym3 {
  T xx, xy, xz, yy, yz, zz;

  friend Sym3 operator+(const Sym3& a, const Sym3& b) {
    return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
  }
  friend Vec3<T> operator*(const Sym3& s, const Vec3<T>& v) {
    return {s.xx * v.x + s.xy * v.y + s.xz * v.z, s.xy * v.x + s.yy * v.y + s.yz * v.z,
            s.xz * v.x + s.yz * v.y + s.zz * v.z};
  }
};
template <class T>
inline Mat3<T> full(const Sym3<T>& s) {
  return {{s.xx, s.xy, s.xz}, {s.xy, s.yy, s.yz}, {s.xz, s.yz, s.zz}};
}
/// A matrix that is symmetric but for rounding; what is computed of its lower half only is left out.
template <class T>
inline Sym3<T> symmetric(const Mat3<T>& m) {
  return {m.c0.x, m.c1.x, m.c2.x, m.c1.y, m.c2.y, m.c2.z};
}
/// R S R^T.
template <class T>
[[gnu::always_inline]] inline Sym3<T> rotated(const Mat3<T>& R, const Sym3<T>& S) {
  return symmetric(R * full(S) * transposed(R));
}
template <class T>
inline Sym3<T> broadcastSym3(const double* from) {
  return {T(from[0]), T(from[1]), T(from[2]), T(from[3]), T(from[4]), T(from[5])};
}

/// Where the frame of a link stands in that of its parent; see scene/link.h.
template <class T>
inline KernelPose<T> poseInParent(const Link& link, const double* const* q) {
  KernelPose<T> X = broadcastPose<T>(link.X_PL);
  if (link.kind == Link::Kind::kQuaternion) {
    X.R = X.R * rotationOfQuaternion<T>(q, link.qIndex);
    return X;
  }
  const T x = T(link.ratio) * gathered<T>(q, link.qIndex) + T(link.offset);
  if (link.kind == Link::Kind::kSlider) {
    X.p = X.p + x * X.R.c2;
    return X;
  }
  if (link.kind == Link::Kind::kScrew) X.p = X.p + T(link.pitch) * x * X.R.c2;
  const SinCos<T> turn = sinCos(x);
  const Vec3<T> c0 = X.R.c0;
  X.R.c0 = turn.cosine * c0 + turn.sine * X.R.c1;
  X.R.c1 = turn.cosine * X.R.c1 - turn.sine * c0;
  return X;
}

}  // namespace
}  // namespace rex

// See base/pack.h for why all is anonymous.
#ifdef __AVX__
namespace rex {
namespace {

/// Where the frame of a link stands in that of its parent, as poseInParent(), with these functions of its
/// coordinate x; not of a quaternion.
inline PoseColumns columnsInParent(const Link& link, double x, double sine, double cosine) {
  PoseColumns X = loadColumns(link.X_PL);
  if (link.kind == Link::Kind::kSlider) {
    X.p = X.p + Quad(x) * X.z;
    return X;
  }
  if (link.kind == Link::Kind::kScrew) X.p = X.p + Quad(link.pitch * x) * X.z;
  const Quad c0 = X.x;
  X.x = Quad(cosine) * c0 + Quad(sine) * X.y;
  X.y = Quad(cosine) * X.y - Quad(sine) * c0;
  return X;
}

/// Places the links in the world, one posture in lanes: four sines at once, and poses by columns, which stay
/// in registers as long as the next link hangs on the one before. pose(i) is where the twelve numbers of link
/// i go.
template <class PoseOf>
inline void placeByColumns(const Link* links, int count, const double* q, const PoseOf& pose) {
  constexpr int kAhead = 16;
  PoseColumns X{};
  for (int begin = 0; begin < count; begin += kAhead) {
    const int end = begin + kAhead < count ? begin + kAhead : count;
    double x[kAhead] = {}, sines[kAhead], cosines[kAhead];
    for (int i = begin; i < end; ++i)
      if (links[i].kind != Link::Kind::kQuaternion)
        x[i - begin] = links[i].ratio * q[links[i].qIndex] + links[i].offset;
    sinesOf(x, end - begin, sines, cosines);
    for (int i = begin; i < end; ++i) {
      const Link& link = links[i];
      double motion[12];
      if (link.kind == Link::Kind::kQuaternion)
        storePose(poseInParent<double>(link, &q), motion, 1);
      else
        storeColumns(columnsInParent(link, x[i - begin], sines[i - begin], cosines[i - begin]), motion);
      if (link.parent == Link::kNoParent) {
        X = loadColumns(motion);
      } else {
        if (link.parent != i - 1) X = loadColumns(pose(link.parent));
        X = times(X, motion);
      }
      storeColumns(X, pose(i));
    }
  }
}

}  // namespace
}  // namespace rex
#endif
