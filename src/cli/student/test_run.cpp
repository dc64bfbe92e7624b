#include "cli/student/test_run.h"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text_file.h"
#include "cli/out_folder.h"
#include "cli/report_format.h"
#include "cli/sandbox_choice.h"
#include "cli/student/progress.h"
#include "cli/student/student_file.h"
#include "cli/terminal.h"
#include "grading/hidden_seed.h"
#include "grading/results.h"

namespace rex::cli {

namespace fs = std::filesystem;
using grading::GradeResult;
using grading::Outcome;

namespace {

// Results of some checks or a debug run do not overwrite those of a complete grading.
const char* resultName(const TestOptions& options) {
  if (options.debug) return "results-debug.json";
  return options.job.checks.empty() ? "results.json" : "results-partial.json";
}

fs::path resultsOf(const Project& project, const ExerciseInfo& exercise, const TestOptions& options) {
  const fs::path out =
      fs::absolute(options.out.empty() ? project.outFolder(exercise, options.solution) : options.out);
  makeOutFolder(out);
  return out / resultName(options);
}

// An unreadable file tells nothing, and is replaced.
std::optional<GradeResult> lastResult(const fs::path& file) {
  if (!fs::exists(file)) return {};
  try {
    return grading::loadResult(file);
  } catch (const Error&) {
    return {};
  }
}

// With the checks of a part instead of its name, and those that blamed a function in the last test.
std::vector<std::string> withParts(const std::vector<std::string>& names, const ExerciseInfo& exercise,
                                   const submission::Toolchain& toolchain, const fs::path& lastTest) {
  std::vector<std::string> checks;
  const auto takeAll = [&](const std::vector<grading::CheckResult>& all,
                           std::string grading::CheckResult::*field, const std::string& name) {
    const std::size_t before = checks.size();
    for (const grading::CheckResult& check : all)
      if (check.*field == name) checks.push_back(check.id);
    return checks.size() > before;
  };
  for (const std::string& name : names) {
    const auto isNamed = [&](const submission::ExercisePart& part) { return part.id == name; };
    if (std::any_of(exercise.parts.begin(), exercise.parts.end(), isNamed)) {
      takeAll(submission::listChecks(toolchain), &grading::CheckResult::part, name);
      continue;
    }
    const auto last = lastResult(lastTest);
    if (!last || !takeAll(last->checks, &grading::CheckResult::function, name)) checks.push_back(name);
  }
  return checks;
}

// Returns the text about it. Without gnuplot there is no curve, and the text stays.
std::string drawn(const std::string& name, const Attempts& attempts, const fs::path& picture) {
  const std::string text = recordText(name, attempts);
  if (attempts.values.size() < 2) return text;
  try {
    writeFigure(recordFigure(name, attempts), picture.string());
    return fmt::format("{}: {}", text, shown(picture));
  } catch (const Error& error) {
    note(wrap(fmt::format("rex: no curve of records: {}", error.what()), 2, 0));
    return text;
  }
}

std::vector<std::string> drawRecords(const GradeResult& result, const Records& records,
                                     const fs::path& folder) {
  std::vector<std::string> texts;
  for (const grading::CheckResult& check : result.checks)
    if (check.record && records.contains(check.record->name))
      texts.push_back(drawn(check.record->name, records.at(check.record->name),
                            folder / fmt::format("record-{}.png", check.id)));
  return texts;
}

Published remember(const Project& project, const ExerciseInfo& exercise, const GradeResult& result,
                   const TestOptions& options, const fs::path& folder) {
  if (result.outcome == Outcome::kGraderError) return {};
  const bool isWhole = options.job.checks.empty(),
             hasUsualCases = options.job.seed == grading::GradingJob().seed;
  const ProgressFile file(project.root);
  const AllProgress all = file.read();
  const bool isFirst =
      std::ranges::all_of(all.exercises, [](const auto& one) { return one.second.work.lastSave == 0; });
  Records records;
  const bool isKept = file.change(exercise.name, [&](Progress& progress) {
    addTest(progress.work, result, isWhole, std::time(nullptr));
    if (hasUsualCases) {  // values of others cannot be compared
      addRecords(progress.records, result);
      records = progress.records;
    }
    if (!isWhole) return;
    progress.tested = true;
    progress.points = result.score;
    progress.maxPoints = result.maxScore;
    progress.solved = progress.solved || result.outcome == Outcome::kPass;
    progress.fileSha256 = result.snapshotSha256;
  });
  return {.isFirstWork = isFirst && isKept, .records = drawRecords(result, records, folder)};
}

}  // namespace

std::string stageText(const GradeResult& soFar, const CheckOrder& order) {
  constexpr std::size_t kMostTold = 3;
  std::vector<const grading::CheckResult*> checks;  // as they are run
  for (const grading::CheckResult& check : soFar.checks) checks.push_back(&check);
  const auto place = [&](const grading::CheckResult* check) {
    return std::find(order.ids.begin(), order.ids.end(), check->id) - order.ids.begin();
  };
  std::stable_sort(checks.begin(), checks.end(), [&](auto* a, auto* b) { return place(a) < place(b); });
  std::string told;
  for (std::size_t k = 0; k < std::min({order.changed, checks.size(), kMostTold}); ++k)
    if (checks[k]->status)
      told += fmt::format("{} {}, ", checks[k]->id, *checks[k]->status == Outcome::kPass ? "ok" : "FAIL");
  const auto isOpen = [](const grading::CheckResult* check) { return !check->status; };
  const auto open = std::find_if(checks.begin(), checks.end(), isOpen);
  if (open == checks.end()) return told + "looking again";
  return fmt::format("{}check {} of {}, {}", told, open - checks.begin() + 1, checks.size(),
                     escapeForTerminal((*open)->title));
}

TestRun::TestRun(const Project& project, ExerciseInfo exercise, const TestOptions& options)
    : exercise_(std::move(exercise)),
      options_(options),
      file_(chooseStudentFile(exercise_, options.solution, options.main)),
      results_(resultsOf(project, exercise_, options)),
      before_(options.main.empty() ? lastResult(results_) : std::nullopt),
      toolchain_(prepare(project, exercise_)),
      work_(project.workPlace("exercises/" + exercise_.name)),
      reports_(parseReportFormats(options.reports)) {
  options_.job.checks = withParts(options.job.checks, exercise_, toolchain_,
                                  project.outFolder(exercise_, false) / "results.json");
  if (options.job.checks.empty() && before_ && !options.saved.before.empty() && !options.saved.now.empty()) {
    SavedFile saved = options.saved;
    saved.last = before_->checks;
    order_ = checkOrder(submission::listChecks(toolchain_), saved);
  }
  if (options.job.secret.empty()) return;
  static_cast<void>(grading::readCourseSecret(options.job.secret));
  if (const std::string warning = grading::openSecretWarning(options.job.secret); !warning.empty())
    note(wrap(escapeForTerminal(warning), 2, 0));
}

submission::Submission TestRun::grade(const sandbox::Sandbox& sandbox, int processors) const {
  grading::GradingJob job = options_.job;
  if (!order_.ids.empty()) job.checks = order_.ids;
  job.results = ownResults();
  job.evidence = work_.path() / "checks";
  job.sandbox = sandbox;
  job.jobs = processors;
  return submission::gradeSubmission(
      toolchain_, exercise_,
      {.main = file_, .workFolder = work_.path(), .job = job, .lookAgain = true, .sanitize = options_.debug});
}

std::string TestRun::stage() const {
  const std::string name = exercise_.name + ": ";
  try {
    return name + stageText(grading::loadResult(ownResults()), order_);
  } catch (const std::exception&) {
    return name + "compiling";
  }
}

Published TestRun::publish(const Project& project, const GradeResult& result) const {
  const fs::path out = results_.parent_path(), log = work_.path() / "build.log",
                 evidence = work_.path() / "checks";
  replaceTextFile(results_, readTextFile(ownResults()), "the result file");
  if (fs::exists(log)) replaceTextFile(out / "build.log", readTextFile(log), "the log");
  for (const reports::ReportFormat& format : reports::reportFormats())
    if (contains(reports_, format) || fs::exists(out / format.file))
      replaceTextFile(out / format.file, format.write(result), "the report");
  fs::remove_all(out / "checks");
  if (fs::exists(evidence)) fs::copy(evidence, out / "checks", fs::copy_options::recursive);
  if (!options_.main.empty() || options_.solution || options_.debug) return {};
  return remember(project, exercise_, result, options_, out);
}

std::string aboutWork() {
  return wrap(
      "From now on, rex notes in .rex/progress.json how long you work on each exercise, and when its parts "
      "first pass. That stays on this machine unless you hand it in with rex submit --progress.",
      0, 0);
}

void TestRun::print(const submission::Submission& graded, const Published& published) const {
  const bool isWhole = options_.job.checks.empty();
  printResult(exercise_, graded, results_, file_,
              {.isWhole = isWhole,
               .inFull = options_.inFull || !isWhole || !before_ || before_->checks.empty(),
               .before = before_,
               .records = published.records});
  if (options_.main.empty() && !fs::exists(file_))
    say(fmt::format("To restore it as it was handed out: scripts/rex reset {}", exercise_.name));
}

ExitCode toExitCode(const GradeResult& result) {
  if (result.outcome == Outcome::kGraderError) return ExitCode::kGraderFault;
  if (result.outcome == Outcome::kCompileError) return ExitCode::kNotGradable;
  return result.outcome == Outcome::kPass ? ExitCode::kFull : ExitCode::kBelow;
}

ExitCode testOne(const Project& project, const TestOptions& options) {
  ExerciseInfo exercise = project.exercise(options.exercise);
  const std::optional<sandbox::Sandbox> sandbox = chooseSandbox(project, options.level);
  if (!sandbox) return ExitCode::kWeakSandbox;
  const TestRun run(project, std::move(exercise), options);
  // A sandbox has one work folder for all tools.
  const int processors =
      isConfined(sandbox->level) ? 1 : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const submission::Submission graded = [&] {
    const ProgressLine line([&] { return run.stage(); });
    return run.grade(*sandbox, processors);
  }();
  const Published published = run.publish(project, graded.result);
  if (options.json) {
    std::fputs(readTextFile(run.ownResults()).c_str(), stdout);
  } else {
    run.print(graded, published);
  }
  if (published.isFirstWork) note(aboutWork());
  return toExitCode(graded.result);
}

}  // namespace rex::cli
