#include "formats/mjcf_reader.h"

#include <fstream>
#include <numbers>
#include <tuple>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "formats/ors_writer.h"
#include "geometry/rotation.h"
#include "kinematics/forward_kinematics.h"
#include "scene/model.h"
#include "scene/scene_edit.h"
#include "support/block_surface.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::mjcf_reader_test {

using std::numbers::pi;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

SceneFile parse(const std::string& inside, const ReadOptions& options = {}) {
  return parseMjcf("<mujoco>" + inside + "</mujoco>", "m.xml", options);
}
SceneFile world(const std::string& inside, const std::string& before = "") {
  return parse(before + "<worldbody>" + inside + "</worldbody>");
}
BodySpec body(const std::string& inside, const std::string& before = "") {
  return world("<body name='a'>" + inside + "</body>", before).spec.bodies.back();
}
Pose placed(const std::string& attributes, const std::string& before = "") {
  return world("<body name='a' " + attributes + "/>", before).spec.bodies.at(0).X_WB;
}
std::vector<std::string> notesOf(const SceneFile& scene) {
  std::vector<std::string> notes;
  for (const Diagnostic& one : scene.notes) notes.push_back(toString(one));
  return notes;
}

constexpr const char* kRadian = "<compiler angle='radian'/>";

TEST(MjcfReader, TurnsBodiesInAllWays) {
  EXPECT_TRUE(isApprox(placed("pos='1 2 3' quat='2 0 0 2'"),
                       translation(1, 2, 3) * rotation(pi / 2, Eigen::Vector3d::UnitZ()), 1e-15));
  EXPECT_TRUE(isApprox(placed("axisangle='0 0 2 90'"), rotation(pi / 2, Eigen::Vector3d::UnitZ()), 1e-15));
  EXPECT_TRUE(
      isApprox(placed("axisangle='0 1 0 .5'", kRadian), rotation(.5, Eigen::Vector3d::UnitY()), 1e-15));
  EXPECT_LT((placed("xyaxes='0 2 0 -3 1 0'").R - rotation(pi / 2, Eigen::Vector3d::UnitZ()).R).norm(), 1e-15);
  const Eigen::Matrix3d R = placed("zaxis='1 1 1'").R;
  EXPECT_LT((R.col(2) - Eigen::Vector3d(1, 1, 1).normalized()).norm(), 1e-15);
  EXPECT_TRUE(placed("zaxis='0 0 -2'").R.isApprox(rotation(pi, Eigen::Vector3d::UnitX()).R, 1e-15));
}

// Letters say about which axes, their case whether these turn along.
TEST(MjcfReader, TurnsByEulerAngles) {
  const auto turn = [](double angle, int axis) {
    return Eigen::Matrix3d(Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis)));
  };
  const Eigen::Matrix3d along = turn(.1, 0) * turn(.2, 1) * turn(.3, 2);
  EXPECT_LT((placed("euler='.1 .2 .3'", kRadian).R - along).norm(), 1e-15);
  const Eigen::Matrix3d fixed = turn(.3, 2) * turn(.2, 1) * turn(.1, 0);
  EXPECT_LT((placed("euler='.1 .2 .3'", "<compiler angle='radian' eulerseq='XYZ'/>").R - fixed).norm(),
            1e-15);
  const Eigen::Matrix3d mixed = turn(.2, 1) * turn(.1, 2) * turn(.3, 0);
  EXPECT_LT((placed("euler='.1 .2 .3'", "<compiler angle='radian' eulerseq='zYx'/>").R - mixed).norm(),
            1e-15);
}

TEST(MjcfReader, ReadsShapes) {
  const BodySpec a = body(
      "<geom size='.1'/><geom type='box' size='1 2 3' name='crate' rgba='1 0 0 .5'/>"
      "<geom type='capsule' size='.1 .2' pos='1 0 0'/><geom type='cylinder' size='.1 .2'/>"
      "<geom type='capsule' size='.1' fromto='0 0 0 2 0 0'/><geom type='box' size='.1' fromto='0 0 1 0 0 "
      "3'/>");
  ASSERT_EQ(a.shapes.size(), 6u);
  EXPECT_EQ(a.shapes[0].shape.type, ShapeType::kSphere);
  EXPECT_EQ(a.shapes[0].shape.radius, .1);
  EXPECT_EQ(a.shapes[0].name, "a");
  EXPECT_EQ(a.shapes[0].color, Eigen::Vector4d(.5, .5, .5, 1));
  EXPECT_EQ(a.shapes[1].name, "crate");
  EXPECT_EQ(a.shapes[1].shape.extent, Eigen::Vector3d(2, 4, 6));
  EXPECT_EQ(a.shapes[1].color, Eigen::Vector4d(1, 0, 0, .5));
  EXPECT_EQ(a.shapes[2].shape.extent.z(), .4);
  EXPECT_EQ(a.shapes[2].X_BS.p, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(a.shapes[3].shape.type, ShapeType::kCylinder);
  EXPECT_EQ(a.shapes[4].shape.extent.z(), 2);
  EXPECT_EQ(a.shapes[4].X_BS.p, Eigen::Vector3d(1, 0, 0));
  EXPECT_NEAR(std::abs(a.shapes[4].X_BS.R(0, 2)), 1, 1e-15);
  EXPECT_LT((a.shapes[5].shape.extent - Eigen::Vector3d(.2, .2, 2)).norm(), 1e-15);
}

TEST(MjcfReader, KnowsWhatIsDrawnAndTouched) {
  const BodySpec a = body(
      "<geom size='1'/><geom size='1' contype='0' conaffinity='0'/><geom size='1' group='3'/>"
      "<geom size='1' rgba='1 1 1 0'/>");
  const auto flags = [&](std::size_t i) { return std::pair(a.shapes[i].visible, a.shapes[i].contact); };
  EXPECT_EQ(flags(0), std::pair(true, true));
  EXPECT_EQ(flags(1), std::pair(true, false));
  EXPECT_EQ(flags(2), std::pair(false, true));
  EXPECT_EQ(flags(3), std::pair(false, true));
}

TEST(MjcfReader, PaintsByMaterials) {
  const std::string assets = "<asset><material name='red' rgba='1 0 0 1'/><material name='plain'/></asset>";
  const BodySpec a = body(
      "<geom size='1' material='red'/><geom size='1' material='plain'/>"
      "<geom size='1' material='red' rgba='0 1 0 1'/><geom size='1' material='red' rgba='.5 .5 .5 1'/>",
      assets);
  EXPECT_EQ(a.shapes[0].color, Eigen::Vector4d(1, 0, 0, 1));
  EXPECT_EQ(a.shapes[1].color, Eigen::Vector4d(1, 1, 1, 1));
  EXPECT_EQ(a.shapes[2].color, Eigen::Vector4d(0, 1, 0, 1));
  EXPECT_EQ(a.shapes[3].color, Eigen::Vector4d(1, 0, 0, 1)) << "what geoms have anyway says nothing";
}

TEST(MjcfReader, MakesPlanesOfBoxes) {
  const SceneFile scene =
      world("<geom type='plane' size='2 3 .1'/><geom type='plane' zaxis='1 0 0' size='0 0 1'/>");
  const ShapeSpec &ground = scene.spec.worldShapes.at(0), &wall = scene.spec.worldShapes.at(1);
  EXPECT_EQ(ground.shape.extent, Eigen::Vector3d(4, 6, 1));
  EXPECT_EQ(ground.X_BS.p, Eigen::Vector3d(0, 0, -.5)) << "its upper side is the plane";
  EXPECT_FALSE(ground.visible);
  EXPECT_TRUE(ground.contact);
  EXPECT_EQ(wall.shape.extent, Eigen::Vector3d(100, 100, 1));
  EXPECT_LT((wall.X_BS.p - Eigen::Vector3d(-.5, 0, 0)).norm(), 1e-15);
  EXPECT_TRUE(wall.visible);
  EXPECT_THAT(notesOf(scene), ElementsAre("m.xml:1:20: note: a plane becomes a box 1 m thick, as wide as its "
                                          "size says or 100 m; the ground is not drawn (2 times)"));
}

// Joints turn about their anchors one after the other, over bodies without mass.
TEST(MjcfReader, HangsSeveralJointsOnOneBody) {
  const SceneFile scene = world(
      "<body name='base' pos='0 0 1'><body name='arm' pos='1 0 0'>"
      "<joint name='turn' axis='0 0 1' pos='-.5 0 0' range='-90 45'/>"
      "<joint name='slide' type='slide' axis='0 2 0' range='-1 2'/></body></body>");
  EXPECT_THAT(scene.notes, IsEmpty());
  ASSERT_EQ(scene.spec.bodies.size(), 3u);
  EXPECT_EQ(scene.spec.bodies[1].name, "arm_turn");
  const Model model = compile(scene.spec);
  const Pose X_WA = forwardKinematics(model, Eigen::Vector2d(pi / 2, .5))[model.body("arm")];
  EXPECT_LT((X_WA.p - Eigen::Vector3d(0, .5, 1)).norm(), 1e-15)
      << "the arm swings round (0.5, 0) to (0.5, 0.5), then slides along what is -x by then";
  EXPECT_NEAR(model.lowerLimits()[0], -pi / 2, 1e-15);
  EXPECT_NEAR(model.upperLimits()[0], pi / 4, 1e-15);
  EXPECT_EQ(model.upperLimits()[1], 2);
}

TEST(MjcfReader, StartsAtTheReference) {
  const SceneFile scene = world(
      "<body name='a' pos='0 0 1'><joint type='slide' axis='0 0 1' ref='1.25'/><joint axis='1 0 0' ref='30'/>"
      "</body>");
  const Model model = compile(scene.spec);
  EXPECT_LT((model.initialPositions() - Eigen::Vector2d(1.25, pi / 6)).norm(), 1e-15);
  EXPECT_TRUE(isApprox(forwardKinematics(model, model.initialPositions())[model.body("a")],
                       translation(0, 0, 1), 1e-15));
  EXPECT_TRUE(isApprox(forwardKinematics(model, Eigen::Vector2d(0, 0))[model.body("a")],
                       translation(0, 0, -.25) * rotation(-pi / 6, Eigen::Vector3d::UnitX()), 1e-15));
}

TEST(MjcfReader, ReadsAllKindsOfJoints) {
  const Model model =
      compile(world("<body name='a' pos='1 2 3' quat='0 1 0 0'><freejoint name='root'/>"
                    "<body name='b'><joint type='ball' pos='0 0 1' damping='2'/></body></body>"
                    "<body name='c'><joint type='free' frictionloss='3'/></body>")
                  .spec);
  EXPECT_EQ(model.nq(), 18);
  EXPECT_EQ(model.initialPositions().head<7>(), (Eigen::VectorXd(7) << 1, 2, 3, 0, 1, 0, 0).finished());
  EXPECT_EQ(model[model[model.body("b")].joint].damping, 2);
  EXPECT_EQ(model[model[model.body("b")].joint].type, JointType::kBall);
  EXPECT_EQ(model[model[model.body("c")].joint].friction, 3);
  EXPECT_EQ(model[model[model.body("c")].joint].name, "world>c");
  Eigen::VectorXd q = model.initialPositions();
  q.tail<4>() << 0, 0, 1, 0;  // half a turn about y
  EXPECT_TRUE(isApprox(forwardKinematics(model, q)[model.body("b")],
                       forwardKinematics(model, q)[model.body("a")] * translation(0, 0, 2) *
                           rotation(pi, Eigen::Vector3d::UnitY()),
                       1e-15));
}

TEST(MjcfReader, NamesWhatHasNoName) {
  const SceneSpec spec =
      world(
          "<body><joint/><joint/><body/></body><body name='body_2'/><body><joint name='body_joint'/></body>")
          .spec;
  std::vector<std::string> bodies, joints;
  for (const BodySpec& one : spec.bodies) bodies.push_back(one.name);
  for (const JointSpec& one : spec.joints) joints.push_back(one.name);
  EXPECT_THAT(bodies, ElementsAre("body_body_joint_2", "body", "body_3", "body_2", "body_4"));
  EXPECT_THAT(joints, ElementsAre("body_joint_2", "body_joint_3", "body>body_3", "body_joint"));
  EXPECT_EQ(compile(spec).nv(), 3);
}

TEST(MjcfReader, TakesDefaultsOfClasses) {
  const std::string defaults =
      "<default><geom rgba='1 0 0 1' size='.1'/><joint damping='1'/>"
      "<default class='leg'><geom size='.2'/><default class='foot'><geom type='box' size='.3 .3 "
      ".3'/></default>"
      "</default></default><default><geom size='.4'/></default>";
  const BodySpec a = body(
      "<joint/><geom/><geom class='leg'/><geom class='foot'/><geom class='foot' size='1 1 1'/>", defaults);
  EXPECT_EQ(a.shapes[0].shape.radius, .4) << "the second section adds to the first";
  EXPECT_EQ(a.shapes[1].shape.radius, .2);
  EXPECT_EQ(a.shapes[2].shape.extent, Eigen::Vector3d(.6, .6, .6));
  EXPECT_EQ(a.shapes[3].shape.extent, Eigen::Vector3d(2, 2, 2));
  for (const ShapeSpec& shape : a.shapes) EXPECT_EQ(shape.color, Eigen::Vector4d(1, 0, 0, 1));
  const SceneSpec spec = world(
                             "<body name='a' childclass='leg'><geom/><body name='b'><joint/><geom/><geom "
                             "class='main'/></body></body>",
                             defaults)
                             .spec;
  EXPECT_EQ(spec.bodies[0].shapes[0].shape.radius, .2);
  EXPECT_EQ(spec.bodies[1].shapes[0].shape.radius, .2);
  EXPECT_EQ(spec.bodies[1].shapes[1].shape.radius, .4);
  EXPECT_EQ(spec.joints[0].damping, 1);
}

// What a later section says does not reach classes that stand before it.
TEST(MjcfReader, KeepsClassesAsTheyWereMade) {
  const BodySpec a = body("<geom class='leg'/>",
                          "<default><geom size='.1'/><default class='leg'/></default>"
                          "<default><geom size='.4'/></default>");
  EXPECT_EQ(a.shapes[0].shape.radius, .1);
}

TEST(MjcfReader, PlacesFrames) {
  const SceneSpec spec =
      world(
          "<frame pos='1 0 0' euler='0 0 90'><body name='a' pos='1 0 0'>"
          "<frame pos='0 0 1'><joint axis='1 0 0'/><geom size='1' pos='0 0 1'/></frame></body>"
          "<geom size='2'/></frame>")
          .spec;
  const Model model = compile(spec);
  const BodyPoses poses = forwardKinematics(model, Eigen::VectorXd::Constant(1, pi));
  EXPECT_LT((spec.worldShapes[0].X_BS.p - Eigen::Vector3d(1, 0, 0)).norm(), 1e-15);
  EXPECT_EQ(spec.bodies[0].shapes[0].X_BS.p, Eigen::Vector3d(0, 0, 2));
  EXPECT_LT((poses[model.body("a")].p - Eigen::Vector3d(1, 1, 2)).norm(), 1e-15)
      << "half a turn about the height of the inner frame";
}

// Against integrals by counting: a fine lattice of points inside.
TEST(MjcfReader, WeighsSolids) {
  struct Row {
    std::string geom;
    bool (*isInside)(const Eigen::Vector3d&);
  };
  const std::vector<Row> rows = {
      {"<geom size='.5'/>", [](const Eigen::Vector3d& p) { return p.norm() <= .5; }},
      {"<geom type='box' size='.2 .3 .4'/>",
       [](const Eigen::Vector3d& p) { return (p.cwiseAbs() - Eigen::Vector3d(.2, .3, .4)).maxCoeff() <= 0; }},
      {"<geom type='cylinder' size='.3 .4'/>",
       [](const Eigen::Vector3d& p) { return p.head<2>().norm() <= .3 && std::abs(p.z()) <= .4; }},
      {"<geom type='ellipsoid' size='.2 .3 .5'/>",
       [](const Eigen::Vector3d& p) { return p.cwiseQuotient(Eigen::Vector3d(.2, .3, .5)).norm() <= 1; }},
      {"<geom type='capsule' size='.2 .3'/>", [](const Eigen::Vector3d& p) {
         return Eigen::Vector3d(p.x(), p.y(), std::max(0., std::abs(p.z()) - .3)).norm() <= .2;
       }}};
  constexpr int kSteps = 100;
  constexpr double kStep = 1. / kSteps;
  for (const Row& row : rows) {
    double mass = 0;
    Eigen::Matrix3d I = Eigen::Matrix3d::Zero();
    for (int i = 0; i < kSteps * kSteps * kSteps; ++i) {
      const Eigen::Vector3d p =
          kStep * Eigen::Vector3d(i % kSteps + .5, i / kSteps % kSteps + .5, i / kSteps / kSteps + .5) -
          Eigen::Vector3d::Constant(.5);
      if (!row.isInside(p)) continue;
      mass += 1000 * kStep * kStep * kStep;
      I += 1000 * kStep * kStep * kStep * (p.squaredNorm() * Eigen::Matrix3d::Identity() - p * p.transpose());
    }
    const BodySpec a = body(row.geom);
    EXPECT_NEAR(a.mass, mass, .01 * mass) << row.geom;
    EXPECT_LT((*a.inertia - I).norm(), .01 * I.norm()) << row.geom;
  }
}

TEST(MjcfReader, WeighsGeomsTogether) {
  const BodySpec a = body(
      "<geom size='.1' mass='2' pos='1 0 0'/><geom type='box' size='.1 .1 .1' density='250' pos='-1 0 0'/>"
      "<geom size='1' mass='0'/><geom size='1' density='0'/><geom size='1' group='7'/>");
  EXPECT_NEAR(a.mass, 4, 1e-12);
  EXPECT_LT(a.p_BBcm.norm(), 1e-12);
  const double ball = .4 * 2 * .01, cube = 2. / 3 * 2 * .01;
  EXPECT_LT((*a.inertia -
             Eigen::Matrix3d(Eigen::Vector3d(ball + cube, ball + cube + 4, ball + cube + 4).asDiagonal()))
                .norm(),
            1e-12);
}

TEST(MjcfReader, TakesInertiasAsAsked) {
  const std::string both =
      "<inertial pos='0 0 1' mass='3' diaginertia='1 2 2.5' euler='0 0 90'/><geom size='.1'/>";
  const BodySpec given = body(both);
  EXPECT_EQ(given.mass, 3);
  EXPECT_EQ(given.p_BBcm, Eigen::Vector3d(0, 0, 1));
  EXPECT_LT((*given.inertia - Eigen::Matrix3d(Eigen::Vector3d(2, 1, 2.5).asDiagonal())).norm(), 1e-15);
  const double ball = 4. / 3 * pi;
  EXPECT_NEAR(body(both, "<compiler inertiafromgeom='true'/>").mass, ball, 1e-12);
  EXPECT_EQ(body(both, "<compiler inertiafromgeom='false'/>").mass, 3);
  EXPECT_EQ(body("<geom size='.1'/>", "<compiler inertiafromgeom='false'/>").mass, 0);
  EXPECT_EQ(
      body("<inertial pos='0 0 1' mass='3' diaginertia='1 1 1'/>", "<compiler inertiafromgeom='true'/>").mass,
      3)
      << "there are no geoms";
  const BodySpec full = body("<inertial pos='0 0 0' mass='1' fullinertia='3 4 5 .1 .2 .3'/>");
  EXPECT_EQ(*full.inertia, (Eigen::Matrix3d() << 3, .1, .2, .1, 4, .3, .2, .3, 5).finished());
}

TEST(MjcfReader, BoundsAndScalesMasses) {
  const std::string light = "<inertial pos='0 0 0' mass='.1' diaginertia='1 1 3'/>";
  EXPECT_EQ(body(light, "<compiler boundmass='.5'/>").mass, .5);
  EXPECT_LT((*body(light, "<compiler boundinertia='2'/>").inertia -
             Eigen::Matrix3d(Eigen::Vector3d(2, 2, 3).asDiagonal()))
                .norm(),
            1e-15);
  EXPECT_LT((*body(light, "<compiler balanceinertia='true'/>").inertia - 5. / 3 * Eigen::Matrix3d::Identity())
                .norm(),
            1e-15);
  EXPECT_EQ(body("<geom size='.1' group='1'/>", "<compiler inertiagrouprange='2 5'/>").mass, 0);
  const SceneSpec spec = world("<body><geom size='.1'/><body><joint/><geom size='.2'/></body></body>",
                               "<compiler settotalmass='9'/>")
                             .spec;
  EXPECT_NEAR(spec.bodies[0].mass, 1, 1e-12);
  EXPECT_NEAR(spec.bodies[1].mass, 8, 1e-12);
  EXPECT_NEAR((*spec.bodies[1].inertia)(0, 0), .4 * 8 * .04, 1e-12);
}

TEST(MjcfReader, ReadsForcesOfMotors) {
  const auto effort = [](const std::string& actuators, const std::string& before = "") {
    return parse(before + "<worldbody><body><joint name='j'/></body></worldbody><actuator>" + actuators +
                 "</actuator>")
        .spec.joints.at(0)
        .maxEffort;
  };
  EXPECT_EQ(effort("<motor joint='j' gear='150' ctrlrange='-.5 1'/>"), 150);
  EXPECT_EQ(effort("<motor joint='j' gear='-10' ctrlrange='-1 1' forcerange='-.5 .5'/>"), 5);
  EXPECT_EQ(effort("<motor joint='j' ctrllimited='false' ctrlrange='-1 1'/>"), kUnlimited);
  EXPECT_EQ(effort("<motor joint='j' ctrlrange='-1 1'/>", "<compiler autolimits='false'/>"), kUnlimited);
  EXPECT_EQ(effort("<position joint='j' kp='9' ctrlrange='-1 1' forcerange='-7 7'/>"), 7);
  EXPECT_EQ(effort("<velocity joint='j' kv='9' ctrlrange='-1 1'/>"), kUnlimited);
  EXPECT_EQ(effort("<general joint='j' ctrlrange='-1 1' gainprm='4' gear='2'/>"), 8);
  EXPECT_EQ(effort("<general joint='j' ctrlrange='-1 1' gainprm='4' biastype='affine' forcerange='-3 3'/>"),
            3);
  EXPECT_EQ(effort("<motor joint='j' ctrlrange='-1 1'/><motor joint='j' ctrlrange='-2 2'/>"), 3);
  EXPECT_EQ(effort("<motor joint='j' ctrlrange='-1 1'/><motor joint='j'/>"), kUnlimited);
  EXPECT_EQ(
      effort(
          "<motor joint='j' class='m'/>",
          "<default><position forcerange='-2 2'/><default class='m'><motor gear='3'/></default></default>"),
      6)
      << "all kinds of actuators share their defaults";
  EXPECT_EQ(parse("<worldbody><body><joint name='j' actuatorfrcrange='-4 2'/></body></worldbody>"
                  "<actuator><motor joint='j' ctrlrange='-9 9'/></actuator>")
                .spec.joints[0]
                .maxEffort,
            4);
}

SceneSpec following(const std::string& equalities) {
  return parse(
             "<compiler angle='radian'/><worldbody><body><joint name='a'/><body><joint name='b' "
             "ref='.5'/><body>"
             "<joint name='c'/></body></body></body></worldbody><equality>" +
             equalities + "</equality>")
      .spec;
}

TEST(MjcfReader, LetsJointsFollow) {
  const SceneSpec spec =
      following("<joint joint1='b' joint2='a' polycoef='.1 2 0 0 0'/><joint joint1='c' joint2='b'/>");
  EXPECT_EQ(spec.joints[1].mimic, "a");
  EXPECT_EQ(spec.joints[1].mimicRatio, 2);
  EXPECT_DOUBLE_EQ(spec.joints[1].mimicOffset, .6);
  EXPECT_EQ(spec.joints[2].mimic, "a") << "who follows a follower follows its leader";
  EXPECT_EQ(spec.joints[2].mimicRatio, 2);
  EXPECT_DOUBLE_EQ(spec.joints[2].mimicOffset, .1);
  EXPECT_EQ(compile(spec).nv(), 1);
  EXPECT_EQ(following("<joint joint1='b' joint2='a' active='false'/>").joints[1].mimic, "");
}

// The points meet where the joints start, whatever their `ref` and the frames are.
TEST(MjcfReader, ClosesLoops) {
  const auto pinned = [](const std::string& equalities, const std::string& before = "") {
    return parse(before +
                 "<worldbody><body name='a' pos='1 2 3' euler='10 20 30'><freejoint/><geom size='1'/>"
                 "<body name='b' pos='1 0 0'><joint name='j' axis='1 1 0' ref='40'/><joint type='slide' "
                 "ref='.2'/>"
                 "<geom size='1'/></body></body></worldbody><equality>" +
                 equalities + "</equality>")
        .spec;
  };
  const SceneSpec spec = pinned(
      "<connect body1='b' body2='a' anchor='.1 .2 .3'/><connect body1='b' anchor='0 0 1'/>"
      "<connect body1='b' anchor='0 0 1' active='false'/><connect body1='a' class='off' anchor='0 0 1'/>",
      "<default><default class='off'><equality active='false'/></default></default>");
  ASSERT_EQ(spec.pins.size(), 2u);
  EXPECT_EQ(spec.pins[0].p_AP, Eigen::Vector3d(.1, .2, .3));
  EXPECT_EQ(spec.pins[1].b, "world");
  const Model model = compile(spec);
  const BodyPoses poses = forwardKinematics(model, model.initialPositions());
  for (const Pin& pin : model.pins())
    EXPECT_LT((poses[pin.a] * pin.p_AP - poses[pin.b] * pin.p_BQ).norm(), 1e-14);
  const SceneSpec global = parse(
                               "<compiler coordinate='global'/><worldbody><body name='a' pos='1 2 3'>"
                               "<geom size='1' pos='1 2 3'/></body></worldbody>"
                               "<equality><connect body1='a' anchor='1 2 4'/></equality>")
                               .spec;
  EXPECT_EQ(global.pins.at(0).p_AP, Eigen::Vector3d(0, 0, 1));
}

std::string pairsOf(const SceneSpec& spec) {
  std::string text;
  for (const CollisionChoice& one : spec.collisionChoices)
    text += one.a + "-" + one.b + ": " + one.reason + (one.mayCollide ? " on\n" : "\n");
  return text;
}

TEST(MjcfReader, KnowsWhoMayCollide) {
  EXPECT_EQ(
      pairsOf(parse("<worldbody><geom size='1'/><body name='a'><joint/><geom size='1'/></body>"
                    "<body name='b'><joint/><geom size='1'/></body></worldbody>"
                    "<contact><exclude body1='a' body2='b'/><exclude body1='world' body2='b'/></contact>")
                  .spec),
      "a-b: exclude\nworld-b: exclude\n");
  const std::string bits = "<default><geom size='1' conaffinity='0'/></default>";
  const SceneSpec spec = world("<body name='a'><geom/><geom contype='4294967295'/></body>", bits).spec;
  EXPECT_EQ(pairsOf(spec), "") << "bits belong to shapes";
  EXPECT_EQ(spec.bodies[0].shapes[0].mask, (ContactMask{.type = 1, .affinity = 0}));
  EXPECT_EQ(spec.bodies[0].shapes[1].mask, (ContactMask{.type = 4294967295, .affinity = 0}));
}

TEST(MjcfReader, KnowsNeighboursAcrossSeveralJoints) {
  const SceneSpec spec =
      world(
          "<body name='a'><joint/><geom size='1'/><body name='welded'><geom size='1'/></body>"
          "<body name='b'><joint/><joint pos='0 0 1'/><geom size='1'/></body></body>")
          .spec;
  EXPECT_EQ(pairsOf(spec), "a-b: Adjacent\nwelded-b: Adjacent\n");
  static_cast<void>(compile(spec));
}

class MjcfFile : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = folder_.path() / "robot" / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
    return file;
  }
  TemporaryFolder folder_;
};

// A brick of 0.2 x 0.4 x 0.6 with a corner at the origin.
constexpr const char* kBrick =
    "OFF\n8 6 12\n0 0 0\n2 0 0\n2 4 0\n0 4 0\n0 0 6\n2 0 6\n2 4 6\n0 4 6\n4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n"
    "4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

TEST_F(MjcfFile, WeighsMeshes) {
  write("parts/brick.off", kBrick);
  const SceneFile scene = readMjcf(write(
      "m.xml",
      "<mujoco><compiler meshdir='parts'/><asset><mesh file='brick.off' scale='.1 .1 .1'/></asset><worldbody>"
      "<body name='a'><geom type='mesh' mesh='brick'/></body>"
      "<body name='b'><geom type='box' size='.1 .2 .3' pos='.1 .2 .3'/></body></worldbody></mujoco>"));
  EXPECT_THAT(scene.notes, IsEmpty());
  const BodySpec &a = scene.spec.bodies.at(0), &b = scene.spec.bodies.at(1);
  EXPECT_NEAR(a.mass, b.mass, 1e-6 * b.mass);
  EXPECT_LT((a.p_BBcm - b.p_BBcm).norm(), 1e-7);
  EXPECT_LT((*a.inertia - *b.inertia).norm(), 1e-6 * b.inertia->norm());
  EXPECT_TRUE(a.shapes[0].contact);
  EXPECT_EQ(a.shapes[0].shape.hull.positions().size(), 8u);
}

// What MuJoCo 3.3.8 (mujoco-js 0.0.7) says of the samples, with density 1. Its principal axes are exact to
// some 1e-7 rad.
struct WeighedSample {
  bool open;
  const char* inertia;
  double mass;
  Eigen::Vector3d center;
  Eigen::Matrix<double, 6, 1> moments;  // xx, yy, zz, xy, xz, yz
};
const WeighedSample kWeighed[] = {
    {false,
     "legacy",
     4.161340544083906,
     {0.7751966568338247, 1.2420108161258603, 0.5},
     {3.4306587574634664, 1.486195380984847, 4.234053417373246, 0.767785673867065, 0, 0}},
    {false,
     "exact",
     4,
     {0.75, 1.25, 0.5},
     {3.4166666666666865, 1.4166666666666798, 4.166666666666688, 0.75, 0, 0}},
    {false,
     "convex",
     5,
     {0.8666666666666666, 1.3333333333333337, 0.5},
     {3.861111111111135, 1.8277777777777953, 4.855555555555588, 0.6111111111111265, 0, 0}},
    {false,
     "shell",
     18,
     {0.7777777777777778, 1.2777777777777775, 0.5},
     {20.111111111111214, 9.944444444444532, 24.388888888889014, 3.8888888888889652, 0, 0}},
    {true,
     "legacy",
     3.372619047619048,
     {0.7803571428571429, 1.2375, 0.41071428571428575},
     {2.9360383193198554, 1.2262102701329565, 3.7418727692693077, 0.6791830516743348, -0.0036956859895004865,
      0.0010227965848628828}},
    {true,
     "exact",
     3.2099567099567095,
     {0.7475649350649349, 1.2475649350649352, 0.40746753246753253},
     {2.919113521086601, 1.1561265931046942, 3.6729314252064116, 0.6610992791336162, -0.00021733951897764763,
      -0.0002173394630880781}},
    {true,
     "convex",
     5,
     {0.8666666666666666, 1.3333333333333333, 0.5},
     {3.861111111111135, 1.8277777777777953, 4.855555555555588, 0.6111111111111265, 0, 0}},
    {true,
     "shell",
     14,
     {0.7857142857142857, 1.285714285714286, 0.35714285714285715},
     {15.738095414012598, 7.571428600326389, 20.21428550947077, 3.1428572152495193, -0.07143221574955923,
      -0.07142981116348768}},
};

TEST_F(MjcfFile, WeighsMeshesAsMujocoDoes) {
  for (const WeighedSample& sample : kWeighed) {
    SCOPED_TRACE(std::string(sample.inertia) + (sample.open ? ", open" : ", closed"));
    write("m.obj", objText(trianglesOf(profileSample(sample.open))));
    for (const bool touches : {true, false}) {  // what is not touched has no hull of its own
      const SceneFile scene = readMjcf(write(
          "m.xml",
          std::string("<mujoco><default><mesh inertia='") + sample.inertia +
              "'/></default><asset><mesh file='m.obj'/></asset><worldbody><body><geom type='mesh' mesh='m' "
              "density='1' contype='" +
              (touches ? "1" : "0") + "' conaffinity='0'/></body></worldbody></mujoco>"));
      const BodySpec& body = scene.spec.bodies.at(0);
      EXPECT_NEAR(body.mass, sample.mass, 1e-9);
      EXPECT_LT((body.p_BBcm - sample.center).norm(), 1e-9);
      const Eigen::Matrix3d& I = *body.inertia;
      const auto& m = sample.moments;
      EXPECT_LT(
          (I - (Eigen::Matrix3d() << m[0], m[3], m[4], m[3], m[1], m[5], m[4], m[5], m[2]).finished()).norm(),
          2e-5);
      EXPECT_NEAR(I.trace(), m.head<3>().sum(), 1e-9);
    }
  }
}

// What MuJoCo 3.3.8 says of surfaces with density 1.
TEST(MjcfReader, WeighsShellsAsMujocoDoes) {
  const struct {
    const char* geom;
    double mass;
    Eigen::Vector3d moments;
  } shells[] = {
      {"size='.3'", 1.1309733552923256, Eigen::Vector3d::Constant(0.06785840131753952)},
      {"type='capsule' size='.1 .4'",
       0.6283185307179586,
       {0.055292030703180374, 0.055292030703180374, 0.005864306286700949}},
      {"type='cylinder' size='.2 .3'",
       1.0053096491487339,
       {0.06283185307179587, 0.06283185307179587, 0.03518583772020569}},
      {"type='box' size='.1 .2 .4'", 1.12, {0.10026666666666671, 0.0848, 0.03146666666666668}},
      {"type='ellipsoid' size='.1 .2 .4'",
       0.6356634521946628,
       {0.03414433178954823, 0.028877387881038885, 0.010715538637725786}},
  };
  for (const auto& [geom, mass, moments] : shells) {
    SCOPED_TRACE(geom);
    const std::string attributes = std::string("<geom density='1' shellinertia='true' ") + geom;
    for (const double factor : {1., 3.}) {
      const BodySpec shell =
          body(attributes + (factor == 1 ? "/>" : " mass='" + std::to_string(3 * mass) + "'/>"));
      EXPECT_NEAR(shell.mass, factor * mass, factor == 1 ? 1e-9 : 1e-5);
      EXPECT_LT((shell.inertia->diagonal() / shell.mass - moments / mass).norm(), 1e-9);
      EXPECT_TRUE(shell.inertia->isDiagonal());
    }
  }
  EXPECT_EQ(body("<geom density='1' size='.3' shellinertia='false'/>").mass,
            body("<geom density='1' size='.3'/>").mass);
}

TEST_F(MjcfFile, TakesTheRuleOfMeshesFromTheCompiler) {
  write("m.obj", objText(trianglesOf(profileSample(false))));
  const auto massWith = [&](const std::string& compiler, const std::string& mesh) {
    return readMjcf(write("m.xml", "<mujoco><compiler " + compiler + "/><asset><mesh file='m.obj' " + mesh +
                                       "/></asset><worldbody><body><geom type='mesh' mesh='m' "
                                       "density='1'/></body></worldbody></mujoco>"))
        .spec.bodies.at(0)
        .mass;
  };
  EXPECT_NEAR(massWith("", ""), 4.161340544083906, 1e-9);
  EXPECT_NEAR(massWith("exactmeshinertia='false'", ""), 4.161340544083906, 1e-9);
  EXPECT_NEAR(massWith("exactmeshinertia='true'", ""), 4, 1e-9);
  EXPECT_NEAR(massWith("exactmeshinertia='true'", "inertia='convex'"), 5, 1e-9);
}

TEST_F(MjcfFile, SaysHowFarTheVolumeOfAMeshIsInDoubt) {
  write("open.obj", objText(trianglesOf(profileSample(true))));
  write("closed.obj", objText(trianglesOf(profileSample(false))));
  const auto notesWith = [&](const std::string& file, const std::string& mesh, const std::string& geom = "") {
    const std::string body = "<body><geom type='mesh' mesh='m' " + geom + "/></body>\n";
    return notesOf(
        readMjcf(write("m.xml", "<mujoco><asset>\n<mesh name='m' file='" + file + "' " + mesh +
                                    "/></asset><worldbody>" + body + body + "</worldbody></mujoco>")));
  };
  const std::string holes =
      "m.xml:2:22: warning: mesh 'open.obj': the surface has holes, or triangles with the wrong side out, so "
      "its "
      "volume is uncertain by ";
  EXPECT_THAT(
      notesWith("open.obj", ""),
      ElementsAre(HasSubstr(holes + "19 %: 3.373 m^3 by inertia=\"legacy\", 4 m^3 with all holes closed")));
  EXPECT_THAT(
      notesWith("open.obj", "inertia='exact'", "mass='1'"),
      ElementsAre(HasSubstr(holes + "25 %: 3.21 m^3 by inertia=\"exact\", 4 m^3 with all holes closed")));
  EXPECT_THAT(
      notesWith("closed.obj", ""),
      ElementsAre(HasSubstr("m.xml:2:22: note: a mesh that is not convex weighs more than it encloses, as in "
                            "MuJoCo, where inertia=\"legacy\" is the default of <mesh>; \"exact\" counts "
                            "what it encloses")));
  EXPECT_THAT(notesWith("closed.obj", "", "mass='1'"), IsEmpty());
  EXPECT_THAT(notesWith("closed.obj", "inertia='exact'"), IsEmpty());
  for (const char* file : {"open.obj", "closed.obj"})
    for (const char* inertia : {"inertia='convex'", "inertia='shell'"})
      EXPECT_THAT(notesWith(file, inertia), IsEmpty()) << file << inertia;
  EXPECT_THAT(notesWith("open.obj", "", "density='0'"), IsEmpty()) << "what weighs nothing is in no doubt";
  EXPECT_THAT(notesWith("closed.obj", "inertia='exact'", "mass='1' shellinertia='true'"),
              testing::Contains(
                  HasSubstr("<geom>: 'shellinertia' has no effect on a mesh, as in MuJoCo since version 3.3: "
                            "its <mesh> needs inertia=\"shell\"")));
}

TEST_F(MjcfFile, WeighsNoHullsOfTooManyVertices) {
  std::string text;
  for (int i = 0; i <= 100'000; ++i) text += "v " + std::to_string(i) + " 0 " + std::to_string(i % 2) + "\n";
  for (int i = 3; i <= 100'001; ++i)
    text += "f " + std::to_string(i - 2) + " " + std::to_string(i - 1) + " " + std::to_string(i) + "\n";
  write("fine.obj", text);
  EXPECT_REX_ERROR(
      readMjcf(
          write("m.xml",
                "<mujoco><asset><mesh file='fine.obj' inertia='convex'/></asset><worldbody><body>"
                "<geom type='mesh' mesh='fine' contype='0' conaffinity='0'/></body></worldbody></mujoco>")),
      "m.xml:1:28: mesh 'fine.obj': inertia=\"convex\": convex hull: found 100001 different points, wanted "
      "at most "
      "100000");
}

// A cube, and far from it a small one that is inside out.
TEST_F(MjcfFile, RepairsMomentsOfMeshes) {
  std::vector<BlockFace> faces = facesOf({{0, 0, 0}}, {{{-1, 1}, {-1, 1}, {-1, 1}}});
  for (BlockFace face : facesOf({{0, 0, 0}}, {{{19.75, 20.25}, {-.25, .25}, {-.25, .25}}})) {
    std::swap(face.u, face.v);
    faces.push_back(face);
  }
  write("m.obj", objText(trianglesOf(faces)));
  const auto file =
      write("m.xml",
            "<mujoco><asset><mesh file='m.obj' inertia='exact'/></asset><worldbody>\n"
            "<body name='a'><geom type='mesh' mesh='m' density='1'/></body></worldbody></mujoco>");
  const SceneFile scene = readMjcf(file);
  const double small = .125, mass = 8 - small, x = -20 * small / mass;
  const double xx = 8 * (1. / 3 + x * x) - small * (1. / 48 + (20 - x) * (20 - x));
  const double yy = 8. / 3 - small / 48;
  EXPECT_THAT(notesOf(scene),
              ElementsAre(testing::MatchesRegex(
                  ".*m.xml:2:1: warning: body 'a': its geoms: a negative principal moment: wanted "
                  "principal moments >= 0; -4[0-9.]* and -4[0-9.]* kg m.2 are physically impossible "
                  "and count as 0")));
  const BodySpec& body = scene.spec.bodies.at(0);
  EXPECT_NEAR(body.mass, mass, 1e-9);
  EXPECT_LT(xx + yy, -40);
  EXPECT_LT((*body.inertia - Eigen::Matrix3d(Eigen::Vector3d(2 * yy, 0, 0).asDiagonal())).norm(), 1e-9);
  EXPECT_REX_ERROR(
      readMjcf(file, {.strict = true}),
      "m.xml:2:1: body 'a': its geoms: a negative principal moment: wanted principal moments >= 0");
  static_cast<void>(compile(scene.spec));
}

TEST_F(MjcfFile, NamesMeshesByPathOnlyIfAsked) {
  write("brick.off", kBrick);
  const SceneFile scene = readMjcf(write("m.xml",
                                         "<mujoco><compiler strippath='true'/><asset><mesh name='x' "
                                         "file='elsewhere/brick.off'/></asset><worldbody>"
                                         "<geom type='mesh' mesh='x'/></worldbody></mujoco>"));
  EXPECT_EQ(scene.spec.worldShapes.at(0).meshFile, "brick.off");
}

TEST_F(MjcfFile, SaysWhatWeighsNothing) {
  write("flat.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const std::string text =
      "<mujoco><asset><mesh file='flat.off'/><mesh name='gone' file='gone.off'/></asset><worldbody><body>"
      "<geom type='mesh' mesh='flat' contype='0' conaffinity='0'/>\n<geom type='mesh' mesh='gone'/></body>"
      "</worldbody></mujoco>";
  const std::vector<std::string> notes =
      notesOf(readMjcf(write("m.xml", text), {.allowMissingMeshes = true}));
  ASSERT_EQ(notes.size(), 3u);
  EXPECT_THAT(notes[0],
              HasSubstr("m.xml:1:99: warning: <geom>: the mesh encloses no volume, so it weighs nothing"));
  EXPECT_THAT(notes[1], HasSubstr("m.xml:2:1: warning: <geom>: the mesh is missing, so it weighs nothing"));
  EXPECT_THAT(notes[2], HasSubstr("mesh 'gone.off' of the folder of the scene was not found"));
  EXPECT_REX_ERROR(parseMjcf(text, "m.xml"),
                   "m.xml:1:99: <geom>: the mass of a mesh: found a scene that was given as text, wanted an "
                   "<inertial> of the body, or the model in a file");
}

// As in MuJoCo, where the robot file alone says the colours, whatever a library of the mesh does.
TEST_F(MjcfFile, IgnoresTheMaterialsOfMeshes) {
  write("red.mtl", "newmtl red\nKd 1 0 0\nd 0\n");
  write("red.obj", "mtllib red.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
  const SceneFile scene = readMjcf(write("m.xml",
                                         "<mujoco><asset><mesh file='red.obj'/></asset><worldbody><geom "
                                         "type='mesh' mesh='red' rgba='0 0 1 1'/></worldbody></mujoco>"));
  EXPECT_THAT(notesOf(scene), IsEmpty());
  const ShapeSpec& shape = scene.spec.worldShapes.at(0);
  ASSERT_EQ(shape.shape.mesh.parts().size(), 1u);
  EXPECT_FALSE(shape.shape.mesh.parts()[0].color);
  EXPECT_EQ(shape.color, Eigen::Vector4d(0, 0, 1, 1));
}

TEST_F(MjcfFile, IncludesOthers) {
  write("parts/arm.xml",
        "<mujocoinclude><body name='arm'><include file='parts/geoms.xml'/></body></mujocoinclude>");
  write("parts/geoms.xml", "<mujoco model='g'><geom size='1'/><geom sise='2' size='1'/><site/></mujoco>");
  write("style.xml", "<mujoco><default><geom rgba='0 0 1 1' condim='3'/></default></mujoco>");
  const SceneFile scene = readMjcf(
      write("m.xml",
            "<mujoco><worldbody><include file='parts/arm.xml'/><geom size='1' condim='1'/><site/></worldbody>"
            "<include file='style.xml'/></mujoco>"));
  ASSERT_EQ(scene.spec.bodies.size(), 1u);
  ASSERT_EQ(scene.spec.bodies[0].shapes.size(), 2u);
  EXPECT_EQ(scene.spec.bodies[0].shapes[0].color, Eigen::Vector4d(0, 0, 1, 1));
  EXPECT_EQ(scene.spec.bodies[0].shapes[0].where.line, 1);
  EXPECT_THAT(scene.spec.bodies[0].shapes[0].where.file, HasSubstr("geoms.xml"));
  const std::vector<std::string> notes = notesOf(scene);
  ASSERT_EQ(notes.size(), 3u);
  EXPECT_THAT(notes[0],
              HasSubstr("geoms.xml:1:41: warning: body 'arm': <geom>: unknown attribute 'sise' is ignored "
                        "(did you mean 'size'?)"));
  EXPECT_THAT(notes[1], HasSubstr("m.xml:1:66: warning: <geom>: contact will differ: attributes that are not "
                                  "read: condim (2 times)"));
  EXPECT_THAT(notes[2], HasSubstr("m.xml:1:78: note: <site> is ignored: the picture will differ (2 times)"))
      << "of both files";
}

TEST_F(MjcfFile, RefusesIncludesThatCannotBe) {
  const auto read = [&](const std::string& inside) {
    return readMjcf(write("m.xml", "<mujoco><worldbody>" + inside + "</worldbody></mujoco>"));
  };
  write("part.xml", "<mujoco/>");
  write("robot.xml", "<robot/>");
  write("ring.xml", "<mujoco><include file='m.xml'/></mujoco>");
  EXPECT_REX_ERROR(read("<include file='prat.xml'/>"), "m.xml:1:35: <include> of 'prat.xml': found no file");
  EXPECT_REX_ERROR(read("<include file='prat.xml'/>"), "did you mean 'part.xml'");
  EXPECT_REX_ERROR(read("<include file='../../../etc/passwd'/>"), "wanted a file inside the asset root");
  EXPECT_REX_ERROR(
      read("<include file='part.xml'/><include file='part.xml'/>"),
      "m.xml:1:61: <worldbody>: <include>: attribute 'file': found a file that is already included, wanted "
      "each file once");
  EXPECT_REX_ERROR(read("<include file='ring.xml'/>"), "found a file that is already included");
  EXPECT_REX_ERROR(
      read("<include file='robot.xml'/>"),
      "robot.xml:1:1: not an MJCF model: found <robot>, wanted <mujoco>; if it is a robot in URDF, name "
      "it .urdf");
  std::string many;
  for (int i = 0; i < 64; ++i) {
    write("p" + std::to_string(i) + ".xml", "<mujoco/>");
    many += "<include file='p" + std::to_string(i) + ".xml'/>";
  }
  EXPECT_REX_ERROR(read(many), "found file number 65, wanted at most 64");
  EXPECT_REX_ERROR(
      world("<include file='part.xml'/>"),
      "m.xml:1:35: <worldbody>: <include>: attribute 'file': found a scene that was given as text, "
      "wanted no <include>: only models in files include others");
}

TEST_F(MjcfFile, LimitsHowDeepBodiesAre) {
  const auto nested = [](const std::string& inside) {
    std::string text;
    for (int i = 0; i < 60; ++i) text += "<body>";
    text += inside;
    for (int i = 0; i < 60; ++i) text += "</body>";
    return text;
  };
  write("part.xml", "<mujoco>" + nested("") + "</mujoco>");
  EXPECT_REX_ERROR(readMjcf(write("m.xml", "<mujoco><worldbody>" + nested("<include file='part.xml'/>") +
                                               "</worldbody></mujoco>")),
                   "part.xml:1:249: <body>: nested too deep: found level 101, wanted at most 100");
}

TEST_F(MjcfFile, LimitsAllFilesTogether) {
  const std::string large = "<mujoco><!--" + std::string((8u << 20) - 30, ' ') + "--></mujoco>";
  std::string all;
  for (int i = 0; i < 5; ++i) {
    write("p" + std::to_string(i) + ".xml", large);
    all += "<include file='p" + std::to_string(i) + ".xml'/>";
  }
  EXPECT_REX_ERROR(readMjcf(write("m.xml", "<mujoco>" + all + "</mujoco>")),
                   "bytes in all files, wanted at most 32 MiB");
  EXPECT_REX_ERROR(readMjcf(write("m.xml", large + std::string(40, ' '))), "scene file too large");
}

TEST(MjcfReader, IsWrittenAndReadAgain) {
  const SceneFile scene = world(
      "<geom type='plane' size='0 0 1'/><body name='a' pos='0 0 1'><freejoint/><geom type='capsule' size='.1 "
      ".2'/>"
      "<body name='b' pos='1 0 0'><joint axis='1 1 0' pos='0 0 .1' ref='20' range='-90 90'/>"
      "<joint axis='0 0 1' pos='0 0 .2'/><geom type='box' size='.1 .2 .3' euler='10 20 30'/></body></body>");
  const Model model = compile(scene.spec);
  const Model again = compile(parseScene(writeOrs(scene.spec), "again.ors").spec);
  ASSERT_EQ(again.nq(), model.nq());
  Rng rng(5);
  Eigen::VectorXd q = rng.normalVector(model.nq());
  q.segment<4>(3).normalize();
  for (const Body& one : model.bodies())
    EXPECT_TRUE(isApprox(forwardKinematics(model, q)[model.body(one.name)],
                         forwardKinematics(again, q)[again.body(one.name)], 1e-12));
  EXPECT_NEAR(again.mass(), model.mass(), 1e-12);
  EXPECT_EQ(again.collisionChoices().size(), model.collisionChoices().size());
}

// A mesh in the tag weighs, is drawn and touches as one in a file does.
TEST(MjcfReader, ReadsMeshesInTags) {
  const std::string corners = "vertex='0 0 0  2 0 0  0 2 0  0 0 2' ";
  const auto geom = [&](const std::string& mesh) {
    return body("<geom type='mesh' mesh='m' density='3'/>",
                "<asset><mesh name='m' inertia='exact' " + mesh + "/></asset>");
  };
  const BodySpec whole = geom(corners + "face='0 2 1  0 1 3  1 2 3  0 3 2'");
  EXPECT_NEAR(whole.mass, 3 * 8. / 6, 1e-9);
  EXPECT_TRUE(whole.p_BBcm.isApproxToConstant(.5, 1e-9));
  EXPECT_EQ(whole.shapes.at(0).shape.mesh.triangles().size(), 4u);
  EXPECT_FALSE(whole.shapes[0].shape.hull.isEmpty());
  EXPECT_NEAR(geom(corners).mass, 4, 1e-9) << "without faces, the hull";
  EXPECT_NEAR(geom(corners + "scale='-2 1 1'").mass, 8, 1e-9);
  EXPECT_NEAR(geom("builtin='sphere' params='4' scale='.5 .5 .5'").mass, 3 * 4 * pi / 3 / 8, .01);
  EXPECT_LT(geom("builtin='sphere' params='0'").mass, geom("builtin='sphere' params='1'").mass);
}

// MuJoCo's order: less refpos, turned back by refquat, then scaled.
TEST(MjcfReader, MovesMeshesByTheirReference) {
  const std::string corners = "vertex='0 0 0  2 0 0  0 2 0  0 0 2' inertia='exact' ";
  const auto center = [&](const std::string& mesh) {
    return body("<geom type='mesh' mesh='m'/>", "<asset><mesh name='m' " + corners + mesh + "/></asset>")
        .p_BBcm;
  };
  EXPECT_TRUE(center("refpos='1 2 3'").isApprox(Eigen::Vector3d(-.5, -1.5, -2.5), 1e-6));
  // A quarter about z, back: x goes to -y.
  const std::string quarter = "refquat='1 0 0 1' ";
  EXPECT_TRUE(center(quarter + "refpos='1 0 0'").isApprox(Eigen::Vector3d(.5, .5, .5), 1e-6));
  EXPECT_TRUE(center(quarter + "refpos='1 0 0' scale='2 3 4'").isApprox(Eigen::Vector3d(1, 1.5, 2), 1e-6));
  EXPECT_TRUE(center("refquat='.9 .1 .2 .3' scale='-2 -2 -2'").norm() > 1.7);
}

TEST(MjcfReader, RepeatsWhatIsInReplicate) {
  const SceneFile scene = world(
      "<body name='hub'><replicate count='3' offset='0 0 1' euler='0 0 90' sep='-'>"
      "<body name='arm' pos='1 0 0'><joint name='j'/><replicate count='2' offset='2 0 0'>"
      "<geom name='g' size='.1'/></replicate></body></replicate></body>",
      "<equality><joint joint1='j'/></equality><actuator><motor joint='j' forcerange='-2 2'/></actuator>"
      "<contact><exclude body1='hub' body2='arm'/></contact>");
  std::vector<std::string> names;
  for (const BodySpec& one : scene.spec.bodies) names.push_back(one.name);
  EXPECT_THAT(names, ElementsAre("hub", "arm-0", "arm-1", "arm-2"));
  ASSERT_EQ(scene.spec.joints.size(), 3u);
  EXPECT_EQ(scene.spec.joints[2].name, "j-2");
  EXPECT_EQ(scene.spec.joints[2].maxEffort, 2);
  EXPECT_EQ(scene.spec.collisionChoices.size(), 3u);
  const auto at = [&](std::size_t j) { return scene.spec.joints[j].X_PF; };
  EXPECT_TRUE(at(0).p.isApprox(Eigen::Vector3d(1, 0, 0), 1e-12));
  EXPECT_TRUE(at(1).p.isApprox(Eigen::Vector3d(0, 1, 1), 1e-12));
  EXPECT_TRUE(at(2).p.isApprox(Eigen::Vector3d(-1, 0, 2), 1e-12));
  ASSERT_EQ(scene.spec.bodies[1].shapes.size(), 2u);
  EXPECT_EQ(scene.spec.bodies[1].shapes[1].X_BS.p.x(), 2);
  EXPECT_NEAR(scene.spec.bodies[1].mass, scene.spec.bodies[3].mass, 1e-12);
}

TEST(MjcfReader, CountsReplicasWithZerosInFront) {
  const SceneFile scene = world("<replicate count='10' offset='1 0 0'><body name='a'/></replicate>");
  ASSERT_EQ(scene.spec.bodies.size(), 10u);
  EXPECT_EQ(scene.spec.bodies[3].name, "a03");
  EXPECT_EQ(scene.spec.bodies[9].X_WB.p.x(), 9);
}

TEST(MjcfReader, LeavesOutForcesThatFlagsDisable) {
  const auto with = [](const std::string& flags) {
    return world("<body name='a'><joint damping='4' frictionloss='5' stiffness='6' range='-1 1'/></body>",
                 "<option><flag " + flags + "/></option>")
        .spec.joints.at(0);
  };
  EXPECT_EQ(with("damper='disable'").damping, 0);
  EXPECT_EQ(with("passive='disable'").damping, 0);
  EXPECT_EQ(with("damper='disable'").stiffness, 6);
  EXPECT_EQ(with("spring='disable'").stiffness, 0);
  EXPECT_EQ(with("passive='disable'").stiffness, 0);
  EXPECT_EQ(with("frictionloss='disable'").friction, 0);
  EXPECT_EQ(with("limit='disable'").lower.size(), 0);
  EXPECT_EQ(with("constraint='disable'").friction, 0);
  EXPECT_EQ(with("constraint='disable'").damping, 4);
}

TEST(MjcfReader, LeavesOutWhatFlagsDisable) {
  const auto with = [](const std::string& flag) {
    return parse(
               "<option><flag " + flag +
               "='disable'/></option><worldbody><body name='a'><joint name='j'/><geom size='1'/><body "
               "name='b'><joint name='k'/></body></body></worldbody><equality><joint joint1='j' joint2='k'/>"
               "</equality>")
        .spec;
  };
  EXPECT_EQ(with("energy").joints[0].mimic, "k");
  EXPECT_EQ(with("equality").joints[0].mimic, "");
  EXPECT_TRUE(with("equality").bodies[0].shapes[0].contact);
  EXPECT_FALSE(with("contact").bodies[0].shapes[0].contact);
}

TEST(MjcfReader, ReadsArmaturesAndSprings) {
  const SceneSpec spec = world(
                             "<body name='a' pos='1 2 3'><joint type='free' stiffness='7' armature='2'/>"
                             "<body name='b'><joint armature='.1' stiffness='3' springref='90'/></body>"
                             "<body name='c'><joint type='slide' springref='.4' stiffness='2'/></body>"
                             "<body name='d'><joint type='ball' springref='1' stiffness='2'/></body></body>")
                             .spec;
  const Model model = compile(spec);
  const std::vector<Joint>& joints = model.joints();
  EXPECT_EQ(joints[0].springReference, model.initialPositions().head<7>());
  EXPECT_EQ(compile(atPositions(spec, model.initialPositions() * 2)).joints()[0].springReference,
            joints[0].springReference);
  EXPECT_EQ(joints[0].armature, 2);
  EXPECT_EQ(joints[1].armature, .1);
  EXPECT_EQ(joints[1].stiffness, 3);
  EXPECT_NEAR(joints[1].springReference[0], pi / 2, 1e-15);
  EXPECT_EQ(joints[2].springReference[0], .4);
  EXPECT_EQ(joints[3].springReference, Eigen::Vector4d(1, 0, 0, 0));
}

// A rod of mass 3 about its end, with armature: 3 * 4 / 3 + 1 kg m^2.
TEST(MjcfReader, MakesSpringsOfTheirTimeAndDampingRatio) {
  const auto with = [](const std::string& joint, const std::string& flags = "") {
    return world(
               "<body name='a'><inertial pos='1 0 0' mass='3' diaginertia='1 1 1'/><joint armature='1' "
               "axis='0 1 0' springdamper='" +
                   joint + "' stiffness='8' damping='9'/></body>",
               "<option><flag " + flags + "/></option>")
        .spec.joints.at(0);
  };
  EXPECT_NEAR(with(".5 2").stiffness, 5 / (.25 * 4), 1e-12);
  EXPECT_NEAR(with(".5 2").damping, 2 * 5 / .5, 1e-12);
  EXPECT_EQ(with("0 2").stiffness, 8);
  EXPECT_EQ(with(".5 -1").damping, 9);
  EXPECT_EQ(with(".5 2", "spring='disable'").stiffness, 0);
  EXPECT_NEAR(with(".5 2", "spring='disable'").damping, 20, 1e-12);
  EXPECT_EQ(with(".5 2", "damper='disable'").damping, 0);
  EXPECT_EQ(with(".5 2", "passive='disable'").stiffness, 0);
}

// c q + d p keeps its length, or one follows the other.
TEST(MjcfReader, CouplesJointsByFixedTendons) {
  const auto follower = [](const std::string& tendons, const std::string& equality) {
    const SceneSpec spec =
        parse(
            "<compiler angle='radian'/><worldbody><body><joint name='j' ref='.5'/><body><joint name='k' "
            "ref='2'/></body></body></worldbody><tendon>" +
            tendons + "</tendon><equality><tendon " + equality + "/></equality>")
            .spec;
    const JointSpec& j = spec.joints.at(0);
    return std::tuple(j.mimic, j.mimicRatio, j.mimicOffset);
  };
  const std::string both = "<fixed name='t'><joint joint='j' coef='2'/><joint joint='k' coef='-1'/></fixed>";
  EXPECT_EQ(follower(both, "tendon1='t' polycoef='.5'"), std::tuple("k", .5, .5 + .25 - .5 * 2));
  const std::string one =
      "<fixed name='t'><joint joint='j' coef='2'/></fixed>"
      "<fixed name='s'><joint joint='k' coef='4'/></fixed>";
  EXPECT_EQ(follower(one, "tendon1='t' tendon2='s' polycoef='1 3'"), std::tuple("k", 6., .5 + .5 - 12));
  EXPECT_EQ(follower(both, "tendon1='t' active='false'"), std::tuple("", 1., 0.));
}

TEST(MjcfReader, SharesTheForceOfATendon) {
  const SceneSpec spec =
      parse(
          "<worldbody><body><joint name='j'/><body><joint name='k'/></body></body></worldbody><tendon>"
          "<fixed name='t'><joint joint='j' coef='.5'/><joint joint='k' coef='-2'/></fixed></tendon>"
          "<actuator><general tendon='t' forcerange='-5 5'/><motor joint='k' ctrlrange='0 1'/></actuator>")
          .spec;
  EXPECT_EQ(spec.joints[0].maxEffort, 2.5);
  EXPECT_EQ(spec.joints[1].maxEffort, 11);
}

TEST(MjcfReader, AttachesNoModelToItselfForEver) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "a.xml")
      << "<mujoco><asset><model name='a' file='a.xml'/></asset><worldbody><body name='b'><geom size='1'/>"
         "<attach model='a' prefix='x'/></body></worldbody></mujoco>";
  EXPECT_REX_ERROR(readMjcf(folder.path() / "a.xml"),
                   "found level 9 of models that attach others, wanted at most 8");
  std::ofstream(folder.path() / "c.xml")
      << "<mujoco><asset><model file='d.xml'/></asset><worldbody><attach model='d' body='x' "
         "prefix=''/></worldbody></mujoco>";
  std::ofstream(folder.path() / "d.xml") << "<mujoco><worldbody><body name='b'/></worldbody></mujoco>";
  EXPECT_REX_ERROR(readMjcf(folder.path() / "c.xml"), "found 'x', wanted a body of the model 'd'");
  std::ofstream(folder.path() / "d.xml")
      << "<mujoco><worldbody><body name='x'><freejoint/></body></worldbody></mujoco>";
  EXPECT_NO_THROW(static_cast<void>(readMjcf(folder.path() / "c.xml")));
  std::ofstream(folder.path() / "c.xml")
      << "<mujoco><asset><model file='d.xml'/></asset><worldbody><body name='e'><attach model='d' body='x' "
         "prefix=''/></body></worldbody></mujoco>";
  EXPECT_REX_ERROR(readMjcf(folder.path() / "c.xml"),
                   "a free joint: found a body on 'e', wanted a body on the world");
}

}  // namespace rex::mjcf_reader_test
