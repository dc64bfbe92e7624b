#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "control/controllability.h"
#include "grading/check.h"
#include "interface.h"
#include "plants.h"

// Parts 4 and 5: controllability and poles.

inline double rankOf(const Eigen::MatrixXd& M) {
  const Eigen::VectorXd s = rex::svd(M).s;
  return static_cast<double>((s.array() > 1e-9 * s[0]).count());
}

inline void reachFits(rex::grading::Check& check, Student& student, const Plant& plant, Eigen::Index rank) {
  describe(check, "a plant", plant);
  const Eigen::MatrixXd wanted = rex::controllabilityMatrix({.A = plant.A, .B = plant.B});
  check.near("reachMatrix", student.reachMatrix(plant), wanted, 1e-9 * (1 + wanted.norm()));
  const auto zeros = check.ask(
      "Which singular values count as zero? Those below 1e-9 of the largest.",
      rank < plant.A.rows() || wanted.norm() < 1e-6 || rex::svd(wanted).s.tail(1)[0] < 1e-5 * wanted.norm());
  check.near("reachable, the rank", student.reachable(plant), static_cast<double>(rank), 0);
}

/// A plant in which u reaches `rank` of n dimensions, in coordinates that do not show which. No singular
/// value lies between 1e-13 and 1e-6 of the largest, so that it is clear which are zero up to rounding.
inline Plant partlyReached(rex::Rng& rng, Eigen::Index n, Eigen::Index rank, Eigen::Index m) {
  for (;;) {
    Plant plant = randomPlant(rng, rank, m);
    plant.A.topRows(1) *= 2;
    const Eigen::Index rest = n - rank;
    const Eigen::MatrixXd unmoved = randomMatrix(rng, rest, rest) / std::sqrt(static_cast<double>(n));
    plant = inCoordinates(besideUnmoved(plant, unmoved), randomCoordinates(rng, n));
    const Eigen::VectorXd sizes = rex::svd(rex::controllabilityMatrix({.A = plant.A, .B = plant.B})).s;
    const bool isClear = sizes[rank - 1] > 1e-6 * sizes[0] && (rest == 0 || sizes[rank] < 1e-13 * sizes[0]);
    if (isClear) return plant;
  }
}

/// Blocks along the diagonal.
inline Eigen::MatrixXd beside(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd both = Eigen::MatrixXd::Zero(a.rows() + b.rows(), a.rows() + b.rows());
  both.topLeftCorner(a.rows(), a.rows()) = a;
  both.bottomRightCorner(b.rows(), b.rows()) = b;
  return both;
}

inline Eigen::MatrixXd rest() { return Eigen::MatrixXd::Zero(1, 1); }
inline Eigen::MatrixXd decay(double rate) { return Eigen::MatrixXd::Constant(1, 1, -rate); }
inline Eigen::MatrixXd drift() { return (Eigen::MatrixXd(2, 2) << 0, 1, 0, 0).finished(); }
inline Eigen::MatrixXd swing(double w, double rate = 0) {
  return (Eigen::MatrixXd(2, 2) << rate, w, -w, rate).finished();
}
/// Two oscillators, the first of which drives the second.
inline Eigen::MatrixXd drivenSwing(double w) {
  Eigen::MatrixXd A = beside(swing(w), swing(w));
  A.bottomLeftCorner(2, 2).setIdentity();
  return A;
}

struct KnownFate {
  std::string name;
  Eigen::MatrixXd A;
  Fate fate;
};

inline std::vector<KnownFate> knownFates(rex::Rng& rng) {
  const double w = rng.uniform(.5, 2), rate = rng.uniform(.1, 1);
  return {
      {"two decays", beside(decay(rate), decay(1)), Fate::dies},
      {"a damped oscillation", swing(w, -rate), Fate::dies},
      {"an oscillation", swing(w), Fate::stays},
      {"a decay and a constant", beside(decay(rate), rest()), Fate::stays},
      {"a point mass on which no force acts", drift(), Fate::grows},
      {"two constants", beside(rest(), rest()), Fate::stays},
      {"two oscillators of the same frequency, one driven by the other", drivenSwing(w), Fate::grows},
      {"two oscillators of the same frequency", beside(swing(w), swing(w)), Fate::stays},
      {"a decay and a growing oscillation", beside(decay(1), swing(w, rate)), Fate::grows},
      {"a decay and slow growth", beside(decay(1), decay(-.02)), Fate::grows},
      {"a point mass and a decay", beside(drift(), decay(rate)), Fate::grows},
      {"an oscillation, a constant and a decay", beside(swing(w), beside(rest(), decay(1))), Fate::stays},
      {"a point mass, a constant and an oscillation", beside(beside(drift(), rest()), swing(w)), Fate::grows},
      {"two oscillations and two decays", beside(beside(swing(w), swing(w)), beside(decay(1), decay(1))),
       Fate::stays}};
}

/// 0, ..., count - 1, shuffled, so that counting calls does not help.
inline std::vector<std::size_t> shuffled(rex::Rng& rng, std::size_t count) {
  std::vector<std::size_t> order(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto other = static_cast<std::size_t>(rng.index(static_cast<int>(i) + 1));
    order[i] = order[other];
    order[other] = i;
  }
  return order;
}

inline std::string nameOf(Fate fate) {
  return fate == Fate::dies ? "dies" : fate == Fate::stays ? "stays" : "grows";
}

inline void fateFits(rex::grading::Check& check, Student& student, const KnownFate& known) {
  check.input(known.name, {{"A", known.A}});
  const Fate got = student.fateOf(known.A);
  check.input(fmt::format("{}, got `{}`, wanted `{}`", known.name, nameOf(got), nameOf(known.fate)),
              {{"A", known.A}});
  const auto lacks = check.ask(
      "A double eigenvalue with a single eigenvector also lets motions grow, on the imaginary axis: is that "
      "tested?",
      known.fate == Fate::grows && got == Fate::stays && abscissa(known.A) < 1e-5);
  const auto has =
      check.ask("A double eigenvalue that has two eigenvectors does no harm on the imaginary axis.",
                known.fate == Fate::stays && got == Fate::grows);
  check.that("fateOf returns the fate of the motions", got == known.fate);
}
