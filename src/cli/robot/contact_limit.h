#pragma once

#include <cstddef>

#include "collision/contact_model.h"

namespace rex::cli {

/// Pairs of shapes that a command looks at: if all of them touch, their list takes seconds and 220 MB.
inline constexpr std::size_t kMostContactPairs = 200'000;

/// What of a model may collide; says what is doubtful about it. Throws UsageError for more pairs of shapes on
/// different bodies, before they take memory, and as ContactModel throws Error.
[[nodiscard]] ContactModel contactModelOf(const Model& model);

/// Prints collisionWarnings().
void noteCollisionWarnings(const Model& model);

}  // namespace rex::cli
