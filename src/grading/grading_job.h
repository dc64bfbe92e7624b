#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "grading/limits.h"
#include "sandbox/cell.h"

namespace CLI {
class App;
}

namespace rex::grading {

/// Which checks a run of a grader program takes on. What runs beside a hidden check might learn from it, so a
/// class gets its hidden checks in a second run of each grader, which continues the results of the first.
enum class Pass : int { kWhole = 0, kVisible = 1, kHidden = 2 };

/// What one run of a grader program is asked to do. It is passed as a whole from the command line of `rex`
/// to the launch of each worker.
struct GradingJob {
  std::filesystem::path worker{};     ///< see workerProgram(); empty: all checks are listed as not run
  std::vector<std::string> parts{};   ///< of the exercise, with workers of their own
  std::filesystem::path control{};    ///< see slownessOfMachine(); empty: lost time is the file's fault
  std::filesystem::path results{};    ///< results.json; its fields about the submission are kept; empty: none
  std::vector<std::string> checks{};  ///< ids, in the order to run them; empty: all
  Pass pass = Pass::kWhole;           ///< a whole grading runs the hidden checks last
  std::uint64_t seed = 1;
  Limits limits{};
  sandbox::Sandbox sandbox{};
  std::vector<std::filesystem::path> libraries{};  ///< loaded by the worker, besides those of the system
  std::filesystem::path temporaryFolder = "/tmp";  ///< workers get their working folders in it
  std::filesystem::path evidence{};  ///< folder for pictures of failed visible checks; empty: none
  std::filesystem::path
      secret{};  ///< file with the secret of the course; empty: hidden checks use `seed`, too
  std::filesystem::path mistakes{};  ///< KnownMistakes, whose questions are asked; empty: none are known
  std::filesystem::path
      sketches{};  ///< where to write the SketchedChecks of the visible checks; empty: nowhere
  int jobs = 1;    ///< checks that run at once, each in a copy of the grader
};

/// The options of a grader program, which set the job.
void declareOptions(CLI::App& app, GradingJob& job);

/// The command-line arguments that give a grader program this job.
[[nodiscard]] std::vector<std::string> toArguments(const GradingJob& job);

/// The program that answers the checks of a part: WORKER.PART if the part has a worker of its own, in which
/// less of the library may be called, else WORKER. Whether it exists is not looked at.
[[nodiscard]] std::filesystem::path workerProgram(const std::string& part, const GradingJob& job);

}  // namespace rex::grading
