#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "base/text_file.h"
#include "cli/json_internal.h"
#include "cli/option_value_internal.h"
#include "cli/robot/contact_limit.h"
#include "cli/robot/film_file.h"
#include "cli/robot/motion_files.h"
#include "cli/robot/robot_options_internal.h"
#include "cli/robot/robot_room_internal.h"
#include "cli/robot/simulation.h"
#include "cli/shared_options_internal.h"
#include "cli/wrong_use_internal.h"
#include "render/figure.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

struct SimulateOptions {
  SceneOption scene{};
  std::string posture{};   ///< see parsePosture(); empty: that of the file
  std::string velocity{};  ///< see parseVelocities(); empty: at rest
  std::string engine = "rk4";
  double seconds = 5;
  double tau = 1e-3;              ///< seconds per step
  bool hold = false;              ///< computed torque holds the posture
  bool friction = false;          ///< that of the joints, as in the scene
  double noise = 0;               ///< see StepperOptions
  std::optional<double> floor{};  ///< its height, metres; empty: none but what the scene has
  std::uint64_t seed = 0;
  double speed = 1;  ///< of the film; 1: real time
  bool noFilm = false;
  RenderOptions film{};               ///< cameras, size and gl of the film
  std::vector<std::string> traces{};  ///< bodies whose way is drawn
  bool json = false;
  std::filesystem::path out{};  ///< a folder
};

constexpr double kMostSteps = 2e5;  // of which the log takes some hundred megabytes, at most

// None: Bullet, which takes steps of its own.
std::optional<Integrator> integratorOf(const std::string& engine) {
  return choose<std::optional<Integrator>>("--engine", engine,
                                           {{"rk4", Integrator::kRungeKutta4},
                                            {"beeman", Integrator::kBeeman},
                                            {"leapfrog", Integrator::kLeapfrog},
                                            {"semi-implicit", Integrator::kSemiImplicitEuler},
                                            {"euler", Integrator::kEuler},
                                            {"bullet", std::nullopt}});
}

SimulationPlan planOf(const Model& model, const SimulateOptions& options) {
  SimulationPlan plan{.tau = options.tau, .isHeld = options.hold, .seed = options.seed};
  if (const auto integrator = integratorOf(options.engine))
    plan.stepper = {
        .integrator = *integrator, .jointForces = {.friction = options.friction}, .noise = options.noise};
  else
    plan.physics = {.jointFriction = options.friction};
  if (plan.physics && options.noise != 0)
    throw UsageError({.what = "--noise", .found = "--engine bullet", .wanted = "another engine"});
  requireBetween("--tau", options.tau, 1e-6, 1);
  requireBetween("--seconds", options.seconds, 1e-6, 120);
  requireBetween("--noise", options.noise, 0, 1e6);
  requireBetween("--speed", options.speed, 1e-3, 1e3);
  requireBetween("--seconds / --tau, steps", options.seconds / options.tau, 1, kMostSteps);
  plan.steps = static_cast<int>(std::lround(options.seconds / options.tau));
  for (const std::string& body : options.traces) asWrongUse([&] { return model.body(body); }, "--trace: ");
  if (model.nv() == 0) throw UsageError({.what = model.name(), .found = "no joint that moves"});
  plan.start = initialState(model);
  if (!options.posture.empty()) plan.start.q = parsePosture(model, options.posture);
  if (!options.velocity.empty()) plan.start.v = parseVelocities(model, options.velocity);
  return plan;
}

std::string logOf(const std::vector<Moment>& moments) {
  fmt::memory_buffer log;
  const auto out = std::back_inserter(log);
  fmt::format_to(out, "time");
  for (Eigen::Index i = 0; i < moments[0].state.q.size(); ++i) fmt::format_to(out, ",q{}", i);
  for (Eigen::Index i = 0; i < moments[0].state.v.size(); ++i) fmt::format_to(out, ",v{}", i);
  fmt::format_to(out, ",kinetic,potential,total\n");
  for (const auto& [state, energy] : moments) {
    fmt::format_to(out, "{}", state.time);
    for (const double x : state.q) fmt::format_to(out, ",{}", x);
    for (const double x : state.v) fmt::format_to(out, ",{}", x);
    fmt::format_to(out, ",{},{},{}\n", energy.kinetic, energy.potential, energy.total());
  }
  return fmt::to_string(log);
}

// Potential energy from that of the start, because its zero lies anywhere. Of very many moments some
// thousand: a picture has no more columns.
Figure energyFigure(const std::vector<Moment>& moments, const std::string& title) {
  Series kinetic{.label = "kinetic"}, potential{.label = "potential"}, total{.label = "total", .size = 1.5};
  const double zero = moments.front().energy.potential;
  const std::size_t stride = 1 + moments.size() / 4000;
  for (std::size_t i = 0; i < moments.size(); i += stride) {
    const auto& [state, energy] = moments[i];
    for (Series* series : {&kinetic, &potential, &total}) series->x.push_back(state.time);
    kinetic.y.push_back(energy.kinetic);
    potential.y.push_back(energy.potential - zero);
    total.y.push_back(energy.total() - zero);
  }
  return {.title = title,
          .xLabel = "time [s]",
          .yLabel = "energy [J], potential 0 at the start",
          .legend = Legend::kOutside,
          .series = {kinetic, potential, total}};
}

// How far the total energy was from that of the start.
double largestChange(const std::vector<Moment>& moments) {
  double change = 0;
  for (const Moment& moment : moments)
    change = std::max(change, std::abs(moment.energy.total() - moments.front().energy.total()));
  return change;
}

std::string titleOf(const Model& model, const SimulateOptions& options) {
  return fmt::format("{}, {}, {}, steps of {:g} ms", model.name(), options.hold ? "held" : "free",
                     options.engine, 1000 * options.tau);
}

fs::path writeMotion(const Model& model, const std::vector<Moment>& moments, const SimulateOptions& options,
                     const RenderPlan& film) {
  const double speed = filmSpeed(options.speed, static_cast<double>(moments.size() - 1) * options.tau);
  const Motion motion = motionOf(moments, options.tau, kFilmRate / speed);
  std::vector<std::size_t> shown(motion.postures.size());
  std::iota(shown.begin(), shown.end(), std::size_t{0});
  const MotionPictures pictures(model, motion, shown, options.traces, titleOf(model, options));
  return writeFilm(pictures, film, options.out / "simulate.mp4");
}

// What rounds to zero has no sign.
double rounded(double x) { return std::abs(x) < 5e-6 ? 0 : x; }

// Where each coordinate was at first, and is in the end.
void sayPostures(const Model& model, const Eigen::VectorXd& first, const Eigen::VectorXd& last) {
  std::size_t width = 0;
  for (const Joint& joint : model.joints()) width = std::max(width, harmless(joint.name).size());
  for (const Joint& joint : model.joints()) {
    if (joint.mimics) continue;
    for (int i = joint.qIndex; i < joint.qIndex + joint.nq; ++i)
      say(fmt::format("q{:<3} {:{}}  {:9.5f} -> {:9.5f}", i, harmless(joint.name), width, rounded(first[i]),
                      rounded(last[i])));
  }
}

void report(const Model& model, const std::vector<Moment>& moments, const SimulateOptions& options,
            const std::vector<std::string>& files) {
  const Moment &first = moments.front(), &last = moments.back();
  const std::size_t steps = moments.size() - 1;
  if (options.json) {
    say(dump(Json{{"scene", model.name()},
                  {"engine", options.engine},
                  {"held", options.hold},
                  {"tau", options.tau},
                  {"steps", steps},
                  {"energy",
                   {{"start", first.energy.total()},
                    {"end", last.energy.total()},
                    {"largest_change", largestChange(moments)}}},
                  {"q", jsonOf(last.state.q)},
                  {"v", jsonOf(last.state.v)},
                  {"files", files}}));
    return;
  }
  say(fmt::format("{}: {} steps, {:g} s", titleOf(model, options), steps, last.state.time));
  say(fmt::format("energy: {:.6g} J at first, {:.6g} J in the end, largest change {:.2g} J",
                  first.energy.total(), last.energy.total(), largestChange(moments)));
  sayPostures(model, first.state.q, last.state.q);
  for (const std::string& file : files) say(file);
}

// A slab that is not drawn: films have a ground of their own, which lies where the lowest shape comes to.
ShapeSpec floorAt(double height) {
  constexpr double kThickness = 1, kWidth = 100;
  return {.name = "floor",
          .X_BS = translation(0, 0, height - kThickness / 2),
          .shape = {.type = ShapeType::kBox, .extent = {kWidth, kWidth, kThickness}},
          .contact = true,
          .visible = false};
}

Model modelOf(const Project& project, const SimulateOptions& options) {
  SceneSpec spec = loadSpec(project, options.scene);
  if (options.floor) {
    requireBetween("--floor", *options.floor, -1e3, 1e3);
    if (integratorOf(options.engine))
      throw UsageError({.what = "--floor",
                        .found = "--engine " + harmless(options.engine),
                        .wanted = "--engine bullet, which knows contacts"});
    spec.worldShapes.push_back(floorAt(*options.floor));
  }
  return asWrongUse([&] { return compile(spec); });
}

// Lets a scene move under gravity; writes log, energy plot and film.
ExitCode simulateScene(const Project& project, const SimulateOptions& options) {
  RenderOptions filmOptions = options.film;
  filmOptions.out = options.out / "simulate.mp4";
  const RenderPlan film = planOf(filmOptions, facingOf(fileOf(project, options.scene)));
  const Model model = modelOf(project, options);
  if (!options.noFilm) requireFilmable(model);
  const SimulationPlan plan = planOf(model, options);
  if (plan.physics) noteCollisionWarnings(model);
  const std::vector<Moment> moments = asWrongUse([&] { return simulate(model, plan); });

  std::vector<std::string> files;
  writeTextFile(options.out / "log.csv", logOf(moments));
  files.push_back(shown(options.out / "log.csv"));
  const Figure figure = energyFigure(moments, titleOf(model, options));
  for (const char* name : {"energy.png", "energy.svg"}) {
    writeFigure(figure, options.out / name);
    files.push_back(shown(options.out / name));
  }
  if (!options.noFilm) files.push_back(shown(writeMotion(model, moments, options, film)));
  report(model, moments, options, files);
  return ExitCode::kFull;
}

}  // namespace

void addSimulate(CLI::App* command, Action& action) {
  const auto options = std::make_shared<SimulateOptions>();
  command->footer(
      "Examples:\n  scripts/rex simulate pegArm -o fall\n"
      "  scripts/rex simulate arm3 --q 0.5,-0.5,0.3 --v 0,2,0 --hold --seconds 2 -o hold\n"
      "  scripts/rex simulate pegArm --engine euler --tau 0.01 -o euler\n"
      "  scripts/rex simulate quadruped --free-base --engine bullet --floor -0.9 -o drop\n\n"
      "Joints are free; only bullet knows contacts and limits of joints. DIR gets log.csv\n"
      "(time, q, v and energies of every step), energy.png, energy.svg and simulate.mp4.");
  addSceneFile(command, "SCENE", options->scene.file);
  command->add_option("-o,--out", options->out, "folder for what is written")->type_name("DIR")->required();
  command
      ->add_option("--engine", options->engine,
                   "rk4, beeman, leapfrog, semi-implicit, euler; bullet (default: rk4)")
      ->type_name("NAME");
  command->add_option("--seconds", options->seconds, "how long (default: 5)")->type_name("S");
  command->add_option("--tau", options->tau, "seconds per step (default: 0.001)")->type_name("S");
  addPosture(command, options->posture);
  command->add_option("--v", options->velocity, "all velocities, or joint=number,... (default: 0)")
      ->type_name("VELOCITY");
  command->add_flag("--hold", options->hold, "computed torque holds the posture of the start");
  command->add_flag("--friction", options->friction, "with friction and damping of the scene's joints");
  command->add_option("--noise", options->noise, "each step adds sqrt(tau) * X * N(0, 1) to velocities")
      ->type_name("X");
  addSeed(command, options->seed, "of the noise (default: 0)");
  command->add_option("--floor", options->floor, "a floor at that height, metres (bullet; default: none)")
      ->type_name("Z");
  addFilmSpeed(command, options->speed);
  command->add_flag("--no-film", options->noFilm, "no simulate.mp4");
  addFilmOptions(command, options->film);
  command->add_option("--trace", options->traces, "whose way is drawn as a line")
      ->allow_extra_args(false)
      ->type_name("BODY");
  addJson(command, options->json);
  addReading(command, options->scene.reading);
  addGl(command, options->film.gl);
  command->callback(
      [&action, options] { action = [options](const Project& p) { return simulateScene(p, *options); }; });
}

}  // namespace rex::cli
