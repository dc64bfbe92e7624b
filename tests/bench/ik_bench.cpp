#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "base/rng.h"
#include "bench/ik_boxes.h"
#include "bench/ik_peer.h"
#include "bench/row.h"
#include "geometry/rotation.h"
#include "kinematics/closed_form_arm.h"
#include "kinematics/inverse_kinematics_solver.h"
#include "kinematics/task_maps.h"
#include "scene/urdf_reader.h"
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

IkPeer::Solve ours(const std::shared_ptr<ReachableRobot>& robot) {
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
Measurement missedShare(const std::shared_ptr<ReachableRobot>& robot, const IkPeer::Solve& solve) {
  if (!solve) return {};
  return [=] {
    double missed = 0;
    for (std::size_t k = 0; k < kPoses; ++k) missed += isSolved(*robot, solve(k), k) ? 0 : 1;
    return missed / static_cast<double>(kPoses);
  };
}

Measurement meanTime(const IkPeer::Solve& solve) {
  if (!solve) return {};
  const Measurement all = timed([=] {
    for (std::size_t k = 0; k < kTimedPoses; ++k) static_cast<void>(solve(k));
  });
  return [=] { return all() / static_cast<double>(kTimedPoses); };
}

void addRows(const std::shared_ptr<ReachableRobot>& robot, std::vector<Row>& rows) {
  constexpr double kTimeLimit = 1e-4, kMissedLimit = 1e-3;
  const IkPeer kdl = kdlIkPeer(*robot);
  const Measurement time = meanTime(ours(robot)), missed = missedShare(robot, ours(robot));
  const std::string on = robot->name;
  rows.push_back({"ik-" + on, time, "limit", [] { return kTimeLimit; }, 1, "us"});
  rows.push_back({"ik-" + on + "-lma", time, "KDL", meanTime(kdl.levenbergMarquardt), {}, "us", 3});
  rows.push_back({"ik-" + on + "-nr", time, "KDL", meanTime(kdl.newtonWithLimits), {}, "us", 3});
  rows.push_back({"ik-" + on + "-missed", missed, "limit", [] { return kMissedLimit; }, 1, "%", 1});
  rows.push_back(
      {"ik-" + on + "-missed-lma", missed, "KDL", missedShare(robot, kdl.levenbergMarquardt), {}, "%", 1});
  rows.push_back(
      {"ik-" + on + "-missed-nr", missed, "KDL", missedShare(robot, kdl.newtonWithLimits), {}, "%", 1});
}

// A chain of six hinges along or across each other, with a tip.
std::string sixHinges(const std::array<const char*, 6>& origins, const std::array<const char*, 6>& axes) {
  std::string urdf = "<robot name='arm'><link name='l0'/>";
  for (std::size_t i = 0; i < 6; ++i)
    urdf += fmt::format(
        "<link name='l{1}'/><joint name='j{1}' type='revolute'><parent link='l{0}'/><child link='l{1}'/>"
        "<origin xyz='{2}'/><axis xyz='{3}'/><limit lower='-3.1' upper='3.1' effort='1' "
        "velocity='1'/></joint>",
        i, i + 1, origins[i], axes[i]);
  return urdf + "</robot>";
}

// All postures of an arm in closed form: the mean over poses.
Row closedFormRow(const std::string& name, const std::string& urdf) {
  const auto model = std::make_shared<const Model>(compile(parseUrdf(urdf, name + ".urdf").spec));
  const auto arm =
      std::make_shared<const ClosedFormArm>(ClosedFormArm::of(*model, model->body("l6")).value());
  const auto targets = std::make_shared<std::vector<Pose>>();
  Rng rng(1);
  Eigen::VectorXd q(6);
  for (std::size_t k = 0; k < kTimedPoses; ++k) {
    for (double& angle : q) angle = rng.uniform(-3, 3);
    targets->push_back(forwardKinematics(*model, q)[model->body("l6")]);
    double nearest = 1;
    for (const ClosedFormPosture& one : arm->postures(targets->back(), q))
      nearest = std::min(nearest, (one.q - q).lpNorm<Eigen::Infinity>());
    if (nearest > 1e-6) throw std::logic_error("a posture is missing");
  }
  const Measurement all = timed([=] {
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(6);
    for (const Pose& X_WT : *targets) static_cast<void>(arm->postures(X_WT, zero));
  });
  return {name, [=] { return all() / kTimedPoses; }, "limit", [] { return 6e-6; }, 1, "us"};
}

// A posture free of contact for each pose. All answers are checked first, and each counts that is wrong or
// missing.
void addRowsAmongBoxes(std::vector<Row>& rows) {
  const auto problem = std::make_shared<const IkAmongBoxes>(static_cast<int>(kTimedPoses));
  double missed = 0;
  for (std::size_t k = 0; k < kTimedPoses; ++k) {
    const InverseKinematicsResult found = solve(*problem, k);
    const bool isSolved = found.status == InverseKinematicsResult::Status::kSolved;
    if (isSolved && !isRight(*problem, k, found.q)) throw std::logic_error("a posture that is none");
    missed += isSolved ? 0 : 1. / kTimedPoses;
  }
  const Measurement all = timed([=] {
    for (std::size_t k = 0; k < kTimedPoses; ++k) static_cast<void>(solve(*problem, k));
  });
  rows.push_back({.name = "ik-boxes", .ours = [=] { return all() / kTimedPoses; }, .unit = "us"});
  rows.push_back({.name = "ik-boxes-missed", .ours = [=] { return missed; }, .unit = "%", .repetitions = 1});
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
  addRowsAmongBoxes(rows);
  const char *x = "1 0 0", *y = "0 1 0", *z = "0 0 1", *none = "0 0 0";
  rows.push_back(closedFormRow(
      "ik-6r-wrist",
      sixHinges({none, ".35 0 .7", "0 0 1.1", ".5 0 -.04", ".7 0 0", none}, {z, y, y, x, y, x})));
  rows.push_back(closedFormRow("ik-6r-parallel", sixHinges({"0 0 .0892", "0 .1358 0", "0 -.1197 .425",
                                                            "0 0 .3922", "0 .093 0", "0 0 .0946"},
                                                           {z, y, y, y, z, y})));
  return rows;
}

}  // namespace rex::bench
