#include "grading/hostile_answers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <ctime>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/isolated_call.h"
#include "grading/worker_process.h"

namespace rex::grading {
namespace {

using remote::Caller;
using Bytes = std::vector<std::byte>;

constexpr double kHuge = 1e200;

/// One value of an answer, with what it consists of.
struct Node {
  char kind = ' ';            ///< the first character of its layout
  std::string layout{};       ///< of all of it
  int size = 0;               ///< of an integer, in bytes
  std::vector<Node> parts{};  ///< of fields, lists, optional values and matrices
  double number = 0;
  std::uint64_t bits = 0;  ///< of integers and truth values
  Bytes raw{};             ///< of texts and generators
  int rows = 0, cols = 0;
  int fixedRows = -1, fixedCols = -1;
};

/// Takes answers apart by their layout.
class Parser {
 public:
  Parser(std::string_view layout, std::span<const std::byte> bytes) : layout_(layout), bytes_(bytes) {}

  Node all() {
    Node node = layout_.empty() ? Node{} : value();
    if (!layout_.empty() || !bytes_.empty()) refuse();
    return node;
  }

  /// Of the first value, in bytes.
  std::size_t sizeOfFirst() {
    const std::size_t size = bytes_.size();
    static_cast<void>(value());
    return size - bytes_.size();
  }

 private:
  [[noreturn]] static void refuse() { throw Error({.what = "an answer does not have its layout"}); }

  template <class T>
  T take() {
    T value{};
    if (bytes_.size() < sizeof value) refuse();
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_ = bytes_.subspan(sizeof value);
    return value;
  }

  Bytes takeBytes(std::uint64_t count) {
    if (bytes_.size() < count) refuse();
    Bytes taken(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(count));
    bytes_ = bytes_.subspan(count);
    return taken;
  }

  int number() {
    int value = 0;
    const auto [end, error] = std::from_chars(layout_.data(), layout_.data() + layout_.size(), value);
    if (error != std::errc()) refuse();
    layout_.remove_prefix(static_cast<std::size_t>(end - layout_.data()));
    return value;
  }

  char next() {
    if (layout_.empty()) refuse();
    const char c = layout_.front();
    layout_.remove_prefix(1);
    return c;
  }

  Node value() {
    const std::string_view start = layout_;
    Node node{.kind = next()};
    read(node);
    node.layout = start.substr(0, start.size() - layout_.size());
    return node;
  }

  void read(Node& node) {
    switch (node.kind) {
      case 'd':
        node.number = take<double>();
        break;
      case 'f':
        node.number = take<float>();
        break;
      case 'b':
        node.bits = take<std::uint8_t>();
        break;
      case 'i':
      case 'u': {
        node.size = number();
        const Bytes raw = takeBytes(static_cast<std::uint64_t>(node.size));
        std::memcpy(&node.bits, raw.data(), raw.size());
        break;
      }
      case 's':
        node.raw = takeBytes(take<std::uint64_t>());
        break;
      case 'r':
        node.raw = takeBytes(4 * sizeof(std::uint64_t));
        break;
      case '(':
        while (!layout_.empty() && layout_.front() != ')') node.parts.push_back(value());
        next();
        break;
      case '[':
        repeat(node, take<std::uint64_t>());
        next();
        break;
      case '?':
        repeat(node, take<std::uint8_t>());
        break;
      case 'M':
        node.fixedRows = number();
        next();
        node.fixedCols = number();
        next();
        node.rows = take<std::int32_t>();
        node.cols = take<std::int32_t>();
        repeat(node, static_cast<std::uint64_t>(node.rows) * static_cast<std::uint64_t>(node.cols));
        break;
      default:
        refuse();
    }
  }

  // One layout for all parts; without any it is passed over.
  void repeat(Node& node, std::uint64_t count) {
    const std::string_view element = layout_;
    for (std::uint64_t k = 0; k < count; ++k) {
      layout_ = element;
      node.parts.push_back(value());
    }
    if (count == 0) pass();
  }

  void pass() {
    const char kind = next();
    if (kind == 'i' || kind == 'u') number();
    if (kind == '?') pass();
    if (kind == '[') pass(), next();
    if (kind == 'M') number(), next(), number(), next(), pass();
    if (kind == '(') {
      while (!layout_.empty() && layout_.front() != ')') pass();
      next();
    }
  }

  std::string_view layout_;
  std::span<const std::byte> bytes_;
};

template <class T>
void put(Bytes& bytes, const T& value) {
  const auto* first = reinterpret_cast<const std::byte*>(&value);
  bytes.insert(bytes.end(), first, first + sizeof value);
}

void write(const Node& node, Bytes& bytes) {
  switch (node.kind) {
    case 'd':
      return put(bytes, node.number);
    case 'f':
      return put(bytes, static_cast<float>(node.number));
    case 'b':
      return put(bytes, static_cast<std::uint8_t>(node.bits & 1));
    case 'i':
    case 'u': {
      const auto* first = reinterpret_cast<const std::byte*>(&node.bits);
      bytes.insert(bytes.end(), first, first + node.size);
      return;
    }
    case 's':
      put(bytes, static_cast<std::uint64_t>(node.raw.size()));
      [[fallthrough]];
    case 'r':
      bytes.insert(bytes.end(), node.raw.begin(), node.raw.end());
      return;
    case '[':
      put(bytes, static_cast<std::uint64_t>(node.parts.size()));
      break;
    case '?':
      put(bytes, static_cast<std::uint8_t>(node.parts.size()));
      break;
    case 'M':
      put(bytes, node.rows);
      put(bytes, node.cols);
      break;
    default:
      break;
  }
  for (const Node& part : node.parts) write(part, bytes);
}

/// Spoils the nodes of one answer.
class Spoiler {
 public:
  Spoiler(Hostility hostility, Rng& rng) : hostility_(hostility), rng_(rng) {}

  void spoil(Node& node) {
    const Hostility asked = hostility_;
    if (asked == Hostility::mixed)
      hostility_ = static_cast<Hostility>(rng_.index(static_cast<int>(Hostility::mixed)));
    if (node.kind == '[' || node.kind == '?' || node.kind == 'M') resize(node);
    for (Node& part : node.parts) {
      if (asked == Hostility::mixed && rng_.uniform() < 0.5) continue;
      spoil(part);
    }
    if (hostility_ == Hostility::permuted) permute(node);
    change(node);
    hostility_ = asked;
  }

 private:
  void change(Node& node) {
    if (node.kind == 'd' || node.kind == 'f') node.number = changed(node.number);
    if (node.kind == 'b') node.bits = hostility_ == Hostility::zero ? 0 : node.bits ^ 1;
    if (node.kind == 'i' || node.kind == 'u') node.bits = changedInteger(node.bits);
  }

  double changed(double number) {
    switch (hostility_) {
      case Hostility::notANumber:
        return std::numeric_limits<double>::quiet_NaN();
      case Hostility::infinite:
        return std::numeric_limits<double>::infinity() * (rng_.uniform() < 0.5 ? -1 : 1);
      case Hostility::overflowing:
        return (rng_.uniform() < 0.5 ? -kHuge : kHuge) * rng_.uniform(0.5, 1);
      case Hostility::denormal:
        return std::numeric_limits<double>::denorm_min();
      case Hostility::zero:
        return 0;
      case Hostility::constant:
        return 1.5;
      case Hostility::shifted:
        return number + 1;
      case Hostility::scaled:
        return number * 1e6 + 1e6;
      default:
        return number;
    }
  }

  std::uint64_t changedInteger(std::uint64_t bits) {
    switch (hostility_) {
      case Hostility::extremeIntegers: {
        constexpr std::array<std::int64_t, 8> kValues = {-1,
                                                         std::numeric_limits<std::int32_t>::max(),
                                                         std::numeric_limits<std::int32_t>::min(),
                                                         1000,
                                                         65536,
                                                         -1000,
                                                         1 << 24,
                                                         7};
        return static_cast<std::uint64_t>(kValues[static_cast<std::size_t>(rng_.index(kValues.size()))]);
      }
      case Hostility::zero:
        return 0;
      case Hostility::constant:
        return 3;
      case Hostility::shifted:
        return bits + 1;
      case Hostility::scaled:
        return bits * 100 + 1;
      default:
        return bits;
    }
  }

  int newSize(int size, int fixed) {
    if (fixed >= 0) return fixed;
    if (hostility_ == Hostility::empty) return 0;
    if (hostility_ == Hostility::huge) return 300;
    if (hostility_ == Hostility::ragged) return std::max(0, size + rng_.index(5) - 2);
    return size;
  }

  void resize(Node& node) {
    if (node.kind == 'M') {
      node.rows = newSize(node.rows, node.fixedRows);
      node.cols = newSize(node.cols, node.fixedCols);
      fill(node, static_cast<std::size_t>(node.rows) * static_cast<std::size_t>(node.cols));
    } else if (node.kind == '?') {
      if (hostility_ == Hostility::empty || hostility_ == Hostility::ragged) node.parts.clear();
    } else if (hostility_ == Hostility::empty) {
      node.parts.clear();
    } else if (hostility_ == Hostility::huge) {
      fill(node, 20000);
    } else if (hostility_ == Hostility::ragged) {
      fill(node, std::max<std::size_t>(2, node.parts.size()) - 2 + static_cast<std::size_t>(rng_.index(5)));
    }
  }

  // Repeats what is there; where nothing is, only numbers can be made.
  void fill(Node& node, std::size_t count) {
    if (node.parts.empty() && count > 0) {
      if (node.kind == '[') return;
      node.parts.push_back({.kind = 'd', .number = 1});
      if (!node.layout.ends_with('d')) node.parts.back() = {.kind = 'i', .size = 4, .bits = 1};
    }
    constexpr std::size_t kMostNodes = 400'000;
    if (count > node.parts.size() &&
        weight(node) * (count / std::max<std::size_t>(1, node.parts.size())) > kMostNodes)
      count = node.parts.size();
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

  static std::size_t weight(const Node& node) {
    std::size_t sum = 1;
    for (const Node& part : node.parts) sum += weight(part);
    return sum;
  }

  void permute(Node& node) {
    if (node.kind == '(') return;
    for (std::size_t k = node.parts.size(); k > 1; --k)
      std::swap(node.parts[k - 1], node.parts[static_cast<std::size_t>(rng_.index(static_cast<int>(k)))]);
  }

  Hostility hostility_;
  Rng& rng_;
};

Bytes copyOf(Caller::Bytes bytes) { return {bytes.begin(), bytes.end()}; }

/// A question, and what a reference solution answers.
struct Honest {
  Bytes arguments{}, answer{};
};

/// Those of each function.
using Pool = std::map<std::uint32_t, std::vector<Honest>>;

WorkerRun askWorker(const RunnableCheck& check, const GradeOptions& options,
                    const std::function<void(Caller&)>& conversation) {
  return runWithWorker({.program = workerOf(check.info.part, options.worker),
                        .signature = options.signature,
                        .limits = options.limits,
                        .temporaryFolder = options.temporaryFolder},
                       conversation);
}

Pool recordHonestAnswers(std::span<const RunnableCheck> checks, const GradeOptions& options) {
  constexpr std::size_t kMostOfOne = 64, kLongest = 4u << 20;
  Pool pool;
  for (const RunnableCheck& check : checks) {
    Check judge(check.info, options.seed);
    const WorkerRun run = askWorker(check, options, [&](Caller& caller) {
      caller.tamperWithResults([&](std::uint32_t method, Caller::Bytes arguments, Caller::Bytes answer) {
        std::vector<Honest>& known = pool[method];
        if (known.size() < kMostOfOne && answer.size() + arguments.size() < kLongest)
          known.push_back({copyOf(arguments), copyOf(answer)});
        return answer;
      });
      static_cast<void>(judge.judge([&](Check& requirements) { check.run(requirements, caller); }));
    });
    if (run.failure)
      throw Error(
          {.what = "the reference solution fails in " + check.info.id, .found = run.failure->message});
  }
  return pool;
}

// Where in the bytes of the arguments the first one lies that has the layout of the result.
Bytes firstLikeTheResult(Caller::Bytes arguments, const std::vector<std::string>& layouts) {
  for (std::size_t k = 1; k < layouts.size(); ++k) {
    const std::size_t size = Parser(layouts[k], arguments).sizeOfFirst();
    if (layouts[k] == layouts[0])
      return {arguments.begin(), arguments.begin() + static_cast<std::ptrdiff_t>(size)};
    arguments = arguments.subspan(size);
  }
  return {};
}

/// Puts lies in the places of honest answers.
class Liar {
 public:
  Liar(Lie lie, const Pool& pool, const CallLayouts& layouts) : lie_(lie), pool_(pool), layouts_(layouts) {}

  Caller::Bytes tell(std::uint32_t method, Caller::Bytes arguments, Caller::Bytes honest) {
    Bytes last = std::exchange(last_[method], copyOf(honest));
    said_ = lie_ == Lie::constant     ? answerToAnother(method, arguments)
            : lie_ == Lie::lastAnswer ? std::move(last)
            : lie_ == Lie::echo       ? firstLikeTheResult(arguments, layouts_[method])
                                      : Bytes{};
    if (said_.empty()) said_ = spoilt(honest, layouts_[method].front(), Hostility::zero, rng_);
    return said_;
  }

 private:
  // What was right for the first other question that was ever asked.
  Bytes answerToAnother(std::uint32_t method, Caller::Bytes arguments) const {
    for (const Honest& one : pool_.at(method))
      if (!std::ranges::equal(one.arguments, arguments)) return one.answer;
    return {};
  }

  Lie lie_;
  const Pool& pool_;
  const CallLayouts& layouts_;
  std::map<std::uint32_t, Bytes> last_{};
  Bytes said_{};
  Rng rng_{};
};

int pointsFor(Liar liar, const RunnableCheck& check, const GradeOptions& options) {
  Check judge(check.info, options.seed);
  int points = 0;
  try {
    static_cast<void>(askWorker(check, options, [&](Caller& caller) {
      caller.tamperWithResults([&](std::uint32_t method, Caller::Bytes arguments, Caller::Bytes honest) {
        return liar.tell(method, arguments, honest);
      });
      points = judge.judge([&](Check& requirements) { check.run(requirements, caller); }).points;
    }));
  } catch (const std::logic_error&) {
    return 0;  // it cannot be judged, see giveHostileAnswers()
  }
  return points;
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
      if (outcome_.answers == before) break;  // it asks nothing
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
      answer = spoilt(honest, layouts_[method].front(), outcome_.hostility, rng_);
      allAreLies = allAreLies && !std::ranges::equal(answer, honest);
      ++outcome_.answers;
      return std::span<const std::byte>(answer);
    });
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
  switch (result.end) {
    case IsolatedEnd::kTookTooLong:
      return "it took too long";
    case IsolatedEnd::kOutOfMemory:
      return "it took too much memory";
    default:
      return fmt::format("signal {}, exit code {}", result.signal, result.exitCode);
  }
}

}  // namespace

std::string toString(Hostility hostility) {
  constexpr std::array<const char*, static_cast<std::size_t>(Hostility::count)> kNames = {
      "empty",    "huge",   "nan",      "inf",     "1e200",  "denormal", "zero",
      "constant", "ragged", "permuted", "shifted", "scaled", "integers", "mixed"};
  return kNames.at(static_cast<std::size_t>(hostility));
}

bool keepsNumbers(Hostility hostility) {
  constexpr auto kKeeping = std::to_array({Hostility::huge, Hostility::ragged, Hostility::permuted,
                                           Hostility::extremeIntegers, Hostility::mixed});
  return std::ranges::find(kKeeping, hostility) != kKeeping.end();
}

std::vector<std::byte> spoilt(std::span<const std::byte> answer, const std::string& layout,
                              Hostility hostility, Rng& rng) {
  Node node = Parser(layout, answer).all();
  if (!layout.empty()) Spoiler(hostility, rng).spoil(node);
  Bytes bytes;
  if (!layout.empty()) write(node, bytes);
  return bytes;
}

std::vector<HostileOutcome> giveHostileAnswers(std::span<const RunnableCheck> checks,
                                               const GradeOptions& options, const CallLayouts& layouts,
                                               std::int64_t answers) {
  const Pool pool = recordHonestAnswers(checks, options);
  const auto each = static_cast<std::int64_t>(checks.size()) * static_cast<std::int64_t>(Hostility::count);
  const std::int64_t ofEach = (answers + each - 1) / std::max<std::int64_t>(1, each);
  std::vector<HostileOutcome> outcomes;
  for (const RunnableCheck& check : checks) {
    for (int k = 0; k < static_cast<int>(Hostility::count); ++k) {
      HostileOutcome outcome{.check = check.info.id, .hostility = static_cast<Hostility>(k)};
      // What a whole run of the grader may take with one answer, for all of these together.
      const IsolatedResult result =
          callIsolated([&] { return toText(Attack(check, outcome.hostility, pool, layouts).run(ofEach)); },
                       {.cpuSeconds = 600, .wallSeconds = 1800, .memory = std::size_t{6} << 30});
      if (result.end == IsolatedEnd::kReturned)
        readText(result.bytes, outcome);
      else
        outcome.crash = describe(result);
      outcomes.push_back(std::move(outcome));
    }
  }
  return outcomes;
}

std::string toString(Lie lie) {
  constexpr std::array<const char*, static_cast<std::size_t>(Lie::count)> kNames = {"zeros", "constant",
                                                                                    "last answer", "echo"};
  return kNames.at(static_cast<std::size_t>(lie));
}

std::vector<LieOutcome> tellLies(std::span<const RunnableCheck> checks, const GradeOptions& options,
                                 const CallLayouts& layouts) {
  GradeOptions others = options;
  others.seed += 1000;  // constants that were right once
  const Pool pool = recordHonestAnswers(checks, others);
  std::vector<LieOutcome> outcomes;
  for (const RunnableCheck& check : checks)
    for (int k = 0; k < static_cast<int>(Lie::count); ++k) {
      const Lie lie = static_cast<Lie>(k);
      outcomes.push_back({.check = check.info.id,
                          .part = check.info.part,
                          .lie = lie,
                          .points = pointsFor(Liar(lie, pool, layouts), check, options)});
    }
  return outcomes;
}

}  // namespace rex::grading
