#pragma once

#include <filesystem>
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

namespace rex::cli {

/// The timing of a path, and its limits.
struct PathTiming {
  JointLimits limits{};
  TimingResult result{};

  [[nodiscard]] bool isFound() const { return result.status == TimingStatus::kFound; }
};

/// The fastest motion along the path found, within the limits of the scene and of the options. Throws Error
/// like jointLimits().
[[nodiscard]] PathTiming timingOf(const PathTask& task, const PlanOptions& options, const FoundPath& found);

/// One line about limits that do not come from the scene; empty if all do.
[[nodiscard]] std::string assumptionsOf(const PathTiming& timing, const PlanOptions& options);

/// One line about the limits that were respected.
[[nodiscard]] std::string limitsTextOf(const PathTiming& timing, const PlanOptions& options);

/// Postures of a motion, `rate` per second, and its end, so that the last interval may be shorter.
[[nodiscard]] Motion sampledMotion(const TimedPath& timed, double rate);

/// The motion as a table: "time", then the joints by name, separated by commas; a motion for readMotion().
[[nodiscard]] std::string csvOf(const Model& model, const Motion& motion);

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
[[nodiscard]] std::string titleOf(const PathTask& task, const PlanOptions& options, const FoundPath& found);

/// Draws what a search explored, with a caption, into a .png file. Throws Error if nothing is to be seen.
void writeExplored(Picture picture, RenderPlan plan, std::string caption, const std::filesystem::path& out);

/// Writes into options.out what a search explored, and the motion along the path found as a table, a film
/// and a page with a replay. Pictures show the traces of `body` and are drawn according to `pictures`.
/// Returns the files, as a user would type them. Throws Error like the functions that write them.
[[nodiscard]] std::vector<std::string> writePathFiles(const PathTask& task, const PlanOptions& options,
                                                      const RenderPlan& pictures, BodyId body,
                                                      const FoundPath& found, const PathTiming& timing);

/// A few lines for one search; for several a table of minima, medians and maxima, with lengths and
/// clearances only of the paths found. `timing` is that of the shortest path.
[[nodiscard]] std::string summaryOf(const PathTask& task, const PlanOptions& options, const FoundPaths& found,
                                    const PathTiming& timing);

/// The same as JSON, with the shortest path.
[[nodiscard]] std::string jsonSummaryOf(const PathTask& task, const PlanOptions& options,
                                        const FoundPaths& found, const PathTiming& timing,
                                        const std::vector<std::string>& files);

}  // namespace rex::cli
