#include "authoring/wrong_variants.h"

#include <algorithm>

#include <fmt/format.h>

#include "authoring/joint_build.h"
#include "authoring/seen_messages.h"
#include "base/error.h"
#include "base/text_file.h"
#include "grading/unknown_check.h"
#include "render/contact_sheet.h"
#include "render/png.h"
#include "submission/submission.h"

namespace rex::grading {
namespace {

using std::filesystem::path;
using Complaints = std::vector<std::string>;

path wrongFileOf(const ExerciseInfo& exercise) { return exercise.folder / "wrong.cpp"; }

SubmissionOptions gradingOf(const GateContext& context, const WrongVariant& variant) {
  SubmissionOptions options{.main = context.workFolder / "main.cpp",
                            .workFolder = context.workFolder / "build",
                            .job = {.results = context.workFolder / "results.json"}};
  if (!variant.shownBy.empty() || !context.sheet.empty())
    options.job.evidence = context.workFolder / "checks";
  return options;
}

// A variant with a forbidden call is refused before any check runs.
Complaints whyNotRefused(const GradeResult& result) {
  const auto& diagnostics = result.compile.diagnostics;
  const bool refused = std::any_of(diagnostics.begin(), diagnostics.end(),
                                   [](const auto& d) { return d.rule == kForbiddenCall; });
  if (refused) return {};
  return {"it should call a forbidden function, but no call was found"};
}

const CheckResult& checkNamed(const GradeResult& result, const std::string& id, const WrongVariant& variant) {
  const auto isIt = [&](const CheckResult& check) { return check.id == id; };
  const auto check = std::find_if(result.checks.begin(), result.checks.end(), isIt);
  if (check != result.checks.end()) return *check;
  std::vector<std::string> ids;
  for (const CheckResult& known : result.checks) ids.push_back(known.id);
  throw unknownCheck(id, ids, variant.namedAt.at(id));
}

// Complains if there is no picture, or if there is a replay that begins while all is still well.
Complaints missingOf(const CheckResult& check, const path& workFolder) {
  if (check.picture.empty() || !std::filesystem::exists(workFolder / check.picture))
    return {fmt::format("check '{}' leaves no picture", check.id)};
  constexpr std::string_view kAtOnce = "data-start=\"0\"";
  if (!check.replay.empty() && readTextFile(workFolder / check.replay).find(kAtOnce) != std::string::npos)
    return {fmt::format("the replay of check '{}' begins at 0 s, not where it went wrong", check.id)};
  return {};
}

// Complaints if the result is not what the variant promises.
Complaints whyNotCaughtIn(const GradeResult& result, const WrongVariant& variant, const path& workFolder) {
  if (variant.caughtBy.front() == kForbiddenCall) return whyNotRefused(result);
  if (result.outcome == Outcome::kCompileError || result.outcome == Outcome::kGraderError)
    return {"it was not graded: " + result.message};
  for (const std::string& id : variant.caughtBy)
    if (checkNamed(result, id, variant).status == Outcome::kPass)
      return {fmt::format("check '{}' does not catch this mistake: {}", id, variant.mistake)};
  if (result.score >= result.maxScore) return {"it gets the full score"};
  Complaints missing;
  for (const std::string& id : variant.shownBy)
    for (std::string& what : missingOf(checkNamed(result, id, variant), workFolder))
      missing.push_back(std::move(what));
  return missing;
}

void requireChecks(const WrongVariant& variant, const std::vector<std::string>& known) {
  for (const auto* ids : {&variant.caughtBy, &variant.shownBy})
    for (const std::string& id : *ids)
      if (id != kForbiddenCall && std::find(known.begin(), known.end(), id) == known.end())
        throw unknownCheck(id, known, variant.namedAt.at(id));
}

GradeResult gradeWhole(const GateContext& context, const WrongVariant& variant) {
  const SubmissionOptions options = gradingOf(context, variant);
  writeTextFile(options.main, variant.source);
  return gradeSubmission(context.toolchain, context.exercise, options).result;
}

// Runs only the checks that the variant names: as soon as one of them fails, the full score is out of reach.
GradeResult gradeLinked(const GateContext& context, const BuiltSubmission& built,
                        const WrongVariant& variant) {
  if (built.worker.empty()) return built.start;
  SubmissionOptions options = gradingOf(context, variant);
  options.workFolder = built.worker.parent_path();
  options.job.checks = variant.caughtBy;
  options.job.checks.insert(options.job.checks.end(), variant.shownBy.begin(), variant.shownBy.end());
  return gradeBuilt(built, context.toolchain, context.exercise, options);
}

// The pictures of the checks of `ids` that failed, on the sheet.
void addPictures(std::vector<KeyFrame>& sheet, const GradeResult& result, const std::vector<std::string>& ids,
                 const std::string& name, const path& workFolder) {
  for (const CheckResult& check : result.checks)
    if (check.status != Outcome::kPass && !check.picture.empty() &&
        std::find(ids.begin(), ids.end(), check.id) != ids.end())
      sheet.push_back({readPng(workFolder / check.picture), fmt::format("{}: {}", name, check.id)});
}

void writeSheet(const std::vector<KeyFrame>& pictures, const path& file) {
  if (pictures.empty()) return;
  writePng(
      contactSheet(pictures,
                   {.pictures = static_cast<int>(pictures.size()) + 1, .columns = 2, .pictureWidth = 900}),
      file);
}

// The variants that the context names, or all.
std::vector<WrongVariant> wantedVariants(const GateContext& context) {
  const std::vector<std::string>& wanted = context.variants;
  requireVariants(context.exercise, wanted);
  std::vector<WrongVariant> variants = variantsOf(context.exercise);
  if (!wanted.empty())
    std::erase_if(variants, [&](const WrongVariant& variant) {
      return std::find(wanted.begin(), wanted.end(), variant.name) == wanted.end();
    });
  return variants;
}

// Complains if students read something else than the exercise's file says, or writes it there. The gate
// `evidence` wants the file. Messages of variants that were not tested stay as they are.
Complaints whyNotSeen(const GateContext& context, const SeenMessages& seen) {
  const path file = seenMessagesFile(context.exercise.folder);
  SeenMessages stored = std::filesystem::exists(file) ? readSeenMessages(file) : SeenMessages{};
  if (!context.variants.empty())
    std::erase_if(stored, [&](const auto& one) { return !seen.contains(one.first); });
  if (!context.storesMessages)
    return std::filesystem::exists(file) ? changedMessages(seen, stored) : Complaints{};
  SeenMessages all = seen;
  if (!context.variants.empty() && std::filesystem::exists(file)) all.merge(readSeenMessages(file));
  writeSeenMessages(all, file);
  return {};
}

// Adds the complaints of `find`, each with the name of the variant.
template <class Find>
void addComplaints(std::vector<std::string>& complaints, const std::string& name, const Find& find) {
  try {
    for (const std::string& what : find()) complaints.push_back(fmt::format("{}: {}", name, what));
  } catch (const Error& error) {
    complaints.push_back(fmt::format("{}: {}", name, error.what()));
  }
}

}  // namespace

std::vector<WrongVariant> variantsOf(const ExerciseInfo& exercise) {
  const path solution = exercise.folder / "solution.cpp", wrong = wrongFileOf(exercise);
  if (!std::filesystem::exists(wrong)) return {};
  return readVariants(readTextFile(solution), solution.string(), readTextFile(wrong), wrong.string());
}

std::vector<std::string> variantNames(const ExerciseInfo& exercise) {
  const path wrong = wrongFileOf(exercise);
  if (!std::filesystem::exists(wrong)) return {};
  return variantNamesIn(readTextFile(wrong));
}

void requireVariants(const ExerciseInfo& exercise, const std::vector<std::string>& names) {
  const std::vector<std::string> known = variantNames(exercise);
  for (const std::string& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw UsageError({.what = fmt::format("{} has no wrong variant '{}'", exercise.name, name),
                        .nearest = nearestNames(name, known)});
}

std::vector<std::string> whyNotCaught(const GateContext& context, const std::string& name) {
  requireVariants(context.exercise, {name});
  const std::vector<WrongVariant> variants = variantsOf(context.exercise);
  const auto variant = std::find_if(variants.begin(), variants.end(),
                                    [&](const WrongVariant& one) { return one.name == name; });
  return whyNotCaughtIn(gradeWhole(context, *variant), *variant, context.workFolder);
}

CaughtTogether whyNotCaughtTogether(const GateContext& context) {
  std::vector<std::string> known, sources;
  for (const CheckResult& check : listChecks(context.toolchain)) known.push_back(check.id);
  CaughtTogether all;
  std::vector<WrongVariant> variants;
  for (const WrongVariant& variant : wantedVariants(context))
    addComplaints(all.complaints, variant.name, [&]() -> Complaints {
      requireChecks(variant, known);
      sources.push_back(variant.source);
      variants.push_back(variant);
      return {};
    });
  const path solution = context.exercise.folder / "solution.cpp";
  const JointBuild build(context, referenceText(readTextFile(solution), solution.string()), sources);
  SeenMessages seen;
  std::vector<KeyFrame> pictures;
  for (std::size_t k = 0; k < variants.size(); ++k) {
    const WrongVariant& variant = variants[k];
    if (!build.holds(k)) all.alone.push_back(variant.name);
    addComplaints(all.complaints, variant.name, [&] {
      const GradeResult result =
          build.holds(k) ? gradeLinked(context, build.link(k), variant) : gradeWhole(context, variant);
      seen[variant.name] = seenMessage(result, variant.caughtBy);
      addPictures(pictures, result, variant.caughtBy, variant.name, context.workFolder);
      return whyNotCaughtIn(result, variant, context.workFolder);
    });
  }
  if (!context.sheet.empty()) writeSheet(pictures, context.sheet);
  const Complaints changed = whyNotSeen(context, seen);
  all.complaints.insert(all.complaints.end(), changed.begin(), changed.end());
  return all;
}

}  // namespace rex::grading
