#include "grading/spoilt_answer.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/text.h"

namespace rex::grading {
namespace {

using Bytes = std::vector<std::byte>;

constexpr double kFarOut = 1e200;

/// One value of an answer and its parts.
struct Node {
  char kind = ' ';            ///< the first character of its layout
  std::string layout{};       ///< of the whole value
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

  /// The size of the first value in bytes.
  std::size_t sizeOfFirst() {
    const std::size_t size = bytes_.size();
    static_cast<void>(value());
    return size - bytes_.size();
  }

 private:
  [[noreturn]] static void refuse() { throw Error({.what = "an answer does not match its layout"}); }

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
    const std::optional<int> value = takeNumber<int>(layout_);
    if (!value) refuse();
    return *value;
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

  // All parts share one layout, which is skipped if there are none.
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
    if (asked == Hostility::kMixed)
      hostility_ = static_cast<Hostility>(rng_.index(static_cast<int>(Hostility::kMixed)));
    if (node.kind == '[' || node.kind == '?' || node.kind == 'M') resize(node);
    for (Node& part : node.parts) {
      if (asked == Hostility::kMixed && rng_.uniform() < 0.5) continue;
      spoil(part);
    }
    if (hostility_ == Hostility::kPermuted) permute(node);
    change(node);
    hostility_ = asked;
  }

 private:
  void change(Node& node) {
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

  void resize(Node& node) {
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
  void fill(Node& node, std::size_t count) {
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
  Node node = Parser(layout, answer).all();
  if (!layout.empty()) Spoiler(hostility, rng).spoil(node);
  Bytes bytes;
  if (!layout.empty()) write(node, bytes);
  return bytes;
}

std::size_t sizeOfValue(std::span<const std::byte> bytes, const std::string& layout) {
  return Parser(layout, bytes).sizeOfFirst();
}

}  // namespace rex::grading
