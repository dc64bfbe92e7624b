#include "grasping/quality.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "grasping/closure.h"
#include "support/expect_error.h"

namespace rex::quality_test {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

std::vector<PlanarContact> antipodal(double friction) {
  return {{{-1, 0}, {1, 0}, friction}, {{1, 0}, {-1, 0}, friction}};
}

std::vector<Contact> cubeFaces(double friction) {
  std::vector<Contact> contacts;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1., -1.})
      contacts.push_back({sign * Vector3d::Unit(axis), -sign * Vector3d::Unit(axis), friction});
  return contacts;
}

GraspQuality qualityOf(const std::vector<WrenchCone>& cones, int edges = 8) {
  return graspQuality(primitiveWrenches(cones, edges).wrenches);
}

TEST(Quality, OfTwoFingersInThePlane) {
  for (const double mu : {0.1, 0.5, 1., 2.}) {
    const double known = mu / std::sqrt(2 + mu * mu);
    const std::vector<WrenchCone> cones = wrenchCones(antipodal(mu));
    EXPECT_NEAR(qualityOf(cones).epsilon, known, 1e-14);
    EXPECT_NEAR(qualityOf(cones).volume, 8 * mu * mu / 3, 1e-13);  // a tetrahedron
    // In other units of length, with the matching reference.
    std::vector<PlanarContact> large = antipodal(mu);
    for (PlanarContact& contact : large) contact.p_OC *= 7;
    EXPECT_NEAR(qualityOf(wrenchCones(large, {.length = 7})).epsilon, known, 1e-14);
    EXPECT_NEAR(exactEpsilon(cones).atLeast, known, 1e-14);
  }
}

TEST(Quality, OfACubeHeldAtAllFaces) {
  for (const double mu : {0.1, 0.3, 0.5}) {
    const std::vector<WrenchCone> cones = wrenchCones(cubeFaces(mu));
    const double known = mu * std::sqrt(2. / 3);
    EXPECT_NEAR(qualityOf(cones, 8).epsilon, known, 1e-12) << mu;
    EXPECT_NEAR(qualityOf(cones, 4).epsilon, mu / std::sqrt(3), 1e-12) << mu;  // edges along the axes
    const EpsilonBounds exact = exactEpsilon(cones, 1e-9);
    EXPECT_NEAR(exact.atLeast, known, 1e-9) << mu;
    EXPECT_NEAR(exact.atMost, known, 1e-9) << mu;
  }
}

TEST(Quality, OfASmoothSquare) {
  MatrixXd wrenches(3, 4);
  wrenches << 1, -1, 0, 0, 0, 0, 1, -1, 0.5, 0.5, -0.5, -0.5;
  const GraspQuality quality = graspQuality(wrenches);
  EXPECT_EQ(quality.status, HullStatus::kInside);
  EXPECT_NEAR(quality.epsilon, .3535533906, 1e-10);
  // The same from contacts on a square of half edge one.
  const std::vector<PlanarContact> contacts = {
      {{-1, -0.5}, {1, 0}}, {{1, 0.5}, {-1, 0}}, {{-0.5, -1}, {0, 1}}, {{0.5, 1}, {0, -1}}};
  EXPECT_NEAR(qualityOf(wrenchCones(contacts)).epsilon, std::sqrt(1. / 8), 1e-14);
}

// The verdicts of the hull and of the linear program are those of two algorithms that share nothing.
TEST(Quality, AgreesWithTheLinearProgramOnTenThousandGrasps) {
  Rng rng(31);
  int inside = 0;
  for (int trial = 0; trial < 10'000; ++trial) {
    MatrixXd wrenches;
    if (trial % 2 == 0) {
      std::vector<PlanarContact> contacts;
      for (int i = 2 + rng.index(4); i > 0; --i) {
        const Vector2d p = rng.normalVector(2).normalized();
        contacts.push_back({p, (0.7 * rng.normalVector(2) - p).normalized(), rng.uniform(0, 1)});
      }
      wrenches = primitiveWrenches(wrenchCones(contacts)).wrenches;
    } else {
      std::vector<Contact> contacts;
      for (int i = 2 + rng.index(3); i > 0; --i) {
        const Vector3d p = rng.normalVector(3).normalized();
        contacts.push_back({p, (0.3 * rng.normalVector(3) - p).normalized(), rng.uniform(0.2, 1.2)});
      }
      wrenches = primitiveWrenches(wrenchCones(contacts), 3 + rng.index(2)).wrenches;
    }
    const Closure byProgram = forceClosure(wrenches);
    const GraspQuality byHull = graspQuality(wrenches);
    ASSERT_NE(byProgram.status, ClosureStatus::kUndecided) << trial;
    EXPECT_EQ(byHull.status == HullStatus::kInside, byProgram.status == ClosureStatus::kClosed) << trial;
    EXPECT_EQ(byHull.epsilon > 0, byHull.status == HullStatus::kInside) << trial;
    inside += byHull.status == HullStatus::kInside;
  }
  EXPECT_GT(inside, 2000);
  EXPECT_LT(inside, 8000);
}

// No direction is reached less far than epsilon, and the weakest one exactly so.
TEST(Quality, IsTheLeastReach) {
  Rng rng(32);
  int inside = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const int d = 2 + trial % 5;
    const MatrixXd wrenches = rng.normalVector(d * 4 * d).reshaped(d, 4 * d);
    const GraspQuality quality = graspQuality(wrenches);
    if (quality.status != HullStatus::kInside) continue;
    ++inside;
    EXPECT_NEAR((quality.weakest.transpose() * wrenches).maxCoeff(), quality.epsilon, 1e-12);
    for (int k = 0; k < 1000; ++k) {
      const VectorXd direction = (quality.weakest + 0.3 * rng.normalVector(d)).normalized();
      EXPECT_GE((direction.transpose() * wrenches).maxCoeff(), quality.epsilon - 1e-12);
    }
  }
  EXPECT_GT(inside, 30);
}

TEST(Quality, OfExactConesLiesBetweenThoseOfPyramids) {
  Rng rng(33);
  int closed = 0;
  for (int trial = 0; trial < 6; ++trial) {
    std::vector<Contact> contacts;
    for (int i = 0; i < 3; ++i) {
      const double angle = 2 * std::numbers::pi * i / 3 + rng.uniform(-0.3, 0.3);
      const Vector3d p(std::cos(angle), std::sin(angle), rng.uniform(-0.2, 0.2));
      contacts.push_back({p, -p.normalized(), rng.uniform(0.5, 0.9)});
    }
    const std::vector<WrenchCone> cones = wrenchCones(contacts);
    const EpsilonBounds exact = exactEpsilon(cones, 1e-4);
    EXPECT_LE(exact.atMost - exact.atLeast, 1e-4) << trial;
    EXPECT_GE(exact.atLeast, qualityOf(cones, 8).epsilon - 1e-12);
    for (Contact& contact : contacts) contact.friction /= std::cos(std::numbers::pi / 12);
    EXPECT_LE(exact.atMost, qualityOf(wrenchCones(contacts), 12).epsilon + 1e-4);
    closed += exact.status == HullStatus::kInside;
  }
  EXPECT_GT(closed, 3);
}

// All sums of one wrench per finger: nothing, or one of the two edges of its cone.
MatrixXd sumsOf(const std::vector<WrenchCone>& cones) {
  const MatrixXd edges = primitiveWrenches(cones).wrenches;
  MatrixXd sums = MatrixXd::Zero(3, 1);
  for (Eigen::Index i = 0; i < edges.cols(); i += 2) {
    MatrixXd more(3, 3 * sums.cols());
    more << sums, sums.colwise() + edges.col(i), sums.colwise() + edges.col(i + 1);
    sums = more;
  }
  return sums;
}

TEST(Quality, OfFingersThatAreLimitedEach) {
  Rng rng(34);
  int closed = 0;
  for (int trial = 0; trial < 30; ++trial) {
    std::vector<PlanarContact> contacts;
    for (int i = 0; i < 2 + trial % 3; ++i) {
      const double angle = rng.uniform(0, 2 * std::numbers::pi);
      const Vector2d p(std::cos(angle), std::sin(angle));
      contacts.push_back({p, -p, rng.uniform(0.3, 0.9)});
    }
    const std::vector<WrenchCone> cones = wrenchCones(contacts);
    const EpsilonBounds each = exactEpsilon(cones, 1e-9, 100, ForceBudget::kPerFinger);
    const EpsilonBounds shared = exactEpsilon(cones, 1e-9);
    EXPECT_EQ(each.status, shared.status);
    if (each.status != HullStatus::kInside) continue;
    ++closed;
    EXPECT_NEAR(each.atLeast, graspQuality(sumsOf(cones)).epsilon, 1e-9) << trial;
    EXPECT_LE(each.atMost - each.atLeast, 1e-9);
    EXPECT_GE(each.atLeast, shared.atLeast - 1e-9);
    EXPECT_LE(each.atLeast, static_cast<double>(cones.size()) * shared.atMost + 1e-9);
  }
  EXPECT_GT(closed, 8);
}

// In space, no direction may reach less than what is proven, and `weakest` reaches what is claimed.
TEST(Quality, OfACubeWhoseFingersAreLimitedEach) {
  const std::vector<WrenchCone> cones = wrenchCones(cubeFaces(0.5));
  const EpsilonBounds each = exactEpsilon(cones, 1e-3, 14, ForceBudget::kPerFinger);
  const auto reach = [&](const VectorXd& direction) {
    double sum = 0;
    for (const WrenchCone& cone : cones) sum += std::max(0., direction.dot(cone.lowest(-direction)));
    return sum;
  };
  EXPECT_NEAR(reach(each.weakest), each.atMost, 1e-12);
  EXPECT_LE(each.atMost, 1.5 * each.atLeast);
  EXPECT_GT(each.atLeast, exactEpsilon(cones, 1e-3).atMost);
  Rng rng(35);
  for (int k = 0; k < 20000; ++k) ASSERT_GE(reach(rng.normalVector(6).normalized()), each.atLeast);
}

TEST(Quality, SaysWhatIsWrongWithAHull) {
  EXPECT_EQ(graspQuality(MatrixXd(3, 0)).status, HullStatus::kEmpty);
  EXPECT_EQ(graspQuality(MatrixXd(3, 0)).dimension, -1);
  EXPECT_EQ(graspQuality(primitiveWrenches({}).wrenches).status, HullStatus::kEmpty);
  EXPECT_EQ(exactEpsilon({}).status, HullStatus::kEmpty);
  EXPECT_EQ(exactEpsilon({}).atMost, 0);
  // Two contacts in space cannot turn the object about their line.
  const std::vector<Contact> two = {{{-1, 0, 0}, {1, 0, 0}, 0.5}, {{1, 0, 0}, {-1, 0, 0}, 0.5}};
  const GraspQuality flat = qualityOf(wrenchCones(two));
  EXPECT_EQ(flat.status, HullStatus::kFlat);
  EXPECT_EQ(flat.dimension, 5);
  EXPECT_EQ(flat.epsilon, 0);
  EXPECT_EQ(flat.volume, 0);
  EXPECT_EQ(exactEpsilon(wrenchCones(two)).status, HullStatus::kFlat);
  EXPECT_EQ(exactEpsilon(wrenchCones(two)).atMost, 0);
  // Two planar fingers that push from the same side.
  const std::vector<PlanarContact> oneSide = {{{-1, 1}, {1, 0}, 0.5}, {{-1, -1}, {1, 0}, 0.5}};
  const EpsilonBounds open = exactEpsilon(wrenchCones(oneSide));
  EXPECT_EQ(qualityOf(wrenchCones(oneSide)).status, HullStatus::kFlat);  // one newton each: fx = 1 always
  EXPECT_EQ(open.atMost, 0);
  std::vector<PlanarContact> three = oneSide;
  three.push_back({{0, 2}, {0, -1}, 0.1});
  const GraspQuality outside = qualityOf(wrenchCones(three));
  EXPECT_EQ(outside.status, HullStatus::kOutside);
  EXPECT_EQ(outside.epsilon, 0);
  EXPECT_GT(outside.volume, 0);
  EXPECT_LE((outside.weakest.transpose() * primitiveWrenches(wrenchCones(three)).wrenches).maxCoeff(), 0);
  EXPECT_EQ(exactEpsilon(wrenchCones(three)).status, HullStatus::kOutside);
  EXPECT_EQ(exactEpsilon(wrenchCones(three)).atMost, 0);
}

TEST(Quality, RefusesBadInput) {
  EXPECT_REX_ERROR(exactEpsilon(wrenchCones(antipodal(0.5)), 0),
                   "epsilon: tolerance: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(exactEpsilon(wrenchCones(antipodal(0.5)), HUGE_VAL), "epsilon: tolerance: found inf");
  EXPECT_REX_ERROR(exactEpsilon(wrenchCones(antipodal(0.5)), 1e-6, -1),
                   "epsilon: rounds: found -1, wanted 0 or more");
  EXPECT_REX_ERROR(graspQuality(MatrixXd::Constant(3, 4, std::nan(""))),
                   "hull: point 0: number 0: found nan");
}

}  // namespace rex::quality_test
