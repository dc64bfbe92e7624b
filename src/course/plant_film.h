#pragma once

#include <Eigen/Core>

namespace rex {

/// How pictures and films of a cart pole or a racer are made.
struct PlantFilmOptions {
  Eigen::Vector3d view{0.35, -2, 0.45};  ///< the direction in which the camera stands, from the scene
  int width = 640, height = 480;         ///< pixels
  double step = 0.01;                    ///< seconds from view to view
  int rate = 30;                         ///< frames per second of a video, which plays in real time
  int moments = 6;                       ///< pictures in a contact sheet, at least 2
};

}  // namespace rex
