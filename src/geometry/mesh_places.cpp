#include <bit>
#include <limits>

#include "geometry/mesh_places_internal.h"

namespace rex {
namespace {

std::uint64_t hashOf(const Eigen::Vector3f& p) {
  std::uint64_t hash = 0;
  for (const float x : p)
    hash = (hash ^ std::bit_cast<std::uint32_t>(x + 0.f)) * 0x9e3779b97f4a7c15u;  // -0 is 0
  return hash;
}

}  // namespace

// Uses a hash table with linear probing, at least half of which stays free.
MeshPlaces findPlaces(std::span<const Eigen::Vector3f> positions) {
  constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();
  const auto bits = std::bit_width(2 * positions.size() + 1);
  std::vector<std::uint32_t> table(std::size_t{1} << bits, kFree);
  MeshPlaces places;
  places.placeOf.reserve(positions.size());
  for (const Eigen::Vector3f& p : positions) {
    std::size_t slot = hashOf(p) >> (64 - bits);
    while (table[slot] != kFree && places.positions[table[slot]] != p) slot = (slot + 1) % table.size();
    if (table[slot] == kFree) {
      table[slot] = static_cast<std::uint32_t>(places.positions.size());
      places.positions.push_back(p);
    }
    places.placeOf.push_back(table[slot]);
  }
  return places;
}

}  // namespace rex
