#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "authoring/gates.h"
#include "authoring/joined_variants.h"
#include "submission/student_build.h"
#include "submission/submission.h"

namespace rex::grading {

/// Wrong variants of an exercise, compiled together as JoinedVariants, and linked one by one.
class JointBuild {
 public:
  /// Compiles, in the context's work folder, those of the variants with which a file can be made that
  /// compiles. Throws Error when the tools fail.
  JointBuild(const GateContext& context, const std::string& reference, std::vector<std::string> variants);

  /// Whether functions of a variant are there to take the place of those of the reference.
  bool holds(std::size_t variant) const;

  /// The worker of one that is there, or the forbidden calls of what is compiled of it, as buildSubmission()
  /// finds them in the whole file. The next one replaces the worker. Throws Error when the tools fail.
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
