#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace rex {

/// Which shapes in contact a shape may touch, by the rule of MuJoCo: bits of `type` that the other one has in
/// `affinity`, or the other way round. Whatever is not from an MJCF file has 1 and 1.
struct ContactMask {
  std::uint32_t type = 1, affinity = 1;
  /// Numbers of pairs that touch whatever the bits say: each number belongs to the shapes that have it.
  std::vector<int> pairs{};

  bool operator==(const ContactMask&) const = default;
};

/// Whether two masks have the number of a pair in common.
[[nodiscard]] inline bool arePaired(const ContactMask& a, const ContactMask& b) {
  return std::ranges::any_of(a.pairs, [&](int pair) { return std::ranges::count(b.pairs, pair) > 0; });
}

/// Whether shapes with these masks may touch.
[[nodiscard]] inline bool mayTouch(const ContactMask& a, const ContactMask& b) {
  return (a.type & b.affinity) != 0 || (b.type & a.affinity) != 0 || arePaired(a, b);
}

}  // namespace rex
