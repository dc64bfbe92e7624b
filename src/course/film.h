#pragma once

#include <vector>

#include <Eigen/Core>

#include "render/film.h"

namespace rex {

class Simulator;
struct PictureOptions;

/// The recording as a film of at most `most` frames, evenly spaced, thirty a second, with what the options
/// add. Throws Error for an unknown body in `traces`, and when `most` is below 2.
[[nodiscard]] Film filmOf(const Simulator& simulator, const PictureOptions& options, int most);

/// A film of the given postures (n joint angles each), with the traces up to each of them.
[[nodiscard]] Film filmOf(const Simulator& simulator, const std::vector<Eigen::VectorXd>& postures,
                          const PictureOptions& options);

}  // namespace rex
