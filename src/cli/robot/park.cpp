// `rex park`: hybrid A* for a car in a scene.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "base/text_file.h"
#include "cli/json_internal.h"
#include "cli/option_value_internal.h"
#include "cli/robot/contact_limit.h"
#include "cli/robot/film_file.h"
#include "cli/robot/motion_files.h"
#include "cli/robot/parking.h"
#include "cli/robot/path_files.h"
#include "cli/robot/path_motion.h"
#include "cli/robot/path_pictures.h"
#include "cli/robot/posture_within_limits.h"
#include "cli/robot/robot_options_internal.h"
#include "cli/robot/robot_room_internal.h"
#include "cli/terminal.h"
#include "cli/wrong_use_internal.h"
#include "collision/collision_pairs.h"
#include "collision/contacts.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

struct ParkOptions {
  SceneOption scene{};
  std::string start{}, goal{};  ///< x,y,heading; see parsePosture(); an empty start: that of the file
  double wheelbase = 2.6, steering = 0.6;
  double margin = 0.05;  ///< metres between all pairs of shapes
  double resolution = 0.05;
  HybridAStarOptions search{};
  double speed = 1;  ///< of the film; 1: as a car at 1 m/s
  RenderOptions film{};
  bool noFilm = false;
  bool json = false;
  fs::path out{};  ///< a folder
};

void requireSensible(const ParkOptions& options) {
  requireBetween("--wheelbase", options.wheelbase, 1e-2, 100);
  requireBetween("--steering", options.steering, 1e-2, 1.5);
  requireBetween("--margin", options.margin, 0, kQueryCutoff);
  requireBetween("--resolution", options.resolution, 1e-3, 1);
  requireBetween("--cell", options.search.cellSize, 1e-2, 10);
  requireBetween("--reverse-cost", options.search.reverseFactor, 1, 1000);
  requireBetween("--switch-cost", options.search.switchCost, 0, 1e6);
  requireBetween("--slack", options.search.slack, 0, 10);
  requireBetween("--states", options.search.maxExpanded, 1, 1e8);
  requireBetween("--speed", options.speed, 1e-3, 1e3);
}

// Whoever puts obstacles there would see the car drive through them.
void tellWhatIsNoObstacle(const Model& model) {
  for (const PairVerdict& pair : pairVerdicts(model))
    if (pair.reason == PairReason::kNeighbours)
      note(wrap(
          fmt::format("shapes of '{}' and '{}' do not stop each other, because a joint links these bodies: "
                      "put obstacles on a body of their own",
                      harmless(model[pair.a].name), harmless(model[pair.b].name)),
          2, 0));
}

PathTask taskOf(Model model, const ParkOptions& options) {
  requireCar(model);
  const ContactModel contacts = contactModelOf(model);
  const Eigen::VectorXd start =
      postureWithinLimits(model, "--start", options.start.empty() ? "file" : options.start);
  const Eigen::VectorXd goal = postureWithinLimits(model, "--goal", options.goal);
  PathTask task = asWrongUse([&] {
    return parkingTask(std::move(model), contacts, start, goal, options.margin, options.resolution);
  });
  requireFreeEnds(task.problem, options.margin);
  tellWhatIsNoObstacle(task.model);
  return task;
}

Report replayOf(const PathTask& task, const Parking& parking, const ParkOptions& options,
                const std::string& title, const Motion& motion) {
  Report report{.title = title,
                .figures = {{jointsFigure(task.model, motion)}},
                .facts = {{"length", fmt::format("{:.2f} m", parking.path.length)},
                          {"changes of direction", fmt::format("{}", parking.path.switches)},
                          {"margin", fmt::format("{:g} m", options.margin)},
                          {"states expanded", fmt::format("{}", parking.path.expanded)}}};
  if (!task.contacts.pairs().empty()) {
    report.figures.push_back({clearanceFigure(task.model, task.contacts, motion, options.margin)});
    report.facts.emplace_back("clearance", fmt::format("{:.4g} m", parking.clearance.atLeast));
  }
  return report;
}

std::vector<std::string> writeFiles(const PathTask& task, const Parking& parking, const ParkOptions& options,
                                    const RenderPlan& pictures) {
  const std::string title = harmless(task.model.name()) + ", hybrid A*";
  std::vector<fs::path> files = {options.out / "tree.png"};
  writeExplored(parkingPicture(task, parking), pictures,
                fmt::format("{}: {} states expanded", title, parking.path.expanded), files.back());
  if (parking.isFound()) {
    files.push_back(options.out / "path.csv");
    constexpr double kRate = 100;
    writeTextFile(files.back(), csvOf(task.model, motionOf(parking, kRate)));
  }
  if (parking.isFound() && !options.noFilm) {
    const double speed = filmSpeed(options.speed, parking.path.length);
    const Motion motion = motionOf(parking, kFilmRate / speed);
    for (const fs::path& file : writeFilmAndReplay(task.model, motion, farthestBody(task.model),
                                                   replayOf(task, parking, options, title, motion), pictures,
                                                   options.out / "path", speed))
      files.push_back(file);
  }
  std::vector<std::string> names;
  for (const fs::path& file : files) names.push_back(shown(file));
  return names;
}

std::string summaryOf(const PathTask& task, const Parking& parking, const ParkOptions& options) {
  std::string text =
      fmt::format("{}, hybrid A*: {}", harmless(task.model.name()), parking.path.driven.found.message);
  if (!parking.isFound()) return text;
  text += fmt::format("\ncost       {:.3f}, no path on the grid costs less than {:.3f}\nclearance  ",
                      parking.path.cost, parking.path.leastCost);
  text += std::isfinite(parking.clearance.atLeast) ? fmt::format("{:.4f} m all along the path, margin {:g} m",
                                                                 parking.clearance.atLeast, options.margin)
                                                   : "nothing can collide";
  text += "\nmetres and steering angles (negative: backward)";
  for (const auto& [u, seconds] : parking.path.driven.controls)
    text += fmt::format("\n{:9.3f} {:8.3f}", u[0] * seconds, u[1]);
  return text;
}

std::string jsonTextOf(const PathTask& task, const Parking& parking, const std::vector<std::string>& files) {
  const CarPath& path = parking.path;
  Json controls = Json::array();
  for (const auto& [u, seconds] : path.driven.controls)
    controls.push_back(Json::array({u[0] * seconds, u[1]}));
  const auto orNull = [&](double number) {
    return parking.isFound() && std::isfinite(number) ? Json(number) : Json();
  };
  return dump(Json{{"scene", task.model.name()},
                   {"found", parking.isFound()},
                   {"message", path.driven.found.message},
                   {"expanded", path.expanded},
                   {"checks", path.driven.found.asked},
                   {"cost", orNull(path.cost)},
                   {"least_cost", orNull(path.leastCost)},
                   {"length", orNull(path.length)},
                   {"switches", parking.isFound() ? Json(path.switches) : Json()},
                   {"clearance", orNull(parking.clearance.atLeast)},
                   {"drives", std::move(controls)},
                   {"path", parking.isFound() ? jsonOfRows(path.driven.found.path.transpose()) : Json()},
                   {"files", files}});
}

// Parks a car: writes what was explored, the motion, a film and a replay. kBelow without a path, or if it is
// not proven that nothing touches.
ExitCode park(const Project& project, const ParkOptions& options) {
  RenderOptions filmOptions = options.film;
  filmOptions.out = options.out / "path.mp4";
  if (filmOptions.cameras.empty()) filmOptions.cameras = {"0,-0.5,1"};  // a street is seen from above
  const RenderPlan pictures = planOf(filmOptions, facingOf(fileOf(project, options.scene)));
  requireSensible(options);
  Model model = loadScene(project, options.scene);
  if (!options.noFilm) requireFilmable(model);
  const Car car{.wheelbase = options.wheelbase, .maxSteering = options.steering};
  const PathTask task = taskOf(std::move(model), options);
  makeResultFolder(options.out, {"tree.png", "path.csv", "path.mp4", "path.html"}, "path");

  const Parking parking = asWrongUse([&] { return parked(task, car, options.search); });
  const std::vector<std::string> files = writeFiles(task, parking, options, pictures);
  if (options.json) {
    say(jsonTextOf(task, parking, files));
  } else {
    say(summaryOf(task, parking, options));
    for (const std::string& file : files) say(file);
  }
  if (!parking.isFound()) return ExitCode::kBelow;
  if (parking.clearance.atLeast > (options.margin > 0 ? 0 : -kClearanceTolerance)) return ExitCode::kFull;
  note(
      "it is not proven that shapes stay apart between the poses that were checked: use a finer --resolution "
      "or a larger --margin");
  return ExitCode::kBelow;
}

}  // namespace

void addPark(CLI::App* command, Action& action) {
  const auto options = std::make_shared<ParkOptions>();
  command->footer(
      "Examples:\n  scripts/rex park street --goal -1.3,1.1,0 -o park\n"
      "  scripts/rex park street --start -1.3,1.1,0 --goal 8,4.5,0 --reverse-cost 3 -o leave --no-film\n\n"
      "The scene has one joint that moves, of type transXYPhi: x and y of the middle of the rear axle,\n"
      "and the heading. Shapes of the body to which it joins the car are no obstacles. Hybrid A*\n"
      "(Dolgov 2010) finds a path of arcs past all others. DIR gets path.csv (time at 1 m/s, and joints;\n"
      "`rex render --motion` reads it), tree.png (what was explored, from the goal back), path.mp4 and\n"
      "path.html (a replay).\n"
      "Exit codes: 0 found a path, 1 found none or one not proven clear, 64 wrong use.");
  const HybridAStarOptions& search = options->search;
  addSceneFile(command, "SCENE", options->scene.file);
  command->add_option("-o,--out", options->out, "folder for the results")->type_name("DIR")->required();
  command->add_option("--start", options->start, "x,y,heading, or file (default: file)")->type_name("POSE");
  command->add_option("--goal", options->goal, "pose to reach, metres and radians")
      ->type_name("POSE")
      ->required();
  command->add_option("--wheelbase", options->wheelbase, "metres between the axles (default: 2.6)")
      ->type_name("METRES");
  command->add_option("--steering", options->steering, "largest steering angle (default: 0.6)")
      ->type_name("RAD");
  command->add_option("--margin", options->margin, "clearance to keep between all shapes (default: 0.05)")
      ->type_name("METRES");
  command
      ->add_option("--resolution", options->resolution,
                   "distance between checks along the path (default: 0.05)")
      ->type_name("METRES");
  command
      ->add_option("--cell", options->search.cellSize,
                   fmt::format("size of cells (default: {:g})", search.cellSize))
      ->type_name("METRES");
  command
      ->add_option("--reverse-cost", options->search.reverseFactor,
                   fmt::format("cost of a metre backward, at least 1 (default: {:g})", search.reverseFactor))
      ->type_name("X");
  command
      ->add_option("--switch-cost", options->search.switchCost,
                   fmt::format("cost of changing direction, in metres (default: {:g})", search.switchCost))
      ->type_name("X");
  command
      ->add_option(
          "--slack", options->search.slack,
          fmt::format("by what share a path may cost more than the best one on the grid (default: {:g})",
                      search.slack))
      ->type_name("X");
  command
      ->add_option("--states", options->search.maxExpanded,
                   fmt::format("budget of expanded states (default: {})", search.maxExpanded))
      ->type_name("N");
  addFilmSpeed(command, options->speed);
  command->add_flag("--no-film", options->noFilm, "do not make path.mp4 and path.html");
  addFilmOptions(command, options->film);
  addJson(command, options->json);
  addReading(command, options->scene.reading);
  addGl(command, options->film.gl);
  command->callback(
      [&action, options] { action = [options](const Project& p) { return park(p, *options); }; });
}

}  // namespace rex::cli
