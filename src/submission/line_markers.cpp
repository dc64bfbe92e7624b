#include "submission/line_markers.h"

#include <algorithm>
#include <cctype>

#include "submission/cpp_text.h"

namespace rex::grading {
namespace {

constexpr std::string_view kDirectiveBlanks = " \t\v\f\r";
constexpr std::size_t kMostMarkers = 100;

/// Searches a source whose lines have been joined at backslashes.
class MarkerSearch {
 public:
  MarkerSearch(std::string_view text, bool knowsComments) : text_(text), knowsComments_(knowsComments) {
    skipBlanksAndComments();
  }

  // The position of the '#' of each marker.
  std::vector<std::size_t> find() const {
    std::vector<std::size_t> found;
    for (std::size_t at = 0; at < text_.size() && found.size() < kMostMarkers;) {
      if (knowsComments_) at = behind_[at];
      const std::size_t end = std::min(text_.find('\n', at), text_.size());
      bool isFirst = true;  // only blanks are before it, or a comment could be
      for (std::size_t sign = at; sign < end; ++sign) {
        if (isFirst && isDirective(sign)) found.push_back(sign);
        const bool isBlank = kDirectiveBlanks.find(text_[sign]) != kDirectiveBlanks.npos;
        isFirst = (isFirst && isBlank) || (sign > at && text_.substr(sign - 1, 2) == "*/");
      }
      at = end + 1;
    }
    return found;
  }

 private:
  // Finds where the blanks and comments that begin at each position end; comments may span lines. If the line
  // is inside a comment that began on another one, "/*/" ends that comment. So whatever is skipped is indeed
  // a comment, though perhaps not all of it.
  void skipBlanksAndComments() {
    const std::size_t size = text_.size();
    behind_.assign(size + 3, size);
    std::size_t close = size;  // the next "*/" after this position
    for (std::size_t at = size; at-- > 0;) {
      if (kDirectiveBlanks.find(text_[at]) != kDirectiveBlanks.npos)
        behind_[at] = behind_[at + 1];
      else
        behind_[at] = text_.substr(at, 2) == "/*" ? behind_[close + 2] : at;
      if (text_.substr(at, 2) == "*/") close = at;
    }
  }

  bool isDirective(std::size_t sign) const {
    const bool isHash = text_[sign] == '#',
               isDigraph = text_.substr(sign, 2) == "%:", isTrigraph = text_.substr(sign, 3) == "?\?=";
    if (!isHash && !isDigraph && !isTrigraph) return false;
    const std::size_t at = behind_[sign + (isHash ? 1 : isDigraph ? 2 : 3)];
    const bool isNumber = at < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at])) != 0;
    const bool isLine = at < text_.size() && text_.substr(at, 4) == "line" &&
                        (at + 4 >= text_.size() || !isWord(text_[at + 4]));
    return isNumber || isLine;
  }

  std::string_view text_;
  bool knowsComments_;
  std::vector<std::size_t> behind_{};
};

}  // namespace

std::vector<CompileDiagnostic> lineMarkers(std::string_view source, const std::string& mainFile) {
  if (source.starts_with("\xEF\xBB\xBF")) source.remove_prefix(3);
  const auto [text, places] = spliced(source);
  std::vector<std::size_t> found = MarkerSearch(text, text.find("R\"") == text.npos).find();
  constexpr std::string_view kPragma = "system_header";
  for (std::size_t at = text.find(kPragma); at != text.npos && found.size() < 2 * kMostMarkers;
       at = text.find(kPragma, at + 1))
    found.push_back(at);
  std::sort(found.begin(), found.end());
  const TextPlaces lines(source);
  std::vector<CompileDiagnostic> messages;
  for (const std::size_t at : found) {
    const auto [line, column] = lines.place(places[at]);
    messages.push_back({mainFile, line, column, "error", "line-marker",
                        text[at] == 's'
                            ? "found the pragma system_header, wanted code that the compiler warns about"
                            : "found a #line directive, wanted the real line numbers of the file"});
  }
  return messages;
}

}  // namespace rex::grading
