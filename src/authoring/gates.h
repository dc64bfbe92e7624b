#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "submission/exercise_info.h"
#include "submission/toolchain.h"

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
  std::string message{};  ///< lines of text; empty if passed
  std::string note{};     ///< what else is worth a line; empty: nothing
};

/// The gates of an exercise in order: main-current, points, names, release, evidence, main-floor, solution,
/// sanitizers, hostile, liars, and, if there are wrong variants, wrong.
[[nodiscard]] std::vector<std::string> gateNames(const ExerciseInfo& exercise);

/// Passes the exercise through one gate; or a single variant, wrong/NAME, by itself, which takes longer and
/// proves more: see whyNotCaughtTogether(). Throws Error for a gate it does not have; bad input in the
/// exercise's files fails the gate.
[[nodiscard]] GateResult runGate(const GateContext& context, const std::string& gate);

}  // namespace rex::grading
