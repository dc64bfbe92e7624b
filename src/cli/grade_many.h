#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "cli/exit_code.h"
#include "cli/project.h"

/// The commands of the instructor's desk, one source file each: share/doc/grading-many.md.
namespace rex::cli {

struct GradeManyOptions {
  std::filesystem::path folder{};  ///< DIR/STUDENT/EXERCISE/main.cpp
  std::filesystem::path out{};
  int jobs = 0;                 ///< at once; 0: one per processor
  std::optional<int> level{};   ///< of the sandbox; nothing: the best that holds here
  std::optional<int> accept{};  ///< the lowest level, where that is below 2
  std::optional<std::uint64_t> seed{};
  std::filesystem::path secret{};     ///< file; empty: hidden checks take the seed, too
  std::filesystem::path workers{};    ///< folder that keeps compiled programs; empty: none
  std::string only{};                 ///< exercise; empty: all
  std::filesystem::path deadlines{};  ///< TOML file; empty: none
  std::filesystem::path submitted{};  ///< CSV file; empty: times of files count
  std::filesystem::path manifest{};   ///< write the list of tasks here, and grade nothing
  bool csv = false;                   ///< print grades.csv
  bool regrade = false;               ///< also what has a valid result
  bool evidence = false;              ///< keep pictures and replays of visible checks that do not hold
  std::string reports{};              ///< formats of `rex report` to write for each, by commas; empty: none
};
/// Grades what many students handed in. kFull whatever the grades; kNotGradable if something could not be
/// taken, kGraderFault if a grading must be repeated.
ExitCode gradeMany(const Project& project, const GradeManyOptions& options);

struct GradeOneOptions {
  std::filesystem::path manifest{};
  int task = 0;  ///< from 1
  std::filesystem::path out{};
  std::filesystem::path secret{};
  bool evidence = false;
  std::filesystem::path workers{};  ///< folder that keeps compiled programs; empty: none
};
/// Grades one line of a list of tasks, unless it has a valid result. kFull if it has one then.
ExitCode gradeOne(const Project& project, const GradeOneOptions& options);

struct CollectOptions {
  std::filesystem::path out{};
  std::filesystem::path manifest{};
  std::filesystem::path deadlines{};
  bool csv = false;
  std::string reports{};  ///< as above
};
/// Makes grades.csv of all results, and names the tasks to repeat. kGraderFault if there are any.
ExitCode collectResults(const Project& project, const CollectOptions& options);

}  // namespace rex::cli
