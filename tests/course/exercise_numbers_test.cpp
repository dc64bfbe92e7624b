// The numbers that the course gives for exercise 12.3.2 c and d; those of a and b are in simulator_test.cpp.
#include <cmath>

#include <gtest/gtest.h>

#include "course/simulator.h"
#include "kinematics/inverse_kinematics.h"

namespace rex::exercise_numbers_test {

const Eigen::Vector3d kTarget(-.2, -.4, 1.1);

// The largest |y - wanted(t)| from step `first` on, when the hand takes a full step towards wanted(t) for t =
// 1 ... T.
template <class Wanted>
double largestError(int T, int first, const Wanted& wanted) {
  Simulator S("man.ors");
  double largest = 0;
  for (int t = 1; t <= T; ++t) {
    const Eigen::VectorXd dy = wanted(t) - S.kinematicsPos("handR");
    S.setJointAngles(S.getJointAngles() + inverseKinematicsStep(S.jacobianPos("handR"), dy, .01));
    if (t >= first) largest = std::max(largest, (S.kinematicsPos("handR") - wanted(t)).norm());
  }
  return largest;
}

TEST(ExerciseNumbers, TheHandFollowsAMovingTarget) {
  const Eigen::Vector3d start = Simulator("man.ors").kinematicsPos("handR");
  const auto onLine = [&](int t) -> Eigen::Vector3d { return start + t / 100. * (kTarget - start); };
  EXPECT_NEAR(largestError(100, 1, onLine), 2.3e-5, 5e-7);
}

TEST(ExerciseNumbers, TheHandTracksTheCircleUntilThePostureGetsLost) {
  const auto onCircle = [](int t) -> Eigen::Vector3d {
    return kTarget + .2 * Eigen::Vector3d(std::cos(t / 20.), 0, std::sin(t / 20.));
  };
  EXPECT_LT(largestError(600, 20, onCircle), 5e-4);
  EXPECT_GT(largestError(1000, 20, onCircle), .1);
}

}  // namespace rex::exercise_numbers_test
