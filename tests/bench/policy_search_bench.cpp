#include <cmath>
#include <stdexcept>

#include "bench/row.h"
#include "control/racer_rollouts.h"

namespace rex::bench {

// Racers that are held for all of 500 steps, by a policy that takes all features, though only the sensors
// count: one generation of a search.
std::vector<Row> policySearchRows() {
  constexpr int kPolicies = 20, kTrials = 4;
  constexpr double kLimit = 1. / 20000;  // seconds per rollout
  const RacerRolloutOptions options{
      .features = {.rates = true, .averages = true, .averagedRates = true, .controls = true}};
  Eigen::VectorXd w = Eigen::VectorXd::Zero(options.features.count());
  w.head<9>() << 0.037, -0.986, 5.999, 0.726, 0.070, -0.001, -0.001, -0.004, 0.053;
  const Eigen::MatrixXd W = w.replicate(1, kPolicies);
  std::vector<Trial> trials;
  for (std::uint64_t seed = 0; seed < kTrials; ++seed) trials.push_back({{0, 0.2, 0, 0}, seed});
  if (racerRollouts(W, trials, options).steps.minCoeff() < options.steps)
    throw std::logic_error("a racer fell over: its rollout is short");

  const Measurement all = timed([=] { (void)racerRollouts(W, trials, options); });
  return {{.name = "policy-search-rollouts",
           .ours = [=] { return all() / (kPolicies * kTrials); },
           .peerName = "limit",
           .peer = [] { return kLimit; },
           .target = 1,
           .unit = "us"}};
}

}  // namespace rex::bench
