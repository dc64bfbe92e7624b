#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "control/controllability.h"
#include "grading/check.h"
#include "interface.h"
#include "plants.h"

// Parts 4, 5 and 7: controllability, poles and Lyapunov functions.

inline double rankOf(const Eigen::MatrixXd& M) {
  const Eigen::VectorXd s = rex::svd(M).s;
  return static_cast<double>((s.array() > 1e-9 * s[0]).count());
}

inline void reachFits(rex::grading::Check& check, Student& student, const Plant& plant, Eigen::Index rank) {
  describe(check, "a plant", plant);
  const auto matrixOf = [&](const Eigen::MatrixXd& A) -> Eigen::MatrixXd {
    return rex::controllabilityMatrix({.A = A, .B = plant.B});
  };
  const Eigen::MatrixXd wanted = matrixOf(plant.A);
  const auto transposed = check.suspect("Is A transposed?", matrixOf(plant.A.transpose()));
  const auto tooMany = check.suspect(
      "Is a power of A too many? The last is A^(n-1).",
      (Eigen::MatrixXd(wanted.rows(), plant.B.cols() + wanted.cols()) << plant.B, plant.A * wanted)
          .finished());
  check.near("reachMatrix", student.reachMatrix(plant), wanted, 1e-9 * (1 + wanted.norm()));
  const auto ofB = check.suspect("Is it the rank of B?", Eigen::MatrixXd::Constant(1, 1, rankOf(plant.B)));
  const auto ofA = check.suspect("Is it the rank of A?", Eigen::MatrixXd::Constant(1, 1, rankOf(plant.A)));
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

/// A flow, a candidate and a box.
struct Candidate {
  std::string name;
  Flow f;
  Eigen::MatrixXd P;
  Eigen::VectorXd high;
  bool isWrong = false;  ///< points that disprove it fill 2 % of the box, or lie on an axis
};

inline bool disproves(const Candidate& candidate, const Eigen::VectorXd& x, double slack = 0) {
  const Eigen::VectorXd gradient = candidate.P * x, rate = candidate.f(x);
  return x.dot(gradient) <= slack * x.squaredNorm() * candidate.P.norm() ||
         gradient.dot(rate) >= -slack * gradient.norm() * rate.norm();
}

/// The share of the box that disproves the candidate, estimated from 4000 points.
inline double wrongShare(const Candidate& candidate, rex::Rng& rng) {
  int count = 0;
  for (int i = 0; i < 4000; ++i)
    count += disproves(candidate, candidate.high.cwiseProduct(
                                      rng.uniformVector(static_cast<int>(candidate.high.size()), -1, 1)));
  return count / 4000.;
}

inline void asksForPoint(rex::grading::Check& check, const Candidate& candidate, bool isFound) {
  rex::Rng rng(1);
  const auto negative = check.ask("V is negative everywhere: is V(x) <= 0 tested, too?",
                                  Eigen::MatrixXd(-candidate.P).llt().info() == Eigen::Success);
  const auto many = check.ask("Such points fill more than 1 % of the box: is all of it searched?",
                              !isFound && wrongShare(candidate, rng) > .01);
  const auto axes = check.ask("Such points lie on the axes of the box: are these searched?");
  check.that("counterexample finds a point that disproves V", isFound);
}

/// Accepts every point that disproves the candidate.
inline void candidateIsJudged(rex::grading::Check& check, Student& student, const Candidate& candidate) {
  check.input(candidate.name, {{"P", candidate.P}, {"high", candidate.high}});
  int asked = 0;
  const Flow f = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    ++asked;
    if (x.size() != candidate.high.size() || !x.allFinite())
      return Eigen::VectorXd::Zero(candidate.high.size());
    return candidate.f(x);
  };
  const std::optional<Eigen::VectorXd> x =
      student.counterexample(f, candidate.P, candidate.high, check.rng().split(7));
  check.rng().next();
  check.atMost("number of calls of f by counterexample", asked, 20000);
  if (candidate.isWrong) asksForPoint(check, candidate, x.has_value());
  if (!x) {
    check.that("counterexample returns nothing if V is a Lyapunov function", !candidate.isWrong);
    return;
  }
  check.shape("the point", *x, candidate.high.size(), 1);
  check.atLeast("norm of the point", x->norm(), 1e-12);
  check.atMost("the point, as a share of the box", (x->cwiseAbs().cwiseQuotient(candidate.high)).maxCoeff(),
               1 + 1e-9);
  check.that("the point disproves V", disproves(candidate, *x, 1e-9));
}

inline Flow linearFlow(const Eigen::MatrixXd& A) {
  return [A](const Eigen::VectorXd& x) -> Eigen::VectorXd { return A * x; };
}

/// The point mass of 8:42 under PD control. V is its kinetic energy, its energy with that of the spring, or
/// the solution of the Lyapunov equation, which has a cross term. Position and velocity come in a random
/// order, so that the axis on which a candidate fails is not known.
inline std::vector<Candidate> energyCandidates(rex::Rng& rng) {
  const double m = rng.uniform(.5, 2), Kp = rng.uniform(.5, 2), Kd = rng.uniform(.5, 2);
  const int place = rng.index(2), velocity = 1 - place;
  Eigen::Matrix2d A = Eigen::Matrix2d::Zero(), kinetic = A;
  A(place, velocity) = 1;
  A(velocity, place) = -Kp / m;
  A(velocity, velocity) = -Kd / m;
  kinetic(velocity, velocity) = m / 2;
  Eigen::Matrix2d energy = kinetic;
  energy(place, place) = Kp / 2;
  const Eigen::Matrix2d crossed = rex::solveLyapunov(A, Eigen::Matrix2d::Identity());
  const Eigen::Vector2d high(rng.uniform(.5, 2), rng.uniform(.5, 2));
  return {
      {"a point mass under PD control, V its kinetic energy as on slide 8:42", linearFlow(A), kinetic, high,
       true},
      {"a point mass under PD control, V its kinetic energy and that of the spring", linearFlow(A), energy,
       high, true},
      {"a point mass under PD control, V with a cross term", linearFlow(A), crossed, high, false},
      {"a point mass under PD control, backward in time, V negative", linearFlow(-A), -crossed, high, true},
      {"a point mass under PD control of the wrong sign, V with a cross term", linearFlow(-A), crossed, high,
       true}};
}

/// The cart pole under optimal gains, with costs on all states: near upright the value function proves
/// stability; in the large box V rises at four points out of ten.
inline std::vector<Candidate> cartCandidates(const PoleCart& cart) {
  const Costs costs{Eigen::Vector4d(1, 1, 100, 100).asDiagonal(), Eigen::MatrixXd::Identity(1, 1)};
  const Regulation task = regulationOf(plantOf(cart), costs);
  const rex::CartPoleDynamics dynamics = dynamicsOf(cart);
  const Eigen::MatrixXd K = -task.optimal.K;
  const Flow f = [dynamics, K](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return dynamics.derivative(x, (K * x)[0]);
  };
  return {{"the cart pole, optimal gains and V = x^T P x, a small box", f, task.optimal.X,
           Eigen::Vector4d(.2, .2, .05, .1), false},
          {"the cart pole, optimal gains and V = x^T P x, a large box", f, task.optimal.X,
           Eigen::Vector4d(2, 2, 1.5, 2), true}};
}

/// Whether the candidate holds at the corners of the box and on its axes, so that a search of these alone
/// fails.
inline bool holdsAtTheCorners(const Candidate& candidate) {
  const Eigen::Index n = candidate.high.size();
  for (int corner = 0; corner < 1 << n; ++corner) {
    Eigen::VectorXd x = candidate.high;
    for (Eigen::Index i = 0; i < n; ++i)
      if ((corner >> i & 1) != 0) x[i] = -x[i];
    if (disproves(candidate, x)) return false;
  }
  for (Eigen::Index i = 0; i < n; ++i)
    if (disproves(candidate, candidate.high[i] * Eigen::VectorXd::Unit(n, i))) return false;
  return true;
}

/// A linear flow with a cubic term, which makes V rise far from the origin; and the linear flow with a
/// wrong V.
inline std::vector<Candidate> cubicCandidates(rex::Rng& rng, Eigen::Index n) {
  for (;;) {
    Eigen::MatrixXd A = randomMatrix(rng, n, n);
    A.diagonal().array() -= abscissa(A) + rng.uniform(.3, 1);
    const Eigen::MatrixXd P = rex::solveLyapunov(A, randomPositive(rng, n, .3));
    const Flow f = [A](const Eigen::VectorXd& x) -> Eigen::VectorXd { return A * x + x.squaredNorm() * x; };
    // V' = -x^T Q x + 2 |x|^2 x^T P x is negative where 2 |x|^2 is below the least eigenvalue of P^-1 Q.
    const double nearby = std::sqrt(.3 / 2 / P.norm()) / std::sqrt(static_cast<double>(n));
    Candidate far{"a cubic flow, a large box", f, P, Eigen::VectorXd::Constant(n, 8 * nearby), true};
    Candidate other{"a linear flow, another V", linearFlow(A),
                    Eigen::MatrixXd::Identity(n, n) + .3 * randomPositive(rng, n, 0),
                    rng.uniformVector(static_cast<int>(n), .2, 2), true};
    if (!holdsAtTheCorners(other)) continue;
    if (wrongShare(far, rng) < .02 || wrongShare(other, rng) < .02) continue;
    return {{"a cubic flow, a small box", f, P, Eigen::VectorXd::Constant(n, .9 * nearby), false},
            far,
            {"a linear flow", linearFlow(A), P, other.high, false},
            other};
  }
}

/// The minimum of x^T P x on the faces x_i = high_i, by eliminating all other coordinates.
inline void levelFits(rex::grading::Check& check, Student& student, Eigen::Index n) {
  const Eigen::MatrixXd P = randomPositive(check.rng(), n, .1);
  const Eigen::VectorXd high = check.rng().uniformVector(static_cast<int>(n), .2, 2);
  check.input("a box |x_i| <= high_i", {{"P", P}, {"high", high}});
  double lowest = INFINITY;
  for (Eigen::Index face = 0; face < n; ++face) {
    std::vector<Eigen::Index> others;
    for (Eigen::Index k = 0; k < n; ++k)
      if (k != face) others.push_back(k);
    const Eigen::VectorXd coupling = P(others, face);
    const double left =
        n == 1 ? P(0, 0)
               : P(face, face) - coupling.dot(rex::solve(Eigen::MatrixXd(P(others, others)), coupling));
    lowest = std::min(lowest, left * high[face] * high[face]);
  }
  const auto number = [](double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
  const auto axes =
      check.suspect("Is it where the ellipsoid meets the box on an axis? It leaves the box elsewhere.",
                    number((P.diagonal().array() * high.array().square()).minCoeff()));
  check.near("levelInside", student.levelInside(P, high), lowest, 1e-8 * lowest);
}
