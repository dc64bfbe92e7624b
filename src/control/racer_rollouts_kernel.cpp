#include "control/racer_policy_kernel_internal.h"
#include "control/racer_rollouts_kernel_internal.h"
#include "systems/normal_pair.h"

namespace rex::internal {
namespace {

static_assert(RacerRolloutsTask::kWeights == kRacerFeatures);

template <class T>
inline T squared(const T& x) {
  return x * x;
}

template <class T>
inline T costOf(const RacerRolloutsRules& rules, const RacerState<T>& s, const T (&y)[kRacerSensors]) {
  return T(rules.xCost) * squared(s.x) + T(rules.thetaCost) * squared(s.theta) +
         T(rules.gyroCost) * squared(y[2]) + T(rules.wheelCost) * squared(y[3]);
}

template <class T>
inline RacerState<T> startOf(const RacerRolloutsTask& task, int lane) {
  return {load<T>(task.start[0] + lane), load<T>(task.start[1] + lane), load<T>(task.start[2] + lane),
          load<T>(task.start[3] + lane)};
}

template <class T>
inline LaneRng<T> rngOf(const RacerRolloutsTask& task, int lane) {
  LaneRng<T> rng;
  for (int i = 0; i < RacerRolloutsTask::kWords; ++i)
    __builtin_memcpy(&rng.state[i], task.random[i] + lane, sizeof(T));
  return rng;
}

template <class T>
inline RacerState<T> noisyStep(const RacerRolloutsRules& rules, const RacerState<T>& s, const T& u,
                               LaneRng<T>& rng) {
  RacerState<T> next = racerStep(rules.dynamics, s, u, rules.tau);
  const RandomBits<T> bits = rng.next();
  const NormalPair<T> normals = normalPair<T>(bits, rng.next());
  next.v = next.v + T(rules.deviation) * normals.first;
  next.w = next.w + T(rules.deviation) * normals.second;
  return next;
}

// Rollouts that have failed keep their state, while the others next to them go on.
template <class T>
void runLanes(const RacerRolloutsRules& rules, RacerRolloutsTask& task, int lane) {
  const T one(1.0), zero(0.0);
  T w[kRacerFeatures], features[kRacerFeatures], y[kRacerSensors];
  for (int i = 0; i < kRacerFeatures; ++i) w[i] = load<T>(task.weights[i] + lane);
  LaneRng<T> rng = rngOf<T>(task, lane);
  RacerState<T> s = startOf<T>(task, lane);
  racerMeasure(rules.sensors, s, y);
  beginFeatures(y, features);

  T cost(0.0), steps(0.0), stands(1.0);  // stands: 1 or 0
  for (int t = 0; t < rules.steps && any(stands > zero); ++t) {
    advanceFeatures(y, 1 / rules.tau, features);
    const T u = nextControl(w, rules.largestControl, features);
    const RacerState<T> next = noisyStep(rules, s, u, rng);
    stands = select(absolute(next.theta) <= T(rules.largestAngle), stands, zero);
    const auto goesOn = stands > zero;
    s = {select(goesOn, next.x, s.x), select(goesOn, next.theta, s.theta), select(goesOn, next.v, s.v),
         select(goesOn, next.w, s.w)};
    racerMeasure(rules.sensors, s, y);
    cost = cost + select(goesOn, costOf(rules, s, y), zero);
    steps = steps + select(goesOn, one, zero);
  }
  cost = cost + T(rules.failureCost) * (T(double(rules.steps)) - steps);
  store(cost, task.cost + lane);
  store(steps, task.steps + lane);
}

template <class T>
void runBlock(const RacerRolloutsRules& rules, RacerRolloutsTask& task) {
  for (int lane = 0; lane < RacerRolloutsTask::kBlock; lane += kLanesOf<T>) runLanes<T>(rules, task, lane);
}

}  // namespace

template <int kLanes>
RacerRolloutsKernel RacerRolloutsKernel::compiled() {
  return {&runBlock<InLanes<kLanes>>};
}
template RacerRolloutsKernel RacerRolloutsKernel::compiled<REX_LANES>();

}  // namespace rex::internal
