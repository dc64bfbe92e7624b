#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "geometry/pose.h"
#include "geometry/shape.h"
#include "render/bounds.h"
#include "render/color.h"

namespace rex {

/// A body to draw: `shape` at X_WS. Materials of a mesh hide `color` but not its opacity; a mesh without
/// triangles and a point cloud are drawn as points, a sphere-swept convex mesh without what surrounds it. The
/// name appears in messages only.
struct Solid {
  Shape shape{};
  Pose X_WS{};
  Color color{0.7f, 0.7f, 0.72f};
  std::string name{};
};

/// A checkered plane z = height that fades out around the scene; not visible from below. It is left out where
/// the scene has a ground of its own there, and lies a little lower where something small and flat does.
struct Ground {
  bool visible = true;
  double height = 0;  ///< metres
  Bounds scene{};     ///< what it fades out around, W; empty: bounds() of the picture
  double cell = 0.5;  ///< edge length of a square, metres
  Color light{0.92f, 0.93f, 0.94f};
  Color dark{0.84f, 0.86f, 0.88f};
};

/// A line through points in W (metres). What solids hide of it shows through faintly.
struct Polyline {
  std::vector<Eigen::Vector3d> points{};
  Color color{0.84f, 0.37f, 0.0f};
  double width = 2.5;  ///< pixels
};

/// Separate lines from point to point of W (metres), such as the edges of a tree: tens of thousands cost
/// little.
struct LineSet {
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> segments{};
  Color color{0.35f, 0.40f, 0.46f};
  double width = 1;  ///< pixels
};

/// Discs that face the camera, at points in W (metres). Hidden ones show through faintly.
struct PointSet {
  std::vector<Eigen::Vector3d> points{};
  Color color{0.0f, 0.45f, 0.7f};
  double size = 6;  ///< diameter, pixels
};

/// The axes of frame F as a red x, green y and blue z line of `size` metres, with its name beside the origin.
struct Axes {
  Pose X_WF{};
  double size = 0.2;
  std::string name{};
};

/// An arrow between two points of W (metres), shaded as a solid. Its head is three times as thick as its
/// shaft. One shorter than 12 radii is as a whole smaller.
struct Arrow {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::UnitZ();
  Color color{0.84f, 0.37f, 0.0f};
  double radius = 0.01;  ///< of the shaft, metres
};

/// The ellipsoid with half axes `radii` (metres) along the axes of E. Translucent, so that what lies in it
/// shows.
struct Ellipsoid {
  Pose X_WE{};
  Eigen::Vector3d radii = Eigen::Vector3d::Ones();
  Color color{0.0f, 0.45f, 0.7f, 0.35f};
};

/// Text beside a point in W (metres); never hidden. Printable ASCII; any other character shows as '?'. Labels
/// and names of axes keep clear of each other and of captions while there is room, the nearest choose first.
struct Label {
  std::string text{};
  Eigen::Vector3d p_WQ = Eigen::Vector3d::Zero();
  Color color{0.1f, 0.1f, 0.12f};
  double scale = 1;  ///< 1: capitals 9 pixels high; at most 100
};

enum class Corner { kTopLeft, kTopRight, kBottomLeft, kBottomRight };

/// Text in a corner of the picture; several in one corner stand below each other, '\n' starts a new line.
struct Caption {
  std::string text{};
  Corner corner = Corner::kTopLeft;
  Color color{0.1f, 0.1f, 0.12f};
  double scale = 1;
};

/// All that a picture shows, as plain data. Where it is seen from is a Camera.
struct Picture {
  std::vector<Solid> solids{};
  Ground ground{};
  std::vector<Polyline> polylines{};
  std::vector<LineSet> lineSets{};
  std::vector<PointSet> pointSets{};
  std::vector<Axes> axes{};
  std::vector<Arrow> arrows{};
  std::vector<Ellipsoid> ellipsoids{};
  std::vector<Label> labels{};
  std::vector<Caption> captions{};
  Eigen::Vector3d toLight{-0.15, -0.85, 1.5};  ///< direction from the scene to the light, W, any length
};

/// The box around all solids, lines, points, axes, arrows, ellipsoids and labels; empty if there are none.
/// The ground has no end and does not count.
[[nodiscard]] Bounds bounds(const Picture& picture);
/// The box around one solid.
[[nodiscard]] Bounds bounds(const Solid& solid);

/// Throws Error naming the first solid, line ... with a number that is not finite or beyond 1e9, a size that
/// is negative, a solid's pose that is not a rotation, a mesh that is empty, or a light without direction.
void requireDrawable(const Picture& picture);

}  // namespace rex
