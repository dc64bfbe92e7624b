#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "geometry/pose.h"
#include "geometry/shape.h"
#include "render/camera.h"
#include "render/color.h"

namespace rex {

class Model;
struct BodyPoses;

/// A body to draw: `shape` at X_WS. Materials of a mesh override `color`, except its opacity. A mesh
/// without triangles and a point cloud are drawn as points, a sphere-swept convex mesh without the swept
/// sphere. The name appears in messages only.
struct Solid {
  Shape shape{};
  Pose X_WS{};
  Color color{0.7f, 0.7f, 0.72f};
  std::string name{};
};

/// A checkered plane z = height that fades out around the scene; not visible from below. It is left out if
/// the scene has a ground of its own there, and lies a little lower if something small and flat is there.
struct Ground {
  bool visible = true;
  double height = 0;  ///< metres
  Bounds scene{};     ///< around which it fades out, W; empty: bounds() of the picture
  double cell = 0.5;  ///< edge length of a square, metres
  Color light{0.92f, 0.93f, 0.94f};
  Color dark{0.84f, 0.86f, 0.88f};
};

/// A line through points in W (metres). Parts hidden by solids show through faintly.
struct Polyline {
  std::vector<Eigen::Vector3d> points{};
  Color color{0.84f, 0.37f, 0.0f};
  double width = 2.5;  ///< pixels
};

/// Separate line segments in W (metres), such as the edges of a tree: tens of thousands are cheap.
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

/// An arrow between two points in W (metres), shaded as a solid. Its head is three times as thick as its
/// shaft. An arrow shorter than 12 radii is scaled down as a whole.
struct Arrow {
  Eigen::Vector3d from{0, 0, 0};
  Eigen::Vector3d to{0, 0, 1};
  Color color{0.84f, 0.37f, 0.0f};
  double radius = 0.01;  ///< of the shaft, metres
};

/// The ellipsoid with semi-axes `radii` (metres) along the axes of E. It is translucent: its interior is
/// visible.
struct Ellipsoid {
  Pose X_WE{};
  Eigen::Vector3d radii{1, 1, 1};
  Color color{0.0f, 0.45f, 0.7f, 0.35f};
};

/// Text beside a point in W (metres); never hidden. Printable ASCII only; any other character appears as '?'.
/// Labels and names of axes avoid each other and captions while there is room; the nearest are placed first.
struct Label {
  std::string text{};
  Eigen::Vector3d p_WQ{0, 0, 0};
  Color color{0.1f, 0.1f, 0.12f};
  double scale = 1;  ///< 1: capitals are 9 pixels high; at most 100
};

enum class Corner { kTopLeft, kTopRight, kBottomLeft, kBottomRight };

/// Text in a corner of the picture. Several in one corner are stacked; '\n' starts a new line.
struct Caption {
  std::string text{};
  Corner corner = Corner::kTopLeft;
  Color color{0.1f, 0.1f, 0.12f};
  double scale = 1;
};

/// Everything that a picture shows, as plain data. The viewpoint is given by a Camera.
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
/// The ground is infinite and does not count.
[[nodiscard]] Bounds bounds(const Picture& picture);
/// The box around one solid.
[[nodiscard]] Bounds bounds(const Solid& solid);

/// Throws Error naming the first solid, line, ... that has a number that is not finite or beyond 1e9, a
/// negative size, a matrix that is not a rotation, or an empty mesh, and for a light without direction.
void requireDrawable(const Picture& picture);

/// The ellipsoid of all x with (x - mean)' covariance^-1 (x - mean) <= sigmas^2, for a Gaussian in W, in
/// metres and square metres. With sigmas = 2 it contains 74 % of the samples. It is flat in directions of
/// zero variance. Throws Error for numbers that are not finite, a matrix that is not symmetric or has a
/// negative eigenvalue (both up to rounding), or sigmas that are not positive.
[[nodiscard]] Ellipsoid covarianceEllipsoid(const Eigen::Vector3d& mean, const Eigen::Matrix3d& covariance,
                                            double sigmas = 2, const Color& color = Ellipsoid{}.color);

/// The visible shapes of a scene, or all if none is visible, at `poses`, each in its own colour. Shapes
/// whose mesh was not loaded are left out.
[[nodiscard]] std::vector<Solid> placedSolids(const Model& model, const BodyPoses& poses);

/// Where the ground of a scene is, if it has one: the highest point of its shapes that are called so (W,
/// metres).
[[nodiscard]] std::optional<double> groundHeight(const Model& model, const BodyPoses& poses);

/// The same on the ground of the scene, or else on one that is never above a shape, for which it checks every
/// vertex of every mesh.
[[nodiscard]] Picture scenePicture(const Model& model, const BodyPoses& poses);

}  // namespace rex
