#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "classroom/task_list.h"

namespace rex::cli {

/// What a run of `rex grade` did, besides the results that it left.
struct GradingSummary {
  int level = 0;                        ///< of the sandbox
  int graded = 0;                       ///< tasks; the others had a valid result
  std::vector<std::string> notTaken{};  ///< complaints about what was handed in
  std::vector<std::string> blocked{};   ///< exercises whose grader does not build
};

/// The states of all tasks as JSON, "collect" of share/grading/commands.schema.json.
[[nodiscard]] std::string collectJson(const std::vector<grading::Task>& tasks,
                                      const std::filesystem::path& out);
/// The same with the summary: "grade".
[[nodiscard]] std::string gradingJson(const std::vector<grading::Task>& tasks,
                                      const std::filesystem::path& out, const GradingSummary& summary);

}  // namespace rex::cli
