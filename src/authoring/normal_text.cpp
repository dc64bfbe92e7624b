#include "authoring/normal_text.h"

#include <algorithm>
#include <array>
#include <utility>

namespace rex::grading {
namespace {

// Both ways to write them: the second is that of htmlText().
constexpr std::array<std::pair<std::string_view, char>, 10> kMeanings = {{{"&lt;", '<'},
                                                                          {"&gt;", '>'},
                                                                          {"&amp;", '&'},
                                                                          {"&quot;", '"'},
                                                                          {"&#60;", '<'},
                                                                          {"&#62;", '>'},
                                                                          {"&#38;", '&'},
                                                                          {"&#34;", '"'},
                                                                          {"&#39;", '\''},
                                                                          {"\\\"", '"'}}};
// Line breaks and tabs in literals, and lines that continue on the next.
constexpr std::array<std::string_view, 5> kNothing = {"\\n", "\\t", "\\r", "\\\n", "\\\r\n"};
constexpr std::array<std::string_view, 3> kCommentSigns = {"//", "/*", "*/"};

// The comment at the start of `rest`, or nothing.
std::string_view commentAt(std::string_view rest) {
  if (rest.starts_with("//")) return rest.substr(0, std::min(rest.find('\n'), rest.size()));
  if (!rest.starts_with("/*")) return {};
  return rest.substr(0, std::min(rest.find("*/", 2), rest.size() - 2) + 2);
}

// Text at the start of `rest` that is ignored.
std::string_view emptyAt(std::string_view rest, Comments comments) {
  if (rest[0] == '/' && comments == Comments::kDrop) return commentAt(rest);
  if (rest[0] == '/' || rest[0] == '*') {
    for (const std::string_view sign : kCommentSigns)
      if (rest.starts_with(sign)) return sign;
  }
  if (rest[0] == '\\') {
    for (const std::string_view escape : kNothing)
      if (rest.starts_with(escape)) return escape;
  }
  return {};
}

// The length of what represents a letter at the start of `rest`, and that letter (perhaps by itself).
std::pair<std::size_t, char> letterAt(std::string_view rest) {
  if (rest[0] == '&' || rest[0] == '\\')
    for (const auto& [text, letter] : kMeanings)
      if (rest.starts_with(text)) return {text.size(), letter};
  return {1, rest[0]};
}

}  // namespace

NormalText normalText(std::string_view text, Comments comments) {
  NormalText normal;
  int line = 1;
  while (!text.empty()) {
    const std::string_view empty = emptyAt(text, comments);
    const auto [size, letter] = empty.empty() ? letterAt(text) : std::pair{empty.size(), '\0'};
    // The zero bytes of text in UTF-16 vanish here, too.
    if (static_cast<unsigned char>(letter) > ' ') {
      normal.letters += letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
      normal.lines.push_back(line);
    }
    line += static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(size), '\n'));
    text.remove_prefix(size);
  }
  return normal;
}

}  // namespace rex::grading
