#include "submission/cpp_text.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace rex::submission {
namespace {

bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

std::size_t behind(std::string_view mark, std::string_view source, std::size_t from) {
  const std::size_t at = source.find(mark, from);
  return at == source.npos ? source.size() : at + mark.size();
}

// A backslash before the end of the line continues the comment on the next.
std::size_t behindLineComment(std::string_view source, std::size_t at) {
  for (;;) {
    const std::size_t end = std::min(source.find('\n', at), source.size());
    const std::size_t last = source.substr(at, end - at).find_last_not_of(" \t\r\v\f");
    if (end == source.size() || last == source.npos || source[at + last] != '\\') return end;
    at = end + 1;
  }
}

// The position after digits and what may appear between them: 1'000, 0x1p-3.
std::size_t behindNumber(std::string_view source, std::size_t at) {
  const auto goesOn = [&](std::size_t i) {
    if (isWord(source[i]) || source[i] == '.') return true;
    if (source[i] == '\'') return i + 1 < source.size() && isWord(source[i + 1]);
    return (source[i] == '+' || source[i] == '-') &&
           std::string_view("eEpP").find(source[i - 1]) != std::string_view::npos;
  };
  while (at < source.size() && goesOn(at)) ++at;
  return at;
}

std::size_t behindWord(std::string_view source, std::size_t at) {
  while (at < source.size() && isWord(source[at])) ++at;
  return at;
}

std::size_t behindPlainQuotes(std::string_view source, std::size_t at) {
  const char quote = source[at++];
  while (at < source.size() && source[at] != quote && source[at] != '\n') at += source[at] == '\\' ? 2 : 1;
  if (at >= source.size()) return source.size();
  return source[at] == quote ? at + 1 : at;
}

// The position after R"x(...)x", whose quotes open at `at`; `at` itself if no such literal does. The standard
// allows 16 characters before the parenthesis.
std::size_t behindRawString(std::string_view source, std::size_t at, std::string_view prefix) {
  constexpr auto kPrefixes = std::to_array<std::string_view>({"R", "LR", "uR", "UR", "u8R"});
  constexpr std::size_t kLongestMark = 16;
  if (std::find(kPrefixes.begin(), kPrefixes.end(), prefix) == kPrefixes.end()) return at;
  const std::size_t size = source.substr(at + 1, kLongestMark + 1).find('(');
  if (size == source.npos) return at;
  std::string mark = ")";
  mark.append(source.substr(at + 1, size)).push_back('"');
  return behind(mark, source, at + 1 + size);
}

// The brackets of one kind that are open.
struct OpenBrackets {
  char open, close;
  std::vector<std::uint32_t> places{};
};

}  // namespace

bool isWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

CppText::CppText(std::string_view source) : source_(source) {
  bool startsLine = true;
  for (std::size_t at = 0; at < source.size();) {
    const char c = source[at], next = at + 1 < source.size() ? source[at + 1] : '\0';
    if (c == '\n') startsLine = true;
    if (c == '\n' || c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f') {
      ++at;
    } else if (c == '/' && next == '/') {
      at = behindLineComment(source, at);
    } else if (c == '/' && next == '*') {
      at = behind("*/", source, at + 2);
    } else {
      Token token{.startsLine = startsLine, .start = static_cast<std::uint32_t>(at)};
      std::size_t end = at + 1;
      if (isDigit(c) || (c == '.' && isDigit(next))) {
        token.kind = TokenKind::kNumber;
        end = behindNumber(source, at);
      } else if (isWord(c)) {
        token.kind = TokenKind::kWord;
        end = behindWord(source, at);
      } else if (c == '"' || c == '\'') {
        token.kind = TokenKind::kText;
        const bool isPrefixed = c == '"' && !tokens_.empty() && tokens_.back().end == at;
        if (isPrefixed) end = behindRawString(source, at, this->at(tokens_.size() - 1));
        if (!isPrefixed || end == at) end = behindPlainQuotes(source, at);
      }
      token.end = static_cast<std::uint32_t>(end);
      tokens_.push_back(token);
      startsLine = false;
      at = end;
    }
  }
  findPartners();
}

void CppText::findPartners() {
  std::array<OpenBrackets, 3> kinds = {
      {{.open = '(', .close = ')'}, {.open = '[', .close = ']'}, {.open = '{', .close = '}'}}};
  partners_.assign(size(), static_cast<std::uint32_t>(size()));
  for (std::uint32_t i = 0; i < size(); ++i) {
    if (tokens_[i].kind != TokenKind::kSign) continue;
    for (auto& [open, close, places] : kinds) {
      if (source_[tokens_[i].start] == open) places.push_back(i);
      if (source_[tokens_[i].start] != close || places.empty()) continue;
      partners_[i] = places.back();
      partners_[places.back()] = i;
      places.pop_back();
    }
  }
}

std::string_view CppText::at(std::size_t i) const {
  return i < size() ? source_.substr(tokens_[i].start, tokens_[i].end - tokens_[i].start)
                    : std::string_view{};
}

std::size_t CppText::nextLine(std::size_t i) const {
  for (++i; i < size(); ++i)
    if (tokens_[i].startsLine && !isSign(i - 1, '\\')) break;
  return std::min(i, size());
}

TextPlaces::TextPlaces(std::string_view text) : starts_{0} {
  for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 1))
    starts_.push_back(at + 1);
}

std::pair<int, int> TextPlaces::place(std::size_t position) const {
  const auto next = std::upper_bound(starts_.begin(), starts_.end(), position);
  return {static_cast<int>(next - starts_.begin()), static_cast<int>(position - *std::prev(next)) + 1};
}

int TextPlaces::line(std::size_t position) const { return place(position).first; }

// The compiler allows blanks between the backslash and the end of the line.
std::pair<std::string, std::vector<std::size_t>> spliced(std::string_view source) {
  std::string text;
  std::vector<std::size_t> places;
  text.reserve(source.size());
  places.reserve(source.size());
  for (std::size_t at = 0; at < source.size(); ++at) {
    const std::size_t end = source[at] == '\\' ? source.find_first_not_of(" \t\r\v\f", at + 1) : source.npos;
    if (end != source.npos && source[end] == '\n') {
      at = end;
      continue;
    }
    text += source[at];
    places.push_back(at);
  }
  return {std::move(text), std::move(places)};
}

}  // namespace rex::submission
