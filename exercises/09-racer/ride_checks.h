#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "control/racer_rollouts.h"
#include "course/racer_pictures.h"
#include "feature_checks.h"
#include "grading/evidence.h"

// Part 5: rides, against the library's.

/// The world in which a policy rides.
struct Situation {
  RacerModel racer{};
  rex::RacerSensors sensors{};
  double noise = kNoise;
};

inline rex::RacerRolloutOptions optionsOf(const Situation& in, int steps) {
  return {.features = {.rates = true, .averages = true, .averagedRates = true, .controls = true},
          .cost = {.failure = kCostOfMissing},
          .steps = steps,
          .tau = kTau,
          .noise = in.noise,
          .largestControl = kLargestControl,
          .largestAngle = kLargestAngle,
          .dynamics = dynamicsOf(in.racer),
          .sensors = in.sensors};
}

inline rex::RacerSensors randomSensors(rex::Rng& rng) {
  return {.s = rng.uniform(.9, 1.1),
          .phi = rng.uniform(-.3, .3),
          .kappa = rng.uniform(.03, .07),
          .gyroBias = rng.uniform(-.1, .1)};
}

/// Weights that keep the racer of the sheet upright, with some weight on all features: less on the rates,
/// which are large.
inline Eigen::VectorXd balancing(rex::Rng& rng) {
  Eigen::VectorXd w = .001 * rng.normalVector(kFeatures);
  for (const int rates : {5, 13, 21}) w.segment<4>(rates) *= .1;
  w.head<9>() += Eigen::Matrix<double, 9, 1>(.037, -.986, 5.999, .726, .07, -.001, -.001, -.004, .053);
  return w;
}

inline Eigen::VectorXd tippingOver(rex::Rng& rng) {
  Eigen::VectorXd w = .02 * rng.normalVector(kFeatures);
  for (const int rates : {5, 13, 21}) w.segment<4>(rates) *= .01;
  return w;
}

/// Often asks for more than the motor gives.
inline Eigen::VectorXd shaking(rex::Rng& rng) { return 8 * balancing(rng); }

/// The noise of the library's rollout with that seed, from what it adds to a racer at rest upright.
inline Eigen::MatrixXd noiseOf(const Situation& in, std::uint64_t seed, int steps) {
  rex::Rng rng(seed);
  Eigen::MatrixXd noise(2, steps);
  for (int t = 0; t < steps; ++t)
    noise.col(t) = dynamicsOf(in.racer).noisyStep(Eigen::Vector4d::Zero(), 0, kTau, in.noise, rng).tail<2>();
  return noise;
}

/// The states of a ride under u(x) until it fails, and the controls in row 4, the last one 0; step t
/// leads to after(x, u, t).
template <class Control, class Step>
Eigen::MatrixXd ridden(const Eigen::Vector4d& start, Eigen::Index steps, const Control& u,
                       const Step& after) {
  Eigen::MatrixXd ride = Eigen::MatrixXd::Zero(5, steps + 1);
  ride.col(0).head(4) = start;
  Eigen::Index t = 0;
  for (; t < steps && std::abs(ride(1, t)) <= kLargestAngle; ++t) {
    ride(4, t) = u(ride.col(t).head<4>());
    ride.col(t + 1).head(4) = after(ride.col(t).head<4>(), ride(4, t), t);
  }
  return ride.leftCols(t + 1);
}

/// The state after a step with that noise.
inline Eigen::Vector4d kicked(const Situation& in, const Eigen::Vector4d& x, double u,
                              const Eigen::Vector2d& noise) {
  Eigen::Vector4d next = dynamicsOf(in.racer).rungeKuttaStep(x, u, kTau);
  next.tail<2>() += noise;
  return next;
}

/// The ride of a policy according to the equations, as ridden() gives it.
inline Eigen::MatrixXd rightRide(const Situation& in, const Eigen::VectorXd& w, const Eigen::Vector4d& start,
                                 const Eigen::MatrixXd& noise) {
  rex::RacerPolicy policy(optionsOf(in, 1).features, w, kTau, kLargestControl);
  return ridden(
      start, noise.cols(),
      [&](const Eigen::Vector4d& x) { return policy.control(in.sensors.measured(x, in.racer.r)); },
      [&](const Eigen::Vector4d& x, double u, Eigen::Index t) { return kicked(in, x, u, noise.col(t)); });
}

/// Two rides, as ridden() gives them.
struct Pair {
  Eigen::MatrixXd got, other;
  std::string name = "wanted";  ///< of the other
};

/// One row of both rides over time.
inline rex::Figure rowOf(const Pair& rides, Eigen::Index row, Eigen::Index moment) {
  constexpr std::array kNames{"x [m]", "theta [rad]", "x' [m/s]", "theta' [rad/s]", "u [N m]"};
  const auto curve = [&](const Eigen::MatrixXd& ride, rex::Series series) {
    for (Eigen::Index k = 0; k < ride.cols() - (row == 4 ? 1 : 0); ++k)
      series.add(kTau * static_cast<double>(k), ride(row, k));
    return series;
  };
  const char* name = kNames[static_cast<std::size_t>(row)];
  rex::Figure figure{.title = "The ride", .xLabel = "time [s]", .yLabel = name};
  figure.series = {curve(rides.got, rex::grading::gotCurve("got")),
                   curve(rides.other, rex::grading::wantedCurve(rides.name))};
  figure.verticalLines = {rex::grading::wrongFrom(kTau * static_cast<double>(moment))};
  if (row == 4 && rides.got.row(4).cwiseAbs().maxCoeff() > 3 * kLargestControl) {  // it would hide the rest
    figure.yRange = {-3 * kLargestControl, 3 * kLargestControl};
    figure.horizontalLines = {{.at = kLargestControl, .label = "limits of the motor"},
                              {.at = -kLargestControl}};
  }
  return figure;
}

/// A film of both racers, side by side, that opens at step `moment`.
inline rex::grading::Evidence sideBySide(const Situation& in, const Pair& rides, Eigen::Index moment) {
  const Eigen::Index count = std::max(rides.got.cols(), rides.other.cols()), stride = 1 + count / 400;
  const auto at = [](const Eigen::MatrixXd& ride, Eigen::Index k) -> Eigen::Vector4d {
    return ride.col(std::min(k, ride.cols() - 1)).head(4);
  };
  rex::Film film;
  for (Eigen::Index k = 0; k < count; k += stride) {
    Eigen::Matrix4Xd both(4, 2);
    both << at(rides.got, k), at(rides.other, k);
    film.push_back({kTau * static_cast<double>(k),
                    racerPicture(rex::RacerView{
                        .x = both, .names = {"got", rides.name}, .dynamics = dynamicsOf(in.racer)})});
  }
  return {.film = film, .view = {1.2, -1.6, .7}, .moment = kTau * static_cast<double>(moment)};
}

/// What is being checked: a row of ridden() at a step.
struct Place {
  Eigen::Index row = 0, step = 0;
};

inline double limited(double u) { return std::clamp(u, -kLargestControl, kLargestControl); }

inline void controlFits(rex::grading::Check& check, double got, const Eigen::VectorXd& w,
                        const Eigen::VectorXd& features, const Eigen::VectorXd& ofUnlimited) {
  Eigen::VectorXd first = Eigen::VectorXd::Zero(kFeatures), noControls = features;
  first.head(5) = features.head(5);
  first.segment<4>(9) = first.segment<4>(17) = features.segment<4>(1);
  noControls.tail(2).setZero();
  check.near("control u of rideOf", got, limited(w.dot(features)), 1e-7,
             {{"Do the features remember u before it is limited?", limited(w.dot(ofUnlimited))},
              {"Is featuresAt called as at the first reading, with `before` empty?", limited(w.dot(first))},
              {"Do the features lack the last controls?", limited(w.dot(noControls))}},
             "N m");
}

inline void checkMotion(rex::grading::Check& check, const Situation& in, const Eigen::Vector4d& got,
                        const Eigen::Vector4d& x, double u, const Eigen::Vector2d& noise) {
  const Eigen::Vector4d still = kicked(in, x, u, {0, 0}), wanted = kicked(in, x, u, noise);
  Eigen::Vector4d early = x;
  early.tail<2>() += noise;
  check.near(
      "state of rideOf after the step", got, wanted, 1e-8 * (1 + wanted.norm()),
      {{"Is the noise of the step left out?", still},
       {"Is the noise added before the step? It comes after.", kicked(in, early, u, {0, 0})},
       {"Is the noise added to (x, theta)?", still + stateOf(noise, Eigen::Vector2d::Zero())},
       {"Is the noise multiplied by sqrt(tau) once more?", kicked(in, x, u, std::sqrt(kTau) * noise)}});
}

/// Control and state of each step, from the states before it. `place` is where it is.
inline void stepsFit(rex::grading::Check& check, const Situation& in, const Eigen::VectorXd& w,
                     const Eigen::MatrixXd& noise, const Ride& ride, Place& place) {
  rex::SensorHistory history = noHistory(kTau), unlimited = history;
  for (Eigen::Index t = 0; t < ride.controls.size(); ++t) {
    const Eigen::Vector4d x = ride.states.col(t), y = in.sensors.measured(x, in.racer.r);
    const Eigen::VectorXd features = history.observe(y), ofUnlimited = unlimited.observe(y);
    const std::string step = fmt::format("step {} of {}, {}", t + 1, noise.cols(), described(in.racer));
    place = {4, t};
    check.input(step, {{"x", x}, {"y", y}, {"w", w}});
    controlFits(check, ride.controls[t], w, features, ofUnlimited);
    history.act(limited(w.dot(features)));
    unlimited.act(w.dot(ofUnlimited));
    const Eigen::Vector4d next = kicked(in, x, ride.controls[t], noise.col(t));
    place.step = t + 1;
    (ride.states.col(t + 1) - next).cwiseAbs().maxCoeff(&place.row);
    check.input(step, {{"x", x}, {"u", ride.controls[t]}, {"noise", noise.col(t)}});
    checkMotion(check, in, ride.states.col(t + 1), x, ride.controls[t], noise.col(t));
  }
}

/// The ride ends with the first state in which the racer has failed, and not before.
inline void endFits(rex::grading::Check& check, const Ride& ride, int wantedSteps) {
  rex::grading::Signal angle{.axis = "time [s]"};
  for (Eigen::Index t = 0; t < ride.controls.size(); ++t)
    angle.add(kTau * static_cast<double>(t), std::abs(ride.states(1, t)));
  const auto on = check.ask("Does the ride go on after the racer has failed?");
  check.atMostAlong("|theta| before the last state of rideOf", angle, kLargestAngle, "rad");
  const auto early = check.ask("Does the ride end before the racer has failed?");
  check.near("number of steps of rideOf", static_cast<double>(ride.controls.size()), wantedSteps, 0);
}

/// Checks that the ride has the states and the length that follow from the equations.
inline void rideFollows(rex::grading::Check& check, const Situation& in, const Eigen::VectorXd& w,
                        const Eigen::MatrixXd& noise, const Ride& ride, int wantedSteps) {
  const std::string input = check.input();
  Place place;
  const auto shown = check.show([&] {
    Eigen::MatrixXd got = Eigen::MatrixXd::Zero(5, ride.states.cols());
    got.topRows(4) = ride.states;
    got.row(4).head(ride.controls.size()) = ride.controls.transpose();
    const Pair rides{got, rightRide(in, w, ride.states.col(0), noise)};
    rex::grading::Evidence evidence = sideBySide(in, rides, place.step);
    evidence.figures = {rowOf(rides, place.row, place.step)};
    return evidence;
  });
  stepsFit(check, in, w, noise, ride, place);
  place = {1, std::min<Eigen::Index>(ride.controls.size(), wantedSteps)};
  check.input(input);
  endFits(check, ride, wantedSteps);
}

/// The cost so far, up to the wanted one, and the one that was returned.
inline rex::grading::Evidence costsOf(const Eigen::VectorXd& ofSteps, double got) {
  rex::Series sum = rex::grading::wantedCurve("wanted, so far", {0}, {0});
  for (Eigen::Index t = 0; t < ofSteps.size(); ++t)
    sum.add(kTau * static_cast<double>(t + 1), sum.y.back() + ofSteps[t]);
  return {.figures = {{.title = "Cost of rideOf",
                       .xLabel = "time [s]",
                       .yLabel = "cost [1]",
                       .series = {sum},
                       .horizontalLines = {{.at = got, .label = "got", .color = rex::grading::kGotColor}}}}};
}

/// The cost of a ride whose states are right.
inline void costFits(rex::grading::Check& check, const Ride& ride, Eigen::Index steps, double wanted) {
  const Eigen::Index n = ride.controls.size();
  const bool failed = std::abs(ride.states(1, n)) > kLargestAngle;
  const Eigen::Index stood = failed ? n - 1 : n;
  const Eigen::VectorXd ofStates =
      ride.states.row(0).array().square() + 10 * ride.states.row(1).array().square();
  Eigen::VectorXd ofSteps = Eigen::VectorXd::Constant(steps, kCostOfMissing);
  ofSteps.head(stood) = ofStates.segment(1, stood);
  const auto shown = check.show([&] { return costsOf(ofSteps, ride.cost); });
  const double sum = ofSteps.head(stood).sum(), missing = ofSteps.tail(steps - stood).sum();
  // Without a failure these values mean nothing.
  const double since = failed ? sum : std::numeric_limits<double>::quiet_NaN();
  check.near(
      "cost of rideOf", ride.cost, wanted, 1e-6 * (1 + wanted),
      {{"Is the start counted, too?", ofStates.head(stood + 1).sum() + missing},
       {"Is the cost multiplied by kTau?", kTau * wanted},
       {"Does the step that failed cost nothing? It counts as missing.", since + missing - kCostOfMissing},
       {"Is the state of the step that failed counted, too?", since + ofStates[n] + missing}});
}

inline void rideFits(rex::grading::Check& check, Student& student, const Situation& in,
                     const Eigen::VectorXd& w, int steps) {
  const Eigen::Vector4d start(0, check.rng().uniform(-.2, .2), .1 * check.rng().normal(), 0);
  const std::uint64_t seed = check.rng().next();
  check.input(fmt::format("a ride of {} steps, {}", steps, described(in.racer)), {{"start", start}});
  const Eigen::MatrixXd noise = noiseOf(in, seed, steps);
  const Ride ride = student.rideOf(w, start, noise, in.racer, in.sensors);
  const rex::Rollouts wanted = rex::racerRollouts(w, {{start, seed}}, optionsOf(in, steps));
  const Eigen::Index n = ride.controls.size();
  check.atLeast("number of controls of rideOf", static_cast<double>(n), 1);
  check.atMost("number of controls of rideOf", static_cast<double>(n), steps);
  check.shape("states of rideOf", ride.states, 4, n + 1);
  check.near("first state of rideOf", ride.states.col(0), start, 0);
  rideFollows(check, in, w, noise, ride, std::min(steps, wanted.steps(0, 0) + 1));
  costFits(check, ride, steps, wanted.cost(0, 0));
}
