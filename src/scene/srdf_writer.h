#pragma once

#include <span>
#include <string>

#include "scene/scene_spec.h"

namespace rex {

/// An SRDF with the collision choices of the robot of that name, as parseSrdf() reads it. A non-empty
/// `about` becomes a comment below its head. Throws Error for a name with characters that are not allowed
/// in XML.
[[nodiscard]] std::string writeSrdf(const std::string& robot, std::span<const CollisionChoice> choices,
                                    const std::string& about = "");

}  // namespace rex
