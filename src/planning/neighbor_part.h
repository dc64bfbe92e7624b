#pragma once

namespace rex {

/// A part of a space in plain numbers, for the kernel of nearest neighbours. Its numbers are scaled by its
/// weight; a chord is two lines, cosine and sine.
struct NeighborPart {
  enum class Kind { kLine, kCircle, kQuaternion };
  Kind kind = Kind::kLine;
  float period = 0;  ///< of a circle; angles are at most half of it
};

}  // namespace rex
