#include "classroom/class_statistics.h"

#include <algorithm>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "base/error.h"
#include "grading/result_file.h"

namespace rex::grading {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> foldersIn(const fs::path& folder) {
  std::vector<fs::path> folders;
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end; entry.increment(failure))
    if (entry->is_directory() && !entry->is_symlink()) folders.push_back(entry->path());
  if (failure)
    throw Error({.what = "cannot read this folder", .where = {folder.string()}, .found = failure.message()});
  std::sort(folders.begin(), folders.end());
  return folders;
}

StudentResult readOne(const fs::path& folder) {
  const fs::path file = folder / "results.json";
  if (!fs::exists(file))
    throw Error(
        {.what = "not counted", .where = {file.string()}, .found = "no result", .wanted = "this file"});
  StudentResult read{.student = folder.parent_path().filename().string(),
                     .exercise = folder.filename().string(),
                     .result = loadResult(file)};
  if (read.result.exerciseId != read.exercise)
    throw Error({.what = "not counted",
                 .where = {file.string()},
                 .found = fmt::format("a result of '{}'", read.result.exerciseId),
                 .wanted = fmt::format("one of '{}'", read.exercise)});
  return read;
}

std::size_t binOf(int points, int possible) {
  if (points >= possible) return 0;
  if (points <= 0) return 5;
  const int quarters = 4 * points / possible;  // 0 to 3
  return static_cast<std::size_t>(4 - quarters);
}

void count(const GradeResult& result, std::vector<CheckStatistics>& checks) {
  for (const CheckResult& check : result.checks) {
    auto known = std::find_if(checks.begin(), checks.end(),
                              [&](const CheckStatistics& one) { return one.id == check.id; });
    if (known == checks.end())
      known = checks.insert(checks.end(), {.id = check.id, .title = check.title, .group = check.group});
    if (check.status == Outcome::kPass) continue;
    ++known->failed;
    ++known->classes[classOf(check, result)];
  }
}

// `results` holds at least one result, all of the same exercise.
ExerciseStatistics statisticsOfOne(const std::vector<const StudentResult*>& results) {
  ExerciseStatistics all{.exercise = results.front()->exercise};
  std::vector<double> points, seconds;
  std::set<std::string> versions;
  for (const StudentResult* one : results) {
    const GradeResult& result = one->result;
    if (result.outcome == Outcome::kGraderError) {
      ++all.graderFailed;
      continue;
    }
    ++all.graded;
    const std::size_t bin = binOf(result.score, result.maxScore);
    ++all.distribution[bin];
    if (bin == 0) ++all.full;
    all.maxPoints = std::max(all.maxPoints, result.maxScore);
    all.meanPoints += result.score;
    points.push_back(result.score);
    // A file that does not compile takes no time.
    if (result.outcome != Outcome::kCompileError) seconds.push_back(result.usage.wallSeconds);
    if (all.slowest.empty() || result.usage.wallSeconds > all.longestSeconds)
      std::tie(all.slowest, all.longestSeconds) = std::tie(one->student, result.usage.wallSeconds);
    versions.insert(result.exerciseVersion);
    count(result, all.checks);
  }
  all.versions = static_cast<int>(versions.size());
  all.meanPoints /= std::max(1, all.graded);
  all.medianPoints = medianOf(points);
  all.medianSeconds = medianOf(seconds);
  std::stable_sort(all.checks.begin(), all.checks.end(),
                   [](const CheckStatistics& a, const CheckStatistics& b) { return a.failed > b.failed; });
  return all;
}

}  // namespace

double medianOf(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

ClassResults readClassResults(const fs::path& folder) {
  ClassResults all;
  for (const fs::path& student : foldersIn(folder)) {
    try {
      for (const fs::path& exercise : foldersIn(student)) {
        try {
          all.results.push_back(readOne(exercise));
        } catch (const Error& error) {
          all.complaints.emplace_back(error.what());
        }
      }
    } catch (const Error& error) {
      all.complaints.emplace_back(error.what());
    }
  }
  std::stable_sort(all.results.begin(), all.results.end(),
                   [](const StudentResult& a, const StudentResult& b) { return a.exercise < b.exercise; });
  return all;
}

std::string classOf(const CheckResult& check, const GradeResult& whole) {
  if (!check.status) return whole.outcome == Outcome::kCompileError ? "compile" : "not run";
  switch (*check.status) {
    case Outcome::kCompileError:
      return "compile";
    case Outcome::kRuntimeError:
      return "crash";
    case Outcome::kTimeLimit:
      return "timeout";
    case Outcome::kMemoryLimit:
      return "memory";
    case Outcome::kOutputLimit:
      return "output";
    case Outcome::kProtocolError:
      return "protocol";
    case Outcome::kSecurityEvent:
      return "security";
    case Outcome::kGraderError:
      return "not run";
    case Outcome::kFail:
    case Outcome::kPass:
      if (check.message.find(check.property + ": not finite") != std::string::npos) return "non-finite";
      return check.message.find(check.property + ": wrong shape") != std::string::npos ? "shape" : "wrong";
  }
  return "";
}

std::vector<ExerciseStatistics> statisticsOf(const std::vector<StudentResult>& results) {
  std::map<std::string, std::vector<const StudentResult*>> byExercise;
  for (const StudentResult& one : results) byExercise[one.exercise].push_back(&one);
  std::vector<ExerciseStatistics> all;
  for (const auto& [exercise, some] : byExercise) all.push_back(statisticsOfOne(some));
  return all;
}

}  // namespace rex::grading
