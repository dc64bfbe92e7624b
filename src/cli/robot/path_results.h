#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/robot/path_search.h"
#include "cli/robot/plan.h"
#include "cli/robot/posture_option.h"
#include "cli/robot/render_plan.h"
#include "planning/time_parametrization.h"
#include "planning/timed_path.h"
#include "render/figure.h"
#include "render/picture.h"
#include "render/report.h"

namespace rex::cli {

struct Results;

/// The timing of a path, and its limits.
struct PathTiming {
  JointLimits limits{};
  TimingResult result{};

  [[nodiscard]] bool isFound() const { return result.status == TimingStatus::kFound; }
};

/// The fastest motion along the path found, within the limits of the scene and of the options. Throws Error
/// like jointLimits().
[[nodiscard]] PathTiming timePath(const PathTask& task, const PlanOptions& options, const FoundPath& found);

/// One line about limits that do not come from the scene; empty if all do.
[[nodiscard]] std::string assumedLimits(const PathTiming& timing, const PlanOptions& options);

/// One line about the limits that were respected.
[[nodiscard]] std::string limitsText(const PathTiming& timing, const PlanOptions& options);

/// Postures of a motion, `rate` per second, and its end, so that the last interval may be shorter.
[[nodiscard]] Motion sampledMotion(const TimedPath& timed, double rate);

/// The motion as a table: "time", then the joints by name, separated by commas; a motion for readMotion().
[[nodiscard]] std::string motionCsv(const Model& model, const Motion& motion);

/// The body whose trace a picture shows by default: the first of those moved by the most joints.
[[nodiscard]] BodyId farthestBody(const Model& model);

/// What a search explored, in the workspace: the traces of a body's origin between connected
/// configurations, each tree in its own colour, and the path on top; also the scene at the start and,
/// faintly, at the goal.
[[nodiscard]] Picture exploredPicture(const PathTask& task, BodyId body, const FoundPath& found);

/// The joint positions over time.
[[nodiscard]] Figure jointsFigure(const Model& model, const Motion& motion);

/// The joint speeds over time, as fractions of their limits, with a line at 1.
[[nodiscard]] Figure speedsFigure(const TimedPath& timed, const MotionLimits& limits);

/// The distance of the nearest pair of shapes over time, with the margin (metres). There must be at least
/// one pair.
[[nodiscard]] Figure clearanceFigure(const Model& model, const ContactModel& contacts, const Motion& motion,
                                     double margin);

/// "scene, planner, seed 3", without control characters.
[[nodiscard]] std::string pathTitle(const PathTask& task, const PlanOptions& options, const FoundPath& found);

/// Draws what a search explored, with a caption, into a .png file. Throws Error if nothing is to be seen.
void writeExplored(Picture picture, RenderPlan plan, std::string caption, const std::filesystem::path& out);

/// A motion that was planned.
struct PlannedMotion {
  const Model& model;
  const ContactModel& contacts;
  BodyId body{};                                  ///< whose trace the film shows
  double duration = 0;                            ///< seconds
  std::function<Motion(double rate)> postures{};  ///< `rate` per second
  double clearance = 0;                           ///< metres
  Report page{};  ///< the title, figures besides those of joints and clearances, and facts, none of them a
                  ///< computing time: the same input gives the same bytes
};

/// Writes into options.out the table, and unless there is to be no film, the film and a page with a replay.
/// Throws Error like the functions that write them.
void writeMotion(const PlannedMotion& planned, const Motion& table, const PlanOptions& options,
                 const RenderPlan& pictures, Results& results);

/// Writes into options.out what a search explored, and the motion along the path found. Pictures show the
/// traces of `body` and are drawn according to `pictures`.
void writePathFiles(const PathTask& task, const PlanOptions& options, const RenderPlan& pictures, BodyId body,
                    const FoundPath& found, const PathTiming& timing, Results& results);

/// A few lines for one search; for several a table of minima, medians and maxima, with lengths and
/// clearances only of the paths found. `timing` is that of the shortest path.
[[nodiscard]] std::string pathSummary(const PathTask& task, const PlanOptions& options,
                                      const FoundPaths& found, const PathTiming& timing);

/// The same, for programs with the shortest path.
[[nodiscard]] Results pathResults(const PathTask& task, const PlanOptions& options, const FoundPaths& found,
                                  const PathTiming& timing);

}  // namespace rex::cli
