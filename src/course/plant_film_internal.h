#pragma once

#include <functional>
#include <string>

#include "course/plant_film.h"
#include "render/film.h"

namespace rex::internal {

/// Draws a picture into `file`, a .png.
void writePlantPicture(const Picture& picture, const std::string& file, const PlantFilmOptions& options);

/// Draws the pictures at(0) to at(count - 1), which are options.step seconds apart, as frames NAME/0000.png,
/// ..., the video NAME.mp4 and the contact sheet NAME_sheet.png.
void writePlantFilm(int count, const std::function<Picture(int)>& at, const std::string& name,
                    const PlantFilmOptions& options);

}  // namespace rex::internal
