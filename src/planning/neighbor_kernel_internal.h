#pragma once

#include "planning/neighbor_part.h"

// Squared distances in single precision, of which NearestNeighbors knows how far they may be off.
namespace rex::internal {

/// `count` parts, together of `size` numbers.
struct NeighborParts {
  const NeighborPart* parts;
  int count, size;
  bool isStraight;  ///< all are lines
};

struct NeighborKernel {
  /// Writes the squared distances of x from the points of `blocks` blocks of eight and returns the smallest.
  /// Number i of point k is at numbers[(k / 8 * size + i) * 8 + k % 8].
  float (*ofPoints)(const NeighborParts& parts, const float* numbers, int blocks, const float* x,
                    float* squared);
  /// Writes those from boxes: of each block first the lower numbers, like those of points, then the upper
  /// ones.
  void (*ofBoxes)(const NeighborParts& parts, const float* boxes, int blocks, const float* x, float* squared);
  /// One bit for each of the numbers in up to eight blocks: whether it is at most `reach`, or not a number.
  unsigned long long (*within)(const float* squared, int blocks, float reach);

  template <int kLanes>
  static NeighborKernel compiled();
};

}  // namespace rex::internal
