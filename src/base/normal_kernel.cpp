#include "base/exp_log.h"
#include "base/normal_kernel_internal.h"
#include "base/sin_cos.h"

namespace rex::internal {
namespace {

// Unsigned, because random words overflow.
template <int kLanes>
struct Words;
template <>
struct Words<1> {
  typedef unsigned long long Type;
};
template <>
struct Words<2> {
  typedef unsigned long long Type __attribute__((vector_size(16)));
};
template <>
struct Words<4> {
  typedef unsigned long long Type __attribute__((vector_size(32)));
};

template <class Word>
inline Word rotated(Word x, int by) {
  return (x << by) | (x >> (64 - by));
}

template <class Word>
struct Generator {
  Word word[4];

  Word next() {
    const Word result = rotated(word[0] + word[3], 23) + word[0];
    const Word t = word[1] << 17;
    word[2] ^= word[0];
    word[3] ^= word[1];
    word[1] ^= word[2];
    word[0] ^= word[3];
    word[2] ^= t;
    word[3] = rotated(word[3], 45);
    return result;
  }
};

// Uniform in [1, 2), on a grid of 2^-52: the high bits as a fraction.
template <class T, class Word>
inline T fromOneToTwo(Word bits) {
  return fromBits<T>((bits >> 12) | 0x3ff0000000000000);
}

template <class T>
void fillBlocks(std::uint64_t* words, double* numbers, long blocks) {
  constexpr int kLanes = kLanesOf<T>, kStreams = NormalKernel::kStreams;
  constexpr double kTwoPi = 6.283185307179586;
  for (int stream = 0; stream < kStreams; stream += kLanes) {
    Generator<typename Words<kLanes>::Type> generator;
    for (int i = 0; i < 4; ++i)
      __builtin_memcpy(&generator.word[i], words + i * kStreams + stream, sizeof generator.word[i]);
    double* out = numbers + stream;
    for (long block = 0; block < blocks; ++block, out += 2 * kStreams) {
      const T u = T(2.0) - fromOneToTwo<T>(generator.next());  // in (0, 1]
      const T turn = fromOneToTwo<T>(generator.next()) - T(1.5);
      const T radius = squareRoot(T(-2.0) * logarithm(u));
      const SinCos<T> direction = sinCosBelowLimit(turn * T(kTwoPi));
      store(radius * direction.cosine, out);
      store(radius * direction.sine, out + kStreams);
    }
    for (int i = 0; i < 4; ++i)
      __builtin_memcpy(words + i * kStreams + stream, &generator.word[i], sizeof generator.word[i]);
  }
}

}  // namespace

template <int kLanes>
NormalKernel NormalKernel::compiled() {
  return {&fillBlocks<InLanes<kLanes>>};
}
template NormalKernel NormalKernel::compiled<REX_LANES>();

}  // namespace rex::internal
