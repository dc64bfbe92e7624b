// `rex map`: SLAM with grid maps by particles, in a simulated building.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
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
#include "estimation/grid_slam.h"
#include "estimation/map_agreement.h"
#include "geometry/rotation.h"

namespace rex::cli {
namespace {

struct MapOptions {
  RobotWalkOptions walk{.rays = 120};
  int particles = 15;
  double cell = 0.1;  // metres
  bool noScanMatching = false;
};

// A run with one seed. Errors are root mean squares along the way, of positions (m) and of headings (rad).
struct MapRun {
  std::uint64_t seed = 0;
  MapAgreement agreement{};
  Eigen::Vector2d error{}, reckonedError{};
  int resamplings = 0;
  Eigen::Matrix3Xd truth{}, path{}, reckoned{};
  // Of the first run only.
  std::vector<CarView> frames{};
  CarView end{};
};

CarView mapView(const GridSlam& slam, const ScanWalk& walk, const RangeScanner& scanner, int step) {
  constexpr Color kLightTruth{0.45f, 0.48f, 0.54f};
  const int best = slam.likeliest();
  const Eigen::Matrix3Xd path = slam.path(best);
  const Eigen::Vector3d now = path.rightCols<1>();
  return {.car = walk.truth.col(step),
          .estimate = now,
          .carScale = 0.25,
          .map = slam.map(best),
          .particles = slam.poses(),
          .weights = slam.weights(),
          .ways = {{.name = "true way",
                    .points = walk.truth.topLeftCorner(2, step + 1),
                    .color = kLightTruth,
                    .width = 5},
                   {.name = "estimate", .points = path.topRows<2>(), .color = kEstimateColor, .width = 2}},
          .scan = scanFrom(scanner, now, walk.ranges.col(step)),
          .caption = fmt::format("grid SLAM, step {}", step)};
}

// The poses that follow from odometry alone.
Eigen::Matrix3Xd deadReckoning(const ScanWalk& walk) {
  Eigen::Matrix3Xd poses = walk.truth;
  for (Eigen::Index k = 1; k < poses.cols(); ++k)
    poses.col(k) = movedPose(poses.col(k - 1), walk.odometry.col(k));
  return poses;
}

Eigen::Vector2d pathError(const Eigen::Matrix3Xd& path, const Eigen::Matrix3Xd& truth) {
  const Eigen::Matrix3Xd errors = path - truth;
  const Eigen::ArrayXd headings = errors.row(2).unaryExpr([](double angle) { return wrapAngle(angle); });
  const double steps = static_cast<double>(errors.cols());
  return {errors.topRows<2>().norm() / std::sqrt(steps), headings.matrix().norm() / std::sqrt(steps)};
}

MapRun mapped(const MapOptions& options, std::uint64_t seed, bool isWatched) {
  Rng rng(seed);
  const Building office = officeBuilding();
  const RangeScanner scanner = scannerOf(options.walk);
  const Eigen::Vector3d deviations = deviationsOf(options.walk);
  const ScanWalk walk = measured(office, officePoses(options.walk), scanner,
                                 {.odometry = deviations, .range = options.walk.rangeNoise}, rng);
  OccupancyMap truth = emptyOffice(options.cell);
  GridSlam slam(walk.truth.col(0), truth, scanner, walk.ranges.col(0),
                {.particles = options.particles,
                 .matchScans = !options.noScanMatching,
                 .deviation = std::max(GridSlamOptions{}.deviation, options.walk.rangeNoise)});
  MapRun run{.seed = seed, .truth = walk.truth, .reckoned = deadReckoning(walk)};
  for (int k = 0; k < static_cast<int>(walk.truth.cols()); ++k) {
    throwIfInterrupted();
    if (k > 0)
      run.resamplings +=
          slam.step(odometryTransition(walk.odometry.col(k), deviations), walk.ranges.col(k), rng).resampled;
    if (isWatched && isFilmed(k)) run.frames.push_back(mapView(slam, walk, scanner, k));
  }
  if (isWatched) run.end = mapView(slam, walk, scanner, static_cast<int>(walk.truth.cols()) - 1);
  rasterize(office, truth);
  run.agreement = compareMaps(slam.map(slam.likeliest()), truth);
  run.path = slam.path(slam.likeliest());
  run.error = pathError(run.path, run.truth);
  run.reckonedError = pathError(run.reckoned, run.truth);
  return run;
}

std::string pathTable(const MapRun& run) {
  fmt::memory_buffer table;
  const auto out = std::back_inserter(table);
  fmt::format_to(
      out,
      "step,x,y,heading,x_estimate,y_estimate,heading_estimate,x_reckoned,y_reckoned,heading_reckoned\n");
  for (Eigen::Index k = 0; k < run.truth.cols(); ++k) {
    fmt::format_to(out, "{}", k);
    for (const Eigen::Matrix3Xd* poses : {&run.truth, &run.path, &run.reckoned})
      for (const double number : poses->col(k)) fmt::format_to(out, ",{}", number);
    fmt::format_to(out, "\n");
  }
  return fmt::to_string(table);
}

// The map at the end.
Figure endFigure(const MapOptions& options, const MapRun& run) {
  CarView end = run.end;
  end.particles.resize(3, 0);
  end.weights.resize(0);
  end.scan.resize(2, 0);
  end.ways.insert(end.ways.begin(), {"dead reckoning", run.reckoned.topRows<2>(), kDeadReckoningColor, true});
  end.caption = fmt::format("grid SLAM, {} {}{}, overlap {:.3f}", options.particles,
                            options.particles == 1 ? "particle" : "particles",
                            options.noScanMatching ? " without scan matching" : "", run.agreement.overlap);
  return figureOf(end);
}

std::vector<std::string> writeMapFiles(const MapOptions& options, const MapRun& run) {
  const std::filesystem::path& out = options.walk.out;
  std::vector<std::string> files{shown(out / "map.csv"), shown(out / "map.png")};
  writeTextFile(out / "map.csv", pathTable(run));
  plot((out / "map").string(), endFigure(options, run));
  writeWalkFilm(options.walk, run.frames, "map", files);
  return files;
}

Json mapJson(const MapRun& run) {
  return {{"seed", run.seed},
          {"overlap", run.agreement.overlap},
          {"precision", run.agreement.precision},
          {"recall", run.agreement.recall},
          {"position", run.error[0]},
          {"heading", run.error[1]},
          {"dead_reckoning", run.reckonedError[0]},
          {"resamplings", run.resamplings}};
}

void sayRun(const MapRun& run) {
  say(fmt::format("{:<6} {:>8.3f} {:>10.3f} {:>8.3f} {:>10.3f} {:>10.4f} {:>12.3f} {:>10}", run.seed,
                  run.agreement.overlap, run.agreement.precision, run.agreement.recall, run.error[0],
                  run.error[1], run.reckonedError[0], run.resamplings));
}

// Lets a robot map a building. Prints how its maps agree with the truth.
ExitCode map(const MapOptions& options) {
  requireRobotWalk(options.walk);
  requireBetween("--particles", options.particles, 1, 300);
  requireBetween("--cell", options.cell, 0.05, 0.5);
  const bool writes = !options.walk.out.empty();
  if (writes) makeFilmFolder(options.walk.out, "map");
  if (!options.walk.json)
    say(fmt::format("{:<6} {:>8} {:>10} {:>8} {:>10} {:>10} {:>12} {:>10}", "seed", "overlap", "precision",
                    "recall", "error [m]", "[rad]", "odometry [m]", "resampled"));
  Json runs = Json::array();
  std::vector<std::string> files;
  for (int i = 0; i < options.walk.seeds; ++i) {
    const MapRun run = mapped(options, options.walk.seed + static_cast<std::uint64_t>(i), writes && i == 0);
    runs.push_back(mapJson(run));
    if (!options.walk.json) sayRun(run);
    if (writes && i == 0) files = writeMapFiles(options, run);
  }
  if (options.walk.json)
    say(dump(Json{{"particles", options.particles}, {"runs", std::move(runs)}, {"files", files}}));
  else
    for (const std::string& file : files) say(file);
  return ExitCode::kFull;
}

}  // namespace

void addMap(CLI::App* command, Action& action) {
  const auto options = std::make_shared<MapOptions>();
  command->footer(
      "Examples:\n  scripts/rex map -o office\n"
      "  scripts/rex map --no-scan-matching --seeds 5\n"
      "  scripts/rex map --particles 5 --odometry-noise 0.05 --seeds 5 --json\n\n"
      "A robot walks through a simulated office and back, and maps it by its odometry and a range scanner:\n"
      "SLAM with a grid map in each particle. Poses are drawn around matches of scans with these maps. It\n"
      "starts at a known pose, so that its map and the building have the same frame.\n"
      "Overlap: the harmonic mean of precision (fraction of the occupied cells that are within a cell of a\n"
      "wall) and recall (fraction of the seen wall cells that are within a cell of an occupied one). Errors\n"
      "are root mean squares along the path of the likeliest particle, and of odometry alone.\n"
      "DIR gets map.csv (all poses), the map as map.png, and the film map.mp4 of the first run.");
  command->add_option("--particles", options->particles, "number of particles (default: 15)")->type_name("N");
  command->add_option("--cell", options->cell, "size of the cells of the map (default: 0.1)")
      ->type_name("METRES");
  command->add_flag("--no-scan-matching", options->noScanMatching, "draw poses from the odometry alone");
  addRobotWalk(command, options->walk);
  command->callback([&action, options] { action = [options](const Project&) { return map(*options); }; });
}

}  // namespace rex::cli
