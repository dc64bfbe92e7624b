// What the Simulator offers besides the words of the course script.
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <unistd.h>

#include "base/rng.h"
#include "collision/contacts.h"
#include "course/clearances.h"
#include "course/motion.h"
#include "course/pictures.h"
#include "course/recording.h"
#include "course/simulator.h"
#include "formats/scene_file.h"
#include "geometry/pose.h"
#include "kinematics/forward_kinematics.h"
#include "physics/physics_world.h"
#include "planning/timed_path.h"
#include "scene/model.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::simulator_facade_test {

namespace fs = std::filesystem;

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kArm = "data/robots/arm7dof/arm7dof.urdf";

// A ball of 2 kg and 0.1 m whose middle can rise from 0 to 3 m, over nothing.
Simulator ball() {
  return Simulator(SimulatorDescription{.sceneName = "ball.ors",
                                        .sceneText =
                                            "body root {}\n"
                                            "body ball { mass=2 type=ST_sphere size=[0 0 0 0.1] contact }\n"
                                            "joint drop (root ball) { type=transZ q=1 limits=[0 3] }\n",
                                        .q = {}});
}

const Shape kSlab{.type = ShapeType::kBox, .extent = {2, 2, 0.2}};
const Pose kBelowFloor = translation(0, 0, -0.1);

class SimulatorFacade : public ::testing::Test {
 protected:
  std::string in(const std::string& name) const { return (folder_.path() / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories(fs::path(in(name)).parent_path());
    std::ofstream(in(name)) << text;
  }

 private:
  TemporaryFolder folder_;
};

// The spec is what the file says; the model is what became of it.
TEST_F(SimulatorFacade, KnowsNamesAndLimits) {
  const Simulator S("arm7dof");
  const SceneSpec spec = readScene(sourcePath(kArm)).spec;
  std::vector<std::string> joints, bodies;
  VectorXd lower(7), upper(7);
  for (const JointSpec& joint : spec.joints) {
    if (joint.type != JointType::kHinge) continue;
    lower[static_cast<int>(joints.size())] = joint.lower[0];
    upper[static_cast<int>(joints.size())] = joint.upper[0];
    joints.push_back(joint.name);
  }
  for (const BodySpec& body : spec.bodies) bodies.push_back(body.name);
  EXPECT_EQ(S.getJointNames(), joints);
  EXPECT_EQ(S.getBodyNames(), bodies);
  EXPECT_EQ(S.getLowerLimits(), lower);
  EXPECT_EQ(S.getUpperLimits(), upper);
  EXPECT_EQ(upper[0], 2.9);
}

TEST_F(SimulatorFacade, NumbersTheCoordinatesOfAJoint) {
  const Simulator S("maze");
  EXPECT_THAT(S.getJointNames(), ElementsAre("drive [0]", "drive [1]", "drive [2]"));
  EXPECT_EQ(S.getLowerLimits(), Vector3d(-0.5, -0.5, -3.2));
  EXPECT_EQ(Simulator("man.ors").getUpperLimits().minCoeff(), std::numeric_limits<double>::infinity());
}

TEST_F(SimulatorFacade, FreesTheBaseOfAUrdf) {
  const Simulator S("quadruped", {.freeBase = true});
  EXPECT_EQ(S.getJointDimension(), 7 + 12);
  EXPECT_EQ(S.model().nv(), 6 + 12);
  EXPECT_EQ(S.getJointNames()[7], Simulator("quadruped").getJointNames()[0]);
  Simulator moved = S;
  VectorXd q = S.getJointAngles();
  q.head<3>() += Vector3d(1, 2, 3);
  moved.setJointAngles(q);
  EXPECT_LT(
      (moved.kinematicsPos("rear_left_foot") - S.kinematicsPos("rear_left_foot") - Vector3d(1, 2, 3)).norm(),
      1e-12);
  const Simulator copy(moved.description());
  EXPECT_LT((copy.kinematicsPos("rear_left_foot") - moved.kinematicsPos("rear_left_foot")).norm(), 1e-12);
  EXPECT_REX_ERROR(Simulator("man.ors", {.freeBase = true}), "free base: found an .ors scene");
}

TEST_F(SimulatorFacade, ReadsStrictlyIfAsked) {
  write("scene.ors", "body wedge { type=3 mesh='wedge.off' }");
  testing::internal::CaptureStderr();
  EXPECT_NO_THROW(Simulator(in("scene.ors")));
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("warning: "));
  EXPECT_REX_ERROR(Simulator(in("scene.ors"), {.strict = true}), "scene.ors:1:");
}

TEST_F(SimulatorFacade, FindsMeshesInItsAssetRoot) {
  write("wedge.off", "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  write("a/b/scene.ors", "body wedge { type=3 mesh='../../wedge.off' }");
  EXPECT_REX_ERROR(Simulator(in("a/b/scene.ors"), {.strict = true}), "wedge.off");
  const Simulator S(in("a/b/scene.ors"), {.assetRoot = in(""), .strict = true});
  EXPECT_EQ(S.model().shapes()[0].shape.mesh.triangles().size(), 4u);
}

constexpr const char* kFork =
    "<robot name='fork'><link name='base'/><link name='left'><collision><geometry><sphere "
    "radius='.1'/></geometry>"
    "</collision></link><link name='right'><collision><geometry><sphere "
    "radius='.1'/></geometry></collision></link>"
    "<joint name='l' type='prismatic'><parent link='base'/><child link='left'/><origin xyz='.3 0 0'/>"
    "<limit lower='-1' upper='1' velocity='1' effort='1'/></joint>"
    "<joint name='r' type='prismatic'><parent link='base'/><child link='right'/><origin xyz='-.3 0 0'/>"
    "<limit lower='-1' upper='1' velocity='1' effort='1'/></joint></robot>";

TEST_F(SimulatorFacade, StartsAtAPostureOfItsSrdf) {
  write("fork.urdf", kFork);
  write("own.srdf",
        "<robot name='fork'><disable_collisions link1='left' link2='right'/>"
        "<group_state name='shut' group='g'><joint name='l' value='-.3'/></group_state></robot>");
  const std::string fork = in("fork.urdf");
  EXPECT_EQ(Simulator(fork).getJointAngles(), Vector2d(0, 0));
  const Simulator S(fork, {.srdf = in("own.srdf"), .posture = "state:shut"});
  EXPECT_EQ(S.getJointAngles(), Vector2d(-.3, 0));
  EXPECT_EQ(S.recording().count(), 1u);
  EXPECT_EQ(Simulator(S.description()).getJointAngles(), S.getJointAngles());
  Simulator free(fork);
  free.setContactMargin(1);
  EXPECT_GT(free.kinematicsContacts()[0], 0);
  Simulator spared = S;
  spared.setContactMargin(1);
  EXPECT_EQ(spared.kinematicsContacts()[0], 0) << "as its SRDF says";
  EXPECT_REX_ERROR(Simulator(fork, {.srdf = in("own.srdf"), .posture = "state:shot"}), "state:shut");
  EXPECT_REX_ERROR(Simulator("man.ors", {.srdf = in("own.srdf")}), "an SRDF: wanted a .urdf robot");
}

// A long wedge of a Collada file with y up.
TEST_F(SimulatorFacade, ReadsMeshesByEitherUpAxis) {
  write(
      "tall.dae",
      "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'>"
      "<asset><up_axis>Y_UP</up_axis></asset><library_geometries><geometry id='g'><mesh>"
      "<source id='p'><float_array id='a' count='12'>0 0 0 1 0 0 0 3 0 0 0 1</float_array><technique_common>"
      "<accessor source='#a' count='4' stride='3'><param name='X' type='float'/><param name='Y' "
      "type='float'/>"
      "<param name='Z' type='float'/></accessor></technique_common></source>"
      "<vertices id='v'><input semantic='POSITION' source='#p'/></vertices>"
      "<triangles count='4'><input semantic='VERTEX' source='#v' offset='0'/>"
      "<p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles></mesh></geometry></library_geometries>"
      "<library_visual_scenes><visual_scene id='s'><node><instance_geometry url='#g'/></node></visual_scene>"
      "</library_visual_scenes><scene><instance_visual_scene url='#s'/></scene></COLLADA>");
  write("tall.ors", "body tall { type=3 mesh='tall.dae' }");
  const auto height = [&](const SimulatorOptions& options) {
    double top = 0;
    const Simulator S(in("tall.ors"), options);
    for (const auto& corner : S.model().shapes()[0].shape.mesh.positions())
      top = std::max(top, static_cast<double>(corner.z()));
    return top;
  };
  EXPECT_NEAR(height({}), 3, 1e-6);
  EXPECT_NEAR(height({.ignoresUpAxis = false}), 3, 1e-6);
  EXPECT_NEAR(height({.ignoresUpAxis = true}), 1, 1e-6);
}

// How often a file was opened while something was done.
template <class Act>
int countOpens(const std::string& file, const Act& act) {
  const int queue = ::inotify_init1(IN_NONBLOCK);
  EXPECT_GE(::inotify_add_watch(queue, file.c_str(), IN_OPEN), 0);
  act();
  int count = 0;
  for (inotify_event event; ::read(queue, &event, sizeof event) > 0;) ++count;
  ::close(queue);
  return count;
}

TEST_F(SimulatorFacade, ReadsItsSceneOnce) {
  write("scene.ors", "body arm {}");
  const int once = countOpens(in("scene.ors"), [&] { static_cast<void>(readScene(in("scene.ors"))); });
  EXPECT_GT(once, 0);
  EXPECT_EQ(countOpens(in("scene.ors"), [&] { Simulator(in("scene.ors")).description(); }), once);
}

// Postures that are known give places that can be reached; forward kinematics says whether they were.
TEST_F(SimulatorFacade, ReachesPosesAndPlaces) {
  Simulator S("arm7dof");
  Rng rng(3);
  for (int trial = 0; trial < 20; ++trial) {
    VectorXd hidden(7);
    for (int i = 0; i < 7; ++i) hidden[i] = rng.uniform(S.getLowerLimits()[i], S.getUpperLimits()[i]);
    const Pose X_WB = forwardKinematics(S.model(), hidden)[S.model().body("tool")];
    const ReachedPosture posture = S.inverseKinematics("tool", X_WB);
    ASSERT_TRUE(posture.isReached) << posture.message;
    EXPECT_TRUE((posture.q.array() >= S.getLowerLimits().array()).all());
    EXPECT_TRUE((posture.q.array() <= S.getUpperLimits().array()).all());
    const Pose found = forwardKinematics(S.model(), posture.q)[S.model().body("tool")];
    EXPECT_TRUE(isApprox(found, X_WB, 2e-6));

    const Vector3d rel(0, 0.1, 0.2);
    const ReachedPosture place = S.inverseKinematics("tool", X_WB * rel, rel);
    ASSERT_TRUE(place.isReached) << place.message;
    Simulator there = S;
    there.setJointAngles(place.q);
    EXPECT_LT((there.kinematicsPos("tool", rel) - X_WB * rel).norm(), 2e-6);
    EXPECT_LE((there.kinematicsPos("tool", rel) - X_WB * rel).cwiseAbs().maxCoeff(), place.error + 1e-12);
  }
  EXPECT_EQ(S.getJointAngles(), VectorXd::Zero(7)) << "it only looks";
  EXPECT_EQ(S.inverseKinematics("tool", Vector3d(.3, .3, .5)).q,
            S.inverseKinematics("tool", Vector3d(.3, .3, .5)).q);
}

// Six hinges, the last three of which meet: the nearest posture in closed form.
TEST_F(SimulatorFacade, ReachesPosesInClosedForm) {
  const std::string text =
      "body b0 {} body b1 {} body b2 {} body b3 {} body b4 {} body b5 {} body b6 {}\n"
      "joint (b0 b1) { type=hingeZ } joint (b1 b2) { A=<T t(.3 0 .7)> type=hingeY }\n"
      "joint (b2 b3) { A=<T t(0 0 1)> type=hingeY } joint (b3 b4) { A=<T t(.5 0 0)> type=hingeX }\n"
      "joint (b4 b5) { A=<T t(.7 0 0)> type=hingeY } joint (b5 b6) { type=hingeX }\n";
  Simulator S(SimulatorDescription{.sceneName = "six.ors", .sceneText = text, .q = {}});
  VectorXd q(6);
  q << .3, .4, -.5, .6, .8, .2;
  const Pose X_WB = forwardKinematics(S.model(), q)[S.model().body("b6")];
  S.setJointAngles(q + VectorXd::Constant(6, .05));
  const ReachedPosture found = S.inverseKinematics("b6", X_WB);
  EXPECT_TRUE(found.isReached);
  EXPECT_EQ(found.message, "solved in closed form");
  EXPECT_LT((found.q - q).norm(), 1e-9);
}

TEST_F(SimulatorFacade, SaysHowFarOffWhatItCannotReachIs) {
  Simulator S(SimulatorDescription{.sceneName = "arm.ors",
                                   .sceneText = "body post {} body arm {}\n"
                                                "joint turn (post arm) { B=<T t(1 0 0)> type=hingeZ }\n",
                                   .q = {}});
  ASSERT_NEAR(S.kinematicsPos("arm").norm(), 1, 1e-12);
  const Vector3d far = 3 * S.kinematicsPos("arm");
  const ReachedPosture posture = S.inverseKinematics("arm", far);
  EXPECT_FALSE(posture.isReached);
  EXPECT_NEAR(posture.error, 2 * S.kinematicsPos("arm").cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_THAT(posture.message, HasSubstr("arm"));
  EXPECT_REX_ERROR((void)S.inverseKinematics("amr", far), "has no body 'amr' (did you mean 'arm'");
}

// Postures that reach this place exist clear of the wall and in it.
TEST_F(SimulatorFacade, ReachesPlacesClearOfContacts) {
  Simulator S("arm7dof");
  S.addObstacle({.type = ShapeType::kBox, .extent = {0.04, 1, 0.4}}, translation(0.3, 0, 0.2), "wall");
  Rng rng(5);
  int blocked = 0;
  for (int trial = 0; trial < 10; ++trial) {
    S.setJointAngles(VectorXd::NullaryExpr(
        7, [&](Eigen::Index i) { return rng.uniform(S.getLowerLimits()[i], S.getUpperLimits()[i]); }));
    const Vector3d place(0.45, rng.uniform(-.2, .2), 0.5);
    const auto touches = [&](const VectorXd& q) {
      Simulator there = S;
      there.setContactMargin(0.02);
      there.setJointAngles(q);
      return there.kinematicsContacts()[0] > 1e-5;
    };
    if (touches(S.inverseKinematics("tool", place).q)) ++blocked;
    const ReachedPosture clear = S.inverseKinematics("tool", place, Vector3d::Zero(), 0.02);
    ASSERT_TRUE(clear.isReached) << clear.message;
    EXPECT_FALSE(touches(clear.q));
    const Pose X_WB = forwardKinematics(S.model(), clear.q)[S.model().body("tool")];
    EXPECT_LT((X_WB.p - place).norm(), 2e-6);
    const ReachedPosture again = S.inverseKinematics("tool", X_WB, 0.01);
    ASSERT_TRUE(again.isReached) << again.message;
    Simulator there = S;
    there.setContactMargin(0.01);
    there.setJointAngles(again.q);
    EXPECT_EQ(there.kinematicsContacts()[0], 0);
  }
  EXPECT_GT(blocked, 0) << "the test asks for nothing that the plain call does not give";
  EXPECT_REX_ERROR((void)S.inverseKinematics("tool", Pose{}, 0.), "inverseKinematics: clearance: found 0");
}

// The distance of a ball from a slab is its height less its radius.
TEST_F(SimulatorFacade, KeepsObstaclesInMind) {
  Simulator S = ball();
  EXPECT_EQ(S.kinematicsContacts()[0], 0);
  S.addObstacle(kSlab, kBelowFloor, "floor");
  for (const double height : {2.0, 0.5, 0.13, 0.05}) {
    S.setJointAngles(VectorXd::Constant(1, height));
    EXPECT_NEAR(clearances(S).y[0], height - 0.1, 1e-9);
    EXPECT_NEAR(S.kinematicsContacts()[0], std::max(0., 1 - (height - 0.1) / 0.1), 1e-9);
    EXPECT_NEAR(Simulator(S.description()).kinematicsContacts()[0], S.kinematicsContacts()[0], 1e-9);
  }
  EXPECT_THAT(S.proxyReport(), HasSubstr("floor"));
  EXPECT_LT((S.kinematicsPos("floor") - kBelowFloor.p).norm(), 1e-15);
  EXPECT_EQ(S.getJointAngles()[0], 0.05) << "the robot stays";
  EXPECT_EQ(S.recording().count(), 4u);
}

// Balls of MuJoCo that may not touch each other, nor anything in their file, touch what is added.
TEST_F(SimulatorFacade, AddsObstaclesToModelsOfMujoco) {
  write("balls.xml",
        "<mujoco><default><geom contype='1' conaffinity='0' size='.1'/></default><worldbody>"
        "<body><joint type='slide'/><geom/></body><body pos='1 0 0'><joint type='slide'/><geom/></body>"
        "</worldbody></mujoco>");
  Simulator S(in("balls.xml"));
  EXPECT_EQ(S.kinematicsContacts()[0], 0);
  S.addObstacle(kSlab, kBelowFloor, "floor");
  S.setJointAngles(Eigen::Vector2d(-0.05, 0.05));
  EXPECT_NEAR(clearances(S).y.minCoeff(), -0.15, 1e-9);
  EXPECT_GT(S.kinematicsContacts()[0], 1);
}

// Rules that spare neighbours and what overlaps at home are not for obstacles.
TEST_F(SimulatorFacade, FeelsObstaclesThatItStandsIn) {
  Simulator S("arm7dof");
  S.addObstacle({.type = ShapeType::kSphere, .radius = 0.3}, translation(0, 0, 0.6), "cloud");
  EXPECT_GT(S.kinematicsContacts()[0], 1);
  EXPECT_THAT(S.proxyReport(), HasSubstr("cloud"));
}

TEST_F(SimulatorFacade, FallsOntoObstacles) {
  Simulator S = ball();
  S.stepPhysics(0.1);
  const double falling = S.getJointVels()[0];
  EXPECT_NEAR(falling, -0.981, 1e-3);
  S.addObstacle(kSlab, kBelowFloor, "floor");
  EXPECT_EQ(S.getJointVels()[0], falling);
  for (int i = 0; i < 20; ++i) S.stepPhysics(0.1);
  EXPECT_NEAR(S.getJointAngles()[0], 0.1, 1e-3);
}

// The same bytes as of a scene whose file has it.
TEST_F(SimulatorFacade, DrawsObstacles) {
  Simulator S = ball();
  SimulatorDescription same = S.description();
  same.sceneText +=
      "body floor { X=<T t(0 0 -0.1)> type=ST_box size=[2 2 0.2] color=[.85 .55 .3] contact fixed }\n";
  S.addObstacle(kSlab, kBelowFloor, "floor");
  const PictureOptions small{.width = 160, .height = 120};
  writePicture(S, in("added.png"), small);
  writePicture(Simulator(same), in("read.png"), small);
  writePicture(ball(), in("without.png"), small);
  EXPECT_EQ(fileText(in("added.png")), fileText(in("read.png")));
  EXPECT_NE(fileText(in("added.png")), fileText(in("without.png")));
}

TEST_F(SimulatorFacade, RefusesWhatIsNoObstacle) {
  Simulator S = ball();
  EXPECT_REX_ERROR(S.addObstacle({.type = ShapeType::kMesh}, {}, "thing"),
                   "addObstacle: shape of 'thing': found a mesh, wanted a box, sphere");
  EXPECT_REX_ERROR(S.addObstacle({.type = ShapeType::kMarker}, {}, "thing"), "found a marker");
  for (const char* name : {"", "world", "ball", "root"})
    EXPECT_REX_ERROR(S.addObstacle(kSlab, {}, name), "addObstacle: name: found '");
  EXPECT_REX_ERROR(S.addObstacle({.type = ShapeType::kSphere, .radius = -1}, {}, "thing"), "thing");
  EXPECT_THAT(S.getBodyNames(), ElementsAre("root", "ball")) << "what is refused changes nothing";
}

// The same as PhysicsWorld itself, to the bit.
TEST_F(SimulatorFacade, DrivesJointsByMotors) {
  Simulator S = ball();
  PhysicsWorld world(S.model());
  S.setPositionMotor("drop", 1.3, 200);
  world.setMotors(std::vector<Motor>{{.kind = Motor::Kind::kPosition, .target = 1.3, .maxForce = 200}});
  for (int i = 0; i < 50; ++i) S.stepPhysics(0.02), world.step(0.02);
  EXPECT_EQ(S.getJointAngles(), world.state().q);
  EXPECT_NEAR(S.getJointAngles()[0], 1.3, 1e-3);

  S.setVelocityMotor("drop", -0.5, 200);
  S.stepPhysics(0.4);
  EXPECT_NEAR(S.getJointVels()[0], -0.5, 1e-6);
  EXPECT_NEAR(S.getJointAngles()[0], 1.1, 1e-3);

  S.removeMotor("drop");
  S.stepPhysics(0.1);
  EXPECT_NEAR(S.getJointVels()[0], -0.5 - 0.981, 1e-3);
}

// 2 kg fall with g less what 5 N brake.
TEST_F(SimulatorFacade, MotorsAreNoStrongerThanTheySay) {
  Simulator S = ball();
  S.setVelocityMotor("drop", 0, 5);
  const Simulator copy = S;
  S.stepPhysics(0.2);
  EXPECT_NEAR(S.getJointVels()[0], -0.2 * (9.81 - 5 / 2.), 1e-3);
  Simulator other = copy;
  other.stepPhysics(0.2);
  EXPECT_EQ(other.getJointVels(), S.getJointVels()) << "a copy has the motors, too";
}

TEST_F(SimulatorFacade, RefusesMotorsThatMakeNoSense) {
  Simulator S = ball();
  EXPECT_REX_ERROR(S.setPositionMotor("drip", 0, 1),
                   "scene 'ball.ors' has no joint 'drip' (did you mean 'drop'");
  EXPECT_REX_ERROR(S.removeMotor("drip"), "no joint 'drip'");
  EXPECT_REX_ERROR(S.setPositionMotor("drop", std::nan(""), 1), "setPositionMotor: position: found nan");
  EXPECT_REX_ERROR(S.setVelocityMotor("drop", std::nan(""), 1), "setVelocityMotor: velocity: found nan");
  EXPECT_REX_ERROR(S.setPositionMotor("drop", 0, 0), "setPositionMotor: maxForce: found 0");
  EXPECT_REX_ERROR(S.setVelocityMotor("drop", 0, -1), "setVelocityMotor: maxForce: found -1");
  S.setPositionMotor("drop", 1, 100);
  EXPECT_REX_ERROR(S.stepPhysics(VectorXd::Constant(1, 3), 0.1),
                   "stepPhysics: force of joint 'drop': found 3, wanted zero, because it has a motor");
  Simulator free("quadruped", {.freeBase = true});
  const std::string base = free.getJointNames()[0];
  EXPECT_REX_ERROR(free.setPositionMotor(base, 0, 1), "found a free joint");
}

// What lies still is carried with its weight.
TEST_F(SimulatorFacade, FeelsWhatTouches) {
  Simulator S = ball();
  S.addObstacle(kSlab, kBelowFloor, "floor");
  EXPECT_THAT(S.getContacts(), IsEmpty());
  S.stepPhysics(0.01);
  EXPECT_THAT(S.getContacts(), IsEmpty()) << "it is in the air";
  for (int i = 0; i < 30; ++i) S.stepPhysics(0.1);
  S.stepPhysics(0.0025);  // in three inner steps
  const std::vector<SimulatorContact> contacts = S.getContacts();
  ASSERT_EQ(contacts.size(), 1u);
  const bool ballFirst = contacts[0].shapeA == "ball";
  EXPECT_EQ(ballFirst ? contacts[0].shapeB : contacts[0].shapeA, "floor");
  EXPECT_LT((contacts[0].normal_W - Vector3d(0, 0, ballFirst ? 1 : -1)).norm(), 1e-6);
  EXPECT_NEAR(contacts[0].force, 2 * 9.81, 0.1);
  EXPECT_NEAR(contacts[0].distance, S.getJointAngles()[0] - 0.1, 1e-4);
  EXPECT_LT((ballFirst ? contacts[0].p_WA : contacts[0].p_WB).norm(), 1e-3);
  EXPECT_EQ(Simulator(S).getContacts().size(), 1u);
  S.addObstacle({.type = ShapeType::kSphere, .radius = 0.1}, translation(5, 0, 0), "far");
  EXPECT_THAT(S.getContacts(), IsEmpty());
}

// The way of a cart, past the wall and within its limits; forward kinematics and contacts judge the film.
TEST_F(SimulatorFacade, MovesToAPosturePastObstacles) {
  Simulator S("maze");
  const VectorXd start = S.getJointAngles(), goal = Vector3d(3, 0, 0);
  const Move move = moveTo(S, goal);
  ASSERT_TRUE(move.isFound) << move.message;
  EXPECT_GT(move.clearance, 0);
  EXPECT_EQ(S.getJointAngles(), goal);
  EXPECT_NEAR(S.recording().duration(), move.duration, 1e-9);
  const auto postures = S.recording().evenly(2000);
  EXPECT_EQ(postures.front().q, start);
  Simulator there = S;
  there.setContactMargin(1e-9);
  const double fastest = jointLimits(S.model()).limits.velocity.maxCoeff();
  for (std::size_t i = 0; i < postures.size(); ++i) {
    there.setJointAngles(postures[i].q);
    ASSERT_EQ(there.kinematicsContacts()[0], 0) << i;
    if (i == 0) continue;
    const double tau = postures[i].time - postures[i - 1].time;
    EXPECT_LT((postures[i].q - postures[i - 1].q).cwiseAbs().maxCoeff(), 1.02 * fastest * tau);
  }
  Simulator other("maze");
  EXPECT_EQ(moveTo(other, goal).duration, move.duration) << "the same seed";
}

TEST_F(SimulatorFacade, SaysWhatItExploredInVain) {
  Simulator S("maze");
  S.addObstacle({.type = ShapeType::kBox, .extent = {0.1, 20, 4}},
                translation(S.kinematicsPos("cart").x() + 1, 0, 0), "wall");
  const VectorXd start = S.getJointAngles();
  const Move move = moveTo(S, Vector3d(3, 0, 0), {.timeLimit = 0.2});
  EXPECT_FALSE(move.isFound);
  EXPECT_THAT(move.message, HasSubstr("within 0.2 s: "));
  EXPECT_THAT(move.message, HasSubstr("samples explored"));
  EXPECT_EQ(S.getJointAngles(), start);
  EXPECT_REX_ERROR((void)moveTo(S, Vector2d(0, 0)), "moveTo: goal: found a vector of size 2, wanted size 3");
  EXPECT_REX_ERROR((void)moveTo(S, Vector3d(1, 0, 0)), "goal");
  EXPECT_REX_ERROR((void)moveTo(S, start, {.clearance = 0}), "moveTo: clearance: found 0");
}

}  // namespace rex::simulator_facade_test
