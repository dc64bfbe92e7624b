// caught by: failed-ride
// mistake: goes on after the failure, turning round and round.

// <solution rideOf>
const Eigen::Index T = noise.cols();
Ride ride{Eigen::MatrixXd(4, T + 1), Eigen::VectorXd(T), 0};
ride.states.col(0) = start;
Eigen::VectorXd features;
double u = 0;
for (Eigen::Index n = 0; n < T; ++n) {
  const Eigen::Vector4d x = ride.states.col(n);
  features = featuresAt(sensors.measured(x, racer.r), features, u, kTau);
  u = std::clamp(w.dot(features), -kLargestControl, kLargestControl);
  ride.controls[n] = u;
  Eigen::Vector4d next = stepped(x, u, kTau, racer);
  next.tail<2>() += noise.col(n);
  ride.states.col(n + 1) = next;
  ride.cost += next[0] * next[0] + 10 * next[1] * next[1];
}
return ride;
// </solution>
