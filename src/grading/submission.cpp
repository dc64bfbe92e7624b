#include "grading/submission.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/process.h"
#include "grading/compiler_messages.h"
#include "grading/result_file.h"
#include "grading/sha256.h"
#include "grading/student_build.h"
#include "grading/text_file_internal.h"

namespace rex::grading {
namespace {

using std::filesystem::path;

constexpr int kUsage = 64;
constexpr double kLongestGrading = 3600;

// Changes whenever the task or its checks do.
std::string exerciseVersion(const path& folder) {
  std::string text;
  for (const char* name : {"exercise.toml", "exercise.h", "check.cpp"})
    if (std::filesystem::exists(folder / name)) text += internal::readTextFile(folder / name) + '\0';
  return sha256(text).substr(0, 12);
}

// What is known before any check runs.
GradeResult startResult(const Toolchain& toolchain, const ExerciseInfo& exercise,
                        const StudentObject& object) {
  GradeResult result;
  result.snapshotSha256 = sha256(object.source);
  result.submissionId = result.snapshotSha256.substr(0, 12);
  result.files = {{object.name, result.snapshotSha256}};
  result.exerciseId = exercise.name;
  result.exerciseVersion = exerciseVersion(exercise.folder);
  result.toolVersion = REX_VERSION;
  result.compiler = path(toolchain.compiler).filename().string();
  result.compile = {object.exitCode, object.messages, object.truncated};
  result.limits.cpuSeconds = exercise.limits.cpuSeconds;
  result.limits.memoryMegabytes = exercise.limits.memoryMb;
  result.limits.outputMegabytes = exercise.limits.outputMb;
  return result;
}

std::vector<std::string> graderCommand(const Toolchain& toolchain, const ExerciseInfo& exercise,
                                       const SubmissionOptions& options, const path& worker) {
  std::vector<std::string> command = {toolchain.grader.string(), "--results", options.results.string()};
  if (!worker.empty()) command.insert(command.end(), {"--worker", worker.string()});
  for (const std::string& check : options.checks) command.insert(command.end(), {"--check", check});
  if (options.seed) command.insert(command.end(), {"--seed", fmt::format("{}", *options.seed)});
  command.insert(command.end(), {"--cpu-seconds", fmt::format("{:g}", exercise.limits.cpuSeconds),
                                 "--memory-mb", fmt::format("{}", exercise.limits.memoryMb), "--output-mb",
                                 fmt::format("{}", exercise.limits.outputMb)});
  return command;
}

// Runs the grader and reads what it wrote; a grader that breaks is our fault and says so in the result.
GradeResult callGrader(const std::vector<std::string>& command, const path& results) {
  const ProcessResult run = runProcess(command, {.timeout = kLongestGrading});
  const std::string said = run.error.substr(0, run.error.find_last_not_of('\n') + 1);
  if (run.exitCode == kUsage) throw Error({.what = said});
  GradeResult result = loadResult(results);
  if (run.exitCode != 0 && run.exitCode != 1) {
    result.outcome = Outcome::graderError;
    if (result.message.empty())
      result.message =
          fmt::format("the grader failed (exit code {}, signal {}): {}", run.exitCode, run.signal, said);
    saveResult(result, results);
  }
  return result;
}

std::string firstError(const std::vector<CompileDiagnostic>& messages) {
  const auto first = std::find_if(messages.begin(), messages.end(), [](const CompileDiagnostic& message) {
    return message.severity == "error";
  });
  return first == messages.end() ? "does not compile" : toString(*first);
}

struct Build {
  GradeResult result;  // so far
  std::string source, log;
  path worker;  // empty: does not compile
};

Build buildWorker(const Toolchain& toolchain, const ExerciseInfo& exercise,
                  const SubmissionOptions& options) {
  const StudentObject object =
      compileStudent(toolchain, exercise.forbidden, {.main = options.main, .workFolder = options.workFolder});
  Build build{startResult(toolchain, exercise, object), object.source, object.log, {}};
  if (object.ok) {
    const StudentProgram linked = linkWorker(toolchain, object);
    if (linked.ok) build.worker = linked.program;
    auto& diagnostics = build.result.compile.diagnostics;
    diagnostics.insert(diagnostics.end(), linked.messages.begin(), linked.messages.end());
    build.log += linked.log;
  }
  if (build.worker.empty()) {
    build.result.outcome = Outcome::compileError;
    build.result.message = firstError(build.result.compile.diagnostics);
  }
  return build;
}

}  // namespace

Submission gradeSubmission(const Toolchain& toolchain, const ExerciseInfo& exercise,
                           const SubmissionOptions& options) {
  Build build;
  try {
    build = buildWorker(toolchain, exercise, options);
  } catch (const Error& error) {
    build.result = startResult(toolchain, exercise, {});
    build.result.message = error.what();  // the outcome is graderError until somebody finds a better one
    saveResult(build.result, options.results);
    return {build.result, ""};
  }
  internal::writeTextFile(options.results.parent_path() / "build.log", build.log);
  saveResult(build.result, options.results);
  return {callGrader(graderCommand(toolchain, exercise, options, build.worker), options.results),
          build.source};
}

std::vector<CheckResult> listChecks(const Toolchain& toolchain) {
  const ProcessResult run = runProcess({toolchain.grader.string(), "--list"});
  std::vector<CheckResult> checks;
  try {
    for (const nlohmann::json& entry : nlohmann::json::parse(run.output)) {
      CheckResult check{.id = entry.at("id"), .part = entry.at("part"), .title = entry.at("title")};
      check.group = entry.at("group") == "hidden" ? Group::hidden : Group::visible;
      check.maxPoints = entry.at("points");
      checks.push_back(std::move(check));
    }
  } catch (const nlohmann::json::exception&) {
    throw Error({.what = "the grader cannot list its checks",
                 .where = {toolchain.grader.string()},
                 .found = run.error.empty() ? run.output : run.error});
  }
  return checks;
}

}  // namespace rex::grading
