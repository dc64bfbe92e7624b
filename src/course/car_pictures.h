#pragma once

#include <string>
#include <vector>

#include "course/car_view.h"

namespace rex {

struct Picture;

/// How pictures and films of the car are made.
struct CarPictureOptions {
  Eigen::Vector3d view{10, -50, 99.5};  ///< the direction in which the camera stands, from the scene
  int width = 640, height = 480;        ///< pixels
  int rate = 10;                        ///< views per second of a video
  double step = 1;                      ///< seconds from view to view, for the times in a contact sheet
  int moments = 6;                      ///< pictures in a contact sheet, at least 2
};

/// The view in space, on a ground with squares of 5 m. Throws Error as requireDrawable().
[[nodiscard]] Picture pictureOf(const CarView& view);

/// Draws the view into `file`, a .png. Large ellipses may reach out of the picture. Throws Error as
/// requireDrawable(), for a view of nothing, a size out of range, a file that cannot be written, or a machine
/// without software OpenGL.
void writePicture(const CarView& view, const std::string& file, const CarPictureOptions& options = {});

/// Draws the views into the folder NAME as 0000.png, 0001.png, ..., the video NAME.mp4 and, of moments evenly
/// spaced, the contact sheet NAME_sheet.png; all are seen from one place. Without ffmpeg there is no video,
/// and a line on standard error says so. Throws as writePicture(), and Error for no views,
/// steps that are not positive, fewer than 2 moments and a rate below 1.
void writeFilm(const std::vector<CarView>& views, const std::string& name,
               const CarPictureOptions& options = {});

}  // namespace rex
