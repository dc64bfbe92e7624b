#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "course/cart_pole_pictures.h"
#include "grading/check.h"
#include "grading/evidence.h"
#include "grading/tolerance.h"
#include "interface.h"
#include "plants.h"

// Parts 1 and 3: the cart pole by itself, and under control.

inline void ratesFit(rex::grading::Check& check, Student& student, const PoleCart& cart) {
  rex::Rng& rng = check.rng();
  const Eigen::Vector4d x(rng.uniform(-2, 2), rng.normal(), rng.uniform(-4, 4), 2 * rng.normal());
  const double u = 5 * rng.normal();
  check.input(described(cart), {{"x", x}, {"u", u}});
  const Eigen::Vector4d wanted = dynamicsOf(cart).derivative(x, u);
  const auto length =
      check.ask("It is right for the cart of the sheet: is l left out, which is 1 there?", cart.l != 1);
  check.near("(p', p'', theta', theta'') of rateOf", student.rateOf(cart, x, u), wanted,
             1e-9 * (1 + wanted.norm()));
}

inline void linearisationFits(rex::grading::Check& check, Student& student, const PoleCart& cart) {
  check.input(described(cart));
  const Plant wanted = plantOf(cart), got = student.linearised(cart);
  // Loose enough for good finite differences.
  check.near("A of linearised", got.A, wanted.A, 1e-7);
  check.near("B of linearised", got.B, wanted.B, 1e-7);
}

// x after one Euler step, with noise from the generator.
inline Eigen::Vector4d euler(const PoleCart& cart, const Eigen::Vector4d& x, double u, double tau,
                             double noise, rex::Rng& rng) {
  const double first = rng.normal(), second = rng.normal();
  return x + tau * dynamicsOf(cart).derivative(x, u) + noise * Eigen::Vector4d(0, first, 0, second);
}

inline void checkStep(rex::grading::Check& check, Student& student, const PoleCart& cart, double noise) {
  rex::Rng& rng = check.rng();
  const Eigen::Vector4d x = rng.normalVector(4);
  const double u = 5 * rng.normal(), tau = rng.uniform(.005, .1);
  check.input(described(cart), {{"x", x}, {"u", u}, {"tau", tau}, {"noise", noise}});
  const rex::remote::SplitRng given = check.split(7);
  const Eigen::Vector4d rates = dynamicsOf(cart).derivative(x, u);
  const bool isRate = (student.rateOf(cart, x, u) - rates).norm() <= 1e-9 * (1 + rates.norm());
  const Eigen::Vector4d got = student.stepped(cart, x, u, tau, noise, given);
  rex::Rng same = given;
  const Eigen::Vector4d wanted = euler(cart, x, u, tau, noise, same);
  const auto ofRates = check.ask("Does stepped use rateOf? That is wrong for this input, too.", !isRate);
  check.near("(p, theta) of stepped", Eigen::Vector2d(got[0], got[2]), Eigen::Vector2d(wanted[0], wanted[2]),
             1e-9);
  const auto ratesOf = [](const Eigen::Vector4d& state) { return Eigen::Vector2d(state[1], state[3]); };
  check.near("(p', theta') of stepped", ratesOf(got), ratesOf(wanted), 1e-9);
  rng.next();
}

/// The states of an outing according to the equations, until its end.
inline Eigen::MatrixXd statesOf(const PoleCart& cart, const Eigen::MatrixXd& K, const Eigen::Vector4d& start,
                                const Outing& outing, rex::Rng rng) {
  Eigen::MatrixXd run(4, outing.steps + 1);
  run.col(0) = start;
  Eigen::Index t = 0;
  for (; t < outing.steps && std::abs(run(2, t)) <= std::numbers::pi / 2; ++t)
    run.col(t + 1) = euler(cart, run.col(t), (K * run.col(t))[0], outing.tau, outing.noise, rng);
  return run.leftCols(t + 1);
}

/// One coordinate of the states over time.
inline std::vector<double> rowOf(const Eigen::MatrixXd& states, Eigen::Index row) {
  const Eigen::VectorXd numbers = states.row(row);
  return {numbers.begin(), numbers.end()};
}

inline std::vector<double> timesOf(const Eigen::MatrixXd& states, double tau) {
  std::vector<double> times;
  for (Eigen::Index k = 0; k < states.cols(); ++k) times.push_back(tau * static_cast<double>(k));
  return times;
}

/// A film of every `stride`-th state, until the cart is 8 m away.
inline rex::Film filmOf(const Eigen::MatrixXd& states, double tau, Eigen::Index stride) {
  rex::Film film;
  for (Eigen::Index k = 0; k < states.cols() && std::abs(states(0, k)) < 8; k += stride)
    film.push_back({tau * static_cast<double>(k), cartPolePicture(rex::CartPoleView{.x = states.col(k)})});
  return film;
}

/// The outing beside the wanted one, as a film.
inline rex::grading::Evidence seen(const Eigen::MatrixXd& states, const Eigen::MatrixXd& wanted, double tau) {
  using rex::grading::gotCurve, rex::grading::wantedCurve;
  const std::vector<double> times = timesOf(states, tau), wantedTimes = timesOf(wanted, tau);
  rex::Figure figure{
      .title = "The outing until its end", .xLabel = "time [s]", .yLabel = "p [m], theta [rad]"};
  figure.series = {gotCurve("p, got", times, rowOf(states, 0)),
                   gotCurve("theta, got", times, rowOf(states, 2)),
                   wantedCurve("p and theta, wanted", wantedTimes, rowOf(wanted, 0)),
                   wantedCurve("", wantedTimes, rowOf(wanted, 2))};
  figure.series[1].color = rex::Color{.84f, .37f, 0};
  const Eigen::Index stride = 1 + std::max(states.cols(), wanted.cols()) / 400;
  return {.figures = {figure},
          .film = rex::grading::withWanted(filmOf(states, tau, stride), filmOf(wanted, tau, stride)),
          .view = {.35, -2, .45}};
}

/// The same, which opens where the two angles theta first differ by `apart`, radians.
inline rex::grading::Evidence seenApart(const Eigen::MatrixXd& states, const Eigen::MatrixXd& wanted,
                                        double tau, double apart) {
  Eigen::Index t = 0;
  const Eigen::Index last = std::min(states.cols(), wanted.cols()) - 1;
  while (t + 1 < last && std::abs(states(2, t + 1) - wanted(2, t + 1)) < apart) ++t;
  rex::grading::Evidence evidence = seen(states, wanted, tau);
  if (last < 1 || std::abs(states(2, t + 1) - wanted(2, t + 1)) < apart) return evidence;
  evidence.moment = tau * static_cast<double>(t + 1);
  evidence.figures[0].verticalLines = {rex::grading::wrongFrom(evidence.moment)};
  return evidence;
}

/// The cart under u = K x with the gains that were returned and with the wanted ones, without noise.
inline rex::grading::Evidence seenUnder(const Eigen::MatrixXd& K, const Eigen::MatrixXd& wantedK) {
  const Outing calm{.noise = 0, .steps = 300};
  const auto statesUnder = [&](const Eigen::MatrixXd& gains) {
    return statesOf({}, gains, {0, 0, .2, 0}, calm, rex::Rng(1));
  };
  rex::grading::Evidence evidence = seenApart(statesUnder(K), statesUnder(wantedK), calm.tau, .05);
  evidence.figures[0].title = "The cart under these gains, from theta = 0.2 without noise";
  return evidence;
}

/// Checks that each state follows from the one before it and that the outing ends when it must. Returns the
/// states.
inline Eigen::MatrixXd outingFits(rex::grading::Check& check, Student& student, const PoleCart& cart,
                                  const Eigen::MatrixXd& K, const Eigen::Vector4d& start,
                                  const Outing& outing) {
  const rex::remote::SplitRng given = check.split(7);
  check.rng().next();
  const Eigen::MatrixXd states = student.balanced(cart, K, start, outing, given);
  check.atLeast("number of states of balanced", static_cast<double>(states.cols()), 1);
  check.atMost("number of states of balanced", static_cast<double>(states.cols()), outing.steps + 1);
  check.shape("states of balanced", states, 4, states.cols());
  check.near("first state of balanced", states.col(0), start, 0);
  rex::Rng same = given;
  rex::grading::Signal angles{.axis = "time [s]"}, got = angles;
  std::vector<Eigen::VectorXd> wanted;
  double largest = 1;
  bool hasFallen = false, isRepeated = outing.noise > 0 && states.cols() > 2;
  bool isTurned = K.norm() > 0 && states.cols() > 1;
  for (Eigen::Index t = 0; t + 1 < states.cols(); ++t) {
    const Eigen::Vector4d x = states.col(t);
    angles.add(outing.tau * static_cast<double>(t), std::abs(x[2]));
    hasFallen = hasFallen || std::abs(x[2]) > std::numbers::pi / 2;
    if (hasFallen) continue;  // numbers may become large
    got.add(outing.tau * static_cast<double>(t + 1), states.col(t + 1));
    rex::Rng again = same;
    const Eigen::Vector4d turned = euler(cart, x, -(K * x)[0], outing.tau, outing.noise, again);
    wanted.emplace_back(euler(cart, x, (K * x)[0], outing.tau, outing.noise, same));
    // A motion that explodes hides nothing.
    largest = std::max(largest, rex::grading::sizeUpTo(1000, wanted.back()));
    isTurned = isTurned && (turned - states.col(t + 1)).norm() < 1e-9 * largest;
    rex::Rng first = given;
    const Eigen::Vector4d repeated = euler(cart, x, (K * x)[0], outing.tau, outing.noise, first);
    isRepeated = isRepeated && (repeated - states.col(t + 1)).norm() < 1e-9 * largest;
  }
  const auto shown =
      check.show([&] { return seen(states, statesOf(cart, K, start, outing, given), outing.tau); });
  if (!wanted.empty()) {
    const auto copied = check.ask(
        "Does each step get the same noise? Pass rng on by reference, not a copy of it.", isRepeated);
    const auto opposite = check.ask("Is it u = -K x? Here the control is u = K x.", isTurned);
    check.nearAlong("(p, p', theta, theta') in balanced, next to a step from the state before", got, wanted,
                    1e-9 * largest);
    const auto goesOn = check.ask("Does the outing go on after the pole has fallen?");
    check.atMostAlong("|theta| before the last state of balanced", angles, std::numbers::pi / 2, "rad");
  }
  if (states.cols() <= outing.steps) {
    const auto fallen = check.ask("Is the state left out in which the pole has fallen?",
                                  std::abs(states(2, states.cols() - 1)) > 1);
    const auto few = check.ask("There are steps + 1 states, with the start: is one missing?",
                               states.cols() == outing.steps);
    check.atLeast("|theta| in the last state of balanced, which came early",
                  std::abs(states(2, states.cols() - 1)), std::numbers::pi / 2, "rad");
  }
  return states;
}

/// Single steps of carts with and without noise. If one is wrong, the outing shows what that leads to.
inline void stepsFit(rex::grading::Check& check, Student& student, const PoleCart& cart,
                     const Eigen::MatrixXd& K) {
  const Eigen::Vector4d start(0, 0, .2, 0);
  const Outing calm{.noise = 0, .steps = 300};
  const Eigen::MatrixXd states = student.balanced(cart, K, start, calm, check.split(7)),
                        wanted = statesOf(cart, K, start, calm, rex::Rng(1));
  const auto shown = check.show([&] {
    const bool isOuting = states.rows() == 4 && states.cols() > 1 && wanted.cols() > 1;
    return isOuting && !states.isApprox(wanted) ? seenApart(states, wanted, calm.tau, 1e-6)
                                                : rex::grading::Evidence{};
  });
  for (int i = 0; i < 20; ++i) checkStep(check, student, randomCart(check.rng()), i < 10 ? 0 : .1 * i);
}

/// Balances for 50 s with the student's own A, B, P and K. With the gains of the sheet's costs and noise
/// 0.1, none of 40000 outings from 0.4 rad fell, and none of 40000 from 0.6 rad.
inline void survivesFrom(rex::grading::Check& check, Student& student, double angle, double noise) {
  const PoleCart cart;
  const Costs costs = costsOfTheSheet();
  check.input(
      fmt::format("the cart pole of the sheet from theta = {:g}, noise {:g}, 3000 steps", angle, noise));
  const Plant plant = student.linearised(cart);
  check.shape("A of linearised", plant.A, 4, 4);
  check.shape("B of linearised", plant.B, 4, 1);
  const Eigen::MatrixXd P = student.viaHamiltonian(plant, costs);
  check.shape("P of viaHamiltonian", P, 4, 4);
  const Eigen::MatrixXd K = student.gainOf(plant, costs, P);
  check.shape("K of gainOf", K, 1, 4);
  const Eigen::MatrixXd states =
      outingFits(check, student, cart, K, Eigen::Vector4d(0, 0, angle, 0), {.noise = noise});
  check.near("number of states", static_cast<double>(states.cols()), 3001, 0);
  check.atMost("|theta| at the end", std::abs(states(2, 3000)), std::numbers::pi / 2, "rad");
  if (noise > 0) return;
  check.near("last state", states.col(3000), Eigen::Vector4d::Zero(), 1e-3);
}
