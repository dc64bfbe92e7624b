#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/require.h"
#include "control/rollouts.h"

namespace rex::internal {

inline void requireTrials(const std::string& plant, const std::vector<Trial>& trials) {
  for (std::size_t k = 0; k < trials.size(); ++k) {
    if (!trials[k].start.allFinite())
      rex::requireFinite(fmt::format("{}: start of trial {}", plant, k), trials[k].start);
  }
}

}  // namespace rex::internal
