#pragma once

#include <string>
#include <vector>

#include "authoring/gates.h"
#include "submission/exercise_info.h"
#include "submission/regions.h"

namespace rex::grading {

/// The wrong variants of an exercise in the order of wrong.cpp, composed with the solution; none without that
/// file. Throws Error (file:line:column) like readVariants().
[[nodiscard]] std::vector<WrongVariant> variantsOf(const ExerciseInfo& exercise);

/// Their names, also if wrong.cpp is malformed.
[[nodiscard]] std::vector<std::string> variantNames(const ExerciseInfo& exercise);

/// Throws UsageError unless the exercise has a variant of each of these names.
void requireVariants(const ExerciseInfo& exercise, const std::vector<std::string>& names);

/// Why a variant is not caught as it promises, line by line, when compiled like a student's file and graded
/// by all checks; empty if it is. Throws Error like variantsOf() and requireVariants(), and for checks that
/// do not exist.
[[nodiscard]] std::vector<std::string> whyNotCaught(const GateContext& context, const std::string& name);

/// The results for several variants of an exercise.
struct CaughtTogether {
  std::vector<std::string> complaints;  ///< lines that begin with the name of a variant
  std::vector<std::string> alone;       ///< names of those that were tested with whyNotCaught() instead
};

/// The same for all variants, or those of the context, at a fraction of the cost: JointBuild compiles only
/// functions that differ, and only the checks that a variant names are run. Only whyNotCaught() proves that
/// the whole file compiles, and runs the other checks. Also complains if students read other messages than
/// seen.txt says, or stores them there if the context asks for it. Writes the context's sheet if it has one.
/// Throws Error like variantsOf() and requireVariants().
[[nodiscard]] CaughtTogether whyNotCaughtTogether(const GateContext& context);

}  // namespace rex::grading
