#include "classroom/submission_times.h"

#include "base/error.h"
#include "base/instant.h"
#include "classroom/csv.h"

namespace rex::grading {

SubmissionTimes::SubmissionTimes(const std::filesystem::path& file,
                                 const std::vector<ExerciseInfo>& exercises) {
  const CsvTable table(file, "a table of submission times");
  table.require({"student"}), table.require({"submitted"});
  table.requireWholeRows();
  for (std::size_t k = 0; k < table.size(); ++k) {
    const auto fail = [&](std::string what, std::string found, std::string wanted) {
      return Error({.what = std::move(what),
                    .where = {table.place(k)},
                    .found = std::move(found),
                    .wanted = std::move(wanted)});
    };
    const std::string student = table.text(k, {"student"}), submitted = table.text(k, {"submitted"}),
                      exercise = table.text(k, {"exercise"});
    if (submitted.empty()) continue;
    const auto time = parseInstant(submitted);
    if (!time)
      throw fail("not a time", "'" + submitted + "'",
                 "a time with its zone, such as 2026-11-20T23:59:00+01:00");
    std::string name;
    try {
      if (!exercise.empty()) name = findExercise(exercises, exercise).name;
    } catch (const Error& error) {
      throw fail(error.parts().what, "", error.parts().wanted);
    }
    if (!times_.emplace(std::pair(student, name), *time).second)
      throw fail("a second time for the same submission", "'" + student + "' again", "one row");
  }
}

std::optional<std::int64_t> SubmissionTimes::of(const std::string& student,
                                                const std::string& exercise) const {
  for (const std::string& name : {exercise, std::string()})
    if (const auto found = times_.find({student, name}); found != times_.end()) return found->second;
  return std::nullopt;
}

}  // namespace rex::grading
