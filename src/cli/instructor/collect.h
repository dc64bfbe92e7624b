#pragma once

#include <filesystem>
#include <vector>

#include "classroom/late_policy.h"
#include "classroom/task_list.h"
#include "cli/project.h"
#include "reports/report.h"

namespace rex::cli {

/// The deadlines of that file; none without one. Throws as grading::readLatePolicy().
[[nodiscard]] grading::LatePolicy readDeadlines(const Project& project, const std::filesystem::path& file);

/// The formats of these names, with commas between. Throws UsageError naming the nearest.
[[nodiscard]] std::vector<grading::ReportFormat> reportsOf(const std::string& names);

/// Writes those reports beside the result of each task that has one, unless they are there, and takes away
/// those of these formats that have no result any more.
void writeReports(const std::vector<grading::Task>& tasks, const std::filesystem::path& out,
                  const std::vector<grading::ReportFormat>& reports);

/// Writes OUT/grades.csv, and prints it if asked. Tells which tasks have no valid result; false if there are
/// such.
[[nodiscard]] bool writeGrades(const std::vector<grading::Task>& tasks, const std::filesystem::path& out,
                               const grading::LatePolicy& policy, bool print);

}  // namespace rex::cli
