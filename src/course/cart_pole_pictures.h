#pragma once

#include <string>
#include <vector>

#include "course/plant_film.h"
#include "render/picture.h"

namespace rex {

/// The content of a picture of a cart pole.
struct CartPoleView {
  Eigen::Vector4d x{0, 0, 0, 0};  ///< state, as in CartPole
  double u = 0;                   ///< the force, an arrow of 5 cm per newton
  std::string caption{};          ///< in the top left corner
};

/// The cart on its rail, 1 m above the ground; the rail is as long as it has to be. Throws Error for
/// numbers that are not finite.
[[nodiscard]] Picture pictureOf(const CartPoleView& view);

/// Draws the view into `file`, a .png. Throws Error as pictureOf() does, and for a size out of range, a
/// file that cannot be written, or a machine without software OpenGL.
void writePicture(const CartPoleView& view, const std::string& file, const PlantFilmOptions& options = {});

/// Draws the views, one for each step, into the folder NAME as 0000.png, ..., the video NAME.mp4, and the
/// contact sheet NAME_sheet.png of evenly spaced moments. The film ends when the cart is more than 8 m
/// away. Without ffmpeg there is no video, and a line on standard error says so. Throws as writePicture()
/// does, and Error if there are no views, the step is not positive, there are fewer than 2 moments, or the
/// rate is below 1.
void writeFilm(const std::vector<CartPoleView>& views, const std::string& name,
               const PlantFilmOptions& options = {.step = 1. / 60});

}  // namespace rex
