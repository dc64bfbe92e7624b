#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "base/exit_code.h"
#include "cli/robot/path_search.h"
#include "cli/robot/render_plan.h"
#include "planning/hybrid_astar.h"

namespace rex::cli {

/// The options of `rex plan`.
struct PlanOptions {
  SceneOption scene{};
  std::string start{};  ///< see parsePosture(); empty: that of the file
  std::string goal{};   ///< a posture; to optimize, BODY:x,y,z
  Planner planner = Planner::kRrtConnect;
  std::optional<double> margin{};  ///< metres between all pairs of shapes; its default depends on the planner
  std::optional<double> resolution{};
  double speed = 1;      ///< of the film; 1: real time
  RenderOptions film{};  ///< cameras, size and gl of the pictures
  bool noFilm = false;
  bool json = false;
  std::filesystem::path out{};  ///< a folder

  // Of planners that draw samples.
  double step = PathSearch{}.step;
  std::optional<int> samples{};
  std::uint64_t seed = 0;
  int runs = 1;  ///< searches, each with the next seed
  bool noSmooth = false;
  double velocity = 1;  ///< limit for joints without one in the scene, rad/s or m/s
  double ramp = 0.5;    ///< seconds in which each joint accelerates from rest to its velocity limit
  bool effort = false;  ///< respect the scene's effort limits
  std::string body{};   ///< whose traces are drawn; empty: farthestBody()

  // Of hybrid A*.
  double wheelbase = 2.6, steering = 0.6;
  HybridAStarOptions grid{};

  // To optimize.
  bool avoid = false;  ///< keep shapes apart
  int steps = 100;
  double duration = 2;  ///< of the motion, seconds
};

/// Each searches in its way, and writes what it found. kBelow if nothing was found, or it is not proven that
/// nothing touches.
[[nodiscard]] ExitCode planCar(const PlanOptions& options, const RenderPlan& pictures, Model model);
[[nodiscard]] ExitCode planMotion(const PlanOptions& options, const RenderPlan& pictures, Model model);

}  // namespace rex::cli
