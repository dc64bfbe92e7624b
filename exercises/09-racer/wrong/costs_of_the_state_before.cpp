// caught by: ride
// mistake: counts the state before the step.

// <solution rideOf>
const Eigen::Index T = noise.cols();
Ride ride{Eigen::MatrixXd(4, T + 1), Eigen::VectorXd(T), 0};
ride.states.col(0) = start;
Eigen::Vector4d x = start;
Eigen::VectorXd features;
double u = 0;
Eigen::Index n = 0;
for (bool stands = true; stands && n < T; ++n) {
  features = featuresAt(sensors.measured(x, racer.r), features, u, kTau);
  u = std::clamp(w.dot(features), -kLargestControl, kLargestControl);
  const Eigen::Vector4d last = x;
  x = stepped(x, u, kTau, racer);
  x.tail<2>() += noise.col(n);
  ride.controls[n] = u;
  ride.states.col(n + 1) = x;
  stands = std::abs(x[1]) <= kLargestAngle;
  ride.cost +=
      stands ? last[0] * last[0] + 10 * last[1] * last[1] : kCostOfMissing * static_cast<double>(T - n);
}
ride.states.conservativeResize(4, n + 1);
ride.controls.conservativeResize(n);
return ride;
// </solution>
