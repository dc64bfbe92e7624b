#include "collision/motion_clearance.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "collision/contacts.h"
#include "support/expect_error.h"
#include "support/random_scene.h"

namespace rex::motion_clearance_test {

using Eigen::VectorXd;

ShapeSpec contactShape(const Shape& shape, const Pose& X_BS = {}) {
  return {.name = "", .X_BS = X_BS, .shape = shape, .contact = true};
}

Shape sphere(double radius) { return {.type = ShapeType::kSphere, .radius = radius}; }

double leastDistance(const Model& model, const ContactModel& contacts, const VectorXd& q) {
  double least = std::numeric_limits<double>::infinity();
  for (const Proxy& proxy : proxies(contacts, forwardKinematics(model, q), least))
    least = std::min(least, proxy.proximity.distance);
  return least;
}

// By samples that close in on the best one.
double sampledClearance(const Model& model, const ContactModel& contacts, const VectorXd& from,
                        const VectorXd& to) {
  double start = 0, end = 1, least = std::numeric_limits<double>::infinity();
  for (int level = 0; level < 4; ++level) {
    const int count = level == 0 ? 1000 : 20;
    double best = start;
    for (int i = 0; i <= count; ++i) {
      const double t = start + (end - start) * i / count;
      const double distance = leastDistance(model, contacts, (1 - t) * from + t * to);
      if (distance < least) least = distance, best = t;
    }
    const double step = (end - start) / count;
    start = std::max(0., best - step);
    end = std::min(1., best + step);
  }
  return least;
}

// A ball on an arm of one metre, which turns about z, and a ball on the circle that it draws.
Model clock(JointType type = JointType::kHinge) {
  SceneSpec spec;
  spec.name = "clock";
  spec.bodies.push_back(
      {.name = "hand", .X_WB = {}, .shapes = {contactShape(sphere(0.1), translation(1, 0, 0))}});
  spec.joints.push_back({.name = "axle",
                         .parent = "world",
                         .child = "hand",
                         .type = type,
                         .X_PF = {},
                         .X_MC = {},
                         .axis = {0, 0, 1}});
  spec.worldShapes.push_back(contactShape(sphere(0.2), translation(0, 1, 0.5)));
  return compile(spec);
}

const ShapePair kBoth[] = {{0, 1}};

TEST(MotionClearance, FindsWhatHappensBetweenTheEnds) {
  const Model model = clock();
  const ContactModel contacts(model, kBoth);
  const VectorXd from = VectorXd::Constant(1, 0.), to = VectorXd::Constant(1, 3.);
  for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
    const double clearance = motionClearance(model, contacts, from, to, tolerance);
    EXPECT_LE(clearance, 0.5 - 0.3 + 1e-12);
    EXPECT_GE(clearance, 0.5 - 0.3 - tolerance);
  }
}

TEST(MotionClearance, IsTheDistanceWhereNothingMoves) {
  const Model model = clock();
  const VectorXd q = VectorXd::Constant(1, std::numbers::pi / 2);
  EXPECT_NEAR(motionClearance(model, ContactModel(model, kBoth), q, q, 1e-9), 0.2, 1e-12);
}

// What turns about its axis keeps its distance, however finely one looks: 0.2 m from the hand, which moves by
// metres in between.
TEST(MotionClearance, GivesTheBoundItHasProvedWhenItGivesUp) {
  SceneSpec spec;
  spec.bodies.push_back(
      {.name = "wheel",
       .X_WB = {},
       .shapes = {contactShape({.type = ShapeType::kCapsule, .extent = {0, 0, 1}, .radius = 0.3})}});
  spec.joints.push_back({.name = "axle",
                         .parent = "world",
                         .child = "wheel",
                         .type = JointType::kHinge,
                         .X_PF = {},
                         .X_MC = {},
                         .axis = {0, 0, 1}});
  spec.worldShapes.push_back(contactShape(sphere(0.1), translation(0.6, 0, 0)));
  const Model model = compile(spec);
  const ContactModel contacts(model, kBoth);
  const VectorXd from = VectorXd::Zero(1);
  const auto clearance = [&](double angle) {
    return motionClearance(model, contacts, from, VectorXd::Constant(1, angle), 1e-9);
  };
  const double proved = clearance(10), atFullTurns = clearance(1e7), atEndless = clearance(1e300);
  EXPECT_LE(proved, 0.2);
  EXPECT_GE(proved, 0.2 - 1e-3);
  EXPECT_LE(atFullTurns, 0.2);
  EXPECT_GE(atFullTurns, -1e7);
  EXPECT_LE(atEndless, 0.2);
}

TEST(MotionClearance, IsInfiniteWithoutPairs) {
  const Model model = clock();
  const ContactModel nothing(model, std::span<const ShapePair>{});
  const VectorXd q = VectorXd::Zero(1);
  EXPECT_EQ(motionClearance(model, nothing, q, q, 1e-3), std::numeric_limits<double>::infinity());
}

// Two balls on bodies of a random tree, which fill one place at a random time and so are as deep in each
// other as balls can be. Right before and after, the distance changes as fast as they move.
TEST(MotionClearance, FindsTheMomentWhenBallsFillOnePlace) {
  constexpr double kTolerance = 1e-3, kRadius = 0.01;
  for (int seed = 0; seed < 500; ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed));
    SceneSpec spec = randomScene(rng, 2 + seed % 4);
    for (JointSpec& joint : spec.joints)
      joint.type = kAllJointTypes[1 + rng.index(std::size(kAllJointTypes) - 1)], joint.q0 = {};
    const Model bare = compile(spec);
    const VectorXd from = randomPositions(rng, bare.nq());
    VectorXd to = from + 0.5 * rng.normalVector(bare.nq());
    const double meeting = rng.uniform();
    const BodyPoses poses = forwardKinematics(bare, (1 - meeting) * from + meeting * to);
    const std::size_t b = spec.bodies.size() - 1,
                      a = static_cast<std::size_t>(rng.index(static_cast<int>(b)));
    const Pose X_WS{Eigen::Matrix3d::Identity(),
                    poses[bare.body(spec.bodies[b].name)] * Eigen::Vector3d(rng.normalVector(3) / 2)};
    for (const std::size_t i : {a, b}) {
      const Pose X_BS = poses[bare.body(spec.bodies[i].name)].inverse() * X_WS;
      spec.bodies[i].shapes = {contactShape(sphere(kRadius), X_BS)};
    }
    const Model model = compile(spec);
    const double clearance = motionClearance(model, ContactModel(model, kBoth), from, to, kTolerance);
    EXPECT_LE(clearance, -2 * kRadius + 1e-12) << "seed " << seed;
    EXPECT_GE(clearance, -2 * kRadius - kTolerance) << "seed " << seed;
  }
}

// The far end of a bar that turns about its middle passes through a ball.
TEST(MotionClearance, KnowsHowFastTheEndsOfALongShapeMove) {
  Rng rng(81);
  for (int i = 0; i < 100; ++i) {
    SceneSpec spec;
    spec.bodies.push_back(
        {.name = "bar",
         .X_WB = {},
         .shapes = {contactShape({.type = ShapeType::kCapsule, .extent = {0, 0, 2}, .radius = 0.01},
                                 rotation(M_PI_2, {0, 1, 0}))}});
    spec.joints.push_back({.name = "axle",
                           .parent = "world",
                           .child = "bar",
                           .type = JointType::kHinge,
                           .X_PF = {},
                           .X_MC = {},
                           .axis = {0, 0, 1}});
    const double meeting = rng.uniform(0.1, 3);
    spec.worldShapes.push_back(
        contactShape(sphere(0.01), translation(std::cos(meeting), std::sin(meeting), 0)));
    const Model model = compile(spec);
    const double clearance = motionClearance(model, ContactModel(model, kBoth), VectorXd::Constant(1, 0),
                                             VectorXd::Constant(1, 3.1), 1e-4);
    EXPECT_LE(clearance, -0.02 + 1e-12) << i;
    EXPECT_GE(clearance, -0.02 - 1e-4) << i;
  }
}

// Joints of all types, joints that follow others, and quaternions of any length.
TEST(MotionClearance, BoundsDenseSamples) {
  constexpr double kTolerance = 3e-3;
  for (int seed = 0; seed < 40; ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed));
    SceneSpec spec = randomScene(rng, 6 + seed % 12);
    for (BodySpec& body : spec.bodies) {
      Shape box{.type = ShapeType::kBox, .extent = rng.uniformVector(3, 0.02, 0.2)};
      body.shapes = {contactShape(seed % 2 == 0 ? sphere(0.05) : box,
                                  {Eigen::Matrix3d::Identity(), 0.2 * rng.normalVector(3)})};
    }
    const Model model = compile(spec);
    const int last = static_cast<int>(model.shapes().size()) - 1;
    const ShapePair pairs[] = {{0, last}, {1, last}, {last / 2, last}};
    const ContactModel contacts(model, pairs);
    const VectorXd from = randomPositions(rng, model.nq());
    const VectorXd to = from + 0.3 * rng.normalVector(model.nq());
    const double clearance = motionClearance(model, contacts, from, to, kTolerance);
    const double sampled = sampledClearance(model, contacts, from, to);
    EXPECT_LE(clearance, sampled + 1e-9) << "seed " << seed;
    EXPECT_GE(clearance, sampled - kTolerance - 1e-5) << "seed " << seed;
  }
}

// A ball slides outwards on a turning arm and passes another far out, faster than where it was in the middle.
TEST(MotionClearance, KnowsThatJointsCarryWhatOthersMove) {
  for (int i = 0; i < 100; ++i) {
    SceneSpec spec;
    spec.bodies.push_back({.name = "arm", .X_WB = {}});
    spec.bodies.push_back({.name = "ball", .X_WB = {}, .shapes = {contactShape(sphere(0.01))}});
    spec.joints.push_back({.name = "axle",
                           .parent = "world",
                           .child = "arm",
                           .type = JointType::kHinge,
                           .X_PF = {},
                           .X_MC = {},
                           .axis = {0, 0, 1}});
    spec.joints.push_back({.name = "rail",
                           .parent = "arm",
                           .child = "ball",
                           .type = JointType::kSlider,
                           .X_PF = {},
                           .X_MC = {},
                           .axis = {1, 0, 0}});
    const double t = 0.9 + 1e-3 * i, angle = 6 * t, radius = 0.5 + t;
    spec.worldShapes.push_back(
        contactShape(sphere(0.01), translation(radius * std::cos(angle), radius * std::sin(angle), 0)));
    const Model model = compile(spec);
    const double clearance = motionClearance(model, ContactModel(model, kBoth), Eigen::Vector2d(0, 0.5),
                                             Eigen::Vector2d(6, 1.5), 1e-4);
    EXPECT_LE(clearance, -0.02 + 1e-12) << i;
    EXPECT_GE(clearance, -0.02 - 1e-4) << i;
  }
}

TEST(MotionClearance, RefusesWhatIsNoMotion) {
  const Model model = clock();
  const ContactModel contacts(model, kBoth);
  const VectorXd q = VectorXd::Zero(1), two = VectorXd::Zero(2);
  EXPECT_REX_ERROR(motionClearance(model, contacts, two, q, 1e-3),
                   "start of the motion: found a vector of size 2, wanted size 1");
  EXPECT_REX_ERROR(motionClearance(model, contacts, q, two, 1e-3),
                   "end of the motion: found a vector of size 2, wanted size 1");
  EXPECT_REX_ERROR(motionClearance(model, contacts, q, VectorXd::Constant(1, NAN), 1e-3),
                   "end of the motion: found a number that is not finite");
  EXPECT_REX_ERROR(motionClearance(model, contacts, q, q, 0),
                   "tolerance of the clearance: found 0 m, wanted at least 1e-09 m");
}

TEST(MotionClearance, RefusesQuaternionsThatMeetInZero) {
  const Model model = clock(JointType::kBall);
  const VectorXd q = Eigen::Vector4d(1, 0, 0, 0);
  EXPECT_REX_ERROR(motionClearance(model, ContactModel(model, kBoth), q, -q, 1e-3),
                   "motion of joint 'axle': found a quaternion that becomes zero on the way");
}

}  // namespace rex::motion_clearance_test
