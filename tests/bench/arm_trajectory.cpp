#include "bench/arm_trajectory.h"

#include <stdexcept>

#include "formats/ors_reader.h"
#include "kinematics/jacobians.h"
#include "support/paths.h"
#include "trajectory/motion_terms.h"

namespace rex::bench {
namespace {

constexpr double kMargin = 0.05, kBall = 0.12;
const Eigen::Vector3d kTip(0, 0, 0.2);  // of the last link

Eigen::VectorXd from() { return Eigen::VectorXd::Constant(7, 0.3); }
Eigen::VectorXd to() { return (Eigen::VectorXd(7) << 1.2, 0.6, -0.2, 0.8, 0.1, 0.7, 0.3).finished(); }

Model armModel(bool hasObstacle) {
  SceneSpec spec = readOrs(sourcePath("data/robots/arm7.ors")).spec;
  if (!hasObstacle) return compile(spec);
  const Model arm = compile(spec);
  const BodyPoses poses = forwardKinematics(arm, (from() + to()) / 2);
  const Eigen::Vector3d middle = position(poses, arm.body("arm7"), kTip);
  ShapeSpec ball{.name = "obstacle", .X_BS = {}, .shape = {.type = ShapeType::kSphere, .radius = kBall}};
  ball.X_BS.p = middle + Eigen::Vector3d(0.03, 0.02, 0.05);
  ball.contact = true;
  spec.worldShapes.push_back(ball);
  return compile(spec);
}

TrajectoryProblem problemOf(const Model& model, int steps, bool hasObstacle) {
  std::vector<TrajectoryTerm> terms = restTerms(to(), steps);
  terms.push_back(accelerationTerm());
  terms.push_back(jointLimitsTerm(model));
  if (hasObstacle)
    terms.push_back(clearanceTerm(model, ContactModel(model), {.margin = kMargin, .samples = 1}));
  return {terms, from().replicate(1, 2), steps, 1. / steps};
}

}  // namespace

ArmTrajectory::ArmTrajectory(int steps, bool obstacle)
    : hasObstacle(obstacle),
      model(armModel(hasObstacle)),
      problem(problemOf(model, steps, hasObstacle)),
      start(straightTrajectory(from(), to(), steps)) {}

TrajectoryResult solve(const ArmTrajectory& arm) {
  // A stiff penalty has the ends within their tolerance after one round. It would make the way round an
  // obstacle narrow.
  const double penalty = arm.hasObstacle ? 1e4 : 1e5;
  TrajectoryResult result = optimizeTrajectory(arm.problem, arm.start,
                                               {.tolerance = 1e-6, .stationarity = 1e-4, .penalty = penalty});
  if (result.solution.status != ConstrainedStatus::kSolved) throw std::logic_error(result.solution.message);
  return result;
}

}  // namespace rex::bench
