#include "cli/student/progress.h"

#include <algorithm>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "base/error.h"
#include "base/instant.h"
#include "base/sha256.h"
#include "base/text_file.h"
#include "cli/json_internal.h"
#include "cli/terminal.h"
#include "submission/student_build.h"

namespace rex::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kSchema = "rex-progress/1";

// Keeps other programs from changing the file. If the file system has no locks, nobody waits.
class Lock {
 public:
  explicit Lock(const fs::path& file) : fd_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
    if (fd_ >= 0) ::flock(fd_, LOCK_EX);
  }
  ~Lock() {
    if (fd_ >= 0) ::close(fd_);
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  int fd_;
};

// 0 if there is none.
std::int64_t instantIn(const Json& entry, const char* key) {
  return parseInstant(entry.value(key, "")).value_or(0);
}

Work workOf(const Json& entry) {
  Work work{.seconds = entry.value("seconds", std::int64_t{0}),
            .lastSave = instantIn(entry, "last_save"),
            .fileSha256 = entry.value("file_sha256", "")};
  if (entry.contains("parts"))
    for (const auto& [id, part] : entry.at("parts").items())
      work.parts[id] = {.at = instantIn(part, "first_passed"),
                        .worked = part.value("after_seconds", std::int64_t{0})};
  return work;
}

Json toJson(const Work& work) {
  Json parts = Json::object();
  for (const auto& [id, part] : work.parts)
    parts[id] = {{"first_passed", instantText(part.at)}, {"after_seconds", part.worked}};
  return {{"seconds", work.seconds},
          {"last_save", instantText(work.lastSave)},
          {"file_sha256", work.fileSha256},
          {"parts", parts}};
}

Records recordsOf(const Json& entry) {
  Records records;
  for (const auto& [name, record] : entry.items()) {
    Attempts attempts{.unit = record.value("unit", ""),
                      .isMoreBetter = record.value("more_is_better", false),
                      .values = record.at("values").get<std::vector<double>>(),
                      .fileSha256 = record.value("file_sha256", "")};
    if (!attempts.values.empty()) records[name] = std::move(attempts);
  }
  return records;
}

Json toJson(const Records& records) {
  Json json = Json::object();
  for (const auto& [name, attempts] : records)
    json[name] = {{"unit", attempts.unit},
                  {"more_is_better", attempts.isMoreBetter},
                  {"values", attempts.values},
                  {"file_sha256", attempts.fileSha256}};
  return json;
}

Progress progressOf(const Json& entry) {
  Progress progress{.tested = entry.contains("points"),
                    .points = entry.value("points", 0),
                    .maxPoints = entry.value("max_points", 0),
                    .solved = entry.value("solved", false),
                    .fileSha256 = entry.value("file_sha256", "")};
  if (entry.contains("hints")) entry.at("hints").get_to(progress.hints);
  if (entry.contains("work")) progress.work = workOf(entry.at("work"));
  if (entry.contains("records")) progress.records = recordsOf(entry.at("records"));
  return progress;
}

void putInto(Json& entry, const Progress& progress) {
  if (progress.tested) {
    entry["points"] = progress.points;
    entry["max_points"] = progress.maxPoints;
    entry["solved"] = progress.solved;
    entry["file_sha256"] = progress.fileSha256;
  }
  if (!progress.hints.empty()) entry["hints"] = progress.hints;
  if (progress.work.lastSave != 0) entry["work"] = toJson(progress.work);
  if (!progress.records.empty()) entry["records"] = toJson(progress.records);
}

// Throws a Json::exception if it is not a progress file.
AllProgress allProgressOf(const Json& json) {
  AllProgress all{.last = json.value("last", "")};
  for (const auto& [name, entry] : json.at("exercises").items()) all.exercises[name] = progressOf(entry);
  return all;
}

Json emptyFile() { return {{"schema", kSchema}, {"exercises", Json::object()}}; }

bool isSound(const Json& json) {
  try {
    static_cast<void>(allProgressOf(json));
    return json.at("schema") == kSchema;
  } catch (const Json::exception&) {
    return false;
  }
}

// The broken file is kept, as somebody may still repair it.
void moveAside(const fs::path& file) {
  fs::path aside;
  for (int k = 1; k == 1 || fs::exists(aside); ++k) aside = fmt::format("{}.broken-{}", file.string(), k);
  fs::rename(file, aside);
  note(wrap(fmt::format("rex: {} cannot be understood and is now {}; progress starts from zero",
                        file.string(), aside.filename().string()),
            2, 0));
}

// Call under the lock. Throws Error if the file cannot be read at all, and leaves it in place.
Json load(const fs::path& file) {
  if (!fs::exists(file)) return emptyFile();
  Json json = Json::parse(readTextFile(file), nullptr, false);
  if (isSound(json)) return json;
  moveAside(file);
  return emptyFile();
}

void complain(const fs::path& folder, const std::exception& error) {
  note(wrap(fmt::format("rex: cannot keep progress in {}: {}", folder.string(), error.what()), 2, 0));
}

}  // namespace

void addTest(Work& work, const grading::GradeResult& result, bool isWhole, std::int64_t now) {
  if (result.snapshotSha256 != work.fileSha256) {
    const std::int64_t pause = now - work.lastSave;
    if (work.lastSave != 0 && pause > 0 && pause <= kLongestPause) work.seconds += pause;
    work.lastSave = now;
    work.fileSha256 = result.snapshotSha256;
  }
  if (!isWhole) return;
  std::map<std::string, bool> passes;
  for (const grading::CheckResult& check : result.checks)
    passes.try_emplace(check.part, true).first->second &= check.status == grading::Outcome::kPass;
  for (const auto& [part, all] : passes)
    if (all) work.parts.try_emplace(part, PassedPart{.at = now, .worked = work.seconds});
}

AllProgress ProgressFile::read() const {
  if (!fs::exists(folder_)) return {};
  try {
    const Lock lock(folder_ / "lock");
    return allProgressOf(load(folder_ / "progress.json"));
  } catch (const std::exception& error) {
    complain(folder_, error);
    return {};
  }
}

bool ProgressFile::change(const std::string& exercise, const std::function<void(Progress&)>& edit) const {
  try {
    fs::create_directories(folder_);
    const Lock lock(folder_ / "lock");
    const fs::path file = folder_ / "progress.json";
    Json json = load(file);
    Json& entry = json["exercises"][exercise];
    if (entry.is_null()) entry = Json::object();
    Progress progress = progressOf(entry);
    edit(progress);
    putInto(entry, progress);
    if (progress.tested) json["last"] = exercise;
    replaceTextFile(file, json.dump(2) + "\n", "the progress");
    return true;
  } catch (const std::exception& error) {
    complain(folder_, error);
    return false;
  }
}

namespace {

// Whether main.cpp differs from what was tested last.
bool isEdited(const ExerciseInfo& exercise, const Progress& progress) {
  try {
    return sha256(submission::readStudentFile(exercise.folder / "main.cpp")) != progress.fileSha256;
  } catch (const Error&) {
    return true;
  }
}

std::string lineOf(const ExerciseInfo& exercise, const Progress& progress, std::size_t nameWidth) {
  const int all = progress.tested ? progress.maxPoints : exercise.points();
  const std::string start = fmt::format("{:{}}  [{}] ", exercise.name, nameWidth, bar(progress.points, all));
  if (!progress.tested) return start + fmt::format("  - of {:2}", all);
  const bool isFull = progress.points == all;
  std::string line = start + paint(isFull ? Colour::kGreen : Colour::kYellow,
                                   fmt::format("{:3} of {:2}", progress.points, all));
  if (isEdited(exercise, progress)) line += "   edited since this test";
  return line;
}

// The exercise tested last if it is not solved, else the first unsolved one.
const ExerciseInfo* nextOf(const std::vector<ExerciseInfo>& exercises, const AllProgress& all) {
  const auto isOpen = [&](const ExerciseInfo& exercise) {
    const auto found = all.exercises.find(exercise.name);
    return found == all.exercises.end() || !found->second.solved;
  };
  const ExerciseInfo* next = nullptr;
  for (const ExerciseInfo& exercise : exercises) {
    if (!isOpen(exercise)) continue;
    if (exercise.name == all.last) return &exercise;
    if (next == nullptr) next = &exercise;
  }
  return next;
}

void sayNextStep(const ExerciseInfo& exercise, const Progress& progress) {
  const std::string main = shown(exercise.folder / "main.cpp");
  const std::string rex = "  scripts/rex ";
  say("Next: " + wrap(fmt::format("{}, {}", exercise.name, exercise.title), 6, 6));
  if (!progress.tested) {
    say(fmt::format("  read {} and edit {}, then", shown(exercise.folder / "README.md"), main));
    say(rex + fmt::format("{:20} its pictures", "run " + exercise.name.substr(0, 2)));
  } else {
    say(fmt::format("  go on with {}", main));
    say(rex + fmt::format("{:20} a question that helps", "hint " + exercise.name.substr(0, 2)));
  }
  say(rex + fmt::format("{:20} grade it", "test " + exercise.name.substr(0, 2)));
  say(rex + fmt::format("{:20} grade it whenever you save", "watch " + exercise.name.substr(0, 2)));
}

}  // namespace

ExitCode progress(const Project& project) {
  const std::vector<ExerciseInfo> exercises = project.exercises();
  if (exercises.empty() && !project.installed.empty()) {
    say(kNoCourseHere);
    return ExitCode::kFull;
  }
  const AllProgress all = ProgressFile(project.root).read();
  std::size_t nameWidth = 0;
  for (const ExerciseInfo& exercise : exercises) nameWidth = std::max(nameWidth, exercise.name.size());
  int solved = 0, points = 0, maxPoints = 0;
  const auto progressOf = [&](const ExerciseInfo& exercise) {
    const auto found = all.exercises.find(exercise.name);
    return found == all.exercises.end() ? Progress{} : found->second;
  };
  for (const ExerciseInfo& exercise : exercises) {
    const Progress progress = progressOf(exercise);
    say(lineOf(exercise, progress, nameWidth));
    solved += progress.solved ? 1 : 0;
    points += progress.points;
    maxPoints += progress.tested ? progress.maxPoints : exercise.points();
  }
  say(fmt::format("{} of {} exercises solved, {} of {} points in the last tests", solved, exercises.size(),
                  points, maxPoints));
  say();
  if (const ExerciseInfo* next = nextOf(exercises, all))
    sayNextStep(*next, progressOf(*next));
  else
    say("All exercises are solved.");
  say("\nAll commands: scripts/rex --help");
  return ExitCode::kFull;
}

}  // namespace rex::cli
