#include "render/report.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <zlib.h>

#include "base/base64.h"
#include "base/escape.h"
#include "base/text.h"
#include "render/figure_internal.h"
#include "render/film.h"
#include "render/frame_sink_internal.h"
#include "render/glb.h"
#include "render/image.h"
#include "render/report_page_internal.h"
#include "render/text_internal.h"

namespace rex::internal {

/// Bytes packed as a gzip file without name and time: the same bytes each time.
[[nodiscard]] std::string gzip(std::string_view bytes);

std::string gzip(std::string_view bytes) {
  constexpr int kLargestWindow = 15, kAsGzip = 16, kDefaultMemory = 8;
  z_stream stream{};
  [[maybe_unused]] int status = deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED,
                                             kLargestWindow + kAsGzip, kDefaultMemory, Z_DEFAULT_STRATEGY);
  assert(status == Z_OK);
  std::string packed(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  status = deflate(&stream, Z_FINISH);
  assert(status == Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

}  // namespace rex::internal

namespace rex {
namespace {

// Escapes text for use between tags and in attributes with double quotes.
std::string escaped(std::string_view text) { return htmlText(internal::singleLines(text)); }

// The headline already gives the title.
Film withoutCaption(Film film, const std::string& title) {
  for (Frame& frame : film)
    std::erase_if(frame.picture.captions, [&](const Caption& caption) { return caption.text == title; });
  return film;
}

// The frames shown from `start` on, with the last one before it.
Film fromTime(const Film& film, double start) {
  const auto isLater = [&](const Frame& frame) { return frame.time > start; };
  const auto later = std::find_if(film.begin(), film.end(), isLater);
  return {later == film.begin() ? later : later - 1, film.end()};
}

std::string stillOf(const Film& film, const Report& report) {
  const RendererOptions& options = report.still;
  Renderer renderer(options);  // rejects sizes without an aspect ratio
  const Camera camera = framing(film, report.view, static_cast<double>(options.width) / options.height);
  return encodePng(drawStill(fromTime(film, report.start), camera, renderer));
}

// As the viewer reads it.
std::string partsOf(const Color& color) { return fmt::format("{} {} {}", color.r, color.g, color.b); }

// Left and right edge of the axes of a figure with marks, as shares of its width.
constexpr double kMarkedLeft = 0.19, kMarkedRight = 0.96;

/// A figure as an SVG, and where on it the viewer draws marks: "time share time share ...".
struct MarkedFigure {
  std::string svg, marks{};
};

MarkedFigure markedFigure(const ReportFigure& item) {
  const auto byX = [](const auto& a, const auto& b) { return a.second < b.second; };
  const auto [low, high] = std::minmax_element(item.marks.begin(), item.marks.end(), byX);
  if (item.marks.empty() || !(low->second < high->second)) return {encodeSvg(item.figure)};
  Figure figure = item.figure;
  if (!figure.xRange) figure.xRange = AxisRange{low->second, high->second};
  const auto [from, to] = *figure.xRange;
  MarkedFigure marked{internal::encodeSvg(
      figure,
      fmt::format("set lmargin at screen {}\nset rmargin at screen {}\n", kMarkedLeft, kMarkedRight))};
  for (const auto& [time, x] : item.marks)
    marked.marks += fmt::format("{:.3f} {:.4f} ", time,
                                kMarkedLeft + (kMarkedRight - kMarkedLeft) * (x - from) / (to - from));
  return marked;
}

std::string figuresOf(const Report& report) {
  if (report.figures.empty()) return {};
  std::string html = "<section class=\"figures\" aria-label=\"Figures\">\n";
  for (const ReportFigure& item : report.figures) {
    const std::string alt = escaped(internal::singleLine(item.figure.title));
    const MarkedFigure drawn = markedFigure(item);
    html += drawn.marks.empty()
                ? "<figure>"
                : "<figure><div class=\"marked\" data-marks=\"" + drawn.marks + "\"><i hidden></i>";
    html += fmt::format("<img src=\"data:image/svg+xml;base64,{}\" alt=\"{}\" width=\"{}\" height=\"{}\">",
                        base64(drawn.svg), alt, item.figure.width, item.figure.height);
    if (!drawn.marks.empty()) html += "</div>";
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

// Inserted text is not searched again, so it cannot contain placeholders.
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
  const Film film = withoutCaption(report.film, report.title);
  const std::string glb = toGlb(film, report.view);
  const internal::ReportTemplate parts = internal::reportTemplate();
  return filled(parts.html, {{"title", escaped(report.title)},
                             {"style", std::string(parts.style)},
                             {"styleHash", base64(bytesOfHex(parts.styleHash))},
                             {"viewer", std::string(parts.viewer)},
                             {"viewerHash", base64(bytesOfHex(parts.viewerHash))},
                             {"threeJs", base64(internal::gzip(parts.threeJs))},
                             {"threeJsHash", base64(bytesOfHex(parts.threeJsHash))},
                             {"layout", report.figures.empty() ? "alone" : "withFigures"},
                             {"backgroundTop", partsOf(report.still.backgroundTop)},
                             {"backgroundBottom", partsOf(report.still.backgroundBottom)},
                             {"still", base64(stillOf(film, report))},
                             {"start", fmt::format("{}", report.start)},
                             {"facts", factsOf(report)},
                             {"figures", figuresOf(report)},
                             {"film", base64(glb)}});
}

void writeReport(const Report& report, const std::filesystem::path& path) {
  internal::writeWhole(path, reportPage(report));
}

}  // namespace rex
