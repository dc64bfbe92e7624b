#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "geometry/pose.h"
#include "render/camera.h"
#include "render/color.h"

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

}  // namespace rex::internal
