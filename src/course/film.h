#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "course/pictures.h"
#include "render/film.h"

namespace rex {

inline constexpr int kFilmRate = 30;  ///< frames per second of a simulator's film

/// The default maximum of frames in a film: those of half a minute. Longer motions get fewer frames per
/// second.
inline constexpr int kMostFrames = 900;

/// The recording as a film of at most `most` postures, evenly spaced in time, with what the options add:
/// traces up to each moment, paths, points and the caption. Frames have the times of the motion, starting
/// at 0; see Recording::evenly() for postures without times. By default there are kFilmRate frames per
/// second of motion, but at most kMostFrames. Throws Error for an unknown body in `traces` and if `most` is
/// below 2.
[[nodiscard]] Film filmOf(const Simulator& simulator, const PictureOptions& options,
                          std::optional<int> most = {});

/// The same for any postures, each given by its joint angles, at kFilmRate per second.
[[nodiscard]] Film filmOf(const Simulator& simulator, const std::vector<Eigen::VectorXd>& postures,
                          const PictureOptions& options);

/// The present posture as a film of one frame, with the traces of the recording up to it.
[[nodiscard]] Film stillOf(const Simulator& simulator, const PictureOptions& options);

/// The frame rate, 1 to kFilmRate per second, at which a video of the film's frames plays closest to real
/// time.
[[nodiscard]] int videoRateOf(const Film& film);

/// The camera that sees the whole film from the direction that the options ask for.
[[nodiscard]] Camera cameraFor(const Film& film, const PictureOptions& options);

}  // namespace rex
