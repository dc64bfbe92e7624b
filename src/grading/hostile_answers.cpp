#include "grading/hostile_answers.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <ctime>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/isolated_call.h"
#include "base/text.h"
#include "grading/answer_value.h"
#include "grading/grown_answers.h"
#include "grading/grown_answers_internal.h"
#include "grading/rewound_generators.h"

namespace rex::grading {
namespace {

constexpr double kFarOut = 1e200;

/// Spoils the nodes of one answer.
class Spoiler {
 public:
  Spoiler(Hostility hostility, Rng& rng) : hostility_(hostility), rng_(rng) {}

  void spoil(AnswerValue& node) {
    const Hostility asked = hostility_;
    if (asked == Hostility::kMixed)
      hostility_ = static_cast<Hostility>(rng_.index(static_cast<int>(Hostility::kMixed)));
    if (node.kind == '[' || node.kind == '?' || node.kind == 'M') resize(node);
    for (AnswerValue& part : node.parts) {
      if (asked == Hostility::kMixed && rng_.uniform() < 0.5) continue;
      spoil(part);
    }
    if (hostility_ == Hostility::kPermuted) permute(node);
    change(node);
    hostility_ = asked;
  }

 private:
  void change(AnswerValue& node) {
    if (node.kind == 'd' || node.kind == 'f') node.number = changed(node.number);
    if (node.kind == 'b') node.bits = hostility_ == Hostility::kZero ? 0 : node.bits ^ 1;
    if (node.kind == 'i' || node.kind == 'u') node.bits = changedInteger(node.bits);
  }

  double changed(double number) {
    using enum Hostility;
    if (hostility_ == kNotANumber) return std::numeric_limits<double>::quiet_NaN();
    if (hostility_ == kInfinite)
      return std::numeric_limits<double>::infinity() * (rng_.uniform() < 0.5 ? -1 : 1);
    if (hostility_ == kOverflowing) return (rng_.uniform() < 0.5 ? -kFarOut : kFarOut) * rng_.uniform(0.5, 1);
    if (hostility_ == kDenormal) return std::numeric_limits<double>::denorm_min();
    if (hostility_ == kZero) return 0;
    if (hostility_ == kConstant) return 1.5;
    if (hostility_ == kShifted) return number + 1;
    if (hostility_ == kScaled) return number * 1e6 + 1e6;
    return number;
  }

  std::uint64_t changedInteger(std::uint64_t bits) {
    using enum Hostility;
    using Int = std::numeric_limits<std::int32_t>;
    constexpr std::array<std::int64_t, 8> kExtremes = {-1,    Int::max(), Int::min(), 1000,
                                                       65536, -1000,      1 << 24,    7};
    if (hostility_ == kExtremeIntegers)
      return static_cast<std::uint64_t>(kExtremes[static_cast<std::size_t>(rng_.index(kExtremes.size()))]);
    if (hostility_ == kZero) return 0;
    if (hostility_ == kConstant) return 3;
    if (hostility_ == kShifted) return bits + 1;
    if (hostility_ == kScaled) return bits * 100 + 1;
    return bits;
  }

  int newSize(int size, int fixed) {
    if (fixed >= 0) return fixed;
    if (hostility_ == Hostility::kEmpty) return 0;
    if (hostility_ == Hostility::kHuge) return 300;
    if (hostility_ == Hostility::kRagged) return std::max(0, size + rng_.index(5) - 2);
    return size;
  }

  void resize(AnswerValue& node) {
    if (node.kind == 'M') {
      node.rows = newSize(node.rows, node.fixedRows);
      node.cols = newSize(node.cols, node.fixedCols);
      fill(node, static_cast<std::size_t>(node.rows) * static_cast<std::size_t>(node.cols));
    } else if (node.kind == '?') {
      if (hostility_ == Hostility::kEmpty || hostility_ == Hostility::kRagged) node.parts.clear();
    } else if (hostility_ == Hostility::kEmpty) {
      node.parts.clear();
    } else if (hostility_ == Hostility::kHuge) {
      fill(node, 20000);
    } else if (hostility_ == Hostility::kRagged) {
      fill(node, std::max<std::size_t>(2, node.parts.size()) - 2 + static_cast<std::size_t>(rng_.index(5)));
    }
  }

  // Repeats the parts that are there. If there are none, only numbers can be added.
  void fill(AnswerValue& node, std::size_t count) {
    if (node.parts.empty() && count > 0) {
      if (node.kind == '[') return;
      node.parts.push_back({.kind = 'd', .number = 1});
      if (!node.layout.ends_with('d')) node.parts.back() = {.kind = 'i', .size = 4, .bits = 1};
    }
    if (count > node.parts.size()) {
      const std::size_t copies = weight(node) * (count / std::max<std::size_t>(1, node.parts.size()));
      if (copies > spare_)
        count = node.parts.size();
      else
        spare_ -= copies;
    }
    if (node.kind == 'M' &&
        count != static_cast<std::size_t>(node.rows) * static_cast<std::size_t>(node.cols)) {
      node.rows = node.fixedRows >= 0 ? node.fixedRows : 0;
      node.cols = node.fixedCols >= 0 && node.rows == 0 ? node.fixedCols : 0;
      count = 0;
    }
    const std::size_t had = node.parts.size();
    node.parts.reserve(std::max(count, had));
    while (node.parts.size() < count) node.parts.push_back(node.parts[node.parts.size() % had]);
    node.parts.resize(count);
  }

  static std::size_t weight(const AnswerValue& node) {
    std::size_t sum = 1;
    for (const AnswerValue& part : node.parts) sum += weight(part);
    return sum;
  }

  void permute(AnswerValue& node) {
    if (node.kind == '(') return;
    for (std::size_t k = node.parts.size(); k > 1; --k)
      std::swap(node.parts[k - 1], node.parts[static_cast<std::size_t>(rng_.index(static_cast<int>(k)))]);
  }

  Hostility hostility_;
  std::size_t spare_ = 400'000;  // nodes that may still be added, nested ones included
  Rng& rng_;
};

}  // namespace

std::string toString(Hostility hostility) {
  constexpr std::array<const char*, static_cast<std::size_t>(Hostility::kCount)> kNames = {
      "empty",    "huge",   "nan",      "inf",     "1e200",  "denormal", "zero",
      "constant", "ragged", "permuted", "shifted", "scaled", "integers", "mixed"};
  return kNames.at(static_cast<std::size_t>(hostility));
}

bool keepsNumbers(Hostility hostility) {
  constexpr auto kKeeping = std::to_array({Hostility::kHuge, Hostility::kRagged, Hostility::kPermuted,
                                           Hostility::kExtremeIntegers, Hostility::kMixed});
  return std::ranges::find(kKeeping, hostility) != kKeeping.end();
}

std::vector<std::byte> corruptedAnswer(std::span<const std::byte> answer, const std::string& layout,
                                       Hostility hostility, Rng& rng) {
  AnswerValue value = readAnswer(answer, layout);
  if (layout.empty()) return {};
  Spoiler(hostility, rng).spoil(value);
  return toBytes(value);
}

namespace {

using remote::Caller;
using Bytes = std::vector<std::byte>;

// The limits of a whole run of the grader with one answer, here for all answers of a kind together.
constexpr IsolationLimits kOneRun = {.cpuSeconds = 600, .wallSeconds = 1800, .memory = std::size_t{6} << 30};

Bytes copyOf(Caller::Bytes bytes) { return {bytes.begin(), bytes.end()}; }

/// A question and the answer of a reference solution.
struct Honest {
  Bytes arguments{}, answer{};
};

/// The honest answers of each function.
using Pool = std::map<std::uint32_t, std::vector<Honest>>;

// Throws Error if a worker receives a generator that gives the seed of the case.
Pool recordHonestAnswers(std::span<const RunnableCheck> checks, const Reference& reference,
                         const CallLayouts& layouts) {
  constexpr std::size_t kMostOfOne = 64, kLongest = 4u << 20;
  Pool pool;
  for (const RunnableCheck& check : checks) {
    Check judge(check.info, reference.job.seed);
    const auto recordOf = [&](const Caller& caller) {
      return [&](std::uint32_t method, Caller::Bytes arguments, Caller::Bytes answer) {
        requireNoSeedBehind(check.info.id, caller.lastCalled(), arguments, layouts.at(method));
        std::vector<Honest>& known = pool[method];
        if (known.size() < kMostOfOne && answer.size() + arguments.size() < kLongest)
          known.push_back({copyOf(arguments), copyOf(answer)});
        return answer;
      };
    };
    static_cast<void>(judgeTampered(check, reference, judge, recordOf));
  }
  return pool;
}

// The bytes of the first argument that has the layout of the result; empty if there is none.
Bytes firstLikeTheResult(Caller::Bytes arguments, const std::vector<std::string>& layouts) {
  for (std::size_t k = 1; k < layouts.size(); ++k) {
    const std::size_t size = sizeOfValue(arguments, layouts[k]);
    if (layouts[k] == layouts[0])
      return {arguments.begin(), arguments.begin() + static_cast<std::ptrdiff_t>(size)};
    arguments = arguments.subspan(size);
  }
  return {};
}

/// Replaces honest answers with lies.
class FalseAnswerer {
 public:
  FalseAnswerer(FalseAnswer lie, const Pool& pool, const CallLayouts& layouts)
      : lie_(lie), pool_(pool), layouts_(layouts) {}

  /// Whether it lied since it was last asked. Other lies than those from memory count even if they are true.
  bool lied() { return std::exchange(lied_, false) || lie_ != FalseAnswer::kMemory; }

  Caller::Bytes tell(std::uint32_t method, Caller::Bytes arguments, Caller::Bytes honest) {
    Bytes last = std::exchange(last_[method], copyOf(honest));
    said_ = lie_ == FalseAnswer::kMemory       ? memories_[method].answer(arguments, honest, layouts_[method])
            : lie_ == FalseAnswer::kConstant   ? answerToAnother(method, arguments)
            : lie_ == FalseAnswer::kLastAnswer ? std::move(last)
            : lie_ == FalseAnswer::kEcho       ? firstLikeTheResult(arguments, layouts_[method])
                                               : Bytes{};
    lied_ = lied_ || !std::ranges::equal(said_, honest);
    if (said_.empty()) said_ = corruptedAnswer(honest, layouts_[method].front(), Hostility::kZero, rng_);
    return said_;
  }

 private:
  // The right answer to the first other question on record.
  Bytes answerToAnother(std::uint32_t method, Caller::Bytes arguments) const {
    for (const Honest& one : pool_.at(method))
      if (!std::ranges::equal(one.arguments, arguments)) return one.answer;
    return {};
  }

  FalseAnswer lie_;
  const Pool& pool_;
  const CallLayouts& layouts_;
  std::map<std::uint32_t, Bytes> last_{};
  std::map<std::uint32_t, RememberedAnswer> memories_{};
  Bytes said_{};
  bool lied_ = false;
  Rng rng_{};
};

int pointsFor(const FalseAnswerer& liar, const RunnableCheck& check, const Reference& reference) {
  Check judge(check.info, reference.job.seed);
  std::vector<std::unique_ptr<FalseAnswerer>>
      liars;  // a fresh worker remembers nothing of what others were asked
  const auto another = [&](const Caller&) {
    liars.push_back(std::make_unique<FalseAnswerer>(liar));
    return [one = liars.back().get()](std::uint32_t method, Caller::Bytes arguments, Caller::Bytes honest) {
      return one->tell(method, arguments, honest);
    };
  };
  const auto haveLied = [&] {
    bool any = false;
    for (const auto& one : liars) any = one->lied() || any;
    return any;
  };
  int cases = 0, casesByLies = 0;
  judge.watchCases([&](bool holds) {
    ++cases;
    casesByLies += haveLied() && holds ? 1 : 0;
  });
  try {
    const int points = judgeTampered(check, reference, judge, another).points;
    if (cases > 0) return std::min(points, check.info.points * casesByLies / cases);
    return haveLied() ? points : 0;
  } catch (const std::exception&) {
    return 0;  // it cannot be judged, see giveHostileAnswers()
  }
}

// In a copy of this process, as when grading: a lie that brings the grader down gets nothing.
int pointsApart(const FalseAnswerer& liar, const RunnableCheck& check, const Reference& reference) {
  const IsolatedResult result =
      callIsolated([&] { return std::to_string(pointsFor(liar, check, reference)); }, kOneRun);
  return result.end == IsolatedEnd::kReturned ? parseNumber<int>(result.bytes).value_or(0) : 0;
}

double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Gives one check hostile answers of one kind.
class Attack {
 public:
  Attack(const RunnableCheck& check, Hostility hostility, const Pool& pool, const CallLayouts& layouts)
      : check_(check),
        pool_(pool),
        layouts_(layouts),
        rng_(Rng(7).split(static_cast<std::uint64_t>(hostility))) {
    outcome_.check = check.info.id;
    outcome_.hostility = hostility;
  }

  HostileOutcome run(std::int64_t answers) {
    constexpr int kMostRuns = 100000;
    while (outcome_.answers < answers && outcome_.runs < kMostRuns) {
      const std::int64_t before = outcome_.answers;
      const double start = processorSeconds();
      runOnce();
      outcome_.mostSeconds = std::max(outcome_.mostSeconds, processorSeconds() - start);
      ++outcome_.runs;
      if (outcome_.answers == before) break;  // the check asks nothing
    }
    return outcome_;
  }

 private:
  void runOnce() {
    Check judge(check_.info, static_cast<std::uint64_t>(outcome_.runs) + 1);
    Bytes answer;
    bool allAreLies = true;
    remote::Caller caller([&](std::uint32_t method) {
      const auto known = pool_.find(method);
      if (known == pool_.end() || known->second.empty())
        throw Error({.what = "the reference solution never answers " + std::to_string(method)});
      const Bytes& honest =
          known->second[static_cast<std::size_t>(rng_.index(static_cast<int>(known->second.size())))].answer;
      answer = corruptedAnswer(honest, layouts_[method].front(), outcome_.hostility, rng_);
      allAreLies = allAreLies && !std::ranges::equal(answer, honest);
      ++outcome_.answers;
      return std::span<const std::byte>(answer);
    });
    judge.startWorkersBy([&](const Check::Conversation& conversation) { conversation(caller); });
    try {
      const CheckResult verdict = judge.judge([&](Check& requirements) { check_.run(requirements, caller); });
      if (!allAreLies) return;
      outcome_.mostPoints = std::max(outcome_.mostPoints, verdict.points);
      outcome_.runsWithPoints += verdict.points > 0 ? 1 : 0;
    } catch (const std::exception& error) {
      if (outcome_.unjudged++ == 0) outcome_.exception = error.what();
    }
  }

  const RunnableCheck& check_;
  const Pool& pool_;
  const CallLayouts& layouts_;
  Rng rng_;
  HostileOutcome outcome_{};
};

std::string toText(const HostileOutcome& outcome) {
  const nlohmann::json json = {{"answers", outcome.answers},    {"runs", outcome.runs},
                               {"points", outcome.mostPoints},  {"with_points", outcome.runsWithPoints},
                               {"unjudged", outcome.unjudged},  {"exception", outcome.exception},
                               {"seconds", outcome.mostSeconds}};
  return json.dump();
}

void readText(const std::string& text, HostileOutcome& outcome) {
  const nlohmann::json json = nlohmann::json::parse(text);
  outcome.answers = json.at("answers");
  outcome.runs = json.at("runs");
  outcome.mostPoints = json.at("points");
  outcome.runsWithPoints = json.at("with_points");
  outcome.unjudged = json.at("unjudged");
  outcome.exception = json.at("exception");
  outcome.mostSeconds = json.at("seconds");
}

std::string describe(const IsolatedResult& result) {
  if (result.end == IsolatedEnd::kTookTooLong) return "it took too long";
  if (result.end == IsolatedEnd::kOutOfMemory) return "it took too much memory";
  return fmt::format("signal {}, exit code {}", result.signal, result.exitCode);
}

}  // namespace

std::vector<HostileOutcome> giveHostileAnswers(std::span<const RunnableCheck> checks, const GradingJob& job,
                                               std::uint64_t signature, const CallLayouts& layouts,
                                               std::int64_t answers) {
  const Pool pool = recordHonestAnswers(checks, {job, signature}, layouts);
  const auto each = static_cast<std::int64_t>(checks.size()) * static_cast<std::int64_t>(Hostility::kCount);
  const std::int64_t ofEach = (answers + each - 1) / std::max<std::int64_t>(1, each);
  std::vector<HostileOutcome> outcomes;
  for (const RunnableCheck& check : checks) {
    for (int k = 0; k < static_cast<int>(Hostility::kCount); ++k) {
      HostileOutcome outcome{.check = check.info.id, .hostility = static_cast<Hostility>(k)};
      const IsolatedResult result = callIsolated(
          [&] { return toText(Attack(check, outcome.hostility, pool, layouts).run(ofEach)); }, kOneRun);
      if (result.end == IsolatedEnd::kReturned)
        readText(result.bytes, outcome);
      else
        outcome.crash = describe(result);
      outcomes.push_back(std::move(outcome));
    }
  }
  return outcomes;
}

std::string toString(FalseAnswer lie) {
  constexpr std::array<const char*, static_cast<std::size_t>(FalseAnswer::kCount)> kNames = {
      "zeros", "constant", "last answer", "echo", "memory"};
  return kNames.at(static_cast<std::size_t>(lie));
}

std::vector<FalseAnswerOutcome> runAdversarially(std::span<const RunnableCheck> checks, const GradingJob& job,
                                                 std::uint64_t signature, const CallLayouts& layouts) {
  GradingJob others = job;
  others.seed += 1000;  // constants that were right for another seed
  const Pool pool = recordHonestAnswers(checks, {others, signature}, layouts);
  std::vector<FalseAnswerOutcome> outcomes;
  for (const RunnableCheck& check : checks)
    for (int k = 0; k < static_cast<int>(FalseAnswer::kCount); ++k) {
      const FalseAnswer lie = static_cast<FalseAnswer>(k);
      outcomes.push_back({.check = check.info.id,
                          .part = check.info.part,
                          .lie = lie,
                          .points = pointsApart(FalseAnswerer(lie, pool, layouts), check, {job, signature})});
    }
  return outcomes;
}

}  // namespace rex::grading
