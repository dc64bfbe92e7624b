#include "render/report.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <map>

#include <fmt/format.h>

#include "render/base64_internal.h"
#include "render/draw_film.h"
#include "render/glb.h"
#include "render/gzip_internal.h"
#include "render/png.h"
#include "render/report_page_internal.h"
#include "render/staged_file_internal.h"
#include "render/utf8_internal.h"

namespace rex {
namespace {

// Text that is nothing but text, between tags and in attributes with double quotes.
std::string escaped(std::string_view text) {
  std::string html;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    if (start > 0) html += '\n';
    for (const char c : internal::singleLine(text.substr(start, end - start))) {
      constexpr std::string_view kSpecial = "&<>\"'`";
      if (kSpecial.find(c) != std::string_view::npos)
        html += fmt::format("&#{};", static_cast<int>(c));
      else
        html += c;
    }
    start = end + 1;
  }
  return html;
}

std::string bytesOfHex(std::string_view digits) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
    unsigned value = 0;
    std::from_chars(digits.data() + i, digits.data() + i + 2, value, 16);
    bytes += static_cast<char>(value);
  }
  return bytes;
}

std::string stillOf(const Report& report) {
  Renderer renderer(report.still);
  const double aspect = static_cast<double>(report.still.width) / report.still.height;
  return encodePng(drawStill(report.film, framing(report.film, report.view, aspect), renderer));
}

std::string figuresOf(const Report& report) {
  if (report.figures.empty()) return {};
  std::string html = "<section class=\"figures\" aria-label=\"Figures\">\n";
  for (const ReportFigure& item : report.figures) {
    const std::string alt = escaped(internal::singleLine(item.figure.title));
    html += fmt::format(
        "<figure><img src=\"data:image/svg+xml;base64,{}\" alt=\"{}\" width=\"{}\" height=\"{}\">",
        internal::base64(encodeSvg(item.figure)), alt, item.figure.width, item.figure.height);
    if (!item.caption.empty()) html += "<figcaption>" + escaped(item.caption) + "</figcaption>";
    html += "</figure>\n";
  }
  return html + "</section>\n";
}

std::string factsOf(const Report& report) {
  if (report.facts.empty()) return {};
  std::string html = "<table>\n";
  for (const auto& [name, value] : report.facts)
    html += "<tr><th scope=\"row\">" + escaped(name) + "</th><td>" + escaped(value) + "</td></tr>\n";
  return html + "</table>\n";
}

// What is filled in is not searched again, so no text can ask for another.
std::string filled(std::string_view page, const std::map<std::string_view, std::string>& values) {
  std::string result;
  for (;;) {
    const std::size_t open = page.find("{{");
    result += page.substr(0, open);
    if (open == std::string_view::npos) return result;
    const std::size_t close = page.find("}}", open);
    assert(close != std::string_view::npos);
    result += values.at(page.substr(open + 2, close - open - 2));
    page.remove_prefix(close + 2);
  }
}

}  // namespace

std::string reportPage(const Report& report) {
  const std::string glb = glbOf(report.film, report.view);
  const internal::ReportPage page = internal::reportPage();
  return filled(page.page, {{"title", escaped(report.title)},
                            {"style", std::string(page.style)},
                            {"styleHash", internal::base64(bytesOfHex(page.styleHash))},
                            {"viewer", std::string(page.viewer)},
                            {"viewerHash", internal::base64(bytesOfHex(page.viewerHash))},
                            {"library", internal::base64(internal::gzip(page.library))},
                            {"libraryHash", internal::base64(bytesOfHex(page.libraryHash))},
                            {"layout", report.figures.empty() ? "alone" : "withFigures"},
                            {"still", internal::base64(stillOf(report))},
                            {"facts", factsOf(report)},
                            {"figures", figuresOf(report)},
                            {"film", internal::base64(glb)}});
}

void writeReport(const Report& report, const std::filesystem::path& path) {
  internal::writeWhole(path, reportPage(report));
}

}  // namespace rex
