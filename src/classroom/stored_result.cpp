#include "classroom/stored_result.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text_file.h"
#include "grading/hidden_seed.h"
#include "reports/report.h"

namespace rex::classroom {

namespace fs = std::filesystem;

namespace {

// By the file alone.
std::string faultOf(const grading::ResultFile& read, const fs::path& file, const Task& task) {
  if (!read.fault.empty() || read.result->exerciseId == task.exercise) return read.fault;
  return Error({.what = "a result of another exercise",
                .where = {file.string()},
                .found = "'" + read.result->exerciseId + "'",
                .wanted = "'" + task.exercise + "'"})
      .what();
}

bool isFailed(const grading::ResultFile& read) {
  return read.result && read.result->outcome == grading::Outcome::kGraderError;
}

TaskState stateOf(const grading::ResultFile& read, const fs::path& file, const Task& task, bool isHeld) {
  if (read.inputs.sha256 != task.inputsSha256() && !isHeld) return TaskState::kStale;
  if (isFailed(read)) return TaskState::kFailed;
  return faultOf(read, file, task).empty() ? TaskState::kDone : TaskState::kRefused;
}

bool existAll(const grading::GradeResult& result, const fs::path& folder) {
  return std::ranges::all_of(result.checks, [&](const grading::CheckResult& check) {
    return (check.picture.empty() || fs::exists(folder / check.picture)) &&
           (check.replay.empty() || fs::exists(folder / check.replay));
  });
}

StoredResult judge(StoredFiles files, const Task& task, const fs::path& folder, std::string_view secret) {
  StoredResult stored{.with = files.with()};
  if (!files.counts) return stored;
  grading::ResultFile& counts = *files.counts;
  const fs::path file = folder / kResults;
  const bool isSameText = counts.inputs.sourceSha256 == task.sourceSha256;
  if (isSameText && files.waits && files.waits->result && files.waits->inputs.sha256 == task.inputsSha256())
    stored.waiting = files.waits->result->score;
  stored.state = stateOf(counts, file, task, stored.waiting.has_value());
  stored.why = whyRefused(counts, file, task, secret);
  if (isSameText && !isFailed(counts) && faultOf(counts, file, task).empty())
    stored.before = counts.result->score;
  stored.evidence = counts.inputs.evidence;
  stored.hasEvidence = stored.evidence && counts.result && existAll(*counts.result, folder);
  stored.result = std::move(counts.result);
  return stored;
}

}  // namespace

std::optional<int> StoredResult::now() const {
  return waiting ? waiting : state == TaskState::kDone ? before : std::nullopt;
}

std::optional<grading::GradedWith> StoredFiles::with() const {
  const std::optional<grading::ResultFile>& last = waits ? waits : counts;
  return last ? last->inputs.with : std::nullopt;
}

void ClassRun::add(Task task, StoredFiles files) {
  stored.push_back(judge(std::move(files), task, resultFolder(out, task), secret));
  tasks.push_back(std::move(task));
}

void ClassRun::readAgain(std::size_t task) { stored[task] = readStored(tasks[task], out, secret); }

ClassRun readClassRun(const std::vector<Task>& tasks, const fs::path& out, const fs::path& secret) {
  ClassRun run{.out = out, .secret = classSecret(secret)};
  for (const Task& task : tasks) run.add(task, readStoredFiles(resultFolder(out, task)));
  return run;
}

std::string classSecret(const fs::path& file) { return file.empty() ? "" : grading::readCourseSecret(file); }

fs::path resultFolder(const fs::path& out, const Task& task) { return out / task.student / task.exercise; }

StoredFiles readStoredFiles(const fs::path& folder) {
  return {grading::readResultFile(folder / kResults), grading::readResultFile(folder / kRegraded / kResults)};
}

StoredResult readStored(const Task& task, const fs::path& out, std::string_view secret) {
  const fs::path folder = resultFolder(out, task);
  return judge(readStoredFiles(folder), task, folder, secret);
}

std::string whyRefused(const grading::ResultFile& read, const fs::path& file, const Task& task,
                       std::string_view secret) {
  const std::string fault = faultOf(read, file, task), &hmac = read.inputs.hmac;
  if (!fault.empty() || secret.empty() || hmac == resultHmac(read.inputs, task, secret)) return fault;
  return Error({.what = "a result that was not written with the secret of the course",
                .where = {file.string()},
                .found = hmac.empty() ? "no result_hmac" : "another result_hmac"})
      .what();
}

std::string resultHmac(const grading::ResultInputs& inputs, const Task& task, std::string_view secret) {
  return grading::hmacSha256(secret, fmt::format("{}\n{}\n{}\n", task.student, inputs.sha256, inputs.seal));
}

void removeReports(const fs::path& folder) {
  for (const reports::ReportFormat& format : reports::reportFormats()) fs::remove(folder / format.file);
}

void acceptRegradings(ClassRun& run) {
  for (std::size_t k = 0; k < run.tasks.size(); ++k) {
    const fs::path folder = resultFolder(run.out, run.tasks[k]), regraded = folder / kRegraded;
    if (run.stored[k].waiting) {
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
    if (run.stored[k].waiting) run.readAgain(k);
  }
}

}  // namespace rex::classroom
