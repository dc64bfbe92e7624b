#pragma once

#include <filesystem>
#include <vector>

#include "cli/project.h"
#include "grading/late_policy.h"
#include "grading/task_list.h"

namespace rex::cli {

/// The deadlines of that file; none without one. Throws as grading::readLatePolicy().
[[nodiscard]] grading::LatePolicy readDeadlines(const Project& project, const std::filesystem::path& file);

/// Writes OUT/grades.csv, and prints it if asked. Tells which tasks have no valid result; false if there are
/// such.
[[nodiscard]] bool writeGrades(const std::vector<grading::Task>& tasks, const std::filesystem::path& out,
                               const grading::LatePolicy& policy, bool print);

}  // namespace rex::cli
