#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "base/process.h"
#include "course/course.h"
#include "kinematics/forward_kinematics.h"
#include "kinematics/inverse_kinematics.h"
#include "locomotion/footsteps.h"
#include "render/image.h"
#include "render/video_sink.h"
#include "scene/model.h"
#include "support/changed_path.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/image_difference.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::simulator_test {

namespace fs = std::filesystem;

// A folder of its own for each test, gone afterwards.
class SimulatorTest : public testing::Test {
 protected:
  std::string in(const std::string& name) const { return (folder_.path() / name).string(); }

 private:
  TemporaryFolder folder_;
};

TEST_F(SimulatorTest, StartsInThePostureOfTheFile) {
  Simulator S("man.ors");
  EXPECT_EQ(S.getJointDimension(), 27);
  EXPECT_EQ(S.getJointAngles(), Eigen::VectorXd::Zero(27));
  EXPECT_LT((S.kinematicsPos("handR") - Eigen::Vector3d(-.19044, -.25586, .79452)).norm(), 1e-5);
}

TEST_F(SimulatorTest, FindsScenesByPathToo) {
  EXPECT_EQ(Simulator(sourcePath("data/robots/pegArm.ors").string()).getJointDimension(), 3);
  EXPECT_EQ(Simulator("pegArm").getJointDimension(), 3);
  EXPECT_REX_ERROR(Simulator("mann.ors"), "there is no scene 'mann.ors': wanted an .ors, .urdf or .xml file");
  EXPECT_REX_ERROR(Simulator("mann.ors"), "(did you mean 'man.ors'");
  EXPECT_REX_ERROR(Simulator("no/such.ors"), "there is no scene 'no/such.ors'");
}

// Its description stands for itself, also where the model has parts in other files.
TEST_F(SimulatorTest, LoadsModelsOfMujoco) {
  const std::string arm =
      "<body name='arm'><joint name='j' axis='0 1 0'/><geom type='capsule' size='.1' fromto='0 0 0 1 0 "
      "0'/></body>";
  std::ofstream(in("arm.xml")) << "<mujoco>" << arm << "</mujoco>";
  std::ofstream(in("whole.xml")) << "<mujoco><worldbody>" << arm << "</worldbody></mujoco>";
  std::ofstream(in("parts.xml")) << "<mujoco><worldbody><include file='arm.xml'/></worldbody></mujoco>";
  for (const char* name : {"whole.xml", "parts.xml"}) {
    const Simulator S(in(name)), again(S.description());
    EXPECT_EQ(S.getJointDimension(), 1);
    EXPECT_EQ(again.getJointDimension(), 1);
    EXPECT_DOUBLE_EQ(again.model().mass(), S.model().mass());
  }
}

TEST_F(SimulatorTest, TakesTheChoicesOfAnSrdfAlong) {
  const std::string ball = "<collision><geometry><sphere radius='.1'/></geometry></collision>";
  std::ofstream(in("arm.urdf"))
      << "<robot name='arm'><link name='a'>" + ball + "</link><link name='b'>" + ball +
             "</link><link name='c'>" + ball +
             "</link><joint name='j' type='continuous'><parent link='a'/><child link='b'/>"
             "<origin xyz='0 0 .1'/></joint><joint name='k' type='continuous'><parent "
             "link='b'/><child link='c'/><origin xyz='0 0 .05'/></joint></robot>";
  testing::internal::CaptureStderr();
  const Simulator warned(in("arm.urdf"));
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              testing::HasSubstr("'a' and 'c' overlap at home by 0.05 m"));
  EXPECT_EQ(warned.kinematicsContacts().size(), 1);
  EXPECT_EQ(warned.kinematicsContacts()[0], 0);
  std::ofstream(in("arm.srdf")) << "<robot name='arm'><enable_collisions link1='a' link2='c'/></robot>";
  testing::internal::CaptureStderr();
  const Simulator S(in("arm.urdf"));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_GT(S.kinematicsContacts()[0], 1);
  EXPECT_EQ(Simulator(S.description()).kinematicsContacts(), S.kinematicsContacts());
  Simulator anchored(S);
  anchored.anchorKinematicChainIn("c");
  EXPECT_EQ(anchored.model().collisionRule(), CollisionRule::kAllButNeighbours);
  EXPECT_EQ(anchored.model().collisionChoices().size(), 1u);
  EXPECT_NEAR(Simulator(anchored.description()).kinematicsContacts()[0], S.kinematicsContacts()[0], 1e-9);
}

TEST_F(SimulatorTest, LoadsTheMeshesOfAFileButNotThoseOfADescription) {
  std::ofstream(in("wedge.off"))
      << "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
  std::ofstream(in("scene.ors")) << "body wedge { type=3 mesh='wedge.off' }";
  const Simulator S(in("scene.ors"));
  EXPECT_EQ(S.model().shapes()[0].shape.mesh.triangles().size(), 4u);
  EXPECT_TRUE(Simulator(S.description()).model().shapes()[0].shape.mesh.isEmpty());
  fs::remove(in("wedge.off"));
  testing::internal::CaptureStderr();
  EXPECT_NO_THROW(Simulator(in("scene.ors"))) << "a box stands for it";
  EXPECT_THAT(testing::internal::GetCapturedStderr(), testing::HasSubstr("warning: "));
  EXPECT_NO_THROW(Simulator(S.description()));
}

// With the wrong sign of a gain, nothing is left of a figure; the next one must still be drawn.
TEST(Plot, SaysWhatCannotBeDrawn) {
  const TemporaryFolder folder;
  const std::string name = (folder.path() / "figure").string();
  Figure figure{.title = "Poles", .xLabel = "x", .yLabel = "y", .yRange = AxisRange{-1, 2}};
  figure.series = {{.label = "a", .x = {1, 2}, .y = {5, 6}}};
  ::testing::internal::CaptureStderr();
  plot(name, figure);
  EXPECT_THAT(::testing::internal::GetCapturedStderr(),
              ::testing::HasSubstr("is not drawn: figure 'Poles': "));
  EXPECT_FALSE(std::filesystem::exists(name + ".png"));
  figure.yRange.reset();
  EXPECT_THROW(plot("/proc/none/figure", figure), Error);
}

TEST_F(SimulatorTest, LoadsUrdfByName) {
  const Simulator S("quadruped");
  EXPECT_EQ(S.getJointDimension(), 12);
  EXPECT_EQ(Simulator(S.description()).kinematicsPos("front_left_foot"), S.kinematicsPos("front_left_foot"));
}

TEST_F(SimulatorTest, DescribesScenesOfSeveralFiles) {
  std::ofstream(in("post.ors")) << "body post { X=<T t(0 0 2)> }";
  std::ofstream(in("scene.ors"))
      << "Include='post.ors'\nbody arm {}\njoint (post arm) { A=<T t(0 0 .5)> q=.3 }";
  const Simulator S(in("scene.ors")), copy(S.description());
  EXPECT_EQ(copy.kinematicsPos("arm"), Eigen::Vector3d(0, 0, 2.5));
  EXPECT_EQ(copy.getJointAngles(), S.getJointAngles());
}

TEST_F(SimulatorTest, SaysWhatKeepsPins) {
  std::ofstream(in("scene.ors"))
      << "body a {}\nbody b {}\njoint (world a) {}\njoint (world b) {}\npin (a b) {}";
  testing::internal::CaptureStderr();
  const Simulator S(in("scene.ors"));
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              testing::HasSubstr("pins close loops here: stepPhysics() keeps them closed"));
}

TEST_F(SimulatorTest, PrintsWarningsOfTheReader) {
  std::ofstream(in("scene.ors")) << "body arm { mas=2 }";
  testing::internal::CaptureStderr();
  const Simulator S(in("scene.ors"));
  EXPECT_THAT(testing::internal::GetCapturedStderr(), testing::HasSubstr("scene.ors:1:12: warning: "));
}

// The lecture's numbers for exercise 3.2: |y - y*| after full steps and after steps of a tenth.
TEST_F(SimulatorTest, ReproducesTheTaskErrorsOfTheCourse) {
  const Eigen::Vector3d target(-.2, -.4, 1.1);
  const auto errorsWithSteps = [&](double alpha, int steps) {
    Simulator S("man.ors");
    std::vector<double> errors = {(S.kinematicsPos("handR") - target).norm()};
    for (int i = 0; i < steps; ++i) {
      const Eigen::MatrixXd J = S.jacobianPos("handR");
      const Eigen::MatrixXd regularised = J.transpose() * J + 1e-4 * Eigen::MatrixXd::Identity(27, 27);
      S.setJointAngles(S.getJointAngles() +
                       alpha * solve(regularised, J.transpose() * (target - S.kinematicsPos("handR"))));
      errors.push_back((S.kinematicsPos("handR") - target).norm());
    }
    return errors;
  };
  const std::vector<double> full = errorsWithSteps(1, 4);
  EXPECT_NEAR(full[0], .3379, 5e-5);
  EXPECT_NEAR(full[1], .1750, 5e-5);
  EXPECT_NEAR(full[2], .0297, 5e-5);
  EXPECT_NEAR(full[3], .0015, 5e-5);
  EXPECT_NEAR(full[4], 4e-6, 5e-7);
  const std::vector<double> small = errorsWithSteps(.1, 100);
  EXPECT_NEAR(small[1], .3041, 5e-5);
  EXPECT_NEAR(small[10], .1179, 5e-5);
  EXPECT_NEAR(small[50], .0018, 5e-5);
  EXPECT_NEAR(small[100], 9e-6, 5e-7);
}

TEST_F(SimulatorTest, JacobiansAgreeWithDifferences) {
  Simulator S("man.ors");
  Rng rng(1);
  for (const double scale : {0., 1e-8, 1.}) {
    const Eigen::VectorXd q = scale * rng.normalVector(27);
    const auto check = [&](const VectorFunction& f, const Eigen::MatrixXd& J) {
      const JacobianCheck result = checkJacobian(f, J, q, 1e-8);
      EXPECT_TRUE(result.ok) << result.message;
    };
    const auto at = [&](const Eigen::VectorXd& posture) -> Simulator& {
      S.setJointAngles(posture);
      return S;
    };
    const Eigen::Vector3d rel(.1, .2, .3);
    check([&](const Eigen::VectorXd& x) { return at(x).kinematicsPos("handL", rel); },
          at(q).jacobianPos("handL", rel));
    check([&](const Eigen::VectorXd& x) { return at(x).kinematicsVec("head", rel); },
          at(q).jacobianVec("head", rel));
    check([&](const Eigen::VectorXd& x) { return at(x).kinematicsCOM(); }, at(q).jacobianCOM());
    check([&](const Eigen::VectorXd& x) { return at(x).kinematicsQuat("handL"); },
          at(q).jacobianQuat("handL"));
  }
}

// One that penetrates, one that nearly touches, one that is free.
TEST_F(SimulatorTest, ContactCostsAreThoseOfTheCourse) {
  Simulator S("pegInAHole.ors");
  S.setContactMargin(.02);
  const Eigen::VectorXd inTheHole =
      (Eigen::VectorXd(7) << 0.945499, 0.431195, -1.97155, 0.623969, 2.22355, -0.665206, -1.48356).finished();
  const Eigen::VectorXd inTheWall = (Eigen::VectorXd(7) << 0.891517560122, 0.334051987365, -1.81008497784,
                                     0.524757936631, 1.97316199614, -0.426071069568, -1.31115913687)
                                        .finished();
  for (const Eigen::VectorXd& free : {Eigen::VectorXd(Eigen::VectorXd::Zero(7)), inTheHole}) {
    S.setJointAngles(free);
    EXPECT_EQ(S.kinematicsContacts(), Eigen::VectorXd::Zero(1));
    EXPECT_EQ(S.jacobianContacts(), Eigen::MatrixXd::Zero(1, 7));
  }
  S.setContactMargin(.06);  // the peg is 0.05 from all four walls
  EXPECT_NEAR(
      S.kinematicsContacts()[0],
      6 - (0.050010855025 + 0.049981552391 + 0.049992976099 + 0.050003138974 + 2 * 0.024491145218) / .06,
      1e-9);
  S.setContactMargin(.1);
  S.setJointAngles(inTheWall);
  EXPECT_GT(S.kinematicsContacts()[0], 2.5);
  const VectorFunction cost = [&](const Eigen::VectorXd& q) {
    S.setJointAngles(q);
    return S.kinematicsContacts();
  };
  // Where the peg is parallel to its walls, the nearest points jump.
  const Eigen::VectorXd aslant = inTheHole + Eigen::VectorXd::LinSpaced(7, -.02, .01);
  for (const Eigen::VectorXd& q : {aslant, Eigen::VectorXd(aslant.array() + 1e-8), inTheWall}) {
    S.setJointAngles(q);
    const JacobianCheck check = checkJacobian(cost, S.jacobianContacts(), q, 1e-5);
    EXPECT_TRUE(check.ok) << check.message;
  }
}

TEST_F(SimulatorTest, ReportsWhatIsNear) {
  Simulator S("pegInAHole.ors");
  S.setJointAngles(
      (Eigen::VectorXd(7) << 0.945499, 0.431195, -1.97155, 0.623969, 2.22355, -0.665206, -1.48356)
          .finished());
  const std::string report = S.proxyReport();
  EXPECT_THAT(report, testing::StartsWith("pair           distance          point of the first"));
  EXPECT_EQ(std::count(report.begin(), report.end(), '\n'), 13) << "all twelve pairs are near";
  EXPECT_LT(report.find("hole#2 - arm5    0.0245"), report.find("hole#1 - peg     0.0500")) << report;
  testing::internal::CaptureStdout();
  S.reportProxies();
  fflush(stdout);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), report);
  EXPECT_EQ(Simulator("man.ors").proxyReport().find('\n') + 1, Simulator("man.ors").proxyReport().size())
      << "nothing of the man collides";
}

TEST_F(SimulatorTest, RefusesMarginsThatAreNone) {
  Simulator S("pegInAHole.ors");
  for (const double margin : {0., -1., std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_REX_ERROR(S.setContactMargin(margin), "wanted a positive, finite number of metres");
  EXPECT_REX_ERROR(S.setContactMargin(-1), "setContactMargin: found -1 m");
  EXPECT_REX_ERROR(Simulator({.sceneName = "a.ors", .sceneText = "body a {}", .q = {}, .contactMargin = 0}),
                   "setContactMargin: found 0 m");
}

// Whoever never asks for contacts does not need them.
TEST_F(SimulatorTest, RefusesContactsOfMeshesThatAreNotThere) {
  std::ofstream(in("wedge.off"))
      << "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
  std::ofstream(in("scene.ors")) << "body wedge { type=3 mesh='wedge.off' contact }\n"
                                    "body post {} body ball { type=1 size=[0 0 0 .1] contact }\n"
                                    "joint (post ball) { A=<T t(0 0 2)> }";
  const Simulator S(in("scene.ors")), without(S.description());
  EXPECT_EQ(S.kinematicsContacts().size(), 1);
  EXPECT_REX_ERROR(without.kinematicsContacts(), "mesh");
  EXPECT_REX_ERROR(without.jacobianContacts(), "mesh");
  EXPECT_REX_ERROR(without.proxyReport(), "mesh");
}

// The humanoid steps from one foot to the other.
TEST_F(SimulatorTest, AnchorsTheChainInABody) {
  Simulator S("man.ors");
  Rng rng(2);
  S.setJointAngles(.3 * rng.normalVector(27));
  S.setContactMargin(.05);
  const Simulator before = S;
  S.anchorKinematicChainIn("rfoot");
  EXPECT_EQ(S.getJointDimension(), 27);
  for (const char* body : {"rfoot", "handR", "head", "waist", "lfoot"}) {
    EXPECT_LT((S.kinematicsPos(body, {.1, .2, .3}) - before.kinematicsPos(body, {.1, .2, .3})).norm(), 1e-12);
    EXPECT_LT((S.kinematicsVec(body) - before.kinematicsVec(body)).norm(), 1e-12);
  }
  EXPECT_LT((S.kinematicsCOM() - before.kinematicsCOM()).norm(), 1e-12);
  EXPECT_EQ(S.recording().count(), 1u) << "older postures have another meaning";

  const Eigen::Vector3d foot = S.kinematicsPos("rfoot"), hand = S.kinematicsPos("handR");
  S.setJointAngles(S.getJointAngles() + .1 * rng.normalVector(27));
  EXPECT_EQ(S.kinematicsPos("rfoot"), foot);
  EXPECT_GT((S.kinematicsPos("waist") - before.kinematicsPos("waist")).norm(), 1e-3);
  EXPECT_GT((S.kinematicsPos("handR") - hand).norm(), 1e-3);
  EXPECT_EQ(S.jacobianPos("rfoot"), Eigen::MatrixXd::Zero(3, 27));

  const Simulator copy(S.description());
  EXPECT_EQ(copy.getJointAngles(), S.getJointAngles());
  EXPECT_LT((copy.kinematicsPos("handR") - S.kinematicsPos("handR")).norm(), 1e-12);
  EXPECT_EQ(copy.description().contactMargin, .05);
  EXPECT_REX_ERROR(S.anchorKinematicChainIn("rfot"), "has no body 'rfot' (did you mean 'rfoot'");
  S.anchorKinematicChainIn("lfoot");
  EXPECT_LT((S.kinematicsPos("handR") - copy.kinematicsPos("handR")).norm(), 1e-12);
}

// The humanoid walks by inverse kinematics: it shifts its weight over one foot, and puts the other one
// forward.
class StaticWalk {
 public:
  StaticWalk() { S_.anchorKinematicChainIn(stand_); }

  // One step of 0.2 m, with the mass above a point that divides the way between the soles as 1 + lean : 1 -
  // lean. Returns by how much, while only one foot is on the floor, the mass is inside that foot's sole;
  // negative: it would fall.
  double step(double lean) {
    double least = 1;
    const Eigen::Vector3d place = S_.kinematicsPos(stand_, kSole), from = S_.kinematicsPos(swing_, kSole),
                          to(place.x() + 0.2, from.y(), from.z());
    const Eigen::Vector2d before = S_.kinematicsCOM(),
                          aim = (1 + lean) / 2 * place.head(2) + (1 - lean) / 2 * from.head(2);
    for (int i = 1; i <= 20; ++i) move(from, before + i / 20. * (aim - before));
    for (int i = 1; i <= 20; ++i) {
      const double s = i / 20.;
      move(from + s * (to - from) + Eigen::Vector3d(0, 0, 0.24 * s * (1 - s)), aim);
      least = std::min(least, margin());
    }
    EXPECT_LT((S_.kinematicsPos(swing_, kSole) - to).norm(), 2e-3);
    S_.anchorKinematicChainIn(swing_);
    std::swap(stand_, swing_);
    return least;
  }

 private:
  inline static const Eigen::Vector3d kSole{0.03, 0, -0.075}, kHalf{0.12, 0.055, 0};  // its centre and size

  void move(const Eigen::Vector3d& sole, const Eigen::Vector2d& under) {
    const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), z = Eigen::Vector3d::UnitZ();
    for (int i = 0; i < 3; ++i) {
      Eigen::VectorXd error(18);
      error << under - S_.kinematicsCOM(), sole - S_.kinematicsPos(swing_, kSole),
          x - S_.kinematicsVec(swing_, x), z - S_.kinematicsVec(swing_, z), x - S_.kinematicsVec("pelvis", x),
          z - S_.kinematicsVec("pelvis", z), height_ - S_.kinematicsPos("pelvis").z();
      Eigen::MatrixXd J(18, S_.getJointDimension());
      J << S_.jacobianCOM(), S_.jacobianPos(swing_, kSole), S_.jacobianVec(swing_, x),
          S_.jacobianVec(swing_, z), S_.jacobianVec("pelvis", x), S_.jacobianVec("pelvis", z),
          S_.jacobianPos("pelvis").bottomRows(1);
      S_.setJointAngles(S_.getJointAngles() + inverseKinematicsStep(J, error, 0.01));
    }
  }

  // By the support polygon; and in the frame of the foot, where its sole is a box, with the mass of each
  // body.
  double margin() const {
    Eigen::Matrix2Xd corners(2, 4);
    for (int k = 0; k < 4; ++k)
      corners.col(k) = S_.kinematicsPos(stand_, kSole + Eigen::Vector3d(k % 2 ? kHalf.x() : -kHalf.x(),
                                                                        k / 2 ? kHalf.y() : -kHalf.y(), 0))
                           .head(2);
    const double inside = supportMargin(supportPolygon(corners), S_.kinematicsCOM()).margin;
    const Model& model = S_.model();
    const BodyPoses poses = forwardKinematics(model, S_.getJointAngles());
    Eigen::Vector3d mass = Eigen::Vector3d::Zero();
    for (int i = 1; i < static_cast<int>(model.bodies().size()); ++i)
      mass += model[BodyId{i}].mass / model.mass() * (poses[BodyId{i}] * model[BodyId{i}].p_BBcm);
    const Eigen::Vector3d off = poses[model.body(stand_)].inverse() * mass - kSole;
    if (inside >= 0) {
      EXPECT_NEAR(inside, (kHalf - off.cwiseAbs()).head(2).minCoeff(), 1e-6);  // it tilts by 1e-7
    }
    EXPECT_EQ(inside >= 0, std::abs(off.x()) <= kHalf.x() && std::abs(off.y()) <= kHalf.y());
    return inside;
  }

  Simulator S_{"humanoid"};
  std::string stand_ = "left_foot", swing_ = "right_foot";
  double height_ = S_.kinematicsPos("pelvis").z() - 0.06;
};

TEST(StaticWalk, StandsOnOneFootIfItLeansFarEnough) {
  StaticWalk walk, hasty;
  for (const char* foot : {"left", "right"}) {
    EXPECT_NEAR(walk.step(0.9), 0.0455, 1e-4) << foot;    // half the width of a sole, less 0.1 * 0.19 m / 2
    EXPECT_NEAR(hasty.step(0.3), -0.0115, 1e-4) << foot;  // less 0.7 * 0.19 m / 2
  }
}

// Its description is .ors, whatever the file was.
TEST_F(SimulatorTest, AnchorsAUrdfToo) {
  Simulator S("quadruped");
  S.anchorKinematicChainIn("front_left_foot");
  EXPECT_LT((Simulator(S.description()).kinematicsPos("rear_right_foot") - S.kinematicsPos("rear_right_foot"))
                .norm(),
            1e-12);
}

TEST_F(SimulatorTest, OffersTheScriptsFormsToo) {
  Simulator S("pegInAHole.ors");
  Eigen::VectorXd q, y;
  Eigen::MatrixXd J;
  S.getJointAngles(q);
  EXPECT_EQ(q, S.getJointAngles());
  S.kinematicsPos(y, "peg");
  EXPECT_EQ(y, S.kinematicsPos("peg"));
  S.jacobianPos(J, "peg");
  EXPECT_EQ(J, S.jacobianPos("peg"));
  S.kinematicsVec(y, "peg");
  EXPECT_EQ(y, S.kinematicsVec("peg", {0, 0, 1}));
  S.jacobianVec(J, "peg");
  EXPECT_EQ(J, S.jacobianVec("peg", {0, 0, 1}));
  S.kinematicsCOM(y);
  EXPECT_EQ(y, S.kinematicsCOM());
  S.jacobianCOM(J);
  EXPECT_EQ(J, S.jacobianCOM());
  S.kinematicsQuat(y, "peg");
  EXPECT_EQ(y, S.kinematicsQuat("peg"));
  S.jacobianQuat(J, "peg");
  EXPECT_EQ(J, S.jacobianQuat("peg"));
  S.setContactMargin(.5);
  S.setJointAngles(Eigen::VectorXd::Constant(7, .4));
  S.kinematicsContacts(y);
  EXPECT_EQ(y, S.kinematicsContacts());
  EXPECT_NE(y[0], 0);
  S.jacobianContacts(J);
  EXPECT_EQ(J, S.jacobianContacts());
}

TEST_F(SimulatorTest, ExplainsMistakes) {
  Simulator S("man.ors");
  EXPECT_REX_ERROR(S.kinematicsPos("handr"), "scene 'man.ors' has no body 'handr' (did you mean 'handR'");
  EXPECT_REX_ERROR(S.setJointAngles(Eigen::VectorXd::Zero(7)),
                   "setJointAngles: found a vector of size 7, wanted size 27");
  Eigen::VectorXd q = Eigen::VectorXd::Zero(27);
  q[3] = std::nan("");
  EXPECT_REX_ERROR(S.setJointAngles(q), "setJointAngles: angle 3: found nan, wanted a finite number");
  EXPECT_REX_ERROR(S.setJointAngles(Eigen::VectorXd::Ones(27), 0),
                   "setJointAngles: duration: found 0 s, wanted a positive, finite number of seconds");
  EXPECT_EQ(S.getJointAngles(), Eigen::VectorXd::Zero(27)) << "a refused posture changes nothing";
}

TEST_F(SimulatorTest, IsAValueThatCanBeRebuilt) {
  Simulator S("pegArm.ors");
  Simulator copy = S;
  copy.setJointAngles(Eigen::Vector3d(.1, .2, .3));
  EXPECT_EQ(S.getJointAngles(), Eigen::Vector3d::Zero());
  EXPECT_EQ(Simulator(copy.description()).kinematicsPos("peg"), copy.kinematicsPos("peg"));
  S = copy;
  EXPECT_EQ(S.getJointAngles(), copy.getJointAngles());
}

TEST_F(SimulatorTest, WritesTheSameFramesTwice) {
  const PictureOptions options{
      .caption = "a swing", .traces = {"peg"}, .points = {{0, -1, 1}}, .width = 160, .height = 120};
  for (const char* folder : {"first", "second"}) {
    Simulator S("pegArm.ors");
    for (int i = 1; i < 10; ++i) S.setJointAngles(Eigen::Vector3d::Constant(.1 * i));
    writeFrames(S, in(folder), options, 4);
  }
  for (const char* frame : {"0000.png", "0001.png", "0002.png", "0003.png"}) {
    EXPECT_GT(fs::file_size(in("first") + "/" + frame), 1000u);
    EXPECT_EQ(fileText(in("first") + "/" + frame), fileText(in("second") + "/" + frame)) << frame;
  }
  EXPECT_FALSE(fs::exists(in("first") + "/0004.png"));
  EXPECT_NE(fileText(in("first") + "/0000.png"), fileText(in("first") + "/0003.png"));
}

TEST_F(SimulatorTest, MakesAVideoOfItsFrames) {
  if (!missingForVideo("swing.mp4").empty()) GTEST_SKIP() << "needs the Debian package ffmpeg";
  Simulator S("pegArm.ors");
  for (int i = 0; i < 5; ++i) S.setJointAngles(Eigen::Vector3d::Constant(.1 * i));
  writeVideo(S, in("swing"), {.width = 64, .height = 48});
  const ProcessResult probe =
      runProcess({"ffprobe", "-v", "error", "-count_frames", "-show_entries",
                  "stream=nb_read_frames,width,height,avg_frame_rate", "-of", "csv=p=0", in("swing.mp4")});
  EXPECT_EQ(probe.output, "64,48,30/1,5\n") << probe.error;
  EXPECT_TRUE(fs::exists(in("swing/0004.png")));
  EXPECT_FALSE(fs::exists(in("swing/0005.png")));
}

// Five postures per second, shown as often, and a thousand, of which thirty per second are.
TEST_F(SimulatorTest, MakesVideosInRealTime) {
  if (!missingForVideo("swing.mp4").empty()) GTEST_SKIP() << "needs the Debian package ffmpeg";
  const auto probed = [&](double tau, int count) {
    Simulator S("pegArm.ors");
    for (int i = 0; i < count; ++i) S.setJointAngles(Eigen::Vector3d::Constant(.1 * i * tau), tau);
    writeVideo(S, in("swing"), {.width = 64, .height = 48});
    return runProcess({"ffprobe", "-v", "error", "-count_frames", "-show_entries",
                       "stream=nb_read_frames,avg_frame_rate", "-of", "csv=p=0", in("swing.mp4")})
        .output;
  };
  EXPECT_EQ(probed(.2, 11), "5/1,11\n");
  EXPECT_EQ(probed(.001, 2001), "30/1,61\n");
}

TEST_F(SimulatorTest, LeavesTheFramesWhereThereIsNoFfmpeg) {
  const Simulator S("pegArm.ors");
  testing::internal::CaptureStderr();
  {
    const ChangedPath nowhere;
    writeVideo(S, in("swing"), {.width = 64, .height = 48});
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            in("swing.mp4") +
                " is missing because ffmpeg is not installed (apt-get install ffmpeg); the frames are in " +
                in("swing") + "\n");
  EXPECT_TRUE(fs::exists(in("swing/0000.png")));
  EXPECT_FALSE(fs::exists(in("swing.mp4")));
}

using SimulatorDeathTest = SimulatorTest;

// The signal acts in the end, when nothing half made is left.
TEST_F(SimulatorDeathTest, LeavesNoHalfVideoWhenInterrupted) {
  writeProgram(in("ffmpeg"),
               "case \"$*\" in *encoder=*) echo yes;; *) kill -INT $PPID; exec sleep 600;; esac");
  const auto interrupted = [&] {
    const ChangedPath first(in("."));
    writeVideo(Simulator("pegArm.ors"), in("swing"), {.width = 64, .height = 48});
  };
  EXPECT_EXIT(interrupted(), testing::KilledBySignal(SIGINT), "");
  EXPECT_TRUE(fs::exists(in("swing/0000.png")));
  for (const auto& entry : fs::directory_iterator(in(".")))
    EXPECT_EQ(entry.path().filename().string().find("swing.mp4"), std::string::npos) << entry.path();
}

TEST_F(SimulatorTest, ShowsItsWayOnAContactSheet) {
  Simulator S("pegArm.ors");
  for (int i = 0; i < 30; ++i) S.setJointAngles(Eigen::Vector3d::Constant(.1 * i));
  const PictureOptions options{.traces = {"peg"}, .width = 160, .height = 120};
  writeContactSheet(S, in("swing"), options, 4);
  writeFrames(S, in("film"), options);
  const Image sheet = readPng(in("swing.png")), first = readPng(in("film/0000.png")),
              last = readPng(in("film/0029.png"));
  // The first picture of the sheet and its fourth, which starts the second row, are those of the film but for
  // their edges, which are smoother.
  const int below = sheet.height - 10 - (sheet.height - 10) / 2;
  const auto cut = [&](int top) {
    Image part(160, 120);
    for (int y = 0; y < part.height; ++y)
      std::copy_n(sheet.pixel(10, top + y), 3 * part.width, part.pixel(0, y));
    return part;
  };
  EXPECT_LT(imageDifference(cut(10), first, 8).mean, 1);
  EXPECT_LT(imageDifference(cut(10 + below), last, 8).mean, 1);
  EXPECT_GT(imageDifference(cut(10), last, 8).mean, 2);
}

TEST_F(SimulatorTest, TellsTheTimesOfTheFilmOnAContactSheet) {
  Simulator S("pegArm.ors");
  const auto sheet = [&](const std::string& name, int most) {
    writeContactSheet(S, in(name), {.width = 160, .height = 120}, 2, most);
    return readPng(in(name + ".png"));
  };
  for (int i = 0; i < 2; ++i) S.setJointAngles(Eigen::Vector3d::Ones());
  const Image two = sheet("two", 120);
  for (int i = 0; i < 28; ++i) S.setJointAngles(Eigen::Vector3d::Ones());
  EXPECT_EQ(sheet("thinned", 2), two) << "the last of two frames is at 1/30 s";
  EXPECT_FALSE(sheet("all", 120) == two) << "that of thirty is at 29/30 s";
  EXPECT_REX_ERROR(writeContactSheet(S, in("x"), {}, 6, 1), "number of postures: found 1, wanted at least 2");
}

TEST_F(SimulatorTest, ReplacesFramesOfAnEarlierRun) {
  Simulator S("pegArm.ors");
  const PictureOptions small{.width = 64, .height = 48};
  for (int i = 0; i < 5; ++i) S.setJointAngles(Eigen::Vector3d::Constant(.1 * i));
  writeFrames(S, in("film"), small);
  std::ofstream(in("film/notes.txt")) << "mine";
  S.clearRecording();
  S.setJointAngles(Eigen::Vector3d::Zero());
  writeFrames(S, in("film"), small);
  EXPECT_TRUE(fs::exists(in("film/0000.png")));
  EXPECT_FALSE(fs::exists(in("film/0001.png")));
  EXPECT_TRUE(fs::exists(in("film/notes.txt")));
}

TEST_F(SimulatorTest, WatchWritesOnePicture) {
  Simulator("pegInAHole.ors").watch(in("peg"));
  EXPECT_GT(fs::file_size(in("peg.png")), 1000u);
}

TEST_F(SimulatorTest, ExplainsPicturesThatCannotBe) {
  Simulator S("pegArm.ors");
  EXPECT_REX_ERROR(writePicture(S, in("x.png"), {.traces = {"pge"}}),
                   "has no body 'pge' (did you mean 'peg'?)");
  EXPECT_REX_ERROR(writeFrames(S, in("film"), {}, 1), "number of postures: found 1, wanted at least 2");
  std::ofstream(in("file")) << "x";
  EXPECT_REX_ERROR(writeFrames(S, in("file")), "file' for frames: found Not a directory");
  EXPECT_REX_ERROR(writeContactSheet(S, in("x"), {}, 1),
                   "contact sheet: pictures: found 1, wanted at least 2");
  EXPECT_REX_ERROR(writeContactSheet(S, in("x"), {.width = 0}),
                   "picture size: found 0 x 480, wanted 1 to 8192");
  EXPECT_REX_ERROR(writeContactSheet(S, in("x"), {.height = -1}), "picture size: found 640 x -1");
  writeContactSheet(S, in("wide"), {.width = 8000, .height = 10});
  EXPECT_GT(readPng(in("wide.png")).width, 480) << "a picture of one row of pixels is one, too";
  S.clearRecording();
  EXPECT_REX_ERROR(writeContactSheet(S, in("x")), "x.png: no postures for a contact sheet");
}

TEST(FormatMatrix, ShowsNameShapeAndNumbers) {
  EXPECT_EQ(formatMatrix("J", (Eigen::MatrixXd(2, 2) << 1, -2.5, 1e-7, 1234567).finished()),
            "J (2 x 2)\n           1        -2.5\n       1e-07 1.23457e+06\n");
  EXPECT_EQ(formatMatrix("q", Eigen::Vector2d(1, 2)), "q (2)\n           1           2\n");
  EXPECT_EQ(formatMatrix("q", Eigen::VectorXd::LinSpaced(7, 0, 6)),
            "q (7)\n  0 to 5:\n           0           1           2           3           4           5\n"
            "  6 to 6:\n           6\n");
  EXPECT_EQ(formatMatrix("q", Eigen::VectorXd::LinSpaced(7, 0, 6), 84),
            "q (7)\n           0           1           2           3           4           5           6\n");
}

TEST(Print, TakesVectorsOfNumbersAndOfVectors) {
  ::testing::internal::CaptureStdout();
  print("x", std::vector<double>{1, 2.5});
  print("n", std::vector{3, 4});
  print("q", std::vector<Eigen::VectorXd>{Eigen::Vector2d(1, 2), Eigen::Vector2d(3, 4)});
  print("p", std::vector<Eigen::VectorXd>{Eigen::Vector2d(1, 2), Eigen::Vector3d(3, 4, 5)});
  print("e", std::vector<Eigen::VectorXd>{});
  print("i", Eigen::Vector2i(5, 6));
  print("s", Eigen::Vector2d(1, 2) + Eigen::Vector2d(3, 4));
  print("n", 3);
  print("t", "a text");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(),
            "x (2)\n           1         2.5\nn (2)\n           3           4\n"
            "q (2 x 2)\n           1           2\n           3           4\n"
            "p[0] (2)\n           1           2\np[1] (3)\n           3           4           5\ne (0 x 0)\n"
            "i (2)\n           5           6\ns (2)\n           4           6\nn = 3\nt = a text\n");
}

TEST(Print, IsReadBeforeTheProgramIsKilled) {
  const auto printIntoAPipe = [] {
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
    std::setvbuf(stdout, nullptr, _IOFBF, BUFSIZ);
    print("x", 1);
    ::raise(SIGKILL);
  };
  EXPECT_EXIT(printIntoAPipe(), ::testing::KilledBySignal(SIGKILL), "x = 1");
}

}  // namespace rex::simulator_test
