// A second opinion: KDL computes the same poses and Jacobians.
#include <gtest/gtest.h>

#ifdef REX_WITH_KDL

#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "kinematics/jacobians.h"
#include "support/kdl_tree.h"
#include "support/random_scene.h"

namespace rex::peer_test {

constexpr double kTolerance = 1e-11;

// A random tree in which every joint is a hinge, a slider or rigid.
Model randomPeerScene(Rng& rng, int bodies) {
  SceneSpec spec = randomScene(rng, bodies);
  for (JointSpec& joint : spec.joints) {
    const double kind = rng.uniform(0, 1);
    joint.type = kind < 0.6 ? JointType::kHinge : kind < 0.9 ? JointType::kSlider : JointType::kRigid;
  }
  return compile(spec);
}

void expectSame(const KdlChain& kdl, const Model& model, const Eigen::VectorXd& q, BodyId body) {
  const std::string& name = model[body].name;
  const BodyPoses poses = forwardKinematics(model, q);
  KDL::JntArray chainQ(kdl.chain.getNrOfJoints());
  chainQ.data = q(kdl.indices);

  KDL::Frame frame;
  ASSERT_EQ(KDL::ChainFkSolverPos_recursive(kdl.chain).JntToCart(chainQ, frame), 0) << name;
  EXPECT_TRUE(isApprox(poses[body], poseFrom(frame), kTolerance)) << name;

  KDL::Jacobian chainJ(kdl.chain.getNrOfJoints());
  ASSERT_EQ(KDL::ChainJntToJacSolver(kdl.chain).JntToJac(chainQ, chainJ), 0) << name;
  Eigen::MatrixXd theirs = Eigen::MatrixXd::Zero(6, model.nv()), ours(6, model.nv());
  theirs(Eigen::all, kdl.indices) = chainJ.data;
  ours << positionJacobian(model, poses, body, Eigen::Vector3d::Zero()), angularJacobian(model, poses, body);
  EXPECT_LE((ours - theirs).cwiseAbs().maxCoeff(), kTolerance) << name;
}

TEST(Peer, KdlAgreesOnRandomTrees) {
  Rng rng(31);
  for (int i = 0; i < 20; ++i) {
    const Model model = randomPeerScene(rng, 3 + i);
    const KDL::Tree tree = kdlTree(model);
    const Eigen::VectorXd q = 3 * rng.normalVector(model.nq());
    for (int b = 1; b < static_cast<int>(model.bodies().size()); ++b)
      expectSame(kdlChain(model, tree, BodyId{b}), model, q, BodyId{b});
  }
}

TEST(Peer, KdlAgreesOnBatches) {
  Rng rng(32);
  const Model model = randomPeerScene(rng, 12);
  const BodyId body{static_cast<int>(model.bodies().size()) - 1};
  const KdlChain kdl = kdlChain(model, kdlTree(model), body);
  Eigen::MatrixXd Q(model.nq(), 11);
  for (auto q : Q.colwise()) q = 3 * rng.normalVector(model.nq());
  PoseBatch poses;
  JacobianBatch linear, angular;
  forwardKinematicsBatch(model, Q, poses);
  positionJacobianBatch(model, poses, body, Eigen::Vector3d::Zero(), linear);
  angularJacobianBatch(model, poses, body, angular);
  for (int k = 0; k < poses.count(); ++k) {
    KDL::JntArray chainQ(kdl.chain.getNrOfJoints());
    chainQ.data = Q(kdl.indices, k);
    KDL::Frame frame;
    KDL::Jacobian J(kdl.chain.getNrOfJoints());
    ASSERT_EQ(KDL::ChainFkSolverPos_recursive(kdl.chain).JntToCart(chainQ, frame), 0);
    ASSERT_EQ(KDL::ChainJntToJacSolver(kdl.chain).JntToJac(chainQ, J), 0);
    EXPECT_TRUE(isApprox(poses.pose(body, k), poseFrom(frame), kTolerance));
    EXPECT_TRUE(linear.jacobian(k)(Eigen::all, kdl.indices).isApprox(J.data.topRows<3>(), kTolerance));
    EXPECT_TRUE(angular.jacobian(k)(Eigen::all, kdl.indices).isApprox(J.data.bottomRows<3>(), kTolerance));
  }
}

}  // namespace rex::peer_test

#else

TEST(Peer, KdlAgreesOnBatches) {
  GTEST_SKIP() << "KDL (liborocos-kdl-dev) was not found when this was built";
}

TEST(Peer, KdlAgreesOnRandomTrees) {
  GTEST_SKIP() << "KDL (liborocos-kdl-dev) was not found when this was built";
}

#endif
