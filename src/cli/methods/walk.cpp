// `rex walk`: the humanoid in the simulated world, on an uneven floor and pushed.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/interruption.h"
#include "base/rng.h"
#include "base/text_file.h"
#include "cli/json_internal.h"
#include "cli/methods/film_folder.h"
#include "cli/methods/methods_room_internal.h"
#include "cli/option_value_internal.h"
#include "cli/project.h"
#include "cli/shared_options_internal.h"
#include "cli/terminal.h"
#include "course/plot.h"
#include "course/walk_pictures.h"
#include "kinematics/center_of_mass.h"
#include "locomotion/simulated_walk.h"

namespace rex::cli {
namespace {

constexpr double kFeetApart = 0.19;  // metres, as wide as the hips
constexpr double kTile = 0.1;        // metres
constexpr double kPushAt = 4;        // seconds
constexpr double kMostPush = 128;    // N s, searched by --largest-push
constexpr int kEvery = 5;            // samples per view of the film and row of the table
constexpr Color kPlanColor{0.45f, 0.45f, 0.45f}, kZmpColor{0.84f, 0.37f, 0.0f},
    kCenterColor{0.0f, 0.45f, 0.7f};

struct WalkCommandOptions {
  int steps = 20;
  double length = 0.2;             // metres
  double unevenness = 0.005;       // metres
  std::vector<double> push{};      // x and y, N s
  std::optional<double> pushAt{};  // seconds
  bool largestPushes = false;
  std::uint64_t seed = 0;
  int seeds = 1;
  bool noFilm = false, json = false;
  std::filesystem::path out{};
};

// A walk on the floor of a seed.
struct HumanoidRun {
  WalkPlan plan;
  CourseHumanoid humanoid;
  Eigen::VectorXd home;
  SimulatedWalkOptions simulation;
  SimulatedWalk done{};
};

WalkPlan planOf(const WalkCommandOptions& options) {
  return {.footsteps = straightFootsteps(options.steps, options.length, kFeetApart)};
}

HumanoidRun preparedHumanoid(const WalkCommandOptions& options, std::uint64_t seed) {
  WalkPlan plan = planOf(options);
  SceneSpec floor;
  Rng rng(seed);
  addUnevenFloor(floor, plan, options.unevenness, kTile, rng);
  CourseHumanoid humanoid = courseHumanoid(floor.worldShapes);
  WalkPlan start = plan;
  start.footsteps.resize(2);
  const WalkingPattern pattern = walkingPattern(humanoid.model, humanoid.legs, start, humanoid.start);
  SimulatedWalkOptions simulation{.startAbove = options.unevenness};
  if (!options.push.empty())
    simulation.pushes = {
        {.time = options.pushAt.value_or(kPushAt), .impulse_W = {options.push[0], options.push[1], 0}}};
  return {std::move(plan), std::move(humanoid), pattern.Q.col(0), simulation};
}

HumanoidRun walkedHumanoid(const WalkCommandOptions& options, std::uint64_t seed) {
  HumanoidRun walk = preparedHumanoid(options, seed);
  walk.done = simulateWalk(walk.humanoid.model, walk.humanoid.legs, walk.plan, walk.home, walk.simulation);
  return walk;
}

// The plan and what was measured, by time or from above.
Figure zmpFigures(const HumanoidRun& walk, bool isFromAbove) {
  Figure figure = isFromAbove ? footprintFigure(walk.plan) : Figure{.xLabel = "time [s]", .yLabel = "y [m]"};
  figure.title = "Zero moment point of the simulated humanoid";
  figure.legend = Legend::kOutside;
  figure.width = 1100;
  figure.height = isFromAbove ? 350 : 450;
  figure.series = {{.label = "measured from contacts", .size = 1.2, .color = kZmpColor},
                   {.label = "planned", .dashed = true, .color = kPlanColor},
                   {.label = "centre of mass", .size = 2, .color = kCenterColor}};
  const auto add = [&](Series& series, double time, const Eigen::Vector2d& p) {
    series.x.push_back(isFromAbove ? p.x() : time);
    series.y.push_back(p.y());
  };
  for (const WalkMeasurement& sample : walk.done.samples) {
    if (sample.measured.exists) add(figure.series[0], sample.time, sample.measured.p_W.head<2>());
    add(figure.series[1], sample.time, sample.control.plannedZmp);
    const Model& model = walk.humanoid.model;
    add(figure.series[2], sample.time, centerOfMass(model, forwardKinematics(model, sample.q)).head<2>());
  }
  return figure;
}

void writeHumanoidFilm(const WalkCommandOptions& options, const HumanoidRun& walk) {
  HumanoidWalk shown{.plan = walk.plan};
  std::vector<const WalkMeasurement*> views;
  for (std::size_t i = 0; i < walk.done.samples.size(); i += kEvery) views.push_back(&walk.done.samples[i]);
  const Model& model = walk.humanoid.model;
  Eigen::MatrixXd Q(model.nq(), static_cast<Eigen::Index>(views.size()));
  for (std::size_t k = 0; k < views.size(); ++k) {
    const WalkMeasurement& sample = *views[k];
    Q.col(static_cast<Eigen::Index>(k)) = sample.q;
    shown.center.emplace_back(centerOfMass(model, forwardKinematics(model, sample.q)).head<2>());
    // In the air it stays where it was.
    if (sample.measured.exists || shown.zmp.empty())
      shown.zmp.emplace_back(sample.measured.p_W.head<2>());
    else
      shown.zmp.push_back(shown.zmp.back());
  }
  writeFilm(walk.humanoid, Q, shown, (options.out / "walk").string(),
            {.view = {.35, -1, .5}, .width = 960, .height = 540, .step = kEvery * walk.simulation.step});
}

std::vector<std::string> writeHumanoidFiles(const WalkCommandOptions& options, const HumanoidRun& walk) {
  const std::filesystem::path& out = options.out;
  std::string table =
      "time,zmp_x,zmp_y,planned_x,planned_y,demanded_x,demanded_y,error_x,error_y,force,left,right\n";
  for (std::size_t i = 0; i < walk.done.samples.size(); i += kEvery) {
    const WalkMeasurement& now = walk.done.samples[i];
    const WalkControl& control = now.control;
    table += fmt::format("{:.3f},{},{},{},{},{},{},{},{},{},{},{}\n", now.time, now.measured.p_W.x(),
                         now.measured.p_W.y(), control.plannedZmp.x(), control.plannedZmp.y(),
                         control.zmp.x(), control.zmp.y(), control.captureError.x(), control.captureError.y(),
                         now.measured.force_W.z(), now.loads.left, now.loads.right);
  }
  writeTextFile(out / "walk.csv", table);
  plot((out / "zmp").string(), zmpFigures(walk, true));
  plot((out / "zmp_time").string(), zmpFigures(walk, false));
  std::vector<std::string> files{shown(out / "walk.csv"), shown(out / "zmp.png"),
                                 shown(out / "zmp_time.png")};
  if (options.noFilm) return files;
  writeHumanoidFilm(options, walk);
  const std::filesystem::path film = out / "walk.mp4";
  files.push_back(shown(std::filesystem::exists(film) ? film : out / "walk"));
  files.push_back(shown(out / "walk_sheet.png"));
  return files;
}

// The directions of pushes, as people would name them.
const std::vector<std::pair<const char*, Eigen::Vector3d>>& pushDirections() {
  static const std::vector<std::pair<const char*, Eigen::Vector3d>> all = {{"from_behind", {1, 0, 0}},
                                                                           {"from_front", {-1, 0, 0}},
                                                                           {"from_right", {0, 1, 0}},
                                                                           {"from_left", {0, -1, 0}}};
  return all;
}

Json largestPushes(const WalkCommandOptions& options) {
  Json all = Json::object();
  const HumanoidRun walk = preparedHumanoid(options, options.seed);
  for (const auto& [name, direction] : pushDirections()) {
    throwIfInterrupted();
    const double impulse =
        largestPush(walk.humanoid.model, walk.humanoid.legs, walk.plan, walk.home, direction,
                    options.pushAt.value_or(kPushAt), kMostPush, 1, walk.simulation);
    all[name] = impulse;
    if (!options.json) {
      std::string words = name;
      std::replace(words.begin(), words.end(), '_', ' ');
      say(fmt::format("{:<12} {:>6.1f} N s", words, impulse));
    }
  }
  return all;
}

void requireWalkable(const WalkCommandOptions& options) {
  requireBetween("--steps", options.steps, 1, 100);
  requireBetween("--length", options.length, -0.3, 0.4);
  requireBetween("--unevenness", options.unevenness, 0, 0.05);
  for (const double number : options.push) requireBetween("--push", number, -1000, 1000);
  requireBetween("--seeds", options.seeds, 1, 1000);
  if (options.noFilm && options.out.empty())
    throw UsageError({.what = "--no-film", .found = "no effect on its own", .wanted = "-o with it"});
  if (options.largestPushes && !options.push.empty())
    throw UsageError({.what = "--largest-push", .found = "--push beside it", .wanted = "one of them"});
  if (options.largestPushes || !options.push.empty())
    requireBetween("--push-at", options.pushAt.value_or(kPushAt), 0,
                   duration(planOf(options)) - TrunkPush{}.duration);
  else if (options.pushAt)
    throw UsageError({.what = "--push-at", .found = "no push", .wanted = "--push or --largest-push with it"});
}

// Lets the humanoid walk. Prints how well it did. kBelow if it falls.
ExitCode walkHumanoid(const WalkCommandOptions& options) {
  requireWalkable(options);
  if (!options.out.empty()) makeFilmFolder(options.out, "walk");
  if (!options.json)
    say(fmt::format("{:<6} {:>8} {:>12} {:>12} {:>8}", "seed", "walked", "capture point", "ZMP [m rms]",
                    "effort"));
  Json runs = Json::array();
  std::vector<std::string> files;
  bool falls = false;
  for (int i = 0; i < options.seeds; ++i) {
    throwIfInterrupted();
    const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(i);
    const HumanoidRun one = walkedHumanoid(options, seed);
    const SimulatedWalk& done = one.done;
    falls |= done.falls;
    const double walked = done.state.q[0] - one.home[0];
    runs.push_back({{"seed", seed},
                    {"falls", done.falls},
                    {"seconds", done.time},
                    {"message", done.message},
                    {"walked", walked},
                    {"capture_point", done.largestCaptureError},
                    {"zmp", done.rmsZmpError},
                    {"effort", done.largestEffort}});
    if (!options.json)
      say(fmt::format("{:<6} {:>6.2f} m {:>11.4f} m {:>12.4f} {:>6.0f} % {}", seed, walked,
                      done.largestCaptureError, done.rmsZmpError, 100 * done.largestEffort, done.message));
    if (i == 0 && !options.out.empty()) files = writeHumanoidFiles(options, one);
  }
  Json answer{{"steps", options.steps}, {"runs", std::move(runs)}};
  if (options.largestPushes) answer["largest_push"] = largestPushes(options);
  answer["files"] = files;
  if (options.json)
    say(dump(answer));
  else
    for (const std::string& file : files) say(file);
  return falls ? ExitCode::kBelow : ExitCode::kFull;
}

}  // namespace

void addWalk(CLI::App* command, Action& action) {
  const auto options = std::make_shared<WalkCommandOptions>();
  command->footer(
      "Examples:\n  scripts/rex walk --steps 8 -o walk\n  scripts/rex walk --push 0,25 --push-at 4 -o "
      "pushed\n"
      "  scripts/rex walk --steps 6 --largest-push\n\n"
      "The course's humanoid walks in the physics of Bullet, on tiles of different heights. Its motion is\n"
      "that of slide 11:12, and a controller of the capture point and the whole body keeps it on its feet:\n"
      "locomotion/walk_controller.h. Printed are the largest error of the capture point, the error of the\n"
      "zero moment point measured from the contacts, and the largest joint torque relative to its limit.\n"
      "DIR gets walk.csv, zmp.png (from above), zmp_time.png and the film walk.mp4.\n"
      "Exit codes: 0 stayed on its feet, 1 fell, 64 wrong use.");
  command->add_option("--steps", options->steps, "number of steps (default: 20)")->type_name("N");
  command->add_option("--length", options->length, "length of a step (default: 0.2)")->type_name("METRES");
  command->add_option("--unevenness", options->unevenness, "tiles are up to this high (default: 0.005)")
      ->type_name("METRES");
  command->add_option("--push", options->push, "push at the pelvis for 0.1 s, forward and to the left")
      ->type_name("X,Y")
      ->delimiter(',')
      ->expected(2);
  command->add_option("--push-at", options->pushAt, "when (default: 4)")->type_name("SECONDS");
  command->add_flag("--largest-push", options->largestPushes,
                    "find the largest pushes that it survives on the first floor, up to 128 N s, to 1 N s; "
                    "takes minutes");
  addSeed(command, options->seed, "seed of the floor (default: 0)");
  command->add_option("--seeds", options->seeds, "number of floors, each with its own seed")->type_name("N");
  command->add_option("-o,--out", options->out, "folder for the results of the first run")->type_name("DIR");
  command->add_flag("--no-film", options->noFilm, "do not make a film");
  command->add_flag("--json", options->json, "print JSON");
  command->callback(
      [&action, options] { action = [options](const Project&) { return walkHumanoid(*options); }; });
}

}  // namespace rex::cli
