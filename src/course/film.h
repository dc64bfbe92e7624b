#pragma once

#include <vector>

#include <Eigen/Core>

#include "course/pictures.h"
#include "render/film.h"

namespace rex {

inline constexpr int kFilmRate = 30;  ///< frames per second of a simulator's film

/// The recording as a film of at most `most` evenly spaced postures, with what the options add: traces up to
/// each moment, paths, points and the caption. Throws Error for an unknown body in `traces` and when `most`
/// is below 2.
[[nodiscard]] Film filmOf(const Simulator& simulator, const PictureOptions& options, int most);

/// The same of any postures, joint angles each.
[[nodiscard]] Film filmOf(const Simulator& simulator, const std::vector<Eigen::VectorXd>& postures,
                          const PictureOptions& options);

/// The camera that sees all of the film from the side that the options ask for.
[[nodiscard]] Camera cameraFor(const Film& film, const PictureOptions& options);

}  // namespace rex
