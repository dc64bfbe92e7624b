#include "grading/gates.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "base/error.h"
#include "grading/compiler_messages.h"
#include "grading/named_symbols.h"
#include "grading/regions.h"
#include "grading/release.h"
#include "grading/submission.h"
#include "grading/text_file.h"
#include "grading/unknown_check_internal.h"

namespace rex::grading {
namespace {

using std::filesystem::path;

using Points = std::map<std::string, int>;  // by part

const GateResult kPassed{true, {}};

GateResult failed(std::string message) { return {false, std::move(message)}; }

// Passed if there is nothing to complain about.
GateResult judge(const std::vector<std::string>& complaints) {
  return {complaints.empty(), fmt::format("{}", fmt::join(complaints, "\n"))};
}

// The wrong/NAME of an exercise, in order.
std::vector<std::string> variantNames(const ExerciseInfo& exercise) {
  std::vector<std::string> names;
  if (std::filesystem::is_directory(exercise.folder / "wrong"))
    for (const auto& entry : std::filesystem::directory_iterator(exercise.folder / "wrong"))
      if (entry.path().extension() == ".cpp") names.push_back("wrong/" + entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

WrongVariant variantOf(const ExerciseInfo& exercise, const std::string& name) {
  const path solution = exercise.folder / "solution.cpp", wrong = exercise.folder / (name + ".cpp");
  return composeVariant(readTextFile(solution), solution.string(), readTextFile(wrong), wrong.string());
}

SubmissionOptions optionsFor(const GateContext& context, const path& file) {
  return {.main = file,
          .workFolder = context.workFolder / "build",
          .results = context.workFolder / "results.json",
          .checks = {},
          .seed = {}};
}

GradeResult grade(const GateContext& context, const path& file) {
  return gradeSubmission(context.toolchain, context.exercise, optionsFor(context, file)).result;
}

// What is not as it should be in a result, line by line.
std::string shortfalls(const GradeResult& result) {
  std::string lines = result.message.empty() ? "" : "\n  " + result.message;
  for (const CheckResult& check : result.checks)
    if (check.status != Outcome::pass) lines += fmt::format("\n  {}: {}", check.id, check.message);
  return lines;
}

GateResult mainIsCurrent(const GateContext& context) {
  const path folder = context.exercise.folder, solution = folder / "solution.cpp";
  if (readTextFile(folder / "main.cpp") == stripSolution(readTextFile(solution), solution.string()))
    return kPassed;
  return failed(fmt::format("main.cpp is not what solution.cpp gives; run: scripts/rex dev strip {}",
                            context.exercise.name));
}

// The checks of each part must be worth what exercise.toml promises.
GateResult pointsAddUp(const GateContext& context) {
  Points checked;
  for (const CheckResult& check : listChecks(context.toolchain)) checked[check.part] += check.maxPoints;
  std::vector<std::string> complaints;
  for (const ExercisePart& part : context.exercise.parts) {
    if (checked[part.id] != part.points)
      complaints.push_back(fmt::format("part '{}': checks are worth {} points, exercise.toml says {}",
                                       part.id, checked[part.id], part.points));
    checked.erase(part.id);
  }
  for (const auto& [part, points] : checked)
    complaints.push_back(fmt::format("checks name a part '{}' that exercise.toml does not have", part));
  return judge(complaints);
}

GateResult namesExist(const GateContext& context) {
  std::vector<std::string> complaints;
  for (const DeadName& dead : deadNames(context.root, context.exercise.folder))
    complaints.emplace_back(Error({.what = fmt::format("'{}' does not exist", dead.name),
                                   .where = dead.where,
                                   .nearest = dead.nearest})
                                .what());
  return judge(complaints);
}

GateResult releaseIsClean(const GateContext& context) {
  requireNoSolutionText(context.exercise.folder);
  return kPassed;
}

GateResult mainScoresFloor(const GateContext& context) {
  const GradeResult result = grade(context, context.exercise.folder / "main.cpp");
  if (!result.compile.diagnostics.empty())
    return failed("main.cpp does not compile cleanly: " + toString(result.compile.diagnostics.front()));
  if (result.outcome == Outcome::graderError) return failed("the grader failed: " + result.message);
  Points scored;
  for (const CheckResult& check : result.checks) scored[check.part] += check.points;
  std::vector<std::string> complaints;
  for (const ExercisePart& part : context.exercise.parts)
    if (scored[part.id] != part.floor)
      complaints.push_back(
          fmt::format("part '{}': the untouched main.cpp gets {} points, exercise.toml says floor = {}",
                      part.id, scored[part.id], part.floor));
  return judge(complaints);
}

GateResult solutionIsFull(const GateContext& context) {
  SubmissionOptions options = optionsFor(context, context.exercise.folder / "solution.cpp");
  const BuiltSubmission built = buildSubmission(context.toolchain, context.exercise, options);
  if (!built.start.compile.diagnostics.empty())
    return failed("solution.cpp does not compile cleanly: " +
                  toString(built.start.compile.diagnostics.front()));
  for (int seed = 1; seed <= context.seeds; ++seed) {
    options.seed = seed;
    const GradeResult result = gradeBuilt(built, context.toolchain, context.exercise, options);
    if (result.outcome != Outcome::pass || result.score != context.exercise.points())
      return failed(fmt::format("solution.cpp scores {} of {} under seed {}{}", result.score,
                                context.exercise.points(), seed, shortfalls(result)));
  }
  return kPassed;
}

// What students ask for after a crash must not complain about a program that is right. One check tells.
GateResult solutionPassesSanitizers(const GateContext& context) {
  SubmissionOptions options = optionsFor(context, context.exercise.folder / "solution.cpp");
  options.sanitize = true;
  for (const CheckResult& check : listChecks(context.toolchain))
    if (check.group == Group::visible && options.checks.empty()) options.checks = {check.id};
  const GradeResult result = gradeSubmission(context.toolchain, context.exercise, options).result;
  if (result.outcome == Outcome::pass) return kPassed;
  return failed("solution.cpp does not pass with the sanitizers: " + shortfalls(result));
}

// A call that the scan refuses never meets a check.
GateResult isRefused(const GradeResult& result) {
  const auto& diagnostics = result.compile.diagnostics;
  const bool refused = std::any_of(diagnostics.begin(), diagnostics.end(),
                                   [](const auto& d) { return d.rule == kForbiddenCall; });
  return refused ? kPassed : failed("it should call a forbidden function, but nothing noticed one");
}

// The gates of the variants prove that it is there.
GateResult mistakesAreShown(const GateContext& context) {
  for (const std::string& name : variantNames(context.exercise))
    if (!variantOf(context.exercise, name).shownBy.empty()) return kPassed;
  return failed("no wrong variant names a check that shows its mistake: '// shown by: CHECK, ...'");
}

const CheckResult& checkNamed(const GradeResult& result, const std::string& id, const path& wrong) {
  const auto isIt = [&](const CheckResult& check) { return check.id == id; };
  const auto check = std::find_if(result.checks.begin(), result.checks.end(), isIt);
  if (check != result.checks.end()) return *check;
  std::vector<std::string> ids;
  for (const CheckResult& known : result.checks) ids.push_back(known.id);
  throw internal::unknownCheck(id, ids, {wrong.string(), 1});
}

// What is missing of a picture, and of a replay if there is one: it must not begin where all is well.
std::vector<std::string> missingOf(const CheckResult& check, const path& workFolder) {
  if (check.picture.empty() || !std::filesystem::exists(workFolder / check.picture))
    return {fmt::format("check '{}' leaves no picture", check.id)};
  constexpr std::string_view kAtOnce = "data-start=\"0\"";
  if (!check.replay.empty() && readTextFile(workFolder / check.replay).find(kAtOnce) != std::string::npos)
    return {fmt::format("the replay of check '{}' begins at 0 s, not where it went wrong", check.id)};
  return {};
}

GateResult wrongIsCaught(const GateContext& context, const std::string& gate) {
  const WrongVariant variant = variantOf(context.exercise, gate);
  const path file = context.workFolder / "main.cpp", wrong = context.exercise.folder / (gate + ".cpp");
  writeTextFile(file, variant.source);
  SubmissionOptions options = optionsFor(context, file);
  if (!variant.shownBy.empty()) options.evidence = context.workFolder / "checks";
  const GradeResult result = gradeSubmission(context.toolchain, context.exercise, options).result;
  if (variant.caughtBy.front() == kForbiddenCall) return isRefused(result);
  if (result.outcome == Outcome::compileError || result.outcome == Outcome::graderError)
    return failed("it was not graded: " + result.message);
  for (const std::string& id : variant.caughtBy)
    if (checkNamed(result, id, wrong).status == Outcome::pass)
      return failed(fmt::format("check '{}' passes although: {}", id, variant.mistake));
  if (result.score >= result.maxScore) return failed("it gets the full score");
  std::vector<std::string> missing;
  for (const std::string& id : variant.shownBy)
    for (std::string& what : missingOf(checkNamed(result, id, wrong), context.workFolder))
      missing.push_back(std::move(what));
  return judge(missing);
}

}  // namespace

std::vector<std::string> gateNames(const ExerciseInfo& exercise) {
  std::vector<std::string> names = {"main-current", "points",     "names",    "release",
                                    "evidence",     "main-floor", "solution", "sanitizers"};
  const std::vector<std::string> wrong = variantNames(exercise);
  names.insert(names.end(), wrong.begin(), wrong.end());
  return names;
}

GateResult runGate(const GateContext& context, const std::string& gate) {
  const std::vector<std::string> names = gateNames(context.exercise);
  if (std::find(names.begin(), names.end(), gate) == names.end())
    throw UsageError({.what = fmt::format("{} has no gate '{}'", context.exercise.name, gate),
                      .nearest = nearestNames(gate, names)});
  const std::map<std::string, GateResult (*)(const GateContext&)> gates = {
      {"main-current", mainIsCurrent}, {"points", pointsAddUp},
      {"names", namesExist},           {"release", releaseIsClean},
      {"evidence", mistakesAreShown},  {"main-floor", mainScoresFloor},
      {"solution", solutionIsFull},    {"sanitizers", solutionPassesSanitizers}};
  try {
    const auto found = gates.find(gate);
    return found == gates.end() ? wrongIsCaught(context, gate) : found->second(context);
  } catch (const Error& error) {
    return failed(error.what());
  }
}

}  // namespace rex::grading
