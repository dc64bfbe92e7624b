#include <algorithm>
#include <atomic>
#include <cstdio>
#include <deque>
#include <memory>
#include <thread>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/json_internal.h"
#include "cli/progress_line.h"
#include "cli/sandbox_choice.h"
#include "cli/terminal.h"
#include "cli/test_run.h"
#include "grading/process_pool.h"
#include "grading/result_file.h"
#include "grading/text_file.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;
using grading::GradeResult;
using grading::Submission;

// Each once, in the order asked for.
std::vector<ExerciseInfo> exercisesOf(const Project& project, const TestManyOptions& options) {
  if (options.all) return project.exercises();
  std::vector<ExerciseInfo> chosen;
  for (const std::string& name : options.exercises) {
    ExerciseInfo exercise = project.exercise(name);
    const auto isThis = [&](const ExerciseInfo& other) { return other.name == exercise.name; };
    if (std::none_of(chosen.begin(), chosen.end(), isThis)) chosen.push_back(std::move(exercise));
  }
  return chosen;
}

void requireOptionsOfMany(const TestOptions& options) {
  for (const auto& [name, isGiven] :
       {std::pair{"--main", !options.main.empty()}, {"--check", !options.checks.empty()}})
    if (isGiven)
      throw UsageError({.what = name, .found = "several exercises", .wanted = "one, which it belongs to"});
}

fs::path sourceIn(const TestRun& run) { return run.folder() / "graded.cpp"; }

// In a process of its own. What goes wrong costs this exercise alone, and leaves no graded.cpp.
int gradeApart(const TestRun& run, const sandbox::Sandbox& sandbox) {
  try {
    grading::writeTextFile(sourceIn(run), run.grade(sandbox).source);
    return 0;
  } catch (const std::exception& error) {
    note(wrap(harmless(fmt::format("rex: {}: {}", run.exercise().name, error.what())), 2, 0));
    return 1;
  }
}

// What the process left; a fault of the grader if it did not come to its end.
Submission collect(const TestRun& run, int code) {
  if (code == 0) return {grading::loadResult(run.ownResults()), grading::readTextFile(sourceIn(run))};
  GradeResult broken;
  broken.exerciseId = run.exercise().name;
  broken.maxScore = run.exercise().points();
  broken.message = "grading this exercise ended early";
  grading::saveResult(broken, run.ownResults());
  return {broken, ""};
}

/// The exercises and what came out of those that have ended.
class TestMany {
 public:
  TestMany(const Project& project, const std::vector<ExerciseInfo>& exercises, const TestManyOptions& options)
      : project_(project), asJson_(options.each.json), graded_(exercises.size()) {
    for (const ExerciseInfo& exercise : exercises) {
      TestOptions own = options.each;
      own.exercise = exercise.name;
      if (!own.out.empty()) own.out /= exercise.name;
      runs_.emplace_back(project, exercise, own);
    }
  }

  void grade(const sandbox::Sandbox& sandbox, int jobs) {
    ProgressLine line([this] { return stage(); });
    grading::runInCopies(
        static_cast<int>(runs_.size()), jobs,
        [&](int k) { return gradeApart(runs_[static_cast<std::size_t>(k)], sandbox); },
        [&](int k, int code) {
          take(static_cast<std::size_t>(k), code);
          if (!asJson_) line.stepAside([this] { printThoseReady(); });
        });
  }

  void printSummary() const {
    int full = 0, refused = 0, faults = 0, points = 0, maxPoints = 0;
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      const GradeResult& result = graded_[k]->result;
      const ExitCode code = exitCodeOf(result);
      full += code == ExitCode::kFull;
      refused += code == ExitCode::kNotGradable;
      faults += code == ExitCode::kGraderFault;
      points += result.score;
      maxPoints += result.maxScore > 0 ? result.maxScore : runs_[k].exercise().points();
    }
    std::string line =
        fmt::format("{} of {} exercises in full, {} of {} points", full, runs_.size(), points, maxPoints);
    if (refused > 0) line += fmt::format("; {} cannot be graded", refused);
    if (faults > 0) line += fmt::format("; {} met a fault of the grader", faults);
    say(paint(full == static_cast<int>(runs_.size()) ? Colour::kGreen : Colour::kBold, line));
  }

  void printJson() const {
    Json results = Json::array();
    for (const TestRun& run : runs_) results.push_back(Json::parse(grading::readTextFile(run.ownResults())));
    say(Json{{"schema", "rex-results/1"}, {"results", results}}.dump(2));
  }

  // The codes of one exercise grow as things get worse.
  ExitCode worst() const {
    ExitCode code = ExitCode::kFull;
    for (const auto& graded : graded_) code = std::max(code, exitCodeOf(graded->result));
    return code;
  }

 private:
  void take(std::size_t k, int code) {
    graded_[k] = collect(runs_[k], code);
    runs_[k].publish(project_, graded_[k]->result);
    ++ended_;
  }

  // Those that all before them let through.
  void printThoseReady() {
    for (std::size_t k = printed_; k < runs_.size() && graded_[k]; printed_ = ++k) {
      runs_[k].print(*graded_[k]);
      say();
      std::fflush(stdout);
    }
  }

  // Called from a thread of its own.
  std::string stage() const {
    const std::size_t next = printed_;
    return fmt::format("{} of {} graded; {}", ended_.load(), runs_.size(),
                       next < runs_.size() ? runs_[next].stage() : "");
  }

  const Project& project_;
  bool asJson_;
  std::deque<TestRun> runs_;  // a private folder stays where it is
  std::vector<std::optional<Submission>> graded_;
  std::atomic<std::size_t> ended_ = 0, printed_ = 0;
};

}  // namespace

ExitCode testMany(const Project& project, const TestManyOptions& options) {
  if (!options.all && options.exercises.size() == 1) {
    TestOptions one = options.each;
    one.exercise = options.exercises.front();
    return test(project, one);
  }
  requireOptionsOfMany(options.each);
  const std::vector<ExerciseInfo> exercises = exercisesOf(project, options);
  const std::optional<sandbox::Sandbox> sandbox = chooseSandbox(project, options.each.level);
  if (!sandbox) return ExitCode::kWeakSandbox;
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  TestMany many(project, exercises, options);
  many.grade(*sandbox, options.jobs > 0 ? options.jobs : processors);
  if (options.each.json)
    many.printJson();
  else
    many.printSummary();
  return many.worst();
}

}  // namespace rex::cli
