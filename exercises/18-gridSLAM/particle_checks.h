#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "match_checks.h"

// Part 4: particles.

inline void movesOnce(Check& check, Student& student) {
  rex::Rng& rng = check.rng();
  constexpr int kCount = 800;
  const Eigen::Vector3d pose(rounded(rng.uniform(-3, 3)), rounded(rng.uniform(-3, 3)),
                             rounded(rng.uniform(1, 2)) * (rng.index(2) == 0 ? 1 : -1)),
      motion(rounded(rng.uniform(.4, 1)), rounded(rng.uniform(.2, .5)), rounded(rng.uniform(.3, 1))),
      deviations(.3, .1, .2);
  check.input("a pose and a motion", {{"pose", pose}, {"motion", motion}, {"deviations", deviations}});
  const Eigen::MatrixXd got = student.moved(pose, motion, deviations, kCount, check.split(7));
  check.shape("moved", got, 3, kCount);
  const auto seenFrom = [&](double heading) {
    Eigen::MatrixXd ways(3, kCount);
    for (int k = 0; k < kCount; ++k)
      ways.col(k) =
          motionFrom({pose[0], pose[1], heading}, got.col(k)) + Eigen::Vector3d(0, 0, heading - pose[2]);
    return ways;
  };
  const auto meanOf = [](const Eigen::MatrixXd& ways) -> Eigen::Vector3d { return ways.rowwise().mean(); };
  const auto spreadOf = [&](const Eigen::MatrixXd& ways) -> Eigen::Vector3d {
    return ((ways.colwise() - meanOf(ways)).array().square().rowwise().sum() / kCount).sqrt();
  };
  const Eigen::MatrixXd ways = seenFrom(pose[2]);
  const Eigen::Vector3d mean = meanOf(ways), spread = spreadOf(ways);
  const auto shown = check.show([&] {
    const double c = std::cos(pose[2]), s = std::sin(pose[2]);
    Eigen::Matrix2d R;
    R << c, -s, s, c;
    rex::Figure figure = rex::planeFigure({.title = "poses after a motion"});
    figure.series = {rex::through(got, {.label = "moved", .style = rex::SeriesStyle::kPoints, .size = .5}),
                     rex::grading::wrongPoint("before", pose[0], pose[1])};
    figure.ellipses = {{.label = "wanted, 2 sigma",
                        .mean = pose.head<2>() + R * motion.head<2>(),
                        .covariance = R * deviations.head<2>().cwiseAbs2().asDiagonal() * R.transpose(),
                        .sigmas = 2,
                        .color = rex::grading::kWantedColor}};
    return Evidence{.figures = {figure}};
  });
  const double tolerance = 6 * .3 / std::sqrt(kCount);
  const auto nearly = [&](double heading) {
    return (meanOf(seenFrom(heading)) - motion).head<2>().norm() < tolerance;
  };
  {
    const auto world =
        check.ask("Is the motion added in the world frame? It is (ahead, left, turn).", nearly(0));
    const auto inverse = check.ask("Is the motion rotated the wrong way?", nearly(-pose[2]));
    const auto after =
        check.ask("Is the heading after the motion used? Odometry is in the frame of the pose before.",
                  nearly(pose[2] + motion[2]) || nearly(pose[2] + motion[2] / 2));
    const auto once = check.ask("Do all poses get the same noise? It is drawn for each of them.",
                                spread.norm() < 1e-9 && (mean - motion).norm() > 1e-9);
    check.near("mean of moved, seen from the pose before", mean, motion, tolerance);
  }
  const auto none = check.ask("Is there no noise?", spread.norm() < 1e-6);
  const auto small = check.ask("Are these variances? The noise has standard deviations.",
                               (spread - deviations.cwiseAbs2()).norm() < .03);
  const auto rotated =
      check.ask("Is noise added in the world frame? It belongs to the motion, before that is rotated.",
                (spreadOf(seenFrom(0)) - deviations).norm() < .05);
  check.near("standard deviations of moved, seen from the pose before", spread, deviations, .05);
  const Eigen::MatrixXd centred = ways.colwise() - mean;
  const Eigen::Matrix3d covariance = centred * centred.transpose() / kCount;
  double correlation = 0;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < i; ++k)
      correlation = std::max(correlation, std::abs(covariance(i, k)) / (spread[i] * spread[k]));
  const auto shared = check.ask("Is the same random number used for all three?");
  check.atMost("correlation of the noises of moved", correlation, .25);
}

inline Particle idParticle(int id, double logWeight) {
  return {{Eigen::Vector3d(id, 0, 0)}, {{0, 0}, 1, Eigen::MatrixXd::Constant(2, 2, id)}, logWeight};
}

inline std::vector<Particle> idParticles(int count, double offset, double spread, rex::Rng& rng) {
  std::vector<Particle> particles;
  for (int k = 0; k < count; ++k)
    particles.push_back(
        idParticle(100 + 7 * rng.index(1000) * count + k, offset + rounded(rng.uniform(-spread, spread))));
  return particles;
}

inline Eigen::VectorXd logsOf(const std::vector<Particle>& particles) {
  Eigen::VectorXd logs(static_cast<Eigen::Index>(particles.size()));
  for (std::size_t k = 0; k < particles.size(); ++k)
    logs[static_cast<Eigen::Index>(k)] = particles[k].logWeight;
  return logs;
}

// Each from its differences to all others.
inline Eigen::VectorXd weightsFrom(const Eigen::VectorXd& logs) {
  Eigen::VectorXd weights(logs.size());
  for (Eigen::Index k = 0; k < logs.size(); ++k) weights[k] = 1 / (logs.array() - logs[k]).exp().sum();
  return weights;
}

inline void weighs(Check& check, Student& student, double offset) {
  const std::vector<Particle> particles = idParticles(6, offset, 2, check.rng());
  const Eigen::VectorXd logs = logsOf(particles), wanted = weightsFrom(logs);
  check.input("particles", {{"log weights", logs}});
  const Eigen::VectorXd got = student.weightsOf(particles);
  check.shape("weightsOf", got, 6, 1);
  const auto plain = check.suspect("Are these the logarithms?", logs);
  const auto shares = check.suspect("Are logarithms divided by their sum?", logs / logs.sum());
  const auto raw = check.suspect("Do the weights not sum to one?", logs.array().exp().matrix());
  const auto zero = check.suspect("Is exp() of each logarithm zero? Only their differences matter.",
                                  Eigen::VectorXd::Constant(6, 1. / 6));
  const auto high =
      check.suspect("Do the weights not sum to one?", (logs.array() - logs.maxCoeff()).exp().matrix());
  check.near("weightsOf", got, wanted, 1e-9);
  const double size = student.effectiveSize(wanted);
  const auto squares = check.ask("Is it the sum of the squares? Wanted is one over it.",
                                 std::abs(size - wanted.squaredNorm()) < 1e-6);
  const auto root = check.ask("Is a root taken?", std::abs(size - 1 / wanted.norm()) < 1e-6);
  const auto mean =
      check.ask("Is it one over the mean of the squares?", std::abs(size - 6 / wanted.squaredNorm()) < 1e-6);
  check.near("effectiveSize", size, 1 / wanted.squaredNorm(), 1e-9);
}

inline void weighsParticles(Check& check, Student& student) {
  for (const double offset : {0., -1200., 900.}) weighs(check, student, offset);
}

inline void resamples(Check& check, Student& student, int count, double spread) {
  constexpr int kTimes = 200;
  const Eigen::VectorXd logs = logsOf(idParticles(count, -50, spread, check.rng())),
                        expected = count * weightsFrom(logs);
  check.input("particles", {{"N weight", expected}});
  Eigen::VectorXd first, sum = Eigen::VectorXd::Zero(count);
  bool isSame = true;
  for (int n = 0; n < kTimes; ++n) {
    std::vector<Particle> particles = idParticles(count, 0, 1, check.rng());
    for (std::size_t k = 0; k < particles.size(); ++k)
      particles[k].logWeight = logs[static_cast<Eigen::Index>(k)];
    const std::vector<Particle> got = student.resampled(particles, check.split(7));
    check.near("number of particles after resampling", static_cast<double>(got.size()), count, 0);
    Eigen::VectorXd copies = Eigen::VectorXd::Zero(count);
    for (const Particle& copy : got) {
      check.that("each particle has a path after resampling", !copy.path.empty());
      const auto parent = std::find_if(particles.begin(), particles.end(), [&](const Particle& particle) {
        return particle.path.back()[0] == copy.path.back()[0];
      });
      check.that("each path after resampling is that of a given particle", parent != particles.end());
      check.shape("map of a copy", copy.map.values, 2, 2);
      check.that("a copy has the map of the particle whose path it has",
                 copy.map.values == parent->map.values);
      const auto kept = check.ask("Do copies keep their weights? Weights would count twice.",
                                  copy.logWeight == parent->logWeight);
      check.near("log weight of a copy", copy.logWeight, 0, 0);
      copies[parent - particles.begin()] += 1;
    }
    Eigen::Index worst = 0;
    const double lack = ((expected.array() - 1e-9).floor() - copies.array()).maxCoeff(&worst);
    bool isNext = true, isInOrder = true;
    for (Eigen::Index k = 0; k < count; ++k) {
      isNext = isNext && copies[(k + 1) % count] >= std::floor(expected[k] - 1e-9);
      isInOrder = isInOrder && std::abs(copies.head(k + 1).sum() - expected.head(k + 1).sum()) < 1;
    }
    const auto several =
        check.ask("Is a new random number drawn for each copy? One is enough for all.", isInOrder);
    const auto shifted = check.ask("Is particle i + 1 copied as often as particle i should be?", isNext);
    const auto drawn =
        check.ask("Is each copy drawn by itself? Then a likely particle may be lost by bad luck.");
    if (lack > 0)
      check.atLeast("how often a particle occurs that should occur " + std::to_string(expected[worst]) +
                        " times on average",
                    copies[worst], std::floor(expected[worst]));
    if (n == 0) first = copies;
    isSame = isSame && copies == first;
    sum += copies;
  }
  const auto fixed = check.ask(
      "Are the copies the same each time? A particle with 2.3 has a third one in three of ten cases.",
      isSame);
  check.near("how often particles occur, on average over 200 draws", sum / kTimes, expected, .4);
}

// Three particles near the robot, each with the map of a building, a little displaced.
inline std::vector<Particle> threeParticles(const Sight& sight, const Eigen::Vector3d& before,
                                            rex::Rng& rng) {
  std::vector<Particle> particles;
  for (int k = 0; k < 3; ++k) {
    Particle particle{
        {Eigen::Vector3d(rng.normalVector(3)), before}, sight.truth, rounded(rng.uniform(-3, 0))};
    particle.map.values *= .15 + .05 * k;  // a wall that is seen becomes one
    const Eigen::Vector2d shift(.04 * (k - 1), .04 * (1 - k));
    particle.map.origin += shift;
    particle.path.back().head<2>() += shift;
    particles.push_back(particle);
  }
  return particles;
}

// What slamStep() made of one particle; `other` is another one.
inline void steps(Check& check, const Particle& before, const Particle& after, const Particle& other,
                  const Eigen::Vector3d& expected, const Sight& sight, const Settings& settings) {
  const Grid distances = distancesTo(before.map, settings.reach);
  check.near("length of a path after slamStep", static_cast<double>(after.path.size()),
             static_cast<double>(before.path.size()) + 1, 0);
  for (std::size_t t = 0; t < before.path.size(); ++t)
    check.near("an earlier pose of a path after slamStep", after.path[t], before.path[t], 1e-12);
  const Eigen::Vector3d pose = after.path.back();
  const auto rate = [&](const Eigen::Vector3d& at) {
    return fitOf(distances, at, sight.scan, settings.deviation);
  };
  const Eigen::Vector3d apart = motionFrom(expected, pose);
  check.atMost("how far a pose of slamStep is from where the motion leads", apart.head<2>().norm(), 1, "m");
  if (settings.matches) {
    const Eigen::Vector3d best = bestIn(distances, sight.scan, settings.deviation, expected, {.25, .15});
    const auto unmatched = check.ask("Is the drawn pose kept? With `matches`, the match takes its place.");
    check.atLeast("fit of a pose of slamStep with matches", rate(pose),
                  rate(best) - 1.5 - .1 * (rate(best) - rate(expected + Eigen::Vector3d(.1, .1, .05))));
  } else {
    check.atMost("how many deviations a pose of slamStep is from the measured motion",
                 apart.cwiseQuotient(settings.odometry).cwiseAbs().maxCoeff(), 6);
  }
  const double says = rate(pose) / settings.temper;
  const Grid now = distancesTo(mapAfter(before.map, pose, sight.scan, settings.evidence), settings.reach);
  const auto one = [](double value) -> Eigen::MatrixXd { return Eigen::MatrixXd::Constant(1, 1, value); };
  {
    const auto kept = check.suspect("Does the scan not change the weight?", one(before.logWeight));
    const auto fresh = check.suspect("Is the log weight from before forgotten?", one(says));
    const auto hot = check.suspect("Is `temper` forgotten?", one(before.logWeight + says * settings.temper));
    const auto cold = check.suspect("Is it multiplied by `temper`?",
                                    one(before.logWeight + says * settings.temper * settings.temper));
    const auto blind = check.suspect(
        "Is the scan in the map already that says how well it fits? It would always fit.",
        one(before.logWeight + fitOf(now, pose, sight.scan, settings.deviation) / settings.temper));
    const auto shared = check.suspect("Is the map of another particle used? Each has its own.",
                                      one(before.logWeight + fitOf(distancesTo(other.map, settings.reach),
                                                                   pose, sight.scan, settings.deviation) /
                                                                 settings.temper));
    check.near("log weight after slamStep", one(after.logWeight), one(before.logWeight + says),
               1e-6 * (1 + std::abs(says)));
  }
  const Eigen::MatrixXd wanted = mapAfter(before.map, pose, sight.scan, settings.evidence).values,
                        got = whereClear(after.map.values, before.map, pose, sight.scan, settings.evidence);
  const auto unchanged = check.suspect("Is the scan never added to the map?", before.map.values);
  const auto guessed = check.ask(
      "Is the scan added at another pose than the last one of the path, or to the "
      "map of another particle?");
  const auto shown = check.show([&] { return gridsOf(before.map, got, wanted, "log odds"); });
  check.near("map after slamStep", got, wanted, 1e-9);
}

inline void stepsParticles(Check& check, Student& student) {
  check.forEachCase(3, [&](int i) {
    const Sight sight = randomSight(check.rng());
    const Eigen::Vector3d motion(.3, -.1, .2);
    // The pose from where that motion leads to the scan.
    const double heading = sight.pose[2] - motion[2], c = std::cos(heading), s = std::sin(heading);
    const Eigen::Vector3d before(sight.pose[0] - c * motion[0] + s * motion[1],
                                 sight.pose[1] - s * motion[0] - c * motion[1], heading);
    Settings settings;
    settings.matches = i % 2 == 0;
    settings.odometry << .07, .06, .03;  // matches reach five deviations far
    const std::vector<Particle> particles = threeParticles(sight, before, check.rng());
    check.input(settings.matches ? "three particles in a building; poses are matched"
                                 : "three particles in a building; poses are not matched",
                {{"motion", motion}, {"last pose", before}});
    const std::vector<Particle> got =
        student.slamStep(particles, motion, sight.scan, settings, check.split(7));
    check.near("number of particles after slamStep", static_cast<double>(got.size()), 3, 0);
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d last = particles[k].path.back();
      const Eigen::Vector3d expected =
          last + Eigen::Vector3d(c * motion[0] - s * motion[1], s * motion[0] + c * motion[1], motion[2]);
      check.shape("values of a map after slamStep", got[k].map.values, 60, 60);
      steps(check, particles[k], got[k], particles[k == 0 ? 1 : 0], expected, sight, settings);
    }
    if (!settings.matches) {
      const auto ways = [&](std::size_t k) {
        return motionFrom(particles[k].path.back(), got[k].path.back());
      };
      {
        const auto once = check.ask("Do all particles get the same noise?");
        check.atLeast("difference of the motions of two particles", (ways(0) - ways(1)).norm(), 1e-6);
      }
      // The mean over 24 calls, 3 particles and 3 numbers of the square of what is 1 on average.
      double share = 0;
      for (int n = 0; n < 24; ++n) {
        const std::vector<Particle> more =
            student.slamStep(particles, motion, sight.scan, settings, check.split(100 + n));
        check.near("number of particles after slamStep", static_cast<double>(more.size()), 3, 0);
        for (std::size_t k = 0; k < 3; ++k) {
          check.that("each particle has a path after slamStep", !more[k].path.empty());
          share += (motionFrom(particles[k].path.back(), more[k].path.back()) - motion)
                       .cwiseQuotient(settings.odometry)
                       .squaredNorm() /
                   216;
        }
      }
      const auto always = check.ask("Are poses matched although `matches` is false?");
      check.atLeast("mean square of the noise of slamStep without matches, in deviations", share, .6);
    }
  });
}
