#include "classroom/submission_times.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/instant.h"
#include "base/join.h"
#include "base/text_file.h"
#include "classroom/csv.h"

namespace rex::grading {
namespace {

constexpr std::size_t kAbsent = static_cast<std::size_t>(-1);

std::size_t columnOf(const CsvRow& headings, const std::string& name) {
  const auto found = std::find(headings.fields.begin(), headings.fields.end(), name);
  return found == headings.fields.end() ? kAbsent : static_cast<std::size_t>(found - headings.fields.begin());
}

}  // namespace

SubmissionTimes::SubmissionTimes(const std::filesystem::path& file,
                                 const std::vector<ExerciseInfo>& exercises) {
  const auto fail = [&](int line, std::string what, std::string found, std::string wanted) {
    return Error({.what = std::move(what),
                  .where = {file.string(), line, 0},
                  .found = std::move(found),
                  .wanted = std::move(wanted)});
  };
  const std::vector<CsvRow> rows = parseCsv(readTextFile(file), file.string());
  const CsvRow headings = rows.empty() ? CsvRow{} : rows.front();
  const std::size_t student = columnOf(headings, "student"), submitted = columnOf(headings, "submitted"),
                    exercise = columnOf(headings, "exercise");
  if (student == kAbsent || submitted == kAbsent)
    throw fail(1, "no submission times", fmt::format("the columns {}", join(headings.fields, ", ")),
               "student and submitted, and exercise if they differ");
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const auto& [line, fields] = rows[k];
    if (fields.size() != headings.fields.size())
      throw fail(line, "a broken row of submission times", fmt::format("{} fields", fields.size()),
                 fmt::format("{}", headings.fields.size()));
    if (fields[submitted].empty()) continue;
    const auto time = parseInstant(fields[submitted]);
    if (!time)
      throw fail(line, "not a time", "'" + fields[submitted] + "'",
                 "a time with its zone, such as 2026-11-20T23:59:00+01:00");
    std::string name;
    try {
      if (exercise != kAbsent && !fields[exercise].empty())
        name = findExercise(exercises, fields[exercise]).name;
    } catch (const Error& error) {
      throw fail(line, error.parts().what, "", error.parts().wanted);
    }
    if (!times_.emplace(std::pair(fields[student], name), *time).second)
      throw fail(line, "a second time for the same submission", "'" + fields[student] + "' again", "one row");
  }
}

std::optional<std::int64_t> SubmissionTimes::of(const std::string& student,
                                                const std::string& exercise) const {
  for (const std::string& name : {exercise, std::string()})
    if (const auto found = times_.find({student, name}); found != times_.end()) return found->second;
  return std::nullopt;
}

}  // namespace rex::grading
