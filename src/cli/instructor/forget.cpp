#include "cli/instructor/forget.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/instant.h"
#include "classroom/forgetting.h"
#include "cli/instructor/collect.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

std::int64_t dayOf(const std::string& text) {
  if (const auto time = parseInstant(text + "T00:00:00Z")) return *time;
  throw UsageError({.what = "--forget-before",
                    .found = "'" + escapeForTerminal(text) + "'",
                    .wanted = "a day such as 2026-03-31"});
}

// With the people of both folders: an import may be newer than the last grading.
classroom::ImportTable importsOf(const ForgetPlan& plan) {
  classroom::ImportTable all = classroom::importTableIn(plan.out);
  if (plan.handedIn.empty()) return all;
  for (classroom::ImportedStudent& person : classroom::importTableIn(plan.handedIn).students)
    if (all.find(person.student) == nullptr) all.students.push_back(std::move(person));
  return all;
}

// Names of folders and archives in both folders, to find who is on no list.
std::vector<std::string> foldersOf(const ForgetPlan& plan) {
  std::vector<std::string> names;
  for (const fs::path& folder : {plan.out, plan.handedIn})
    if (!folder.empty())
      for (const auto& entry : fs::directory_iterator(folder))
        names.push_back(entry.is_directory() ? entry.path().filename().string()
                                             : entry.path().stem().string());
  return names;
}

void sayList(const std::string& title, const std::vector<std::string>& all) {
  if (all.empty()) return;
  say(fmt::format("{} ({})", title, all.size()));
  for (const std::string& one : all) say(wrap("  " + escapeForTerminal(one), 4, 0));
}

std::vector<std::string> shownPaths(const classroom::Traces& traces) {
  std::vector<std::string> paths;
  for (const fs::path& path : traces.removed) paths.push_back(shown(path));
  for (const auto& [file, text] : traces.rewritten) paths.push_back(shown(file) + ": rows of this table");
  return paths;
}

// Lines that people wrote, which only people take out.
std::vector<std::string> mentions(const ForgetPlan& plan, const classroom::Course& course,
                                  const classroom::CourseStudent& student) {
  std::vector<fs::path> files = course.files;
  if (!plan.files.course.empty()) files.insert(files.begin(), plan.files.course);
  if (!plan.files.adjustments.empty()) files.push_back(plan.files.adjustments);
  std::vector<std::string> places;
  for (const fs::path& file : files)
    if (fs::is_regular_file(file))
      for (const std::string& place : classroom::mentionsIn(file, student)) places.push_back(place);
  return places;
}

classroom::CourseStudent studentOf(const ForgetPlan& plan, const classroom::Course& everyone,
                                   const classroom::ImportTable& imported) {
  if (plan.student.empty()) return {};
  const std::vector<std::string> folders = foldersOf(plan);
  const std::string id = classroom::studentCalled(plan.student, everyone, imported, folders);
  if (const classroom::CourseStudent* known = everyone.student(id)) return *known;
  if (!id.empty()) return {.id = id};
  std::vector<std::string> known = everyone.ids();
  known.insert(known.end(), folders.begin(), folders.end());
  throw UsageError({.what = fmt::format("--forget: nobody is called '{}'", escapeForTerminal(plan.student)),
                    .wanted = "the id, number, e-mail, name or folder of a student",
                    .nearest = nearestNames(plan.student, known)});
}

void makeTablesAgain(const Project& project, const ForgetPlan& plan) {
  if (!fs::exists(plan.out / "tasks.tsv") || tasksIn(plan.out).empty()) return;
  static_cast<void>(collectResults(project, {.out = plan.out, .files = plan.files}));
}

}  // namespace

ExitCode forgetPeople(const Project& project, const ForgetPlan& plan) {
  requireFolder(plan.out, "the folder of results that rex grade wrote");
  if (!plan.handedIn.empty()) requireFolder(plan.handedIn, "a folder of submissions");
  const classroom::Course course = readClassCourse(project, plan.files);
  const classroom::ImportTable imported = importsOf(plan);
  const std::vector<classroom::Task> tasks =
      fs::exists(plan.out / "tasks.tsv") ? tasksIn(plan.out) : std::vector<classroom::Task>{};
  const classroom::Course everyone = classroom::withStudents(course, tasks, imported);
  const classroom::CourseStudent student = studentOf(plan, everyone, imported);
  classroom::ForgetOptions options{.student = student.id};
  if (!plan.before.empty()) options.before = dayOf(plan.before);
  const classroom::Forgetting forgetting(everyone, imported, tasks, options);
  classroom::Traces traces;
  for (const fs::path& folder : {plan.handedIn, plan.out})
    if (!folder.empty()) forgetting.addFolder(folder, traces);
  if (!plan.similar.empty()) forgetting.addSimilar(plan.similar, traces);
  const std::vector<std::string> byHand =
      student.id.empty() ? std::vector<std::string>{} : mentions(plan, course, student);
  const bool isNothing = traces.removed.empty() && traces.rewritten.empty();
  sayList(plan.removes ? "Removed" : "To be removed", shownPaths(traces));
  sayList("Kept", traces.kept);
  sayList("Lines for you to take out", byHand);
  if (plan.removes) {
    classroom::removeTraces(traces);
    makeTablesAgain(project, plan);
  }
  say(isNothing      ? "Nothing is to be removed."
      : plan.removes ? "Copies elsewhere stay: exports, backups, platforms."
                     : "Nothing is removed yet: with --accept, it is.");
  return traces.kept.empty() && byHand.empty() ? ExitCode::kFull : ExitCode::kNotGradable;
}

}  // namespace rex::cli
