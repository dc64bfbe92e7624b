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
  check.near(
      "cost of sensedCost", student.sensedCost(Y, steps), wanted, 1e-9 * wanted,
      {{"Is the encoder's square not divided by 10?", squares[2] + squares[3] + late},
       {"Are readings not squared?", Y.row(2).cwiseAbs().sum() + .1 * Y.row(3).cwiseAbs().sum() + late},
       {"Are sums squared, instead of each reading?",
        Y.row(2).sum() * Y.row(2).sum() + .1 * Y.row(3).sum() * Y.row(3).sum() + late},
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
    const double folded = std::asin(std::clamp(y[1] / s, -1., 1.)) - phi;
    check.near("(x, theta) of sensedPose", student.sensedPose(y, in.racer, in.sensors), x.head<2>(),
               1e-9 * (1 + x.norm()),
               {{"Are the terms with theta'^2 subtracted? They were in y.", pose(x[3], -kappa, phi)},
                {"Is theta' not squared?", pose(std::sqrt(std::abs(x[3])), x[3] < 0 ? -kappa : kappa, phi)},
                {"Is phi added to the angle of the accelerometers?", pose(x[3], kappa, -phi)},
                {"Does theta follow from y1 alone, without the terms with theta'^2?",
                 Eigen::Vector2d(in.racer.r * (y[3] + folded), folded)},
                {"Are x and theta exchanged?", Eigen::Vector2d(x[1], x[0])}});
  }
}
