#include "render/figure.h"

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

// The bytes of the picture; `name` stands for the figure in messages.
std::string drawFigure(const Figure& figure, const std::string& terminal, const std::string& name) {
  constexpr std::size_t kLargestFile = 256u << 20;
  internal::requireDrawable(figure);
  // gnuplot writes to a pipe, so the path never becomes part of a script.
  ProcessResult run =
      runProcess({"gnuplot", "--default-settings"},
                 {.input = internal::figureScript(figure, terminal), .outputLimit = kLargestFile});
  const auto fail = [&](const std::string& found, const std::string& wanted) {
    return Error({.what = "cannot draw figure '" + name + "'", .found = found, .wanted = wanted});
  };
  if (!run.started) throw fail(run.error, "gnuplot, Debian package gnuplot-nox");
  if (!run.ok()) throw fail("gnuplot says: " + run.error, "");
  if (run.output.empty() || run.output.size() == kLargestFile)
    throw fail("no complete picture from gnuplot", "");
  return std::move(run.output);
}

}  // namespace

void writeFigure(const Figure& figure, const std::filesystem::path& path) {
  internal::writeWhole(path, drawFigure(figure, terminalFor(path), path.string()));
}

std::string encodeSvg(const Figure& figure) { return drawFigure(figure, "svg", figure.title); }

}  // namespace rex
