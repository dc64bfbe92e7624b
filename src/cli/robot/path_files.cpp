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

// Contains no computing times: the same input gives the same bytes.
Report replayOf(const PathTask& task, const PlanOptions& options, const FoundPath& found,
                const PathTiming& timing, const Motion& motion) {
  const TimingResult& result = timing.result;
  Report report{.title = titleOf(task, options, found),
                .figures = {{jointsFigure(task.model, motion)}},
                .facts = {{"length", fmt::format("{:.4g}", found.length)},
                          {"duration", fmt::format("{:.3f} s", result.motion.duration())},
                          {"from velocity limits alone", fmt::format("{:.3f} s", result.lowerBound)},
                          {"limits", limitsTextOf(timing, options)},
                          {"margin", fmt::format("{:g} m", *options.margin)},
                          {"nodes", fmt::format("{}", found.nodes)},
                          {"configurations checked", fmt::format("{}", found.checks)}}};
  if (result.motion.duration() > 0)
    report.figures.push_back({speedsFigure(result.motion, timing.limits.limits)});
  if (!task.contacts.pairs().empty()) {
    report.figures.push_back({clearanceFigure(task.model, task.contacts, motion, *options.margin)});
    report.facts.emplace_back("clearance", fmt::format("{:.4g} m", found.clearance.atLeast));
  }
  return report;
}

// A hundred rows per second, fewer for very long motions.
std::string tableOf(const Model& model, const TimedPath& timed) {
  constexpr double kRate = 100, kMostRows = 1e6;
  const double rate = std::min(kRate, kMostRows / std::max(timed.duration(), 1.));
  return csvOf(model, motionOf(timed, rate));
}

// Writes the film and the replay.
std::vector<fs::path> writeMotion(const PathTask& task, const PlanOptions& options,
                                  const RenderPlan& pictures, BodyId body, const FoundPath& found,
                                  const PathTiming& timing) {
  const double speed = filmSpeed(options.speed, timing.result.motion.duration());
  const Motion motion = motionOf(timing.result.motion, kFilmRate / speed);
  return writeFilmAndReplay(task.model, motion, body, replayOf(task, options, found, timing, motion),
                            pictures, options.out / "path", speed);
}

}  // namespace

void writeExplored(Picture picture, RenderPlan plan, std::string caption, const fs::path& out) {
  picture.captions.push_back({.text = std::move(caption)});
  plan.renderer.antiAliasing = AntiAliasing::kMsaa4;
  Studio studio(plan, bounds(picture));
  const Image image = studio.draw(picture);
  studio.requireSomethingSeen();
  writePng(image, out);
}

std::string titleOf(const PathTask& task, const PlanOptions& options, const FoundPath& found) {
  return fmt::format("{}, {}, seed {}", harmless(task.model.name()), nameOf(options.planner), found.seed);
}

std::vector<std::string> writePathFiles(const PathTask& task, const PlanOptions& options,
                                        const RenderPlan& pictures, BodyId body, const FoundPath& found,
                                        const PathTiming& timing) {
  std::vector<fs::path> files = {options.out / "tree.png"};
  writeExplored(exploredPicture(task, body, found), pictures,
                fmt::format("{}: {} nodes", titleOf(task, options, found), found.nodes), files.back());
  const bool canMove = found.isFound() && timing.isFound();
  if (canMove) {
    files.push_back(options.out / "path.csv");
    writeTextFile(files.back(), tableOf(task.model, timing.result.motion));
  }
  if (canMove && !options.noFilm)
    for (const fs::path& file : writeMotion(task, options, pictures, body, found, timing))
      files.push_back(file);
  std::vector<std::string> names;
  for (const fs::path& file : files) names.push_back(shown(file));
  return names;
}

}  // namespace rex::cli
