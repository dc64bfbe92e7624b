#include "cli/robot/path_files.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "base/text_file.h"
#include "cli/robot/film_file.h"
#include "cli/robot/motion_files.h"
#include "cli/robot/path_motion.h"
#include "cli/robot/path_pictures.h"
#include "cli/robot/studio.h"
#include "cli/terminal.h"
#include "render/png.h"
#include "render/report.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

void writeExplored(Picture picture, RenderPlan plan, std::string caption, const fs::path& out) {
  picture.captions.push_back({.text = std::move(caption)});
  plan.renderer.antiAliasing = AntiAliasing::kMsaa4;
  Studio studio(plan, bounds(picture));
  const Image image = studio.draw(picture);
  studio.requireSomethingSeen();
  writePng(image, out);
}

// No times of computing in it: the same input gives the same bytes.
Report replayOf(const PathTask& task, const PlanOptions& options, const FoundPath& found,
                const Motion& motion) {
  Report report{.title = titleOf(task, options, found),
                .figures = {{jointsFigure(task.model, motion)}},
                .facts = {{"length", fmt::format("{:.4g}", found.length)},
                          {"margin", fmt::format("{:g} m", options.margin)},
                          {"nodes", fmt::format("{}", found.nodes)},
                          {"configurations checked", fmt::format("{}", found.checks)}}};
  if (!task.contacts.pairs().empty()) {
    report.figures.push_back({clearanceFigure(task.model, task.contacts, motion, options.margin)});
    report.facts.emplace_back("clearance", fmt::format("{:.4g} m", found.clearance.atLeast));
  }
  return report;
}

// Film and replay.
std::vector<fs::path> writeMotion(const PathTask& task, const PlanOptions& options,
                                  const RenderPlan& pictures, BodyId body, const FoundPath& found) {
  const double speed = std::max(options.speed, found.length / kLongestFilm);
  if (speed > options.speed) note(fmt::format("the film is {:.3g} times as fast", speed / options.speed));
  const Space& space = task.problem.space;
  const Motion motion = resampled(space, timedPath(space, found.path, speed, 1 / kFilmRate), kFilmRate);
  return writeFilmAndReplay(task.model, motion, body, replayOf(task, options, found, motion), pictures,
                            options.out / "path");
}

}  // namespace

std::string titleOf(const PathTask& task, const PlanOptions& options, const FoundPath& found) {
  return fmt::format("{}, {}, seed {}", harmless(task.model.name()), options.planner, found.seed);
}

std::vector<std::string> writePathFiles(const PathTask& task, const PlanOptions& options,
                                        const RenderPlan& pictures, BodyId body, const FoundPath& found) {
  std::vector<fs::path> files = {options.out / "tree.png"};
  writeExplored(exploredPicture(task, body, found), pictures,
                fmt::format("{}: {} nodes", titleOf(task, options, found), found.nodes), files.back());
  if (found.isFound()) {
    files.push_back(options.out / "path.csv");
    const Motion motion = timedPath(task.problem.space, found.path, options.speed, 1 / kFilmRate);
    writeTextFile(files.back(), csvOf(task.model, motion));
  }
  if (found.isFound() && !options.noFilm)
    for (const fs::path& file : writeMotion(task, options, pictures, body, found)) files.push_back(file);
  std::vector<std::string> names;
  for (const fs::path& file : files) names.push_back(shown(file));
  return names;
}

}  // namespace rex::cli
