#pragma once

#include <string>
#include <vector>

#include "bench/report.h"

namespace rex::bench {

/// One HTML page that needs no network: the machine, the peers' versions (where Debian's packages say), and
/// all rows with bars of ratios, shorter being better, with a mark at each target.
[[nodiscard]] std::string reportPage(const std::vector<Line>& lines);

}  // namespace rex::bench
