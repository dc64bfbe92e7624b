#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "geometry/pose.h"
#include "geometry/shape.h"
#include "render/camera.h"
#include "render/color.h"
#include "render/image.h"

namespace rex::internal {

enum class GlbTopology { kTriangles, kLines, kLineStrip, kPoints };

/// A part of a mesh in one colour. Its corners have as many normals as positions, or none.
struct GlbPrimitive {
  GlbTopology topology = GlbTopology::kTriangles;
  int positions = -1;  ///< accessors
  int normals = -1;
  int indices = -1;
  Color color{};
  bool doubleSided = false;  ///< seen from behind as well
};

/// Free data of a node or mesh: numbers and valid UTF-8 text by name.
struct GlbExtras {
  std::map<std::string, std::vector<double>> numbers{};  ///< one number is written as such, several as a list
  std::map<std::string, std::string> texts{};

  auto operator<=>(const GlbExtras&) const = default;
};

/// A place in the scene tree; without a mesh only a frame.
struct GlbNode {
  std::string name{};  ///< valid UTF-8
  int parent = -1;     ///< -1: the node stands at the top
  int mesh = -1;
  Pose pose{};
  Eigen::Vector3d scale{1, 1, 1};
  GlbExtras extras{};
};

enum class GlbPath { kTranslation, kRotation, kScale };

/// The parts of a binary glTF 2.0 file, collected one after the other. All indices count from 0 in the order
/// of adding. Data that was added before is not stored again.
class GlbWriter {
 public:
  GlbWriter();
  ~GlbWriter();
  GlbWriter(const GlbWriter&) = delete;
  GlbWriter& operator=(const GlbWriter&) = delete;

  /// Seconds, increasing.
  int addTimes(const std::vector<float>& times);
  /// What a node goes through: translations and scales (x, y, z) or rotations (x, y, z, w).
  int addKeys(std::span<const Eigen::Vector3f> keys);
  int addKeys(std::span<const Eigen::Vector4f> keys);
  /// The first `count` of some positions or normals; others may use more of them.
  int addVertices(std::span<const Eigen::Vector3f> values, std::size_t count);
  int addIndices(const std::vector<std::uint32_t>& indices);

  int addMesh(const std::vector<GlbPrimitive>& primitives, const GlbExtras& extras = {});
  int addNode(const GlbNode& node);
  int addCamera(const Camera& camera, int parent);
  /// Moves `node` through the accessors `times` and `values`; between two times in a straight line, or not
  /// at all.
  void animate(int node, GlbPath path, int times, int values, bool stepwise);

  /// The file so far.
  [[nodiscard]] std::string bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Triangles with smooth or flat normals; metres.
struct GlbSurface {
  std::vector<Eigen::Vector3f> positions, normals;
  std::vector<std::uint32_t> indices;
};

/// Puts meshes into a file, each one once. What has no surface is -1.
class GlbMeshes {
 public:
  explicit GlbMeshes(GlbWriter& writer) : writer_(&writer) {}

  /// A shape in its own frame; a sphere as ball(), to be scaled by its radius.
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
