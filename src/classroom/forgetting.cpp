#include "classroom/forgetting.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "base/text_file.h"
#include "classroom/archive.h"
#include "classroom/gradebook.h"
#include "classroom/gradebook_text.h"

namespace rex::classroom {
namespace {

namespace fs = std::filesystem;

// Tables of names and grades that `rex grade --collect` makes again, and what batch systems wrote.
bool isMadeAgain(const std::string& name) {
  static const std::set<std::string> kTables = {"grades.csv",   "totals.csv",    "not_on_roster.csv",
                                                "regraded.csv", "regrading.tsv", "jobs.tsv"};
  return kTables.contains(name) || (name.starts_with("slurm-") && name.ends_with(".log"));
}

std::int64_t secondsOf(const fs::path& path) {
  return std::chrono::duration_cast<std::chrono::seconds>(
             std::chrono::file_clock::to_sys(fs::last_write_time(path)).time_since_epoch())
      .count();
}

std::vector<fs::path> entriesOf(const fs::path& folder) {
  std::vector<fs::path> entries;
  if (fs::is_directory(fs::symlink_status(folder)))
    for (const auto& entry : fs::directory_iterator(folder)) entries.push_back(entry.path());
  std::ranges::sort(entries);
  return entries;
}

bool isFolder(const fs::path& path) { return fs::is_directory(fs::symlink_status(path)); }

// Beside letters and digits, another word.
bool isNamedIn(std::string_view line, const std::string& name) {
  const auto isPart = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 0x80 || std::isalnum(byte) != 0;
  };
  for (std::size_t at = line.find(name); at != line.npos; at = line.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || !isPart(line[at - 1])) && (end == line.size() || !isPart(line[end]))) return true;
  }
  return false;
}

}  // namespace

Forgetting::Forgetting(const Course& course, const ImportTable& imported, const std::vector<Task>& tasks,
                       ForgetOptions options)
    : course_(course), imported_(imported), options_(std::move(options)), owners_(course, imported) {
  for (const ImportedStudent& person : imported.students)
    for (const auto& [exercise, entry] : person.exercises)
      if (entry.submitted) times_[{entry.handedInBy, exercise}] = *entry.submitted;
  for (const Task& task : tasks) times_[{task.student, task.exercise}] = task.submitted;
}

Forgetting::Fate Forgetting::fateOf(const std::string& folder, const std::string& exercise,
                                    const fs::path& path) const {
  if (options_.before) {
    const auto known = times_.find({folder, exercise});
    const fs::path file = fs::exists(path / "main.cpp") ? path / "main.cpp" : path;
    const std::int64_t time = known != times_.end() ? known->second : secondsOf(file);
    return time < *options_.before ? Fate::kForgotten : Fate::kStays;
  }
  const std::vector<std::string> ids = owners_.of(folder, exercise);
  if (ids.empty()) return isPerson(folder) ? Fate::kForgotten : Fate::kStays;
  if (std::ranges::find(ids, options_.student) == ids.end()) return Fate::kStays;
  return ids.size() == 1 ? Fate::kForgotten : Fate::kShared;
}

bool Forgetting::isPerson(const std::string& folder) const {
  return !options_.student.empty() && caseless(folder) == caseless(options_.student);
}

std::string Forgetting::othersOf(const std::vector<std::string>& owners) const {
  std::vector<std::string> others = owners;
  std::erase(others, options_.student);
  return join(others, ", ");
}

void Forgetting::addStudent(const fs::path& folder, Traces& traces) const {
  const std::string name = folder.filename().string();
  const std::vector<fs::path> entries = entriesOf(folder);
  std::vector<fs::path> forgotten;
  for (const fs::path& entry : entries) {
    const std::string exercise = entry.filename().string();
    const Fate fate = fateOf(name, exercise, entry);
    if (fate == Fate::kForgotten) forgotten.push_back(entry);
    if (fate == Fate::kShared)
      traces.kept.push_back(
          fmt::format("{}: it counts for {}, too", entry.string(), othersOf(owners_.of(name, exercise))));
  }
  if (forgotten.size() == entries.size() && (!entries.empty() || isPerson(name))) forgotten = {folder};
  traces.removed.insert(traces.removed.end(), forgotten.begin(), forgotten.end());
}

void Forgetting::addFolder(const fs::path& folder, Traces& traces) const {
  const std::size_t before = traces.removed.size();
  for (const fs::path& entry : entriesOf(folder)) {
    const std::string name = entry.filename().string();
    if (isFolder(entry)) {
      addStudent(entry, traces);
    } else if (isArchiveName(name)) {
      const std::string student = withoutArchiveEnding(name);
      const Fate fate = fateOf(student, "", entry);
      if (fate == Fate::kForgotten) traces.removed.push_back(entry);
      if (fate == Fate::kShared)
        traces.kept.push_back(
            fmt::format("{}: it counts for {}, too", entry.string(), othersOf(owners_.of(student, ""))));
    }
  }
  addTables(folder, traces);
  const bool isChanged = traces.removed.size() > before || !traces.rewritten.empty();
  for (const fs::path& entry : entriesOf(folder))
    if (isChanged && isMadeAgain(entry.filename().string())) traces.removed.push_back(entry);
}

ImportTable Forgetting::without(const ImportTable& table) const {
  std::map<std::string, std::int64_t> latest;  // of each exercise: who handed in nothing has no time
  for (const ImportedStudent& person : table.students)
    for (const auto& [exercise, entry] : person.exercises)
      if (entry.submitted) latest[exercise] = std::max(latest[exercise], *entry.submitted);
  ImportTable rest;
  for (ImportedStudent person : table.students) {
    const std::string id = courseStudent(person, course_);
    if (!options_.student.empty() && (id == options_.student || (id.empty() && isPerson(person.student))))
      continue;
    const bool hadSome = !person.exercises.empty();
    if (options_.before)
      std::erase_if(person.exercises, [&](const auto& one) {
        const auto last = latest.find(one.first);
        const auto time = one.second.submitted   ? *one.second.submitted
                          : last != latest.end() ? last->second
                                                 : *options_.before;
        return time < *options_.before;
      });
    if (!hadSome || !person.exercises.empty()) rest.students.push_back(std::move(person));
  }
  return rest;
}

void Forgetting::addTables(const fs::path& folder, Traces& traces) const {
  const auto rewrite = [&](const char* name, const std::string& text) {
    if (text != readTextFile(folder / name)) traces.rewritten[folder / name] = text;
  };
  if (fs::exists(folder / kImportTable))
    rewrite(kImportTable, importTableText(without(readImportTable(folder / kImportTable))));
  const fs::path manifest = folder / "tasks.tsv", notTaken = folder / "not_taken.tsv";
  if (fs::exists(manifest)) {
    std::vector<Task> tasks = readManifest(manifest);
    std::erase_if(tasks, [&](const Task& task) {
      return fateOf(task.student, task.exercise, folder / task.student / task.exercise) == Fate::kForgotten;
    });
    rewrite("tasks.tsv", toManifest(tasks));
  }
  if (fs::exists(notTaken)) {
    std::vector<RejectedSubmission> rejected = readRejected(notTaken);
    std::erase_if(rejected, [&](const RejectedSubmission& one) {
      if (!options_.before) return fateOf(one.student, one.exercise, {}) == Fate::kForgotten;
      const auto time = times_.find({one.student, one.exercise});
      return time != times_.end() && time->second < *options_.before;
    });
    rewrite("not_taken.tsv", rejectedText(rejected));
  }
}

void Forgetting::addSimilar(const fs::path& folder, Traces& traces) const {
  for (const fs::path& entry : entriesOf(folder)) {
    if (!isFolder(entry)) continue;
    const std::string exercise = entry.filename().string();
    bool isNamed = false;
    for (const fs::path& student : entriesOf(entry / "submissions"))
      if (fateOf(student.filename().string(), exercise, student) == Fate::kForgotten) {
        traces.removed.push_back(student);
        isNamed = true;
      }
    const fs::path page = folder / (exercise + ".html");
    if (isNamed && fs::exists(page)) traces.removed.push_back(page);
  }
}

std::vector<std::string> mentionsIn(const fs::path& file, const CourseStudent& student) {
  std::vector<std::string> places;
  const std::string text = readTextFile(file);
  int number = 0;
  for (const std::string_view line : splitLines(text)) {
    ++number;
    const std::string composedLine = composed(line);
    for (const std::string* name : {&student.id, &student.number, &student.email, &student.name})
      if (!name->empty() && isNamedIn(composedLine, *name)) {
        places.push_back(fmt::format("{}:{}", file.string(), number));
        break;
      }
  }
  return places;
}

void removeTraces(const Traces& traces) {
  for (const auto& [file, text] : traces.rewritten) replaceTextFile(file, text, "the table");
  for (const fs::path& path : traces.removed) {
    std::error_code failure;
    fs::remove_all(path, failure);
    if (failure) throw Error({.what = "cannot remove", .where = {path.string()}, .found = failure.message()});
  }
}

}  // namespace rex::classroom
