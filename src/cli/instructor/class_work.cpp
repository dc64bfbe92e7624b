#include "cli/instructor/class_work.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "base/error.h"
#include "base/sha256.h"
#include "base/text.h"
#include "base/text_file.h"
#include "classroom/download.h"
#include "classroom/grade_task.h"
#include "classroom/import_table.h"
#include "classroom/platform_time.h"
#include "classroom/submission_folder.h"
#include "cli/build_on_demand.h"
#include "cli/sandbox_choice.h"
#include "cli/terminal.h"
#include "grading/hidden_seed.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;
using classroom::Task;

void makeFolder(const fs::path& out) {
  std::error_code failure;
  fs::create_directories(out, failure);
  if (failure)
    throw Error(
        {.what = "cannot make the folder of results", .where = {out.string()}, .found = failure.message()});
}

// What an import could not take is in no folder, and must not be forgotten.
void addRejected(const fs::path& folder, const std::string& only, classroom::SubmittedFiles& handedIn) {
  const auto isThere = [&](const std::string& student, const std::string& exercise) {
    return std::any_of(
        handedIn.files.begin(), handedIn.files.end(), [&](const classroom::SubmittedFile& file) {
          return file.student == student && file.exercise == exercise;  // put there by hand since then
        });
  };
  for (const classroom::ImportedStudent& student : classroom::importTableIn(folder).students)
    for (const auto& [exercise, told] : student.exercises)
      if (told.status == classroom::SubmissionStatus::kRejected && (only.empty() || only == exercise) &&
          !isThere(student.student, exercise))
        handedIn.complaints.push_back(
            fmt::format("{} {}: not taken by the import: {}", student.student, exercise, told.why));
}

// A download as it came from a platform is no folder of submissions yet.
void adviseImport(const fs::path& folder, const std::vector<ExerciseInfo>& exercises) {
  const classroom::Layout layout = classroom::recognizeFolderLayout(folder, exercises);
  if (layout.platform)
    note(fmt::format("`rex import {0} {1} -o HANDED_IN` makes a folder of submissions of what is there",
                     classroom::toString(*layout.platform), shown(folder)));
}

void tell(const classroom::SubmittedFiles& handedIn) {
  for (const std::string& complaint : handedIn.complaints) note(wrap(escapeForTerminal(complaint), 2, 0));
  constexpr std::size_t kMostNotes = 5;
  for (std::size_t k = 0; k < std::min(handedIn.notes.size(), kMostNotes); ++k)
    note(wrap(escapeForTerminal(handedIn.notes[k]), 2, 0));
  if (handedIn.notes.size() > kMostNotes)
    note(fmt::format("and {} more files that are not graded", handedIn.notes.size() - kMostNotes));
}

// The exercises whose grader does not build. They wait while the others are graded.
std::set<std::string> blockedOf(const classroom::SubmittedFiles& handedIn, Graders& graders) {
  std::map<std::string, int> counts;
  for (const classroom::SubmittedFile& file : handedIn.files) ++counts[file.exercise];
  std::set<std::string> blocked;
  for (const auto& [exercise, count] : counts) {
    try {
      static_cast<void>(graders.of(exercise));
    } catch (const BuildFailure& failure) {
      note(fmt::format("rex: {}", failure.what()));
      note(fmt::format("{}: {} submission{} not graded", exercise, count, count == 1 ? "" : "s"));
      blocked.insert(exercise);
    }
  }
  return blocked;
}

// The tasks, each with what is stored for it.
classroom::ClassRun readRun(const classroom::SubmittedFiles& handedIn, const GradeManyOptions& options,
                            sandbox::Level level, const std::vector<ExerciseInfo>& exercises,
                            const std::set<std::string>& blocked, Graders& graders) {
  std::optional<classroom::SubmissionTimes> times;
  if (!options.submitted.empty()) times.emplace(options.submitted, exercises);
  const classroom::ImportTable imports = classroom::importTableIn(options.folder);
  classroom::ClassRun run{.out = options.out, .secret = classroom::classSecret(options.secret)};
  if (const std::string warning = grading::openSecretWarning(options.secret); !warning.empty())
    note(wrap(escapeForTerminal(warning), 2, 0));
  for (const classroom::SubmittedFile& file : handedIn.files) {
    if (blocked.contains(file.exercise)) continue;
    Task task{.student = file.student, .exercise = file.exercise};
    task.file = classroom::writeSnapshot(file, options.out);
    task.sourceSha256 = sha256(classroom::gradedText(options.out / task.file));
    task.graderSha256 = graders.of(file.exercise).sha256;
    task.level = level;
    task.seed = options.seed;
    task.secretId = grading::courseSecretId(run.secret);
    const auto told = times ? times->of(file.student, file.exercise) : std::nullopt;
    const classroom::ImportedExercise* imported = imports.find(file.student, file.exercise);
    task.submitted = told.value_or(file.submitted);
    task.timeFrom = told ? "table" : "file";
    if (!told && imported != nullptr && imported->submitted) {
      task.submitted = *imported->submitted;
      task.timeFrom = imported->timeFrom;
    }
    // Others keep what they were graded with, and so does who was graded alone.
    classroom::StoredFiles files = classroom::readStoredFiles(classroom::resultFolder(options.out, task));
    const auto before = files.with();
    const bool isChosen = options.student.empty() || options.chosen.contains({task.student, task.exercise});
    if (before && (!isChosen || (before->alone && options.student.empty() && !options.regrade)))
      task.level = before->level, task.seed = before->seed, task.secretId = before->secretId;
    run.add(std::move(task), std::move(files));
  }
  return run;
}

// The files that count for the student of the option, also those that a partner handed in.
void chooseStudent(const classroom::SubmittedFiles& handedIn, const classroom::Course& course,
                   GradeManyOptions& options) {
  if (options.student.empty()) return;
  std::vector<Task> tasks;
  std::vector<std::string> folders, known;
  for (const classroom::SubmittedFile& file : handedIn.files) {
    tasks.push_back({.student = file.student, .exercise = file.exercise});
    folders.push_back(file.student);
  }
  const classroom::ImportTable imported = classroom::importTableIn(options.folder);
  const classroom::Course everyone = classroom::withStudents(course, tasks, imported);
  const classroom::SubmissionOwners owners(everyone, imported);
  const std::string id = classroom::studentCalled(options.student, everyone, imported, folders);
  for (const Task& task : tasks) {
    const std::vector<std::string> ids = owners.of(task.student, task.exercise);
    const bool isFolder = everyone.student(id) == nullptr && task.student == id;
    if (isFolder || std::find(ids.begin(), ids.end(), id) != ids.end())
      options.chosen.insert({task.student, task.exercise});
  }
  if (!options.chosen.empty()) return;
  known = folders;
  for (const classroom::CourseStudent& student : everyone.students)
    known.insert(known.end(), {student.id, student.name});
  throw UsageError(
      {.what = fmt::format("--student: '{}' handed in nothing", options.student),
       .wanted = "the id, number or name of a student, or a folder of submissions",
       .nearest = id.empty() ? nearestNames(options.student, known) : std::vector<std::string>{}});
}

// Another seed or another secret gives other questions, so that points of last week could change.
void requireSameSettings(const classroom::ClassRun& run, const GradeManyOptions& options) {
  if (options.regrade || !options.student.empty()) return;
  std::map<std::string, int> changes;
  int others = 0;
  const auto compare = [&](const char* name, const std::string& before, const std::string& now) {
    if (before == now) return false;
    ++changes[fmt::format("{} {} instead of {}", name, now, before)];
    return true;
  };
  const auto seedOf = [](const std::optional<std::uint64_t>& seed) {
    return seed ? fmt::format("{}", *seed) : "none";
  };
  const auto secretOf = [](const std::string& id) { return id.empty() ? "none" : id; };
  for (std::size_t k = 0; k < run.tasks.size(); ++k)
    if (const auto& before = run.stored[k].with) {
      const Task& task = run.tasks[k];
      const bool level = compare("sandbox level", fmt::format("{}", numberOf(before->level)),
                                 fmt::format("{}", numberOf(task.level))),
                 seed = compare("seed", seedOf(before->seed), seedOf(task.seed)),
                 secret = compare("secret", secretOf(before->secretId), secretOf(task.secretId));
      if (level || seed || secret) ++others;
    }
  if (others == 0) return;
  std::vector<std::string> parts;
  for (const auto& [change, count] : changes) parts.push_back(change);
  throw UsageError(
      {.what = fmt::format("{} result{} made with other settings", others, others == 1 ? " was" : "s were"),
       .where = {options.out.string()},
       .found = join(parts, ", "),
       .wanted = "the same, best in the course file, or --regrade"});
}

// The tables are of what was asked for, not of all that lies in the folder.
void tellWhatTablesLeaveOut(const fs::path& manifest, const std::string& only) {
  if (only.empty() || !fs::exists(manifest)) return;
  std::istringstream lines(readTextFile(manifest));  // only counted: it may be of another version
  int others = -1;                                   // without the headings
  for (std::string line; std::getline(lines, line);)
    if (line.find("\t" + only + "\t") == std::string::npos) ++others;
  if (others < 1) return;
  note(wrap(fmt::format("{} and grades.csv now list {} alone; the results of {} other submission{} stay, and "
                        "are listed again by rex grade without an exercise",
                        shown(manifest), only, others, others == 1 ? "" : "s"),
            2, 0));
}

// `rex grade --collect` has only the folder of results.
void keepWhatCollectNeeds(const classroom::SubmittedFiles& handedIn, const GradeManyOptions& options) {
  replaceTextFile(options.out / kRejectedFile, classroom::rejectedText(handedIn.rejected),
                  "the list of what was not taken");
  const fs::path imported = options.folder / classroom::kImportTable;
  if (fs::exists(imported))
    replaceTextFile(options.out / classroom::kImportTable, readTextFile(imported), "the table of imports");
  else
    fs::remove(options.out / classroom::kImportTable);
}

}  // namespace

const Graders::Grader& Graders::of(const std::string& name) {
  if (const auto found = graders_.find(name); found != graders_.end()) return found->second;
  Grader grader{.exercise = project_.exercise(name), .toolchain = {}, .sha256 = {}};
  grader.toolchain = prepare(project_, grader.exercise);
  grader.sha256 = classroom::graderFingerprint(grader.toolchain, grader.exercise, launcherPath(project_));
  return graders_.emplace(name, std::move(grader)).first->second;
}

ClassWork readClassWork(const Project& project, const classroom::Course& course, sandbox::Level level,
                        Graders& graders, const fs::path& manifest, GradeManyOptions& options) {
  const ExitCode roster = tellRoster(course);
  const std::vector<ExerciseInfo> exercises = project.exercises();
  classroom::SubmittedFiles handedIn = classroom::readSubmittedFiles(options.folder, exercises, options.only);
  ClassWork work{.only = options.only.empty() ? "" : project.exercise(options.only).name};
  addRejected(options.folder, work.only, handedIn);
  tell(handedIn);
  if (handedIn.files.empty()) adviseImport(options.folder, exercises);
  chooseStudent(handedIn, course, options);
  makeFolder(options.out);
  work.blocked = blockedOf(handedIn, graders);
  work.run = readRun(handedIn, options, level, exercises, work.blocked, graders);
  requireSameSettings(work.run, options);
  if (options.manifest.empty()) tellWhatTablesLeaveOut(manifest, work.only);
  replaceTextFile(manifest, classroom::toManifest(work.run.tasks), "the list of tasks");
  keepWhatCollectNeeds(handedIn, options);
  work.rejected = static_cast<int>(handedIn.complaints.size());
  work.taken = !work.blocked.empty() ? ExitCode::kGraderFault
               : work.rejected == 0  ? roster
                                     : ExitCode::kNotGradable;
  work.notTaken = std::move(handedIn.complaints);
  for (const classroom::RosterFault& fault : course.faults) work.notTaken.push_back(fault.why);
  return work;
}

}  // namespace rex::cli
