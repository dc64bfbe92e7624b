#include <algorithm>
#include <atomic>
#include <cstdio>
#include <deque>
#include <memory>
#include <thread>

#include <fmt/format.h>

#include "base/error.h"
#include "base/process_pool.h"
#include "base/text_file.h"
#include "cli/build_on_demand.h"
#include "cli/json_internal.h"
#include "cli/sandbox_choice.h"
#include "cli/student/test_run.h"
#include "cli/terminal.h"
#include "grading/results.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;
using grading::GradeResult;
using submission::Submission;

void requireOptionsOfMany(const TestOptions& options) {
  for (const auto& [name, isGiven] :
       {std::pair{"--main", !options.main.empty()}, {"--check", !options.job.checks.empty()}})
    if (isGiven)
      throw UsageError({.what = name, .found = "several exercises", .wanted = "only one exercise"});
}

fs::path sourceIn(const TestRun& run) { return run.folder() / "graded.cpp"; }

// Runs in its own process, so that a failure affects this exercise alone and leaves no graded.cpp.
int gradeApart(const TestRun& run, const sandbox::Sandbox& sandbox) {
  try {
    writeTextFile(sourceIn(run), run.grade(sandbox).source);
    return 0;
  } catch (const std::exception& error) {
    note(wrap(escapeForTerminal(fmt::format("rex: {}: {}", run.exercise().name, error.what())), 2, 0));
    return 1;
  }
}

// The files that the process left; a fault of the grader if it did not finish.
Submission collect(const TestRun& run, int code) {
  if (code == 0) return {grading::loadResult(run.ownResults()), readTextFile(sourceIn(run))};
  GradeResult broken;
  broken.exerciseId = run.exercise().name;
  broken.maxScore = run.exercise().points();
  broken.message = "grading this exercise ended early";
  grading::saveResult(broken, run.ownResults());
  return {broken, ""};
}

// The result if the grader does not build.
GradeResult blocked(const ExerciseInfo& exercise) {
  GradeResult result;
  result.exerciseId = exercise.name;
  result.maxScore = exercise.points();
  result.message = "the grader of this exercise does not build";
  return result;
}

/// The exercises, and the results of those that have finished.
class TestMany {
 public:
  TestMany(const Project& project, const std::vector<ExerciseInfo>& exercises, const TestOptions& each)
      : project_(project), asJson_(each.json) {
    for (const ExerciseInfo& exercise : exercises) {
      TestOptions own = each;
      own.exercise = exercise.name;
      if (!own.out.empty()) own.out /= exercise.name;
      try {
        runs_.emplace_back(project, exercise, own);
      } catch (const BuildFailure& failure) {
        note(fmt::format("rex: {}", failure.what()));
        blocked_.push_back(blocked(exercise));
      }
    }
    graded_.resize(runs_.size());
    published_.resize(runs_.size());
  }

  void grade(const sandbox::Sandbox& sandbox, int jobs) {
    ProgressLine line([this] { return stage(); });
    forkMap(
        static_cast<int>(runs_.size()), jobs,
        [&](int k) { return gradeApart(runs_[static_cast<std::size_t>(k)], sandbox); },
        [&](int k, int code) {
          take(static_cast<std::size_t>(k), code);
          if (!asJson_) line.stepAside([this] { printThoseReady(); });
        });
  }

  void printSummary() const {
    int full = 0, refused = 0, faults = 0, points = 0, maxPoints = 0;
    const std::vector<GradeResult> all = results();
    for (const GradeResult& result : all) {
      const ExitCode code = toExitCode(result);
      full += code == ExitCode::kFull;
      refused += code == ExitCode::kNotGradable;
      faults += code == ExitCode::kGraderFault;
      points += result.score;
      maxPoints += result.maxScore;
    }
    std::string line =
        fmt::format("{} of {} exercises in full, {} of {} points", full, all.size(), points, maxPoints);
    if (refused > 0) line += fmt::format("; {} cannot be graded", refused);
    if (faults > 0) line += fmt::format("; {} hit a grader fault", faults);
    if (isFirst_) note(aboutWork());
    say(paint(full == static_cast<int>(all.size()) ? Colour::kGreen : Colour::kBold, line));
  }

  void printJson() const {
    Json list = Json::array();
    for (const TestRun& run : runs_) list.push_back(Json::parse(readTextFile(run.ownResults())));
    for (const GradeResult& result : blocked_) list.push_back(Json::parse(toJson(result)));
    if (isFirst_) note(aboutWork());
    say(Json{{"schema", "rex-results/1"}, {"results", list}}.dump(2));
  }

  // Exit codes grow with severity.
  ExitCode worst() const {
    ExitCode code = ExitCode::kFull;
    for (const GradeResult& result : results()) code = std::max(code, toExitCode(result));
    return code;
  }

 private:
  void take(std::size_t k, int code) {
    graded_[k] = collect(runs_[k], code);
    published_[k] = runs_[k].publish(project_, graded_[k]->result);
    isFirst_ = published_[k].isFirstWork || isFirst_;
    ++ended_;
  }

  // Prints in order: those that are finished and have no unfinished one before them.
  void printThoseReady() {
    for (std::size_t k = printed_; k < runs_.size() && graded_[k]; printed_ = ++k) {
      runs_[k].print(*graded_[k], published_[k]);
      say();
      std::fflush(stdout);
    }
  }

  // Call when all have finished. The result of a file that does not compile has no maximum of points.
  std::vector<GradeResult> results() const {
    std::vector<GradeResult> all = blocked_;
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      all.push_back(graded_[k]->result);
      if (all.back().maxScore <= 0) all.back().maxScore = runs_[k].exercise().points();
    }
    return all;
  }

  // Called from another thread.
  std::string stage() const {
    const std::size_t next = printed_;
    return fmt::format("{} of {} graded; {}", ended_.load(), runs_.size(),
                       next < runs_.size() ? runs_[next].stage() : "");
  }

  const Project& project_;
  bool asJson_;
  bool isFirst_ = false;              // see Published
  std::deque<TestRun> runs_;          // a deque, as a TestRun cannot move its private folder
  std::vector<GradeResult> blocked_;  // of those whose grader does not build
  std::vector<std::optional<Submission>> graded_;
  std::vector<Published> published_;
  std::atomic<std::size_t> ended_ = 0, printed_ = 0;
};

}  // namespace

ExitCode testMany(const Project& project, const std::vector<ExerciseInfo>& exercises, const TestOptions& each,
                  int jobs) {
  requireOptionsOfMany(each);
  const std::optional<sandbox::Sandbox> sandbox = chooseSandbox(project, each.level);
  if (!sandbox) return ExitCode::kWeakSandbox;
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  TestMany many(project, exercises, each);
  many.grade(*sandbox, jobs > 0 ? jobs : processors);
  if (each.json)
    many.printJson();
  else
    many.printSummary();
  return many.worst();
}

}  // namespace rex::cli
