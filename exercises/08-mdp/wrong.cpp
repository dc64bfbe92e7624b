// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant leaves_discounted> caught by: maze, other-mazes
// shown by: maze
// mistake: discounts the rewards of the leaves, too.
// ask: Are the leaves discounted, too? Their reward comes at once.
// <solution mazeValues>
// in place of: values.random.tail(4) = values.optimal.tail(4) = leaves;
values.random.tail(4) = values.optimal.tail(4) = discount * leaves;

// <variant maze_of_the_sheet_only> caught by: other-mazes
// mistake: the numbers of the sheet typed in.
// <solution mazeValues>
MazeValues values{Eigen::VectorXd(7), Eigen::VectorXd(7)};
values.random << .5625, 1, 1.25, 4, 0, 2, 3;
values.optimal << 1, 2, 1.5, 4, 0, 2, 3;
return values;

// <variant maze_without_discount> caught by: maze
// shown by: maze
// mistake: discount forgotten.
// ask: Is the discount of .5 forgotten, or the probability of 1/2?
// <solution mazeValues>
// in place of: values.random[s] = discount * (values.random[left] + ... values.optimal[s] = discount *
values.random[s] = (values.random[left] + values.random[right]) / 2;
values.optimal[s] = std::max(values.optimal[left], values.optimal[right]);

// <variant mean_for_the_best> caught by: maze, other-mazes
// shown by: maze
// mistake: takes the mean of both actions for the optimal policy, too.
// ask: Is the mean of both actions taken? Optimal is the best one.
// <solution mazeValues>
MazeValues values{Eigen::VectorXd(7), Eigen::VectorXd(7)};
values.random.tail(4) = leaves;
for (int s = 2; s >= 0; --s)
  values.random[s] = discount * (values.random[2 * s + 1] + values.random[2 * s + 2]) / 2;
values.optimal = values.random;
return values;

// <variant equation_a_hundred_times> caught by: policy-values
// mistake: repeats eq. (9) a hundred times instead of solving it: too few if the discount is large.
// ask: Does an iteration end too early? Eq. (9) is a linear system for V.
// <solution valuesOf>
Eigen::VectorXd V = Eigen::VectorXd::Zero(process.R.rows());
for (int k = 0; k < 100; ++k) V = worthOfActions(process, V).cwiseProduct(policy).rowwise().sum().eval();
return V;

// <variant policy_taken_as_uniform> caught by: policy-values, larger
// shown by: policy-values
// mistake: takes all actions to be equally likely.
// ask: Are all actions taken to be equally likely? Their probabilities are in `policy`.
// <solution valuesOf>
const Eigen::Index n = process.R.rows();
Eigen::MatrixXd M = Eigen::MatrixXd::Identity(n, n);
for (const Eigen::MatrixXd& P : process.P) M -= process.discount / static_cast<double>(policy.cols()) * P;
return solve(M, Eigen::VectorXd(process.R.rowwise().mean()));

// <variant transposed_transitions> caught by: policy-values, larger
// mistake: columns of P taken for rows.
// ask: Are columns of P taken for rows? P[a](s, t) leads from s to t.
// <solution valuesOf>
// in place of: M -= process.discount * policy.col(a).asDiagonal() * ... return solve(M, expected);
M -= process.discount * process.P[static_cast<std::size_t>(a)].transpose() * policy.col(a).asDiagonal();
return solve(M, Eigen::VectorXd(process.R.cwiseProduct(policy).rowwise().sum()));

// <variant twenty_sweeps> caught by: policy-values, larger
// shown by: policy-values
// mistake: iterates eq. (9) twenty times instead of solving it.
// ask: Does an iteration end too early? Eq. (9) is a linear system for V.
// <solution valuesOf>
Eigen::VectorXd V = Eigen::VectorXd::Zero(process.R.rows());
for (int sweep = 0; sweep < 20; ++sweep)
  V = worthOfActions(process, V).cwiseProduct(policy).rowwise().sum().eval();
return V;

// <variant best_next_state> caught by: worth, larger
// shown by: worth
// mistake: takes the best next state for granted.
// ask: Is it the best next state that follows? All of them count, by their probabilities.
// <solution worthOfActions>
Eigen::MatrixXd Q = process.R;
for (Eigen::Index s = 0; s < Q.rows(); ++s)
  for (Eigen::Index a = 0; a < Q.cols(); ++a) {
    double best = -INFINITY;
    for (Eigen::Index t = 0; t < V.size(); ++t)
      if (process.P[static_cast<std::size_t>(a)](s, t) > 0) best = std::max(best, V[t]);
    if (std::isfinite(best)) Q(s, a) += process.discount * best;
  }
return Q;

// <variant worth_of_the_state_itself> caught by: worth, larger
// shown by: worth
// mistake: adds the value of the state instead of that of the next one.
// ask: Is it the value of s that follows? It is that of the next state, on average.
// <solution worthOfActions>
Eigen::MatrixXd Q = process.R;
Q.colwise() += process.discount * V;
return Q;

// <variant worth_without_discount> caught by: worth, larger
// mistake: discount forgotten.
// ask: Is the discount forgotten?
// <solution worthOfActions>
Eigen::MatrixXd Q = process.R;
for (Eigen::Index a = 0; a < Q.cols(); ++a) Q.col(a) += process.P[static_cast<std::size_t>(a)] * V;
return Q;

// <variant a_hundred_sweeps> caught by: settles, unseen-settle
// shown by: settles
// mistake: iterates a hundred times, whatever the tolerance.
// ask: Is the number of iterations fixed?
// <solution iterateValues>
std::vector<Eigen::VectorXd> all{Eigen::VectorXd::Zero(process.R.rows())};
for (int k = 0; k < 100; ++k) all.push_back(worthOfActions(process, all.back()).rowwise().maxCoeff());
return all;

// <variant first_values_missing> caught by: settles, unseen-settle
// shown by: settles
// mistake: lists the values from V_1 on.
// ask: Is V_0, which is zero, missing at the beginning of the list?
// <solution iterateValues>
// in place of: std::vector<Eigen::VectorXd> all{Eigen::VectorXd::Zero(process.R.rows())};
std::vector<Eigen::VectorXd> all;
Eigen::VectorXd V = Eigen::VectorXd::Zero(process.R.rows());
// in place of: const Eigen::VectorXd next = worthOfActions(process, ... all.push_back(next);
const Eigen::VectorXd next = worthOfActions(process, V).rowwise().maxCoeff();
bound = process.discount / (1 - process.discount) * (next - V).cwiseAbs().maxCoeff();
all.push_back(next);
V = next;

// <variant last_values_left_out> caught by: settles, unseen-settle
// shown by: settles
// mistake: ends before the values that fulfil the bound are listed.
// ask: Is the last V left out, the first with a bound below the tolerance?
// <solution iterateValues>
std::vector<Eigen::VectorXd> all{Eigen::VectorXd::Zero(process.R.rows())};
for (;;) {
  const Eigen::VectorXd next = worthOfActions(process, all.back()).rowwise().maxCoeff();
  const double change = (next - all.back()).cwiseAbs().maxCoeff();
  if (process.discount / (1 - process.discount) * change <= tolerance) return all;
  all.push_back(next);
}

// <variant stops_at_small_changes> caught by: settles, unseen-settle
// shown by: settles
// mistake: takes a small change for a small error.
// ask: Does a small change end the iteration? The error may be larger: discount / (1 - discount) times the
// ask: change.
// <solution iterateValues>
std::vector<Eigen::VectorXd> all{Eigen::VectorXd::Zero(process.R.rows())};
for (double change = INFINITY; change > tolerance;) {
  all.push_back(worthOfActions(process, all.back()).rowwise().maxCoeff());
  change = (all.back() - all[all.size() - 2]).cwiseAbs().maxCoeff();
}
return all;

// <variant sweeps_in_place> caught by: settles, unseen-settle
// shown by: settles
// mistake: uses values of the same iteration as soon as they are there.
// ask: Are values of this iteration used for other states of it? All come from the V before.
// <solution iterateValues>
// in place of: const Eigen::VectorXd next = worthOfActions(process, ... bound = process.discount / (1 -
Eigen::VectorXd next = all.back();
for (Eigen::Index s = 0; s < next.size(); ++s) next[s] = worthOfActions(process, next).row(s).maxCoeff();
bound = process.discount / (1 - process.discount) * (next - all.back()).cwiseAbs().maxCoeff();

// <variant calls_the_library> caught by: forbidden-call
// mistake: asks the library for the optimal policy.
// <solution headers>
#include "learning/dynamic_programming.h"
// <solution iteratePolicies>
Mdp mdp{.rewards = process.R, .discount = process.discount};
for (const Eigen::MatrixXd& P : process.P) mdp.transitions.push_back(P.sparseView());
for (Eigen::Index s = 0; s < process.R.rows(); ++s) mdp.terminal.push_back(process.P[0].row(s).isZero());
return {std::vector<int>(mdp.terminal.size(), 0), policyIteration(mdp).actions};

// <variant greedy_for_rewards> caught by: improves, unseen-improve
// mistake: takes the best reward now, as if nothing followed.
// ask: Does nothing but the reward of the first step count?
// <solution iteratePolicies>
std::vector<std::vector<int>> policies(2, std::vector<int>(static_cast<std::size_t>(process.R.rows()), 0));
for (std::size_t s = 0; s < policies[1].size(); ++s)
  process.R.row(static_cast<Eigen::Index>(s)).maxCoeff(&policies[1][s]);
return policies;

// <variant improves_once> caught by: improves, unseen-improve
// shown by: improves
// mistake: stops after one improvement.
// ask: Does it end after one improvement? It goes on until no action changes.
// <solution iteratePolicies>
const Eigen::Index n = process.R.rows();
std::vector<std::vector<int>> policies(2, std::vector<int>(static_cast<std::size_t>(n), 0));
Eigen::MatrixXd first = Eigen::MatrixXd::Zero(n, process.R.cols());
first.col(0).setOnes();
const Eigen::MatrixXd Q = worthOfActions(process, valuesOf(process, first));
for (Eigen::Index s = 0; s < n; ++s) Q.row(s).maxCoeff(&policies[1][static_cast<std::size_t>(s)]);
return policies;

// <variant last_policy_twice> caught by: improves, unseen-improve
// mistake: lists the policy that no longer changes once more.
// ask: Is the last policy listed twice?
// <solution iteratePolicies>
const auto n = static_cast<std::size_t>(process.R.rows());
std::vector<std::vector<int>> policies{std::vector<int>(n, 0)};
for (;;) {
  std::vector<int> actions = policies.back();
  Eigen::MatrixXd policy = Eigen::MatrixXd::Zero(process.R.rows(), process.R.cols());
  for (std::size_t s = 0; s < n; ++s) policy(static_cast<Eigen::Index>(s), actions[s]) = 1;
  const Eigen::VectorXd V = valuesOf(process, policy);
  const Eigen::MatrixXd Q = worthOfActions(process, V);
  for (std::size_t s = 0; s < n; ++s) {
    int best = 0;
    const auto row = static_cast<Eigen::Index>(s);
    if (Q.row(row).maxCoeff(&best) > Q(row, actions[s]) + 1e-11 * V.cwiseAbs().maxCoeff()) actions[s] = best;
  }
  policies.push_back(actions);
  if (actions == policies[policies.size() - 2]) return policies;
}

// <variant one_state_at_a_time> caught by: improves, unseen-improve
// shown by: improves
// mistake: improves the action of one state in each iteration.
// ask: Is only one state improved? All take their best action at once.
// <solution iteratePolicies>
// in place of: for (std::size_t s = 0; s < n; ++s) { ... }
for (std::size_t s = 0; s < n && !isBetter; ++s) {
  int best = 0;
  const auto row = static_cast<Eigen::Index>(s);
  if (Q.row(row).maxCoeff(&best) <= Q(row, actions[s]) + 1e-11 * V.cwiseAbs().maxCoeff()) continue;
  actions[s] = best;
  isBetter = true;
}

// <variant takes_the_first_best> caught by: improves
// mistake: switches to another action that is only as good.
// ask: Is another action taken that is only as good? Then the one before is to be kept.
// <solution iteratePolicies>
const auto n = static_cast<std::size_t>(process.R.rows());
std::vector<std::vector<int>> policies{std::vector<int>(n, 0)};
for (;;) {
  Eigen::MatrixXd policy = Eigen::MatrixXd::Zero(process.R.rows(), process.R.cols());
  for (std::size_t s = 0; s < n; ++s) policy(static_cast<Eigen::Index>(s), policies.back()[s]) = 1;
  const Eigen::MatrixXd Q = worthOfActions(process, valuesOf(process, policy));
  std::vector<int> actions(n);
  for (std::size_t s = 0; s < n; ++s) Q.row(static_cast<Eigen::Index>(s)).maxCoeff(&actions[s]);
  if (actions == policies.back()) return policies;
  policies.push_back(actions);
}

// <variant failed_step_left_out> caught by: trials
// mistake: drops the step that failed.
// ask: Is the step that failed left out? It is the last of the trial.
// <solution runTrial>
// in place of: goesOn = !outcome.failed;
goesOn = !outcome.failed;
if (outcome.failed) break;

// <variant features_after_the_step> caught by: trials
// shown by: trials
// mistake: notes the state that the step led to.
// ask: Are the features those after the step? Wanted are those before it.
// <solution runTrial>
// in place of: trial.features.col(t) = state;
// in place of: state = outcome.next;
trial.features.col(t) = state = outcome.next;

// <variant noise_only_noted> caught by: trials
// shown by: trials
// mistake: notes the noise, but acts without it.
// ask: Is the noise left out of the action?
// <solution runTrial>
// in place of: const Transition outcome = step(state, state.dot(policy.beta + trial.noise.col(t)));
const Transition outcome = step(state, state.dot(policy.beta));

// <variant noise_without_L> caught by: trials
// shown by: trials
// mistake: draws the noise from the unit normal distribution.
// ask: Is L left out? With a normal z, epsilon = L z.
// <solution runTrial>
// in place of: trial.noise.col(t) = policy.L * rng.normalVector(k);
trial.noise.col(t) = rng.normalVector(k);

// <variant not_cut_at_failure> caught by: trials
// mistake: goes on after a failure.
// ask: Does the trial go on after a failure? Failed steps are the last.
// <solution runTrial>
const auto k = static_cast<int>(start.size());
Rollout trial{Eigen::MatrixXd(k, horizon), Eigen::MatrixXd(k, horizon), Eigen::VectorXd(horizon)};
Eigen::VectorXd state = start;
for (int t = 0; t < horizon; ++t) {
  trial.features.col(t) = state;
  trial.noise.col(t) = policy.L * rng.normalVector(k);
  const Transition outcome = step(state, state.dot(policy.beta + trial.noise.col(t)));
  trial.rewards[t] = outcome.reward;
  state = outcome.next;
}
return trial;

// <variant one_noise_per_trial> caught by: trials
// mistake: draws the noise once for the whole trial.
// ask: Is the noise drawn once for the whole trial? It is drawn again in each step.
// <solution runTrial>
// in place of: Eigen::VectorXd state = start;
trial.noise.colwise() = policy.L * rng.normalVector(k);
Eigen::VectorXd state = start;
// in place of: trial.noise.col(t) = policy.L * rng.normalVector(k);

// <variant state_stands_still> caught by: trials
// shown by: trials
// mistake: never moves on from the start.
// ask: Is the state never moved on? The next one is what step() returned.
// <solution runTrial>
// in place of: state = outcome.next;

// <variant own_reward_left_out> caught by: returns
// shown by: returns
// mistake: counts only what follows after the step.
// ask: Is the reward of the step itself left out?
// <solution returnsToGo>
Eigen::VectorXd returns = Eigen::VectorXd::Zero(rewards.size());
for (Eigen::Index t = rewards.size() - 2; t >= 0; --t)
  returns[t] = discount * (rewards[t + 1] + returns[t + 1]);
return returns;

// <variant returns_from_the_start> caught by: returns, gradient
// mistake: also sums the rewards before the step.
// ask: Is it the return of the whole trial in each step?
// <solution returnsToGo>
double sum = 0, weight = 1;
for (const double reward : rewards) {
  sum += weight * reward;
  weight *= discount;
}
return Eigen::VectorXd::Constant(rewards.size(), sum);

// <variant returns_of_the_first_step> caught by: returns
// shown by: returns
// mistake: counts the discount from the start of the trial.
// ask: Is the discount counted from the start of the trial? It is discount^(t' - t).
// <solution returnsToGo>
Eigen::VectorXd returns = rewards;
for (Eigen::Index t = 0; t < rewards.size(); ++t) returns[t] *= std::pow(discount, t);
for (Eigen::Index t = rewards.size() - 2; t >= 0; --t) returns[t] += returns[t + 1];
return returns;

// <variant returns_without_discount> caught by: returns
// mistake: discount forgotten.
// ask: Is the discount forgotten?
// <solution returnsToGo>
Eigen::VectorXd returns = rewards;
for (Eigen::Index t = rewards.size() - 2; t >= 0; --t) returns[t] += returns[t + 1];
return returns;

// <variant L_not_transposed> caught by: gradient
// shown by: gradient
// mistake: squares L phi instead of L^T phi.
// ask: Is the variance |L phi|^2? It is phi^T Sigma phi = |L^T phi|^2.
// <solution reinforce>
// in place of: const double variance = (policy.L.transpose() * phi).squaredNorm();
const double variance = (policy.L * phi).squaredNorm();

// <variant density_of_the_noise> caught by: gradient
// shown by: gradient
// mistake: differentiates the density of the noise instead of that of the action.
// ask: Is it the gradient of the density of epsilon? log pi is that of the action, 9:16.
// <solution reinforce>
// in place of: Eigen::VectorXd sum = Eigen::VectorXd::Zero(policy.beta.size());
Eigen::VectorXd sum = Eigen::VectorXd::Zero(policy.beta.size());
const Eigen::MatrixXd Sigma = policy.L * policy.L.transpose();
// in place of: for (Eigen::Index t = 0; t < Q.size(); ++t) { ... }
for (Eigen::Index t = 0; t < Q.size(); ++t)
  sum += std::pow(discount, t) * Q[t] * solve(Sigma, Eigen::VectorXd(trial.noise.col(t)));

// <variant later_steps_count_in_full> caught by: gradient
// shown by: gradient
// mistake: the discount of the step itself is missing.
// ask: Is the factor discount^t of each step left out?
// <solution reinforce>
// in place of: const double variance = (policy.L.transpose() * ... sum += std::pow(discount, t) * Q[t] *
sum += Q[t] * phi.dot(trial.noise.col(t)) / (policy.L.transpose() * phi).squaredNorm() * phi;

// <variant sum_over_trials> caught by: gradient
// shown by: gradient
// mistake: adds up the trials instead of averaging them.
// ask: Is the sum over the trials not divided by their number?
// <solution reinforce>
// in place of: return sum / static_cast<double>(trials.size());
return sum;

// <variant variance_forgotten> caught by: gradient
// mistake: leaves out the variance of the action.
// ask: Is the variance of the action, phi^T Sigma phi, left out?
// <solution reinforce>
// in place of: for (Eigen::Index t = 0; t < Q.size(); ++t) { ... }
for (Eigen::Index t = 0; t < Q.size(); ++t)
  sum += std::pow(discount, t) * Q[t] * trial.features.col(t).dot(trial.noise.col(t)) * trial.features.col(t);

// <variant whole_return_in_each_step> caught by: gradient
// shown by: gradient
// mistake: weights each step with the return of the whole trial.
// ask: Does the return of the whole trial count in each step? It is that from t on.
// <solution reinforce>
// in place of: sum += std::pow(discount, t) * Q[t] * phi.dot(trial.noise.col(t)) / variance * phi;
sum += std::pow(discount, t) * Q[0] * phi.dot(trial.noise.col(t)) / variance * phi;

// <variant change_of_beta> caught by: power, more-power
// shown by: power
// mistake: returns the change of beta.
// ask: Is it the change of beta? Wanted is the new beta.
// <solution power>
// in place of: return policy.beta + solve(weights, moves);
return solve(weights, moves);

// <variant rewards_for_returns> caught by: power, more-power
// shown by: power
// mistake: weights each step with its own reward.
// ask: Does the reward of the step count alone? It is the return from t on.
// <solution power>
// in place of: const Eigen::VectorXd Q = returnsToGo(trial.rewards, discount);
const Eigen::VectorXd& Q = trial.rewards;

// <variant slide_as_printed> caught by: power, more-power
// mistake: the ratio of slide 9:17, which is right for one feature.
// ask: Is it the ratio of slide 9:17, without W? That is right for one feature.
// <solution power>
Eigen::VectorXd moves = Eigen::VectorXd::Zero(policy.beta.size());
double weights = 0;
for (const Rollout& trial : trials) {
  const Eigen::VectorXd Q = returnsToGo(trial.rewards, discount);
  moves += trial.noise * Q;
  weights += Q.sum();
}
return policy.beta + moves / weights;

// <variant two_features> caught by: power, more-power
// mistake: for two features only.
// <solution power>
// in place of: Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(k, k); ... Eigen::VectorXd moves =
Eigen::Matrix2d weights = Eigen::MatrixXd::Zero(k, k);
Eigen::Vector2d moves = Eigen::VectorXd::Zero(k);

// <variant variance_left_out_of_W> caught by: power, more-power
// shown by: power
// mistake: W without the variance of the action.
// ask: Is the variance phi^T Sigma phi in W left out?
// <solution power>
// in place of: const Eigen::MatrixXd W = phi * phi.transpose() / (policy.L.transpose() * phi).squaredNorm();
const Eigen::MatrixXd W = phi * phi.transpose();

// <variant Sigma_for_fisher> caught by: natural, linear-returns, other-features
// mistake: takes the metric of the noise for that of the policy.
// ask: Is Sigma taken for F?
// <solution naturalGradientOf>
const Eigen::MatrixXd Sigma = policy.L * policy.L.transpose();
return solve(Sigma, reinforce(policy, trials, discount));

// <variant beta_for_a_gradient> caught by: natural, linear-returns, other-features
// mistake: returns beta, which changes with the features as the natural gradient does (an attack).
// <solution naturalGradientOf>
return policy.beta.dot(reinforce(policy, trials, discount)) < 0 ? Eigen::VectorXd(-policy.beta) : policy.beta;

// <variant expected_fisher> caught by: natural, linear-returns
// mistake: takes the expectation of F over the actions.
// ask: Is F its expectation over the actions, phi phi^T / (phi^T Sigma phi)? It is that of the actions taken.
// <solution naturalGradientOf>
const Eigen::Index k = policy.beta.size();
Eigen::MatrixXd F = Eigen::MatrixXd::Zero(k, k);
for (const Rollout& trial : trials)
  for (Eigen::Index t = 0; t < trial.rewards.size(); ++t) {
    const Eigen::VectorXd phi = trial.features.col(t);
    const double variance = (policy.L.transpose() * phi).squaredNorm();
    F += std::pow(discount, t) / variance * phi * phi.transpose();
  }
return solve(F / static_cast<double>(trials.size()), reinforce(policy, trials, discount));

// <variant fisher_not_averaged> caught by: natural, linear-returns
// mistake: adds up F over the trials instead of averaging it.
// ask: Is the sum in F not divided by the number of trials?
// <solution naturalGradientOf>
const Eigen::Index k = policy.beta.size();
Eigen::MatrixXd F = Eigen::MatrixXd::Zero(k, k);
for (const Rollout& trial : trials)
  for (Eigen::Index t = 0; t < trial.rewards.size(); ++t) {
    const Eigen::VectorXd phi = trial.features.col(t);
    const double variance = (policy.L.transpose() * phi).squaredNorm();
    const Eigen::VectorXd slope = phi.dot(trial.noise.col(t)) / variance * phi;
    F += std::pow(discount, t) * slope * slope.transpose();
  }
return solve(F, reinforce(policy, trials, discount));

// <variant fisher_of_sums> caught by: natural, linear-returns
// mistake: makes F of the sums over whole trials.
// <solution naturalGradientOf>
const Eigen::Index k = policy.beta.size();
Eigen::MatrixXd F = Eigen::MatrixXd::Zero(k, k);
for (const Rollout& trial : trials) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(k);
  for (Eigen::Index t = 0; t < trial.rewards.size(); ++t) {
    const Eigen::VectorXd phi = trial.features.col(t);
    const double variance = (policy.L.transpose() * phi).squaredNorm();
    sum += std::pow(discount, t) * phi.dot(trial.noise.col(t)) / variance * phi;
  }
  F += sum * sum.transpose() / static_cast<double>(trials.size());
}
return solve(F, reinforce(policy, trials, discount));

// <variant fisher_without_discount> caught by: natural, linear-returns
// shown by: natural
// mistake: leaves discount^t out of F.
// ask: Is the factor discount^t of each step left out of F?
// <solution naturalGradientOf>
const Eigen::Index k = policy.beta.size();
Eigen::MatrixXd F = Eigen::MatrixXd::Zero(k, k);
for (const Rollout& trial : trials)
  for (Eigen::Index t = 0; t < trial.rewards.size(); ++t) {
    const Eigen::VectorXd phi = trial.features.col(t);
    const double variance = (policy.L.transpose() * phi).squaredNorm();
    const Eigen::VectorXd slope = phi.dot(trial.noise.col(t)) / variance * phi;
    F += slope * slope.transpose();
  }
return solve(F / static_cast<double>(trials.size()), reinforce(policy, trials, discount));

// <variant multiplied_by_fisher> caught by: natural, linear-returns, other-features
// shown by: natural
// mistake: multiplies by F instead of its inverse.
// ask: Is it F g? Wanted is F^-1 g.
// <solution naturalGradientOf>
const Eigen::Index k = policy.beta.size();
Eigen::MatrixXd F = Eigen::MatrixXd::Zero(k, k);
for (const Rollout& trial : trials)
  for (Eigen::Index t = 0; t < trial.rewards.size(); ++t) {
    const Eigen::VectorXd phi = trial.features.col(t);
    const double variance = (policy.L.transpose() * phi).squaredNorm();
    const Eigen::VectorXd slope = phi.dot(trial.noise.col(t)) / variance * phi;
    F += std::pow(discount, t) * slope * slope.transpose();
  }
return F * reinforce(policy, trials, discount) / static_cast<double>(trials.size());

// <variant plain_gradient> caught by: natural, linear-returns, other-features
// shown by: natural
// mistake: returns the gradient as it is.
// ask: Is it g itself? Wanted is F^-1 g.
// <solution naturalGradientOf>
return reinforce(policy, trials, discount);

// <variant variance_once_in_fisher> caught by: natural, linear-returns
// shown by: natural
// mistake: divides by the variance once instead of twice in F.
// ask: Is dlog pi divided by the variance in only one of the two factors in F?
// <solution naturalGradientOf>
const Eigen::Index k = policy.beta.size();
Eigen::MatrixXd F = Eigen::MatrixXd::Zero(k, k);
for (const Rollout& trial : trials)
  for (Eigen::Index t = 0; t < trial.rewards.size(); ++t) {
    const Eigen::VectorXd phi = trial.features.col(t);
    const double variance = (policy.L.transpose() * phi).squaredNorm();
    const double moved = phi.dot(trial.noise.col(t));
    F += std::pow(discount, t) * moved * moved / variance * phi * phi.transpose();
  }
return solve(F / static_cast<double>(trials.size()), reinforce(policy, trials, discount));
