// caught by: whole-parts, unbiased, filter-step
// mistake: only the heaviest particle has children.

// <solution resampledParents>
int heaviest = 0;
weights.maxCoeff(&heaviest);
static_cast<void>(rng);
parents.assign(static_cast<std::size_t>(count), heaviest);
// </solution>
