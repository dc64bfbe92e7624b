#include "planning/sphere_planner.h"

#include <gtest/gtest.h>

#include "base/cpu_lanes.h"
#include "base/text_file.h"
#include "planning/sphere_arm.h"
#include "support/expect_error.h"
#include "support/paths.h"
#include "support/rounds.h"
#include "support/sphere_problems.h"
#include "support/temporary_folder.h"

namespace rex::sphere_planner_test {

ShapeSpec box(const std::string& name, const Eigen::Vector3d& at, const Eigen::Vector3d& size) {
  ShapeSpec obstacle{.name = name, .X_BS = {}, .shape = {}, .contact = true};
  obstacle.X_BS.p = at;
  obstacle.shape.extent = size;
  return obstacle;
}

Eigen::VectorXd posture(std::initializer_list<double> numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.begin(), static_cast<Eigen::Index>(numbers.size()));
}

// On both sides of a wall beside the arm.
const Eigen::VectorXd kLeft = posture({.9, 1.2, 0, .1, .2, 0}), kRight = posture({-.9, 1.2, 0, .1, .2, 0});
const std::vector<ShapeSpec> kWall{box("wall", {0, .75, .3}, {.1, .5, 1.2})};

TEST(PlanSpheres, GoesAroundAWall) {
  const SceneSpec spec = sphereArm();
  const SphereRobot robot(compile(spec));
  const SphereWorld world(robot, kWall);
  ASSERT_FALSE(world.isFree(kLeft, kRight));
  const ExactJudge judge(spec, kWall);
  const Space space = Space::box(robot.lowerLimits(), robot.upperLimits());
  for (const int first : {1, 77}) {
    const PathResult plan = planSpheres(world, kLeft, kRight, {.firstPoint = first});
    ASSERT_EQ(plan.status, PathStatus::kFound);
    EXPECT_EQ(judge.faultOf(plan.path, kLeft, kRight), "");
    EXPECT_DOUBLE_EQ(plan.length, pathLength(space, plan.path));
    const Eigen::MatrixXd shorter = shortenPath(world, plan.path);
    EXPECT_EQ(judge.faultOf(shorter, kLeft, kRight), "");
    EXPECT_LE(pathLength(space, shorter), plan.length + 1e-5);
  }
}

TEST(PlanSpheres, GivesTheSamePathInAllLanes) {
  const SphereRobot robot(compile(sphereArm()));
  const PathResult first = planSpheres(SphereWorld(robot, kWall), kLeft, kRight);
  const Eigen::MatrixXd shorter = shortenPath(SphereWorld(robot, kWall), first.path);
  for (const int lanes : {1, 2, cpuLanes()}) {
    const SphereWorld world(robot, kWall, lanes);
    const PathResult again = planSpheres(world, kLeft, kRight);
    EXPECT_EQ(again.path, first.path);
    EXPECT_EQ(again.samples, first.samples);
    EXPECT_EQ(again.asked, first.asked);
    EXPECT_EQ(shortenPath(world, again.path), shorter);
  }
}

TEST(PlanSpheres, GoesStraightIfNothingIsInTheWay) {
  const SphereWorld world(SphereRobot(compile(sphereArm())), {});
  const PathResult plan = planSpheres(world, kLeft, kRight);
  ASSERT_EQ(plan.path.cols(), 2);
  EXPECT_EQ(plan.samples, 0);
  EXPECT_EQ(shortenPath(world, plan.path), plan.path);
}

// Walls before and behind the arm, and one above it, leave no way from side to side.
TEST(PlanSpheres, SaysThatItFoundNoPath) {
  const SphereRobot robot(compile(sphereArm()));
  const std::vector<ShapeSpec> fence{box("front", {0, 1.6, .5}, {.05, 2.7, 6}),
                                     box("back", {0, -1.6, .5}, {.05, 2.7, 6}),
                                     box("roof", {0, 0, 2.2}, {.05, 6, 2.6})};
  const SphereWorld world(robot, fence);
  const PathResult plan = planSpheres(world, kLeft, kRight, {.budget = 40000});
  EXPECT_EQ(plan.status, PathStatus::kBudgetSpent);
  EXPECT_EQ(plan.path.size(), 0);
  EXPECT_GE(plan.asked, 40000);
  EXPECT_EQ(plan.message, "no path was found within 40000 postures");
}

TEST(PlanSpheres, EndsIfItsStepsAreTooShortForEveryTarget) {
  const SphereRobot robot(compile(sphereArm()));
  const SphereWorld world(robot, kWall);
  EXPECT_EQ(planSpheres(world, kLeft, kRight, {.range = 1e-6}).status, PathStatus::kBudgetSpent);
}

TEST(PlanSpheres, SaysWhatIsWrong) {
  const SphereRobot robot(compile(sphereArm()));
  const SphereWorld world(robot, kWall);
  EXPECT_REX_ERROR(planSpheres(world, kLeft, kRight, {.range = 0}),
                   "range: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(planSpheres(world, kLeft, kRight, {.firstPoint = 0}),
                   "first point: found 0, wanted at least 1");
  EXPECT_REX_ERROR(planSpheres(world, kLeft, kRight, {.budget = 0}), "budget: found 0, wanted at least 1");
  EXPECT_REX_ERROR(planSpheres(world, Eigen::VectorXd::Zero(2), kRight), "wanted size 6");
  EXPECT_REX_ERROR(planSpheres(world, kLeft, Eigen::VectorXd::Constant(6, 9)), "goal");
  EXPECT_REX_ERROR(planSpheres(world, kLeft, posture({0, 1.2, 0, .1, .2, 0})),
                   "goal: found a posture in which shapes overlap or are nearer than ");
  EXPECT_REX_ERROR(shortenPath(world, Eigen::MatrixXd::Zero(6, 1)),
                   "path: found 1 postures, wanted at least two");
  EXPECT_REX_ERROR(shortenPath(world, Eigen::MatrixXd::Zero(5, 2)),
                   "postures of a path: found a vector of size 5");
}

TEST(PlanSpheres, SolvesProblemsOfThePanda) {
  const auto folder = sharedPath("data/panda-problems"), urdf = sharedPath("data/urdf/panda_spherized.urdf");
  if (!std::filesystem::exists(folder) || !std::filesystem::exists(urdf))
    GTEST_SKIP() << "no ../shared/data/panda-problems or panda_spherized.urdf";
  const SceneSpec spec = readSphereRobot(urdf);
  const SphereRobot robot(compile(spec));
  const std::vector<SphereProblem> problems = readSphereProblems(folder, robot.nq());
  ASSERT_EQ(problems.size(), 140u);
  for (std::size_t i = 0; i < problems.size(); i += static_cast<std::size_t>(rounds(10, 1))) {
    const SphereProblem& problem = problems[i];
    const ExactJudge judge(spec, problem.obstacles);
    EXPECT_EQ(judge.faultOf(problem.start), "");
    EXPECT_EQ(judge.faultOf(problem.goal), "");
    const SphereWorld world(robot, problem.obstacles);
    const PathResult plan = planSpheres(world, problem.start, problem.goal);
    ASSERT_EQ(plan.status, PathStatus::kFound) << problem.name;
    EXPECT_EQ(judge.faultOf(plan.path, problem.start, problem.goal), "") << problem.name;
    EXPECT_EQ(judge.faultOf(shortenPath(world, plan.path), problem.start, problem.goal), "") << problem.name;
  }
}

TEST(ExactJudge, FindsFaults) {
  const ExactJudge judge(sphereArm(), kWall);
  Eigen::MatrixXd path(6, 2);
  path << kLeft, kRight;
  EXPECT_THAT(judge.faultOf(path, kLeft, kRight),
              testing::HasSubstr("the clearance of the path is between -"));
  EXPECT_EQ(judge.faultOf(path, kRight, kLeft), "the path does not lead from start to goal");
  EXPECT_THAT(judge.faultOf(posture({0, 1.2, 0, .1, .2, 0})), testing::HasSubstr("'wall'"));
  EXPECT_EQ(judge.faultOf(posture({0, 1.2, 0, .3, .2, 0})),
            "coordinate 3 is 0.3, outside its limits 0 and 0.2");
  path.col(1) = posture({0, 1.2, 0, .1, .2, 0});
  EXPECT_THAT(judge.faultOf(path, kLeft, path.col(1)), testing::HasSubstr("posture 2 of the path: "));
}

// Reads one file with that text.
std::vector<SphereProblem> read(const std::string& text) {
  const TemporaryFolder folder;
  writeTextFile(folder.path() / "set.json", text);
  return readSphereProblems(folder.path(), 2);
}

std::string withObject(const std::string& object) {
  return R"({"set":"s","problems":[{"name":"p","start":[0,0],"goal":[1,1],"objects":[)" + object + "]}]}";
}

TEST(SphereProblems, HaveObstaclesOfFourKinds) {
  const std::string pose = R"("position":[1,2,3],"quat_wxyz":[2,0,0,0])";
  const auto problems = read(withObject(
      R"({"id":"a","type":"box","size":[1,2,3],)" + pose + R"(},{"id":"b","type":"sphere","radius":2,)" +
      pose + R"(},{"id":"c","type":"cylinder","radius":2,"height":4,)" + pose +
      R"(},{"id":"d","type":"capsule","radius":2,"height":4,)" + pose + "}"));
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].set, "s");
  EXPECT_EQ(problems[0].goal, Eigen::Vector2d(1, 1));
  ASSERT_EQ(problems[0].obstacles.size(), 4u);
  EXPECT_EQ(problems[0].obstacles[0].shape.extent, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(problems[0].obstacles[0].X_BS.R, Eigen::Matrix3d::Identity());
  EXPECT_EQ(problems[0].obstacles[3].shape.type, ShapeType::kCapsule);
  EXPECT_EQ(problems[0].obstacles[3].shape.extent.z(), 4);
}

TEST(SphereProblems, SayWhatIsWrongInWhichFile) {
  const TemporaryFolder empty;
  EXPECT_REX_ERROR(readSphereProblems(empty.path(), 7), "problems: found no .json file, wanted a folder");
  EXPECT_REX_ERROR(readSphereProblems(empty.path() / "no", 7),
                   "problems: found no such folder, wanted a folder");
  EXPECT_REX_ERROR(read("{"), "set.json: problem file: found no JSON, wanted JSON");
  EXPECT_REX_ERROR(read("[]"), "found array, wanted an object");
  EXPECT_REX_ERROR(read("{}"), "set.json: 'set': found nothing, wanted a text");
  EXPECT_REX_ERROR(read(R"({"set":1})"), "'set': found 1, wanted a text");
  EXPECT_REX_ERROR(read(R"({"set":"s","problems":1})"), "'problems': found 1, wanted a list");
  EXPECT_REX_ERROR(read(R"({"set":"s","problems":[{}]})"), "problem 1: 'name': found nothing, wanted a text");
  EXPECT_REX_ERROR(read(R"({"set":"s","problems":[{"name":"p","start":[1]}]})"),
                   "problem 'p': 'start': found 1 numbers, wanted 2 numbers");
  EXPECT_REX_ERROR(read(R"({"set":"s","problems":[{"name":"p","start":["1",2]}]})"),
                   "'start': found [\"1\",2], wanted 2 numbers");
  const std::string pose = R"(,"position":[1,2,3],"quat_wxyz":[2,0,0,0]})";
  EXPECT_REX_ERROR(read(withObject("{}")), "problem 'p': object 1: 'id': found nothing, wanted a text");
  EXPECT_REX_ERROR(
      read(withObject(R"({"id":"a","type":"cone")" + pose)),
      "problem 'p': object 1: object 'a': 'type': found 'cone', wanted 'box', 'sphere', 'cylinder'");
  EXPECT_REX_ERROR(read(withObject(R"({"id":"a","type":"sphere","radius":0)" + pose)),
                   "'radius': found 0, wanted a positive number of metres");
  EXPECT_REX_ERROR(read(withObject(R"({"id":"a","type":"box","size":[0,1,1])" + pose)),
                   "'size': found [0,1,1], wanted positive numbers");
  EXPECT_REX_ERROR(read(withObject(R"({"id":"a","type":"box","quat_wxyz":[0,0,0,0]})")),
                   "'quat_wxyz': found a quaternion of length zero, wanted a rotation");
}

TEST(SphereProblems, NeedARobotOfSpheresOnABase) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& link) {
    writeTextFile(folder.path() / "arm.urdf", "<robot name='arm'>" + link + "</robot>");
    return readSphereRobot(folder.path() / "arm.urdf");
  };
  const std::string sphere = "<collision><geometry><sphere radius='1'/></geometry></collision>";
  EXPECT_EQ(read("<link name='a'>" + sphere + "</link>").bodies.size(), 1u);
  EXPECT_REX_ERROR(
      read("<link name='a'><collision><geometry><mesh filename='a.stl'/></geometry></collision></link>"),
      "arm.urdf: collision shape of 'a': found mesh 'a.stl', wanted spheres");
  EXPECT_REX_ERROR(
      read("<link name='world'>" + sphere + "</link>"),
      "arm.urdf: robot: found shapes fixed to the world itself, wanted a base link that carries them");
}

}  // namespace rex::sphere_planner_test
