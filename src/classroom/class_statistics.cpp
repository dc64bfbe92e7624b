#include "classroom/class_statistics.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "classroom/import_table.h"
#include "classroom/task_list.h"

namespace rex::classroom {
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

void readOne(const fs::path& folder, ClassResults& all) {
  const std::string student = folder.parent_path().filename().string(), exercise = folder.filename().string();
  StoredFiles& files = all.files[{student, exercise}] = readStoredFiles(folder);
  const std::string file = (folder / kResults).string();
  if (!files.counts)
    throw Error({.what = "not counted", .where = {file}, .found = "no result", .wanted = "this file"});
  const grading::ResultFile& counts = *files.counts;
  if (!counts.fault.empty())
    all.complaints.push_back(counts.fault);
  else if (counts.result->exerciseId != exercise)
    throw Error({.what = "not counted",
                 .where = {file},
                 .found = fmt::format("a result of '{}'", counts.result->exerciseId),
                 .wanted = fmt::format("one of '{}'", exercise)});
  else
    all.results.push_back({.student = student, .exercise = exercise, .result = *counts.result});
}

std::size_t binOf(int points, int possible) {
  if (points >= possible) return 0;
  if (points <= 0) return 5;
  const int quarters = 4 * points / possible;  // 0 to 3
  return static_cast<std::size_t>(4 - quarters);
}

CheckStatistics& statisticsFor(const grading::CheckResult& check, std::vector<CheckStatistics>& checks) {
  const auto known = std::find_if(checks.begin(), checks.end(),
                                  [&](const CheckStatistics& one) { return one.id == check.id; });
  if (known != checks.end()) return *known;
  checks.push_back({.id = check.id, .part = check.part, .title = check.title, .group = check.group});
  return checks.back();
}

void count(const grading::GradeResult& result, std::vector<CheckStatistics>& checks) {
  for (const grading::CheckResult& check : result.checks) {
    CheckStatistics& known = statisticsFor(check, checks);
    if (check.status == grading::Outcome::kPass) continue;
    ++known.failed;
    ++known.classes[failureClass(check, result)];
    if (const std::string question = askedQuestion(check.message); !question.empty())
      ++known.questions[question];
  }
}

// Points of each part, over the results that have checks of it.
void countParts(const grading::GradeResult& result, std::vector<PartStatistics>& parts) {
  std::vector<PartStatistics> own;
  for (const grading::CheckResult& check : result.checks) {
    auto known =
        std::find_if(own.begin(), own.end(), [&](const PartStatistics& one) { return one.id == check.part; });
    if (known == own.end()) known = own.insert(own.end(), {.id = check.part});
    known->maxPoints += check.maxPoints;
    known->meanPoints += check.points;
  }
  for (const PartStatistics& part : own) {
    auto known = std::find_if(parts.begin(), parts.end(),
                              [&](const PartStatistics& one) { return one.id == part.id; });
    if (known == parts.end()) known = parts.insert(parts.end(), {.id = part.id});
    known->maxPoints = std::max(known->maxPoints, part.maxPoints);
    known->meanPoints += part.meanPoints;  // the sum, until all are counted
    known->full += part.meanPoints >= part.maxPoints ? 1 : 0;
  }
}

// The correlation coefficient of pairs; nothing if either number is the same in all pairs.
std::optional<double> correlationOf(const std::vector<std::pair<double, double>>& pairs) {
  double meanX = 0, meanY = 0, xx = 0, yy = 0, xy = 0;
  const auto n = static_cast<double>(pairs.size());
  for (const auto& [x, y] : pairs) meanX += x / n, meanY += y / n;
  for (const auto& [x, y] : pairs) {
    xx += (x - meanX) * (x - meanX);
    yy += (y - meanY) * (y - meanY);
    xy += (x - meanX) * (y - meanY);
  }
  constexpr double kRounding = 1e-12;
  if (xx <= kRounding || yy <= kRounding) return {};
  return xy / std::sqrt(xx * yy);
}

std::optional<double> discriminationOf(const std::string& check,
                                       const std::vector<const StudentResult*>& results) {
  std::vector<std::pair<double, double>> pairs;
  for (const StudentResult* one : results)
    for (const grading::CheckResult& result : one->result.checks)
      if (result.id == check && one->result.outcome != grading::Outcome::kGraderError)
        pairs.emplace_back(result.points, one->result.score - result.points);
  return correlationOf(pairs);
}

void countAttempts(const std::vector<const StudentResult*>& results, AttemptStatistics& all) {
  std::vector<double> attempts;
  for (const StudentResult* one : results) {
    if (one->attempts == 0) continue;
    ++all.known;
    if (one->attemptsFrom == "imports") ++all.atLeast;
    attempts.push_back(one->attempts);
    if (one->attempts > all.most) std::tie(all.most, all.mostBy) = std::tie(one->attempts, one->student);
  }
  all.median = medianValue(attempts);
}

double hoursOf(std::int64_t seconds) { return static_cast<double>(seconds) / 3600; }

void countWork(const std::vector<const StudentResult*>& results, ExerciseStatistics& all) {
  std::vector<double> whole;
  std::map<std::string, std::vector<double>> parts;
  for (const StudentResult* one : results) {
    if (!one->work) continue;
    whole.push_back(hoursOf(one->work->seconds));
    for (const auto& [part, seconds] : one->work->parts) parts[part].push_back(hoursOf(seconds));
  }
  all.work = {.known = static_cast<int>(whole.size()), .medianHours = medianValue(whole)};
  for (PartStatistics& part : all.parts) {
    part.timed = static_cast<int>(parts[part.id].size());
    part.medianHours = medianValue(parts[part.id]);
  }
}

void noteFull(const StudentResult& one, std::optional<FirstFull>& first) {
  if (one.submitted && (!first || *one.submitted < first->submitted))
    first = FirstFull{one.student, *one.submitted, one.timeFrom};
}

// `results` holds at least one result, all of the same exercise.
ExerciseStatistics statisticsOfOne(const std::vector<const StudentResult*>& results) {
  ExerciseStatistics all{.exercise = results.front()->exercise};
  std::vector<double> points, seconds;
  std::set<std::string> versions;
  for (const StudentResult* one : results) {
    const grading::GradeResult& result = one->result;
    if (result.outcome == grading::Outcome::kGraderError) {
      ++all.graderFailed;
      continue;
    }
    ++all.graded;
    const std::size_t bin = binOf(result.score, result.maxScore);
    ++all.distribution[bin];
    if (bin == 0) ++all.full, noteFull(*one, all.firstFull);
    all.maxPoints = std::max(all.maxPoints, result.maxScore);
    all.meanPoints += result.score;
    points.push_back(result.score);
    // A file that does not compile takes no time.
    if (result.outcome != grading::Outcome::kCompileError) seconds.push_back(result.usage.wallSeconds);
    if (all.slowest.empty() || result.usage.wallSeconds > all.longestSeconds)
      std::tie(all.slowest, all.longestSeconds) = std::tie(one->student, result.usage.wallSeconds);
    versions.insert(result.exerciseVersion);
    count(result, all.checks);
    countParts(result, all.parts);
  }
  all.versions = static_cast<int>(versions.size());
  all.meanPoints /= std::max(1, all.graded);
  for (PartStatistics& part : all.parts) part.meanPoints /= std::max(1, all.graded);
  for (CheckStatistics& check : all.checks) check.discrimination = discriminationOf(check.id, results);
  countAttempts(results, all.attempts);
  countWork(results, all);
  all.medianPoints = medianValue(points);
  all.medianSeconds = medianValue(seconds);
  std::stable_sort(all.checks.begin(), all.checks.end(),
                   [](const CheckStatistics& a, const CheckStatistics& b) { return a.failed > b.failed; });
  return all;
}

// What the list of tasks and the table of imports know. Without them, nothing.
void addHandIns(const fs::path& folder, ClassResults& all) {
  std::map<std::pair<std::string, std::string>, StudentResult*> results;
  for (StudentResult& one : all.results) results[{one.student, one.exercise}] = &one;
  const fs::path tasks = folder / "tasks.tsv";
  for (const Task& task : fs::exists(tasks) ? readManifest(tasks) : std::vector<Task>{})
    if (const auto found = results.find({task.student, task.exercise}); found != results.end())
      found->second->submitted = task.submitted, found->second->timeFrom = task.timeFrom;
  for (const ImportedStudent& student : importTableIn(folder).students)
    for (const auto& [exercise, entry] : student.exercises)
      if (const auto found = results.find({entry.handedInBy, exercise}); found != results.end())
        found->second->attempts = entry.attempts, found->second->attemptsFrom = entry.attemptsFrom,
        found->second->work = entry.work;
}

}  // namespace

std::string askedQuestion(const std::string& message) {
  constexpr std::string_view kAfterInput = "). ";
  const std::size_t end = message.rfind(kAfterInput);
  const std::string rest = end == message.npos ? "" : message.substr(end + kAfterInput.size());
  return rest.find('?') == rest.npos ? "" : rest;
}

double medianValue(std::vector<double> values) {
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
          readOne(exercise, all);
        } catch (const Error& error) {
          all.complaints.emplace_back(error.what());
        }
      }
    } catch (const Error& error) {
      all.complaints.emplace_back(error.what());
    }
  }
  try {
    addHandIns(folder, all);
  } catch (const Error& error) {
    all.complaints.emplace_back(error.what());
  }
  std::stable_sort(all.results.begin(), all.results.end(),
                   [](const StudentResult& a, const StudentResult& b) { return a.exercise < b.exercise; });
  return all;
}

ClassRun runOf(const std::vector<Task>& tasks, const fs::path& folder, const ClassResults& read) {
  ClassRun run{.out = folder};
  for (const Task& task : tasks) {
    const auto known = read.files.find({task.student, task.exercise});
    run.add(task, known != read.files.end() ? known->second : readStoredFiles(resultFolder(folder, task)));
  }
  return run;
}

std::string failureClass(const grading::CheckResult& check, const grading::GradeResult& whole) {
  if (!check.status) return whole.outcome == grading::Outcome::kCompileError ? "compile" : "not run";
  switch (*check.status) {
    case grading::Outcome::kCompileError:
      return "compile";
    case grading::Outcome::kRuntimeError:
      return "crash";
    case grading::Outcome::kTimeLimit:
      return "timeout";
    case grading::Outcome::kMemoryLimit:
      return "memory";
    case grading::Outcome::kOutputLimit:
      return "output";
    case grading::Outcome::kProtocolError:
      return "protocol";
    case grading::Outcome::kSecurityEvent:
      return "security";
    case grading::Outcome::kGraderError:
      return "not run";
    case grading::Outcome::kFail:
    case grading::Outcome::kPass:
      if (check.message.find(check.property + ": not finite") != std::string::npos) return "non-finite";
      return check.message.find(check.property + ": wrong shape") != std::string::npos ? "shape" : "wrong";
  }
  return "";
}

ClassResults resultsByPerson(const ClassResults& read, const Gradebook& book) {
  ClassResults people{.complaints = read.complaints};
  const auto wholePoints = [](std::int64_t hundredths) {
    return static_cast<int>(std::lround(static_cast<double>(hundredths) / 100));
  };
  for (const GradeRow& row : book.rows) {
    const auto found = std::ranges::find_if(read.results, [&](const StudentResult& one) {
      return one.student == row.handedInAs && one.exercise == row.exercise;
    });
    if (!row.result || found == read.results.end()) continue;
    StudentResult one = *found;
    one.student = row.student.id;
    for (const AppliedAdjustment& by : row.applied)
      for (grading::CheckResult& check : one.result.checks) {
        if (by.adjustment.check != check.id) continue;
        check.points = wholePoints(by.after);
        if (check.points == check.maxPoints) check.status = grading::Outcome::kPass;
      }
    std::erase_if(one.result.checks,
                  [&](const grading::CheckResult& check) { return !row.worth.counts(check.part); });
    one.result.score = wholePoints(row.points), one.result.maxScore = wholePoints(row.possible);
    people.results.push_back(std::move(one));
  }
  std::ranges::stable_sort(people.results, {},
                           [](const StudentResult& one) { return std::tie(one.exercise, one.student); });
  return people;
}

std::vector<ExerciseStatistics> exerciseStatistics(const std::vector<StudentResult>& results) {
  std::map<std::string, std::vector<const StudentResult*>> byExercise;
  for (const StudentResult& one : results) byExercise[one.exercise].push_back(&one);
  std::vector<ExerciseStatistics> all;
  for (const auto& [exercise, some] : byExercise) all.push_back(statisticsOfOne(some));
  return all;
}

}  // namespace rex::classroom
