// caught by: noise, noise-elsewhere
// mistake: the residuals of one filter only, which was misled by the wrong noise.

// <solution likelyNoise>
Cloud cloud{log.start.replicate(1, 200), Eigen::VectorXd::Constant(200, 1. / 200)};
double sum = 0, count = 0;
for (std::size_t t = 0; t < log.controls.size(); ++t) {
  cloud = filterStep(cloud, log.controls[t], log.observations[t], world, rng);
  sum += (log.observations[t] - viewFrom(meanPose(cloud), world)).squaredNorm();
  count += static_cast<double>(log.observations[t].size());
}
return std::sqrt(sum / count);
// </solution>
