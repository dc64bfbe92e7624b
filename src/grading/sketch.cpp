#include "grading/sketch.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "grading/answer_value.h"
#include "remote/layout.h"

namespace rex::grading {
namespace {

using remote::combineHashes;

constexpr double kRoundedZero = 1e-9;  // what rounding leaves of a zero

// The finaliser of splitmix64.
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// Of number `i` in sum `k`: between -1 and 1, and the same everywhere.
double weight(std::uint64_t i, std::uint64_t k) {
  constexpr double kScale = 0x1p-52;
  return static_cast<double>(mixed(i * 4 + k + 1) >> 11) * kScale - 1;
}

double asNumber(const AnswerValue& value) {
  if (value.kind == 'd' || value.kind == 'f') return value.number;
  if (value.kind != 'i') return static_cast<double>(value.bits);
  const int unused = 64 - 8 * value.size;
  return static_cast<double>(static_cast<std::int64_t>(value.bits << unused) >> unused);
}

bool isNumber(const AnswerValue& value) {
  return std::string_view("dfiub").find(value.kind) != std::string_view::npos;
}

// Sizes and texts; numbers are left to `number`, in order.
template <class Number>
std::uint64_t hashForm(const AnswerValue& value, std::uint64_t hash, const Number& number) {
  if (isNumber(value)) return number(hash, asNumber(value));
  hash = combineHashes(hash, static_cast<unsigned char>(value.kind));
  if (!value.raw.empty()) {
    const std::string_view text(reinterpret_cast<const char*>(value.raw.data()), value.raw.size());
    hash = combineHashes(hash, remote::hashText(text));
  }
  hash = combineHashes(hash, value.kind == 'M' ? static_cast<std::uint64_t>(value.rows) : value.parts.size());
  for (const AnswerValue& part : value.parts) hash = hashForm(part, hash, number);
  return hash;
}

// The same for arguments that differ by rounding only: what was computed from an answer, or by another
// library.
std::uint64_t rounded(double x) {
  if (!(std::abs(x) > kRoundedZero)) return std::isnan(x) ? 1 : 0;
  constexpr std::uint32_t kHalf = 4;
  return (std::bit_cast<std::uint32_t>(static_cast<float>(x)) + kHalf) / (2 * kHalf);
}

std::uint64_t hashArguments(std::span<const std::byte> bytes, const std::vector<std::string>& layouts,
                            std::uint64_t hash) {
  for (std::size_t k = 1; k < layouts.size(); ++k) {
    const std::size_t size = sizeOfValue(bytes, layouts[k]);
    hash = hashForm(readAnswer(bytes.first(size), layouts[k]), hash,
                    [](std::uint64_t now, double x) { return combineHashes(now, rounded(x)); });
    bytes = bytes.subspan(size);
  }
  return mixed(hash);
}

}  // namespace

Sketch sketchOf(std::span<const std::byte> answer, const std::string& layout) {
  constexpr double kLargest = 1e100;
  Sketch sketch;
  std::uint64_t count = 0;
  const auto add = [&](std::uint64_t hash, double x) {
    const std::uint64_t i = count++;
    if (!std::isfinite(x)) return combineHashes(hash, std::isnan(x) ? i : ~i);
    x = std::clamp(x, -kLargest, kLargest);
    sketch.isWhole = sketch.isWhole && std::abs(x - std::round(x)) <= kRoundedZero;
    sketch.size = std::hypot(sketch.size, x);
    for (std::size_t k = 0; k < sketch.sums.size(); ++k) sketch.sums[k] += weight(i, k) * x;
    return hash;
  };
  const std::uint64_t form = hashForm(readAnswer(answer, layout), remote::hashText(layout), add);
  sketch.form = static_cast<std::uint32_t>(mixed(combineHashes(form, count)));
  return sketch;
}

bool agree(const Sketch& a, const Sketch& b) {
  constexpr double kRounding = 1e-5;
  if (a.threw || b.threw) return a.threw == b.threw;
  const double most = kRounding * std::max(a.size, b.size) + kRoundedZero;
  bool same = a.form == b.form && std::abs(a.size - b.size) <= most;
  for (std::size_t k = 0; k < a.sums.size(); ++k) same = same && std::abs(a.sums[k] - b.sums[k]) <= most;
  return same;
}

void CallSketcher::hear(std::uint32_t method, const std::string& function, Bytes arguments,
                        const std::optional<Bytes>& answer) {
  constexpr int kMostInCase = 100;
  constexpr std::size_t kMostCalls = 1000, kMostBytes = std::size_t{1} << 20;
  const std::size_t size = arguments.size() + (answer ? answer->size() : 0);
  if (method >= layouts_.size() || calls_.size() >= kMostCalls || bytes_ + size > kMostBytes ||
      ++callsInCase_[method] > kMostInCase)
    return;
  bytes_ += size;
  try {
    SketchedCall call{.function = function};
    if (answer)
      call.answer = sketchOf(*answer, layouts_[method].front());
    else
      call.answer.threw = true;
    call.key = hashArguments(arguments, layouts_[method], combineHashes(remote::hashText(function), case_));
    call.key = mixed(combineHashes(call.key, asked_[call.key]++));
    calls_.push_back(std::move(call));
  } catch (const Error&) {
  }
}

void CallSketcher::nextCase() {
  ++case_;
  callsInCase_.clear();
}

}  // namespace rex::grading
