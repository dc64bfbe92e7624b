#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "course/car_view.h"
#include "estimation/scan_walk.h"

namespace rex::cli {

/// The options that `rex map` and `rex localize` share: a robot with a range scanner that walks through
/// officeBuilding().
struct RobotWalkOptions {
  int rays = 60;
  double maxRange = 8;          ///< metres
  double rangeNoise = 0.02;     ///< metres
  double odometryNoise = 0.03;  ///< of each motion, metres; of its heading two thirds of it, radians
  int steps = 0;                ///< 0: the whole walk
  std::uint64_t seed = 0;
  int seeds = 1;
  bool noFilm = false, json = false;
  std::filesystem::path out{};
};

void addRobotWalk(CLI::App* command, RobotWalkOptions& options);
/// Throws UsageError for a number out of range, and for --no-film without -o.
void requireRobotWalk(const RobotWalkOptions& options);

/// Its rays go in all directions, evenly spaced.
[[nodiscard]] RangeScanner scannerOf(const RobotWalkOptions& options);
/// Of the odometry, as odometryTransition() takes them.
[[nodiscard]] Eigen::Vector3d deviationsOf(const RobotWalkOptions& options);
/// The true poses of the walk.
[[nodiscard]] Eigen::Matrix3Xd officePoses(const RobotWalkOptions& options);
/// A map of the size of the building in which nothing is known.
[[nodiscard]] OccupancyMap emptyOffice(double cellSize);

/// The end points of a scan's rays from a pose, in the world.
[[nodiscard]] Eigen::Matrix2Xd scanFrom(const RangeScanner& scanner, const Eigen::Vector3d& pose,
                                        const Eigen::VectorXd& ranges);
/// Whether the film shows step 0, 1, ...: every second one.
[[nodiscard]] bool isFilmed(int step);
/// Draws the frames from above as NAME.mp4 (without ffmpeg the folder NAME) and NAME_sheet.png in
/// options.out, unless there shall be no film. Adds the files to `files`, as a user would type them.
void writeWalkFilm(const RobotWalkOptions& options, const std::vector<CarView>& frames,
                   const std::string& name, std::vector<std::string>& files);

}  // namespace rex::cli
