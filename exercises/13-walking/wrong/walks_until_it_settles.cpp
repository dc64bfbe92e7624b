// caught by: other-gaits
// mistake: walks on until nothing changes, which finds stable gaits only.

// <solution gaitNear>
Eigen::Vector4d x = guess;
for (int i = 0; i < 400; ++i) {
  const auto end = stepFrom(walker, x);
  if (!end) return std::nullopt;
  if ((end->x - x).norm() < 1e-9) break;
  x = end->x;
}
return x;
// </solution>
