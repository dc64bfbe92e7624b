#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "process_checks.h"

// Parts 3 and 4: value iteration and policy iteration.

inline Eigen::VectorXd bestOf(const Eigen::MatrixXd& Q) { return Q.rowwise().maxCoeff(); }

/// A bound on the error of the second of two successive values.
inline double boundOf(const Process& process, const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
  return process.discount / (1 - process.discount) * distance(before, after);
}

/// The bounds on the errors of V_1, V_2, ..., with the bound that only the last should reach, and a ring
/// around the one in question.
inline rex::grading::Evidence settlingSeen(const Process& process, const std::vector<Eigen::VectorXd>& V,
                                           double tolerance, std::size_t here) {
  rex::Series bounds = rex::grading::gotCurve("got: bound of V_k");
  bounds.style = rex::SeriesStyle::kLinesPoints;
  bounds.marker = rex::Marker::kDot;
  const double lowest = tolerance / 100;  // what is below, such as zero, has no logarithm
  for (std::size_t k = 1; k < V.size(); ++k)
    bounds.add(static_cast<double>(k), std::max(lowest, boundOf(process, V[k - 1], V[k])));
  const double most = *std::max_element(bounds.y.begin(), bounds.y.end());
  rex::Figure figure{.title = "Value iteration until it ends",
                     .xLabel = "k",
                     .yLabel = "discount / (1 - discount) * largest change",
                     .logY = true,
                     .yRange = rex::AxisRange(lowest / 2, 2 * std::max(most, tolerance)),
                     .series = {bounds, rex::grading::wrongPoint("in question", static_cast<double>(here),
                                                                 bounds.y[here - 1])}};
  figure.horizontalLines = {{.at = tolerance, .label = "tolerance: only the last is at most this"}};
  return {.figures = {figure}};
}

/// What a mistake makes of V_k, computed from V_(k-1).
inline std::vector<Mistake> mistakenStep(const Process& process, const Eigen::VectorXd& before) {
  rex::Mdp mdp = mdpOf(process);
  const Eigen::MatrixXd Q = rex::actionValues(mdp, before);
  Eigen::VectorXd inPlace = before;
  for (Eigen::Index s = 0; s < before.size(); ++s) inPlace[s] = bestOf(rex::actionValues(mdp, inPlace))[s];
  Eigen::VectorXd mean(Q.rows()), worst(Q.rows()), rewards(Q.rows());
  for (Eigen::Index s = 0; s < Q.rows(); ++s) {
    mean[s] = Q.row(s).mean();
    worst[s] = Q.row(s).minCoeff();
    rewards[s] = process.R.row(s).maxCoeff();
  }
  mdp.discount = 1;
  return {{"Are values of this iteration used for other states of it? All come from the V before.", inPlace},
          {"Is the mean over the actions taken? Eq. (10) takes the best one.", mean},
          {"Is the worst action taken?", worst},
          {"Is only action 0 taken?", Q.col(0)},
          {"Is the discount forgotten?", bestOf(rex::actionValues(mdp, before))},
          {"Does nothing but the reward count?", rewards}};
}

/// The values until the bound is at most the tolerance, and what else could have ended the iteration with
/// V_k.
inline const char* whyEndedWith(std::size_t last, const Process& process, double tolerance) {
  const rex::Mdp mdp = mdpOf(process);
  struct Rule {
    const char* question;
    double factor;
    std::size_t end = 0;
  };
  const double discount = process.discount;
  std::vector<Rule> rules{
      {"", discount / (1 - discount)},
      {"Does a small change end the iteration? The error may be larger: discount / (1 - discount) times the "
       "change.",
       1},
      {"Does discount * change end the iteration? The bound is discount / (1 - discount) times the change.",
       discount},
      {"Is the bound 1 / (1 - discount) times the change? It is discount / (1 - discount) times that.",
       1 / (1 - discount)}};
  Eigen::VectorXd V = Eigen::VectorXd::Zero(process.R.rows());
  for (std::size_t k = 1; rules[0].end == 0 || rules[3].end == 0; ++k) {
    const Eigen::VectorXd next = bestOf(rex::actionValues(mdp, V));
    for (Rule& rule : rules)
      if (rule.end == 0 && rule.factor * distance(next, V) <= tolerance) rule.end = k;
    V = next;
  }
  if (last + 1 == rules[0].end) return "Is the last V left out, the first with a bound below the tolerance?";
  if (last == rules[0].end + 1) return "Is one V too many computed after the bound was below the tolerance?";
  for (std::size_t i = 1; i < rules.size(); ++i)
    if (last == rules[i].end) return rules[i].question;
  for (const std::size_t round : {10, 20, 50, 100, 200, 500, 1000, 10000})
    if (last == round || last + 1 == round) return "Is the number of iterations fixed?";
  return "";
}

inline void valuesSettle(rex::grading::Check& check, Student& student, const Process& process,
                         double tolerance) {
  check.input(described(process), {{"P, action by action", stacked(process)},
                                   {"R", process.R},
                                   {"discount", process.discount},
                                   {"tolerance", tolerance}});
  const std::vector<Eigen::VectorXd> V = student.iterateValues(process, tolerance);
  const rex::Mdp mdp = mdpOf(process);
  check.atLeast("number of V_0, V_1, ... that iterateValues returns", static_cast<double>(V.size()), 2);
  const double rounding = 1e-11 * scaleOf(process);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(process.R.rows());
  {
    const Eigen::VectorXd first = bestOf(rex::actionValues(mdp, zero));
    const auto shown = check.show([&] { return barsSeen("V_0 of iterateValues", "state", V.front(), zero); });
    check.near("V_0 of iterateValues", V.front(), zero, 0,
               {{"Is V_0, which is zero, missing at the beginning of the list?",
                 distance(V.front(), first) <= rounding ? V.front() : zero}});
  }
  for (std::size_t k = 1; k < V.size(); ++k) {
    const Eigen::VectorXd &before = V[k - 1], wanted = bestOf(rex::actionValues(mdp, before));
    check.input(described(process), {{"P, action by action", stacked(process)},
                                     {"R", process.R},
                                     {"discount", process.discount},
                                     {fmt::format("V_{}", k - 1), before}});
    const std::string property = fmt::format("V_{} of iterateValues, from your V_{}", k, k - 1);
    check.shape(property, V[k], wanted.size(), 1);
    const auto shown = check.show([&] { return barsSeen(property, "state", V[k], wanted); });
    const bool isRight = distance(V[k], wanted) <= rounding;
    check.near(property, V[k], wanted, rounding,
               isRight ? std::vector<Mistake>() : mistakenStep(process, before));
  }
  const std::size_t last = V.size() - 1;
  const auto asked = check.ask(whyEndedWith(last, process, tolerance));
  const std::string bound = "discount / (1 - discount) * largest change from V_{} to V_{}";
  for (std::size_t k : {last, last - 1}) {
    if (k == 0) return;
    check.input(described(process), {{"discount", process.discount},
                                     {"tolerance", tolerance},
                                     {fmt::format("V_{}", k - 1), V[k - 1]},
                                     {fmt::format("V_{}", k), V[k]}});
    const auto shown = check.show([&] { return settlingSeen(process, V, tolerance, k); });
    const double got = boundOf(process, V[k - 1], V[k]);
    if (k == last)
      check.atMost(fmt::format(fmt::runtime(bound + ", the last of iterateValues"), k - 1, k), got,
                   tolerance * (1 + 1e-6));
    else
      check.atLeast(fmt::format(fmt::runtime(bound + ", before the last of iterateValues"), k - 1, k), got,
                    tolerance * (1 - 1e-6));
  }
}

inline Eigen::VectorXd numbersOf(const std::vector<int>& actions) {
  Eigen::VectorXd numbers(static_cast<Eigen::Index>(actions.size()));
  std::copy(actions.begin(), actions.end(), numbers.begin());
  return numbers;
}

/// The entry of each row that an action has.
inline Eigen::VectorXd worthOf(const Eigen::MatrixXd& Q, const std::vector<int>& actions) {
  Eigen::VectorXd worth(Q.rows());
  for (Eigen::Index s = 0; s < Q.rows(); ++s) worth[s] = Q(s, actions[static_cast<std::size_t>(s)]);
  return worth;
}

/// A small process whose first policy takes two improvements at least.
inline Process improvableProcess(rex::Rng& rng) {
  for (;;) {
    Process process = randomProcess(rng, 4, 2, .9);
    const rex::Mdp mdp = mdpOf(process);
    std::vector<int> actions(4, 0);
    for (int i = 0; i < 2; ++i) {
      const Eigen::VectorXd V = rex::policyValues(mdp, rex::deterministicPolicy(mdp, actions)).V;
      const std::vector<int> better = rex::greedyActions(rex::actionValues(mdp, V));
      if (better == actions) break;
      if (i == 1) return process;
      actions = better;
    }
  }
}

/// What to ask about policy i, which is not best by the values of the one before.
inline const char* whyNotBest(const Process& process, const Eigen::MatrixXd& Q,
                              const std::vector<std::vector<int>>& policies, std::size_t i) {
  const Eigen::VectorXd worth = worthOf(Q, policies[i]);
  if (i == 1 && policies[1] == rex::greedyActions(process.R))
    return "Does nothing but the reward of the first step count?";
  if (distance(worth, -bestOf(-Q)) == 0) return "Is the worst action taken?";
  int changed = 0;
  for (std::size_t s = 0; s < policies[i].size(); ++s) changed += policies[i][s] != policies[i - 1][s];
  return changed == 1 ? "Is only one state improved? All take their best action at once." : "";
}

/// Policy i, by the values of the one before, in each state.
inline void policyIsBest(rex::grading::Check& check, const Process& process,
                         const std::vector<std::vector<int>>& policies, std::size_t i,
                         const Eigen::VectorXd& V) {
  const Eigen::MatrixXd Q = rex::actionValues(mdpOf(process), V);
  const Eigen::VectorXd got = worthOf(Q, policies[i]), wanted = bestOf(Q);
  const auto shown = check.show([&] {
    return barsSeen(
        fmt::format("What the actions of policy {} are worth by the values of policy {}", i, i - 1), "state",
        got, wanted);
  });
  const auto asked = check.ask(whyNotBest(process, Q, policies, i));
  for (Eigen::Index s = 0; s < got.size(); ++s) {
    check.input(described(process), {{"P, action by action", stacked(process)},
                                     {"R", process.R},
                                     {"discount", process.discount},
                                     {fmt::format("policy {}", i - 1), numbersOf(policies[i - 1])},
                                     {"its V", V},
                                     {fmt::format("policy {}", i), numbersOf(policies[i])}});
    check.near(
        fmt::format("worth of the action of policy {} of iteratePolicies in state {}, by the values of "
                    "policy {}",
                    i, s, i - 1),
        got[s], wanted[s], 1e-8 * scaleOf(process));
  }
}

/// Sizes and actions of all policies.
inline void policiesMakeSense(rex::grading::Check& check, const Process& process,
                              const std::vector<std::vector<int>>& policies) {
  const Eigen::Index m = process.R.cols();
  check.atLeast("number of policies of iteratePolicies", static_cast<double>(policies.size()), 1);
  for (std::size_t i = 0; i < policies.size(); ++i) {
    const Eigen::VectorXd actions = numbersOf(policies[i]);
    const std::string name = fmt::format("action of policy {} of iteratePolicies", i);
    check.shape(fmt::format("actions of policy {} of iteratePolicies", i), actions, process.R.rows(), 1);
    check.atLeast("smallest " + name, actions.minCoeff(), 0);
    check.atMost("largest " + name, actions.maxCoeff(), static_cast<double>(m - 1));
  }
  check.near("actions of policy 0 of iteratePolicies", numbersOf(policies.front()),
             Eigen::VectorXd::Zero(process.R.rows()), 0);
}

/// Returns the policies.
inline std::vector<std::vector<int>> policiesImprove(rex::grading::Check& check, Student& student,
                                                     const Process& process) {
  const auto describe = [&] {
    check.input(
        described(process),
        {{"P, action by action", stacked(process)}, {"R", process.R}, {"discount", process.discount}});
  };
  describe();
  const std::vector<std::vector<int>> policies = student.iteratePolicies(process);
  policiesMakeSense(check, process, policies);
  const rex::Mdp mdp = mdpOf(process);
  Eigen::VectorXd V;
  for (std::size_t i = 0; i < policies.size(); ++i) {
    if (i > 0) {
      policyIsBest(check, process, policies, i, V);
      const auto twice = check.ask("Is the last policy listed twice?", i + 1 == policies.size());
      check.that(fmt::format("policy {} of iteratePolicies differs from policy {}", i, i - 1),
                 policies[i] != policies[i - 1]);
    }
    V = rex::policyValues(mdp, rex::deterministicPolicy(mdp, policies[i])).V;
  }
  describe();
  const Eigen::VectorXd best = rex::policyIteration(mdp).V;
  const std::string property =
      fmt::format("values of the last policy of iteratePolicies, policy {}", policies.size() - 1);
  const auto shown = check.show([&] { return barsSeen(property, "state", V, best); });
  const auto none = check.ask("Is policy 0 never improved?", policies.size() == 1);
  const auto once = check.ask("Does it end after one improvement? It goes on until no action changes.",
                              policies.size() == 2);
  const auto early = check.ask("Does it end before no action changes any more?");
  check.near(property, V, best, 1e-7 * scaleOf(process));
  return policies;
}

/// From state 0, actions 1 and 2 lead to states 1 and 2, from which every action leads to state 3. At first
/// action 2 is better; in the end both are equally good, and the action taken before must stay.
inline void tieStays(rex::grading::Check& check, Student& student) {
  Process process{std::vector<Eigen::MatrixXd>(3, Eigen::MatrixXd::Zero(4, 4)), Eigen::MatrixXd(4, 3), .5};
  for (Eigen::Index a = 0; a < 3; ++a) {
    Eigen::MatrixXd& P = process.P[static_cast<std::size_t>(a)];
    P(0, a == 0 ? 3 : a) = P(1, 3) = P(2, 3) = 1;
  }
  process.R << -1, 0, 0, 0, 1, -1, .5, 1, -1, 0, 0, 0;
  const std::vector<std::vector<int>> policies = policiesImprove(check, student, process);
  const Eigen::VectorXd got = numbersOf(policies.back()), wanted = Eigen::Vector4d(2, 1, 1, 0);
  check.input("action 1 leads from state 0 to 1, action 2 to 2, all others to 3, the end",
              {{"R", process.R}, {"discount", process.discount}});
  const auto shown = check.show([&] { return barsSeen("Actions of the last policy", "state", got, wanted); });
  const auto asked =
      check.ask("Is another action taken that is only as good? Then the one before is to be kept.");
  check.near("actions of the last policy of iteratePolicies, where some are equally good", got, wanted, 0);
  check.near("number of policies of iteratePolicies, where some actions are equally good",
             static_cast<double>(policies.size()), 2, 0);
}
