#include "submission/cpp_names.h"

#include <algorithm>
#include <array>

namespace rex::submission {
namespace {

std::pair<int, int> placeOf(std::size_t token, const CppText& text) {
  return TextPlaces(text.source()).place(text[token].start);
}

// Whether "(...) ... {" follows, as after the name of a function that is defined there.
bool opensBody(const CppText& text, std::size_t i) {
  if (!text.isSign(i, '(')) return false;
  constexpr std::string_view kSigns = "{;()=,}";
  for (i = text.partner(i) + 1; i < text.size(); ++i)
    if (text[i].kind == TokenKind::kSign && kSigns.find(text.at(i).front()) != kSigns.npos)
      return text.isSign(i, '{');
  return false;
}

// Whether the token, after splicing, is the word "define" of a directive.
bool isDefine(const CppText& text, std::size_t i) {
  if (text.at(i) != "define" || i == 0 || text[i].startsLine) return false;
  const bool isDigraph =
      i > 1 && text.isSign(i - 2, '%') && text.isSign(i - 1, ':') && text[i - 2].end == text[i - 1].start;
  return isDigraph || text.isSign(i - 1, '#');
}

}  // namespace

Names namesIn(const CppText& text, std::size_t first, std::size_t end) {
  Names names;
  for (std::size_t i = first; i < end; ++i)
    if (text.isName(i)) names.emplace(text.at(i));
  return names;
}

std::pair<int, int> standardInputUse(const CppText& text) {
  constexpr auto kWords = std::to_array<std::string_view>({"cin", "stdin", "scanf", "getchar"});
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text.isName(i) && std::find(kWords.begin(), kWords.end(), text.at(i)) != kWords.end())
      return placeOf(i, text);
  return {0, 0};
}

int macroDefinitionLine(std::string_view name, std::string_view source) {
  const auto [joined, places] = spliced(source);
  const CppText text(joined);
  for (std::size_t i = 0; i + 1 < text.size(); ++i)
    if (isDefine(text, i) && text.at(i + 1) == name && !text[i + 1].startsLine)
      return TextPlaces(source).line(places[text[i].start]);
  return 0;
}

int definitionLine(std::string_view function, const CppText& text) {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text.isName(i) && text.at(i) == function && opensBody(text, i + 1)) return placeOf(i, text).first;
  return 0;
}

std::pair<int, int> onlyMention(std::string_view function, const CppText& text) {
  const std::size_t colons = function.rfind("::");
  const std::string_view word = colons == function.npos ? function : function.substr(colons + 2);
  std::size_t found = text.size();
  bool isHeadOfMain = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.isName(i) && text.at(i) == "main") isHeadOfMain = true;
    if (text.isSign(i, ';')) isHeadOfMain = false;
    if (isHeadOfMain && text.isSign(i, '{')) {
      isHeadOfMain = false;
      i = text.partner(i);
    } else if (text.isName(i) && text.at(i) == word) {
      if (found < text.size()) return {0, 0};
      found = i;
    }
  }
  return found < text.size() ? placeOf(found, text) : std::pair{0, 0};
}

}  // namespace rex::submission
