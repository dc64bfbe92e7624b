#include "render/figure.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/process.h"
#include "render/figure_script_internal.h"
#include "render/staged_file_internal.h"

namespace rex {
namespace {

std::string terminalFor(const std::filesystem::path& path) {
  if (path.extension() == ".png") return "pngcairo";
  if (path.extension() == ".svg") return "svg";
  throw Error({.what = "cannot write figure '" + path.string() + "'",
               .found = "the ending '" + path.extension().string() + "'",
               .wanted = ".png or .svg"});
}

// What an SVG says beside the figure: which gnuplot drew it, and that cells may be blurred.
std::string cleaned(std::string svg) {
  const std::string remark = "<desc>", end = "</desc>", image = "<image ";
  if (const std::size_t at = svg.find(remark); at != std::string::npos)
    svg.erase(at, svg.find(end, at) + end.size() - at);
  for (std::size_t at = svg.find(image); at != std::string::npos; at = svg.find(image, at + image.size()))
    svg.insert(at + image.size(), "style='image-rendering:pixelated' ");
  return svg;
}

// The bytes of the picture; `name` stands for the figure in messages.
std::string drawFigure(const Figure& figure, const std::string& terminal, const std::string& name) {
  constexpr std::size_t kLargestFile = 256u << 20;
  // gnuplot writes to a pipe, so the path never becomes part of a script.
  ProcessResult run =
      runProcess({"gnuplot", "--default-settings"},
                 {.input = internal::figureScript(figure, terminal), .outputLimit = kLargestFile});
  const auto fail = [&](const std::string& found, const std::string& wanted) {
    return Error({.what = "cannot draw figure '" + name + "'", .found = found, .wanted = wanted});
  };
  if (!run.started) throw fail(run.error, "gnuplot, Debian package gnuplot-nox");
  // A minute is what runProcess gives it.
  if (run.signal != 0)
    throw fail(fmt::format("signal {} that ended gnuplot", run.signal), "its end within a minute");
  if (!run.ok()) throw fail("gnuplot says: " + run.error, "");
  if (run.output.empty() || run.output.size() == kLargestFile)
    throw fail("no complete picture from gnuplot", "");
  return terminal == "svg" ? cleaned(std::move(run.output)) : std::move(run.output);
}

}  // namespace

void writeFigure(const Figure& figure, const std::filesystem::path& path) {
  internal::writeWhole(path, drawFigure(figure, terminalFor(path), path.string()));
}

std::string encodeSvg(const Figure& figure) { return drawFigure(figure, "svg", figure.title); }

}  // namespace rex
