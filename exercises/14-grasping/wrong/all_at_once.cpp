// caught by: fewer, fewer-on-solids
// mistake: finds the fingers that are redundant, and deletes all of them at once.

// <solution keptFingers>
const auto without = [&](int removed) {
  Eigen::MatrixXd some(wrenches.rows(), 0);
  for (std::size_t k = 0; k < finger.size(); ++k)
    if (finger[k] != removed) {
      some.conservativeResize(wrenches.rows(), some.cols() + 1);
      some.col(some.cols() - 1) = wrenches.col(static_cast<Eigen::Index>(k));
    }
  return some;
};
std::vector<int> kept;
if (!judged(wrenches).closed) return kept;
for (const int one : finger)
  if ((kept.empty() || kept.back() != one) && !judged(without(one)).closed) kept.push_back(one);
return kept;
// </solution>
