// caught by: failed-ride, unseen-rides
// mistake: the motor gives whatever the policy asks for.

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
  u = w.dot(features);
  x = stepped(x, u, kTau, racer);
  x.tail<2>() += noise.col(n);
  ride.controls[n] = u;
  ride.states.col(n + 1) = x;
  stands = std::abs(x[1]) <= kLargestAngle;
  ride.cost += stands ? x[0] * x[0] + 10 * x[1] * x[1] : kCostOfMissing * static_cast<double>(T - n);
}
ride.states.conservativeResize(4, n + 1);
ride.controls.conservativeResize(n);
return ride;
// </solution>
