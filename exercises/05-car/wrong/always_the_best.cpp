// caught by: whole-parts, unbiased, filter-step
// mistake: only the heaviest particle has children.

// <solution resampledParents>
int heaviest = 0;
weights.maxCoeff(&heaviest);
parents.assign(static_cast<std::size_t>(count), heaviest);
// </solution>
