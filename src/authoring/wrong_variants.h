#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "authoring/gates.h"
#include "submission/exercise_info.h"
#include "submission/regions.h"
#include "submission/student_build.h"
#include "submission/submission.h"

namespace rex::authoring {

/// Joins the wrong variants of a file into one source, so that headers and common code are compiled only
/// once: the reference with an empty main(), and after each function the variants' versions that differ.
/// Function f() of variant 2 is named variant_2_f(), and the linker can substitute it for f(), about which
/// callers assume nothing.
class JoinedVariants {
 public:
  /// All arguments are whole files. A variant is left out if it equals the reference or differs in more
  /// than the bodies of functions that other files may call.
  JoinedVariants(std::string_view reference, const std::vector<std::string>& variants);

  const std::string& source() const { return source_; }
  /// The number of functions of a variant; 0 if it is left out.
  std::size_t functions(std::size_t variant) const { return functions_[variant]; }
  /// The variant whose function contains a line, from 1, of the source; the number of variants if there is
  /// none.
  std::size_t variantAt(int line) const;

 private:
  struct Place {
    int first, last;  // lines
    std::size_t variant;
  };
  std::string source_;
  std::vector<std::size_t> functions_;
  std::vector<Place> places_;
};

/// A function that replaces another; both are linker names.
struct StandIn {
  std::string own, replaced;
};

/// The replacements of a variant among the global symbols of the compiled source.
[[nodiscard]] std::vector<StandIn> standIns(const std::vector<std::string>& symbols, std::size_t variant);

/// Compiles the wrong variants of an exercise together as JoinedVariants, and links them one by one.
class JointBuild {
 public:
  /// Compiles, in the context's work folder, as many of the variants as compile together. Throws Error if
  /// the tools fail.
  JointBuild(const GateContext& context, const std::string& reference, std::vector<std::string> variants);

  /// Whether a variant was compiled, so that its functions can replace those of the reference.
  bool holds(std::size_t variant) const;

  /// What the compiler says first if it compiles none of them; empty if it does.
  std::string complaint() const;

  /// The worker of a compiled variant, or the forbidden calls of its functions, as buildSubmission() would
  /// report for the whole file. The next call overwrites the worker. Throws Error if the tools fail.
  submission::BuiltSubmission link(std::size_t variant) const;

  /// The worker of the reference, for as long.
  submission::BuiltSubmission linkReference() const;

 private:
  std::vector<std::size_t> compile(const std::string& reference);
  std::vector<std::string> symbols() const;
  std::vector<grading::CompileDiagnostic> forbiddenCalls(std::size_t variant) const;
  submission::BuiltSubmission linkWith(const std::vector<StandIn>& functions,
                                       submission::BuiltSubmission built) const;

  GateContext context_;
  std::vector<std::string> sources_;  // of each variant
  std::filesystem::path folder_;
  submission::StudentObject object_;
  std::vector<std::vector<StandIn>> functions_;  // of each variant; none if it is not there
};

/// The wrong variants of an exercise in the order of wrong.cpp, composed with the solution; none without that
/// file. Throws Error (file:line:column) like readVariants().
[[nodiscard]] std::vector<submission::WrongVariant> exerciseVariants(
    const submission::ExerciseInfo& exercise);

/// Their names, also if wrong.cpp is malformed.
[[nodiscard]] std::vector<std::string> variantNames(const submission::ExerciseInfo& exercise);

/// Throws UsageError unless the exercise has a variant of each of these names.
void requireVariants(const submission::ExerciseInfo& exercise, const std::vector<std::string>& names);

/// Why a variant is not caught as it promises, line by line, when compiled like a student's file and graded
/// by all checks; empty if it is. Throws Error like exerciseVariants() and requireVariants(), and for checks
/// that do not exist.
[[nodiscard]] std::vector<std::string> whyNotCaught(const GateContext& context, const std::string& name);

/// The results for several variants of an exercise.
struct CaughtTogether {
  std::vector<std::string> complaints;  ///< lines that begin with the name of a variant
  std::vector<std::string> alone;       ///< names of those that were tested with whyNotCaught() instead
  std::size_t asked = 0;                ///< variants whose question their first message asks
};

/// The same for all variants, or those of the context, at a fraction of the cost: JointBuild compiles only
/// functions that differ, and only the checks that a variant names are run. Only whyNotCaught() proves that
/// the whole file compiles, and runs the other checks. Also complains if students read other messages than
/// seen.txt says, and, if variants have questions and all are tested, if other mistakes than those of
/// knownMistakesFile() are known or a question is never asked; or stores both if the context asks for it.
/// Writes the context's sheet if it has one. Throws Error like exerciseVariants() and requireVariants().
[[nodiscard]] CaughtTogether whyNotCaughtTogether(const GateContext& context);

}  // namespace rex::authoring
