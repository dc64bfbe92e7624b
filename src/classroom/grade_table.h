#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "classroom/late_policy.h"
#include "classroom/task_list.h"

namespace rex::grading {

/// What the folder of results holds for a list of tasks, by their numbers from 1.
struct Collected {
  std::string csv{};           ///< one line per task, in their order
  std::vector<int> missing{};  ///< without a result
  std::vector<int> stale{};    ///< with a result of other inputs
  std::vector<int> failed{};   ///< the grader failed: to be repeated, never a zero
};

/// Reads all results below `out`. A task without a valid one has no points in its line.
[[nodiscard]] Collected collect(const std::vector<Task>& tasks, const std::filesystem::path& out,
                                const LatePolicy& policy);

/// "1,4-6,9": how engines name tasks.
[[nodiscard]] std::string rangesOf(std::vector<int> numbers);

}  // namespace rex::grading
