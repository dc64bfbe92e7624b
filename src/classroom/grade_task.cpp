#include "classroom/grade_task.h"

#include <algorithm>
#include <optional>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/folders.h"
#include "base/instant.h"
#include "base/sha256.h"
#include "base/text.h"
#include "base/text_file.h"
#include "classroom/csv.h"
#include "grading/hidden_seed.h"
#include "grading/results.h"
#include "reports/report.h"
#include "submission/student_build.h"
#include "submission/submission.h"

namespace rex::classroom {

using submission::SubmissionOptions;

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kWorker = "worker";
constexpr const char* kStart = "start.json";
constexpr const char* kSource = "main.cpp";
// In start.json: the parts of the exercise with workers of their own, and the hashes of all other files.
constexpr const char *kParts = "kept_parts", *kHashes = "kept_sha256";

fs::path workerIn(const fs::path& folder, const std::string& part) {
  return folder / fmt::format("{}.{}", kWorker, part);
}

// Of all files but start.json itself; one that is missing is an error.
Json hashesOf(const fs::path& entry, const std::vector<std::string>& parts) {
  std::vector<fs::path> files = {entry / kWorker, entry / kSource, entry / kBuildLog};
  for (const std::string& part : parts) files.push_back(workerIn(entry, part));
  Json hashes;
  for (const fs::path& file : files) hashes[file.filename().string()] = sha256(readTextFile(file));
  return hashes;
}

// The worker gets a second name: whoever finds a fault in the entry may remove it while the worker runs.
void takeWorker(const fs::path& kept, const fs::path& worker) {
  std::error_code otherDisk;
  fs::remove(worker);
  fs::create_hard_link(kept, worker, otherDisk);
  if (otherDisk) fs::copy_file(kept, worker);
}

// Empty if an entry is missing or has changed since it was written, as after a power cut or a disk failure.
std::optional<submission::BuiltSubmission> take(const fs::path& kept, const SubmissionOptions& options) {
  if (!fs::exists(kept / kStart)) return {};
  try {
    const Json start = Json::parse(readTextFile(kept / kStart)), &hashes = start.at(kHashes);
    submission::BuiltSubmission built{.start = grading::loadResult(kept / kStart),
                                      .source = readTextFile(kept / kSource),
                                      .worker = {},
                                      .parts = start.at(kParts).get<std::vector<std::string>>()};
    if (hashes != hashesOf(kept, built.parts)) return {};
    const fs::path work = fs::absolute(options.workFolder);
    fs::create_directories(work);
    built.worker = work / kWorker;
    std::vector<fs::path> workers = {built.worker};
    for (const std::string& part : built.parts) workers.push_back(workerIn(work, part));
    for (const fs::path& worker : workers) {
      takeWorker(kept / worker.filename(), worker);
      if (hashes.at(worker.filename().string()) != sha256(readTextFile(worker))) return {};
    }
    writeTextFile(options.job.results.parent_path() / kBuildLog, readTextFile(kept / kBuildLog));
    return built;
  } catch (const Error&) {
    return {};
  } catch (const Json::exception&) {
    return {};
  } catch (const fs::filesystem_error&) {
    return {};
  }
}

// Accessible to its owner only, as the programs in it are run.
void makeFolder(const fs::path& folder) {
  std::error_code refused;
  if (fs::create_directories(folder, refused)) fs::permissions(folder, fs::perms::owner_all, refused);
  if (!refused && !fs::is_directory(folder)) refused = std::make_error_code(std::errc::not_a_directory);
  if (refused)
    throw Error({.what = "cannot keep programs in " + folder.string(), .found = refused.message()});
}

// The hashes come last, once the hashed files are on the disk.
void fill(const fs::path& entry, const submission::BuiltSubmission& built, const fs::path& log) {
  fs::create_directory(entry);
  fs::copy_file(built.worker, entry / kWorker);
  for (const std::string& part : built.parts)
    fs::copy_file(workerIn(built.worker.parent_path(), part), workerIn(entry, part));
  writeTextFile(entry / kSource, built.source);
  writeTextFile(entry / kBuildLog, readTextFile(log));
  Json start = Json::parse(grading::toJson(built.start));
  start[kParts] = built.parts;
  start[kHashes] = hashesOf(entry, built.parts);
  for (const auto& [name, hash] : start[kHashes].items()) bringToDisk(entry / name);
  replaceTextFile(entry / kStart, start.dump(2) + "\n", "what is known of a program");
}

// The entry is complete and on the disk before it gets its name. If two processes build the same, one wins.
void keep(const submission::BuiltSubmission& built, const fs::path& kept, const fs::path& log) {
  makeFolder(kept.parent_path());
  const PrivateFolder folder(kept.parent_path());
  fill(folder.path() / "entry", built, log);
  std::error_code missing, other;
  fs::rename(kept, folder.path() / "old", missing);
  fs::rename(folder.path() / "entry", kept, other);
  bringToDisk(kept.parent_path());
}

}  // namespace

submission::BuiltSubmission buildOnce(const KeptWorkers& keeping, const submission::Toolchain& toolchain,
                                      const submission::ExerciseInfo& exercise,
                                      const SubmissionOptions& options) {
  const fs::path kept = keeping.folder / keeping.key;
  if (!keeping.recompile)
    if (auto taken = take(kept, options)) return *std::move(taken);
  submission::BuiltSubmission built = submission::buildSubmission(toolchain, exercise, options);
  if (built.worker.empty()) return built;
  keep(built, kept, options.job.results.parent_path() / kBuildLog);
  return built;
}

namespace {

std::vector<std::string> rowOf(const Task& task, const std::filesystem::path& out, const LatePolicy& policy) {
  const grading::GradeResult result = grading::loadResult(resultFolder(out, task) / "results.json");
  const auto rule = policy.find(task.exercise);
  const Lateness late = rule == policy.end()
                            ? Lateness{}
                            : computeLateness(rule->second, task.student, task.submitted, result.score);
  return {task.student,
          task.exercise,
          fmt::format("{}", result.score),
          fmt::format("{}", result.maxScore),
          std::string(toString(result.outcome)),
          fmt::format("{}", late.days),
          reports::hundredthsText(late.penalty),
          reports::hundredthsText(std::int64_t{100} * result.score - late.penalty)};
}

}  // namespace

Collected collect(const std::vector<Task>& tasks, const std::filesystem::path& out,
                  const LatePolicy& policy) {
  Collected found;
  found.csv = csvLine({"student", "exercise", "points", "possible", "outcome", "late", "penalty", "final",
                       "submitted", "time_from"});
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    const Task& task = tasks[k];
    const int number = static_cast<int>(k) + 1;
    std::vector<std::string> row = {task.student, task.exercise, "", "", "missing", "", "", ""};
    switch (taskState(task, out)) {
      case TaskState::kMissing:
        found.missing.push_back(number);
        break;
      case TaskState::kStale:
        found.stale.push_back(number);
        row[4] = "stale";
        break;
      case TaskState::kRefused:
        found.refused.push_back(number);
        row[4] = "refused";
        break;
      case TaskState::kFailed:
        found.failed.push_back(number);
        row[4] = toString(grading::Outcome::kGraderError);
        break;
      case TaskState::kDone:
        row = rowOf(task, out, policy);
    }
    row.insert(row.end(), {instantText(task.submitted), task.timeFrom});
    found.csv += csvLine(row);
  }
  return found;
}

std::string numberRanges(std::vector<int> numbers) {
  std::sort(numbers.begin(), numbers.end());
  std::string text;
  for (std::size_t k = 0; k < numbers.size();) {
    std::size_t last = k;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += fmt::format("{}{}", text.empty() ? "" : ",", numbers[k]);
    if (last > k) text += fmt::format("-{}", numbers[last]);
    k = last + 1;
  }
  return text;
}

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kResults = "results.json";
constexpr const char* kEvidence = "checks";
constexpr const char* kRegraded = "regraded";
constexpr const char* kVisible = "visible";

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
                   const submission::ExerciseInfo& exercise, const TaskOptions& options) {
  require(file.string(), sha256(gradedText(file)), task.sourceSha256);
  require("the grader of " + exercise.name, graderFingerprint(toolchain, exercise, options.launcher),
          task.graderSha256);
  if (secretFileId(options.secret) != task.secretId)
    throw Error({.what = "the secret of the course",
                 .found = options.secret.empty() ? "none" : secretFileId(options.secret),
                 .wanted = task.secretId.empty() ? "none" : task.secretId});
}

// Seeds and secrets change the questions, not the program.
std::string workerKey(const Task& task) {
  return sha256(fmt::format("{}\n{}\n{}\n{}\n", task.exercise, task.sourceSha256, task.graderSha256,
                            numberOf(task.level)));
}

// An empty table if there is none.
Json resultJson(const fs::path& file) {
  if (!fs::exists(file)) return Json::object();
  Json json = Json::parse(readTextFile(file), nullptr, false);
  return json.is_object() ? json : Json::object();
}

// One of the hashes in a result; empty if it has none.
std::string inputOf(const fs::path& file, const char* key) {
  const Json json = resultJson(file);
  const bool hasInputs = json.contains("inputs") && json["inputs"].is_object();
  return hasInputs && json["inputs"].contains(key) && json["inputs"][key].is_string()
             ? json["inputs"][key].get<std::string>()
             : "";
}

// Anyone who can write to the folder of results can make a hash; this one needs the secret.
std::string hmacOf(const std::string& seal, const std::string& inputs, const Task& task,
                   const fs::path& secret) {
  return grading::hmacSha256(grading::readCourseSecret(secret),
                             fmt::format("{}\n{}\n{}\n", task.student, inputs, seal));
}

std::string withInputs(const fs::path& results, const Task& task, bool evidence, bool alone,
                       const fs::path& secret) {
  const std::string text = readTextFile(results);
  Json json = Json::parse(text);
  json["inputs"] = {
      {"sha256", task.inputsSha256()},      {"source_sha256", task.sourceSha256},
      {"grader_sha256", task.graderSha256}, {"result_sha256", grading::computeSeal(text, results.string())},
      {"level", numberOf(task.level)},      {"secret_id", task.secretId}};
  if (task.seed) json["inputs"]["seed"] = *task.seed;
  if (alone) json["inputs"]["alone"] = true;
  if (!secret.empty())
    json["inputs"]["result_hmac"] =
        hmacOf(json["inputs"]["result_sha256"], task.inputsSha256(), task, secret);
  json["volatile"]["evidence"] = evidence;
  return json.dump(2) + "\n";
}

// Why a result file for the inputs of a task is not believed; empty if it is.
std::string whyNoResult(const fs::path& file, const Task& task, const fs::path& secret) {
  try {
    const grading::GradeResult result = grading::loadSoundResult(file);
    const std::string hmac = inputOf(file, "result_hmac");
    if (!secret.empty() &&
        hmac != hmacOf(inputOf(file, "result_sha256"), inputOf(file, "sha256"), task, secret))
      return Error({.what = "a result that was not written with the secret of the course",
                    .where = {file.string()},
                    .found = hmac.empty() ? "no result_hmac" : "another result_hmac"})
          .what();
    if (result.exerciseId == task.exercise) return {};
    return Error({.what = "a result of another exercise",
                  .where = {file.string()},
                  .found = "'" + result.exerciseId + "'",
                  .wanted = "'" + task.exercise + "'"})
        .what();
  } catch (const Error& error) {
    return error.what();
  }
}

bool keptEvidence(const fs::path& folder) {
  return resultJson(folder / kResults).value(Json::json_pointer("/volatile/evidence"), false);
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
  std::string text =
      fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n", REX_VERSION, submission::exerciseVersion(exercise.definition),
                  toolchain.compiler, join(toolchain.flags, "\n"), join(toolchain.linkFlags, "\n"),
                  sha256(headersOf(toolchain.flags)));
  std::vector<fs::path> files = toolchain.libraries;
  files.insert(files.end(), {toolchain.grader, toolchain.workerObject});
  for (const fs::path& file : files) text += sha256(readTextFile(file)) + "\n";
  text += hashOfRunningProgram() + "\n";
  if (fs::exists(launcher)) text += sha256(readTextFile(launcher)) + "\n";
  return sha256(text);
}

std::string secretFileId(const fs::path& secret) {
  return secret.empty() ? "" : grading::courseSecretId(grading::readCourseSecret(secret));
}

fs::path resultFolder(const fs::path& out, const Task& task) { return out / task.student / task.exercise; }

TaskState taskState(const Task& task, const fs::path& out, const fs::path& secret) {
  const fs::path file = resultFolder(out, task) / kResults;
  if (!fs::exists(file)) return TaskState::kMissing;
  try {
    const Json json = Json::parse(readTextFile(file));
    if (json.at("inputs").at("sha256") != task.inputsSha256() && !isHeldBack(task, out))
      return TaskState::kStale;
    if (json.at("outcome") == toString(grading::Outcome::kGraderError)) return TaskState::kFailed;
  } catch (const Json::exception&) {
    return TaskState::kStale;  // some other file of that name
  }
  return whyRefused(task, out, secret).empty() ? TaskState::kDone : TaskState::kRefused;
}

std::string whyRefused(const Task& task, const fs::path& out, const fs::path& secret) {
  return whyNoResult(resultFolder(out, task) / kResults, task, secret);
}

bool awaitsSecondPass(const Task& task, const fs::path& out, const fs::path& secret) {
  const fs::path file = resultFolder(out, task) / kVisible / kResults;
  return inputOf(file, "sha256") == task.inputsSha256() && whyNoResult(file, task, secret).empty();
}

void removeReports(const fs::path& folder) {
  for (const reports::ReportFormat& format : reports::reportFormats()) fs::remove(folder / format.file);
}

bool isHeldBack(const Task& task, const fs::path& out) {
  const fs::path folder = resultFolder(out, task);
  return fs::exists(folder / kRegraded / kResults) &&
         inputOf(folder / kResults, "source_sha256") == task.sourceSha256 &&
         inputOf(folder / kRegraded / kResults, "sha256") == task.inputsSha256();
}

void acceptRegrading(const Task& task, const fs::path& out) {
  const fs::path folder = resultFolder(out, task), regraded = folder / kRegraded;
  if (isHeldBack(task, out)) {
    // Copies until the result itself moves: after an interruption, all of it can be done again.
    removeReports(folder);
    fs::remove_all(folder / kEvidence);
    if (fs::exists(regraded / kBuildLog))
      replaceTextFile(folder / kBuildLog, readTextFile(regraded / kBuildLog), "the log of the compiler");
    if (fs::exists(regraded / kEvidence))
      fs::copy(regraded / kEvidence, folder / kEvidence, fs::copy_options::recursive);
    fs::rename(regraded / kResults, folder / kResults);
    bringToDisk(folder);
  }
  if (!fs::exists(regraded / kResults)) fs::remove_all(regraded);
}

std::optional<int> pointsBefore(const Task& task, const fs::path& out) {
  const fs::path file = resultFolder(out, task) / kResults;
  if (!fs::exists(file) || inputOf(file, "source_sha256") != task.sourceSha256) return {};
  try {
    const grading::GradeResult result = grading::loadSoundResult(file);
    if (result.exerciseId != task.exercise || result.outcome == grading::Outcome::kGraderError) return {};
    return result.score;
  } catch (const Error&) {
    return {};
  }
}

std::optional<int> pointsNow(const Task& task, const fs::path& out) {
  if (isHeldBack(task, out)) return grading::loadResult(resultFolder(out, task) / kRegraded / kResults).score;
  return taskState(task, out) == TaskState::kDone ? pointsBefore(task, out) : std::nullopt;
}

std::optional<GradedWith> gradedWith(const Task& task, const fs::path& out) {
  const fs::path folder = resultFolder(out, task), waiting = folder / kRegraded / kResults;
  try {
    const Json inputs = resultJson(fs::exists(waiting) ? waiting : folder / kResults).at("inputs");
    GradedWith with{.level = sandbox::parseLevel(inputs.at("level").get<int>()),
                    .secretId = inputs.at("secret_id").get<std::string>(),
                    .alone = inputs.value("alone", false)};
    if (inputs.contains("seed")) with.seed = inputs["seed"].get<std::uint64_t>();
    return with;
  } catch (const Json::exception&) {
    return {};
  }
}

bool hasEvidence(const Task& task, const fs::path& out) {
  const fs::path folder = resultFolder(out, task);
  try {
    const Json json = Json::parse(readTextFile(folder / kResults));
    const Json& kept = json.at("volatile");
    if (!kept.value("evidence", false)) return false;
    for (const Json& check : kept.at("checks"))
      for (const char* kind : {"picture", "replay"})
        if (const std::string name = check.value(kind, ""); !name.empty() && !fs::exists(folder / name))
          return false;
    return true;
  } catch (const Json::exception&) {
    return false;
  }
}

grading::GradeResult gradeTask(const Task& task, const submission::Toolchain& toolchain,
                               const submission::ExerciseInfo& exercise, const TaskOptions& options) {
  const fs::path file = options.out / task.file, whole = resultFolder(options.out, task),
                 out = options.workFolder / "out";
  requireInputs(task, file, toolchain, exercise, options);
  fs::create_directories(out);
  const bool keepsEvidence = options.evidence || keptEvidence(whole);
  if (options.pass == grading::Pass::kVisible && awaitsSecondPass(task, options.out, options.secret) &&
      keptEvidence(whole / kVisible) == keepsEvidence)
    return grading::loadResult(whole / kVisible / kResults);  // of a run that was interrupted
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
  const auto sealed = [&] {
    return withInputs(out / kResults, task, keepsEvidence, options.alone, options.secret);
  };
  if (options.pass == grading::Pass::kVisible && awaitsHiddenChecks(result)) {
    publish(out, whole / kVisible, sealed());
    return result;
  }
  const std::optional<int> before = pointsBefore(task, options.out);
  const bool isHeld =
      !options.accept && before && result.outcome != grading::Outcome::kGraderError && result.score < *before;
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
