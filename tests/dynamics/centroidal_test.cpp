#include "dynamics/centroidal.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "dynamics/stepper.h"
#include "geometry/rotation.h"
#include "kinematics/center_of_mass.h"
#include "kinematics/jacobians.h"
#include "support/expect_error.h"
#include "support/random_motion.h"

namespace rex::centroidal_test {

Eigen::VectorXd momenta(const Centroidal& all) {
  Eigen::VectorXd both(6);
  both << all.linearMomentum, all.angularMomentum;
  return both;
}

TEST(Centroidal, IsTheSumOverBodies) {
  Rng rng(321);
  for (int i = 0; i < 20; ++i) {
    const Model model = randomModel(rng, 2 + 2 * i, Followers::kSome);
    const BodyPoses poses = forwardKinematics(model, randomPositions(rng, model.nq()));
    const Eigen::VectorXd v = rng.normalVector(model.nv());
    const Centroidal found = centroidal(model, poses, v);
    const Eigen::Vector3d center = centerOfMass(model, poses);
    Eigen::VectorXd wanted = Eigen::VectorXd::Zero(6);
    for (int b = 1; b < static_cast<int>(model.bodies().size()); ++b) {
      const Body& body = model[BodyId{b}];
      const Pose& X_WB = poses[BodyId{b}];
      const Eigen::Vector3d p = body.mass * positionJacobian(model, poses, BodyId{b}, body.p_BBcm) * v;
      const Eigen::Vector3d w_B = X_WB.R.transpose() * angularJacobian(model, poses, BodyId{b}) * v;
      wanted.head<3>() += p;
      wanted.tail<3>() += (X_WB * body.p_BBcm - center).cross(p) + X_WB.R * body.I_BBcm_B * w_B;
    }
    EXPECT_EQ(found.center, center);
    EXPECT_LE((momenta(found) - wanted).norm(), 1e-12 * wanted.norm());
    EXPECT_LE((found.velocity - centerOfMassJacobian(model, poses) * v).norm(),
              1e-12 * found.velocity.norm());
    const auto A = centroidalMomentumMatrix(model, poses);
    EXPECT_LE((A * v - wanted).norm(), 1e-11 * wanted.norm());
    EXPECT_LE((A.topRows<3>() - model.mass() * centerOfMassJacobian(model, poses)).norm(), 1e-12 * A.norm());
  }
}

SceneSpec floatingRobot(Rng& rng, int bodies) {
  SceneSpec spec = randomScene(rng, bodies);
  spec.joints.insert(spec.joints.begin(), {.name = "base",
                                           .parent = "world",
                                           .child = "b0",
                                           .type = JointType::kFree,
                                           .X_PF = randomPose(rng),
                                           .X_MC = randomPose(rng)});
  return spec;
}

// Its joints held, a robot turns like one body.
TEST(Centroidal, InertiaIsThatOfOneBody) {
  Rng rng(322);
  const Model model = compile(floatingRobot(rng, 14));
  const BodyPoses poses = forwardKinematics(model, randomPositions(rng, model.nq()));
  Eigen::VectorXd v = Eigen::VectorXd::Zero(model.nv());
  v.head<6>() = rng.normalVector(6);
  const Eigen::Vector3d w = angularJacobian(model, poses, model.body("b0")) * v;
  const Centroidal all = centroidal(model, poses, v);
  EXPECT_LE((all.inertia * w - all.angularMomentum).norm(), 1e-12 * all.angularMomentum.norm());
  EXPECT_LE((all.inertia - all.inertia.transpose()).norm(), 1e-14 * all.inertia.norm());
}

// Parallel axes: two balls of mass m and inertia I at a distance d.
TEST(Centroidal, InertiaOfADumbbell) {
  SceneSpec spec;
  const Eigen::Matrix3d I = 0.01 * Eigen::Matrix3d::Identity();
  spec.bodies = {{.name = "left", .X_WB = translation(5, 1, 0), .mass = 2, .inertia = I},
                 {.name = "right", .X_WB = translation(5, 4, 0), .mass = 2, .inertia = I}};
  const Model model = compile(spec);
  const Centroidal all = centroidal(model, forwardKinematics(model, Eigen::VectorXd()), Eigen::VectorXd());
  const Eigen::Vector3d wanted(0.02 + 2 * 2 * 1.5 * 1.5, 0.02, 0.02 + 2 * 2 * 1.5 * 1.5);
  EXPECT_TRUE(all.inertia.isApprox(Eigen::Matrix3d(wanted.asDiagonal()), 1e-14)) << all.inertia;
  EXPECT_EQ(all.center, Eigen::Vector3d(5, 2.5, 0));
}

TEST(Centroidal, MomentaStayInFreeFlight) {
  Rng rng(323);
  const Model model = compile(floatingRobot(rng, 14));
  State state{randomPositions(rng, model.nq()), rng.normalVector(model.nv())};
  const auto now = [&] { return centroidal(model, forwardKinematics(model, state.q), state.v); };
  const Centroidal start = now();
  Eigen::VectorXd u = rng.normalVector(model.nv());
  u.head<6>().setZero();
  Stepper stepper(model, {.gravity_W = Eigen::Vector3d::Zero()});
  const double h = 2.5e-4;
  const int steps = 200;
  for (int i = 0; i < steps; ++i) stepper.step(state, u, h);
  const Centroidal end = now();
  EXPECT_LE((momenta(end) - momenta(start)).norm(), 1e-8 * momenta(start).norm());
  EXPECT_LE((end.center - start.center - steps * h * start.velocity).norm(), 1e-7);
  EXPECT_GE((end.inertia - start.inertia).norm(), 0.01 * start.inertia.norm()) << "it did not move";
}

TEST(Centroidal, NeedsAMassAndRightSizes) {
  SceneSpec spec;
  spec.name = "ghost.ors";
  spec.bodies = {{.name = "a", .X_WB = {}}};
  const Model model = compile(spec);
  const BodyPoses poses = forwardKinematics(model, model.initialPositions());
  EXPECT_REX_ERROR(centroidal(model, poses, Eigen::VectorXd()),
                   "centre of mass of scene 'ghost.ors': found no body with a mass");
  EXPECT_REX_ERROR(centroidalMomentumMatrix(model, poses),
                   "centre of mass of scene 'ghost.ors': found no body with a mass");
  EXPECT_REX_ERROR(centroidal(model, poses, Eigen::VectorXd::Zero(2)),
                   "joint velocities v: found a vector of size 2, wanted size 0");
}

}  // namespace rex::centroidal_test
