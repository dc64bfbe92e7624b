// caught by: rule
// mistake: the first scan is not in the maps.

// <solution mapped>
for (std::size_t t = 0; t < log.motions.size(); ++t) {
  // Before the next step, so that the weights of the last one tell which particle is best.
  if (!sizes.empty() && sizes.back() < settings.threshold * count) particles = resampled(particles, rng);
  particles = slamStep(particles, log.motions[t], log.scans[t + 1], settings, rng);
  sizes.push_back(effectiveSize(weightsOf(particles)));
}
// </solution>
