#include "submission/line_markers.h"

#include <algorithm>
#include <cctype>

#include "submission/mentions.h"

namespace rex::grading {
namespace {

constexpr std::string_view kDirectiveBlanks = " \t\v\f\r";

/// Searches a source whose lines have been joined at backslashes.
class MarkerSearch {
 public:
  MarkerSearch(std::string_view text, bool knowsComments) : text_(text), knowsComments_(knowsComments) {}

  // The position of the '#' of each marker.
  std::vector<std::size_t> find() {
    std::vector<std::size_t> found;
    for (std::size_t at = 0; at < text_.size();) {
      if (knowsComments_) at = behindComments(at);
      const std::size_t end = std::min(text_.find('\n', at), text_.size());
      for (std::size_t sign = at; sign < end; ++sign)
        if (isDirective(at, sign)) found.push_back(sign);
      at = end + 1;
    }
    return found;
  }

 private:
  // The position after the blanks and comments at `at`, which may span lines. If the line is inside a comment
  // that began on another one, "/*/" ends that comment. So whatever is skipped is indeed a comment, though
  // perhaps not all of it.
  std::size_t behindComments(std::size_t at) const {
    for (;;) {
      const std::size_t first = std::min(text_.find_first_not_of(kDirectiveBlanks, at), text_.size());
      if (text_.substr(first, 2) != "/*") return at;
      const std::size_t end = text_.find("*/", first + 1);
      if (end == text_.npos) return text_.size();
      at = end + 2;
    }
  }

  // Blanks and comments, also those that span lines, may follow the '#'.
  bool isDirective(std::size_t lineStart, std::size_t sign) const {
    const bool isHash = text_[sign] == '#',
               isDigraph = text_.substr(sign, 2) == "%:", isTrigraph = text_.substr(sign, 3) == "?\?=";
    if (!isHash && !isDigraph && !isTrigraph) return false;
    const std::string_view before = text_.substr(lineStart, sign - lineStart);
    const std::size_t last = before.find_last_not_of(kDirectiveBlanks);
    const bool isFirst = last == before.npos || before.substr(0, last + 1).ends_with("*/");
    std::size_t at = behindComments(sign + (isHash ? 1 : isDigraph ? 2 : 3));
    at = std::min(text_.find_first_not_of(kDirectiveBlanks, at), text_.size());
    const bool isNumber = at < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at])) != 0;
    const bool isLine = text_.substr(at, 4) == "line" && (at + 4 >= text_.size() || !isWord(text_[at + 4]));
    return isFirst && (isNumber || isLine);
  }

  std::string_view text_;
  bool knowsComments_;
};

}  // namespace

std::vector<CompileDiagnostic> lineMarkers(std::string_view source, const std::string& mainFile) {
  if (source.starts_with("\xEF\xBB\xBF")) source.remove_prefix(3);
  const auto [text, places] = spliced(source);
  std::vector<std::size_t> found = MarkerSearch(text, text.find("R\"") == text.npos).find();
  constexpr std::string_view kPragma = "system_header";
  for (std::size_t at = text.find(kPragma); at != text.npos; at = text.find(kPragma, at + 1))
    found.push_back(at);
  std::sort(found.begin(), found.end());
  std::vector<CompileDiagnostic> messages;
  for (const std::size_t at : found) {
    const auto before = source.substr(0, places[at]);
    const int line = static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1;
    const std::size_t lineStart = before.rfind('\n') + 1;  // npos + 1 is 0
    messages.push_back({mainFile, line, static_cast<int>(places[at] - lineStart) + 1, "error", "line-marker",
                        text[at] == 's'
                            ? "found the pragma system_header, wanted code that the compiler warns about"
                            : "found a #line directive, wanted the real line numbers of the file"});
  }
  return messages;
}

}  // namespace rex::grading
