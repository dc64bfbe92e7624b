#include <algorithm>
#include <filesystem>
#include <memory>

#include "base/rng.h"
#include "bench/ik_peer.h"
#include "bench/row.h"
#include "formats/urdf_reader.h"
#include "geometry/rotation.h"
#include "kinematics/inverse_kinematics_solver.h"
#include "kinematics/task_maps.h"
#include "support/file_text.h"
#include "support/paths.h"

namespace rex::bench {
namespace {

constexpr double kTolerance = 1e-5;  // on each of six numbers, metres and radians
constexpr std::size_t kPoses = 10000, kTimedPoses = 1000;

std::shared_ptr<ReachableRobot> reachableRobot(const std::string& name, const std::filesystem::path& urdf,
                                               const std::string& tip) {
  Model model = compile(parseUrdf(fileText(urdf), urdf.filename().string()).spec);
  const Eigen::VectorXd lower = model.lowerLimits(), upper = model.upperLimits();
  const BodyId body = model.body(tip);
  const auto robot = std::make_shared<ReachableRobot>(
      ReachableRobot{name, std::move(model), body, 0.5 * (lower + upper), {}});
  Rng rng(1);
  Eigen::VectorXd q(lower.size());
  for (std::size_t k = 0; k < kPoses; ++k) {
    for (Eigen::Index i = 0; i < q.size(); ++i) q[i] = rng.uniform(lower[i], upper[i]);
    robot->targets.push_back(forwardKinematics(robot->model, q)[body]);
  }
  return robot;
}

SolveIk ours(const std::shared_ptr<ReachableRobot>& robot) {
  return [robot](std::size_t k) {
    const Task task{.name = "tip", .map = poseTask(robot->tip, robot->targets[k]), .tolerance = kTolerance};
    Rng rng(k);
    return solveInverseKinematics(robot->model, std::span(&task, 1), robot->middle, {}, rng).q;
  };
}

// By its pose alone: a posture beyond the limits counts for a peer that knows none.
bool isSolved(const ReachableRobot& robot, const Eigen::VectorXd& q, std::size_t k) {
  const Pose &X_WT = robot.targets[k], X_WB = forwardKinematics(robot.model, q)[robot.tip];
  const double turn = logSO3(X_WB.R * X_WT.R.transpose()).lpNorm<Eigen::Infinity>();
  const double way = (X_WB.p - X_WT.p).lpNorm<Eigen::Infinity>();
  return std::max(turn, way) <= kTolerance * (1 + 1e-6);
}

// The share of all poses that a solver misses; measured like a time, in seconds that mean nothing.
Measurement missedShare(const std::shared_ptr<ReachableRobot>& robot, const SolveIk& solve) {
  if (!solve) return {};
  return [=] {
    double missed = 0;
    for (std::size_t k = 0; k < kPoses; ++k) missed += isSolved(*robot, solve(k), k) ? 0 : 1;
    return missed / static_cast<double>(kPoses);
  };
}

Measurement meanTime(const SolveIk& solve) {
  if (!solve) return {};
  const Measurement all = timed([=] {
    for (std::size_t k = 0; k < kTimedPoses; ++k) static_cast<void>(solve(k));
  });
  return [=] { return all() / static_cast<double>(kTimedPoses); };
}

void addRows(const std::shared_ptr<ReachableRobot>& robot, std::vector<Row>& rows) {
  constexpr double kTimeLimit = 1e-4, kMissedLimit = 1e-3;
  const SolveIk kdl = kdlMarquardt(*robot);
  const Measurement time = meanTime(ours(robot)), missed = missedShare(robot, ours(robot));
  const std::string on = robot->name;
  rows.push_back({"ik-" + on, time, "limit", [] { return kTimeLimit; }, 1, "us"});
  rows.push_back({"ik-" + on + "-lma", time, "KDL", meanTime(kdl), {}, "us", 3});
  rows.push_back({"ik-" + on + "-missed", missed, "limit", [] { return kMissedLimit; }, 1, "%", 1});
  rows.push_back({"ik-" + on + "-missed-lma", missed, "KDL", missedShare(robot, kdl), {}, "%", 1});
}

}  // namespace

// Poses that random postures within the limits reach, from the middle of all joints. The first robot is not
// ours to ship.
std::vector<Row> ikRows() {
  std::vector<Row> rows;
  const std::filesystem::path panda = sharedPath("data/urdf/panda_arm_hand.urdf");
  if (std::filesystem::exists(panda)) {
    addRows(reachableRobot("panda", panda, "panda_hand"), rows);
  } else {
    rows.push_back({.name = "ik-panda", .peerName = "no " + panda.filename().string(), .unit = "us"});
  }
  addRows(reachableRobot("arm7dof", sourcePath("data/robots/arm7dof/arm7dof.urdf"), "flange"), rows);
  return rows;
}

}  // namespace rex::bench
