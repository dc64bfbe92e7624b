#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "submission/exercise_info.h"
#include "submission/toolchain.h"

namespace rex::grading {

/// The inputs of the gates of one exercise.
struct GateContext {
  std::filesystem::path root;  ///< of the project
  ExerciseInfo exercise;
  Toolchain toolchain;
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

/// The gates of an exercise in order: main-current, points, names, release, evidence, main-floor, solution,
/// sanitizers, hostile, grown, liars, and, if there is wrong.cpp, wrong.
[[nodiscard]] std::vector<std::string> gateNames(const ExerciseInfo& exercise);

/// Runs one gate on the exercise. The gate wrong/NAME tests a single variant by itself, which takes longer
/// and proves more: see whyNotCaughtTogether(). Throws Error for an unknown gate; malformed files of the
/// exercise fail the gate.
[[nodiscard]] GateResult runGate(const GateContext& context, const std::string& gate);

}  // namespace rex::grading
