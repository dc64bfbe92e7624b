#pragma once

#include <string>
#include <vector>

#include "course/car_view.h"

namespace rex {

struct Picture;

/// Settings for pictures and films of the car.
struct CarPictureOptions {
  Eigen::Vector3d view{10, -50, 99.5};  ///< direction from the scene to the camera
  int width = 640, height = 480;        ///< pixels
  int rate = 10;                        ///< views per second of a video
  double step = 1;                      ///< seconds between views, for the times in a contact sheet
  int moments = 6;                      ///< pictures in a contact sheet, at least 2
};

/// The view in three dimensions, on a ground with squares of 5 m. Throws Error as requireDrawable() does.
[[nodiscard]] Picture pictureOf(const CarView& view);

/// Draws the view into `file`, a .png. Large ellipses may extend beyond the picture. Throws Error as
/// requireDrawable() does, and for an empty view, a size out of range, a file that cannot be written, or a
/// machine without software OpenGL.
void writePicture(const CarView& view, const std::string& file, const CarPictureOptions& options = {});

/// Draws the views into the folder NAME as 0000.png, 0001.png, ..., the video NAME.mp4, and the contact
/// sheet NAME_sheet.png of evenly spaced moments, all from the same camera. Without ffmpeg there is no
/// video, and a line on standard error says so. Throws as writePicture() does, and Error if there are no
/// views, the step is not positive, there are fewer than 2 moments, or the rate is below 1.
void writeFilm(const std::vector<CarView>& views, const std::string& name,
               const CarPictureOptions& options = {});

}  // namespace rex
