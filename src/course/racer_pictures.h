#pragma once

#include <string>
#include <vector>

#include "control/racer_dynamics.h"
#include "course/plant_film.h"
#include "render/picture.h"

namespace rex {

/// What a picture shows of racers, side by side in lanes of 0.3 m, such as one before and one after learning.
struct RacerView {
  Eigen::Matrix4Xd x{};              ///< states (x, theta, x', theta'), the nearest first
  std::vector<std::string> names{};  ///< as many, over the racers; or none
  std::string caption{};             ///< in the top left corner
  RacerDynamics dynamics{};          ///< their lengths
};

/// Wheels with crosses that turn, and pendulums. Throws Error for numbers that are not finite, another number
/// of names than racers, and no racer.
[[nodiscard]] Picture pictureOf(const RacerView& view);

/// Draws the view into `file`, a .png. Throws Error as pictureOf(), for a size out of range, a file that
/// cannot be written, or a machine without software OpenGL.
void writePicture(const RacerView& view, const std::string& file, const PlantFilmOptions& options = {});

/// Draws the views, one for each step, into the folder NAME as 0000.png, ..., the video NAME.mp4 and, of
/// moments evenly spaced, the contact sheet NAME_sheet.png. Without ffmpeg there is no video, and a line on
/// standard error says so. Throws as writePicture(), and Error for no views, steps that are not positive,
/// fewer than 2 moments and a rate below 1.
void writeFilm(const std::vector<RacerView>& views, const std::string& name,
               const PlantFilmOptions& options = {});

}  // namespace rex
