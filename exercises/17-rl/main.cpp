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

Eigen::MatrixXd cloned(const std::vector<Lesson>& lessons, int states, int actions) {
  // TODO: count, then divide.
  return Eigen::MatrixXd::Zero(states, actions);
}

Eigen::VectorXd mistakeChances(const std::vector<Eigen::MatrixXd>& P, const Eigen::VectorXd& start,
                               const Eigen::MatrixXd& policy, const std::vector<int>& teacher, int steps) {
  // TODO: how likely is each state in each step, and a mistake in it?
  return Eigen::VectorXd::Zero(steps);
}

Eigen::MatrixXd aggregated(const std::vector<Lesson>& lessons, int states, int actions, int rounds,
                           const std::function<std::vector<int>(const Eigen::MatrixXd& policy)>& visited,
                           const std::function<int(int state)>& taught) {
  // TODO: the clone acts, the teacher corrects it.
  return Eigen::MatrixXd::Zero(states, actions);
}

Eigen::VectorXd expectedFeatures(const FeatureWorld& world, const Eigen::MatrixXd& policy) {
  // TODO: how often is each state visited, and with which discount?
  return Eigen::VectorXd::Zero(world.features.rows());
}

Eigen::MatrixXd bestPolicy(const FeatureWorld& world, const Eigen::VectorXd& w) {
  // TODO: a plan for these rewards.
  return Eigen::MatrixXd::Zero(world.features.cols(), static_cast<Eigen::Index>(world.P.size()));
}

double nearestShare(const Eigen::VectorXd& teacher, const Eigen::VectorXd& mixed,
                    const Eigen::VectorXd& candidate) {
  // TODO: project, but not beyond the ends.
  return 0;
}

Explanation explained(const FeatureWorld& world, const Eigen::VectorXd& teacher, int rounds,
                      double tolerance) {
  // TODO: weights, a policy for them, its share; then repeat.
  return {};
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
  // Part 5: a clone leaves the row that it was shown, and learns to come back.
  showImitation();
  // Part 6: a teacher walks over several kinds of ground. What does it like?
  showTeacher();
  // Part 7: five arms, and one pays best.
  showBandits(.1);
}
