#include "show.h"

#include <cmath>
#include <numbers>

#include "course/mdp_figures.h"
#include "learning/dynamic_programming.h"
#include "pole.h"

using namespace rex;

namespace {

GridWorld slipperyFloor() {
  return gridWorld(
      "........\n"
      ".##..#..\n"
      ".#...#.G\n"
      ".#.P.##.\n"
      "........\n",
      {.discount = .95, .stepReward = -.02, .slip = .2, .marks = {{'G', 1}, {'P', -1}}});
}

// The floor as a Process.
Process processOf(const GridWorld& world) {
  return {denseTransitions(world.mdp), world.mdp.rewards, world.mdp.discount};
}

void plotOf(const char* name, const char* title, Figure figure) {
  figure.title = title;
  plot(name, figure);
}

// Learns to balance a pole several times, with fresh noise. There are no curves if nothing is ever learned.
using Update = std::function<Eigen::VectorXd(const Policy&, const std::vector<Rollout>&)>;
std::vector<std::vector<double>> learnPole(const Policy& first, const Update& update) {
  std::vector<std::vector<double>> runs;
  bool isLearning = false;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Rng rng(seed);
    Policy policy = first;
    std::vector<double> returns;
    for (int i = 0; i < 40; ++i) {
      std::vector<Rollout> trials;
      double sum = 0;
      for (int j = 0; j < 20; ++j) {
        trials.push_back(runTrial(poleStep(rng), poleStart(rng), policy, kPoleHorizon, rng));
        sum += trials.back().rewards.sum() / 20;
      }
      returns.push_back(sum);
      const Eigen::VectorXd next = update(policy, trials);
      if (next.allFinite()) policy.beta = next;
    }
    runs.push_back(returns);
    isLearning = isLearning || policy.beta != first.beta;
  }
  if (!isLearning) runs.clear();
  return runs;
}

// Steps of length 1 along the gradient.
Eigen::VectorXd byReinforce(const Policy& policy, const std::vector<Rollout>& trials) {
  const Eigen::VectorXd g = reinforce(policy, trials, 1);
  return policy.beta + g / (g.norm() + 1e-9);
}

// Steps of length 1 in the metric F: w^T F w = w^T g.
Eigen::VectorXd byNaturalGradient(const Policy& policy, const std::vector<Rollout>& trials) {
  const Eigen::VectorXd w = naturalGradientOf(policy, trials, 1), g = reinforce(policy, trials, 1);
  return policy.beta + w / (std::sqrt(w.dot(g)) + 1e-9);
}

Eigen::VectorXd byPower(const Policy& policy, const std::vector<Rollout>& trials) {
  return power(policy, trials, 1);
}

// The same method if the angle, the first feature, is in degrees.
Update inDegrees(const Update& update) {
  return [update](const Policy& policy, const std::vector<Rollout>& trials) {
    const Eigen::Vector2d degrees(180 / std::numbers::pi, 1), radians = degrees.cwiseInverse();
    std::vector<Rollout> converted = trials;
    for (Rollout& trial : converted) {
      trial.features = degrees.asDiagonal() * trial.features;
      trial.noise = radians.asDiagonal() * trial.noise;
    }
    const Policy same{radians.asDiagonal() * policy.beta, radians.asDiagonal() * policy.L};
    return Eigen::VectorXd(degrees.asDiagonal() * update(same, converted));
  };
}

}  // namespace

void showRandomWalk() {
  const GridWorld world = slipperyFloor();
  const Process floor = processOf(world);
  const Eigen::VectorXd V = valuesOf(floor, Eigen::MatrixXd::Constant(floor.R.rows(), floor.R.cols(), .25));
  if (V.isZero()) return nothingYet("a random walk");
  plotOf("random", "Values of the random walk", valueFigure(world, V));

  const Eigen::MatrixXd worth = worthOfActions(floor, V);
  std::vector<int> best(static_cast<std::size_t>(V.size()));
  for (Eigen::Index s = 0; s < V.size(); ++s) worth.row(s).maxCoeff(&best[static_cast<std::size_t>(s)]);
  plotOf("improved", "The best actions by the values of the random walk",
         policyFigure(world, V, deterministicPolicy(world.mdp, best)));
}

void showOptimum(double tolerance) {
  const GridWorld world = slipperyFloor();
  const Process floor = processOf(world);
  const Eigen::VectorXd exact = policyIteration(world.mdp).V;
  const std::vector<Eigen::VectorXd> V = iterateValues(floor, tolerance);
  if (V.size() < 2) return nothingYet("value iteration");
  plotOf("optimal", "Optimal values", valueFigure(world, V.back()));

  Figure figure{.xLabel = "iteration", .yLabel = "greatest error", .logY = true};
  const auto error = [&](const Eigen::VectorXd& v) { return (v - exact).cwiseAbs().maxCoeff() + 1e-12; };
  Series& values = figure.series.emplace_back(Series{.label = "value iteration"});
  for (const Eigen::VectorXd& v : V) values.y.push_back(error(v));

  const std::vector<std::vector<int>> policies = iteratePolicies(floor);
  if (policies.size() > 1) {
    plotOf("policy", "Optimal policy",
           policyFigure(world, V.back(), deterministicPolicy(world.mdp, policies.back())));
    Series& steps =
        figure.series.emplace_back(Series{.label = "policy iteration", .style = SeriesStyle::kLinesPoints});
    for (const std::vector<int>& actions : policies)
      steps.y.push_back(error(valuesOf(floor, deterministicPolicy(world.mdp, actions))));
  } else {
    nothingYet("policy iteration");
  }
  plotOf("convergence", "Distance from the optimal values", figure);
}

void showRollouts(const Policy& policy) {
  Figure figure{.xLabel = "time [s]", .yLabel = "angle [rad]", .legend = Legend::kNone};
  Rng rng(1);
  for (int i = 0; i < 8; ++i) {
    const Eigen::MatrixXd states =
        runTrial(poleStep(rng), poleStart(rng), policy, kPoleHorizon, rng).features;
    if (states.cols() == 0) return nothingYet("trials");
    figure.series.push_back(overTime(states.row(0), .02));
  }
  plotOf("rollouts", "The pole before learning: eight trials", figure);
}

void showLearning(const Policy& first) {
  Rng rng(1);
  if (runTrial(poleStep(rng), poleStart(rng), first, kPoleHorizon, rng).rewards.size() == 0) return;
  std::vector<LearningCurves> curves, converted;
  const auto learnBy = [&](const std::string& label, const Update& update) {
    curves.push_back({label, learnPole(first, update)});
    if (!curves.back().runs.empty()) return converted.push_back({label, learnPole(first, inDegrees(update))});
    curves.pop_back();
    nothingYet("learning by " + label);
  };
  learnBy("REINFORCE", byReinforce);
  learnBy("natural gradient", byNaturalGradient);
  learnBy("PoWER", byPower);
  if (curves.empty()) return;
  const auto draw = [](const char* name, const char* title, const std::vector<LearningCurves>& drawn) {
    Figure figure = learningFigure(drawn);
    figure.xLabel = "iterations of 20 trials";
    figure.yRange = AxisRange(0, 100);
    plotOf(name, title, figure);
  };
  draw("learning", "Balancing a pole: ten runs each", curves);
  draw("degrees", "Balancing a pole with the angle in degrees", converted);
}
