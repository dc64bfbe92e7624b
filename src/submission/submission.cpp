#include "submission/submission.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/printable.h"
#include "base/process.h"
#include "base/sha256.h"
#include "base/text_file.h"
#include "grading/descendants.h"
#include "grading/grade.h"
#include "grading/result_file.h"
#include "grading/unknown_check.h"
#include "grading/worker_failure.h"
#include "submission/compiler_messages.h"
#include "submission/mentions.h"
#include "submission/second_look.h"
#include "submission/student_build.h"

namespace rex::grading {
namespace {

using std::filesystem::path;

constexpr int kGraderFault = 3;  // it explains itself in the result
constexpr double kLongestGrading = 3600;
// A program with the sanitizers is slow, and keeps a record of its memory and some of what it gave back.
constexpr double kSanitizedSlowness = 20;
constexpr int kSanitizedFactor = 2, kKeptBackMegabytes = 256;

// "c++ (Debian 12.2.0-14) 12.2.0", or the name alone of a compiler that does not run.
std::string compilerVersion(const std::string& compiler) {
  const ProcessResult run = runProcess({compiler, "--version"});
  return run.ok() ? run.output.substr(0, run.output.find('\n')) : path(compiler).filename().string();
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
  result.compiler = compilerVersion(toolchain.compiler);
  result.compile = {object.exitCode, object.messages, object.truncated};
  result.limits.cpuSeconds = exercise.limits.cpuSeconds;
  result.limits.memoryMegabytes = exercise.limits.memoryMb;
  result.limits.outputMegabytes = exercise.limits.outputMb;
  return result;
}

std::vector<std::string> graderCommand(const Toolchain& toolchain, const ExerciseInfo& exercise,
                                       const SubmissionOptions& options, const path& worker) {
  std::vector<std::string> command = {toolchain.grader.string(), "--results", options.results.string(),
                                      "--temporary", options.workFolder.string()};
  if (!worker.empty()) command.insert(command.end(), {"--worker", worker.string()});
  for (const std::string& check : options.checks) command.insert(command.end(), {"--check", check});
  if (options.seed) command.insert(command.end(), {"--seed", fmt::format("{}", *options.seed)});
  if (isConfined(options.sandbox.level)) {
    command.insert(command.end(), {"--level", fmt::format("{}", numberOf(options.sandbox.level)), "--sandbox",
                                   options.sandbox.launcher.string()});
    if (options.sanitize || toolchain.workerPart.empty())
      for (const path& library : toolchain.libraries)
        command.insert(command.end(), {"--library", library.string()});
  }
  if (!options.evidence.empty()) command.insert(command.end(), {"--evidence", options.evidence.string()});
  if (options.sanitize) command.emplace_back("--sanitized");
  if (options.processors > 1)
    command.insert(command.end(), {"--jobs", fmt::format("{}", options.processors)});
  if (!options.secret.empty()) command.insert(command.end(), {"--secret", options.secret.string()});
  command.insert(command.end(), {"--cpu-seconds", fmt::format("{:g}", exercise.limits.cpuSeconds),
                                 "--memory-mb", fmt::format("{}", exercise.limits.memoryMb), "--output-mb",
                                 fmt::format("{}", exercise.limits.outputMb)});
  return command;
}

ExerciseInfo withLimitsOfSanitizers(ExerciseInfo exercise) {
  exercise.limits.cpuSeconds *= kSanitizedSlowness;
  exercise.limits.memoryMb = kSanitizedFactor * exercise.limits.memoryMb + kKeptBackMegabytes;
  return exercise;
}

// Runs the grader and reads what it wrote; a grader that breaks is our fault and says so in the result. One
// that was stopped leaves its worker behind, and what that started.
GradeResult callGrader(const std::vector<std::string>& command, const path& results) {
  const NewDescendants workers;
  const ProcessResult run = runProcess(command, {.timeout = kLongestGrading});
  const std::string said = run.error.substr(0, run.error.find_last_not_of('\n') + 1);
  GradeResult result = loadResult(results);
  if (run.exitCode != 0 && run.exitCode != 1) {
    result.outcome = Outcome::graderError;
    if (run.exitCode != kGraderFault || result.message.empty())
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

void requireKnownChecks(const Toolchain& toolchain, const std::vector<std::string>& wanted) {
  if (wanted.empty()) return;
  std::vector<std::string> known;
  for (const CheckResult& check : listChecks(toolchain)) known.push_back(check.id);
  for (const std::string& id : wanted)
    if (std::find(known.begin(), known.end(), id) == known.end()) throw unknownCheck(id, known);
}

Toolchain sanitized(const Toolchain& toolchain, const ExerciseInfo& exercise,
                    const SubmissionOptions& options) {
  std::filesystem::create_directories(options.workFolder);
  return sanitizedToolchain(toolchain, std::filesystem::absolute(options.workFolder),
                            withLimitsOfSanitizers(exercise).limits.memoryMb);
}

StudentObject compileAsAsked(const Toolchain& toolchain, const ExerciseInfo& exercise,
                             const SubmissionOptions& options) {
  constexpr double kSanitizedSeconds = 90;
  StudentBuildOptions build{.main = options.main,
                            .workFolder = options.workFolder,
                            .publicHeadersOnly = true,
                            .graded = true,
                            .seconds = options.compileSeconds,
                            .sandbox = options.sandbox,
                            .part = options.processors > 1};
  if (!options.sanitize) return compileStudent(toolchain, exercise.forbidden, build);
  // Unoptimised, inline functions of the library that main() uses refer to what is forbidden outside of it.
  build.seconds = kSanitizedSeconds;
  build.graded = build.part = false;
  return compileStudent(toolchain, {}, build);
}

void compileAndLink(const Toolchain& toolchain, const ExerciseInfo& exercise,
                    const SubmissionOptions& options, BuiltSubmission& built) {
  const StudentObject object = compileAsAsked(toolchain, exercise, options);
  built.start = startResult(toolchain, exercise, object);
  setSandbox(built.start, options.sandbox.level);
  built.source = object.source;
  std::string log = object.log;
  auto& diagnostics = built.start.compile.diagnostics;
  if (object.ok) {
    const StudentProgram linked = linkWorker(toolchain, object, options.sandbox);
    if (linked.ok) built.worker = linked.program;
    diagnostics.insert(diagnostics.end(), linked.messages.begin(), linked.messages.end());
    log += linked.log;
  }
  if (built.worker.empty()) {
    built.start.outcome = Outcome::compileError;
    built.start.message = firstError(diagnostics);
  }
  writeTextFile(options.results.parent_path() / "build.log", log);
}

// What the sanitizers see in one check of a build with them.
std::optional<CrashSite> crashSiteOf(const Toolchain& toolchain, const ExerciseInfo& exercise,
                                     const SubmissionOptions& options, const path& worker,
                                     const std::string& check, const std::string& mainFile) {
  SubmissionOptions one = options;
  one.checks = {check};
  one.processors = 1;
  one.evidence.clear();
  one.results = options.workFolder / "second-look.json";
  std::filesystem::remove(one.results);
  const ExerciseInfo limited = withLimitsOfSanitizers(exercise);
  const NewDescendants workers;
  static_cast<void>(runProcess(graderCommand(toolchain, limited, one, worker), {.timeout = kLongestGrading}));
  return crashSiteIn(loadResult(one.results).error.text, mainFile);
}

// Builds the same file with the sanitizers and repeats the visible checks that crashed, to say where. The
// verdict stays: whatever goes wrong here, the result is as good as without.
void findCrashes(const Toolchain& toolchain, const ExerciseInfo& exercise, const SubmissionOptions& options,
                 const BuiltSubmission& graded, GradeResult& result) {
  constexpr int kMostRepeated = 4;
  std::vector<CheckResult*> crashed;
  for (CheckResult& check : result.checks)
    if (check.group == Group::visible && tellsOfCrash(check.message)) crashed.push_back(&check);
  if (crashed.size() > kMostRepeated) crashed.resize(kMostRepeated);
  // The sanitizers read and map what a sandbox forbids.
  if (crashed.empty() || isConfined(options.sandbox.level)) return;
  SubmissionOptions again = options;
  again.sanitize = true;
  again.workFolder = options.workFolder / "second-look";
  again.results = again.workFolder / "results.json";
  try {
    const BuiltSubmission built = options.sanitize ? graded : buildSubmission(toolchain, exercise, again);
    std::filesystem::create_directories(again.workFolder);
    if (built.worker.empty()) return;
    for (CheckResult* check : crashed) {
      const auto site =
          crashSiteOf(toolchain, exercise, again, built.worker, check->id, built.start.files.front().name);
      if (!site) continue;
      // The message of an abort already gives the reason.
      if (!check->message.starts_with("aborted "))
        check->message += "; a second look: " + printable(site->finding, 500);
      if (site->line > 0) check->line = site->line;
    }
  } catch (const Error&) {
    return;
  }
}

}  // namespace

BuiltSubmission buildSubmission(const Toolchain& toolchain, const ExerciseInfo& exercise,
                                const SubmissionOptions& options) {
  BuiltSubmission built;
  try {
    compileAndLink(options.sanitize ? sanitized(toolchain, exercise, options) : toolchain, exercise, options,
                   built);
  } catch (const Error& error) {
    built.start = startResult(toolchain, exercise, {});
    built.start.message = error.what();  // the outcome is graderError until somebody finds a better one
  }
  return built;
}

GradeResult gradeBuilt(const BuiltSubmission& built, const Toolchain& toolchain, const ExerciseInfo& exercise,
                       const SubmissionOptions& options) {
  saveResult(built.start, options.results);
  const ExerciseInfo limited = options.sanitize ? withLimitsOfSanitizers(exercise) : exercise;
  GradeResult result = callGrader(graderCommand(toolchain, limited, options, built.worker), options.results);
  if (built.worker.empty()) return result;
  for (CheckResult& check : result.checks) check.line = definitionLineOf(check.function, built.source);
  if (options.lookAgain || options.sanitize) findCrashes(toolchain, exercise, options, built, result);
  saveResult(result, options.results);
  return result;
}

Submission gradeSubmission(const Toolchain& toolchain, const ExerciseInfo& exercise,
                           const SubmissionOptions& options) {
  requireKnownChecks(toolchain, options.checks);
  const BuiltSubmission built = buildSubmission(toolchain, exercise, options);
  return {gradeBuilt(built, toolchain, exercise, options), built.source};
}

std::string exerciseVersion(const path& folder) {
  std::string text;
  for (const char* name : {"exercise.toml", "exercise.h", "check.cpp"})
    if (std::filesystem::exists(folder / name)) text += readTextFile(folder / name) + '\0';
  return sha256(text).substr(0, 12);
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
