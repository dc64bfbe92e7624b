#pragma once

#include <string>
#include <string_view>

#include "geometry/pose.h"

namespace rex {

/// The pose that a text such as "<T t(0 0 1) d(90 1 0 0)>" describes, see share/doc/ors-format.md; `name`
/// stands for it in messages. Throws Error with line and column unless it is one pose with finite numbers.
[[nodiscard]] Pose parsePose(std::string_view text, const std::string& name);

}  // namespace rex
