#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "cli/robot/render_plan.h"

namespace rex::cli {

/// What `rex plan` is asked for.
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
  double velocity = 1;   ///< of joints without a limit in the scene, rad/s or m/s
  double ramp = 0.5;     ///< seconds in which each joint comes from rest to its limit of velocity
  bool effort = false;   ///< keep to the efforts of joints in the scene
  double speed = 1;      ///< of the film; 1: real time
  std::string body{};    ///< whose ways are drawn; empty: farthestBody()
  RenderOptions film{};  ///< cameras, size and gl of the pictures
  bool noFilm = false;
  bool json = false;
  std::filesystem::path out{};  ///< a folder
};

}  // namespace rex::cli
