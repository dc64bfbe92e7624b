// caught by: match
// mistake: one number after the other, once.

// <solution matched>
Eigen::Vector3d best = guess;
for (int i = 0; i < 3; ++i) {
  double score = fit(distances, best, scan, deviation);
  for (int k = -20; k <= 20; ++k) {
    Eigen::Vector3d pose = best;
    pose[i] = guess[i] + window[i / 2] * k / 20;
    const double value = fit(distances, pose, scan, deviation);
    if (value > score) best = pose, score = value;
  }
}
return best;
// </solution>
