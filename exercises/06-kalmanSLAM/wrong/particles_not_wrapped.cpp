// caught by: particles-weigh
// mistake: subtracts bearings without wrapping them for the landmarks of particles.

// <solution weighed>
std::vector<double> logs;
for (MapParticle& particle : after) {
  double log = std::log(particle.weight);
  for (const LandmarkObservation& seen : sightings) {
    const bool isNew = static_cast<std::size_t>(seen.landmark) == particle.map.size();
    if (isNew) particle.map.push_back({placed(car, particle.x, seen.y), {}});
    Belief& landmark = particle.map[static_cast<std::size_t>(seen.landmark)];
    const Eigen::Vector2d l = landmark.mean;
    const Eigen::MatrixXd D = viewByLandmark(car, particle.x, l);
    if (isNew) {
      const Eigen::MatrixXd byView = inverse(D), noise = byView * viewNoise(car);
      landmark.covariance = symmetric(noise * byView.transpose());
      continue;
    }
    const Eigen::Vector2d gap = seen.y - view(car, particle.x, l);
    const Eigen::MatrixXd DS = D * landmark.covariance, S = DS * D.transpose() + viewNoise(car);
    const Eigen::Vector2d scaled = solveMatrix(S, gap);
    log -= 0.5 * (gap.dot(scaled) + std::log(S(0, 0) * S(1, 1) - S(0, 1) * S(1, 0)));
    landmark = corrected(landmark, gap, D, viewNoise(car));
  }
  logs.push_back(log);
}
// Relative to the largest of them, or all would be zero where all are tiny.
const double most = *std::max_element(logs.begin(), logs.end());
double sum = 0;
for (double& log : logs) sum += log = std::exp(log - most);
for (std::size_t k = 0; k < after.size(); ++k) after[k].weight = logs[k] / sum;
// </solution>
