#include <algorithm>
#include <cmath>

#include "exercise.h"
#include "show.h"

using namespace rex;

int chosenAction(const Eigen::VectorXd& worth, double epsilon, Rng& rng) {
  // TODO: any action, or one of the best.
  return 0;
}

Eigen::MatrixXd qLearned(const Eigen::MatrixXd& Q, const std::vector<Experience>& steps, double stepSize,
                         double discount) {
  // TODO: one step after the other.
  return Q;
}

Eigen::MatrixXd sarsaLearned(const Eigen::MatrixXd& Q, const std::vector<Experience>& episode,
                             double stepSize, double discount) {
  // TODO: the action that was taken next.
  return Q;
}

LearnedWorld estimated(const std::vector<Experience>& steps, int states, int actions) {
  // TODO: count, then divide.
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(states, actions);
  return {{static_cast<std::size_t>(actions), Eigen::MatrixXd::Zero(states, states)}, none, none};
}

Eigen::MatrixXd plannedValues(const LearnedWorld& model, double discount) {
  // TODO: value iteration.
  return Eigen::MatrixXd::Zero(model.R.rows(), model.R.cols());
}

Eigen::MatrixXd optimisticValues(const LearnedWorld& model, int known, double maxReward, double discount) {
  // TODO: make the model optimistic where it is not known, and plan.
  return Eigen::MatrixXd::Zero(model.R.rows(), model.R.cols());
}

Eigen::VectorXd upperBounds(const Eigen::VectorXi& pulls, const Eigen::VectorXd& paid) {
  // TODO: the mean of each arm, and its margin.
  return Eigen::VectorXd::Zero(pulls.size());
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
