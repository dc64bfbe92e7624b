// caught by: step
// mistake: the scan is in the map already when it is asked how well it fits.

// <solution slamStep>
for (Particle& particle : after) {
  Eigen::Vector3d pose = moved(particle.path.back(), motion, settings.odometry, 1, rng).col(0);
  const Grid distances = wallDistances(particle.map, settings.reach);
  if (settings.matches) pose = matched(distances, scan, settings.deviation, pose, settings.window);
  particle.map = observed(particle.map, pose, scan, settings.evidence);
  particle.logWeight +=
      fit(wallDistances(particle.map, settings.reach), pose, scan, settings.deviation) / settings.temper;
  particle.path.push_back(pose);
}
// </solution>
