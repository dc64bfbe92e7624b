#include "bench/report.h"

#include <fstream>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/cpu_lanes.h"
#include "base/process.h"

namespace rex::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kTableFormat =
    "{:<11} {:<30} {:>10} {:>10} {:>10} {:>10} {:<4} {:<24} {:>6} {:>6}  {}\n";

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

std::string number(const std::optional<double>& value) { return value ? fmt::format("{:.2f}", *value) : "-"; }

std::string figure(const std::optional<Spread>& spread, double Spread::*which) {
  return spread ? fmt::format("{:.4g}", (*spread).*which) : "-";
}

Json numbers(const std::optional<Spread>& spread, double Spread::*which) {
  return spread ? Json((*spread).*which) : Json();
}

std::string verdict(const Line& line) {
  const std::optional<double> measured = ratio(line.row, line.result);
  if (!line.row.target || !measured) return "-";
  return *measured <= *line.row.target ? "met" : "not met";
}

// Debian's version of a peer without epoch and revision, by the name of the row; none where there is no dpkg.
std::string versionOf(const std::string& peer) {
  static const std::map<std::string, std::string> kPackages{
      {"Bullet", "libbullet-dev"},  {"Ceres", "libceres-dev"},   {"FCL", "libfcl-dev"},
      {"KDL", "liborocos-kdl-dev"}, {"MuJoCo", "libmujoco-dev"}, {"OMPL", "libompl-dev"},
      {"pagmo", "libpagmo-dev"},    {"SLICOT", "libslicot-dev"}};
  const auto package = kPackages.find(peer);
  if (package == kPackages.end()) return "";
  std::string version = runProcess({"dpkg-query", "-W", "-f", "${Version}", package->second}).output;
  version.erase(0, version.find(':') + 1);
  return version.substr(0, version.find_first_of("-+"));
}

}  // namespace

std::string peerWithVersion(const Row& row) {
  static std::map<std::string, std::string> known;
  std::string all;
  std::istringstream names(row.peerName);
  for (std::string name; std::getline(names, name, '+');) {
    if (!known.contains(name)) known[name] = versionOf(name);
    all += (all.empty() ? "" : " + ") + name + (known[name].empty() ? "" : " " + known[name]);
  }
  return all;
}

Machine thisMachine() {
  return {.cpu = cpuInfo("model name"),
          .flags = vectorFlags(),
          .compiler = REX_BENCH_COMPILER,
          .kernels = REX_BENCH_KERNELS,
          .lanes = cpuLanes()};
}

std::string tableHead() {
  return fmt::format(kTableFormat, "group", "name", "ours", "median", "peer", "median", "", "", "ratio",
                     "target", "");
}

std::string tableLine(const Line& line) {
  const auto& [group, row, result] = line;
  return fmt::format(kTableFormat, group, row.name, figure(result.ours, &Spread::smallest),
                     figure(result.ours, &Spread::median), figure(result.peer, &Spread::smallest),
                     figure(result.peer, &Spread::median), row.unit, peerWithVersion(row),
                     number(ratio(row, result)), number(row.target), verdict(line));
}

std::string json(const std::vector<Line>& lines) {
  Json rows = Json::array();
  for (const auto& [group, row, result] : lines) {
    rows.push_back({{"group", group},
                    {"name", row.name},
                    {"ours", numbers(result.ours, &Spread::smallest)},
                    {"ours_median", numbers(result.ours, &Spread::median)},
                    {"peer", numbers(result.peer, &Spread::smallest)},
                    {"peer_median", numbers(result.peer, &Spread::median)},
                    {"peer_name", row.peerName.empty() ? Json() : Json(peerWithVersion(row))},
                    {"unit", row.unit},
                    {"ratio", orNull(ratio(row, result))},
                    {"ratio_of", row.isMedian ? "medians" : "smallest"},
                    {"target", orNull(row.target)}});
  }
  const Machine machine = thisMachine();
  const Json about{{"cpu", machine.cpu},
                   {"flags", machine.flags},
                   {"lanes", machine.lanes},
                   {"compiler", machine.compiler},
                   {"kernels", machine.kernels}};
  return Json{{"machine", about}, {"rows", rows}}.dump(2) + "\n";
}

}  // namespace rex::bench
