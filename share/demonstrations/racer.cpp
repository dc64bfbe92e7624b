// Chapter 9: A policy gradient and CMA-ES on a robot. Two racers learn to stand from the same number of
// rides, which last longer and longer, by the same cost and with the same five weights: the one in front by
// the natural gradient, the one behind by CMA-ES. Both show what they have learnt so far, in noise
// that is new to them.
// Slides: 9:17, 9:30, 9:31
// Formula: β ← β + α F⁻¹ ∇J(β), F the Fisher matrix; or CMA-ES on β
// Try: Two racers learn by the natural gradient and by CMA-ES. Press "natural or plain gradient": the plain
// one never balances. Press "growing or long rides".
#include <algorithm>
#include <cmath>
#include <optional>

#include "control/racer_task.h"
#include "course/course.h"
#include "course/live_view.h"
#include "course/racer_pictures.h"
#include "learning/policy_search.h"
#include "optim/cma_es.h"

using namespace rex;

int main() {
  constexpr int kRides = 40, kRounds = 100, kLambda = 10, kGenerations = 2;  // rides in a round, of each
  LiveView view("racer");
  view.lookFrom({1.2, -1.6, 0.7});
  const std::vector<Eigen::Vector4d> starts{{0, 0.2, 0, 0}, {0, -0.2, 0, 0}};
  std::vector<Trial> unseen;
  for (std::uint64_t k = 0; k < 20; ++k) unseen.push_back({starts[k % 2], 900000 + k});
  bool isNatural = true, growing = true;
  int round = kRounds, ride = 0, at = 0;
  std::uint64_t seed = 0;
  double last = -1;
  Rng rng, kicks[2];
  LinearGaussianPolicy policy;
  std::optional<CmaEs> search;
  RacerView racers;
  std::vector<RacerPolicy> shown;
  for (int t = 0; t < 300 || view.isWatched(); ++t) {
    const double deviation = view.slider("exploration [N m]", 0.1, 2, 0.5);
    const bool swapped = view.button("natural or plain gradient"),
               other = view.button("growing or long rides");
    if (swapped) isNatural = !isNatural;
    if (other) growing = !growing;
    if (view.button("again, other noise") || swapped || other || deviation != last) {
      last = deviation, round = at = 0, rng = Rng(seed++);
      policy = {Eigen::VectorXd::Zero(5), Eigen::MatrixXd::Zero(5, 5)};
      policy.Sigma(0, 0) = deviation * deviation;
      search.emplace(policy.beta, Eigen::VectorXd::Constant(5, 0.3), CmaOptions{.lambda = kLambda});
    }
    if (round < kRounds && t % 3 == 0) {
      const int stages[] = {50, 100, 200, 500}, steps = growing ? stages[4 * round / kRounds] : 500;
      const PolicySearchOptions one{
          .method = isNatural ? SearchMethod::kNaturalGradient : SearchMethod::kReinforce,
          .iterations = 1,
          .episodes = kRides,
          .rate = 1,
          .longestStep = 0.2};
      policy = improvedPolicy(rolloutSource(racerTask(starts, {.steps = steps})), policy, one, rng).policy;
      Eigen::MatrixXd W(5, kLambda);
      for (int generation = 0; generation < kGenerations; ++generation) {
        search->sample(W, rng);
        std::vector<Trial> trials;
        for (int k = 0; k < kRides / kLambda / kGenerations; ++k)
          trials.push_back({starts[k % 2], rng.next()});
        search->update(W, racerRollouts(W, trials, {.steps = steps}).cost.colwise().mean().transpose());
      }
      Eigen::MatrixXd both(5, 2);
      both << policy.beta, search->mean();
      const Eigen::RowVectorXd costs = racerRollouts(both, unseen).cost.colwise().mean() / 500;
      ++round;
      view.plot("log10 cost per step, gradient", round * kRides, std::log10(costs[0]), "rides");
      view.plot("log10 cost per step, CMA-ES", round * kRides, std::log10(costs[1]), "rides");
    }
    // The newest policies ride for three seconds; one that has fallen lies there until then.
    if (at++ % 90 == 0) {
      racers.x = starts[ride % 2].replicate(1, 2);
      kicks[0] = kicks[1] = Rng(1000000 + ride++);
      shown = {RacerPolicy({}, policy.beta), RacerPolicy({}, search->mean())};
    }
    for (int i = 0; i < 2; ++i)
      for (int step = 0; step < 3 && std::abs(racers.x(1, i)) < 0.8; ++step) {
        const double u = shown[i].control(RacerSensors{}.measured(racers.x.col(i), racers.dynamics.r));
        racers.x.col(i) = racers.dynamics.noisyStep(racers.x.col(i), u, 0.01, 0.1, kicks[i]);
      }
    racers.names = {isNatural ? "natural gradient" : "plain gradient", "CMA-ES"};
    racers.caption = std::to_string(round * kRides) + " rides";
    view.show(racerPicture(racers));
  }
}
