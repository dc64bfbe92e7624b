// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant explores_the_others_only>
// caught by: choices, other-choices
// shown by: choices
// mistake: a random action is never the best one.
// <solution chosenAction>
const auto m = static_cast<int>(worth.size());
std::vector<int> best, others;
for (int a = 0; a < m; ++a) (worth[a] == worth.maxCoeff() ? best : others).push_back(a);
const std::vector<int>& from = !others.empty() && rng.uniform() < epsilon ? others : best;
return from[static_cast<std::size_t>(rng.index(static_cast<int>(from.size())))];

// <variant first_of_the_best>
// caught by: choices, other-choices
// shown by: choices
// mistake: takes the first of several best actions.
// <solution chosenAction>
if (rng.uniform() < epsilon) return rng.index(static_cast<int>(worth.size()));
int best = 0;
worth.maxCoeff(&best);
return best;

// <variant greedy_with_epsilon>
// caught by: choices, other-choices
// shown by: choices
// mistake: takes the best action with probability epsilon.
// <solution chosenAction>
const auto m = static_cast<int>(worth.size());
if (rng.uniform() >= epsilon) return rng.index(m);
std::vector<int> best;
for (int a = 0; a < m; ++a)
  if (worth[a] == worth.maxCoeff()) best.push_back(a);
return best[static_cast<std::size_t>(rng.index(static_cast<int>(best.size())))];

// <variant adds_the_whole_target>
// caught by: q-steps, more-steps
// shown by: q-steps
// mistake: adds the target and not the difference from it.
// <solution qLearned>
Eigen::MatrixXd learned = Q;
for (const Experience& step : steps) {
  const double later = step.ended ? 0 : learned.row(step.next).maxCoeff();
  double& q = learned(step.state, step.action);
  q += stepSize * (step.reward + discount * later);
}
return learned;

// <variant calls_the_library>
// caught by: forbidden-call
// mistake: asks the library to learn.
// <solution headers>
#include "learning/q_learning.h"
// <solution qLearned>
Eigen::MatrixXd learned = Q;
for (const Experience& e : steps)
  learnFrom(learned, {e.state, e.action, e.reward, e.ended ? std::nullopt : std::optional(e.next)},
            std::nullopt, stepSize, discount);
return learned;

// <variant end_is_worth_something>
// caught by: q-steps, more-steps
// shown by: q-steps
// mistake: adds the values of the next state after the end.
// <solution qLearned>
Eigen::MatrixXd learned = Q;
for (const Experience& step : steps) {
  const double later = learned.row(step.next).maxCoeff();
  double& q = learned(step.state, step.action);
  q += stepSize * (step.reward + discount * later - q);
}
return learned;

// <variant from_the_first_table>
// caught by: q-steps, more-steps
// mistake: takes the best of the next state by the Q from before all steps.
// <solution qLearned>
Eigen::MatrixXd learned = Q;
for (const Experience& step : steps) {
  const double later = step.ended ? 0 : Q.row(step.next).maxCoeff();
  double& q = learned(step.state, step.action);
  q += stepSize * (step.reward + discount * later - q);
}
return learned;

// <variant q_without_discount>
// caught by: q-steps, more-steps
// shown by: q-steps
// mistake: forgets the discount.
// <solution qLearned>
Eigen::MatrixXd learned = Q;
for (const Experience& step : steps) {
  const double later = step.ended ? 0 : learned.row(step.next).maxCoeff();
  double& q = learned(step.state, step.action);
  q += stepSize * (step.reward + later - q);
}
return learned;

// <variant learns_from_the_last>
// caught by: sarsa-steps, more-episodes
// shown by: sarsa-steps
// mistake: learns from the last step as if nothing followed.
// <solution sarsaLearned>
Eigen::MatrixXd learned = Q;
for (std::size_t t = 0; t < episode.size(); ++t) {
  const Experience& step = episode[t];
  const bool isLast = t + 1 == episode.size();
  const double later = isLast ? 0 : learned(step.next, episode[t + 1].action);
  double& q = learned(step.state, step.action);
  q += stepSize * (step.reward + discount * later - q);
}
return learned;

// <variant never_learns_from_the_end>
// caught by: sarsa-steps, more-episodes
// mistake: leaves out the last step even if it ended the episode.
// <solution sarsaLearned>
Eigen::MatrixXd learned = Q;
for (std::size_t t = 0; t < episode.size(); ++t) {
  const Experience& step = episode[t];
  if (t + 1 == episode.size()) break;
  const double later = step.ended ? 0 : learned(step.next, episode[t + 1].action);
  double& q = learned(step.state, step.action);
  q += stepSize * (step.reward + discount * later - q);
}
return learned;

// <variant own_action_again>
// caught by: sarsa-steps, more-episodes
// mistake: takes the action of the step itself in the next state.
// <solution sarsaLearned>
Eigen::MatrixXd learned = Q;
for (std::size_t t = 0; t < episode.size(); ++t) {
  const Experience& step = episode[t];
  if (!step.ended && t + 1 == episode.size()) break;
  const double later = step.ended ? 0 : learned(step.next, step.action);
  double& q = learned(step.state, step.action);
  q += stepSize * (step.reward + discount * later - q);
}
return learned;

// <variant sarsa_takes_the_best>
// caught by: sarsa-steps, more-episodes
// shown by: sarsa-steps
// mistake: is Q-learning.
// <solution sarsaLearned>
Eigen::MatrixXd learned = Q;
for (std::size_t t = 0; t < episode.size(); ++t) {
  const Experience& step = episode[t];
  if (!step.ended && t + 1 == episode.size()) break;
  const double later = step.ended ? 0 : learned.row(step.next).maxCoeff();
  double& q = learned(step.state, step.action);
  q += stepSize * (step.reward + discount * later - q);
}
return learned;

// <variant counts_for_frequencies>
// caught by: estimate, unseen-map
// shown by: estimate
// mistake: does not divide the counts.
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
  }
return model;

// <variant ends_do_not_count>
// caught by: estimate, unseen-map
// shown by: estimate
// mistake: divides by the steps that went on.
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
    const double went = model.P[static_cast<std::size_t>(a)].row(s).sum();
    if (went > 0) model.P[static_cast<std::size_t>(a)].row(s) /= went;
  }
return model;

// <variant sums_of_rewards>
// caught by: estimate, unseen-map
// shown by: estimate
// mistake: does not divide the sums of rewards.
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
    model.P[static_cast<std::size_t>(a)].row(s) /= tries;
  }
return model;

// <variant rewards_only>
// caught by: plan, more-plans, unseen-map
// shown by: plan
// mistake: does not look ahead.
// <solution plannedValues>
return discount < 0 ? model.visits : model.R;

// <variant ten_sweeps>
// caught by: plan, more-plans
// shown by: plan
// mistake: ends after ten sweeps.
// <solution plannedValues>
Eigen::MatrixXd Q = Eigen::MatrixXd::Zero(model.R.rows(), model.R.cols());
for (int i = 0; i < 10; ++i) {
  const Eigen::VectorXd V = Q.rowwise().maxCoeff();
  Eigen::MatrixXd next = model.R;
  for (Eigen::Index a = 0; a < Q.cols(); ++a)
    next.col(a) += discount * model.P[static_cast<std::size_t>(a)] * V;
  Q = next;
}
return Q;

// <variant hope_does_not_spread>
// caught by: hope, more-hope
// shown by: hope
// mistake: hopes only after planning, so the neighbours do not know.
// <solution optimisticValues>
Eigen::MatrixXd Q = plannedValues(model, discount);
for (Eigen::Index s = 0; s < Q.rows(); ++s)
  for (Eigen::Index a = 0; a < Q.cols(); ++a)
    if (model.visits(s, a) < known) Q(s, a) = maxReward / (1 - discount);
return Q;

// <variant known_too_late>
// caught by: hope, more-hope
// shown by: hope
// mistake: believes one try too late.
// <solution optimisticValues>
LearnedWorld hoped = model;
for (Eigen::Index s = 0; s < model.R.rows(); ++s)
  for (Eigen::Index a = 0; a < model.R.cols(); ++a) {
    if (model.visits(s, a) > known) continue;
    hoped.R(s, a) = maxReward / (1 - discount);
    hoped.P[static_cast<std::size_t>(a)].row(s).setZero();
  }
return plannedValues(hoped, discount);

// <variant known_when_tried>
// caught by: hope, more-hope
// shown by: hope
// mistake: believes a single try.
// <solution optimisticValues>
LearnedWorld hoped = model;
for (Eigen::Index s = 0; s < model.R.rows(); ++s)
  for (Eigen::Index a = 0; a < model.R.cols(); ++a) {
    if (known > 0 && model.visits(s, a) > 0) continue;
    hoped.R(s, a) = maxReward / (1 - discount);
    hoped.P[static_cast<std::size_t>(a)].row(s).setZero();
  }
return plannedValues(hoped, discount);

// <variant paid_once>
// caught by: hope, more-hope
// shown by: hope
// mistake: what is not known pays only once.
// <solution optimisticValues>
LearnedWorld hoped = model;
for (Eigen::Index s = 0; s < model.R.rows(); ++s)
  for (Eigen::Index a = 0; a < model.R.cols(); ++a) {
    if (model.visits(s, a) >= known) continue;
    hoped.R(s, a) = maxReward;
    hoped.P[static_cast<std::size_t>(a)].row(s).setZero();
  }
return plannedValues(hoped, discount);

// <variant margin_of_sums>
// caught by: bounds, other-bounds
// mistake: adds the margin to the sum of payments.
// <solution upperBounds>
const Eigen::ArrayXd N = pulls.cast<double>();
return paid.array() + (2 * std::log(N.sum()) / N).sqrt();

// <variant n_of_the_arm>
// caught by: bounds, other-bounds
// shown by: bounds
// mistake: counts only the pulls of the arm itself.
// <solution upperBounds>
const Eigen::ArrayXd N = pulls.cast<double>();
return paid.array() / N + (2 * N.log() / N).sqrt();

// <variant pessimist>
// caught by: bounds, other-bounds
// shown by: bounds
// mistake: subtracts the margin.
// <solution upperBounds>
const Eigen::ArrayXd N = pulls.cast<double>();
return paid.array() / N - (2 * std::log(N.sum()) / N).sqrt();

// <variant power_forgotten>
// caught by: bounds, other-bounds
// mistake: solves exp(-2 N b^2) = 1 / n.
// <solution upperBounds>
const Eigen::ArrayXd N = pulls.cast<double>();
return paid.array() / N + (std::log(N.sum()) / (2 * N)).sqrt();
