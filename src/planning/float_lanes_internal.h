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
inline unsigned signsOf(int mask) { return static_cast<unsigned>(mask) & 1u; }
inline unsigned signsOf(FloatTypes<4>::Mask mask) {
#ifdef __x86_64__
  return static_cast<unsigned>(__builtin_ia32_movmskps(reinterpret_cast<FloatTypes<4>::Numbers>(mask)));
#else
  return static_cast<unsigned>((mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8));
#endif
}
#ifdef __AVX__
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

}  // namespace
}  // namespace rex
