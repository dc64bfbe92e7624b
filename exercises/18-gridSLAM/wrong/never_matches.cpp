// caught by: step
// mistake: poses are those of the motion.

// <solution slamStep>
for (Particle& particle : after) {
  Eigen::Vector3d pose = moved(particle.path.back(), motion, settings.odometry, 1, rng).col(0);
  const Grid distances = wallDistances(particle.map, settings.reach);
  particle.logWeight += fit(distances, pose, scan, settings.deviation) / settings.temper;
  particle.path.push_back(pose);
  particle.map = observed(particle.map, pose, scan, settings.evidence);
}
// </solution>
