#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "dynamics/inverse_dynamics.h"
#include "formats/ors_reader.h"
#include "formats/scene_file.h"
#include "planning/timed_path.h"
#include "support/expect_error.h"
#include "support/paths.h"

namespace rex::motion_limits_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(JointLimits, AreThoseOfTheFile) {
  const Model model = compile(readScene(sourcePath("data/robots/arm7dof/arm7dof.urdf")).spec);
  const JointLimits found = jointLimits(model, {.ramp = .25, .effort = true});
  Eigen::VectorXd velocity(7), effort(7);
  velocity << 1.7, 1.7, 1.75, 2.3, 2.4, 3.1, 3.1;
  effort << 180, 180, 110, 110, 60, 40, 40;
  EXPECT_EQ(found.limits.velocity, velocity);
  EXPECT_EQ(found.limits.acceleration, 4 * velocity);
  EXPECT_EQ(found.limits.effort, effort);
  EXPECT_THAT(found.assumedVelocity, IsEmpty());
  EXPECT_THAT(found.anyEffort, IsEmpty());
  EXPECT_EQ(found.limits.names[0], "shoulder_yaw");
  Rng rng(1);
  const Eigen::VectorXd q = Eigen::VectorXd::NullaryExpr(7, [&] { return rng.normal(); });
  Eigen::VectorXd u(7);
  found.limits.forces(q, 2 * q, -q, u);
  EXPECT_LT((u - inverseDynamics(model, q, 2 * q, -q)).norm(), 1e-9);
}

TEST(JointLimits, AreAssumedWhereTheFileHasNone) {
  SceneSpec spec = parseOrs(
                       "body a {} body b {} body c {} body d {} body e {}\n"
                       "joint slide (a b) { type=transXYPhi }\njoint turn (b c) { type=hingeX }\n"
                       "joint last (c d) { type=hingeX }\njoint also (d e) { type=hingeX }\n",
                       "x.ors")
                       .spec;
  spec.joints[1].maxVelocity = 0, spec.joints[1].maxEffort = 0;
  spec.joints[2].maxVelocity = 3, spec.joints[2].maxEffort = 7;
  spec.joints[3].mimic = "last", spec.joints[3].mimicRatio = -2, spec.joints[3].maxVelocity = 4;
  const Model model = compile(spec);
  const JointLimits found = jointLimits(model, {.velocity = .8, .effort = true});
  ASSERT_EQ(found.limits.velocity.size(), 5);
  EXPECT_EQ(found.limits.velocity.head(4), Eigen::Vector4d::Constant(.8));
  EXPECT_EQ(found.limits.velocity[4], 2) << "of the joint that mimics it twice as fast";
  EXPECT_EQ(found.limits.effort[4], 7);
  EXPECT_TRUE(std::isinf(found.limits.effort[3]));
  EXPECT_THAT(found.assumedVelocity, ElementsAre("slide [0]", "slide [1]", "slide [2]", "turn"));
  EXPECT_THAT(found.anyEffort, ElementsAre("slide [0]", "slide [1]", "slide [2]", "turn"));
  EXPECT_EQ(jointLimits(model).limits.effort.size(), 0);
}

TEST(JointLimits, RefuseDefaultsThatAreNone) {
  const Model model = compile(parseOrs("body a {} body b {} joint (a b) {}", "x.ors").spec);
  EXPECT_REX_ERROR(static_cast<void>(jointLimits(model, {.velocity = 0})),
                   "velocity of joints without a limit: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(static_cast<void>(jointLimits(model, {.ramp = -1})),
                   "seconds to the velocity limit: found -1, wanted a positive, finite number");
}

}  // namespace rex::motion_limits_test
