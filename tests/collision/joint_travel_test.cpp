#include <gtest/gtest.h>

#include "collision/motion_clearance_internal.h"
#include "geometry/rotation.h"
#include "support/random_scene.h"

namespace rex::joint_travel_test {

using Eigen::VectorXd;

struct Rates {
  double angle = 0, way = 0;
};

// The fastest of many short steps, per whole motion.
Rates sampledRates(const Joint& joint, const VectorXd& from, const VectorXd& to) {
  constexpr int kSteps = 200;
  Rates rates;
  Pose last = jointMotion(joint.type, joint.axis, joint.pitch, from.data());
  for (int i = 1; i <= kSteps; ++i) {
    const double t = static_cast<double>(i) / kSteps;
    const VectorXd q = (1 - t) * from + t * to;
    const Pose next = jointMotion(joint.type, joint.axis, joint.pitch, q.data());
    rates.angle = std::max(rates.angle, logSO3(last.R.transpose() * next.R).norm() * kSteps);
    rates.way = std::max(rates.way, (next.p - last.p).norm() * kSteps);
    last = next;
  }
  return rates;
}

class JointTravelOf : public testing::TestWithParam<JointType> {};

TEST_P(JointTravelOf, BoundsTheMotionAndIsReached) {
  Rng rng(71);
  Joint joint;
  joint.type = GetParam();
  joint.nq = positionCount(GetParam());
  double angleReached = 0, wayReached = 0, most = 0;
  for (int i = 0; i < 300; ++i) {
    joint.axis = rng.normalVector(3).normalized();
    joint.pitch = rng.normal();
    const VectorXd from = rng.normalVector(joint.nq), to = from + rng.uniform() * rng.normalVector(joint.nq);
    const internal::JointTravel bound = internal::jointTravel(joint, from, to);
    const Rates rates = sampledRates(joint, from, to);
    EXPECT_LE(rates.angle, bound.angle * (1 + 1e-9) + 1e-9) << i;
    EXPECT_LE(rates.way, bound.way * (1 + 1e-9) + 1e-9) << i;
    if (bound.angle > 0) angleReached = std::max(angleReached, rates.angle / bound.angle);
    if (bound.way > 0) wayReached = std::max(wayReached, rates.way / bound.way);
    most = std::max({most, bound.angle, bound.way});
  }
  const bool moves = joint.nq > 0;
  EXPECT_EQ(most > 0, moves);
  if (moves) {
    EXPECT_GT(std::max(angleReached, wayReached), 0.95);
  }
}

INSTANTIATE_TEST_SUITE_P(All, JointTravelOf, testing::ValuesIn(kAllJointTypes),
                         [](const auto& i) { return std::string(toString(i.param)); });

TEST(JointTravel, FollowsTheRatioOfAJointThatMimics) {
  Joint joint;
  joint.type = JointType::kHinge;
  joint.nq = 1;
  joint.ratio = -2;
  EXPECT_DOUBLE_EQ(internal::jointTravel(joint, VectorXd::Constant(1, 0.5), VectorXd::Constant(1, 1)).angle,
                   1);
}

}  // namespace rex::joint_travel_test
