#include <cmath>

#include "course/mdp_figures.h"
#include "exercise.h"
#include "learning/dynamic_programming.h"
#include "pole.h"

using namespace rex;

// Keeps the compiler quiet about what a function below does not use yet.
template <class... Unused>
void notUsedYet(const Unused&...) {}

MazeValues mazeValues(const Eigen::VectorXd& leaves, double discount) {
  // TODO: from the leaves to the root.
  notUsedYet(leaves, discount);
  return {Eigen::VectorXd::Zero(7), Eigen::VectorXd::Zero(7)};
}

Eigen::VectorXd valuesOf(const Process& process, const Eigen::MatrixXd& policy) {
  // TODO: eq. (9) for all states is one linear system. solve(A, b) gives the x with A x = b.
  notUsedYet(policy);
  return Eigen::VectorXd::Zero(process.R.rows());
}

Eigen::MatrixXd worthOfActions(const Process& process, const Eigen::VectorXd& V) {
  // TODO: the reward now, and what the next state is worth on average.
  notUsedYet(V);
  return Eigen::MatrixXd::Zero(process.R.rows(), process.R.cols());
}

std::vector<Eigen::VectorXd> iterateValues(const Process& process, double tolerance) {
  // TODO: the best of worthOfActions() in each state, until the bound in exercise.h is small enough.
  notUsedYet(tolerance);
  return {Eigen::VectorXd::Zero(process.R.rows())};
}

std::vector<std::vector<int>> iteratePolicies(const Process& process) {
  // TODO: the values of the last policy, the actions that are best by them, and again.
  return {std::vector<int>(static_cast<std::size_t>(process.R.rows()), 0)};
}

Trial runTrial(const StepFunction& step, const Eigen::VectorXd& start, const Policy& policy, int horizon,
               Rng& rng) {
  // TODO: draw epsilon, act, note down; until the horizon or a failure.
  notUsedYet(step, policy, horizon, rng);
  return {Eigen::MatrixXd(start.size(), 0), Eigen::MatrixXd(start.size(), 0), Eigen::VectorXd(0)};
}

Eigen::VectorXd returnsToGo(const Eigen::VectorXd& rewards, double discount) {
  // TODO: the last is the last reward. And the one before?
  notUsedYet(discount);
  return Eigen::VectorXd::Zero(rewards.size());
}

Eigen::VectorXd reinforce(const Policy& policy, const std::vector<Trial>& trials, double discount) {
  // TODO: differentiate the logarithm of the normal density of 9:16 by beta; how far was a from its mean?
  notUsedYet(trials, discount);
  return Eigen::VectorXd::Zero(policy.beta.size());
}

Eigen::VectorXd power(const Policy& policy, const std::vector<Trial>& trials, double discount) {
  // TODO: a matrix and a vector, summed over all steps of all trials.
  notUsedYet(trials, discount);
  return policy.beta;
}

// What follows is given.

// A slippery floor with a goal, a pit and walls, as a process of yours.
Process processOf(const GridWorld& world) {
  return {denseTransitions(world.mdp), world.mdp.rewards, world.mdp.discount};
}

void showMaze() {
  const MazeValues values = mazeValues(Eigen::Vector4d(4, 0, 2, 3), .5);
  print("T-maze, random policy", values.random.transpose());
  print("T-maze, optimal policy", values.optimal.transpose());
}

GridWorld slipperyFloor() {
  return gridWorld(
      "........\n"
      ".##..#..\n"
      ".#...#.G\n"
      ".#.P.##.\n"
      "........\n",
      {.discount = .95, .stepReward = -.02, .slip = .2, .marks = {{'G', 1}, {'P', -1}}});
}

// `exact` are the optimal values, of the library.
void showGrid(const GridWorld& world, const Eigen::VectorXd& exact) {
  const Process process = processOf(world);
  const Eigen::Index n = process.R.rows();
  Figure random = valueFigure(world, valuesOf(process, Eigen::MatrixXd::Constant(n, 4, .25)));
  random.title = "Values of walking at random";
  plot("random", random);

  const std::vector<Eigen::VectorXd> V = iterateValues(process, 1e-6);
  Figure optimal = valueFigure(world, V.back());
  optimal.title = "Optimal values";
  plot("optimal", optimal);
  const std::vector<std::vector<int>> policies = iteratePolicies(process);
  Figure policy = policyFigure(world, V.back(), policyOf(world.mdp, policies.back()));
  policy.title = "Optimal policy";
  plot("policy", policy);

  // How far both are from them, step by step.
  Figure figure{.title = "Distance from the optimal values",
                .xLabel = "iteration",
                .yLabel = "greatest error",
                .logY = true};
  Series values{.label = "value iteration"},
      steps{.label = "policy iteration", .style = SeriesStyle::kLinesPoints};
  for (const Eigen::VectorXd& v : V) values.y.push_back((v - exact).cwiseAbs().maxCoeff() + 1e-12);
  for (const std::vector<int>& actions : policies)
    steps.y.push_back((valuesOf(process, policyOf(world.mdp, actions)) - exact).cwiseAbs().maxCoeff() +
                      1e-12);
  figure.series = {values, steps};
  plot("convergence", figure);
}

// Learning to balance a pole, several times, with fresh noise.
using Update = std::function<Eigen::VectorXd(const Policy&, const std::vector<Trial>&)>;
LearningCurves learnPole(const std::string& label, const Update& update) {
  LearningCurves curves{label, {}};
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Rng rng(seed);
    Policy policy{Eigen::Vector2d::Zero(), 10 * Eigen::Matrix2d::Identity()};
    std::vector<double> returns;
    for (int i = 0; i < 40; ++i) {
      std::vector<Trial> trials;
      double sum = 0;
      for (int j = 0; j < 20; ++j) {
        trials.push_back(runTrial(poleStep(rng), poleStart(rng), policy, kPoleHorizon, rng));
        sum += trials.back().rewards.sum() / 20;
      }
      returns.push_back(sum);
      const Eigen::VectorXd next = update(policy, trials);
      if (next.allFinite()) policy.beta = next;
    }
    curves.runs.push_back(returns);
  }
  return curves;
}

void showPole() {
  const LearningCurves byGradient =
      learnPole("REINFORCE", [](const Policy& policy, const std::vector<Trial>& trials) {
        const Eigen::VectorXd g = reinforce(policy, trials, 1);
        return Eigen::VectorXd(policy.beta + g / (g.norm() + 1e-9));
      });
  const LearningCurves byPower = learnPole(
      "PoWER",
      [](const Policy& policy, const std::vector<Trial>& trials) { return power(policy, trials, 1); });
  Figure figure = learningFigure({byGradient, byPower});
  figure.title = "Balancing a pole: ten runs each";
  figure.xLabel = "iterations of 20 trials";
  plot("learning", figure);
}

int main() {
  showMaze();
  const GridWorld floor = slipperyFloor();
  showGrid(floor, policyIteration(floor.mdp).V);
  showPole();
}
