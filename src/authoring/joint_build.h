#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "authoring/gates.h"
#include "authoring/joined_variants.h"
#include "submission/student_build.h"
#include "submission/submission.h"

namespace rex::grading {

/// Compiles the wrong variants of an exercise together as JoinedVariants, and links them one by one.
class JointBuild {
 public:
  /// Compiles, in the context's work folder, as many of the variants as compile together. Throws Error if
  /// the tools fail.
  JointBuild(const GateContext& context, const std::string& reference, std::vector<std::string> variants);

  /// Whether a variant was compiled, so that its functions can replace those of the reference.
  bool holds(std::size_t variant) const;

  /// The worker of a compiled variant, or the forbidden calls of its functions, as buildSubmission() would
  /// report for the whole file. The next call overwrites the worker. Throws Error if the tools fail.
  BuiltSubmission link(std::size_t variant) const;

 private:
  std::vector<std::size_t> compile(const std::string& reference);
  std::vector<std::string> symbols() const;
  std::vector<CompileDiagnostic> forbiddenCallsOf(std::size_t variant) const;

  GateContext context_;
  std::vector<std::string> sources_;  // of each variant
  std::filesystem::path folder_;
  StudentObject object_;
  std::vector<std::vector<StandIn>> functions_;  // of each variant; none if it is not there
};

}  // namespace rex::grading
