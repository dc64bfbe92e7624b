#include "cli/collect.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "cli/grade_many.h"
#include "cli/terminal.h"
#include "grading/grade_table.h"
#include "grading/grade_task.h"
#include "grading/result_file.h"
#include "grading/text_file.h"

namespace rex::cli {
namespace {

using grading::Task;

void tell(const std::string& what, const std::vector<int>& numbers, const std::vector<Task>& tasks) {
  if (numbers.empty()) return;
  constexpr std::size_t kMostNamed = 10;
  note(fmt::format("{}: tasks {}", what, grading::rangesOf(numbers)));
  for (std::size_t k = 0; k < std::min(numbers.size(), kMostNamed); ++k) {
    const Task& task = tasks[static_cast<std::size_t>(numbers[k]) - 1];
    note(fmt::format("  {} {}", task.student, task.exercise));
  }
  if (numbers.size() > kMostNamed) note(fmt::format("  and {} more", numbers.size() - kMostNamed));
}

}  // namespace

grading::LatePolicy readDeadlines(const Project& project, const std::filesystem::path& file) {
  if (file.empty()) return {};
  std::vector<std::string> names;
  for (const ExerciseInfo& exercise : project.exercises()) names.push_back(exercise.name);
  return grading::readLatePolicy(file, names);
}

bool writeGrades(const std::vector<Task>& tasks, const std::filesystem::path& out,
                 const grading::LatePolicy& policy, bool print) {
  std::vector<std::string> students;
  for (const Task& task : tasks) students.push_back(task.student);
  for (const std::string& sentence : grading::unknownExtensions(policy, students))
    note(wrap(harmless(sentence), 2, 0));
  const grading::Collected found = grading::collect(tasks, out, policy);
  grading::replaceTextFile(out / "grades.csv", found.csv, "the table of grades");
  if (print) std::fputs(found.csv.c_str(), stdout);
  tell("no result", found.missing, tasks);
  tell("a result of something else", found.stale, tasks);
  tell("the grader failed", found.failed, tasks);
  std::vector<int> again = found.missing;
  again.insert(again.end(), found.stale.begin(), found.stale.end());
  again.insert(again.end(), found.failed.begin(), found.failed.end());
  if (again.empty()) return true;
  note(fmt::format("To repeat: {}", grading::rangesOf(again)));
  return false;
}

ExitCode collectResults(const Project& project, const CollectOptions& options) {
  const std::filesystem::path manifest =
      options.manifest.empty() ? options.out / "tasks.tsv" : options.manifest;
  const std::vector<Task> tasks = grading::readManifest(manifest);
  const bool complete =
      writeGrades(tasks, options.out, readDeadlines(project, options.deadlines), options.csv);
  note(fmt::format("{} tasks. Table: {}", tasks.size(), shown(options.out / "grades.csv")));
  return complete ? ExitCode::kFull : ExitCode::kGraderFault;
}

}  // namespace rex::cli
