// caught by: tour, more-tours
// shown by: tour
// mistake: each motion goes with the scan before it.

// <solution mapped>
for (Particle& one : particles) one.map = observed(empty, log.start, log.scans[0], settings.evidence);
for (std::size_t t = 0; t < log.motions.size(); ++t) {
  // Before the next step, so that the weights of the last one tell which particle is best.
  if (!sizes.empty() && sizes.back() < settings.threshold * count) particles = resampled(particles, rng);
  particles = slamStep(particles, log.motions[t], log.scans[t], settings, rng);
  sizes.push_back(effectiveSize(weightsOf(particles)));
}
// </solution>
