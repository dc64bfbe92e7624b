// rex_bench [NAME...] [--json] [--report FILE.html]: measures ours against its peers; `rex dev bench` runs
// it.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <malloc.h>
#include <stdlib.h>

#include "base/error.h"
#include "base/text_file.h"
#include "bench/report.h"
#include "bench/report_page.h"

namespace rex::bench {
namespace {

constexpr int kUsageError = 64, kInternalError = 70;

using MakeRows = std::vector<Row> (*)();

struct Group {
  const char* name;
  std::vector<MakeRows> makers;
};

const std::vector<Group>& groups() {
  static const std::vector<Group> kGroups = {
      {"collision", {collisionRows}},   {"control", {controlRows}}, {"dynamics", {dynamicsRows}},
      {"estimation", {estimationRows}}, {"grading", {gradingRows}}, {"ik", {ikRows}},
      {"kinematics", {kinematicsRows}}, {"optim", {cmaRows}},       {"physics", {physicsRows}},
      {"planning", {planningRows}},     {"render", {renderRows}},   {"scene", {sceneRows}},
      {"trajectory", {trajectoryRows}}};
  return kGroups;
}

std::vector<Row> rowsOf(const Group& group) {
  std::vector<Row> rows;
  for (const MakeRows make : group.makers)
    for (Row& row : make()) rows.push_back(std::move(row));
  return rows;
}

bool isNamed(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// All groups, or those that a name selects, whole or a row of it. Names of rows are known only when the rows
// are made, which takes some seconds.
std::vector<Group> select(const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const Group& group : groups()) known.emplace_back(group.name);
  const bool areGroups =
      std::all_of(names.begin(), names.end(), [&](const std::string& name) { return isNamed(name, known); });
  std::vector<Group> selected;
  for (const Group& group : groups()) {
    bool isSelected = names.empty() || isNamed(group.name, names);
    if (!areGroups) {
      for (const Row& row : rowsOf(group)) {
        known.push_back(row.name);
        isSelected = isSelected || isNamed(row.name, names);
      }
    }
    if (isSelected) selected.push_back(group);
  }
  for (const std::string& name : names) {
    if (isNamed(name, known)) continue;
    throw UsageError({.what = fmt::format("no benchmark '{}'", name),
                      .wanted = "the name of a group or a row of the table, or none for all",
                      .nearest = nearestNames(name, known)});
  }
  return selected;
}

// The most memory that this process has held since the last call; nothing where the kernel does not say.
std::optional<double> peakBytes() {
  ::malloc_trim(0);
  std::ifstream status("/proc/self/status");
  std::optional<double> peak;
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) peak = 1024 * std::stod(line.substr(6));
  std::ofstream("/proc/self/clear_refs") << "5";
  return peak;
}

// Of ours and the peers together.
Line memoryLine(const std::string& group) {
  Line line{group, {.name = "peak-memory-" + group, .unit = "MB"}, {}};
  if (const std::optional<double> bytes = peakBytes())
    line.result.ours = Spread{*bytes * 1e-6, *bytes * 1e-6};
  return line;
}

enum class Form { kTable, kJson, kPage };

void run(const std::vector<std::string>& names, Form form, const std::filesystem::path& page) {
  const std::vector<Group> selected = select(names);
  const bool isTold = form != Form::kJson;
  if (isTold) fmt::print("{}", tableHead());
  std::vector<Line> lines;
  const auto add = [&](const Line& line) {
    lines.push_back(line);
    if (isTold) fmt::print("{}", tableLine(line));
    std::fflush(stdout);
  };
  // A group's rows go before the next one's are made, so that each is measured in a process of the same size.
  for (const Group& group : selected) {
    const bool isWhole = names.empty() || isNamed(group.name, names);
    static_cast<void>(peakBytes());
    for (const Row& row : rowsOf(group))
      if (isWhole || isNamed(row.name, names)) add({group.name, row, measure(row)});
    if (isWhole) add(memoryLine(group.name));
  }
  if (form == Form::kJson) fmt::print("{}", json(lines));
  if (form == Form::kPage) writeTextFile(page, reportPage(lines));
}

int main(int argc, char** argv) {
  CLI::App app(
      "Measures rex against its peers: CPU time, the smallest of several runs of both sides in turn.",
      "rex dev bench");
  std::vector<std::string> names;
  bool asJson = false;
  app.add_option("NAME", names, "groups or rows of the table; none: all");
  app.add_flag("--json", asJson, "print JSON instead of a table");
  std::filesystem::path page;
  app.add_option("--report", page, "also write a page with figures to this HTML file");
  try {
    app.parse(argc, argv);
    // Both sides draw on one thread: processor time then holds no waiting of threads for each other.
    ::setenv("LP_NUM_THREADS", "0", 0);
    run(names, asJson ? Form::kJson : page.empty() ? Form::kTable : Form::kPage, page);
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kUsageError;
  } catch (const UsageError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return kUsageError;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return kInternalError;
  }
}

}  // namespace
}  // namespace rex::bench

int main(int argc, char** argv) { return rex::bench::main(argc, argv); }
