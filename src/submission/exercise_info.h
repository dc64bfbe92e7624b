#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "grading/limits.h"

namespace rex::submission {

/// One part of an exercise: what a student completes for points.
struct ExercisePart {
  std::string id;
  std::string title;
  int points = 0;
  int floor = 0;                   ///< points that the untouched main.cpp gets
  bool isCore = true;              ///< no bonus, and no part that a course can leave out
  int lies = 0;                    ///< points that a generic wrong function may get: see the gate `liars`
  std::vector<std::string> hints;  ///< increasingly specific questions; the last may be almost code
  /// If given, the part is graded by its own worker, which serves only these functions of the student and
  /// contains only what `allowed` lists.
  std::vector<std::string> functions{}, allowed{};
};

/// A library function that this exercise asks students to write themselves.
struct ForbiddenFunction {
  std::string function;  ///< qualified: "rex::inverseKinematicsStep"; a class forbids its members
  std::string reason;
  std::string part{};  ///< the part whose own worker lacks it; empty: all workers do
};

/// When `rex show --solution` prints the reference solution, if solution.cpp was handed out.
enum class SolutionRule { kNever, kAfterPass, kAlways };

/// The contents of exercise.toml.
struct ExerciseInfo {
  std::string name;              ///< of the folder: "01-kinematics"
  std::filesystem::path folder;  ///< as given; where students work
  std::filesystem::path
      definition;  ///< the same, or the folder of an installed rex that says what is demanded
  std::string title;
  bool isPrivate = false;          ///< of one lecturer: nothing of the course describes it
  std::string script;              ///< section of the course script; empty only if private
  int chapter = 0;                 ///< of the script; 0: none
  std::vector<std::string> needs;  ///< numbers of the exercises that it builds on: "01"
  int hours = 0;                   ///< of a student's work; 0: not said
  SolutionRule solution = SolutionRule::kNever;
  grading::Limits limits;
  std::vector<ExercisePart> parts;
  std::vector<std::string>
      allowed;  ///< library functions that graded functions may call: see allowedFunctions()
  std::vector<ForbiddenFunction> forbidden;  ///< exceptions from `allowed`, with reasons
  [[nodiscard]] int points() const;
};

/// Reads folder/exercise.toml. Throws Error (file:line:column) for a missing file, bad syntax, an unknown
/// or missing key, and a value of the wrong type or out of range.
[[nodiscard]] ExerciseInfo readExerciseInfo(const std::filesystem::path& folder);

/// The subfolders that hold an exercise.toml, in order; none is read.
[[nodiscard]] std::vector<std::string> exerciseNames(const std::filesystem::path& folder);

/// The exercises of exerciseNames(). Throws like readExerciseInfo does.
[[nodiscard]] std::vector<ExerciseInfo> listExercises(const std::filesystem::path& folder);

/// The exercise named "01-kinematics", "01" or "kinematics". Throws Error if none or several match.
[[nodiscard]] const ExerciseInfo& findExercise(const std::vector<ExerciseInfo>& exercises,
                                               std::string_view name);

}  // namespace rex::submission
