#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "render/figure_axes_internal.h"
#include "render/figure_check_internal.h"
#include "render/figure_legend_internal.h"
#include "render/figure_script_internal.h"
#include "render/figure_style_internal.h"
#include "render/figure_trace_internal.h"
#include "render/figure_view_internal.h"
#include "render/utf8_internal.h"

namespace rex::internal {
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

void addAxes(Script out, const Figure& figure, const FigureAxes& axes) {
  addAxis(out, "x", axes.x, figure.logX);
  addAxis(out, "y", axes.y, figure.logY);
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
  addAxes(out, figure, axes);
  addNotes(out, figure, axes, texts);
  const bool freely = figure.legend == Legend::kAuto && !inSpace(figure);
  fmt::format_to(out, "{}\n", placeOf(figure, freely ? emptiestCorner(figure, traces, axes) : figure.legend));
  const std::string drawing = drawingOf(figure, traces, axes, texts);
  return terminalCommand(figure, terminal) + figureStyle() + texts.block() + layout + drawing;
}

}  // namespace rex::internal
