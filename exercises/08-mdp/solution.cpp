#include <algorithm>
#include <cmath>

#include "exercise.h"
#include "show.h"
// <solution headers>
// What a mistake in wrong.cpp takes from the library.
// <todo>
// </solution>

using namespace rex;

MazeValues mazeValues(const Eigen::VectorXd& leaves, double discount) {
  // <solution mazeValues>
  MazeValues values{Eigen::VectorXd(7), Eigen::VectorXd(7)};
  values.random.tail(4) = values.optimal.tail(4) = leaves;
  for (int s = 2; s >= 0; --s) {
    const int left = 2 * s + 1, right = 2 * s + 2;
    values.random[s] = discount * (values.random[left] + values.random[right]) / 2;
    values.optimal[s] = discount * std::max(values.optimal[left], values.optimal[right]);
  }
  return values;
  // <todo>
  //| // TODO: from the leaves to the root.
  //| return {Eigen::VectorXd::Zero(7), Eigen::VectorXd::Zero(7)};
  // </solution>
}

Eigen::VectorXd valuesOf(const Process& process, const Eigen::MatrixXd& policy) {
  // <solution valuesOf>
  const Eigen::Index n = process.R.rows();
  Eigen::MatrixXd M = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index a = 0; a < process.R.cols(); ++a)
    M -= process.discount * policy.col(a).asDiagonal() * process.P[static_cast<std::size_t>(a)];
  const Eigen::VectorXd expected = process.R.cwiseProduct(policy).rowwise().sum();
  return solve(M, expected);
  // <todo>
  //| // TODO: eq. (9) for all states is one linear system. solve(A, b) gives the x with A x = b.
  //| return Eigen::VectorXd::Zero(process.R.rows());
  // </solution>
}

Eigen::MatrixXd worthOfActions(const Process& process, const Eigen::VectorXd& V) {
  // <solution worthOfActions>
  Eigen::MatrixXd Q = process.R;
  for (Eigen::Index a = 0; a < Q.cols(); ++a)
    Q.col(a) += process.discount * process.P[static_cast<std::size_t>(a)] * V;
  return Q;
  // <todo>
  //| // TODO: the reward now, and what the next state is worth on average.
  //| return Eigen::MatrixXd::Zero(process.R.rows(), process.R.cols());
  // </solution>
}

std::vector<Eigen::VectorXd> iterateValues(const Process& process, double tolerance) {
  // <solution iterateValues>
  std::vector<Eigen::VectorXd> all{Eigen::VectorXd::Zero(process.R.rows())};
  double bound = INFINITY;
  while (bound > tolerance) {
    const Eigen::VectorXd next = worthOfActions(process, all.back()).rowwise().maxCoeff();
    const double change = (next - all.back()).cwiseAbs().maxCoeff();
    bound = process.discount / (1 - process.discount) * change;
    all.push_back(next);
  }
  return all;
  // <todo>
  //| // TODO: the best of worthOfActions() in each state, until the bound in exercise.h is small enough.
  //| return {Eigen::VectorXd::Zero(process.R.rows())};
  // </solution>
}

std::vector<std::vector<int>> iteratePolicies(const Process& process) {
  // <solution iteratePolicies>
  const auto n = static_cast<std::size_t>(process.R.rows());
  std::vector<std::vector<int>> policies{std::vector<int>(n, 0)};
  for (bool isBetter = true; isBetter;) {
    isBetter = false;
    std::vector<int> actions = policies.back();
    Eigen::MatrixXd policy = Eigen::MatrixXd::Zero(process.R.rows(), process.R.cols());
    for (std::size_t s = 0; s < n; ++s) policy(static_cast<Eigen::Index>(s), actions[s]) = 1;
    const Eigen::VectorXd V = valuesOf(process, policy);
    const Eigen::MatrixXd Q = worthOfActions(process, V);
    for (std::size_t s = 0; s < n; ++s) {
      int best = 0;
      const auto row = static_cast<Eigen::Index>(s);
      if (Q.row(row).maxCoeff(&best) <= Q(row, actions[s]) + 1e-11 * V.cwiseAbs().maxCoeff()) continue;
      actions[s] = best;
      isBetter = true;
    }
    if (isBetter) policies.push_back(actions);
  }
  return policies;
  // <todo>
  //| // TODO: the values of the last policy, the actions that are best by them, and again.
  //| return {std::vector<int>(static_cast<std::size_t>(process.R.rows()), 0)};
  // </solution>
}

Rollout runTrial(const StepFunction& step, const Eigen::VectorXd& start, const Policy& policy, int horizon,
                 Rng& rng) {
  // <solution runTrial>
  const auto k = static_cast<int>(start.size());
  Rollout trial{Eigen::MatrixXd(k, horizon), Eigen::MatrixXd(k, horizon), Eigen::VectorXd(horizon)};
  Eigen::VectorXd state = start;
  int t = 0;
  for (bool goesOn = true; goesOn && t < horizon; ++t) {
    trial.features.col(t) = state;
    trial.noise.col(t) = policy.L * rng.normalVector(k);
    const Transition outcome = step(state, state.dot(policy.beta + trial.noise.col(t)));
    trial.rewards[t] = outcome.reward;
    state = outcome.next;
    goesOn = !outcome.failed;
  }
  return {trial.features.leftCols(t), trial.noise.leftCols(t), trial.rewards.head(t)};
  // <todo>
  //| // TODO: draw epsilon, act, note down; until the horizon or a failure.
  //| return {Eigen::MatrixXd(start.size(), 0), Eigen::MatrixXd(start.size(), 0), Eigen::VectorXd(0)};
  // </solution>
}

Eigen::VectorXd returnsToGo(const Eigen::VectorXd& rewards, double discount) {
  // <solution returnsToGo>
  Eigen::VectorXd returns = rewards;
  for (Eigen::Index t = rewards.size() - 2; t >= 0; --t) returns[t] += discount * returns[t + 1];
  return returns;
  // <todo>
  //| // TODO: the last is the last reward. And the one before?
  //| return Eigen::VectorXd::Zero(rewards.size());
  // </solution>
}

Eigen::VectorXd reinforce(const Policy& policy, const std::vector<Rollout>& trials, double discount) {
  // <solution reinforce>
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(policy.beta.size());
  for (const Rollout& trial : trials) {
    const Eigen::VectorXd Q = returnsToGo(trial.rewards, discount);
    for (Eigen::Index t = 0; t < Q.size(); ++t) {
      const Eigen::VectorXd phi = trial.features.col(t);
      const double variance = (policy.L.transpose() * phi).squaredNorm();
      sum += std::pow(discount, t) * Q[t] * phi.dot(trial.noise.col(t)) / variance * phi;
    }
  }
  return sum / static_cast<double>(trials.size());
  // <todo>
  //| // TODO: differentiate the logarithm of the normal density of 9:16 by beta; how far was a from its mean?
  //| return Eigen::VectorXd::Zero(policy.beta.size());
  // </solution>
}

Eigen::VectorXd power(const Policy& policy, const std::vector<Rollout>& trials, double discount) {
  // <solution power>
  const Eigen::Index k = policy.beta.size();
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(k, k);
  Eigen::VectorXd moves = Eigen::VectorXd::Zero(k);
  for (const Rollout& trial : trials) {
    const Eigen::VectorXd Q = returnsToGo(trial.rewards, discount);
    for (Eigen::Index t = 0; t < Q.size(); ++t) {
      const Eigen::VectorXd phi = trial.features.col(t);
      const Eigen::MatrixXd W = phi * phi.transpose() / (policy.L.transpose() * phi).squaredNorm();
      weights += W * Q[t];
      moves += W * trial.noise.col(t) * Q[t];
    }
  }
  return policy.beta + solve(weights, moves);
  // <todo>
  //| // TODO: a matrix and a vector, summed over all steps of all trials.
  //| return policy.beta;
  // </solution>
}

Eigen::VectorXd naturalGradientOf(const Policy& policy, const std::vector<Rollout>& trials, double discount) {
  // <solution naturalGradientOf>
  const Eigen::Index k = policy.beta.size();
  Eigen::MatrixXd F = Eigen::MatrixXd::Zero(k, k);
  for (const Rollout& trial : trials) {
    for (Eigen::Index t = 0; t < trial.noise.cols(); ++t) {
      const Eigen::VectorXd phi = trial.features.col(t);
      const double variance = (policy.L.transpose() * phi).squaredNorm();
      const Eigen::VectorXd slope = phi.dot(trial.noise.col(t)) / variance * phi;
      F += std::pow(discount, t) * slope * slope.transpose();
    }
  }
  return solve(F / static_cast<double>(trials.size()), reinforce(policy, trials, discount));
  // <todo>
  //| // TODO: F is a mean over the trials, like reinforce(). Then solve F w = g.
  //| return Eigen::VectorXd::Zero(policy.beta.size());
  // </solution>
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
