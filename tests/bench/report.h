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

/// The table's head and one line of it, each ending in a newline.
[[nodiscard]] std::string tableHead();
[[nodiscard]] std::string tableLine(const Line& line);

/// {"machine": {"cpu", "flags", "compiler"}, "rows": [{"group", "name", "ours", "peer", "peer_name", "unit",
/// "ratio", "target"}]}, with null for what is not there; `flags` are the CPU's vector extensions.
[[nodiscard]] std::string json(const std::vector<Line>& lines);

}  // namespace rex::bench
