#pragma once

#include <vector>

#include "course/car_view.h"
#include "render/picture.h"

namespace rex::internal {

/// Particles of similar weight, and how strongly they show: in (0, 1], the heaviest 1.
struct ParticleGroup {
  double strength = 1;
  std::vector<Eigen::Vector3d> poses{};
};

/// The particles that are drawn, the lightest first. None of the groups is empty.
[[nodiscard]] std::vector<ParticleGroup> particleGroups(const CarView& view);

/// The corners of the ellipse of a belief, in order, the first one again at the end.
[[nodiscard]] Eigen::Matrix2Xd outlineOf(const PlanarGaussian& belief, double sigmas);

/// The middle of a car is so far ahead of its pose, which lies between the hind wheels; metres.
inline constexpr double kCarMiddle = 1, kCarLength = 3, kCarWidth = 1.5;

/// Where a point ahead and to the left of the car at `pose` lies.
[[nodiscard]] Eigen::Vector2d placeAt(const Eigen::Vector3d& pose, double ahead, double left);

/// A floor with the map painted on it, and a low block for each occupied cell.
[[nodiscard]] std::vector<Solid> wallSolids(const OccupancyMap& map);
/// The probability of being occupied, one row of cells per row.
[[nodiscard]] Eigen::MatrixXd probabilitiesOf(const OccupancyMap& map);
/// Two opposite corners of the map.
[[nodiscard]] Eigen::Matrix2d cornersOf(const OccupancyMap& map);

}  // namespace rex::internal
