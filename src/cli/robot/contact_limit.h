#pragma once

#include <cstddef>

#include "collision/contact_model.h"

namespace rex::cli {

/// The limit on pairs of shapes for a command: if all of them touch, their list takes seconds and 220 MB.
inline constexpr std::size_t kMostContactPairs = 200'000;

/// What may collide in a model; prints warnings about doubtful settings. Throws UsageError for more pairs
/// of shapes on different bodies, before allocating them, and if ContactModel throws Error.
[[nodiscard]] ContactModel contactModelOf(const Model& model);

/// Prints collisionWarnings().
void noteCollisionWarnings(const Model& model);

}  // namespace rex::cli
