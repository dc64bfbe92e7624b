#pragma once

// Numbers in lanes, for kernels: templates on T, which is double or a Pack. A kernel is compiled once per
// number of lanes, each time with other machine instructions. Therefore everything here and in a kernel is in
// an anonymous namespace and uses no templates of Eigen or the standard library, whose code the linker would
// share. All operations round as IEEE 754 requires: a lane has the bits that a single double would have.
namespace rex {
namespace {

// Spelled out, because g++ 12 ignores a vector size that depends on a template and uses a plain double.
template <int kLanes>
struct LaneTypes;
template <>
struct LaneTypes<2> {
  typedef double Numbers __attribute__((vector_size(16)));
  typedef long long Mask __attribute__((vector_size(16)));
};
template <>
struct LaneTypes<4> {
  typedef double Numbers __attribute__((vector_size(32)));
  typedef long long Mask __attribute__((vector_size(32)));
};

/// kLanes numbers with the arithmetic of one.
template <int kLanes>
struct Pack {
  using Numbers = typename LaneTypes<kLanes>::Numbers;
  using Mask = typename LaneTypes<kLanes>::Mask;  ///< all bits of a lane, or none

  Numbers numbers;

  Pack() = default;
  Pack(Numbers given) : numbers(given) {}
  Pack(double all) : numbers(all - Numbers{}) {}

  friend Pack operator+(Pack a, Pack b) { return a.numbers + b.numbers; }
  friend Pack operator-(Pack a, Pack b) { return a.numbers - b.numbers; }
  friend Pack operator*(Pack a, Pack b) { return a.numbers * b.numbers; }
  friend Pack operator/(Pack a, Pack b) { return a.numbers / b.numbers; }
  friend Pack operator-(Pack a) { return -a.numbers; }
  friend Mask operator<(Pack a, Pack b) { return a.numbers < b.numbers; }
  friend Mask operator>(Pack a, Pack b) { return a.numbers > b.numbers; }
  friend Mask operator<=(Pack a, Pack b) { return a.numbers <= b.numbers; }
  friend Mask operator>=(Pack a, Pack b) { return a.numbers >= b.numbers; }
};

/// A number in kLanes lanes: a double or a Pack.
template <int kLanes>
struct InLanesType {
  using Type = Pack<kLanes>;
};
template <>
struct InLanesType<1> {
  using Type = double;
};
template <int kLanes>
using InLanes = typename InLanesType<kLanes>::Type;

/// How many lanes a T has.
template <class T>
inline constexpr int kLanesOf = sizeof(T) / sizeof(double);

/// Lane by lane: a where the mask holds, else b.
inline double select(bool mask, double a, double b) { return mask ? a : b; }
template <int kLanes>
inline Pack<kLanes> select(typename Pack<kLanes>::Mask mask, Pack<kLanes> a, Pack<kLanes> b) {
  return mask ? a.numbers : b.numbers;
}

/// The lanes in which the mask holds, one bit each.
inline int lanesOf(LaneTypes<2>::Mask mask) {
#ifdef __x86_64__
  return __builtin_ia32_movmskpd(reinterpret_cast<LaneTypes<2>::Numbers>(mask));
#else
  return static_cast<int>((mask[0] & 1) | (mask[1] & 2));
#endif
}
#ifdef __AVX__
inline int lanesOf(LaneTypes<4>::Mask mask) {
  return __builtin_ia32_movmskpd256(reinterpret_cast<LaneTypes<4>::Numbers>(mask));
}
#endif

/// Whether the mask holds in at least one lane, or in all.
inline bool any(bool mask) { return mask; }
inline bool all(bool mask) { return mask; }
template <class Mask>
inline bool any(Mask mask) {
  return lanesOf(mask) != 0;
}
template <class Mask>
inline bool all(Mask mask) {
  return lanesOf(mask) == (1 << sizeof(Mask) / sizeof(long long)) - 1;
}

/// The bits of each lane as an integer, to compute with, and back.
inline long long bitsOf(double x) {
  long long bits;
  __builtin_memcpy(&bits, &x, sizeof bits);
  return bits;
}
template <int kLanes>
inline typename Pack<kLanes>::Mask bitsOf(Pack<kLanes> x) {
  return reinterpret_cast<typename Pack<kLanes>::Mask>(x.numbers);
}
template <class T, class Bits>
inline T fromBits(Bits bits) {
  T x;
  __builtin_memcpy(&x, &bits, sizeof x);
  return x;
}

inline double squareRoot(double x) { return __builtin_sqrt(x); }
inline Pack<2> squareRoot(Pack<2> x) {
#ifdef __x86_64__
  return __builtin_ia32_sqrtpd(x.numbers);
#else
  return LaneTypes<2>::Numbers{__builtin_sqrt(x.numbers[0]),
                               __builtin_sqrt(x.numbers[1])};  // one instruction of NEON
#endif
}
#ifdef __AVX__
inline Pack<4> squareRoot(Pack<4> x) { return __builtin_ia32_sqrtpd256(x.numbers); }
#endif

/// Loads the numbers that start at `from`, one per lane, and stores them.
template <class T>
inline T load(const double* from) {
  T result;
  __builtin_memcpy(&result, from, sizeof(T));
  return result;
}
template <class T>
inline void store(const T& x, double* to) {
  __builtin_memcpy(to, &x, sizeof(T));
}

/// Loads entry i of each row, lane[0], lane[1], ..., into the lanes, and stores it back.
inline void gather(const double* const* lane, int i, double& x) { x = lane[0][i]; }
inline void gather(const double* const* lane, int i, Pack<2>& x) {
  x.numbers = LaneTypes<2>::Numbers{lane[0][i], lane[1][i]};
}
#ifdef __AVX__
inline void gather(const double* const* lane, int i, Pack<4>& x) {
  x.numbers = LaneTypes<4>::Numbers{lane[0][i], lane[1][i], lane[2][i], lane[3][i]};
}
#endif
template <class T>
inline T gathered(const double* const* lane, int i) {
  T x;
  gather(lane, i, x);
  return x;
}
inline void scatter(double x, double* const* lane, int i) { lane[0][i] = x; }
inline void scatter(const Pack<2>& x, double* const* lane, int i) {
  lane[0][i] = x.numbers[0];
  lane[1][i] = x.numbers[1];
}
#ifdef __AVX__
inline void scatter(const Pack<4>& x, double* const* lane, int i) {
  lane[0][i] = x.numbers[0];
  lane[1][i] = x.numbers[1];
  lane[2][i] = x.numbers[2];
  lane[3][i] = x.numbers[3];
}
#endif

template <class T>
inline T smaller(T a, T b) {
  return select(a < b, a, b);
}
template <class T>
inline T larger(T a, T b) {
  return select(a > b, a, b);
}
template <class T>
inline T absolute(T a) {
  return fromBits<T>(bitsOf(a) & 0x7fffffffffffffff);
}
template <class T>
inline T clamped(T a, T low, T high) {
  return smaller(larger(a, low), high);
}

}  // namespace
}  // namespace rex
