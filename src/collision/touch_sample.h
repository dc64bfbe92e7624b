#pragma once

#include <string>
#include <vector>

#include "base/rng.h"
#include "collision/collision_pairs.h"

namespace rex {

/// In how many of `postures` random postures pairs of bodies overlapped.
struct TouchSample {
  struct Pair {
    PairVerdict verdict;
    int touches = 0;
  };
  int postures = 0;
  std::vector<Pair> pairs{};
  std::vector<std::string> held{};  ///< joints with a coordinate that has no range and stayed at home
};

/// Draws postures within the limits, turns without limits from a whole turn, and counts for all pairs that
/// may collide or are left out because they overlap at home. A sample proves nothing: a pair that never
/// touched may do so elsewhere. Throws Error as ContactModel, and unless `postures` > 0.
[[nodiscard]] TouchSample sampleTouches(const Model& model, int postures, Rng& rng);

/// What the sample suggests to disable, as MoveIt's assistant names the reasons: "Never" and "Always"
/// touched, or "Default" where an overlap at home is there at times.
[[nodiscard]] std::vector<CollisionChoice> suggestedChoices(const Model& model, const TouchSample& sample);

}  // namespace rex
