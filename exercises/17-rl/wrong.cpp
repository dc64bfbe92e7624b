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
// ask: Is Q moved by the target itself? It moves towards it.
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

// <variant nothing_learned> caught by: q-steps, more-steps
// mistake: as it was handed out.
// ask: Is nothing learned?
// <solution qLearned>
return Q;

// <variant learns_as_sarsa> caught by: q-steps, more-steps
// mistake: is SARSA.
// ask: Does the action taken next count? Q-learning takes the best.
// <solution qLearned>
// in place of: const double later = step.ended ? 0 : learned.row(step.next).maxCoeff();
if (!step.ended && &step == &steps.back()) break;
const double later = step.ended ? 0 : learned(step.next, (&step + 1)->action);

// <variant end_is_worth_something> caught by: q-steps, more-steps
// shown by: q-steps
// mistake: adds the values of the next state after the end.
// ask: Does something follow a step that ended the episode?
// <solution qLearned>
// in place of: const double later = step.ended ? 0 : learned.row(step.next).maxCoeff();
const double later = learned.row(step.next).maxCoeff();

// <variant last_step_as_the_end> caught by: q-steps, more-steps
// mistake: nothing follows the last step, even if it did not end the episode.
// ask: Is the last step taken as the end of the episode? It did not end.
// <solution qLearned>
// in place of: const double later = step.ended ? 0 : learned.row(step.next).maxCoeff();
const double later = step.ended || &step == &steps.back() ? 0 : learned.row(step.next).maxCoeff();

// <variant from_the_first_table> caught by: q-steps, more-steps
// mistake: takes the best of the next state by the Q from before all steps.
// ask: Is the next state judged by the Q of before all steps? Q changes with each.
// <solution qLearned>
// in place of: const double later = step.ended ? 0 : learned.row(step.next).maxCoeff();
const double later = step.ended ? 0 : Q.row(step.next).maxCoeff();

// <variant q_without_discount> caught by: q-steps, more-steps
// shown by: q-steps
// mistake: forgets the discount.
// ask: Is the discount forgotten?
// <solution qLearned>
// in place of: q += stepSize * (step.reward + discount * later - q);
q += stepSize * (step.reward + later - q);

// <variant learns_from_the_last> caught by: sarsa-steps, more-episodes
// shown by: sarsa-steps
// mistake: learns from the last step as if nothing followed.
// ask: Is the last step taken as the end of the episode? It did not end.
// <solution sarsaLearned>
// in place of: if (!step.ended && t + 1 == episode.size()) break; ... const double later = step.ended ? 0 :
const bool isLast = t + 1 == episode.size();
const double later = isLast ? 0 : learned(step.next, episode[t + 1].action);

// <variant never_learns_from_the_end> caught by: sarsa-steps, more-episodes
// mistake: leaves out the last step even if it ended the episode.
// ask: Is nothing learned from the last step? It ended the episode, so nothing else is needed.
// <solution sarsaLearned>
// in place of: if (!step.ended && t + 1 == episode.size()) break;
if (t + 1 == episode.size()) break;

// <variant own_action_again> caught by: sarsa-steps, more-episodes
// mistake: takes the action of the step itself in the next state.
// ask: Is it the action of the step itself that counts in the next state? It is the one taken there.
// <solution sarsaLearned>
// in place of: const double later = step.ended ? 0 : learned(step.next, episode[t + 1].action);
const double later = step.ended ? 0 : learned(step.next, step.action);

// <variant sarsa_takes_the_best> caught by: sarsa-steps, more-episodes
// shown by: sarsa-steps
// mistake: is Q-learning.
// ask: Does the best next action count? SARSA takes the one that was taken.
// <solution sarsaLearned>
// in place of: const double later = step.ended ? 0 : learned(step.next, episode[t + 1].action);
const double later = step.ended ? 0 : learned.row(step.next).maxCoeff();

// <variant all_of_q_learning> caught by: sarsa-steps, more-episodes
// mistake: is Q-learning, and learns from the last step, too.
// ask: Does the best next action count? SARSA takes the one that was taken.
// <solution sarsaLearned>
// in place of: if (!step.ended && t + 1 == episode.size()) break; ... const double later = step.ended ? 0 :
const double later = step.ended ? 0 : learned.row(step.next).maxCoeff();

// <variant sarsa_from_the_first_table> caught by: sarsa-steps, more-episodes
// mistake: takes the Q from before all steps in the next state.
// ask: Is the next state judged by the Q of before all steps? Q changes with each.
// <solution sarsaLearned>
// in place of: const double later = step.ended ? 0 : learned(step.next, episode[t + 1].action);
const double later = step.ended ? 0 : Q(step.next, episode[t + 1].action);

// <variant sarsa_adds_the_whole_target> caught by: sarsa-steps, more-episodes
// mistake: adds the target and not the difference from it.
// ask: Is Q moved by the target itself? It moves towards it.
// <solution sarsaLearned>
// in place of: q += stepSize * (step.reward + discount * later - q);
q += stepSize * (step.reward + discount * later);

// <variant sarsa_without_discount> caught by: sarsa-steps, more-episodes
// mistake: forgets the discount.
// ask: Is the discount forgotten?
// <solution sarsaLearned>
// in place of: q += stepSize * (step.reward + discount * later - q);
q += stepSize * (step.reward + later - q);

// <variant sarsa_learns_nothing> caught by: sarsa-steps, more-episodes
// mistake: as it was handed out.
// ask: Is nothing learned?
// <solution sarsaLearned>
return Q;

// <variant counts_for_frequencies> caught by: estimate, unseen-map
// shown by: estimate
// mistake: does not divide the counts.
// ask: Are these counts? Wanted are frequencies.
// <solution estimated>
// in place of: model.P[static_cast<std::size_t>(a)].row(s) /= tries;

// <variant ends_do_not_count> caught by: estimate, unseen-map
// shown by: estimate
// mistake: divides by the steps that went on.
// ask: Do steps that ended not count as tries? Their rows sum to less than one.
// <solution estimated>
// in place of: model.P[static_cast<std::size_t>(a)].row(s) /= tries;
const double went = model.P[static_cast<std::size_t>(a)].row(s).sum();
if (went > 0) model.P[static_cast<std::size_t>(a)].row(s) /= went;

// <variant sums_of_rewards> caught by: estimate, unseen-map
// shown by: estimate
// mistake: does not divide the sums of rewards.
// ask: Is it the sum of the rewards? Wanted is their mean.
// <solution estimated>
// in place of: model.R(s, a) /= tries;

// <variant rewards_only> caught by: plan, more-plans, unseen-map
// shown by: plan
// mistake: does not look ahead.
// ask: Does nothing but the reward count?
// <solution plannedValues>
return discount < 0 ? model.visits : model.R;

// <variant ten_sweeps> caught by: plan, more-plans
// shown by: plan
// mistake: ends after ten sweeps.
// ask: Does the iteration end too early?
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
// ask: Do the neighbours of a pair that is not known not hope for it?
// <solution optimisticValues>
Eigen::MatrixXd Q = plannedValues(model, discount);
for (Eigen::Index s = 0; s < Q.rows(); ++s)
  for (Eigen::Index a = 0; a < Q.cols(); ++a)
    if (model.visits(s, a) < known) Q(s, a) = maxReward / (1 - discount);
return Q;

// <variant known_too_late> caught by: hope, more-hope
// shown by: hope
// mistake: believes one try too late.
// ask: Is a pair known too late? `known` tries are enough.
// <solution optimisticValues>
// in place of: if (model.visits(s, a) >= known) continue;
if (model.visits(s, a) > known) continue;

// <variant known_when_tried> caught by: hope, more-hope
// shown by: hope
// mistake: believes a single try.
// ask: Is a pair known as soon as it was tried once?
// <solution optimisticValues>
// in place of: if (model.visits(s, a) >= known) continue;
if (known > 0 && model.visits(s, a) > 0) continue;

// <variant paid_once> caught by: hope, more-hope
// shown by: hope
// mistake: what is not known pays only once.
// ask: Is maxReward paid only once? It is paid in every step for ever.
// <solution optimisticValues>
// in place of: hoped.R(s, a) = maxReward / (1 - discount);
hoped.R(s, a) = maxReward;

// <variant counts_for_shares> caught by: clone, other-clones
// mistake: does not divide the counts.
// ask: Are these counts? Wanted are shares.
// <solution cloned>
// in place of: if (all == 0) policy.row(s).setOnes(); ... policy.row(s) /= all > 0 ? all : actions;
if (all == 0) policy.row(s).setConstant(1. / actions);

// <variant counts_and_zeros> caught by: clone, other-clones
// mistake: does not divide the counts, and leaves zeros where there are no lessons.
// ask: Are these counts? Wanted are shares.
// <solution cloned>
// in place of: for (int s = 0; s < states; ++s) { ... }

// <variant nothing_without_lessons> caught by: clone, other-clones
// mistake: leaves zeros where there are no lessons.
// ask: Is there no action in states without lessons? All are equally likely there.
// <solution cloned>
// in place of: if (all == 0) policy.row(s).setOnes(); ... policy.row(s) /= all > 0 ? all : actions;
if (all > 0) policy.row(s) /= all;

// <variant nothing_by_nothing> caught by: clone, other-clones
// mistake: divides zero by zero where there are no lessons.
// ask: Is zero divided by zero? Some states have no lessons.
// <solution cloned>
// in place of: if (all == 0) policy.row(s).setOnes(); ... policy.row(s) /= all > 0 ? all : actions;
policy.row(s) /= all;

// <variant share_of_all_lessons> caught by: clone, other-clones
// mistake: divides by the number of all lessons.
// ask: Is it the share of all lessons? Those of the state itself count.
// <solution cloned>
// in place of: policy.row(s) /= all > 0 ? all : actions;
policy.row(s) /= all > 0 ? static_cast<double>(lessons.size()) : actions;

// <variant share_of_all_and_zeros> caught by: clone, other-clones
// mistake: divides by the number of all lessons, also where there are none.
// ask: Is it the share of all lessons? Those of the state itself count.
// <solution cloned>
// in place of: for (int s = 0; s < states; ++s) { ... }
policy /= static_cast<double>(lessons.size());

// <variant most_frequent_action> caught by: clone, other-clones
// mistake: always takes the most frequent action.
// ask: Is the most frequent action always taken? Each has its share.
// <solution cloned>
// in place of: policy.row(s) /= all > 0 ? all : actions;
Eigen::Index favourite = 0;
policy.row(s).maxCoeff(&favourite);
policy.row(s).setConstant(all > 0 ? 0 : 1. / actions);
if (all > 0) policy(s, favourite) = 1;

// <variant last_lesson> caught by: clone, other-clones
// mistake: remembers only the last lesson of a state.
// ask: Does only the last lesson of a state count?
// <solution cloned>
// in place of: for (const Lesson& lesson : lessons) policy(lesson.state, lesson.action) += 1;
for (const Lesson& lesson : lessons)
  policy.row(lesson.state) = Eigen::RowVectorXd::Unit(actions, lesson.action);

// <variant one_more_of_each> caught by: clone, other-clones
// mistake: adds one to each count.
// ask: Is one added to each count? The shares are those of the lessons alone.
// <solution cloned>
// in place of: Eigen::MatrixXd policy = Eigen::MatrixXd::Zero(states, actions);
Eigen::MatrixXd policy = Eigen::MatrixXd::Ones(states, actions);

// <variant follows_the_teacher> caught by: clone, other-clones
// mistake: the teacher acts, and the clone is asked what it would do.
// ask: Do the states follow the teacher? The clone acts.
// <solution mistakeChances>
// in place of: const Eigen::MatrixXd next = nextUnder(P, policy);
Eigen::MatrixXd acts = Eigen::MatrixXd::Zero(policy.rows(), policy.cols());
for (Eigen::Index s = 0; s < policy.rows(); ++s) acts(s, teacher[static_cast<std::size_t>(s)]) = 1;
const Eigen::MatrixXd next = nextUnder(P, acts);

// <variant ends_with_a_mistake> caught by: clone, other-clones
// mistake: follows only walks without a mistake.
// ask: Does a walk end with its first mistake? The clone goes on.
// <solution mistakeChances>
// in place of: const Eigen::MatrixXd next = nextUnder(P, policy);
Eigen::MatrixXd acts = Eigen::MatrixXd::Zero(policy.rows(), policy.cols());
for (Eigen::Index s = 0; s < policy.rows(); ++s) {
  const int a = teacher[static_cast<std::size_t>(s)];
  acts(s, a) = policy(s, a);
}
const Eigen::MatrixXd next = nextUnder(P, acts);

// <variant from_columns_to_rows> caught by: clone, other-clones
// mistake: multiplies by P, not by its transpose.
// ask: Are rows and columns of P exchanged?
// <solution mistakeChances>
// in place of: now = (next.transpose() * now).eval();
now = (next * now).eval();

// <variant second_step_first> caught by: clone, other-clones
// mistake: moves on before it counts.
// ask: Is entry 0 the second step? It is the first.
// <solution mistakeChances>
// in place of: for (Eigen::Index s = 0; s < now.size(); ++s) ... now = (next.transpose() * now).eval();
now = (next.transpose() * now).eval();
for (Eigen::Index s = 0; s < now.size(); ++s)
  chances[t] += now[s] * (1 - policy(s, teacher[static_cast<std::size_t>(s)]));

// <variant mistakes_so_far> caught by: clone, other-clones
// mistake: sums over the steps.
// ask: Are these the mistakes of all steps so far? Each step has its own entry.
// <solution mistakeChances>
// in place of: now = (next.transpose() * now).eval();
now = (next.transpose() * now).eval();
if (t > 0) chances[t] += chances[t - 1];

// <variant share_of_those_left> caught by: clone, other-clones
// mistake: divides by the probability that the walk goes on.
// ask: Is it a share of the walks that go on? What has ended makes no mistake.
// <solution mistakeChances>
// in place of: now = (next.transpose() * now).eval();
chances[t] /= now.sum();
now = (next.transpose() * now).eval();

// <variant chance_of_being_right> caught by: clone, other-clones
// mistake: adds up what the teacher would do, too.
// ask: Are these the chances of the teacher's action?
// <solution mistakeChances>
// in place of: chances[t] += now[s] * (1 - policy(s, teacher[static_cast<std::size_t>(s)]));
chances[t] += now[s] * policy(s, teacher[static_cast<std::size_t>(s)]);

// <variant one_less_right> caught by: clone, other-clones
// mistake: one minus the chance of being right, also after the end.
// ask: Does a walk that has ended still make mistakes?
// <solution mistakeChances>
// in place of: for (Eigen::Index s = 0; s < now.size(); ++s) ... chances[t] +=
chances[t] = 1;
for (Eigen::Index s = 0; s < now.size(); ++s)
  chances[t] -= now[s] * policy(s, teacher[static_cast<std::size_t>(s)]);

// <variant forgets_the_rounds_before> caught by: aggregate, other-clones
// mistake: learns only the lessons of the last round.
// ask: Do only the lessons of the last round count? All do.
// <solution aggregated>
// in place of: for (const int s : here) all.push_back({s, taught(s)});
all.clear();
for (const int s : here) all.push_back({s, taught(s)});

// <variant forgets_the_demonstrations> caught by: aggregate, other-clones
// mistake: begins without the demonstrations.
// ask: Do the demonstrations not count?
// <solution aggregated>
// in place of: std::vector<Lesson> all = lessons;
std::vector<Lesson> all;

// <variant same_clone_in_each_round> caught by: aggregate, other-clones
// mistake: the clone of the demonstrations acts in each round.
// <solution aggregated>
// in place of: const std::vector<int> here = visited(cloned(all, states, actions));
const std::vector<int> here = visited(cloned(lessons, states, actions));

// <variant never_learns> caught by: aggregate, other-clones
// mistake: asks the teacher, and does not use the answers.
// ask: Are the lessons of the rounds never used?
// <solution aggregated>
// in place of: return cloned(all, states, actions);
return cloned(lessons, states, actions);

// <variant last_that_acted> caught by: aggregate, other-clones
// mistake: returns the clone that acted last.
// ask: Is it the clone that acted last? It has not had the lessons of that round.
// <solution aggregated>
Eigen::MatrixXd policy = cloned(lessons, states, actions);
std::vector<Lesson> all = lessons;
for (int round = 0; round < rounds; ++round) {
  policy = cloned(all, states, actions);
  for (const int s : visited(policy)) all.push_back({s, taught(s)});
}
return policy;

// <variant each_state_once> caught by: aggregate, other-clones
// mistake: asks once about each state of a round.
// ask: Does each state count once in a round? Each visit is a lesson.
// <solution aggregated>
// in place of: for (const int s : here) all.push_back({s, taught(s)});
for (std::size_t i = 0; i < here.size(); ++i)
  if (std::find(here.begin(), here.begin() + static_cast<std::ptrdiff_t>(i), here[i]) ==
      here.begin() + static_cast<std::ptrdiff_t>(i))
    all.push_back({here[i], taught(here[i])});

// <variant copies_itself> caught by: aggregate, other-clones
// mistake: learns what the clone would do.
// ask: Does the clone learn from its own actions? It is the teacher who says what to do.
// <solution aggregated>
// in place of: for (const int s : here) all.push_back({s, taught(s)});
for (const int s : here) {
  int best = 0;
  cloned(all, states, actions).row(s).maxCoeff(&best);
  all.push_back({s, best});
}

// <variant one_round_more> caught by: aggregate, other-clones
// mistake: lets the clone act once more.
// <solution aggregated>
// in place of: for (int round ... return
for (int round = 0; round <= rounds; ++round)
  for (const int s : visited(cloned(all, states, actions))) all.push_back({s, taught(s)});
return cloned(all, states, actions);

// <variant rows_of_p_as_columns> caught by: wishes, other-teachers
// mistake: does not transpose P.
// ask: Are rows and columns of P exchanged? It is a row that says where a state leads.
// <solution expectedFeatures>
// in place of: const Eigen::VectorXd visits = solve(stay - world.discount * next, world.start);
const Eigen::VectorXd visits = solve(stay - world.discount * next.transpose(), world.start);

// <variant without_the_first_state> caught by: wishes, other-teachers
// mistake: begins with the second state.
// ask: Do the features of the first state not count?
// <solution expectedFeatures>
// in place of: const Eigen::VectorXd visits = solve(stay - world.discount * next, world.start);
const Eigen::VectorXd visits = solve(stay - world.discount * next, world.start) - world.start;

// <variant discount_from_the_first> caught by: wishes, other-teachers
// mistake: also discounts the first state.
// ask: Do the features of the first state count with the discount?
// <solution expectedFeatures>
// in place of: return world.features * visits;
return world.discount * (world.features * visits);

// <variant mean_over_the_steps> caught by: wishes, other-teachers
// mistake: divides by the sum of the discounts.
// ask: Is it a mean over the steps? Wanted is the sum.
// <solution expectedFeatures>
// in place of: return world.features * visits;
return (1 - world.discount) * (world.features * visits);

// <variant features_without_discount> caught by: wishes, other-teachers
// mistake: forgets the discount.
// ask: Is the discount forgotten?
// <solution expectedFeatures>
// in place of: const Eigen::VectorXd visits = solve(stay - world.discount * next, world.start);
const Eigen::VectorXd visits = solve(stay - next, world.start);

// <variant first_state_alone> caught by: wishes, other-teachers
// mistake: looks at the first state only.
// ask: Does only the first state count?
// <solution expectedFeatures>
// in place of: const Eigen::VectorXd visits = solve(stay - world.discount * next, world.start);
const Eigen::VectorXd visits = world.discount < 0 ? stay.col(0) : world.start;

// <variant actions_alike> caught by: wishes, other-teachers
// mistake: draws all actions with equal probability.
// ask: Do all actions count alike? The policy draws them.
// <solution expectedFeatures>
// in place of: next = nextUnder(world.P, policy).transpose();
next = nextUnder(world.P, Eigen::MatrixXd::Constant(policy.rows(), policy.cols(),
                                                    1. / static_cast<double>(policy.cols())))
           .transpose();

// <variant twenty_steps> caught by: wishes, other-teachers
// mistake: adds up twenty steps only.
// ask: Does the sum end too early?
// <solution expectedFeatures>
// in place of: const Eigen::VectorXd visits = solve(stay - world.discount * next, world.start);
Eigen::VectorXd visits = stay.col(0) * 0, now = world.start;
for (int t = 0; t < 20; ++t) {
  visits += now;
  now = (world.discount * next * now).eval();
}

// <variant worst_policy> caught by: wishes, other-teachers
// mistake: takes the worst action.
// ask: Is it the worst action?
// <solution bestPolicy>
// in place of: Q.row(s).maxCoeff(&favourite);
Q.row(s).minCoeff(&favourite);

// <variant opposite_wishes> caught by: wishes, other-teachers
// mistake: pays -w^T phi.
// ask: Does w have the opposite sign?
// <solution bestPolicy>
// in place of: for (Eigen::Index s = 0; s < n; ++s) paid.row(s).setConstant(w.dot(world.features.col(s)));
for (Eigen::Index s = 0; s < n; ++s) paid.row(s).setConstant(-w.dot(world.features.col(s)));

// <variant next_state_only> caught by: wishes, other-teachers
// mistake: looks one step ahead only.
// ask: Does only the next state count? All later ones do, too.
// <solution bestPolicy>
// in place of: const Eigen::MatrixXd Q = plannedValues({world.P, paid, policy}, world.discount);
Eigen::MatrixXd Q = paid;
for (Eigen::Index a = 0; a < m; ++a) Q.col(a) += world.P[static_cast<std::size_t>(a)] * paid.col(0);

// <variant rewards_without_plan> caught by: wishes, other-teachers
// mistake: compares the rewards, which are equal.
// <solution bestPolicy>
// in place of: Q.row(s).maxCoeff(&favourite);
paid.row(s).maxCoeff(&favourite);

// <variant values_for_probabilities> caught by: wishes, other-teachers
// mistake: returns the values of the actions.
// ask: Are these values of actions? A policy has their probabilities.
// <solution bestPolicy>
// in place of: for (Eigen::Index s = 0; s < n; ++s) { ... return policy;
return Q;

// <variant undecided> caught by: wishes, other-teachers
// mistake: takes all actions with equal probability.
// ask: Are all actions equally likely?
// <solution bestPolicy>
// in place of: policy(s, favourite) = 1;
policy.row(s).setConstant(1. / static_cast<double>(m));

// <variant beyond_the_ends> caught by: explain, other-teachers
// mistake: does not stop at the ends.
// ask: May the share be less than 0 or more than 1?
// <solution nearestShare>
// in place of: return std::clamp(way.dot(teacher - mixed) / way.squaredNorm(), 0., 1.);
return way.dot(teacher - mixed) / way.squaredNorm();

// <variant share_of_the_mixture> caught by: explain, other-teachers
// mistake: returns the share of the other.
// ask: Is it the share of the mixture so far? Wanted is that of the candidate.
// <solution nearestShare>
// in place of: return std::clamp(way.dot(teacher - mixed) / way.squaredNorm(), 0., 1.);
return std::clamp(1 - way.dot(teacher - mixed) / way.squaredNorm(), 0., 1.);

// <variant length_of_the_projection> caught by: explain, other-teachers
// mistake: divides by the length, not by its square.
// ask: Is it a length? Wanted is its share of the distance from `mixed` to `candidate`.
// <solution nearestShare>
// in place of: return std::clamp(way.dot(teacher - mixed) / way.squaredNorm(), 0., 1.);
return std::clamp(way.dot(teacher - mixed) / way.norm(), 0., 1.);

// <variant share_by_distances> caught by: explain, other-teachers
// mistake: compares the distances only.
// ask: Does only the distance to the teacher count? The direction does, too.
// <solution nearestShare>
// in place of: return std::clamp(way.dot(teacher - mixed) / way.squaredNorm(), 0., 1.);
return std::clamp((teacher - mixed).norm() / way.norm(), 0., 1.);

// <variant projected_from_the_origin> caught by: explain, other-teachers
// mistake: projects the teacher from the origin.
// ask: Is the teacher projected from the origin? The line begins at `mixed`.
// <solution nearestShare>
// in place of: return std::clamp(way.dot(teacher - mixed) / way.squaredNorm(), 0., 1.);
return std::clamp(teacher.dot(candidate) / candidate.squaredNorm(), 0., 1.);

// <variant no_way_at_all> caught by: explain
// mistake: divides zero by zero if both are equal.
// <solution nearestShare>
// in place of: if (way.squaredNorm() == 0) return 0;

// <variant away_from_the_teacher> caught by: explain, other-teachers
// mistake: w points away from the teacher.
// ask: Does w point from the teacher to the mixture?
// <solution explained>
// in place of: found.w = (teacher - mixed) / (teacher - mixed).norm();
found.w = (mixed - teacher) / (mixed - teacher).norm();

// <variant last_policy_alone> caught by: explain, other-teachers
// mistake: compares the teacher with the last policy, not with the mixture.
// ask: Is the teacher compared with the last policy alone? The mixture counts.
// <solution explained>
// in place of: found.w = (teacher - mixed) / (teacher - mixed).norm();
const Eigen::VectorXd lack = teacher - expectedFeatures(world, found.policies.back());
found.w = lack / lack.norm();

// <variant teacher_alone> caught by: explain, other-teachers
// mistake: takes what the teacher has for w.
// ask: Is w the teacher's <phi>? It is what that has more than the mixture.
// <solution explained>
// in place of: found.w = (teacher - mixed) / (teacher - mixed).norm();
found.w = teacher / teacher.norm();

// <variant w_of_any_length> caught by: explain, other-teachers
// mistake: does not give w the length 1.
// ask: Is the length of w not 1?
// <solution explained>
// in place of: found.w = (teacher - mixed) / (teacher - mixed).norm();
found.w = teacher - mixed;

// <variant same_w_in_each_round> caught by: explain, other-teachers
// mistake: keeps the w of the first round.
// ask: Is w the same in each round?
// <solution explained>
// in place of: found.w = (teacher - mixed) / (teacher - mixed).norm();
if (round == 0) found.w = (teacher - mixed) / (teacher - mixed).norm();

// <variant mixture_replaced> caught by: explain, other-teachers
// mistake: takes the last policy for the mixture.
// ask: Is the last policy taken for the mixture? The mixture moves towards it by its share.
// <solution explained>
// in place of: mixed += share * (candidate - mixed);
mixed = candidate;

// <variant others_keep_their_shares> caught by: explain, other-teachers
// mistake: does not shrink the shares of the others.
// ask: Do the shares of the others not shrink?
// <solution explained>
// in place of: found.shares *= 1 - share;

// <variant all_shares_equal> caught by: explain, other-teachers
// mistake: gives all policies the same share.
// ask: Do all policies have the same share?
// <solution explained>
// in place of: return found;
found.shares.setConstant(1. / static_cast<double>(found.shares.size()));
return found;

// <variant last_has_all> caught by: explain, other-teachers
// mistake: gives the last policy all of the mixture.
// ask: Does the last policy have all of the mixture?
// <solution explained>
// in place of: return found;
found.shares = Eigen::VectorXd::Unit(found.shares.size(), found.shares.size() - 1);
return found;

// <variant shares_exchanged> caught by: explain, other-teachers
// mistake: gives the new policy what is left for the others.
// ask: Do both have each other's share?
// <solution explained>
// in place of: found.shares *= 1 - share;
found.shares *= share;
// in place of: found.shares[found.shares.size() - 1] = share;
found.shares[found.shares.size() - 1] = 1 - share;

// <variant w_of_the_round_to_come> caught by: explain, other-teachers
// mistake: returns the next w.
// ask: Is it the w of the round to come? Wanted is that of the last policy.
// <solution explained>
// in place of: return found;
if (found.policies.size() > 1 && teacher != mixed) found.w = (teacher - mixed) / (teacher - mixed).norm();
return found;

// <variant without_the_first_policy> caught by: explain, other-teachers
// mistake: leaves out the policy that it begins with.
// ask: Is the policy left out with which the search begins?
// <solution explained>
// in place of: return found;
if (found.policies.size() > 1) {
  found.policies.erase(found.policies.begin());
  found.shares = found.shares.tail(found.shares.size() - 1).eval();
}
return found;

// <variant never_ends_early> caught by: other-teachers
// mistake: goes on where the teacher is matched.
// <solution explained>
// in place of: Eigen::VectorXd mixed = expectedFeatures(world, found.policies[0]);
Eigen::VectorXd mixed = expectedFeatures(world, found.policies[0]);
tolerance = 0;

// <variant margin_of_sums> caught by: bounds, other-bounds
// mistake: adds the margin to the sum of payments.
// ask: Is the margin added to the sum of what was paid? It belongs to the mean.
// <solution upperBounds>
const Eigen::ArrayXd N = pulls.cast<double>();
return paid.array() + (2 * std::log(N.sum()) / N).sqrt();

// <variant n_of_the_arm> caught by: bounds, other-bounds
// shown by: bounds
// mistake: counts only the pulls of the arm itself.
// ask: Is n the number of pulls of the arm itself? It is that of all arms.
// <solution upperBounds>
const Eigen::ArrayXd N = pulls.cast<double>();
return paid.array() / N + (2 * N.log() / N).sqrt();

// <variant number_of_arms> caught by: bounds, other-bounds
// mistake: takes the number of arms for n.
// ask: Is n the number of arms? It is that of all pulls.
// <solution upperBounds>
const Eigen::ArrayXd N = pulls.cast<double>();
return paid.array() / N + (2 * std::log(static_cast<double>(N.size())) / N).sqrt();

// <variant means_alone> caught by: bounds, other-bounds
// mistake: adds no margin.
// ask: Is there no margin?
// <solution upperBounds>
return paid.array() / pulls.cast<double>().array();

// <variant pessimist> caught by: bounds, other-bounds
// shown by: bounds
// mistake: subtracts the margin.
// ask: Is it the lower bound?
// <solution upperBounds>
const Eigen::ArrayXd N = pulls.cast<double>();
return paid.array() / N - (2 * std::log(N.sum()) / N).sqrt();

// <variant power_forgotten> caught by: bounds, other-bounds
// mistake: solves exp(-2 N b^2) = 1 / n.
// ask: Is the power of n forgotten? Hoeffding's inequality should allow n^-4.
// <solution upperBounds>
const Eigen::ArrayXd N = pulls.cast<double>();
return paid.array() / N + (std::log(N.sum()) / (2 * N)).sqrt();
