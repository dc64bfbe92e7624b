// caught by: forbidden-call
// mistake: the library resamples.

// <solution resampledParents>
parents = resampled(weights, count, Resampling::kResidual, rng);
// </solution>
