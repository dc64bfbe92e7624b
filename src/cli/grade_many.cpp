#include "cli/grade_many.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <thread>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/collect.h"
#include "cli/progress_line.h"
#include "cli/sandbox_choice.h"
#include "cli/terminal.h"
#include "grading/grade_task.h"
#include "grading/grader_fingerprint.h"
#include "grading/hand_in.h"
#include "grading/private_folder.h"
#include "grading/process_pool.h"
#include "grading/sha256.h"
#include "grading/submission_times.h"
#include "grading/text_file.h"
#include "sandbox/probes.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;
using grading::Task;

/// How exercises are graded here, made when the first task asks.
class Graders {
 public:
  explicit Graders(const Project& project) : project_(project) {}

  struct Grader {
    ExerciseInfo exercise;
    grading::Toolchain toolchain;
    std::string sha256;
  };
  const Grader& of(const std::string& name) {
    if (const auto found = graders_.find(name); found != graders_.end()) return found->second;
    Grader grader{.exercise = project_.exercise(name), .toolchain = {}, .sha256 = {}};
    grader.toolchain = prepare(project_, grader.exercise);
    grader.sha256 = grading::graderFingerprint(grader.toolchain, grader.exercise, launcherOf(project_));
    return graders_.emplace(name, std::move(grader)).first->second;
  }

 private:
  const Project& project_;
  std::map<std::string, Grader> graders_;
};

// For work of strangers: the asked level, else the best that holds here. One below 2 must be accepted by its
// number. Nothing if there is none; why is told, and what a weak one does not stop.
std::optional<sandbox::Sandbox> chooseForStrangers(const Project& project, std::optional<int> level,
                                                   std::optional<int> accepted) {
  constexpr int kBest = 3, kSafe = 2;
  if (!level) {
    const grading::PrivateFolder folder(std::filesystem::temp_directory_path());
    const auto best = sandbox::bestLevel(kBest, launcherOf(project), probeOf(project), folder.path());
    level = best.level;
    for (const std::string& reason : best.reasons)
      if (best.level < kSafe) note(wrap(harmless(reason), 2, 0));
  }
  if (*level < accepted.value_or(kSafe)) {
    note(wrap(fmt::format("sandbox level {} is not for work of strangers: {}; to grade all the same, say "
                          "--i-accept-level {}",
                          *level, sandbox::warningOf(*level), *level),
              2, 0));
    return {};
  }
  const std::optional<sandbox::Sandbox> chosen = chooseSandbox(project, level);
  if (chosen && *level < kSafe)
    note(wrap(fmt::format("sandbox level {}: {}", *level, sandbox::warningOf(*level)), 2, 0));
  return chosen;
}

// Results inside of what was handed in would be handed in next time.
bool contains(const fs::path& outer, const fs::path& inner) {
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

// What a command writes would be taken for what was handed in, or for results.
void requireApart(const char* option, const fs::path& folder, const fs::path& other) {
  const fs::path here = fs::weakly_canonical(folder), there = fs::weakly_canonical(other);
  if (contains(here, there) || contains(there, here))
    throw UsageError(
        {.what = option, .found = here.string(), .wanted = "a folder apart from " + there.string()});
}

void requireApart(const GradeManyOptions& options) {
  if (!fs::is_directory(options.folder))
    throw UsageError(
        {.what = "no such folder", .where = {options.folder.string()}, .wanted = "what was handed in"});
  requireApart("--out", options.out, options.folder);
  if (options.workers.empty()) return;
  requireApart("--workers", options.workers, options.folder);
  requireApart("--workers", options.workers, options.out);
}

void makeFolder(const fs::path& out) {
  std::error_code failure;
  fs::create_directories(out, failure);
  if (failure)
    throw Error(
        {.what = "cannot make the folder of results", .where = {out.string()}, .found = failure.message()});
}

void tell(const grading::HandIns& handedIn) {
  for (const std::string& complaint : handedIn.complaints) note(wrap(harmless(complaint), 2, 0));
  constexpr std::size_t kMostNotes = 5;
  for (std::size_t k = 0; k < std::min(handedIn.notes.size(), kMostNotes); ++k)
    note(wrap(harmless(handedIn.notes[k]), 2, 0));
  if (handedIn.notes.size() > kMostNotes)
    note(fmt::format("and {} more files that are not graded", handedIn.notes.size() - kMostNotes));
}

std::vector<Task> tasksOf(const grading::HandIns& handedIn, const GradeManyOptions& options, int level,
                          const std::vector<ExerciseInfo>& exercises, Graders& graders) {
  std::optional<grading::SubmissionTimes> times;
  if (!options.submitted.empty()) times.emplace(options.submitted, exercises);
  const std::string secretId = grading::secretIdOf(options.secret);
  std::vector<Task> tasks;
  for (const grading::HandIn& file : handedIn.files) {
    Task task{.student = file.student, .exercise = file.exercise};
    task.file = grading::snapshotOf(file, options.out);
    task.sourceSha256 = grading::sha256(grading::gradedText(options.out / task.file));
    task.graderSha256 = graders.of(file.exercise).sha256;
    task.level = level;
    task.seed = options.seed;
    task.secretId = secretId;
    const auto told = times ? times->of(file.student, file.exercise) : std::nullopt;
    task.submitted = told.value_or(file.submitted);
    task.timeFrom = told ? "table" : "file";
    tasks.push_back(std::move(task));
  }
  return tasks;
}

// One task in a process of its own; what goes wrong costs this task alone.
int gradeApart(const Task& task, const Graders::Grader& grader, const grading::TaskOptions& options) {
  try {
    const grading::GradeResult result = grading::gradeTask(task, grader.toolchain, grader.exercise, options);
    return result.outcome == grading::Outcome::graderError ? 1 : 0;
  } catch (const std::exception& error) {
    note(wrap(harmless(fmt::format("{} {}: {}", task.student, task.exercise, error.what())), 2, 0));
    return 1;
  }
}

bool isOpen(const Task& task, const GradeManyOptions& options) {
  if (options.regrade || grading::stateOf(task, options.out) != grading::TaskState::done) return true;
  return options.evidence && !grading::hasEvidence(task, options.out);
}

// Grades those without a valid result; returns how many that were.
int gradeOpen(const std::vector<Task>& tasks, const GradeManyOptions& options,
              const sandbox::Sandbox& sandbox, Graders& graders) {
  std::vector<const Task*> open;
  for (const Task& task : tasks)
    if (isOpen(task, options)) open.push_back(&task);
  const int count = static_cast<int>(open.size()),
            jobs = options.jobs > 0 ? options.jobs
                                    : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const grading::PrivateFolder work(fs::temp_directory_path());
  std::atomic<int> ended = 0;
  const ProgressLine line([&] {
    return fmt::format("graded {} of {}, {} kept", ended.load(), count, tasks.size() - open.size());
  });
  grading::runInCopies(
      count, jobs,
      [&](int k) {
        const Task& task = *open[static_cast<std::size_t>(k)];
        return gradeApart(task, graders.of(task.exercise),
                          {.out = options.out,
                           .workFolder = work.path() / fmt::format("{}", k),
                           .launcher = sandbox.launcher,
                           .secret = options.secret,
                           .evidence = options.evidence,
                           .workers = options.workers,
                           .anew = options.regrade});
      },
      [&](int k, int) {
        std::error_code ignored;
        fs::remove_all(work.path() / fmt::format("{}", k), ignored);
        ++ended;
      });
  return count;
}

void tellTimes(const std::vector<Task>& tasks, const GradeManyOptions& options) {
  if (options.deadlines.empty()) return;
  const auto told =
      std::count_if(tasks.begin(), tasks.end(), [](const Task& task) { return task.timeFrom == "table"; });
  note(fmt::format("Times of submission: {} from {}, {} from when files were modified", told,
                   options.submitted.empty() ? "a table" : shown(options.submitted),
                   static_cast<std::ptrdiff_t>(tasks.size()) - told));
}

}  // namespace

ExitCode gradeMany(const Project& project, const GradeManyOptions& options) {
  requireApart(options);
  const std::vector<grading::ReportFormat> reports = reportsOf(options.reports);
  const grading::LatePolicy policy = readDeadlines(project, options.deadlines);
  const auto sandbox = chooseForStrangers(project, options.level, options.accept);
  if (!sandbox) return ExitCode::kWeakSandbox;
  const std::vector<ExerciseInfo> exercises = project.exercises();
  const grading::HandIns handedIn = grading::readHandIns(options.folder, exercises, options.only);
  tell(handedIn);
  makeFolder(options.out);
  Graders graders(project);
  const std::vector<Task> tasks = tasksOf(handedIn, options, sandbox->level, exercises, graders);
  const fs::path manifest = options.manifest.empty() ? options.out / "tasks.tsv" : options.manifest;
  grading::replaceTextFile(manifest, grading::toManifest(tasks), "the list of tasks");
  const ExitCode taken = handedIn.complaints.empty() ? ExitCode::kFull : ExitCode::kNotGradable;
  if (!options.manifest.empty()) {
    say(fmt::format("{} tasks: {}", tasks.size(), shown(manifest)));
    return taken;
  }
  const int graded = gradeOpen(tasks, options, *sandbox, graders);
  tellTimes(tasks, options);
  writeReports(tasks, options.out, reports);
  const bool complete = writeGrades(tasks, options.out, policy, options.csv);
  note(
      fmt::format("{} submission{} at sandbox level {}: {} graded, {} kept, {} could not be taken. Table: {}",
                  tasks.size(), tasks.size() == 1 ? "" : "s", sandbox->level, graded,
                  static_cast<int>(tasks.size()) - graded, handedIn.complaints.size(),
                  shown(options.out / "grades.csv")));
  return complete ? taken : ExitCode::kGraderFault;
}

}  // namespace rex::cli
