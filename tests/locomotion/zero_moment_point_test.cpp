#include "locomotion/zero_moment_point.h"

#include <Eigen/Geometry>

#include "dynamics/forward_dynamics.h"
#include "dynamics/inverse_dynamics.h"
#include "formats/scene_file.h"
#include "kinematics/center_of_mass.h"
#include "support/expect_error.h"
#include "support/paths.h"
#include "support/random_motion.h"

namespace rex::zero_moment_point_test {

using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::HasSubstr;

Model humanoid() {
  return compile(readScene(sourcePath("data/robots/humanoid/humanoid.urdf"), {.freeBase = true}).spec);
}

// Feet are pushed by forces at random, joints by torques at random; forward dynamics says how all moves.
TEST(ZeroMomentPoint, FromMotionAndFromContactsAgree) {
  Rng rng(1);
  const Model model = humanoid();
  for (int trial = 0; trial < 20; ++trial) {
    const VectorXd q = randomPositions(rng, model.nq()), v = rng.normalVector(model.nv());
    const BodyPoses poses = forwardKinematics(model, q);
    std::vector<Wrench> pushes;
    std::vector<ContactForce> contacts;
    for (const char* foot : {"left_foot", "right_foot"})
      for (const double x : {-.09, .15}) {
        const Vector3d force = 100 * rng.normalVector(3) + Vector3d(0, 0, 400);
        pushes.push_back({.body = model.body(foot), .p_BQ = {x, .02, -.075}, .force_W = force});
        contacts.push_back({.p_WC = poses[pushes.back().body] * pushes.back().p_BQ, .force_W = force});
      }
    VectorXd u = 20 * rng.normalVector(model.nv());
    u.head<6>().setZero();  // nothing holds the pelvis
    const VectorXd a = forwardDynamics(model, q, v, u + wrenchForces(model, poses, pushes));
    const ZeroMomentPoint byMotion = zmpOfMotion(model, q, v, a, -.3);
    const ZeroMomentPoint byContacts = zmpOfContacts(contacts, -.3);
    ASSERT_TRUE(byMotion.exists && byContacts.exists);
    EXPECT_LT((byMotion.p_W - byContacts.p_W).norm(), 1e-9) << "trial " << trial;
    EXPECT_LT((byMotion.force_W - byContacts.force_W).norm(), 1e-8);
    EXPECT_NEAR(byMotion.moment, byContacts.moment, 1e-8);
    EXPECT_EQ(byContacts.p_W.z(), -.3);
  }
}

TEST(ZeroMomentPoint, AtRestLiesBelowTheCenterOfMass) {
  Rng rng(2);
  const Model model = humanoid();
  const VectorXd q = randomPositions(rng, model.nq()), zero = VectorXd::Zero(model.nv());
  const ZeroMomentPoint zmp = zmpOfMotion(model, q, zero, zero, -1);
  const Vector3d center = centerOfMass(model, forwardKinematics(model, q));
  ASSERT_TRUE(zmp.exists);
  EXPECT_LT((zmp.p_W.head<2>() - center.head<2>()).norm(), 1e-12);
  EXPECT_NEAR(zmp.force_W.z(), 9.81 * model.mass(), 1e-9);
  EXPECT_NEAR(zmp.moment, 0, 1e-10);
}

// One body that slides without turning is a linear inverted pendulum.
TEST(ZeroMomentPoint, OfASlidingBodyIsThatOfThePendulum) {
  SceneSpec spec;
  spec.bodies = {{.name = "box", .X_WB = {}, .mass = 3, .inertia = Eigen::Matrix3d::Identity()}};
  spec.joints = {{.name = "slide",
                  .parent = "world",
                  .child = "box",
                  .type = JointType::kTranslation3,
                  .X_PF = {},
                  .X_MC = {}}};
  const Model model = compile(spec);
  const Vector3d q(.3, -.2, .7), v(1, 2, 0), a(.4, -.5, 0);
  const ZeroMomentPoint zmp = zmpOfMotion(model, q, v, a);
  ASSERT_TRUE(zmp.exists);
  EXPECT_LT((zmp.p_W.head<2>() - InvertedPendulum{.height = .7}.zmp(q.head<2>(), a.head<2>())).norm(), 1e-15);
  const ZeroMomentPoint falling = zmpOfMotion(model, q, v, earthGravity());
  EXPECT_FALSE(falling.exists);
  EXPECT_THAT(falling.message, HasSubstr("the ground would have to push upwards with 0 N"));
}

TEST(ZeroMomentPoint, WithoutPressureThereIsNone) {
  EXPECT_FALSE(zmpOfContacts({}).exists);
  const std::vector<ContactForce> pull = {{.p_WC = {1, 0, 0}, .force_W = {0, 0, -5}}};
  EXPECT_THAT(zmpOfContacts(pull).message, HasSubstr("push upwards with -5 N"));
}

TEST(ZeroMomentPoint, NamesWhatIsWrong) {
  const Model model = humanoid();
  const VectorXd q = model.initialPositions(), zero = VectorXd::Zero(model.nv());
  EXPECT_REX_ERROR(zmpOfMotion(model, q, zero, zero, NAN), "zero moment point: ground height: found nan");
  EXPECT_REX_ERROR(zmpOfMotion(model, NAN * q, zero, zero),
                   "zero moment point: joint positions q: number 0: found nan");
  EXPECT_REX_ERROR(zmpOfMotion(model, q, zero, NAN * zero),
                   "zero moment point: joint accelerations a: number 0");
  EXPECT_REX_ERROR(zmpOfMotion(model, q, NAN * zero, zero),
                   "zero moment point: joint velocities v: number 0");
  EXPECT_REX_ERROR(zmpOfMotion(model, q, zero, zero, 0, {0, NAN, 0}), "zero moment point: gravity: number 1");
  SceneSpec spec;
  spec.bodies = {{.name = "ghost", .X_WB = {}}};
  const Model massless = compile(spec);
  const char* wanted = "found no body with a mass";
  EXPECT_REX_ERROR(zmpOfMotion(massless, VectorXd(), VectorXd(), VectorXd()), wanted);
  EXPECT_REX_ERROR(staticStability(massless, VectorXd(), {}), wanted);
  const std::vector<ContactForce> place = {{.p_WC = {NAN, 0, 0}}}, force = {{.force_W = {NAN, 0, 0}}};
  EXPECT_REX_ERROR(zmpOfContacts(place), "zero moment point: position of a contact: number 0");
  EXPECT_REX_ERROR(zmpOfContacts(force), "zero moment point: force of a contact: number 0");
}

TEST(StaticStability, OfAStandingHumanoid) {
  const Model model = humanoid();
  const BodyPoses poses = forwardKinematics(model, model.initialPositions());
  Eigen::Matrix2Xd contacts(2, 0);
  for (const char* foot : {"left_foot", "right_foot"})
    for (const double x : {-.09, .15})
      for (const double y : {-.055, .055}) {
        contacts.conservativeResize(2, contacts.cols() + 1);
        contacts.rightCols<1>() = (poses[model.body(foot)] * Vector3d(x, y, -.075)).head<2>();
      }
  const SupportMargin both = staticStability(model, model.initialPositions(), supportPolygon(contacts), .05);
  EXPECT_TRUE(both.isInside) << both.message;
  const SupportMargin left =
      staticStability(model, model.initialPositions(), supportPolygon(contacts.leftCols(4)));
  EXPECT_FALSE(left.isInside);
  EXPECT_NEAR(left.margin, -.04, 1e-3);  // the feet stand 0.095 m from the middle and are 0.11 m wide
}

}  // namespace rex::zero_moment_point_test
