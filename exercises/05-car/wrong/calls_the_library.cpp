// caught by: forbidden-call
// mistake: the library resamples.

// <solution headers>
#include "estimation/resampling.h"
// </solution>

// <solution resampledParents>
parents = resampled(weights, count, Resampling::kResidual, rng);
// </solution>
