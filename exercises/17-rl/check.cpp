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
    const auto shown = check.show([&] { return tableSeen("R", got.R, wanted.R); });
    check.near("R", got.R, wanted.R, 1e-9);
  }
  for (std::size_t a = 0; a < wanted.P.size(); ++a) {
    const Eigen::MatrixXd &P = wanted.P[a], &mine = got.P[a];
    const std::string property = fmt::format("P of action {}", a);
    check.shape(property, mine, states, states);
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
  const auto shown = check.show([&] { return tableSeen("Q of plannedValues", got, wanted); });
  check.near("Q of plannedValues", got, wanted, 1.1e-6);
}

void plansSmall(Check& check, Student& student) {
  plans(check, student, 3, .5);
  plans(check, student, 5, .95);
}

// Asks for the time alone; that of a wrong plan does not count.
void plansMany(Check& check, Student& student) {
  constexpr int kStates = 200;
  constexpr double kDiscount = .99;
  const LearnedWorld model = modelOf(randomSteps(kStates, 2, 5 * kStates, check.rng()), kStates, 2);
  check.input("a model of 200 states", {{"discount", kDiscount}});
  const Eigen::MatrixXd got = student.plannedValues(model, kDiscount);
  check.shape("Q of plannedValues", got, kStates, 2);
  if ((got - exactValues(model, kDiscount)).cwiseAbs().maxCoeff() < 1.1e-6)
    check.recordTime("time of a plan in a model of 200 states");
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
  const auto shown = check.show([&] { return tableSeen("Policy of the clone", got, wanted); });
  check.near("policy of the clone", got, wanted, 1e-9);
}

void checkMistakes(Check& check, Student& student, int states, int actions, int steps) {
  rex::Rng& rng = check.rng();
  const FeatureWorld world = randomWorld(states, actions, 1, 0, rng);
  const Eigen::MatrixXd policy = randomPolicy(states, actions, rng);
  const std::vector<int> teacher = randomTeacher(states, actions, rng);
  Eigen::VectorXd wrong = Eigen::VectorXd::Ones(states);
  for (Eigen::Index s = 0; s < states; ++s) wrong[s] -= policy(s, teacher[static_cast<std::size_t>(s)]);
  check.input("a clone and a teacher", {{"P, action by action", stackedOf({world.P, policy, {}})},
                                        {"start", world.start},
                                        {"policy", policy},
                                        {"teacher", numbersOf(teacher)},
                                        {"steps", steps}});
  // Backwards: what a state now means for a mistake t steps later.
  const Eigen::MatrixXd next = nextUnder(world.P, policy);
  Eigen::VectorXd wanted(steps);
  for (int t = 0; t < steps; ++t, wrong = (next * wrong).eval()) wanted[t] = world.start.dot(wrong);
  check.near("chances of mistakes", student.mistakeChances(world.P, world.start, policy, teacher, steps),
             wanted, 1e-9);
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
  std::vector<Lesson> learnt = lessons;
  Eigen::MatrixXd before = cloneOf(lessons, states, actions);
  for (std::size_t r = 0; r < acted.size(); ++r) {
    const bool isLast = r + 1 == acted.size();
    const Eigen::MatrixXd wanted = cloneOf(learnt, states, actions);
    const std::string property =
        isLast ? "policy of aggregated" : fmt::format("policy that acts in round {}", r + 1);
    check.shape(property, acted[r], states, actions);
    // With it, the answer of aggregated may be right.
    const auto again = check.ask("Does the clone of the round before act again?",
                                 !isLast && (acted[r] - before).isZero(1e-9));
    const auto shown = check.show([&] { return tableSeen(property, acted[r], wanted); });
    check.near(property, acted[r], wanted, 1e-9);
    if (isLast) break;
    before = wanted;
    for (const int s : visits[r]) learnt.push_back({s, taught(s)});
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
  // So does a planner that looks at rewards alone: answers do not tell both mistakes apart.
  const auto first = check.ask("Is it always the first action?", got.col(0).minCoeff() == 1);
  check.near("values of the states under bestPolicy", worthOf(world, w, got), bestWorth(world, w), 1e-4);
}

void checkShare(Check& check, Student& student, const Eigen::VectorXd& teacher, const Eigen::VectorXd& mixed,
                const Eigen::VectorXd& candidate) {
  check.input("three points", {{"teacher", teacher}, {"mixed", mixed}, {"candidate", candidate}});
  const double got = student.nearestShare(teacher, mixed, candidate);
  const Eigen::VectorXd step = candidate - mixed;
  const double free = step.dot(teacher - mixed) / std::max(1e-300, step.squaredNorm());
  check.near("nearest share", got, std::clamp(free, 0., 1.), 1e-9);
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
  Eigen::VectorXd mixed, w = Eigen::VectorXd::Zero(teacher.size()), shares = Eigen::VectorXd::Zero(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::MatrixXd& policy = got.policies[static_cast<std::size_t>(i)];
    const std::string name = fmt::format("policy {}", i);
    isPolicy(check, name, policy, world);
    const Eigen::VectorXd candidate = featuresOf(world, policy);
    if (i == 0) {
      check.near(name, policy, uniformChoice(policy.rows(), policy.cols()), 1e-9);
      mixed = candidate;
      shares[0] = 1;
      continue;
    }
    const Eigen::VectorXd gap = teacher - mixed, way = candidate - mixed;
    check.that("the search ends where the mixture is as near as the tolerance", gap.norm() > .99 * tolerance);
    w = gap / std::max(1e-300, gap.norm());
    const double length = way.squaredNorm(),
                 share = length > 0 ? std::clamp(gap.dot(way) / length, 0., 1.) : 0;
    mixed += share * way;
    shares *= 1 - share;
    shares[i] = share;
    if (i + 1 == count) check.near("w", got.w, w, 1e-6);
    check.near(fmt::format("values of policy {} where w^T phi is paid", i), worthOf(world, w, policy),
               bestWorth(world, w), 1e-4);
  }
  if (count == 1) check.near("w without any round", got.w, w, 0);
  if (count <= rounds)
    check.atMost("distance of the mixture from the teacher, where the search ends early",
                 (teacher - mixed).norm(), 1.01 * tolerance);
  check.near("shares", got.shares, shares, 1e-6);
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
  Eigen::VectorXd wanted(m);
  for (Eigen::Index k = 0; k < m; ++k)
    wanted[k] = paid[k] / pulls[k] + std::sqrt(2 * std::log(pulls.sum()) / pulls[k]);
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
      {"plan-time", "model", "The time of a plan in a large model (no points)", 0, Group::kVisible,
       plansMany},
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
