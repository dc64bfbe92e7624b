#include <limits>

#include <gtest/gtest.h>

#include "kinematics/task_maps.h"
#include "support/expect_error.h"
#include "support/random_scene.h"

namespace rex::task_test {

struct Robot {
  Rng rng{41};
  Model model = compile(randomScene(rng, 12));
  Eigen::VectorXd q = randomPositions(rng, model.nq());
  BodyPoses poses = forwardKinematics(model, q);
  Posture posture{model, q, poses};
};

TEST(StackTasks, WeighsAndStacks) {
  Robot robot;
  const BodyId tip{12};
  const Eigen::Vector3d target(1, 2, 3);
  const std::vector<Task> tasks{
      {.name = "tip", .map = positionTask(tip), .target = target, .precision = 100},
      {.name = "home", .map = homingTask(robot.model.initialPositions()), .precision = 0.25}};
  const TaskValue phi = stackTasks(tasks, robot.posture);
  std::vector<TaskValue> values(2);
  for (std::size_t i = 0; i < 2; ++i) tasks[i].map(robot.posture, values[i]);
  const int nv = robot.model.nv();
  ASSERT_EQ(phi.y.size(), 3 + nv);
  EXPECT_LT((phi.y.head<3>() - 10 * (values[0].y - target)).norm(), 1e-13);
  EXPECT_EQ(phi.y.tail(nv), 0.5 * values[1].y);
  EXPECT_EQ(phi.J.topRows(3), 10 * values[0].J);
  EXPECT_EQ(phi.J.bottomRows(nv), 0.5 * values[1].J);
  EXPECT_EQ(taskError(tasks[0], values[0]), (values[0].y - target).cwiseAbs().maxCoeff());
  EXPECT_EQ(taskError(tasks[1], values[1]), values[1].y.cwiseAbs().maxCoeff());
}

TEST(StackTasks, TakesMapsOfUsers) {
  Robot robot;
  const TaskMap height = [](const Posture& at, TaskValue& out) {
    TaskValue whole;
    positionTask(BodyId{5})(at, whole);
    out = {whole.y.tail(1), whole.J.bottomRows(1)};
  };
  const TaskValue phi = stackTasks(std::vector<Task>{{.name = "height", .map = height}}, robot.posture);
  ASSERT_EQ(phi.y.size(), 1);
  EXPECT_EQ(phi.y[0], robot.poses[BodyId{5}].p.z());
}

// Errors name the task that is at fault, the second of two.
void expectError(const Task& task, const std::string& text) {
  Robot robot;
  const std::vector<Task> tasks{{.name = "sane", .map = positionTask(BodyId{1})}, task};
  EXPECT_REX_ERROR(stackTasks(tasks, robot.posture), text);
}

TEST(StackTasks, NamesTheTaskThatIsNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const TaskMap sane = positionTask(BodyId{1});
  const auto spoilt = [&](const std::function<void(TaskValue&)>& spoil) -> TaskMap {
    return [=](const Posture& at, TaskValue& out) {
      sane(at, out);
      spoil(out);
    };
  };
  expectError({.name = "gaze"}, "task 'gaze': map: found none, wanted a function");
  expectError({.name = "gaze", .map = sane, .precision = 0},
              "task 'gaze': precision: found 0, wanted a positive, finite number");
  expectError({.name = "gaze", .map = sane, .precision = kNoTolerance},
              "task 'gaze': precision: found inf, wanted a positive, finite number");
  expectError({.name = "gaze", .map = sane, .tolerance = -1},
              "task 'gaze': tolerance: found -1, wanted a number, 0 or more, or infinity");
  expectError({.name = "gaze", .map = sane, .target = Eigen::Vector2d(1, 2)},
              "task 'gaze': target: found 2 numbers, wanted 3, as its map gives");
  expectError({.name = "gaze", .map = sane, .target = Eigen::Vector3d(1, 2, nan)},
              "task 'gaze': target: found a number that is not finite");
  expectError({.name = "gaze", .map = spoilt([=](TaskValue& value) { value.y[1] = nan; })},
              "task 'gaze': value: found a number that is not finite, wanted finite numbers");
  expectError({.name = "gaze", .map = spoilt([=](TaskValue& value) { value.J(0, 3) = nan; })},
              "task 'gaze': Jacobian: found a number that is not finite, wanted finite numbers");
  expectError({.name = "gaze", .map = spoilt([](TaskValue& value) { value.J.setZero(3, 2); })},
              "task 'gaze': Jacobian: found 3 x 2, wanted 3 x ");
}

}  // namespace rex::task_test
