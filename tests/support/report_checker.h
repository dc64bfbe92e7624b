#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/process.h"
#include "support/paths.h"

namespace rex {

inline constexpr const char* kPython = "/usr/bin/python3";  // where Debian's packages are known

/// What tests/grading/check_reports.py says; empty: all is well.
inline std::string reportChecker(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {kPython, sourcePath("tests/grading/check_reports.py")});
  const ProcessResult run = runProcess(arguments, {.timeout = 280});
  EXPECT_EQ(run.ok(), run.output.empty()) << run.error;
  EXPECT_EQ(run.error, "");
  return run.output;
}

/// A line for each file that breaks the schema of its format.
inline std::string schemaFaults(std::string_view format, const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> arguments = {"valid", std::string(format)};
  for (const std::filesystem::path& file : files) arguments.push_back(file.string());
  return reportChecker(arguments);
}

/// The same for all reports in a folder, and what they say otherwise than their results.
inline std::string reportDifferences(const std::filesystem::path& folder) {
  return reportChecker({"equal", folder.string()});
}

/// Whether the programs that it needs are installed; asked once.
inline bool hasReportChecker() {
  static const bool has = runProcess({kPython, "-c", "import jsonschema, markdown_it"}).ok() &&
                          runProcess({"xmllint", "--version"}).ok();
  return has;
}

}  // namespace rex

#define REX_NEEDS_REPORT_CHECKER() \
  if (!::rex::hasReportChecker())  \
  GTEST_SKIP() << "python3-jsonschema, python3-markdown-it or libxml2-utils is not installed"
