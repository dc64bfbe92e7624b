// caught by: step
// shown by: step
// mistake: the scan is drawn at the pose before the match.

// <solution slamStep>
for (Particle& particle : after) {
  Eigen::Vector3d pose = moved(particle.path.back(), motion, settings.odometry, 1, rng).col(0);
  const Grid distances = wallDistances(particle.map, settings.reach);
  const Eigen::Vector3d drawn = pose;
  if (settings.matches) pose = matched(distances, scan, settings.deviation, pose, settings.window);
  particle.logWeight += fit(distances, pose, scan, settings.deviation) / settings.temper;
  particle.path.push_back(pose);
  particle.map = observed(particle.map, drawn, scan, settings.evidence);
}
// </solution>
