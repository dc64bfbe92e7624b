// caught by: noise, noise-elsewhere
// mistake: the mean square over landmarks, each of which has two coordinates.

// <solution likelyNoise>
CarWorld assumed = world;
for (int round = 0; round < 4; ++round) {
  Cloud cloud{log.start.replicate(1, 200), Eigen::VectorXd::Constant(200, 1. / 200)};
  double squares = 0, numbers = 0;
  for (std::size_t t = 0; t < log.controls.size(); ++t) {
    cloud = filterStep(cloud, log.controls[t], log.observations[t], assumed, rng);
    squares += (log.observations[t] - viewFrom(meanPose(cloud), assumed)).squaredNorm();
    numbers += static_cast<double>(log.observations[t].size() / 2);
  }
  assumed.observationNoise = std::sqrt(squares / numbers);
}
return assumed.observationNoise;
// </solution>
