#pragma once

#include <functional>
#include <string>
#include <vector>

#include "course/plant_film.h"
#include "render/film.h"

namespace rex::internal {

/// Draws a picture into `file`, a .png.
void writePlantPicture(const Picture& picture, const std::string& file, const PlantFilmOptions& options);

/// Which views a film takes, and its frames per second: of a frame the view that is nearest in time; where
/// views are rarer than frames, one frame for each. Throws Error for no views, steps that are not positive,
/// fewer than 2 moments and a rate below 1.
struct PlantFilmTiming {
  std::vector<int> views{};
  int rate = 0;
};
[[nodiscard]] PlantFilmTiming plantFilmTiming(int count, const PlantFilmOptions& options);

/// Draws the pictures at(0) to at(count - 1), which are options.step seconds apart, as frames NAME/0000.png,
/// ..., the video NAME.mp4 and the contact sheet NAME_sheet.png.
void writePlantFilm(int count, const std::function<Picture(int)>& at, const std::string& name,
                    const PlantFilmOptions& options);

}  // namespace rex::internal
