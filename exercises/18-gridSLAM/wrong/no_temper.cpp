// caught by: step
// mistake: rays count as if they were independent.

// <solution slamStep>
for (Particle& particle : after) {
  Eigen::Vector3d pose = moved(particle.path.back(), motion, settings.odometry, 1, rng).col(0);
  const Grid distances = wallDistances(particle.map, settings.reach);
  if (settings.matches) pose = matched(distances, scan, settings.deviation, pose, settings.window);
  particle.logWeight += fit(distances, pose, scan, settings.deviation);
  particle.path.push_back(pose);
  particle.map = observed(particle.map, pose, scan, settings.evidence);
}
// </solution>
