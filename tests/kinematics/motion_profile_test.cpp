#include "kinematics/motion_profile.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "support/expect_error.h"

namespace rex::motion_profile_test {

struct Case {
  MotionProfile profile;
  double peakVelocity, peakAcceleration;  // in closed form
  bool startsAtRest;
};

const double kPi = std::numbers::pi;
const std::vector<Case> kCases{
    {{.shape = ProfileShape::kRamp}, 1, 0, false},
    {{.shape = ProfileShape::kSine}, kPi / 2, kPi* kPi / 2, true},
    {{.shape = ProfileShape::kTrapezoid, .blend = 0.25}, 4. / 3, 16. / 3, true},
    {{.shape = ProfileShape::kTrapezoid, .blend = 0.5}, 2, 4, true},
    {{.shape = ProfileShape::kTrapezoid, .blend = 0.01}, 1 / 0.99, 1 / 0.0099, true},
    {{.shape = ProfileShape::kMinimumJerk}, 15. / 8, 10 / std::sqrt(3.), true},
};

TEST(MotionProfile, LeadsFromZeroToOne) {
  for (const Case& c : kCases) {
    EXPECT_EQ(profileAt(c.profile, 0).position, 0);
    EXPECT_EQ(profileAt(c.profile, 1).position, 1);
    EXPECT_NEAR(profileAt(c.profile, 0.5).position, 0.5, 1e-15);
    EXPECT_EQ(profileAt(c.profile, -0.1).position, 0);
    EXPECT_EQ(profileAt(c.profile, 1.1).position, 1);
    for (const double outside : {-0.1, 1.1}) {
      EXPECT_EQ(profileAt(c.profile, outside).velocity, 0);
      EXPECT_EQ(profileAt(c.profile, outside).acceleration, 0);
    }
    if (!c.startsAtRest) continue;
    EXPECT_NEAR(profileAt(c.profile, 0).velocity, 0, 1e-15);
    EXPECT_NEAR(profileAt(c.profile, 1).velocity, 0, 1e-15);
  }
}

TEST(MotionProfile, RisesAndPeaksWhereItShould) {
  constexpr int kSamples = 100000;
  for (const Case& c : kCases) {
    double before = 0, velocity = 0, acceleration = 0;
    for (int i = 0; i <= kSamples; ++i) {
      const ProfilePoint point = profileAt(c.profile, static_cast<double>(i) / kSamples);
      EXPECT_GE(point.position, before);
      before = point.position;
      velocity = std::max(velocity, std::abs(point.velocity));
      acceleration = std::max(acceleration, std::abs(point.acceleration));
    }
    EXPECT_NEAR(velocity, c.peakVelocity, 1e-8 * c.peakVelocity);
    EXPECT_NEAR(acceleration, c.peakAcceleration, 1e-8 * c.peakAcceleration);
  }
}

TEST(MotionProfile, HasItsDerivatives) {
  for (const Case& c : kCases) {
    for (const double s : {0.123, 0.4, 0.61, 0.87}) {
      const auto value = [&](const Eigen::VectorXd& at) {
        const ProfilePoint point = profileAt(c.profile, at[0]);
        return Eigen::Vector2d(point.position, point.velocity);
      };
      const ProfilePoint point = profileAt(c.profile, s);
      const Eigen::Vector2d derivative(point.velocity, point.acceleration);
      const JacobianCheck check = checkJacobian(value, derivative, Eigen::VectorXd::Constant(1, s), 1e-8);
      EXPECT_TRUE(check.ok) << check.message;
    }
  }
}

TEST(MotionProfile, IsSymmetric) {
  for (const Case& c : kCases)
    for (const double s : {0.003, 0.1, 0.3, 0.499})
      EXPECT_NEAR(profileAt(c.profile, s).position + profileAt(c.profile, 1 - s).position, 1, 1e-14);
}

TEST(MotionProfile, RefusesWhatIsNoProfile) {
  for (const double blend : {0., 0.6, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_REX_ERROR(profileAt({.shape = ProfileShape::kTrapezoid, .blend = blend}, 0.5),
                     "blend of a trapezoid profile: found");
  }
  EXPECT_REX_ERROR(profileAt({}, std::numeric_limits<double>::infinity()),
                   "time of a motion profile: found inf, wanted a finite number");
}

}  // namespace rex::motion_profile_test
