#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "classroom/late_policy.h"
#include "classroom/task_list.h"

namespace rex::grading {

/// The results found for a list of tasks, which are numbered from 1.
struct Collected {
  std::string csv{};           ///< one line per task, in their order
  std::vector<int> missing{};  ///< without a result
  std::vector<int> stale{};    ///< with a result for other inputs
  std::vector<int> refused{};  ///< with a result that was changed after the grading
  std::vector<int> failed{};   ///< the grader failed: to be repeated, never zero points
};

/// Reads all results below `out`. A task without a valid result has no points in its line.
[[nodiscard]] Collected collect(const std::vector<Task>& tasks, const std::filesystem::path& out,
                                const LatePolicy& policy);

/// "1,4-6,9": how batch systems name tasks.
[[nodiscard]] std::string rangesOf(std::vector<int> numbers);

}  // namespace rex::grading
