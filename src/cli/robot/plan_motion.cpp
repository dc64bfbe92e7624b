#include <algorithm>
#include <cmath>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/numbers.h"
#include "cli/option_table_internal.h"
#include "cli/results_internal.h"
#include "cli/robot/motion_files.h"
#include "cli/robot/path_results.h"
#include "cli/robot/path_search.h"
#include "cli/robot/plan.h"
#include "cli/robot/posture_option.h"
#include "cli/robot/scene_option.h"
#include "kinematics/jacobians.h"
#include "kinematics/task_maps.h"
#include "planning/robot_problem.h"
#include "trajectory/motion_terms.h"

// `rex plan --planner optimize`: motions with little acceleration.

namespace rex::cli {

namespace {

constexpr int kMostSamples = 16;
constexpr double kNearEnough = 1e-4;  // metres

std::vector<TrajectoryTerm> termsOf(const TrajectoryTask& task, int samples) {
  const int last = task.steps - 1;
  const Task goal{.name = "goal", .map = positionTask(task.body), .target = task.p_WQ};
  TrajectoryTerm rest = at(as(TermKind::kEquality, velocityTerm()), last);
  rest.name = "rest at the goal";
  std::vector<TrajectoryTerm> terms{accelerationTerm(), jointLimitsTerm(task.model), rest,
                                    at(as(TermKind::kEquality, taskTerm(task.model, goal)), last)};
  if (samples > 0)
    terms.push_back(clearanceTerm(task.model, task.contacts, {.margin = task.margin, .samples = samples}));
  return terms;
}

// Optimizes and appends to the log.
void optimize(const TrajectoryTask& task, int samples, Eigen::MatrixXd& X, FoundTrajectory& found) {
  const TrajectoryProblem problem(termsOf(task, samples), task.start.replicate(1, 2), task.steps, found.tau);
  TrajectoryResult result = optimizeTrajectory(
      problem, X, {.method = task.method, .tolerance = 1e-6, .stationarity = 1e-4, .penalty = 1e4});
  X = result.X;
  std::vector<ConstrainedIteration> log = std::move(found.solution.log);
  log.insert(log.end(), result.solution.log.begin(), result.solution.log.end());
  found.solution = std::move(result.solution);
  found.solution.log = std::move(log);
  found.samples = samples;
  found.path.resize(task.start.size(), task.steps + 1);
  found.path << task.start, X;
}

}  // namespace

FoundTrajectory findTrajectory(const TrajectoryTask& task) {
  const std::clock_t begin = std::clock();
  FoundTrajectory found{.tau = task.seconds / task.steps};
  Eigen::MatrixXd X = task.start.replicate(1, task.steps);
  optimize(task, 0, X, found);
  const auto clearance = [&] {
    return trajectoryClearance(task.model, task.contacts, found.path, kNearEnough);
  };
  found.clearance = clearance();
  for (int samples = 1; task.avoids && found.isSolved() && samples <= kMostSamples; samples *= 2) {
    optimize(task, samples, X, found);
    found.clearance = clearance();
    if (found.clearance.distance > 0) break;
  }
  const BodyPoses poses = forwardKinematics(task.model, found.path.rightCols<1>());
  found.error = (position(poses, task.body, Eigen::Vector3d::Zero()) - task.p_WQ).norm();
  found.cpuTime = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  return found;
}

namespace {

ConstraintMethod methodOf(Planner planner) {
  return planner == Planner::kOptimizePenalty   ? ConstraintMethod::kSquaredPenalty
         : planner == Planner::kOptimizeBarrier ? ConstraintMethod::kLogBarrier
                                                : ConstraintMethod::kAugmentedLagrangian;
}

std::pair<BodyId, Eigen::Vector3d> goalOf(const Model& model, const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos)
    throw UsageError(
        {.what = "--goal", .found = "'" + escapeForTerminal(text) + "'", .wanted = "BODY:x,y,z"});
  const BodyId body = asWrongUse([&] { return model.body(text.substr(0, colon)); }, "--goal: ");
  return {body, parsePoint(text.substr(colon + 1), "--goal", "BODY:x,y,z")};
}

TrajectoryTask motionTaskOf(Model model, const PlanOptions& options) {
  const auto [body, p_WQ] = goalOf(model, options.goal);
  ContactModel contacts = sceneContactModel(model);
  const Eigen::VectorXd start = postureWithinLimits(model, "--start", options.start);
  TrajectoryTask task{.model = std::move(model),
                      .contacts = std::move(contacts),
                      .body = body,
                      .p_WQ = p_WQ,
                      .start = start,
                      .avoids = options.avoid,
                      .margin = *options.margin,
                      .steps = options.steps,
                      .seconds = options.duration,
                      .method = methodOf(options.planner)};
  if (task.avoids && task.contacts.pairs().empty())
    note(escapeForTerminal(task.model.name()) + ": no two shapes may collide: there is nothing to avoid");
  task.avoids = task.avoids && !task.contacts.pairs().empty();
  if (task.avoids)
    requireClear("--start", task.start, task.model, task.contacts,
                 contactFree(task.model, task.contacts, task.margin), task.margin);
  return task;
}

Motion trajectoryMotion(const FoundTrajectory& found) {
  Motion motion;
  for (Eigen::Index k = 0; k < found.path.cols(); ++k) {
    motion.times.push_back(static_cast<double>(k) * found.tau);
    motion.postures.emplace_back(found.path.col(k));
  }
  return motion;
}

// Interpolates linearly between steps, with `rate` postures per second.
Motion filmOf(const FoundTrajectory& found, double rate) {
  Motion motion;
  const double end = static_cast<double>(found.path.cols() - 1) * found.tau;
  const int frames = std::max(1, static_cast<int>(std::lround(end * rate)));
  for (int i = 0; i <= frames; ++i) {
    const double time = end * i / frames, step = time / found.tau;
    const auto k = std::min(static_cast<Eigen::Index>(step), found.path.cols() - 2);
    const double share = step - static_cast<double>(k);
    motion.times.push_back(time);
    motion.postures.emplace_back((1 - share) * found.path.col(k) + share * found.path.col(k + 1));
  }
  return motion;
}

// Both fall over many powers of ten; zero is drawn at the bottom.
Figure costFigure(const FoundTrajectory& found) {
  constexpr double kFoot = 1e-12;
  Series cost{.label = "cost"}, violation{.label = "largest constraint violation"};
  for (std::size_t i = 0; i < found.solution.log.size(); ++i) {
    const ConstrainedIteration& one = found.solution.log[i];
    for (Series* series : {&cost, &violation}) series->x.push_back(static_cast<double>(i + 1));
    cost.y.push_back(std::max(one.cost, kFoot));
    violation.y.push_back(std::max(one.violation, kFoot));
  }
  return {.title = "costs",
          .xLabel = "Newton step",
          .yLabel = "cost, violation [1]",
          .logY = true,
          .series = {cost, violation}};
}

std::string titleOf(const TrajectoryTask& task) {
  return fmt::format("{}: {} to {:g}, {:g}, {:g}", escapeForTerminal(task.model.name()),
                     escapeForTerminal(task.model[task.body].name), task.p_WQ.x(), task.p_WQ.y(),
                     task.p_WQ.z());
}

void writeFiles(const TrajectoryTask& task, const PlanOptions& options, const RenderPlan& pictures,
                const FoundTrajectory& found, Results& results) {
  const Figure costs = costFigure(found);
  writeFigure(costs, results.file(options.out / "costs.png"));
  writeMotion({.model = task.model,
               .contacts = task.contacts,
               .body = task.body,
               .duration = task.seconds,
               .postures = [&](double rate) { return filmOf(found, rate); },
               .clearance = found.clearance.distance,
               .page = {.title = titleOf(task),
                        .figures = {{costs}},
                        .facts = {{"method", toString(task.method)},
                                  {"status", toString(found.solution.status)},
                                  {"cost", fmt::format("{:.6g}", found.solution.cost)},
                                  {"distance from the goal", fmt::format("{:.3g} m", found.error)},
                                  {"Newton steps", fmt::format("{}", found.solution.log.size())}}}},
              trajectoryMotion(found), options, pictures, results);
}

Results resultsOf(const TrajectoryTask& task, const FoundTrajectory& found) {
  const auto& [distance, step] = found.clearance;
  Results all{.json = {{"scene", task.model.name()},
                       {"body", task.model[task.body].name},
                       {"method", toString(task.method)},
                       {"status", toString(found.solution.status)},
                       {"message", found.solution.message},
                       {"cost", found.solution.cost},
                       {"violation", found.solution.violation},
                       {"most_violated", found.solution.mostViolated},
                       {"newton_steps", found.solution.log.size()},
                       {"cpu_seconds", found.cpuTime},
                       {"error", found.error},
                       {"clearance", distance},
                       {"tau", found.tau},
                       {"path", jsonOfRows(found.path.transpose())}}};
  all.line("{}\n{}", titleOf(task), found.solution.message);
  all.line("goal       {:.3g} m away at the end, after {:g} s in {} steps", found.error, task.seconds,
           task.steps);
  all.line("CPU time   {:.1f} ms, {} Newton steps", 1e3 * found.cpuTime, found.solution.log.size());
  if (!std::isfinite(distance))
    all.line("clearance  nothing can collide");
  else
    all.line("clearance  {}, nearest in step {}{}",
             distance > 0 ? fmt::format("{:.4f} m proven along the whole path", distance)
                          : fmt::format("none: shapes may overlap by {:.4f} m", -distance),
             step, task.avoids ? fmt::format(", margin {:g} m", task.margin) : "; nothing was avoided");
  return all;
}

}  // namespace

// Moves a body to a point with little acceleration.
ExitCode planMotion(const PlanOptions& options, const RenderPlan& pictures, Model model) {
  if (model.nq() != model.nv())
    throw UsageError(
        {.what = model.name(), .found = "joints with quaternions", .wanted = "hinges and sliders"});
  const TrajectoryTask task = motionTaskOf(std::move(model), options);
  makeResultFolder(options.out, {"costs.png", "path.csv", "path.mp4", "path.html"}, "path");

  const FoundTrajectory found = findTrajectory(task);
  Results results = resultsOf(task, found);
  writeFiles(task, options, pictures, found, results);
  results.print(options.json);
  if (found.isSolved() && task.avoids && found.clearance.distance <= 0)
    note("it is not proven that shapes stay apart between steps: use more --steps or a larger --margin");
  return found.isSolved() && !(task.avoids && found.clearance.distance <= 0) ? ExitCode::kFull
                                                                             : ExitCode::kBelow;
}

}  // namespace rex::cli
