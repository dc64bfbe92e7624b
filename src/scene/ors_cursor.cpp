#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "scene/ors_cursor_internal.h"
#include "scene/ors_limits_internal.h"

namespace rex::ors {
namespace {

// Whether a number that no double holds is too near to zero for one, rather than too far from it.
bool isTiny(const char* first, const char* last) {
  long double parsed = 0;
  return std::from_chars(first, last, parsed).ec == std::errc() && std::abs(parsed) < 1;
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
  const std::size_t end = std::min(text_.find_first_of(" \t\r\n,;(){}[]<>=", at_ + 1), at_ + 40);
  std::string shown;
  for (const char c : text_.substr(at_, end - at_)) {
    const auto byte = static_cast<unsigned char>(c);
    shown += byte < 0x20 || byte == 0x7f ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
  }
  return "'" + shown + "'";
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
  const std::size_t start = std::exchange(at_, end);
  return std::string(text_.substr(start, end - start));
}

std::string Cursor::upTo(char closing, const Place& open, const char* what) {
  const std::size_t end = text_.find(closing, at_);
  if (end == std::string_view::npos)
    failAt(open, fmt::format("{} is never closed", what), "", fmt::format("a second {}", closing));
  if (end - at_ > kLongestWord)
    failAt(open, fmt::format("{} is too long", what), fmt::format("{} bytes", end - at_),
           fmt::format("at most {}", kLongestWord));
  std::string text(text_.substr(at_, end - at_));
  while (at_ <= end) take();
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
