// caught by: rule
// shown by: rule
// mistake: resamples after each step.

// <solution mapped>
for (Particle& one : particles) one.map = observed(empty, log.start, log.scans[0], settings.evidence);
for (std::size_t t = 0; t < log.motions.size(); ++t) {
  // Before the next step, so that the weights of the last one tell which particle is best.
  if (!sizes.empty()) particles = resampled(particles, rng);
  particles = slamStep(particles, log.motions[t], log.scans[t + 1], settings, rng);
  sizes.push_back(effectiveSize(weightsOf(particles)));
}
// </solution>
