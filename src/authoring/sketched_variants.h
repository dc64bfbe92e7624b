#pragma once
// The questions of wrong variants, and the file by which checks recognise the mistakes: submission's
// knownMistakesFile().
#include <filesystem>
#include <string>
#include <vector>

#include "authoring/gates.h"
#include "grading/grading_job.h"
#include "grading/known_mistakes.h"
#include "grading/results.h"
#include "submission/regions.h"

namespace rex::authoring {

/// Collects what the solution and the variants of an exercise answer in visible checks.
class SketchedVariants {
 public:
  /// `checks` are those of the exercise. Nothing is collected unless a variant has a question and the context
  /// names no variants.
  SketchedVariants(const GateContext& context, const std::vector<submission::WrongVariant>& variants,
                   const std::vector<grading::CheckResult>& checks);

  bool isNeeded() const { return isNeeded_; }

  /// Has a grading write down what it hears in all visible checks.
  void listenTo(grading::GradingJob& job) const;

  /// After the grading of the solution, or of a variant: takes what was written.
  void takeRight() { right_ = take(); }
  void takeVariant(const submission::WrongVariant& variant);

  /// Writes the file, or removes it if no variant has a question. Forgets what it took.
  void store();

  /// Complaints if the file says something else than what was taken.
  std::vector<std::string> whyNotStored() const;

 private:
  grading::SketchedChecks take() const;

  std::filesystem::path written_, file_;
  bool isNeeded_ = false, isWhole_;
  std::vector<std::string> visible_{};
  grading::SketchedChecks right_{};
  std::vector<grading::SketchedMistake> mistakes_{};
};

}  // namespace rex::authoring
