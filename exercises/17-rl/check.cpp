#include "grading/check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "grading/evidence.h"
#include "interface.h"
#include "worlds.h"

using rex::grading::Check;
using rex::grading::Evidence;
using rex::grading::Group;

namespace {

// Bars of all entries of a table, state by state, with the wanted ones as dots.
Evidence tableSeen(const std::string& title, const Eigen::MatrixXd& got, const Eigen::MatrixXd& wanted) {
  if (got.rows() != wanted.rows() || got.cols() != wanted.cols() || got.size() == 0) return {};
  std::vector<double> mine, right;
  std::size_t worst = 0;
  for (Eigen::Index s = 0; s < got.rows(); ++s)
    for (Eigen::Index a = 0; a < got.cols(); ++a) {
      mine.push_back(got(s, a));
      right.push_back(wanted(s, a));
      if (std::abs(mine.back() - right.back()) > std::abs(mine[worst] - right[worst]))
        worst = mine.size() - 1;
    }
  const rex::Series dots{.label = "wanted",
                         .y = right,
                         .style = rex::SeriesStyle::kPoints,
                         .marker = rex::Marker::kDot,
                         .size = 2,
                         .color = rex::grading::kWantedColor};
  return {.figures = {{.title = title,
                       .xLabel = "entry, row by row",
                       .yLabel = "value",
                       .series = {dots, rex::grading::wrongPoint("differs most", static_cast<double>(worst),
                                                                 mine[worst])},
                       .histograms = {{.label = "got", .heights = mine}}}}};
}

// How often each action is chosen, within six standard deviations.
void choosesAsOften(Check& check, Student& student, const Eigen::VectorXd& worth, double epsilon) {
  constexpr int kCount = 3000;
  check.input("many choices", {{"worth", worth}, {"epsilon", epsilon}});
  const std::vector<int> choices = student.choicesOf(worth, epsilon, kCount, check.split(7));
  check.near("number of choices", static_cast<double>(choices.size()), kCount, 0);
  const int m = int(worth.rows());
  Eigen::VectorXd got = Eigen::VectorXd::Zero(m);
  for (const int a : choices) {
    check.that("the action is one of 0 to m - 1", a >= 0 && a < m);
    got[a] += 1. / kCount;
  }
  const Eigen::VectorXd isBest = (worth.array() == worth.maxCoeff()).cast<double>();
  const Eigen::VectorXd greedy = isBest / isBest.sum();
  const Eigen::VectorXd wanted = (1 - epsilon) * greedy + Eigen::VectorXd::Constant(m, epsilon / m);
  const double tolerance = 6 * std::sqrt(.25 / kCount);
  const Eigen::VectorXd others = (1 - isBest.array()) / std::max(1., m - isBest.sum());
  const double rest = epsilon * (1 - isBest.sum() / m);
  const auto close = [&](const Eigen::VectorXd& mistaken) {
    return (got - mistaken).cwiseAbs().maxCoeff() < tolerance;
  };
  const auto unequal =
      check.ask("Are several actions equally good? Each of them should be chosen as often.",
                isBest.sum() > 1 && std::abs((got.array() * (1 - isBest.array())).sum() - rest) < tolerance);
  const auto excluded = check.ask("Is a random action never the best one? It may be any.",
                                  close((1 - epsilon) * greedy + epsilon * others));
  const auto swapped = check.ask("Is the best action taken with probability epsilon?",
                                 close(epsilon * greedy + Eigen::VectorXd::Constant(m, (1 - epsilon) / m)));
  const auto shown = check.show([&] { return tableSeen("How often each action is chosen", got, wanted); });
  check.near("share of each action", got, wanted, tolerance);
}

void choices(Check& check, Student& student) {
  choosesAsOften(check, student, Eigen::Vector4d(1, 3, 2, 0), .6);
  choosesAsOften(check, student, Eigen::Vector4d(2, -1, 2, 2), .2);
}

double bestOf(const Eigen::MatrixXd& Q, int s) { return Q.row(s).maxCoeff(); }

Eigen::MatrixXd learnedBy(const Eigen::MatrixXd& Q, const std::vector<Experience>& steps, double stepSize,
                          double discount, bool isSarsa) {
  Eigen::MatrixXd after(Q);
  for (std::size_t t = 0; t < steps.size(); ++t) {
    const bool isLast = t + 1 == steps.size();
    if (isSarsa && isLast && !steps[t].ended) break;
    rex::learnFrom(after, tabular(steps[t]),
                   isSarsa && !isLast ? std::optional(steps[t + 1].action) : std::nullopt, stepSize,
                   discount);
  }
  return after;
}

// Episodes that end, and episodes that do not.
void learns(Check& check, Student& student, bool isSarsa, int states, int actions, int length, bool ends) {
  rex::Rng& rng = check.rng();
  const Eigen::MatrixXd Q = roundedTable(states, actions, rng);
  const std::vector<Experience> steps = randomEpisode(states, actions, length, ends, rng);
  const double stepSize = .25 + .05 * rng.index(10), discount = .5 + .05 * rng.index(9);
  check.input(ends ? "an episode that ends" : "an episode that does not end",
              {{"Q", Q},
               {"steps (state, action, reward, next, ended)", rowsOf(steps)},
               {"stepSize", stepSize},
               {"discount", discount}});
  const Eigen::MatrixXd got = isSarsa ? student.sarsaLearned(Q, steps, stepSize, discount)
                                      : student.qLearned(Q, steps, stepSize, discount);
  const Eigen::MatrixXd wanted = learnedBy(Q, steps, stepSize, discount, isSarsa);
  const auto nothing = check.suspect("Is nothing learned?", Q);
  const auto undiscounted =
      check.suspect("Is the discount forgotten?", learnedBy(Q, steps, stepSize, 1, isSarsa));
  const auto other =
      check.suspect(isSarsa ? "Does the best next action count? SARSA takes the one that was taken."
                            : "Does the action taken next count? Q-learning takes the best.",
                    learnedBy(Q, steps, stepSize, discount, !isSarsa));
  // The last step as if it ended the episode, or did not.
  std::vector<Experience> changed = steps;
  changed.back().ended = !ends;
  const char* onEnd =
      !ends     ? "Is the last step taken as the end of the episode? It did not end."
      : isSarsa ? "Is nothing learned from the last step? It ended the episode, so nothing else is needed."
                : "Does something follow a step that ended the episode?";
  const auto end = check.suspect(onEnd, learnedBy(Q, changed, stepSize, discount, isSarsa));
  Eigen::MatrixXd stale = Q, whole = Q;
  for (std::size_t t = 0; t < steps.size(); ++t) {
    const Experience& e = steps[t];
    const bool isKnown = e.ended || !isSarsa || t + 1 < steps.size();
    if (!isKnown) continue;
    const double later = e.ended ? 0 : isSarsa ? Q(e.next, steps[t + 1].action) : bestOf(Q, e.next);
    stale(e.state, e.action) =
        (1 - stepSize) * stale(e.state, e.action) + stepSize * (e.reward + discount * later);
    const double now = e.ended ? 0 : isSarsa ? whole(e.next, steps[t + 1].action) : bestOf(whole, e.next);
    whole(e.state, e.action) = whole(e.state, e.action) + stepSize * (e.reward + discount * now);
  }
  const auto isStale =
      check.suspect("Is the next state judged by the Q of before all steps? Q changes with each.", stale);
  const auto isWhole = check.suspect("Is Q moved by the target itself? It moves towards it.", whole);
  const auto shown = check.show([&] { return tableSeen("Q after the steps", got, wanted); });
  check.shape("Q after the steps", got, states, actions);
  check.near("Q after the steps", got, wanted, 1e-9);
}

void checkQSteps(Check& check, Student& student) {
  learns(check, student, false, 3, 2, 2, false);
  learns(check, student, false, 3, 2, 6, true);
}
void learnsTaken(Check& check, Student& student) {
  learns(check, student, true, 3, 2, 2, false);
  learns(check, student, true, 3, 2, 6, true);
}

void estimates(Check& check, Student& student, int states, int actions, int count) {
  const std::vector<Experience> steps = randomSteps(states, actions, count, check.rng());
  check.input("steps", {{"steps (state, action, reward, next, ended)", rowsOf(steps)},
                        {"states", states},
                        {"actions", actions}});
  const LearnedWorld got = student.estimated(steps, states, actions),
                     wanted = modelOf(steps, states, actions);
  check.shape("visits", got.visits, states, actions);
  check.shape("R", got.R, states, actions);
  check.near("number of matrices P", static_cast<double>(got.P.size()), actions, 0);
  {
    const auto shown = check.show([&] { return tableSeen("visits", got.visits, wanted.visits); });
    check.near("visits", got.visits, wanted.visits, 0);
  }
  {
    const auto sums = check.suspect("Is it the sum of the rewards? Wanted is their mean.",
                                    wanted.R.cwiseProduct(wanted.visits));
    const auto shown = check.show([&] { return tableSeen("R", got.R, wanted.R); });
    check.near("R", got.R, wanted.R, 1e-9);
  }
  for (std::size_t a = 0; a < wanted.P.size(); ++a) {
    const Eigen::MatrixXd &P = wanted.P[a], &mine = got.P[a];
    const std::string property = fmt::format("P of action {}", a);
    check.shape(property, mine, states, states);
    Eigen::MatrixXd counts = P, normed = P;
    for (Eigen::Index s = 0; s < P.rows(); ++s) {
      counts.row(s) *= wanted.visits(s, static_cast<Eigen::Index>(a));
      if (P.row(s).sum() > 0) normed.row(s) /= P.row(s).sum();
    }
    const auto counted = check.suspect("Are these counts? Wanted are frequencies.", counts);
    const auto all =
        check.suspect("Do steps that ended not count as tries? Their rows sum to less than one.", normed);
    const auto shown = check.show([&] { return tableSeen(property, mine, P); });
    check.near(property, mine, P, 1e-9);
  }
}

void estimatesFew(Check& check, Student& student) { estimates(check, student, 2, 2, 8); }

void plans(Check& check, Student& student, int states, double discount) {
  const LearnedWorld model = modelOf(randomSteps(states, 2, 5 * states, check.rng()), states, 2);
  check.input("a model", {{"P, action by action", stackedOf(model)}, {"R", model.R}, {"discount", discount}});
  const Eigen::MatrixXd got = student.plannedValues(model, discount);
  const Eigen::MatrixXd wanted = exactValues(model, discount);
  check.shape("Q of plannedValues", got, states, 2);
  const auto early = check.ask("Does the iteration end too early?",
                               (got - wanted).cwiseAbs().maxCoeff() < .4 * wanted.cwiseAbs().maxCoeff());
  const auto reward = check.suspect("Does nothing but the reward count?", model.R);
  const auto shown = check.show([&] { return tableSeen("Q of plannedValues", got, wanted); });
  check.near("Q of plannedValues", got, wanted, 1.1e-6);
}

void plansSmall(Check& check, Student& student) {
  plans(check, student, 3, .5);
  plans(check, student, 5, .95);
}

// maxReward is at least 2, for no reward of randomSteps() exceeds that.
void checkOptimism(Check& check, Student& student, int states, double maxReward, double discount) {
  const LearnedWorld model = modelOf(randomSteps(states, 2, 6 * states, check.rng()), states, 2);
  // As many as some pair was tried, and others less often.
  std::vector<double> tries(model.visits.data(), model.visits.data() + model.visits.size());
  std::sort(tries.begin(), tries.end());
  const int known = std::max(2, static_cast<int>(tries[tries.size() * 2 / 3]));
  check.input("a model", {{"P, action by action", stackedOf(model)},
                          {"R", model.R},
                          {"visits", model.visits},
                          {"known", known},
                          {"maxReward", maxReward},
                          {"discount", discount}});
  const Eigen::MatrixXd got = student.optimisticValues(model, known, maxReward, discount);
  const Eigen::MatrixXd wanted = exactValues(hopeful(model, known, maxReward / (1 - discount)), discount);
  check.shape("Q of optimisticValues", got, states, 2);
  const auto once = check.suspect("Is maxReward paid only once? It is paid in every step for ever.",
                                  exactValues(hopeful(model, known, maxReward), discount));
  const auto never = check.suspect("Is a pair known as soon as it was tried once?",
                                   exactValues(hopeful(model, 1, maxReward / (1 - discount)), discount));
  const auto late =
      check.suspect("Is a pair known too late? `known` tries are enough.",
                    exactValues(hopeful(model, known + 1, maxReward / (1 - discount)), discount));
  Eigen::MatrixXd alone = exactValues(model, discount);
  for (int i = 0; i < states * 2; ++i)
    if (model.visits(i / 2, i % 2) < known) alone(i / 2, i % 2) = maxReward / (1 - discount);
  const auto notSpread =
      check.suspect("Do the neighbours of a pair that is not known not hope for it?", alone);
  const auto shown = check.show([&] { return tableSeen("Q of optimisticValues", got, wanted); });
  check.near("Q of optimisticValues", got, wanted, 2e-6 * std::max(1., wanted.cwiseAbs().maxCoeff()));
}

void checkSmallOptimism(Check& check, Student& student) { checkOptimism(check, student, 4, 2, .8); }

void checkCloned(Check& check, Student& student, int states, int actions, int count) {
  const std::vector<Lesson> lessons = randomLessons(states, actions, count, check.rng());
  check.input("lessons",
              {{"lessons (state, action)", rowsOf(lessons)}, {"states", states}, {"actions", actions}});
  const Eigen::MatrixXd got = student.cloned(lessons, states, actions);
  const Eigen::MatrixXd wanted = cloneOf(lessons, states, actions);
  Eigen::MatrixXd counts = Eigen::MatrixXd::Zero(states, actions), last = wanted, most = wanted;
  for (const Lesson& l : lessons) {
    ++counts(l.state, l.action);
    last.row(l.state) = Eigen::RowVectorXd::Unit(actions, l.action);
  }
  const Eigen::VectorXd tries = counts.rowwise().sum();
  Eigen::MatrixXd rest = wanted;  // in states without lessons
  for (Eigen::Index s = 0; s < states; ++s) {
    if (tries[s] == 0) continue;
    Eigen::Index a = 0;
    counts.row(s).maxCoeff(&a);
    most.row(s) = Eigen::RowVectorXd::Unit(actions, a);
    rest.row(s).setZero();
  }
  const Eigen::MatrixXd ofAll = counts / static_cast<double>(lessons.size());
  const auto smooth = (tries.array() + actions).inverse().matrix().asDiagonal();
  const char *counted = "Are these counts? Wanted are shares.",
             *together = "Is it the share of all lessons? Those of the state itself count.";
  const auto mistakes = check.suspect(
      {{counted, counts},
       {counted, counts + rest},
       {together, ofAll},
       {together, ofAll + rest},
       {"Is there no action in states without lessons? All are equally likely there.", wanted - rest},
       {"Is the most frequent action always taken? Each has its share.", most},
       {"Does only the last lesson of a state count?", last},
       {"Is one added to each count? The shares are those of the lessons alone.",
        smooth * (counts.array() + 1).matrix()}});
  const auto shown = check.show([&] { return tableSeen("Policy of the clone", got, wanted); });
  check.near("policy of the clone", got, wanted, 1e-9);
}

void checkMistakes(Check& check, Student& student, int states, int actions, int steps) {
  rex::Rng& rng = check.rng();
  const FeatureWorld world = randomWorld(states, actions, 1, 0, rng);
  const Eigen::MatrixXd policy = randomPolicy(states, actions, rng);
  const std::vector<int> teacher = randomTeacher(states, actions, rng);
  Eigen::MatrixXd rights = Eigen::MatrixXd::Zero(states, actions);
  for (Eigen::Index s = 0; s < states; ++s) rights(s, teacher[static_cast<std::size_t>(s)]) = 1;
  const Eigen::MatrixXd actsLikeTeacher = policy.cwiseProduct(rights);
  const Eigen::VectorXd wrong = (policy - actsLikeTeacher).rowwise().sum();
  check.input("a clone and a teacher", {{"P, action by action", stackedOf({world.P, policy, {}})},
                                        {"start", world.start},
                                        {"policy", policy},
                                        {"teacher", numbersOf(teacher)},
                                        {"steps", steps}});
  // Backwards: what a state now means for a chance t steps later.
  const auto chances = [&](const Eigen::MatrixXd& next, Eigen::VectorXd later) {
    Eigen::VectorXd all(steps);
    for (int t = 0; t < steps; ++t, later = (next * later).eval()) all[t] = world.start.dot(later);
    return all;
  };
  const Eigen::MatrixXd next = nextUnder(world.P, policy);
  const Eigen::VectorXd wanted = chances(next, wrong), left = chances(next, Eigen::VectorXd::Ones(states));
  Eigen::VectorXd sums = wanted;
  for (int t = 1; t < steps; ++t) sums[t] += sums[t - 1];
  const Eigen::VectorXd got = student.mistakeChances(world.P, world.start, policy, teacher, steps);
  const auto mistakes = check.suspect(
      {{"Do the states follow the teacher? The clone acts.", chances(nextUnder(world.P, rights), wrong)},
       {"Does a walk end with its first mistake? The clone goes on.",
        chances(nextUnder(world.P, actsLikeTeacher), wrong)},
       {"Are rows and columns of P exchanged?", chances(next.transpose(), wrong)},
       {"Is entry 0 the second step? It is the first.", chances(next, next * wrong)},
       {"Are these the mistakes of all steps so far? Each step has its own entry.", sums},
       {"Is it a share of the walks that go on? What has ended makes no mistake.",
        wanted.cwiseQuotient(left)},
       {"Are these the chances of the teacher's action?", left - wanted},
       {"Does a walk that has ended still make mistakes?", wanted + (1 - left.array()).matrix()}});
  check.near("chances of mistakes", got, wanted, 1e-9);
}

// The states that a clone visits are drawn beforehand, whatever it does.
void checkAggregated(Check& check, Student& student, int states, int actions, int rounds) {
  rex::Rng& rng = check.rng();
  const std::vector<Lesson> lessons = randomLessons(states, actions, 5, rng);
  const std::vector<int> teacher = randomTeacher(states, actions, rng);
  std::vector<std::vector<int>> visits;
  Eigen::MatrixXd seen(rounds, 4);
  for (int r = 0; r < rounds; ++r) {
    const int s = rng.index(states);
    visits.push_back({s, rng.index(states), s, r % 2 == 0 ? states - 1 : 0});
    for (int i = 0; i < 4; ++i) seen(r, i) = visits.back()[static_cast<std::size_t>(i)];
  }
  check.input("a teacher and lessons", {{"lessons (state, action)", rowsOf(lessons)},
                                        {"visited, round by round", seen},
                                        {"the teacher's actions", numbersOf(teacher)}});
  std::vector<Eigen::MatrixXd> acted;
  const auto visited = [&](const Eigen::MatrixXd& policy) {
    const std::size_t r = acted.size();
    if (r <= visits.size()) acted.push_back(policy);
    return r < visits.size() ? visits[r] : std::vector<int>();
  };
  const auto taught = [&](int s) { return s >= 0 && s < states ? teacher[static_cast<std::size_t>(s)] : 0; };
  const Eigen::MatrixXd got = student.aggregated(lessons, states, actions, rounds, visited, taught);
  check.near("rounds in which a clone acts", static_cast<double>(acted.size()), rounds, 0);
  acted.push_back(got);
  std::vector<Lesson> all = lessons, latest = lessons, alone, once = lessons, own = lessons;
  Eigen::MatrixXd before = cloneOf(lessons, states, actions);
  for (std::size_t r = 0; r < acted.size(); ++r) {
    const bool isLast = r + 1 == acted.size();
    const Eigen::MatrixXd wanted = cloneOf(all, states, actions);
    const auto mistakes = check.suspect(
        {{isLast ? "Is it the clone that acted last? It has not had the lessons of that round."
                 : "Does the clone of the round before act again?",
          before},
         {"Do only the lessons of the last round count? All do.", cloneOf(latest, states, actions)},
         {"Do the demonstrations not count?", cloneOf(alone, states, actions)},
         {"Are the lessons of the rounds never used?", cloneOf(lessons, states, actions)},
         {"Does each state count once in a round? Each visit is a lesson.", cloneOf(once, states, actions)},
         {"Does the clone learn from its own actions? It is the teacher who says what to do.",
          cloneOf(own, states, actions)}});
    const std::string property =
        isLast ? "policy of aggregated" : fmt::format("policy that acts in round {}", r + 1);
    const auto shown = check.show([&] { return tableSeen(property, acted[r], wanted); });
    check.near(property, acted[r], wanted, 1e-9);
    if (isLast) break;
    before = wanted;
    latest.clear();
    for (const int s : visits[r]) {
      Eigen::Index likeliest = 0;
      cloneOf(own, states, actions).row(s).maxCoeff(&likeliest);
      own.push_back({s, static_cast<int>(likeliest)});
      latest.push_back({s, taught(s)});
      const bool isNew =
          std::none_of(latest.begin(), latest.end() - 1, [&](const Lesson& l) { return l.state == s; });
      if (isNew) once.push_back(latest.back());
    }
    all.insert(all.end(), latest.begin(), latest.end());
    alone.insert(alone.end(), latest.begin(), latest.end());
  }
}

void checkClone(Check& check, Student& student) {
  checkCloned(check, student, 4, 3, 7);
  checkMistakes(check, student, 3, 2, 4);
}
void checkAggregation(Check& check, Student& student) { checkAggregated(check, student, 4, 2, 2); }

void inputWorld(Check& check, const std::string& text, const FeatureWorld& world,
                const rex::grading::InputValue& more) {
  check.input(text, {{"P, action by action",
                      stackedOf({world.P, paidBy(world, Eigen::VectorXd::Zero(world.features.rows())), {}})},
                     {"start", world.start},
                     {"features", world.features},
                     {"discount", world.discount},
                     more});
}

void isPolicy(Check& check, const std::string& name, const Eigen::MatrixXd& policy,
              const FeatureWorld& world) {
  check.shape(name, policy, world.features.cols(), static_cast<Eigen::Index>(world.P.size()));
  const auto values = check.ask("Are these values of actions? A policy has their probabilities.");
  check.atLeast("smallest probability of " + name, policy.minCoeff(), 0);
  check.near("sums of the rows of " + name, policy.rowwise().sum(), Eigen::VectorXd::Ones(policy.rows()),
             1e-10);
}

void checkFeatures(Check& check, Student& student, int states, int actions, int features, double discount) {
  rex::Rng& rng = check.rng();
  const FeatureWorld world = randomWorld(states, actions, features, discount, rng);
  const Eigen::MatrixXd policy = randomPolicy(states, actions, rng);
  inputWorld(check, "a policy in a world", world, {"policy", policy});
  const Eigen::VectorXd got = student.expectedFeatures(world, policy), wanted = featuresOf(world, policy);
  const Eigen::VectorXd first = world.features * world.start;
  const auto visited = [&](const Eigen::MatrixXd& next) -> Eigen::VectorXd {
    const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(states, states) - next;
    return world.features * rex::solveMatrix(rest, world.start);
  };
  const Eigen::MatrixXd next = nextUnder(world.P, policy);
  const auto mistakes =
      check.suspect({{"Are rows and columns of P exchanged? It is a row that says where a state leads.",
                      visited(discount * next)},
                     {"Do the features of the first state not count?", wanted - first},
                     {"Do the features of the first state count with the discount?", discount * wanted},
                     {"Does only the first state count?", first},
                     {"Is the discount forgotten?", visited(next.transpose())},
                     {"Is it a mean over the steps? Wanted is the sum.", (1 - discount) * wanted},
                     {"Do all actions count alike? The policy draws them.",
                      featuresOf(world, uniformChoice(states, actions))}});
  check.shape("expected features", got, features, 1);
  const auto early = check.ask("Does the sum end too early?", (got - wanted).norm() < .1 * wanted.norm());
  check.near("expected features", got, wanted, 1e-8);
}

void checkBest(Check& check, Student& student, int states, int actions, int features, double discount) {
  rex::Rng& rng = check.rng();
  const FeatureWorld world = randomWorld(states, actions, features, discount, rng);
  Eigen::VectorXd w(features);
  for (double& number : w) number = .1 * (rng.index(19) - 9) + .05;
  inputWorld(check, "a world and weights", world, {"w", w});
  const Eigen::MatrixXd got = student.bestPolicy(world, w);
  isPolicy(check, "bestPolicy", got, world);
  const Eigen::MatrixXd Q = exactValues({world.P, paidBy(world, w), {}}, discount);
  Eigen::MatrixXd greedy = Eigen::MatrixXd::Zero(states, actions), first = greedy, worst = greedy;
  first.col(0).setOnes();
  for (Eigen::Index s = 0; s < states; ++s) {
    Eigen::VectorXd soon(actions);
    for (int a = 0; a < actions; ++a)
      soon[a] = world.P[static_cast<std::size_t>(a)].row(s) * world.features.transpose() * w;
    Eigen::Index a = 0;
    soon.maxCoeff(&a);
    greedy(s, a) = 1;
    Q.row(s).minCoeff(&a);
    worst(s, a) = 1;
  }
  check.near("values of the states under bestPolicy", worthOf(world, w, got), bestWorth(world, w), 1e-4,
             {{"Is it the worst action?", worthOf(world, w, worst)},
              {"Has w the opposite sign?", -bestWorth(world, -w)},
              {"Does only the next state count? All later ones do, too.", worthOf(world, w, greedy)},
              {"Is it always the first action?", worthOf(world, w, first)},
              {"Are all actions equally likely?", worthOf(world, w, uniformChoice(states, actions))}});
}

void checkShare(Check& check, Student& student, const Eigen::VectorXd& teacher, const Eigen::VectorXd& mixed,
                const Eigen::VectorXd& candidate) {
  check.input("three points", {{"teacher", teacher}, {"mixed", mixed}, {"candidate", candidate}});
  const double got = student.nearestShare(teacher, mixed, candidate);
  const Eigen::VectorXd way = candidate - mixed, gap = teacher - mixed;
  const double length = std::max(1e-300, way.norm()), free = gap.dot(way) / (length * length),
               wanted = std::min(1., std::max(0., free));
  check.near("nearest share", got, wanted, 1e-9,
             {{"May the share be less than 0 or more than 1?", free},
              {"Is it the share of the mixture so far? Wanted is that of the candidate.", 1 - wanted},
              {"Is it a length? Wanted is its share of the distance from `mixed` to `candidate`.",
               std::clamp(gap.dot(way) / length, 0., 1.)},
              {"Does only the distance to the teacher count? The direction does, too.",
               std::min(1., gap.norm() / length)},
              {"Is the teacher projected from the origin? The line begins at `mixed`.",
               std::clamp(teacher.dot(candidate) / std::max(1e-300, candidate.squaredNorm()), 0., 1.)}});
}

// Follows the search along the policies of the answer: any best policy will do.
void explains(Check& check, Student& student, const FeatureWorld& world, const Eigen::VectorXd& teacher,
              int rounds, double tolerance) {
  inputWorld(check, fmt::format("a world and a teacher; rounds = {}, tolerance = {:g}", rounds, tolerance),
             world, {"teacher", teacher});
  const Explanation got = student.explained(world, teacher, rounds, tolerance);
  const auto count = static_cast<Eigen::Index>(got.policies.size());
  check.that("the first policy is there, and at most one more for each round",
             count >= 1 && count <= rounds + 1);
  check.shape("shares", got.shares, count, 1);
  check.shape("w", got.w, teacher.size(), 1);
  const auto unit = [](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    return v / std::max(1e-300, v.norm());
  };
  Eigen::VectorXd mixed, last, first, w = Eigen::VectorXd::Zero(teacher.size());
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(count), kept = shares;
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::MatrixXd& policy = got.policies[static_cast<std::size_t>(i)];
    const std::string name = fmt::format("policy {}", i);
    isPolicy(check, name, policy, world);
    const Eigen::VectorXd candidate = featuresOf(world, policy);
    if (i == 0) {
      const auto other = check.ask("Is the policy left out with which the search begins?");
      check.near(name, policy, uniformChoice(policy.rows(), policy.cols()), 1e-9);
      mixed = last = candidate;
      shares[0] = kept[0] = 1;
      continue;
    }
    const Eigen::VectorXd gap = teacher - mixed, way = candidate - mixed;
    check.that("the search ends where the mixture is as near as the tolerance", gap.norm() > .99 * tolerance);
    w = unit(gap);
    if (i == 1) first = w;
    const double length = way.squaredNorm(),
                 share = length > 0 ? std::clamp(gap.dot(way) / length, 0., 1.) : 0;
    mixed += share * way;
    shares *= 1 - share;
    shares[i] = kept[i] = share;
    if (i + 1 == count)
      check.near(
          "w", got.w, w, 1e-6,
          {{"Has w not the length 1?", gap},
           {"Does w point from the teacher to the mixture?", -w},
           {"Is w the teacher's <phi>? It is what that has more than the mixture.", unit(teacher)},
           {"Is the teacher compared with the last policy alone? The mixture counts.", unit(teacher - last)},
           {"Is it the w of the round to come? Wanted is that of the last policy.", unit(teacher - mixed)}});
    const auto isBest = [&](const Eigen::VectorXd& other) {
      return i > 1 && (worthOf(world, other, policy) - bestWorth(world, other)).cwiseAbs().maxCoeff() < 1e-4;
    };
    const auto same = check.ask("Is w the same in each round?", isBest(first));
    const auto alone = check.ask("Is the teacher compared with the last policy alone? The mixture counts.",
                                 isBest(teacher - last));
    check.near(fmt::format("values of policy {} where w^T phi is paid", i), worthOf(world, w, policy),
               bestWorth(world, w), 1e-4);
    last = candidate;
  }
  if (count == 1) check.near("w without any round", got.w, w, 0);
  if (count <= rounds)
    check.atMost("distance of the mixture from the teacher, where the search ends early",
                 (teacher - mixed).norm(), 1.01 * tolerance);
  check.near("shares", got.shares, shares, 1e-6,
             {{"Do the shares of the others not shrink?", kept},
              {"Have all policies the same share?",
               Eigen::VectorXd::Constant(count, 1. / static_cast<double>(count))},
              {"Has the last policy all of the mixture?", Eigen::VectorXd::Unit(count, count - 1)},
              {"Do both have each other's share?", shares.reverse()}});
}

void checkWishes(Check& check, Student& student) {
  checkFeatures(check, student, 3, 2, 2, .8);
  checkBest(check, student, 4, 2, 2, .8);
}

// The teacher has hidden wishes, or none.
void explainsTeacher(Check& check, Student& student, int states, int features, int rounds) {
  const FeatureWorld world = randomWorld(states, 2, features, .7, check.rng());
  explains(check, student, world, featuresOf(world, randomPolicy(states, 2, check.rng())), rounds, 1e-3);
}

void checkExplained(Check& check, Student& student) {
  const Eigen::Vector2d mixed(1, 1), candidate(4, 5);
  checkShare(check, student, Eigen::Vector2d(3, 1.5), mixed, candidate);
  checkShare(check, student, Eigen::Vector2d(9, 7), mixed, candidate);
  checkShare(check, student, Eigen::Vector2d(0, -2), mixed, candidate);
  checkShare(check, student, Eigen::Vector2d(3, 2), mixed, mixed);
  explainsTeacher(check, student, 3, 2, 1);
  explainsTeacher(check, student, 4, 3, 4);
}

void bounds(Check& check, Student& student, const Eigen::VectorXi& pulls, const Eigen::VectorXd& paid) {
  check.input("arms", {{"pulls", Eigen::VectorXd(pulls.cast<double>())}, {"paid", paid}});
  const Eigen::VectorXd got = student.upperBounds(pulls, paid);
  const Eigen::Index m = pulls.size();
  check.shape("upper bounds", got, m, 1);
  // Bounds of which the margin is the root of `numerator` / pulls, above the mean, or above the sum.
  const auto boundsBy = [&](const Eigen::VectorXd& numerators, double sign = 1) {
    Eigen::VectorXd b(m);
    for (Eigen::Index k = 0; k < m; ++k)
      b[k] = paid[k] / pulls[k] + sign * std::sqrt(numerators[k] / pulls[k]);
    return b;
  };
  const double n = pulls.sum();
  const auto same = [&](double number) -> Eigen::VectorXd { return Eigen::VectorXd::Constant(m, number); };
  const Eigen::VectorXd own = pulls.cast<double>().array().log();
  const Eigen::VectorXd wanted = boundsBy(same(2 * std::log(n))), means = boundsBy(same(0));
  const auto ownPulls =
      check.suspect("Is n the number of pulls of the arm itself? It is that of all arms.", boundsBy(2 * own));
  const auto armCount = check.suspect("Is n the number of arms? It is that of all pulls.",
                                      boundsBy(same(2 * std::log(static_cast<double>(m)))));
  const auto half = check.suspect("Is the power of n forgotten? Hoeffding's inequality should allow n^-4.",
                                  boundsBy(same(std::log(n) / 2)));
  const auto below = check.suspect("Is it the lower bound?", boundsBy(same(2 * std::log(n)), -1));
  const auto sums = check.suspect("Is the margin added to the sum of what was paid? It belongs to the mean.",
                                  wanted - means + paid);
  const auto noMargin = check.suspect("Is there no margin?", means);
  const auto shown = check.show([&] { return tableSeen("Upper bounds", got, wanted); });
  check.near("upper bounds", got, wanted, 1e-9);
}

void boundsOfThree(Check& check, Student& student) {
  bounds(check, student, Eigen::Vector3i(10, 4, 2), Eigen::Vector3d(6, 1, 1));
  bounds(check, student, Eigen::Vector2i(1, 30), Eigen::Vector2d(0, 12.5));
}

// <hidden>
void otherBounds(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) {
    rex::Rng& rng = check.rng();
    const int m = 2 + i;
    Eigen::VectorXi pulls(m);
    Eigen::VectorXd paid(m);
    for (int k = 0; k < m; ++k) {
      pulls[k] = 1 + rng.index(k % 2 == 0 ? 5 : 2000);
      paid[k] = .01 * rng.index(100 * pulls[k] + 1);
    }
    bounds(check, student, pulls, paid);
  });
}

void otherChoices(Check& check, Student& student) {
  choosesAsOften(check, student, Eigen::Vector2d(-3, -2), 1);
  choosesAsOften(check, student, Eigen::VectorXd::Zero(5), 0);
  choosesAsOften(check, student, Eigen::Vector3d(-1, -7, -1), .5);
}

void moreSteps(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) { learns(check, student, false, 2 + i, 1 + i % 4, 20 + i, i % 2 == 0); });
}

void moreEpisodes(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) { learns(check, student, true, 2 + i, 2 + i % 3, 20 + i, i % 2 == 0); });
}

// From random steps on a map that nobody saw to the best way, by estimate and plan.
void unseenMap(Check& check, Student& student) {
  estimates(check, student, 7, 3, 60);
  const rex::GridWorld world = hiddenMap();
  const std::vector<Experience> steps = wander(world, 6000, check.rng());
  const int n = world.mdp.states();
  const Eigen::MatrixXd Q = student.plannedValues(student.estimated(steps, n, 4), .95);
  check.near("Q of the estimated model of a map", Q, exactValues(modelOf(steps, n, 4), .95), 1.1e-6);
}

void plansMore(Check& check, Student& student) {
  check.forEachCase(5, [&](int i) { plans(check, student, 2 + 3 * i, .2 * i); });
}

void hopesMore(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) { checkOptimism(check, student, 2 + 2 * i, 2 + i, .15 * (i + 1)); });
}
void otherClones(Check& check, Student& student) {
  check.forEachCase(5, [&](int i) {
    checkCloned(check, student, 2 + i, 2 + i % 3, 8 + 5 * i);
    checkMistakes(check, student, 2 + i, 2 + i % 3, 1 + 4 * i);
    checkAggregated(check, student, 2 + i, 2 + i % 3, i);
  });
}

void otherTeachers(Check& check, Student& student) {
  check.forEachCase(5, [&](int i) {
    rex::Rng& rng = check.rng();
    checkFeatures(check, student, 2 + 2 * i, 1 + i, 1 + i, .2 * i);
    checkBest(check, student, 3 + i, 2 + i % 2, 2 + i, .2 * i);
    checkShare(check, student, rng.uniformVector(2 + i, -1, 1), rng.uniformVector(2 + i, -1, 1),
               rng.uniformVector(2 + i, -1, 1));
    explainsTeacher(check, student, 3 + i, 2 + i, 2 * i);
    // A teacher without wishes.
    const FeatureWorld world = randomWorld(4, 2, 3, .5, rng);
    explains(check, student, world, featuresOf(world, uniformChoice(4, 2)), 3, 1e-3);
  });
}
// </hidden>

}  // namespace

rex::grading::Checks<Student> checks() {
  return {
      {"choices", "q", "Epsilon-greedy actions", 1, Group::kVisible, choices},
      {"q-steps", "q", "Q-learning from a few steps", 1, Group::kVisible, checkQSteps},
      {"sarsa-steps", "sarsa", "SARSA from a few steps", 1, Group::kVisible, learnsTaken},
      {"estimate", "model", "The model of a few steps", 1, Group::kVisible, estimatesFew},
      {"plan", "model", "A plan in a model", 1, Group::kVisible, plansSmall},
      {"hope", "rmax", "An optimistic plan", 1, Group::kVisible, checkSmallOptimism},
      {"clone", "imitation", "A clone, and its mistakes", 1, Group::kVisible, checkClone},
      {"aggregate", "imitation", "Aggregation in two rounds", 1, Group::kVisible, checkAggregation},
      {"wishes", "inverse", "Expected features, and a policy for weights", 1, Group::kVisible, checkWishes},
      {"explain", "inverse", "The search for weights", 1, Group::kVisible, checkExplained},
      {"bounds", "bandits", "Upper confidence bounds of a few arms", 1, Group::kVisible, boundsOfThree},
      // <hidden>
      {"other-choices", "q", "Other numbers of actions", 1, Group::kHidden, otherChoices},
      {"more-steps", "q", "Q-learning from other steps", 1, Group::kHidden, moreSteps},
      {"more-episodes", "sarsa", "SARSA from other episodes", 1, Group::kHidden, moreEpisodes},
      {"unseen-map", "model", "A model and a plan on an unseen map", 1, Group::kHidden, unseenMap},
      {"more-plans", "model", "Plans in other models", 1, Group::kHidden, plansMore},
      {"more-hope", "rmax", "Optimistic plans in other models", 1, Group::kHidden, hopesMore},
      {"other-clones", "imitation", "Other lessons, clones and teachers", 1, Group::kHidden, otherClones},
      {"other-teachers", "inverse", "Other worlds and teachers", 1, Group::kHidden, otherTeachers},
      {"other-bounds", "bandits", "Upper confidence bounds of other arms", 1, Group::kHidden, otherBounds},
      // </hidden>
  };
}
