#pragma once

#include <string>
#include <vector>

#include "authoring/gates.h"
#include "submission/exercise_info.h"
#include "submission/regions.h"

namespace rex::grading {

/// The wrong variants of an exercise as "wrong/NAME", in order.
[[nodiscard]] std::vector<std::string> variantNames(const ExerciseInfo& exercise);

/// One of them in place of the solution. Throws Error (file:line) for what composeVariant() refuses.
[[nodiscard]] WrongVariant variantOf(const ExerciseInfo& exercise, const std::string& name);

/// What keeps a variant from being caught as it promises, line by line: compiled as a student's whole file
/// is, and graded by all checks. Throws Error as variantOf(), and for checks that there are not.
[[nodiscard]] std::vector<std::string> whyNotCaught(const GateContext& context, const std::string& name);

/// What became of all variants of an exercise.
struct CaughtTogether {
  std::vector<std::string> complaints;  ///< lines that begin with the name of a variant
  std::vector<std::string> alone;       ///< the names of those that went the long way of whyNotCaught()
};

/// The same at a small part of the cost: JointBuild compiles only functions that differ, and only checks run
/// that a variant names. That its whole file compiles, and what the others say, whyNotCaught() alone proves.
[[nodiscard]] CaughtTogether whyNotCaughtTogether(const GateContext& context);

}  // namespace rex::grading
