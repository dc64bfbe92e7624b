#pragma once
// What a class handed in, read for `rex grade`: tasks, what is stored for each, and complaints.
//   Graders graders(project);
//   const ClassWork work = readClassWork(project, course, level, graders, out / "tasks.tsv", options);
//   for (const classroom::Task& task : work.run.tasks) graders.of(task.exercise);

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "classroom/course_file.h"
#include "classroom/stored_result.h"
#include "cli/instructor/class_grades.h"
#include "cli/project.h"
#include "sandbox/confinement.h"
#include "submission/submission.h"

namespace rex::cli {

/// The options of `rex grade`.
struct GradeManyOptions {
  std::filesystem::path folder{};  ///< DIR/STUDENT/EXERCISE/main.cpp
  std::filesystem::path out{};
  int jobs = 0;                            ///< parallel gradings; 0: one per processor
  std::optional<sandbox::Level> level{};   ///< empty: the best that holds here
  std::optional<sandbox::Level> accept{};  ///< the lowest level to accept, though too weak for strangers
  std::optional<std::uint64_t> seed{};
  std::filesystem::path secret{};   ///< file; empty: the seed decides hidden checks, too
  std::filesystem::path workers{};  ///< folder that keeps compiled programs; empty: none
  std::string only{};               ///< exercise; empty: all
  std::string student{};            ///< only grade this one; empty: all
  std::set<std::pair<std::string, std::string>> chosen{};  ///< folder and exercise of what that one handed in
  ClassFiles files{};                                      ///< roster, dates and adjustments
  bool acceptFewer = false;           ///< take results of the same text with fewer points, too
  std::filesystem::path submitted{};  ///< CSV file; empty: use the times of the files
  std::filesystem::path
      manifest{};           ///< only write the list of tasks here; empty: grade. Or see task and collect
  int task = 0;             ///< only grade this line, or chunk, of the manifest; 0: all
  int chunk = 1;            ///< lines of a chunk
  bool visible = false;     ///< only grade visible checks of a task or chunk
  bool collect = false;     ///< only make the table
  bool csv = false;         ///< print grades.csv
  bool json = false;        ///< print what was done
  bool complaints = false;  ///< only list the open ones
  std::vector<std::string> explain{};  ///< a student and an exercise: only say how this grade came about
  bool regrade = false;                ///< also submissions that have a valid result
  bool evidence = false;               ///< keep pictures and replays of failed visible checks
  std::string reports{};               ///< see parseReportFormats(): written beside each result
  std::filesystem::path similar{};     ///< folder for pages of similar submissions; empty: none
  int similarPercent = kSimilarPercent;
  std::string forget{},
      forgetBefore{};  ///< only list, or remove, what is kept of this student, before this day
  [[nodiscard]] bool forgets() const { return !forget.empty() || !forgetBefore.empty(); }
};

/// How exercises are graded here, made when the first task asks.
class Graders {
 public:
  explicit Graders(const Project& project) : project_(project) {}

  struct Grader {
    ExerciseInfo exercise;
    submission::Toolchain toolchain;
    std::string sha256;
  };
  /// Throws BuildFailure like prepare().
  const Grader& of(const std::string& name);

 private:
  const Project& project_;
  std::map<std::string, Grader> graders_;
};

/// What a class handed in, and what is stored for it.
struct ClassWork {
  classroom::ClassRun run{};
  std::string only{};                   ///< exercise; empty: all
  int rejected = 0;                     ///< submissions that could not be taken
  std::vector<std::string> notTaken{};  ///< of what was handed in and of the roster
  std::set<std::string> blocked{};      ///< exercises whose grader does not build
  ExitCode taken = ExitCode::kFull;
};

/// Reads the submissions in options.folder, with complaints on standard error. Also writes the list of tasks,
/// and what `rex grade --collect` needs. Throws UsageError if results there were made with other settings.
[[nodiscard]] ClassWork readClassWork(const Project& project, const classroom::Course& course,
                                      sandbox::Level level, Graders& graders,
                                      const std::filesystem::path& manifest, GradeManyOptions& options);

}  // namespace rex::cli
