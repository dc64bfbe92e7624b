#include "submission/submission.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/escape.h"
#include "base/exit_code.h"
#include "base/process.h"
#include "base/sha256.h"
#include "base/text.h"
#include "base/text_file.h"
#include "grading/descendants.h"
#include "grading/grade.h"
#include "grading/results.h"
#include "grading/unknown_check.h"
#include "grading/worker_failure.h"
#include "submission/compiler_messages.h"
#include "submission/cpp_names.h"
#include "submission/reading_apart_internal.h"
#include "submission/sanitizer_rerun.h"
#include "submission/student_build.h"
#include "submission/worker_part.h"

namespace rex::submission {
namespace {

using std::filesystem::path;

constexpr double kLongestGrading = 3600;
constexpr std::size_t kLongestLine = 1000;
// A program with the sanitizers keeps records of its memory and some of what it has freed.
constexpr std::size_t kSanitizedFactor = 2, kKeptBack = 256 * grading::kMegabyte;

// "c++ (Debian 12.2.0-14) 12.2.0", or only its name if the compiler does not run.
std::string compilerVersion(const std::string& compiler) {
  const ProcessResult run = runProcess({compiler, "--version"});
  return run.ok() ? run.output.substr(0, run.output.find('\n')) : path(compiler).filename().string();
}

// The result as far as it is known before any check runs.
grading::GradeResult startResult(const Toolchain& toolchain, const ExerciseInfo& exercise,
                                 const StudentObject& object) {
  grading::GradeResult result;
  result.snapshotSha256 = sha256(object.source);
  result.submissionId = result.snapshotSha256.substr(0, 12);
  result.files = {{object.name, result.snapshotSha256}};
  result.exerciseId = exercise.name;
  result.exerciseVersion = exerciseVersion(exercise.definition);
  result.toolVersion = REX_VERSION;
  result.compiler = compilerVersion(toolchain.compiler);
  result.compile = {object.exitCode, object.messages, object.truncated};
  result.limits = exercise.limits;
  return result;
}

grading::Limits withSanitizers(grading::Limits limits) {
  limits.cpuSeconds *= grading::kSanitizedSlowness;
  limits.memory = kSanitizedFactor * limits.memory + kKeptBack;
  limits.sanitized = true;
  return limits;
}

grading::GradingJob jobOf(const Toolchain& toolchain, const ExerciseInfo& exercise,
                          const SubmissionOptions& options, const BuiltSubmission& built) {
  grading::GradingJob job = options.job;
  job.worker = built.worker;
  job.parts = built.parts;
  job.temporaryFolder = options.workFolder;
  job.limits = options.sanitize ? withSanitizers(exercise.limits) : exercise.limits;
  const bool isWhole = options.sanitize || toolchain.workerPart.empty();
  if (isWhole) job.libraries = toolchain.libraries;
  if (const path control = controlProgram(toolchain.workerPart); !isWhole && std::filesystem::exists(control))
    job.control = control;
  if (const path known = knownMistakesFile(exercise.definition); std::filesystem::exists(known))
    job.mistakes = known;
  return job;
}

std::vector<std::string> graderCommand(const Toolchain& toolchain, const grading::GradingJob& job) {
  std::vector<std::string> command = grading::toArguments(job);
  command.insert(command.begin(), toolchain.grader.string());
  return command;
}

// Runs the grader and reads what it wrote. If the grader breaks, the result says that it is our fault. A
// grader that is stopped leaves its worker behind, and what that started.
grading::GradeResult callGrader(const std::vector<std::string>& command, const path& results) {
  const grading::NewDescendants workers;
  const ProcessResult run = runProcess(command, {.timeout = kLongestGrading});
  const std::string said = run.error.substr(0, run.error.find_last_not_of('\n') + 1);
  grading::GradeResult result = grading::loadResult(results);
  if (run.exitCode != numberOf(ExitCode::kFull) && run.exitCode != numberOf(ExitCode::kBelow)) {
    result.outcome = grading::Outcome::kGraderError;
    // A grader that reports a fault of its own explains it in the result.
    if (run.exitCode != numberOf(ExitCode::kGraderFault) || result.message.empty())
      result.message =
          fmt::format("the grader failed (exit code {}, signal {}): {}", run.exitCode, run.signal, said);
    grading::saveResult(result, results);
  }
  return result;
}

std::string firstError(const std::vector<grading::CompileDiagnostic>& messages) {
  const auto first =
      std::find_if(messages.begin(), messages.end(),
                   [](const grading::CompileDiagnostic& message) { return message.severity == "error"; });
  return first == messages.end() ? "does not compile" : toString(*first);
}

void requireKnownChecks(const Toolchain& toolchain, const std::vector<std::string>& wanted) {
  if (wanted.empty()) return;
  std::vector<std::string> known;
  for (const grading::CheckResult& check : listChecks(toolchain)) known.push_back(check.id);
  for (const std::string& id : wanted)
    if (std::find(known.begin(), known.end(), id) == known.end()) throw grading::unknownCheck(id, known);
}

Toolchain sanitized(const Toolchain& toolchain, const ExerciseInfo& exercise,
                    const SubmissionOptions& options) {
  std::filesystem::create_directories(options.workFolder);
  return sanitizedToolchain(toolchain, std::filesystem::absolute(options.workFolder),
                            withSanitizers(exercise.limits).memory);
}

// It takes three times as long with the sanitizers, with which a whole tree may be built, too.
double compileSeconds(const SubmissionOptions& options) {
  constexpr double kSlowness = 3;
#ifdef __SANITIZE_ADDRESS__
  return kSlowness * options.compileSeconds;
#else
  return options.sanitize ? kSlowness * options.compileSeconds : options.compileSeconds;
#endif
}

StudentObject compileAsAsked(const Toolchain& toolchain, const ExerciseInfo& exercise,
                             const SubmissionOptions& options) {
  StudentBuildOptions build{.main = options.main,
                            .workFolder = options.workFolder,
                            .publicHeadersOnly = true,
                            .graded = true,
                            .seconds = compileSeconds(options),
                            .sandbox = options.job.sandbox,
                            .part = true};
  if (!options.sanitize) return compileStudent(toolchain, exercise.forbidden, build);
  // Unoptimised inline functions of the library, used by main(), refer to functions forbidden elsewhere.
  build.graded = build.part = false;
  return compileStudent(toolchain, {}, build);
}

// A message can have any line breaks, and a CI service may print the log: no line of it is a command there.
std::string withoutCommands(std::string_view log) {
  std::string text;
  for (const std::string_view line : splitLines(log)) {
    if (trimmed(line).starts_with("::")) text += "| ";
    text.append(line) += '\n';
  }
  for (std::size_t at = text.find("##"); at != text.npos; at = text.find("##", at + 2))
    text.insert(at + 1, " ");
  return text;
}

void compileAndLink(const Toolchain& toolchain, const ExerciseInfo& exercise,
                    const SubmissionOptions& options, BuiltSubmission& built) {
  const StudentObject object = compileAsAsked(toolchain, exercise, options);
  built.start = startResult(toolchain, exercise, object);
  grading::setSandbox(built.start, options.job.sandbox.level);
  built.source = object.source;
  std::string log = object.log;
  auto& diagnostics = built.start.compile.diagnostics;
  if (object.ok) {
    const StudentProgram linked = linkWorker(toolchain, object, options.job.sandbox);
    if (linked.ok) {
      built.worker = linked.program;
      built.parts = linked.parts;
    }
    diagnostics.insert(diagnostics.end(), linked.messages.begin(), linked.messages.end());
    log += linked.log;
  }
  if (built.worker.empty()) {
    built.start.outcome = grading::Outcome::kCompileError;
    built.start.message = firstError(diagnostics);
  }
  writeTextFile(options.job.results.parent_path() / "build.log", withoutCommands(log));
}

BuiltSubmission buildWith(const Toolchain& toolchain, const ExerciseInfo& exercise,
                          const SubmissionOptions& options) {
  BuiltSubmission built;
  try {
    compileAndLink(toolchain, exercise, options, built);
  } catch (const Error& error) {
    built.start = startResult(toolchain, exercise, {});
    built.start.message = error.what();  // the outcome is graderError unless a better one is found
  }
  return built;
}

// What the sanitizers find when one check runs on a build with them.
std::optional<CrashSite> crashSiteOf(const Toolchain& toolchain, const ExerciseInfo& exercise,
                                     const SubmissionOptions& options, const BuiltSubmission& built,
                                     const std::string& check) {
  SubmissionOptions one = options;
  one.job.checks = {check};
  one.job.evidence.clear();
  one.job.results = options.workFolder / "second-look.json";
  std::filesystem::remove(one.job.results);
  const grading::GradingJob job = jobOf(toolchain, exercise, one, built);
  const grading::NewDescendants workers;
  static_cast<void>(runProcess(graderCommand(toolchain, job), {.timeout = kLongestGrading}));
  return crashSiteIn(grading::loadResult(job.results).error.text, built.start.files.front().name);
}

// "3 and 2" are sizes that differ, "7 and 0" an index that is compared with 0 before the size.
std::string sentenceOn(const std::string& sides) {
  const bool isIndex = sides.ends_with(" and 0");
  return isIndex ? fmt::format("The index is {}.", sides.substr(0, sides.find(' ')))
                 : fmt::format("The sizes are {}.", sides);
}

// What the sanitizers found comes first; without their guess, the crash follows. An assertion says more than
// they.
std::string messageAbout(const CrashSite& site, const std::string& crash) {
  constexpr std::string_view kAborts = "aborts";
  const bool isAssertion = crash.find("Assertion") != std::string::npos;
  if (isAssertion && !site.sides.empty()) return crash + " " + sentenceOn(site.sides);
  if (site.finding == kAborts || isAssertion) return crash;
  std::string place = site.line > 0 ? fmt::format("line {}", site.line) : "";
  if (!site.function.empty()) place += (place.empty() ? "in " : ", in ") + site.function;
  return printable(fmt::format("{}{}{} ({})", place, place.empty() ? "" : ": ", site.finding,
                               crash.substr(0, crash.find(" ("))),
                   kLongestLine);
}

// Visible checks with an outcome of which a second look says more.
std::vector<grading::CheckResult*> chosen(grading::GradeResult& result, std::size_t most,
                                          const std::function<bool(const grading::CheckResult&)>& tells) {
  std::vector<grading::CheckResult*> checks;
  for (grading::CheckResult& check : result.checks)
    if (check.group == grading::Group::kVisible && tells(check)) checks.push_back(&check);
  if (checks.size() > most) checks.resize(most);
  return checks;
}

// Another build of the file repeats the checks to find out where they end. The verdict stays: whatever goes
// wrong here, the result is no worse than without.
void repeat(const std::vector<grading::CheckResult*>& checks, const Toolchain& toolchain,
            const ExerciseInfo& exercise, const SubmissionOptions& options, const BuiltSubmission& built,
            const std::function<void(const CrashSite&, grading::CheckResult&)>& explain) {
  std::filesystem::create_directories(options.workFolder);
  if (built.worker.empty()) return;
  for (grading::CheckResult* check : checks) {
    const auto site = crashSiteOf(toolchain, exercise, options, built, check->id);
    if (!site) continue;
    explain(*site, *check);
    if (site->line > 0) check->line = site->line;
  }
}

void findCrashes(const Toolchain& toolchain, const ExerciseInfo& exercise, const SubmissionOptions& options,
                 const BuiltSubmission& graded, grading::GradeResult& result) {
  const auto crashed = chosen(
      result, 2, [](const grading::CheckResult& check) { return grading::tellsOfCrash(check.message); });
  if (crashed.empty()) return;
  SubmissionOptions again = options;
  again.sanitize = true;
  const BuiltSubmission built = options.sanitize ? graded : buildSubmission(toolchain, exercise, again);
  repeat(crashed, toolchain, exercise, again, built, [](const CrashSite& site, grading::CheckResult& check) {
    check.message = messageAbout(site, check.message);
  });
}

// The function that was called last need not be the one that never ends, or that fills the memory.
void findEndlessLoops(const Toolchain& toolchain, const ExerciseInfo& exercise,
                      const SubmissionOptions& options, grading::GradeResult& result) {
  constexpr double kMostSeconds = 3;
  const auto late = chosen(result, 1, [](const grading::CheckResult& check) {
    const bool isAsleep = check.message.find("CPU time") == std::string::npos;
    return !check.function.empty() && (check.status == grading::Outcome::kMemoryLimit ||
                                       (check.status == grading::Outcome::kTimeLimit && !isAsleep));
  });
  if (late.empty() || options.sanitize) return;
  std::filesystem::create_directories(options.workFolder);
  SubmissionOptions again = options;
  again.sanitize = true;
  ExerciseInfo timed = exercise;
  // With the sanitizers, memory fills more slowly.
  const bool isFull = late.front()->status == grading::Outcome::kMemoryLimit;
  const double seconds = isFull ? 10 * kMostSeconds : std::min(exercise.limits.cpuSeconds, kMostSeconds);
  timed.limits.wallSeconds = 10 * seconds;
  const Toolchain locating = locatingToolchain(toolchain, std::filesystem::absolute(options.workFolder),
                                               withSanitizers(exercise.limits).memory, seconds);
  const BuiltSubmission built = buildWith(locating, timed, again);
  repeat(late, locating, timed, again, built, [](const CrashSite& site, grading::CheckResult& check) {
    if (site.line == 0) return;
    const bool isAsking = site.finding.starts_with("asked");
    check.message = printable(fmt::format("{}; line {}, in {}, {}", check.message, site.line, site.function,
                                          isAsking ? site.finding : "was running: an endless loop?"),
                              kLongestLine);
  });
}

void lookAgain(const Toolchain& toolchain, const ExerciseInfo& exercise, const SubmissionOptions& options,
               const BuiltSubmission& graded, grading::GradeResult& result) {
  // The sanitizers need to read and map memory in ways that a sandbox forbids.
  if (isConfined(options.job.sandbox.level)) return;
  SubmissionOptions again = options;
  again.workFolder = options.workFolder / "second-look";
  again.job.results = again.workFolder / "results.json";
  again.job.jobs = 1;
  try {
    findCrashes(toolchain, exercise, again, graded, result);
    findEndlessLoops(toolchain, exercise, again, result);
  } catch (const Error&) {
    return;
  }
}

// What a report may say beyond the verdict, from the text of the file. Without it if the text defies reading.
nlohmann::json hintsFrom(const std::function<nlohmann::json()>& read) {
  try {
    return readApart("the file for hints", kAfterCompiling, read);
  } catch (const UnreadableFile&) {
    return {};
  }
}

void findLines(const std::string& source, std::vector<grading::CheckResult>& checks) {
  const nlohmann::json lines = hintsFrom([&] {
    const CppText text(source);
    nlohmann::json found;
    for (const grading::CheckResult& check : checks)
      found.push_back(check.function.empty() ? 0 : definitionLine(check.function, text));
    return found;
  });
  for (std::size_t k = 0; k < lines.size(); ++k) checks[k].line = lines[k];
}

void explain(const std::string& source, std::vector<grading::CheckResult>& checks) {
  const nlohmann::json messages = hintsFrom([&] {
    std::vector<grading::CheckResult> explained = checks;
    explainCascades(explained, source);
    nlohmann::json found;
    for (const grading::CheckResult& check : explained) found.push_back(check.message);
    return found;
  });
  for (std::size_t k = 0; k < messages.size(); ++k) checks[k].message = messages[k];
}

}  // namespace

BuiltSubmission buildSubmission(const Toolchain& toolchain, const ExerciseInfo& exercise,
                                const SubmissionOptions& options) {
  return buildWith(options.sanitize ? sanitized(toolchain, exercise, options) : toolchain, exercise, options);
}

grading::GradeResult gradeBuilt(const BuiltSubmission& built, const Toolchain& toolchain,
                                const ExerciseInfo& exercise, const SubmissionOptions& options) {
  const grading::GradingJob job = jobOf(toolchain, exercise, options, built);
  grading::saveResult(built.start, job.results);
  grading::GradeResult result = callGrader(graderCommand(toolchain, job), job.results);
  if (built.worker.empty() || (job.pass == grading::Pass::kVisible && awaitsHiddenChecks(result)))
    return result;
  findLines(built.source, result.checks);
  if (options.lookAgain || options.sanitize) lookAgain(toolchain, exercise, options, built, result);
  explain(built.source, result.checks);
  grading::saveResult(result, job.results);
  return result;
}

Submission gradeSubmission(const Toolchain& toolchain, const ExerciseInfo& exercise,
                           const SubmissionOptions& options) {
  requireKnownChecks(toolchain, options.job.checks);
  const BuiltSubmission built = buildSubmission(toolchain, exercise, options);
  return {gradeBuilt(built, toolchain, exercise, options), built.source};
}

std::string exerciseVersion(const path& folder) {
  std::string text;
  for (const char* name : {"exercise.toml", "exercise.h", "check.cpp"})
    if (std::filesystem::exists(folder / name)) text += readTextFile(folder / name) + '\0';
  return sha256(text).substr(0, 12);
}

path knownMistakesFile(const path& folder) { return folder / "sketches.tsv"; }

std::vector<grading::CheckResult> listChecks(const Toolchain& toolchain) {
  const ProcessResult run = runProcess({toolchain.grader.string(), "--list"});
  std::vector<grading::CheckResult> checks;
  try {
    for (const nlohmann::json& entry : nlohmann::json::parse(run.output)) {
      grading::CheckResult check{.id = entry.at("id"), .part = entry.at("part"), .title = entry.at("title")};
      check.group = entry.at("group") == "hidden" ? grading::Group::kHidden : grading::Group::kVisible;
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

}  // namespace rex::submission
