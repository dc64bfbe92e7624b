#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "estimation/histogram_filter.h"
#include "grading/evidence.h"
#include "interface.h"

// Part 1: a belief over cells. Wanted values are those of the library's filter, with a transition that is
// written column by column.

inline Corridor randomCorridor(rex::Rng& rng) {
  Corridor corridor{.doors = Eigen::VectorXd::Zero(5 + rng.index(8)),
                    .misses = rng.uniform(0.02, 0.2),
                    .alarms = rng.uniform(0.22, 0.4),
                    .slips = rng.uniform(0.02, 0.15),
                    .leaps = rng.uniform(0.17, 0.3)};
  for (Eigen::Index i = 0; i < corridor.doors.size(); ++i) corridor.doors[i] = rng.uniform() < 0.4 ? 1 : 0;
  corridor.doors[rng.index(static_cast<int>(corridor.doors.size()))] = 1;
  return corridor;
}

inline Eigen::VectorXd randomBelief(Eigen::Index cells, rex::Rng& rng) {
  const Eigen::VectorXd belief = rng.uniformVector(static_cast<int>(cells), 0.01, 1).array().square();
  return belief / belief.sum();
}

// P(next = i | now = j) in entry (i, j). A wall at either end, or, for a mistake, a ring.
inline Eigen::MatrixXd transitionOf(const Corridor& corridor, int way, bool ring = false) {
  const int n = static_cast<int>(corridor.doors.size());
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(n, n);
  const auto inside = [&](int i) { return ring ? (i + n) % n : i < 0 ? 0 : i >= n ? n - 1 : i; };
  for (int j = 0; j < n; ++j) {
    T(j, j) += corridor.slips;
    T(inside(j + way), j) += 1 - corridor.slips - corridor.leaps;
    T(inside(j + 2 * way), j) += corridor.leaps;
  }
  return T;
}

inline Eigen::VectorXd likelihoodsOf(const Corridor& corridor, bool door) {
  const Eigen::VectorXd sees =
      (corridor.doors.array() > 0.5)
          .select(Eigen::ArrayXd::Constant(corridor.doors.size(), 1 - corridor.misses), corridor.alarms);
  return door ? sees : Eigen::VectorXd(1 - sees.array());
}

inline rex::grading::Evidence beliefsBeside(const std::string& title, const Eigen::VectorXd& got,
                                            const Eigen::VectorXd& wanted) {
  std::vector<double> x;
  for (Eigen::Index i = 0; i < wanted.size(); ++i) x.push_back(static_cast<double>(i));
  const auto listed = [&](const Eigen::VectorXd& v) { return std::vector<double>(v.begin(), v.end()); };
  std::vector<rex::Series> series = {rex::grading::wantedCurve("wanted", x, listed(wanted))};
  if (got.size() == wanted.size()) series.push_back(rex::grading::gotCurve("got", x, listed(got)));
  return {.figures = {{.title = title, .xLabel = "cell", .yLabel = "probability", .series = series}}};
}

inline void describeCorridor(rex::grading::Check& check, const Corridor& corridor,
                             const Eigen::VectorXd& belief, const char* what, double value) {
  check.input("a corridor", {{"doors", corridor.doors},
                             {"misses", corridor.misses},
                             {"alarms", corridor.alarms},
                             {"slips", corridor.slips},
                             {"leaps", corridor.leaps},
                             {"belief", belief},
                             {what, value}});
}

inline void movedCellsFit(rex::grading::Check& check, Student& student, int number) {
  rex::Rng& rng = check.rng();
  const Corridor corridor = randomCorridor(rng);
  const Eigen::Index n = corridor.doors.size();
  const int way = number % 2 == 0 ? 1 : -1;
  // By turns far from the wall, at it, and anywhere.
  Eigen::VectorXd belief = randomBelief(n, rng);
  if (number % 3 == 0) belief = Eigen::VectorXd::Unit(n, n / 2);
  if (number % 3 == 1) belief = Eigen::VectorXd::Unit(n, way > 0 ? n - 2 : 1);
  describeCorridor(check, corridor, belief, "way", way);
  const Eigen::MatrixXd T = transitionOf(corridor, way);
  const Eigen::VectorXd got = student.movedCells(belief, way, corridor);
  const Eigen::VectorXd wanted = rex::predictCells(belief, rex::CellTransition(T.sparseView()));
  check.shape("result of movedCells", got, n, 1);
  Eigen::VectorXd lost = Eigen::VectorXd::Zero(n);
  const Eigen::Vector3d share(corridor.slips, 1 - corridor.slips - corridor.leaps, corridor.leaps);
  for (Eigen::Index i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) {
      const Eigen::Index to = i + way * k;
      if (to >= 0 && to < n) lost[to] += share[k] * belief[i];
    }
  const auto shown = check.show([&] { return beliefsBeside("The belief after the move", got, wanted); });
  check.near("belief of movedCells", got, wanted, 1e-9,
             {{"Does what would go beyond the wall get lost? It stays in the last cell.", lost},
              {"Is it the product with the transposed matrix? A cell passes its probability on.",
               T.transpose() * belief},
              {"Is the belief the same as before?", belief}});
}

inline void seenCellsFit(rex::grading::Check& check, Student& student, int number) {
  rex::Rng& rng = check.rng();
  Corridor corridor = randomCorridor(rng);
  const Eigen::Index n = corridor.doors.size();
  bool door = number % 2 == 0;
  Eigen::VectorXd belief = randomBelief(n, rng);
  if (number % 5 == 4) {  // surely at a door, which is never missed, and no door is seen
    corridor.misses = 0;
    door = false;
    Eigen::Index at = 0;
    corridor.doors.maxCoeff(&at);
    belief = Eigen::VectorXd::Unit(n, at);
    corridor.doors[(at + 1) % n] = 1;
    belief[at] = 0.7;
    belief[(at + 1) % n] = 0.3;
  }
  describeCorridor(check, corridor, belief, "door", door ? 1 : 0);
  const Eigen::VectorXd L = likelihoodsOf(corridor, door), chances = student.doorChances(door, corridor);
  check.shape("result of doorChances", chances, n, 1);
  check.near(
      "result of doorChances", chances, L, 1e-12,
      {{"Is it the chance of the other observation?", likelihoodsOf(corridor, !door)},
       {"Is the result a distribution over cells? Each number is one over observations.", L / L.sum()}});
  const Eigen::VectorXd got = student.seenCells(belief, door, corridor);
  const rex::CellUpdate update = rex::updateCells(belief, L);
  check.shape("result of seenCells", got, n, 1);
  const Eigen::VectorXd product = belief.cwiseProduct(L), sum = belief + L;
  const auto shown = check.show([&] { return beliefsBeside("The belief after a look", got, update.belief); });
  check.near(
      "belief of seenCells", got, update.belief, 1e-9,
      {{"Is the sum of belief and likelihood taken? Bayes' rule has a product.", sum / sum.sum()},
       {"Is the likelihood counted twice?", product.cwiseProduct(L) / std::max(1e-300, product.dot(L))},
       {"Is the belief the same as before?", belief}});
}

inline void hindsightFits(rex::grading::Check& check, Student& student) {
  rex::Rng& rng = check.rng();
  const Corridor corridor = randomCorridor(rng);
  const Eigen::Index n = corridor.doors.size();
  const Eigen::VectorXd prior = randomBelief(n, rng);
  std::vector<int> ways, seen = {rng.index(2)};
  std::vector<rex::CellTransition> transitions;
  std::vector<Eigen::VectorXd> likelihoods = {likelihoodsOf(corridor, seen[0] == 1)};
  for (int t = 0; t < 5; ++t) {
    ways.push_back(rng.uniform() < 0.7 ? 1 : -1);
    seen.push_back(rng.index(2));
    transitions.push_back(transitionOf(corridor, ways.back()).sparseView());
    likelihoods.push_back(likelihoodsOf(corridor, seen.back() == 1));
  }
  const auto listed = [](const std::vector<int>& numbers) {
    Eigen::VectorXd list(static_cast<Eigen::Index>(numbers.size()));
    for (std::size_t k = 0; k < numbers.size(); ++k) list[static_cast<Eigen::Index>(k)] = numbers[k];
    return list;
  };
  check.input("a walk in a corridor", {{"doors", corridor.doors},
                                       {"misses", corridor.misses},
                                       {"alarms", corridor.alarms},
                                       {"slips", corridor.slips},
                                       {"leaps", corridor.leaps},
                                       {"prior", prior},
                                       {"ways", listed(ways)},
                                       {"seen", listed(seen)}});
  const std::vector<Eigen::VectorXd> wanted = rex::smoothedCells(prior, transitions, likelihoods);
  const std::vector<Eigen::VectorXd> got = student.cellsInHindsight(prior, ways, seen, corridor);
  check.near("number of beliefs of cellsInHindsight", static_cast<double>(got.size()), 6, 0);
  Eigen::VectorXd filtered = prior;
  std::vector<Eigen::VectorXd> forward;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    if (k > 0) filtered = rex::predictCells(filtered, transitions[k - 1]);
    filtered = rex::updateCells(filtered, likelihoods[k]).belief;
    forward.push_back(filtered);
  }
  for (const std::size_t t : {5, 4, 3, 2, 1, 0}) {
    check.shape("belief of cellsInHindsight", got[t], n, 1);
    Eigen::VectorXd unmoved = forward[t], moved = unmoved, own = unmoved;
    if (t < 5) {
      unmoved = unmoved.cwiseProduct(likelihoods[t + 1]);
      moved = moved.cwiseProduct(transitions[t] * likelihoods[t + 1]);
      own = own.cwiseProduct(transitions[t].transpose() * likelihoods[t + 1].cwiseProduct(forward[t + 1]));
    }
    const auto shown =
        check.show([&] { return beliefsBeside("The belief in hindsight", got[t], wanted[t]); });
    check.near("belief of cellsInHindsight at time " + std::to_string(t), got[t], wanted[t], 1e-9,
               {{"Is it what was believed before anything was seen?", prior}});
  }
}
