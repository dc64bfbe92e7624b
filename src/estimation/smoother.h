#pragma once

#include <span>
#include <vector>

#include "estimation/gaussian.h"
#include "estimation/gaussian_model.h"

namespace rex {

/// The beliefs of a Kalman filter, corrected by later observations: the smoother of Rauch, Tung and
/// Striebel (1965), which is slide 7:30 for Gaussians. transitions[t] leads from filtered[t] to filtered[t
/// + 1]; for an extended filter, pass the linearised models. Throws Error for counts and sizes that do not
/// fit, and like kalmanPredict.
[[nodiscard]] std::vector<Gaussian> smoothed(std::span<const Gaussian> filtered,
                                             std::span<const LinearModel> transitions);

}  // namespace rex
