#include "base/sin_cos.h"
#include "estimation/car_particles_kernel_internal.h"

namespace rex::internal {
namespace {

/// The states of as many particles as T has lanes.
template <class T, class Number>
struct Lanes {
  Number* lane[kLanesOf<T>];

  Lanes(Number* states, long stride, long first) {
    for (int k = 0; k < kLanesOf<T>; ++k) lane[k] = states + stride * (first + k);
  }
};

template <class T>
inline void moveSome(const CarStep& step, const double* normals, double* states, long stride, long count,
                     long i) {
  const Lanes<T, double> lanes(states, stride, i);
  const T heading = gathered<T>(lanes.lane, 2);
  const SinCos<T> along = sinCos(heading);
  const auto noise = [&](int k) { return T(step.deviations[k]) * load<T>(normals + k * count + i); };
  scatter(gathered<T>(lanes.lane, 0) + (T(step.distance) * along.cosine + noise(0)), lanes.lane, 0);
  scatter(gathered<T>(lanes.lane, 1) + (T(step.distance) * along.sine + noise(1)), lanes.lane, 1);
  scatter(heading + (T(step.turn) + noise(2)), lanes.lane, 2);
}

template <class T>
inline void weighSome(const Sighting* sightings, long sighted, const double* states, long stride,
                      double* logWeights, long i) {
  const Lanes<T, const double> lanes(states, stride, i);
  const T x = gathered<T>(lanes.lane, 0), y = gathered<T>(lanes.lane, 1);
  const SinCos<T> heading = sinCos(gathered<T>(lanes.lane, 2));
  T sum(0.0);
  for (long k = 0; k < sighted; ++k) {
    const Sighting& sighting = sightings[k];
    const T dx = T(sighting.landmark[0]) - x, dy = T(sighting.landmark[1]) - y;
    const T ahead = heading.cosine * dx + heading.sine * dy - T(sighting.seen[0]);
    const T left = heading.cosine * dy - heading.sine * dx - T(sighting.seen[1]);
    const double* information = sighting.information;
    sum = sum + ahead * (T(information[0]) * ahead + T(2 * information[1]) * left) +
          T(information[2]) * left * left;
  }
  store(load<T>(logWeights + i) - T(0.5) * sum, logWeights + i);
}

// Flat, because the compiler would otherwise call sinCos() and pass its registers through memory.
template <class T>
__attribute__((flatten)) void move(const CarStep& step, const double* normals, double* states, long stride,
                                   long count) {
  long i = 0;
  for (; i + kLanesOf<T> <= count; i += kLanesOf<T>) moveSome<T>(step, normals, states, stride, count, i);
  for (; i < count; ++i) moveSome<double>(step, normals, states, stride, count, i);
}

template <class T>
__attribute__((flatten)) void weigh(const Sighting* sightings, long sighted, const double* states,
                                    long stride, long count, double* logWeights) {
  long i = 0;
  for (; i + kLanesOf<T> <= count; i += kLanesOf<T>)
    weighSome<T>(sightings, sighted, states, stride, logWeights, i);
  for (; i < count; ++i) weighSome<double>(sightings, sighted, states, stride, logWeights, i);
}

}  // namespace

template <int kLanes>
CarParticlesKernel CarParticlesKernel::compiled() {
  return {.move = internal::move<InLanes<kLanes>>, .weigh = internal::weigh<InLanes<kLanes>>};
}
template CarParticlesKernel CarParticlesKernel::compiled<REX_LANES>();

}  // namespace rex::internal
