#pragma once

#include "base/lane_math.h"
#include "base/pack.h"

// Vectors, rotations and poses for kernels; T is double or a Pack. See base/pack.h for the reason for the
// anonymous namespace.
namespace rex {
namespace {

template <class T>
struct Vec3 {
  T x, y, z;

  friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
  friend Vec3 operator*(const T& s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
};

template <class T>
inline T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
inline Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A matrix by its columns, as Eigen stores it.
template <class T>
struct Mat3 {
  Vec3<T> c0, c1, c2;

  friend Vec3<T> operator*(const Mat3& m, const Vec3<T>& v) {
    return {m.c0.x * v.x + m.c1.x * v.y + m.c2.x * v.z, m.c0.y * v.x + m.c1.y * v.y + m.c2.y * v.z,
            m.c0.z * v.x + m.c1.z * v.y + m.c2.z * v.z};
  }
  friend Mat3 operator*(const Mat3& a, const Mat3& b) { return {a * b.c0, a * b.c1, a * b.c2}; }
};

/// Transpose of m times v: the world vector v in the frame whose axes are the columns of m.
template <class T>
inline Vec3<T> transposedTimes(const Mat3<T>& m, const Vec3<T>& v) {
  return {dot(m.c0, v), dot(m.c1, v), dot(m.c2, v)};
}

/// The rotation of the quaternion that starts at entry i of each row. Its length may be anything but zero;
/// it is scaled first, so that squares cannot overflow.
template <class T>
inline Mat3<T> rotationOfQuaternion(const double* const* lane, int i) {
  const T w0 = gathered<T>(lane, i), x0 = gathered<T>(lane, i + 1), y0 = gathered<T>(lane, i + 2),
          z0 = gathered<T>(lane, i + 3);
  const T size = larger(larger(absolute(w0), absolute(x0)), larger(absolute(y0), absolute(z0)));
  const T w = w0 / size, x = x0 / size, y = y0 / size, z = z0 / size;
  const T s = T(2.0) / (w * w + x * x + y * y + z * z), one(1.0);
  return {{one - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)},
          {s * (x * y - w * z), one - s * (x * x + z * z), s * (y * z + w * x)},
          {s * (x * z + w * y), s * (y * z - w * x), one - s * (x * x + y * y)}};
}

/// The layout of rex::Pose: the rotation by columns, then the origin.
template <class T>
struct KernelPose {
  Mat3<T> R;
  Vec3<T> p;

  friend KernelPose operator*(const KernelPose& a, const KernelPose& b) {
    return {a.R * b.R, a.R * b.p + a.p};
  }
};

/// The same constant in all lanes.
template <class T>
inline Vec3<T> broadcast(const Vec3<double>& v) {
  return {T(v.x), T(v.y), T(v.z)};
}
template <class T>
inline Mat3<T> broadcast(const Mat3<double>& m) {
  return {broadcast<T>(m.c0), broadcast<T>(m.c1), broadcast<T>(m.c2)};
}
template <class T>
inline KernelPose<T> broadcast(const KernelPose<double>& X) {
  return {broadcast<T>(X.R), broadcast<T>(X.p)};
}

/// Loads vectors and poses from numbers that are `stride` apart, one T each, and stores them: the stride is
/// 1 for one configuration, and 8 for blocks of them.
template <class T>
inline Vec3<T> loadVec3(const double* from, int stride) {
  return {load<T>(from), load<T>(from + stride), load<T>(from + 2 * stride)};
}
template <class T>
inline KernelPose<T> loadPose(const double* from, int stride) {
  return {{loadVec3<T>(from, stride), loadVec3<T>(from + 3 * stride, stride),
           loadVec3<T>(from + 6 * stride, stride)},
          loadVec3<T>(from + 9 * stride, stride)};
}
template <class T>
inline void storeVec3(const Vec3<T>& v, double* to, int stride) {
  store(v.x, to);
  store(v.y, to + stride);
  store(v.z, to + 2 * stride);
}
template <class T>
inline void storePose(const KernelPose<T>& X, double* to, int stride) {
  storeVec3(X.R.c0, to, stride);
  storeVec3(X.R.c1, to + 3 * stride, stride);
  storeVec3(X.R.c2, to + 6 * stride, stride);
  storeVec3(X.p, to + 9 * stride, stride);
}

/// The vector or pose (by columns) at `from` in all lanes.
template <class T>
inline Vec3<T> broadcastVec3(const double* from) {
  return {T(from[0]), T(from[1]), T(from[2])};
}
template <class T>
inline KernelPose<T> broadcastPose(const double* from) {
  return {{broadcastVec3<T>(from), broadcastVec3<T>(from + 3), broadcastVec3<T>(from + 6)},
          broadcastVec3<T>(from + 9)};
}

}  // namespace
}  // namespace rex

// One pose in lanes, for kernels of four: its columns, each in the first three lanes of a pack. All numbers
// have the bits that the functions above give. See base/pack.h for the reason for the anonymous namespace.
#ifdef __AVX__
namespace rex {
namespace {

using Quad = Pack<4>;

/// The fourth lanes are arbitrary.
struct PoseColumns {
  Quad x, y, z, p;
};

/// The layout of rex::Pose: twelve numbers.
inline PoseColumns loadColumns(const double* X) {
  const Quad end = load<Quad>(X + 8);
  return {load<Quad>(X), load<Quad>(X + 3), load<Quad>(X + 6),
          __builtin_shufflevector(end.numbers, end.numbers, 1, 2, 3, 3)};
}

/// Stores two columns one after the other, six numbers; the second store overwrites the fourth lane of a.
inline void storePair(const Quad& a, const Quad& b, double* to) {
  store(a, to);
  store(Quad(__builtin_shufflevector(a.numbers, b.numbers, 2, 4, 5, 6)), to + 2);
}
inline void storeColumns(const PoseColumns& X, double* to) {
  storePair(X.x, X.y, to);
  storePair(X.z, X.p, to + 6);
}

/// R v.
inline Quad turned(const PoseColumns& X, const double* v) {
  return X.x * Quad(v[0]) + X.y * Quad(v[1]) + X.z * Quad(v[2]);
}

/// X times the pose at `motion`, which has the layout of rex::Pose.
inline PoseColumns times(const PoseColumns& X, const double* motion) {
  return {turned(X, motion), turned(X, motion + 3), turned(X, motion + 6), turned(X, motion + 9) + X.p};
}

/// Sines and cosines of `count` angles, four at once; all three have room for whole packs.
inline void sinesOf(const double* angles, int count, double* sines, double* cosines) {
  for (int i = 0; i < count; i += kLanesOf<Quad>) {
    const SinCos<Quad> turn = sinCos(load<Quad>(angles + i));
    store(turn.sine, sines + i);
    store(turn.cosine, cosines + i);
  }
}

inline Quad crossColumns(const Quad& a, const Quad& b) {
  const auto yzx = [](const Quad& v) { return __builtin_shufflevector(v.numbers, v.numbers, 1, 2, 0, 3); };
  const auto zxy = [](const Quad& v) { return __builtin_shufflevector(v.numbers, v.numbers, 2, 0, 1, 3); };
  return yzx(a) * zxy(b) - zxy(a) * yzx(b);
}

}  // namespace
}  // namespace rex
#endif
