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

Eigen::MatrixXd cloned(const std::vector<Lesson>& lessons, int states, int actions) {
  // <solution cloned>
  Eigen::MatrixXd policy = Eigen::MatrixXd::Zero(states, actions);
  for (const Lesson& lesson : lessons) policy(lesson.state, lesson.action) += 1;
  for (int s = 0; s < states; ++s) {
    const double all = policy.row(s).sum();
    if (all == 0) policy.row(s).setOnes();
    policy.row(s) /= all > 0 ? all : actions;
  }
  return policy;
  // <todo>
  //| // TODO: count, then divide.
  //| return Eigen::MatrixXd::Zero(states, actions);
  // </solution>
}

Eigen::VectorXd mistakeChances(const std::vector<Eigen::MatrixXd>& P, const Eigen::VectorXd& start,
                               const Eigen::MatrixXd& policy, const std::vector<int>& teacher, int steps) {
  // <solution mistakeChances>
  const Eigen::MatrixXd next = nextUnder(P, policy);
  Eigen::VectorXd chances = Eigen::VectorXd::Zero(steps), now = start;
  for (int t = 0; t < steps; ++t) {
    for (Eigen::Index s = 0; s < now.size(); ++s)
      chances[t] += now[s] * (1 - policy(s, teacher[static_cast<std::size_t>(s)]));
    now = (next.transpose() * now).eval();
  }
  return chances;
  // <todo>
  //| // TODO: how likely is each state in each step, and a mistake in it?
  //| return Eigen::VectorXd::Zero(steps);
  // </solution>
}

Eigen::MatrixXd aggregated(const std::vector<Lesson>& lessons, int states, int actions, int rounds,
                           const std::function<std::vector<int>(const Eigen::MatrixXd& policy)>& visited,
                           const std::function<int(int state)>& taught) {
  // <solution aggregated>
  std::vector<Lesson> all = lessons;
  for (int round = 0; round < rounds; ++round) {
    const std::vector<int> here = visited(cloned(all, states, actions));
    for (const int s : here) all.push_back({s, taught(s)});
  }
  return cloned(all, states, actions);
  // <todo>
  //| // TODO: the clone acts, the teacher corrects it.
  //| return Eigen::MatrixXd::Zero(states, actions);
  // </solution>
}

Eigen::VectorXd expectedFeatures(const FeatureWorld& world, const Eigen::MatrixXd& policy) {
  // <solution expectedFeatures>
  const Eigen::MatrixXd stay = Eigen::MatrixXd::Identity(policy.rows(), policy.rows()),
                        next = nextUnder(world.P, policy).transpose();
  const Eigen::VectorXd visits = solve(stay - world.discount * next, world.start);
  return world.features * visits;
  // <todo>
  //| // TODO: how often is each state visited, and with which discount?
  //| return Eigen::VectorXd::Zero(world.features.rows());
  // </solution>
}

Eigen::MatrixXd bestPolicy(const FeatureWorld& world, const Eigen::VectorXd& w) {
  // <solution bestPolicy>
  const auto n = world.features.cols(), m = static_cast<Eigen::Index>(world.P.size());
  Eigen::MatrixXd policy = Eigen::MatrixXd::Zero(n, m), paid(n, m);
  for (Eigen::Index s = 0; s < n; ++s) paid.row(s).setConstant(w.dot(world.features.col(s)));
  const Eigen::MatrixXd Q = plannedValues({world.P, paid, policy}, world.discount);
  for (Eigen::Index s = 0; s < n; ++s) {
    Eigen::Index favourite = 0;
    Q.row(s).maxCoeff(&favourite);
    policy(s, favourite) = 1;
  }
  return policy;
  // <todo>
  //| // TODO: a plan for these rewards.
  //| return Eigen::MatrixXd::Zero(world.features.cols(), static_cast<Eigen::Index>(world.P.size()));
  // </solution>
}

double nearestShare(const Eigen::VectorXd& teacher, const Eigen::VectorXd& mixed,
                    const Eigen::VectorXd& candidate) {
  // <solution nearestShare>
  const Eigen::VectorXd way = candidate - mixed;
  if (way.squaredNorm() == 0) return 0;
  return std::clamp(way.dot(teacher - mixed) / way.squaredNorm(), 0., 1.);
  // <todo>
  //| // TODO: project, but not beyond the ends.
  //| return 0;
  // </solution>
}

Explanation explained(const FeatureWorld& world, const Eigen::VectorXd& teacher, int rounds,
                      double tolerance) {
  // <solution explained>
  const auto n = world.features.cols(), m = static_cast<Eigen::Index>(world.P.size());
  Explanation found{{Eigen::MatrixXd::Constant(n, m, 1. / static_cast<double>(m))},
                    Eigen::VectorXd::Ones(1),
                    Eigen::VectorXd::Zero(teacher.size())};
  Eigen::VectorXd mixed = expectedFeatures(world, found.policies[0]);
  for (int round = 0; round < rounds && (teacher - mixed).norm() > tolerance; ++round) {
    found.w = (teacher - mixed) / (teacher - mixed).norm();
    found.policies.push_back(bestPolicy(world, found.w));
    const Eigen::VectorXd candidate = expectedFeatures(world, found.policies.back());
    const double share = nearestShare(teacher, mixed, candidate);
    mixed += share * (candidate - mixed);
    found.shares *= 1 - share;
    found.shares.conservativeResize(found.shares.size() + 1);
    found.shares[found.shares.size() - 1] = share;
  }
  return found;
  // <todo>
  //| // TODO: weights, a policy for them, its share; then repeat.
  //| return {};
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
  // Part 5: a clone leaves the row that it was shown, and learns to come back.
  showImitation();
  // Part 6: a teacher walks over several kinds of ground. What does it like?
  showTeacher();
  // Part 7: five arms, and one pays best.
  showBandits(.1);
}
