#pragma once

#include "base/lane_math.h"

// The motion and the sensors of the racer in plain numbers, for one or for many at once; see base/pack.h.
namespace rex {

struct RacerDynamics;
struct RacerSensors;

}  // namespace rex

namespace rex::internal {

/// What the racer's equations of motion are made of: M = [[inertiaX, coupling cos], [., inertiaTheta]] and
/// F = -coupling sin (theta'^2, g). The determinant of M is leastDeterminant + (coupling sin)^2, a sum of
/// what is not negative, where the difference of two products might lose it.
struct RacerNumbers {
  double inertiaX, inertiaTheta, coupling, gravity, perRadius, leastDeterminant;
};

/// What its sensors are made of.
struct RacerSensorNumbers {
  double scaledCosPhi, scaledSinPhi, kappaCosPhi, kappaSinPhi, gyroBias, perRadius;
};

/// These numbers. Throw Error for constants that are not positive, or not finite.
[[nodiscard]] RacerNumbers racerNumbers(const RacerDynamics& plant);
[[nodiscard]] RacerSensorNumbers racerSensorNumbers(const RacerSensors& sensors, double r);

namespace {

template <class T>
struct RacerState {
  T x, theta, v, w;  // w: of theta
};

template <class T>
struct RacerAccelerations {
  T x, theta;
};

template <class T>
inline RacerAccelerations<T> racerAccelerations(const RacerNumbers& k, const T& theta, const T& w,
                                                const T& u) {
  const SinCos<T> angle = sinCos(theta);
  const T mixed = T(k.coupling) * angle.cosine, swing = T(k.coupling) * angle.sine;
  const T alongX = u * T(k.perRadius) + swing * w * w, aboutAxis = swing * T(k.gravity) - u;
  const T perDeterminant = T(1.0) / (T(k.leastDeterminant) + swing * swing);
  return {(T(k.inertiaTheta) * alongX - mixed * aboutAxis) * perDeterminant,
          (T(k.inertiaX) * aboutAxis - mixed * alongX) * perDeterminant};
}

/// The classic step of Runge and Kutta: as accelerations depend on theta and theta' alone, its sums for the
/// positions are written out.
template <class T>
inline RacerState<T> racerStep(const RacerNumbers& k, const RacerState<T>& s, const T& u, double tau) {
  const T h(tau), half(tau / 2), sixth(tau / 6), sixthOfSquare(tau * tau / 6), two(2.0);
  const auto a1 = racerAccelerations(k, s.theta, s.w, u);
  const T w2 = s.w + half * a1.theta;
  const auto a2 = racerAccelerations(k, s.theta + half * s.w, w2, u);
  const T w3 = s.w + half * a2.theta;
  const auto a3 = racerAccelerations(k, s.theta + half * w2, w3, u);
  const T w4 = s.w + h * a3.theta;
  const auto a4 = racerAccelerations(k, s.theta + h * w3, w4, u);
  return {s.x + h * s.v + sixthOfSquare * (a1.x + a2.x + a3.x),
          s.theta + h * s.w + sixthOfSquare * (a1.theta + a2.theta + a3.theta),
          s.v + sixth * (a1.x + two * (a2.x + a3.x) + a4.x),
          s.w + sixth * (a1.theta + two * (a2.theta + a3.theta) + a4.theta)};
}

inline constexpr int kRacerSensors = 4;

template <class T>
inline void racerMeasure(const RacerSensorNumbers& k, const RacerState<T>& s, T (&y)[kRacerSensors]) {
  const SinCos<T> angle = sinCos(s.theta);
  const T square = s.w * s.w;
  y[0] = T(k.scaledCosPhi) * angle.cosine - T(k.scaledSinPhi) * angle.sine - T(k.kappaCosPhi) * square;
  y[1] = T(k.scaledCosPhi) * angle.sine + T(k.scaledSinPhi) * angle.cosine - T(k.kappaSinPhi) * square;
  y[2] = s.w - T(k.gyroBias);
  y[3] = s.x * T(k.perRadius) - s.theta;
}

}  // namespace
}  // namespace rex::internal
