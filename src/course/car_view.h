#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "estimation/occupancy_map.h"
#include "render/color.h"
#include "render/image.h"

namespace rex {

// The meaning of colours in pictures and figures of the car. They can be told apart with any colour vision.
inline constexpr Color kTruthColor{0.20f, 0.22f, 0.26f};
inline constexpr Color kEstimateColor{0.0f, 0.45f, 0.7f};
inline constexpr Color kDeadReckoningColor{0.84f, 0.37f, 0.0f};
inline constexpr Color kLandmarkColor{0.0f, 0.62f, 0.45f};
inline constexpr Color kScanColor{0.80f, 0.47f, 0.65f};

/// A normal distribution of a point in the plane, drawn as an ellipse with a dot at its centre.
struct PlanarGaussian {
  Eigen::Vector2d mean{0, 0};
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
};

/// The positions of poses (x, y, heading), one in each column.
[[nodiscard]] Eigen::Matrix2Xd pathPoints(const std::vector<Eigen::Vector3d>& poses);

/// A line through points in the plane, such as the path of a car. The legend shows its name.
struct DrawnPath {
  std::string name{};         ///< empty: not in the legend
  Eigen::Matrix2Xd points{};  ///< the first two rows of poses: poses.topRows<2>()
  Color color = kTruthColor;
  bool dashed = false;  ///< in figures
  double width = 2.5;   ///< pixels
};

/// The content of one picture of a CarSimulator's world, as plain data; fill in what you have. Everything
/// is in the world frame, in metres; poses are (x, y, heading).
struct CarView {
  std::optional<Eigen::Vector3d> car{};       ///< the true pose: a solid car
  std::optional<Eigen::Vector3d> estimate{};  ///< a translucent car with an outline
  double carScale = 1;                        ///< of both cars' drawn size: 3 x 1.5 m
  std::optional<OccupancyMap> map{};          ///< walls, and grey where nothing is known
  Eigen::Matrix2Xd landmarks{};               ///< true positions: green posts
  Eigen::Matrix3Xd particles{};               ///< poses; at most 3000, evenly chosen, are drawn
  Eigen::VectorXd weights{};                  ///< of the particles, none negative; empty: all equal
  std::vector<PlanarGaussian> poseBeliefs{};
  std::vector<PlanarGaussian> landmarkBeliefs{};
  double sigmas = 2;  ///< size of all ellipses, in standard deviations
  std::vector<DrawnPath> paths{};
  Eigen::Matrix2Xd sightings{};  ///< positions seen now: lines to them from the car, or from its estimate
  Eigen::Matrix2Xd scan{};       ///< dots, such as the hits of a range scanner
  std::string caption{};         ///< in the top left corner, or the title of a figure
};

/// Throws Error naming what cannot be drawn: numbers that are not finite or beyond 1e9, weights that are
/// negative or do not match the particles in number, matrices that are not covariances, sigmas or widths
/// that are not positive, a car's scale that is not positive, sightings without a car or estimate.
void requireDrawable(const CarView& view);

struct Figure;

/// The view from above as a figure with equal axes in metres: the map with its ellipses, paths, particles
/// and landmarks. You may change the title, the legend and everything else afterwards; plot() draws it.
/// Throws Error as requireDrawable() does.
[[nodiscard]] Figure carFigure(const CarView& view);

}  // namespace rex
