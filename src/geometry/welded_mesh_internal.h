#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace rex {

/// The distinct positions of vertices, in the order in which they come first, and which of them each has.
struct MeshPlaces {
  std::vector<Eigen::Vector3f> positions;
  std::vector<std::uint32_t> placeOf;
};
[[nodiscard]] MeshPlaces findPlaces(std::span<const Eigen::Vector3f> positions);

}  // namespace rex
