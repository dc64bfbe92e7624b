#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "belief_checks.h"
#include "interface.h"

// Part 1: models, against those of the library. Derivatives by finite differences are accurate to 1e-8 here.

inline std::vector<rex::grading::Mistake> wrongSteps(const CarSetup& car, const Eigen::Vector3d& x,
                                                     const Eigen::Vector2d& u, const Eigen::Vector3d& after,
                                                     const Eigen::MatrixXd& byControl) {
  const Eigen::Vector3d way = after - x, late(x[0], x[1], after[2]);
  const Eigen::Vector3d turned =
      rex::CarSimulator::withoutPlaces(0, optionsOf(car)).getMeanStateAfterStep(late, u) - late;
  const auto with = [&](double dx, double dy, double turn) {
    return Eigen::Vector3d(x[0] + dx, x[1] + dy, x[2] + turn);
  };
  return {{"Are sine and cosine exchanged?", with(way[1], way[0], way[2])},
          {"Does the car turn by the steering angle itself?", with(way[0], way[1], u[1])},
          {"Is the tangent of the steering angle left out?",
           with(way[0], way[1], way[2] * u[1] / std::tan(u[1]))},
          {"Is the wheelbase left out?", with(way[0], way[1], way[2] * car.wheelbase)},
          {"Is the speed left out of the turn?", with(way[0], way[1], way[2] / u[0])},
          {"Does the car move along its new heading? The step is one of Euler's method: the old one counts.",
           with(turned[0], turned[1], way[2])},
          {"Is it x + B u? That is a linearisation at no point: the car turns too far.",
           sum(x, product(byControl, u))},
          {"Is the step one second long, whatever tau is?", sum(x, way, 1 / car.tau)}};
}

inline std::vector<rex::grading::Mistake> wrongByState(const CarSetup& car, const Eigen::MatrixXd& A) {
  const auto withHeading = [&](double dx, double dy) {
    Eigen::MatrixXd wrong = A;
    wrong(0, 2) = dx;
    wrong(1, 2) = dy;
    return wrong;
  };
  const char* sign =
      "Does the derivative by the heading have the right signs? Turn the car a little to the left.";
  const Eigen::MatrixXd I = unitMatrix(3);
  return {{"Is the x that the step starts from left out? Its derivative is the unit matrix.", sum(A, I, -1)},
          {"Does the heading change nothing?", I},
          {sign, withHeading(-A(0, 2), A(1, 2))},
          {sign, withHeading(A(0, 2), -A(1, 2))},
          {sign, withHeading(-A(0, 2), -A(1, 2))},
          {"Are sine and cosine exchanged?", withHeading(A(1, 2), A(0, 2))},
          {"Are sine and cosine not differentiated?", withHeading(A(1, 2), -A(0, 2))},
          {"Is the step one second long, whatever tau is?", sum(I, sum(A, I, -1), 1 / car.tau)}};
}

inline std::vector<rex::grading::Mistake> wrongByControl(const CarSetup& car, const Eigen::Vector2d& u,
                                                         const Eigen::MatrixXd& B) {
  const auto withSteering = [&](double factor) {
    Eigen::MatrixXd wrong = B;
    wrong(2, 1) *= factor;
    return wrong;
  };
  Eigen::MatrixXd exchanged = B;
  exchanged.col(0).swap(exchanged.col(1));
  const double c = std::cos(u[1]);
  return {{"Is the tangent not differentiated?", withSteering(std::tan(u[1]) * c * c)},
          {"Is the derivative of the tangent taken for 1?", withSteering(c * c)},
          {"The derivative of the tangent has a square in it: is it left out?", withSteering(c)},
          {"Is the wheelbase left out?", withSteering(car.wheelbase)},
          {"Is the speed left out?", withSteering(1 / u[0])},
          {"Are the columns exchanged? u is (speed, steering angle).", exchanged},
          {"Is the step one second long, whatever tau is?", 1 / car.tau * B}};
}

inline void stepsRightly(rex::grading::Check& check, Student& student, const CarSetup& car) {
  const Eigen::Vector3d x = randomState(check.rng());
  const Eigen::Vector2d u = randomControl(check.rng());
  check.input(described(car), {{"x", x}, {"u", u}});
  const auto model = rex::CarSimulator::withoutPlaces(0, optionsOf(car));
  const Eigen::Vector3d after = model.getMeanStateAfterStep(x, u);
  const Eigen::MatrixXd A =
      derivative([&](const Eigen::VectorXd& z) { return model.getMeanStateAfterStep(z, u); }, x);
  const Eigen::MatrixXd B =
      derivative([&](const Eigen::VectorXd& z) { return model.getMeanStateAfterStep(x, z); }, u);
  const Eigen::VectorXd moved = student.stepped(car, x, u);
  check.near("state after a step of stepped", sum(after, gapOf(moved, after)), after, 1e-9,
             wrongSteps(car, x, u, after, B));
  check.near("A of stepByState", student.stepByState(car, x, u), A, 1e-6, wrongByState(car, A));
  check.near("B of stepByControl", student.stepByControl(car, x, u), B, 1e-6, wrongByControl(car, u, B));
  const double sigma = car.dynamicsNoise;
  const Eigen::MatrixXd I = unitMatrix(3);
  check.near("Q of stepNoise", student.stepNoise(car), sigma * sigma * I, 1e-12,
             {{"Is the noise multiplied by tau? It is that of a whole step.", sigma * sigma * car.tau * I}});
}

/// (distance, angle) of a point (ahead, left).
inline Eigen::Vector2d polar(const Eigen::Vector2d& p) { return {p.norm(), std::atan2(p[1], p[0])}; }

inline CarSetup cartesian(const CarSetup& car) {
  return {car.tau, car.wheelbase, car.dynamicsNoise, car.observationNoise, car.bearingNoise, false};
}

/// Turned by a heading of the opposite sign.
inline Eigen::Vector3d mirrored(const Eigen::Vector3d& x) { return {x[0], x[1], -x[2]}; }

inline std::vector<rex::grading::Mistake> wrongViews(const CarSetup& car, const Eigen::Vector3d& x,
                                                     const Eigen::Vector2d& l, const Eigen::Vector2d& wanted,
                                                     const Eigen::Vector2d& got) {
  const Eigen::Vector2d offset = l - x.head(2), right = seenFrom(cartesian(car), x, l),
                        other = seenFrom(cartesian(car), mirrored(x), l),
                        origin = seenFrom(cartesian(car), x, Eigen::Vector2d::Zero()),
                        turns(0, 2 * kPi * std::round((got[1] - wanted[1]) / (2 * kPi)));
  const auto seen = [&](const Eigen::Vector2d& p) { return car.rangeBearing ? polar(p) : p; };
  std::vector<rex::grading::Mistake> mistakes{
      {"Is the heading left out? The landmark is seen in the frame of the car.", seen(offset)},
      {"Is it rotated the wrong way, from the frame of the car to that of the world?", seen(other)},
      {"Is left counted as negative?", seen({right[0], -right[1]})},
      {"Is the way taken from the landmark to the car?", seen(-right)},
      {"Is the position of the car left out?", seen(right - origin)}};
  if (!car.rangeBearing) return mistakes;
  mistakes.push_back({"Is the bearing within -pi and pi? It is off by whole turns.", wanted + turns});
  mistakes.push_back(
      {"Is the sensor the one of metres? With rangeBearing, distance and angle are seen.", right});
  mistakes.push_back({"Is the bearing in degrees?", Eigen::Vector2d(wanted[0], wanted[1] * 180 / kPi)});
  mistakes.push_back({"Is the distance squared?", Eigen::Vector2d(wanted[0] * wanted[0], wanted[1])});
  return mistakes;
}

/// Of a derivative of the view, by the state or by the landmark, with that of the other sensor and the one
/// for the opposite heading.
inline std::vector<rex::grading::Mistake> wrongDerivatives(const CarSetup& car, const Eigen::MatrixXd& J,
                                                           const Eigen::MatrixXd& metres,
                                                           const Eigen::MatrixXd& opposite, double distance) {
  std::vector<rex::grading::Mistake> mistakes{
      {"Is it rotated the wrong way, from the frame of the car to that of the world?", opposite}};
  if (J.cols() == 3) {
    Eigen::MatrixXd wrong = J;
    wrong.col(2) = -J.col(2);
    mistakes.push_back(
        {"Does the derivative by the heading have the opposite sign? If the car turns left, what it sees "
         "turns "
         "right.",
         wrong});
    wrong.col(2).setZero();
    mistakes.push_back({"Is the derivative by the heading left out?", wrong});
  }
  if (!car.rangeBearing) return mistakes;
  mistakes.push_back(
      {"Is it the derivative of the metres ahead and to the left? With rangeBearing, the chain rule adds a "
       "factor.",
       metres});
  for (const auto& [question, factor] :
       {std::pair{"Is the bearing's derivative divided by the distance only once?", distance},
        {"Is the bearing's derivative not divided by the square of the distance?", distance * distance},
        {"Does the bearing's derivative have the opposite sign?", -1.}}) {
    Eigen::MatrixXd wrong = J;
    wrong.row(1) *= factor;
    mistakes.push_back({question, wrong});
  }
  return mistakes;
}

inline void seesRightly(rex::grading::Check& check, Student& student, const CarSetup& car,
                        const Eigen::Vector3d& x, const Eigen::Vector2d& l) {
  check.input(described(car), {{"x", x}, {"l", l}});
  const auto byState = [&](const CarSetup& setup, const Eigen::Vector3d& at) {
    const Eigen::VectorXd there = seenFrom(setup, at, l);
    return derivative([&](const Eigen::VectorXd& z) { return gapsOf(setup, seenFrom(setup, z, l), there); },
                      at);
  };
  const auto byLandmark = [&](const CarSetup& setup, const Eigen::Vector3d& at) {
    const Eigen::VectorXd there = seenFrom(setup, at, l);
    return derivative([&](const Eigen::VectorXd& z) { return gapsOf(setup, seenFrom(setup, at, z), there); },
                      l);
  };
  const Eigen::Vector2d y = seenFrom(car, x, l), got = student.view(car, x, l);
  const double distance = (l - x.head(2)).norm();
  const Eigen::MatrixXd C = byState(car, x), D = byLandmark(car, x), W = noiseOf(car, 1);
  check.near("what view sees", got, y, 1e-9, wrongViews(car, x, l, y, got));
  check.near("C of viewByState", student.viewByState(car, x, l), C, 1e-6,
             wrongDerivatives(car, C, byState(cartesian(car), x), byState(car, mirrored(x)), distance));
  check.near("D of viewByLandmark", student.viewByLandmark(car, x, l), D, 1e-6,
             wrongDerivatives(car, D, byLandmark(cartesian(car), x), byLandmark(car, mirrored(x)), distance));
  check.near("W of viewNoise", student.viewNoise(car), W, 1e-12,
             {{"Is it the noise of the other sensor? With rangeBearing, the bearing has its own.",
               noiseOf(cartesian(car), 1)},
              {"Are the entries exchanged? The distance comes first.", noiseOf(car, 1).reverse()}});
}

/// Of two sightings by metres, which may be many metres apart.
inline void subtractsMetres(rex::grading::Check& check, Student& student) {
  const Eigen::Vector2d y = check.rng().uniformVector(2, -9, 9),
                        expected = check.rng().uniformVector(2, -9, 9);
  check.input("two sightings, metres ahead and left", {{"y", y}, {"expected", expected}});
  const Eigen::Vector2d gap = y - expected, got = student.viewGap({}, y, expected);
  Eigen::Vector2d wrapped = gap, both(rex::wrapAngle(gap[0]), rex::wrapAngle(gap[1]));
  wrapped[1] = both[1];
  const char* question = "Are metres wrapped like angles?";
  check.near("difference of viewGap", got, gap, 1e-12, {{question, wrapped}, {question, both}});
}

/// Of two sightings by distance and bearing, `turn` to the left of each other.
inline void subtractsBearings(rex::grading::Check& check, Student& student, const Eigen::Vector2d& from,
                              const Eigen::Vector2d& to, double turn) {
  CarSetup car;
  car.rangeBearing = true;
  for (const double sign : {1., -1.}) {
    const Eigen::Vector2d y = sign > 0 ? to : from, expected = sign > 0 ? from : to;
    check.input("two sightings, distance and bearing", {{"y", y}, {"expected", expected}});
    const Eigen::Vector2d gap(y[0] - expected[0], sign * turn), got = student.viewGap(car, y, expected);
    check.near(
        "difference of viewGap", got, gap, 1e-9,
        {{"Is the difference of the distances wrapped? Only bearings are angles.",
          Eigen::Vector2d(rex::wrapAngle(gap[0]), gap[1])},
         {"Does the difference of the bearings lose its sign?", Eigen::Vector2d(gap[0], std::abs(turn))}});
  }
}
