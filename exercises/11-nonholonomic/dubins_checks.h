#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "car_checks.h"
#include "planning/car_curves.h"

// Part 3: words, and the shortest of them.

inline const std::array<std::string, 6> kNames{"LSL", "LSR", "RSL", "RSR", "LRL", "RLR"};

/// Where the pieces lead. The steering angle of a car with a wheelbase of 1 makes the radius.
inline Eigen::Vector3d endOf(const std::string& word, const std::array<double, 3>& lengths, Eigen::Vector3d q,
                             double radius) {
  for (std::size_t i = 0; i < 3; ++i) {
    const double steering = word[i] == 'S' ? 0 : std::atan(1 / radius) * (word[i] == 'L' ? 1 : -1);
    q = rex::driveCar({1, 1.57}, q, {1, steering}, lengths[i]);
  }
  return q;
}

/// Between the centres of the first and the last circle.
inline double gapOf(const std::string& word, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                    double radius) {
  const auto center = [&](const Eigen::Vector3d& q, char side) -> Eigen::Vector2d {
    return moved(q, {0, side == 'L' ? radius : -radius, 0}).head<2>();
  };
  return (center(to, word[2]) - center(from, word[0])).norm();
}

/// Poses along the pieces, every fiftieth of each.
inline Poses piecesOf(const std::string& word, const std::array<double, 3>& lengths,
                      const Eigen::Vector3d& from, double radius) {
  Poses poses{from};
  std::array<double, 3> driven{};
  for (std::size_t i = 0; i < 3; ++i)
    for (int part = 1; part <= 50; ++part) {
      driven[i] = lengths[i] * part / 50;
      poses.push_back(endOf(word, driven, from, radius));
    }
  return poses;
}

/// What to ask about pieces that do not lead there, or have impossible lengths.
inline std::string whyAstray(const std::string& word, const std::array<double, 3>& lengths,
                             const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
  const auto leads = [&](const std::string& by, const std::array<double, 3>& along) {
    const Eigen::Vector3d end = endOf(by, along, from, radius);
    return (end - to).head<2>().norm() < 1e-5 && std::abs(wrapped(end[2] - to[2])) < 1e-5;
  };
  std::array<double, 3> positive = lengths, arcs = lengths, all = lengths;
  std::string mirrored = word;
  for (std::size_t i = 0; i < 3; ++i) {
    all[i] *= radius;
    if (word[i] == 'S') continue;
    positive[i] += lengths[i] < 0 ? 2 * kPi * radius : 0;
    arcs[i] *= radius;
    mirrored[i] = word[i] == 'L' ? 'R' : 'L';
  }
  const bool isSame = leads(word, lengths);
  if (isSame && positive != lengths && leads(word, positive))
    return "Is an arc taken the shorter way round, backward? Its angle is from 0 to 2 pi.";
  if (isSame && lengths[1] < 0) return "Is the straight piece driven backward?";
  if (isSame && word[1] != 'S' && lengths[1] < kPi * radius)
    return "Is it the other of the two circles in the middle? Its arc is longer than half a turn.";
  if (radius != 1 && leads(word, arcs)) return "Are arcs angles? Wanted is their length: angle times radius.";
  if (radius != 1 && leads(word, all)) return "Are lengths in units of the radius? Wanted are metres.";
  if (leads(mirrored, lengths)) return "Are left and right exchanged?";
  return "";
}

/// `function` is the one that returned the pieces.
inline void checkPieces(rex::grading::Check& check, const std::string& function, const std::string& word,
                        const std::array<double, 3>& lengths, const Eigen::Vector3d& from,
                        const Eigen::Vector3d& to, double radius) {
  for (const double length : lengths)
    check.atMost("length of a piece of " + function, length, 1000 * radius, "m");
  for (const double length : lengths)
    check.atLeast("length of a piece of " + function, length, -1000 * radius, "m");
  check.input(word, {{"from", from},
                     {"to", to},
                     {"radius", radius},
                     {"your lengths", Eigen::Vector3d(lengths[0], lengths[1], lengths[2])}});
  const auto isLong = [&](std::size_t i) {
    const double least = i == 1 && word[1] != 'S' ? kPi * radius - 1e-6 : 0;
    return lengths[i] >= least && (word[i] == 'S' || lengths[i] <= 2 * kPi * radius + 1e-6);
  };
  const auto shown = check.show([&] {
    const Poses pieces = piecesOf(word, lengths, from, radius);
    rex::grading::Evidence evidence =
        dubinsSeen(word + " from start to goal", pieces, from, to, radius, false);
    for (std::size_t i = 0; i < 3; ++i)
      if (!isLong(i)) {
        const auto first = pieces.begin() + 50 * static_cast<std::ptrdiff_t>(i);
        evidence.figures.front().series.push_back(rex::through(
            Poses(first, first + 51), rex::grading::wrongCurve("a piece of impossible length", {}, {})));
        break;
      }
    return evidence;
  });
  const auto asked = check.ask(whyAstray(word, lengths, from, to, radius));
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string piece = fmt::format("length of piece {} of {} by {}", i + 1, word, function);
    check.atLeast(piece, lengths[i], 0, "m");
    if (word[i] != 'S') check.atMost(piece, lengths[i], 2 * kPi * radius + 1e-6, "m");
  }
  if (word[1] != 'S')
    check.atLeast("length of the middle arc of " + word + " by " + function, lengths[1], kPi * radius - 1e-6,
                  "m");
  const Eigen::Vector3d end = endOf(word, lengths, from, radius);
  check.near("position at the end of " + word + " by " + function, end.head<2>(), to.head<2>(), 1e-5, "m");
  check.nearAngle("heading at the end of " + word + " by " + function, end[2], to[2], 1e-5);
}

/// The circles on which a word begins and ends.
inline rex::grading::Evidence circlesSeen(const std::string& title, const std::string& word,
                                          const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                          double radius) {
  rex::grading::Evidence evidence = dubinsSeen(title, {from, to}, from, to, radius, false);
  rex::Figure& figure = evidence.figures.front();
  figure.series.clear();
  for (const auto& [q, turn] : {std::pair{from, word[0]}, {to, word[2]}}) {
    const std::array<double, 3> whole{2 * kPi * radius, 0, 0};
    const bool isFirst = figure.series.empty();
    figure.series.push_back(
        rex::through(piecesOf(std::string(3, turn), whole, q, radius),
                     {.label = isFirst ? "first and last circle" : "", .color = rex::grading::kWantedColor}));
  }
  return evidence;
}

inline void wordLeads(rex::grading::Check& check, Student& student, int k, bool isFar) {
  const std::string& name = kNames[static_cast<std::size_t>(k)];
  rex::Rng& rng = check.rng();
  const double radius = rng.uniform(0.5, 5);
  const Eigen::Vector3d from = randomPose(rng, 10);
  Eigen::Vector3d to = randomPose(rng, isFar ? 4 * radius : radius);
  to.head<2>() += from.head<2>();
  const double gap = gapOf(name, from, to, radius) / radius;
  const bool crosses = name[1] == 'S' && name[0] != name[2], turns = name[1] != 'S';
  if ((crosses && std::abs(gap - 2) < 1e-3) || (turns && std::abs(gap - 4) < 1e-3)) return;
  const bool exists = crosses ? gap > 2 : turns ? gap < 4 : true;
  check.input(name, {{"from", from}, {"to", to}, {"radius", radius}});
  const auto lengths = student.dubinsLengths(static_cast<DubinsWord>(k), from, to, radius);
  {
    const auto shown = check.show([&] {
      return circlesSeen(name + (exists ? "; wanted: it leads there" : "; wanted: it does not lead there"),
                         name, from, to, radius);
    });
    const auto asked = check.ask(
        exists
            ? turns
                  ? "Is the word left out? Three circles touch if the outer centres are less than 4 r apart."
                  : "Is the word left out? Which line touches both circles?"
        : turns ? "Can three circles touch if the outer centres are more than 4 r apart?"
                : "Does a line cross from one circle to the other if they overlap?");
    check.that(fmt::format("dubinsLengths returns {} for {}, which {} there", exists ? "lengths" : "nothing",
                           name, exists ? "leads" : "does not lead"),
               lengths.has_value() == exists);
  }
  if (lengths) checkPieces(check, "dubinsLengths", name, *lengths, from, to, radius);
}

/// What to ask if a returned path is longer than the shortest.
inline std::string whyLonger(Student& student, double got, const Eigen::Vector3d& from,
                             const Eigen::Vector3d& to, double radius) {
  double least = INFINITY, straight = INFINITY, most = 0;
  for (int k = 0; k < 6; ++k) {
    const auto lengths = student.dubinsLengths(static_cast<DubinsWord>(k), from, to, radius);
    if (!lengths.has_value()) continue;
    const double sum = (*lengths)[0] + (*lengths)[1] + (*lengths)[2];
    least = std::min(least, sum);
    most = std::max(most, sum);
    if (k < 4) straight = std::min(straight, sum);
  }
  if (least > got - 1e-6) return "";  // none of their words is shorter
  if (std::abs(got - straight) < 1e-6) return "Are the words with three arcs, LRL and RLR, not asked for?";
  return std::abs(got - most) < 1e-6 ? "Is it the longest word?"
                                     : "Is every word asked for? One of your dubinsLengths is shorter.";
}

inline void isShortest(rex::grading::Check& check, Student& student, const Eigen::Vector3d& from,
                       const Eigen::Vector3d& to, double radius) {
  check.input("two poses", {{"from", from}, {"to", to}, {"radius", radius}});
  const DubinsWay way = student.shortestDubins(from, to, radius);
  const auto word = static_cast<std::size_t>(way.word);
  check.that("the word of shortestDubins is one of the six", word < 6);
  checkPieces(check, "shortestDubins", kNames[word], way.lengths, from, to, radius);
  const auto shown = check.show([&] {
    return dubinsSeen("The shortest of six", piecesOf(kNames[word], way.lengths, from, radius), from, to,
                      radius, true);
  });
  const double got = way.lengths[0] + way.lengths[1] + way.lengths[2],
               wanted = rex::dubinsLength(from, to, radius);
  const auto asked = check.ask(got > wanted + 1e-6 ? whyLonger(student, got, from, to, radius) : "");
  check.near("length of the way of shortestDubins", got, wanted, 1e-6, "m");
}
