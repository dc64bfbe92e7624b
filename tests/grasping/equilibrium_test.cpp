#include "grasping/equilibrium.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "grasping/closure.h"
#include "support/expect_error.h"

namespace rex::equilibrium_test {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kGravity = 9.81;
const Vector3d kDown(0, 0, -kGravity);

// Two fingers along x, half a metre from the centre.
std::vector<Contact> pinch(double friction) {
  return {{{-0.5, 0, 0}, {1, 0, 0}, friction}, {{0.5, 0, 0}, {-1, 0, 0}, friction}};
}

// Three feet of a table that stands on a slope, in axes of the slope: z is across it.
std::vector<Contact> feet(double friction) {
  return {{{0.2, 0, 0}, {0, 0, 1}, friction},
          {{-0.1, 0.2, 0}, {0, 0, 1}, friction},
          {{-0.1, -0.2, 0}, {0, 0, 1}, friction}};
}

// Forces lie in the cones of the contacts themselves, and balance the load.
void expectBalance(const std::vector<Contact>& contacts, const MatrixXd& forces_C, const VectorXd& load,
                   double limit, double tolerance) {
  VectorXd total = load;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Vector3d f_C = forces_C.col(static_cast<Eigen::Index>(i));
    EXPECT_GE(f_C.x(), 0);
    EXPECT_LE(f_C.x(), limit + tolerance);
    EXPECT_LE(f_C.tail<2>().norm(), contacts[i].friction * f_C.x() + tolerance);
    const Vector3d f_O = contactFrame(contacts[i]) * f_C;
    total.head<3>() += f_O;
    total.tail<3>() += contacts[i].p_OC.cross(f_O);
  }
  EXPECT_LT(total.norm(), tolerance);
}

// The load wins along the direction against anything that the cones can do.
void expectLost(const std::vector<WrenchCone>& cones, const Equilibrium& result, const VectorXd& load,
                double limit) {
  double against = 0;
  for (const WrenchCone& cone : cones) {
    const double most = -result.direction.dot(cone.lowest(result.direction));
    against += most > 1e-8 ? limit * most : 0;
  }
  EXPECT_GT(result.direction.dot(load), against);
}

TEST(Equilibrium, OfAPinchNeedsTheWeightDividedByFriction) {
  for (const double mu : {0.2, 0.7}) {
    const std::vector<WrenchCone> cones = wrenchCones(pinch(mu));
    for (const double angle : {0.0, 0.3, 1.0}) {  // exact cones hold equally well all around
      const Vector3d down = kGravity * Vector3d(0, std::sin(angle), -std::cos(angle));
      const VectorXd load = weightWrench(2, {0, 0, 0}, down);
      const Equilibrium held = equilibrium(cones, load);
      ASSERT_EQ(held.status, EquilibriumStatus::kHeld) << held.message;
      EXPECT_NEAR(held.forces_C.row(0).sum(), 2 * kGravity / mu, 1e-6);
      expectBalance(pinch(mu), held.forces_C, load, HUGE_VAL, 1e-6);
      const LargestLoad most = largestLoad(cones, load, 30);
      EXPECT_EQ(most.status, LoadStatus::kBounded);
      EXPECT_NEAR(most.factor, 2 * mu * 30 / (2 * kGravity), 1e-8);
      expectBalance(pinch(mu), most.forces_C, most.factor * load, 30, 1e-6);
    }
  }
}

TEST(Equilibrium, SaysWhichTurnAPinchCannotHold) {
  const std::vector<WrenchCone> cones = wrenchCones(pinch(0.5));
  const VectorXd load = weightWrench(1, {0, 0.1, 0}, kDown);  // turns about the line of the fingers
  const Equilibrium result = equilibrium(cones, load);
  ASSERT_EQ(result.status, EquilibriumStatus::kNotHeld);
  EXPECT_EQ(result.message, "the load overcomes the contacts in one direction");
  EXPECT_NEAR(result.direction[3], -1, 1e-12);
  EXPECT_NEAR(result.residual, 0.1 * kGravity, 1e-9);
  const LargestLoad most = largestLoad(cones, load);
  EXPECT_EQ(most.status, LoadStatus::kBounded);
  EXPECT_NEAR(most.factor, 0, 1e-12);
  EXPECT_NEAR(most.direction[3], -1, 1e-9);
}

TEST(Equilibrium, OnASlopeEndsWhereItsTangentIsTheFriction) {
  const double mu = 0.4;
  const std::vector<WrenchCone> cones = wrenchCones(feet(mu));
  Rng rng(41);
  for (int trial = 0; trial < 50; ++trial) {
    const double heading = rng.uniform(0, 2 * std::numbers::pi);
    for (const double slope : {0.5 * mu, 0.999 * mu, 1.001 * mu, 2 * mu}) {
      const Vector3d down =
          kGravity * Vector3d(slope * std::cos(heading), slope * std::sin(heading), -1).normalized();
      const VectorXd load = weightWrench(3, {0, 0, 0}, down);
      const Equilibrium result = equilibrium(cones, load);
      EXPECT_EQ(result.status, slope < mu ? EquilibriumStatus::kHeld : EquilibriumStatus::kNotHeld)
          << heading << " " << slope;
      if (slope < mu) expectBalance(feet(mu), result.forces_C, load, HUGE_VAL, 1e-6);
      if (slope > mu) expectLost(cones, result, load, HUGE_VAL);
    }
  }
}

TEST(Equilibrium, NeedsTheWeightAboveTheFeet) {
  const std::vector<WrenchCone> cones = wrenchCones(feet(0.4));
  for (const double x : {-0.101, -0.099, 0.0, 0.199, 0.201}) {
    const Equilibrium result = equilibrium(cones, weightWrench(1, {x, 0, 0.3}, kDown));
    EXPECT_EQ(result.status, x > -0.1 && x < 0.2 ? EquilibriumStatus::kHeld : EquilibriumStatus::kNotHeld)
        << x;
  }
}

// Any load is held by a force closure grasp, and only by one; the limit scales what is held.
TEST(Equilibrium, FollowsForceClosureAndLimits) {
  Rng rng(42);
  int closed = 0, held = 0, lost = 0;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Contact> contacts;
    for (int i = 0; i < 3; ++i) {
      const double angle = 2 * std::numbers::pi * i / 3 + rng.uniform(-0.5, 0.5);
      const Vector3d p(std::cos(angle), std::sin(angle), rng.uniform(-0.3, 0.3));
      contacts.push_back({p, -p.normalized(), rng.uniform(0.2, 0.9)});
    }
    const std::vector<WrenchCone> cones = wrenchCones(contacts);
    const VectorXd load = rng.normalVector(6);
    const bool isClosed = forceClosure(cones).closure.status == ClosureStatus::kClosed;
    closed += isClosed;
    if (isClosed) {
      EXPECT_EQ(largestLoad(cones, load).status, LoadStatus::kUnbounded);
    }
    const double limit = 5;
    const Equilibrium result = equilibrium(cones, load, limit);
    const LargestLoad most = largestLoad(cones, load, limit);
    SCOPED_TRACE(trial);
    ASSERT_EQ(most.status, LoadStatus::kBounded);
    ASSERT_NE(result.status, EquilibriumStatus::kUndecided) << result.message;
    EXPECT_EQ(result.status == EquilibriumStatus::kHeld, most.factor >= 1) << most.factor;
    expectBalance(contacts, most.forces_C, most.factor * load, limit, 1e-6);
    EXPECT_NEAR(largestLoad(cones, load, 1e7 * limit).factor, 1e7 * most.factor, 1e-6 * 1e7 * most.factor);
    if (result.status == EquilibriumStatus::kHeld) {
      ++held;
      expectBalance(contacts, result.forces_C, load, limit, 1e-6);
      EXPECT_EQ(equilibrium(cones, load, 1e9).status, EquilibriumStatus::kHeld);
    } else {
      ++lost;
      expectLost(cones, result, load, limit);
    }
    // Along the direction that gives way first, that multiple is all that the contacts can do.
    double against = 0;
    for (const WrenchCone& cone : cones)
      against += limit * std::max(0.0, -most.direction.dot(cone.lowest(most.direction)));
    EXPECT_NEAR(most.factor * most.direction.dot(load), against, 1e-6);
  }
  EXPECT_GT(closed, 20);
  EXPECT_GT(held, 20);
  EXPECT_GT(lost, 20);
}

TEST(Equilibrium, HoldsInThePlane) {
  const std::vector<PlanarContact> contacts = {{{-1, 0}, {1, 0}, 0.5}, {{1, 0}, {-1, 0}, 0.5}};
  const Equilibrium held = equilibrium(wrenchCones(contacts), Vector3d(0, -3, 0));
  ASSERT_EQ(held.status, EquilibriumStatus::kHeld);
  EXPECT_NEAR((held.forces_C - (MatrixXd(2, 2) << 3, 3, 1.5, -1.5).finished()).norm(), 0, 1e-12);
}

TEST(Equilibrium, WithoutContactsOrLoad) {
  const Equilibrium nothing = equilibrium({}, VectorXd::Zero(6));
  EXPECT_EQ(nothing.status, EquilibriumStatus::kHeld);
  EXPECT_EQ(nothing.message, "there is no load, and no contact");
  const Equilibrium falls = equilibrium({}, Vector3d(0, -2, 0));
  EXPECT_EQ(falls.status, EquilibriumStatus::kNotHeld);
  EXPECT_EQ(falls.message, "there are no contacts");
  EXPECT_EQ(falls.direction, VectorXd(Vector3d(0, -1, 0)));
  EXPECT_EQ(falls.residual, 2);
  const Equilibrium rests = equilibrium(wrenchCones(pinch(0.5)), VectorXd::Zero(6), 1);
  EXPECT_EQ(rests.status, EquilibriumStatus::kHeld);
  EXPECT_LT(rests.forces_C.norm(), 1e-12);
  const LargestLoad none = largestLoad({}, Vector3d(0, -2, 0));
  EXPECT_EQ(none.status, LoadStatus::kBounded);
  EXPECT_EQ(none.factor, 0);
  EXPECT_EQ(none.message, "there are no contacts");
}

TEST(Equilibrium, SaysWhenRoundingDecides) {
  const std::vector<WrenchCone> cones = wrenchCones(std::vector<PlanarContact>{{{0, 0}, {0, 1}, 0.5}});
  EXPECT_EQ(equilibrium(cones, Vector3d(0.5, -1, 0)).status, EquilibriumStatus::kHeld);
  EXPECT_EQ(equilibrium(cones, Vector3d(0.5 + 1e-6, -1, 0)).status, EquilibriumStatus::kNotHeld);
  EXPECT_EQ(equilibrium(cones, Vector3d(0.5 + 1.1e-9, -1, 0)).message,
            "rounding decides whether the load is held");
}

TEST(Equilibrium, RefusesBadInput) {
  const std::vector<WrenchCone> cones = wrenchCones(pinch(0.5));
  VectorXd load = VectorXd::Ones(6);
  EXPECT_REX_ERROR(equilibrium(cones, VectorXd::Ones(3)),
                   "equilibrium: load: found a vector of size 3, wanted size 6");
  EXPECT_REX_ERROR(equilibrium(cones, load, 0),
                   "equilibrium: largest normal force: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(equilibrium(cones, load, HUGE_VAL), "equilibrium: largest normal force: found inf");
  std::vector<WrenchCone> mixed = cones;
  mixed[0].tangents.conservativeResize(6, 1);
  EXPECT_REX_ERROR(equilibrium(mixed, load), "wrench cone 1: tangents: found 6 x 2, wanted as many rows");
  EXPECT_REX_ERROR(largestLoad(cones, VectorXd::Zero(6)), "largest load: found a load of zero");
  load[2] = std::nan("");
  EXPECT_REX_ERROR(equilibrium(cones, load), "equilibrium: load: number 2: found nan");
}

}  // namespace rex::equilibrium_test
