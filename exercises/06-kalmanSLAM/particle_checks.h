#pragma once

#include <cmath>
#include <vector>

#include "filter_checks.h"
#include "slam_checks.h"

// Part 5: particles, each with a map of its own.

/// Particles around x with three landmarks each, and the true positions of these and of one more.
struct Swarm {
  std::vector<MapParticle> particles;
  std::vector<Eigen::Vector2d> places;
};

/// With bearings, the first landmark is behind the car: for some particles to the left, for others to the
/// right.
inline Swarm randomSwarm(rex::Rng& rng, const CarSetup& car, const Eigen::Vector3d& x) {
  Swarm swarm;
  for (int i = 0; i < 4; ++i) swarm.places.emplace_back(randomLandmark(rng, x));
  if (car.rangeBearing) swarm.places[0] = placeBehind(rng, x);
  for (int k = 0; k < 12; ++k) {
    MapParticle particle{x + 0.1 * rng.normalVector(3), rng.uniform(0.5, 1.5) / 12, {}};
    for (std::size_t i = 0; i < 3; ++i)
      particle.map.push_back({swarm.places[i] + 0.2 * rng.normalVector(2), randomCovariance(rng, 2)});
    swarm.particles.push_back(particle);
  }
  return swarm;
}

/// The gap of a sighting to a landmark of a particle.
inline Observation gapOfLandmark(const CarSetup& car, const MapParticle& particle,
                                 const LandmarkObservation& seen, const Eigen::VectorXd& l) {
  const Eigen::VectorXd expected = seenFrom(car, particle.x, l);
  return {
      gapsOf(car, seen.y, expected),
      derivative(
          [&](const Eigen::VectorXd& z) { return gapsOf(car, seenFrom(car, particle.x, z), expected); }, l),
      noiseOf(car, 1)};
}

inline void newLandmarkFits(rex::grading::Check& check, const CarSetup& car, const MapParticle& particle,
                            const LandmarkObservation& seen, const Belief& got) {
  const Eigen::Vector2d place = rex::landmarkPosition(sensorOf(car), particle.x, seen.y).landmark;
  check.input(described(car), {{"x of the particle", particle.x}, {"y", seen.y}});
  const Observation at = gapOfLandmark(car, particle, seen, place);
  const Belief wanted{place, rex::inverse(carried(transposed(at.C), rex::inverse(at.W)))};
  std::vector<WrongBelief> wrong{
      {"Is W that of the sighting in the frame of the car? It has to be turned into that of the world.",
       {place, at.W}},
      {"Is W transformed the wrong way, by D in place of its inverse?", {place, carried(at.C, at.W)}},
      {"Is the covariance never set?", {place, unitMatrix(2)}},
      {"Is the covariance never set?", {place, Eigen::MatrixXd::Zero(2, 2)}}};
  for (const auto& [question, other] : wrongPlaces(car, particle.x, seen.y))
    wrong.push_back({question, {other, wanted.covariance}});
  sameBelief(check, {.name = "weighed, of the new landmark of a particle", .isOfCar = false}, got, wanted,
             1e-6, wrong);
}

inline void knownLandmarkFits(rex::grading::Check& check, const CarSetup& car, const MapParticle& particle,
                              const LandmarkObservation& seen, const Belief& before, const Belief& got) {
  check.input(described(car), {{"x of the particle", particle.x},
                               {"mean", before.mean},
                               {"covariance", before.covariance},
                               {"y", seen.y}});
  const Observation at = gapOfLandmark(car, particle, seen, before.mean);
  const Belief wanted = informed(before, at);
  Observation unwrapped = at;
  unwrapped.gap = seen.y - seenFrom(car, particle.x, before.mean);
  std::vector<WrongBelief> wrong = wrongCorrections(before, at, wanted);
  wrong.insert(wrong.begin(), {{"Is a landmark never corrected?", before},
                               {"Is the difference of the bearings not wrapped? viewGap does it.",
                                informed(before, unwrapped)}});
  sameBelief(check, {.name = "weighed, of a landmark of a particle that is seen", .isOfCar = false}, got,
             wanted, 1e-6, wrong);
}

/// Factors of the likelihood of a particle, as logarithms.
struct LogWeight {
  double before = 0, exponent = 0, determinant = 0;
  double exponentOfSensor = 0, determinantOfSensor = 0;  ///< as if the landmarks were known exactly
};

inline Eigen::VectorXd normalized(const std::vector<LogWeight>& logs,
                                  const std::function<double(const LogWeight&)>& logOf) {
  Eigen::VectorXd weights(static_cast<Eigen::Index>(logs.size()));
  for (std::size_t k = 0; k < logs.size(); ++k) weights[static_cast<Eigen::Index>(k)] = logOf(logs[k]);
  weights.array() -= weights.maxCoeff();
  for (double& weight : weights) weight = std::exp(weight);
  return weights / weights.sum();
}

inline void weightsFit(rex::grading::Check& check, const std::vector<LogWeight>& logs,
                       const Eigen::VectorXd& got) {
  const auto likelihood = [](const LogWeight& one) { return one.exponent + one.determinant; };
  const Eigen::VectorXd wanted = normalized(
                            logs, [&](const LogWeight&one) { return one.before + likelihood(one); }),
                        same = Eigen::VectorXd::Constant(got.size(), 1. / static_cast<double>(got.size()));
  Eigen::VectorXd before(got.size());
  for (Eigen::Index k = 0; k < before.size(); ++k)
    before[k] = std::exp(logs[static_cast<std::size_t>(k)].before);
  check.input("12 particles that see three landmarks, one for the first time", {{"weights before", before}});
  const auto sum = check.ask("Do the weights sum to one?", std::abs(got.sum() - 1) > 1e-5);
  check.near(
      "weights of weighed", got, wanted, 1e-5,
      {{"Do all particles weigh the same, whatever they expect to see?", same},
       {"Do the sightings leave the weights as they are?", before / before.sum()},
       {"Are the weights before the sightings left out?", normalized(logs, likelihood)},
       {"Is the determinant left out of the density?",
        normalized(logs, [](const LogWeight& one) { return one.before + one.exponent; })},
       {"Is the exponent left out of the density?",
        normalized(logs, [](const LogWeight& one) { return one.before + one.determinant; })},
       {"Is the root of the determinant left out?",
        normalized(logs,
                   [](const LogWeight& one) { return one.before + one.exponent + 2 * one.determinant; })},
       {"Is the exponent not halved?",
        normalized(logs,
                   [](const LogWeight& one) { return one.before + 2 * one.exponent + one.determinant; })},
       {"Is the gap measured with the noise of the sensor alone? The landmark is uncertain, too.",
        normalized(logs,
                   [](const LogWeight& one) {
                     return one.before + one.exponentOfSensor + one.determinantOfSensor;
                   })},
       {"Is it likely to see what is far from expected? The exponent is negative.",
        normalized(logs, [](const LogWeight& one) { return one.before - one.exponent + one.determinant; })}});
}

// Compares maps and weights of random particles with corrections in canonical form. The landmarks are seen
// `offset` [m] away from their positions in the maps.
inline void weighsAsItShould(rex::grading::Check& check, Student& student, const CarSetup& car,
                             double offset) {
  const Eigen::Vector3d x = randomState(check.rng());
  const auto [particles, places] = randomSwarm(check.rng(), car, x);
  std::vector<LandmarkObservation> seen;
  for (const int i : {2, 0, 3}) {
    const Eigen::Vector2d place = places[static_cast<std::size_t>(i)] + Eigen::Vector2d(offset, 0);
    seen.push_back({i, seenFrom(car, x, place)});
  }
  check.input("12 particles with three landmarks each; numbers 2, 0 and the new one, 3, are seen, " +
              described(car));
  const std::vector<MapParticle> after = student.weighed(car, particles, seen);
  check.near("number of particles of weighed", static_cast<double>(after.size()), 12, 0);
  std::vector<LogWeight> logs;
  Eigen::VectorXd weights(12);
  for (std::size_t k = 0; k < 12; ++k) {
    const MapParticle& given = particles[k];
    check.near("x of a particle of weighed", after[k].x, given.x, 0);
    check.near("number of landmarks in a map of weighed", static_cast<double>(after[k].map.size()), 4, 0);
    LogWeight weight{.before = std::log(given.weight)};
    for (const LandmarkObservation& one : seen) {
      const auto i = static_cast<std::size_t>(one.landmark);
      if (i == 3) {
        newLandmarkFits(check, car, given, one, after[k].map[3]);
        continue;
      }
      const Observation at = gapOfLandmark(car, given, one, given.map[i].mean);
      const Eigen::MatrixXd S = sum(carried(at.C, given.map[i].covariance), at.W);
      weight.exponent -= 0.5 * squaredError(at.gap, S);
      weight.determinant -= 0.5 * std::log(S.determinant());
      weight.exponentOfSensor -= 0.5 * squaredError(at.gap, at.W);
      weight.determinantOfSensor -= 0.5 * std::log(at.W.determinant());
      knownLandmarkFits(check, car, given, one, given.map[i], after[k].map[i]);
    }
    sameBelief(check, {.name = "weighed, of a landmark of a particle that is not seen", .isOfCar = false},
               after[k].map[1], given.map[1], 0);
    logs.push_back(weight);
    weights[static_cast<Eigen::Index>(k)] = after[k].weight;
  }
  weightsFit(check, logs, weights);
}
