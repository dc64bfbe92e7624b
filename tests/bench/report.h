#pragma once

#include <string>

#include "bench/row.h"

namespace rex::bench {

/// A measured row of a group.
struct Line {
  std::string group;
  Row row;
  Result result;
};

/// The name of the row's peer, with the versions of Debian's packages where they are installed.
[[nodiscard]] std::string peerWithVersion(const Row& row);

/// The table's head and one line of it, each ending in a newline.
[[nodiscard]] std::string tableHead();
[[nodiscard]] std::string tableLine(const Line& line);

/// {"machine": {"cpu", "flags", "lanes", "compiler", "kernels"}, "rows": [{"group", "name", "ours",
/// "ours_median", "peer", "peer_median", "peer_name", "unit", "ratio", "ratio_of", "target"}]}, with null for
/// what is not there; `flags` are the CPU's vector extensions, `lanes` what our kernels use of them.
[[nodiscard]] std::string json(const std::vector<Line>& lines);

/// What the machine is, by the names of "machine" above.
struct Machine {
  std::string cpu, flags, compiler, kernels;
  int lanes = 0;
};
[[nodiscard]] Machine thisMachine();

}  // namespace rex::bench
