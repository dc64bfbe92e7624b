#include "cli/robot/plan.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "cli/option_value_internal.h"
#include "cli/robot/contact_limit.h"
#include "cli/robot/film_file.h"
#include "cli/robot/motion_files.h"
#include "cli/robot/path_files.h"
#include "cli/robot/path_pictures.h"
#include "cli/robot/path_summary.h"
#include "cli/robot/posture_within_limits.h"
#include "cli/robot/robot_options_internal.h"
#include "cli/robot/robot_room_internal.h"
#include "cli/shared_options_internal.h"
#include "cli/wrong_use_internal.h"
#include "collision/contacts.h"
#include "planning/robot_problem.h"

namespace rex::cli {
namespace {

PathSearch searchOf(const PlanOptions& options) {
  PathSearch search{.planner = plannerOf(options.planner), .smooth = !options.noSmooth};
  requireBetween("--margin", options.margin, 0, kQueryCutoff);
  requireBetween("--resolution", options.resolution, 1e-4, 10);
  requireBetween("--velocity", options.velocity, 1e-6, 1e6);
  requireBetween("--ramp", options.ramp, 1e-6, 1e6);
  requireBetween("--speed", options.speed, 1e-3, 1e3);
  requireBetween("--seeds", options.seeds, 1, 10'000);
  if (options.step && !growsTrees(search.planner))
    throw UsageError(
        {.what = "--step", .found = "--planner " + options.planner, .wanted = "a planner that grows trees"});
  search.step = options.step.value_or(search.step);
  requireBetween("--step", search.step, 1e-3, 1e3);
  if (search.planner == Planner::kRrtStar) search.samples = 10'000;  // RRT* uses all of them
  if (!growsTrees(search.planner)) search.samples = 2000;
  search.samples = options.samples.value_or(search.samples);
  requireBetween("--samples", search.samples, 1, growsTrees(search.planner) ? 1e7 : 1e5);
  return search;
}

PathTask taskOf(Model model, const PlanOptions& options) {
  const ContactModel contacts = contactModelOf(model);
  if (contacts.pairs().empty())
    note(harmless(model.name()) + ": no two shapes may collide: every path is free");
  const Eigen::VectorXd start =
      postureWithinLimits(model, "--start", options.start.empty() ? "file" : options.start);
  const Eigen::VectorXd goal = postureWithinLimits(model, "--goal", options.goal);
  PathProblem problem = asWrongUse(
      [&] { return robotProblem(model, contacts, start, goal, options.margin, options.resolution); });
  requireFreeEnds(problem, options.margin);
  return {std::move(model), contacts, std::move(problem)};
}

BodyId drawnBody(const Model& model, const std::string& name) {
  if (name.empty()) return farthestBody(model);
  const BodyId body = asWrongUse([&] { return model.body(name); }, "--body: ");
  for (BodyId at = body; at != kWorld; at = model[at].parent)
    if (model[at].joint != kNoJoint && model[model[at].joint].nv > 0) return body;
  throw UsageError({.what = "--body", .found = "'" + harmless(name) + "', which no joint moves"});
}

// Whether all paths are clear of collisions; if not, says why.
bool isClear(const FoundPaths& found, double margin) {
  // Without a margin shapes may touch, and touching cannot be told from a tiny overlap.
  const double least = margin > 0 ? 0 : -kClearanceTolerance;
  const auto all = [&](double ClearanceBounds::*bound) {
    return std::ranges::all_of(
        found.all, [&](const FoundPath& one) { return !one.isFound() || one.clearance.*bound > least; });
  };
  if (all(&ClearanceBounds::atLeast)) return true;
  note(all(&ClearanceBounds::atMost)
           ? "it is not proven that shapes stay apart between the postures that were checked: use a larger "
             "--margin"
           : "shapes overlap between the postures that were checked: use a finer --resolution or a larger "
             "--margin");
  return false;
}

// Searches for a path of a robot past all obstacles, and the fastest motion along it. Writes the motion, what
// was explored, a film and a replay. kBelow if no path was found, one is not clear, or it cannot be timed.
ExitCode planPath(const Project& project, const PlanOptions& options) {
  RenderOptions filmOptions = options.film;
  filmOptions.out = options.out / "path.mp4";
  const RenderPlan pictures = planOf(filmOptions, facingOf(fileOf(project, options.scene)));
  const PathSearch search = searchOf(options);
  Model model = loadScene(project, options.scene);
  if (model.nv() == 0) throw UsageError({.what = model.name(), .found = "no joint that moves"});
  if (!options.noFilm) requireFilmable(model);
  const BodyId body = drawnBody(model, options.body);
  const PathTask task = taskOf(std::move(model), options);
  makeResultFolder(options.out, {"tree.png", "path.csv", "path.mp4", "path.html"}, "path");

  const FoundPaths found = asWrongUse([&] { return searchPaths(task, search, options.seed, options.seeds); });
  const bool isFound = found.successes() > 0;
  const PathTiming timing = isFound ? timingOf(task, options, found.shortest()) : PathTiming{};
  if (const std::string assumed = assumptionsOf(timing, options); !assumed.empty()) note(assumed);
  const std::vector<std::string> files =
      writePathFiles(task, options, pictures, body, found.shortest(), timing);
  if (options.json) {
    say(jsonSummaryOf(task, options, found, timing, files));
  } else {
    say(summaryOf(task, options, found, timing));
    for (const std::string& file : files) say(file);
  }
  return isClear(found, options.margin) && timing.isFound() ? ExitCode::kFull : ExitCode::kBelow;
}

}  // namespace

void addPlan(CLI::App* command, Action& action) {
  const auto options = std::make_shared<PlanOptions>();
  command->footer(
      "Examples:\n  scripts/rex plan board --goal 1.5,-1.1,-1 -o around\n"
      "  scripts/rex plan maze --goal 3,0,0 --planner rrt-star --speed 0.5 -o rooms\n"
      "  scripts/rex plan board --goal 'stem>arm1=1.5' --planner lazy-prm --seeds 20 -o compare\n\n"
      "Lengths are Euclidean distances between joint vectors, in rad and m. Turning joints without limits\n"
      "turn the shorter way round. The motion is the fastest within the limits of the scene.\n"
      "DIR gets path.csv (time and joints; `rex render --motion` reads it), tree.png (what was explored),\n"
      "path.mp4 and path.html (a replay).\n"
      "Exit codes: 0 found a path, 1 found none or one not proven clear, 64 wrong use.");
  addSceneFile(command, "SCENE", options->scene.file);
  command->add_option("-o,--out", options->out, "folder for the results")->type_name("DIR")->required();
  command->add_option("--start", options->start, "all numbers, joint=number,..., 0, or file (default: file)")
      ->type_name("POSTURE");
  command->add_option("--goal", options->goal, "posture to reach, as for --start")
      ->type_name("POSTURE")
      ->required();
  command
      ->add_option("--planner", options->planner,
                   "rrt, rrt-connect, rrt-star; prm, prm-star, lazy-prm (default: rrt-connect)")
      ->type_name("NAME");
  command->add_option("--margin", options->margin, "clearance to keep between all shapes (default: 0.01)")
      ->type_name("METRES");
  command
      ->add_option("--resolution", options->resolution,
                   "distance between checks along the path (default: 0.02)")
      ->type_name("LENGTH");
  command->add_option("--step", options->step, "step size of growing trees (default: 0.3)")
      ->type_name("LENGTH");
  command
      ->add_option("--samples", options->samples,
                   "budget of samples (default: 100000; rrt-star 10000, roadmaps 2000)")
      ->type_name("N");
  addSeed(command, options->seed, "seed of the random numbers (default: 0)");
  command->add_option("--seeds", options->seeds, "search with this many seeds and print a table")
      ->type_name("N");
  CLI::Option* smooth = command->add_flag("--smooth");
  smooth->description("shortcuts, then a spline that cuts corners (default)");
  command->add_flag("--no-smooth", options->noSmooth,
                    "the path as the planner finds it, with a stop at each corner");
  command
      ->add_option("--velocity", options->velocity, "limit for joints without one, rad/s or m/s (default: 1)")
      ->type_name("X");
  command
      ->add_option("--ramp", options->ramp,
                   "time from rest to the velocity limits of the joints (default: 0.5)")
      ->type_name("S");
  command->add_flag("--effort", options->effort,
                    "keep within the effort limits of the scene, too (no friction)");
  addFilmSpeed(command, options->speed);
  command
      ->add_option("--body", options->body,
                   "draw the paths of this body (default: the one moved by most joints)")
      ->type_name("NAME");
  command->add_flag("--no-film", options->noFilm, "do not make path.mp4 and path.html");
  addFilmOptions(command, options->film);
  addJson(command, options->json);
  addReading(command, options->scene.reading);
  addGl(command, options->film.gl);
  command->callback([&action, options, smooth] {
    if (options->noSmooth && smooth->count() > 0) throw CLI::ExcludesError("--smooth", "--no-smooth");
    action = [options](const Project& p) { return planPath(p, *options); };
  });
}

}  // namespace rex::cli
