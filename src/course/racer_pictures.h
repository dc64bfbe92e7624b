#pragma once

#include <string>
#include <vector>

#include "course/plant_film.h"
#include "render/picture.h"
#include "systems/racer.h"

namespace rex {

/// The content of a picture of racers, side by side in lanes 0.3 m wide, such as one before and one after
/// learning.
struct RacerView {
  Eigen::Matrix4Xd x{};              ///< states (x, theta, x', theta'), the nearest first
  std::vector<std::string> names{};  ///< one for each racer, drawn above it; or none
  std::string caption{};             ///< in the top left corner
  RacerDynamics dynamics{};          ///< for their lengths
};

/// Draws wheels, with crosses that show how they turn, and pendulums. Throws Error for numbers that are not
/// finite, if the number of names is not that of racers, and if there is no racer.
[[nodiscard]] Picture pictureOf(const RacerView& view);

/// Draws the view into `file`, a .png. Throws Error as pictureOf() does, and for a size out of range, a
/// file that cannot be written, or a machine without software OpenGL.
void writePicture(const RacerView& view, const std::string& file, const PlantFilmOptions& options = {});

/// Draws the views, one for each step, into the folder NAME as 0000.png, ..., the video NAME.mp4, and the
/// contact sheet NAME_sheet.png of evenly spaced moments. Without ffmpeg there is no video, and a line on
/// standard error says so. Throws as writePicture() does, and Error if there are no views, the step is not
/// positive, there are fewer than 2 moments, or the rate is below 1.
void writeFilm(const std::vector<RacerView>& views, const std::string& name,
               const PlantFilmOptions& options = {});

}  // namespace rex
