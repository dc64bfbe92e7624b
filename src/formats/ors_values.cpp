#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "formats/ors_attributes_internal.h"
#include "formats/ors_values_internal.h"
#include "geometry/rotation.h"

namespace rex::ors {
namespace {

constexpr std::string_view kBlank = " \t\r\n";

// Whether a number that does not fit into a double is too close to zero, rather than too far from it.
bool isTiny(const char* first, const char* last) {
  long double parsed = 0;
  return std::from_chars(first, last, parsed).ec == std::errc() && std::abs(parsed) < 1;
}

// The number of bytes of the UTF-8 character at the start of `text`; 0: there is none.
std::size_t letterLength(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned lead = byte(0), next = byte(1);
  const bool isWide = lead >= 0xc2 && lead < 0xf5;
  const std::size_t length = lead < 0x80 ? 1 : !isWide ? 0 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  const bool isOverlong = (lead == 0xe0 && next < 0xa0) || (lead == 0xf0 && next < 0x90);
  const bool isNone = (lead == 0xed && next >= 0xa0) || (lead == 0xf4 && next >= 0x90);
  return isOverlong || isNone ? 0 : length;
}

bool isControl(unsigned char c) { return c < 0x20 || c == 0x7f; }

// `text` as a message shows it: one line of UTF-8.
std::string shown(std::string_view text) {
  std::string line;
  while (!text.empty()) {
    const std::size_t length = letterLength(text);
    const bool isText = length > 0 && !isControl(text[0]);
    line += isText ? std::string(text.substr(0, length))
                   : fmt::format("\\x{:02x}", static_cast<unsigned char>(text[0]));
    text.remove_prefix(isText ? length : 1);
  }
  return line;
}

}  // namespace

char Cursor::take() {
  const char c = text_[at_++];
  if (c == '\n') {
    ++line_;
    lineStart_ = at_;
  }
  return c;
}

void Cursor::skip(std::string_view set) {
  while (!atEnd() && contains(set, peek())) take();
}

void Cursor::skipSpaceAndComments() {
  for (;;) {
    skip(" \t\r\n,");
    if (peek() != '#') return;
    at_ = std::min(text_.find('\n', at_), text_.size());
  }
}

std::string Cursor::found() const {
  if (atEnd()) return "the end of the file";
  if (peek() == '\n' || peek() == '\r') return "the end of the line";
  std::size_t end = std::min({text_.find_first_of(" \t\r\n,;(){}[]<>=", at_ + 1), at_ + 40, text_.size()});
  while (end < text_.size() && end > at_ + 37 && (text_[end] & 0xc0) == 0x80)
    --end;  // never half a character
  return "'" + shown(text_.substr(at_, end - at_)) + "'";
}

void Cursor::countWord() {
  if (++budget_.words > kMostWords)
    fail("too many names and numbers", "", fmt::format("at most {}", kMostWords));
}

std::string Cursor::word(std::string_view terminators) {
  countWord();
  const std::size_t end = std::min(text_.find_first_of(terminators, at_), text_.size());
  if (end - at_ > kLongestWord)
    fail("word too long", fmt::format("{} bytes", end - at_), fmt::format("at most {}", kLongestWord));
  return textUpTo(end);
}

std::string Cursor::textUpTo(std::size_t end) {
  const std::size_t start = at_;
  while (at_ < end) {
    const std::size_t length = letterLength(text_.substr(at_, end - at_));
    if (length == 0 || (isControl(peek()) && !contains(kBlank, peek()))) failAtByte();
    for (std::size_t i = 0; i < length; ++i) take();
  }
  return std::string(text_.substr(start, end - start));
}

void Cursor::failAtByte() const {
  const char c = peek();
  const std::string byte = "'" + shown(text_.substr(at_, 1)) + "'";
  if (c == 0) fail("a zero byte, as in UTF-16 text", byte, "UTF-8");
  if (isControl(c)) fail("a control character", byte, "text");
  fail("a byte that is not UTF-8", byte, "text in UTF-8; only comments may have other bytes");
}

std::string Cursor::upTo(char closing, const Place& open, const char* what) {
  const std::size_t end = text_.find(closing, at_);
  if (end == std::string_view::npos)
    failAt(open, fmt::format("{} is never closed", what), "", fmt::format("a second {}", closing));
  if (end - at_ > kLongestWord)
    failAt(open, fmt::format("{} is too long", what), fmt::format("{} bytes", end - at_),
           fmt::format("at most {}", kLongestWord));
  std::string text = textUpTo(end);
  take();
  return text;
}

double Cursor::number(const char* wanted, bool mayBeInfinite) {
  const char* const last = text_.data() + text_.size();
  const char* const first = text_.data() + at_ + (peek() == '+' ? 1 : 0);
  double parsed = 0;
  const auto [end, error] = std::from_chars(first, last, parsed);
  const bool hasOneSign = peek() != '+' || first == last || *first != '-';
  const bool followed = end == last || contains(" \t\r\n,;})]>#", *end);
  const bool inRange = std::isfinite(parsed) || (mayBeInfinite && std::isinf(parsed));
  const bool isRead = error == std::errc() || (error == std::errc::result_out_of_range && isTiny(first, end));
  if (!isRead || !hasOneSign || !followed || !inRange) fail("not a number", found(), wanted);
  countWord();
  at_ = static_cast<std::size_t>(end - text_.data());
  return parsed;
}

void Cursor::warn(const Place& where, std::string text) const {
  if (budget_.notes.size() < kMostNotes)
    budget_.notes.push_back({where, std::move(text), Severity::kWarning});
}

void Cursor::fail(std::string what, std::string found, std::string wanted) const {
  failAt(here(), std::move(what), std::move(found), std::move(wanted));
}

void Cursor::failAt(const Place& where, std::string what, std::string found, std::string wanted) {
  throw Error(
      {.what = std::move(what), .where = where, .found = std::move(found), .wanted = std::move(wanted)});
}

namespace {

constexpr std::string_view kSpace = " \t\r\n";

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// The numbers of an array, row after row.
struct Rows {
  std::vector<double> numbers{};
  std::size_t rowStart = 0, columns = 0;
  bool mayDiffer = false;

  void end(const Cursor& cursor) {
    const std::size_t length = numbers.size() - rowStart;
    if (length == 0) return;
    if (columns != 0 && length != columns && !mayDiffer) {
      cursor.fail("row of an array", fmt::format("{} numbers", length),
                  fmt::format("{}, as in the first row", columns));
    }
    columns = length;
    rowStart = numbers.size();
  }
};

std::pair<int, int> readDimensions(Cursor& cursor) {
  cursor.take();
  std::vector<int> sizes;
  for (cursor.skip(" \t"); cursor.peek() != '>'; cursor.skip(" \t")) {
    const double size = cursor.number("a dimension or '>'");
    if (size < 0 || size > static_cast<double>(kMostNumbers) || size != std::floor(size))
      cursor.fail("array dimension", fmt::format("{}", size), "a count");
    sizes.push_back(static_cast<int>(size));
  }
  cursor.take();
  if (sizes.empty() || sizes.size() > 2)
    cursor.fail("array dimensions", fmt::format("{} of them", sizes.size()), "one or two");
  return sizes.size() == 1 ? std::pair(1, sizes[0]) : std::pair(sizes[0], sizes[1]);
}

Eigen::VectorXd readNumbers(Cursor& cursor, int count, const char* wanted) {
  Eigen::VectorXd values(count);
  for (double& value : values) {
    cursor.skip(kSpace);
    if (cursor.peek() == ',')
      cursor.fail("a comma in a pose", cursor.found(), fmt::format("{} separated by blanks", wanted));
    if (cursor.atEnd() || contains(")>", cursor.peek()))
      cursor.fail("too few numbers in a pose", cursor.found(), wanted);
    value = cursor.number(wanted);
  }
  return values;
}

Eigen::Matrix3d rotationFromFile(const Place& where, const Eigen::Vector4d& quaternion) {
  if (quaternion.isZero(0))
    Cursor::failAt(where, "quaternion", "(0, 0, 0, 0)", "a quaternion w x y z that is not zero");
  return rotationFromQuaternion(quaternion);
}

Pose readPoseElement(Cursor& cursor) {
  const Place start = cursor.here();
  if (cursor.atNumber()) {
    const Eigen::VectorXd n = readNumbers(cursor, 7, "x y z qw qx qy qz");
    return {rotationFromFile(start, n.tail<4>()), n.head<3>()};
  }
  const char kind = cursor.peek();
  if (!contains("tdrqE", kind) || cursor.found() != fmt::format("'{}'", kind)) {
    cursor.fail("unknown element of a pose", cursor.found(),
                "t(..), d(..), r(..), q(..), E(..), seven numbers, or '>'");
  }
  cursor.take();
  const std::string name = fmt::format("pose element '{}'", kind);
  if (cursor.peek() != '(') cursor.fail(name, cursor.found(), "'('");
  cursor.take();
  const bool three = kind == 't' || kind == 'E';
  const Eigen::VectorXd n = readNumbers(cursor, three ? 3 : 4, three ? "three numbers" : "four numbers");
  cursor.skip(kSpace);
  if (cursor.peek() != ')') cursor.fail(name, cursor.found(), fmt::format("')' after {} numbers", n.size()));
  cursor.take();
  if ((kind == 'd' || kind == 'r') && n[0] != 0 && n.tail<3>().isZero(0))
    cursor.warn(start, name + " about a zero axis has no effect: give the axis x y z");
  switch (kind) {
    case 't':
      return translation(n[0], n[1], n[2]);
    case 'd':
      return rotation(n[0] * std::numbers::pi / 180, n.tail<3>());
    case 'r':
      return rotation(n[0], n.tail<3>());
    case 'q':
      return {rotationFromFile(start, n), Eigen::Vector3d::Zero()};
    default:
      return {rotationFromRollPitchYaw(n), Eigen::Vector3d::Zero()};
  }
}

// Elements apply left to right, each relative to the frame so far.
Pose readPose(Cursor& cursor, const Place& open) {
  Pose X;
  for (cursor.skip(" \t\r\n|<"); cursor.peek() != '>'; cursor.skip(" \t\r\n|")) {
    if (cursor.atEnd()) Cursor::failAt(open, "'<T' is never closed", "", "a '>'");
    X = X * readPoseElement(cursor);
  }
  if (!X.p.allFinite()) Cursor::failAt(open, "pose", "a position beyond the range of numbers", "metres");
  cursor.take();
  return X;
}

}  // namespace

Eigen::MatrixXd readArray(Cursor& cursor) {
  const Place open = cursor.here();
  cursor.take();
  cursor.skip(kSpace);
  std::optional<std::pair<int, int>> dimensions;
  if (cursor.peek() == '<') dimensions = readDimensions(cursor);
  Rows rows{.mayDiffer = dimensions.has_value()};
  for (cursor.skip(" \t\r,"); cursor.peek() != ']'; cursor.skip(" \t\r,")) {
    if (cursor.atEnd()) Cursor::failAt(open, "'[' is never closed", "", "a ']'");
    if (cursor.peek() == ';' || cursor.peek() == '\n') {
      rows.end(cursor);
      cursor.take();
    } else {
      rows.numbers.push_back(cursor.number("a number or ']'", true));
      if (rows.numbers.size() > kMostNumbers)
        Cursor::failAt(open, "array too long", "", fmt::format("at most {} numbers", kMostNumbers));
    }
  }
  rows.end(cursor);
  cursor.take();
  const auto count = static_cast<Eigen::Index>(rows.numbers.size());
  if (!dimensions) {
    const auto columns = static_cast<Eigen::Index>(rows.columns);
    return Eigen::Map<const RowMajor>(rows.numbers.data(), columns == 0 ? 0 : count / columns, columns);
  }
  const auto [height, width] = *dimensions;
  if (Eigen::Index{height} * width != count) {
    Cursor::failAt(open, "array with explicit dimensions", fmt::format("{} numbers", count),
                   fmt::format("{} x {}", height, width));
  }
  return Eigen::Map<const RowMajor>(rows.numbers.data(), height, width);
}

Value readTyped(Cursor& cursor) {
  const Place open = cursor.here();
  cursor.take();
  cursor.skip(kSpace);
  const std::string type = cursor.word(" \t\r\n>|");
  if (type == "T") return readPose(cursor, open);
  return type + cursor.upTo('>', open, "'<'");
}

}  // namespace rex::ors
