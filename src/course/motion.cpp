#include "course/motion.h"

#include <cmath>
#include <ctime>

#include <fmt/format.h>

#include "base/require.h"
#include "base/rng.h"
#include "collision/contacts.h"
#include "course/recording.h"
#include "planning/path_spline.h"
#include "planning/robot_problem.h"
#include "planning/rrt.h"
#include "planning/time_parametrization.h"
#include "scene/model.h"

namespace rex {
namespace {

double processorTime() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::string exploredBy(const PathResult& found, const MoveOptions& options, bool isTimeUp) {
  Eigen::Index nodes = 0;
  for (const PathTree& tree : found.trees) nodes += tree.nodes.cols();
  const std::string limit = isTimeUp ? fmt::format(" within {:g} s", options.timeLimit) : "";
  return fmt::format("{}{}: {} nodes of {} samples explored", found.message, limit, nodes, found.samples);
}

void follow(Simulator& simulator, const TimedPath& motion, const Eigen::VectorXd& goal) {
  simulator.setJointAngles(simulator.getJointAngles());  // the first one of a recording replaces its start
  const int steps = std::max(1, static_cast<int>(std::ceil(motion.duration() * Recording::kRate - 1e-9)));
  const double tau = motion.duration() / steps;
  if (!(tau > 0)) return simulator.setJointAngles(goal);
  for (int i = 1; i < steps; ++i) simulator.setJointAngles(motion.at(i * tau).q, tau);
  simulator.setJointAngles(goal, tau);
}

}  // namespace

Move moveTo(Simulator& simulator, const Eigen::VectorXd& goal, const MoveOptions& options) {
  constexpr double kResolution = 0.02, kStep = 0.3, kChordTolerance = 5e-5;
  constexpr int kShortcuts = 200;
  requirePositive("moveTo: clearance", options.clearance, kMetres);
  requirePositive("moveTo: time limit", options.timeLimit, kSeconds);
  const Model& model = simulator.model();
  requireSize("moveTo: goal", goal.size(), model.nq());
  const ContactModel contacts(model);
  PathProblem problem =
      robotProblem(model, contacts, simulator.getJointAngles(), goal, options.clearance, kResolution);
  const double begin = processorTime();
  bool isTimeUp = false;
  problem.isTimeUp = [&] { return isTimeUp = isTimeUp || processorTime() - begin > options.timeLimit; };
  Rng rng(options.seed);
  const PathResult found = connectRrts(problem, {.stepSize = kStep}, rng);
  Move move{.message = exploredBy(found, options, isTimeUp)};
  if (found.status != PathStatus::kFound) return move;
  const PathCurve curve = smoothCurve(problem, found.path, kShortcuts, rng);
  move.clearance = pathClearance(model, contacts, problem.space, sampled(curve, kChordTolerance)).atLeast;
  if (!(move.clearance > 0)) {
    move.message +=
        "; it is not proven that shapes stay apart between the postures that were checked: use a "
        "larger clearance";
    return move;
  }
  const TimingResult timing =
      parametrizeTime(curve, jointLimits(model, {.velocity = options.velocity, .ramp = options.ramp}).limits);
  if (timing.status != TimingStatus::kFound) {
    move.message += "; " + timing.message;
    return move;
  }
  move.isFound = true;
  move.duration = timing.motion.duration();
  follow(simulator, timing.motion, goal);
  return move;
}

}  // namespace rex
