#pragma once

#include "systems/racer_kernel.h"

// Features of what the racer measured, for one or for many at once; see base/pack.h.
namespace rex::internal {
namespace {

inline constexpr int kRacerFeatures = 27;
/// Where features of all four sensors begin, and those of controls. The others are 1.
inline constexpr int kSensorPlace = 1, kRatePlace = 5, kAveragePlaces[] = {9, 17},
                     kAveragedRatePlaces[] = {13, 21}, kControlPlace = 25;
inline constexpr double kRacerFactors[] = {0.5, 0.9};

/// As if y had been measured for ever without any control.
template <class T>
inline void beginFeatures(const T (&y)[kRacerSensors], T (&features)[kRacerFeatures]) {
  for (T& feature : features) feature = T(0.0);
  features[0] = T(1.0);
  for (int i = 0; i < kRacerSensors; ++i)
    features[kSensorPlace + i] = features[kAveragePlaces[0] + i] = features[kAveragePlaces[1] + i] = y[i];
}

/// From the features before to those with y.
template <class T>
inline void advanceFeatures(const T (&y)[kRacerSensors], double perTau, T (&features)[kRacerFeatures]) {
  for (int i = 0; i < kRacerSensors; ++i) {
    const T rate = (y[i] - features[kSensorPlace + i]) * T(perTau);
    features[kSensorPlace + i] = y[i];
    features[kRatePlace + i] = rate;
    for (int k = 0; k < 2; ++k) {
      const T share(1 - kRacerFactors[k]);
      T &average = features[kAveragePlaces[k] + i], &averagedRate = features[kAveragedRatePlaces[k] + i];
      average = average + share * (y[i] - average);
      averagedRate = averagedRate + share * (rate - averagedRate);
    }
  }
}

/// w . features within the limit, which becomes the last control among them.
template <class T>
inline T nextControl(const T* w, double limit, T (&features)[kRacerFeatures]) {
  // Sums of their own, which do not wait for one another.
  T sums[4] = {w[0] * features[0], w[1] * features[1], w[2] * features[2], w[3] * features[3]};
  for (int i = 4; i < kRacerFeatures; ++i) sums[i % 4] = sums[i % 4] + w[i] * features[i];
  const T u = clamped((sums[0] + sums[1]) + (sums[2] + sums[3]), T(-limit), T(limit));
  features[kControlPlace + 1] = features[kControlPlace];
  features[kControlPlace] = u;
  return u;
}

}  // namespace
}  // namespace rex::internal
