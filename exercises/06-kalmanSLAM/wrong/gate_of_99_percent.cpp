// caught by: names-found, names-any
// mistake: a landmark that looks unlikely at 1 % is taken for a new one: every hundredth sighting.

// <solution assigned>
// Squared distances are chi-square of 2 degrees for the right landmark: beyond g with probability exp(-g /
// 2). A landmark that is entered twice is never got rid of again, so a new one must be far from all.
constexpr double kSame = 9.21, kDifferent = 9.21;
struct Pair {
  double distance;
  std::size_t k;
  int i;
};
std::vector<Pair> pairs;
std::vector<double> nearest(ys.size(), kDifferent);
for (int i = 0; 3 + 2 * i < joint.mean.size(); ++i) {
  const ExpectedView expected = expectedView(car, joint, i);
  const Eigen::MatrixXd CS = expected.C * joint.covariance;
  const Eigen::MatrixXd precision = inverse(CS * expected.C.transpose() + viewNoise(car));
  for (std::size_t k = 0; k < ys.size(); ++k) {
    const Eigen::Vector2d gap = viewGap(car, ys[k], expected.y);
    const double distance = gap.dot(precision * gap);
    nearest[k] = std::min(nearest[k], distance);
    if (distance < kSame) pairs.push_back({distance, k, i});
  }
}
for (std::size_t k = 0; k < ys.size(); ++k)
  if (nearest[k] >= kDifferent) names[k] = kNewLandmark;
std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.distance < b.distance; });
for (const Pair& pair : pairs)
  if (names[pair.k] == kUnclear && std::find(names.begin(), names.end(), pair.i) == names.end())
    names[pair.k] = pair.i;
// </solution>
