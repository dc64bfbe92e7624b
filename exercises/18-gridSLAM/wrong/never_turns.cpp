// caught by: match, more-matches
// mistake: only positions are tried.

// <solution matched>
Eigen::Vector3d best = guess;
double score = fit(distances, guess, scan, deviation);
for (int i = -20; i <= 20; ++i)
  for (int j = -20; j <= 20; ++j) {
    const Eigen::Vector3d pose = guess + Eigen::Vector3d(i, j, 0) * window[0] / 20;
    const double value = fit(distances, pose, scan, deviation);
    if (value > score) best = pose, score = value;
  }
return best;
// </solution>
