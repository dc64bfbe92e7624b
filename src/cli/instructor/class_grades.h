#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/exit_code.h"
#include "classroom/class_statistics.h"
#include "classroom/gradebook.h"
#include "classroom/stored_result.h"
#include "classroom/task_list.h"
#include "cli/project.h"
#include "render/figure.h"

namespace rex::cli {

/// The files that turn results into grades.
struct ClassFiles {
  std::filesystem::path course{};       ///< empty: no roster
  std::filesystem::path deadlines{};    ///< instead of a course; empty: none
  std::filesystem::path adjustments{};  ///< empty: those that the course names
  [[nodiscard]] bool hasBook() const { return !course.empty() || !adjustments.empty(); }
};

/// Files beside the results.
inline constexpr const char *kRejectedFile = "not_taken.tsv", *kTotals = "totals.csv",
                            *kStrangers = "not_on_roster.csv", *kRegradedFile = "regraded.csv";

/// The course, or one without a roster. Throws like classroom::readCourse().
[[nodiscard]] classroom::Course readClassCourse(const Project& project, const ClassFiles& files,
                                                classroom::RosterUse roster = classroom::RosterUse::kRead);

/// Says which rows of the roster were not taken, and what names lost. kNotGradable if there is such a row.
[[nodiscard]] ExitCode tellRoster(const classroom::Course& course);

/// The exercises that the course counts, by name; all if it names none.
[[nodiscard]] std::vector<std::string> courseExercises(const Project& project,
                                                       const classroom::Course& course);

/// What makes the grade book of a folder of results, and the book: what was not taken and the table of
/// imports lie in it. `only`: an exercise; empty: all. Throws like the readers of these files.
[[nodiscard]] classroom::GradebookSource readGradebookSource(const Project& project, const ClassFiles& files,
                                                             const classroom::ClassRun& run,
                                                             const std::string& only = {});
[[nodiscard]] classroom::Gradebook readGradebook(const Project& project, const ClassFiles& files,
                                                 const classroom::ClassRun& run);

/// Writes grades.csv, totals.csv and the table of people who are not on the roster, and tells the notes.
void writeBook(const classroom::Gradebook& book, const std::filesystem::path& out, bool print);

struct ExplainOptions {
  std::filesystem::path out{};       ///< the folder of results
  std::filesystem::path manifest{};  ///< the list of tasks; empty: tasks.tsv in it
  ClassFiles files{};
  std::string student{}, exercise{};
  bool json = false;
};
/// Prints how a grade came about. Throws UsageError, with the nearest names, if there is no such row, and
/// like runIn().
ExitCode explainResults(const Project& project, const ExplainOptions& options);

/// Prints each complaint without an answer, the oldest first, with the grade's explanation below. Throws like
/// runIn().
ExitCode listComplaints(const Project& project, const std::filesystem::path& results,
                        const ClassFiles& files);

/// Throws UsageError if one of the folders is in the other one: files written there would be taken for
/// submissions or results. `option` names the first.
void requireApart(const std::string& option, const std::filesystem::path& folder,
                  const std::filesystem::path& other);

/// Throws UsageError, with the nearest names beside it, unless there is such a folder; `wanted` says what
/// should be in it.
void requireFolder(const std::filesystem::path& folder, const std::string& wanted);

/// The list of tasks of a folder of results, also with what is stored for each; `manifest`: another file with
/// it. Throws UsageError if there is no such folder or list, and Error like readManifest().
[[nodiscard]] std::vector<classroom::Task> tasksIn(const std::filesystem::path& results,
                                                   const std::filesystem::path& manifest = {});
[[nodiscard]] classroom::ClassRun runIn(const std::filesystem::path& results,
                                        const std::filesystem::path& manifest = {});

/// The points of every student in each exercise, in percent of the maximum, over the exercise's number
/// ("01-kinematics" is 1; one without a number gets the next after the largest). Equal points are drawn
/// side by side, with a line at each median. Grader errors are left out. Throws Error if nothing is left.
[[nodiscard]] Figure pointsFigure(const std::vector<classroom::StudentResult>& results);

/// A bar for each part, with its name and the mean of its points in percent. Throws Error if there is nothing
/// to draw.
[[nodiscard]] Figure partsFigure(const std::vector<classroom::ExerciseStatistics>& all);

/// How much of each of two submissions the other must have, in percent, to be shown.
inline constexpr int kSimilarPercent = 70;

/// Compares what was handed in to each exercise. Writes folder/EXERCISE.html with the pairs that have at
/// least that percentage in common and no group of the roster, or removes the one of an earlier run if there
/// are none, and folder/EXERCISE/{base,submissions/STUDENT}/main.cpp for other programs that compare. Prints
/// the groups.
void writeSimilar(const Project& project, const classroom::Course& course,
                  const std::vector<classroom::Task>& tasks, const std::filesystem::path& out,
                  const std::filesystem::path& folder, int percent);

}  // namespace rex::cli
