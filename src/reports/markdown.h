#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace rex::reports {

/// A heading of a page and the text below it, up to the next heading.
struct PageSection {
  std::string title{};
  std::string anchor{};  ///< the id of the heading: "part-1-dead-reckoning"
  int level = 1;
  std::string text{};  ///< without markup
};

/// A page made from Markdown.
struct MarkdownPage {
  std::string html{};  ///< for the inside of a body; nothing in it comes from HTML in the source
  std::vector<PageSection> sections{};
};

/// Converts Markdown with tables and TeX between $ or $$, as GitHub reads it. `newTarget` gives the new
/// target of each link and picture; where it gives none, only their text remains. HTML in the source is shown
/// as text. Throws Error for formulas that toMathMl() does not know.
[[nodiscard]] MarkdownPage markdownPage(std::string_view markdown,
                                        const std::function<std::string(const std::string&)>& newTarget);

/// Documents speak of the source tree, where the command is `scripts/rex`; for others it is `rex`.
[[nodiscard]] std::string forInstalledRex(std::string markdown);

/// What GitHub makes of a heading in links: small letters and digits, blanks as dashes, nothing else.
[[nodiscard]] std::string headingAnchor(std::string_view heading);

/// Converts a formula to a <math> element of MathML Core, which browsers draw without a script or a font of
/// ours. Knows the part of TeX that formulas of a lecture need: scripts, \frac, \sqrt, \left and \right,
/// accents, \text, alphabets such as \mathbb, names of functions, Greek letters, usual signs, and the
/// environments matrix, pmatrix, bmatrix, cases and aligned. Throws Error for anything else.
[[nodiscard]] std::string toMathMl(std::string_view tex, bool isDisplayed);

}  // namespace rex::reports
