#include "grading/check.h"

#include "interface.h"
#include "model_checks.h"
#include "name_checks.h"
#include "particle_checks.h"
#include "slam_checks.h"
#include "smoother_checks.h"

using namespace rex;
using grading::Check;
using grading::Group;

namespace {

// Part 1.

void carSteps(Check& check, Student& student) {
  check.forEachCase(10, [&](int) { stepsRightly(check, student, {}); });
}

void carSees(Check& check, Student& student) {
  check.forEachCase(10, [&](int) {
    const Eigen::Vector3d x = randomState(check.rng());
    seesRightly(check, student, {}, x, randomLandmark(check.rng(), x));
    subtractsMetres(check, student);
  });
}

// In every other case the bearings lie on both sides of straight behind the car.
void carMeasuresAngles(Check& check, Student& student) {
  CarSetup car;
  car.rangeBearing = true;
  check.forEachCase(10, [&](int i) {
    Rng& rng = check.rng();
    const Eigen::Vector3d x = randomState(rng);
    seesRightly(check, student, car, x, randomLandmark(rng, x));
    const double a = i % 2 == 0 ? rng.uniform(2.5, 3.1) : rng.uniform(-1.5, 1.5),
                 turn = rng.uniform(0.1, 1.2);
    const Eigen::Vector2d from(rng.uniform(1, 9), a), to(rng.uniform(1, 9), wrapAngle(a + turn));
    subtractsBearings(check, student, from, to, turn);
  });
}

// <hidden>
void anyCar(Check& check, Student& student) {
  check.forEachCase(20, [&](int i) {
    const CarSetup car = randomCar(check.rng(), i % 2 == 0);
    stepsRightly(check, student, car);
    const Eigen::Vector3d x = randomState(check.rng());
    seesRightly(check, student, car, x, randomLandmark(check.rng(), x));
  });
}
// </hidden>

// Part 2.

void predictsAndTracks(Check& check, Student& student) {
  check.forEachCase(10, [&](int i) {
    predicts(check, student, {});
    CarSetup car;
    car.rangeBearing = i % 2 == 1;
    tracksOneStep(check, student, car, 1);
    tracksOneStep(check, student, car, 2 + check.rng().index(3));
  });
}

void tracksCircle(Check& check, Student& student) {
  check.input("40 runs of 50 steps with u = (0.1, 0.2) among two landmarks");
  Tracking total;
  for (int i = 0; i < 40; ++i) trackRun(check, student, randomRun(check.rng(), {}, 2, 50, {0.1, 0.2}), total);
  requireTracking(check, total, 0.3, 1.8, 4.6);
}

// <hidden>
void tracksAnyCar(Check& check, Student& student) {
  check.forEachCase(10, [&](int i) {
    const CarSetup car = randomCar(check.rng(), i % 2 == 0);
    predicts(check, student, car);
    tracksOneStep(check, student, car, 1 + i % 4);
  });
}

void tracksFast(Check& check, Student& student) {
  Tracking total;
  for (int i = 0; i < 60; ++i) {
    CarSetup car;
    car.rangeBearing = i % 2 == 0;
    trackRun(check, student, randomRun(check.rng(), car, 4, 40, {1.3, i % 3 == 0 ? -0.2 : 0.2}), total);
  }
  requireTracking(check, total, 0.25, 2, 4.5);
}
// </hidden>

// Part 3.

void smoothsAsAWhole(Check& check, Student& student) {
  check.forEachCase(4, [&](int i) {
    const CarSetup car = i == 0 ? CarSetup{} : randomCar(check.rng(), false);
    smoothsRightly(check, student, randomRun(check.rng(), car, 2, 12, {1.5, 0.3}, 0.3));
  });
}

// <hidden>
// Over 400 seeds: a ratio of 0.70 with a standard deviation of 0.03, squared errors of 3.03 with 0.37.
void smoothsBetter(Check& check, Student& student) {
  double before = 0, after = 0, squared = 0;
  constexpr int kRuns = 40;
  for (int i = 0; i < kRuns; ++i) {
    const CarRun run = randomRun(check.rng(), {}, 2, 60, {0.5, 0.2});
    const std::vector<Belief> filtered = filteredRun(check.rng(), run);
    const std::vector<Belief> smooth = student.hindsight(run.car, filtered, run.controls);
    check.near("number of beliefs of hindsight", static_cast<double>(smooth.size()),
               static_cast<double>(filtered.size()), 0);
    for (std::size_t t = 0; t < smooth.size(); ++t) {
      requireBelief(check, "hindsight", smooth[t], 3);
      before += (filtered[t].mean - run.states[t]).head(2).squaredNorm();
      after += (smooth[t].mean - run.states[t]).head(2).squaredNorm();
    }
    squared += squaredError(gapOf(smooth[30].mean, run.states[30]), smooth[30].covariance) / kRuns;
  }
  check.atMost("root mean square distance of hindsight from the car, summed over all steps", std::sqrt(after),
               0.9 * std::sqrt(before), "m");
  const char* property = "squared error of hindsight relative to its covariance, on average over runs";
  check.atMost(property, squared, 5);
  check.atLeast(property, squared, 1.5);
}
// </hidden>

// Part 4.

void predictsJoints(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) {
    predictsJointly(check, student, i < 2 ? CarSetup{} : randomCar(check.rng(), false), i);
  });
}

void correctsJoints(Check& check, Student& student) {
  check.forEachCase(8, [&](int k) {
    CarSetup car;
    car.rangeBearing = k >= 4;
    correctsJointly(check, student, car, 1 + k % 4, k == 5 || k == 7);
  });
}

void startsLandmarks(Check& check, Student& student) {
  check.forEachCase(8, [&](int k) {
    CarSetup car;
    car.rangeBearing = k >= 4;
    startsLandmark(check, student, car, k % 4);
  });
}

// Over 400 seeds: the landmark error is 0.071 m with a standard deviation of 0.006 m, the squared error 1.02
// with 0.13.
void mapsRing(Check& check, Student& student) {
  check.input(
      "10 runs of 70 steps, more than a full circle, among five landmarks; all are seen in each step");
  MapQuality total;
  for (int i = 0; i < 10; ++i) {
    const CarRun run = randomRun(check.rng(), {}, 5, 70, {1, 0.2});
    judgeMap(check, run, mapped(check, student, run, 100), total);
  }
  requireMap(check, total, 0.35, 0.4, 1.9);
}

// <hidden>
void mapsAnyRing(Check& check, Student& student) {
  MapQuality total;
  for (int i = 0; i < 10; ++i) {
    CarSetup car;
    car.rangeBearing = i % 2 == 0;
    car.dynamicsNoise = 0.02;
    const CarRun run = randomRun(check.rng(), car, 5 + i % 3, 65, {1, i % 3 == 0 ? -0.2 : 0.2});
    judgeMap(check, run, mapped(check, student, run, 18), total);
  }
  requireMap(check, total, 0.5, 0.4, 1.9);
}
// </hidden>

// Part 5.

// None of 400 seeds fails here or in the hidden check. Overall the landmark error is 0.08 m with a standard
// deviation of 0.03 m; without corrections it is 0.7 m (0.3 m).
void findsLandmarks(Check& check, Student& student) {
  namesByCovariance(check, student);
  for (int i = 0; i < 3; ++i) {
    CarSetup car;
    car.dynamicsNoise = 0.02;
    judgeNameless(check, student, clearRun(check.rng(), car, 5 + i, {1, 0.2}, 18), 18);
  }
}

// <hidden>
void findsAnyLandmarks(Check& check, Student& student) {
  namesByCovariance(check, student);
  for (int i = 0; i < 4; ++i) {
    CarSetup car;
    car.rangeBearing = i % 2 == 0;
    car.dynamicsNoise = 0.02;
    if (car.rangeBearing) car.observationNoise = 0.2;
    judgeNameless(check, student, clearRun(check.rng(), car, 5 + i % 3, {1, -0.2}, 20), 20);
  }
}
// </hidden>

// The first cases tell mistakes apart; in the last ones, all particles are far off.
void weighsParticles(Check& check, Student& student) {
  for (int k = 0; k < 6; ++k) {
    CarSetup car;
    car.rangeBearing = k % 2 == 1;
    weighsAsItShould(check, student, car, k < 4 ? 0 : 60);
  }
}

// <hidden>
// Draws as many particles as there are, in proportion to their weights, with one random number.
std::vector<MapParticle> drawn(Rng& rng, const std::vector<MapParticle>& particles) {
  const auto n = static_cast<double>(particles.size());
  std::vector<MapParticle> survivors;
  double sum = 0, next = rng.uniform() / n;
  for (const MapParticle& particle : particles) {
    sum += particle.weight;
    for (; next < sum && survivors.size() < particles.size(); next += 1 / n) {
      survivors.push_back(particle);
      survivors.back().weight = 1 / n;
    }
  }
  while (survivors.size() < particles.size()) survivors.push_back(survivors.back());
  return survivors;
}

// FastSLAM 1: the grader moves and resamples particles, the student updates maps and weights. Returns the map
// of the particle with the largest weight.
Eigen::Matrix2Xd particleMap(Check& check, Student& student, const CarRun& run) {
  constexpr std::size_t kParticles = 50;
  Rng& rng = check.rng();
  const auto model = CarSimulator::withoutPlaces(0, optionsOf(run.car));
  std::vector<MapParticle> particles(kParticles, {Eigen::Vector3d::Zero(), 1. / kParticles, {}});
  for (std::size_t t = 0; t < run.controls.size(); ++t) {
    for (MapParticle& particle : particles)
      particle.x = model.getMeanStateAfterStep(particle.x, run.controls[t]) +
                   run.car.dynamicsNoise * rng.normalVector(3);
    const std::vector<MapParticle> before = particles;
    particles = student.weighed(run.car, before, seenAt(run, t, 100));
    check.near("number of particles of weighed", static_cast<double>(particles.size()), kParticles, 0);
    for (std::size_t k = 0; k < kParticles; ++k)
      check.near("x of a particle of weighed", particles[k].x, before[k].x, 0);
    double sum = 0, squares = 0;
    for (const MapParticle& particle : particles) {
      check.that("weights of weighed are not negative", particle.weight >= 0);
      sum += particle.weight;
      squares += particle.weight * particle.weight;
      check.near("number of landmarks in a map of weighed", static_cast<double>(particle.map.size()),
                 static_cast<double>(run.landmarks.cols()), 0);
      for (const Belief& landmark : particle.map) requireBelief(check, "weighed", landmark, 2);
    }
    check.near("sum of the weights of weighed", sum, 1, 1e-9);
    if (t + 1 < run.controls.size() && 1 / squares < 0.5 * kParticles) particles = drawn(rng, particles);
  }
  const auto& best =
      *std::max_element(particles.begin(), particles.end(),
                        [](const MapParticle& a, const MapParticle& b) { return a.weight < b.weight; });
  Eigen::Matrix2Xd places(2, run.landmarks.cols());
  for (std::size_t i = 0; i < best.map.size(); ++i)
    places.col(static_cast<Eigen::Index>(i)) = best.map[i].mean;
  return places;
}

// The noise of the motion is large, so that the particles spread and their weights matter. Over 16 seeds the
// error of the reference solution is at most 0.064 m, and with equal weights at least 0.279 m.
void mapsWithParticles(Check& check, Student& student) {
  double squared = 0;
  for (int i = 0; i < 4; ++i) {
    const CarRun run =
        randomRun(check.rng(), {.dynamicsNoise = 0.08, .observationNoise = 0.3}, 3 + i, 50, {1, 0.2});
    squared += std::pow(absoluteTrajectoryError(particleMap(check, student, run), run.landmarks), 2) / 4;
  }
  check.atMost("root mean square error of the landmarks after alignment", std::sqrt(squared), 0.15, "m");
}
// </hidden>

}  // namespace

rex::grading::Checks<Student> checks() {
  return {
      {"car-step", "models", "A step and its derivatives", 1, Group::kVisible, carSteps},
      {"car-view", "models", "Landmarks ahead and to the left", 1, Group::kVisible, carSees},
      {"car-bearing", "models", "Landmarks by distance and bearing", 1, Group::kVisible, carMeasuresAngles},
      {"kf-step", "filter", "One step of the filter", 1, Group::kVisible, predictsAndTracks},
      {"kf-correct", "filter", "The correction, against the canonical form", 1, Group::kVisible, corrects},
      {"kf-covariance", "filter", "A covariance stays a covariance", 1, Group::kVisible, staysACovariance},
      {"kf-track", "filter", "Tracking the car from the script", 1, Group::kVisible, tracksCircle},
      {"rts-batch", "smoother", "Smoothing equals estimating all states at once", 1, Group::kVisible,
       smoothsAsAWhole},
      {"slam-predict", "slam", "The joint belief after a step", 1, Group::kVisible, predictsJoints},
      {"slam-correct", "slam", "The joint belief after a sighting", 1, Group::kVisible, correctsJoints},
      {"slam-start", "slam", "A landmark seen for the first time", 1, Group::kVisible, startsLandmarks},
      {"slam-map", "slam", "A map of five landmarks", 1, Group::kVisible, mapsRing},
      {"names-found", "hard", "Landmarks without names", 1, Group::kVisible, findsLandmarks},
      {"particles-weigh", "hard", "Maps and weights of particles", 1, Group::kVisible, weighsParticles},
      // <hidden>
      {"car-any", "models", "Other cars", 1, Group::kHidden, anyCar},
      {"kf-any", "filter", "Other cars, both sensors", 1, Group::kHidden,
       [](Check& check, Student& student) {
         tracksAnyCar(check, student);
         tracksFast(check, student);
       }},
      {"rts-better", "smoother", "The smoother is better than the filter", 1, Group::kHidden, smoothsBetter},
      {"slam-any", "slam", "Other maps, with landmarks that appear during the drive", 1, Group::kHidden,
       mapsAnyRing},
      {"names-any", "hard", "More landmarks without names, both sensors", 1, Group::kHidden,
       findsAnyLandmarks},
      {"particles-map", "hard", "A map by FastSLAM", 1, Group::kHidden, mapsWithParticles},
      // </hidden>
  };
}
