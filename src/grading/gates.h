#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "grading/exercise_info.h"
#include "grading/toolchain.h"

namespace rex::grading {

/// What the gates of one exercise look at.
struct GateContext {
  std::filesystem::path root;  ///< of the project
  ExerciseInfo exercise;
  Toolchain toolchain;
  std::filesystem::path workFolder;  ///< empty and writable
  int seeds = 3;                     ///< to grade the solution with: 1, 2, ...
};

/// Whether an exercise passed a gate, and what to do if not.
struct GateResult {
  bool passed = false;
  std::string message;  ///< lines of text; empty if passed
};

/// The gates of an exercise in order: main-current, points, names, release, evidence, main-floor, solution,
/// sanitizers, and one wrong/NAME for each file in wrong/.
[[nodiscard]] std::vector<std::string> gateNames(const ExerciseInfo& exercise);

/// Passes the exercise through one gate. Throws Error for a gate it does not have; bad input in the
/// exercise's files fails the gate.
[[nodiscard]] GateResult runGate(const GateContext& context, const std::string& gate);

}  // namespace rex::grading
