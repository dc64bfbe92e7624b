// caught by: box, more-boxes
// mistake: a number that was held once is held for ever.

// <solution boxed>
const int size = static_cast<int>(lower.size());
Eigen::VectorXd z = Eigen::VectorXd::Zero(size);
std::vector<bool> isHeld(static_cast<std::size_t>(size), false);
for (;;) {
  std::vector<int> free, held;
  for (int i = 0; i < size; ++i) (isHeld[static_cast<std::size_t>(i)] ? held : free).push_back(i);
  if (free.empty()) return z;
  Eigen::VectorXd right = -cost.g(free);
  if (!held.empty()) right -= cost.H(free, held) * z(held);
  z(free) = solve(cost.H(free, free), right);
  bool isInside = true;
  for (const int i : free) {
    if (z[i] >= lower[i] && z[i] <= upper[i]) continue;
    z[i] = std::clamp(z[i], lower[i], upper[i]);
    isHeld[static_cast<std::size_t>(i)] = true;
    isInside = false;
  }
  if (isInside) return z;
}
// </solution>
