#include "dynamics/derivatives.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "base/cpu_lanes.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/forward_dynamics.h"
#include "dynamics/kernel_room_internal.h"
#include "dynamics/kernels_internal.h"
#include "formats/scene_file.h"
#include "geometry/rotation.h"
#include "scene/state.h"
#include "support/allocations.h"
#include "support/expect_error.h"
#include "support/paths.h"
#include "support/random_motion.h"
#include "support/world_frame_dynamics.h"

namespace rex::derivatives_test {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

double largest(const MatrixXd& M) { return M.size() == 0 ? 0 : M.cwiseAbs().maxCoeff(); }

void expectNear(const MatrixXd& got, const MatrixXd& wanted, double tolerance, const char* what) {
  ASSERT_EQ(got.rows(), wanted.rows()) << what;
  ASSERT_EQ(got.cols(), wanted.cols()) << what;
  EXPECT_LE(largest(got - wanted), tolerance * std::max(1., largest(wanted))) << what;
}

// The derivative of f(x) at x = 0 for n numbers, by central differences of eighth order.
template <class Function>
MatrixXd differences(int n, const Function& f) {
  constexpr double kWeights[] = {4. / 5, -1. / 5, 4. / 105, -1. / 280}, kStep = 1. / 64;
  MatrixXd J(n, n);
  for (int i = 0; i < n; ++i) {
    VectorXd sum = VectorXd::Zero(n);
    for (int k = 1; k <= 4; ++k) {
      const VectorXd way = k * kStep * VectorXd::Unit(n, i);
      sum += kWeights[k - 1] * (f(way) - f(-way));
    }
    J.col(i) = sum / kStep;
  }
  return J;
}

// By differences of a plain recursion in the frame of the world.
InverseDynamicsDerivatives byDifferences(const Model& model, const VectorXd& q, const VectorXd& v,
                                         const VectorXd& a, const Vector3d& gravity_W) {
  const auto forces = [&](const VectorXd& atQ, const VectorXd& atV, const VectorXd& atA) {
    return worldFrameInverseDynamics(model, atQ, atV, atA, gravity_W);
  };
  const int n = model.nv();
  return {differences(n, [&](const VectorXd& way) { return forces(integrate(model, q, way), v, a); }),
          differences(n, [&](const VectorXd& way) { return forces(q, v + way, a); }),
          differences(n, [&](const VectorXd& way) { return forces(q, v, a + way); })};
}

void expectAsDifferences(const Model& model, const VectorXd& q, const VectorXd& v, const VectorXd& a,
                         const Vector3d& gravity_W) {
  const InverseDynamicsDerivatives wanted = byDifferences(model, q, v, a, gravity_W);
  const InverseDynamicsDerivatives got = inverseDynamicsDerivatives(model, q, v, a, gravity_W);
  expectNear(got.u_q, wanted.u_q, 1e-9, "u_q");
  expectNear(got.u_v, wanted.u_v, 1e-9, "u_v");
  expectNear(got.u_a, wanted.u_a, 1e-9, "u_a");
}

// M a_q + u_q = 0 and so on, at the acceleration of forward dynamics.
void expectInverse(const Model& model, const VectorXd& q, const VectorXd& v, const VectorXd& u) {
  const ForwardDynamicsDerivatives forward = forwardDynamicsDerivatives(model, q, v, u);
  EXPECT_EQ(forward.a, forwardDynamics(model, q, v, u));
  const InverseDynamicsDerivatives inverse = inverseDynamicsDerivatives(model, q, v, forward.a);
  const auto expectZero = [&](const MatrixXd& a_x, const MatrixXd& minus, const char* what) {
    const MatrixXd left = inverse.u_a * a_x;
    EXPECT_LE(largest(left + minus), 1e-9 * (largest(minus) + largest(inverse.u_a) * largest(a_x))) << what;
  };
  expectZero(forward.a_q, inverse.u_q, "a_q");
  expectZero(forward.a_v, inverse.u_v, "a_v");
  expectZero(forward.a_u, -MatrixXd::Identity(model.nv(), model.nv()), "a_u");
}

TEST(Derivatives, AgreeWithDifferencesOnTrees) {
  Rng rng(411);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const Model model = randomModel(rng, 2 + i % 29, i % 4 == 0 ? Followers::kSome : Followers::kNone);
    const RandomMotion at(rng, model);
    const VectorXd a = rng.normalVector(model.nv());
    expectAsDifferences(model, at.q, at.v, a, 5 * (i % 3) * rng.normalVector(3));
    expectInverse(model, at.q, at.v, 10 * rng.normalVector(model.nv()));
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Derivatives, OfForwardDynamicsAgreeWithDifferences) {
  Rng rng(412);
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    const Model model = randomModel(rng, 2 + i % 14, i % 4 == 0 ? Followers::kSome : Followers::kNone);
    const RandomMotion at(rng, model);
    const VectorXd u = 10 * rng.normalVector(model.nv());
    const auto motion = [&](const VectorXd& q, const VectorXd& v, const VectorXd& forces) {
      return forwardDynamicsByMassMatrix(model, q, v, forces);
    };
    const ForwardDynamicsDerivatives got = forwardDynamicsDerivatives(model, at.q, at.v, u);
    const int n = model.nv();
    expectNear(
        got.a_q,
        differences(n, [&](const VectorXd& way) { return motion(integrate(model, at.q, way), at.v, u); }),
        1e-9, "a_q");
    expectNear(got.a_v, differences(n, [&](const VectorXd& way) { return motion(at.q, at.v + way, u); }),
               1e-9, "a_v");
    expectNear(got.a_u, differences(n, [&](const VectorXd& way) { return motion(at.q, at.v, u + way); }),
               1e-9, "a_u");
  }
}

// All files of data/robots, on the ground and, where the format allows it, free to move.
TEST(Derivatives, AgreeWithDifferencesOnRobots) {
  Rng rng(413);
  int robots = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(sourcePath("data/robots"))) {
    const std::filesystem::path& file = entry.path();
    const bool isUrdf = file.extension() == ".urdf";
    if (!isUrdf && file.extension() != ".ors") continue;
    for (const bool isFree : {false, true}) {
      if (isFree && !isUrdf) continue;
      SCOPED_TRACE(file.filename().string() + (isFree ? ", free" : ""));
      const Model model = compile(readScene(file, {.freeBase = isFree}).spec);
      const VectorXd q = integrate(model, model.initialPositions(), 0.5 * rng.normalVector(model.nv()));
      const VectorXd v = rng.normalVector(model.nv()), a = rng.normalVector(model.nv());
      expectAsDifferences(model, q, v, a, earthGravity());
      ++robots;
    }
  }
  EXPECT_GE(robots, 20);
}

// A rod of mass m, its centre at c from a hinge about y, with inertia I about its centre; hangs at q = 0.
constexpr double kMass = 1.3, kCentre = 0.4, kInertia = 0.07, kGravity = 9.81, kLength = 0.9;

void addRod(SceneSpec& spec, const std::string& name, const std::string& parent, const Vector3d& at) {
  BodySpec rod{.name = name, .X_WB = {}, .mass = kMass, .p_BBcm = {0, 0, -kCentre}};
  rod.inertia = kInertia * Eigen::Matrix3d::Identity();
  spec.bodies.push_back(rod);
  spec.joints.push_back(
      {.name = name + "Hinge", .parent = parent, .child = name, .X_PF = Pose{.p = at}, .X_MC = {}});
  spec.joints.back().axis = -Vector3d::UnitY();  // x of the end is sin q
}

TEST(Derivatives, OfAPendulumAreThoseByHand) {
  SceneSpec spec;
  addRod(spec, "rod", "world", Vector3d::Zero());
  const Model model = compile(spec);
  const double J = kInertia + kMass * kCentre * kCentre, weight = kMass * kGravity * kCentre;
  const VectorXd q = VectorXd::Constant(1, 0.7), v = VectorXd::Constant(1, -2), u = VectorXd::Constant(1, 3);
  const InverseDynamicsDerivatives inverse = inverseDynamicsDerivatives(model, q, v, u);
  EXPECT_NEAR(inverse.u_q(0, 0), weight * std::cos(0.7), 1e-14 * weight);
  EXPECT_NEAR(inverse.u_v(0, 0), 0, 1e-15);
  EXPECT_NEAR(inverse.u_a(0, 0), J, 1e-15);
  const ForwardDynamicsDerivatives forward = forwardDynamicsDerivatives(model, q, v, u);
  EXPECT_NEAR(forward.a[0], (3 - weight * std::sin(0.7)) / J, 1e-12);
  EXPECT_NEAR(forward.a_q(0, 0), -weight * std::cos(0.7) / J, 1e-12);
  EXPECT_NEAR(forward.a_u(0, 0), 1 / J, 1e-13);
}

// u = ((m0 + m) x" + m c (t" cos t - t'^2 sin t), m c x" cos t + (I + m c^2) t" + m g c sin t).
TEST(Derivatives, OfACartWithAPendulumAreThoseByHand) {
  SceneSpec spec;
  spec.bodies = {{.name = "cart", .X_WB = {}, .mass = 2}};
  spec.joints = {{.name = "rail",
                  .parent = "world",
                  .child = "cart",
                  .type = JointType::kSlider,
                  .X_PF = {},
                  .X_MC = {}}};
  spec.joints[0].axis = Vector3d::UnitX();
  addRod(spec, "rod", "cart", Vector3d::Zero());
  const Model model = compile(spec);
  const double t = 0.8, w = -1.7, s = std::sin(t), c = std::cos(t), lever = kMass * kCentre;
  const Eigen::Vector2d q(0.3, t), v(0.6, w), a(1.1, -0.4);
  const InverseDynamicsDerivatives got = inverseDynamicsDerivatives(model, q, v, a);
  const Eigen::Matrix2d u_q{{0, lever * (-a[1] * s - w * w * c)}, {0, lever * (kGravity * c - a[0] * s)}};
  const Eigen::Matrix2d u_v{{0, -2 * lever * w * s}, {0, 0}};
  const Eigen::Matrix2d M{{2 + kMass, lever * c}, {lever * c, kInertia + lever * kCentre}};
  expectNear(got.u_q, u_q, 1e-14, "u_q");
  expectNear(got.u_v, u_v, 1e-14, "u_v");
  expectNear(got.u_a, M, 1e-14, "u_a");
}

// By Lagrange, with b = m l c: M = (A + 2 b cos q2, D + b cos q2; ., D).
TEST(Derivatives, OfADoublePendulumAreThoseByHand) {
  SceneSpec spec;
  addRod(spec, "upper", "world", Vector3d::Zero());
  addRod(spec, "lower", "upper", {0, 0, -kLength});
  const Model model = compile(spec);
  const double b = kMass * kLength * kCentre, D = kInertia + kMass * kCentre * kCentre;
  const double A = 2 * D + kMass * kLength * kLength;
  const Eigen::Vector2d q(0.4, -1.1), v(1.5, -0.7), a(0.2, 2.3);
  const double s = std::sin(q[1]), c = std::cos(q[1]), both = std::cos(q.sum());
  const double upper = kMass * kGravity * (kCentre + kLength), lower = kMass * kGravity * kCentre;
  const Eigen::Matrix2d u_q{
      {upper * std::cos(q[0]) + lower * both,
       lower * both - b * s * (2 * a[0] + a[1]) - b * c * (2 * v[0] * v[1] + v[1] * v[1])},
      {lower * both, lower * both - b * s * a[0] + b * c * v[0] * v[0]}};
  const Eigen::Matrix2d u_v{{-2 * b * s * v[1], -2 * b * s * (v[0] + v[1])}, {2 * b * s * v[0], 0}};
  const Eigen::Matrix2d M{{A + 2 * b * c, D + b * c}, {D + b * c, D}};
  const InverseDynamicsDerivatives got = inverseDynamicsDerivatives(model, q, v, a);
  expectNear(got.u_q, u_q, 1e-14, "u_q");
  expectNear(got.u_v, u_v, 1e-14, "u_v");
  expectNear(got.u_a, M, 1e-14, "u_a");
}

SceneSpec withoutQuaternions(SceneSpec spec) {
  for (JointSpec& joint : spec.joints) {
    if (joint.type == JointType::kBall) joint.type = JointType::kUniversal;
    if (joint.type == JointType::kFree) joint.type = JointType::kPlanarXYPhi;
  }
  return spec;
}

// Second derivatives of the potential energy; those along the axes of a body that turns differ by what
// turning about one axis does to the other.
TEST(Derivatives, OfGravityAreSymmetric) {
  Rng rng(414);
  for (int i = 0; i < 50; ++i) {
    const Model model = randomModel(rng, 2 + i % 29, i % 4 == 0 ? Followers::kSome : Followers::kNone);
    const VectorXd q = randomPositions(rng, model.nq()), rest = VectorXd::Zero(model.nv());
    MatrixXd u_q = inverseDynamicsDerivatives(model, q, rest, rest).u_q;
    const VectorXd G = gravityForces(model, q);
    forEachQuaternion(model, [&](int, int iv) { u_q.block<3, 3>(iv, iv) -= skew(G.segment<3>(iv)) / 2; });
    expectNear(u_q, u_q.transpose(), 1e-13, "u_q");
  }
}

TEST(Derivatives, SplitIntoMassesAndCoriolisTerms) {
  Rng rng(415);
  for (int i = 0; i < 50; ++i) {
    const Model model = compile(withoutQuaternions(randomScene(rng, 2 + i % 29)));
    const RandomMotion at(rng, model);
    const int n = model.nv();
    const VectorXd zero = VectorXd::Zero(n);
    const InverseDynamicsDerivatives drift = inverseDynamicsDerivatives(model, at.q, at.v, zero);
    expectNear(drift.u_v, 2 * coriolisMatrix(model, at.q, at.v), 1e-12, "u_v");
    MatrixXd rate(n, n);  // of the mass matrix
    for (int k = 0; k < n; ++k) {
      const VectorXd unit = VectorXd::Unit(n, k);
      rate.col(k) = (inverseDynamicsDerivatives(model, at.q, zero, unit).u_q -
                     inverseDynamicsDerivatives(model, at.q, zero, zero).u_q) *
                    at.v;
    }
    const double scale = 1 + largest(rate) + largest(drift.u_q);
    EXPECT_LE(largest(rate - rate.transpose()), 1e-12 * scale) << i;
    const MatrixXd skew = rate - drift.u_v;
    EXPECT_LE(largest(skew + skew.transpose()), 1e-12 * scale) << i;
  }
}

// F - G is of second degree in v, also with quaternions.
TEST(Derivatives, ByVelocityAreOfFirstDegree) {
  Rng rng(416);
  for (int i = 0; i < 50; ++i) {
    const Model model = randomModel(rng, 2 + i % 29, i % 4 == 0 ? Followers::kSome : Followers::kNone);
    const RandomMotion at(rng, model);
    const VectorXd a = rng.normalVector(model.nv());
    const InverseDynamicsDerivatives got = inverseDynamicsDerivatives(model, at.q, at.v, a);
    const VectorXd twice = 2 * biasForces(model, at.q, at.v, Vector3d::Zero());
    expectNear(got.u_v * at.v, twice, 1e-12, "u_v v");
    expectNear(got.u_a, massMatrix(model, at.q), 1e-13, "u_a");
  }
}

TEST(Derivatives, HaveTheSameBitsInLanes) {
  Rng rng(417);
  const Vector3d gravity_W = earthGravity();
  for (int i = 0; i < 20; ++i) {
    const Model model = randomModel(rng, 2 + 2 * i, i < 7 ? Followers::kNone : Followers::kSome);
    const RandomMotion at(rng, model);
    const int n = model.nv();
    const VectorXd a = rng.normalVector(n);
    const InverseDynamicsDerivatives wanted = inverseDynamicsDerivatives(model, at.q, at.v, a);
    for (int lanes = 1; lanes <= cpuLanes(); lanes *= 2) {
      const auto kernel = kernelFor<internal::DerivativesKernel>(lanes);
      MatrixXd u_q(n, n), u_v(n, n), u_a(n, n);
      const double *q = at.q.data(), *v = at.v.data(), *given = a.data();
      double* const results[] = {u_q.data(), u_v.data(), u_a.data()};
      DynamicsWorkspace workspace;
      kernel.one({.links = model.links().data(),
                  .linkCount = static_cast<int>(model.links().size()),
                  .nv = n,
                  .gravity_W = gravity_W.data(),
                  .q = &q,
                  .v = &v,
                  .given = &given,
                  .result = results,
                  .memory = internal::roomFor(kernel, model, 1, workspace)});
      EXPECT_EQ(u_q, wanted.u_q) << lanes;
      EXPECT_EQ(u_v, wanted.u_v) << lanes;
      u_a.diagonal() += model.armature();
      EXPECT_EQ(u_a, wanted.u_a) << lanes;
    }
  }
}

TEST(Derivatives, NameWrongSizesAndWhatMovesNoMass) {
  Rng rng(418);
  const Model model = compile(randomScene(rng, 12));
  const RandomMotion at(rng, model);
  const VectorXd u = rng.normalVector(model.nv()), two = Eigen::Vector2d(1, 2);
  EXPECT_REX_ERROR(inverseDynamicsDerivatives(model, two, at.v, u),
                   "joint positions q: found a vector of size 2, wanted size 29");
  EXPECT_REX_ERROR(inverseDynamicsDerivatives(model, at.q, two, u),
                   "joint velocities v: found a vector of size 2, wanted size 27");
  EXPECT_REX_ERROR(inverseDynamicsDerivatives(model, at.q, at.v, two),
                   "joint accelerations a: found a vector of size 2, wanted size 27");
  EXPECT_REX_ERROR(forwardDynamicsDerivatives(model, at.q, at.v, two),
                   "joint forces u: found a vector of size 2, wanted size 27");
  SceneSpec spec;
  addRod(spec, "rod", "world", Vector3d::Zero());
  spec.bodies[0].mass = 0;
  spec.bodies[0].inertia = Eigen::Matrix3d::Zero();
  const VectorXd one = VectorXd::Zero(1);
  EXPECT_REX_ERROR(forwardDynamicsDerivatives(compile(spec), one, one, one),
                   "joint 'rodHinge' moves no mass: wanted some: give body 'rod' a mass");
}

TEST(Derivatives, OfASceneThatCannotMoveAreEmpty) {
  SceneSpec spec;
  spec.bodies = {{.name = "rock", .X_WB = {}, .mass = 1}};
  EXPECT_EQ(forwardDynamicsDerivatives(compile(spec), VectorXd(), VectorXd(), VectorXd()).a_q.size(), 0);
}

#ifndef __SANITIZE_ADDRESS__
TEST(Derivatives, AllocateOnlyAtFirst) {
  Rng rng(419);
  for (const Followers followers : {Followers::kNone, Followers::kSome}) {
    const Model model = randomModel(rng, 30, followers);
    const RandomMotion at(rng, model);
    const VectorXd u = rng.normalVector(model.nv());
    DynamicsWorkspace workspace;
    InverseDynamicsDerivatives inverse;
    ForwardDynamicsDerivatives forward;
    const auto differentiate = [&] {
      inverseDynamicsDerivatives(model, at.q, at.v, u, earthGravity(), workspace, inverse);
      forwardDynamicsDerivatives(model, at.q, at.v, u, earthGravity(), workspace, forward);
    };
    const long before = allocations();
    differentiate();
    const long first = allocations();
    differentiate();
    EXPECT_GT(first, before);
    EXPECT_EQ(allocations(), first);
  }
}
#endif

}  // namespace rex::derivatives_test
