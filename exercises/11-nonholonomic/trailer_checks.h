#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "car_checks.h"

// Part 5: a trailer.

inline Eigen::Vector4d rigMotion(const Rig& rig, const Eigen::Vector4d& q, double speed, double steering,
                                 double seconds) {
  return rex::driveTrailer({{rig.car.wheelbase, 1.5}, rig.hitchLength}, q, {speed, steering}, seconds);
}

inline void rigFits(rex::grading::Check& check, Student& student) {
  rex::Rng& rng = check.rng();
  Rig rig;
  rig.car = randomCar(rng);
  rig.hitchLength = rng.uniform(2, 5);
  const Eigen::Vector4d q = rng.uniformVector(4, -3, 3);
  const double speed = rng.uniform(-2, 2), steering = rng.uniform(-0.6, 0.6), d = rig.hitchLength;
  check.input("a rig",
              {{"L", rig.car.wheelbase}, {"d", d}, {"q", q}, {"speed", speed}, {"steering", steering}});
  const Eigen::Vector4d v = student.rigVelocity(rig, q, speed, steering);
  check.near("velocity of the car by rigVelocity (x, y, heading)", v.head<3>(),
             rex::carVelocity({rig.car.wheelbase, 1.5}, q.head<3>(), {speed, steering}), 1e-9, "m/s, rad/s");
  // The axle is d behind the hitch. It must not slide: its velocity has no part across the trailer.
  const double across = (-v[0] * std::sin(q[3]) + v[1] * std::cos(q[3])) / d, hitch = q[2] - q[3];
  {
    check.near("rate of the trailer's heading by rigVelocity", v[3], across, 1e-9,
               {{"Is the rate not divided by the length of the hitch?", across * d},
                {"Is it divided by the wheelbase? The trailer's axle is hitchLength behind.",
                 across * d / rig.car.wheelbase},
                {"Is it the tangent of the angle at the hitch? It is the sine.", speed / d * std::tan(hitch)},
                {"Is it the cosine of the angle at the hitch?", speed / d * std::cos(hitch)},
                {"Is it the rate of the angle at the hitch? Wanted is that of the trailer's heading.",
                 across - v[2]},
                {"Is it the rate of the angle at the hitch? Wanted is that of the trailer's heading.",
                 v[2] - across},
                {"Does the trailer turn with the car?", v[2]}},
               "rad/s");
  }
  check.input("wheels straight", {{"d", d}, {"speed", speed}});
  const double rate = student.hitchGrowth(rig, speed);
  const Eigen::Vector4d later = rigMotion(rig, {0, 0, 0, -1e-5}, speed, 0, 1);
  const double growth = (later[2] - later[3]) / 1e-5, wanted = std::log(growth);
  check.near("hitchGrowth", rate, wanted, 1e-4,
             {{"Is it the factor of growth in a second? Wanted is its rate.", growth},
              {"Is the speed left out?", wanted / speed},
              {"Is it not divided by the length of the hitch?", wanted * d}},
             "1/s");
}

/// What to ask if a rig folds up, or does not reach the axis: how the steering angle answers to a small
/// angle at the hitch, with the axle of the trailer on the axis, and to a small offset.
inline std::string whyAstray(Student& student, const Rig& rig) {
  const double d = rig.hitchLength, small = 0.02;
  const auto change = [&](const Eigen::Vector4d& by) {
    const Eigen::Vector4d at(d, 0, 0, 0);
    return (student.reverseSteering(rig, at + by) - student.reverseSteering(rig, at - by)) / (2 * small);
  };
  const double byHitch = change({0, 0, small, 0}), byOffset = change({0, small, 0, 0});
  if (std::abs(byHitch) < 1e-6)
    return "Does the steering angle not depend on the angle at the hitch? Backward, that angle grows by "
           "itself.";
  if (byHitch < 0)
    return "Does the car steer against the angle at the hitch? Backward, it has to follow the trailer.";
  if (byHitch < rig.car.wheelbase / d)
    return "Does the car steer too little against the growth of the angle at the hitch?";
  if (std::abs(byOffset) < 1e-6) return "Does the steering angle not depend on the distance from the axis?";
  return byOffset < 0 ? "Does the trailer turn away from the axis? Check the sign of the distance from it."
                      : "";
}

/// Over 2000 seeds the reference was never farther off than 2 mm and 1 mrad, and folded up by 0.6 rad at
/// most.
inline void reverses(rex::grading::Check& check, Student& student, const Rig& rig, int mostTurns) {
  rex::Rng& rng = check.rng();
  const double trailer = rng.uniform(-0.25, 0.25), offset = rng.uniform(-1, 1);
  Eigen::Vector4d q(0, offset + rig.hitchLength * std::sin(trailer), rng.uniform(-0.25, 0.25), trailer);
  for (const int i : {2, 3}) q[i] += 2 * kPi * mostTurns * (rng.index(3) - 1);
  constexpr double kStep = 0.05, kMostHitch = 1.2;
  check.input("50 m backward", {{"d", rig.hitchLength}, {"L", rig.car.wheelbase}, {"q at the start", q}});
  std::vector<Eigen::Vector4d> states{q};
  const auto shown = check.show([&] { return reversingSeen(rig, states, kStep); });
  rex::grading::Signal hitch{.axis = "time [s]"}, axle = hitch, headings = hitch;
  for (int step = 1; step <= 1000; ++step) {
    const double steering = student.reverseSteering(rig, q);
    checkLimits(check, rig.car, {1, steering, 1}, "reverseSteering");
    q = rigMotion(rig, q, -1, steering, kStep);
    states.push_back(q);
    hitch.add(kStep * step, std::abs(wrapped(q[2] - q[3])));
    if (hitch.values.back()[0] > kMostHitch) break;
    if (step <= 800) continue;
    axle.add(kStep * step, q[1] - rig.hitchLength * std::sin(q[3]));
    headings.add(kStep * step, Eigen::Vector2d(wrapped(q[2]), wrapped(q[3])));
  }
  const auto none = [](const rex::grading::Signal& signal) {
    return std::vector<Eigen::VectorXd>(signal.values.size(),
                                        Eigen::VectorXd::Zero(signal.values.front().size()));
  };
  const bool isRight = hitch.values.back()[0] <= kMostHitch && std::abs(axle.values.back()[0]) <= 0.05;
  const auto asked = check.ask(isRight ? "" : whyAstray(student, rig));
  check.atMostAlong("|angle between car and trailer| under reverseSteering", hitch, kMostHitch, "rad");
  check.nearAlong("y of the trailer's axle under reverseSteering, after 40 m", axle, none(axle), 0.05, "m");
  check.nearAlong("headings of car and trailer under reverseSteering, after 40 m", headings, none(headings),
                  0.05, "rad");
}
