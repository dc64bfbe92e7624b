// caught by: step
// mistake: a fall is noticed only when the stance leg hangs straight down.

// <solution stepFrom>
const auto lands = [&](const Eigen::Vector4d& at) { return at[0] + at[1] + 2 * walker.slope <= 0; };
constexpr double h = 1e-3;
Eigen::Vector4d now = x;
for (int i = 0; i < 5000; ++i) {
  const Eigen::Vector4d next = swung(walker, now, h);
  if (!lands(now) && lands(next) && next[1] > next[0]) {
    double low = 0, high = h;
    for (int j = 0; j < 60; ++j)
      (lands(swung(walker, now, (low + high) / 2)) ? high : low) = (low + high) / 2;
    return StepEnd{impactOf(walker, swung(walker, now, high)), i * h + high};
  }
  if (std::abs(next[0]) >= M_PI) return std::nullopt;
  now = next;
}
return std::nullopt;
// </solution>
