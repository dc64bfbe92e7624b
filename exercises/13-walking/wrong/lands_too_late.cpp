// caught by: step, other-steps
// mistake: the impact happens at the end of a time step.

// <solution stepFrom>
const auto lands = [&](const Eigen::Vector4d& at) { return at[0] + at[1] + 2 * walker.slope <= 0; };
Eigen::Vector4d now = x;
for (int i = 0; i < 5000; ++i) {
  const Eigen::Vector4d next = swung(walker, now, 1e-3);
  if (!lands(now) && lands(next) && next[1] > next[0]) return StepEnd{impactOf(walker, next), (i + 1) * 1e-3};
  if (std::abs(next[0] + walker.slope) >= M_PI / 2) return std::nullopt;
  now = next;
}
return std::nullopt;
// </solution>
