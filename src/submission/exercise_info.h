#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "grading/limits.h"

namespace rex::grading {

/// One part of an exercise: what a student completes for points.
struct ExercisePart {
  std::string id;
  std::string title;
  int points = 0;
  int floor = 0;                   ///< points that the untouched main.cpp gets
  int lies = 0;                    ///< points that a generic liar may get: see the gate `liars`
  std::vector<std::string> hints;  ///< questions that narrow; the last may be near-code
  /// Where they are given, the part is graded by a worker of its own, for these functions of the student's,
  /// in which `allowed` alone is there.
  std::vector<std::string> functions{}, allowed{};
};

/// A library function that this exercise asks students to write themselves.
struct ForbiddenFunction {
  std::string function;  ///< qualified: "rex::inverseKinematicsStep"; a class forbids its members
  std::string reason;
  std::string part{};  ///< with a worker of its own, in which it is not; empty: it is in none
};

/// When `rex solution` shows the reference solution, where solution.cpp was handed out.
enum class SolutionRule { kNever, kAfterPass, kAlways };

/// What exercise.toml says.
struct ExerciseInfo {
  std::string name;              ///< of the folder: "01-kinematics"
  std::filesystem::path folder;  ///< as it was given
  std::string title;
  std::string script;  ///< section of the course script
  SolutionRule solution = SolutionRule::kNever;
  Limits limits;
  std::vector<ExercisePart> parts;
  std::vector<std::string>
      allowed;  ///< what graded functions may call of the library: see allowedFunctions()
  std::vector<ForbiddenFunction> forbidden;  ///< and may not, although it is allowed; and why
  [[nodiscard]] int points() const;
};

/// Reads folder/exercise.toml. Throws Error (file:line:column) for a missing file, bad syntax, an unknown or
/// missing key, a value of the wrong type or range.
[[nodiscard]] ExerciseInfo readExerciseInfo(const std::filesystem::path& folder);

/// All subfolders that hold an exercise.toml, by name. Throws as readExerciseInfo does.
[[nodiscard]] std::vector<ExerciseInfo> listExercises(const std::filesystem::path& folder);

/// The exercise called "01-kinematics", "01" or "kinematics". Throws Error when none or several match.
[[nodiscard]] const ExerciseInfo& findExercise(const std::vector<ExerciseInfo>& exercises,
                                               std::string_view name);

}  // namespace rex::grading
