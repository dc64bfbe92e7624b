#pragma once

#include <cmath>

#include "ride_checks.h"

// Part 8: costs from sensors alone.

inline void sensedCostFits(rex::grading::Check& check, Student& student, int readings, int steps) {
  const Eigen::MatrixXd Y = check.rng().normalVector(4 * readings).reshaped(4, readings);
  check.input("a ride", {{"Y", Y}, {"steps", steps}});
  const Eigen::Vector4d squares = Y.rowwise().squaredNorm();
  const int missing = steps - readings;
  const double late = kCostOfMissing * missing, sum = squares[2] + .1 * squares[3], wanted = sum + late;
  const auto hasMissing = [&](double cost) { return missing > 1 ? cost : std::nan(""); };
  check.near(
      "cost of sensedCost", student.sensedCost(Y, steps), wanted, 1e-9 * wanted,
      {{"Is y2 the second row? Rows are counted from zero.", squares[1] + .1 * squares[2] + late},
       {"Are gyroscope and encoder exchanged? It is the encoder's square that is divided by 10.",
        .1 * squares[2] + squares[3] + late},
       {"Is the encoder's square not divided by 10?", squares[2] + squares[3] + late},
       {"Is the reading of the encoder divided by 10 before it is squared?",
        squares[2] + .01 * squares[3] + late},
       {"Are readings not squared?", Y.row(2).cwiseAbs().sum() + .1 * Y.row(3).cwiseAbs().sum() + late},
       {"Are sums squared, instead of each reading?",
        Y.row(2).sum() * Y.row(2).sum() + .1 * Y.row(3).sum() * Y.row(3).sum() + late},
       {"Do missing steps cost nothing?", hasMissing(sum)},
       {"Is kCostOfMissing counted once? Each missing step costs as much.", hasMissing(sum + kCostOfMissing)},
       {"Does each step that was ridden cost kCostOfMissing?", sum + kCostOfMissing * readings},
       {"Does each of the `steps` cost kCostOfMissing? Only those without a reading do.",
        sum + kCostOfMissing * steps},
       {"Is it the mean of a step? The cost of a ride is a sum.", wanted / steps},
       {"Is the cost multiplied by kTau?", kTau * wanted}});
}

inline void sensedPoseFits(rex::grading::Check& check, Student& student, const Situation& in) {
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector4d x(check.rng().normal(), check.rng().uniform(-1.2, 1.2), check.rng().normal(),
                            3 * check.rng().normal());
    const Eigen::Vector4d y = in.sensors.measured(x, in.racer.r);
    const auto& [s, phi, kappa, bias] = in.sensors;
    check.input(fmt::format("r = {:.6g}, s = {:.6g}, phi = {:.6g}, kappa = {:.6g}, gyroBias = {:.6g}",
                            in.racer.r, s, phi, kappa, bias),
                {{"y", y}});
    // The pose, if theta' and the angle of the sensors' mount are those.
    const auto pose = [&](double rate, double pulled, double mount) {
      const double tilt = std::atan2(y[1] + pulled * rate * rate * std::sin(in.sensors.phi),
                                     y[0] + pulled * rate * rate * std::cos(in.sensors.phi)) -
                          mount;
      return Eigen::Vector2d(in.racer.r * (y[3] + tilt), tilt);
    };
    const double linear = y[1] / s - phi, folded = std::asin(std::clamp(y[1] / s, -1., 1.)) - phi;
    check.near(
        "(x, theta) of sensedPose", student.sensedPose(y, in.racer, in.sensors), x.head<2>(),
        1e-9 * (1 + x.norm()),
        {{"Is theta' the reading of the gyroscope? It reads theta' - gyroBias.", pose(y[2], kappa, phi)},
         {"Is gyroBias subtracted? The gyroscope reads theta' - gyroBias.", pose(y[2] - bias, kappa, phi)},
         {"Are the terms with theta'^2 left out?", pose(0, kappa, phi)},
         {"Are the terms with theta'^2 subtracted? They were in y.", pose(x[3], -kappa, phi)},
         {"Is theta' not squared?", pose(std::sqrt(std::abs(x[3])), x[3] < 0 ? -kappa : kappa, phi)},
         {"Is it theta + phi? The accelerometers are mounted at the angle phi.", pose(x[3], kappa, 0)},
         {"Is phi added to the angle of the accelerometers?", pose(x[3], kappa, -phi)},
         {"Is sin(theta + phi) taken for theta + phi?",
          Eigen::Vector2d(in.racer.r * (y[3] + linear), linear)},
         {"Does theta follow from y1 alone, without the terms with theta'^2?",
          Eigen::Vector2d(in.racer.r * (y[3] + folded), folded)},
         {"Is x = r y3? The encoder is between wheel and body, which tilts.",
          Eigen::Vector2d(in.racer.r * y[3], x[1])},
         {"Has theta the wrong sign in x?", Eigen::Vector2d(in.racer.r * (y[3] - x[1]), x[1])},
         {"Is x not multiplied by r?", Eigen::Vector2d(y[3] + x[1], x[1])},
         {"Are x and theta exchanged?", Eigen::Vector2d(x[1], x[0])}});
  }
}
