// caught by: astar-known-maps, astar-anything
// mistake: uses the estimate of the start for every node: that is Dijkstra, which looks everywhere.

// <solution aStar>
std::vector<double> lengths(estimates.size(), kInfinite);
std::vector<std::size_t> from(estimates.size(), start);
std::vector<bool> isDone(estimates.size());
using Entry = std::pair<double, std::size_t>;
std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
lengths[start] = 0;
queue.emplace(estimates[start], start);
while (!queue.empty() && queue.top().second != goal) {
  const std::size_t node = queue.top().second;
  queue.pop();
  if (isDone[node]) continue;
  isDone[node] = true;
  for (const Arc& arc : arcsOf(node)) {
    const double length = lengths[node] + arc.length;
    if (length >= lengths[arc.to]) continue;
    lengths[arc.to] = length;
    from[arc.to] = node;
    queue.emplace(length + estimates[start], arc.to);
  }
}
if (lengths[goal] == kInfinite) return {};
for (std::size_t node = goal; node != start; node = from[node]) way.push_back(node);
way.push_back(start);
std::reverse(way.begin(), way.end());
// </solution>
