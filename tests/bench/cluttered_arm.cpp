#include "bench/cluttered_arm.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/rng.h"
#include "collision/proximity.h"
#include "geometry/rotation.h"
#include "kinematics/jacobians.h"
#include "scene/ors_reader.h"
#include "support/paths.h"
#include "trajectory/contact_terms.h"
#include "trajectory/motion_terms.h"
#include "trajectory/task_terms.h"

namespace rex::bench {
namespace {

constexpr int kSteps = 100, kObstacles = 5;
constexpr double kMargin = 0.05;

// The smallest distance of all pairs, metres.
double clearance(const Model& model, const ContactModel& contacts, const Eigen::VectorXd& q) {
  const BodyPoses poses = forwardKinematics(model, q);
  double smallest = INFINITY;
  for (const ShapePair& pair : contacts.pairs()) {
    const auto placed = [&](int i) -> std::pair<const Shape&, Pose> {
      const ModelShape& at = model.shapes()[static_cast<std::size_t>(i)];
      return {at.shape, poses[at.body] * at.X_BS};
    };
    const auto [a, X_WA] = placed(pair.a);
    const auto [b, X_WB] = placed(pair.b);
    smallest = std::min(smallest, proximity(a, X_WA, b, X_WB).distance);
  }
  return smallest;
}

Model armAmong(const std::vector<ShapeSpec>& obstacles) {
  SceneSpec spec = readOrs(sourcePath("data/robots/arm7.ors")).spec;
  spec.worldShapes.insert(spec.worldShapes.end(), obstacles.begin(), obstacles.end());
  return compile(spec);
}

ShapeSpec obstacleAt(const Eigen::Vector3d& p_W, int k, Rng& rng) {
  ShapeSpec one{
      .name = "obstacle" + std::to_string(k), .X_BS = {expSO3(rng.normalVector(3)), p_W}, .shape = {}};
  if (k % 2 == 0)
    one.shape = {.type = ShapeType::kSphere, .radius = rng.uniform(0.05, 0.12)};
  else
    one.shape = {.type = ShapeType::kBox, .extent = rng.uniformVector(3, 0.08, 0.2)};
  one.contact = true;
  return one;
}

TrajectoryProblem problemOf(const Model& model, const ContactModel& contacts, const ClutteredTask& task) {
  std::vector<TrajectoryTerm> terms = restAt(task.to, kSteps);
  terms.push_back(accelerationTerm());
  terms.push_back(jointLimitsTerm(model));
  terms.push_back(clearanceTerm(model, contacts, {.margin = kMargin, .samples = 1}));
  return {terms, task.from.replicate(1, 2), kSteps, 1. / kSteps};
}

std::array<Eigen::MatrixXd, 3> startsOf(const ClutteredTask& task, Rng& rng) {
  std::array<Eigen::MatrixXd, 3> starts;
  starts.fill(straightTrajectory(task.from, task.to, kSteps));
  for (const std::size_t bent : {1u, 2u}) {
    const Eigen::VectorXd bend = 0.5 * rng.normalVector(static_cast<int>(task.from.size()));
    for (int t = 0; t < kSteps; ++t)
      starts[bent].col(t) += std::sin(std::numbers::pi * (t + 1) / kSteps) * bend;
  }
  return starts;
}

}  // namespace

ClutteredTask randomClutteredTask(Rng& rng) {
  const Model alone = armAmong({});
  for (;;) {
    ClutteredTask task{
        rng.uniformVector(alone.nq(), -1.2, 1.2), rng.uniformVector(alone.nq(), -1.2, 1.2), {}};
    const Eigen::VectorXd middle = (task.from + task.to) / 2;
    for (int k = 0; k < kObstacles; ++k) {
      const Eigen::VectorXd q = k == 0 ? middle : rng.uniformVector(alone.nq(), -1.2, 1.2);
      const Eigen::Vector3d tip = position(forwardKinematics(alone, q), alone.body("arm7"), {0, 0, 0.2});
      task.obstacles.push_back(obstacleAt(tip, k, rng));
    }
    const Model model = armAmong(task.obstacles);
    const ContactModel contacts(model);
    if (clearance(model, contacts, task.from) > 1.5 * kMargin &&
        clearance(model, contacts, task.to) > 1.5 * kMargin && clearance(model, contacts, middle) < 0)
      return task;
  }
}

ClutteredArm::ClutteredArm(ClutteredTask given, Rng& rng)
    : task(std::move(given)),
      model(armAmong(task.obstacles)),
      contacts(model),
      problem(problemOf(model, contacts, task)),
      starts(startsOf(task, rng)) {}

TrajectoryResult solve(const ClutteredArm& arm, const Eigen::MatrixXd& start) {
  return optimizeTrajectory(arm.problem, start,
                            {.tolerance = 1e-6, .stationarity = 1e-4, .penalty = 1e4, .maxIterations = 300});
}

bool isRight(const ClutteredArm& arm, const TrajectoryResult& result) {
  if (result.solution.status != ConstrainedStatus::kSolved) return false;
  Eigen::MatrixXd path(arm.task.from.size(), result.X.cols() + 1);
  path << arm.task.from, result.X;
  return trajectoryClearance(arm.model, arm.contacts, path, 1e-3).distance > 0;
}

}  // namespace rex::bench
