#include "bench/report.h"

#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace rex::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kTableFormat = "{:<11} {:<22} {:>12} {:>12} {:<8} {:>7} {:>7}  {}\n";

// The value of the first line of /proc/cpuinfo with that key.
std::string cpuInfo(const std::string& key) {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(key)) return line.substr(std::min(line.size(), line.find(": ") + 2));
  }
  return "unknown";
}

// Of the CPU's many flags those that a kernel may use.
std::string vectorFlags() {
  std::istringstream all(cpuInfo("flags"));
  std::string kept;
  for (std::string flag; all >> flag;) {
    if (flag == "fma" || flag.starts_with("sse") || flag.starts_with("avx"))
      kept += (kept.empty() ? "" : " ") + flag;
  }
  return kept;
}

template <class T>
Json orNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

std::string number(const std::optional<double>& value, const std::string& unit = "") {
  if (!value) return "-";
  return unit.empty() ? fmt::format("{:.2f}", *value) : fmt::format("{:.4g} {}", *value, unit);
}

std::string verdict(const Line& line) {
  const std::optional<double> ratio = line.result.ratio();
  if (!line.row.target || !ratio) return "-";
  return *ratio <= *line.row.target ? "met" : "not met";
}

}  // namespace

std::string tableHead() {
  return fmt::format(kTableFormat, "group", "name", "ours", "peer", "", "ratio", "target", "");
}

std::string tableLine(const Line& line) {
  const Row& row = line.row;
  return fmt::format(kTableFormat, line.group, row.name, number(line.result.ours, row.unit),
                     number(line.result.peer, row.unit), row.peerName, number(line.result.ratio()),
                     number(row.target), verdict(line));
}

std::string json(const std::vector<Line>& lines) {
  Json rows = Json::array();
  for (const Line& line : lines) {
    rows.push_back({{"group", line.group},
                    {"name", line.row.name},
                    {"ours", orNull(line.result.ours)},
                    {"peer", orNull(line.result.peer)},
                    {"peer_name", line.row.peerName.empty() ? Json() : Json(line.row.peerName)},
                    {"unit", line.row.unit},
                    {"ratio", orNull(line.result.ratio())},
                    {"target", orNull(line.row.target)}});
  }
  const Json machine{
      {"cpu", cpuInfo("model name")}, {"flags", vectorFlags()}, {"compiler", REX_BENCH_COMPILER}};
  return Json{{"machine", machine}, {"rows", rows}}.dump(2) + "\n";
}

}  // namespace rex::bench
