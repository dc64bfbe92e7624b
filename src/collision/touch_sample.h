#pragma once

#include <string>
#include <vector>

#include "base/rng.h"
#include "collision/collision_pairs.h"

namespace rex {

/// How often pairs of bodies overlapped in `postures` random postures.
struct TouchSample {
  struct Pair {
    PairVerdict verdict;
    int touches = 0;
  };
  int postures = 0;
  std::vector<Pair> pairs{};
  std::vector<std::string> held{};  ///< joints with a coordinate without a range, which was kept at home
};

/// Draws postures within the limits, with unlimited angles from a whole turn, and counts overlaps of all
/// pairs that may collide or are left out because they overlap at home. A sample proves nothing: a pair
/// that never touched may do so elsewhere. Throws Error as ContactModel, and unless `postures` > 0.
[[nodiscard]] TouchSample sampleTouches(const Model& model, int postures, Rng& rng);

/// The pairs to disable according to the sample, with the reasons as MoveIt's assistant names them: "Never"
/// or "Always" touched, or "Default" for an overlap at home that sometimes goes away.
[[nodiscard]] std::vector<CollisionChoice> suggestedChoices(const Model& model, const TouchSample& sample);

}  // namespace rex
