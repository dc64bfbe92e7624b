#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/wrong_use_internal.h"
#include "grading/text_file.h"
#include "scene/ors_writer.h"
#include "scene/urdf_writer.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

void requireEnding(const fs::path& out) {
  const std::string ending = out.extension().string();
  if (ending == ".ors" || ending == ".urdf") return;
  throw UsageError({.what = fmt::format("cannot write '{}'", harmless(out.string())),
                    .found = ending.empty() ? "no ending" : fmt::format("the ending '{}'", harmless(ending)),
                    .wanted = ".ors or .urdf",
                    .nearest = nearestNames(ending, {".ors", ".urdf"})});
}

}  // namespace

ExitCode sceneConvert(const Project& project, const ConvertOptions& options) {
  requireEnding(options.out);
  const SceneSpec spec = loadSpec(project, options.scene);
  const fs::path folder = options.out.has_parent_path() ? options.out.parent_path() : ".";
  if (options.out.extension() == ".ors") {
    grading::writeTextFile(options.out, asWrongUse([&] { return writeOrs(spec, folder); }));
  } else {
    const UrdfText urdf = asWrongUse([&] { return writeUrdf(spec, folder); });
    for (const Diagnostic& one : urdf.notes) note(wrap(harmless(toString(one)), 2, 0));
    grading::writeTextFile(options.out, urdf.text);
  }
  say(shown(options.out));
  return ExitCode::kFull;
}

}  // namespace rex::cli
