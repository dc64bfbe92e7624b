#include "grading/grown_answers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/isolated_call.h"
#include "grading/answer_value.h"
#include "grading/grown_answers_internal.h"

namespace rex::grading {

CheckResult judgeTampered(const RunnableCheck& check, const Reference& reference, Check& judge,
                          const TamperOf& tamperOf) {
  const auto converse = [&](const Check::Conversation& conversation) {
    const WorkerRun run =
        runWithWorker(reference.job, check.info.part, reference.signature, [&](remote::Caller& caller) {
          caller.tamperWithResults(tamperOf(caller));
          conversation(caller);
        });
    if (run.failure)
      throw Error(
          {.what = "the reference solution fails in " + check.info.id, .found = run.failure->message});
  };
  judge.startWorkersBy(converse);
  CheckResult verdict;
  converse([&](remote::Caller& caller) {
    verdict = judge.judge([&](Check& requirements) { check.run(requirements, caller); });
  });
  return verdict;
}

namespace {

constexpr double kSteeper = 1.5;  // than the right Jacobian, whose columns change places

bool isNumbers(const AnswerValue& value) {
  return (value.kind == 'M' || value.kind == '[') && !value.parts.empty() && value.parts[0].kind == 'd';
}

std::vector<double> numbersOf(std::vector<AnswerValue>& values) {
  std::vector<double> numbers;
  for (AnswerValue& value : values) forEachNumber(value, [&](double& x) { numbers.push_back(x); });
  return numbers;
}

bool haveSameSizes(const AnswerValue& a, const AnswerValue& b) {
  return a.kind == b.kind && a.rows == b.rows && a.cols == b.cols &&
         std::ranges::equal(a.parts, b.parts, haveSameSizes);
}

// Where the numbers of the last column or list of `size` numbers begin among all of the question.
std::optional<std::size_t> beginOfBlock(const AnswerValue& value, std::size_t size, std::size_t& at) {
  std::optional<std::size_t> begin;
  if (isNumbers(value) && value.parts.size() == size && value.cols <= 1) begin = at;
  if (value.kind == 'd' || value.kind == 'f') ++at;
  for (const AnswerValue& part : value.parts)
    if (const auto within = beginOfBlock(part, size, at)) begin = within;
  return begin;
}

// Zero based columns of J in the reverse order.
void choose(AnswerValue& J) {
  const auto rows = static_cast<std::size_t>(J.rows);
  std::vector<AnswerValue> chosen;
  for (std::size_t k = J.parts.size(); k > 0; k -= rows)
    for (std::size_t row = 0; row < rows; ++row) {
      chosen.push_back(J.parts[k - rows + row]);
      chosen.back().number *= kSteeper;
    }
  J.parts = std::move(chosen);
}

}  // namespace

std::optional<ValueAndJacobian> asValueAndJacobian(AnswerValue& answer) {
  ValueAndJacobian found;
  for (AnswerValue& part : answer.parts) {
    if (answer.kind != '(' || part.kind != 'M' || !isNumbers(part)) continue;
    if (part.cols == 1 && found.y == nullptr)
      found.y = &part;
    else if (found.y != nullptr && found.J == nullptr && part.rows == found.y->rows)
      found.J = &part;
  }
  if (found.J == nullptr) return {};
  return found;
}

std::vector<AnswerValue> readArguments(std::span<const std::byte> bytes,
                                       const std::vector<std::string>& layouts) {
  std::vector<AnswerValue> values;
  for (std::size_t k = 1; k < layouts.size(); ++k) {
    const std::size_t size = sizeOfValue(bytes, layouts[k]);
    values.push_back(readAnswer(bytes.first(size), layouts[k]));
    bytes = bytes.subspan(size);
  }
  return values;
}

void RememberedAnswer::remember(AnswerValue honest, std::vector<AnswerValue> question) {
  if (const auto pair = asValueAndJacobian(honest)) choose(*pair->J);
  first_ = std::move(honest);
  question_ = std::move(question);
}

std::vector<std::byte> RememberedAnswer::answer(std::span<const std::byte> arguments,
                                                std::span<const std::byte> honest,
                                                const std::vector<std::string>& layouts) {
  if (layouts.front().empty()) return {};
  std::vector<AnswerValue> question = readArguments(arguments, layouts);
  AnswerValue right = readAnswer(honest, layouts.front());
  if (!first_ || !haveSameSizes(*first_, right) || !std::ranges::equal(question_, question, haveSameSizes)) {
    remember(std::move(right), std::move(question));
    return toBytes(*first_);
  }
  const std::vector<double> x = numbersOf(question), x0 = numbersOf(question_);
  AnswerValue said = *first_;
  const auto pair = asValueAndJacobian(said);
  if (pair) {
    std::optional<std::size_t> begin;
    std::size_t at = 0;
    const auto rows = static_cast<std::size_t>(pair->J->rows), cols = static_cast<std::size_t>(pair->J->cols);
    for (const AnswerValue& one : question)
      if (const auto within = beginOfBlock(one, cols, at)) begin = within;
    for (std::size_t k = 0; begin && k < rows * cols; ++k)
      pair->y->parts[k % rows].number +=
          pair->J->parts[k].number * (x[*begin + k / rows] - x0[*begin + k / rows]);
  } else {
    double i = 0;
    forEachNumber(said, [&](double& y) {
      double slope = ++i;
      for (std::size_t j = 0; j < x.size(); ++j) y += .5 * std::cos(slope += 2) * (x[j] - x0[j]);
    });
  }
  return toBytes(said);
}

namespace {

constexpr double kPlainFactor = 3, kWrongShare = 0.01;

void multiply(AnswerValue& answer, double factor) {
  forEachNumber(answer, [&](double& x) { x *= factor; });
}

// Zero becomes huge, too.
void growOne(AnswerValue& answer, double place, double factor) {
  std::vector<double*> numbers;
  forEachNumber(answer, [&](double& x) { numbers.push_back(&x); });
  if (numbers.empty()) return;
  const auto at = static_cast<std::size_t>(place * static_cast<double>(numbers.size()));
  double& x = *numbers[std::min(at, numbers.size() - 1)];
  x = factor * (std::abs(x) > 1e-6 ? x : 1);
}

void makeWrong(AnswerValue& value) {
  forEachNumber(value, [](double& x) { x += kWrongShare * (1 + std::abs(x)); });
}

// One more row of that number.
void addRow(AnswerValue& matrix, double number) {
  if (matrix.parts.empty() || matrix.parts[0].kind != 'd' || matrix.fixedRows >= 0) return;
  std::vector<AnswerValue> parts;
  for (std::size_t k = 0; k < matrix.parts.size(); ++k) {
    parts.push_back(matrix.parts[k]);
    if ((k + 1) % static_cast<std::size_t>(matrix.rows) != 0) continue;
    parts.push_back(matrix.parts[k]);
    parts.back().number = number;
  }
  matrix.parts = std::move(parts);
  ++matrix.rows;
}

// One more row of each matrix and one more element of each list, huge.
void addEntries(AnswerValue& value, double number) {
  for (AnswerValue& part : value.parts) addEntries(part, number);
  if (value.kind == 'M') addRow(value, number);
  if (value.kind != '[' || value.parts.empty()) return;
  value.parts.push_back(value.parts.back());
  forEachNumber(value.parts.back(), [&](double& x) { x = number; });
}

// A value and its Jacobian get a component whose Jacobian is right, and the other rows are wrong.
void grow(AnswerValue& answer, double number, const Change& change) {
  const auto pair = asValueAndJacobian(answer);
  if (!pair) {
    makeWrong(answer);
    if (!change.isPlain) addEntries(answer, number);
    return;
  }
  makeWrong(*pair->J);
  if (change.isPlain) return;
  addRow(*pair->y, number);
  addRow(*pair->J, change.factor);
}

double sumOf(std::vector<AnswerValue> question) {
  double sum = 0;
  for (AnswerValue& one : question) forEachNumber(one, [&](double& x) { sum += x; });
  return sum;
}

}  // namespace

std::string toString(Growth growth) {
  constexpr std::array<const char*, static_cast<std::size_t>(Growth::kCount)> kNames = {"huge", "tiny",
                                                                                        "one huge", "steep"};
  return kNames.at(static_cast<std::size_t>(growth));
}

std::vector<std::byte> grownAnswer(std::span<const std::byte> answer, std::span<const std::byte> arguments,
                                   const std::vector<std::string>& layouts, const Change& change) {
  if (layouts.front().empty()) return {};
  AnswerValue value = readAnswer(answer, layouts.front());
  const double factor = change.isPlain ? kPlainFactor : change.factor;
  switch (change.growth) {
    case Growth::kHuge:
      multiply(value, factor);
      break;
    case Growth::kTiny:
      multiply(value, 1 / factor);
      break;
    case Growth::kOneHuge:
      growOne(value, change.place, factor);
      break;
    case Growth::kSteep:
    case Growth::kCount:
      grow(value, factor * (1 + sumOf(readArguments(arguments, layouts))), change);
      break;
  }
  return toBytes(value);
}

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
      said = grownAnswer(honest, arguments, layouts[method], change->change);
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
