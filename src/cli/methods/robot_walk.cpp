#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "cli/methods/robot_walk_internal.h"
#include "cli/option_value_internal.h"
#include "cli/project.h"
#include "cli/shared_options_internal.h"
#include "course/car_pictures.h"
#include "estimation/scan_matching.h"

namespace rex::cli {

void addRobotWalk(CLI::App* command, RobotWalkOptions& options) {
  const auto number = [&](const char* name, auto& value, const std::string& help, const char* unit) {
    command->add_option(name, value, help)->type_name(unit);
  };
  number("--rays", options.rays, fmt::format("number of rays of the scanner (default: {})", options.rays),
         "N");
  number("--max-range", options.maxRange, fmt::format("how far it sees (default: {:g})", options.maxRange),
         "METRES");
  number("--range-noise", options.rangeNoise, "noise of ranges (default: 0.02)", "METRES");
  number("--odometry-noise", options.odometryNoise,
         "noise of each measured motion, in radians two thirds of it (default: 0.03)", "METRES");
  number("--steps", options.steps, "number of motions (default: the whole walk)", "N");
  addSeed(command, options.seed, "seed of all noise (default: 0)");
  number("--seeds", options.seeds, "number of runs, each with its own seed", "N");
  number("-o,--out", options.out, "folder for the results of the first run", "DIR");
  command->add_flag("--no-film", options.noFilm, "do not make a film");
  command->add_flag("--json", options.json, "print JSON");
}

void requireRobotWalk(const RobotWalkOptions& options) {
  requireBetween("--rays", options.rays, 3, 1000);
  requireBetween("--max-range", options.maxRange, 0.5, 100);
  requireBetween("--range-noise", options.rangeNoise, 0, 1);
  requireBetween("--odometry-noise", options.odometryNoise, 1e-3, 0.3);
  const auto most = static_cast<double>(officePoses({}).cols() - 1);
  if (options.steps != 0) requireBetween("--steps", options.steps, 2, most);
  requireBetween("--seeds", options.seeds, 1, 1000);
  if (options.noFilm && options.out.empty())
    throw UsageError({.what = "--no-film", .found = "no effect on its own", .wanted = "-o with it"});
}

RangeScanner scannerOf(const RobotWalkOptions& options) {
  RangeScanner scanner{.maxRange = options.maxRange};
  for (int i = 0; i < options.rays; ++i) scanner.angles.push_back(2 * std::numbers::pi * i / options.rays);
  return scanner;
}

Eigen::Vector3d deviationsOf(const RobotWalkOptions& options) {
  return options.odometryNoise * Eigen::Vector3d(1, 1, 2. / 3);
}

Eigen::Matrix3Xd officePoses(const RobotWalkOptions& options) {
  const Eigen::Matrix3Xd poses = posesAlong(officeWalk(), 0.5, 0.5);
  return options.steps == 0 ? poses : poses.leftCols(options.steps + 1);
}

OccupancyMap emptyOffice(double cellSize) {
  // Half a cell beyond a whole number of cells, so that the outer walls lie in the middle of cells.
  const double margin = cellSize * (std::floor(0.5 / cellSize) + 0.5);
  const auto cells = [&](double metres) {
    return static_cast<int>(std::ceil((metres + 2 * margin) / cellSize));
  };
  return {cells(24), cells(16), cellSize, {-margin, -margin}};
}

Eigen::Matrix2Xd scanFrom(const RangeScanner& scanner, const Eigen::Vector3d& pose,
                          const Eigen::VectorXd& ranges) {
  Eigen::Matrix2Xd points = scanPoints(scanner, ranges);
  for (auto point : points.colwise())
    point = movedPose(pose, Eigen::Vector3d(point.x(), point.y(), 0)).head<2>().eval();
  return points;
}

bool isFilmed(int step) { return step % 2 == 0; }

void writeWalkFilm(const RobotWalkOptions& options, const std::vector<CarView>& frames,
                   const std::string& name, std::vector<std::string>& files) {
  if (options.noFilm) return;
  const std::filesystem::path stem = options.out / name;
  writeFilm(frames, stem.string(), {.view = {0, -0.25, 1}, .step = 2});
  const std::filesystem::path film = stem.string() + ".mp4";
  files.push_back(shown(std::filesystem::exists(film) ? film : stem));
  files.push_back(shown(stem.string() + "_sheet.png"));
}

}  // namespace rex::cli
