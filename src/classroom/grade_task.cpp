#include "classroom/grade_task.h"

#include <algorithm>
#include <optional>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/sha256.h"
#include "base/text.h"
#include "base/text_file.h"
#include "classroom/kept_workers.h"
#include "grading/hidden_seed.h"
#include "submission/student_build.h"
#include "submission/submission.h"

namespace rex::classroom {

using submission::SubmissionOptions;

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// All files below the folder, in the same order on every machine.
std::vector<fs::path> filesBelow(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code missing;  // missing folders are skipped, as the compiler does
  for (const auto& entry : fs::recursive_directory_iterator(folder, missing))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

// Functions in headers are compiled into the student's program, so no library reveals their changes. The
// folder of the exercise itself holds what students and instructors write; its version covers that.
std::string headersOf(const std::vector<std::string>& flags) {
  std::string text;
  for (std::size_t i = 0; i + 1 < flags.size(); ++i)
    if (flags[i] == "-isystem")
      for (const fs::path& file : filesBelow(flags[i + 1]))
        if (file.extension() == ".h") text += fmt::format("{}\n{}\n", file.string(), readTextFile(file));
  return text;
}

// The program cannot change while it runs, even if a new one takes its name.
const std::string& hashOfRunningProgram() {
  static const std::string hash = sha256(readTextFile("/proc/self/exe"));
  return hash;
}

void require(const std::string& what, const std::string& found, const std::string& wanted) {
  if (found == wanted) return;
  throw Error({.what = what + " is not the one that the list of tasks was written for",
               .found = "hash " + found.substr(0, 12),
               .wanted = wanted.substr(0, 12) + ", or a new list"});
}

void requireInputs(const Task& task, const fs::path& file, const submission::Toolchain& toolchain,
                   const submission::ExerciseInfo& exercise, const fs::path& launcher,
                   const std::string& secretId) {
  require(file.string(), sha256(gradedText(file)), task.sourceSha256);
  require("the grader of " + exercise.name, graderFingerprint(toolchain, exercise, launcher),
          task.graderSha256);
  if (secretId != task.secretId)
    throw Error({.what = "the secret of the course",
                 .found = secretId.empty() ? "none" : secretId,
                 .wanted = task.secretId.empty() ? "none" : task.secretId});
}

// Seeds and secrets change the questions, not the program.
std::string workerKey(const Task& task) {
  return sha256(fmt::format("{}\n{}\n{}\n{}\n", task.exercise, task.sourceSha256, task.graderSha256,
                            numberOf(task.level)));
}

std::string withInputs(const fs::path& results, const Task& task, bool evidence, bool alone,
                       const std::string& secret) {
  const std::string text = readTextFile(results), seal = grading::computeSeal(text, results.string());
  Json json = Json::parse(text);
  json["inputs"] = {{"sha256", task.inputsSha256()},      {"source_sha256", task.sourceSha256},
                    {"grader_sha256", task.graderSha256}, {"result_sha256", seal},
                    {"level", numberOf(task.level)},      {"secret_id", task.secretId}};
  if (task.seed) json["inputs"]["seed"] = *task.seed;
  if (alone) json["inputs"]["alone"] = true;
  if (!secret.empty())
    json["inputs"]["result_hmac"] = resultHmac({.sha256 = task.inputsSha256(), .seal = seal}, task, secret);
  json["volatile"]["evidence"] = evidence;
  return json.dump(2) + "\n";
}

// Copies what a grading left, of which nothing is seen before all of it is there: reports and pictures of an
// earlier result would mislead, and new pictures are written before the result that names them.
void publish(const fs::path& from, const fs::path& folder, const std::string& result) {
  fs::create_directories(folder);
  if (fs::exists(from / kBuildLog))
    replaceTextFile(folder / kBuildLog, readTextFile(from / kBuildLog), "the log of the compiler");
  removeReports(folder);
  fs::remove_all(folder / kEvidence);
  if (fs::exists(from / kEvidence))
    fs::copy(from / kEvidence, folder / kEvidence, fs::copy_options::recursive);
  replaceTextFile(folder / kResults, result, "the result file");
}

// A pass of a class keeps its program for the next.
submission::BuiltSubmission build(const Task& task, const submission::Toolchain& toolchain,
                                  const submission::ExerciseInfo& exercise, const TaskOptions& options,
                                  const SubmissionOptions& submission) {
  if (options.workers.empty() && options.pass == grading::Pass::kWhole)
    return submission::buildSubmission(toolchain, exercise, submission);
  const fs::path kept = options.workers.empty() ? options.workFolder / "kept" : options.workers;
  return buildOnce({kept, workerKey(task), options.recompile}, toolchain, exercise, submission);
}

}  // namespace

std::string graderFingerprint(const submission::Toolchain& toolchain,
                              const submission::ExerciseInfo& exercise, const fs::path& launcher) {
  std::string text = fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n{}\n", REX_VERSION,
                                 submission::exerciseVersion(exercise.definition), toolchain.compiler,
                                 join(toolchain.flags, "\n"), join(toolchain.linkFlags, "\n"),
                                 sha256(headersOf(toolchain.flags)), hashOfRunningProgram());
  std::vector<fs::path> files = toolchain.libraries;
  files.insert(files.end(), {toolchain.grader, toolchain.workerObject});
  for (const fs::path& file : files) text += sha256(readTextFile(file)) + "\n";
  for (const fs::path& file : {launcher, submission::knownMistakesFile(exercise.definition)})
    if (fs::exists(file)) text += sha256(readTextFile(file)) + "\n";
  return sha256(text);
}

std::optional<grading::ResultFile> readFirstPass(const Task& task, const fs::path& out,
                                                 std::string_view secret) {
  const fs::path file = resultFolder(out, task) / kVisible / kResults;
  auto read = grading::readResultFile(file);
  if (!read || read->inputs.sha256 != task.inputsSha256() || !whyRefused(*read, file, task, secret).empty())
    return {};
  return read;
}

grading::GradeResult gradeTask(const Task& task, const StoredResult& stored,
                               const submission::Toolchain& toolchain,
                               const submission::ExerciseInfo& exercise, const TaskOptions& options) {
  const fs::path file = options.out / task.file, whole = resultFolder(options.out, task),
                 out = options.workFolder / "out";
  const std::string secret = classSecret(options.secret);
  requireInputs(task, file, toolchain, exercise, options.launcher, grading::courseSecretId(secret));
  fs::create_directories(out);
  const bool keepsEvidence = options.evidence || stored.evidence;
  if (options.pass == grading::Pass::kVisible)
    if (auto read = readFirstPass(task, options.out, secret); read && read->inputs.evidence == keepsEvidence)
      return *std::move(read->result);  // of a run that was interrupted
  const SubmissionOptions submission{.main = file,
                                     .workFolder = options.workFolder / "work",
                                     .job = {.results = out / kResults,
                                             .pass = options.pass,
                                             .seed = task.seed.value_or(grading::GradingJob{}.seed),
                                             .sandbox = {.level = task.level, .launcher = options.launcher},
                                             .evidence = keepsEvidence ? out / kEvidence : fs::path(),
                                             .secret = options.secret}};
  submission::BuiltSubmission built = build(task, toolchain, exercise, options, submission);
  if (options.pass == grading::Pass::kHidden) {
    fs::copy(whole / kVisible, out, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    built.start = grading::loadResult(out / kResults);
  }
  grading::GradeResult result = submission::gradeBuilt(built, toolchain, exercise, submission);
  fs::remove_all(submission.workFolder);
  const auto sealed = [&] { return withInputs(out / kResults, task, keepsEvidence, options.alone, secret); };
  if (options.pass == grading::Pass::kVisible && awaitsHiddenChecks(result)) {
    publish(out, whole / kVisible, sealed());
    return result;
  }
  const bool isHeld = !options.accept && stored.before && result.outcome != grading::Outcome::kGraderError &&
                      result.score < *stored.before;
  fs::remove_all(whole / kRegraded);
  publish(out, isHeld ? whole / kRegraded : whole, sealed());
  fs::remove_all(whole / kVisible);
  return result;
}

std::string gradedText(const fs::path& file) {
  try {
    return submission::readStudentFile(file);
  } catch (const Error&) {
    return {};
  }
}

}  // namespace rex::classroom
