#pragma once

#include <algorithm>

#include "belief_evidence.h"
#include "car_runs.h"

// Whole runs of SLAM with the functions of parts 4 and 5, and how good their maps are.

// The sightings of the landmarks whose true distance is less than `range`, with their names in
// `run.landmarks`.
inline std::vector<LandmarkObservation> seenAt(const CarRun& run, std::size_t t, double range) {
  std::vector<LandmarkObservation> seen;
  for (Eigen::Index i = 0; i < run.landmarks.cols(); ++i)
    if ((run.landmarks.col(i) - run.states[t + 1].head<2>()).norm() < range)
      seen.push_back({static_cast<int>(i), run.sightings[t].segment<2>(2 * i)});
  return seen;
}

// A joint belief, and which true landmark each of its landmarks is.
struct MapBelief {
  Belief joint;
  std::vector<int> names;
};

inline Belief startBelief() { return {Eigen::Vector3d::Zero(), 1e-6 * Eigen::Matrix3d::Identity()}; }

inline Eigen::Index sizeOf(const MapBelief& map) {
  return 3 + 2 * static_cast<Eigen::Index>(map.names.size());
}

inline void enter(rex::grading::Check& check, Student& student, const CarSetup& car,
                  const LandmarkObservation& seen, MapBelief& map) {
  map.joint = student.withLandmark(car, map.joint, seen.y);
  map.names.push_back(seen.landmark);
  requireBelief(check, map.joint, sizeOf(map));
}

inline MapBelief mapped(rex::grading::Check& check, Student& student, const CarRun& run, double range) {
  MapBelief map{startBelief(), {}};
  for (std::size_t t = 0; t < run.controls.size(); ++t) {
    map.joint = student.jointPredicted(run.car, map.joint, run.controls[t]);
    requireBelief(check, map.joint, sizeOf(map));
    for (const LandmarkObservation& seen : seenAt(run, t, range)) {
      const auto known = std::find(map.names.begin(), map.names.end(), seen.landmark);
      if (known == map.names.end()) {
        enter(check, student, run.car, seen, map);
        continue;
      }
      map.joint =
          student.jointCorrected(run.car, map.joint, static_cast<int>(known - map.names.begin()), seen.y);
      requireBelief(check, map.joint, sizeOf(map));
    }
  }
  return map;
}

// The mean squared error of the landmarks [m^2], after the rigid motion that brings them nearest to the
// truth, and the squared error of the joint belief relative to its covariance, per entry: sums over runs.
struct MapQuality {
  double error = 0, squared = 0;
  int runs = 0;
  double worst = -1;  // error of the worst map, which is shown
  CarRun worstRun{};
  Belief worstMap{};
};

inline Eigen::Matrix2Xd truePlaces(const CarRun& run, const std::vector<int>& names) {
  Eigen::Matrix2Xd places(2, static_cast<Eigen::Index>(names.size()));
  for (Eigen::Index k = 0; k < places.cols(); ++k)
    places.col(k) = run.landmarks.col(names[static_cast<std::size_t>(k)]);
  return places;
}

inline void judgeMap(rex::grading::Check& check, const CarRun& run, const MapBelief& map, MapQuality& total) {
  check.atLeast("number of landmarks in the map", static_cast<double>(map.names.size()), 2);
  const Eigen::Matrix2Xd truth = truePlaces(run, map.names);
  const Eigen::Matrix2Xd places = map.joint.mean.tail(truth.size()).reshaped(2, truth.cols());
  const double error = rex::absoluteTrajectoryError(places, truth);
  total.error += error * error;
  if (error > total.worst) {
    total.worst = error;
    total.worstRun = run;
    total.worstMap = map.joint;
  }
  Eigen::VectorXd all(map.joint.mean.size());
  all << run.states.back(), truth.reshaped();
  total.squared +=
      squaredError(gapOf(map.joint.mean, all), map.joint.covariance) / static_cast<double>(all.size());
  ++total.runs;
}

inline void requireMap(rex::grading::Check& check, const MapQuality& total, double mostError, double least,
                       double most) {
  const auto shown = check.show([&] { return mapSeen(total.worstRun, total.worstMap); });
  check.atMost("root mean square error of the landmarks after alignment", std::sqrt(total.error / total.runs),
               mostError, "m");
  const double squared = total.squared / total.runs;
  check.atMost("squared error relative to the covariance, per entry (1 expected)", squared, most);
  check.atLeast("squared error relative to the covariance, per entry (1 expected)", squared, least);
}

// A run in which the landmarks can be told apart: at least three are always in view, and none is nearer than
// 3 m.
inline CarRun clearRun(rex::Rng& rng, const CarSetup& car, int landmarks, const Eigen::Vector2d& u,
                       double range) {
  while (true) {
    const CarRun run = randomRun(rng, car, landmarks, 70, u);
    bool isClear = true;
    for (std::size_t t = 0; t < run.controls.size() && isClear; ++t)
      isClear = seenAt(run, t, 3).empty() && seenAt(run, t, range).size() >= 3;
    if (isClear) return run;
  }
}

// A run whose landmarks have no names. Sightings come in a random order.
struct NamelessMap {
  MapBelief map;
  std::vector<int> seen;  // how often each true landmark was seen
  int wrong = 0;          // how often a sighting was taken for another landmark
};

inline NamelessMap namelessMap(rex::grading::Check& check, Student& student, const CarRun& run,
                               double range) {
  NamelessMap found{{startBelief(), {}}, std::vector<int>(static_cast<std::size_t>(run.landmarks.cols())), 0};
  MapBelief& map = found.map;
  for (std::size_t t = 0; t < run.controls.size(); ++t) {
    map.joint = student.jointPredicted(run.car, map.joint, run.controls[t]);
    requireBelief(check, map.joint, sizeOf(map));
    std::vector<LandmarkObservation> seen = seenAt(run, t, range);
    for (std::size_t k = seen.size(); k > 1; --k)
      std::swap(seen[k - 1], seen[static_cast<std::size_t>(check.rng().index(static_cast<int>(k)))]);
    std::vector<Eigen::Vector2d> ys;
    for (const LandmarkObservation& one : seen) ys.push_back(one.y);
    const std::vector<int> names = student.assigned(run.car, map.joint, ys);
    check.near("number of names", static_cast<double>(names.size()), static_cast<double>(ys.size()), 0);
    const int known = static_cast<int>(map.names.size());
    for (std::size_t k = 0; k < names.size(); ++k) {
      ++found.seen[static_cast<std::size_t>(seen[k].landmark)];
      check.that("a name is that of a landmark in the map, or kNewLandmark, or kUnclear",
                 names[k] < known && names[k] >= kUnclear);
      check.that("no landmark is named twice",
                 names[k] < 0 || std::count(names.begin(), names.end(), names[k]) == 1);
      if (names[k] == kNewLandmark) {
        check.that("there are at most 20 landmarks in the map", map.names.size() < 20);
        enter(check, student, run.car, seen[k], map);
      }
      if (names[k] < 0) continue;
      map.joint = student.jointCorrected(run.car, map.joint, names[k], ys[k]);
      requireBelief(check, map.joint, sizeOf(map));
      if (map.names[static_cast<std::size_t>(names[k])] != seen[k].landmark) ++found.wrong;
    }
  }
  return found;
}

inline void judgeNameless(rex::grading::Check& check, Student& student, const CarRun& run, double range) {
  const NamelessMap found = namelessMap(check, student, run, range);
  const auto shown = check.show([&] { return mapSeen(run, found.map.joint); });
  const std::vector<int>& names = found.map.names;
  for (std::size_t i = 0; i < found.seen.size(); ++i) {
    const auto times = std::count(names.begin(), names.end(), static_cast<int>(i));
    check.that("no landmark is in the map twice", times <= 1);
    check.that("every landmark that was seen five times is in the map", times == 1 || found.seen[i] < 5);
  }
  check.near("sightings taken for another landmark", found.wrong, 0, 0);
  MapQuality total;
  judgeMap(check, run, found.map, total);
  check.atMost("root mean square error of the landmarks after alignment", std::sqrt(total.error), 0.4, "m");
}

// The squared gap between y and the expected view of landmark i, relative to the covariance of the gap.
inline double squaredGap(const CarSetup& car, const Belief& joint, int i, const Eigen::Vector2d& y) {
  const auto g = [&](const Eigen::VectorXd& z) { return seenFrom(car, z.head(3), z.segment(3 + 2 * i, 2)); };
  Eigen::Vector2d gap = y - g(joint.mean);
  if (car.rangeBearing) gap[1] = std::remainder(gap[1], 2 * kPi);
  const Eigen::MatrixXd C = derivative(g, joint.mean);
  return squaredError(gap, C * joint.covariance * C.transpose() + noiseOf(car, 1));
}

// A joint belief, sightings, and the names they should get.
struct NamingCase {
  Belief joint;
  std::vector<Eigen::Vector2d> ys;
  std::vector<int> names;
};

inline bool isClear(const CarSetup& car, const NamingCase& one) {
  for (std::size_t k = 0; k < one.ys.size(); ++k)
    for (int i = 0; i < 3; ++i) {
      const double squared = squaredGap(car, one.joint, i, one.ys[k]);
      const bool isNew = one.names[k] == kNewLandmark;
      if (isNew ? squared < 500 : i == one.names[k] ? squared > 1.9 : squared < 60) return false;
    }
  return true;
}

// The same with its landmarks in random order.
inline NamingCase renumbered(rex::Rng& rng, const NamingCase& one) {
  std::vector<int> order, numbers{0, 1, 2};
  for (int i = 0; i < 3; ++i) order.insert(order.begin() + rng.index(i + 1), i);
  for (const int i : order) numbers.insert(numbers.end(), {3 + 2 * i, 4 + 2 * i});
  NamingCase other{{one.joint.mean(numbers), one.joint.covariance(numbers, numbers)}, one.ys, one.names};
  for (int& name : other.names)
    if (name >= 0) name = static_cast<int>(std::find(order.begin(), order.end(), name) - order.begin());
  return other;
}

// Three landmarks, all known within centimetres, except for the first if it is vague. A vague first landmark
// is seen at a position nearer, in metres, to the second; otherwise a new landmark is seen within 3.5 m of
// the first. The last landmark is seen, too.
inline NamingCase namingCase(rex::Rng& rng, const CarSetup& car, bool isVague) {
  while (true) {
    NamingCase one{randomJoint(rng, 3), {}, {isVague ? 0 : kNewLandmark, 2}};
    Belief& joint = one.joint;
    Eigen::VectorXd scale = Eigen::VectorXd::Constant(9, 0.25);  // powers of two keep it exactly symmetric
    scale.head(3).setConstant(0.125);
    if (isVague) scale.segment(3, 2).setConstant(4);
    joint.covariance = (scale.asDiagonal() * joint.covariance * scale.asDiagonal()).eval();
    const Eigen::Vector2d first = joint.mean.segment(3, 2), second = first + rng.uniformVector(2, -2, 2),
                          last = joint.mean.tail(2), place = first + rng.uniformVector(2, -2.4, 2.4);
    joint.mean.segment(5, 2) = second;
    if (isVague && (place - second).norm() > 0.7 * (place - first).norm()) continue;
    for (const Eigen::Vector2d& l : {place, last}) one.ys.emplace_back(seenFrom(car, joint.mean.head(3), l));
    if (rng.index(2) == 0) {
      std::swap(one.ys[0], one.ys[1]);
      std::swap(one.names[0], one.names[1]);
    }
    if (isClear(car, one)) return renumbered(rng, one);
  }
}

inline std::string nameOf(int landmark) {
  return landmark >= 0 ? std::to_string(landmark) : landmark == kNewLandmark ? "new" : "unclear";
}

// The belief, and the name that each sighting got.
inline rex::grading::Evidence namesSeen(const CarSetup& car, const NamingCase& one,
                                        const std::vector<int>& names) {
  const Eigen::Vector3d pose = one.joint.mean.head<3>();
  rex::Figure figure = rex::figureOf({.car = pose, .landmarkBeliefs = landmarksOf(one.joint)});
  figure.title = "Landmarks of the belief, and the sightings";
  for (int i = 0; i < 3; ++i)
    figure.notes.push_back({std::to_string(i), one.joint.mean[3 + 2 * i], one.joint.mean[4 + 2 * i]});
  for (std::size_t k = 0; k < names.size(); ++k) {
    const double ahead = car.rangeBearing ? one.ys[k][0] * std::cos(one.ys[k][1]) : one.ys[k][0],
                 left = car.rangeBearing ? one.ys[k][0] * std::sin(one.ys[k][1]) : one.ys[k][1];
    const double c = std::cos(pose[2]), s = std::sin(pose[2]);
    figure.series.push_back(
        rex::grading::wrongPoint("seen: got " + nameOf(names[k]) + ", wanted " + nameOf(one.names[k]),
                                 pose[0] + c * ahead - s * left, pose[1] + s * ahead + c * left));
    if (names[k] == one.names[k]) figure.series.back().color = rex::grading::kWantedColor;
  }
  return {.figures = {figure}};
}

// Vague landmarks and new ones, with both sensors; shuffled, so that counting calls does not help.
inline void namesByCovariance(rex::grading::Check& check, Student& student) {
  rex::Rng& rng = check.rng();
  std::vector<int> kinds;
  for (int k = 0; k < 16; ++k) kinds.insert(kinds.begin() + rng.index(k + 1), k);
  for (const int kind : kinds) {
    CarSetup car;
    car.observationNoise = 0.05;
    car.bearingNoise = 0.01;
    car.rangeBearing = kind % 4 > 1;
    const bool isVague = kind % 2 == 0;
    check.input(isVague ? "a belief about three landmarks; a vague one, seen nearer to another one, and a "
                          "well-known one are seen"
                        : "a belief about three landmarks, all well known; one of them, and a new one within "
                          "3.5 m of another, are seen");
    const NamingCase one = namingCase(rng, car, isVague);
    const std::vector<int> names = student.assigned(car, one.joint, one.ys);
    check.near("number of names", static_cast<double>(names.size()), static_cast<double>(one.ys.size()), 0);
    const auto shown = check.show([&] { return namesSeen(car, one, names); });
    for (std::size_t k = 0; k < names.size(); ++k)
      check.near("name of a sighting, by its squared gap relative to the covariance", names[k], one.names[k],
                 0);
  }
}

// Compares maps and weights of random particles with corrections in canonical form. The landmarks are seen
// `offset` [m] away from their positions in the maps.
inline void weighsAsItShould(rex::grading::Check& check, Student& student, const CarSetup& car,
                             double offset) {
  rex::Rng& rng = check.rng();
  const Eigen::Vector3d x = randomState(rng);
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < 4; ++i) places.emplace_back(randomLandmark(rng, x));
  std::vector<MapParticle> particles;
  for (int k = 0; k < 12; ++k) {
    MapParticle particle{x + 0.1 * rng.normalVector(3), rng.uniform(0.5, 1.5) / 12, {}};
    for (std::size_t i = 0; i < 3; ++i)
      particle.map.push_back({places[i] + 0.2 * rng.normalVector(2), randomCovariance(rng, 2)});
    particles.push_back(particle);
  }
  const Eigen::Vector2d far(offset, 0);
  std::vector<LandmarkObservation> seen;
  for (const int i : {2, 0, 3})
    seen.push_back({i, seenFrom(car, x, places[static_cast<std::size_t>(i)] + far)});
  const std::vector<MapParticle> after = student.weighed(car, particles, seen);
  check.near("number of particles", static_cast<double>(after.size()), 12, 0);
  Eigen::VectorXd logs(12), weights(12);
  const Eigen::Matrix2d W = noiseOf(car, 1);
  for (std::size_t k = 0; k < 12; ++k) {
    const auto& [stateGiven, weightGiven, mapGiven] = particles[k];
    check.near("state of a particle", after[k].x, stateGiven, 0);
    check.near("number of landmarks in a map", static_cast<double>(after[k].map.size()), 4, 0);
    double log = std::log(weightGiven);
    for (const LandmarkObservation& one : seen) {
      const auto i = static_cast<std::size_t>(one.landmark);
      const auto g = [&](const Eigen::VectorXd& l) { return seenFrom(car, stateGiven, l); };
      if (i == 3) {
        check.shape("position of the new landmark", after[k].map[3].mean, 2, 1);
        check.near("view of the new landmark", g(after[k].map[3].mean), one.y, 1e-9);
        const Eigen::Matrix2d D = derivative(g, after[k].map[3].mean);
        sameBelief(check, after[k].map[3],
                   {after[k].map[3].mean, (D.transpose() * W.inverse() * D).inverse()}, 1e-6);
        continue;
      }
      const Eigen::Matrix2d D = derivative(g, mapGiven[i].mean);
      Eigen::Vector2d gap = one.y - g(mapGiven[i].mean);
      if (car.rangeBearing) gap[1] = std::remainder(gap[1], 2 * kPi);
      const Eigen::Matrix2d S = D * mapGiven[i].covariance * D.transpose() + W;
      log -= 0.5 * (squaredError(gap, S) + std::log(S.determinant()));
      sameBelief(check, after[k].map[i], informed(mapGiven[i], gap, D, W), 1e-6);
    }
    sameBelief(check, after[k].map[1], mapGiven[1], 0);
    logs[static_cast<Eigen::Index>(k)] = log;
    weights[static_cast<Eigen::Index>(k)] = after[k].weight;
  }
  const Eigen::VectorXd wanted = (logs.array() - logs.maxCoeff()).exp();
  check.near("weights", weights, wanted / wanted.sum(), 1e-5);
}
