#include "classroom/grade_table.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/instant.h"
#include "classroom/csv.h"
#include "classroom/grade_task.h"
#include "grading/result_file.h"
#include "reports/report.h"

namespace rex::grading {
namespace {

std::vector<std::string> rowOf(const Task& task, const std::filesystem::path& out, const LatePolicy& policy) {
  const GradeResult result = loadResult(resultFolder(out, task) / "results.json");
  const auto rule = policy.find(task.exercise);
  const Lateness late = rule == policy.end()
                            ? Lateness{}
                            : latenessOf(rule->second, task.student, task.submitted, result.score);
  return {task.student,
          task.exercise,
          fmt::format("{}", result.score),
          fmt::format("{}", result.maxScore),
          std::string(toString(result.outcome)),
          fmt::format("{}", late.days),
          hundredthsText(late.penalty),
          hundredthsText(std::int64_t{100} * result.score - late.penalty)};
}

}  // namespace

Collected collect(const std::vector<Task>& tasks, const std::filesystem::path& out,
                  const LatePolicy& policy) {
  Collected found;
  found.csv = csvLine({"student", "exercise", "points", "possible", "outcome", "late", "penalty", "final",
                       "submitted", "time_from"});
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    const Task& task = tasks[k];
    const int number = static_cast<int>(k) + 1;
    std::vector<std::string> row = {task.student, task.exercise, "", "", "missing", "", "", ""};
    switch (stateOf(task, out)) {
      case TaskState::kMissing:
        found.missing.push_back(number);
        break;
      case TaskState::kStale:
        found.stale.push_back(number);
        row[4] = "stale";
        break;
      case TaskState::kRefused:
        found.refused.push_back(number);
        row[4] = "refused";
        break;
      case TaskState::kFailed:
        found.failed.push_back(number);
        row[4] = toString(Outcome::kGraderError);
        break;
      case TaskState::kDone:
        row = rowOf(task, out, policy);
    }
    row.insert(row.end(), {instantText(task.submitted), task.timeFrom});
    found.csv += csvLine(row);
  }
  return found;
}

std::string rangesOf(std::vector<int> numbers) {
  std::sort(numbers.begin(), numbers.end());
  std::string text;
  for (std::size_t k = 0; k < numbers.size();) {
    std::size_t last = k;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += fmt::format("{}{}", text.empty() ? "" : ",", numbers[k]);
    if (last > k) text += fmt::format("-{}", numbers[last]);
    k = last + 1;
  }
  return text;
}

}  // namespace rex::grading
