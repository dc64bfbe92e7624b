#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "base/exit_code.h"
#include "cli/robot/path_search.h"
#include "cli/robot/posture_option.h"
#include "cli/robot/render_plan.h"
#include "collision/contacts.h"
#include "planning/hybrid_astar.h"
#include "render/picture.h"
#include "scene/model.h"
#include "trajectory/motion_terms.h"
#include "trajectory/trajectory_optimizer.h"

namespace rex::cli {

/// The options of `rex plan`.
struct PlanOptions {
  SceneOption scene{};
  std::string start = "file";  ///< see parsePosture()
  std::string goal{};          ///< a posture; to optimize, BODY:x,y,z
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
  double timeLimit = PathSearch{}.timeLimit;
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

/// Each searches in its way, and writes what it found. kBelow if nothing was found, or nothing proven
/// clear.
[[nodiscard]] ExitCode planCar(const PlanOptions& options, const RenderPlan& pictures, Model model);
[[nodiscard]] ExitCode planMotion(const PlanOptions& options, const RenderPlan& pictures, Model model);

/// Throws UsageError for a scene in which anything but one joint of type transXYPhi moves.
void requireCar(const Model& model);

/// The task of a car in a scene: from a pose (x, y, heading) to another, with all pairs of shapes `margin`
/// metres apart. Throws like robotProblem().
[[nodiscard]] PathTask parkingTask(Model model, const ContactModel& contacts, const VectorArg& start,
                                   const VectorArg& goal, double margin, double resolution);

/// What `rex plan --planner hybrid-astar` found.
struct Parking {
  Car car{};
  CarPath path{};
  ClearanceBounds clearance{};  ///< along the whole path

  [[nodiscard]] bool isFound() const { return path.driven.found.status == PathStatus::kFound; }
};

/// Searches by findCarPath(). Throws like it.
[[nodiscard]] Parking parkCar(const PathTask& task, const Car& car, const HybridAStarOptions& search);

/// The drive at 1 m/s, `rate` postures per second, and its end. There must be a path.
[[nodiscard]] Motion parkingMotion(const Parking& parking, double rate);

/// What was explored, and the path, as exploredPicture() shows them.
[[nodiscard]] Picture parkingPicture(const PathTask& task, const Parking& parking);

/// Moves a point of `body` from rest at `start` to rest at p_WQ, with little acceleration and within the
/// joint limits. If `avoids`, all pairs of shapes stay `margin` metres apart.
struct TrajectoryTask {
  Model model;
  ContactModel contacts;
  BodyId body;
  Eigen::Vector3d p_WQ;
  Eigen::VectorXd start;
  bool avoids = false;
  double margin = 0.02;
  int steps = 100;
  double seconds = 2;
  ConstraintMethod method = ConstraintMethod::kAugmentedLagrangian;
};

/// The trajectory found, beginning with the start.
struct FoundTrajectory {
  Eigen::MatrixXd path{};  ///< nq x (steps + 1), `tau` seconds apart
  double tau = 0;
  double error = 0;              ///< final distance of the body's point from the goal, metres
  ConstrainedResult solution{};  ///< with the log of all iterations
  TrajectoryClearance clearance{};
  int samples = 0;     ///< postures per step checked for obstacles in the last round; 0: none
  double cpuTime = 0;  ///< seconds

  [[nodiscard]] bool isSolved() const { return solution.status == ConstrainedStatus::kSolved; }
};

/// First solves the problem without obstacles, starting from standing still. Then solves it with obstacles
/// from a warm start, checking more and more postures per step until everything in between is proven clear.
/// Throws Error like the terms, and for a model with quaternions.
[[nodiscard]] FoundTrajectory findTrajectory(const TrajectoryTask& task);

}  // namespace rex::cli
