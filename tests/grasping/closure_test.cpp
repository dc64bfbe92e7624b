#include "grasping/closure.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::closure_test {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// What the verdict claims, put into the wrenches themselves.
void expectProven(const MatrixXd& wrenches, const Closure& closure) {
  EXPECT_EQ(closure.rank, Eigen::FullPivLU<MatrixXd>(wrenches).rank());
  if (closure.status == ClosureStatus::kClosed) {
    EXPECT_EQ(closure.rank, wrenches.rows());
    EXPECT_GT(closure.weights.minCoeff(), 0);
    EXPECT_NEAR(closure.weights.sum(), 1, 1e-12);
    EXPECT_LT((wrenches * closure.weights).norm(), 1e-9);
    EXPECT_EQ(closure.direction.size(), 0);
  } else if (closure.status == ClosureStatus::kOpen) {
    EXPECT_NEAR(closure.direction.norm(), 1, 1e-12);
    EXPECT_GT((wrenches.transpose() * closure.direction).minCoeff(), -1e-8);
    EXPECT_EQ(closure.weights.size(), 0);
  } else {
    ADD_FAILURE() << closure.message;
  }
}

std::vector<Contact> randomContacts(Rng& rng, int count) {
  std::vector<Contact> contacts;
  for (int i = 0; i < count; ++i) {
    const Vector3d p = rng.normalVector(3).normalized();
    contacts.push_back({p, (0.4 * rng.normalVector(3) - p).normalized(), rng.uniform(0, 1)});
  }
  return contacts;
}

TEST(Closure, ProvesItsVerdictOnRandomWrenches) {
  Rng rng(21);
  int closed = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const int d = 1 + rng.index(6);
    const MatrixXd wrenches = rng.normalVector(d * (d + rng.index(2 * d + 3))).reshaped(d, Eigen::AutoSize);
    const Closure closure = forceClosure(wrenches);
    SCOPED_TRACE(trial);
    expectProven(wrenches, closure);
    closed += closure.status == ClosureStatus::kClosed;
  }
  EXPECT_GT(closed, 300);
  EXPECT_LT(closed, 1700);
}

TEST(Closure, SeesThatWrenchesAreFlat) {
  MatrixXd wrenches(3, 4);
  wrenches << 1, -1, 0, 0, 0, 0, 1, -1, 0, 0, 0, 0;
  const Closure flat = forceClosure(wrenches);
  EXPECT_EQ(flat.status, ClosureStatus::kOpen);
  EXPECT_EQ(flat.rank, 2);
  EXPECT_EQ(flat.message, "the wrenches span 2 of 3 dimensions");
  EXPECT_NEAR(std::abs(flat.direction[2]), 1, 1e-12);
  // All of space spanned, but on one side, with the origin on the border or not.
  wrenches.row(2) << 0, 0, 1, 0;
  const Closure border = forceClosure(wrenches);
  expectProven(wrenches, border);
  EXPECT_EQ(border.status, ClosureStatus::kOpen);
  EXPECT_EQ(border.message, "all wrenches lie on one side of a plane");
  wrenches.row(2) << 1, 1, 1, 1;
  expectProven(wrenches, forceClosure(wrenches));
  EXPECT_EQ(forceClosure(wrenches).status, ClosureStatus::kOpen);
  wrenches.row(2) << 1, 1, -1, -1;
  EXPECT_EQ(forceClosure(wrenches).status, ClosureStatus::kClosed);
  EXPECT_EQ(forceClosure(MatrixXd::Zero(3, 4)).rank, 0);
  EXPECT_EQ(forceClosure(MatrixXd::Zero(3, 4)).status, ClosureStatus::kOpen);
}

TEST(Closure, SaysWhenRoundingDecides) {
  const auto tilted = [](double tilt) {
    return (MatrixXd(2, 3) << 1, -0.7, 0.1, tilt, 0.3 * tilt, 0.5).finished();
  };
  for (const double tilt : {1e-3, 1e-7, 1e-12, 0.0, -1e-7, -1e-3}) {
    const Closure closure = forceClosure(tilted(tilt));
    expectProven(tilted(tilt), closure);
    EXPECT_EQ(closure.status, tilt < 0 ? ClosureStatus::kClosed : ClosureStatus::kOpen) << tilt;
  }
  const Closure closure = forceClosure(tilted(-1e-10));
  EXPECT_EQ(closure.status, ClosureStatus::kUndecided);
  EXPECT_EQ(closure.message, "rounding decides whether the wrenches counteract all others");
  EXPECT_EQ(closure.weights.size() + closure.direction.size(), 0);
}

TEST(Closure, WithoutContactsIsOpen) {
  const Closure none = forceClosure(MatrixXd(6, 0));
  EXPECT_EQ(none.status, ClosureStatus::kOpen);
  EXPECT_EQ(none.message, "there are no contacts");
  EXPECT_EQ(none.rank, 0);
  EXPECT_EQ(forceClosure(std::vector<WrenchCone>()).closure.message, "there are no contacts");
  EXPECT_EQ(formClosure({}).message, "there are no contacts");
}

// Two fingers of the plane hold exactly if the line between them lies inside both cones (Nguyen, 1988).
TEST(Closure, OfTwoPlanarContactsIsThatOfNguyen) {
  Rng rng(22);
  int closed = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Vector2d p = rng.normalVector(2), q = rng.normalVector(2), line = (q - p).normalized();
    const auto turned = [&](const Vector2d& v) { return Eigen::Rotation2Dd(rng.uniform(-1, 1)) * v; };
    const std::vector<PlanarContact> contacts = {{p, turned(line), rng.uniform(0.1, 1)},
                                                 {q, turned(-line), rng.uniform(0.1, 1)}};
    const auto isInside = [&](const PlanarContact& contact, const Vector2d& along) {
      return std::acos(along.dot(contact.normal_O)) < std::atan(contact.friction);
    };
    const bool holds = isInside(contacts[0], line) && isInside(contacts[1], -line);
    const std::vector<WrenchCone> cones = wrenchCones(contacts, {{0.3, -2, 0}, 0.7});
    const ConeClosure exact = forceClosure(cones);
    EXPECT_EQ(exact.closure.status == ClosureStatus::kClosed, holds) << trial;
    expectProven(exact.set.wrenches, exact.closure);
    closed += holds;
  }
  EXPECT_GT(closed, 200);
}

TEST(Closure, OfTwoContactsInSpaceLeavesTheTurnAboutTheirLine) {
  const std::vector<Contact> contacts = {{{-1, 0, 0}, {1, 0, 0}, 0.5}, {{1, 0, 0}, {-1, 0, 0}, 0.5}};
  const ConeClosure grasp = forceClosure(wrenchCones(contacts));
  EXPECT_EQ(grasp.closure.status, ClosureStatus::kOpen);
  EXPECT_EQ(grasp.closure.rank, 5);
  EXPECT_NEAR(std::abs(grasp.closure.direction[3]), 1, 1e-12);
}

// The exact cones lie between a pyramid inside and one outside.
TEST(Closure, OfConesLiesBetweenThoseOfPyramids) {
  Rng rng(23);
  int closed = 0, open = 0, moreThanPyramid = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    std::vector<Contact> contacts = randomContacts(rng, 3);
    const std::vector<WrenchCone> cones = wrenchCones(contacts);
    const ConeClosure exact = forceClosure(cones);
    SCOPED_TRACE(trial);
    expectProven(exact.set.wrenches, exact.closure);
    const bool isClosed = exact.closure.status == ClosureStatus::kClosed;
    (isClosed ? closed : open) += 1;
    const auto holds = [](std::span<const WrenchCone> all, int edges) {
      return forceClosure(primitiveWrenches(all, edges).wrenches).status == ClosureStatus::kClosed;
    };
    EXPECT_LE(holds(cones, 8), isClosed);
    moreThanPyramid += isClosed && !holds(cones, 8);
    for (Contact& contact : contacts) contact.friction /= std::cos(std::numbers::pi / 64);
    EXPECT_GE(holds(wrenchCones(contacts), 64), isClosed);
    if (!isClosed) {
      for (const WrenchCone& cone : cones)
        EXPECT_GT(exact.closure.direction.dot(cone.lowest(exact.closure.direction)), -1e-8);
    }
  }
  EXPECT_GT(closed, 50);
  EXPECT_GT(open, 50);
  EXPECT_GT(moreThanPyramid, 0);
}

TEST(Closure, DoesNotDependOnTheReference) {
  Rng rng(24);
  int closed = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const std::vector<Contact> contacts = randomContacts(rng, 4);
    const ClosureStatus status = forceClosure(wrenchCones(contacts)).closure.status;
    EXPECT_EQ(forceClosure(wrenchCones(contacts, {rng.normalVector(3), 0.2})).closure.status, status);
    closed += status == ClosureStatus::kClosed;
  }
  EXPECT_GT(closed, 20);
}

std::vector<Contact> cubeFaces(double friction) {
  std::vector<Contact> contacts;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1., -1.})
      contacts.push_back({sign * Vector3d::Unit(axis), -sign * Vector3d::Unit(axis), friction});
  return contacts;
}

TEST(Closure, DoesNotDependOnAReferenceFarAwayOrInAnotherUnit) {
  Rng rng(26);
  const std::vector<Contact> two = {{{-1, 0, 0}, {1, 0, 0}, 0.5}, {{1, 0, 0}, {-1, 0, 0}, 0.5}};
  const std::vector<PlanarContact> flat = {{{-1, 0}, {1, 0}, 0.5}, {{1, 0}, {-1, 0}, 0.5}};
  const std::vector<PlanarContact> smooth = {
      {{-1, -0.5}, {1, 0}}, {{1, 0.5}, {-1, 0}}, {{-0.5, -1}, {0, 1}}, {{0.5, 1}, {0, -1}}};
  for (const double far : {0., 1e2, 1e4, 1e5})
    for (const double length : {1e-10, 1., 1e10}) {
      const WrenchReference reference{far * rng.normalVector(3).normalized(), length};
      SCOPED_TRACE(testing::Message() << far << " m, in units of " << length);
      const Closure cube = forceClosure(wrenchCones(cubeFaces(0.5), reference)).closure;
      EXPECT_EQ(cube.status, ClosureStatus::kClosed) << cube.message;
      EXPECT_EQ(cube.rank, 6);
      EXPECT_EQ(forceClosure(wrenchCones(flat, reference)).closure.status, ClosureStatus::kClosed);
      EXPECT_EQ(formClosure(wrenchCones(smooth, reference)).status, ClosureStatus::kClosed);
      const Closure open = forceClosure(wrenchCones(two, reference)).closure;
      EXPECT_EQ(open.status, ClosureStatus::kOpen) << open.message;
      EXPECT_EQ(open.rank, 5);
      EXPECT_EQ(open.message, "the wrenches span 5 of 6 dimensions");
    }
  const std::vector<WrenchCone> tooFar = wrenchCones(two, {{1e9, 0, 0}});
  EXPECT_EQ(forceClosure(tooFar).closure.status, ClosureStatus::kUndecided);
  const std::vector<Contact> onePlace = {{{1, 2, 3}, {1, 0, 0}, 0.5}, {{1, 2, 3}, {-1, 0, 0}, 0.5}};
  EXPECT_EQ(forceClosure(wrenchCones(onePlace)).closure.message, "the wrenches span 3 of 6 dimensions");
  EXPECT_EQ(forceClosure(wrenchCones(onePlace, {{1, 2, 3}})).closure.rank, 3);
}

// The turn about their line that two contacts leave free, in the wrenches of their reference.
TEST(Closure, GivesTheOpenDirectionOfItsReference) {
  const std::vector<Contact> two = {{{-1, 0, 0}, {1, 0, 0}, 0.5}, {{1, 0, 0}, {-1, 0, 0}, 0.5}};
  const ConeClosure grasp = forceClosure(wrenchCones(two, {{5, 3, -2}, 0.7}));
  expectProven(grasp.set.wrenches, grasp.closure);
  const Vector3d arm(0, -3, 2), turn(1, 0, 0);  // to the line from the reference
  VectorXd known(6);
  known << arm.cross(turn), 0.7 * turn;  // velocity of the reference point, and the turn: power is zero
  EXPECT_NEAR(std::abs(grasp.closure.direction.dot(known.normalized())), 1, 1e-12);
}

TEST(Closure, IsUndecidedWhereRoundingDecidesTheRank) {
  const auto thin = [](double width) { return (MatrixXd(2, 3) << 1, -1, 1, width, 0, -width).finished(); };
  EXPECT_EQ(forceClosure(thin(1e-8)).status, ClosureStatus::kClosed);
  EXPECT_EQ(forceClosure(thin(1e-10)).status, ClosureStatus::kUndecided);
  EXPECT_EQ(forceClosure(thin(1e-10)).message, "rounding decides whether the wrenches counteract all others");
  EXPECT_EQ(forceClosure(thin(1e-13)).message, "the wrenches span 1 of 2 dimensions");
}

// Four smooth fingers on a square hold it if they turn it both ways, and not if all point at its centre or
// turn it the same way.
TEST(Closure, OfFormIsThatWithoutFriction) {
  const auto square = [](double x, double y) {
    return wrenchCones(std::vector<PlanarContact>{
        {{x, -1}, {0, 1}, 1}, {{-x, 1}, {0, -1}, 1}, {{1, y}, {-1, 0}, 1}, {{-1, -y}, {1, 0}, 1}});
  };
  EXPECT_EQ(formClosure(square(0, 0)).rank, 2);
  EXPECT_EQ(formClosure(square(0, 0)).status, ClosureStatus::kOpen);
  EXPECT_EQ(forceClosure(square(0, 0)).closure.status, ClosureStatus::kClosed);
  EXPECT_EQ(formClosure(square(0.5, 0.5)).status, ClosureStatus::kOpen);
  EXPECT_EQ(formClosure(square(0.5, -0.5)).status, ClosureStatus::kClosed);
}

// Three smooth fingers at the middles of the edges of a triangle: no form closure, since no wrench turns it,
// but every small motion drives an edge into a finger.
TEST(Closure, OfFormIsOfFirstOrder) {
  std::vector<PlanarContact> fingers;
  for (int k = 0; k < 3; ++k) {
    const double angle = 2 * std::numbers::pi * k / 3;
    const Vector2d out(std::cos(angle), std::sin(angle));
    fingers.push_back({0.5 * out, -out, 1});
  }
  EXPECT_EQ(formClosure(wrenchCones(fingers)).rank, 2);
  EXPECT_EQ(formClosure(wrenchCones(fingers)).status, ClosureStatus::kOpen);
  Rng rng(26);
  for (int trial = 0; trial < 1000; ++trial) {
    const double turn = (trial % 2 == 0 ? 1 : -1) * rng.uniform(1e-3, 0.2);
    const Vector2d shift = rng.uniform(0, 0.2) * Vector2d(rng.normalVector(2)).normalized();
    double deepest = 0;  // of a finger below the edge that touched it
    for (const PlanarContact& finger : fingers) {
      const Vector2d inTriangle = Eigen::Rotation2Dd(-turn) * (finger.p_OC - shift);
      deepest = std::max(deepest, 0.5 + finger.normal_O.dot(inTriangle));
    }
    EXPECT_GT(deepest, 1e-8) << turn << ' ' << shift.transpose();
  }
}

TEST(Closure, OfFormNeedsOneContactMoreThanDimensions) {
  Rng rng(25);
  int closedBySeven = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    EXPECT_EQ(formClosure(wrenchCones(randomContacts(rng, 6))).status, ClosureStatus::kOpen);
    closedBySeven += formClosure(wrenchCones(randomContacts(rng, 7))).status == ClosureStatus::kClosed;
  }
  EXPECT_GT(closedBySeven, 0);
}

TEST(Closure, RefusesWhatAreNoWrenches) {
  MatrixXd broken = MatrixXd::Zero(3, 2);
  broken(1, 1) = std::nan("");
  EXPECT_REX_ERROR(forceClosure(broken), "force closure: wrench 1: number 1: found nan");
  EXPECT_REX_ERROR(forceClosure(MatrixXd(0, 3)), "force closure: found wrenches without numbers");
}

}  // namespace rex::closure_test
