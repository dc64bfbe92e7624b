#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/film_file.h"
#include "cli/json_internal.h"
#include "cli/option_value_internal.h"
#include "cli/path_motion.h"
#include "cli/path_pictures.h"
#include "cli/path_search.h"
#include "cli/studio.h"
#include "cli/wrong_use_internal.h"
#include "collision/contacts.h"
#include "grading/text_file.h"
#include "planning/robot_problem.h"
#include "render/png.h"
#include "render/report.h"
#include "scene/coordinates.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kLongestFilm = 120;  // seconds, as of other films

PathSearch searchOf(const PlanOptions& options) {
  PathSearch search{.planner = plannerOf(options.planner), .smooth = !options.noSmooth};
  requireBetween("--margin", options.margin, 0, kQueryCutoff);
  requireBetween("--resolution", options.resolution, 1e-4, 10);
  requireBetween("--speed", options.speed, 1e-3, 1e3);
  requireBetween("--seeds", options.seeds, 1, 10'000);
  if (options.step && !growsTrees(search.planner))
    throw UsageError(
        {.what = "--step", .found = "--planner " + options.planner, .wanted = "a planner that grows trees"});
  search.step = options.step.value_or(search.step);
  requireBetween("--step", search.step, 1e-3, 1e3);
  if (search.planner == Planner::kRrtStar) search.samples = 5000;  // it spends them all
  if (!growsTrees(search.planner)) search.samples = 2000;
  search.samples = options.samples.value_or(search.samples);
  requireBetween("--samples", search.samples, 1, growsTrees(search.planner) ? 1e7 : 1e5);
  return search;
}

void requireWithinLimits(const Model& model, const std::string& option, const VectorArg& q) {
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const double lower = model.lowerLimits()[i], upper = model.upperLimits()[i];
    const double outside = std::max(lower - q[i], q[i] - upper);
    if (outside <= 0) continue;
    throw UsageError(
        {.what = fmt::format("{}: joint '{}' (q{})", option, harmless(jointOfPosition(model, i).name), i),
         .found = fmt::format("{:g}, out of bounds by {:.4g}", q[i], outside),
         .wanted = fmt::format("{:g} to {:g}", lower, upper)});
  }
}

Eigen::VectorXd postureOf(const Model& model, const std::string& option, const std::string& text) {
  Eigen::VectorXd q = parsePostureOf(model, option, text);
  forEachQuaternion(model, [&](int iq, int) {
    if (q.segment<4>(iq).isZero(0))
      throw UsageError({.what = option, .found = "a quaternion of zeros", .wanted = "a rotation"});
    q.segment<4>(iq).normalize();
  });
  requireWithinLimits(model, option, q);
  return q;
}

PathProblem problemOf(const Model& model, const ContactModel& contacts, const PlanOptions& options) {
  const Eigen::VectorXd start = postureOf(model, "--start", options.start.empty() ? "file" : options.start);
  const Eigen::VectorXd goal = postureOf(model, "--goal", options.goal);
  PathProblem problem = asWrongUse(
      [&] { return robotProblem(model, contacts, start, goal, options.margin, options.resolution); });
  const auto requireFree = [&](const char* option, const Eigen::VectorXd& q) {
    if (problem.allValid(q)) return;
    throw UsageError({.what = option,
                      .found = harmless(problem.reason(q)),
                      .wanted = fmt::format("all shapes {:g} m apart, the --margin", options.margin)});
  };
  requireFree("--start", start);
  requireFree("--goal", goal);
  return problem;
}

BodyId drawnBody(const Model& model, const std::string& name) {
  if (name.empty()) return farthestBody(model);
  const BodyId body = asWrongUse([&] { return model.body(name); }, "--body: ");
  for (BodyId at = body; at != kWorld; at = model[at].parent)
    if (model[at].joint != kNoJoint && model[model[at].joint].nv > 0) return body;
  throw UsageError({.what = "--body", .found = "'" + harmless(name) + "', which no joint moves"});
}

void makeFolder(const fs::path& folder) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (!problem && fs::is_directory(folder)) return;
  throw UsageError({.what = "-o " + harmless(folder.string()),
                    .found = problem ? problem.message() : "a file",
                    .wanted = "a folder"});
}

// Searches with each seed. Only the shortest path keeps what was explored; of searches that found none, the
// first.
struct Searches {
  std::vector<FoundPath> all{};
  std::size_t best = 0;
  [[nodiscard]] const FoundPath& shortest() const { return all[best]; }
  [[nodiscard]] auto found() const { return std::ranges::count_if(all, &FoundPath::isFound); }
};

Searches runSearches(const Model& model, const ContactModel& contacts, const PathProblem& problem,
                     const PathSearch& search, const PlanOptions& options) {
  Searches searches;
  for (int i = 0; i < options.seeds; ++i) {
    const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(i);
    searches.all.push_back(
        asWrongUse([&] { return searchPath(model, contacts, problem, search, seed); }));
    if (i == 0) continue;
    const FoundPath& last = searches.all.back();
    const FoundPath& best = searches.shortest();
    const bool isBetter = last.isFound() && (!best.isFound() || last.length < best.length);
    searches.all[isBetter ? searches.best : searches.all.size() - 1].explored.clear();
    if (isBetter) searches.best = searches.all.size() - 1;
  }
  return searches;
}

// What the files are made of.
struct Planned {
  const Model& model;
  const ContactModel& contacts;
  const PathProblem& problem;
  BodyId body;
  RenderPlan pictures;
  const PlanOptions& options;
  const FoundPath& found;

  [[nodiscard]] std::string title() const {
    return fmt::format("{}, {}, seed {}", model.name(), options.planner, found.seed);
  }
};

void writeExplored(const Planned& planned, const fs::path& out) {
  Picture picture = exploredPicture(planned.model, planned.problem, planned.body, planned.found);
  picture.captions.push_back(
      {.text = fmt::format("{}: {} nodes", harmless(planned.title()), planned.found.nodes)});
  RenderPlan plan = planned.pictures;
  plan.renderer.antiAliasing = AntiAliasing::kMsaa4;
  Studio studio(plan, bounds(picture));
  const Image image = studio.draw(picture);
  studio.requireSomethingSeen();
  writePng(image, out);
}

// The replay: no times of computing, so that the same input gives the same bytes.
void writePage(const Planned& planned, const MotionPictures& pictures, const Motion& motion,
               const fs::path& out) {
  const FoundPath& found = planned.found;
  Report report{.title = planned.title(),
                .film = pictures.film(),
                .view = planned.pictures.views.front().view.direction(),
                .figures = {{.figure = jointsFigure(planned.model, motion)}},
                .facts = {{"length", fmt::format("{:.4g}", found.length)},
                          {"margin", fmt::format("{:g} m", planned.options.margin)},
                          {"nodes", fmt::format("{}", found.nodes)},
                          {"configurations checked", fmt::format("{}", found.checks)}},
                .still = {.gl = planned.pictures.renderer.gl}};
  if (!planned.contacts.pairs().empty()) {
    report.figures.push_back(
        {clearanceFigure(planned.model, planned.contacts, motion, planned.options.margin)});
    report.facts.emplace_back("clearance", fmt::format("{:.4g} m", found.clearance));
  }
  for (ReportFigure& item : report.figures) item.figure.width = 560, item.figure.height = 360;
  writeReport(report, out);
}

void writeMotion(const Planned& planned, std::vector<std::string>& files) {
  const PlanOptions& options = planned.options;
  const Space& space = planned.problem.space;
  const auto timed = [&](double speed) {
    return timedPath(space, planned.found.path, speed, 1 / kFilmRate);
  };
  grading::writeTextFile(options.out / "path.csv", csvOf(planned.model, timed(options.speed)));
  files.push_back(shown(options.out / "path.csv"));
  if (options.noFilm) return;
  const double speed = std::max(options.speed, planned.found.length / kLongestFilm);
  if (speed > options.speed) note(fmt::format("the film is {:.3g} times as fast", speed / options.speed));
  const Motion motion = resampled(space, timed(speed), kFilmRate);
  std::vector<std::size_t> shownFrames(motion.postures.size());
  std::iota(shownFrames.begin(), shownFrames.end(), std::size_t{0});
  const MotionPictures pictures(planned.model, motion, shownFrames, {planned.model[planned.body].name},
                                harmless(planned.title()));
  files.push_back(shown(writeFilm(pictures, planned.pictures, options.out / "path.mp4")));
  writePage(planned, pictures, motion, options.out / "path.html");
  files.push_back(shown(options.out / "path.html"));
}

// What an earlier search left there must not pass for this one's.
std::vector<std::string> writeFiles(const Planned& planned) {
  const fs::path& out = planned.options.out;
  for (const char* name : {"path.csv", "tree.png", "path.mp4", "path.html"}) fs::remove(out / name);
  writeExplored(planned, out / "tree.png");
  std::vector<std::string> files = {shown(out / "tree.png")};
  if (planned.found.isFound()) writeMotion(planned, files);
  return files;
}

Json jsonOf(const FoundPath& found) {
  Json json{{"seed", found.seed},
            {"found", found.isFound()},
            {"samples", found.samples},
            {"nodes", found.nodes},
            {"checks", found.checks},
            {"planning_seconds", found.planningTime},
            {"smoothing_seconds", found.smoothingTime}};
  if (!found.isFound()) return json;
  json["planned_length"] = found.plannedLength;
  json["length"] = found.length;
  json["clearance"] = std::isfinite(found.clearance) ? Json(found.clearance) : Json();
  return json;
}

void sayJson(const Planned& planned, const Searches& searches, const std::vector<std::string>& files) {
  const PlanOptions& options = planned.options;
  Json runs = Json::array();
  for (const FoundPath& found : searches.all) runs.push_back(jsonOf(found));
  Json json{{"scene", planned.model.name()},  {"planner", options.planner},
            {"margin", options.margin},       {"resolution", options.resolution},
            {"found", searches.found()},      {"runs", runs},
            {"seed", Json()},                 {"path", Json::array()},
            {"files", files}};
  if (planned.found.isFound()) {
    json["seed"] = planned.found.seed;
    json["path"] = jsonOfRows(planned.found.path.transpose());
  }
  say(dump(json));
}

std::string metres(double clearance) {
  return std::isfinite(clearance) ? fmt::format("{:.4f} m", clearance) : "nothing can collide";
}

void sayOne(const Planned& planned) {
  const FoundPath& found = planned.found;
  say(fmt::format("{}: {}", harmless(planned.title()), found.isFound() ? "found a path" : found.message));
  say(fmt::format("explored    {} nodes of {} samples; {} configurations checked", found.nodes, found.samples,
                  found.checks));
  say(fmt::format("CPU time    {:.1f} ms for planning{}", 1e3 * found.planningTime,
                  found.isFound() ? fmt::format(", {:.1f} ms for smoothing", 1e3 * found.smoothingTime) : ""));
  if (!found.isFound()) return;
  say(fmt::format("length      {:.3f}, before smoothing {:.3f}; {:.1f} s at a speed of {:g}", found.length,
                  found.plannedLength, found.length / planned.options.speed, planned.options.speed));
  say(fmt::format("clearance   {} all along the path; margin {:g} m", metres(found.clearance),
                  planned.options.margin));
}

void sayTable(const Planned& planned, const Searches& searches) {
  const std::vector<FoundPath>& all = searches.all;
  say(fmt::format("{}, {}, seeds {} to {}: {} of {} found a path", harmless(planned.model.name()),
                  planned.options.planner, all.front().seed, all.back().seed, searches.found(), all.size()));
  say(fmt::format("{:24} {:>10} {:>10} {:>10}", "", "min", "median", "max"));
  const auto row = [&](const char* name, const std::function<double(const FoundPath&)>& value,
                       bool ofPaths = false) {
    std::vector<double> values;
    for (const FoundPath& found : all)
      if (found.isFound() || !ofPaths) values.push_back(value(found));
    if (values.empty()) return;
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    const double median = values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
    say(fmt::format("{:24} {:>10.5g} {:>10.5g} {:>10.5g}", name, values.front(), median, values.back()));
  };
  row("nodes", [](const FoundPath& found) { return found.nodes; });
  row("configurations checked", [](const FoundPath& found) { return static_cast<double>(found.checks); });
  row("planning, CPU ms", [](const FoundPath& found) { return 1e3 * found.planningTime; });
  row("smoothing, CPU ms", [](const FoundPath& found) { return 1e3 * found.smoothingTime; }, true);
  row("length", [](const FoundPath& found) { return found.length; }, true);
  row("clearance, m", [](const FoundPath& found) { return found.clearance; }, true);
  if (planned.found.isFound()) say(fmt::format("files: seed {}, the shortest path", planned.found.seed));
}

// Between postures that were checked a robot may come nearer to things.
bool isClear(const FoundPath& found) {
  if (found.clearance > 0) return true;
  note(wrap(fmt::format("seed {}: the path is not clear between the postures that were checked; give a finer "
                        "--resolution or a larger --margin",
                        found.seed),
            2, 0));
  return false;
}

}  // namespace

ExitCode planPath(const Project& project, const PlanOptions& options) {
  RenderOptions filmOptions = options.film;
  filmOptions.out = options.out / "path.mp4";
  const RenderPlan pictures = planOf(filmOptions);
  const PathSearch search = searchOf(options);
  const Model model = loadScene(project, options.scene);
  if (model.nv() == 0) throw UsageError({.what = model.name(), .found = "no joint that moves"});
  if (!options.noFilm) requireFilmable(model);
  const BodyId body = drawnBody(model, options.body);
  const ContactModel contacts = asWrongUse([&] { return ContactModel(model); });
  if (contacts.pairs().empty()) note(model.name() + ": no two shapes may collide, so all ways are free");
  const PathProblem problem = problemOf(model, contacts, options);
  makeFolder(options.out);

  const Searches searches = runSearches(model, contacts, problem, search, options);
  const Planned planned{model, contacts, problem, body, pictures, options, searches.shortest()};
  const std::vector<std::string> files = writeFiles(planned);
  if (options.json) {
    sayJson(planned, searches, files);
  } else {
    options.seeds == 1 ? sayOne(planned) : sayTable(planned, searches);
    for (const std::string& file : files) say(file);
  }
  if (!planned.found.isFound()) return ExitCode::kBelow;
  return isClear(planned.found) ? ExitCode::kFull : ExitCode::kBelow;
}

}  // namespace rex::cli
