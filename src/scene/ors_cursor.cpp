#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "scene/ors_cursor_internal.h"
#include "scene/ors_limits_internal.h"

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

bool isControl(char c) { return (c >= 0 && c < 0x20) || c == 0x7f; }

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

}  // namespace rex::ors
