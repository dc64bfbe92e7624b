#include "grading/spoilt_answer.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

#include "grading/answer_value.h"

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

std::vector<std::byte> spoilt(std::span<const std::byte> answer, const std::string& layout,
                              Hostility hostility, Rng& rng) {
  AnswerValue value = readAnswer(answer, layout);
  if (layout.empty()) return {};
  Spoiler(hostility, rng).spoil(value);
  return bytesOf(value);
}

}  // namespace rex::grading
