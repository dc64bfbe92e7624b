#include "render/figure.h"

#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/process.h"
#include "render/figure_internal.h"
#include "render/figure_script_internal.h"
#include "render/frame_sink_internal.h"

namespace rex {
namespace {

std::string terminalFor(const std::filesystem::path& path) {
  if (path.extension() == ".png") return "pngcairo";
  if (path.extension() == ".svg") return "svg";
  throw Error({.what = "cannot write figure '" + path.string() + "'",
               .found = "the ending '" + path.extension().string() + "'",
               .wanted = ".png or .svg"});
}

// Removes the note on which gnuplot drew the SVG, and keeps viewers from blurring cells.
std::string cleaned(std::string svg) {
  const std::string remark = "<desc>", end = "</desc>", image = "<image ";
  if (const std::size_t at = svg.find(remark); at != std::string::npos)
    svg.erase(at, svg.find(end, at) + end.size() - at);
  for (std::size_t at = svg.find(image); at != std::string::npos; at = svg.find(image, at + image.size()))
    svg.insert(at + image.size(), "style='image-rendering:pixelated' ");
  return svg;
}

// The bytes of the picture; `name` is what messages call the figure, `before` are further commands.
std::string drawFigure(const Figure& figure, const std::string& terminal, const std::string& name,
                       const std::string& before = "") {
  std::string bytes = internal::runGnuplot(before + internal::figureScript(figure, terminal), name);
  return terminal == "svg" ? cleaned(std::move(bytes)) : bytes;
}

}  // namespace

Figure planeFigure(Figure figure) {
  figure.xLabel = "x [m]";
  figure.yLabel = "y [m]";
  figure.equalAxes = true;
  return figure;
}

void writeFigure(const Figure& figure, const std::string& path) {
  internal::writeWhole(path, drawFigure(figure, terminalFor(path), path));
}

std::string encodeSvg(const Figure& figure) { return drawFigure(figure, "svg", figure.title); }

}  // namespace rex

namespace rex::internal {

void requirePlanePoint(Eigen::Index numbers) {
  if (numbers >= 2) return;
  throw Error({.what = "points of a figure",
               .found = numbers == 1 ? "one number for each" : "points without numbers",
               .wanted = "two or more, such as the columns of a 2 x n matrix"});
}

std::string encodeSvg(const Figure& figure, const std::string& commands) {
  return drawFigure(figure, "svg", figure.title, commands);
}

std::string runGnuplot(const std::string& script, const std::string& name, double patience) {
  constexpr std::size_t kLargestFile = 256u << 20;
  // gnuplot writes to a pipe, so that no path becomes part of a script.
  ProcessResult run = runProcess({"gnuplot", "--default-settings"},
                                 {.input = script, .timeout = patience, .outputLimit = kLargestFile});
  const auto fail = [&](const std::string& found, const std::string& wanted = "") {
    return Error({.what = "cannot draw figure '" + name + "'", .found = found, .wanted = wanted});
  };
  if (!run.started) throw fail(run.error, "gnuplot, Debian package gnuplot-nox");
  if (run.timedOut) throw fail("gnuplot still running", fmt::format("a picture within {:g} s", patience));
  if (run.signal != 0) throw fail(fmt::format("signal {} that ended gnuplot", run.signal));
  if (!run.ok()) throw fail("gnuplot says: " + run.error);
  if (run.output.empty() || run.output.size() == kLargestFile) throw fail("no complete picture from gnuplot");
  return std::move(run.output);
}

}  // namespace rex::internal
