#include "show.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include "course/mdp_figures.h"
#include "learning/dynamic_programming.h"
#include "learning/inverse_rl.h"
#include "learning/mdp.h"

using namespace rex;

namespace {

// A step costs 1, a fall 100 and leads back to the start.
GridWorld cliff() {
  return gridWorld(
      "............\n............\n............\nSCCCCCCCCCCG",
      {.discount = 1,
       .stepReward = -1,
       .marks = {
           {'S', -1, false}, {'G', 0}, {.letter = 'C', .reward = -99, .isTerminal = false, .jumpTo = 'S'}}});
}

// One step, in which entering a terminal state ends the episode and pays what that state pays.
Experience stepIn(const Mdp& mdp, int s, int a, Rng& rng) {
  Experience step{s, a, mdp.rewards(s, a), sampledNext(mdp, s, a, rng), false};
  step.ended = mdp.isTerminal(step.next);
  if (step.ended) step.reward += mdp.rewards(step.next, 0);
  return step;
}

struct Learned {
  Eigen::MatrixXd Q;
  std::vector<double> returns{};
};

// Learns after each step, SARSA as soon as the next action is known.
Learned learnCliff(const GridWorld& world, bool isSarsa, double epsilon, Rng& rng) {
  Learned result{Eigen::MatrixXd::Zero(world.mdp.states(), world.mdp.actions())};
  for (int e = 0; e < 500; ++e) {
    std::vector<Experience> last;
    double sum = 0;
    int s = *world.state(0, 0);
    for (int t = 0; t < 1000 && (last.empty() || !last.back().ended); ++t) {
      const int a = chosenAction(result.Q.row(s), epsilon, rng);
      last.push_back(stepIn(world.mdp, s, a, rng));
      sum += last.back().reward;
      s = last.back().next;
      if (!isSarsa) {
        result.Q = qLearned(result.Q, {last.back()}, .5, 1);
      } else if (last.size() > 1) {
        // The step before; of this one only the action is known.
        Experience now = last.back();
        now.ended = false;
        result.Q = sarsaLearned(result.Q, {last[last.size() - 2], now}, .5, 1);
      }
    }
    if (isSarsa && last.back().ended) result.Q = sarsaLearned(result.Q, {last.back()}, .5, 1);
    result.returns.push_back(sum);
  }
  return result;
}

// From the left to the flag on the right.
GridWorld field(double slip) {
  const std::string row = "................\n", middle = "S..............G\n";
  return gridWorld(row + row + row + row + middle + row + row + row + row,
                   {.discount = .95, .slip = slip, .marks = {{'S', 0, false}, {'G', 1}}});
}

// A row for each step, until and with the last: how likely it is taken in each state.
Eigen::MatrixXd whereabouts(const std::vector<Eigen::MatrixXd>& P, Eigen::VectorXd now,
                            const Eigen::MatrixXd& policy, int steps) {
  Eigen::MatrixXd all(steps, now.size());
  const Eigen::MatrixXd onward = nextUnder(P, policy).transpose();
  for (int t = 0; t < steps; ++t, now = (onward * now).eval()) all.row(t) = now.transpose();
  return all;
}

}  // namespace

void showCliff(double epsilon) {
  const GridWorld world = cliff();
  std::vector<LearningCurves> curves;
  for (const bool isSarsa : {false, true}) {
    const char* name = isSarsa ? "SARSA" : "Q-learning";
    LearningCurves curve{name, {}};
    Learned one;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
      Rng rng(seed);
      one = learnCliff(world, isSarsa, epsilon, rng);
      if (one.Q.isZero(0)) break;
      std::vector<double> smooth;  // means of ten episodes
      for (std::size_t e = 0; e + 10 <= one.returns.size(); e += 10) {
        smooth.push_back(0);
        for (std::size_t i = e; i < e + 10; ++i) smooth.back() += one.returns[i] / 10;
      }
      curve.runs.push_back(smooth);
    }
    if (one.Q.isZero(0)) {
      nothingYet(name);
      continue;
    }
    Eigen::VectorXd V = one.Q.rowwise().maxCoeff().cwiseMax(-40);
    for (int column = 1; column < 11; ++column) V[*world.state(column, 0)] = -40;
    Figure figure = policyFigure(world, V, epsilonGreedy(one.Q, 0));
    figure.title = name;
    plot(isSarsa ? "sarsa" : "q", figure);
    curves.push_back(curve);
  }
  if (curves.empty()) return;
  Figure figure = learningFigure(curves);
  figure.title = "Walking along a cliff: 30 runs each";
  figure.xLabel = "tens of episodes";
  figure.yRange = AxisRange(-150, 0);
  plot("learning", figure);
}

void showExploration() {
  const GridWorld world = gridWorld(
      "S.........\n.########.\n.#......#.\n.#.####.#.\n.#.#G.#.#.\n...##.#.#.\n.####.#.#.\n......#...",
      {.discount = .95, .marks = {{'S', 0, false}, {'G', 1}}});
  const Mdp& mdp = world.mdp;
  Figure figure{.title = "Pairs of state and action that were tried",
                .xLabel = "steps",
                .yLabel = "pairs",
                .series = {{.label = "R-max"}, {.label = "by chance"}}};
  for (const bool isPlanned : {true, false}) {
    Rng rng(1);
    std::vector<Experience> steps;
    int s = *world.state(0, 7);
    const auto plan = [&] {
      return optimisticValues(estimated(steps, mdp.states(), mdp.actions()), 1, 1, mdp.discount);
    };
    for (int t = 0; t < 600; ++t) {
      const Eigen::MatrixXd Q = isPlanned ? plan() : Eigen::MatrixXd::Zero(mdp.states(), mdp.actions());
      if (isPlanned && Q.isZero(0)) return nothingYet("R-max");
      int a = rng.index(mdp.actions());
      if (isPlanned) Q.row(s).maxCoeff(&a);
      steps.push_back(stepIn(mdp, s, a, rng));
      s = steps.back().ended ? *world.state(0, 7) : steps.back().next;
      const double tried = (estimated(steps, mdp.states(), mdp.actions()).visits.array() > 0).count();
      figure.series[isPlanned ? 0 : 1].y.push_back(tried);
    }
  }
  plot("explored", figure);
}

void showImitation() {
  constexpr int kSteps = 40;
  const GridWorld world = field(.2);
  const Mdp& mdp = world.mdp;
  const int n = mdp.states(), home = *world.state(0, 4);
  const std::vector<int> teacher = policyIteration(mdp).actions;
  const Eigen::VectorXd start = Eigen::VectorXd::Unit(n, home);
  std::vector<Eigen::MatrixXd> P = denseTransitions(mdp);
  for (Eigen::MatrixXd& next : P) next.col(*world.state(15, 4)).setZero();  // the flag is the end
  std::vector<LearningCurves> curves;
  for (const int rounds : {0, 5, 20, 80}) {
    LearningCurves curve{std::to_string(rounds) + " rounds", {}};
    if (rounds == 0) curve.label = "one demonstration, or many";
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
      Rng rng(seed);
      std::vector<Lesson> lessons;
      const MdpEpisode shown = mdpEpisode(field(0).mdp, deterministicPolicy(mdp, teacher), home, kSteps, rng);
      for (std::size_t t = 0; t < shown.actions.size(); ++t)
        lessons.push_back({shown.states[t], shown.actions[t]});
      const auto walked = [&](const Eigen::MatrixXd& clone) {
        return mdpEpisode(mdp, clone, home, kSteps, rng).states;
      };
      const auto asked = [&](int s) { return teacher[static_cast<std::size_t>(s)]; };
      const Eigen::MatrixXd policy =
          rounds == 0 ? cloned(lessons, n, 4) : aggregated(lessons, n, 4, rounds, walked, asked);
      if (policy.isZero(0)) break;
      if (seed == 0 && (rounds == 0 || rounds == 80)) {
        Figure figure =
            policyFigure(world, whereabouts(P, start, policy, kSteps).colwise().sum().transpose(), policy);
        figure.title =
            rounds == 0 ? "A clone of one demonstration" : "The clone after 80 rounds of aggregation";
        figure.colorLabel = "visits in 40 steps";
        figure.colorRange = AxisRange(0, 1.2);
        for (Arrows& arrows : figure.arrows) arrows.color = {1, 1, 1};
        plot(rounds == 0 ? "cloned" : "aggregated", figure);
      }
      const Eigen::VectorXd chances = mistakeChances(P, start, policy, teacher, kSteps);
      curve.runs.emplace_back(chances.begin(), chances.end());
    }
    if (curve.runs.empty()) {
      nothingYet(rounds == 0 ? "clones" : "aggregation");
      break;
    }
    curves.push_back(curve);
  }
  if (curves.empty()) return;
  Figure figure = learningFigure(curves);
  figure.title = "A clone on slippery ground: 30 runs each";
  figure.xLabel = "step";
  figure.yLabel = "chance of a mistake";
  figure.yRange = AxisRange(0, .7);  // the legend is above the curves
  plot("drift", figure);
}

void showTeacher() {
  // Road, grass, water, home.
  const std::string map = "....,,,,..\n.,,.,~~,..\n.,~.,~~,.,\n.,~....,.,\n.,~~~~.,.,\n....,,...H";
  std::string cells = map;
  for (char& c : cells) c = c == '\n' ? c : '.';
  const GridWorld world = gridWorld(cells, {.slip = .1});
  Mdp mdp = world.mdp;
  const int n = mdp.states();
  FeatureWorld walk{denseTransitions(mdp), Eigen::VectorXd::Constant(n, 1. / n), Eigen::MatrixXd::Zero(4, n),
                    .9};
  for (int s = 0; s < n; ++s) {
    const auto& [column, row] = world.cells[static_cast<std::size_t>(s)];
    walk.features(static_cast<Eigen::Index>(
                      std::string_view(".,~H").find(map[static_cast<std::size_t>((5 - row) * 11 + column)])),
                  s) = 1;
  }
  const Eigen::Vector4d wishes(0, -.3, -.8, .5);
  mdp.rewards = (walk.features.transpose() * wishes).replicate(1, 4);
  const Eigen::MatrixXd acts = deterministicPolicy(mdp, policyIteration(mdp).actions);
  Rng rng(1);
  std::vector<std::vector<int>> seen;
  for (int i = 0; i < 500; ++i) seen.push_back(mdpEpisode(mdp, acts, rng.index(n), 100, rng).states);
  const Eigen::VectorXd teacher = featureExpectations(seen, walk.features, .9);
  const auto draw = [&](const char* name, const char* title, const Eigen::VectorXd& w,
                        const Eigen::MatrixXd& policy) {
    Figure figure = policyFigure(world, walk.features.transpose() * w, policy);
    figure.title = title;
    figure.colorLabel = "reward: water, grass, road, home";
    for (Arrows& arrows : figure.arrows) arrows.color = {1, 1, 1};
    figure.colorRange = AxisRange(w.minCoeff() - .1, w.maxCoeff() + .1);
    plot(name, figure);
  };
  draw("wishes", "Rewards and policy of a teacher", wishes, acts);
  Series gap{.label = "in value, by the weights of the teacher"}, distance{.label = "in <phi>"};
  Explanation found;
  for (int rounds = 0; rounds <= 20; ++rounds) {
    found = explained(walk, teacher, rounds, 0);
    if (found.policies.empty()) return nothingYet("inverse reinforcement learning");
    Eigen::VectorXd mixed = Eigen::VectorXd::Zero(4);
    for (std::size_t i = 0; i < found.policies.size(); ++i)
      mixed += found.shares[static_cast<Eigen::Index>(i)] * expectedFeatures(walk, found.policies[i]);
    gap.add(rounds, std::max(1e-3, wishes.dot(teacher - mixed)));
    distance.add(rounds, (teacher - mixed).norm());
  }
  draw("inferred", "Rewards and policy inferred from 500 walks", found.w, found.policies.back());
  plot("gap", {.title = "How far the mixture is from the teacher",
               .xLabel = "round",
               .yLabel = "difference [1]",
               .logY = true,
               .yRange = AxisRange(.05, 10),
               .series = {gap, distance}});
}

void showBandits(double epsilon) {
  const Eigen::VectorXd arms = Eigen::VectorXd::LinSpaced(5, .1, .9);
  std::vector<LearningCurves> curves;
  for (const bool isBound : {true, false}) {
    LearningCurves curve{isBound ? "upper confidence bounds" : "epsilon-greedy", {}};
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
      Rng rng(seed);
      Eigen::VectorXi pulls = Eigen::VectorXi::Zero(5);
      Eigen::VectorXd paid = Eigen::VectorXd::Zero(5);
      double regret = 0;
      std::vector<double> regrets;
      for (int n = 0; n < 10000; ++n) {
        int arm = n;  // each of them once
        if (n >= 5) {
          const Eigen::VectorXd means = paid.cwiseQuotient(pulls.cast<double>());
          const Eigen::VectorXd worth = isBound ? upperBounds(pulls, paid) : means;
          if (isBound && (worth.size() != 5 || worth.isZero(0))) return nothingYet("bandits");
          arm = std::clamp(chosenAction(worth, isBound ? 0 : epsilon, rng), 0, 4);
        }
        ++pulls[arm];
        paid[arm] += rng.uniform() < arms[arm] ? 1 : 0;
        regret += arms[4] - arms[arm];
        if (n % 100 == 99) regrets.push_back(regret);
      }
      curve.runs.push_back(regrets);
    }
    curves.push_back(curve);
  }
  Figure figure = learningFigure(curves);
  figure.title = "A bandit with five arms: 30 runs each";
  figure.xLabel = "hundreds of pulls";
  figure.yLabel = "regret";
  plot("bandits", figure);
}
