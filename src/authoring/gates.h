#pragma once
// The gates that an exercise passes before it is published, and the search for names that do not exist.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "submission/build_tools.h"
#include "submission/exercise_info.h"

namespace rex::authoring {

/// A name that does not exist.
struct DeadName {
  SourceLocation where;
  std::string name;
  std::vector<std::string> nearest;
};

/// Names in backticks in an exercise's README.md and in the TODO lines of its solution.cpp that do not
/// exist: neither as a file of the exercise or project, nor as a word of code in exercise.h, main.cpp,
/// show.h, show.cpp or a header below root/src. Formulas, numbers, paths in out/ and names in std:: and
/// Eigen:: are ignored. Also functions that exercise.toml forbids but that occur in no header below
/// root/src.
[[nodiscard]] std::vector<DeadName> deadNames(const std::filesystem::path& root,
                                              const std::filesystem::path& exercise);

/// The inputs of the gates of one exercise.
struct GateContext {
  std::filesystem::path root;  ///< of the project
  submission::ExerciseInfo exercise;
  submission::Toolchain toolchain;   ///< not for comparesTexts()
  std::filesystem::path workFolder;  ///< empty and writable
  int seeds = 3;                     ///< number of seeds to grade the solution with: 1, 2, ...
  std::filesystem::path sheet{};     ///< where gate wrong puts the pictures of failed checks; empty: nowhere
  int hostileAnswers = 3000;         ///< that gate hostile gives instead of the student's
  std::vector<std::string> variants{};  ///< the only ones that gate wrong tests; empty: all
  bool storesMessages = false;          ///< whether gate wrong rewrites seen.txt
};

/// Whether an exercise passed a gate, and what to do if not.
struct GateResult {
  bool passed = false;
  std::string message{};  ///< lines of text; empty if passed
  std::string note{};     ///< another remark of one line; empty: none
};

/// The gates of an exercise in order: first those that compare texts, main-current, names, release and
/// handed-out, then points, evidence, main-floor, mains, solution, sanitizers, hostile, grown, liars, pasted,
/// mutants, and, if there is wrong.cpp, wrong. A private exercise has neither handed-out nor evidence.
[[nodiscard]] std::vector<std::string> gateNames(const submission::ExerciseInfo& exercise);

/// Whether a gate compares texts only, so that it needs no toolchain.
[[nodiscard]] bool comparesTexts(const std::string& gate);

/// Throws UsageError if the exercise has no such gate, be it one of gateNames() or wrong/NAME.
void requireGate(const submission::ExerciseInfo& exercise, const std::string& gate);

/// Runs one gate on the exercise. The gate wrong/NAME tests a single variant by itself, which takes longer
/// and proves more: see whyNotCaughtTogether(). Throws as requireGate(); malformed files of the
/// exercise fail the gate.
[[nodiscard]] GateResult runGate(const GateContext& context, const std::string& gate);

}  // namespace rex::authoring
