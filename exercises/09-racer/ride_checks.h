#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "control/racer_rollouts.h"
#include "course/racer_pictures.h"
#include "grading/evidence_parts.h"
#include "learning/sensor_history.h"
#include "racer_checks.h"

// Parts 4 to 6: features, rides and policies, against the library's.

/// The world in which a policy rides.
struct Situation {
  RacerModel racer{};
  rex::RacerSensors sensors{};
  double noise = kNoise;
  Eigen::VectorXd wiring = Eigen::VectorXd::Ones(kFeatures);  ///< factors of a policy's weights
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

/// Racers that differ somewhat from that of the sheet.
inline Situation similarSituation(rex::Rng& rng) {
  Situation in;
  const auto change = [&](double& number) { number *= rng.uniform(.85, 1.2); };
  for (double* number : {&in.racer.r, &in.racer.l, &in.racer.mA, &in.racer.mB, &in.racer.IA, &in.racer.IB,
                         &in.sensors.phi, &in.sensors.kappa, &in.sensors.gyroBias})
    change(*number);
  in.noise = rng.uniform(.08, .12);
  return in;
}

/// The same with motor and sensors wired either way round, accelerometers at any angle, and sensors with
/// larger units, so that weights found elsewhere are of no use, even if all signs are tried: of 40 such
/// policies, 5 balance and none stays. With smaller units, a search over all 27 features would sometimes
/// fail.
inline Situation rewired(Situation in, rex::Rng& rng) {
  const auto sign = [&] { return rng.uniform(0, 1) < .5 ? -1. : 1.; };
  in.sensors.phi = rng.uniform(-std::numbers::pi, std::numbers::pi);
  const double motor = in.wiring[0] = sign();
  for (int sensor = 0; sensor < 4; ++sensor) {
    const double both = motor * sign() * std::pow(3, rng.uniform(-1, 0));
    for (const int block : {1, 5, 9, 13, 17, 21}) in.wiring[block + sensor] = both;
  }
  return in;  // the remembered controls change sign with the motor
}

// Features.

inline void featuresFit(rex::grading::Check& check, Student& student, double tau, int readings) {
  rex::SensorHistory history({.sensors = 4,
                              .timeStep = tau,
                              .constant = true,
                              .derivatives = true,
                              .averages = {.5, .9},
                              .pastActions = 2});
  Eigen::VectorXd before;
  double u = check.rng().normal();
  for (int t = 0; t < readings; ++t) {
    check.input(fmt::format("reading {} of {}, one in {:.3g} s", t + 1, readings, tau));
    const Eigen::Vector4d y = check.rng().normalVector(4);
    const Eigen::VectorXd wanted = history.observe(y), got = student.featuresAt(y, before, u, tau);
    check.shape("features", got, kFeatures, 1);
    const auto shown = check.show([&] {
      return rex::grading::Evidence{.figures = {rex::grading::comparison("features 0 - 26", got, wanted)}};
    });
    for (const auto& [name, begin, count] : {std::tuple{"feature 0", 0, 1},
                                             {"features 1 - 4", 1, 4},
                                             {"features 5 - 8", 5, 4},
                                             {"features 9 - 16", 9, 8},
                                             {"features 17 - 24", 17, 8},
                                             {"features 25 and 26", 25, 2}})
      check.near(name, got.segment(begin, count), wanted.segment(begin, count),
                 1e-10 * (1 + wanted.cwiseAbs().maxCoeff()));
    before = wanted;
    u = check.rng().normal();
    history.act(u);
  }
}

// Rides.

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

/// The states of a ride under u(x) until it fails; step t leads to after(x, u, t).
template <class Control, class Step>
Eigen::MatrixXd ridden(const Eigen::Vector4d& start, Eigen::Index steps, const Control& u,
                       const Step& after) {
  Eigen::MatrixXd ride(4, steps + 1);
  ride.col(0) = start;
  Eigen::Index t = 0;
  for (; t < steps && std::abs(ride(1, t)) <= kLargestAngle; ++t)
    ride.col(t + 1) = after(ride.col(t), u(ride.col(t)), t);
  return ride.leftCols(t + 1);
}

/// The state after a step with that noise.
inline Eigen::Vector4d kicked(const Situation& in, const Eigen::Vector4d& x, double u,
                              const Eigen::Vector2d& noise) {
  Eigen::Vector4d next = dynamicsOf(in.racer).rungeKuttaStep(x, u, kTau);
  next.tail<2>() += noise;
  return next;
}

/// The ride of a policy according to the equations.
inline Eigen::MatrixXd statesOf(const Situation& in, const Eigen::VectorXd& w, const Eigen::Vector4d& start,
                                const Eigen::MatrixXd& noise) {
  rex::RacerPolicy policy(optionsOf(in, 1).features, in.wiring.cwiseProduct(w), kTau, kLargestControl);
  return ridden(
      start, noise.cols(),
      [&](const Eigen::Vector4d& x) { return policy.control(in.sensors.measured(x, in.racer.r)); },
      [&](const Eigen::Vector4d& x, double u, Eigen::Index t) { return kicked(in, x, u, noise.col(t)); });
}

/// Two rides as a film of two racers that opens at step `moment`.
inline rex::grading::Evidence sideBySide(const Situation& in, const Eigen::MatrixXd& got,
                                         const Eigen::MatrixXd& wanted, const std::string& title,
                                         Eigen::Index moment) {
  using rex::grading::gotCurve, rex::grading::wantedCurve;
  const Eigen::Index count = std::max(got.cols(), wanted.cols()), stride = 1 + count / 400;
  const auto at = [](const Eigen::MatrixXd& states, Eigen::Index k) -> Eigen::Vector4d {
    return states.col(std::min(k, states.cols() - 1));
  };
  rex::Film film;
  for (Eigen::Index k = 0; k < count; k += stride) {
    Eigen::Matrix4Xd both(4, 2);
    both << at(got, k), at(wanted, k);
    film.push_back(
        {kTau * static_cast<double>(k),
         pictureOf(rex::RacerView{.x = both, .names = {"got", "wanted"}, .dynamics = dynamicsOf(in.racer)})});
  }
  const auto curve = [](const Eigen::MatrixXd& states, Eigen::Index row, auto make, const char* label) {
    std::vector<double> times, values;
    for (Eigen::Index k = 0; k < states.cols(); ++k) {
      times.push_back(kTau * static_cast<double>(k));
      values.push_back(states(row, k));
    }
    return make(label, times, values);
  };
  const double time = kTau * static_cast<double>(moment);
  rex::Figure figure{.title = title, .xLabel = "time [s]", .yLabel = "x [m], theta [rad]"};
  figure.series = {curve(got, 0, gotCurve, "x, got"), curve(got, 1, gotCurve, "theta, got"),
                   curve(wanted, 0, wantedCurve, "x and theta, wanted"), curve(wanted, 1, wantedCurve, "")};
  figure.series[1].color = rex::Color{.84f, .37f, 0};
  figure.verticalLines = {rex::grading::wrongFrom(time)};
  return {.figures = {figure}, .film = film, .view = {1.2, -1.6, .7}, .moment = time};
}

/// `t` is the step being checked.
inline void statesFit(rex::grading::Check& check, const Situation& in, const Eigen::VectorXd& w,
                      const Eigen::MatrixXd& noise, const Ride& ride, Eigen::Index& t) {
  rex::RacerPolicy policy(optionsOf(in, 1).features, w, kTau, kLargestControl);
  for (; t < ride.controls.size(); ++t) {
    const Eigen::Vector4d x = ride.states.col(t);
    check.input(fmt::format("step {} of {}, from {}", t + 1, noise.cols(), described(in.racer, x)));
    check.near("control, from the readings so far", ride.controls[t],
               policy.control(in.sensors.measured(x, in.racer.r)), 1e-7, "N m");
    const Eigen::Vector4d next = kicked(in, x, ride.controls[t], noise.col(t));
    check.near("state after a step", ride.states.col(t + 1), next, 1e-8 * (1 + next.norm()));
  }
}

/// Checks that the ride has the states and the length that follow from the equations.
inline void rideFollows(rex::grading::Check& check, const Situation& in, const Eigen::VectorXd& w,
                        const Eigen::Vector4d& start, const Eigen::MatrixXd& noise, const Ride& ride,
                        int wantedSteps) {
  const Eigen::Index steps = noise.cols(), ridden = ride.controls.size();
  Eigen::Index t = 0;
  const auto shown = check.show([&] {
    const Eigen::MatrixXd right = statesOf(in, w, start, noise);
    const Eigen::Index moment = std::min({t + 1, ridden, right.cols() - 1});
    return sideBySide(in, ride.states, right, "The ride until its end", moment);
  });
  statesFit(check, in, w, noise, ride, t);
  check.input(fmt::format("{} steps from theta {:.4g}", steps, start[1]));
  check.near("number of steps, including the one that failed", static_cast<double>(ridden), wantedSteps, 0);
}

inline void rideFits(rex::grading::Check& check, Student& student, const Situation& in,
                     const Eigen::VectorXd& w, int steps) {
  const Eigen::Vector4d start(0, check.rng().uniform(-.2, .2), .1 * check.rng().normal(), 0);
  const std::uint64_t seed = check.rng().next();
  check.input(fmt::format("{} steps from theta {:.4g}", steps, start[1]));
  const Eigen::MatrixXd noise = noiseOf(in, seed, steps);
  const Ride ride = student.rideOf(w, start, noise, in.racer, in.sensors);
  const rex::Rollouts wanted = rex::racerRollouts(w, {{start, seed}}, optionsOf(in, steps));
  const Eigen::Index ridden = ride.controls.size();
  check.that("at least one step, and no more than there is noise for", ridden >= 1 && ridden <= steps);
  check.shape("states", ride.states, 4, ridden + 1);
  check.near("start", ride.states.col(0), start, 0);
  rideFollows(check, in, w, start, noise, ride, std::min(steps, wanted.steps(0, 0) + 1));
  check.near("cost", ride.cost, wanted.cost(0, 0), 1e-6 * (1 + wanted.cost(0, 0)));
}

// Policies.

/// The rides of a search. Counts them; beyond the budget, or if a call makes no sense, none is ridden any
/// more.
class Track {
 public:
  Track(const Situation& in, rex::Rng& rng) : in_(in), rng_(&rng) {}

  Eigen::VectorXd costs(const Eigen::MatrixXd& W, int steps) {
    rides_ += static_cast<double>(W.cols());
    makesSense_ = makesSense_ && W.rows() == kFeatures && W.cols() > 0 && W.allFinite() && steps >= 1 &&
                  steps <= kLongestRide;
    if (!makesSense_ || rides_ > kBudget)
      return Eigen::VectorXd::Constant(W.cols(), kCostOfMissing * kLongestRide);
    const std::vector<rex::Trial> trial{{Eigen::Vector4d(0, rng_->uniform(-.2, .2), 0, 0), rng_->next()}};
    return rex::racerRollouts(in_.wiring.asDiagonal() * W, trial, optionsOf(in_, steps))
        .cost.row(0)
        .transpose();
  }
  double rides() const { return rides_; }
  bool makesSense() const { return makesSense_; }

 private:
  Situation in_;
  rex::Rng* rng_;
  double rides_ = 0;
  bool makesSense_ = true;
};

inline Eigen::VectorXd searched(rex::grading::Check& check, Student& student, const Situation& in) {
  Track track(in, check.rng());
  rex::Rng given = check.rng().split(7);
  check.input(fmt::format("{} rides, noise {:.3g}, {}", kBudget, in.noise, described(in.racer)));
  const Eigen::VectorXd w = student.searchedPolicy(
      [&](const Eigen::MatrixXd& W, int steps) { return track.costs(W, steps); }, kBudget, given);
  check.that("policies have 27 finite weights, and rides 1 to 500 steps", track.makesSense());
  check.atMost("rides of the search", track.rides(), kBudget);
  check.shape("weights", w, kFeatures, 1);
  return w;
}

inline std::vector<rex::Trial> unseenTrials(int count, rex::Rng& rng) {
  std::vector<rex::Trial> trials;
  for (int i = 0; i < count; ++i) trials.push_back({{0, rng.uniform(-.2, .2), 0, 0}, rng.next()});
  return trials;
}

/// One of the rides of a policy, beside one under the gain of part 3, which knows the state. Opens at the
/// first step with a high cost, or at the end.
inline rex::grading::Evidence seen(const Situation& in, const Eigen::VectorXd& w, const rex::Trial& trial,
                                   int steps) {
  const Eigen::MatrixXd noise = noiseOf(in, trial.seed, steps), got = statesOf(in, w, trial.start, noise);
  const Eigen::Vector4d K = bestGain(in.racer, Eigen::Vector4d(1, 10, 0, 0).asDiagonal(), 1);
  const Eigen::MatrixXd wanted = ridden(
      trial.start, steps, [&](const Eigen::Vector4d& x) { return -K.dot(x); },
      [&](const Eigen::Vector4d& x, double u, Eigen::Index t) { return kicked(in, x, u, noise.col(t)); });
  Eigen::Index moment = std::min<Eigen::Index>(50, got.cols() - 1);  // after the first correction
  while (moment + 1 < got.cols() && got.col(moment).head<2>().cwiseAbs().maxCoeff() < .5) ++moment;
  return sideBySide(in, got, wanted, "The worst ride, and one under u = -K x", moment);
}

inline void searchSucceeds(rex::grading::Check& check, Student& student, const Situation& in) {
  const Eigen::VectorXd w = searched(check, student, in);
  for (const auto& [steps, wanted] : {std::pair{500, 95}, {2000, 80}}) {
    const std::vector<rex::Trial> trials = unseenTrials(100, check.rng());
    const rex::Rollouts rides = rex::racerRollouts(in.wiring.cwiseProduct(w), trials, optionsOf(in, steps));
    const auto shown = check.show([&, last = steps] {
      Eigen::Index shortest = 0;
      rides.steps.col(0).minCoeff(&shortest);
      return seen(in, w, trials[static_cast<std::size_t>(shortest)], last);
    });
    check.atLeast(fmt::format("number of 100 other rides that last {} steps", steps),
                  static_cast<double>((rides.steps.array() == steps).count()), wanted);
  }
}

inline void searchedPolicyStays(rex::grading::Check& check, Student& student, const Situation& in) {
  const Eigen::VectorXd w = searched(check, student, in);
  const int steps = 50000, count = 16;
  const std::vector<rex::Trial> trials = unseenTrials(count, check.rng());
  const rex::Rollouts rides = rex::racerRollouts(in.wiring.cwiseProduct(w), trials, optionsOf(in, steps));
  const auto shown = check.show([&] {
    Eigen::Index dearest = 0;
    rides.cost.col(0).maxCoeff(&dearest);
    return seen(in, w, trials[static_cast<std::size_t>(dearest)], 3000);
  });
  check.atMost("mean cost per step of rides over 50000 steps", rides.cost.sum() / (1. * steps * count), .02);
}
