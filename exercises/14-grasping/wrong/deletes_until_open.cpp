// caught by: fewer, fewer-on-solids
// mistake: stops at the first finger that is needed; later ones may be redundant.

// <solution keptFingers>
if (!judged(wrenches).closed) return {};
std::vector<int> kept = finger;
kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
Eigen::Index gone = 0;
while (kept.size() > 1) {
  Eigen::Index next = gone;
  while (finger[static_cast<std::size_t>(next)] == kept.front()) ++next;
  if (!judged(wrenches.rightCols(wrenches.cols() - next)).closed) return kept;
  kept.erase(kept.begin());
  gone = next;
}
return kept;
// </solution>
