// caught by: fewer, fewer-on-solids
// mistake: adds fingers one after the other until they hold, and does not check that all are needed.

// <solution keptFingers>
std::vector<int> kept;
Eigen::MatrixXd some(wrenches.rows(), 0);
for (std::size_t k = 0; k < finger.size(); ++k) {
  if (kept.empty() || kept.back() != finger[k]) {
    if (some.cols() > 0 && judged(some).closed) return kept;
    kept.push_back(finger[k]);
  }
  some.conservativeResize(wrenches.rows(), some.cols() + 1);
  some.col(some.cols() - 1) = wrenches.col(static_cast<Eigen::Index>(k));
}
return judged(some).closed ? kept : std::vector<int>();
// </solution>
