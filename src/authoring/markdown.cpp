#include "authoring/markdown.h"

#include <cctype>
#include <regex>
#include <set>

#include <fmt/format.h>
#include <md4c-html.h>

#include "base/error.h"

namespace rex::grading {
namespace {

// The texts of md4c's HTML, which escapes with these names only.
std::string plainText(std::string_view html) {
  static const std::pair<std::string_view, char> kNames[] = {
      {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&amp;", '&'}};
  std::string text;
  bool inTag = false;
  for (std::size_t at = 0; at < html.size(); ++at) {
    if (html[at] == '<') inTag = true;
    if (!inTag) {
      char c = html[at] == '\n' ? ' ' : html[at];
      for (const auto& [name, letter] : kNames)
        if (html.substr(at, name.size()) == name) {
          c = letter;
          at += name.size() - 1;
          break;
        }
      if (c != ' ' || (!text.empty() && text.back() != ' ')) text += c;
    }
    if (html[at] == '>' && inTag) {
      inTag = false;
      if (!text.empty() && text.back() != ' ') text += ' ';
    }
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

std::string convert(std::string_view markdown) {
  std::string html;
  const auto append = [](const MD_CHAR* text, MD_SIZE size, void* to) {
    static_cast<std::string*>(to)->append(text, size);
  };
  constexpr unsigned kDialect = MD_DIALECT_GITHUB | MD_FLAG_NOHTML;
  if (md_html(markdown.data(), static_cast<MD_SIZE>(markdown.size()), append, &html, kDialect, 0) != 0)
    throw Error({.what = "cannot convert Markdown", .found = "no memory"});
  return html;
}

// Gives each link and picture its new target, or only its text.
std::string withTargets(const std::string& html,
                        const std::function<std::string(const std::string&)>& newTarget) {
  static const std::regex kLink(
      R"re(<a href="([^"]*)"( title="[^"]*")?>([\s\S]*?)</a>|<img src="([^"]*)")re");
  std::string result;
  auto last = html.begin();
  for (std::sregex_iterator found(html.begin(), html.end(), kLink), end; found != end; ++found) {
    const std::smatch& link = *found;
    result.append(last, link[0].first);
    last = link[0].second;
    if (link[4].matched) {
      result += fmt::format("<img src=\"{}\"", newTarget(link[4]));
      continue;
    }
    const std::string target = newTarget(link[1]);
    result += target.empty() ? link[3].str() : fmt::format("<a href=\"{}\">{}</a>", target, link[3].str());
  }
  return result.append(last, html.end());
}

}  // namespace

std::string anchorOf(std::string_view heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter) || c == '-' || c == '_' || letter >= 0x80)
      anchor += static_cast<char>(std::tolower(letter));
    if (c == ' ') anchor += '-';
  }
  return anchor;
}

MarkdownPage pageOf(std::string_view markdown,
                    const std::function<std::string(const std::string&)>& newTarget) {
  static const std::regex kHeading(R"(<h([1-6])>([\s\S]*?)</h\1>)");
  const std::string html = withTargets(convert(markdown), newTarget);
  MarkdownPage page;
  std::set<std::string> taken;
  auto last = html.begin();
  for (std::sregex_iterator found(html.begin(), html.end(), kHeading), end; found != end; ++found) {
    const std::smatch& heading = *found;
    const std::string before(last, heading[0].first);
    if (!page.sections.empty()) page.sections.back().text = plainText(before);
    page.html += before;
    last = heading[0].second;
    PageSection section{.title = plainText(heading[2].str()), .level = std::stoi(heading[1])};
    const std::string first = anchorOf(section.title);
    section.anchor = first;
    for (int again = 1; !taken.insert(section.anchor).second; ++again)
      section.anchor = fmt::format("{}-{}", first, again);
    page.html += fmt::format("<h{0} id=\"{1}\">{2}</h{0}>", section.level, section.anchor, heading[2].str());
    page.sections.push_back(std::move(section));
  }
  const std::string rest(last, html.end());
  if (!page.sections.empty()) page.sections.back().text = plainText(rest);
  page.html += rest;
  return page;
}

}  // namespace rex::grading
