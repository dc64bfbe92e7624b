#pragma once

#include <cstddef>
#include <vector>

namespace rex::internal {

/// Which frames of a film a video shows, and how many per second: of each moment the frame that is nearest;
/// where frames are rarer than kFilmRate, all of them.
struct FilmPace {
  std::vector<std::size_t> frames{};
  int rate = 0;
};
/// For `count` frames, `step` seconds apart; one second of the video shows `speed` seconds of the film.
[[nodiscard]] FilmPace filmPace(int count, double step, double speed);

}  // namespace rex::internal
