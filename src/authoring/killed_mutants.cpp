#include "authoring/killed_mutants.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <random>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "authoring/wrong_variants.h"
#include "base/error.h"
#include "base/text.h"
#include "base/text_file.h"
#include "submission/regions.h"
#include "submission/submission.h"

namespace rex::authoring {
namespace {

using std::filesystem::path;
using Ids = std::vector<std::string>;

constexpr std::size_t kMostMutants = 200;

std::string describe(const Mutant& mutant) {
  return fmt::format("solution.cpp:{}:{}: {}: {} -> {}", mutant.line, mutant.column, mutant.change,
                     mutant.before, mutant.after);
}

/// Grades mutants one by one.
class MutantGrader {
 public:
  explicit MutantGrader(const GateContext& context) : context_(context) {
    // They call nothing that the solution does not call, and looking takes longer than grading.
    context_.exercise.forbidden.clear();
    for (const grading::CheckResult& check : submission::listChecks(context.toolchain))
      checks_.push_back(check.id);
    idle_.insert(checks_.begin(), checks_.end());
  }

  // Grades the solution, whose slowest check sets the limit for the mutants. Throws Error if it is wrong.
  void limitBySolution() {
    submission::SubmissionOptions options = optionsIn(context_.workFolder / "solution");
    options.main = context_.exercise.folder / "solution.cpp";
    const grading::GradeResult result =
        submission::gradeSubmission(context_.toolchain, context_.exercise, options).result;
    if (result.outcome != grading::Outcome::kPass)
      throw Error({.what = "solution.cpp does not get all points", .found = result.message});
    double most = 0;
    for (const grading::CheckResult& check : result.checks) most = std::max(most, check.cpuSeconds);
    grading::Limits& limits = context_.exercise.limits;
    limits.wallSeconds = limits.wallBudget();  // other programs must not kill mutants
    limits.cpuSeconds = std::min(limits.cpuSeconds, std::max(1., 4 * most));
  }

  const GateContext& context() const { return context_; }

  // Whether a check fails. Asks first the check that failed last for a mutant of the same function, and those
  // that have not failed yet.
  bool isKilled(const Mutant& mutant, const submission::BuiltSubmission& built) {
    if (built.worker.empty()) throw Error({.what = describe(mutant), .found = built.start.message});
    const auto killer = killers_.find(mutant.function);
    Ids first(idle_.begin(), idle_.end()), rest;
    if (killer != killers_.end() && !idle_.contains(killer->second)) first.push_back(killer->second);
    for (const std::string& check : checks_)
      if (std::find(first.begin(), first.end(), check) == first.end()) rest.push_back(check);
    return (!first.empty() && fails(mutant, built, first)) || (!rest.empty() && fails(mutant, built, rest));
  }

  Ids idleChecks() const {
    Ids idle;
    for (const std::string& check : checks_)
      if (idle_.contains(check)) idle.push_back(check);
    return idle;
  }

 private:
  submission::SubmissionOptions optionsIn(const path& folder) const {
    return {.main = context_.workFolder / "main.cpp",
            .workFolder = folder,
            .job = {.results = context_.workFolder / "results.json"}};
  }

  bool fails(const Mutant& mutant, const submission::BuiltSubmission& built, const Ids& checks) {
    submission::SubmissionOptions options = optionsIn(built.worker.parent_path());
    options.job.checks = checks;
    const grading::GradeResult result =
        submission::gradeBuilt(built, context_.toolchain, context_.exercise, options);
    if (result.outcome == grading::Outcome::kGraderError)
      throw Error({.what = describe(mutant), .found = result.message});
    bool failed = false;
    for (const grading::CheckResult& check : result.checks) {
      if (!check.status || check.status == grading::Outcome::kPass) continue;
      failed = true;
      // What crashes or takes too long does so in any check.
      if (check.status != grading::Outcome::kFail && killers_.contains(mutant.function)) continue;
      killers_[mutant.function] = check.id;
      if (check.status == grading::Outcome::kFail) idle_.erase(check.id);
    }
    return failed;
  }

  GateContext context_;
  Ids checks_{};
  std::set<std::string> idle_{};                  // no mutant failed them by its answers
  std::map<std::string, std::string> killers_{};  // the last check that failed, by function
};

// Takes those that the exercise lists as equal from the drawn mutants, and counts them. The others stay
// drawn.
void setEqualAside(const path& file, const std::vector<Mutant>& all, std::vector<Mutant>& drawn,
                   MutantCounts& counts) {
  if (!std::filesystem::exists(file)) return;
  for (const EqualMutant& equal : readEqualMutants(readTextFile(file), file.string())) {
    const auto isIt = [&](const Mutant& mutant) {
      return mutant.before == equal.before && mutant.after == equal.after;
    };
    if (std::none_of(all.begin(), all.end(), isIt))
      counts.complaints.push_back(fmt::format("{}:{}: no mutant is '{}' -> '{}'", file.filename().string(),
                                              equal.line, equal.before, equal.after));
    else if (const std::size_t number = std::erase_if(drawn, isIt); number > 0)
      counts.equal[equal.reason] += number;
  }
}

}  // namespace

std::vector<EqualMutant> readEqualMutants(std::string_view text, const std::string& file) {
  std::vector<EqualMutant> all;
  int number = 0;
  for (const std::string_view line : splitLines(text)) {
    ++number;
    if (line.empty() || line.starts_with('#')) continue;
    const std::vector<std::string_view> fields = splitAt(line, '\t');
    if (fields.size() != 3 || std::any_of(fields.begin(), fields.end(), [](auto f) { return f.empty(); }))
      throw Error({.what = "a line of equal mutants",
                   .where = {file, number},
                   .wanted = "old line, new line, reason, separated by tabs"});
    all.push_back({std::string(fields[0]), std::string(fields[1]), std::string(fields[2]), number});
  }
  return all;
}

// Not std::shuffle, which differs between libraries.
std::vector<Mutant> drawnMutants(std::vector<Mutant> mutants, std::size_t most) {
  std::mt19937_64 random(1);
  for (std::size_t left = mutants.size(); left > 1; --left)
    std::swap(mutants[left - 1], mutants[random() % left]);
  mutants.resize(std::min(mutants.size(), most));
  return mutants;
}

MutantCounts countMutants(const GateContext& context) {
  const auto start = std::chrono::steady_clock::now();
  const path file = context.exercise.folder / "solution.cpp";
  const std::string solution = readTextFile(file), open = withoutUnnamedNamespaces(solution);
  const std::vector<Mutant> all = mutantsOf(solution, file.string());
  std::vector<Mutant> mutants = drawnMutants(all, kMostMutants);
  MutantCounts counts{.possible = all.size(), .made = mutants.size()};
  setEqualAside(context.exercise.folder / "equal_mutants.tsv", all, mutants, counts);
  std::vector<std::string> sources;
  for (const Mutant& mutant : mutants)
    sources.push_back(submission::referenceText(mutated(open, mutant), file.string()));
  MutantGrader grader(context);
  grader.limitBySolution();
  const JointBuild build(grader.context(), submission::referenceText(open, file.string()), sources);
  if (const std::string complaint = build.complaint(); !complaint.empty())
    throw Error({.what = "the mutants do not compile", .found = complaint});
  std::map<std::pair<int, int>, std::vector<std::string>> survivors;
  for (std::size_t k = 0; k < mutants.size(); ++k) {
    if (!build.holds(k)) {
      ++counts.rejected;
    } else if (grader.isKilled(mutants[k], build.link(k))) {
      ++counts.killed;
    } else {
      ++counts.survived;
      survivors[{mutants[k].line, mutants[k].column}].push_back(describe(mutants[k]));
    }
  }
  for (const auto& [place, texts] : survivors)
    for (const std::string& text : texts) counts.complaints.push_back(text);
  counts.idleChecks = grader.idleChecks();
  counts.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return counts;
}

}  // namespace rex::authoring
