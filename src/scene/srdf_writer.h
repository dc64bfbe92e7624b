#pragma once

#include <span>
#include <string>

#include "scene/scene_spec.h"

namespace rex {

/// An SRDF of a robot of that name that says who may collide, as parseSrdf() reads it. `about` is a comment
/// below its head, if there is one. Throws Error for a name with characters that XML lacks.
[[nodiscard]] std::string writeSrdf(const std::string& robot, std::span<const CollisionChoice> choices,
                                    const std::string& about = "");

}  // namespace rex
