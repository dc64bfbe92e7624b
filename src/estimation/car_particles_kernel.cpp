#include "base/sin_cos.h"
#include "estimation/car_particles_kernel_internal.h"

namespace rex::internal {
namespace {

/// The states of as many particles as T has lanes.
template <class T>
struct Cars {
  T x, y, heading;
};

template <class T>
inline Cars<T> carsApart(const double* states, long stride) {
  const double* lane[kLanesOf<T>];
#pragma GCC unroll 4
  for (int k = 0; k < kLanesOf<T>; ++k) lane[k] = states + stride * k;
  return {gathered<T>(lane, 0), gathered<T>(lane, 1), gathered<T>(lane, 2)};
}

template <class T>
inline void storeApart(const Cars<T>& cars, double* states, long stride) {
  double* lane[kLanesOf<T>];
#pragma GCC unroll 4
  for (int k = 0; k < kLanesOf<T>; ++k) lane[k] = states + stride * k;
  scatter(cars.x, lane, 0);
  scatter(cars.y, lane, 1);
  scatter(cars.heading, lane, 2);
}

#ifdef __AVX2__
using Quad = Pack<4>;

// Entry i of the result is entry i of the pack that comes first, second or third from place i on, cyclically.
inline Quad blended(const Quad& first, const Quad& second, const Quad& third) {
  const Quad both = __builtin_shufflevector(first.numbers, second.numbers, 0, 5, 2, 3);
  return __builtin_shufflevector(both.numbers, third.numbers, 0, 1, 6, 3);
}

// Four particles without gaps are the packs (x y h x), (y h x y) and (h x y h): blending and turning these
// takes less time than twelve loads or stores.
inline Cars<Quad> carsTogether(const double* states) {
  const Quad a = load<Quad>(states), b = load<Quad>(states + 4), c = load<Quad>(states + 8);
  const Quad::Numbers x = blended(a, c, b).numbers, y = blended(b, a, c).numbers,
                      h = blended(c, b, a).numbers;
  return {__builtin_shufflevector(x, x, 0, 3, 2, 1), __builtin_shufflevector(y, y, 1, 0, 3, 2),
          __builtin_shufflevector(h, h, 2, 1, 0, 3)};
}

inline void storeTogether(const Cars<Quad>& cars, double* states) {
  const Quad x = __builtin_shufflevector(cars.x.numbers, cars.x.numbers, 0, 3, 2, 1);
  const Quad y = __builtin_shufflevector(cars.y.numbers, cars.y.numbers, 1, 0, 3, 2);
  const Quad heading = __builtin_shufflevector(cars.heading.numbers, cars.heading.numbers, 2, 1, 0, 3);
  store(blended(x, y, heading), states);
  store(blended(y, heading, x), states + 4);
  store(blended(heading, x, y), states + 8);
}
#endif

template <class T>
inline Cars<T> loadCars(const double* states, long stride) {
#ifdef __AVX2__
  if constexpr (kLanesOf<T> == 4)
    if (stride == 3) return carsTogether(states);
#endif
  return carsApart<T>(states, stride);
}

template <class T>
inline void storeCars(const Cars<T>& cars, double* states, long stride) {
#ifdef __AVX2__
  if constexpr (kLanesOf<T> == 4)
    if (stride == 3) return storeTogether(cars, states);
#endif
  storeApart(cars, states, stride);
}

/// Angles in several lanes must be below the limit: the few beyond are left to one lane, so that no register
/// has to wait in memory for them.
template <class T>
inline SinCos<T> sinesOf(const T& angle) {
  if constexpr (kLanesOf<T> == 1)
    return sinCos(angle);
  else
    return sinCosBelowLimit(angle);
}

struct Move {
  const CarStep& step;
  const double* normals;
  double* states;
  long stride, count;

  /// Moves the particles from i on, as many as T has lanes; not if their headings are beyond the limit.
  template <class T>
  bool some(long i) const {
    const Cars<T> cars = loadCars<T>(states + stride * i, stride);
    if (kLanesOf < T >> 1 && !isBelowLimit(cars.heading)) return false;
    const SinCos<T> along = sinesOf(cars.heading);
    const auto noise = [&](int k) { return T(step.deviations[k]) * load<T>(normals + k * count + i); };
    storeCars<T>(
        {cars.x + (T(step.distance) * along.cosine + noise(0)),
         cars.y + (T(step.distance) * along.sine + noise(1)), cars.heading + (T(step.turn) + noise(2))},
        states + stride * i, stride);
    return true;
  }
};

struct Weighing {
  const Sighting* sightings;
  long sighted;
  const double* states;
  long stride, count;
  double* logWeights;

  template <class T>
  bool some(long i) const {
    const Cars<T> cars = loadCars<T>(states + stride * i, stride);
    if (kLanesOf < T >> 1 && !isBelowLimit(cars.heading)) return false;
    const SinCos<T> heading = sinesOf(cars.heading);
    T sum(0.0);
    for (long k = 0; k < sighted; ++k) {
      const Sighting& sighting = sightings[k];
      const T dx = T(sighting.landmark[0]) - cars.x, dy = T(sighting.landmark[1]) - cars.y;
      const T ahead = heading.cosine * dx + heading.sine * dy - T(sighting.seen[0]);
      const T left = heading.cosine * dy - heading.sine * dx - T(sighting.seen[1]);
      const double* information = sighting.information;
      sum = sum + ahead * (T(information[0]) * ahead + T(2 * information[1]) * left) +
            T(information[2]) * left * left;
    }
    store(load<T>(logWeights + i) - T(0.5) * sum, logWeights + i);
    return true;
  }
};

template <class Work>
__attribute__((noinline)) void doOneByOne(const Work& work, long begin, long end) {
  for (long i = begin; i < end; ++i) work.template some<double>(i);
}

// Flat, because the compiler would otherwise call sinCos() and pass its registers through memory.
template <class T, class Work>
__attribute__((flatten)) void doAll(const Work work) {
  long i = 0;
  for (; i + kLanesOf<T> <= work.count; i += kLanesOf<T>)
    if (!work.template some<T>(i)) doOneByOne(work, i, i + kLanesOf<T>);
  doOneByOne(work, i, work.count);
}

template <class T>
void move(const CarStep& step, const double* normals, double* states, long stride, long count) {
  doAll<T>(Move{step, normals, states, stride, count});
}

template <class T>
void weigh(const Sighting* sightings, long sighted, const double* states, long stride, long count,
           double* logWeights) {
  doAll<T>(Weighing{sightings, sighted, states, stride, count, logWeights});
}

}  // namespace

template <int kLanes>
CarParticlesKernel CarParticlesKernel::compiled() {
  return {.move = internal::move<InLanes<kLanes>>, .weigh = internal::weigh<InLanes<kLanes>>};
}
template CarParticlesKernel CarParticlesKernel::compiled<REX_LANES>();

}  // namespace rex::internal
