#include "grading/mentions.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace rex::grading {
namespace {

bool isWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

void blank(std::string& text, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < std::min(to, text.size()); ++i)
    if (text[i] != '\n') text[i] = ' ';
}

// The position behind the comment or literal that starts at `at`, or `at` when none does.
std::size_t skipText(const std::string& source, std::size_t at) {
  const auto behind = [&](std::string_view mark, std::size_t from) {
    return std::min(source.find(mark, from), source.size() - mark.size()) + mark.size();
  };
  if (source.compare(at, 2, "//") == 0) return std::min(source.find('\n', at), source.size());
  if (source.compare(at, 2, "/*") == 0) return behind("*/", at + 2);
  const char quote = source[at];
  // Behind a digit it separates groups of digits: 1'000.
  const bool opens = quote == '"' || (quote == '\'' && (at == 0 || !isWord(source[at - 1])));
  if (!opens) return at;
  std::size_t end = at + 1;
  while (end < source.size() && source[end] != quote && source[end] != '\n')
    end += source[end] == '\\' ? 2 : 1;
  return std::min(end + 1, source.size());
}

// The source with blanks for all that is not code; every character keeps its place.
std::string codeOf(std::string_view source) {
  std::string code(source);
  for (std::size_t at = 0; at < code.size();) {
    const std::size_t end = skipText(code, at);
    blank(code, at, end);
    at = std::max(end, at + 1);
  }
  return code;
}

std::vector<std::size_t> positionsOf(std::string_view word, const std::string& code) {
  std::vector<std::size_t> positions;
  for (std::size_t at = code.find(word); at != std::string::npos; at = code.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !isWord(code[at - 1])) && (end >= code.size() || !isWord(code[end])))
      positions.push_back(at);
  }
  return positions;
}

// Blanks out what stands between main's braces.
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

}  // namespace

std::pair<int, int> onlyMentionOf(std::string_view function, std::string_view source) {
  const std::size_t colons = function.rfind("::");
  const std::string_view word = colons == function.npos ? function : function.substr(colons + 2);
  std::string code = codeOf(source);
  removeMain(code);
  const std::vector<std::size_t> positions = positionsOf(word, code);
  if (positions.size() != 1) return {0, 0};
  const std::string_view before = source.substr(0, positions.front());
  const std::size_t lineStart = before.rfind('\n') + 1;  // npos + 1 is 0
  return {static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1,
          static_cast<int>(positions.front() - lineStart) + 1};
}

}  // namespace rex::grading
