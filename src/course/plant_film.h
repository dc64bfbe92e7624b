#pragma once

#include <Eigen/Core>

namespace rex {

/// Settings for pictures and films of a cart pole or a racer.
struct PlantFilmOptions {
  Eigen::Vector3d view{0.35, -2, 0.45};  ///< direction from the scene to the camera
  int width = 640, height = 480;         ///< pixels
  double step = 0.01;                    ///< seconds between views
  int rate = 30;                         ///< frames per second of a video, which plays in real time
  int moments = 6;                       ///< pictures in a contact sheet, at least 2
};

}  // namespace rex
