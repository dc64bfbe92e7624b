#pragma once

#include <array>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/shape.h"
#include "render/glb_writer_internal.h"

namespace rex::internal {

/// Triangles with smooth or flat normals; metres.
struct GlbSurface {
  std::vector<Eigen::Vector3f> positions, normals;
  std::vector<std::uint32_t> indices;
};

/// Puts meshes into a file, each one once. What has no surface is -1.
class GlbMeshes {
 public:
  explicit GlbMeshes(GlbWriter& writer) : writer_(&writer) {}

  /// A shape in its own frame.
  int ofShape(const Shape& shape, const Color& color);
  /// Cylinder and cone of radius 1 with z from 0 to 1, the cone's tip above.
  int shaft(const Color& color);
  int head(const Color& color);
  /// The sphere of radius 1.
  int ball(const Color& color);
  /// The square |x|, |y| <= half, to be seen from above.
  int plane(double half, const Color& color);
  /// Three lines along the axes of a frame.
  int axes(double size);
  /// A line through, lines between every two of, or discs at the points of an accessor; width and diameter in
  /// pixels are extras.
  int line(int positions, const Color& color, double width);
  int lines(int positions, const Color& color, double width);
  int points(int positions, const Color& color, double size);

 private:
  int add(const GlbSurface& surface, const Color& color);
  int ofMesh(const Shape& shape, const Color& color);
  int ofRoundedBox(const Shape& shape, const Color& color);
  int ofAxes(double from, double to);
  int intern(const std::vector<GlbPrimitive>& primitives, const GlbExtras& extras = {});

  // All of a primitive, to be compared: what, positions, normals, indices, from both sides or not, colour.
  using Part = std::tuple<GlbTopology, int, int, int, bool, std::array<float, 4>>;

  GlbWriter* writer_;
  std::map<std::pair<std::vector<Part>, GlbExtras>, int> known_;  // meshes by all that makes them up
};

}  // namespace rex::internal
