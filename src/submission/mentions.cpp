#include "submission/mentions.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace rex::grading {

bool isWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

// The compiler allows blanks between the backslash and the end of the line.
std::pair<std::string, std::vector<std::size_t>> spliced(std::string_view source) {
  std::string text;
  std::vector<std::size_t> places;
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

namespace {

void blank(std::string& text, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < std::min(to, text.size()); ++i)
    if (text[i] != '\n') text[i] = ' ';
}

std::size_t after(std::string_view mark, const std::string& source, std::size_t from) {
  return std::min(source.find(mark, from), source.size() - std::min(mark.size(), source.size())) +
         mark.size();
}

// Whether the quote at `at` opens R"x(...)x", possibly with a prefix for another encoding.
bool opensRawString(const std::string& source, std::size_t at) {
  std::size_t start = at;
  while (start > 0 && isWord(source[start - 1])) --start;
  const std::string_view prefix = std::string_view(source).substr(start, at - start);
  return source[at] == '"' &&
         (prefix == "R" || prefix == "LR" || prefix == "uR" || prefix == "UR" || prefix == "u8R");
}

std::size_t behindRawString(const std::string& source, std::size_t at) {
  const std::size_t open = std::min(source.find('(', at), source.size());
  const std::string mark = ')' + source.substr(at + 1, open - at - 1) + '"';
  return std::min(after(mark, source, open), source.size());
}

// The position after digits and what may appear between them: 1'000, 0x1p-3.
std::size_t behindNumber(const std::string& source, std::size_t at) {
  const auto goesOn = [&](std::size_t i) {
    if (isWord(source[i]) || source[i] == '.') return true;
    if (source[i] == '\'') return i + 1 < source.size() && isWord(source[i + 1]);
    return (source[i] == '+' || source[i] == '-') &&
           std::string_view("eEpP").find(source[i - 1]) != std::string_view::npos;
  };
  while (at < source.size() && goesOn(at)) ++at;
  return at;
}

// The position after the comment, literal or number that starts at `at`, or `at` if none does.
std::size_t skipText(const std::string& source, std::size_t at) {
  if (source.compare(at, 2, "//") == 0) return std::min(source.find('\n', at), source.size());
  if (source.compare(at, 2, "/*") == 0) return std::min(after("*/", source, at + 2), source.size());
  const char quote = source[at];
  if (std::isdigit(static_cast<unsigned char>(quote)) && (at == 0 || !isWord(source[at - 1])))
    return behindNumber(source, at);
  if (quote != '"' && quote != '\'') return at;
  if (opensRawString(source, at)) return behindRawString(source, at);
  std::size_t end = at + 1;
  while (end < source.size() && source[end] != quote && source[end] != '\n')
    end += source[end] == '\\' ? 2 : 1;
  return std::min(end + 1, source.size());
}

}  // namespace

std::string codeOf(std::string_view source) {
  std::string code(source);
  for (std::size_t at = 0; at < code.size();) {
    const std::size_t end = skipText(code, at);
    blank(code, at, end);
    at = std::max(end, at + 1);
  }
  return code;
}

namespace {

std::vector<std::size_t> positionsOf(std::string_view word, const std::string& code) {
  std::vector<std::size_t> positions;
  for (std::size_t at = code.find(word); at != std::string::npos; at = code.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !isWord(code[at - 1])) && (end >= code.size() || !isWord(code[end])))
      positions.push_back(at);
  }
  return positions;
}

// Blanks out everything between the braces of main().
void removeMain(std::string& code) {
  for (const std::size_t at : positionsOf("main", code)) {
    const std::size_t open = code.find_first_of("{;", at);
    if (open == std::string::npos || code[open] == ';') continue;
    std::size_t end = open + 1;
    for (int depth = 1; end < code.size() && depth > 0; ++end)
      depth += (code[end] == '{') - (code[end] == '}');
    blank(code, open, end);
  }
}

// The position after the parenthesis that closes the one at `open`.
std::size_t behindParentheses(const std::string& code, std::size_t open) {
  std::size_t end = open + 1;
  for (int depth = 1; end < code.size() && depth > 0; ++end) depth += (code[end] == '(') - (code[end] == ')');
  return end;
}

// Whether "(...) ... {" follows, as after the name of a function that is defined there.
bool opensBody(const std::string& code, std::size_t at) {
  const std::size_t open = code.find_first_not_of(" \n\t\r", at);
  if (open == std::string::npos || code[open] != '(') return false;
  const std::size_t end = code.find_first_of("{;()=,}", behindParentheses(code, open));
  return end != std::string::npos && code[end] == '{';
}

int lineAt(std::size_t position, std::string_view source) {
  const std::string_view before = source.substr(0, position);
  return static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1;
}

std::pair<int, int> placeAt(std::size_t position, std::string_view source) {
  const std::size_t lineStart = source.substr(0, position).rfind('\n') + 1;  // npos + 1 is 0
  return {lineAt(position, source), static_cast<int>(position - lineStart) + 1};
}

}  // namespace

std::pair<int, int> standardInputUse(std::string_view source) {
  const std::string code = codeOf(source);
  std::size_t first = code.size();
  for (const char* word : {"cin", "stdin", "scanf", "getchar"})
    for (const std::size_t at : positionsOf(word, code)) first = std::min(first, at);
  if (first == code.size()) return {0, 0};
  return placeAt(first, source);
}

int macroDefinitionLineOf(std::string_view name, std::string_view source) {
  const auto [text, places] = spliced(source);
  const std::string code = codeOf(text);
  constexpr std::string_view kBlanks = " \t\v\f";
  for (const std::size_t at : positionsOf("define", code)) {
    const std::size_t before = code.find_last_not_of(kBlanks, at - std::min<std::size_t>(at, 1));
    const bool isDirective = at > 0 && before != code.npos &&
                             (code[before] == '#' || (before > 0 && code.compare(before - 1, 2, "%:") == 0));
    const std::size_t first = code.find_first_not_of(kBlanks, at + std::string_view("define").size());
    if (!isDirective || first == code.npos || code.compare(first, name.size(), name) != 0) continue;
    const std::size_t end = first + name.size();
    if (end == code.size() || !isWord(code[end])) return lineAt(places[at], source);
  }
  return 0;
}

Names namesIn(std::string_view code) {
  Names names;
  for (std::size_t at = 0; at < code.size(); ++at) {
    const std::size_t start = at;
    while (at < code.size() && isWord(code[at])) ++at;
    if (at > start) names.emplace(code.substr(start, at - start));
  }
  return names;
}

int definitionLineOf(std::string_view function, std::string_view source) {
  if (function.empty()) return 0;
  const std::string code = codeOf(source);
  for (const std::size_t at : positionsOf(function, code))
    if (opensBody(code, at + function.size())) return lineAt(at, source);
  return 0;
}

std::pair<int, int> onlyMentionOf(std::string_view function, std::string_view source) {
  const std::size_t colons = function.rfind("::");
  const std::string_view word = colons == function.npos ? function : function.substr(colons + 2);
  std::string code = codeOf(source);
  removeMain(code);
  const std::vector<std::size_t> positions = positionsOf(word, code);
  if (positions.size() != 1) return {0, 0};
  return placeAt(positions.front(), source);
}

}  // namespace rex::grading
