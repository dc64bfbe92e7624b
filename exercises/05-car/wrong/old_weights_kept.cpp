// caught by: filter-step
// mistake: the copies of a heavy particle inherit its weight, which therefore counts twice.

// <solution filterStep>
const std::vector<int> parents =
    resampledParents(before.weights, static_cast<int>(before.weights.size()), rng);
for (std::size_t i = 0; i < parents.size(); ++i) {
  after.states.col(static_cast<Eigen::Index>(i)) = before.states.col(parents[i]);
  after.weights[static_cast<Eigen::Index>(i)] = before.weights[parents[i]];
}
after.states = moved(after.states, u, world, rng);
after.weights = after.weights.cwiseProduct(weightsOf(logLikelihoods(after.states, y, world)));
after.weights /= after.weights.sum();
// </solution>
