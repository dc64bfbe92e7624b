// Robots of URDF as parts of .ors scenes.
#include <fstream>
#include <numbers>
#include <span>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "formats/ors_reader.h"
#include "formats/ors_writer.h"
#include "formats/urdf_reader.h"
#include "kinematics/forward_kinematics.h"
#include "scene/model.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"
#include "support/urdf_samples.h"

namespace rex::ors_robot_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A folder "scenes" beside "robots", which hold a robot with a mesh of its own and who may collide in it.
class OrsRobot : public testing::Test {
 protected:
  void SetUp() override {
    write("robots/tricky/tricky.urdf", kTrickyRobot);
    write("robots/arm/meshes/tip.off",
          "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    write("robots/arm/arm.urdf",
          "<robot name='arm'><link name='base'/><link name='tip'><collision><geometry><mesh "
          "filename='meshes/tip.off'/></geometry></collision></link><joint name='j' type='continuous'>"
          "<parent link='base'/><child link='tip'/></joint></robot>");
    write("robots/arm/arm.srdf",
          "<robot name='arm'><disable_collisions link1='tip' link2='world' reason='high up'/></robot>");
  }
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_.path() / name).parent_path());
    std::ofstream(folder_.path() / name) << text;
  }
  fs::path path(const std::string& name) const { return folder_.path() / name; }
  SceneFile read(const std::string& text, const ReadOptions& options = {}) const {
    write("scenes/main.ors", text);
    return readOrs(path("scenes/main.ors"), options);
  }
  TemporaryFolder folder_;
};

constexpr const char* kTwice =
    "body table { X=<T t(0 0 1)> type=ST_box size=[2 2 .1] }\n"
    "urdf left { file='../robots/tricky/tricky.urdf' prefix=left_ pose=<T t(0 .5 0) d(90 0 0 1)> }\n"
    "urdf right (table) { file='../robots/tricky/tricky.urdf' prefix=\"right_\" X=<T t(1 2 3) d(45 1 0 0)> "
    "}\n";

// A swing that a pin holds, a ball that only its pair may touch, and a key.
constexpr const char* kSwing =
    "<mujoco><worldbody><geom name='post' type='sphere' size='.1'/>"
    "<body name='rod' pos='0 0 1'><joint name='turn' axis='0 1 0'/>"
    "<geom name='ball' size='.2' contype='0' conaffinity='0' pos='.3 0 0'/></body>"
    "<body name='loose' pos='0 2 0'><freejoint name='loose'/><geom size='.1'/></body></worldbody>"
    "<contact><pair geom1='post' geom2='ball'/></contact>"
    "<equality><connect body1='rod' anchor='0 0 .5'/></equality>"
    "<keyframe><key name='up' qpos='.7 0 0 3 1 0 0 0'/></keyframe></mujoco>";

TEST_F(OrsRobot, OfMujocoStandsTwice) {
  write("robots/swing.xml", kSwing);
  const SceneFile scene = read(
      "body table { X=<T t(0 0 1)> }\n"
      "mjcf { file='../robots/swing.xml' prefix=l_ X=<T t(0 .5 0)> }\n"
      "mjcf (table) { file='../robots/swing.xml' prefix=r_ X=<T t(0 0 3)> }\n");
  ASSERT_EQ(scene.notes.size(), 1u) << "of the file, once";
  EXPECT_THAT(scene.notes[0].message, HasSubstr("'rod'"));
  const Model model = compile(scene.spec);
  const BodyPoses poses = forwardKinematics(model, model.initialPositions());
  EXPECT_LT((poses[model.body("l_rod")].p - Eigen::Vector3d(0, .5, 1)).norm(), 1e-15);
  EXPECT_LT((poses[model.body("r_rod")].p - Eigen::Vector3d(0, 0, 5)).norm(), 1e-15);
  EXPECT_LT((poses[model.body("l_loose")].p - Eigen::Vector3d(0, 2.5, 0)).norm(), 1e-15);
  EXPECT_LT((poses[model.body("r_loose")].p - Eigen::Vector3d(0, 2, 4)).norm(), 1e-15);

  ASSERT_EQ(model.pins().size(), 2u);
  const Pin &left = model.pins()[0], &right = model.pins()[1];
  EXPECT_EQ(left.a, model.body("l_rod"));
  EXPECT_EQ(left.b, kWorld);
  EXPECT_LT((left.p_BQ - Eigen::Vector3d(0, .5, 1.5)).norm(), 1e-15);
  EXPECT_EQ(right.b, model.body("table"));
  EXPECT_LT((right.p_BQ - Eigen::Vector3d(0, 0, 4.5)).norm(), 1e-15);

  const auto maskOf = [&](const std::string& name) {
    return std::ranges::find(model.shapes(), name, &ModelShape::name)->mask;
  };
  EXPECT_TRUE(mayTouch(maskOf("l_post"), maskOf("l_ball")));
  EXPECT_TRUE(mayTouch(maskOf("r_post"), maskOf("r_ball")));
  EXPECT_FALSE(mayTouch(maskOf("l_post"), maskOf("r_ball"))) << "a pair of another robot";

  const Eigen::VectorXd up = model.posture("key:r_up");
  const auto turn = std::ranges::find(model.joints(), "r_turn", &Joint::name);
  EXPECT_EQ(up[turn->qIndex], .7);
  EXPECT_LT((forwardKinematics(model, up)[model.body("r_loose")].p - Eigen::Vector3d(0, 0, 7)).norm(), 1e-15);
}

TEST_F(OrsRobot, OfMujocoNeedsItsEnding) {
  EXPECT_REX_ERROR(read("mjcf { file='../robots/arm/arm.urdf' }"),
                   "mjcf: file: found '../robots/arm/arm.urdf', wanted a .xml file");
  EXPECT_REX_ERROR(read("mjcf {}"), "mjcf: attribute 'file' is missing: wanted file='ROBOT.xml'");
}

// Each of the two stands where the robot by itself does, seen from the place of its root.
TEST_F(OrsRobot, StandsTwice) {
  const SceneFile scene = read(kTwice);
  EXPECT_THAT(scene.notes, IsEmpty());
  const Model one = compile(readUrdf(path("robots/tricky/tricky.urdf")).spec), two = compile(scene.spec);
  ASSERT_EQ(two.nq(), 2 * one.nq());
  EXPECT_NEAR(two.mass(), 2 * one.mass(), 1e-12);
  const Pose X_WL = translation(0, .5, 0) * rotation(std::numbers::pi / 2, Eigen::Vector3d::UnitZ());
  const Pose X_WR = translation(1, 2, 4) * rotation(std::numbers::pi / 4, Eigen::Vector3d::UnitX());
  Rng rng(31);
  for (int i = 0; i < 10; ++i) {
    const Eigen::VectorXd qLeft = rng.normalVector(one.nq()), qRight = rng.normalVector(one.nq());
    Eigen::VectorXd q(two.nq());
    for (const Joint& joint : one.joints())
      for (const auto& [prefix, own] : {std::pair{"left_", &qLeft}, std::pair{"right_", &qRight}})
        for (const Joint& other : two.joints())
          if (joint.nq > 0 && other.name == prefix + joint.name)
            q.segment(other.qIndex, other.nq) = own->segment(joint.qIndex, joint.nq);
    const BodyPoses poses = forwardKinematics(two, q);
    for (const Body& body : std::span(one.bodies()).subspan(1)) {
      const BodyId id = one.body(body.name);
      EXPECT_TRUE(
          isApprox(poses[two.body("left_" + body.name)], X_WL * forwardKinematics(one, qLeft)[id], 1e-12));
      EXPECT_TRUE(
          isApprox(poses[two.body("right_" + body.name)], X_WR * forwardKinematics(one, qRight)[id], 1e-12));
    }
  }
}

// Names of its bodies are names of the scene, before it and behind.
TEST_F(OrsRobot, IsPartOfTheScene) {
  const SceneFile scene = read(
      "urdf a { file='../robots/arm/arm.urdf' prefix=a_ }\n"
      "body tool { mass=1 }\njoint grip (a_tip tool) { type=rigid }\nshape (-3) { type=ST_sphere size=[0 0 0 "
      "1] }\n"
      "joint follow (world a_base) { type=transX mimic=a_j }\n");
  EXPECT_EQ(scene.spec.joints.at(1).parent, "a_tip");
  EXPECT_EQ(scene.spec.bodies.at(0).shapes.size(), 1u) << "counting back leads to its root";
  const Model model = compile(scene.spec);
  EXPECT_EQ(model.nv(), 1);
}

TEST_F(OrsRobot, BringsItsMeshesAndWhoMayCollide) {
  const SceneFile scene = read(
      "urdf a { file='../robots/arm/arm.urdf' prefix=a_ }\nbody b {}\n"
      "urdf (b) { file='../robots/arm/arm.urdf' prefix=b_ }\n");
  ASSERT_EQ(scene.spec.bodies.size(), 5u);
  const ShapeSpec &first = scene.spec.bodies[1].shapes.at(0), &second = scene.spec.bodies[4].shapes.at(0);
  EXPECT_EQ(first.name, "a_tip");
  EXPECT_EQ(first.meshFile, "../robots/arm/meshes/tip.off");
  EXPECT_EQ(first.shape.mesh, second.shape.mesh) << "the file is read once";
  EXPECT_EQ(first.shape.hull, second.shape.hull);
  EXPECT_EQ(first.shape.hull.positions().size(), 4u);
  ASSERT_EQ(scene.spec.collisionChoices.size(), 2u);
  EXPECT_EQ(scene.spec.collisionChoices[0].a, "a_tip");
  EXPECT_EQ(scene.spec.collisionChoices[0].b, "world");
  EXPECT_EQ(scene.spec.collisionChoices[1].b, "b") << "what was its world";
  EXPECT_EQ(scene.spec.collisionRule, CollisionRule::kAllButNeighbours);
  EXPECT_EQ(
      read("collisions { rule=four_generations }\nurdf { file='../robots/arm/arm.urdf' }").spec.collisionRule,
      CollisionRule::kFourGenerations);
}

// Written, it is bodies and joints with the meshes beside the scene.
TEST_F(OrsRobot, IsWrittenAsBodies) {
  const SceneFile scene = read(kTwice + std::string("urdf arm { file='../robots/arm/arm.urdf' }"));
  for (const fs::path& folder : {fs::path(), path("scenes")}) {
    const std::string text = writeOrs(scene.spec, folder);
    EXPECT_THAT(text, HasSubstr("mesh='../robots/arm/meshes/tip.off'"));
    const Model model = compile(scene.spec), again = compile(read(text).spec);
    ASSERT_EQ(again.nq(), model.nq());
    Rng rng(32);
    const Eigen::VectorXd q = rng.normalVector(model.nq());
    const BodyPoses poses = forwardKinematics(model, q), places = forwardKinematics(again, q);
    for (const Body& body : model.bodies())
      EXPECT_TRUE(isApprox(poses[model.body(body.name)], places[again.body(body.name)], 1e-12)) << body.name;
    EXPECT_EQ(again.collisionRule(), model.collisionRule());
    EXPECT_EQ(again.collisionChoices().size(), model.collisionChoices().size());
  }
}

TEST_F(OrsRobot, MayHaveTheWorldAsItsRoot) {
  write("robots/hall.urdf",
        "<robot name='h'><link name='world'><visual><geometry><box size='1 1 1'/></geometry></visual></link>"
        "<link name='door'/><joint name='hinge' type='continuous'><origin xyz='1 0 0'/><parent link='world'/>"
        "<child link='door'/></joint></robot>");
  const SceneSpec placed = read("urdf { file='../robots/hall.urdf' prefix=x_ X=<T t(0 0 2)> }").spec;
  EXPECT_EQ(placed.worldShapes.at(0).X_BS.p, Eigen::Vector3d(0, 0, 2));
  EXPECT_EQ(placed.joints.at(0).parent, "world");
  EXPECT_EQ(placed.joints.at(0).X_PF.p, Eigen::Vector3d(1, 0, 2));
  const SceneSpec carried = read("body cart {}\nurdf (cart) { file='../robots/hall.urdf' }").spec;
  EXPECT_EQ(carried.bodies.at(0).shapes.size(), 1u);
  EXPECT_EQ(carried.joints.at(0).parent, "cart");
}

TEST_F(OrsRobot, SaysWhatIsWrong) {
  const std::string arm = "urdf a { file='../robots/arm/arm.urdf' }";
  EXPECT_REX_ERROR(read(arm + "\n" + arm),
                   "main.ors:2:1: urdf 'a': a second body 'base': wanted another prefix: the first is at ");
  EXPECT_REX_ERROR(
      read("body x {}\nbody y {}\njoint b_j (x y) {}\nurdf a { file='../robots/arm/arm.urdf' prefix=b_ }"),
      "main.ors:4:1: urdf 'a': a second joint 'b_j': wanted another prefix: the first is at ");
  EXPECT_REX_ERROR(read("urdf a { prefix=x }"),
                   "main.ors:1:1: urdf 'a': attribute 'file' is missing: wanted file='ROBOT.urdf'");
  EXPECT_REX_ERROR(read("urdf a { file='arm.ors' }"),
                   "main.ors:1:15: urdf 'a': file: found 'arm.ors', wanted a .urdf file");
  EXPECT_REX_ERROR(read("urdf a { file='../robots/arm/amr.urdf' }"), "urdf 'a': file: found no file");
  EXPECT_REX_ERROR(read("urdf a { file='../../arm.urdf' }"), "wanted a file inside the asset root");
  EXPECT_REX_ERROR(read("urdf a { file=\"arm.urdf\" }"),
                   "urdf 'a': attribute 'file': found 'arm.urdf', wanted");
  EXPECT_REX_ERROR(read("body x {}\nbody y {}\nurdf a (x y) {}"),
                   "main.ors:3:11: urdf 'a': found 2 parents, wanted one body, or none");
  EXPECT_REX_ERROR(read("urdf a (x) { file='../robots/arm/arm.urdf' }"),
                   "urdf 'a': unknown parent: found 'x'");
  EXPECT_REX_ERROR(parseOrs("urdf a { file='arm.urdf' }", "f"),
                   "f:1:15: urdf 'a': file: found a scene that was given as text, wanted no robots from "
                   "other files: only scenes in files can have them");
  std::string many;
  for (int i = 0; i < 65; ++i)
    many += "urdf { file='../robots/arm/arm.urdf' prefix=p" + std::to_string(i) + "_ }\n";
  EXPECT_REX_ERROR(read(many),
                   "main.ors:65:1: too many robots: wanted at most 64 statements 'urdf' or 'mjcf'");
  std::string chain = "<robot name='c'><link name='0'/>";
  for (int i = 1; i <= 600; ++i)
    chain += "<link name='" + std::to_string(i) + "'/><joint name='" + std::to_string(i) +
             "' type='fixed'><parent link='" + std::to_string(i - 1) + "'/><child link='" +
             std::to_string(i) + "'/></joint>";
  write("robots/chain.urdf", chain + "</robot>");
  EXPECT_REX_ERROR(
      read("urdf { file='../robots/chain.urdf' }\nurdf { file='../robots/chain.urdf' prefix=x }"),
      "main.ors:2:1: too many joints: wanted at most 1000");
  EXPECT_REX_ERROR(read("urdf a { file='../robots/arm/arm.urdf' pose=3 }"), "urdf 'a': attribute 'pose'");
}

TEST_F(OrsRobot, PassesNotesOn) {
  write("robots/odd.urdf", "<robot name='o'><link name='a'/><gazebo/></robot>");
  const Diagnostics notes = read("urdf a { file='../robots/odd.urdf' prefx=x }").notes;
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_THAT(toString(notes[0]), HasSubstr("did you mean 'prefix'?"));
  EXPECT_THAT(toString(notes[1]), HasSubstr("odd.urdf:1:33: note: <gazebo> is ignored"));
}

}  // namespace rex::ors_robot_test
