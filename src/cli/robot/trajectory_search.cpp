#include "cli/robot/trajectory_search.h"

#include <ctime>

#include "kinematics/jacobians.h"
#include "kinematics/task_maps.h"
#include "trajectory/motion_terms.h"
#include "trajectory/task_terms.h"

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

}  // namespace rex::cli
