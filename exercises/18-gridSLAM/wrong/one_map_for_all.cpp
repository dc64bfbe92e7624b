// caught by: step
// mistake: all particles share the map of the first one.

// <solution slamStep>
for (Particle& particle : after) {
  Eigen::Vector3d pose = moved(particle.path.back(), motion, settings.odometry, 1, rng).col(0);
  const Grid distances = wallDistances(particles[0].map, settings.reach);
  if (settings.matches) pose = matched(distances, scan, settings.deviation, pose, settings.window);
  particle.logWeight += fit(distances, pose, scan, settings.deviation) / settings.temper;
  particle.path.push_back(pose);
  particle.map = observed(particles[0].map, pose, scan, settings.evidence);
}
// </solution>
