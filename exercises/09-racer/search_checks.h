#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "ride_checks.h"

// Part 7: policies, in rides of the library.

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

/// The rides of a search. Counts them; beyond the budget, or if a call makes no sense, none is ridden any
/// more.
class Track {
 public:
  Track(const Situation& in, rex::Rng& rng) : in_(in), rng_(&rng) {}

  Eigen::VectorXd costs(const Eigen::MatrixXd& W, int steps) {
    const bool isFirst = rides_ == 0;
    rides_ += static_cast<double>(W.cols());
    makesSense_ = makesSense_ && W.rows() == kFeatures && W.cols() > 0 && W.allFinite() && steps >= 1 &&
                  steps <= kLongestRide;
    if (!makesSense_ || rides_ > kBudget)
      return Eigen::VectorXd::Constant(W.cols(), kCostOfMissing * kLongestRide);
    if (isFirst) ratesAreFar_ = W.middleRows(5, 4).norm() > .3 * W.middleRows(1, 4).norm();
    const std::vector<rex::Trial> trial{{Eigen::Vector4d(0, rng_->uniform(-.2, .2), 0, 0), rng_->next()}};
    return rex::racerRollouts(W, trial, optionsOf(in_, steps)).cost.row(0).transpose();
  }
  double rides() const { return rides_; }
  bool makesSense() const { return makesSense_; }

  /// What could be wrong with the search; empty if nothing comes to mind.
  std::string question() const {
    if (rides_ < kBudget / 4.) return fmt::format("Are only {} of {} rides used?", rides_, kBudget);
    if (ratesAreFar_)
      return "Are the weights of rates searched as far from zero as those of readings? Rates are a hundred "
             "times as large.";
    return "";
  }

 private:
  Situation in_;
  rex::Rng* rng_;
  double rides_ = 0;
  bool makesSense_ = true, ratesAreFar_ = false;
};

/// The weights of a search, and what could be wrong with it.
struct Found {
  Eigen::VectorXd w;
  std::string question;
};

inline Found searched(rex::grading::Check& check, Student& student, const Situation& in) {
  Track track(in, check.rng());
  const rex::remote::SplitRng given = check.split(7);
  check.input(fmt::format("noise {:.3g}, {}", in.noise, described(in.racer)), {{"budget", kBudget}});
  const Eigen::VectorXd w = student.searchedPolicy(
      [&](const Eigen::MatrixXd& W, int steps) { return track.costs(W, steps); }, kBudget, given);
  check.that("searchedPolicy calls rides() with 27 finite weights in each column, and with 1 to 500 steps",
             track.makesSense());
  {
    const auto calls = check.ask("Are calls counted instead of rides? A call with m columns uses m rides.");
    check.atMost("number of rides that searchedPolicy uses", track.rides(), kBudget);
  }
  const auto none = check.ask("Is nothing searched? Weights found elsewhere do not count.");
  check.atLeast("number of rides that searchedPolicy uses", track.rides(), 1000);
  check.shape("weights of searchedPolicy", w, kFeatures, 1);
  return {w, track.question()};
}

inline std::vector<rex::Trial> unseenTrials(int count, rex::Rng& rng) {
  std::vector<rex::Trial> trials;
  for (int i = 0; i < count; ++i) trials.push_back({{0, rng.uniform(-.2, .2), 0, 0}, rng.next()});
  return trials;
}

/// One value of each ride, in ascending order.
inline rex::Figure sorted(const std::string& title, Eigen::VectorXd values, const std::string& yLabel) {
  std::sort(values.begin(), values.end());
  rex::Series points = rex::grading::gotCurve("got");
  points.y.assign(values.begin(), values.end());
  points.style = rex::SeriesStyle::kPoints;
  points.marker = rex::Marker::kDot;
  return {.title = title, .xLabel = "number of rides with less", .yLabel = yLabel, .series = {points}};
}

/// One ride of a policy, beside one under the gain of part 3, which knows the state, at its end.
inline rex::grading::Evidence seen(const Situation& in, const Eigen::VectorXd& w, const rex::Trial& trial) {
  const Eigen::MatrixXd noise = noiseOf(in, trial.seed, kLongestRide);
  const Eigen::Vector4d K = bestGain(in.racer, Eigen::Vector4d(1, 10, 0, 0).asDiagonal(), 1);
  const Pair rides{
      rightRide(in, w, trial.start, noise),
      ridden(
          trial.start, kLongestRide, [&](const Eigen::Vector4d& x) { return limited(-K.dot(x)); },
          [&](const Eigen::Vector4d& x, double u, Eigen::Index t) { return kicked(in, x, u, noise.col(t)); }),
      "u = -K x"};
  const Eigen::Index end = rides.got.cols() - 1;
  rex::grading::Evidence evidence = sideBySide(in, rides, end);
  evidence.figures = {rowOf(rides, 0, end), rowOf(rides, 1, end)};
  for (rex::Figure& figure : evidence.figures) figure.title = "The worst ride, and one that knows the state";
  return evidence;
}

/// Beyond it, small readings already ask for more than the motor gives.
inline constexpr double kLargestWeight = 100;

/// What the points do not tell: rides of 100 s, beyond the 5 s that were searched.
inline void ridesOn(rex::grading::Check& check, const Situation& in, const Eigen::VectorXd& w) {
  constexpr int kRides = 10, kSteps = 10000;
  const rex::Rollouts rides = rex::racerRollouts(w, unseenTrials(kRides, check.rng()), optionsOf(in, kSteps));
  const Eigen::VectorXd seconds = kTau * rides.steps.col(0).cast<double>();
  const double largest = w.cwiseAbs().maxCoeff();
  std::string text = fmt::format("Of {} rides of 100 s, {} last to the end", kRides,
                                 (rides.steps.array() == kSteps).count());
  if (seconds.minCoeff() < kTau * kSteps)
    text += fmt::format("; the shortest lasts {:.0f} s, as drift.png shows", seconds.minCoeff());
  if (largest > kLargestWeight)
    text += fmt::format(". The largest weight is {:.3g}: the motor mostly gives full torque, to and fro",
                        largest);
  check.remark(text + ".");
  check.record("cost of ten rides of 100 s, per step", rides.cost.mean() / kSteps);
}

/// Returns the weights.
inline Eigen::VectorXd searchSucceeds(rex::grading::Check& check, Student& student, const Situation& in) {
  const auto [w, question] = searched(check, student, in);
  const auto asked = check.ask(question);
  const int steps = kLongestRide, wanted = 95;
  const std::vector<rex::Trial> trials = unseenTrials(100, check.rng());
  const rex::Rollouts rides = rex::racerRollouts(w, trials, optionsOf(in, steps));
  const auto shown = check.show([&, weights = w] {
    Eigen::Index shortest = 0;
    rides.steps.col(0).minCoeff(&shortest);
    rex::grading::Evidence evidence = seen(in, weights, trials[static_cast<std::size_t>(shortest)]);
    rex::Figure lengths = sorted("How long 100 rides last", rides.steps.col(0).cast<double>(), "steps");
    lengths.horizontalLines = {{.at = 1. * steps, .label = "the whole ride"}};
    lengths.verticalLines = {{.at = 100. - wanted, .label = "wanted: the whole ride from here on"}};
    evidence.figures.insert(evidence.figures.begin(), lengths);
    return evidence;
  });
  check.atLeast(fmt::format("number of 100 other rides with searchedPolicy that last {} steps", steps),
                static_cast<double>((rides.steps.array() == steps).count()), wanted);
  return w;
}
