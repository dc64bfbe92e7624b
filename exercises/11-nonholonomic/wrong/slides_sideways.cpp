// caught by: tree-room, tree-any
// shown by: tree-room
// mistake: nodes lie slightly beside where their controls lead; to and fro, the car slides to its goal.

// <solution growTree>
CarModel longer = car;
longer.front += 0.12;
longer.back += 0.02;
using Key = std::array<int, 3>;
const auto poseOf = [&](const Key& k) -> Eigen::Vector3d {
  return world.start + Eigen::Vector3d(0.4 * k[0], 0.4 * k[1], std::numbers::pi / 8 * k[2]);
};
std::set<Key> seen{{0, 0, 0}};
std::vector<std::pair<Key, std::size_t>> open{{{0, 0, 0}, 0}};
std::size_t at = 0;
for (; poseDistance(poseOf(open[at].first), world.goal) > 0.5; ++at) {
  for (std::size_t i = 0; i < 6; ++i) {
    Key next = open[at].first;
    next[i / 2] += i % 2 == 0 ? 1 : -1;
    const Eigen::Vector3d q = poseOf(next), middle = (q + poseOf(open[at].first)) / 2;
    if (std::abs(next[2]) > 8 || !isFree(longer, q, world.blocks) || !isFree(longer, middle, world.blocks))
      continue;
    if (seen.insert(next).second) open.emplace_back(next, at);
  }
}
std::vector<Eigen::Vector3d> way{poseOf(open[at].first)};
for (; at > 0; way.insert(way.begin(), poseOf(open[at].first))) at = open[at].second;
for (std::size_t i = 1; i < way.size(); ++i) {
  const Eigen::Vector3d step = way[i] - way[i - 1];
  const int count = 2 * static_cast<int>(std::ceil(step.cwiseAbs().maxCoeff() / 4e-4));
  for (int k = 1; k <= count; ++k) {
    Eigen::Vector3d q = way[i - 1] + step * k / count;
    if (k % 2 == 1) q += 0.1 * Eigen::Vector3d(std::cos(q[2]), std::sin(q[2]), 0);
    tree.push_back({q, static_cast<int>(tree.size()) - 1, {k % 2 == 1 ? 1. : -1., 0, 0.1}});
  }
}
// </solution>
