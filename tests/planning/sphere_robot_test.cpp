#include "planning/sphere_robot.h"

#include <gtest/gtest.h>

#include "base/cpu_lanes.h"
#include "collision/contacts.h"
#include "collision/motion_clearance.h"
#include "formats/ors_reader.h"
#include "planning/sphere_arm.h"
#include "planning/sphere_world_internal.h"
#include "support/expect_error.h"
#include "support/paths.h"
#include "support/rounds.h"
#include "support/sphere_problems.h"

namespace rex::sphere_robot_test {

Eigen::VectorXd randomPosture(Rng& rng, const SphereRobot& robot) {
  Eigen::VectorXd q(robot.nq());
  for (int j = 0; j < robot.nq(); ++j) q[j] = rng.uniform(robot.lowerLimits()[j], robot.upperLimits()[j]);
  return q;
}

double exactDistance(const ExactJudge& judge, const VectorArg& q) {
  PoseBatch poses;
  forwardKinematicsBatch(judge.model(), q, poses);
  Eigen::MatrixXd distances;
  contactDistancesBatch(judge.contacts(), poses, distances);
  return distances.minCoeff();
}

// A random robot among random obstacles: either our arm or, where it is there, the Panda.
struct Case {
  SceneSpec spec;
  SphereRobot robot{compile(spec)};
};

std::vector<Case> cases() {
  std::vector<Case> all{{sphereArm()}};
  const auto panda = sharedPath("data/urdf/panda_spherized.urdf");
  if (std::filesystem::exists(panda)) all.push_back({readSphereRobot(panda)});
  return all;
}

TEST(SphereWorld, AgreesWithExactDistancesButForItsSlack) {
  Rng rng(1);
  int free = 0, overlapping = 0;
  for (const Case& one : cases()) {
    for (int round = 0; round < rounds(20, 200); ++round) {
      const std::vector<ShapeSpec> obstacles = randomObstacles(rng, round % 9);
      const SphereWorld world(one.robot, obstacles);
      const ExactJudge judge(one.spec, obstacles);
      EXPECT_LT(world.slack(), 2e-5);
      for (int i = 0; i < 200; ++i) {
        const Eigen::VectorXd q = randomPosture(rng, one.robot);
        const double distance = exactDistance(judge, q);
        if (world.isFree(q)) {
          ASSERT_GT(distance, 0) << q.transpose();
          ++free;
        } else {
          ASSERT_LT(distance, 2 * world.slack()) << q.transpose();
          ++overlapping;
        }
      }
    }
  }
  EXPECT_GT(free, 1000);
  EXPECT_GT(overlapping, 1000);
}

// Obstacles are moved along their normal until they touch: near contact the answers still differ by less than
// the slack.
TEST(SphereWorld, DecidesAtTheSlackNearContact) {
  Rng rng(2);
  for (const Case& one : cases()) {
    int close = 0;
    for (int i = 0; i < 600; ++i) {
      const Eigen::VectorXd q = randomPosture(rng, one.robot);
      std::vector<ShapeSpec> obstacles = randomObstacles(rng, 8);
      obstacles = {obstacles[static_cast<std::size_t>(i % 8)]};
      const ExactJudge alone(one.spec, {});
      if (exactDistance(alone, q) < 1e-3) continue;
      // Bisects the height at which the obstacle is just free.
      double low = -5, high = obstacles[0].X_BS.p.z();
      const auto at = [&](double height) {
        obstacles[0].X_BS.p.z() = height;
        return exactDistance(ExactJudge(one.spec, obstacles), q);
      };
      if (at(low) < 1e-4 || at(high) > -1e-3) continue;
      for (int step = 0; step < 40; ++step) (at((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
      for (const double shift : {-1e-3, -1e-4, 1e-4, 1e-3}) {
        const double distance = at(low + shift);
        const SphereWorld world(one.robot, obstacles);
        if (std::abs(distance) < 2 * world.slack()) continue;
        EXPECT_EQ(world.isFree(q), distance > 0) << distance;
        ++close;
      }
    }
    EXPECT_GT(close, 30);
  }
}

TEST(SphereWorld, ProvesMotions) {
  Rng rng(3);
  int free = 0, refused = 0;
  for (const Case& one : cases()) {
    for (int round = 0; round < rounds(25, 400); ++round) {
      const std::vector<ShapeSpec> obstacles = randomObstacles(rng, 1 + round % 5);
      const SphereWorld world(one.robot, obstacles);
      const ExactJudge judge(one.spec, obstacles);
      for (int i = 0; i < 6; ++i) {
        const Eigen::VectorXd from = randomPosture(rng, one.robot);
        const Eigen::VectorXd to = from + (randomPosture(rng, one.robot) - from) * rng.uniform(.02, .6);
        const ClearanceBounds exact = clearanceBounds(judge.model(), judge.contacts(), from, to, 1e-3);
        if (world.isFree(from, to)) {
          EXPECT_GT(exact.atMost, 0);
          EXPECT_GT(exact.atLeast, -1e-3);
          ++free;
        } else {
          EXPECT_LT(exact.atLeast, 3e-3);
          ++refused;
        }
      }
    }
  }
  EXPECT_GT(free, 30);
  EXPECT_GT(refused, 30);
}

TEST(SphereWorld, SaysTheSameInAllLanes) {
  Rng rng(4);
  for (const Case& one : cases()) {
    for (int round = 0; round < 10; ++round) {
      const std::vector<ShapeSpec> obstacles = randomObstacles(rng, 6);
      const SphereWorld single(one.robot, obstacles, 1), four(one.robot, obstacles, 2),
          most(one.robot, obstacles, cpuLanes());
      for (int i = 0; i < 40; ++i) {
        const Eigen::VectorXf from = randomPosture(rng, one.robot).cast<float>(),
                              to = from + (randomPosture(rng, one.robot).cast<float>() - from) * .2f;
        const auto ask = [&](const SphereWorld& world) {
          internal::SphereCount count;
          const bool isFree = world.data().kernel.isFree(world.data().scene, from.data(), to.data(), count);
          return std::pair(isFree, count.blocks);
        };
        EXPECT_EQ(ask(single), ask(four));
        EXPECT_EQ(ask(single), ask(most));
      }
    }
  }
}

TEST(SphereWorld, FindsTheNearestPoint) {
  Rng rng(5);
  for (const int count : {1, 7, 8, 9, 100}) {
    constexpr int kCoordinates = 3;
    std::vector<float> points(static_cast<std::size_t>((count + 7) / 8 * 8 * kCoordinates), 1e15f);
    Eigen::Matrix3Xf all(kCoordinates, count);
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < kCoordinates; ++j)
        // Few values, so that some points are equally near.
        points[static_cast<std::size_t>((i / 8 * kCoordinates + j) * 8 + i % 8)] = all(j, i) =
            std::floor(static_cast<float>(rng.uniform(0, 4)));
    const Eigen::Vector3f to(1.2f, 0.3f, 2.6f);
    Eigen::Index nearest;
    (all.colwise() - to).colwise().squaredNorm().minCoeff(&nearest);
    for (const int lanes : {1, 2, cpuLanes()}) {
      float squared;
      const auto kernel = kernelFor<internal::SphereKernel>(lanes);
      EXPECT_EQ(kernel.nearest(points.data(), count, kCoordinates, to.data(), squared), nearest);
      EXPECT_NEAR(squared, (all.col(nearest) - to).squaredNorm(), 1e-6);
    }
  }
}

SphereRobot robotOf(const std::string& ors) { return SphereRobot(compile(parseOrs(ors, "robot.ors").spec)); }

std::string chain(int joints, const std::string& type, const std::string& shape) {
  std::string text = "body b0 {}\n";
  for (int i = 1; i <= joints; ++i)
    text += fmt::format("body b{0} {{ {1} }} joint (b{2} b{0}) {{ {3} A=<T t(0 0 .3)> }}\n", i, shape, i - 1,
                        type);
  return text;
}

TEST(SphereRobot, SaysWhatItCannotTake) {
  const std::string hinge = "type=hingeX limits=[-1 1]", sphere = "type=ST_sphere size=[0 0 0 .1] contact";
  EXPECT_EQ(robotOf(chain(16, hinge, sphere)).nq(), 16);
  EXPECT_REX_ERROR(robotOf(chain(17, hinge, sphere)),
                   "robot 'robot.ors': found 17 coordinates, wanted at most 16");
  EXPECT_REX_ERROR(robotOf(chain(2, "type=hingeX", sphere)),
                   "coordinate 0: found limits -inf and inf, wanted finite limits");
  EXPECT_REX_ERROR(robotOf(chain(1, hinge, "type=ST_box size=[1 1 1 0] contact")),
                   "shape 'b1': found a box, wanted spheres as shapes in contact");
  EXPECT_REX_ERROR(robotOf(chain(1, "type=quatBall", sphere)),
                   "joint of body 'b1': found a screw or a ball joint, wanted hinges and sliders");
}

TEST(SphereRobot, SaysHowManyLinksAndNodesItCanTake) {
  SceneSpec spec = sphereArm();
  const JointSpec mimic = *std::find_if(spec.joints.begin(), spec.joints.end(),
                                        [](const JointSpec& joint) { return !joint.mimic.empty(); });
  for (int i = 0; i < 20; ++i) {
    BodySpec body;
    body.name = fmt::format("extra{}", i);
    spec.bodies.push_back(body);
    JointSpec joint = mimic;
    joint.name = joint.child = body.name;
    spec.joints.push_back(joint);
  }
  EXPECT_REX_ERROR(SphereRobot(compile(spec)), "robot 'arm.urdf': found 27 moving links, wanted at most 24");
  spec = sphereArm();
  for (BodySpec& body : spec.bodies)
    for (int i = 0; i < 40; ++i) {
      body.shapes.push_back(body.shapes[0]);
      body.shapes.back().name = fmt::format("extra{}", i);
    }
  EXPECT_REX_ERROR(SphereRobot(compile(spec)), "wanted at most 512 and 128");
}

TEST(SphereWorld, SaysWhatItCannotTake) {
  const SphereRobot robot(compile(sphereArm()));
  Rng rng(1);
  std::vector<ShapeSpec> obstacles = randomObstacles(rng, 1);
  obstacles[0].shape.type = ShapeType::kCone;
  EXPECT_REX_ERROR(SphereWorld(robot, obstacles),
                   "obstacle 'obstacle 0': found a cone, wanted a box, sphere, capsule or cylinder");
  const SphereWorld world(robot, {});
  EXPECT_REX_ERROR(world.isFree(Eigen::VectorXd::Zero(2)), "q: found a vector of size 2, wanted size 6");
  EXPECT_REX_ERROR(world.isFree(Eigen::VectorXd::Zero(6), Eigen::VectorXd::Zero(7)),
                   "q: found a vector of size 7, wanted size 6");
  EXPECT_REX_ERROR(world.isFree(Eigen::VectorXd::Constant(6, NAN)),
                   "q: number 0: found nan, wanted a finite number");
}

}  // namespace rex::sphere_robot_test
