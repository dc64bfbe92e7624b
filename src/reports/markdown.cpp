#include "reports/markdown.h"

#include <cctype>
#include <regex>
#include <set>

#include <fmt/format.h>
#include <md4c-html.h>

#include "base/error.h"

namespace rex::reports {
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
  constexpr unsigned kDialect = MD_DIALECT_GITHUB | MD_FLAG_NOHTML | MD_FLAG_LATEXMATHSPANS;
  if (md_html(markdown.data(), static_cast<MD_SIZE>(markdown.size()), append, &html, kDialect, 0) != 0)
    throw Error({.what = "cannot convert Markdown", .found = "no memory"});
  return html;
}

// Gives each link and picture its new target; without one, the text that stands for it.
std::string withTargets(const std::string& html,
                        const std::function<std::string(const std::string&)>& newTarget) {
  static const std::regex kTag(
      R"re(<a href="([^"]*)"([^>]*)>|<(/)a>|<img src="([^"]*)" alt="([^"]*)"([^>]*)>)re");
  std::string result;
  bool isDropped = false;  // the link that is open: links do not contain each other
  auto last = html.begin();
  for (std::sregex_iterator found(html.begin(), html.end(), kTag), end; found != end; ++found) {
    const std::smatch& tag = *found;
    result.append(last, tag[0].first);
    last = tag[0].second;
    if (tag[3].matched) {
      if (!isDropped) result += "</a>";
    } else if (tag[4].matched) {
      const std::string target = newTarget(tag[4]);
      result += target.empty()
                    ? tag[5].str()
                    : fmt::format("<img src=\"{}\" alt=\"{}\"{}>", target, tag[5].str(), tag[6].str());
    } else {
      const std::string target = newTarget(tag[1]);
      isDropped = target.empty();
      if (!isDropped) result += fmt::format("<a href=\"{}\"{}>", target, tag[2].str());
    }
  }
  return result.append(last, html.end());
}

std::string withFormulas(const std::string& html) {
  static const std::regex kFormula(R"re(<x-equation( type="display")?>([^<]*)</x-equation>)re");
  std::string result;
  auto last = html.begin();
  for (std::sregex_iterator found(html.begin(), html.end(), kFormula), end; found != end; ++found) {
    const std::smatch& formula = *found;
    result.append(last, formula[0].first);
    result += toMathMl(plainText(formula[2].str()), formula[1].matched);
    last = formula[0].second;
  }
  return result.append(last, html.end());
}

}  // namespace

std::string forInstalledRex(std::string markdown) {
  constexpr std::string_view kScript = "scripts/rex ", kInstalled = "rex ";
  for (std::size_t at = markdown.find(kScript); at != markdown.npos; at = markdown.find(kScript, at))
    markdown.replace(at, kScript.size(), kInstalled);
  return markdown;
}

std::string headingAnchor(std::string_view heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter) || c == '-' || c == '_' || letter >= 0x80)
      anchor += static_cast<char>(std::tolower(letter));
    if (c == ' ') anchor += '-';
  }
  return anchor;
}

MarkdownPage markdownPage(std::string_view markdown,
                          const std::function<std::string(const std::string&)>& newTarget) {
  static const std::regex kHeading(R"(<h([1-6])>([\s\S]*?)</h\1>)");
  const std::string html = withFormulas(withTargets(convert(markdown), newTarget));
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
    const std::string first = headingAnchor(section.title);
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

}  // namespace rex::reports
