#include <algorithm>
#include <cmath>

#include "exercise.h"
#include "show.h"

using namespace rex;

MazeValues mazeValues(const Eigen::VectorXd& leaves, double discount) {
  // TODO: from the leaves to the root.
  return {Eigen::VectorXd::Zero(7), Eigen::VectorXd::Zero(7)};
}

Eigen::VectorXd valuesOf(const Process& process, const Eigen::MatrixXd& policy) {
  // TODO: eq. (9) for all states is one linear system. solve(A, b) gives the x with A x = b.
  return Eigen::VectorXd::Zero(process.R.rows());
}

Eigen::MatrixXd worthOfActions(const Process& process, const Eigen::VectorXd& V) {
  // TODO: the reward now, and what the next state is worth on average.
  return Eigen::MatrixXd::Zero(process.R.rows(), process.R.cols());
}

std::vector<Eigen::VectorXd> iterateValues(const Process& process, double tolerance) {
  // TODO: the best of worthOfActions() in each state, until the bound in exercise.h is small enough.
  return {Eigen::VectorXd::Zero(process.R.rows())};
}

std::vector<std::vector<int>> iteratePolicies(const Process& process) {
  // TODO: the values of the last policy, the actions that are best by them, and again.
  return {std::vector<int>(static_cast<std::size_t>(process.R.rows()), 0)};
}

Rollout runTrial(const StepFunction& step, const Eigen::VectorXd& start, const Policy& policy, int horizon,
                 Rng& rng) {
  // TODO: draw epsilon, act, note down; until the horizon or a failure.
  return {Eigen::MatrixXd(start.size(), 0), Eigen::MatrixXd(start.size(), 0), Eigen::VectorXd(0)};
}

Eigen::VectorXd returnsToGo(const Eigen::VectorXd& rewards, double discount) {
  // TODO: the last is the last reward. And the one before?
  return Eigen::VectorXd::Zero(rewards.size());
}

Eigen::VectorXd reinforce(const Policy& policy, const std::vector<Rollout>& trials, double discount) {
  // TODO: differentiate the logarithm of the normal density of 9:16 by beta; how far was a from its mean?
  return Eigen::VectorXd::Zero(policy.beta.size());
}

Eigen::VectorXd power(const Policy& policy, const std::vector<Rollout>& trials, double discount) {
  // TODO: a matrix and a vector, summed over all steps of all trials.
  return policy.beta;
}

Eigen::VectorXd naturalGradientOf(const Policy& policy, const std::vector<Rollout>& trials, double discount) {
  // TODO: F is a mean over the trials, like reinforce(). Then solve F w = g.
  return Eigen::VectorXd::Zero(policy.beta.size());
}

// What follows is given, and never graded: change it as you like. show.h says what each line draws.

int main() {
  // Part 1: the T-maze of the sheet, with its leaves and its discount.
  const MazeValues maze = mazeValues(Eigen::Vector4d(4, 0, 2, 3), .5);
  print("T-maze, random policy", maze.random.transpose());
  print("T-maze, optimal policy", maze.optimal.transpose());

  // Parts 2 to 4: a floor with a goal, a pit and walls, where one move in five slips to the side.
  showRandomWalk();
  showOptimum(1e-6);

  // Parts 5 to 8: a pole to balance. Learning begins with parameters of zero and a noise of 10 in both.
  const Policy first{Eigen::Vector2d::Zero(), 10 * Eigen::Matrix2d::Identity()};
  showRollouts(first);
  showLearning(first);
}
