#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "cli/robot/render_plan.h"

namespace rex::cli {

/// The options of `rex plan`.
struct PlanOptions {
  SceneOption scene{};
  std::string start{};  ///< see parsePosture(); empty: that of the file
  std::string goal{};
  std::string planner = "rrt-connect";
  double margin = 0.01;  ///< metres between all pairs of shapes
  double resolution = 0.02;
  std::optional<double> step{};  ///< of trees; see PathSearch
  std::optional<int> samples{};
  std::uint64_t seed = 0;
  int seeds = 1;  ///< searches, each with the next seed
  bool noSmooth = false;
  double velocity = 1;   ///< limit for joints without one in the scene, rad/s or m/s
  double ramp = 0.5;     ///< seconds in which each joint accelerates from rest to its velocity limit
  bool effort = false;   ///< respect the scene's effort limits
  double speed = 1;      ///< of the film; 1: real time
  std::string body{};    ///< whose traces are drawn; empty: farthestBody()
  RenderOptions film{};  ///< cameras, size and gl of the pictures
  bool noFilm = false;
  bool json = false;
  std::filesystem::path out{};  ///< a folder
};

}  // namespace rex::cli
