#pragma once

#include <string>

#include "render/camera.h"
#include "render/film.h"

namespace rex {

/// From where and how large a film is drawn.
struct Shot {
  Camera camera{};
  int width = 640, height = 480;  ///< pixels
};

/// Draws the film as folder/0000.png, 0001.png, ...; frames of an earlier run in that folder go first. Ctrl-C
/// leaves whole files. These throw Error for a size out of range, files that cannot be written, a machine
/// without software OpenGL, and as drawFilm().
void writeFilmFrames(const Film& film, const Shot& shot, const std::string& folder);

/// The same into the folder NAME, and the video NAME.mp4 of `rate` frames per second. Without ffmpeg there
/// are only the frames, and a line on standard error says so.
void writeFilmVideo(const Film& film, const Shot& shot, const std::string& name, int rate);

/// Draws at most `pictures` moments of the film, evenly spaced, first and last included, side by side into
/// `file`, a .png, with their times. Throws Error for fewer than 2 pictures, too.
void writeFilmSheet(const Film& film, const Shot& shot, const std::string& file, int pictures);

}  // namespace rex
