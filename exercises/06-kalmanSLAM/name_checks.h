#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "map_checks.h"

// Part 5: landmarks without names.

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

// The gap between y and the expected view of landmark i, and its covariance.
struct ViewGap {
  Eigen::Vector2d gap;
  Eigen::Matrix2d covariance;
};

inline ViewGap gapTo(const CarSetup& car, const Belief& joint, int i, const Eigen::Vector2d& y) {
  const auto g = [&](const Eigen::VectorXd& z) { return seenFrom(car, z.head(3), z.segment(3 + 2 * i, 2)); };
  const Eigen::VectorXd expected = g(joint.mean);
  const Eigen::MatrixXd C =
      derivative([&](const Eigen::VectorXd& z) { return gapsOf(car, g(z), expected); }, joint.mean);
  return {gapsOf(car, y, expected), sum(carried(C, joint.covariance), noiseOf(car, 1))};
}

// The squared gap, relative to its covariance.
inline double squaredGap(const CarSetup& car, const Belief& joint, int i, const Eigen::Vector2d& y) {
  const ViewGap view = gapTo(car, joint, i, y);
  return squaredError(view.gap, view.covariance);
}

// A run whose landmarks have no names. Sightings come in a random order.
struct NamelessMap {
  MapBelief map;
  std::vector<int> seen;  // how often each true landmark was seen
  int unclear = 0,
      known = 0;  // how many sightings of landmarks in the map are unclear, and how many there are
};

// A landmark that was named wrongly once is a wrong landmark of the map for good, so the name of each
// sighting is that of its landmark, or kUnclear.
inline void nameFits(rex::grading::Check& check, const CarRun& run, const MapBelief& map, int name,
                     const LandmarkObservation& seen, const std::string& where) {
  const int wanted = numberIn(map, seen.landmark);
  if (name == kUnclear || name == wanted) return;
  double squared = 0;
  if (wanted >= 0) {
    const ViewGap view = gapTo(run.car, map.joint, wanted, seen.y);
    squared = squaredError(view.gap, view.covariance);
    check.input(where, {{"y", seen.y},
                        {fmt::format("gap to landmark {}", wanted), view.gap},
                        {"its covariance", view.covariance},
                        {"squared gap, relative to it", squared}});
  } else {
    check.input(where, {{"y", seen.y},
                        {"squared gap to the landmark named", squaredGap(run.car, map.joint, name, seen.y)}});
  }
  const bool isDouble = name == kNewLandmark;
  const auto narrow = check.ask(
      "Is every sighting new whose squared gap is beyond a bound? Of a hundred right ones, one is beyond "
      "9.2: "
      "what is too far to be a known landmark may be too near to be a new one.",
      isDouble && squared < 40);
  const auto metres =
      check.ask("Is a sighting new beyond a number of metres? Measure the gap relative to its covariance.",
                isDouble && squared >= 40);
  const auto mixed = check.ask(
      "Is the landmark with the smallest gap taken, however large that is relative to its covariance?",
      !isDouble);
  check.near("name of a sighting by assigned (-1: new)", name, wanted, 0);
}

inline NamelessMap namelessMap(rex::grading::Check& check, Student& student, const CarRun& run,
                               double range) {
  NamelessMap found{{startBelief(), {}}, std::vector<int>(static_cast<std::size_t>(run.landmarks.cols()))};
  MapBelief& map = found.map;
  const auto shown =
      check.show([&]() -> rex::grading::Evidence { return {.figures = {mapSeen(run, map.joint)}}; });
  for (std::size_t t = 0; t < run.controls.size(); ++t) {
    const std::string where = fmt::format("step {} of {}, {} landmarks in the map, {}", t + 1,
                                          run.controls.size(), map.names.size(), described(run.car));
    check.input(where);
    moveOn(check, student, run, t, map);
    std::vector<LandmarkObservation> seen = seenAt(run, t, range);
    for (std::size_t k = seen.size(); k > 1; --k)
      std::swap(seen[k - 1], seen[static_cast<std::size_t>(check.rng().index(static_cast<int>(k)))]);
    std::vector<Eigen::Vector2d> ys;
    for (const LandmarkObservation& one : seen) ys.push_back(one.y);
    const std::vector<int> names = student.assigned(run.car, map.joint, ys);
    check.near("number of names by assigned", static_cast<double>(names.size()),
               static_cast<double>(ys.size()), 0);
    const MapBelief before = map;
    const auto known = static_cast<int>(before.names.size());
    for (std::size_t k = 0; k < names.size(); ++k) {
      ++found.seen[static_cast<std::size_t>(seen[k].landmark)];
      check.that("a name by assigned is that of a landmark in the map, or kNewLandmark, or kUnclear",
                 names[k] < known && names[k] >= kUnclear);
      check.that("no landmark is named twice by assigned",
                 names[k] < 0 || std::count(names.begin(), names.end(), names[k]) == 1);
      nameFits(check, run, before, names[k], seen[k], where);
      if (numberIn(before, seen[k].landmark) >= 0) {
        ++found.known;
        if (names[k] == kUnclear) ++found.unclear;
      }
      if (names[k] == kNewLandmark) enter(check, student, run.car, seen[k], map);
      if (names[k] >= 0) correct(check, student, run.car, names[k], ys[k], map);
    }
  }
  return found;
}

inline void judgeNameless(rex::grading::Check& check, Student& student, const CarRun& run, double range) {
  const NamelessMap found = namelessMap(check, student, run, range);
  const auto shown =
      check.show([&]() -> rex::grading::Evidence { return {.figures = {mapSeen(run, found.map.joint)}}; });
  check.input(fmt::format("a run of {} steps, {}", run.controls.size(), described(run.car)),
              {{"true landmarks", run.landmarks}});
  for (std::size_t i = 0; i < found.seen.size(); ++i) {
    const bool isThere = numberIn(found.map, static_cast<int>(i)) >= 0;
    const auto never = check.ask("Is any sighting ever called new?", found.map.names.empty());
    if (!isThere) check.atMost("sightings of a landmark that assigned never calls new", found.seen[i], 4);
  }
  const auto vague =
      check.ask("Are most sightings unclear? The map needs them.", 2 * found.unclear > found.known);
  check.atMost("root mean square error of the landmarks, after aligning the map with the true one",
               errorOf(check, run, found.map), 0.4, "m");
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
// the first. The last landmark is seen, too, and straight behind the car.
inline NamingCase namingCase(rex::Rng& rng, const CarSetup& car, bool isVague) {
  while (true) {
    NamingCase one{randomJoint(rng, 3), {}, {isVague ? 0 : kNewLandmark, 2}};
    Belief& joint = one.joint;
    Eigen::VectorXd scale = Eigen::VectorXd::Constant(9, 0.25);  // powers of two keep it exactly symmetric
    scale.head(3).setConstant(0.125);
    if (isVague) scale.segment(3, 2).setConstant(4);
    joint.covariance = (scale.asDiagonal() * joint.covariance * scale.asDiagonal()).eval();
    joint.mean.tail(2) = placeBehind(rng, joint.mean.head(3));
    const Eigen::Vector2d first = joint.mean.segment(3, 2), second = first + rng.uniformVector(2, -2, 2),
                          last = joint.mean.tail(2), place = first + rng.uniformVector(2, -2.4, 2.4);
    joint.mean.segment(5, 2) = second;
    if (isVague && (place - second).norm() > 0.7 * (place - first).norm()) continue;
    for (const Eigen::Vector2d& l : {place, last}) one.ys.emplace_back(seenFrom(car, joint.mean.head(3), l));
    if (car.rangeBearing) one.ys[1][1] = rex::wrapAngle(one.ys[1][1] + 2e-3);
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
  rex::Figure figure = rex::carFigure({.car = pose, .landmarkBeliefs = landmarksOf(one.joint)});
  figure.title = "Landmarks of the belief, and the sightings";
  for (int i = 0; i < 3; ++i)
    figure.notes.push_back({std::to_string(i), one.joint.mean[3 + 2 * i], one.joint.mean[4 + 2 * i]});
  for (std::size_t k = 0; k < names.size(); ++k) {
    const Eigen::Vector2d place = rex::landmarkPosition(sensorOf(car), pose, one.ys[k]).landmark;
    figure.series.push_back(rex::grading::wrongPoint(
        "seen: got " + nameOf(names[k]) + ", wanted " + nameOf(one.names[k]), place.x(), place.y()));
    if (names[k] == one.names[k]) figure.series.back().color = rex::grading::kWantedColor;
  }
  return {.figures = {figure}};
}

// What could have led to a wrong name, if anything.
inline std::string questionAboutName(const CarSetup& car, const NamingCase& one, std::size_t k,
                                     const std::vector<int>& names) {
  const int got = names[k], wanted = one.names[k];
  if (std::equal(names.begin(), names.end(), one.names.rbegin(), one.names.rend()))
    return "Are the names in the order of the sightings?";
  int nearest = 0, inMetres = 0;
  double least = 1e9, way = 1e9, ofSensor = 1e9;
  const Eigen::Vector2d place =
      rex::landmarkPosition(sensorOf(car), one.joint.mean.head<3>(), one.ys[k]).landmark;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d gap = gapTo(car, one.joint, i, one.ys[k]).gap;
    if (gap.norm() < least) nearest = i;
    least = std::min(least, gap.norm());
    const double metres = (place - one.joint.mean.segment(3 + 2 * i, 2)).norm();
    if (metres < way) inMetres = i;
    way = std::min(way, metres);
    if (i == wanted) ofSensor = squaredError(gap, noiseOf(car, 1));
  }
  const Eigen::Vector2d plain = one.ys[k] - seenFrom(car, one.joint.mean.head(3),
                                                     one.joint.mean.segment(3 + 2 * std::max(wanted, 0), 2));
  if (car.rangeBearing && wanted >= 0 && std::abs(plain[1]) > 5)
    return "Is the difference of the bearings not wrapped? viewGap does it.";
  if (wanted == kNewLandmark && got >= 0)
    return "Is a new landmark taken for a known one that is a few metres away? The gap counts relative to "
           "its covariance.";
  if (wanted >= 0 && got < 0 && ofSensor > 9)
    return "Is the gap compared with the noise of the sensor alone? The landmark is uncertain, too.";
  if ((got == nearest || got == inMetres) && wanted >= 0)
    return "Is it the landmark with the smallest gap in metres, or by the noise of the sensor alone? The "
           "others are less certain.";
  return "";
}

// Two sightings of one landmark, only one of which can have its name.
inline void namesOnlyOnce(rex::grading::Check& check, Student& student) {
  const CarSetup car{.observationNoise = 0.05, .bearingNoise = 0.01};
  NamingCase one = namingCase(check.rng(), car, false);
  const std::size_t k = one.names[0] >= 0 ? 0 : 1;
  one.ys.emplace_back(one.ys[k] + Eigen::Vector2d(0.01, -0.02));
  check.input(described(car), {{"one y", one.ys[k]}, {"another y", one.ys.back()}});
  const std::vector<int> names = student.assigned(car, one.joint, one.ys);
  check.near("number of names by assigned", static_cast<double>(names.size()), 3, 0);
  const auto both = check.ask("What if two sightings want the same landmark?");
  check.atMost("sightings that get the same landmark by assigned",
               static_cast<double>(std::count(names.begin(), names.end(), one.names[k])), 1);
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
    const NamingCase one = namingCase(rng, car, kind % 2 == 0);
    const std::vector<int> names = student.assigned(car, one.joint, one.ys);
    check.near("number of names by assigned", static_cast<double>(names.size()),
               static_cast<double>(one.ys.size()), 0);
    const auto shown = check.show([&] { return namesSeen(car, one, names); });
    for (std::size_t k = 0; k < names.size(); ++k) {
      Eigen::Vector3d squares;
      for (int i = 0; i < 3; ++i) squares[i] = squaredGap(car, one.joint, i, one.ys[k]);
      check.input(described(car),
                  {{"x", one.joint.mean.head(3)},
                   {"landmarks", one.joint.mean.tail(6).reshaped(2, 3)},
                   {"their variances", one.joint.covariance.diagonal().tail(6).reshaped(2, 3)},
                   {"y", one.ys[k]},
                   {"squared gaps relative to their covariances", squares}});
      const std::string question = questionAboutName(car, one, k, names);
      const auto asked = check.ask(question, names[k] != one.names[k] && !question.empty());
      check.near("name of a sighting by assigned (-1: new, -2: unclear)", names[k], one.names[k], 0);
    }
  }
  namesOnlyOnce(check, student);
}
