#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Cholesky>

#include "control/riccati.h"
#include "grading/check.h"
#include "interface.h"
#include "plants.h"

// Part 4: Lyapunov functions.

/// A flow, a candidate and a box.
struct Candidate {
  std::string name;
  Flow f;
  Eigen::MatrixXd P;
  Eigen::VectorXd high;
  bool isWrong = false;  ///< points that disprove it fill 2 % of the box, or a third of an axis
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
  const auto axes = check.ask(
      "Such points lie on the axes of the box: are these searched all along, and does V' = 0 count?");
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
      student.counterexample(f, candidate.P, candidate.high, check.split(7));
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
  const Eigen::VectorXd across = candidate.P * *x;
  check.input(candidate.name, {{"P", candidate.P},
                               {"high", candidate.high},
                               {"x", *x},
                               {"V", x->dot(across)},
                               {"V'", 2 * across.dot(candidate.f(*x))}});
  const auto slope =
      check.ask("At the point V' = 2 x^T P f(x) has to be 0 or more, or V 0 or less. Is it so there?");
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

/// A damped mass that loses energy at rest, too, but only far away: V' = 0 on a part of the axis of
/// positions.
inline Candidate farFriction(rex::Rng& rng) {
  const double Kp = rng.uniform(.5, 2), Kd = rng.uniform(.5, 2), c = rng.uniform(.5, 2);
  const int place = rng.index(2), velocity = 1 - place;
  const Eigen::Vector2d high(rng.uniform(.5, 2), rng.uniform(.5, 2));
  const double from = rng.uniform(.35, .8) * high[place];
  const Flow f = [=](const Eigen::VectorXd& x) {
    const double beyond = x[place] - std::clamp(x[place], -from, from);
    Eigen::VectorXd rate(2);
    rate[place] = x[velocity] - c * beyond;
    rate[velocity] = -Kp * x[place] - Kd * x[velocity];
    return rate;
  };
  Eigen::Matrix2d energy = Eigen::Matrix2d::Zero();
  energy(place, place) = Kp / 2;
  energy(velocity, velocity) = .5;
  return {"a mass on a spring with friction far away, V its energy", f, energy, high, true};
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
  double last = 0, plain = INFINITY, multiplied = INFINITY;
  for (Eigen::Index face = 0; face < n; ++face) {
    const double reach = rex::inverse(P)(face, face);
    last = std::max(last, high[face] * high[face] / reach);
    plain = std::min(plain, high[face] / reach);
    multiplied = std::min(multiplied, high[face] * high[face] * reach);
  }
  const auto all =
      check.suspect("Is it where the ellipsoid is outside on all sides? One is enough.", number(last));
  const auto product =
      check.suspect("Is high_i^2 multiplied by the entry of P^-1? The ellipsoid reaches as far as its root.",
                    number(multiplied));
  const auto roots = check.suspect("Is high_i not squared? V is a square.", number(plain));
  const auto axes =
      check.suspect("Is it where the ellipsoid meets the box on an axis? It leaves the box elsewhere.",
                    number((P.diagonal().array() * high.array().square()).minCoeff()));
  check.near("levelInside", student.levelInside(P, high), lowest, 1e-8 * lowest);
}
