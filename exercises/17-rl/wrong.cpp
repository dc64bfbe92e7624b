// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant explores_the_others_only> caught by: choices, other-choices
// shown by: choices
// mistake: a random action is never the best one.
// <solution chosenAction>
const auto m = static_cast<int>(worth.size());
std::vector<int> best, others;
for (int a = 0; a < m; ++a) (worth[a] == worth.maxCoeff() ? best : others).push_back(a);
const std::vector<int>& from = !others.empty() && rng.uniform() < epsilon ? others : best;
return from[static_cast<std::size_t>(rng.index(static_cast<int>(from.size())))];

// <variant first_of_the_best> caught by: choices, other-choices
// shown by: choices
// mistake: takes the first of several best actions.
// <solution chosenAction>
if (rng.uniform() < epsilon) return rng.index(static_cast<int>(worth.size()));
int best = 0;
worth.maxCoeff(&best);
return best;

// <variant greedy_with_epsilon> caught by: choices, other-choices
// shown by: choices
// mistake: takes the best action with probability epsilon.
// <solution chosenAction>
// in place of: if (rng.uniform() < epsilon) return rng.index(m);
if (rng.uniform() >= epsilon) return rng.index(m);

// <variant adds_the_whole_target> caught by: q-steps, more-steps
// shown by: q-steps
// mistake: adds the target and not the difference from it.
// <solution qLearned>
// in place of: q += stepSize * (step.reward + discount * later - q);
q += stepSize * (step.reward + discount * later);

// <variant calls_the_library> caught by: forbidden-call
// mistake: asks the library to learn.
// <solution headers>
#include "learning/q_learning.h"
// <solution qLearned>
Eigen::MatrixXd learned = Q;
for (const Experience& e : steps)
  learnFrom(learned, {e.state, e.action, e.reward, e.ended ? std::nullopt : std::optional(e.next)},
            std::nullopt, stepSize, discount);
return learned;

// <variant end_is_worth_something> caught by: q-steps, more-steps
// shown by: q-steps
// mistake: adds the values of the next state after the end.
// <solution qLearned>
// in place of: const double later = step.ended ? 0 : learned.row(step.next).maxCoeff();
const double later = learned.row(step.next).maxCoeff();

// <variant from_the_first_table> caught by: q-steps, more-steps
// mistake: takes the best of the next state by the Q from before all steps.
// <solution qLearned>
// in place of: const double later = step.ended ? 0 : learned.row(step.next).maxCoeff();
const double later = step.ended ? 0 : Q.row(step.next).maxCoeff();

// <variant q_without_discount> caught by: q-steps, more-steps
// shown by: q-steps
// mistake: forgets the discount.
// <solution qLearned>
// in place of: q += stepSize * (step.reward + discount * later - q);
q += stepSize * (step.reward + later - q);

// <variant learns_from_the_last> caught by: sarsa-steps, more-episodes
// shown by: sarsa-steps
// mistake: learns from the last step as if nothing followed.
// <solution sarsaLearned>
// in place of: if (!step.ended && t + 1 == episode.size()) break; ... const double later = step.ended ? 0 :
const bool isLast = t + 1 == episode.size();
const double later = isLast ? 0 : learned(step.next, episode[t + 1].action);

// <variant never_learns_from_the_end> caught by: sarsa-steps, more-episodes
// mistake: leaves out the last step even if it ended the episode.
// <solution sarsaLearned>
// in place of: if (!step.ended && t + 1 == episode.size()) break;
if (t + 1 == episode.size()) break;

// <variant own_action_again> caught by: sarsa-steps, more-episodes
// mistake: takes the action of the step itself in the next state.
// <solution sarsaLearned>
// in place of: const double later = step.ended ? 0 : learned(step.next, episode[t + 1].action);
const double later = step.ended ? 0 : learned(step.next, step.action);

// <variant sarsa_takes_the_best> caught by: sarsa-steps, more-episodes
// shown by: sarsa-steps
// mistake: is Q-learning.
// <solution sarsaLearned>
// in place of: const double later = step.ended ? 0 : learned(step.next, episode[t + 1].action);
const double later = step.ended ? 0 : learned.row(step.next).maxCoeff();

// <variant counts_for_frequencies> caught by: estimate, unseen-map
// shown by: estimate
// mistake: does not divide the counts.
// <solution estimated>
// in place of: model.P[static_cast<std::size_t>(a)].row(s) /= tries;

// <variant ends_do_not_count> caught by: estimate, unseen-map
// shown by: estimate
// mistake: divides by the steps that went on.
// <solution estimated>
// in place of: model.P[static_cast<std::size_t>(a)].row(s) /= tries;
const double went = model.P[static_cast<std::size_t>(a)].row(s).sum();
if (went > 0) model.P[static_cast<std::size_t>(a)].row(s) /= went;

// <variant sums_of_rewards> caught by: estimate, unseen-map
// shown by: estimate
// mistake: does not divide the sums of rewards.
// <solution estimated>
// in place of: model.R(s, a) /= tries;

// <variant rewards_only> caught by: plan, more-plans, unseen-map
// shown by: plan
// mistake: does not look ahead.
// <solution plannedValues>
return discount < 0 ? model.visits : model.R;

// <variant ten_sweeps> caught by: plan, more-plans
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

// <variant hope_does_not_spread> caught by: hope, more-hope
// shown by: hope
// mistake: hopes only after planning, so the neighbours do not know.
// <solution optimisticValues>
Eigen::MatrixXd Q = plannedValues(model, discount);
for (Eigen::Index s = 0; s < Q.rows(); ++s)
  for (Eigen::Index a = 0; a < Q.cols(); ++a)
    if (model.visits(s, a) < known) Q(s, a) = maxReward / (1 - discount);
return Q;

// <variant known_too_late> caught by: hope, more-hope
// shown by: hope
// mistake: believes one try too late.
// <solution optimisticValues>
// in place of: if (model.visits(s, a) >= known) continue;
if (model.visits(s, a) > known) continue;

// <variant known_when_tried> caught by: hope, more-hope
// shown by: hope
// mistake: believes a single try.
// <solution optimisticValues>
// in place of: if (model.visits(s, a) >= known) continue;
if (known > 0 && model.visits(s, a) > 0) continue;

// <variant paid_once> caught by: hope, more-hope
// shown by: hope
// mistake: what is not known pays only once.
// <solution optimisticValues>
// in place of: hoped.R(s, a) = maxReward / (1 - discount);
hoped.R(s, a) = maxReward;

// <variant margin_of_sums> caught by: bounds, other-bounds
// mistake: adds the margin to the sum of payments.
// <solution upperBounds>
const Eigen::ArrayXd N = pulls.cast<double>();
return paid.array() + (2 * std::log(N.sum()) / N).sqrt();

// <variant n_of_the_arm> caught by: bounds, other-bounds
// shown by: bounds
// mistake: counts only the pulls of the arm itself.
// <solution upperBounds>
const Eigen::ArrayXd N = pulls.cast<double>();
return paid.array() / N + (2 * N.log() / N).sqrt();

// <variant pessimist> caught by: bounds, other-bounds
// shown by: bounds
// mistake: subtracts the margin.
// <solution upperBounds>
const Eigen::ArrayXd N = pulls.cast<double>();
return paid.array() / N - (2 * std::log(N.sum()) / N).sqrt();

// <variant power_forgotten> caught by: bounds, other-bounds
// mistake: solves exp(-2 N b^2) = 1 / n.
// <solution upperBounds>
const Eigen::ArrayXd N = pulls.cast<double>();
return paid.array() / N + (std::log(N.sum()) / (2 * N)).sqrt();
