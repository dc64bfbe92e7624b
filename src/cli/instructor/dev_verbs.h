#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/exit_code.h"
#include "cli/project.h"
#include "sandbox/cell.h"

/// The verbs of `rex dev`, one file each. They print for people. They throw UsageError for names that do
/// not exist, and Error if the project or the machine is broken.

namespace rex::cli {

/// Throws UsageError if this rex is installed: `command` works on the files that a course is made from.
void requireSourceTree(const Project& project, const std::string& command);

/// Makes a new exercise: for the exercise.h `header`, or the template if that is empty.
ExitCode devNew(const Project& project, const std::string& name, const std::filesystem::path& header);

struct CheckOptions {
  std::string exercise{};               ///< empty: all
  std::vector<std::string> gates{};     ///< empty: all
  std::vector<std::string> variants{};  ///< the only ones that gate wrong tests; empty: all
  bool listGates = false;
  bool json = false;
  std::filesystem::path sheet{};  ///< a .png for the pictures of wrong variants; empty: none
  int runs = 3;                   ///< of the solution, each with the next seed
};
/// Runs the gates that exercises must pass; a bad exercise.toml counts as a gate that is not passed. Returns
/// kBelow if one is not, kGraderFault if a grader does not build; the other exercises are still tested.
ExitCode devCheck(const Project& project, const CheckOptions& options);

struct VivaOptions {
  std::string exercise{};
  std::filesystem::path file{};  ///< that was handed in
  std::optional<sandbox::Level> level{};
};
/// Prints questions about a person's own file, with answers. Returns kBelow if there are fewer than three.
ExitCode devViva(const Project& project, const VivaOptions& options);

/// Makes main.cpp of that exercise from its solution.cpp.
ExitCode devStrip(const Project& project, const std::string& name);

struct ReleaseOptions {
  std::filesystem::path out{};        ///< new folder
  std::vector<std::string> only{};    ///< these exercises; empty: all
  std::filesystem::path course{};     ///< those of this course file, which has the openings; empty: all
  std::string until{};                ///< those whose opening is not after this time; empty: all
  std::filesystem::path deadlines{};  ///< the file with the openings
  std::filesystem::path scan{};       ///< only scan this tree, and write nothing
  bool installed = false;             ///< what is scanned was installed: see authoring::TreeKind
  std::filesystem::path secret{};     ///< file with the secret of the course; empty: none
  bool prove = false;                 ///< see proveRelease()
  std::filesystem::path proveIn{};    ///< the same, in this folder, which is kept
  bool json = false;
};
/// Writes the tree that packages for students are built from, and prints what it contains. Returns kBelow,
/// without writing anything, if anything leaks.
ExitCode devRelease(const Project& project, const ReleaseOptions& options);

struct BenchOptions {
  std::vector<std::string> names{};  ///< groups; empty: all
  bool json = false;
  std::string report{};
};
/// Runs the benchmarks. Throws Error if they are not built or were ended by a signal.
ExitCode devBench(const Project& project, const BenchOptions& options);

struct SiteOptions {
  std::filesystem::path out{};     ///< new folder
  std::filesystem::path secret{};  ///< file with the secret of the course; empty: none
  std::filesystem::path course{};  ///< course file: its exercises alone, its title and dates; empty: all
  bool notes = false;
  bool json = false;
};
/// Writes the pages of the course. Returns kBelow, without writing anything, if anything leaks.
ExitCode devSite(const Project& project, const SiteOptions& options);

struct StatsOptions {
  std::filesystem::path results{};    ///< folder that `rex grade` wrote
  std::filesystem::path figure{};     ///< the points of each exercise, .png or .svg; empty: none
  std::filesystem::path parts{};      ///< the points of each part, likewise
  std::filesystem::path deadlines{};  ///< a file of deadlines or course file; empty: none
  std::filesystem::path course{};     ///< a course file, to count its people; empty: count folders
  bool json = false;
  bool csv = false;       ///< a table of the checks
  bool students = false;  ///< a table of the students
};
/// Prints the results of a class, per exercise and check. Returns kNotGradable if a result cannot be read or
/// was changed after the grading.
ExitCode devStats(const Project& project, const StatsOptions& options);

/// Builds a copy of a student release from scratch in the new folder `in`, which is kept, or, if that is
/// empty, in a temporary one with a blank in its name. Each untouched main.cpp must get less than the full
/// score, run without a display, and write a picture. Takes minutes. Throws Error with the failed step and
/// the end of its output.
void proveRelease(const std::filesystem::path& release, const std::filesystem::path& in);

}  // namespace rex::cli
