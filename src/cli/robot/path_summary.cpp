#include "cli/robot/path_summary.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "cli/json_internal.h"
#include "cli/robot/path_files.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

std::string timingTextOf(const PathTiming& timing, const PlanOptions& options) {
  if (!timing.isFound()) return fmt::format("duration   none: {}\n", harmless(timing.result.message));
  const TimingResult& result = timing.result;
  const int stops = result.motion.curve().stops();
  return fmt::format("duration   {:.3f} s, at least {:.3f} s from the velocity limits alone; {} on the way\n",
                     result.motion.duration(), result.lowerBound,
                     stops == 0 ? "no stop" : fmt::format("{} stop{}", stops, stops == 1 ? "" : "s")) +
         fmt::format("limits     {}\n", limitsTextOf(timing, options));
}

std::string summaryOfOne(const PathTask& task, const PlanOptions& options, const FoundPath& found,
                         const PathTiming& timing) {
  std::string text = fmt::format("{}: {}\n", titleOf(task, options, found),
                                 found.isFound() ? "found a path" : "no path within the budget of --samples");
  text += fmt::format("explored   {} nodes of {} samples, {} configurations checked\n", found.nodes,
                      found.samples, found.checks);
  text += fmt::format("CPU time   {:.1f} ms for planning", 1e3 * found.planningTime);
  if (!found.isFound()) return text;
  text += fmt::format(", {:.1f} ms for smoothing\n", 1e3 * found.smoothingTime);
  text += fmt::format("length     {:.3f}, before smoothing {:.3f}\n", found.length, found.plannedLength);
  text += timingTextOf(timing, options);
  const auto& [atLeast, atMost] = found.clearance;
  if (!std::isfinite(atLeast)) return text + "clearance  nothing can collide";
  const bool isProven = atMost - atLeast <= 2 * kClearanceTolerance;
  return text + fmt::format("clearance  {:.4f} m all along the path{}, margin {:g} m", atLeast,
                            isProven ? "" : fmt::format(" is proven, {:.4f} m measured", atMost),
                            *options.margin);
}

std::string row(const char* name, std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  const double median = values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
  return fmt::format("\n{:22} {:>10.5g} {:>10.5g} {:>10.5g}", name, values.front(), median, values.back());
}

std::string summaryOfAll(const PathTask& task, const PlanOptions& options, const FoundPaths& found,
                         const PathTiming& timing) {
  const auto valuesOf = [&](bool ofPaths, const std::function<double(const FoundPath&)>& value) {
    std::vector<double> values;
    for (const FoundPath& one : found.all)
      if (one.isFound() || !ofPaths) values.push_back(value(one));
    return values;
  };
  std::string text = fmt::format("{}, {}, seeds {} to {}: {} of {} found a path\n",
                                 harmless(task.model.name()), nameOf(options.planner), found.all.front().seed,
                                 found.all.back().seed, found.successes(), found.all.size());
  text += fmt::format("{:22} {:>10} {:>10} {:>10}", "", "min", "median", "max");
  text += row("nodes", valuesOf(false, [](const FoundPath& one) { return one.nodes; }));
  text += row("configurations checked",
              valuesOf(false, [](const FoundPath& one) { return static_cast<double>(one.checks); }));
  text +=
      row("planning, CPU ms", valuesOf(false, [](const FoundPath& one) { return 1e3 * one.planningTime; }));
  text +=
      row("smoothing, CPU ms", valuesOf(true, [](const FoundPath& one) { return 1e3 * one.smoothingTime; }));
  text += row("length", valuesOf(true, [](const FoundPath& one) { return one.length; }));
  text += row("clearance, m", valuesOf(true, [](const FoundPath& one) { return one.clearance.atLeast; }));
  if (found.successes() == 0) return text;
  text += fmt::format("\nshortest: seed {}\n", found.shortest().seed) + timingTextOf(timing, options);
  text.pop_back();
  return text;
}

Json jsonOfTiming(const PathTiming& timing) {
  const JointLimits& kept = timing.limits;
  Json json{{"duration", timing.isFound() ? Json(timing.result.motion.duration()) : Json()},
            {"least_duration", timing.isFound() ? Json(timing.result.lowerBound) : Json()},
            {"stops", timing.isFound() ? Json(timing.result.motion.curve().stops()) : Json()},
            {"message", timing.result.message},
            {"velocity_limits", jsonOf(kept.limits.velocity)},
            {"acceleration_limits", jsonOf(kept.limits.acceleration)},
            {"assumed_velocities", kept.assumedVelocity}};
  // Infinite limits are null.
  json["effort_limits"] = kept.limits.effort.size() > 0 ? jsonOf(kept.limits.effort) : Json();
  return json;
}

Json jsonOfPath(const FoundPath& found) {
  Json json{{"seed", found.seed},   {"found", found.isFound()}, {"samples", found.samples},
            {"nodes", found.nodes}, {"checks", found.checks},   {"planning_seconds", found.planningTime}};
  if (!found.isFound()) return json;
  json["smoothing_seconds"] = found.smoothingTime;
  json["planned_length"] = found.plannedLength;
  json["length"] = found.length;
  const bool canCollide = std::isfinite(found.clearance.atLeast);
  json["clearance"] = canCollide ? Json(found.clearance.atLeast) : Json();
  json["clearance_measured"] = canCollide ? Json(found.clearance.atMost) : Json();
  return json;
}

}  // namespace

std::string summaryOf(const PathTask& task, const PlanOptions& options, const FoundPaths& found,
                      const PathTiming& timing) {
  return found.all.size() == 1 ? summaryOfOne(task, options, found.shortest(), timing)
                               : summaryOfAll(task, options, found, timing);
}

std::string jsonSummaryOf(const PathTask& task, const PlanOptions& options, const FoundPaths& found,
                          const PathTiming& timing, const std::vector<std::string>& files) {
  Json runs = Json::array();
  for (const FoundPath& one : found.all) runs.push_back(jsonOfPath(one));
  const bool isFound = found.successes() > 0;
  return dump(Json{{"scene", task.model.name()},
                   {"planner", nameOf(options.planner)},
                   {"margin", *options.margin},
                   {"resolution", *options.resolution},
                   {"found", found.successes()},
                   {"runs", std::move(runs)},
                   {"shortest", isFound ? Json(found.shortest().seed) : Json()},
                   {"timing", isFound ? jsonOfTiming(timing) : Json()},
                   {"path", isFound ? jsonOfRows(found.shortest().path.transpose()) : Json()},
                   {"files", files}});
}

}  // namespace rex::cli
