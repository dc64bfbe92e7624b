#pragma once

#include "base/error.h"
#include "scene/scene_file.h"

namespace rex::fuzz {

/// Requires of a scene that was read: it compiles or is refused by an Error, and of a small model all bodies
/// stand upright in space, that is with proper rotations.
void requireSound(const SceneFile& scene);

/// Requires that a reader refused `text` with a reason and a place inside it.
void requirePlace(const Error& error, std::string_view text);

}  // namespace rex::fuzz
