#include "course/clearances.h"

#include <fstream>
#include <sstream>
#include <utility>

#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "base/rng.h"
#include "course/simulator.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::clearances_test {

const Eigen::Vector3d kTip(0, 0, 0.15);

// The planar arm; its hand may hit two balls, of which one is ahead of it, the other 30 m away.
Simulator armAndBalls(const Eigen::Vector3d& q) {
  SimulatorDescription scene = Simulator("arm3.ors").description();
  scene.q = q;
  const Simulator bare(scene);
  const Eigen::Vector3d tip = bare.kinematicsPos("eff", kTip),
                        ahead = tip + 2 * (tip - bare.kinematicsPos("eff"));
  scene.sceneText += "\nEdit body eff { contact }";
  for (const auto& [name, p] : {std::pair("near", ahead), std::pair("far", Eigen::Vector3d(0, 30, 0))}) {
    std::ostringstream shape;
    shape << "\nshape " << name << " { rel=<T t(" << p.x() << " " << p.y() << " " << p.z()
          << ")> type=ST_sphere size=[0 0 0 0.1] contact }";
    scene.sceneText += shape.str();
  }
  return Simulator(scene);
}

// The round end of the hand (0.05 m) and a ball (0.1 m) that is 0.3 m ahead.
TEST(Clearances, AreThoseOfAPointAndABall) {
  const Simulator S = armAndBalls({0.3, 0.2, -0.4});
  const Clearances found = clearances(S);
  ASSERT_EQ(found.y.size(), 2);
  EXPECT_NEAR(found.y[0], 0.3 - 0.15, 1e-4);  // six digits in the text of the scene
  const Eigen::Vector3d axis = (S.kinematicsPos("eff", kTip) - S.kinematicsPos("eff")).normalized();
  const Eigen::RowVectorXd wanted = -axis.transpose() * S.jacobianPos("eff", kTip);
  EXPECT_LT((found.J.row(0) - wanted).norm(), 1e-3);
  EXPECT_GT(found.y[1], 28);
}

TEST(Clearances, HaveTheJacobianOfDifferences) {
  Rng rng(3);
  for (int i = 0; i < 5; ++i) {
    Simulator S = armAndBalls(rng.uniformVector(3, -1, 1));
    const Eigen::VectorXd q = S.getJointAngles() + 0.2 * rng.normalVector(3);
    const auto distances = [&](const Eigen::VectorXd& at) {
      S.setJointAngles(at);
      return clearances(S).y;
    };
    S.setJointAngles(q);
    const JacobianCheck check = checkJacobian(distances, clearances(S).J, q);
    EXPECT_TRUE(check.ok) << check.message;
  }
}

TEST(Clearances, AddUpToTheContactCost) {
  Simulator S = armAndBalls({0.3, 0.2, -0.4});
  S.setContactMargin(0.4);
  const double d = clearances(S).y[0];
  EXPECT_NEAR(S.kinematicsContacts()[0], 1 - d / 0.4, 1e-12);
}

TEST(Clearances, NeedTheMeshesOfShapesThatCollide) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "wedge.off")
      << "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
  std::ofstream(folder.path() / "scene.ors") << "body wedge { type=3 mesh='wedge.off' contact }\n"
                                                "body post {} body ball { type=1 size=[0 0 0 .1] contact }\n"
                                                "joint (post ball) { A=<T t(0 0 2)> }";
  const Simulator S((folder.path() / "scene.ors").string()), without(S.description());
  EXPECT_EQ(clearances(S).y.size(), 1);
  EXPECT_REX_ERROR(clearances(without), "mesh");
}

}  // namespace rex::clearances_test
