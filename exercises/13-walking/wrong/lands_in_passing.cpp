// caught by: step, gait, other-steps, other-gaits
// mistake: the foot lands where it first touches the ground, when the legs pass.

// <solution stepFrom>
const auto height = [&](const Eigen::Vector4d& at) {
  return std::cos(at[0] + walker.slope) - std::cos(at[1] + walker.slope);
};
constexpr double h = 1e-3;
Eigen::Vector4d now = x;
for (int i = 0; i < 5000; ++i) {
  const Eigen::Vector4d next = swung(walker, now, h);
  if (height(now) > 0 && height(next) <= 0) {
    double low = 0, high = h;
    for (int j = 0; j < 60; ++j)
      (height(swung(walker, now, (low + high) / 2)) <= 0 ? high : low) = (low + high) / 2;
    return StepEnd{impactOf(walker, swung(walker, now, high)), i * h + high};
  }
  if (std::abs(next[0] + walker.slope) >= M_PI / 2) return std::nullopt;
  now = next;
}
return std::nullopt;
// </solution>
