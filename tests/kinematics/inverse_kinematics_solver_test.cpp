#include "kinematics/inverse_kinematics_solver.h"

#include <cmath>
#include <filesystem>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "formats/ors_reader.h"
#include "formats/scene_file.h"
#include "formats/urdf_reader.h"
#include "kinematics/task_maps.h"
#include "scene/state.h"
#include "support/allocations.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/paths.h"
#include "support/random_scene.h"

namespace rex::inverse_kinematics_solver_test {

using Status = InverseKinematicsResult::Status;

InverseKinematicsResult solve(const Model& model, const std::vector<Task>& tasks,
                              const Eigen::VectorXd& start, const InverseKinematicsOptions& options = {},
                              std::uint64_t seed = 1) {
  Rng rng(seed);
  return solveInverseKinematics(model, tasks, start, options, rng);
}

bool isWithinLimits(const Model& model, const Eigen::VectorXd& q) {
  return (q.array() >= model.lowerLimits().array()).all() && (q.array() <= model.upperLimits().array()).all();
}

// Two links of lengths a and b in the plane z = 0.
Model planarArm(double a, double b, double limit = std::numbers::pi) {
  SceneSpec spec;
  for (const char* name : {"base", "upper", "lower"}) spec.bodies.push_back({.name = name, .X_WB = {}});
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  spec.joints.push_back(
      {.name = "shoulder", .parent = "base", .child = "upper", .X_PF = {}, .X_MC = {}, .axis = z});
  spec.joints.push_back({.name = "elbow",
                         .parent = "upper",
                         .child = "lower",
                         .X_PF = translation(a, 0, 0),
                         .X_MC = translation(b, 0, 0),
                         .axis = z});
  for (JointSpec& joint : spec.joints) {
    joint.lower = Eigen::VectorXd::Constant(1, -limit);
    joint.upper = Eigen::VectorXd::Constant(1, limit);
  }
  return compile(spec);
}

Task reach(const Model& model, const std::string& body, const Eigen::Vector3d& target) {
  return {.name = body, .map = positionTask(model.body(body)), .target = target, .tolerance = 1e-9};
}

TEST(SolveInverseKinematics, FindsThePosturesOfThePlanarArm) {
  const double a = 1, b = 0.7;
  const Model model = planarArm(a, b);
  Rng rng(1);
  for (int i = 0; i < 100; ++i) {
    const double distance = rng.uniform(0.35, 1.65), angle = rng.uniform(-1, 1);
    const Eigen::Vector3d target = distance * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
    const auto result = solve(model, {reach(model, "lower", target)}, rng.uniformVector(2, -1, 1));
    ASSERT_EQ(result.status, Status::kSolved) << result.message;
    // Law of cosines.
    const double elbow = std::acos((distance * distance - a * a - b * b) / (2 * a * b));
    EXPECT_NEAR(std::abs(result.q[1]), elbow, 1e-7);
    const double inner = std::atan2(b * std::sin(result.q[1]), a + b * std::cos(result.q[1]));
    EXPECT_NEAR(wrapAngle(result.q[0] - (angle - inner)), 0, 1e-7);
  }
}

TEST(SolveInverseKinematics, ReturnsTheNearestPointOfATargetOutOfReach) {
  const Model model = planarArm(1, 0.7);
  const Eigen::Vector3d target(3, 4, 0);
  const auto result = solve(model, {reach(model, "lower", target)}, Eigen::Vector2d(0, 1));
  EXPECT_EQ(result.status, Status::kUnreached);
  EXPECT_LT((result.q - Eigen::Vector2d(std::atan2(4., 3.), 0)).norm(), 1e-4);
  ASSERT_EQ(result.residuals.size(), 1u);
  EXPECT_NEAR(result.residuals[0], 4 - 0.8 * 1.7, 1e-6);
  EXPECT_NEAR(result.cost, 3.3 * 3.3, 1e-9);
  EXPECT_EQ(result.restarts, 50);
  EXPECT_THAT(result.message, testing::StartsWith("task 'lower' misses its target by 2.64 after "));
  EXPECT_THAT(result.message, testing::EndsWith(" and 50 restarts"));
}

TEST(SolveInverseKinematics, StopsExactlyAtLimits) {
  const Model model = planarArm(1, 1, 0.5);
  const auto result = solve(model, {reach(model, "lower", {-1, 1, 0})}, Eigen::Vector2d(0.1, 0.1));
  EXPECT_EQ(result.status, Status::kUnreached);
  EXPECT_EQ(result.q, Eigen::Vector2d(0.5, 0.5));
  // A start beyond the limits is moved into them; what lies on a limit is reached.
  const Eigen::VectorXd corner = Eigen::Vector2d(0.5, -0.5);
  const Eigen::Vector3d target = forwardKinematics(model, corner)[model.body("lower")].p;
  const auto found = solve(model, {reach(model, "lower", target)}, Eigen::Vector2d(3, -3));
  EXPECT_EQ(found.status, Status::kSolved) << found.message;
  EXPECT_TRUE(isWithinLimits(model, found.q));
}

// A step that a limit cuts short must not look like the end: where a start ends, the slope vanishes but for
// what leads beyond limits.
TEST(SolveInverseKinematics, IsNotHeldUpByALimitNearby) {
  const double limit = 2;
  const Model model = planarArm(1, 0.7, limit);
  Rng rng(9);
  int unreached = 0;
  for (const double gap : {0., 1e-15, 1e-12, 1e-9, 1e-7, 3e-7, 1e-6}) {
    for (int i = 0; i < 300; ++i) {
      const Eigen::VectorXd goal = rng.uniformVector(2, -limit, limit);
      Eigen::VectorXd start = rng.uniformVector(2, -limit, limit);
      start[rng.index(2)] = rng.index(2) == 0 ? gap - limit : limit - gap;
      const std::vector<Task> tasks{
          reach(model, "lower", forwardKinematics(model, goal)[model.body("lower")].p)};
      const auto result = solve(model, tasks, start, {.maxRestarts = 0});
      ASSERT_NE(result.status, Status::kIterationLimit) << result.message;
      if (result.status == Status::kSolved) continue;
      ++unreached;
      const TaskValue phi = stackTasks(tasks, {model, result.q, forwardKinematics(model, result.q)});
      const Eigen::VectorXd downhill = result.q - phi.J.transpose() * phi.y;
      EXPECT_LT((downhill.cwiseMax(-limit).cwiseMin(limit) - result.q).norm(), 1e-4) << gap << ", " << start;
    }
  }
  EXPECT_GT(unreached, 10);  // local minima
}

// The follower may move by half a metre, twice as far as what it follows.
TEST(SolveInverseKinematics, KeepsTheLimitsOfJointsThatMimic) {
  const Model model =
      compile(parseOrs("body a {}\nbody sled {}\nbody follower {}\n"
                       "joint rail (a sled) { type=transX limits=[-1 1] }\n"
                       "joint (a follower) { type=transX mimic=rail mimic_ratio=2 limits=[-.5 .5] }",
                       "f")
                  .spec);
  const auto result = solve(model, {reach(model, "sled", {0.9, 0, 0})}, Eigen::VectorXd::Zero(1));
  EXPECT_EQ(result.status, Status::kUnreached);
  EXPECT_EQ(forwardKinematics(model, result.q)[model.body("follower")].p.x(), 0.5);
  EXPECT_NEAR(result.residuals.at(0), 0.65, 1e-15);
}

// Random poses within reach, from the middle of all joints: the protocol of `rex dev bench ik`. Forward
// kinematics is the judge.
void expectSolvesPoses(const Model& model, BodyId tip, int count, int leastSolved) {
  Rng rng(7);
  const Eigen::VectorXd middle = 0.5 * (model.lowerLimits() + model.upperLimits());
  int solved = 0, restarts = 0;
  for (int i = 0; i < count; ++i) {
    Eigen::VectorXd q(model.nq());
    for (int k = 0; k < q.size(); ++k) q[k] = rng.uniform(model.lowerLimits()[k], model.upperLimits()[k]);
    const Pose X_WT = forwardKinematics(model, q)[tip];
    const Task task{.name = "tip", .map = poseTask(tip, X_WT), .tolerance = 1e-5};
    const auto result = solve(model, {task}, middle, {}, static_cast<std::uint64_t>(i));
    EXPECT_TRUE(isWithinLimits(model, result.q));
    restarts += result.restarts;
    if (result.status != Status::kSolved) continue;
    const Pose X_WB = forwardKinematics(model, result.q)[tip];
    EXPECT_LE((X_WB.p - X_WT.p).cwiseAbs().maxCoeff(), 1e-5);
    EXPECT_LE(logSO3(X_WB.R * X_WT.R.transpose()).cwiseAbs().maxCoeff(), 1.001e-5);
    ++solved;
  }
  EXPECT_GE(solved, leastSolved);
  EXPECT_GT(restarts, 0);  // some starts fail, and others help
}

TEST(SolveInverseKinematics, SolvesPosesOfTheArm) {
  const Model model = compile(readScene(sourcePath("data/robots/arm7dof/arm7dof.urdf")).spec);
  expectSolvesPoses(model, model.body("flange"), 400, 400);
}

TEST(SolveInverseKinematics, SolvesPosesOfThePanda) {
  const std::filesystem::path file = sharedPath("data/urdf/panda_arm_hand.urdf");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const Model model = compile(parseUrdf(fileText(file), "panda_arm_hand.urdf").spec);
  expectSolvesPoses(model, model.body("panda_hand"), 400, 400);
}

// A tree of every joint type, quaternions among them; joints without limits.
TEST(SolveInverseKinematics, SolvesWithEveryJointType) {
  Rng rng(8);
  for (int i = 0; i < 20; ++i) {
    const Model model = compile(randomScene(rng, 13));
    const Eigen::VectorXd goal = randomPositions(rng, model.nq());
    const BodyPoses poses = forwardKinematics(model, goal);
    const std::vector<Task> tasks{
        {.name = "tip", .map = poseTask(BodyId{13}, poses[BodyId{13}])},
        {.name = "gaze", .map = vectorTask(BodyId{9}, {1, 0, 0}), .target = poses[BodyId{9}].R.col(0)}};
    const auto result = solve(model, tasks, model.initialPositions());
    ASSERT_EQ(result.status, Status::kSolved) << result.message;
    EXPECT_LT((forwardKinematics(model, result.q)[BodyId{13}].p - poses[BodyId{13}].p).norm(), 2e-6);
    for (const double residual : result.residuals) EXPECT_LE(residual, 1e-6);
  }
}

// Slide 2:47 with |q - q0|_W^2 as a task: nothing nearby is better, and the slope vanishes.
TEST(SolveInverseKinematics, MinimisesTheCostOfWeighedTasks) {
  const Model model = compile(readOrs(sourcePath("data/robots/man.ors")).spec);
  const Eigen::VectorXd q0 = model.initialPositions();
  const BodyId hand = model.body("handR");
  const Eigen::Vector3d target = forwardKinematics(model, q0)[hand].p + Eigen::Vector3d(0.1, -0.2, 0.3);
  const std::vector<Task> tasks{
      {.name = "hand", .map = positionTask(hand), .target = target, .precision = 1e4, .tolerance = 1e-3},
      {.name = "home", .map = homingTask(q0), .precision = 1, .tolerance = kNoTolerance}};
  const auto result = solve(model, tasks, q0);
  ASSERT_EQ(result.status, Status::kSolved) << result.message;
  const VectorFunction cost = [&](const Eigen::VectorXd& q) {
    const TaskValue phi = stackTasks(tasks, {model, q, forwardKinematics(model, q)});
    return Eigen::VectorXd::Constant(1, phi.y.squaredNorm());
  };
  EXPECT_LT(numericJacobian(cost, result.q).norm(), 1e-5);
  EXPECT_NEAR(cost(result.q)[0], result.cost, 1e-12);
  EXPECT_LT(result.residuals[0], 1e-3);
  EXPECT_GT(result.residuals[1], 0.01);
  EXPECT_EQ(result.restarts, 0);
}

TEST(SolveInverseKinematics, SaysWhenItRanOutOfIterations) {
  const Model model = planarArm(1, 0.7);
  const Task hand = reach(model, "lower", {1, 0.5, 0});
  const auto result = solve(model, {hand}, Eigen::Vector2d(0, 2), {.maxIterations = 1, .maxRestarts = 0});
  EXPECT_EQ(result.status, Status::kIterationLimit);
  EXPECT_THAT(result.message, testing::StartsWith("task 'lower' misses its target by "));
  const Task home{.name = "home", .map = homingTask(Eigen::Vector2d(0, 2)), .tolerance = kNoTolerance};
  const auto weighed = solve(model, {home}, Eigen::Vector2d(0, 0), {.maxIterations = 1});
  EXPECT_EQ(weighed.status, Status::kIterationLimit);
  EXPECT_EQ(weighed.message, "tasks without tolerance might still improve after 1 iterations and 0 restarts");
}

TEST(SolveInverseKinematics, DoesNothingWhereNothingIsToDo) {
  const Model model = planarArm(1, 0.7);
  const Eigen::VectorXd q = Eigen::Vector2d(0.3, 0.4);
  const Eigen::Vector3d p = forwardKinematics(model, q)[model.body("lower")].p;
  const Task home{.name = "home", .map = homingTask(q), .tolerance = kNoTolerance};
  const Task still{.name = "base", .map = positionTask(kWorld), .tolerance = kNoTolerance};
  for (const std::vector<Task>& tasks :
       {std::vector{reach(model, "lower", p)}, std::vector{home}, std::vector{still}}) {
    const auto result = solve(model, tasks, q);
    EXPECT_EQ(result.status, Status::kSolved);
    EXPECT_EQ(result.q, q);
    EXPECT_THAT(result.message, testing::StartsWith("solved after "));
  }
}

#ifndef __SANITIZE_ADDRESS__
TEST(SolveInverseKinematics, AllocatesNothingPerIteration) {
  const Model model = compile(readScene(sourcePath("data/robots/arm7dof/arm7dof.urdf")).spec);
  const BodyId flange = model.body("flange");
  const Pose X_WT = translation(3, 2, 1);  // out of reach
  const Task pose{.name = "pose", .map = poseTask(flange, X_WT)};
  const Task point{.name = "point", .map = positionTask(flange), .target = X_WT.p};
  for (const std::vector<Task>& tasks : {std::vector{point}, std::vector{pose}, std::vector{pose, point}}) {
    const auto spent = [&](int iterations) {
      const long before = allocations();
      const auto result = solve(model, tasks, model.initialPositions(), {.maxIterations = iterations});
      const long count = allocations() - before;
      EXPECT_EQ(result.status, Status::kIterationLimit) << result.message;
      EXPECT_EQ(result.iterations, 52 * iterations);
      return count;
    };
    const long few = spent(2);
    EXPECT_GT(few, 0);
    EXPECT_EQ(spent(4), few);
  }
}
#endif

TEST(SolveInverseKinematics, IsTheSameForTheSameSeed) {
  const Model model = planarArm(1, 0.7);
  const Task task = reach(model, "lower", {2, 2, 0});
  const auto first = solve(model, {task}, Eigen::Vector2d(0, 2), {}, 5);
  const auto second = solve(model, {task}, Eigen::Vector2d(0, 2), {}, 5);
  EXPECT_EQ(first.q, second.q);
  EXPECT_EQ(first.iterations, second.iterations);
}

TEST(SolveInverseKinematics, RefusesBadArguments) {
  const Model model = planarArm(1, 0.7);
  const Task task = reach(model, "lower", {1, 1, 0});
  const Eigen::Vector2d q(0, 0);
  EXPECT_REX_ERROR(solve(model, {}, q), "inverse kinematics: found no task, wanted at least one");
  EXPECT_REX_ERROR(solve(model, {task}, Eigen::Vector3d(0, 0, 0)),
                   "start posture: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(solve(model, {task}, Eigen::Vector2d(0, std::nan(""))),
                   "start posture: number 1: found nan, wanted a finite number");
  EXPECT_REX_ERROR(solve(model, {task}, q, {.maxIterations = 0}),
                   "inverse kinematics: iterations: found 0, wanted at least 1");
  EXPECT_REX_ERROR(solve(model, {task}, q, {.maxRestarts = -1}),
                   "inverse kinematics: restarts: found -1, wanted 0 or more");
  EXPECT_REX_ERROR(solve(model, {task}, q, {.stepTolerance = 0}),
                   "inverse kinematics: step tolerance: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(solve(model, {task}, q, {.stepTolerance = HUGE_VAL}),
                   "inverse kinematics: step tolerance: found inf");
  const TaskMap broken = [](const Posture& at, TaskValue& out) {
    out.y = Eigen::VectorXd::Constant(1, std::sqrt(-1 - at.q[0] * at.q[0]));
    out.J.setZero(1, at.model.nv());
  };
  EXPECT_REX_ERROR(solve(model, {task, {.name = "square root", .map = broken}}, q),
                   "task 'square root': value: found a number that is not finite");
}

}  // namespace rex::inverse_kinematics_solver_test
