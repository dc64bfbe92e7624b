// The links of a model against its bodies and joints, in poses of their own.
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "geometry/rotation.h"
#include "kinematics/forward_kinematics.h"
#include "support/random_scene.h"

namespace rex::links_test {

Pose poseInParent(const Link& link, const Eigen::VectorXd& q) {
  const Pose constant{Eigen::Map<const Eigen::Matrix3d>(link.X_PL),
                      Eigen::Map<const Eigen::Vector3d>(link.X_PL + 9)};
  if (link.kind == Link::Kind::kQuaternion)
    return constant * Pose{rotationFromQuaternion(q.segment<4>(link.qIndex)), Eigen::Vector3d::Zero()};
  const double x = link.ratio * q[link.qIndex] + link.offset;
  const Pose turn = rotation(x, Eigen::Vector3d::UnitZ());
  if (link.kind == Link::Kind::kHinge) return constant * turn;
  const double rise = link.kind == Link::Kind::kSlider ? x : link.pitch * x;
  return constant * (link.kind == Link::Kind::kSlider ? Pose{} : turn) * translation(0, 0, rise);
}

std::vector<Pose> linkPoses(const Model& model, const Eigen::VectorXd& q) {
  std::vector<Pose> X_WL;
  for (const Link& link : model.links()) {
    const bool isRoot = link.parent == Link::kNoParent;
    X_WL.push_back((isRoot ? Pose{} : X_WL[static_cast<std::size_t>(link.parent)]) * poseInParent(link, q));
  }
  return X_WL;
}

// Mass, first moment and inertia about the world's origin.
struct Moments {
  double mass = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  // Of a body with that centre and inertia about it.
  void add(double m, const Eigen::Vector3d& c, const Eigen::Matrix3d& I) {
    mass += m;
    first += m * c;
    inertia += I - m * skew(c) * skew(c);
  }
};

Moments ofBodies(const Model& model, const Eigen::VectorXd& q) {
  const BodyPoses poses = forwardKinematics(model, q);
  Moments sum;
  for (std::size_t i = 1; i < model.bodies().size(); ++i) {
    const Body& body = model.bodies()[i];
    if (body.joint == kNoJoint) continue;
    const Pose& X_WB = poses.X_WB[i];
    sum.add(body.mass, X_WB * body.p_BBcm, X_WB.R * body.I_BBcm_B * X_WB.R.transpose());
  }
  return sum;
}

Moments ofLinks(const Model& model, const Eigen::VectorXd& q) {
  const std::vector<Pose> X_WL = linkPoses(model, q);
  Moments sum;
  for (std::size_t i = 0; i < X_WL.size(); ++i) {
    const Link& link = model.links()[i];
    if (link.mass == 0) continue;
    const Eigen::Vector3d c = Eigen::Map<const Eigen::Vector3d>(link.moment) / link.mass;
    const double* n = link.inertia;
    Eigen::Matrix3d I;
    I << n[0], n[1], n[2], n[1], n[3], n[4], n[2], n[4], n[5];
    I += link.mass * skew(c) * skew(c);
    sum.add(link.mass, X_WL[i] * c, X_WL[i].R * I * X_WL[i].R.transpose());
  }
  return sum;
}

// Nothing hangs rigidly on the first body, which stands still: all others move.
SceneSpec randomTree(Rng& rng, int bodies) {
  SceneSpec spec = randomScene(rng, bodies);
  addDetails(rng, spec);
  for (BodySpec& body : spec.bodies) body.shapes.clear();
  spec.worldShapes.clear();
  for (JointSpec& joint : spec.joints)
    if (joint.type == JointType::kRigid && joint.parent == "b0") joint.type = JointType::kHinge;
  return spec;
}

TEST(Links, CarryTheMassOfAllThatMoves) {
  Rng rng(11);
  for (int i = 0; i < 20; ++i) {
    const Model model = compile(randomTree(rng, 30 + i));
    const Eigen::VectorXd q = randomPositions(rng, model.nq());
    const Moments bodies = ofBodies(model, q), links = ofLinks(model, q);
    EXPECT_NEAR(links.mass, bodies.mass, 1e-12 * bodies.mass);
    EXPECT_TRUE(links.first.isApprox(bodies.first, 1e-11));
    EXPECT_TRUE(links.inertia.isApprox(bodies.inertia, 1e-10));
  }
}

TEST(Links, StandBehindTheirParentsAndCoverAllVelocities) {
  Rng rng(12);
  const Model model = compile(randomScene(rng, 40));
  std::vector<int> covered(static_cast<std::size_t>(model.nv()));
  for (std::size_t i = 0; i < model.links().size(); ++i) {
    const Link& link = model.links()[i];
    EXPECT_LT(link.parent, static_cast<int>(i));
    const int count = link.kind == Link::Kind::kQuaternion ? 3 : 1;
    for (int k = 0; k < count; ++k) ++covered[static_cast<std::size_t>(link.vIndex + k)];
    const Joint& joint = model[model[BodyId{link.body}].joint];
    EXPECT_GE(link.vIndex, joint.vIndex);
    EXPECT_LE(link.vIndex + count, joint.vIndex + joint.nv);
  }
  EXPECT_EQ(covered, std::vector<int>(covered.size(), 1));
}

// A door of 2 kg with a handle of 1 kg fixed to it, on a rail of 3 kg that is fixed to the world.
TEST(Links, TakeInWhatHangsOnThemRigidly) {
  SceneSpec spec;
  spec.bodies = {{.name = "rail", .X_WB = {}, .mass = 3},
                 {.name = "door", .X_WB = {}, .mass = 2},
                 {.name = "handle", .X_WB = {}, .mass = 1}};
  spec.bodies[1].inertia = spec.bodies[2].inertia = Eigen::Matrix3d::Zero();
  spec.joints = {{.name = "hinge", .parent = "rail", .child = "door", .X_PF = {}, .X_MC = {}},
                 {.name = "screws",
                  .parent = "door",
                  .child = "handle",
                  .type = JointType::kRigid,
                  .X_PF = translation(0, 0, 2),
                  .X_MC = {}}};
  spec.joints[0].axis = Eigen::Vector3d::UnitZ();
  const Model model = compile(spec);
  ASSERT_EQ(model.links().size(), 1u);
  const Link& link = model.links()[0];
  EXPECT_EQ(link.parent, Link::kNoParent);
  EXPECT_EQ(model[BodyId{link.body}].name, "door");
  EXPECT_DOUBLE_EQ(link.mass, 3);
  EXPECT_DOUBLE_EQ(link.moment[2], 2);
  EXPECT_DOUBLE_EQ(link.inertia[0], 4);
  EXPECT_DOUBLE_EQ(link.inertia[3], 4);
  EXPECT_DOUBLE_EQ(link.inertia[5], 0);
}

}  // namespace rex::links_test
