#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "render/figure_axes_internal.h"
#include "render/figure_check_internal.h"
#include "render/figure_script_internal.h"
#include "render/figure_style_internal.h"
#include "render/text_internal.h"

namespace rex::internal {
namespace {

using Values = std::vector<double>;

double at(const Values& x, std::size_t i) { return x.empty() ? static_cast<double>(i) : x[i]; }

bool isWhole(const Values& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return v == std::floor(v); });
}

// The numbers of style.gp's linetypes, which also differ in their markers.
int pointType(Marker marker) {
  switch (marker) {
    case Marker::kAuto:
      break;
    case Marker::kDot:
      return 7;
    case Marker::kCircle:
      return 6;
    case Marker::kCross:
      return 2;
    case Marker::kPlus:
      return 1;
    case Marker::kSquare:
      return 5;
    case Marker::kTriangle:
      return 9;
  }
  return 0;
}

const char* styleOf(const Series& series) {
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

Trace traceOf(const Series& series, std::size_t index) {
  const bool space = !series.z.empty(), colored = !series.values.empty();
  Trace trace{.legend = series.label, .wholeX = isWhole(series.x), .wholeY = isWhole(series.y)};
  trace.rows.resize(static_cast<Eigen::Index>(series.y.size()), 2 + space + colored);
  for (std::size_t i = 0; i < series.y.size(); ++i) {
    trace.outline.emplace_back(at(series.x, i), series.y[i], space ? series.z[i] : 0);
    const auto row = static_cast<Eigen::Index>(i);
    trace.rows.row(row).head(2 + space) = trace.outline.back().head(2 + space).transpose();
    if (colored) trace.rows(row, 2 + space) = series.values[i];
  }
  if (series.style == SeriesStyle::kPoints) trace.extent = Extent::kPoints;
  const std::string style = styleOf(series), columns = space ? "1:2:3" : "1:2";
  trace.drawing = fmt::format("using {}{} with {} lt {} lw {:.3g}", columns,
                              colored ? (space ? ":4" : ":3") : "", style, index + 1, 2 * series.size);
  if (style != "lines")
    trace.drawing += fmt::format(" ps {:.3g}", (series.marker == Marker::kAuto ? 0.7 : 0.9) * series.size);
  if (series.marker != Marker::kAuto) trace.drawing += fmt::format(" pt {}", pointType(series.marker));
  if (colored)
    trace.drawing += " lc palette";
  else if (series.color)
    trace.drawing += " " + colorOf(series.color, "");
  if (series.dashed) trace.drawing += " dt (12,7)";
  return trace;
}

Trace traceOf(const Band& band, std::size_t index) {
  Trace trace{.legend = band.label, .extent = Extent::kArea, .wholeX = isWhole(band.x)};
  const std::size_t count = band.low.size();
  trace.rows.resize(static_cast<Eigen::Index>(count), 3);
  for (std::size_t i = 0; i < count; ++i) {
    trace.rows.row(static_cast<Eigen::Index>(i)) << at(band.x, i), band.low[i], band.high[i];
    trace.outline.emplace_back(at(band.x, i), band.low[i], 0);
  }
  for (std::size_t i = count; i-- > 0;) trace.outline.emplace_back(at(band.x, i), band.high[i], 0);
  trace.drawing = fmt::format("using 1:2:3 with filledcurves {} fs transparent solid 0.22 noborder",
                              colorOf(band.color, index + 1));
  return trace;
}

Trace traceOf(const Histogram& histogram, std::size_t index) {
  const bool counted = histogram.edges.empty();
  Trace trace{.legend = histogram.label,
              .extent = Extent::kArea,
              .wholeX = counted,
              .wholeY = isWhole(histogram.heights)};
  const std::size_t count = histogram.heights.size();
  trace.rows.resize(static_cast<Eigen::Index>(count), 6);
  for (std::size_t i = 0; i < count; ++i) {
    const double place = static_cast<double>(i), height = histogram.heights[i];
    const double left = counted ? place - 0.4 : histogram.edges[i];
    const double right = counted ? place + 0.4 : histogram.edges[i + 1];
    trace.rows.row(static_cast<Eigen::Index>(i)) << left / 2 + right / 2, height, left, right,
        std::min(0., height), std::max(0., height);
    for (const auto& [x, y] : {std::pair{left, 0.}, {left, height}, {right, height}, {right, 0.}})
      trace.outline.emplace_back(x, y, 0);
  }
  const std::string color = colorOf(histogram.color, index + 1);
  trace.drawing =
      fmt::format("using 1:2:3:4:5:6 with boxxyerror {0} lw 1 fs transparent solid 0.55 border {0}", color);
  return trace;
}

Trace polygon(const std::string& label, const std::string& color, double opacity) {
  return {.legend = label,
          .drawing =
              fmt::format("using 1:2 with filledcurves closed {0} lw 1.5 fs transparent solid {1} border {0}",
                          color, opacity),
          .extent = Extent::kArea};
}

void setOutline(Trace& trace, const Eigen::Matrix2Xd& points) {
  // gnuplot closes the border only if the first point is repeated.
  trace.rows.resize(points.cols() + 1, 2);
  trace.rows << points.transpose(), points.col(0).transpose();
  for (const auto& point : points.colwise()) trace.outline.emplace_back(point.x(), point.y(), 0);
}

Trace traceOf(const CovarianceEllipse& ellipse, std::size_t) {
  Trace trace = polygon(ellipse.label, colorOf(ellipse.color, 2), 0.15);
  setOutline(trace, outlineOf(ellipse));
  return trace;
}

Trace traceOf(const Region& region, std::size_t) {
  Trace trace = polygon(region.label, colorOf(region.color, "lc rgb '#8A9BA8'"), 0.2);
  Eigen::Matrix2Xd points(2, static_cast<Eigen::Index>(region.x.size()));
  points.row(0) = Eigen::Map<const Eigen::RowVectorXd>(region.x.data(), points.cols());
  points.row(1) = Eigen::Map<const Eigen::RowVectorXd>(region.y.data(), points.cols());
  setOutline(trace, points);
  return trace;
}

Trace traceOf(const Arrows& arrows, std::size_t) {
  Trace trace{.legend = arrows.label, .extent = Extent::kPoints};
  trace.rows.resize(static_cast<Eigen::Index>(arrows.x.size()), 4);
  for (std::size_t i = 0; i < arrows.x.size(); ++i) {
    const double x = arrows.x[i], y = arrows.y[i], dx = arrows.dx[i], dy = arrows.dy[i];
    trace.rows.row(static_cast<Eigen::Index>(i)) << x, y, dx, dy;
    trace.outline.emplace_back(x, y, 0);
    trace.outline.emplace_back(x + dx, y + dy, 0);
  }
  trace.drawing = fmt::format("using 1:2:3:4 with vectors head filled size screen 0.008,20 lw 1.2 {}",
                              colorOf(arrows.color, "lc rgb '#8C96A0'"));
  return trace;
}

void setCells(Trace& trace, const AxisRange& xRange, const AxisRange& yRange, const Eigen::MatrixXd& cells) {
  trace.extent = Extent::kArea;
  trace.rows = cells;
  trace.outline = {{xRange.first, yRange.first, 0},
                   {xRange.second, yRange.first, 0},
                   {xRange.second, yRange.second, 0},
                   {xRange.first, yRange.second, 0}};
}

Trace traceOf(const OccupancyCells& map) {
  Trace trace;
  // Free cells are white; unknown ones stay light, so that what is drawn over them is visible.
  const Eigen::ArrayXXd p = map.occupancy.array();
  const Eigen::MatrixXd grey = (255 - p * (30 + p * 195)).round().matrix();
  setCells(trace, map.xRange, map.yRange, grey);
  trace.drawing =
      "matrix using " + cellCentres(map.xRange, map.yRange, map.occupancy) + ":3:3:3 with rgbimage";
  return trace;
}

Trace traceOf(const HeatMap& heatMap) {
  Trace trace;
  setCells(trace, heatMap.xRange, heatMap.yRange, heatMap.values);
  trace.drawing =
      "matrix using " + cellCentres(heatMap.xRange, heatMap.yRange, heatMap.values) + ":3 with image";
  return trace;
}

}  // namespace

std::string colorOf(const std::optional<Color>& color, const char* otherwise) {
  if (!color) return otherwise;
  const auto byte = [](float part) { return std::lround(255 * std::clamp(part, 0.f, 1.f)); };
  return fmt::format("lc rgb '#{:02X}{:02X}{:02X}'", byte(color->r), byte(color->g), byte(color->b));
}

std::string colorOf(const std::optional<Color>& color, std::size_t otherwise) {
  return colorOf(color, fmt::format("lt {}", otherwise).c_str());
}

std::string cellCentres(const AxisRange& xRange, const AxisRange& yRange, const Eigen::MatrixXd& cells) {
  const auto centre = [](const char* index, const AxisRange& range, Eigen::Index count) {
    const double step = (range.second - range.first) / static_cast<double>(count);
    return fmt::format("({:.17e}+${}*{:.17e})", range.first + step / 2, index, step);
  };
  return centre("1", xRange, cells.cols()) + ":" + centre("2", yRange, cells.rows());
}

Eigen::Matrix2Xd outlineOf(const CovarianceEllipse& ellipse) {
  constexpr int kPoints = 96;
  const Eigen::Matrix2d L = ellipse.covariance.llt().matrixL();
  Eigen::Matrix2Xd points(2, kPoints);
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2 * std::numbers::pi * i / kPoints;
    points.col(i) = ellipse.mean + ellipse.sigmas * (L * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return points;
}

std::vector<Trace> tracesOf(const Figure& figure) {
  std::vector<Trace> traces;
  const auto add = [&](const auto& layers) {
    for (std::size_t k = 0; k < layers.size(); ++k) traces.push_back(traceOf(layers[k], k));
  };
  if (figure.map) traces.push_back(traceOf(*figure.map));
  if (figure.heatMap) traces.push_back(traceOf(*figure.heatMap));
  add(figure.regions);
  add(figure.bands);
  add(figure.histograms);
  add(figure.arrows);
  add(figure.ellipses);
  add(figure.series);
  return traces;
}

namespace {

// Space between the numbers where two axes meet.
constexpr const char* kSpaceStyle =
    "set border 127\nset xyplane relative 0\nset view 62,32,1.05\nset grid ztics\n"
    "set xtics offset -0.6,-0.4\nset ytics offset 0.9,-0.2\nset xlabel offset -0.5,-0.6\n"
    "set ylabel offset 1,-0.4\n";

using Script = std::back_insert_iterator<std::string>;

// gnuplot runs backticks in double quotes in a shell and expands macros, but leaves the lines of a data
// block alone. A mark before each line keeps a text from ending the block.
class Texts {
 public:
  /// An expression that has `text` as its value.
  std::string add(const std::string& text) {
    lines_ += "|" + singleLine(text) + "\n";
    return fmt::format("$text[{}][2:*]", ++count_);
  }
  [[nodiscard]] std::string block() const { return "$text << EOD\n" + lines_ + "EOD\n"; }

 private:
  std::string lines_;
  int count_ = 0;
};

const char* placeOf(const Figure& figure, Legend legend) {
  switch (legend) {
    case Legend::kAuto:
    case Legend::kTopRight:
      return "set key top right";
    case Legend::kTopLeft:
      return "set key top left";
    case Legend::kBottomRight:
      return "set key bottom right";
    case Legend::kBottomLeft:
      return "set key bottom left";
    case Legend::kOutside:  // the colour bar is on the right
      return hasColorBar(figure) ? "set key above" : "set key outside right top";
    case Legend::kNone:
      return "set key off";
  }
  return "";
}

void addAxis(Script out, const char* name, const Axis& axis, bool logarithmic) {
  if (logarithmic) fmt::format_to(out, "set logscale {0}\nset format {0} '%g'\n", name);
  // {:e} always writes an exponent, so that no number is read as an integer.
  fmt::format_to(out, "set {}range [{:.17e}:{:.17e}]\n", name, axis.low, axis.high);
  if (axis.step == 0) return;
  if (!logarithmic) {
    fmt::format_to(out, "set {}tics {:.17e}\n", name, axis.step);
  } else if (const double fold = std::log10(axis.step); fold > 1.5) {
    // If a step spans many decades, gnuplot 5.4 counts all minor tics in between, which takes minutes.
    fmt::format_to(out, "set {}tics (", name);
    const char* separator = "";
    for (double k = std::ceil(std::log10(axis.low) / fold - 1e-9); std::pow(10, k * fold) <= axis.high; ++k) {
      fmt::format_to(out, "{}{:.17e}", separator, std::pow(10, k * fold));
      separator = ",";
    }
    fmt::format_to(out, ")\n");
  }
}

// A percent sign in them is a command of its own.
void addNames(Script out, const std::vector<std::string>& names, Texts& texts) {
  if (names.empty()) return;
  fmt::format_to(out, "set ytics noenhanced (");
  for (std::size_t k = 0; k < names.size(); ++k) {
    std::string text;
    for (const char c : names[k]) text += c == '%' ? "%%" : std::string(1, c);
    fmt::format_to(out, "{}{} {}", k == 0 ? "" : ",", texts.add(text), k);
  }
  fmt::format_to(out, ")\n");
}

void addAxes(Script out, const Figure& figure, const FigureAxes& axes, Texts& texts) {
  addAxis(out, "x", axes.x, figure.logX);
  addAxis(out, "y", axes.y, figure.logY);
  addNames(out, figure.yNames, texts);
  if (inSpace(figure)) addAxis(out, "z", axes.z, false);
  if (hasColorBar(figure)) addAxis(out, "cb", axes.color, figure.logColor);
  if (inSpace(figure)) fmt::format_to(out, "{}", kSpaceStyle);
  if (!figure.equalAxes) return;
  fmt::format_to(out, "{}\n", inSpace(figure) ? "set view equal xyz" : "set size ratio -1");
}

void addNotes(Script out, const Figure& figure, const FigureAxes& axes, Texts& texts) {
  for (const Note& note : figure.notes) {
    const double across = shareOf(axes.x, note.x, figure.logX), up = shareOf(axes.y, note.y, figure.logY);
    if (across < 0 || across > 1 || up < 0 || up > 1) continue;
    const bool toTheLeft = across > 0.8 && !inSpace(figure);
    fmt::format_to(out, "set label {} at {:.17e},{:.17e}{} {} noenhanced front\n", texts.add(note.text),
                   note.x, note.y, inSpace(figure) ? fmt::format(",{:.17e}", note.z) : "",
                   toTheLeft ? "right offset -0.9,0.6" : "left offset 0.9,0.6");
  }
}

Trace traceOf(const Guide& guide, const Axis& along, bool vertical) {
  Trace trace{.legend = guide.label};
  trace.rows.resize(2, 2);
  trace.rows.col(vertical ? 0 : 1).setConstant(guide.at);
  trace.rows.col(vertical ? 1 : 0) << along.low, along.high;
  trace.drawing = "using 1:2 with lines lw 1.3 dt (10,7) " + colorOf(guide.color, "lc rgb '#707070'");
  return trace;
}

// Contour lines of the cells in `block`, at equal steps of colour, as the block $contours.
void addContours(Script out, const Figure& figure, const std::string& block, const Axis& color) {
  const HeatMap& heatMap = *figure.heatMap;
  fmt::format_to(out, "set cntrparam levels discrete ");
  for (int i = 1; i <= heatMap.contours; ++i) {
    const double share = static_cast<double>(i) / (heatMap.contours + 1);
    const double level = figure.logColor ? color.low * std::pow(color.high / color.low, share)
                                         : color.low + share * (color.high - color.low);
    fmt::format_to(out, "{}{:.17e}", i > 1 ? "," : "", level);
  }
  fmt::format_to(out, "\nset contour base\nunset surface\nset format '%.12g'\nset table $contours\n");
  fmt::format_to(out, "splot {} matrix using {}:3\nunset table\nunset contour\nset surface\n", block,
                 cellCentres(heatMap.xRange, heatMap.yRange, heatMap.values));
  fmt::format_to(out, "set format '%h'\n");
}

void addRows(Script out, const std::string& block, const Eigen::MatrixXd& rows) {
  fmt::format_to(out, "{} << EOD\n", block);
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
    for (Eigen::Index j = 0; j < rows.cols(); ++j)
      fmt::format_to(out, "{}{}", rows(i, j), j + 1 == rows.cols() ? '\n' : ' ');
  fmt::format_to(out, "EOD\n");
}

std::string terminalCommand(const Figure& figure, const std::string& terminal) {
  return fmt::format("set terminal {} noenhanced font 'DejaVu Sans,11' size {},{} background rgb '#FFFFFF'\n",
                     terminal, figure.width, figure.height);
}

// The data blocks come first and the one command that draws them last.
std::string drawingOf(const Figure& figure, const std::vector<Trace>& traces, const FigureAxes& axes,
                      Texts& texts) {
  std::string blocks, command;
  const Script out(command);
  const bool contours = figure.heatMap && figure.heatMap->contours > 0;
  for (std::size_t k = 0; k < traces.size(); ++k) {
    const Trace& trace = traces[k];
    const std::string block = fmt::format("$d{}", k);
    addRows(Script(blocks), block, trace.rows);
    fmt::format_to(out, "{}{} {} ", k > 0 ? ", " : "", block, trace.drawing);
    if (trace.legend.empty())
      fmt::format_to(out, "notitle");
    else
      fmt::format_to(out, "title {} noenhanced", texts.add(trace.legend));
    if (!contours || k != (figure.map ? 1 : 0)) continue;
    addContours(Script(blocks), figure, block, axes.color);
    fmt::format_to(out, ", $contours using 1:2 with lines lw 0.8 lc rgb '#70FFFFFF' notitle");
  }
  return blocks + "\n" + (inSpace(figure) ? "splot " : "plot ") + command + "\n";
}

}  // namespace

std::string figureScript(const Figure& figure, const std::string& terminal) {
  requireDrawable(figure);
  std::vector<Trace> traces = tracesOf(figure);
  requireDataInView(figure, traces);
  const FigureAxes axes = axesOf(figure, traces);
  std::vector<Trace> guides;
  for (const Guide& guide : figure.verticalLines) guides.push_back(traceOf(guide, axes.y, true));
  for (const Guide& guide : figure.horizontalLines) guides.push_back(traceOf(guide, axes.x, false));
  traces.insert(traces.end() - static_cast<std::ptrdiff_t>(figure.series.size()), guides.begin(),
                guides.end());

  Texts texts;
  std::string layout;
  const Script out(layout);
  const auto addText = [&](const char* what, const std::string& text) {
    if (!text.empty()) fmt::format_to(out, "set {} {} noenhanced\n", what, texts.add(text));
  };
  addText("title", figure.title);
  addText("xlabel", figure.xLabel);
  addText("ylabel", figure.yLabel);
  addText("zlabel", figure.zLabel);
  addText("cblabel", figure.colorLabel);
  addAxes(out, figure, axes, texts);
  addNotes(out, figure, axes, texts);
  const bool freely = figure.legend == Legend::kAuto && !inSpace(figure);
  fmt::format_to(out, "{}\n", placeOf(figure, freely ? emptiestCorner(figure, traces, axes) : figure.legend));
  const std::string drawing = drawingOf(figure, traces, axes, texts);
  return terminalCommand(figure, terminal) + figureStyle() + texts.block() + layout + drawing;
}

}  // namespace rex::internal
