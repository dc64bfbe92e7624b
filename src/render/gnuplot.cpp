#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/process.h"
#include "render/gnuplot_internal.h"

namespace rex::internal {

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
