#pragma once

#include "base/error.h"
#include "formats/scene_file.h"

namespace rex::fuzz {

/// Requires of a scene that was read: it compiles or is refused by an Error. Of a small model all bodies
/// stand with proper rotations, and still do so in the same places after it was written and read again; only
/// what `write` refuses by an Error need not come back. That it wrote what cannot be read may only be for a
/// limit of the reader.
void requireSound(const SceneFile& scene, std::string (*write)(const SceneSpec&),
                  SceneSpec (*read)(const std::string&));

/// Requires that a reader refused `text` with a reason and a place inside it.
void requirePlace(const Error& error, std::string_view text);

}  // namespace rex::fuzz
