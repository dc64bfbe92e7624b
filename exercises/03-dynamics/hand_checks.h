#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "arm_checks.h"
#include "course/film.h"
#include "grading/check.h"
#include "grading/evidence.h"
#include "interface.h"

// Part 6: a hand that follows a path.

// The reference of a hand: once along a path, from rest to rest in three seconds, with the sine profile.
struct Path {
  Eigen::Vector3d start, along, out;  ///< a line to start + along; with `out`, a circle with that radius
  PathPoint at(double t) const {
    const double w = std::numbers::pi / 3, s = (1 - std::cos(w * t)) / 2, sd = w * std::sin(w * t) / 2,
                 sdd = w * w * std::cos(w * t) / 2;
    if (out.isZero()) return {start + s * along, sd * along, sdd * along};
    const double turn = 2 * std::numbers::pi, angle = turn * s;
    const Eigen::Vector3d x = std::cos(angle) * out + std::sin(angle) * along,
                          xd = turn * (-std::sin(angle) * out + std::cos(angle) * along);
    return {start + x - out, sd * xd, sdd * xd - turn * turn * sd * sd * x};
  }
};

// The hand and its wanted point on the path, which is red.
inline rex::grading::Evidence handSeen(const rex::Simulator& S, const std::string& hand, const Path& path,
                                       const std::vector<Eigen::VectorXd>& moments) {
  std::vector<Eigen::Vector3d> way;
  for (int step = 0; step <= 300; ++step) way.emplace_back(path.at(kTau * step).y);
  rex::Film film = rex::makeFilm(
      S, moments, {.caption = "wanted: the hand on the red point", .traces = {hand}, .paths = {way}});
  for (std::size_t i = 0; i < film.size(); ++i) {
    film[i].time = kTau * static_cast<double>(i);
    film[i].picture.pointSets.push_back(
        {.points = {way[std::min(i, way.size() - 1)]}, .color = rex::grading::kWrongColor, .size = 9});
  }
  return {.film = std::move(film)};
}

inline std::size_t firstBeyond(const rex::grading::Signal& signal, double limit) {
  std::size_t i = 0;
  while (i < signal.values.size() && signal.values[i][0] <= limit) ++i;
  return i;
}

// The reference solution stays within 0.6 mm and 0.6 rad/s on all of 60 paths. What goes wrong first is
// reported first.
inline void handFollows(rex::grading::Check& check, Student& student, rex::Simulator S,
                        const std::string& hand, const Path& path) {
  constexpr double kFarthest = 5e-3, kFastest = 5;
  const rex::Simulator atFirst = S;
  ArmRecord record("followWithHand");
  rex::grading::Signal errors{.axis = "time [s]"};
  for (int step = 0; step <= 300 && !record.isOver; ++step) {
    const PathPoint reference = path.at(kTau * step);
    errors.add(kTau * step, (S.kinematicsPos(hand) - reference.y).norm());
    if (step < 300) advance(check, record, S, student.followWithHand(S.description(), hand, reference));
  }
  const auto shown = check.show([&] { return handSeen(atFirst, hand, path, record.moments); });
  const auto joints = [&] {
    check.atMostAlong("largest joint speed under followWithHand", record.speeds, kFastest, "rad/s");
  };
  if (firstBeyond(record.speeds, kFastest) < firstBeyond(errors, kFarthest)) {
    const auto free =
        check.ask("The hand is still on its path: does nothing damp the joint motions it leaves free?");
    joints();
  }
  check.atMostAlong("distance of the hand from its reference under followWithHand", errors, kFarthest, "m");
  joints();
  couldBeSimulated(check, record);
}
