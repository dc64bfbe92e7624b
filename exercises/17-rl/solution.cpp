#include <algorithm>
#include <cmath>

#include "exercise.h"
#include "show.h"
// <solution headers>
// What a mistake in wrong.cpp takes from the library.
// <todo>
// </solution>

using namespace rex;

int chosenAction(const Eigen::VectorXd& worth, double epsilon, Rng& rng) {
  // <solution chosenAction>
  const auto m = static_cast<int>(worth.size());
  if (rng.uniform() < epsilon) return rng.index(m);
  std::vector<int> best;
  for (int a = 0; a < m; ++a)
    if (worth[a] == worth.maxCoeff()) best.push_back(a);
  return best[static_cast<std::size_t>(rng.index(static_cast<int>(best.size())))];
  // <todo>
  //| // TODO: any action, or one of the best.
  //| return 0;
  // </solution>
}

Eigen::MatrixXd qLearned(const Eigen::MatrixXd& Q, const std::vector<Experience>& steps, double stepSize,
                         double discount) {
  // <solution qLearned>
  Eigen::MatrixXd learned = Q;
  for (const Experience& step : steps) {
    const double later = step.ended ? 0 : learned.row(step.next).maxCoeff();
    double& q = learned(step.state, step.action);
    q += stepSize * (step.reward + discount * later - q);
  }
  return learned;
  // <todo>
  //| // TODO: one step after the other.
  //| return Q;
  // </solution>
}

Eigen::MatrixXd sarsaLearned(const Eigen::MatrixXd& Q, const std::vector<Experience>& episode,
                             double stepSize, double discount) {
  // <solution sarsaLearned>
  Eigen::MatrixXd learned = Q;
  for (std::size_t t = 0; t < episode.size(); ++t) {
    const Experience& step = episode[t];
    if (!step.ended && t + 1 == episode.size()) break;
    const double later = step.ended ? 0 : learned(step.next, episode[t + 1].action);
    double& q = learned(step.state, step.action);
    q += stepSize * (step.reward + discount * later - q);
  }
  return learned;
  // <todo>
  //| // TODO: the action that was taken next.
  //| return Q;
  // </solution>
}

LearnedWorld estimated(const std::vector<Experience>& steps, int states, int actions) {
  // <solution estimated>
  LearnedWorld model;
  model.R = model.visits = Eigen::MatrixXd::Zero(states, actions);
  model.P.assign(static_cast<std::size_t>(actions), Eigen::MatrixXd::Zero(states, states));
  for (const Experience& step : steps) {
    model.visits(step.state, step.action) += 1;
    model.R(step.state, step.action) += step.reward;
    if (!step.ended) model.P[static_cast<std::size_t>(step.action)](step.state, step.next) += 1;
  }
  for (int s = 0; s < states; ++s)
    for (int a = 0; a < actions; ++a) {
      const double tries = std::max(1., model.visits(s, a));
      model.R(s, a) /= tries;
      model.P[static_cast<std::size_t>(a)].row(s) /= tries;
    }
  return model;
  // <todo>
  //| // TODO: count, then divide.
  //| const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(states, actions);
  //| return {{static_cast<std::size_t>(actions), Eigen::MatrixXd::Zero(states, states)}, none, none};
  // </solution>
}

Eigen::MatrixXd plannedValues(const LearnedWorld& model, double discount) {
  // <solution plannedValues>
  Eigen::MatrixXd Q = Eigen::MatrixXd::Zero(model.R.rows(), model.R.cols());
  for (double bound = INFINITY; bound > 1e-8;) {
    const Eigen::VectorXd V = Q.rowwise().maxCoeff();
    Eigen::MatrixXd next = model.R;
    for (Eigen::Index a = 0; a < Q.cols(); ++a)
      next.col(a) += discount * model.P[static_cast<std::size_t>(a)] * V;
    bound = (next - Q).cwiseAbs().maxCoeff() * discount / (1 - discount);
    Q = next;
  }
  return Q;
  // <todo>
  //| // TODO: value iteration.
  //| return Eigen::MatrixXd::Zero(model.R.rows(), model.R.cols());
  // </solution>
}

Eigen::MatrixXd optimisticValues(const LearnedWorld& model, int known, double maxReward, double discount) {
  // <solution optimisticValues>
  LearnedWorld hoped = model;
  for (Eigen::Index s = 0; s < model.R.rows(); ++s)
    for (Eigen::Index a = 0; a < model.R.cols(); ++a) {
      if (model.visits(s, a) >= known) continue;
      hoped.R(s, a) = maxReward / (1 - discount);
      hoped.P[static_cast<std::size_t>(a)].row(s).setZero();
    }
  return plannedValues(hoped, discount);
  // <todo>
  //| // TODO: make the model optimistic where it is not known, and plan.
  //| return Eigen::MatrixXd::Zero(model.R.rows(), model.R.cols());
  // </solution>
}

Eigen::VectorXd upperBounds(const Eigen::VectorXi& pulls, const Eigen::VectorXd& paid) {
  // <solution upperBounds>
  const Eigen::ArrayXd N = pulls.cast<double>();
  return paid.array() / N + (2 * std::log(N.sum()) / N).sqrt();
  // <todo>
  //| // TODO: the mean of each arm, and its margin.
  //| return Eigen::VectorXd::Zero(pulls.size());
  // </solution>
}

// What follows is given, and never graded: change it as you like. show.h says what each line draws.

int main() {
  // Parts 1 and 2: along a cliff, where every tenth action is random.
  showCliff(.1);
  // Parts 3 and 4: a maze, explored by chance and with a plan.
  showExploration();
  // Part 5: five arms, one of which pays best.
  showBandits(.1);
}
