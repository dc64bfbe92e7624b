#pragma once

#include <span>
#include <vector>

#include "estimation/gaussian.h"
#include "estimation/gaussian_model.h"

namespace rex {

/// The beliefs of a Kalman filter, corrected by what was observed later: the smoother of Rauch, Tung and
/// Striebel (1965), which is slide 7:30 for Gaussians. transitions[t] leads from filtered[t] to
/// filtered[t + 1]; of an extended filter, give the models that it linearised. Throws Error for counts and
/// sizes that do not fit, and as kalmanPredict.
[[nodiscard]] std::vector<Gaussian> smoothed(std::span<const Gaussian> filtered,
                                             std::span<const LinearModel> transitions);

}  // namespace rex
