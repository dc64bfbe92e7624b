#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "dynamics/centroidal.h"
#include "scene/state.h"
#include "support/expect_error.h"
#include "support/random_motion.h"

namespace rex::momentum_rate_test {

// The momenta about W's origin, differentiated by time along q + v t + a t^2 / 2.
TEST(MomentumRate, IsTheDerivativeOfTheMomenta) {
  Rng rng(341);
  for (int i = 0; i < 20; ++i) {
    const Model model = randomModel(rng, 2 + 2 * i, Followers::kSome);
    const RandomMotion motion(rng, model);
    const Eigen::VectorXd a = rng.normalVector(model.nv());
    const VectorFunction momenta = [&](const Eigen::VectorXd& t) {
      const Eigen::VectorXd q = integrate(model, motion.q, t[0] * motion.v + t[0] * t[0] / 2 * a);
      const Centroidal all = centroidal(model, forwardKinematics(model, q), motion.v + t[0] * a);
      Eigen::VectorXd both(6);
      both << all.linearMomentum, all.angularMomentum + all.center.cross(all.linearMomentum);
      return both;
    };
    const Eigen::VectorXd wanted = numericJacobian(momenta, Eigen::VectorXd::Zero(1));
    const MomentumRate rate = momentumRate(model, forwardKinematics(model, motion.q), motion.v, a);
    EXPECT_LE((rate.force - wanted.head<3>()).norm(), 1e-7 * wanted.norm()) << "model " << i;
    EXPECT_LE((rate.torque - wanted.tail<3>()).norm(), 1e-7 * wanted.norm()) << "model " << i;
  }
}

TEST(MomentumRate, NamesWrongSizes) {
  Rng rng(342);
  const Model model = randomModel(rng, 3, Followers::kNone);
  const RandomMotion motion(rng, model);
  const BodyPoses poses = forwardKinematics(model, motion.q);
  const Eigen::VectorXd longer = Eigen::VectorXd::Zero(model.nv() + 1);
  EXPECT_REX_ERROR(momentumRate(model, poses, longer, motion.v),
                   "joint velocities v: found a vector of size");
  EXPECT_REX_ERROR(momentumRate(model, poses, motion.v, longer),
                   "joint accelerations a: found a vector of size");
}

}  // namespace rex::momentum_rate_test
