#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "course/pictures.h"
#include "render/film.h"

namespace rex {

inline constexpr int kFilmRate = 30;  ///< frames per second of a simulator's film

/// Frames of a film that is not told how many, at most: those of half a minute. Of a longer motion there are
/// fewer per second.
inline constexpr int kMostFrames = 900;

/// The recording as a film of at most `most` postures, evenly spaced in time, with what the options add:
/// traces up to each moment, paths, points and the caption. Frames have the times of the motion, from 0 on;
/// see Recording::evenly() for postures without times. By default there are kFilmRate frames per second of
/// motion, kMostFrames at most. Throws Error for an unknown body in `traces` and when `most` is below 2.
[[nodiscard]] Film filmOf(const Simulator& simulator, const PictureOptions& options,
                          std::optional<int> most = {});

/// The same of any postures, joint angles each, kFilmRate of them per second.
[[nodiscard]] Film filmOf(const Simulator& simulator, const std::vector<Eigen::VectorXd>& postures,
                          const PictureOptions& options);

/// The posture now as a film of one frame, with traces of the recording up to it.
[[nodiscard]] Film stillOf(const Simulator& simulator, const PictureOptions& options);

/// The frames per second, 1 to kFilmRate, at which a video with one picture for each frame of a film is
/// nearest to real time.
[[nodiscard]] int videoRateOf(const Film& film);

/// The camera that sees all of the film from the side that the options ask for.
[[nodiscard]] Camera cameraFor(const Film& film, const PictureOptions& options);

}  // namespace rex
