#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace rex::ors {

/// nearestNames() of the first thousand names: a file may hold so many that comparing all takes long.
[[nodiscard]] inline std::vector<std::string> nearestOfMany(std::string_view wanted,
                                                            std::vector<std::string> names) {
  names.resize(std::min<std::size_t>(names.size(), 1000));
  return nearestNames(wanted, names);
}

}  // namespace rex::ors
