// caught by: filter-step
// mistake: a copy of the generator is used, so that the noise repeats the numbers of the resampling.

// <solution resampledParents>
Rng own = rng;
Eigen::VectorXd rest = count * weights;
for (int i = 0; i < rest.size(); ++i) {
  const int whole = static_cast<int>(rest[i] + 1e-9);
  parents.insert(parents.end(), static_cast<std::size_t>(whole), i);
  rest[i] = std::max(0., rest[i] - whole);
}
double place = own.uniform(), end = 0;
for (int i = 0; i < rest.size(); ++i)
  for (end += rest[i]; place < end && static_cast<int>(parents.size()) < count; place += 1)
    parents.push_back(i);
parents.resize(static_cast<std::size_t>(count), 0);
// </solution>
