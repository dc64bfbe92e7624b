#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "base/error.h"
#include "render/figure_script_internal.h"
#include "render/figure_style_internal.h"
#include "render/figure_view_internal.h"
#include "render/utf8_internal.h"

namespace rex::internal {
namespace {

using Range = std::optional<std::pair<double, double>>;

// gnuplot runs the shell for backticks in double quotes. In single quotes only ' itself has a meaning, and
// doubling it fails at the start of a text (5.4); so it goes into double quotes, alone.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : singleLine(text)) result += c == '\'' ? R"('."'".')" : std::string(1, c);
  return result + "'";
}

std::string nameOf(const Figure& figure) { return fmt::format("figure '{}'", singleLine(figure.title)); }

std::string nameOf(const Figure& figure, std::size_t index) {
  const std::string& label = figure.series[index].label;
  return nameOf(figure) + (label.empty() ? fmt::format(", series {}", index)
                                         : fmt::format(", series '{}'", singleLine(label)));
}

void requireValues(const std::vector<double>& values, bool logarithmic, const std::string& name, char axis) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool good = std::isfinite(values[i]) && (!logarithmic || values[i] > 0);
    if (good) continue;
    throw Error(
        {.what = name,
         .found = fmt::format("{}[{}] = {}", axis, i, values[i]),
         .wanted = logarithmic ? "finite numbers above 0, for the logarithmic axis" : "finite numbers"});
  }
}

void requireRange(const Range& range, bool logarithmic, const std::string& name, char axis) {
  if (!range) return;
  const auto [low, high] = *range;
  const bool good = std::isfinite(low) && std::isfinite(high) && low < high && (!logarithmic || low > 0);
  if (!good)
    throw Error({.what = fmt::format("{}, range of {}", name, axis),
                 .found = fmt::format("{} to {}", low, high),
                 .wanted = logarithmic ? "0 < low < high" : "low < high"});
}

std::string hex(const Color& color) {
  const auto byte = [](float part) { return std::lround(255 * std::clamp(part, 0.f, 1.f)); };
  return fmt::format("#{:02X}{:02X}{:02X}", byte(color.r), byte(color.g), byte(color.b));
}

const char* placeOf(Legend legend) {
  switch (legend) {
    case Legend::kTopRight:
      return "set key top right";
    case Legend::kTopLeft:
      return "set key top left";
    case Legend::kBottomRight:
      return "set key bottom right";
    case Legend::kBottomLeft:
      return "set key bottom left";
    case Legend::kNone:
      return "set key off";
  }
  return "";
}

const char* drawingOf(const Series& series) {
  if (series.y.size() == 1) return "points";  // one point makes no line
  switch (series.style) {
    case SeriesStyle::kLine:
      return "lines";
    case SeriesStyle::kPoints:
      return "points";
    case SeriesStyle::kLinesPoints:
      return "linespoints";
  }
  return "";
}

using Script = std::back_insert_iterator<std::string>;

void addRange(Script out, const Range& range, char axis) {
  // {:e} has a decimal exponent always, so that no number is read as an integer.
  if (range) fmt::format_to(out, "set {}range [{:.17e}:{:.17e}]\n", axis, range->first, range->second);
}

void addData(Script out, const Series& series, std::size_t index) {
  fmt::format_to(out, "$d{} << EOD\n", index);
  for (std::size_t i = 0; i < series.y.size(); ++i)
    fmt::format_to(out, "{} {}\n", series.x.empty() ? static_cast<double>(i) : series.x[i], series.y[i]);
  fmt::format_to(out, "EOD\n");
}

void addCurve(Script out, const Series& series, std::size_t index) {
  fmt::format_to(out, "{}$d{} using 1:2 with {} lt {}", index == 0 ? "plot " : ", ", index, drawingOf(series),
                 index + 1);
  if (series.color) fmt::format_to(out, " lc rgb '{}'", hex(*series.color));
  if (series.dashed) fmt::format_to(out, " dt (12,7)");
  if (series.label.empty())
    fmt::format_to(out, " notitle");
  else
    fmt::format_to(out, " title {} noenhanced", quoted(series.label));
}

}  // namespace

void requireDrawable(const Figure& figure) {
  const std::string name = nameOf(figure);
  if (figure.series.empty()) throw Error({.what = name, .found = "no series", .wanted = "at least one"});
  const auto inRange = [](int size) { return size >= 100 && size <= 8192; };
  if (!inRange(figure.width) || !inRange(figure.height))
    throw Error({.what = name,
                 .found = fmt::format("a size of {} x {}", figure.width, figure.height),
                 .wanted = "100 to 8192 pixels each way"});
  requireRange(figure.xRange, figure.logX, name, 'x');
  requireRange(figure.yRange, figure.logY, name, 'y');
  for (std::size_t k = 0; k < figure.series.size(); ++k) {
    const Series& series = figure.series[k];
    if (series.y.empty())
      throw Error({.what = nameOf(figure, k), .found = "no points", .wanted = "at least one"});
    if (!series.x.empty() && series.x.size() != series.y.size())
      throw Error({.what = nameOf(figure, k),
                   .found = fmt::format("{} x and {} y", series.x.size(), series.y.size()),
                   .wanted = "as many x as y"});
    if (series.x.empty() && figure.logX)
      throw Error({.what = nameOf(figure, k), .found = "no x", .wanted = "x for the logarithmic axis"});
    requireValues(series.x, figure.logX, nameOf(figure, k), 'x');
    requireValues(series.y, figure.logY, nameOf(figure, k), 'y');
  }
  requireDataInView(figure, name);
}

std::string figureScript(const Figure& figure, const std::string& terminal) {
  std::string script;
  const Script out(script);
  fmt::format_to(out, "set terminal {} noenhanced font 'DejaVu Sans,11' size {},{}{}\n", terminal,
                 figure.width, figure.height, " background rgb '#FFFFFF'");
  script += figureStyle();
  const auto addText = [&](const char* what, const std::string& text) {
    if (!text.empty()) fmt::format_to(out, "set {} {} noenhanced\n", what, quoted(text));
  };
  addText("title", figure.title);
  addText("xlabel", figure.xLabel);
  addText("ylabel", figure.yLabel);
  if (figure.logX) fmt::format_to(out, "set logscale x\nset format x '%g'\n");
  if (figure.logY) fmt::format_to(out, "set logscale y\nset format y '%g'\n");
  if (figure.equalAxes) fmt::format_to(out, "set size ratio -1\n");
  addRange(out, figure.xRange, 'x');
  addRange(out, figure.yRange, 'y');
  fmt::format_to(out, "{}\n", placeOf(figure.legend));
  for (std::size_t k = 0; k < figure.series.size(); ++k) addData(out, figure.series[k], k);
  for (std::size_t k = 0; k < figure.series.size(); ++k) addCurve(out, figure.series[k], k);
  return script + "\n";
}

}  // namespace rex::internal
