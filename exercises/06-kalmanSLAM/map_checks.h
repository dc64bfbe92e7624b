#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "belief_checks.h"
#include "belief_evidence.h"
#include "interface.h"

// Whole runs of SLAM with the functions of part 4, and how good their maps are.

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

// The number in the map of a true landmark, or kNewLandmark.
inline int numberIn(const MapBelief& map, int landmark) {
  const auto known = std::find(map.names.begin(), map.names.end(), landmark);
  return known == map.names.end() ? kNewLandmark : static_cast<int>(known - map.names.begin());
}

inline void moveOn(rex::grading::Check& check, Student& student, const CarRun& run, std::size_t t,
                   MapBelief& map) {
  map.joint = student.jointPredicted(run.car, map.joint, run.controls[t]);
  requireBelief(check, "jointPredicted", map.joint, sizeOf(map));
}

inline void enter(rex::grading::Check& check, Student& student, const CarSetup& car,
                  const LandmarkObservation& seen, MapBelief& map) {
  map.joint = student.withLandmark(car, map.joint, seen.y);
  map.names.push_back(seen.landmark);
  requireBelief(check, "withLandmark", map.joint, sizeOf(map));
}

inline void correct(rex::grading::Check& check, Student& student, const CarSetup& car, int number,
                    const Eigen::Vector2d& y, MapBelief& map) {
  map.joint = student.jointCorrected(car, map.joint, number, y);
  requireBelief(check, "jointCorrected", map.joint, sizeOf(map));
}

inline MapBelief mapped(rex::grading::Check& check, Student& student, const CarRun& run, double range) {
  MapBelief map{startBelief(), {}};
  for (std::size_t t = 0; t < run.controls.size(); ++t) {
    moveOn(check, student, run, t, map);
    for (const LandmarkObservation& seen : seenAt(run, t, range)) {
      const int number = numberIn(map, seen.landmark);
      if (number < 0)
        enter(check, student, run.car, seen, map);
      else
        correct(check, student, run.car, number, seen.y, map);
    }
  }
  return map;
}

inline Eigen::Matrix2Xd truePlaces(const CarRun& run, const std::vector<int>& names) {
  Eigen::Matrix2Xd places(2, static_cast<Eigen::Index>(names.size()));
  for (Eigen::Index k = 0; k < places.cols(); ++k)
    places.col(k) = run.landmarks.col(names[static_cast<std::size_t>(k)]);
  return places;
}

// The root mean square error of the landmarks [m], after the rigid motion that brings them nearest to the
// truth.
inline double errorOf(rex::grading::Check& check, const CarRun& run, const MapBelief& map) {
  check.atLeast("number of landmarks in the map", static_cast<double>(map.names.size()), 2);
  const Eigen::Matrix2Xd truth = truePlaces(run, map.names);
  return rex::absoluteTrajectoryError(map.joint.mean.tail(truth.size()).reshaped(2, truth.cols()), truth);
}

// For each run, the error of its map, and the squared error of the joint belief relative to its covariance,
// per entry.
struct MapQuality {
  std::vector<double> errors{}, squares{};
  CarRun worstRun{};  // shown
  Belief worstMap{};
};

inline void judgeMap(rex::grading::Check& check, const CarRun& run, const MapBelief& map, MapQuality& total) {
  const double error = errorOf(check, run, map);
  if (total.errors.empty() || error > *std::max_element(total.errors.begin(), total.errors.end())) {
    total.worstRun = run;
    total.worstMap = map.joint;
  }
  total.errors.push_back(error);
  Eigen::VectorXd all(map.joint.mean.size());
  all << run.states.back(), truePlaces(run, map.names).reshaped();
  total.squares.push_back(squaredError(gapOf(map.joint.mean, all), map.joint.covariance) /
                          static_cast<double>(all.size()));
}

inline void requireMap(rex::grading::Check& check, const MapQuality& total, double mostError, double least,
                       double most) {
  const auto runs = static_cast<double>(total.errors.size());
  double sum = 0, squared = 0;
  for (const double error : total.errors) sum += error * error / runs;
  for (const double square : total.squares) squared += square / runs;
  {
    const auto shown = check.show([&]() -> rex::grading::Evidence {
      return {.figures = {overRuns("Errors of the maps", "root mean square [m]", total.errors,
                                   {{.at = mostError, .label = "at most, over all runs"}}),
                          mapSeen(total.worstRun, total.worstMap)}};
    });
    check.atMost("root mean square error of the landmarks, after aligning each map with the true one",
                 std::sqrt(sum), mostError, "m");
  }
  const auto shown = check.show([&]() -> rex::grading::Evidence {
    return {.figures = {overRuns("Squared errors, relative to the covariance", "per entry", total.squares,
                                 {{.at = most, .label = "at most, on average"},
                                  {.at = least, .label = "at least, on average"}}),
                        mapSeen(total.worstRun, total.worstMap)}};
  });
  const auto small =
      check.ask("Is the joint covariance too small? The errors are larger than it says.", squared > most);
  const auto large =
      check.ask("Is the joint covariance too large? The errors are smaller than it says.", squared < least);
  const char* property = "squared error of the map relative to its covariance, per entry (1 expected)";
  check.atMost(property, squared, most);
  check.atLeast(property, squared, least);
}
