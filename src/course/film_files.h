#pragma once

#include <string>

#include "render/camera.h"
#include "render/film.h"

namespace rex {

/// The camera and the picture size of a film.
struct Shot {
  Camera camera{};
  int width = 640, height = 480;  ///< pixels
};

/// Draws the film as folder/0000.png, 0001.png, ... and first removes frames of an earlier run from that
/// folder. Ctrl-C leaves only complete files. The functions in this file throw Error for a size out of
/// range, files that cannot be written, a machine without software OpenGL, and as drawFilm() does.
void writeFilmFrames(const Film& film, const Shot& shot, const std::string& folder);

/// The same into the folder NAME, with the video NAME.mp4 at `rate` frames per second. Without ffmpeg there
/// are only the frames, and a line on standard error says so.
void writeFilmVideo(const Film& film, const Shot& shot, const std::string& name, int rate);

/// Draws at most `pictures` moments of the film, evenly spaced and including the first and last, side by
/// side into `file`, a .png, with their times. Also throws Error for fewer than 2 pictures.
void writeFilmSheet(const Film& film, const Shot& shot, const std::string& file, int pictures);

}  // namespace rex
