// caught by: step-nearest
// shown by: step-nearest
// mistake: the distance is the sum of the differences of the coordinates.

// <solution nearestNode>
double least = std::numeric_limits<double>::infinity();
for (std::size_t i = 0; i < nodes.size(); ++i) {
  const double distance = (nodes[i] - target).cwiseAbs().sum();
  if (distance >= least) continue;
  least = distance;
  nearest = static_cast<int>(i);
}
// </solution>
