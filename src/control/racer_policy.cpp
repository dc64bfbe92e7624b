#include "control/racer_policy.h"

#include "control/racer_policy_internal.h"
#include "control/racer_policy_kernel_internal.h"
#include "control/require_internal.h"

namespace rex {

static_assert(RacerPolicy::kMostFeatures == internal::kRacerFeatures);

void internal::placeWeights(const RacerFeatures& features, const VectorArg& w, double* all, int stride) {
  struct Group {
    bool isThere;
    int begin, count;
  };
  const Group groups[] = {{true, 0, kRatePlace},
                          {features.rates, kRatePlace, kRacerSensors},
                          {features.averages, kAveragePlaces[0], kRacerSensors},
                          {features.averagedRates, kAveragedRatePlaces[0], kRacerSensors},
                          {features.averages, kAveragePlaces[1], kRacerSensors},
                          {features.averagedRates, kAveragedRatePlaces[1], kRacerSensors},
                          {features.controls, kControlPlace, kRacerFeatures - kControlPlace}};
  Eigen::Index next = 0;
  for (const Group& group : groups)
    for (int i = group.begin; i < group.begin + group.count; ++i)
      all[i * stride] = group.isThere ? w[next++] : 0;
}

RacerPolicy::RacerPolicy(const RacerFeatures& features, const VectorArg& w, double tau, double limit)
    : tau_(tau), limit_(limit) {
  requireSize("racer: weights of features", w.size(), features.count());
  requireFinite("racer: weights of features", w);
  requirePositive("racer: time step tau", tau);
  requirePositive("racer: limit of u", limit);
  internal::placeWeights(features, w, w_, 1);
}

double RacerPolicy::control(const Eigen::Vector4d& y) {
  requireFinite("racer: measured y", y);
  const double now[internal::kRacerSensors] = {y[0], y[1], y[2], y[3]};
  if (!hasPast_) internal::beginFeatures(now, features_);
  internal::advanceFeatures(now, 1 / tau_, features_);
  hasPast_ = true;
  return internal::nextControl(w_, limit_, features_);
}

}  // namespace rex
