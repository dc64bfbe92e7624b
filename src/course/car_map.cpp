#include <cmath>
#include <cstdint>

#include "course/car_marks_internal.h"

namespace rex::internal {
namespace {

constexpr double kWallHeight = 0.4, kFloorHeight = 0.02;  // metres

// Free cells are nearly white, unknown ones grey, occupied ones dark.
std::uint8_t shadeOf(double probability) {
  constexpr double kFree = 250, kUnknown = 200, kOccupied = 60;
  const double shade = probability < 0.5 ? kFree + 2 * probability * (kUnknown - kFree)
                                         : kUnknown + (2 * probability - 1) * (kOccupied - kUnknown);
  return static_cast<std::uint8_t>(std::lround(shade));
}

Solid floorOf(const OccupancyMap& map) {
  MeshPaint paint{.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  Texture& texture = paint.textures.emplace_back(Texture{.width = map.width(), .height = map.height()});
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x)
      texture.rgb.insert(texture.rgb.end(), 3, shadeOf(map.probability(x, y)));
  const Eigen::Vector2f size = (cornersOf(map).col(1) - cornersOf(map).col(0)).cast<float>();
  const std::vector<Eigen::Vector3f> positions{
      {0, 0, 0}, {size.x(), 0, 0}, {size.x(), size.y(), 0}, {0, size.y(), 0}},
      normals(4, Eigen::Vector3f::UnitZ());
  TriangleMesh mesh(positions, normals, {{0, 1, 2}, {0, 2, 3}},
                    {{.color = Eigen::Vector4f::Ones(), .triangleCount = 2, .texture = 0}}, std::move(paint));
  return {{.type = ShapeType::kMesh, .mesh = std::move(mesh)},
          translation(map.origin().x(), map.origin().y(), kFloorHeight),
          {1, 1, 1},
          "floor"};
}

// The sides and the top of a box from `low` to `high`.
void addBlock(const Eigen::Vector3f& low, const Eigen::Vector3f& high,
              std::vector<Eigen::Vector3f>& positions, std::vector<Eigen::Vector3f>& normals,
              std::vector<TriangleMesh::Triangle>& triangles) {
  for (int face = 0; face < 5; ++face) {
    const int axis = face / 2;
    const bool isHigh = face % 2 == 1 || axis == 2;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const auto& [a, b] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
      Eigen::Vector3f corner;
      corner[axis] = isHigh ? high[axis] : low[axis];
      corner[u] = a == 1 ? high[u] : low[u];
      corner[v] = b == 1 ? high[v] : low[v];
      positions.push_back(corner);
      normals.push_back((isHigh ? 1 : -1) * Eigen::Vector3f::Unit(axis));
    }
    if (isHigh)
      triangles.insert(triangles.end(), {{first, first + 1, first + 2}, {first, first + 2, first + 3}});
    else
      triangles.insert(triangles.end(), {{first, first + 2, first + 1}, {first, first + 3, first + 2}});
  }
}

}  // namespace

Eigen::Matrix2d cornersOf(const OccupancyMap& map) {
  Eigen::Matrix2d corners;
  corners << map.origin(), map.origin() + map.cellSize() * Eigen::Vector2d(map.width(), map.height());
  return corners;
}

Eigen::MatrixXd probabilitiesOf(const OccupancyMap& map) {
  Eigen::MatrixXd probabilities(map.height(), map.width());
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x) probabilities(y, x) = map.probability(x, y);
  return probabilities;
}

std::vector<Solid> solidsOf(const OccupancyMap& map) {
  std::vector<Eigen::Vector3f> positions, normals;
  std::vector<TriangleMesh::Triangle> triangles;
  const auto corner = [&](int x, int y, double z) {
    const Eigen::Vector2d at = map.origin() + map.cellSize() * Eigen::Vector2d(x, y);
    return Eigen::Vector3d(at.x(), at.y(), z).cast<float>().eval();
  };
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x) {
      const int first = x;  // neighbours in a row make one block
      while (map.isOccupied(x, y)) ++x;
      if (x > first)
        addBlock(corner(first, y, 0), corner(x, y + 1, kWallHeight), positions, normals, triangles);
    }
  std::vector<Solid> solids{floorOf(map)};
  if (!triangles.empty())
    solids.push_back({{.type = ShapeType::kMesh, .mesh = TriangleMesh(positions, normals, triangles)},
                      {},
                      {0.36f, 0.38f, 0.43f},
                      "walls"});
  return solids;
}

}  // namespace rex::internal
