#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
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
#include "cli/robot/robot_options_internal.h"
#include "cli/robot/scene_option.h"
#include "cli/robot/simulation.h"
#include "live/live_simulation.h"
#include "render/figure.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

enum class Engine { kRungeKutta4, kBeeman, kLeapfrog, kSemiImplicit, kEuler, kBullet };

const std::vector<std::pair<std::string, Engine>>& engineNames() {
  static const std::vector<std::pair<std::string, Engine>> kNames = {
      {"rk4", Engine::kRungeKutta4},   {"beeman", Engine::kBeeman},
      {"leapfrog", Engine::kLeapfrog}, {"semi-implicit", Engine::kSemiImplicit},
      {"euler", Engine::kEuler},       {"bullet", Engine::kBullet}};
  return kNames;
}

struct SimulateOptions {
  SceneOption scene{};
  std::string posture = "file";  ///< see parsePosture()
  std::string velocity = "0";    ///< see parseVelocities()
  Engine engine = Engine::kRungeKutta4;
  double seconds = 5;
  double tau = 1e-3;              ///< seconds per step
  bool hold = false;              ///< the posture of the start
  Hold holdBy = Hold::kNone;      ///< none: the best there is, if joints hold
  fs::path torques{};             ///< see readTorques()
  bool refuseOverlap = false;     ///< at the start
  bool friction = false;          ///< of the joints, as in the scene
  double noise = 0;               ///< see StepperOptions
  std::optional<double> floor{};  ///< its height, metres; empty: none added to the scene
  std::uint64_t seed = 0;
  double speed = 1;  ///< of the film; 1: real time
  bool noFilm = false;
  RenderOptions film{};               ///< cameras, size and gl of the film
  std::vector<std::string> traces{};  ///< bodies whose paths are drawn
  bool json = false;
  std::optional<int> logEvery{};  ///< steps; empty: chosen so that the log has at most kMostLogged numbers
  LogFormat logFormat = LogFormat::kCsv;
  fs::path out{};  ///< a folder, or a page
};

constexpr double kMostSteps = 2e5;
constexpr double kMostLogged = 1e7;  // numbers, 200 megabytes of text

const std::string& toString(Engine engine) {
  return std::ranges::find(engineNames(), engine, &std::pair<std::string, Engine>::second)->first;
}

// Empty for Bullet, which has its own integrator.
std::optional<Integrator> integratorOf(Engine engine) {
  switch (engine) {
    case Engine::kRungeKutta4:
      return Integrator::kRungeKutta4;
    case Engine::kBeeman:
      return Integrator::kBeeman;
    case Engine::kLeapfrog:
      return Integrator::kLeapfrog;
    case Engine::kSemiImplicit:
      return Integrator::kSemiImplicitEuler;
    case Engine::kEuler:
      return Integrator::kEuler;
    case Engine::kBullet:
      break;
  }
  return {};
}

bool isPage(const SimulateOptions& options) { return options.out.extension() == ".html"; }

// For free bases on floors computed torque is not enough, as it ignores the forces on their feet.
Hold holdOf(const Model& model, const SimulateOptions& options, bool isBullet) {
  if (options.holdBy == Hold::kNone) {
    if (!options.hold) return Hold::kNone;
    return isBullet && hasFloatingBase(model) ? Hold::kMotor : Hold::kExact;
  }
  if (options.holdBy == Hold::kMotor && !isBullet)
    throw UsageError({.what = "--hold-by motor",
                      .found = "--engine " + toString(options.engine),
                      .wanted = "--engine bullet, which has motors"});
  return options.holdBy;
}

void requireContacts(const char* option, const SimulateOptions& options) {
  if (integratorOf(options.engine))
    throw UsageError({.what = option,
                      .found = "--engine " + toString(options.engine),
                      .wanted = "--engine bullet, which handles contacts"});
}

SimulationPlan planOf(const Model& model, const SimulateOptions& options) {
  SimulationPlan plan{.tau = options.tau, .seed = options.seed};
  if (const auto integrator = integratorOf(options.engine))
    plan.stepper = {
        .integrator = *integrator, .jointForces = {.friction = options.friction}, .noise = options.noise};
  else
    plan.physics = {.jointFriction = options.friction};
  if (plan.physics && options.noise != 0)
    throw UsageError({.what = "--noise", .found = "--engine bullet", .wanted = "another engine"});
  if (options.refuseOverlap) requireContacts("--refuse-overlap", options);
  requireBetween("--seconds / --tau, steps", options.seconds / options.tau, 1, kMostSteps);
  plan.steps = static_cast<int>(std::lround(options.seconds / options.tau));
  for (const std::string& body : options.traces) asWrongUse([&] { return model.body(body); }, "--trace: ");
  if (model.nv() == 0) throw UsageError({.what = model.name(), .found = "no joint that moves"});
  plan.hold = holdOf(model, options, plan.physics.has_value());
  if (!options.torques.empty()) {
    if (plan.hold == Hold::kMotor)
      throw UsageError({.what = "--torques",
                        .found = "joints that are held by motors",
                        .wanted = "no --hold, or --hold-by exact, gravity or pd, which torques add to"});
    plan.torques = readTorques(model, options.torques);
  }
  plan.start = {parsePosture(model, options.posture), parseVelocities(model, options.velocity)};
  return plan;
}

int logStride(const Model& model, const SimulationPlan& plan, const SimulateOptions& options) {
  if (options.logEvery) return *options.logEvery;
  const double numbers = (4.0 + model.nq() + model.nv()) * plan.steps;
  const int stride = 1 + static_cast<int>(numbers / kMostLogged);
  if (stride > 1 && !isPage(options))
    note(fmt::format("the log keeps one step in {}, to stay below 200 MB; --log-every overrides this",
                     stride));
  return stride;
}

// Records a motion while it is simulated.
class Record {
 public:
  Record(const SimulationPlan& plan, const SimulateOptions& options, double filmRate, int logStride)
      : film_(plan.tau, plan.steps, filmRate),
        keepsFilm_(!options.noFilm),
        logStride_(logStride),
        plotStride_(1 + plan.steps / 4000) {}

  void add(const Moment& moment, MotionLog* log) {
    if (step_ == 0) first_ = moment;
    change_ = std::max(change_, std::abs(moment.energy.total() - first_.energy.total()));
    if (log != nullptr && step_ % logStride_ == 0) log->add(moment);
    if (step_ % plotStride_ == 0) plot(moment);
    if (keepsFilm_) film_.add(moment.state.q);
    last_ = moment;
    ++step_;
  }

  [[nodiscard]] const Moment& first() const { return first_; }
  [[nodiscard]] const Moment& last() const { return last_; }
  /// The largest difference of the total energy from its initial value.
  [[nodiscard]] double largestChange() const { return change_; }
  [[nodiscard]] const Motion& motion() const { return film_.motion(); }
  [[nodiscard]] int steps() const { return step_ - 1; }

  [[nodiscard]] Figure energyFigure(const std::string& title) const {
    return {.title = title,
            .xLabel = "time [s]",
            .yLabel = "energy [J], potential 0 at the start",
            .legend = Legend::kOutside,
            .series = {kinetic_, potential_, total_}};
  }

 private:
  // Potential energy relative to the start, because its zero is arbitrary. Of very many moments only some
  // thousand, as a picture has no more columns.
  void plot(const Moment& moment) {
    const double zero = first_.energy.potential;
    for (Series* series : {&kinetic_, &potential_, &total_}) series->x.push_back(moment.state.time);
    kinetic_.y.push_back(moment.energy.kinetic);
    potential_.y.push_back(moment.energy.potential - zero);
    total_.y.push_back(moment.energy.total() - zero);
  }

  FilmPostures film_;
  bool keepsFilm_;
  int logStride_, plotStride_;
  int step_ = 0;
  Moment first_, last_;
  double change_ = 0;
  Series kinetic_{.label = "kinetic"}, potential_{.label = "potential"},
      total_{.label = "total", .size = 1.5};
};

std::string titleOf(const Model& model, const SimulationPlan& plan, const SimulateOptions& options) {
  return fmt::format("{}, {}{}, {}, steps of {:g} ms", model.name(), toString(plan.hold),
                     plan.torques ? " with torques" : "", toString(options.engine), 1000 * options.tau);
}

// The replay plays as fast as the film would.
void writeMotionPage(const Model& model, const Record& record, const std::string& title,
                     const SimulateOptions& options, const RenderPlan& plan, double speed) {
  writeReplay({.title = title,
               .figures = {{.figure = record.energyFigure(title)}},
               .facts = {{"engine", toString(options.engine)},
                         {"step", fmt::format("{:g} s", options.tau)},
                         {"largest energy change", fmt::format("{:.2g} J", record.largestChange())}},
               .still = plan.renderer},
              {model, record.motion(), {}, options.traces, ""}, plan, speed, options.out);
}

// What rounds to zero has no sign.
double rounded(double x) { return std::abs(x) < 5e-6 ? 0 : x; }

// The first and the last value of each coordinate.
void addPostures(Results& all, const Model& model, const Eigen::VectorXd& first,
                 const Eigen::VectorXd& last) {
  std::size_t width = 0;
  for (const Joint& joint : model.joints()) width = std::max(width, escapeForTerminal(joint.name).size());
  for (const Joint& joint : model.joints()) {
    if (joint.mimics) continue;
    for (int i = joint.qIndex; i < joint.qIndex + joint.nq; ++i)
      all.line("q{:<3} {:{}}  {:9.5f} -> {:9.5f}", i, escapeForTerminal(joint.name), width, rounded(first[i]),
               rounded(last[i]));
  }
}

Results resultsOf(const Model& model, const SimulationPlan& plan, const Record& record,
                  const std::vector<BodyOverlap>& overlaps, const SimulateOptions& options,
                  const std::optional<EnergyGain>& gain) {
  const Moment &first = record.first(), &last = record.last();
  const double start = first.energy.total(), end = last.energy.total(), change = record.largestChange();
  Results all{.json = {{"scene", model.name()},
                       {"engine", toString(options.engine)},
                       {"held", plan.hold != Hold::kNone},
                       {"tau", options.tau},
                       {"steps", record.steps()},
                       {"stopped", nullptr},
                       {"overlaps", Json::array()},
                       {"energy", {{"start", start}, {"end", end}, {"largest_change", change}}},
                       {"q", toJson(last.state.q)},
                       {"v", toJson(last.state.v)}}};
  if (gain) all.json["stopped"] = {{"time", gain->time}, {"gained", gain->gained}, {"given", gain->given}};
  for (const BodyOverlap& one : overlaps)
    all.json["overlaps"].push_back({{"a", one.a}, {"b", one.b}, {"depth", one.depth}});
  all.line("{}: {} steps, {:g} s", titleOf(model, plan, options), record.steps(), last.state.time);
  all.line("energy: {:.6g} J at the start, {:.6g} J at the end, largest change {:.2g} J", start, end, change);
  addPostures(all, model, first.state.q, last.state.q);
  return all;
}

std::string stopped(const EnergyGain& gain) {
  return fmt::format(
      "stopped at {:.6g} s: the energy has grown by {:.3g} J, but the start, gravity, torques and motors "
      "gave {:.3g} J at "
      "most; shorter steps (--tau) may help, or another --engine or --hold-by",
      gain.time, gain.gained, gain.given);
}

Model modelOf(const Project& project, const SimulateOptions& options) {
  SceneSpec spec = loadSpec(project, options.scene);
  if (options.floor) {
    requireContacts("--floor", options);
    spec.worldShapes.push_back(floorAt(*options.floor));
  }
  return asWrongUse([&] { return compile(spec); });
}

// Notes which loops are open at the start.
void noteGaps(const Model& model, const SimulationPlan& plan) {
  constexpr double kVisible = 1e-3;
  if (!plan.physics) return;
  const Eigen::VectorXd gaps = loopClosureErrors(model, plan.start.q);
  std::string text;
  for (Eigen::Index i = 0; i < gaps.size(); ++i) {
    const Pin& pin = model.pins()[static_cast<std::size_t>(i)];
    if (gaps[i] > kVisible)
      text +=
          fmt::format("{}'{}' and '{}' by {:.3g} m", text.empty() ? "" : ", ",
                      escapeForTerminal(model[pin.a].name), escapeForTerminal(model[pin.b].name), gaps[i]);
  }
  if (!text.empty())
    note(wrap("pins are open at the start, pulled together at 1 m/s at most: " + text, 2, 0));
}

// Notes which bodies overlap at the start, or refuses it.
std::vector<BodyOverlap> overlapsOf(const Model& model, const SimulationPlan& plan,
                                    const SimulateOptions& options) {
  if (!plan.physics) return {};
  const std::vector<BodyOverlap> overlaps =
      asWrongUse([&] { return startOverlaps(model, *plan.physics, plan.start); });
  if (overlaps.empty()) return {};
  if (options.refuseOverlap)
    throw UsageError({.what = "--refuse-overlap",
                      .found = "overlaps at the start, " + toString(overlaps),
                      .wanted = "a start where nothing overlaps"});
  note(wrap("overlaps at the start, pushed apart at 1 m/s at most, " + toString(overlaps), 2, 0));
  return overlaps;
}

void noteUnheld(const Model& model, const SimulationPlan& plan) {
  if (plan.hold != Hold::kMotor) return;
  for (const std::string& joint :
       Holder(model, plan.hold, plan.start.q, plan.stepper.gravity_W, plan.tau).unheld())
    note(fmt::format("joint '{}' is not held: motors cannot drive joints with quaternions",
                     escapeForTerminal(joint)));
}

// Lets a scene move under gravity. Writes a log, an energy plot and a film, or a page.
ExitCode simulateScene(const Project& project, const SimulateOptions& options) {
  const Facing facing = sceneFacing(sceneFilePath(project, options.scene));
  requireGiven("--out", options.out.string(), "simulate");
  if (!isPage(options))
    requireFolderName(options.out, "a folder, which gets simulate.mp4, or a page NAME.html");
  RenderOptions filmOptions = options.film;
  filmOptions.out = isPage(options) ? options.out : options.out / "simulate.mp4";
  const RenderPlan film = makeRenderPlan(filmOptions, facing);
  const Model model = modelOf(project, options);
  if (isPage(options) && options.noFilm)
    throw UsageError(
        {.what = "--no-film", .found = "a page, which is a film itself", .wanted = "a folder after -o"});
  if (isPage(options) && (options.logEvery || options.logFormat != LogFormat::kCsv))
    throw UsageError({.what = options.logEvery ? "--log-every" : "--log-format",
                      .found = "a page, which has no log",
                      .wanted = "a folder after -o"});
  if (!options.noFilm) requireFilmable(model);
  const SimulationPlan plan = planOf(model, options);
  if (plan.physics) noteCollisionWarnings(model);
  noteGaps(model, plan);
  const std::vector<BodyOverlap> overlaps = overlapsOf(model, plan, options);
  noteUnheld(model, plan);
  const double speed = options.noFilm ? 1 : filmSpeed(options.speed, plan.steps * options.tau);
  const int stride = logStride(model, plan, options);

  const std::string title = titleOf(model, plan, options);
  Record record(plan, options, kVideoRate / speed, stride);
  std::optional<MotionLog> log;
  const fs::path logFile = options.out / (options.logFormat == LogFormat::kCsv ? "log.csv" : "log.npy");
  if (!isPage(options)) log.emplace(logFile, options.logFormat, model);
  const std::optional<EnergyGain> gain = asWrongUse([&] {
    return simulate(model, plan, [&](const Moment& moment) { record.add(moment, log ? &*log : nullptr); });
  });

  Results results = resultsOf(model, plan, record, overlaps, options, gain);
  if (isPage(options)) {
    writeMotionPage(model, record, title, options, film, speed);
    results.file(options.out);
  } else {
    log->finish();
    results.file(logFile);
    const Figure figure = record.energyFigure(title);
    for (const char* name : {"energy.png", "energy.svg"})
      writeFigure(figure, results.file(options.out / name));
    if (!options.noFilm)
      results.file(writeMotionFilm({model, record.motion(), {}, options.traces, title}, film,
                                   options.out / "simulate.mp4"));
  }
  results.print(options.json);
  if (!gain) return ExitCode::kFull;
  note(wrap(stopped(*gain), 2, 0));
  return ExitCode::kBelow;
}

}  // namespace

void addSimulate(CLI::App* command, Action& action) {
  const auto options = std::make_shared<SimulateOptions>();
  command->footer(
      "Examples:\n  scripts/rex simulate pegArm -o fall\n"
      "  scripts/rex simulate arm3 --q 0.5,-0.5,0.3 --v 0,2,0 --hold --seconds 2 -o hold\n"
      "  scripts/rex simulate pegArm --engine euler --tau 0.01 -o euler\n"
      "  scripts/rex simulate quadruped --free-base --engine bullet --floor -0.9 --hold -o drop\n\n"
      "Joints move freely; only bullet handles contacts and joint limits. DIR gets log.csv\n"
      "(time, q, v and energies), energy.png, energy.svg and simulate.mp4. A name that ends\n"
      "in .html becomes a replay for browsers instead, with the energies beside it.\n\n"
      "--hold drives joints, never a free base: by computed torque, or by motors if bullet\n"
      "moves a free base. --hold-by exact is computed torque, gravity is springs plus gravity\n"
      "compensation, pd is springs alone, motor (bullet) is motors with the effort limits of\n"
      "the file.\n\n"
      "--torques reads a line 'time,joint,joint' with names, then a line of numbers per time.\n"
      "Each applies until the next. They add to the torques of --hold.\n\n"
      "log.npy is a matrix for numpy.load with the columns of log.csv.");
  addSceneFile(command, "SCENE", options->scene.file);
  addOptions(command, {{"-o,--out", options->out, "DIR", "folder for the results, or a page NAME.html"},
                       {"--engine", options->engine, engineNames(), "how to integrate, bullet also contacts"},
                       {"--seconds", options->seconds, {1e-6, 120}, "S", "duration"},
                       {"--tau", options->tau, {1e-6, 1}, "S", "seconds per step"}});
  addPosture(command, options->posture);
  addOptions(
      command,
      {{"--v", options->velocity, "VELOCITY", "all velocities, or joint=number,..."},
       {"--hold", options->hold, "make the joints hold the initial posture"},
       {"--hold-by",
        options->holdBy,
        {{"exact", Hold::kExact}, {"gravity", Hold::kGravity}, {"pd", Hold::kPd}, {"motor", Hold::kMotor}},
        "how to hold, implies --hold"},
       {"--torques", options->torques, "FILE", "a table of joint torques over time"},
       {"--friction", options->friction, "use the friction and damping of the scene's joints"},
       {"--noise", options->noise, {0, 1e6}, "X", "each step adds sqrt(tau) * X * N(0, 1) to velocities"},
       seedRow(options->seed, "seed of the noise"),
       {"--floor", options->floor, {-1e3, 1e3}, "Z", "add a floor at this height, metres (bullet)"},
       {"--refuse-overlap", options->refuseOverlap,
        "refuse overlaps at the start instead of pushing apart (bullet)"},
       {"--log-every",
        options->logEvery,
        {1, kMostSteps},
        "N",
        "log every Nth step (default: 1, or more to stay below 200 MB)"},
       {"--log-format",
        options->logFormat,
        {{"csv", LogFormat::kCsv}, {"npy", LogFormat::kNpy}},
        "of the log"},
       {"--no-film", options->noFilm, "do not make simulate.mp4"},
       {"--trace", options->traces, "BODY", "draw the path of this body as a line"}});
  addFilmSpeed(command, options->speed);
  addFilmOptions(command, options->film);
  addJson(command, options->json);
  addReading(command, options->scene.reading);
  addGl(command, options->film.gl);
  command->callback(
      [&action, options] { action = [options](const Project& p) { return simulateScene(p, *options); }; });
}

}  // namespace rex::cli
