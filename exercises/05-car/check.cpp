#include "grading/check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "cloud_evidence.h"
#include "corridor_checks.h"
#include "drives.h"
#include "filter_checks.h"
#include "interface.h"
#include "motion_checks.h"
#include "resampling_checks.h"
#include "sensor_checks.h"

using namespace rex;
using grading::Check;
using grading::Group;

namespace {

const double kNever = -std::numeric_limits<double>::infinity();

// The random generators passed to students come from a separate stream: rewinding them does not reveal the
// drive.
Rng generatorsOf(Check& check) { return check.rng().split(7); }

// Part 1.

void movesInTheCorridor(Check& check, Student& student) {
  for (int i = 0; i < 30; ++i) movedCellsFit(check, student, i);
}

void seesInTheCorridor(Check& check, Student& student) {
  for (int i = 0; i < 30; ++i) seenCellsFit(check, student, i);
}

void looksBack(Check& check, Student& student) {
  for (int i = 0; i < 10; ++i) hindsightFits(check, student);
}

// Part 2.

void stepsLikeTheCar(Check& check, Student& student) {
  Rng& rng = check.rng();
  for (int i = 0; i < 20; ++i) {
    const CarWorld world{
        .tau = rng.uniform(0.2, 2), .wheelbase = rng.uniform(1, 4), .landmarks = Eigen::MatrixXd::Zero(2, 1)};
    const Eigen::Vector3d x = randomPose(rng);
    checkStep(check, student, world, x, {rng.uniform(-3, 3), rng.uniform(-1.2, 1.2)});
  }
}

void spreadsInOneStep(Check& check, Student& student) {
  spreadsWell(check, student, .03, .5);
  spreadsWell(check, student, .2, 2);
}

// <hidden>
// Headings are sums of Gaussian numbers, so that the means of their cosines, and of products of these, are
// known exactly: the mean of cos(a + s z) is cos(a) exp(-s^2 / 2).
void driftsAsTheModelSays(Check& check, Student& student) {
  Rng& rng = check.rng();
  CarWorld world = worldWith(2, rng);
  world.dynamicsNoise = rng.uniform(0.05, 0.1);
  world.tau = rng.uniform(0.4, 0.7);
  const int steps = 40, count = 2000;
  const double variance = world.dynamicsNoise * world.dynamicsNoise;
  const Eigen::Vector3d start = randomPose(rng);
  const CarSimulator map = mapOf(world);
  Eigen::VectorXd exact = start;
  Eigen::MatrixXd states = start.replicate(1, count);
  Eigen::MatrixXd noise(3, steps * count);
  std::vector<double> ways, headings;
  for (int t = 0; t < steps; ++t) {
    const Eigen::Vector2d u(rng.uniform(-0.2, 1), rng.uniform(-0.4, 0.4));
    ways.push_back(world.tau * u[0]);
    headings.push_back(exact[2]);
    exact = map.getMeanStateAfterStep(exact, u);
    Moved move{states, student.moved(states, u, world, check.split(rng.next())), states};
    check.shape("states of moved", move.after, 3, count);
    for (auto x : move.still.colwise()) x = map.getMeanStateAfterStep(x, u);
    allMove(check, "moved", move);
    noise.middleCols(t * count, count) = move.noise();
    states = move.after;
  }
  noiseFits(check, "moved", noise, world);
  Eigen::Vector2d mean = start.head<2>();
  double square = 2 * steps * variance;
  for (int s = 0; s < steps; ++s) {
    const auto i = static_cast<std::size_t>(s);
    mean +=
        ways[i] * std::exp(-s * variance / 2) * Eigen::Vector2d(std::cos(headings[i]), std::sin(headings[i]));
    for (int t = 0; t < steps; ++t) {
      const auto k = static_cast<std::size_t>(t);
      square +=
          ways[i] * ways[k] * std::cos(headings[i] - headings[k]) * std::exp(-std::abs(s - t) * variance / 2);
    }
  }
  square -= (mean - start.head<2>()).squaredNorm();
  double spread = 0, turned = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    spread += (states.col(i).head<2>() - mean).squaredNorm() / count;
    turned += std::pow(wrapAngle(states(2, i) - exact[2]), 2) / count;
  }
  check.near("mean position after 40 steps of moved", states.topRows(2).rowwise().mean(), mean,
             kSigmas * std::sqrt(square / count), "m");
  // The standard deviation of a squared distance is at most 1.5 times its mean, that of a squared heading
  // error sqrt(2) times; half of that is left for roots.
  check.near("root mean square distance from the mean position after 40 steps of moved", std::sqrt(spread),
             std::sqrt(square), 1.1 * kSigmas * .75 / std::sqrt(count) * std::sqrt(square), "m");
  const double wide = std::sqrt(steps * variance);
  check.near("standard deviation of the headings after 40 steps of moved", std::sqrt(turned), wide,
             1.1 * kSigmas * std::sqrt(.5 / count) * wide, "rad");
}
// </hidden>

// Part 3.

void seesLandmarks(Check& check, Student& student) {
  for (int i = 0; i < 20; ++i)
    viewFits(check, student, worldWith(1 + i % 5, check.rng()), randomPose(check.rng()));
}

void likelihoodsOfTwo(Check& check, Student& student) {
  seesLandmarks(check, student);
  for (int i = 0; i < 10; ++i) {
    CarWorld world = worldWith(2, check.rng());
    world.observationNoise = i == 0 ? .3 : check.rng().uniform(0.1, 2);
    likelihoodsFit(check, student, world, false);
  }
}

void normalises(Check& check, Student& student) {
  const Eigen::VectorXd logs = check.rng().uniformVector(8, -5, 0);
  for (const double shift : {0., -1e5, 1e4}) {
    check.input("logarithms a + b", {{"a", logs}, {"b", shift}});
    const Eigen::VectorXd shifted = (logs.array() + shift).matrix();
    weightsFit(check, student.weightsOf(shifted), shifted);
  }
  check.input("one logarithm, -3000");
  weightsFit(check, student.weightsOf(Eigen::VectorXd::Constant(1, -3000)), Eigen::VectorXd::Zero(1));
  Eigen::VectorXd half = logs;
  half.tail(4).setConstant(kNever);
  check.input("8 logarithms, half of them -infinity", {{"logarithms", half}});
  weightsFit(check, student.weightsOf(half), half);
  check.input("8 logarithms, all of them -infinity");
  weightsFit(check, student.weightsOf(Eigen::VectorXd::Constant(8, kNever)), Eigen::VectorXd::Zero(8));
}

// <hidden>
// 30 particles, `away` metres from the car, with headings up to `turned` off.
void weighsWell(Check& check, Student& student, const CarWorld& world, double away, double turned) {
  Rng& rng = check.rng();
  const Driven one = drive(world, randomPose(rng), {1, -0.2}, 1, rng);
  Eigen::VectorXd y = one.log.observations[0];
  for (Eigen::Index i = 1; i < y.size() && world.rangeBearing; i += 2) y[i] += 2 * M_PI * (rng.index(9) - 4);
  const Eigen::MatrixXd states = posesAround(one.truth[0], away, turned, 30, rng);
  const Eigen::VectorXd got = student.logLikelihoods(states, y, world);
  logarithmsFit(check, got, world, states, y);
  weightsFit(check, student.weightsOf(got), got);
}

void weighsAnywhere(Check& check, Student& student) {
  for (int i = 0; i < 15; ++i) {
    CarWorld world = worldWith(1 + check.rng().index(8), check.rng());
    world.observationNoise = i % 3 == 0 ? 0.02 : check.rng().uniform(0.1, 5);
    weighsWell(check, student, world, i % 3 == 1 ? 1e4 : 2, 1);
  }
}
// </hidden>

// Part 4.

void sizeFits(Check& check, Student& student, const Eigen::VectorXd& weights, double wanted) {
  check.input("30 particles", {{"weights", weights}});
  check.near("result of effectiveSize", student.effectiveSize(weights), wanted, 1e-9 * wanted,
             {{"Is it the sum of squares? Wanted is one over that.", 1 / wanted},
              {"Is it one over the largest weight?", 1 / weights.maxCoeff()},
              {"Are those with any weight counted?", static_cast<double>((weights.array() > 0).count())},
              {"Is it the number of all particles?", 30},
              {"Are the squares left out?", 1}});
}

void countsWorth(Check& check, Student& student) {
  Rng& rng = check.rng();
  for (int i = 0; i < 10; ++i) {
    // Two groups with equal weights inside each: their effective sizes combine by their shares of the weight.
    const double share = rng.uniform(0.05, 0.95);
    Eigen::VectorXd weights = Eigen::VectorXd::Constant(30, (1 - share) / 20);
    weights.head(10).setConstant(share / 10);
    sizeFits(check, student, weights, 200 / (20 * share * share + 10 * (1 - share) * (1 - share)));
    const int equal = 1 + rng.index(30);
    weights.setZero();
    weights.head(equal).setConstant(1. / equal);
    sizeFits(check, student, weights, equal);
  }
}

void wholePartsForCertain(Check& check, Student& student) {
  Rng& rng = check.rng();
  for (int i = 0; i < 30; ++i) {
    // A question about all particles needs eight of them.
    const int particles = i == 0 ? 10 : (i < 10 ? 8 : 2) + rng.index(32);
    const int count = i < 10 ? particles : 2 * particles - 1;
    const Eigen::VectorXd weights =
        i == 0 ? Eigen::VectorXd::Constant(10, .1) : randomWeights(particles, rng);
    check.input(i == 0 ? "10 particles of equal weight" : "particles with random weights",
                {{"weights", weights}, {"count", count}});
    keepsWholeParts(check, weights, count,
                    childrenOf(check, student, weights, count, check.split(rng.next())));
  }
  drawsFromRng(check, student);
  countsWorth(check, student);
}

void unbiased(Check& check, Student& student) {
  isUnbiased(check, student, (Eigen::VectorXd(6) << 0.05, 0.1, 0.15, 0.2, 0.22, 0.28).finished(), 6, 1500);
}

// <hidden>
void resamplesAnyWeights(Check& check, Student& student) {
  Rng& rng = check.rng();
  for (int i = 0; i < 20; ++i) {
    const int particles = 1 + rng.index(200), count = 1 + rng.index(300);
    Eigen::VectorXd weights = randomWeights(particles, rng);
    if (i % 3 == 0) weights.head(particles / 2).setZero();
    if (i % 5 == 0) weights[particles - 1] += 1000;
    weights /= weights.sum();
    keepsWholeParts(check, weights, count,
                    childrenOf(check, student, weights, count, check.split(rng.next())));
  }
  isUnbiased(check, student, randomWeights(9, rng), 4, 1000);
  isUnbiased(check, student, randomWeights(3, rng), 17, 1000);
}
// </hidden>

// Part 5.

void averages(Check& check, Student& student) {
  Rng& rng = check.rng();
  for (int i = 0; i < 20; ++i) {
    Cloud cloud{posesAround(randomPose(rng), 1, 0, 12, rng), randomWeights(12, rng)};
    const double heading = i % 2 == 0 ? M_PI : rng.uniform(-3, 3);
    for (Eigen::Index k = 0; k < 12; ++k)
      cloud.states(2, k) =
          wrapAngle(heading + rng.uniform(-1, 1)) + (i >= 10 ? 2 * M_PI * (rng.index(5) - 2) : 0);
    meanFits(check, student, cloud);
  }
}

// Equal weights after each step, not only after one that no particle explains, must fail.
void explainsWhatIsSeen(Check& check, Student& student) {
  for (int i = 0; i < 5; ++i) goesThroughAllLines(check, student, false);
  drawsAnew(check, student);
  for (const bool isLost : {true, false, true}) goesThroughAllLines(check, student, isLost);
}

// In 3000 drives the position error was 0.2 m, in the worst drive 0.37 m, and the heading error at most 0.034
// rad. With dead reckoning the heading is off by some 0.3 rad.
void tracks(Check& check, Student& student) {
  CarWorld world;
  world.landmarks = (Eigen::MatrixXd(2, 2) << 10, -6, 8, 12).finished();
  Rng given = generatorsOf(check);
  check.input(
      "the car of the exercise sheet for 200 steps, 100 particles, landmarks at (10, 8) and (-6, 12)");
  for (int i = 0; i < 3; ++i) {
    const Driven driven = drive(world, Eigen::Vector3d::Zero(), {0.1, 0.2}, 200, check.rng());
    follows(check, student, world, driven, 100, given);
  }
}

// <hidden>
// The squared error over the covariance of the particles is chi-square distributed with 3 degrees of freedom:
// half of the values are above 2.37. Their median is hardly affected by the few drives in which a handful of
// particles have all the weight. The root mean square position error is 0.20 m (0.03 m); from the last
// observation alone it is 0.76 m (0.15 m). Dead reckoning, whose clouds are as wide as they should be, too,
// has 1.6 m.
void isConsistent(Check& check, Student& student) {
  Rng& rng = check.rng();
  Rng given = generatorsOf(check);
  const int drives = 21, steps = 30, count = 500;
  std::vector<double> squares;
  double square = 0;
  for (int i = 0; i < drives; ++i) {
    CarWorld world = worldWith(3 + rng.index(3), rng);
    world.dynamicsNoise = rng.uniform(0.02, 0.05);
    world.observationNoise = rng.uniform(0.4, 1);
    const Eigen::Vector2d u(rng.uniform(0.2, 0.8), rng.uniform(-0.4, 0.4));
    const Driven driven = drive(world, randomPose(rng), u, steps, rng);
    Cloud cloud = cloudAt(driven.log.start, count);
    for (std::size_t t = 0; t < driven.truth.size(); ++t) {
      cloud = student.filterStep(cloud, u, driven.log.observations[t], world, check.split(given.next()));
      cloudIsSound(check, cloud, count);
    }
    const Eigen::Vector3d mean = student.meanPose(cloud), error = poseError(mean, driven.truth.back());
    squares.push_back(error.dot(covarianceAround(cloud, mean).inverse() * error));
    square += error.head<2>().squaredNorm() / drives;
  }
  check.atMost("distance of meanPose from the car after 30 steps, root mean square over 21 drives",
               std::sqrt(square), 0.4, "m");
  std::sort(squares.begin(), squares.end());
  const double median = squares[drives / 2];
  check.atLeast("median over 21 drives of the squared error over the covariance of the particles", median,
                0.5);
  check.atMost("median over 21 drives of the squared error over the covariance of the particles", median, 8);
}
// </hidden>

// Part 6.

// What could be wrong with the noise found; empty if nothing comes to mind. One number of several explains a
// result only if the assumption was about right.
std::string questionAbout(double got, double noise, double told) {
  const auto isAbout = [&](double value) { return std::abs(got / value - 1) < .06; };
  if (std::abs(got / told - 1) < 1e-9)
    return "Is it the assumed noise? That may be wrong by a factor of ten.";
  if (isAbout(.98 * noise * noise)) return "Is it the variance? Wanted is a standard deviation.";
  if (told > 2 * noise)
    return got > noise && got < 3 * noise
               ? "Is the filter run once, with the wrong assumption? There is a better one now."
               : "";
  if (told < .5 * noise) return "";
  if (isAbout(.98 * std::sqrt(2.) * noise))
    return "Are the squares divided by the number of landmarks? Each has two coordinates with that noise.";
  if (isAbout(.98 * std::sqrt(2 / M_PI) * noise))
    return "Is it the mean of absolute values? Wanted is the root of the mean square.";
  return "";
}

// The car circles among the landmarks. All of 1600 answers from a filter with 200 particles were within 9 %,
// with a standard deviation of 2 %. Estimates from the residuals are some 4 % low, since a part of the noise
// goes into the states. If the assumed noise is ten times too large, a single round finds 25 to 75 % too
// much.
void findsNoise(Check& check, Student& student, const CarWorld& world, double factor) {
  Rng& rng = check.rng();
  const Eigen::Vector2d u(rng.uniform(0.1, 0.3), rng.uniform(0.15, 0.4));
  const Driven driven = drive(world, randomPose(rng), u, 120, rng);
  CarWorld told = world;
  told.observationNoise *= factor;
  check.input("a drive of 120 steps", {{"assumed noise", told.observationNoise},
                                       {"landmarks", world.landmarks},
                                       {"start", driven.log.start},
                                       {"u", u},
                                       {"dynamicsNoise", world.dynamicsNoise}});
  const double got = student.likelyNoise(driven.log, told, check.split(rng.next()));
  const std::string question = questionAbout(got, world.observationNoise, told.observationNoise);
  const auto asked = check.ask(question);
  check.near("noise found by likelyNoise", got, world.observationNoise, .15 * world.observationNoise, "m");
}

// Factors and noise are random, so that the noise cannot be inferred from the assumed one. The first
// assumption is nearly right.
void noiseOfOneCar(Check& check, Student& student) {
  Rng& rng = check.rng();
  CarWorld world = worldWith(8, rng);
  world.dynamicsNoise = 0.04;
  const double first = rng.uniform() < 0.5 ? -1 : 1;
  for (const double power : {rng.uniform(-.25, .25), first * rng.uniform(0.8, 1),
                             -first * rng.uniform(0.8, 1), rng.uniform(-1, 1)}) {
    world.observationNoise = rng.uniform(0.3, 1);
    findsNoise(check, student, world, std::pow(10, power));
  }
}

// <hidden>
void noiseOfOthers(Check& check, Student& student) {
  Rng& rng = check.rng();
  for (int i = 0; i < 4; ++i) {
    CarWorld world = worldWith(8 + rng.index(5), rng);
    world.dynamicsNoise = i == 0 ? 0.04 : rng.uniform(0.02, 0.04);
    world.observationNoise = i == 0 ? 0.3 : rng.uniform(0.3, 1);
    findsNoise(check, student, world, std::pow(10, i == 0 ? 1 : i == 1 ? -1 : rng.uniform(-1, 1)));
  }
}
// </hidden>

// Part 7.

void bearings(Check& check, Student& student) {
  Rng& rng = check.rng();
  for (int i = 0; i < 20; ++i) {
    CarWorld world = worldWith(2, rng);
    world.rangeBearing = true;
    world.bearingNoise = rng.uniform(0.01, 0.1);
    viewFits(check, student, world, randomPose(rng));
    likelihoodsFit(check, student, world, i % 2 == 1);
  }
}

// <hidden>
// At first the heading of the car is unknown, and its position only roughly known: a few of the 2000
// particles are right. In 1200 drives the final errors were below 0.5 m and 0.15 rad.
void findsItsHeading(Check& check, Student& student) {
  Rng& rng = check.rng();
  for (int i = 0; i < 10; ++i) {
    CarWorld world = worldWith(1 + rng.index(5), rng);
    world.rangeBearing = true;
    world.bearingNoise = rng.uniform(0.01, 0.5);
    world.observationNoise = rng.uniform(0.1, 2);
    viewFits(check, student, world, randomPose(rng));
    weighsWell(check, student, world, 2, 3);
  }
  Rng given = generatorsOf(check);
  for (int i = 0; i < 4; ++i) {
    CarWorld world = worldWith(4, rng);
    world.rangeBearing = true;
    world.bearingNoise = 0.1;
    const Eigen::Vector3d start = randomPose(rng);
    const Driven driven = drive(world, start, {0.5, 0.2}, 20, rng);
    // The cloud is not centred at the car.
    const Eigen::Vector3d off(rng.uniform(-0.7, 0.7), rng.uniform(-0.7, 0.7), rng.uniform(-3, 3));
    Cloud cloud = cloudAt(start + off, 2000);
    for (Eigen::Index k = 0; k < 2000; ++k)
      cloud.states.col(k) += Eigen::Vector3d(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-4, 4));
    for (std::size_t t = 0; t < 20; ++t) {
      const Eigen::VectorXd& y = driven.log.observations[t];
      cloud = stepped(check, student, cloud, driven.log.controls[t], y, world, given);
      check.near("weights of filterStep with rangeBearing", cloud.weights,
                 weightsBeside(logDensities(world, cloud.states, y)), 1e-9);
    }
    const Eigen::Vector3d mean = student.meanPose(cloud), car = driven.truth.back();
    check.shape("result of meanPose", mean, 3, 1);
    check.atMost("distance of meanPose from the car after 20 steps", (mean - car).head<2>().norm(), 1.5, "m");
    check.nearAngle("heading of meanPose after 20 steps", mean[2], car[2], 0.3);
  }
}
// </hidden>

}  // namespace

grading::Checks<Student> checks() {
  return {
      {"corridor-moves", "cells", "a belief that moves", 1, Group::kVisible, movesInTheCorridor},
      {"corridor-sees", "cells", "a door, or none", 1, Group::kVisible, seesInTheCorridor},
      {"corridor-hindsight", "cells", "bonus: what was seen later", 1, Group::kVisible, looksBack},
      {"car-step", "reckoning", "one step of the car", 1, Group::kVisible, stepsLikeTheCar},
      {"car-spread", "reckoning", "every particle has its own noise", 1, Group::kVisible, spreadsInOneStep},
      // <hidden>
      {"car-drift", "reckoning", "dead reckoning spreads as the model says", 1, Group::kHidden,
       driftsAsTheModelSays},
      // </hidden>
      {"likelihood", "weights", "landmarks in the frame of the car, and likelihoods", 1, Group::kVisible,
       likelihoodsOfTwo},
      {"normalised", "weights", "weights from likelihoods, however small", 1, Group::kVisible, normalises},
      // <hidden>
      {"weights-anywhere", "weights", "other worlds and far particles", 1, Group::kHidden, weighsAnywhere},
      // </hidden>
      {"whole-parts", "resampling", "integer parts are certain, and the effective size", 1, Group::kVisible,
       wholePartsForCertain},
      {"unbiased", "resampling", "the rest is fair", 1, Group::kVisible, unbiased},
      // <hidden>
      {"any-weights", "resampling", "other weights and counts", 1, Group::kHidden, resamplesAnyWeights},
      // </hidden>
      {"mean-pose", "filter", "the mean of a cloud", 1, Group::kVisible, averages},
      {"filter-step", "filter", "resample, move, weigh, also if no particle explains the observation", 1,
       Group::kVisible, explainsWhatIsSeen},
      {"tracks", "filter", "the filter follows the car", 1, Group::kVisible, tracks},
      // <hidden>
      {"consistent", "filter", "other worlds: errors as large as the cloud is wide", 1, Group::kHidden,
       isConsistent},
      // </hidden>
      {"noise", "noise", "finding the noise from an assumption up to ten times too large or too small", 1,
       Group::kVisible, noiseOfOneCar},
      // <hidden>
      {"noise-elsewhere", "noise", "other noise in other worlds", 1, Group::kHidden, noiseOfOthers},
      // </hidden>
      {"bearings", "bearings", "distances and bearings", 1, Group::kVisible, bearings},
      // <hidden>
      {"finds-heading", "bearings", "a car that does not know its heading", 1, Group::kHidden,
       findsItsHeading},
      // </hidden>
  };
}
