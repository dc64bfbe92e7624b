#include "cli/robot/path_results.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"
#include "base/text_file.h"
#include "cli/results_internal.h"
#include "cli/robot/motion_files.h"
#include "cli/robot/path_search.h"
#include "cli/robot/posture_option.h"
#include "cli/robot/render_plan.h"
#include "cli/terminal.h"
#include "collision/contacts.h"
#include "kinematics/forward_kinematics.h"
#include "render/image.h"
#include "render/picture.h"
#include "render/report.h"

namespace rex::cli {

namespace {

// The first few names, and how many more there are.
std::string listOf(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 6;
  std::vector<std::string> shown;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i)
    shown.push_back("'" + escapeForTerminal(names[i]) + "'");
  const std::string rest = names.size() > kMost ? fmt::format(" and {} more", names.size() - kMost) : "";
  return fmt::format("{}{}", join(shown, ", "), rest);
}

}  // namespace

PathTiming timePath(const PathTask& task, const PlanOptions& options, const FoundPath& found) {
  PathTiming timing{
      .limits = jointLimits(task.model,
                            {.velocity = options.velocity, .ramp = options.ramp, .effort = options.effort})};
  timing.result = parametrizeTime(found.curve, timing.limits.limits);
  return timing;
}

std::string assumedLimits(const PathTiming& timing, const PlanOptions& options) {
  std::string text;
  if (!timing.limits.assumedVelocity.empty())
    text = fmt::format("no velocity limit for {}: assuming {:g} rad/s or m/s, see --velocity",
                       listOf(timing.limits.assumedVelocity), options.velocity);
  if (!timing.limits.anyEffort.empty())
    text += fmt::format("{}no effort limit for {}: assuming any effort", text.empty() ? "" : "; ",
                        listOf(timing.limits.anyEffort));
  return text;
}

std::string limitsText(const PathTiming& timing, const PlanOptions& options) {
  const auto all = timing.limits.limits.velocity.size();
  const auto assumed = static_cast<Eigen::Index>(timing.limits.assumedVelocity.size());
  const std::string velocity =
      assumed == 0     ? "velocities of the scene"
      : assumed == all ? fmt::format("velocities {:g} rad/s or m/s", options.velocity)
                       : fmt::format("velocities of the scene, for {} of {} coordinates {:g} rad/s or m/s",
                                     assumed, all, options.velocity);
  return fmt::format("{}; accelerations that reach them in {:g} s{}", velocity, options.ramp,
                     options.effort ? "; efforts of the scene" : "");
}

namespace {

// Quoted as a CSV field if necessary.
std::string quoted(const std::string& name) {
  if (name.find_first_of(",\"; ") == std::string::npos) return name;
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

}  // namespace

Motion sampledMotion(const TimedPath& timed, double rate) {
  const double end = timed.duration();
  const auto count = static_cast<std::size_t>(std::ceil(end * rate - 1e-9));
  Motion motion;
  for (std::size_t i = 0; i < count; ++i) {
    motion.times.push_back(static_cast<double>(i) / rate);
    motion.postures.push_back(timed.at(motion.times.back()).q);
  }
  motion.times.push_back(end);
  motion.postures.push_back(timed.at(end).q);
  return motion;
}

std::string motionCsv(const Model& model, const Motion& motion) {
  fmt::memory_buffer table;
  const auto out = std::back_inserter(table);
  fmt::format_to(out, "time");
  for (const std::string& name : printablePositionNames(model)) fmt::format_to(out, ",{}", quoted(name));
  for (std::size_t i = 0; i < motion.times.size(); ++i) {
    fmt::format_to(out, "\n{}", motion.times[i]);
    for (const double x : motion.postures[i]) fmt::format_to(out, ",{}", x);
  }
  return fmt::to_string(table) + "\n";
}

namespace {

using Eigen::Vector3d;

constexpr Eigen::Index kBatch = 1024;  // postures at a time, so that their poses take little memory
const Color kPathColor{0.84f, 0.37f, 0.0f};
const std::array<Color, 2> kGraphColors = {Color{0.0f, 0.45f, 0.70f}, Color{0.0f, 0.62f, 0.45f}};

// The position of a body's origin in each posture.
std::vector<Vector3d> placesOf(const Model& model, BodyId body, const MatrixArg& postures) {
  std::vector<Vector3d> places;
  PoseBatch poses;
  for (Eigen::Index first = 0; first < postures.cols(); first += kBatch) {
    const Eigen::Index count = std::min(kBatch, postures.cols() - first);
    forwardKinematicsBatch(model, postures.middleCols(first, count), poses);
    for (int k = 0; k < static_cast<int>(count); ++k) places.push_back(poses.pose(body, k).p);
  }
  return places;
}

// Length of the straight pieces of drawn edges, in the metric of the space; longer for very many edges.
double pieceLength(const Space& space, const std::vector<PathGraph>& graphs) {
  constexpr double kFine = 0.15, kMostPieces = 60'000;
  double whole = 0;
  for (const PathGraph& graph : graphs)
    for (const auto& [a, b] : graph.edges) whole += space.distance(graph.nodes.col(a), graph.nodes.col(b));
  return std::max(kFine, whole / kMostPieces);
}

// Postures from a to b, both included, no further apart than `piece`.
Eigen::MatrixXd pointsBetween(const Space& space, const VectorArg& a, const VectorArg& b, double piece) {
  const int pieces = std::max(1, static_cast<int>(std::ceil(space.distance(a, b) / piece)));
  Eigen::MatrixXd points(a.size(), pieces + 1);
  for (int i = 0; i <= pieces; ++i) space.interpolate(a, b, static_cast<double>(i) / pieces, points.col(i));
  return points;
}

// Very many lines are drawn so faint that what lies behind them shows through.
float opacityOf(std::size_t edges) { return std::clamp(800 / static_cast<float>(edges), 0.08f, 0.5f); }

LineSet linesOf(const Model& model, const Space& space, BodyId body, const PathGraph& graph, double piece) {
  LineSet lines;
  for (const auto& [a, b] : graph.edges) {
    const std::vector<Vector3d> places =
        placesOf(model, body, pointsBetween(space, graph.nodes.col(a), graph.nodes.col(b), piece));
    for (std::size_t i = 1; i < places.size(); ++i) lines.segments.emplace_back(places[i - 1], places[i]);
  }
  return lines;
}

Polyline bodyPath(const Model& model, const Space& space, BodyId body, const MatrixArg& path) {
  constexpr double kFine = 0.03, kMostPieces = 60'000;
  const double piece = std::max(kFine, pathLength(space, path) / kMostPieces);
  Polyline way{.color = kPathColor, .width = 5};
  for (Eigen::Index k = 1; k < path.cols(); ++k)
    for (const Vector3d& place :
         placesOf(model, body, pointsBetween(space, path.col(k - 1), path.col(k), piece)))
      way.points.push_back(place);
  return way;
}

// Adds the moving solids once more, faintly, in the posture of the other picture.
void addFaintly(Picture& picture, const Picture& other) {
  constexpr float kFaint = 0.45f;
  const std::size_t count = picture.solids.size();
  for (std::size_t i = 0; i < count; ++i) {
    Solid solid = other.solids[i];
    const Pose &here = picture.solids[i].X_WS, &there = solid.X_WS;
    if (here.p.isApprox(there.p, 1e-9) && here.R.isApprox(there.R, 1e-9)) continue;
    solid.color.a *= kFaint;
    picture.solids.push_back(std::move(solid));
  }
}

}  // namespace

BodyId farthestBody(const Model& model) {
  std::vector<int> movers(model.bodies().size(), 0);
  std::size_t farthest = 0;
  for (std::size_t i = 1; i < movers.size(); ++i) {  // parents come first
    const Body& body = model.bodies()[i];
    const bool moves = body.joint != kNoJoint && model[body.joint].nv > 0;
    movers[i] = movers[static_cast<std::size_t>(body.parent)] + (moves ? 1 : 0);
    if (movers[i] > movers[farthest]) farthest = i;
  }
  return BodyId(static_cast<int>(farthest));
}

Picture exploredPicture(const PathTask& task, BodyId body, const FoundPath& found) {
  const auto& [model, contacts, problem] = task;
  Picture picture = scenePicture(model, forwardKinematics(model, problem.start));
  addFaintly(picture, scenePicture(model, forwardKinematics(model, problem.goal)));
  const double piece = pieceLength(problem.space, found.explored);
  for (std::size_t i = 0; i < found.explored.size(); ++i) {
    picture.lineSets.push_back(linesOf(model, problem.space, body, found.explored[i], piece));
    picture.lineSets.back().color = kGraphColors[i % kGraphColors.size()];
    picture.lineSets.back().color.a = opacityOf(found.explored[i].edges.size());
  }
  if (found.isFound()) picture.polylines.push_back(bodyPath(model, problem.space, body, found.path));
  Eigen::MatrixXd ends(problem.start.size(), 2);
  ends << problem.start, problem.goal;
  picture.pointSets.push_back({.points = placesOf(model, body, ends), .color = kPathColor, .size = 11});
  return picture;
}

Figure jointsFigure(const Model& model, const Motion& motion) {
  Figure figure{
      .title = "joints", .xLabel = "time [s]", .yLabel = "position [rad, m]", .legend = Legend::kOutside};
  const std::vector<std::string> names = printablePositionNames(model);
  for (std::size_t i = 0; i < names.size(); ++i) {
    Series series{.label = names[i], .x = motion.times};
    for (const Eigen::VectorXd& q : motion.postures) series.y.push_back(q[static_cast<Eigen::Index>(i)]);
    figure.series.push_back(std::move(series));
  }
  return figure;
}

Figure speedsFigure(const TimedPath& timed, const MotionLimits& limits) {
  constexpr int kPoints = 600;  // about as many as a figure has columns
  Figure figure{.title = "speeds",
                .xLabel = "time [s]",
                .yLabel = "speed / limit [1]",
                .legend = Legend::kOutside,
                .horizontalLines = {{.at = 1, .label = "limit"}}};
  for (const std::string& name : limits.names) figure.series.push_back({.label = escapeForTerminal(name)});
  for (int i = 0; i <= kPoints; ++i) {
    const double t = timed.duration() * i / kPoints;
    const Eigen::VectorXd v = timed.at(t).v;
    for (std::size_t k = 0; k < figure.series.size(); ++k) {
      const auto joint = static_cast<Eigen::Index>(k);
      figure.series[k].x.push_back(t);
      figure.series[k].y.push_back(std::abs(v[joint]) / limits.velocity[joint]);
    }
  }
  return figure;
}

Figure clearanceFigure(const Model& model, const ContactModel& contacts, const Motion& motion,
                       double margin) {
  Series nearest{.label = "nearest shapes", .x = motion.times};
  PoseBatch poses;
  Eigen::MatrixXd distances;
  for (const Eigen::VectorXd& q : motion.postures) {
    forwardKinematicsBatch(model, q, poses);
    contactDistancesBatch(contacts, poses, distances);
    nearest.y.push_back(distances.minCoeff());
  }
  return {.title = "clearance",
          .xLabel = "time [s]",
          .yLabel = "distance [m]",
          .series = {nearest},
          .horizontalLines = {{.at = margin, .label = "margin"}}};
}

namespace {

namespace fs = std::filesystem;

}  // namespace

void writeExplored(Picture picture, RenderPlan plan, std::string caption, const fs::path& out) {
  picture.captions.push_back({.text = std::move(caption)});
  plan.renderer.antiAliasing = AntiAliasing::kMsaa4;
  Studio studio(plan, bounds(picture));
  const Image image = studio.draw(picture);
  studio.requireSomethingSeen();
  writePng(image, out);
}

std::string pathTitle(const PathTask& task, const PlanOptions& options, const FoundPath& found) {
  return fmt::format("{}, {}, seed {}", escapeForTerminal(task.model.name()), toString(options.planner),
                     found.seed);
}

void writeMotion(const PlannedMotion& planned, const Motion& table, const PlanOptions& options,
                 const RenderPlan& pictures, Results& results) {
  const auto& [model, contacts, body, duration, postures, clearance, page] = planned;
  writeTextFile(results.file(options.out / "path.csv"), motionCsv(model, table));
  if (options.noFilm) return;
  const double speed = filmSpeed(options.speed, duration);
  const Motion motion = postures(kVideoRate / speed);
  Report report = page;
  report.figures.insert(report.figures.begin(), {jointsFigure(model, motion)});
  if (!contacts.pairs().empty()) {
    report.figures.push_back({clearanceFigure(model, contacts, motion, *options.margin)});
    report.facts.emplace_back("clearance", fmt::format("{:.4g} m", clearance));
  }
  for (const fs::path& file :
       writeFilmAndReplay(model, motion, body, std::move(report), pictures, options.out / "path", speed))
    results.file(file);
}

void writePathFiles(const PathTask& task, const PlanOptions& options, const RenderPlan& pictures, BodyId body,
                    const FoundPath& found, const PathTiming& timing, Results& results) {
  constexpr double kRate = 100, kMostRows = 1e6;  // fewer rows per second for very long motions
  const std::string title = pathTitle(task, options, found);
  writeExplored(exploredPicture(task, body, found), pictures, fmt::format("{}: {} nodes", title, found.nodes),
                results.file(options.out / "tree.png"));
  if (!found.isFound() || !timing.isFound()) return;
  const TimedPath& timed = timing.result.motion;
  const double duration = timed.duration();
  PlannedMotion planned{
      .model = task.model,
      .contacts = task.contacts,
      .body = body,
      .duration = duration,
      .postures = [&](double rate) { return sampledMotion(timed, rate); },
      .clearance = found.clearance.atLeast,
      .page = {.title = title,
               .facts = {{"length", fmt::format("{:.4g}", found.length)},
                         {"duration", fmt::format("{:.3f} s", duration)},
                         {"from velocity limits alone", fmt::format("{:.3f} s", timing.result.lowerBound)},
                         {"limits", limitsText(timing, options)},
                         {"margin", fmt::format("{:g} m", *options.margin)},
                         {"nodes", fmt::format("{}", found.nodes)},
                         {"configurations checked", fmt::format("{}", found.checks)}}}};
  if (duration > 0) planned.page.figures.push_back({speedsFigure(timed, timing.limits.limits)});
  writeMotion(planned, sampledMotion(timed, std::min(kRate, kMostRows / std::max(duration, 1.))), options,
              pictures, results);
}

namespace {

std::string timingTextOf(const PathTiming& timing, const PlanOptions& options) {
  if (!timing.isFound())
    return fmt::format("duration   none: {}\n", escapeForTerminal(timing.result.message));
  const TimingResult& result = timing.result;
  const int stops = result.motion.curve().stops();
  return fmt::format("duration   {:.3f} s, at least {:.3f} s from the velocity limits alone; {} on the way\n",
                     result.motion.duration(), result.lowerBound,
                     stops == 0 ? "no stop" : fmt::format("{} stop{}", stops, stops == 1 ? "" : "s")) +
         fmt::format("limits     {}\n", limitsText(timing, options));
}

std::string summaryOfOne(const PathTask& task, const PlanOptions& options, const FoundPath& found,
                         const PathTiming& timing) {
  std::string text =
      fmt::format("{}: {}\n", pathTitle(task, options, found),
                  found.isFound()  ? "found a path"
                  : found.isTimeUp ? fmt::format("no path within {:g} s, the --time-limit", options.timeLimit)
                                   : "no path within the budget of --samples");
  text += fmt::format("explored   {} nodes of {} samples, {} configurations checked\n", found.nodes,
                      found.samples, found.checks);
  text += fmt::format("CPU time   {:.1f} ms for planning{}", 1e3 * found.planningTime,
                      found.isFound() && found.isTimeUp ? ", ended by the --time-limit" : "");
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

std::string fiveDigits(double value) { return fmt::format("{:.5g}", value); }

std::string summaryOfAll(const PathTask& task, const PlanOptions& options, const FoundPaths& found,
                         const PathTiming& timing) {
  Table table(22, 10);
  table.add({"", "min", "median", "max"});
  const auto add = [&](const char* name, bool ofPaths, const std::function<double(const FoundPath&)>& value) {
    std::vector<double> values;
    for (const FoundPath& one : found.all)
      if (one.isFound() || !ofPaths) values.push_back(value(one));
    if (values.empty()) return;
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    const double median = values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
    table.add(name, Eigen::Vector3d(values.front(), median, values.back()), fiveDigits);
  };
  add("nodes", false, [](const FoundPath& one) { return one.nodes; });
  add("configurations checked", false, [](const FoundPath& one) { return static_cast<double>(one.checks); });
  add("planning, CPU ms", false, [](const FoundPath& one) { return 1e3 * one.planningTime; });
  add("smoothing, CPU ms", true, [](const FoundPath& one) { return 1e3 * one.smoothingTime; });
  add("length", true, [](const FoundPath& one) { return one.length; });
  add("clearance, m", true, [](const FoundPath& one) { return one.clearance.atLeast; });
  std::string text =
      fmt::format("{}, {}, seeds {} to {}: {} of {} found a path\n", escapeForTerminal(task.model.name()),
                  toString(options.planner), found.all.front().seed, found.all.back().seed, found.successes(),
                  found.all.size());
  if (const auto ended = std::ranges::count_if(found.all, &FoundPath::isTimeUp); ended > 0)
    text += fmt::format("{} ended after {:g} s, the --time-limit\n", ended, options.timeLimit);
  text += table.text();
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
            {"velocity_limits", toJson(kept.limits.velocity)},
            {"acceleration_limits", toJson(kept.limits.acceleration)},
            {"assumed_velocities", kept.assumedVelocity}};
  // Infinite limits are null.
  json["effort_limits"] = kept.limits.effort.size() > 0 ? toJson(kept.limits.effort) : Json();
  return json;
}

Json jsonOfPath(const FoundPath& found) {
  Json json{{"seed", found.seed},
            {"found", found.isFound()},
            {"samples", found.samples},
            {"time_is_up", found.isTimeUp},
            {"nodes", found.nodes},
            {"checks", found.checks},
            {"planning_seconds", found.planningTime}};
  if (!found.isFound()) return json;
  json["smoothing_seconds"] = found.smoothingTime;
  json["planned_length"] = found.plannedLength;
  json["length"] = found.length;
  json["clearance"] = found.clearance.atLeast;
  json["clearance_measured"] = found.clearance.atMost;
  return json;
}

}  // namespace

std::string pathSummary(const PathTask& task, const PlanOptions& options, const FoundPaths& found,
                        const PathTiming& timing) {
  return found.all.size() == 1 ? summaryOfOne(task, options, found.shortest(), timing)
                               : summaryOfAll(task, options, found, timing);
}

Results pathResults(const PathTask& task, const PlanOptions& options, const FoundPaths& found,
                    const PathTiming& timing) {
  Json runs = Json::array();
  for (const FoundPath& one : found.all) runs.push_back(jsonOfPath(one));
  const bool isFound = found.successes() > 0;
  return {.lines = {pathSummary(task, options, found, timing)},
          .json = {{"scene", task.model.name()},
                   {"planner", toString(options.planner)},
                   {"margin", *options.margin},
                   {"resolution", *options.resolution},
                   {"found", found.successes()},
                   {"runs", std::move(runs)},
                   {"shortest", isFound ? Json(found.shortest().seed) : Json()},
                   {"timing", isFound ? jsonOfTiming(timing) : Json()},
                   {"path", isFound ? jsonOfRows(found.shortest().path.transpose()) : Json()}}};
}

}  // namespace rex::cli
