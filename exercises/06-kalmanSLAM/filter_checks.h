#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "belief_checks.h"
#include "belief_evidence.h"
#include "interface.h"

// Part 2: the extended Kalman filter.

inline Eigen::MatrixXd stepNoiseOf(const CarSetup& car) {
  return car.dynamicsNoise * car.dynamicsNoise * unitMatrix(3);
}

// The predicted belief, with the library's motion model and its derivative at the old mean.
inline Belief movedOn(const CarSetup& car, const Belief& belief, const Eigen::Vector2d& u) {
  const auto model = rex::CarSimulator::withoutPlaces(0, optionsOf(car));
  return {model.getMeanStateAfterStep(belief.mean, u),
          sum(carried(model.getStateJacobian(belief.mean, u), belief.covariance), stepNoiseOf(car))};
}

inline void predicts(rex::grading::Check& check, Student& student, const CarSetup& car) {
  const Belief belief{randomState(check.rng()), randomCovariance(check.rng(), 3)};
  const Eigen::Vector2d u = randomControl(check.rng());
  check.input(described(car), {{"mean", belief.mean}, {"covariance", belief.covariance}, {"u", u}});
  const Belief wanted = movedOn(car, belief, u);
  const auto model = rex::CarSimulator::withoutPlaces(0, optionsOf(car));
  const Eigen::MatrixXd &S = belief.covariance, A = model.getStateJacobian(belief.mean, u),
                        after = model.getStateJacobian(wanted.mean, u), Q = stepNoiseOf(car);
  const auto with = [&](const Eigen::MatrixXd& covariance) { return Belief{wanted.mean, covariance}; };
  sameBelief(check, {.name = "predicted"}, student.predicted(car, belief, u), wanted, 1e-9,
             {{"Is Q subtracted?", with(sum(wanted.covariance, Q, -2))},
              {"Is A left out?", with(sum(S, Q))},
              {"Is A transposed on the wrong side?", with(sum(carried(transposed(A), S), Q))},
              {"Is the covariance multiplied by A from one side only?", with(sum(product(A, S), Q))},
              {"Is A taken at the mean after the step? It is that of the mean before.",
               with(sum(carried(after, S), Q))},
              {"Is Q added before the step, and moved along by A?", with(carried(A, sum(S, Q)))}});
}

/// An observation of what a belief is about.
struct Observation {
  Eigen::VectorXd gap;
  Eigen::MatrixXd C, W;
};

inline Belief informed(const Belief& belief, const Observation& seen) {
  return informed(belief, seen.gap, seen.C, seen.W);
}

/// Mistakes in the correction itself.
inline std::vector<WrongBelief> wrongCorrections(const Belief& belief, const Observation& seen,
                                                 const Belief& wanted) {
  const Eigen::Index n = belief.mean.size(), m = seen.gap.size();
  const Eigen::MatrixXd &S = belief.covariance, &C = seen.C, Ct = transposed(C),
                        gain = product(product(wanted.covariance, Ct), rex::inverse(seen.W)),
                        left = sum(unitMatrix(static_cast<int>(n)), product(gain, C), -1),
                        toMean = product(gain, seen.gap), spread = carried(C, S);
  const auto correctedBy = [&](const Eigen::MatrixXd& K) {
    return Belief{sum(belief.mean, product(K, seen.gap)), sum(S, product(K, product(C, S)), -1)};
  };
  std::vector<WrongBelief> wrong{
      {"Is the correction subtracted from the mean?", {sum(belief.mean, toMean, -1), wanted.covariance}},
      {"Is the covariance made larger? What is observed becomes more certain.",
       {wanted.mean, sum(sum(S, S), wanted.covariance, -1)}},
      {"Is K W K^T left out of Joseph's form?", {wanted.mean, carried(left, S)}},
      {"Is only the mean corrected?", {wanted.mean, S}},
      {"Is only the covariance corrected?", {belief.mean, wanted.covariance}}};
  if (n == m) {
    const Eigen::MatrixXd other = transposed(gain);
    wrong.push_back({"Is K transposed?", correctedBy(other)});
  }
  if (m <= n) {
    const Eigen::MatrixXd exact = product(product(S, Ct), rex::inverse(spread));
    wrong.push_back({"Is W left out of K, as if the observation were exact?", correctedBy(exact)});
  }
  return wrong;
}

inline void corrects(rex::grading::Check& check, Student& student) {
  check.forEachCase(10, [&](int i) {
    rex::Rng& rng = check.rng();
    const int n = 1 + (i + 1) % 6, m = 1 + rng.index(6);
    const Belief belief{rng.normalVector(n), randomCovariance(rng, n)};
    const Observation seen{rng.normalVector(m), rng.normalVector(m * n).reshaped(m, n),
                           randomCovariance(rng, m)};
    check.input("a random belief and observation", {{"mean", belief.mean},
                                                    {"covariance", belief.covariance},
                                                    {"gap", seen.gap},
                                                    {"C", seen.C},
                                                    {"W", seen.W}});
    const Belief wanted = informed(belief, seen);
    sameBelief(check, {.name = "corrected", .isOfCar = false},
               student.corrected(belief, seen.gap, seen.C, seen.W), wanted, 1e-8,
               wrongCorrections(belief, seen, wanted));
  });
}

// Observations a thousand times better than the belief: a millionth of its covariance remains.
inline void staysACovariance(rex::grading::Check& check, Student& student) {
  rex::Rng& rng = check.rng();
  Belief belief{rng.normalVector(6), sum(unitMatrix(6), randomCovariance(rng, 6), 10)};
  for (int i = 1; i <= 20; ++i) {
    const Observation seen{1e-3 * rng.normalVector(3), rng.normalVector(18).reshaped(3, 6),
                           1e-6 * unitMatrix(3)};
    check.input(fmt::format("observation {} of 20, with standard deviations of 0.001", i),
                {{"mean", belief.mean}, {"covariance", belief.covariance}, {"gap", seen.gap}, {"C", seen.C}});
    const Belief got = student.corrected(belief, seen.gap, seen.C, seen.W), wanted = informed(belief, seen);
    check.shape("mean of corrected", got.mean, 6, 1);
    check.shape("covariance of corrected", got.covariance, 6, 6);
    const auto shown = check.show([&] { return beliefSeen(got, wanted, false); });
    check.near("covariance of corrected", got.covariance, wanted.covariance,
               1e-4 * wanted.covariance.cwiseAbs().maxCoeff());
    requireCovariance(check, "corrected", got.covariance);
    belief = got;
  }
}

/// Landmarks around a belief about a car, and their sightings.
struct Surroundings {
  Eigen::MatrixXd landmarks;
  Eigen::VectorXd y;
};

/// What is seen from the mean of a belief instead of what was expected, and its derivative there.
inline Observation seenAround(const CarSetup& car, const Surroundings& around, const Eigen::VectorXd& mean) {
  const Eigen::VectorXd stacked = around.landmarks.reshaped(), expected = seenFrom(car, mean, stacked);
  const auto gap = [&](const Eigen::VectorXd& z) { return gapsOf(car, seenFrom(car, z, stacked), expected); };
  return {gapsOf(car, around.y, expected), derivative(gap, mean), noiseOf(car, around.landmarks.cols())};
}

inline std::vector<WrongBelief> wrongTracking(const CarSetup& car, const Surroundings& around,
                                              const Belief& before, const Belief& moved,
                                              const Belief& wanted) {
  const Observation here = seenAround(car, around, moved.mean), old = seenAround(car, around, before.mean);
  const Observation alone{here.gap.head(2), here.C.topRows(2), here.W.topLeftCorner(2, 2)};
  Observation unwrapped = here;
  unwrapped.gap = around.y - seenFrom(car, moved.mean, around.landmarks.reshaped());
  return {{"Are the sightings compared with the view from the mean before the step?",
           informed(moved, {old.gap, here.C, here.W})},
          {"Are the sightings compared with the view from the mean before the step, and is C taken there?",
           informed(moved, old)},
          {"Is the step left out? The car moves before it sees.", informed(before, old)},
          {"Are the sightings left out?", moved},
          {"Is only the first landmark used?", informed(moved, alone)},
          {"Are differences of bearings not wrapped? viewGap does it.", informed(moved, unwrapped)},
          {"Is the expected view subtracted the wrong way round?",
           {sum(sum(moved.mean, moved.mean), wanted.mean, -1), wanted.covariance}}};
}

// If several landmarks are seen, the gaps are a millionth of the usual size: processing landmarks one by one
// and linearising again for each is not wrong either, and leads to the same result. A single landmark with a
// bearing is expected to the left of straight behind the car, and seen to the right of it.
inline void tracksOneStep(rex::grading::Check& check, Student& student, const CarSetup& car, int landmarks) {
  rex::Rng& rng = check.rng();
  const Belief belief{randomState(rng), randomCovariance(rng, 3)};
  const Eigen::Vector2d u = randomControl(rng);
  const Belief moved = movedOn(car, belief, u);
  const double size = landmarks > 1 ? 1e-6 : 1;
  Surroundings around{Eigen::MatrixXd(2, landmarks), {}};
  for (int i = 0; i < landmarks; ++i) around.landmarks.col(i) = randomLandmark(rng, moved.mean);
  Eigen::VectorXd gap = size * noiseOf(car, landmarks).cwiseSqrt() * rng.normalVector(2 * landmarks);
  if (car.rangeBearing && landmarks == 1) {
    around.landmarks.col(0) = placeBehind(rng, moved.mean);
    gap[1] = std::abs(gap[1]) + 2e-3;
  }
  around.y = seenFrom(car, moved.mean, around.landmarks.reshaped()) + gap;
  around.y = gapsOf(car, around.y, Eigen::VectorXd::Zero(2 * landmarks));  // wrapped
  check.input(described(car), {{"mean", belief.mean},
                               {"covariance", belief.covariance},
                               {"u", u},
                               {"landmarks", around.landmarks},
                               {"y", around.y}});
  const Belief got = student.tracked(car, belief, u, around.landmarks, around.y),
               wanted = informed(moved, seenAround(car, around, moved.mean));
  sameBelief(check, {.name = "tracked"}, got, wanted, 1e-6,
             wrongTracking(car, around, belief, moved, wanted));
  if (landmarks > 1)
    check.near("mean of tracked, after gaps of micrometres", moved.mean + gapOf(got.mean, moved.mean),
               moved.mean + gapOf(wanted.mean, moved.mean), 1e-9);
}

// The quality of a filter over runs of equal length, step by step: sums of squared position errors [m^2] and
// of squared errors relative to the covariance (3 numbers).
struct Tracking {
  std::vector<double> position{}, squared{};
  int count = 0;
  TrackedRun worst{};  // shown
};

inline void trackRun(rex::grading::Check& check, Student& student, const CarRun& run, Tracking& total) {
  rex::Rng& rng = check.rng();
  const Eigen::Vector3d deviations(0.3, 0.3, 0.1);
  const Eigen::Vector3d start = run.states[0] + deviations.cwiseProduct(rng.normalVector(3));
  Belief belief{start, deviations.cwiseAbs2().asDiagonal()};
  const std::size_t T = run.controls.size();
  total.position.resize(T);
  total.squared.resize(T);
  TrackedRun tracked{.run = run};
  for (std::size_t t = 0; t < T; ++t) {
    belief = student.tracked(run.car, belief, run.controls[t], run.landmarks, run.sightings[t]);
    requireBelief(check, "tracked", belief, 3);
    const Eigen::Vector3d error = gapOf(belief.mean, run.states[t + 1]);
    tracked.beliefs.push_back(belief);
    tracked.error = std::max(tracked.error, error.head(2).norm());
    total.position[t] += error.head(2).squaredNorm();
    total.squared[t] += squaredError(error, belief.covariance);
  }
  ++total.count;
  if (tracked.error > total.worst.error) total.worst = std::move(tracked);
}

// Over 1000 seeds, the mean of squared errors is 3.03 with a standard deviation of 0.29 for the script's car,
// and 3.01 with 0.22 for fast ones. As means of many, they are gamma distributed, and exceed the bounds with
// probabilities below 1e-5. The position errors are 0.18 (0.014) m and 0.12 (0.006) m.
inline void requireTracking(rex::grading::Check& check, const Tracking& total, double mostError, double least,
                            double most) {
  const std::size_t T = total.position.size(), half = T / 2;
  Eigen::VectorXd errors(T), squares(T);
  for (std::size_t t = 0; t < T; ++t) {
    errors[static_cast<Eigen::Index>(t)] = std::sqrt(total.position[t] / total.count);
    squares[static_cast<Eigen::Index>(t)] = total.squared[t] / total.count;
  }
  {
    const auto shown = check.show([&] {
      return trackSeen(total.worst,
                       {.title = "Position error of all runs",
                        .yLabel = "root mean square [m]",
                        .horizontalLines = {{.at = mostError, .label = "at most, in the second half"}}},
                       errors);
    });
    const double mean = std::sqrt(errors.tail(static_cast<Eigen::Index>(T - half)).squaredNorm() /
                                  static_cast<double>(T - half));
    check.atMost("root mean square distance of tracked from the car, in the second half of the runs", mean,
                 mostError, "m");
  }
  const double squared =
      (squares[static_cast<Eigen::Index>(T) - 1] + squares[static_cast<Eigen::Index>(half)]) / 2;
  const auto shown = check.show([&] {
    return trackSeen(total.worst,
                     {.title = "Squared errors, relative to the covariance",
                      .yLabel = "mean over runs",
                      .horizontalLines = {{.at = most, .label = "at most, on average"},
                                          {.at = least, .label = "at least, on average"}}},
                     squares);
  });
  const auto small =
      check.ask("Is the covariance too small? The errors are larger than it says.", squared > most);
  const auto large = check.ask(
      "Is the covariance too large? The errors are smaller than it says. Are Q and W built of deviations "
      "instead of their squares?",
      squared < least);
  const char* property = "squared error of tracked relative to its covariance, on average (3 expected)";
  check.atMost(property, squared, most);
  check.atLeast(property, squared, least);
}
