#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "car_evidence.h"
#include "interface.h"
#include "lots.h"
#include "overlaps.h"
#include "systems/car.h"

// Part 1, and what all checks of drives require.

inline double wrapped(double angle) { return std::remainder(angle, 2 * kPi); }

/// Where a drive leads according to the library, which has no limits here.
inline Eigen::Vector3d exact(const CarModel& car, const Eigen::Vector3d& q, const Drive& drive,
                             double share = 1) {
  return rex::driveCar({car.wheelbase, 1.5}, q, {drive.speed, drive.steering}, share * drive.seconds);
}

inline CarModel randomCar(rex::Rng& rng) {
  CarModel car;
  car.wheelbase = rng.uniform(2.2, 3.2);
  car.maxSteering = rng.uniform(0.45, 0.65);
  car.minSteering = -car.maxSteering;
  car.back = rng.uniform(0.5, 1);
  car.front = car.wheelbase + rng.uniform(0.5, 1);
  car.width = rng.uniform(1.5, 1.9);
  return car;
}

inline Eigen::Vector3d randomPose(rex::Rng& rng, double reach) {
  return {rng.uniform(-reach, reach), rng.uniform(-reach, reach), rng.uniform(-10, 10)};
}

/// Speed, steering angle and seconds.
inline Eigen::Vector3d numbersOf(const Drive& drive) { return {drive.speed, drive.steering, drive.seconds}; }

/// One row (x, y, heading, length, width) for each.
inline Eigen::MatrixXd numbersOf(const std::vector<Block>& blocks) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(blocks.size()), 5);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const Block& block = blocks[static_cast<std::size_t>(i)];
    rows(i, 0) = block.middle[0];
    rows(i, 1) = block.middle[1];
    rows(i, 2) = block.middle[2];
    rows(i, 3) = block.length;
    rows(i, 4) = block.width;
  }
  return rows;
}

/// `drive` says which one it is: "drive 3 of park".
inline void checkLimits(rex::grading::Check& check, const CarModel& car, const Drive& drive,
                        const std::string& name) {
  check.atMost("|speed| of " + name, std::abs(drive.speed), 1 + 1e-9, "m/s");
  check.atMost("steering angle of " + name, drive.steering, car.maxSteering + 1e-9, "rad");
  {
    const auto left =
        check.ask("Does the car steer to the right? Its minSteering is 0.", car.minSteering == 0);
    check.atLeast("steering angle of " + name, drive.steering, car.minSteering - 1e-9, "rad");
  }
  check.atLeast("seconds of " + name, drive.seconds, 0, "s");
  check.atMost("seconds of " + name, drive.seconds, 200, "s");
}

/// Every 4 cm of the way: corners then move by 6 cm at most, and 5 cm are tolerated. If something is touched,
/// the input says where.
inline void isFreeAlong(rex::grading::Check& check, const CarModel& car, const Eigen::Vector3d& from,
                        const Drive& drive, const std::vector<Block>& blocks, const std::string& name) {
  const CarModel smaller = grown(car, -0.05);
  const int tests = std::max(1, static_cast<int>(std::ceil(std::abs(drive.speed) * drive.seconds / 0.04)));
  int first = 0;
  while (first <= tests && !touches(smaller, exact(car, from, drive, 1. * first / tests), blocks)) ++first;
  const bool isFree = first > tests;
  const Eigen::Vector3d end = exact(car, from, drive);
  const auto between = check.ask("Is only the end of a drive tested? The end is free, but the drive is not.",
                                 !isFree && first > 0 && !touches(grown(car, 0.01), end, blocks));
  if (!isFree) {
    const Eigen::Vector3d where = exact(car, from, drive, 1. * first / tests);
    check.input(check.input() + ", touching",
                {{"at q", where}, {"from", from}, {"speed, steering, seconds", numbersOf(drive)}});
  }
  check.that("the body of the car touches nothing during " + name, isFree);
}

inline std::vector<rex::grading::Mistake> mistakenEnds(const CarModel& car, const Eigen::Vector3d& q,
                                                       const Drive& drive) {
  const double way = drive.speed * drive.seconds, turn = way / car.wheelbase * std::tan(drive.steering);
  const Eigen::Vector3d end = exact(car, q, drive);
  const auto stepTo = [&](double heading) -> Eigen::MatrixXd {
    return Eigen::Vector3d(q[0] + way * std::cos(heading), q[1] + way * std::sin(heading), q[2] + turn);
  };
  Drive other = drive;
  const auto led = [&](double speed, double steering, double seconds) -> Eigen::MatrixXd {
    other = {speed, steering, seconds};
    return exact(car, q, other);
  };
  return {
      {"Is it one large step along the heading at the end? The heading changes on the way.", stepTo(end[2])},
      {"Is the chord as long as the arc? Its direction is right.", stepTo(q[2] + turn / 2)},
      {"Are the seconds left out?", led(drive.speed, drive.steering, 1)},
      {"Does the car drive forward, whatever the sign of the speed?",
       led(std::abs(drive.speed), drive.steering, drive.seconds)},
      {"Does a positive steering angle turn to the right? It turns to the left.",
       led(drive.speed, -drive.steering, drive.seconds)},
      {"Does the heading never change?", Eigen::Vector3d(stepTo(q[2])(0), stepTo(q[2])(1), q[2])}};
}

inline void moves(rex::grading::Check& check, Student& student, const CarModel& car, double mostSpeed) {
  rex::Rng& rng = check.rng();
  const Eigen::Vector3d q = randomPose(rng, 5);
  const double speed = rng.uniform(0.3, mostSpeed) * (rng.index(2) == 0 ? -1 : 1);
  const double steering = rng.uniform(car.minSteering, car.maxSteering), L = car.wheelbase;
  {
    check.input("a car", {{"L", L}, {"q", q}, {"speed", speed}, {"steering", steering}});
    const Eigen::Vector3d v = student.velocityOf(car, q, speed, steering),
                          wanted = rex::carVelocity({L, 1.5}, q, {speed, steering});
    const auto with = [&](double rate) -> Eigen::MatrixXd {
      return Eigen::Vector3d(wanted[0], wanted[1], rate);
    };
    check.near(
        "velocity of velocityOf (x, y, heading)", v, wanted, 1e-9,
        {{"Is it the sine of the steering angle? It is the tangent.", with(speed / L * std::sin(steering))},
         {"Is the rate not divided by the wheelbase?", with(speed * std::tan(steering))},
         {"Does the rate lack the speed? A car that stands does not turn.", with(std::tan(steering) / L)},
         {"Does a positive steering angle turn to the right? It turns to the left.", with(-wanted[2])}},
        "m/s, rad/s");
  }
  for (const double angle : {steering, 0., 1e-9}) {
    const Drive drive{speed, angle, rng.uniform(0.5, 8)};
    const double way = std::abs(speed) * drive.seconds, tolerance = 1e-3 * way + 1e-9;
    check.input("a drive",
                {{"L", L}, {"q", q}, {"speed", speed}, {"steering", angle}, {"seconds", drive.seconds}});
    const Eigen::Vector3d end = student.driven(car, q, drive), wanted = exact(car, q, drive);
    const auto shown =
        check.show([&] { return endsSeen(car, q, end, drivenWay(car, q, {drive}, {}).poses); });
    std::string question;
    for (const auto& [asked, value] : mistakenEnds(car, q, drive))
      if (question.empty() && (value - end).cwiseAbs().maxCoeff() <= 1e-6) question = asked;
    const auto mistake = check.ask(question);
    check.near("position after a drive by driven", end.head<2>(), wanted.head<2>(), tolerance, "m");
    check.nearAngle("heading after a drive by driven", end[2], wanted[2], tolerance);
  }
}

/// Continues with arcs from the last pose, until there are 13 poses.
inline void driveOn(rex::Rng& rng, const CarModel& car, Poses& path) {
  while (path.size() < 13) {
    const double way = (rng.index(2) == 0 ? -1 : 1) * rng.uniform(0.3, 1.9);
    const double limit = std::min(0.99, std::atan(0.59 * car.wheelbase / std::abs(way)) / car.maxSteering);
    const double steering = rng.uniform(limit * car.minSteering, limit * car.maxSteering);
    path.push_back(exact(car, path.back(), {way, steering, 1}));
    path.back()[2] += 2 * kPi * (rng.index(3) - 1);
  }
}

/// Breaks a path between two of its poses: by a shift to the side, a turn on the spot, an arc that is too
/// tight, or an arc to the right for a car that turns left only. More arcs follow from wherever the break
/// leads.
inline void breakPath(rex::Rng& rng, const CarModel& car, Poses& path, std::size_t at, int how) {
  const Eigen::Vector3d& before = path[at - 1];
  const double sign = rng.index(2) == 0 ? -1 : 1;
  Eigen::Vector3d wrong = before;
  if (how == 0) wrong = moved(before, {1, sign * rng.uniform(0.012, 0.2), 0});
  if (how == 1) wrong[2] += sign * rng.uniform(0.1, 0.5);
  if (how == 2) wrong = exact(car, before, {1, sign * (1.1 * car.maxSteering), 1});
  if (how == 3) wrong = moved(before, {0, sign * rng.uniform(0.012, 0.2), 0});
  if (how == 4) wrong = exact(car, before, {sign, -rng.uniform(0.2, 0.5), 1});
  path.resize(at);
  path.push_back(wrong);
  driveOn(rng, car, path);
}

/// How it is broken, and what to ask if that is not noticed.
struct Break {
  const char *text, *question;
};
constexpr std::array<Break, 5> kBreaks{{
    {"it slides to the side on its way", "Is the constraint of 4:49 tested, for the chord of the arc?"},
    {"it turns on the spot", "Is a turn on the spot allowed? Without a way there is no turn."},
    {"an arc is too tight", "Are the limits of the steering angle tested?"},
    {"it moves straight to the side",
     "Is the constraint of 4:49 tested where there is no way along the heading?"},
    {"it turns right and can only turn left", "Is minSteering tested? Its limits need not be symmetric."},
}};

/// The error that poses come with.
inline Poses measured(rex::Rng& rng, Poses path) {
  for (Eigen::Vector3d& q : path) q += rng.uniformVector(3, -1e-6, 1e-6);
  return path;
}

/// What to ask after a wrong answer, judging by the answers to other paths.
inline std::string whyNot(Student& student, const CarModel& car, const Poses& given, const Poses& path,
                          std::size_t broken, bool got) {
  if (student.canFollow(car, given) != got) return "Does canFollow answer the same question differently?";
  if (broken > 0) {
    const Poses cut(given.begin(), given.begin() + static_cast<std::ptrdiff_t>(broken) + 1);
    return student.canFollow(car, cut) ? "" : "Does the verdict on a piece replace that on the piece before?";
  }
  if (student.canFollow(car, path))
    return "Are poses taken for exact ones? They come with errors of up to 1 um and 1 urad.";
  Poses unwound = given;
  for (std::size_t i = 1; i < given.size(); ++i)
    unwound[i][2] = unwound[i - 1][2] + wrapped(given[i][2] - unwound[i - 1][2]);
  return student.canFollow(car, unwound) ? "Are headings compared without regard to whole turns?" : "";
}

/// Whether and how a path is broken is random, so that counting calls does not help.
inline void pathIsJudged(rex::grading::Check& check, Student& student) {
  rex::Rng& rng = check.rng();
  const bool follows = rng.index(2) == 0;
  const int how = rng.index(5);
  CarModel car;
  if (how == 0 || how == 4) car.minSteering = 0;
  Poses path{randomPose(rng, 5)};
  driveOn(rng, car, path);
  const std::size_t broken = follows ? 0 : static_cast<std::size_t>(1 + rng.index(12));
  if (!follows) breakPath(rng, car, path, broken, how);
  const Poses given = measured(rng, path);
  const bool got = student.canFollow(car, given);
  if (got == follows) return check.that("canFollow judges the path", true);
  const Break& what = kBreaks[static_cast<std::size_t>(how)];
  if (follows) {
    Eigen::MatrixXd poses(13, 3);
    for (Eigen::Index i = 0; i < 13; ++i) poses.row(i) = given[static_cast<std::size_t>(i)].transpose();
    check.input("twelve arcs, driven forward and backward", {{"L", car.wheelbase},
                                                             {"minSteering", car.minSteering},
                                                             {"maxSteering", car.maxSteering},
                                                             {"poses", poses}});
  } else {
    check.input(fmt::format("twelve pieces, wrong only in piece {} is wrong", broken),
                {{"L", car.wheelbase},
                 {"minSteering", car.minSteering},
                 {"maxSteering", car.maxSteering},
                 {"pose before", given[broken - 1]},
                 {"pose after", given[broken]}});
  }
  const std::string why = whyNot(student, car, given, path, broken, got);
  const auto asked = check.ask(why.empty() && !follows ? what.question : why);
  const auto shown = check.show([&] {
    return pathSeen(follows ? "wanted: it can be followed" : "wanted: it cannot be followed", car, path,
                    broken);
  });
  check.that(follows ? "canFollow returns true, since the car drives arcs within its limits"
                     : fmt::format("canFollow returns false, since {}", what.text),
             false);
}
