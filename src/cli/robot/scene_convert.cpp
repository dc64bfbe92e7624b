#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/folders.h"
#include "base/text.h"
#include "base/text_file.h"
#include "cli/numbers.h"
#include "cli/out_folder.h"
#include "cli/robot/scene_verbs.h"
#include "formats/ors_writer.h"
#include "formats/urdf_writer.h"
#include "scene/scene_edit.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

fs::path folderOf(const fs::path& file) { return fs::absolute(file).lexically_normal().parent_path(); }

void requireEnding(const fs::path& out) {
  const std::string ending = out.extension().string();
  if (endingOf(out) == ".ors" || endingOf(out) == ".urdf") return;
  throw UsageError(
      {.what = fmt::format("cannot write '{}'", escapeForTerminal(out.string())),
       .found = ending.empty() ? "no ending" : fmt::format("the ending '{}'", escapeForTerminal(ending)),
       .wanted = ".ors or .urdf",
       .nearest = nearestNames(ending, {".ors", ".urdf"})});
}

void requireAnother(const fs::path& in, const fs::path& out) {
  std::error_code ignored;
  if (fs::equivalent(in, out, ignored))
    throw UsageError({.what = fmt::format("'{}' is the scene itself", escapeForTerminal(out.string())),
                      .wanted = "another file to write"});
}

// Meshes that the new file names may lie outside the folder in which its readers search.
void warnOfMeshesOutside(const SceneSpec& spec, const fs::path& out) {
  const fs::path above = fs::weakly_canonical(folderOf(out) / "..");
  fs::path root = above;
  const auto widen = [&](const std::vector<ShapeSpec>& shapes) {
    for (const ShapeSpec& shape : shapes) {
      if (shape.meshPath.empty()) continue;
      const fs::path mesh = fs::weakly_canonical(shape.meshPath);
      while (!isBelow(root, mesh)) root = root.parent_path();
    }
  };
  widen(spec.worldShapes);
  for (const BodySpec& body : spec.bodies) widen(body.shapes);
  if (root == above) return;
  note(wrap(fmt::format("the meshes stay where they are; read the new file with --assets {}",
                        escapeForTerminal(root.string())),
            2, 0));
}

}  // namespace

ExitCode sceneConvert(const Project& project, const ConvertOptions& options) {
  requireEnding(options.out);
  requireAnother(sceneFilePath(project, options.scene), options.out);
  SceneSpec spec = loadSpec(project, options.scene);
  const fs::path folder = folderOf(options.out);
  std::string text;
  if (endingOf(options.out) == ".ors") {
    if (const std::size_t count = removeMeshesWithoutFile(spec); count > 0)
      note(fmt::format("meshes without a file are left out: {}", count));
    text = asWrongUse([&] { return writeOrs(spec, folder); });
  } else {
    UrdfText urdf = asWrongUse([&] { return writeUrdf(spec, folder); });
    for (const Diagnostic& one : urdf.notes) note(wrap(escapeForTerminal(toString(one)), 2, 0));
    text = std::move(urdf.text);
  }
  asWrongUse([&] {
    makeOutFolder(folder);
    writeTextFile(options.out, text);
  });
  if (!spec.postures.empty())
    note(wrap("named postures are left out: the format of the new file has none", 2, 0));
  warnOfMeshesOutside(spec, options.out);
  say(shown(options.out));
  return ExitCode::kFull;
}

}  // namespace rex::cli
