#include "grading/grown_answers.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/isolated_call.h"
#include "grading/tampered_run_internal.h"

namespace rex::grading {
namespace {

using remote::Caller;

constexpr IsolationLimits kOneGrownRun = {
    .cpuSeconds = 2 * kJudgingSeconds, .wallSeconds = 600, .memory = std::size_t{6} << 30};
constexpr double kMostGrowth = 10;

/// What a check asked for, and what it allowed.
struct Judged {
  CheckResult verdict{};
  std::map<std::string, double> allowances{};  ///< the largest by requirement
  std::map<std::uint32_t, std::string> functions{};
  int questions = 0;
  bool changed = false;
};

/// A change of all answers of one function.
struct ChangeOf {
  std::uint32_t method = 0;
  Change change{};
};

Judged judgeGrown(const RunnableCheck& check, const Reference& reference, const CallLayouts& layouts,
                  const std::optional<ChangeOf>& change) {
  Judged judged;
  Check judge(check.info, reference.job.seed);
  judge.watchAllowances([&](const Check::Allowance& one) {
    const auto [known, isNew] = judged.allowances.try_emplace(one.property, one.limit);
    if (!isNew) known->second = std::max(known->second, one.limit);
  });
  std::vector<std::byte> said;
  const auto tamperOf = [&](const Caller& caller) {
    return [&](std::uint32_t method, Caller::Bytes arguments, Caller::Bytes honest) -> Caller::Bytes {
      ++judged.questions;
      judged.functions.try_emplace(method, caller.lastCalled());
      if (!change || method != change->method) return honest;
      said = grown(honest, arguments, layouts[method], change->change);
      judged.changed = judged.changed || !std::ranges::equal(said, honest);
      return said;
    };
  };
  judged.verdict = judgeTampered(check, reference, judge, tamperOf);
  return judged;
}

// A requirement that allows more than with honest answers, and still more with answers that are larger again:
// a limit of its growth is a constant then. Empty: none.
std::string allowanceThatGrew(const Judged& honest, const Judged& got, const Judged& larger) {
  for (const auto& [property, limit] : got.allowances) {
    const auto known = honest.allowances.find(property), more = larger.allowances.find(property);
    if (known == honest.allowances.end() || limit <= kMostGrowth * std::abs(known->second)) continue;
    if (more != larger.allowances.end() && more->second > kMostGrowth * limit)
      return fmt::format("what '{}' allows from {:.3g} to {:.3g}", property, known->second, limit);
  }
  return "";
}

// What else is more than with honest answers; empty: nothing.
std::string growthOf(const Judged& got, const Judged& honest) {
  if (got.questions > kMostGrowth * honest.questions)
    return fmt::format("{} questions instead of {}", got.questions, honest.questions);
  if (got.verdict.cases > honest.verdict.cases)
    return fmt::format("{} cases instead of {}", got.verdict.cases, honest.verdict.cases);
  return "";
}

bool gains(const GrownOutcome& one) { return one.points > one.plainPoints; }

// One place of several may be chance: an angle of 1e9 is some angle, too.
void forgiveChance(std::span<GrownOutcome> ofPlaces) {
  if (std::ranges::count_if(ofPlaces, gains) > 1) return;
  for (GrownOutcome& one : ofPlaces) one.plainPoints = std::max(one.points, one.plainPoints);
}

/// Changes the answers to one check.
class Grower {
 public:
  Grower(const RunnableCheck& check, const Reference& reference, const CallLayouts& layouts)
      : check_(check), reference_(reference), layouts_(layouts) {
    honest_ = judgeGrown(check, reference, layouts, {});
    if (honest_.verdict.points != check.info.points)
      throw Error(
          {.what = "the reference solution fails in " + check.info.id, .found = honest_.verdict.message});
  }

  std::vector<GrownOutcome> run() const {
    constexpr int kPlaces = 4;
    std::vector<GrownOutcome> outcomes;
    Rng rng(reference_.job.seed);
    for (const auto& [method, function] : honest_.functions)
      for (int k = 0; k < static_cast<int>(Growth::kCount); ++k) {
        const auto growth = static_cast<Growth>(k);
        const int places = growth == Growth::kOneHuge ? kPlaces : 1;
        for (int i = 0; i < places; ++i) {
          outcomes.push_back(apart({method, {.growth = growth, .place = (i + rng.uniform()) / kPlaces}}));
          outcomes.back().function = function;
        }
        if (places > 1) forgiveChance(std::span(outcomes).last(static_cast<std::size_t>(places)));
      }
    return outcomes;
  }

 private:
  // In a copy of this process, as when grading.
  GrownOutcome apart(ChangeOf change) const {
    GrownOutcome outcome{.check = check_.info.id, .growth = change.change.growth};
    const IsolatedResult result = callIsolated([&] { return pointsFor(change); }, kOneGrownRun);
    if (result.end != IsolatedEnd::kReturned) {
      outcome.changed = true;
      outcome.grew = result.end == IsolatedEnd::kTookTooLong   ? "the time it takes"
                     : result.end == IsolatedEnd::kOutOfMemory ? "the memory it takes"
                                                               : "until the process that judged it ended";
      return outcome;
    }
    const nlohmann::json json = nlohmann::json::parse(result.bytes);
    outcome.changed = json.at("changed");
    outcome.points = json.at("points");
    outcome.plainPoints = json.at("plain");
    outcome.grew = json.at("grew");
    outcome.seconds = json.at("seconds");
    return outcome;
  }

  bool hasGrown(const Judged& got) const {
    return std::ranges::any_of(got.allowances, [&](const auto& one) {
      const auto known = honest_.allowances.find(one.first);
      return known != honest_.allowances.end() && one.second > kMostGrowth * std::abs(known->second);
    });
  }

  std::string pointsFor(ChangeOf change) const {
    nlohmann::json json = {{"changed", false}, {"points", 0}, {"plain", 0}, {"grew", ""}, {"seconds", 0.}};
    try {
      const std::clock_t start = std::clock();
      const Judged got = judgeGrown(check_, reference_, layouts_, change);
      json["seconds"] = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      json["changed"] = got.changed;
      json["grew"] = growthOf(got, honest_);
      if (hasGrown(got)) {
        ChangeOf more = change;
        more.change.factor *= 1000;
        const std::string grew =
            allowanceThatGrew(honest_, got, judgeGrown(check_, reference_, layouts_, more));
        if (!grew.empty()) json["grew"] = grew;
      }
      if (!got.changed || got.verdict.points == 0) return json.dump();
      json["points"] = got.verdict.points;
      change.change.isPlain = true;
      json["plain"] = judgeGrown(check_, reference_, layouts_, change).verdict.points;
    } catch (const std::exception&) {  // an answer that cannot be judged gets nothing
    }
    return json.dump();
  }

  const RunnableCheck& check_;
  const Reference& reference_;
  const CallLayouts& layouts_;
  Judged honest_{};
};

}  // namespace

std::vector<GrownOutcome> giveGrownAnswers(std::span<const RunnableCheck> checks, const GradingJob& job,
                                           std::uint64_t signature, const CallLayouts& layouts) {
  const Reference reference{job, signature};
  std::vector<GrownOutcome> outcomes;
  for (const RunnableCheck& check : checks)
    for (GrownOutcome& one : Grower(check, reference, layouts).run()) outcomes.push_back(std::move(one));
  return outcomes;
}

}  // namespace rex::grading
