#include "grasping/wrench_cone.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::wrench_cone_test {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

Contact randomContact(Rng& rng) {
  return {rng.normalVector(3), rng.normalVector(3).normalized(), rng.uniform(0.1, 1.5)};
}

// Each edge is a force on the rim of the cone, with its torque about the reference.
TEST(WrenchCone, HasEdgesOnTheRimOfTheFrictionCone) {
  Rng rng(1);
  for (int trial = 0; trial < 100; ++trial) {
    const Contact c = randomContact(rng);
    const WrenchReference reference{rng.normalVector(3), rng.uniform(0.1, 3)};
    const int edges = 3 + rng.index(9);
    const WrenchSet set = primitiveWrenches(wrenchCones(std::vector{c}, reference), edges);
    ASSERT_EQ(set.wrenches.cols(), edges);
    Vector3d sum = Vector3d::Zero();
    for (int k = 0; k < edges; ++k) {
      const Vector3d f = set.wrenches.col(k).head<3>(), torque = set.wrenches.col(k).tail<3>();
      EXPECT_NEAR(f.dot(c.normal_O), 1, 1e-12);
      EXPECT_NEAR((f - c.normal_O).norm(), c.friction, 1e-12);
      EXPECT_TRUE((torque * reference.length).isApprox((c.p_OC - reference.p_OR).cross(f), 1e-12));
      sum += f;
    }
    EXPECT_TRUE(sum.isApprox(edges * c.normal_O, 1e-12));  // evenly around
  }
}

TEST(WrenchCone, TurnsTheTorqueAsThePlaneOfSpaceDoes) {
  Rng rng(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Vector2d p = rng.normalVector(2), n = rng.normalVector(2).normalized();
    const WrenchReference reference{rng.normalVector(3), rng.uniform(0.1, 3)};
    const double friction = rng.uniform(0, 1);
    const WrenchCone flat = wrenchCones(std::vector{PlanarContact{p, n, friction}}, reference)[0];
    const Contact solid{{p.x(), p.y(), reference.p_OR.z()}, {n.x(), n.y(), 0}, friction};
    const WrenchCone cone = wrenchCones(std::vector{solid}, reference)[0];
    EXPECT_TRUE(flat.normal.isApprox(cone.normal(std::vector{0, 1, 5}), 1e-12));
    // The tangent of the plane is one of those in space, up to its sign.
    const MatrixXd tangents = cone.tangents(std::vector{0, 1, 5}, Eigen::all);
    const VectorXd t = flat.tangents.col(0);
    EXPECT_LT(std::min((tangents.colwise() - t).colwise().norm().minCoeff(),
                       (tangents.colwise() + t).colwise().norm().minCoeff()),
              1e-12);
  }
}

TEST(WrenchCone, KnowsItsLowestWrench) {
  Rng rng(4);
  for (int trial = 0; trial < 50; ++trial) {
    const Contact contact = randomContact(rng);
    const std::vector<WrenchCone> cones = wrenchCones(std::vector{contact});
    const VectorXd direction = rng.normalVector(6);
    const VectorXd lowest = cones[0].lowest(direction);
    const VectorXd byAll = primitiveWrenches(cones, 3000).wrenches.transpose() * direction;
    EXPECT_NEAR(direction.dot(lowest), byAll.minCoeff(), 1e-5 * direction.norm());
    EXPECT_LE(direction.dot(lowest), byAll.minCoeff() + 1e-12);
    const Vector3d f = lowest.head<3>();
    EXPECT_NEAR((f - contact.normal_O).norm(), contact.friction, 1e-12);
  }
  const WrenchCone cone = wrenchCones(std::vector{Contact{.friction = 1}})[0];
  EXPECT_EQ(cone.lowest(cone.normal), cone.normal);  // all of the rim is equally low
}

TEST(WrenchCone, CountsEdgesOfEachKind) {
  const Contact smooth{}, rough{.friction = 0.5};
  const WrenchSet set = primitiveWrenches(wrenchCones(std::vector{smooth, rough, smooth}), 4);
  EXPECT_EQ(set.contact, (std::vector{0, 1, 1, 1, 1, 2}));
  EXPECT_EQ(set.wrenches.rows(), 6);
  const std::vector<PlanarContact> planar = {{.friction = 0.5}, {}};
  const WrenchSet flat = primitiveWrenches(wrenchCones(planar));
  EXPECT_EQ(flat.contact, (std::vector{0, 0, 1}));
  EXPECT_EQ(flat.wrenches, (MatrixXd(3, 3) << 1, 1, 1, 0.5, -0.5, 0, 0, 0, 0).finished());
  EXPECT_EQ(primitiveWrenches({}).wrenches.size(), 0);
}

TEST(WrenchCone, WeighsAtTheCentreOfMass) {
  const VectorXd weight = weightWrench(2, {1, 2, 3}, {0, 0, -10}, {{0, 2, 0}, 0.5});
  EXPECT_EQ(weight, (VectorXd(6) << 0, 0, -20, 0, 40, 0).finished());
}

TEST(WrenchCone, RefusesBadInput) {
  const std::vector<Contact> contacts = {{}, {.friction = -1}};
  const std::vector<WrenchCone> cones = wrenchCones(std::vector<Contact>(2));
  EXPECT_REX_ERROR(wrenchCones(contacts), "contact 1: friction: found -1, wanted a finite number, 0 or more");
  EXPECT_REX_ERROR(wrenchCones(std::vector<Contact>(1), {.length = 0}),
                   "wrenches: length: found 0 m, wanted a positive, finite number of metres");
  EXPECT_REX_ERROR(wrenchCones(std::vector<Contact>(1), {.length = HUGE_VAL}), "wrenches: length: found inf");
  EXPECT_REX_ERROR(wrenchCones(std::vector<PlanarContact>(1), {.p_OR = {HUGE_VAL, 0, 0}}),
                   "wrenches: reference point: number 0: found inf");
  EXPECT_REX_ERROR(weightWrench(std::nan(""), {}, {}), "weight: mass: found nan");
  EXPECT_REX_ERROR(weightWrench(1, {0, 0, HUGE_VAL}, {0, 0, 0}), "weight: centre of mass: number 2");
  EXPECT_REX_ERROR(weightWrench(1, {0, 0, 0}, {HUGE_VAL, 0, 0}), "weight: gravity: number 0");
  EXPECT_REX_ERROR(primitiveWrenches(cones, 2), "edges of a friction pyramid: found 2, wanted at least 3");
}

TEST(WrenchCone, RefusesConesThatDoNotFit) {
  const std::vector<WrenchCone> good = wrenchCones(std::vector<Contact>(2));
  const auto broken = [&](auto&& change) {
    std::vector<WrenchCone> cones = good;
    change(cones[1]);
    return primitiveWrenches(cones);
  };
  EXPECT_REX_ERROR(broken([](WrenchCone& c) { c.normal.setZero(3); }),
                   "wrench cone 1: normal: found a vector of size 3, wanted size 6");
  EXPECT_REX_ERROR(broken([](WrenchCone& c) { c.tangents.setZero(6, 3); }),
                   "wrench cone 1: tangents: found 6 x 3, wanted as many rows");
  EXPECT_REX_ERROR(broken([](WrenchCone& c) { c.tangents.conservativeResize(6, 1); }),
                   "wrench cone 1: tangents: found 6 x 1, wanted as many rows as the normal has, and one or "
                   "two columns, as many as cone 0 has");
  EXPECT_REX_ERROR(broken([](WrenchCone& c) { c.normal[0] = HUGE_VAL; }),
                   "wrench cone 1: normal: number 0: found inf");
  EXPECT_REX_ERROR(broken([](WrenchCone& c) { c.tangents(1, 1) = HUGE_VAL; }),
                   "wrench cone 1: tangents: number 1: found inf");
  EXPECT_REX_ERROR(broken([](WrenchCone& c) { c.friction = HUGE_VAL; }),
                   "wrench cone 1: friction: found inf");
  EXPECT_REX_ERROR(broken([](WrenchCone& c) { c.friction = -1; }),
                   "wrench cone 1: friction: found -1, wanted a finite number, 0 or more");
}

}  // namespace rex::wrench_cone_test
