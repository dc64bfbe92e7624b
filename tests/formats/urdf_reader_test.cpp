#include "formats/urdf_reader.h"

#include <fstream>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "geometry/rotation.h"
#include "kinematics/forward_kinematics.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/paths.h"
#include "support/temporary_folder.h"
#include "support/urdf_samples.h"

namespace rex::urdf_reader_test {

using std::numbers::pi;

SceneFile parse(const std::string& inside, const ReadOptions& options = {}) {
  return parseUrdf("<robot name='r'>" + inside + "</robot>", "f", options);
}

JointSpec joint(const std::string& type, const std::string& inside) {
  const SceneFile file = parse("<link name='a'/><link name='b'/><joint name='j' type='" + type +
                               "'><parent link='a'/><child link='b'/>" + inside + "</joint>");
  EXPECT_TRUE(file.notes.empty());
  static_cast<void>(compile(file.spec));
  return file.spec.joints.at(0);
}

ShapeSpec visual(const std::string& geometry, const std::string& more = "") {
  return parse("<link name='a'><visual><geometry>" + geometry + "</geometry>" + more + "</visual></link>")
      .spec.bodies.at(0)
      .shapes.at(0);
}

TEST(UrdfReader, ReadsInertias) {
  const BodySpec body = parse(
                            "<link name='a'><inertial><origin xyz='1 2 3' rpy='0 0 1.5707963267948966'/>"
                            "<mass value='+2.5e0'/><inertia ixx='1' iyy='2' izz='3' ixy='.1' ixz='.2' "
                            "iyz='.3'/></inertial></link>")
                            .spec.bodies.at(0);
  EXPECT_EQ(body.name, "a");
  EXPECT_EQ(body.mass, 2.5);
  EXPECT_EQ(body.p_BBcm, Eigen::Vector3d(1, 2, 3));
  const Eigen::Matrix3d turned =  // x becomes y, y becomes -x
      (Eigen::Matrix3d() << 2, -.1, -.3, -.1, 1, .2, -.3, .2, 3).finished();
  EXPECT_LT((*body.inertia - turned).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(parse("<link name='a'/>").spec.bodies.at(0).mass, 0);
}

TEST(UrdfReader, ReadsShapes) {
  const ShapeSpec box = visual("<box size='1 2 3'/>", "<origin xyz='1 0 0' rpy='.1 .2 .3'/>");
  EXPECT_EQ(box.shape.type, ShapeType::kBox);
  EXPECT_EQ(box.shape.extent, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(box.X_BS.p, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(box.X_BS.R, rotationFromRollPitchYaw({.1, .2, .3}));
  EXPECT_EQ(box.name, "a");
  EXPECT_TRUE(box.visible);
  EXPECT_FALSE(box.contact);
  const ShapeSpec cylinder = visual("<cylinder radius='.1' length='2'/>");
  EXPECT_EQ(cylinder.shape.type, ShapeType::kCylinder);
  EXPECT_EQ(cylinder.shape.radius, .1);
  EXPECT_EQ(cylinder.shape.extent.z(), 2);
  EXPECT_EQ(visual("<capsule radius='.1' length='2'/>").shape.type, ShapeType::kCapsule);
  EXPECT_EQ(visual("<sphere radius='.1'/>").shape.radius, .1);
  const ShapeSpec mesh = visual("<mesh filename='package://p/a.stl' scale='1 -1 2'/>");
  EXPECT_EQ(mesh.shape.type, ShapeType::kMesh);
  EXPECT_EQ(mesh.meshFile, "package://p/a.stl");
  EXPECT_EQ(mesh.meshScale, Eigen::Vector3d(1, -1, 2));
}

TEST(UrdfReader, TellsCollisionShapesFromVisibleOnes) {
  const auto shapes = parse(
                          "<link name='a'><collision name='c'><geometry><sphere radius='1'/></geometry>"
                          "</collision><visual><geometry><sphere radius='2'/></geometry></visual></link>")
                          .spec.bodies.at(0)
                          .shapes;
  ASSERT_EQ(shapes.size(), 2u);
  EXPECT_EQ(shapes[0].name, "c");
  EXPECT_TRUE(shapes[0].contact && !shapes[0].visible);
  EXPECT_TRUE(!shapes[1].contact && shapes[1].visible);
}

// The side of the box to which the normal points lies in the plane.
TEST(UrdfReader, MakesBoxesOfPlanes) {
  const auto shapeOf = [](const std::string& tag) {
    return parse("<link name='a'><collision><origin xyz='1 2 3' rpy='0 0 1.5707963267948966'/><geometry>" +
                 tag + "</geometry></collision></link>")
        .spec.bodies.at(0)
        .shapes.at(0);
  };
  for (const auto& [tag, normal] : {std::pair{"<plane/>", Eigen::Vector3d(0, 0, 1)},
                                    {"<plane normal='0 0 2'/>", Eigen::Vector3d(0, 0, 1)},
                                    {"<plane normal='3 4 0'/>", Eigen::Vector3d(-.8, .6, 0)},
                                    {"<plane normal='0 0 -1'/>", Eigen::Vector3d(0, 0, -1)}}) {
    const ShapeSpec shape = shapeOf(tag);
    EXPECT_EQ(shape.shape.type, ShapeType::kBox);
    EXPECT_EQ(shape.shape.extent, Eigen::Vector3d(100, 100, 1));
    EXPECT_TRUE(shape.contact && !shape.visible);
    EXPECT_LT((shape.X_BS * Eigen::Vector3d(0, 0, .5) - Eigen::Vector3d(1, 2, 3)).norm(), 1e-12) << tag;
    EXPECT_LT((shape.X_BS.R.col(2) - normal).norm(), 1e-12) << tag;
  }
}

TEST(UrdfReader, FindsColoursByNameBeforeAndAfter) {
  const auto shape = [](const std::string& material) {
    return "<visual><geometry><sphere radius='1'/></geometry><material " + material + "</material></visual>";
  };
  const SceneFile file =
      parse("<link name='a'>" + shape("name='red'>") + shape("name='blue'>") +
            shape("name='blue'><color rgba='0 0 1 .5'/>") + shape("name='red'><color rgba='.9 0 0 1'/>") +
            shape("name=''><color rgba='0 1 0 1'/>") +
            "</link><material name='red'><color rgba='1 0 0 1'/></material>");
  const std::vector<ShapeSpec>& shapes = file.spec.bodies.at(0).shapes;
  EXPECT_EQ(shapes.at(0).color, Eigen::Vector4d(1, 0, 0, 1));
  EXPECT_EQ(shapes.at(1).color, Eigen::Vector4d(0, 0, 1, .5));
  EXPECT_EQ(shapes.at(3).color, Eigen::Vector4d(.9, 0, 0, 1));
  EXPECT_EQ(shapes.at(4).color, Eigen::Vector4d(0, 1, 0, 1));
  EXPECT_TRUE(file.notes.empty());
}

TEST(UrdfReader, ReadsJoints) {
  const std::string limit = "<limit lower='-1' upper='2' velocity='3' effort='4'/>";
  const JointSpec hinge = joint("revolute", limit +
                                                "<origin xyz='1 2 3' rpy='0 0 1'/><axis xyz='0 0 2'/>"
                                                "<dynamics damping='.1' friction='.2'/>");
  EXPECT_EQ(hinge.type, JointType::kHinge);
  EXPECT_EQ(hinge.parent, "a");
  EXPECT_EQ(hinge.child, "b");
  EXPECT_EQ(hinge.X_PF.p, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(hinge.X_PF.R, rotationFromRollPitchYaw({0, 0, 1}));
  EXPECT_TRUE(isApprox(hinge.X_MC, Pose{}, 0));
  EXPECT_EQ(hinge.axis, Eigen::Vector3d(0, 0, 2));
  EXPECT_EQ(hinge.lower[0], -1);
  EXPECT_EQ(hinge.upper[0], 2);
  EXPECT_EQ(hinge.maxVelocity, 3);
  EXPECT_EQ(hinge.maxEffort, 4);
  EXPECT_EQ(hinge.damping, .1);
  EXPECT_EQ(hinge.friction, .2);
  EXPECT_EQ(joint("prismatic", limit).type, JointType::kSlider);
  EXPECT_EQ(joint("prismatic", limit).axis, Eigen::Vector3d::UnitX());
  EXPECT_EQ(joint("continuous", "").type, JointType::kHinge);
  EXPECT_EQ(joint("continuous", "").lower.size(), 0);
  EXPECT_EQ(joint("fixed", "<axis xyz='0 0 0'/><limit/>").type, JointType::kRigid);
  EXPECT_EQ(joint("floating", "").type, JointType::kFree);
}

TEST(UrdfReader, MovesPlanarJointsAcrossTheirAxis) {
  const SceneSpec spec =
      parse(
          "<link name='a'/><link name='b'/><joint name='j' type='planar'><parent link='a'/>"
          "<child link='b'/><origin xyz='1 2 3'/><axis xyz='0 1 0'/></joint>")
          .spec;
  const Model model = compile(spec);
  ASSERT_EQ(model.nq(), 3);
  const auto pose = [&](double x, double y, double phi) {
    return forwardKinematics(model, Eigen::Vector3d(x, y, phi))[model.body("b")];
  };
  EXPECT_TRUE(isApprox(pose(0, 0, 0), translation(1, 2, 3), 1e-15));
  EXPECT_TRUE(isApprox(pose(0, 0, .5), translation(1, 2, 3) * rotation(.5, {0, 1, 0}), 1e-15));
  const Eigen::Vector3d x = pose(1, 0, 0).p - pose(0, 0, 0).p, y = pose(0, 1, 0).p - pose(0, 0, 0).p;
  EXPECT_NEAR(x.y(), 0, 1e-15);
  EXPECT_NEAR(x.norm(), 1, 1e-15);
  EXPECT_LT((x.cross(y) - Eigen::Vector3d::UnitY()).norm(), 1e-15);
}

const std::string kThree =
    "<link name='a'/><link name='b'/><link name='c'/><joint name='k' type='prismatic'><parent link='b'/>"
    "<child link='c'/><limit lower='0' upper='1' velocity='1' effort='1'/>"
    "<mimic joint='j' multiplier='2' offset='.5'/></joint>"
    "<joint name='j' type='continuous'><parent link='a'/><child link='b'/></joint>";

TEST(UrdfReader, LetsJointsMimic) {
  const Model model = compile(parse(kThree).spec);
  ASSERT_EQ(model.nq(), 1);
  const Pose c = forwardKinematics(model, Eigen::VectorXd::Constant(1, .25))[model.body("c")];
  EXPECT_LT((c.p - Eigen::Vector3d(1, 0, 0)).norm(), 1e-15);
  EXPECT_EQ(model.lowerLimits()[0], -0.25);
  EXPECT_EQ(model.upperLimits()[0], 0.25);
}

TEST(UrdfReader, TakesNoRangeFromAJointThatMimicsWithoutOne) {
  std::string text = kThree;
  text.replace(text.find("lower='0' upper='1'"), 19, "");
  EXPECT_EQ(parse(text).spec.joints[0].upper.size(), 0);
  EXPECT_EQ(compile(parse(text).spec).upperLimits()[0], HUGE_VAL);
}

TEST(UrdfReader, FixesOrFreesTheRoot) {
  EXPECT_EQ(compile(parse(kThree).spec).nq(), 1);
  const SceneSpec free = parse(kThree, {.freeBase = true}).spec;
  ASSERT_EQ(free.joints.size(), 3u);
  EXPECT_EQ(free.joints[0].name, "world>a");
  EXPECT_EQ(free.joints[0].type, JointType::kFree);
  const Model model = compile(free);
  EXPECT_EQ(model.nq(), 8);
  EXPECT_EQ(model[model.joints()[0].child].name, "a");
  EXPECT_EQ(model.joints()[0].qIndex, 0);
}

TEST(UrdfReader, TakesARootCalledWorldForTheWorld) {
  const SceneFile file = parse(
      "<link name='world'><visual><geometry><box size='1 1 1'/></geometry></visual></link><link name='a'/>"
      "<joint name='j' type='floating'><parent link='world'/><child link='a'/></joint>");
  EXPECT_TRUE(file.notes.empty());
  EXPECT_EQ(file.spec.worldShapes.size(), 1u);
  ASSERT_EQ(file.spec.bodies.size(), 1u);
  const Model model = compile(file.spec);
  EXPECT_EQ(model.nq(), 7);
  EXPECT_EQ(model[model.body("a")].parent, kWorld);
}

TEST(UrdfReader, ReadsLatin1) {
  const std::string text =
      "<?xml version='1.0' encoding='ISO-8859-1'?><robot name='r'><link name='Kn\xf6"
      "chel'/></robot>";
  EXPECT_EQ(parseUrdf(text, "f").spec.bodies.at(0).name,
            "Kn\xc3\xb6"
            "chel");
}

TEST(UrdfReader, LoadsAChainOfAThousandJoints) {
  std::string text = "<link name='l0'/>";
  for (int i = 1; i <= 1000; ++i) {
    const std::string n = std::to_string(i);
    text += "<link name='l" + n + "'/><joint name='j" + n + "' type='continuous'><parent link='l" +
            std::to_string(i - 1) + "'/><child link='l" + n +
            "'/><origin xyz='.1 0 0'/><axis xyz='0 0 1'/></joint>";
  }
  const Model model = compile(parse(text).spec);
  EXPECT_EQ(model.nq(), 1000);
  const BodyPoses poses = forwardKinematics(model, Eigen::VectorXd::Zero(1000));
  EXPECT_NEAR(poses[model.body("l1000")].p.x(), 100, 1e-9);
}

TEST(UrdfReader, ReadsFilesByTheirEnding) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "r.urdf";
  std::ofstream(file) << "<robot name='r'><link name='a'/></robot>";
  EXPECT_EQ(readScene(file).spec.bodies.at(0).name, "a");
  EXPECT_EQ(readScene(file, {.freeBase = true}).spec.joints.size(), 1u);
  EXPECT_EQ(parseScene("<robot name='r'><link name='a'/></robot>", "r.urdf").spec.bodies.at(0).name, "a");
  std::ofstream(file) << "<robot name='r'>\n<link name='a'><visual><geometry><mesh filename='none.stl'/>"
                         "</geometry></visual></link></robot>";
  EXPECT_REX_ERROR(readUrdf(file), "r.urdf:2:50: shape 'a': mesh: found no file 'none.stl'");
  std::ofstream(file) << std::string((8u << 20) + 1, ' ');
  EXPECT_REX_ERROR(readUrdf(file), "scene file too large: found 8388609 bytes, wanted at most 8 MiB");
}

TEST(UrdfReader, ReadsAllFiles) {
  const auto files = urdfFiles();
  if (files.empty()) GTEST_SKIP() << "no .urdf file in data/ and ../shared/data/urdf";
  for (const std::filesystem::path& file : files)
    EXPECT_NO_THROW((void)compile(parseUrdf(fileText(file), file.filename()).spec)) << file;
}

}  // namespace rex::urdf_reader_test
