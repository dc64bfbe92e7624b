// `rex localize`: Monte Carlo localisation in the map of a simulated building.
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
#include "cli/methods/robot_walk_internal.h"
#include "cli/option_value_internal.h"
#include "cli/project.h"
#include "cli/terminal.h"
#include "course/car_figure.h"
#include "course/plot.h"
#include "estimation/scan_lookup.h"
#include "estimation/scan_weights.h"
#include "geometry/rotation.h"

namespace rex::cli {
namespace {

constexpr double kNear = 0.5;     // metres: closer than this, the robot knows where it is
constexpr double kMapCell = 0.1;  // metres

struct LocalizeOptions {
  RobotWalkOptions walk{.rays = 12, .maxRange = 5};  // little at once, so that rooms look alike
  std::string start = "anywhere";
  int particles = 500;
  double share = 0.1;
  bool kidnap = false;
};

// A walk, and from which step on it goes on elsewhere.
struct LocalizeWalk {
  ScanWalk measured{};
  std::optional<int> kidnapped{};
};

// A run with one seed. Steps are numbers of motions since the start.
struct LocalizeRun {
  std::uint64_t seed = 0;
  std::optional<int> found{}, kidnapped{}, foundAgain{};
  Eigen::Matrix2Xd errors{};      // of the mean of the particles, at each step: metres, radians
  std::vector<CarView> frames{};  // of the first run only

  std::optional<int> lastFound() const { return kidnapped ? foundAgain : found; }
  // Root mean squares since the robot was found for the last time.
  std::optional<Eigen::Vector2d> error() const {
    if (!lastFound()) return {};
    const auto since = errors.rightCols(errors.cols() - *lastFound());
    return since.rowwise().squaredNorm().cwiseSqrt() / std::sqrt(static_cast<double>(since.cols()));
  }
};

// The map of the building. What cannot be reached from a pose is unknown: outside, and inside of furniture.
OccupancyMap reachableMap(const Eigen::Vector3d& pose) {
  OccupancyMap truth = emptyOffice(kMapCell), map = truth;
  rasterize(officeBuilding(), truth);
  std::vector<Eigen::Vector2i> open{truth.cellAt(pose.head<2>())};
  while (!open.empty()) {
    const Eigen::Vector2i at = open.back();
    open.pop_back();
    if (!map.contains(at.x(), at.y()) || map.logOdds(at.x(), at.y()) != 0) continue;
    map.setLogOdds(at.x(), at.y(), truth.logOdds(at.x(), at.y()));
    if (truth.isOccupied(at.x(), at.y())) continue;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const Eigen::Vector2i next = at + Eigen::Vector2i(dx, dy);
        // Not past the corners of cells, which oblique walls consist of.
        if (dx == 0 || dy == 0 || truth.isOccupied(next.x(), next.y())) open.push_back(next);
      }
  }
  return map;
}

LocalizeWalk localizeWalk(const LocalizeOptions& options, const RangeScanner& scanner, Rng& rng) {
  const Eigen::Matrix3Xd poses = officePoses(options.walk);
  const WalkNoise noise{.odometry = deviationsOf(options.walk), .range = options.walk.rangeNoise};
  const auto measure = [&](const Eigen::Matrix3Xd& some) {
    return measured(officeBuilding(), some, scanner, noise, rng);
  };
  if (!options.kidnap) return {measure(poses), {}};
  // The second half of the walk comes first. Nobody measures the motion between both.
  const Eigen::Index half = poses.cols() / 2;
  const ScanWalk first = measure(poses.rightCols(poses.cols() - half)),
                 second = measure(poses.leftCols(half));
  const auto joined = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    Eigen::MatrixXd both(a.rows(), a.cols() + b.cols());
    both << a, b;
    return both;
  };
  return {{.truth = joined(first.truth, second.truth),
           .odometry = joined(first.odometry, second.odometry),
           .ranges = joined(first.ranges, second.ranges)},
          static_cast<int>(first.truth.cols())};
}

Eigen::Vector3d meanPose(const Particles& particles) {
  Eigen::Vector3d mean = particles.states * particles.weights;
  mean[2] = std::atan2(particles.states.row(2).array().sin().matrix().dot(particles.weights),
                       particles.states.row(2).array().cos().matrix().dot(particles.weights));
  return mean;
}

class Localization {
 public:
  Localization(const OccupancyMap& map, const RangeScanner& scanner, const LocalizeOptions& options,
               const Eigen::Vector3d& known, Rng& rng)
      : map_(map),
        scanner_(scanner),
        options_(options),
        lookup_(map, scanner),
        filter_(start(known, rng), {.resampling = Resampling::kSystematic}) {}

  const Particles& particles() const { return filter_.particles(); }

  void step(const Eigen::Vector3d& motion, const Eigen::VectorXd& ranges, Rng& rng) {
    // Wider than the noise of the odometry and of the scanner: particles are few for so large a building.
    const Eigen::Vector3d deviations = deviationsOf(options_.walk).array() + 0.02;
    const NonlinearModel moved{
        .g = [motion](const Eigen::VectorXd& x) -> Eigen::VectorXd { return movedPose(x, motion); },
        .W = deviations.cwiseAbs2().asDiagonal()};
    const MixtureProposalOptions mixture{
        .share = options_.share, .kidnapping = 0.01, .anywhere = lookup_.anywhere(), .angles = {2}};
    const BeamModel beams{.deviation = std::hypot(0.15, options_.walk.rangeNoise), .temper = 3};
    (void)filter_.step(mixtureProposal(moved, filter_.particles(), lookup_.given(ranges), mixture),
                       scanWeights(map_, scanner_, ranges, beams), rng);
  }

 private:
  Particles start(const Eigen::Vector3d& known, Rng& rng) const {
    const StateDensity anywhere = lookup_.anywhere();
    Particles particles{known.replicate(1, options_.particles),
                        Eigen::VectorXd::Constant(options_.particles, 1. / options_.particles)};
    if (options_.start == "anywhere")
      for (auto pose : particles.states.colwise()) pose = anywhere.draw(rng);
    return particles;
  }

  const OccupancyMap& map_;
  const RangeScanner& scanner_;
  const LocalizeOptions& options_;
  ScanLookup lookup_;
  ParticleFilter filter_;
};

// The first step of begin, ..., end - 1 from which on all errors are small.
std::optional<int> foundIn(const Eigen::Matrix2Xd& errors, int begin, int end) {
  int step = end;
  while (step > begin && errors(0, step - 1) < kNear) --step;
  return step < end ? std::optional(step) : std::nullopt;
}

LocalizeRun localized(const LocalizeOptions& options, std::uint64_t seed, bool isWatched) {
  Rng rng(seed);
  const RangeScanner scanner = scannerOf(options.walk);
  const auto [walk, kidnapped] = localizeWalk(options, scanner, rng);
  const OccupancyMap map = reachableMap(walk.truth.col(0));
  const int poses = static_cast<int>(walk.truth.cols());
  Localization localization(map, scanner, options, walk.truth.col(0), rng);
  LocalizeRun run{.seed = seed, .kidnapped = kidnapped, .errors = Eigen::Matrix2Xd(2, poses)};
  for (int k = 0; k < poses; ++k) {
    throwIfInterrupted();
    localization.step(walk.odometry.col(k), walk.ranges.col(k), rng);
    const Eigen::Vector3d mean = meanPose(localization.particles()), truth = walk.truth.col(k);
    run.errors.col(k) << (mean - truth).head<2>().norm(), std::abs(wrapAngle(mean[2] - truth[2]));
    if (!isWatched || !isFilmed(k)) continue;
    run.frames.push_back({.car = truth,
                          .carScale = 0.25,
                          .map = map,
                          .particles = localization.particles().states,
                          .weights = localization.particles().weights,
                          .scan = scanFrom(scanner, truth, walk.ranges.col(k)),
                          .caption = fmt::format("localization, step {}{}", k,
                                                 k >= kidnapped.value_or(poses) ? ", kidnapped" : "")});
  }
  run.found = foundIn(run.errors, 0, kidnapped.value_or(poses));
  if (kidnapped) run.foundAgain = foundIn(run.errors, *kidnapped, poses);
  return run;
}

Figure errorFigure(const LocalizeOptions& options, const LocalizeRun& run) {
  Figure figure{.title = fmt::format("localization, {} particles", options.particles),
                .xLabel = "step [1]",
                .yLabel = "error of the position [m]",
                .logY = true,
                .legend = Legend::kOutside,
                .series = {{.label = "mean of the particles", .color = kEstimateColor}},
                .horizontalLines = {{.at = kNear, .label = "found"}}};
  if (run.kidnapped) figure.verticalLines = {{.at = double(*run.kidnapped), .label = "kidnapped"}};
  for (Eigen::Index k = 0; k < run.errors.cols(); ++k) {
    figure.series[0].x.push_back(static_cast<double>(k));
    figure.series[0].y.push_back(std::max(run.errors(0, k), 1e-4));
  }
  return figure;
}

std::vector<std::string> writeLocalizeFiles(const LocalizeOptions& options, const LocalizeRun& run) {
  const std::filesystem::path& out = options.walk.out;
  std::vector<std::string> files{shown(out / "localize.csv"), shown(out / "error.png"),
                                 shown(out / "localize.png")};
  std::string table = "step,error,heading_error\n";
  for (Eigen::Index k = 0; k < run.errors.cols(); ++k)
    table += fmt::format("{},{},{}\n", k, run.errors(0, k), run.errors(1, k));
  writeTextFile(out / "localize.csv", table);
  plot((out / "error").string(), errorFigure(options, run));
  plot((out / "localize").string(), figureOf(run.frames[1]));  // a belief with several peaks
  writeWalkFilm(options.walk, run.frames, "localize", files);
  return files;
}

Json stepJson(std::optional<int> step) { return step ? Json(*step) : Json(); }

Json localizeJson(const LocalizeRun& run) {
  const std::optional<Eigen::Vector2d> error = run.error();
  return {{"seed", run.seed},
          {"found", stepJson(run.found)},
          {"kidnapped", stepJson(run.kidnapped)},
          {"found_again", stepJson(run.foundAgain)},
          {"position", error ? Json((*error)[0]) : Json()},
          {"heading", error ? Json((*error)[1]) : Json()}};
}

void sayLocalizeRun(const LocalizeRun& run) {
  const auto textOf = [](const auto& value, int digits) {
    return value ? fmt::format("{:.{}f}", double(*value), digits) : "never";
  };
  const std::optional<Eigen::Vector2d> error = run.error();
  std::string line = fmt::format("{:<6} {:>7}", run.seed, textOf(run.found, 0));
  line += run.kidnapped ? fmt::format(" {:>10} {:>12}", *run.kidnapped, textOf(run.foundAgain, 0))
                        : fmt::format(" {:>10} {:>12}", "", "");
  if (error) line += fmt::format(" {:>10.3f} {:>10.4f}", (*error)[0], (*error)[1]);
  say(line);
}

// Lets a robot find itself. Prints after how many steps it did, and how well. kBelow if it does not.
ExitCode localize(const LocalizeOptions& options) {
  requireRobotWalk(options.walk);
  requireBetween("--particles", options.particles, 10, 5000);
  requireBetween("--share", options.share, 0, 0.9);
  (void)choose<bool>("--start", options.start, {{"anywhere", true}, {"known", false}});
  const bool writes = !options.walk.out.empty();
  if (writes) makeFilmFolder(options.walk.out, "localize");
  if (!options.walk.json)
    say(fmt::format("{:<6} {:>7} {:>10} {:>12} {:>10} {:>10}", "seed", "found", "kidnapped", "found again",
                    "error [m]", "[rad]"));
  Json runs = Json::array();
  std::vector<std::string> files;
  bool isFound = true;
  for (int i = 0; i < options.walk.seeds; ++i) {
    const LocalizeRun run =
        localized(options, options.walk.seed + static_cast<std::uint64_t>(i), writes && i == 0);
    isFound = isFound && run.lastFound();
    runs.push_back(localizeJson(run));
    if (!options.walk.json) sayLocalizeRun(run);
    if (writes && i == 0) files = writeLocalizeFiles(options, run);
  }
  if (options.walk.json)
    say(dump(Json{{"particles", options.particles}, {"runs", std::move(runs)}, {"files", files}}));
  else
    for (const std::string& file : files) say(file);
  return isFound ? ExitCode::kFull : ExitCode::kBelow;
}

}  // namespace

void addLocalize(CLI::App* command, Action& action) {
  const auto options = std::make_shared<LocalizeOptions>();
  command->footer(
      "Examples:\n  scripts/rex localize --kidnap -o office\n"
      "  scripts/rex localize --kidnap --share 0 --seeds 5\n"
      "  scripts/rex localize --start known --particles 50 --seeds 5 --json\n\n"
      "A robot in a simulated office knows the map, but not where it is. It finds itself by its odometry "
      "and\n"
      "a range scanner: Monte Carlo localisation. A share of the particles is drawn from the scan alone, so\n"
      "that the robot also notices that somebody carried it elsewhere (slide 7:25).\n"
      "Found: the step from which on the mean of the particles is within 0.5 m of the robot. Errors are\n"
      "root mean squares since then.\n"
      "DIR gets localize.csv, the error as error.png, the belief after three scans as localize.png, and the\n"
      "film localize.mp4, all of the first run.\n"
      "Exit code 1: in some run the robot was lost at the end.");
  command->add_option("--start", options->start, "anywhere or known (default: anywhere)")->type_name("NAME");
  command->add_option("--particles", options->particles, "number of particles (default: 500)")
      ->type_name("N");
  command->add_option("--share", options->share, "share of the particles drawn from the scan (default: 0.1)")
      ->type_name("X");
  command->add_flag("--kidnap", options->kidnap, "carry the robot elsewhere half way");
  addRobotWalk(command, options->walk);
  command->callback(
      [&action, options] { action = [options](const Project&) { return localize(*options); }; });
}

}  // namespace rex::cli
