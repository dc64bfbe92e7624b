#include "cli/instructor/grading_json.h"

#include "classroom/grade_task.h"
#include "cli/json_internal.h"
#include "grading/result_file.h"

namespace rex::cli {
namespace {

using grading::Task;
using grading::TaskState;

const char* nameOf(TaskState state) {
  switch (state) {
    case TaskState::kMissing:
      return "missing";
    case TaskState::kStale:
      return "stale";
    case TaskState::kFailed:
      return "failed";
    case TaskState::kRefused:
      return "refused";
    case TaskState::kDone:
      return "graded";
  }
  return "";
}

Json optionalJson(const std::optional<int>& number) { return number ? Json(*number) : Json(); }

Json statesJson(const std::vector<Task>& tasks, const std::filesystem::path& out) {
  Json list = Json::array();
  bool isComplete = true;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    const Task& task = tasks[k];
    const TaskState state = grading::stateOf(task, out);
    isComplete = isComplete && state == TaskState::kDone;
    std::optional<int> points, possible;
    if (state == TaskState::kDone) {
      const grading::GradeResult result =
          grading::loadResult(grading::resultFolder(out, task) / "results.json");
      points = result.score, possible = result.maxScore;
    }
    list.push_back(
        {{"task", k + 1},
         {"student", task.student},
         {"exercise", task.exercise},
         {"state", nameOf(state)},
         {"points", optionalJson(points)},
         {"possible", optionalJson(possible)},
         {"waiting", grading::isHeldBack(task, out) ? optionalJson(grading::pointsNow(task, out)) : Json()}});
  }
  return {{"tasks", list}, {"complete", isComplete}, {"table", (out / "grades.csv").string()}};
}

}  // namespace

std::string collectJson(const std::vector<Task>& tasks, const std::filesystem::path& out) {
  return dump(statesJson(tasks, out));
}

std::string gradingJson(const std::vector<Task>& tasks, const std::filesystem::path& out,
                        const GradingSummary& summary) {
  Json json = statesJson(tasks, out);
  json["level"] = summary.level;
  json["graded"] = summary.graded;
  json["kept"] = static_cast<int>(tasks.size()) - summary.graded;
  json["not_taken"] = summary.notTaken;
  json["blocked"] = summary.blocked;
  return dump(json);
}

}  // namespace rex::cli
