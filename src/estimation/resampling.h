#pragma once

#include <vector>

#include "base/require.h"

namespace rex {

class Rng;

/// How parents are drawn by their weights. All methods are unbiased: parent i has `count` w_i children on
/// average. Douc, Cappe and Moulines 2005.
enum class Resampling {
  kMultinomial,  ///< each child independently
  kResidual,     ///< the integer part of count w_i for certain, the rest at random (slide 7:23; Liu and Chen
                 ///< 1998)
  kStratified,   ///< one draw in each of `count` equal slices
  kSystematic    ///< the same offset in each slice: one random number
};

/// The parents of `count` children, in ascending order. Weights need not sum to one. Throws Error for weights
/// that are negative or not finite, naming the first, or all zero, and a negative count.
[[nodiscard]] std::vector<int> resampled(const VectorArg& weights, int count, Resampling how, Rng& rng);
/// Into a vector that is resized.
void resample(const VectorArg& weights, int count, Resampling how, Rng& rng, std::vector<int>& parents);

/// (sum w)^2 / sum w^2: the equivalent number of particles with equal weights. Throws like resampled.
[[nodiscard]] double effectiveSampleSize(const VectorArg& weights);

/// The number of particles that keeps the Kullback-Leibler distance to a distribution on `cells` occupied
/// cells below `error`, with the probability given by its normal quantile (2.326: 99 %). Fox 2003, equation
/// 7. Throws Error for an error or quantile that is not positive and finite, and for fewer than one cell.
[[nodiscard]] int adaptiveSampleSize(int cells, double error, double quantile = 2.326);

}  // namespace rex
