#include <algorithm>
#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "base/folders.h"
#include "base/process_pool.h"
#include "classroom/grade_task.h"
#include "classroom/submission_folder.h"
#include "cli/build_on_demand.h"
#include "cli/command_table.h"
#include "cli/instructor/class_grades.h"
#include "cli/instructor/class_work.h"
#include "cli/instructor/collect.h"
#include "cli/instructor/forget.h"
#include "cli/instructor/grading_options_internal.h"
#include "cli/json_internal.h"
#include "cli/option_table_internal.h"
#include "cli/report_format.h"
#include "cli/sandbox_choice.h"
#include "cli/terminal.h"
#include "sandbox/probes.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

using classroom::Task;

// A sandbox for work of strangers: the given level, else the best that holds here. A level that is too weak
// for strangers must be accepted by its number. Empty if there is none. Says why, and what a weak one does
// not stop.
std::optional<sandbox::Sandbox> chooseForStrangers(const Project& project,
                                                   std::optional<sandbox::Level> level,
                                                   std::optional<sandbox::Level> accepted) {
  if (!level) {
    const PrivateFolder folder(std::filesystem::temp_directory_path());
    const auto best = sandbox::bestLevel(launcherPath(project), probePath(project), folder.path());
    level = best.level;
    for (const std::string& reason : best.reasons)
      if (!isForStrangers(best.level)) note(wrap(escapeForTerminal(reason), 2, 0));
  }
  if (accepted ? *level < *accepted : !isForStrangers(*level)) {
    note(wrap(fmt::format("sandbox level {} is not for work of strangers: {}; to grade anyway, use "
                          "--i-accept-level {}",
                          numberOf(*level), sandbox::levelWarning(*level), numberOf(*level)),
              2, 0));
    return {};
  }
  const std::optional<sandbox::Sandbox> chosen = chooseSandbox(project, level);
  if (chosen && !isForStrangers(*level))
    note(wrap(fmt::format("sandbox level {}: {}", numberOf(*level), sandbox::levelWarning(*level)), 2, 0));
  return chosen;
}

void requireFolders(const GradeManyOptions& options) {
  requireFolder(options.folder, "a folder of submissions");
  requireApart("--out", options.out, options.folder);
  if (!options.manifest.empty()) classroom::requireNameOfResults(options.manifest, options.out);
  if (!options.similar.empty()) {
    requireApart("--similar", options.similar, options.folder);
    requireApart("--similar", options.similar, options.out);
  }
  if (options.workers.empty()) return;
  requireApart("--workers", options.workers, options.folder);
  requireApart("--workers", options.workers, options.out);
}

// A report that was asked for once is kept up to date.
std::vector<reports::ReportFormat> formatsOf(const std::string& asked, const classroom::ClassRun& run) {
  std::vector<reports::ReportFormat> formats = parseReportFormats(asked);
  for (const reports::ReportFormat& format : reports::reportFormats()) {
    const bool isAsked =
        std::any_of(formats.begin(), formats.end(), [&](const auto& one) { return one.file == format.file; });
    if (!isAsked && std::any_of(run.tasks.begin(), run.tasks.end(), [&](const Task& task) {
          return fs::exists(classroom::resultFolder(run.out, task) / format.file);
        }))
      formats.push_back(format);
  }
  return formats;
}

// Grades one task in its own process, so that a failure affects this task alone.
int gradeApart(const Task& task, const classroom::StoredResult& stored, const Graders::Grader& grader,
               const classroom::TaskOptions& options) {
  try {
    const grading::GradeResult result =
        classroom::gradeTask(task, stored, grader.toolchain, grader.exercise, options);
    return result.outcome == grading::Outcome::kGraderError ? 1 : 0;
  } catch (const std::exception& error) {
    note(wrap(escapeForTerminal(fmt::format("{} {}: {}", task.student, task.exercise, error.what())), 2, 0));
    return 1;
  }
}

// With settings of their own, which last until somebody asks to regrade the class.
bool isAlone(const classroom::StoredResult& stored, const GradeManyOptions& options) {
  return !options.student.empty() || (!options.regrade && stored.with && stored.with->alone);
}

bool isOpen(const Task& task, const classroom::StoredResult& stored, const GradeManyOptions& options) {
  if (!options.student.empty() && !options.chosen.contains({task.student, task.exercise})) return false;
  return options.regrade || !stored.isDone() || (options.evidence && !stored.hasEvidence);
}

void tellRefused(const classroom::ClassRun& run) {
  using classroom::TaskState;
  for (const classroom::StoredResult& one : run.stored)
    if ((one.state == TaskState::kDone || one.state == TaskState::kRefused) && !one.why.empty())
      note(wrap(escapeForTerminal(one.why) + "; it is graded again", 2, 0));
}

// Grades those tasks, and reads what is stored for them then. Nobody's hidden checks run beside visible ones:
// what a program learns in a hidden check, it may find a way to tell another.
void gradeOpen(const std::vector<std::size_t>& open, classroom::ClassRun& run,
               const GradeManyOptions& options, const sandbox::Sandbox& sandbox, Graders& graders) {
  const int count = static_cast<int>(open.size()),
            jobs = options.jobs > 0 ? options.jobs
                                    : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const PrivateFolder work(fs::temp_directory_path());
  std::atomic<int> begun = 0, ended = 0;
  const ProgressLine line([&] {
    return fmt::format("visible checks of {0}, hidden checks of {1} of {2} graded, {3} kept", begun.load(),
                       ended.load(), count, run.tasks.size() - open.size());
  });
  const auto gradeAll = [&](grading::Pass pass) {
    const bool isFirst = pass == grading::Pass::kVisible;
    const auto gradeOne = [&](int k) {
      const Task& task = run.tasks[open[static_cast<std::size_t>(k)]];
      const classroom::StoredResult& stored = run.stored[open[static_cast<std::size_t>(k)]];
      if (!isFirst && !classroom::readFirstPass(task, run.out, run.secret)) return 0;
      return gradeApart(task, stored, graders.of(task.exercise),
                        {.out = options.out,
                         .workFolder = work.path() / fmt::format("{}", k),
                         .launcher = sandbox.launcher,
                         .secret = options.secret,
                         .evidence = options.evidence,
                         .alone = isAlone(stored, options),
                         .workers = options.workers,
                         .accept = options.acceptFewer,
                         .recompile = isFirst && options.regrade && stored.isDone(),
                         .pass = pass});
    };
    const auto end = [&](int k, int code) {
      const Task& task = run.tasks[open[static_cast<std::size_t>(k)]];
      if (code < 0)
        note(wrap(escapeForTerminal(fmt::format("{} {}: the grading was ended by signal {}: grade it again",
                                                task.student, task.exercise, -code)),
                  2, 0));
      std::error_code ignored;
      if (!classroom::readFirstPass(task, run.out, run.secret))
        fs::remove_all(work.path() / fmt::format("{}", k), ignored);
      ++(isFirst ? begun : ended);
    };
    forkMap(count, jobs, gradeOne, end, kSecondsOfTask);
  };
  gradeAll(grading::Pass::kVisible);
  gradeAll(grading::Pass::kHidden);
  for (const std::size_t k : open) run.readAgain(k);
}

void tellTimes(const std::vector<Task>& tasks, const GradeManyOptions& options) {
  if (options.files.deadlines.empty() && options.files.course.empty()) return;
  const auto from = [&](const char* source) {
    return std::count_if(tasks.begin(), tasks.end(),
                         [&](const Task& task) { return task.timeFrom == source; });
  };
  std::string text = fmt::format("Times of submission: {} from {}", from("table"),
                                 options.submitted.empty() ? "a table" : shown(options.submitted));
  if (from("platform") > 0) text += fmt::format(", {} from the platform", from("platform"));
  if (from("git") > 0) text += fmt::format(", {} from commits, which students can date", from("git"));
  note(text + fmt::format(", {} from modification times of files", from("file")));
}

void takeSettings(const classroom::GradingSettings& settings, GradeManyOptions& options) {
  if (options.secret.empty()) options.secret = settings.secret;
  if (!options.seed) options.seed = settings.seed;
  if (!options.level && settings.level) options.level = sandbox::parseLevel(*settings.level);
  if (options.reports.empty()) options.reports = settings.reports;
  options.evidence = options.evidence || settings.evidence;
}

ExitCode sayTasks(const ClassWork& work, const fs::path& manifest, const GradeManyOptions& options) {
  if (options.json)
    say(dump(Json{
        {"tasks", work.run.tasks.size()}, {"manifest", manifest.string()}, {"not_taken", work.notTaken}}));
  else
    say(fmt::format("{} tasks: {}", work.run.tasks.size(), shown(manifest)));
  return work.taken;
}

// Grades the submissions of many students: reads, decides, grades, writes. kFull whatever the grades are;
// kNotGradable if a submission could not be taken, kGraderFault if something must be graded again.
ExitCode gradeClass(const Project& project, const classroom::Course& course, GradeManyOptions options) {
  requireFolders(options);
  static_cast<void>(parseReportFormats(options.reports));  // refuses a misspelt one before it grades
  const classroom::LatePolicy policy = readDeadlines(project, options.files.deadlines);
  const auto sandbox = chooseForStrangers(project, options.level, options.accept);
  if (!sandbox) return ExitCode::kWeakSandbox;

  Graders graders(project);
  const fs::path manifest = options.manifest.empty() ? options.out / "tasks.tsv" : options.manifest;
  ClassWork work = readClassWork(project, course, sandbox->level, graders, manifest, options);
  classroom::ClassRun& run = work.run;
  if (!options.manifest.empty()) return sayTasks(work, manifest, options);
  // What could be wrong with roster, dates and adjustments is said before the first grading.
  const classroom::GradebookSource source = readGradebookSource(project, options.files, run, work.only);
  const std::vector<reports::ReportFormat> reports = formatsOf(options.reports, run);

  removeLeftovers(options.out, 3);
  tellRefused(run);
  const auto isOpenHere = [&](std::size_t k) { return isOpen(run.tasks[k], run.stored[k], options); };
  const Regrading regrading(run, isOpenHere, options.acceptFewer);
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < run.tasks.size(); ++k)
    if (isOpenHere(k)) open.push_back(k);

  gradeOpen(open, run, options, *sandbox, graders);

  const int count = static_cast<int>(run.tasks.size()), graded = static_cast<int>(open.size());
  regrading.tell();
  tellTimes(run.tasks, options);
  const classroom::Gradebook book = classroom::makeGradebook(run, source);
  writeReports(run, reports, book);
  const bool complete = writeGrades(run, policy, options.files.hasBook() ? &book : nullptr, options.csv);
  if (!options.similar.empty())
    writeSimilar(project, course, run.tasks, options.out, options.similar, options.similarPercent);
  const int held = tellHeldBack(run);
  if (options.json)
    say(gradingJson(run, {.level = numberOf(sandbox->level),
                          .graded = graded,
                          .rejected = work.notTaken,
                          .blocked = {work.blocked.begin(), work.blocked.end()}}));
  note(
      fmt::format("{} submission{} at sandbox level {}: {} graded, {} kept, {} could not be taken. Table: {}",
                  count, count == 1 ? "" : "s", numberOf(sandbox->level), graded, count - graded,
                  work.rejected, shown(options.out / "grades.csv")));
  if (!complete || work.taken == ExitCode::kGraderFault) return ExitCode::kGraderFault;
  if (held > 0) return ExitCode::kBelow;
  return book.conflicts > 0 ? ExitCode::kNotGradable : work.taken;
}

// What the options ask for: to grade, or one of the things that need only the folder of results.
ExitCode gradeMany(const Project& project, GradeManyOptions options) {
  const classroom::Course course = readClassCourse(project, options.files);
  takeSettings(course.settings, options);
  if (options.out.empty()) options.out = course.results;
  if (options.out.empty())
    throw UsageError(
        {.what = "--out", .found = "no folder", .wanted = "one for the results, here or in the course file"});
  if (options.forgets())
    return forgetPeople(project, {.handedIn = options.folder,
                                  .out = options.out,
                                  .similar = options.similar,
                                  .files = options.files,
                                  .student = options.forget,
                                  .before = options.forgetBefore,
                                  .removes = options.acceptFewer});
  if (!options.explain.empty())
    return explainResults(project, {.out = options.out,
                                    .manifest = options.manifest,
                                    .files = options.files,
                                    .student = options.explain[0],
                                    .exercise = options.explain[1],
                                    .json = options.json});
  if (options.complaints) return listComplaints(project, options.out, options.files);
  if (options.task > 0)
    return gradeOne(project, {.manifest = options.manifest,
                              .task = options.task,
                              .chunk = options.chunk,
                              .visible = options.visible,
                              .out = options.out,
                              .secret = options.secret,
                              .evidence = options.evidence,
                              .accept = options.acceptFewer,
                              .workers = options.workers});
  if (options.collect)
    return collectResults(project, {.out = options.out,
                                    .manifest = options.manifest,
                                    .files = options.files,
                                    .csv = options.csv,
                                    .json = options.json,
                                    .reports = options.reports});
  return gradeClass(project, course, std::move(options));
}

}  // namespace

void addGrade(CLI::App* command, Action& action) {
  const auto options = std::make_shared<GradeManyOptions>();
  command->footer(
      "Examples:\n  scripts/rex grade handed-in -o results -j8\n"
      "  scripts/rex grade handed-in 01 -o results --deadlines deadlines.toml --csv\n"
      "  scripts/rex grade handed-in --course course.toml -o results\n"
      "  scripts/rex grade handed-in -o results --report=markdown,junit --evidence\n"
      "  scripts/rex grade handed-in -o results --similar similar\n"
      "  scripts/rex grade handed-in -o results --manifest tasks.tsv\n"
      "  scripts/rex grade --manifest tasks.tsv --task 7 -o results\n"
      "  scripts/rex grade --collect -o results --course course.toml\n"
      "  scripts/rex grade --explain zoe 01 --course course.toml -o results\n"
      "  scripts/rex grade handed-in --forget zoe --course course.toml -o results\n\n"
      "DIR holds STUDENT/EXERCISE/main.cpp. A second run grades only what has changed.\n" +
      std::string(kGradingCodes));
  command->add_option("DIR", options->folder, "folder of submissions")->type_name("");
  command->add_option("EXERCISE", options->only, "only this exercise (default: all)")->type_name("");
  addResults(command, options->out);
  addOptions(command,
             {{"-j,--jobs", options->jobs, {0, 1024}, "N", "parallel gradings, 0: one per processor"},
              {"--level", options->level, {0, 3}, "N", "sandbox level (default: the best that holds here)"},
              {"--i-accept-level", options->accept, {0, 1}, "N", "also grade at this weak level: 0 or 1"},
              seedRow(options->seed, "seed of the random cases")});
  addSecret(command, options->secret);
  addClassFiles(command, options->files);
  addOptions(
      command,
      {{"--workers", options->workers, "DIR",
        "keep compiled programs here, so that other seeds need no new compilation"},
       {"--submitted", options->submitted, "FILE.csv",
        "times of submission: columns student, submitted, exercise (default: times of the files)"},
       {"--student", options->student, "ID", "only grade this one, also with another --seed"},
       {"--regrade", options->regrade, "also grade what has a valid result, or was graded otherwise"},
       {"--accept", options->acceptFewer,
        "also take results in which the same file has fewer points than before; with --forget: remove"},
       {"--evidence", options->evidence, "keep pictures and replays of failed visible checks"}});
  addReport(command, options->reports);
  const auto shown = addOptions(
      command,
      {{"--csv", options->csv, "print the table of grades"},
       {"--json", options->json, "print what was done as JSON"},
       {"--similar", options->similar, "DIR", "show submissions that are nearly the same in this folder"},
       {"--similar-percent", options->similarPercent, {1, 100}, "N", "how much they must have in common"}});
  shown[1]->excludes(shown[0])->excludes(shown[2]);
  shown[3]->needs(shown[2]);
  const auto parts = addOptions(
      command,
      {{"--manifest", options->manifest, "FILE.tsv", "only write the list of tasks, without grading"},
       {"--task", options->task, {1, 1e9}, "K", "only grade line K of the --manifest, unless it is done"},
       {"--chunk", options->chunk, {1, 9999}, "N", "--task counts chunks of N lines"},
       {"--visible", options->visible,
        "with --task: only visible checks; the same command without it grades the hidden ones"},
       {"--collect", options->collect,
        "only make the tables from the results (--manifest: of these tasks), and name what is missing"}},
      "For clusters");
  parts[1]->needs(parts[0])->excludes(parts[4]);
  for (const int only : {2, 3}) parts[static_cast<std::size_t>(only)]->needs(parts[1]);
  const auto forget = addOptions(
      command,
      {{"--forget", options->forget, "ID", "list what is kept about this student; with --accept, remove it"},
       {"--forget-before", options->forgetBefore, "DATE",
        "the same for all that was handed in before this day"}},
      "What is kept about people");
  forget[0]->excludes(forget[1])->excludes(shown[1]);
  forget[1]->excludes(shown[1]);
  for (CLI::Option* part : parts) part->excludes(forget[0])->excludes(forget[1]);
  addExplain(command, options->explain);
  addOptions(command, {{"--complaints", options->complaints,
                        "only list the complaints without an answer, each with how its grade came about"}})
      .front()
      ->excludes(shown[1]);
  command->callback([&action, options] {
    const bool needsNone =
        !options->explain.empty() || options->task > 0 || options->collect || options->complaints;
    if (options->folder.empty() && !needsNone && !options->forgets()) throw CLI::RequiredError("DIR");
    if (!options->folder.empty() && needsNone)
      throw UsageError({.what = "DIR has no effect with --task, --collect, --explain and --complaints"});
    action = [options](const Project& p) { return gradeMany(p, *options); };
  });
}

}  // namespace rex::cli
