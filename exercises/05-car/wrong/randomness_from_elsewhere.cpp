// caught by: car-spread, car-drift, filter-step, whole-parts
// shown by: car-spread
// mistake: numbers from rand(), uniform with the right variance.

// <solution moved>
const auto number = [] { return std::sqrt(12.) * (std::rand() / (RAND_MAX + 1.) - 0.5); };
for (Eigen::Index i = 0; i < states.cols(); ++i)
  next.col(i) = carStep(states.col(i), u, world) + world.dynamicsNoise
                                                       * Eigen::Vector3d(number(), number(), number());
// </solution>

// <solution resampledParents>
Eigen::VectorXd rest = count * weights;
for (int i = 0; i < rest.size(); ++i) {
  const int whole = static_cast<int>(rest[i] + 1e-9);
  parents.insert(parents.end(), static_cast<std::size_t>(whole), i);
  rest[i] = std::max(0., rest[i] - whole);
}
double place = std::rand() / (RAND_MAX + 1.), end = 0;
for (int i = 0; i < rest.size(); ++i)
  for (end += rest[i]; place < end && static_cast<int>(parents.size()) < count; place += 1)
    parents.push_back(i);
parents.resize(static_cast<std::size_t>(count), 0);
// </solution>
