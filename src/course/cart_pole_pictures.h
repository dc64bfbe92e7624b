#pragma once

#include <string>
#include <vector>

#include "course/plant_film.h"
#include "render/picture.h"

namespace rex {

/// What a picture shows of a cart pole.
struct CartPoleView {
  Eigen::Vector4d x = Eigen::Vector4d::Zero();  ///< as of CartPole
  double u = 0;                                 ///< the force, an arrow of 5 cm per newton
  std::string caption{};                        ///< in the top left corner
};

/// The cart on its rail, which is as long as it must be, 1 m over the ground. Throws Error for numbers that
/// are not finite.
[[nodiscard]] Picture pictureOf(const CartPoleView& view);

/// Draws the view into `file`, a .png. Throws Error as pictureOf(), for a size out of range, a file that
/// cannot be written, or a machine without software OpenGL.
void writePicture(const CartPoleView& view, const std::string& file, const PlantFilmOptions& options = {});

/// Draws the views, one for each step, into the folder NAME as 0000.png, ..., the video NAME.mp4 and, of
/// moments evenly spaced, the contact sheet NAME_sheet.png. The film ends where a cart runs away by more than
/// 8 m. Without ffmpeg there is no video, and a line on standard error says so. Throws as writePicture(), and
/// Error for no views, steps that are not positive, fewer than 2 moments and a rate below 1.
void writeFilm(const std::vector<CartPoleView>& views, const std::string& name,
               const PlantFilmOptions& options = {.step = 1. / 60});

}  // namespace rex
