#include "cli/robot/plan.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "cli/command_table.h"
#include "cli/numbers.h"
#include "cli/option_table_internal.h"
#include "cli/results_internal.h"
#include "cli/robot/motion_files.h"
#include "cli/robot/path_results.h"
#include "cli/robot/posture_option.h"
#include "cli/robot/robot_options_internal.h"
#include "cli/robot/scene_option.h"
#include "collision/contacts.h"
#include "planning/robot_problem.h"

namespace rex::cli {
namespace {

// Defaults and ranges that depend on the planner.
struct PlannerDefaults {
  double margin = 0.01, resolution = 0.02;
  int samples = PathSearch{}.samples;
  Range margins{0, kQueryCutoff}, budgets{1, 1e7};  // of margin and samples
};

PlannerDefaults defaultsOf(Planner planner) {
  if (planner == Planner::kHybridAStar) return {.margin = 0.05, .resolution = 0.05};
  if (planner == Planner::kRrtStar) return {.samples = 10'000};  // RRT* uses all of them
  if (!drawsSamples(planner)) return {.margin = 0.02, .margins = {1e-4, kQueryCutoff}};
  return growsTrees(planner) ? PlannerDefaults{} : PlannerDefaults{.samples = 2000, .budgets = {1, 1e5}};
}

PathSearch searchOf(const PlanOptions& options) {
  PathSearch search{.planner = options.planner, .step = options.step, .smooth = !options.noSmooth};
  search.samples = *options.samples;
  search.timeLimit = options.timeLimit;
  return search;
}

PathTask taskOf(Model model, const PlanOptions& options) {
  const ContactModel contacts = sceneContactModel(model);
  if (contacts.pairs().empty())
    note(escapeForTerminal(model.name()) + ": no two shapes may collide: every path is free");
  const Eigen::VectorXd start = postureWithinLimits(model, "--start", options.start);
  const Eigen::VectorXd goal = postureWithinLimits(model, "--goal", options.goal);
  PathProblem problem = asWrongUse(
      [&] { return robotProblem(model, contacts, start, goal, *options.margin, *options.resolution); });
  PathTask task{std::move(model), contacts, std::move(problem)};
  requireClearEnds(task, *options.margin);
  return task;
}

BodyId drawnBody(const Model& model, const std::string& name) {
  if (name.empty()) return farthestBody(model);
  const BodyId body = asWrongUse([&] { return model.body(name); }, "--body: ");
  for (BodyId at = body; at != kWorld; at = model[at].parent)
    if (model[at].joint != kNoJoint && model[model[at].joint].nv > 0) return body;
  throw UsageError({.what = "--body", .found = "'" + escapeForTerminal(name) + "', which no joint moves"});
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
ExitCode planPath(const PlanOptions& options, const RenderPlan& pictures, Model model) {
  const PathSearch search = searchOf(options);
  const BodyId body = drawnBody(model, options.body);
  const PathTask task = taskOf(std::move(model), options);
  makeResultFolder(options.out, {"tree.png", "path.csv", "path.mp4", "path.html"}, "path");

  const FoundPaths found = asWrongUse([&] { return searchPaths(task, search, options.seed, options.runs); });
  const bool isFound = found.successes() > 0;
  const PathTiming timing = isFound ? timePath(task, options, found.shortest()) : PathTiming{};
  if (const std::string assumed = assumedLimits(timing, options); !assumed.empty()) note(assumed);
  Results results = pathResults(task, options, found, timing);
  writePathFiles(task, options, pictures, body, found.shortest(), timing, results);
  results.print(options.json);
  return isClear(found, *options.margin) && timing.isFound() ? ExitCode::kFull : ExitCode::kBelow;
}

ExitCode plan(const Project& project, PlanOptions options) {
  const bool isCar = options.planner == Planner::kHybridAStar, isPath = drawsSamples(options.planner);
  const PlannerDefaults usual = defaultsOf(options.planner);
  options.margin = options.margin.value_or(usual.margin);
  options.resolution = options.resolution.value_or(usual.resolution);
  options.samples = options.samples.value_or(usual.samples);
  const Facing facing = sceneFacing(sceneFilePath(project, options.scene));
  requireGiven("--goal", options.goal, "plan");
  requireGiven("--out", options.out.string(), "plan");
  requireBetween("--margin", *options.margin, usual.margins.least, usual.margins.most);
  requireBetween("--samples", *options.samples, usual.budgets.least, usual.budgets.most);
  RenderOptions film = options.film;
  film.out = options.out / "path.mp4";
  if (isCar && film.cameras.empty()) film.cameras = {"0,-0.5,1"};  // a street is seen from above
  const RenderPlan pictures = makeRenderPlan(film, facing);
  Model model = loadScene(project, options.scene);
  if (model.nv() == 0) throw UsageError({.what = model.name(), .found = "no joint that moves"});
  if (!options.noFilm) requireFilmable(model);
  return (isCar ? planCar : isPath ? planPath : planMotion)(options, pictures, std::move(model));
}

// Options of other planners than the one that was chosen would have no effect.
void requireOwn(const std::vector<CLI::Option*>& options, bool isTheirs, Planner planner,
                const char* wanted) {
  for (const CLI::Option* option : options)
    if (option->count() > 0 && !isTheirs)
      throw UsageError(
          {.what = option->get_name(), .found = "--planner " + toString(planner), .wanted = wanted});
}

}  // namespace

void addPlan(CLI::App* command, Action& action) {
  const auto options = std::make_shared<PlanOptions>();
  const PlannerDefaults usual = defaultsOf(options->planner), car = defaultsOf(Planner::kHybridAStar);
  command->footer(
      "Examples:\n  scripts/rex plan board --goal 1.5,-1.1,-1 -o around\n"
      "  scripts/rex plan maze --goal 3,0,0 --planner rrt-star --speed 0.5 -o rooms\n"
      "  scripts/rex plan board --goal 'stem>arm1=1.5' --planner lazy-prm --runs 20 -o compare\n"
      "  scripts/rex plan street --goal -1.3,1.1,0 --planner hybrid-astar -o park\n"
      "  scripts/rex plan board --goal eff:0,-0.3,0.5 --planner optimize --avoid -o smooth\n\n"
      "Lengths are Euclidean distances between joint vectors, in rad and m. Turning joints\n"
      "without limits turn the shorter way round. The motion is the fastest within the limits of\n"
      "the scene. hybrid-astar (Dolgov 2010) drives a car, the scene's one joint that moves\n"
      "(transXYPhi: x and y of the middle of the rear axle, and the heading), past all shapes but\n"
      "those of the body that carries it. optimize minimises the accelerations of all joints from\n"
      "rest to rest (slides 5:3 to 5:5), by an augmented Lagrangian; optimize-penalty and\n"
      "optimize-barrier by these.\n"
      "DIR gets path.csv (time and joints; `rex render --motion` reads it), tree.png (what was\n"
      "explored) or costs.png, path.mp4 and path.html (a replay).\n"
      "Exit codes: 0 found a path, 1 found none, one not proven clear, or one\n"
      "that cannot be timed, 64 wrong use.");
  addSceneFile(command, "SCENE", options->scene.file);
  addOptions(command, {{"-o,--out", options->out, "DIR", "folder for the results"},
                       {"--start", options->start, "POSTURE",
                        "all numbers, joint=number,..., 0, file, or key:NAME or state:NAME of the file"},
                       {"--goal", options->goal, "GOAL",
                        "posture to reach, as for --start; with --planner optimize, BODY:x,y,z in metres"},
                       {"--planner", options->planner, plannerNames(), "how to search"},
                       {"--margin", options->margin, usual.margins, "METRES",
                        fmt::format("clearance to keep between all shapes (default: {:g}; hybrid-astar {:g}, "
                                    "optimize --avoid {:g})",
                                    usual.margin, car.margin, defaultsOf(Planner::kOptimize).margin)},
                       {"--no-film", options->noFilm, "do not make path.mp4 and path.html"}});
  addFilmSpeed(command, options->speed);
  addFilmOptions(command, options->film);
  addJson(command, options->json);
  addReading(command, options->scene.reading);
  addGl(command, options->film.gl);
  const auto drawn = addOptions(
      command,
      {{"--samples", options->samples, usual.budgets, "N",
        fmt::format("budget of samples (default: {}; rrt-star {}, roadmaps {})", usual.samples,
                    defaultsOf(Planner::kRrtStar).samples, defaultsOf(Planner::kPrm).samples)},
       {"--time-limit",
        options->timeLimit,
        {1e-3, 1e5},
        "S",
        "processor time for a search, without smoothing"},
       seedRow(options->seed),
       {"--runs", options->runs, {1, 10'000}, "N", "searches, each with the next seed, in a table"},
       {"--no-smooth", options->noSmooth, "the path as the planner finds it, with a stop at each corner"},
       {"--velocity", options->velocity, {1e-6, 1e6}, "X", "limit for joints without one, rad/s or m/s"},
       {"--ramp", options->ramp, {1e-6, 1e6}, "S", "time from rest to the velocity limits of the joints"},
       {"--effort", options->effort, "keep within the effort limits of the scene, too (no friction)"},
       {"--body", options->body, "NAME",
        "draw the paths of this body (default: the one moved by most joints)"}},
      "Planners that draw samples");
  const auto grown =
      addOptions(command, {{"--step", options->step, {1e-3, 1e3}, "LENGTH", "step size of growing trees"}},
                 "rrt, rrt-connect and rrt-star");
  const auto checked =
      addOptions(command,
                 {{"--resolution",
                   options->resolution,
                   {1e-4, 10},
                   "LENGTH",
                   fmt::format("distance between checks along the path (default: {:g}; hybrid-astar {:g})",
                               usual.resolution, car.resolution)}},
                 "All but optimize");
  HybridAStarOptions& grid = options->grid;
  const auto driven =
      addOptions(command,
                 {{"--wheelbase", options->wheelbase, {1e-2, 100}, "METRES", "distance of the axles"},
                  {"--steering", options->steering, {1e-2, 1.5}, "RAD", "largest steering angle"},
                  {"--cell", grid.cellSize, {1e-2, 10}, "METRES", "size of cells"},
                  {"--reverse-cost", grid.reverseFactor, {1, 1000}, "X", "cost of a metre backward"},
                  {"--switch-cost", grid.switchCost, {0, 1e6}, "METRES", "cost of changing direction"},
                  {"--slack",
                   grid.slack,
                   {0, 10},
                   "X",
                   "by what share a path may cost more than the best one on the grid"},
                  {"--states", grid.maxExpanded, {1, 1e8}, "N", "budget of expanded states"}},
                 "hybrid-astar");
  const auto optimized =
      addOptions(command,
                 {{"--avoid", options->avoid, "keep all shapes apart, also between steps"},
                  {"--steps", options->steps, {3, 10'000}, "N", "number of steps of the motion"},
                  {"--duration", options->duration, {1e-3, kLongestFilm}, "S", "time of the motion"}},
                 "optimize");
  command->callback([&action, options, drawn, grown, checked, driven, optimized] {
    const Planner planner = options->planner;
    const bool isCar = planner == Planner::kHybridAStar, isPath = drawsSamples(planner);
    requireOwn(drawn, isPath, planner, "a planner that draws samples");
    requireOwn(grown, growsTrees(planner), planner, "a planner that grows trees");
    requireOwn(checked, isPath || isCar, planner, "another planner");
    requireOwn(driven, isCar, planner, "--planner hybrid-astar");
    requireOwn(optimized, !isPath && !isCar, planner, "--planner optimize");
    action = [options](const Project& p) { return plan(p, *options); };
  });
}

}  // namespace rex::cli
