// caught by: particles-weigh, particles-map
// mistake: every particle counts the same, however well it explains what was seen.

// <solution weighed>
for (MapParticle& particle : after) {
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
    const Eigen::Vector2d gap = viewGap(car, seen.y, view(car, particle.x, l));
    landmark = corrected(landmark, gap, D, viewNoise(car));
  }
}
for (MapParticle& particle : after) particle.weight = 1. / static_cast<double>(after.size());
// </solution>
