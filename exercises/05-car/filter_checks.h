#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <string>

#include "sensor_checks.h"

// Part 5: the filter, against what holds for every correct one.

inline void cloudIsSound(rex::grading::Check& check, const Cloud& cloud, Eigen::Index count) {
  check.shape("states of filterStep", cloud.states, 3, count);
  check.shape("weights of filterStep", cloud.weights, count, 1);
  check.atLeast("smallest weight of filterStep", cloud.weights.minCoeff(), 0);
  check.near("sum of the weights of filterStep", cloud.weights.sum(), 1, 1e-9);
}

inline void meanFits(rex::grading::Check& check, Student& student, const Cloud& cloud) {
  check.input("12 particles", {{"states", cloud.states}, {"weights", cloud.weights}});
  const Eigen::Vector3d got = student.meanPose(cloud);
  check.shape("result of meanPose", got, 3, 1);
  const Eigen::Vector3d plain = cloud.states * cloud.weights, unweighted = cloud.states.rowwise().mean();
  const Eigen::Vector2d middle(unweighted[0], unweighted[1]);
  std::complex<double> sum = 0, all = 0;
  for (Eigen::Index k = 0; k < cloud.weights.size(); ++k) {
    const double heading = cloud.states(2, k);
    sum += std::polar(cloud.weights[k], heading);
    all += std::polar(1., heading);
  }
  Eigen::Index largest = 0;
  cloud.weights.maxCoeff(&largest);
  const auto shown = check.show([&] { return meanSeen(cloud, got, {plain[0], plain[1], std::arg(sum)}); });
  const auto noWeights = check.suspect("Are the weights left out?", middle);
  const auto summed = check.suspect("Is it the sum over all particles? The weights are left out.",
                                    Eigen::Vector2d(12 * middle));
  const auto best = check.suspect("Is it the heaviest particle? Wanted is the mean of all.",
                                  Eigen::Vector2d(cloud.states(0, largest), cloud.states(1, largest)));
  check.near("mean position of meanPose", got.head<2>(), plain.head<2>(), 1e-9, "m");
  check.nearAngle("mean heading of meanPose", got[2], std::arg(sum), 1e-9,
                  {{"Are the weights left out in the heading?", std::arg(all)},
                   {"Are the arguments of atan2 exchanged?", std::atan2(sum.real(), sum.imag())}});
}

/// Four poses far from each other, so that the parent of every child is known, with 50 particles in each.
struct Heaps {
  CarWorld world;
  Eigen::MatrixXd poses, still;  ///< before a step, and after it without noise
  Eigen::Vector4d weights;       ///< of each particle in a pose
  Eigen::Vector2d u;
  Eigen::VectorXd y;
  Cloud before;

  Heaps(rex::Rng& rng, bool isLost) : world(worldWith(3, rng)), poses(3, 4), still(3, 4) {
    world.observationNoise = 100;
    u = {rng.uniform(0.5, 2), rng.uniform(-0.4, 0.4)};
    for (int h = 0; h < 4; ++h) poses.col(h) = Eigen::Vector3d(30 * h, 0, 0) + randomPose(rng);
    for (int h = 0; h < 4; ++h) still.col(h) = mapOf(world).getMeanStateAfterStep(poses.col(h), u);
    weights = rng.uniformVector(4, .7, 1.3).cwiseProduct(Eigen::Vector4d(1, 2, 3, 4));
    weights /= 50 * weights.sum();
    before = {Eigen::MatrixXd(3, 200), Eigen::VectorXd(200)};
    for (int k = 0; k < 200; ++k) before.states.col(k) = poses.col(k / 50);
    for (int k = 0; k < 200; ++k) before.weights[k] = weights[k / 50];
    y = drive(world, poses.col(2), u, 1, rng).log.observations[0];
    if (isLost) y.setConstant(1e200);
  }
  int heapOf(const Eigen::Vector3d& x) const {
    int nearest = 0;
    const auto far = [&](int h) { return std::hypot(still(0, h) - x[0], still(1, h) - x[1]); };
    for (int h = 1; h < 4; ++h)
      if (far(h) < far(nearest)) nearest = h;
    return nearest;
  }
};

inline bool isOneState(const Eigen::MatrixXd& states) {
  bool same = true;
  for (const auto& x : states.colwise()) same = same && x == states.col(0);
  return same;
}

/// Every particle is a moved copy of one of the four, with noise.
inline void copiesFit(rex::grading::Check& check, const Heaps& heaps, const Cloud& after) {
  Eigen::MatrixXd noise(3, after.states.cols());
  double unmoved = 0;
  for (Eigen::Index k = 0; k < noise.cols(); ++k) {
    const Eigen::Vector3d x = after.states.col(k);
    noise.col(k) = poseError(x, heaps.still.col(heaps.heapOf(x)));
    for (const auto& pose : heaps.poses.colwise()) unmoved += pose == x ? 1 : 0;
  }
  const double sigma = heaps.world.dynamicsNoise, far = noise.cwiseAbs().maxCoeff() / sigma;
  {
    const auto still = check.ask("Are particles not moved? They are where they were before the step.",
                                 unmoved == static_cast<double>(noise.cols()));
    const auto shown = check.show([&] { return heapsSeen(after.states, heaps.poses, heaps.still); });
    check.atMost("distance of a particle of filterStep from the nearest moved particle, over dynamicsNoise",
                 far, 8);
  }
  const auto shown = check.show([&] { return noiseSeen(noise, sigma); });
  const double got = noise.norm() / std::sqrt(static_cast<double>(noise.size()));
  const auto none = check.ask("Do the particles move without noise?", got < 1e-9);
  const auto common =
      check.ask("Do all particles get the same noise?", deviationsOf(noise).maxCoeff() < 1e-9);
  check.near("root mean square of the noise of filterStep", got, sigma,
             kSigmas * std::sqrt(.5 / static_cast<double>(noise.size())) * sigma);
}

/// As many children as the weights say. Wide enough even if all children are drawn independently.
inline void childrenFit(rex::grading::Check& check, const Heaps& heaps, const Cloud& after) {
  Eigen::Vector4d children = Eigen::Vector4d::Zero();
  const double count = static_cast<double>(after.states.cols());
  for (const auto& x : after.states.colwise()) children[heaps.heapOf(x)] += 1;
  const Eigen::Vector4d due = 50 * count * heaps.weights;
  Eigen::Index here = 0;
  const auto shown = check.show([&] { return childrenSeen(children, due, here, "pose"); });
  const auto none =
      check.ask("Are the particles not resampled?", children.minCoeff() == 50 && children.maxCoeff() == 50);
  for (; here < 4; ++here)
    check.near("number of particles of filterStep that come from pose " + std::to_string(here),
               children[here], due[here], kSigmas * std::sqrt(due[here] * (1 - due[here] / count)));
}

inline void weightsOfStepFit(rex::grading::Check& check, const Heaps& heaps, const Cloud& after,
                             bool isLost) {
  const Eigen::Index count = after.weights.size();
  const Eigen::VectorXd equal = Eigen::VectorXd::Constant(count, 1. / static_cast<double>(count));
  const Eigen::VectorXd wanted =
      isLost ? equal : weightsBeside(logDensities(heaps.world, after.states, heaps.y));
  Eigen::VectorXd inherited(count), copied(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    copied[k] = heaps.weights[heaps.heapOf(after.states.col(k))];
    inherited[k] = wanted[k] * copied[k];
  }
  inherited /= inherited.sum();
  copied /= copied.sum();
  const auto shown =
      check.show([&] { return weightsSeen("Weights after filterStep", after.weights, wanted); });
  check.near(
      "weights of filterStep", after.weights, wanted, 1e-9,
      {{"Do copies inherit the weight of their parent? It counts in their number already.", inherited},
       {"Are the weights those from before the step?", heaps.before.weights},
       {"Are the weights those of the parents?", copied},
       {"Are the weights equal, as after resampling? Wanted is the likelihood of what is seen.", equal}});
}

inline void givenHeaps(rex::grading::Check& check, const Heaps& heaps, const std::string& text) {
  check.input(text, {{"poses", heaps.poses},
                     {"weight of each particle in a pose", heaps.weights},
                     {"u", heaps.u},
                     {"y", heaps.y},
                     {"landmarks", heaps.world.landmarks},
                     {"observationNoise", heaps.world.observationNoise},
                     {"dynamicsNoise", heaps.world.dynamicsNoise}});
}

/// With `isLost`, no particle explains the observation.
inline void goesThroughAllLines(rex::grading::Check& check, Student& student, bool isLost) {
  const Heaps heaps(check.rng(), isLost);
  givenHeaps(check, heaps,
             isLost ? "200 particles, first 50 in one pose, then 50 in another, and so on; an observation "
                      "that makes all likelihoods zero"
                    : "200 particles, first 50 in one pose, then 50 in another, and so on");
  const rex::remote::SplitRng rng = check.split(check.rng().next());
  const Cloud after = student.filterStep(heaps.before, heaps.u, heaps.y, heaps.world, rng);
  cloudIsSound(check, after, 200);
  const auto same = check.ask("Are all particles in one state? Wanted is a cloud.", isOneState(after.states));
  copiesFit(check, heaps, after);
  childrenFit(check, heaps, after);
  weightsOfStepFit(check, heaps, after, isLost);
  const auto outside = check.ask("Is there other randomness, as from rand()? All randomness comes from rng.");
  check.that("filterStep gives the same particles with the same rng",
             student.filterStep(heaps.before, heaps.u, heaps.y, heaps.world, rng).states == after.states);
}

/// Two particles; the first has one child or none. With every generator, its noise must not tell.
inline void drawsAnew(rex::grading::Check& check, Student& student) {
  const int calls = 300;
  CarWorld world = worldWith(3, check.rng());
  const Eigen::MatrixXd poses{{0, 30}, {0, 0}, {0, 0}};
  const Cloud before{poses, Eigen::Vector2d(.25, .75)};
  const Eigen::Vector2d u(1, 0);
  const Eigen::VectorXd y = mapOf(world).getMeanObservationAtState(Eigen::Vector3d(16, 0, 0));
  check.input("300 calls with two particles",
              {{"states", before.states}, {"weights", before.weights}, {"u", u}, {"tau", world.tau}});
  Eigen::MatrixXd pairs(2, calls);
  for (int i = 0; i < calls; ++i) {
    const Cloud after = student.filterStep(before, u, y, world, check.split(check.rng().next()));
    cloudIsSound(check, after, 2);
    const double x = after.states(0, 0), way = world.tau * u[0];
    pairs(0, i) = std::min(x, after.states(0, 1)) < 15 ? 1 : -1;
    pairs(1, i) = (x - (x < 15 ? way : 30 + way)) / world.dynamicsNoise;
  }
  const auto shown = check.show([&] { return drawsSeen(pairs); });
  const auto asked = check.ask(
      "Do resampledParents and moved draw the same numbers? A copy of rng repeats them: pass it by "
      "reference.");
  double correlation = 0;
  for (int i = 0; i < calls; ++i) correlation += pairs(0, i) * pairs(1, i) / calls;
  check.near("correlation in filterStep of noise with which particle has children", correlation, 0,
             kSigmas / std::sqrt(calls));
}

/// Resampled and moved, the particles have without weights the mean and the spread that the moved particles
/// from before the step have with their weights, up to the random draws of N children. The mean of cos(a + s
/// z) is cos(a) exp(-s^2 / 2). In 13000 steps with 100 particles the mean was off by at most 3.8 standard
/// deviations, and the spread was 0.81 to 1.19 times the expected one.
inline void comesFrom(rex::grading::Check& check, const Cloud& after, const Cloud& before,
                      const Eigen::Vector2d& u, const CarWorld& world) {
  const rex::CarSimulator map = mapOf(world);
  const double count = static_cast<double>(after.weights.size());
  const double variance = world.dynamicsNoise * world.dynamicsNoise;
  // x, y and the cosine and sine of the heading: the noise changes their means by known factors.
  const auto arrowsOf = [](const Eigen::MatrixXd& states) {
    Eigen::MatrixXd arrows(4, states.cols());
    arrows << states.topRows(2), states.row(2).array().cos().matrix(), states.row(2).array().sin().matrix();
    return arrows;
  };
  Eigen::MatrixXd moved = before.states;
  for (auto x : moved.colwise()) x = map.getMeanStateAfterStep(x, u);
  Eigen::MatrixXd due = arrowsOf(moved);
  due.bottomRows(2) *= std::exp(-variance / 2);
  const Eigen::MatrixXd got = arrowsOf(after.states);
  const Eigen::Vector4d wanted = due * before.weights, mean = got.rowwise().mean();
  const Eigen::Vector4d variances =
      ((due.colwise() - wanted).cwiseAbs2() * before.weights).array() + variance;
  constexpr std::array kNames{"x", "y", "cos(heading)", "sin(heading)"};
  Eigen::Index i = 0;
  const auto shown =
      check.show([&] { return cloudsSeen(before.weights, moved, after.states, i == 2 || i == 3); });
  const auto same = check.ask("Are all particles in one state? Wanted is a cloud.", isOneState(after.states));
  for (; i < 4; ++i)
    check.near(std::string("mean ") + kNames[static_cast<std::size_t>(i)] + " of the particles of filterStep",
               mean[i], wanted[i], kSigmas * std::sqrt(variances[i] / count), i < 2 ? "m" : "");
  const double spread = std::sqrt((got.colwise() - mean).topRows(2).squaredNorm() / count),
               wide = std::sqrt(variances.head<2>().sum());
  check.near("root mean square distance of the particles of filterStep from their mean", spread, wide,
             .35 * wide, "m");
}

inline Cloud stepped(rex::grading::Check& check, Student& student, const Cloud& before,
                     const Eigen::Vector2d& u, const Eigen::VectorXd& y, const CarWorld& world,
                     rex::Rng& given) {
  const Cloud after = student.filterStep(before, u, y, world, check.split(given.next()));
  cloudIsSound(check, after, before.weights.size());
  comesFrom(check, after, before, u, world);
  return after;
}

/// Follows a car; the differences of meanPose() from its pose must be small on average.
inline void follows(rex::grading::Check& check, Student& student, const CarWorld& world, const Driven& driven,
                    int count, rex::Rng& given) {
  Cloud cloud = cloudAt(driven.log.start, count);
  TrackRecord record;
  Course far{"Distance of meanPose from the car", "[m]", {}, .5},
      turned{"Heading of meanPose against that of the car", "[rad]", {}, .08};
  const std::string input = check.input();
  for (std::size_t t = 0; t < driven.truth.size(); ++t) {
    check.input(input + ", step " + std::to_string(t + 1));
    cloud = stepped(check, student, cloud, driven.log.controls[t], driven.log.observations[t], world, given);
    const Eigen::Vector3d mean = student.meanPose(cloud);
    check.shape("result of meanPose", mean, 3, 1);
    record.clouds.push_back(cloud);
    record.means.push_back(mean);
    const Eigen::Vector3d error = poseError(mean, driven.truth[t]);
    far.values.push_back(error.head<2>().norm());
    turned.values.push_back(std::abs(error[2]));
  }
  check.input(input);
  const auto meanOf = [](const Course& course) {
    double square = 0;
    for (const double value : course.values)
      square += value * value / static_cast<double>(course.values.size());
    return std::sqrt(square);
  };
  {
    const auto shown = check.show([&] { return trackSeen(world, driven, record, far); });
    check.atMost("distance of meanPose from the car, root mean square over the drive", meanOf(far), far.limit,
                 "m");
  }
  const auto shown = check.show([&] { return trackSeen(world, driven, record, turned); });
  check.atMost("difference of the headings of meanPose and of the car, root mean square over the drive",
               meanOf(turned), turned.limit, "rad");
}
