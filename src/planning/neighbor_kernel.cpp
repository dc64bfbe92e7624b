#include "planning/float_lanes_internal.h"
#include "planning/neighbor_kernel_internal.h"

namespace rex::internal {
namespace {

using Kind = NeighborPart::Kind;

template <class V>
inline V squareOf(const V& x) {
  return x * x;
}

// How far a number is from intervals: 0 inside.
template <class V>
inline V gapTo(const V& x, const V& lower, const V& upper) {
  return larger(larger(lower - x, x - upper), V(0.0f));
}

// Eight points, or eight boxes, and how far x is from number i of each; on a circle, the shorter way round.
template <class V>
struct Points {
  const float* numbers;
  V gap(int i, float x) const { return V(x) - loadAt<V>(numbers + 8 * i); }
  V gapAround(int i, float x, float period) const {
    const V way = absolute(gap(i, x));
    return smaller(way, V(period) - way);
  }
};

template <class V>
struct Boxes {
  const float* lower;
  const float* upper;
  V gap(int i, float x) const { return gapTo(V(x), loadAt<V>(lower + 8 * i), loadAt<V>(upper + 8 * i)); }
  V gapAround(int i, float x, float period) const {
    const V way = gap(i, x);
    return smaller(way, V(period) - (loadAt<V>(upper + 8 * i) - loadAt<V>(lower + 8 * i)) - way);
  }
};

template <class V, class Block>
inline V squaredDistances(const NeighborParts& space, const Block& block, const float* x) {
  V sum(0.0f);
  if (space.isStraight) {
    for (int i = 0; i < space.size; ++i) sum = sum + squareOf(block.gap(i, x[i]));
    return sum;
  }
  int i = 0;
  for (int p = 0; p < space.count; ++p) {
    const NeighborPart& part = space.parts[p];
    if (part.kind == Kind::kQuaternion) {
      V same(0.0f), opposite(0.0f);
      for (int k = i; k < i + 4; ++k) {
        same = same + squareOf(block.gap(k, x[k]));
        opposite = opposite + squareOf(block.gap(k, -x[k]));
      }
      sum = sum + smaller(same, opposite);
      i += 4;
    } else {
      sum = sum +
            squareOf(part.kind == Kind::kLine ? block.gap(i, x[i]) : block.gapAround(i, x[i], part.period));
      ++i;
    }
  }
  return sum;
}

template <int kWidth>
float distancesFromPoints(const NeighborParts& space, const float* numbers, int blocks, const float* x,
                          float* squared) {
  using V = Eight<kWidth>;
  V least(3e38f);
  for (int b = 0; b < blocks; ++b) {
    const V distances = squaredDistances<V>(space, Points<V>{numbers + 8 * b * space.size}, x);
    storeEight(distances, squared + 8 * b);
    least = smaller(distances, least);
  }
  float eight[8];
  storeEight(least, eight);
  float result = eight[0];
  for (const float one : eight) result = one < result ? one : result;
  return result;
}

template <int kWidth>
void distancesFromBoxes(const NeighborParts& space, const float* boxes, int blocks, const float* x,
                        float* squared) {
  using V = Eight<kWidth>;
  for (int b = 0; b < blocks; ++b) {
    const float* lower = boxes + 16 * b * space.size;
    storeEight(squaredDistances<V>(space, Boxes<V>{lower, lower + 8 * space.size}, x), squared + 8 * b);
  }
}

template <int kWidth>
unsigned long long notBeyond(const float* squared, int blocks, float reach) {
  using V = Eight<kWidth>;
  unsigned long long beyond = 0;
  for (int b = 0; b < blocks; ++b)
    beyond |= static_cast<unsigned long long>(bitsOfLanes(V(reach) < loadAt<V>(squared + 8 * b))) << 8 * b;
  return ~beyond;
}

}  // namespace

template <int kLanes>
NeighborKernel NeighborKernel::compiled() {
  constexpr int kWidth = kLanes == 1 ? 1 : 2 * kLanes;
  return {&distancesFromPoints<kWidth>, &distancesFromBoxes<kWidth>, &notBeyond<kWidth>};
}
template NeighborKernel NeighborKernel::compiled<REX_LANES>();

}  // namespace rex::internal
