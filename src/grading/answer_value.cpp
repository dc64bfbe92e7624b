#include "grading/answer_value.h"

#include <charconv>
#include <cstring>
#include <string_view>
#include <utility>

#include "base/error.h"

namespace rex::grading {
namespace {

using Bytes = std::vector<std::byte>;

/// Takes answers apart by their layout.
class AnswerParser {
 public:
  AnswerParser(std::string_view layout, std::span<const std::byte> bytes) : layout_(layout), bytes_(bytes) {}

  AnswerValue all() {
    AnswerValue node = layout_.empty() ? AnswerValue{} : value();
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

  AnswerValue value() {
    const std::string_view start = layout_;
    AnswerValue node{.kind = next()};
    read(node);
    node.layout = start.substr(0, start.size() - layout_.size());
    return node;
  }

  void read(AnswerValue& node) {
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
  void repeat(AnswerValue& node, std::uint64_t count) {
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

void write(const AnswerValue& node, Bytes& bytes) {
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
  for (const AnswerValue& part : node.parts) write(part, bytes);
}

}  // namespace

AnswerValue readAnswer(std::span<const std::byte> bytes, const std::string& layout) {
  return AnswerParser(layout, bytes).all();
}

std::vector<std::byte> toBytes(const AnswerValue& value) {
  Bytes bytes;
  write(value, bytes);
  return bytes;
}

std::size_t sizeOfValue(std::span<const std::byte> bytes, const std::string& layout) {
  return AnswerParser(layout, bytes).sizeOfFirst();
}

void forEachNumber(AnswerValue& value, const std::function<void(double&)>& run) {
  if (value.kind == 'd' || value.kind == 'f') run(value.number);
  for (AnswerValue& part : value.parts) forEachNumber(part, run);
}

}  // namespace rex::grading
