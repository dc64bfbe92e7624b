// caught by: match, more-matches
// mistake: the best of 27 poses, without going on from there.

// <solution matched>
const Eigen::Vector3d half(window[0], window[0], window[1]);
Eigen::Vector3d best = guess;
double score = fit(distances, best, scan, deviation);
const auto take = [&](const Eigen::Vector3d& pose) {
  if (((pose - guess).cwiseAbs() - half).maxCoeff() > 0) return false;
  const double value = fit(distances, pose, scan, deviation);
  if (value <= score) return false;
  best = pose;
  score = value;
  return true;
};
// A coarse search, so that no small hill near the guess is taken for the summit; then uphill.
for (int n = 0; n < 27; ++n)
  take(guess + 2. / 3 * Eigen::Vector3d(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1).cwiseProduct(half));
for (double part = 1. / 3; part > 1;) {
  bool isBetter = false;
  for (int n = 0; n < 6; ++n) {
    Eigen::Vector3d pose = best;
    pose[n / 2] += (n % 2 == 0 ? part : -part) * half[n / 2];
    isBetter = take(pose) || isBetter;
  }
  if (!isBetter) part /= 2;
}
return best;
// </solution>
