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
  const std::vector<int> choices = student.choicesOf(worth, epsilon, kCount, check.rng());
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
  learns(check, student, false, 3, 2, 1, false);
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
      {"bounds", "bandits", "Upper confidence bounds of a few arms", 1, Group::kVisible, boundsOfThree},
      // <hidden>
      {"other-choices", "q", "Other numbers of actions", 1, Group::kHidden, otherChoices},
      {"more-steps", "q", "Q-learning from other steps", 1, Group::kHidden, moreSteps},
      {"more-episodes", "sarsa", "SARSA from other episodes", 1, Group::kHidden, moreEpisodes},
      {"unseen-map", "model", "A model and a plan on an unseen map", 1, Group::kHidden, unseenMap},
      {"more-plans", "model", "Plans in other models", 1, Group::kHidden, plansMore},
      {"more-hope", "rmax", "Optimistic plans in other models", 1, Group::kHidden, hopesMore},
      {"other-bounds", "bandits", "Upper confidence bounds of other arms", 1, Group::kHidden, otherBounds},
      // </hidden>
  };
}
