#pragma once

#include <filesystem>
#include <vector>

#include "classroom/gradebook.h"
#include "classroom/late_policy.h"
#include "classroom/task_list.h"
#include "cli/project.h"
#include "reports/report.h"

namespace rex::cli {

/// The deadlines in that file; none without a file. Throws like grading::readLatePolicy().
[[nodiscard]] grading::LatePolicy readDeadlines(const Project& project, const std::filesystem::path& file);

/// The report formats with these comma-separated names. Throws UsageError naming the nearest.
[[nodiscard]] std::vector<grading::ReportFormat> reportsOf(const std::string& names);

/// Writes missing reports next to the result of each task that has one, renews outdated ones in any format,
/// and removes those that no longer have a result.
void writeReports(const std::vector<grading::Task>& tasks, const std::filesystem::path& out,
                  const std::vector<grading::ReportFormat>& reports, const grading::Gradebook& book);

/// Writes OUT/grades.csv, with the other tables of a grade book if there is one, and prints it on request.
/// Reports tasks without a valid result, and returns false
/// if there are any.
[[nodiscard]] bool writeGrades(const std::vector<grading::Task>& tasks, const std::filesystem::path& out,
                               const grading::LatePolicy& policy, const grading::Gradebook* book, bool print);

/// Says which results with fewer points wait to be accepted; their number.
int tellHeldBack(const std::vector<grading::Task>& tasks, const std::filesystem::path& out);

}  // namespace rex::cli
