#include "authoring/sketched_variants.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text_file.h"
#include "submission/submission.h"

namespace rex::authoring {
namespace {

constexpr std::string_view kHead =
    "# Made by `rex dev check --gate wrong` from wrong.cpp: what mistakes answer in visible checks, and the\n"
    "# questions about them (src/grading/known_mistakes.h). Do not edit.\n";

}  // namespace

SketchedVariants::SketchedVariants(const GateContext& context,
                                   const std::vector<submission::WrongVariant>& variants,
                                   const std::vector<grading::CheckResult>& checks)
    : written_(context.workFolder / "answers.tsv"),
      file_(submission::knownMistakesFile(context.exercise.folder)),
      isWhole_(context.variants.empty()) {
  isNeeded_ = isWhole_ && std::any_of(variants.begin(), variants.end(),
                                      [](const auto& variant) { return !variant.question.empty(); });
  for (const grading::CheckResult& check : checks)
    if (check.group == grading::Group::kVisible) visible_.push_back(check.id);
}

void SketchedVariants::listenTo(grading::GradingJob& job) const {
  if (!isNeeded_) return;
  job.sketches = written_;
  if (!job.checks.empty()) job.checks.insert(job.checks.end(), visible_.begin(), visible_.end());
}

grading::SketchedChecks SketchedVariants::take() const {
  if (!std::filesystem::exists(written_)) return {};
  const std::string text = readTextFile(written_);
  std::filesystem::remove(written_);
  return grading::readSketchedChecks(text, written_.string());
}

// One that does not compile cannot be recognised.
void SketchedVariants::takeVariant(const submission::WrongVariant& variant) {
  if (grading::SketchedChecks checks = take(); !checks.empty())
    mistakes_.push_back({variant.question, std::move(checks)});
}

void SketchedVariants::store() {
  if (isNeeded_)
    writeTextFile(file_, std::string(kHead) + toText(grading::knownMistakes(right_, mistakes_)));
  else if (isWhole_)
    std::filesystem::remove(file_);
  mistakes_.clear();
}

std::vector<std::string> SketchedVariants::whyNotStored() const {
  const std::string name = file_.filename().string();
  const bool isThere = std::filesystem::exists(file_);
  std::string why;
  if (!isNeeded_)
    why = isWhole_ && isThere ? "no variant has a question" : "";
  else if (!isThere)
    why = "it is missing";
  else
    why = differenceBetween(grading::readKnownMistakes(readTextFile(file_), file_.string()),
                            grading::knownMistakes(right_, mistakes_));
  if (why.empty()) return {};
  return {fmt::format("{} does not describe wrong.cpp: {}. Make it with REX_UPDATE_GOLDEN=1.", name, why)};
}

}  // namespace rex::authoring
