#pragma once

// Eight single-precision numbers for kernels, in registers of 1, 4 or 8. They follow the rules of
// base/pack.h: all in an anonymous namespace, no templates of others, and all operations round as IEEE 754
// requires, so that a kernel gives the same bits for every width.
namespace rex {
namespace {

template <int kWidth>
struct FloatTypes;
template <>
struct FloatTypes<1> {
  typedef float Numbers;
  typedef int Mask;
};
template <>
struct FloatTypes<4> {
  typedef float Numbers __attribute__((vector_size(16)));
  typedef int Mask __attribute__((vector_size(16)));
};
template <>
struct FloatTypes<8> {
  typedef float Numbers __attribute__((vector_size(32)));
  typedef int Mask __attribute__((vector_size(32)));
};

inline int isLess(float a, float b) { return -static_cast<int>(a < b); }
template <class Numbers>
inline auto isLess(Numbers a, Numbers b) {
  return a < b;
}
inline float rooted(float x) { return __builtin_sqrtf(x); }
inline FloatTypes<4>::Numbers rooted(FloatTypes<4>::Numbers x) {
#ifdef __x86_64__
  return __builtin_ia32_sqrtps(x);
#else
  return FloatTypes<4>::Numbers{__builtin_sqrtf(x[0]), __builtin_sqrtf(x[1]), __builtin_sqrtf(x[2]),
                                __builtin_sqrtf(x[3])};
#endif
}
inline unsigned signsOf(int mask) { return static_cast<unsigned>(mask) & 1u; }
inline unsigned signsOf(FloatTypes<4>::Mask mask) {
#ifdef __x86_64__
  return static_cast<unsigned>(__builtin_ia32_movmskps(reinterpret_cast<FloatTypes<4>::Numbers>(mask)));
#else
  return static_cast<unsigned>((mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8));
#endif
}
#ifdef __AVX__
inline FloatTypes<8>::Numbers rooted(FloatTypes<8>::Numbers x) { return __builtin_ia32_sqrtps256(x); }
inline unsigned signsOf(FloatTypes<8>::Mask mask) {
  return static_cast<unsigned>(__builtin_ia32_movmskps256(reinterpret_cast<FloatTypes<8>::Numbers>(mask)));
}
#endif

/// Eight numbers with the arithmetic of one, and comparisons that give a Mask.
template <int kWidth>
struct Eight {
  using Numbers = typename FloatTypes<kWidth>::Numbers;
  static constexpr int kParts = 8 / kWidth;
  struct Mask {
    typename FloatTypes<kWidth>::Mask part[kParts];
    friend Mask operator&(const Mask& a, const Mask& b) {
      Mask both;
      for (int i = 0; i < kParts; ++i) both.part[i] = a.part[i] & b.part[i];
      return both;
    }
  };

  Numbers part[kParts];

  Eight() = default;
  Eight(float all) {
    for (Numbers& numbers : part) numbers = all - Numbers{};
  }

  template <class Operation>
  static Eight each(const Eight& a, const Eight& b, Operation operation) {
    Eight result;
    for (int i = 0; i < kParts; ++i) result.part[i] = operation(a.part[i], b.part[i]);
    return result;
  }
  friend Eight operator+(const Eight& a, const Eight& b) {
    return each(a, b, [](Numbers x, Numbers y) { return x + y; });
  }
  friend Eight operator-(const Eight& a, const Eight& b) {
    return each(a, b, [](Numbers x, Numbers y) { return x - y; });
  }
  friend Eight operator*(const Eight& a, const Eight& b) {
    return each(a, b, [](Numbers x, Numbers y) { return x * y; });
  }
  friend Mask operator<(const Eight& a, const Eight& b) {
    Mask mask;
    for (int i = 0; i < kParts; ++i) mask.part[i] = isLess(a.part[i], b.part[i]);
    return mask;
  }
};

template <int kWidth>
inline Eight<kWidth> select(const typename Eight<kWidth>::Mask& mask, const Eight<kWidth>& a,
                            const Eight<kWidth>& b) {
  Eight<kWidth> result;
  for (int i = 0; i < Eight<kWidth>::kParts; ++i) result.part[i] = mask.part[i] ? a.part[i] : b.part[i];
  return result;
}

/// One bit for each of the eight.
template <class Mask>
inline unsigned bitsOfLanes(const Mask& mask) {
  constexpr int kParts = sizeof mask.part / sizeof mask.part[0];
  unsigned bits = 0;
  for (int i = 0; i < kParts; ++i) bits |= signsOf(mask.part[i]) << (8 / kParts * i);
  return bits;
}

template <int kWidth>
inline Eight<kWidth> larger(const Eight<kWidth>& a, const Eight<kWidth>& b) {
  return select<kWidth>(b < a, a, b);
}
template <int kWidth>
inline Eight<kWidth> smaller(const Eight<kWidth>& a, const Eight<kWidth>& b) {
  return select<kWidth>(a < b, a, b);
}
template <int kWidth>
inline Eight<kWidth> absolute(const Eight<kWidth>& a) {
  return larger(a, Eight<kWidth>(0.0f) - a);
}
template <int kWidth>
inline Eight<kWidth> rooted(const Eight<kWidth>& a) {
  Eight<kWidth> result;
  for (int i = 0; i < Eight<kWidth>::kParts; ++i) result.part[i] = rooted(a.part[i]);
  return result;
}

/// Loads a V from the numbers that start at `from`, and stores it.
template <class V>
inline V loadAt(const float* from) {
  V result;
  __builtin_memcpy(&result, from, sizeof result);
  return result;
}
template <int kWidth>
inline void storeEight(const Eight<kWidth>& x, float* to) {
  __builtin_memcpy(to, &x, sizeof x);
}

/// Sine and cosine of angles of up to a few thousand radians, with an error of 2e-7. The polynomials are
/// those of Cephes (Moshier 1989).
template <int kWidth>
inline void sineAndCosine(const Eight<kWidth>& angle, Eight<kWidth>& sine, Eight<kWidth>& cosine) {
  using V = Eight<kWidth>;
  // Adding it rounds to an integer, of which the last bits are those of the number of quarter turns.
  constexpr float kRounding = 0x1.8p23f;
  const V rounded = angle * V(0x1.45f306p-1f) + V(kRounding);
  const V n = rounded - V(kRounding);
  const V r = angle - n * V(0x1.92p0f) - n * V(0x1.fbp-12f) - n * V(0x1.51p-22f) - n * V(0x1.0b4612p-34f);
  const V z = r * r;
  const V s = r + r * z * (V(-1.6666654611e-1f) + z * (V(8.3321608736e-3f) - z * V(1.9515295891e-4f)));
  const V c =
      V(1.0f) - V(0.5f) * z +
      z * z * (V(4.166664568298827e-2f) + z * (V(-1.388731625493765e-3f) + z * V(2.443315711809948e-5f)));
  for (int i = 0; i < V::kParts; ++i) {
    typename FloatTypes<kWidth>::Mask quarter, sineBits, cosineBits;
    __builtin_memcpy(&quarter, &rounded.part[i], sizeof quarter);
    __builtin_memcpy(&sineBits, &s.part[i], sizeof quarter);
    __builtin_memcpy(&cosineBits, &c.part[i], sizeof quarter);
    // An odd quarter swaps the two; bit 1 of the quarter is the sign of the sine, bit 1 of the next that of
    // the cosine.
    const auto swap = (sineBits ^ cosineBits) & -(quarter & 1);
    sineBits ^= swap ^ ((quarter & 2) << 30);
    cosineBits ^= swap ^ (((quarter + 1) & 2) << 30);
    __builtin_memcpy(&sine.part[i], &sineBits, sizeof quarter);
    __builtin_memcpy(&cosine.part[i], &cosineBits, sizeof quarter);
  }
}

}  // namespace
}  // namespace rex
