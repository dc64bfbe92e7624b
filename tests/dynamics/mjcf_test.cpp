// A second opinion: MuJoCo reads the same models by its own reader, places their bodies and weighs them.
#include <gtest/gtest.h>

#ifdef REX_WITH_MUJOCO

#include <algorithm>
#include <fstream>
#include <set>

#include <mujoco/mujoco.h>

#include "base/process.h"
#include "base/rng.h"
#include "bench/mujoco_model.h"
#include "dynamics/energy.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/forward_dynamics.h"
#include "dynamics/stepper.h"
#include "formats/mjcf_reader.h"
#include "geometry/rotation.h"
#include "kinematics/forward_kinematics.h"
#include "support/block_surface.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/mujoco_peer.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::mjcf_test {

using Eigen::VectorXd;

void eraseAll(std::string& text, const std::string& part) {
  for (std::size_t at; (at = text.find(part)) != std::string::npos;) text.erase(at, part.size());
}

// The default of later versions.
void setAutolimits(std::string& xml) {
  if (const std::size_t at = xml.find("<compiler "); at != std::string::npos)
    xml.insert(at + 10, "autolimits='true' ");
}

class MjcfPeer : public testing::TestWithParam<std::string> {};

TEST_P(MjcfPeer, AgreesOnSamples) {
  const std::filesystem::path file = sharedPath("data/mjcf") / (GetParam() + ".xml");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  std::string xml = fileText(file);
  const SceneSpec spec = readMjcf(file).spec;
  eraseAll(xml,
           R"(<inertial mass="10"/>)");  // without 'pos', which MuJoCo refuses even where it does not count
  setAutolimits(xml);
  expectSame(xml, spec);
}

INSTANTIATE_TEST_SUITE_P(Samples, MjcfPeer,
                         testing::Values("ant", "capsule_fromtoX", "half_cheetah", "humanoid",
                                         "inverted_pendulum"));

const std::string kOpenAi = "/usr/share/doc/dart/data/mjcf/openai/";  // of the package dart-doc
INSTANTIATE_TEST_SUITE_P(OpenAi, MjcfPeer,
                         testing::Values(kOpenAi + "inverted_double_pendulum", kOpenAi + "inverted_pendulum",
                                         kOpenAi + "point", kOpenAi + "reacher", kOpenAi + "swimmer"));

// Those that the package compresses, and those that include others and have meshes; but for ant, striker and
// thrower, whose bodies have not all names.
TEST(MjcfPeers, AgreeOnMoreOfOpenAi) {
  namespace fs = std::filesystem;
  if (!fs::exists(kOpenAi)) GTEST_SKIP() << "needs the package dart-doc";
  const TemporaryFolder folder;
  fs::copy(kOpenAi, folder.path(), fs::copy_options::recursive);
  ASSERT_TRUE(runProcess({"gunzip", "-r", folder.path()}).ok());
  for (const char* name :
       {"half_cheetah", "humanoid", "humanoidstandup", "pusher", "robotics/fetch/pick_and_place",
        "robotics/fetch/push", "robotics/fetch/reach", "robotics/fetch/slide"}) {
    SCOPED_TRACE(name);
    const fs::path file = folder.path() / (std::string(name) + ".xml");
    const SceneSpec spec = readMjcf(file, {.assetRoot = folder.path()}).spec;
    std::string xml = fileText(file);
    setAutolimits(xml);
    std::ofstream(file) << xml;
    char message[1000] = "";
    bench::MujocoModel theirs(mj_loadXML(file.c_str(), nullptr, message, sizeof message));
    ASSERT_TRUE(theirs) << message;
    expectSame(std::move(theirs), spec);
  }
}

// MuJoCo has given them up. The masses are those of the hopper that its converted files have.
TEST(MjcfPeers, MissGlobalCoordinates) {
  const std::filesystem::path file = sharedPath("data/mjcf/hopper.xml");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no hopper.xml";
  const Model model = compile(readMjcf(file).spec);
  for (const auto& [body, mass] :
       {std::pair{"torso", 3.66519143}, {"thigh", 4.05789051}, {"leg", 2.78135670}, {"foot", 5.31557477}})
    EXPECT_NEAR(model[model.body(body)].mass, mass, 1e-7) << body;
}

TEST(MjcfFiles, MeanTheSameInGlobalAndLocalCoordinates) {
  const auto modelOf = [](const std::string& coordinate, const std::string& bodies) {
    return compile(parseMjcf("<mujoco><compiler coordinate='" + coordinate + "'/><worldbody>" + bodies +
                                 "</worldbody></mujoco>",
                             "a.xml")
                       .spec);
  };
  const Model local = modelOf("local", R"(
    <body name="a" pos="0 0 1" euler="0 90 0"><joint name="i" axis="0 1 0" pos=".1 0 0"/>
      <geom type="capsule" size=".05" fromto="0 0 0 .5 0 0"/><geom type="box" size=".1 .2 .3" pos="0 .1 0"/>
      <body name="b" pos=".5 0 0"><joint name="j" axis="0 0 1"/><joint name="k" type="slide" axis="1 0 0"/>
        <geom type="sphere" size=".1" pos=".2 0 0"/></body></body>)");
  const Model global = modelOf("global", R"(
    <body name="a" pos="0 0 1" euler="0 90 0"><joint name="i" axis="0 1 0" pos="0 0 .9"/>
      <geom type="capsule" size=".05" fromto="0 0 1 0 0 .5"/>
      <geom type="box" size=".1 .2 .3" pos="0 .1 1" euler="0 90 0"/>
      <body name="b" pos="0 0 .5" euler="0 90 0"><joint name="j" pos="0 0 .5" axis="1 0 0"/>
        <joint name="k" type="slide" axis="0 0 -1"/><geom type="sphere" size=".1" pos="0 0 .3"/></body></body>)");
  const Eigen::Vector3d q(.3, -.5, .7);
  const BodyPoses one = forwardKinematics(local, q), other = forwardKinematics(global, q);
  for (const char* body : {"a", "b"}) {
    EXPECT_LT((one[local.body(body)].p - other[global.body(body)].p).norm(), 1e-12) << body;
    EXPECT_LT((one[local.body(body)].R - other[global.body(body)].R).norm(), 1e-12) << body;
  }
  EXPECT_LT((massMatrix(local, q) - massMatrix(global, q)).norm(), 1e-12);
}

// Orientations, joints, defaults and solids of all kinds.
constexpr const char* kEverything = R"(<mujoco>
  <compiler angle="degree" eulerseq="XyZ"/>
  <default>
    <geom density="700"/>
    <joint axis="1 0 0" armature="0.1"/>
    <default class="heavy"><geom density="3000" type="box" size=".1 .05 .2"/>
      <default class="heavier"><geom mass="4"/><joint type="slide"/></default></default>
  </default>
  <worldbody>
    <geom type="plane" size="1 1 1"/>
    <body name="a" pos="1 2 3" euler="10 20 30">
      <freejoint/>
      <geom size=".2" pos=".1 0 0"/>
      <geom class="heavy" axisangle="1 1 0 40"/>
      <body name="b" pos=".3 0 .1" quat="1 .2 .3 -.1" childclass="heavier">
        <joint class="main" pos="0 .1 .2" axis="1 2 3" ref="25"/>
        <joint/>
        <joint type="hinge" axis="0 1 1" pos="-.1 0 0"/>
        <geom pos="0 .1 0" xyaxes="0 1 0 -1 0 1"/>
        <geom type="capsule" size=".05 .2" zaxis="1 -1 .5"/>
        <geom type="cylinder" fromto="0 0 0 .3 .2 -.1" size=".04"/>
        <body name="c" pos="0 0 .4" zaxis="0 -1 0">
          <joint type="ball" pos=".1 .2 .3"/>
          <inertial pos=".1 0 .2" mass="2" fullinertia=".3 .4 .5 .01 -.02 .03"/>
          <geom class="main" size="1"/>
          <body name="welded" pos="0 0 .1" euler="-40 0 90"><geom type="ellipsoid" size=".1 .2 .3"/></body>
        </body>
      </body>
      <body name="d" axisangle="0 0 1 90">
        <joint type="slide" axis="0 1 1" ref=".7" range="-1 1" limited="true"/>
        <inertial pos="0 .1 0" mass="1.5" diaginertia=".2 .3 .4" euler="0 0 30"/>
      </body>
    </body>
    <body name="fixed" pos="0 0 1"><geom size=".1"/>
      <body name="swing"><joint axis="0 1 0"/><geom type="box" fromto="0 0 0 0 0 -1" size=".05" group="1"/></body>
    </body>
  </worldbody>
</mujoco>)";

TEST(MjcfPeers, AgreeOnEverything) { expectSame(kEverything, parseMjcf(kEverything, "m.xml").spec); }

TEST(MjcfPeers, AgreeOnEulerOrders) {
  for (const char* order : {"xyz", "zyx", "XYZ", "xYz", "ZXz", "yXy"}) {
    std::string xml = kEverything;
    xml.replace(xml.find("XyZ"), 3, order);
    expectSame(xml, parseMjcf(xml, "m.xml").spec);
  }
}

// What the compiler does to masses.
TEST(MjcfPeers, AgreeOnMasses) {
  for (const char* attributes :
       {"inertiafromgeom='true'", "settotalmass='12'", "boundmass='3' boundinertia='.1'",
        "balanceinertia='true'", "inertiagrouprange='1 2'", "angle='radian'"}) {
    const std::string xml = std::string("<mujoco><compiler ") + attributes + R"(/><worldbody>
      <body name="a"><freejoint/><geom type="box" size=".3 .2 .1" euler=".1 .2 .3" group="1"/>
        <inertial pos="0 0 .1" mass="2" diaginertia=".3 .3 .4"/>
        <body name="b" pos="1 0 0"><joint axis="0 1 0"/><geom size=".1" group="2"/><geom size=".3" pos="0 .4 0"/>
          <body name="c"><joint axis="0 0 1"/><geom type="cylinder" size=".05 1" group="1"/></body>
        </body></body></worldbody></mujoco>)";
    SCOPED_TRACE(attributes);
    expectSame(xml, parseMjcf(xml, "m.xml").spec);
  }
}

// MuJoCo 2.2.2 does not know gravcomp: there, a force on the body carries it.
TEST(MjcfPeers, AgreeOnGravityCompensation) {
  const std::vector<std::pair<std::string, double>> shares = {
      {"a", .3}, {"b", -.4}, {"c", 1.2}, {"d", 1}, {"welded", .5}, {"swing", 2}, {"fixed", 1}};
  std::string carried = kEverything;
  for (const auto& [name, share] : shares) {
    const std::string tag = "<body name=\"" + name + "\"";
    carried.insert(carried.find(tag) + tag.size(), " gravcomp=\"" + std::to_string(share) + "\"");
  }
  const SceneSpec spec = parseMjcf(carried, "m.xml").spec;
  const Model model = compile(spec);
  MujocoPeer peer(bench::loadMujoco(kEverything), spec, model);
  for (const auto& [name, share] : shares)
    peer.push(name, {0, 0, 9.81 * share * model[model.body(name)].mass});
  Rng rng(84);
  for (int i = 0; i < 20; ++i) {
    const VectorXd q = randomPosture(rng, model), still = VectorXd::Zero(model.nv());
    peer.set(q);
    const VectorXd theirs = peer.accelerations();
    EXPECT_LT((forwardDynamics(model, q, still, still) - theirs).norm(), 1e-7 * theirs.norm());
  }
}

// MuJoCo keeps both points of a <connect>, each in its body.
TEST(MjcfPeers, AgreeOnPins) {
  std::string xml = kEverything;
  xml.insert(xml.rfind("</mujoco>"),
             "<equality><connect body1='c' body2='d' anchor='.1 .2 .3'/><connect body1='b' anchor='1 0 0'/>"
             "<connect body1='swing' body2='a' anchor='0 .5 0'/></equality>");
  const Model model = compile(parseMjcf(xml, "m.xml").spec);
  const auto theirs = bench::loadMujoco(xml);
  ASSERT_EQ(theirs->neq, 3);
  ASSERT_EQ(model.pins().size(), 3u);
  for (int k = 0; k < 3; ++k) {
    const Pin& pin = model.pins()[static_cast<std::size_t>(k)];
    const double* const points = theirs->eq_data + static_cast<std::ptrdiff_t>(mjNEQDATA) * k;
    EXPECT_LT((pin.p_AP - Eigen::Map<const Eigen::Vector3d>(points)).norm(), 1e-9) << k;
    EXPECT_LT((pin.p_BQ - Eigen::Map<const Eigen::Vector3d>(points + 3)).norm(), 1e-9) << k;
  }
}

// Three points of a <weld> keep the relative pose that MuJoCo keeps.
TEST(MjcfPeers, AgreeOnWelds) {
  std::string xml = kEverything;
  xml.insert(xml.rfind("</mujoco>"),
             "<equality><weld body1='c' body2='d'/><weld body1='b'/>"
             "<weld body1='swing' body2='a' relpose='.1 .2 .3 1 2 3 4' anchor='1 2 3'/>"
             "<weld body1='a' body2='swing' relpose='.1 .2 .3 0 0 0 0'/></equality>");
  const Model model = compile(parseMjcf(xml, "m.xml").spec);
  const auto theirs = bench::loadMujoco(xml);
  ASSERT_EQ(theirs->neq, 4);
  ASSERT_EQ(model.pins().size(), 12u);
  for (int k = 0; k < 12; ++k) {
    const Pin& pin = model.pins()[static_cast<std::size_t>(k)];
    const double* const data = theirs->eq_data + static_cast<std::ptrdiff_t>(mjNEQDATA) * (k / 3);
    // The point of body 1 that `anchor` of body 2 meets, and the quaternion.
    const Eigen::Matrix3d R = rotationFromQuaternion(Eigen::Map<const Quaternion>(data + 6));
    const Eigen::Vector3d anchor = Eigen::Map<const Eigen::Vector3d>(data),
                          there = Eigen::Map<const Eigen::Vector3d>(data + 3);
    EXPECT_LT((there + R * (pin.p_BQ - anchor) - pin.p_AP).norm(), 1e-9) << k;
  }
  const auto cornerOf = [&](int k) { return model.pins()[static_cast<std::size_t>(k)].p_BQ; };
  EXPECT_GT((cornerOf(1) - cornerOf(0)).cross(cornerOf(2) - cornerOf(0)).norm(), 0.01);
}

// Joints that follow have no coordinates here, and their own there.
TEST(MjcfPeers, AgreeOnFollowers) {
  const std::string xml =
      R"(<mujoco><compiler angle="radian"/><worldbody><body name="a"><joint name="j" ref=".3"/>
    <geom size=".1" pos="1 0 0"/><body name="b" pos="1 0 0"><joint name="k" type="slide" ref="-.1"/><geom size=".2"/>
    <body name="c"><joint name="l" axis="0 1 0"/><geom type="box" size=".1 .2 .3"/></body></body></body></worldbody>
    <equality><joint joint1="k" joint2="j" polycoef=".2 1.5 0 0 0"/><joint joint1="l" joint2="k"/></equality>
    </mujoco>)";
  const SceneSpec spec = parseMjcf(xml, "m.xml").spec;
  const Model model = compile(spec);
  ASSERT_EQ(model.nv(), 1);
  MujocoPeer peer(bench::loadMujoco(xml), spec, model);
  for (const double q : {.3, 1., -2.}) {
    const VectorXd one = VectorXd::Constant(1, q);
    peer.set(one);
    for (int body = 1; body < peer.bodies(); ++body)
      EXPECT_TRUE(
          isApprox(forwardKinematics(model, one)[model.body(peer.name(body))], peer.X_WB(body), 1e-12));
    EXPECT_NEAR(massMatrix(model, one)(0, 0), peer.massMatrix()(0, 0), 1e-9);
  }
}

// Each alone and in pairs, on joints of all kinds, two of which follow others.
TEST(MjcfPeers, AgreeOnArmaturesAndSprings) {
  const std::vector<std::string> attributes = {"armature='.7'", "stiffness='3'", "springref='.4'",
                                               "springdamper='.5 .8'", "damping='.2'"};
  for (std::size_t i = 0; i < attributes.size(); ++i)
    for (std::size_t k = i; k < attributes.size(); ++k) {
      const std::string all = " " + attributes[i] + (k == i ? "" : " " + attributes[k]) + "/>";
      const std::string xml = R"(<mujoco><worldbody>
        <body name="a" pos="1 2 3" euler="10 20 30"><joint name="f" type="free")" +
                              all +
                              R"(<geom size=".2" pos=".1 0 0"/>
          <body name="b" pos=".3 0 .1"><joint name="h" axis="1 2 3" ref="25")" +
                              all + R"(<geom type="box" size=".1 .2 .3"/>
            <body name="c" pos="0 .2 .1"><joint name="s" type="slide" axis="0 1 1" ref=".3")" +
                              all + R"(<geom type="capsule" size=".05 .2" zaxis="1 -1 .5"/>
              <body name="d" pos="0 0 .4" zaxis="0 -1 0"><joint name="q" type="ball" pos=".1 .2 .3")" +
                              all + R"(<geom size=".1"/></body></body></body></body>
        <body name="e"><joint name="k" axis="0 1 0" ref="-10")" +
                              all + R"(<geom type="box" size=".3 .1 .2" pos="1 0 0"/>
          <body name="g"><joint name="l")" +
                              all + R"(<geom size=".3" pos="0 .5 0"/></body></body></worldbody>
        <equality><joint joint1="k" joint2="h" polycoef=".2 -1.5 0 0 0"/><joint joint1="l" joint2="s"/></equality>
        </mujoco>)";
      SCOPED_TRACE(all);
      expectSame(bench::loadMujoco(xml), parseMjcf(xml, "m.xml").spec, 1e-9, 20);
    }
}

// What <attach> stands for, written out for MuJoCo 2.2.2, which does not know it.
TEST(MjcfPeers, AgreeOnAttachedModels) {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder.path() / name) << "<mujoco>" << text << "</mujoco>";
  };
  const std::string tail =
      "<geom type='box' size='.1 .2 .3' pos='0 .1 0'/><body name='@hand' pos='0 0 .4' gravcomp='0'>"
      "<joint name='@k' type='slide' axis='1 0 1'/><joint name='@l' axis='1 0 0' armature='.3'/><geom "
      "size='.1'/>"
      "<body name='@tip' pos='.1 0 0'><joint name='@m' axis='0 1 0'/><geom size='.05' pos='0 0 "
      ".1'/></body></body>";
  const auto named = [&](const std::string& text, const std::string& prefix) {
    std::string all = text;
    for (std::size_t at; (at = all.find('@')) != all.npos;) all.replace(at, 1, prefix);
    for (std::size_t at; (at = all.find(" gravcomp='0'")) != all.npos;) all.erase(at, 13);
    return all;
  };
  write("arm.xml",
        "<compiler angle='radian'/><default><joint damping='.2'/></default><worldbody><geom size='.3'/>"
        "<body name='arm' pos='1 0 0' euler='0 .5 0'><joint name='j' axis='0 1 0' ref='.2'/>" +
            named(tail, "") +
            "</body></worldbody><equality><joint joint1='m' joint2='j' polycoef='.1 2 0 0 0'/>"
            "</equality><contact><exclude body1='arm' body2='tip'/></contact>"
            "<keyframe><key name='up' qpos='.1 .2 .3 .4'/></keyframe>");
  write(
      "both.xml",
      "<asset><model name='other' file='arm.xml'/></asset><default><joint damping='9'/></default><worldbody>"
      "<body name='base' pos='1 2 3'><freejoint/><geom size='.4'/><frame pos='.1 .2 .3' euler='20 0 40'>"
      "<attach model='other' body='arm' prefix='l_'/></frame></body>"
      "<attach model='other' body='hand' prefix='h_'/><frame pos='0 0 1'><attach model='other' prefix='r_'/>"
      "</frame></worldbody><contact><exclude body1='l_tip' body2='base'/></contact>");
  const auto armAt = [&](const std::string& prefix) {
    return "<body name='" + prefix + "arm' pos='1 0 0' euler='0 28.64788975654116 0'><joint name='" + prefix +
           "j' axis='0 1 0' ref='11.459155902616464' damping='.2'/>" + named(tail, prefix) + "</body>";
  };
  const auto handIn = [&](const std::string& prefix) {
    const std::string all = named(tail, prefix);
    return all.substr(all.find("<body"));
  };
  const std::string whole =
      "<mujoco><default><joint damping='.2'/></default><worldbody>"
      "<body name='base' pos='1 2 3'><freejoint/><geom size='.4'/><body name='frame' pos='.1 .2 .3' "
      "euler='20 0 40'>" +
      armAt("l_") + "</body></body>" + handIn("h_") + "<body name='world frame' pos='0 0 1'>" + armAt("r_") +
      "</body></worldbody><equality><joint joint1='l_m' joint2='l_j' polycoef='.1 2 0 0 0'/>"
      "<joint joint1='r_m' joint2='r_j' polycoef='.1 2 0 0 0'/></equality></mujoco>";
  const SceneFile attached = readMjcf(folder.path() / "both.xml");
  EXPECT_TRUE(attached.notes.empty()) << toString(attached.notes.front());
  const Model ours = compile(attached.spec), expanded = compile(parseMjcf(whole, "m.xml").spec);
  expectSame(whole, parseMjcf(whole, "m.xml").spec);
  ASSERT_EQ(ours.nv(), expanded.nv());
  ASSERT_EQ(ours.shapes().size(), expanded.shapes().size() + 1) << "the ball of the attached world";
  Rng rng(85);
  const auto positionsOf = [](const Model& model, const Model& other, const VectorXd& q) {
    VectorXd same(other.nq());
    for (const Joint& joint : model.joints()) {
      const auto found = std::ranges::find(other.joints(), joint.name, &Joint::name);
      if (!joint.mimics && joint.nq > 0)
        same.segment(found->qIndex, joint.nq) = q.segment(joint.qIndex, joint.nq);
    }
    return same;
  };
  for (int i = 0; i < 5; ++i) {
    const VectorXd q = i == 0 ? ours.initialPositions() : randomPosture(rng, ours);
    const VectorXd there = positionsOf(ours, expanded, q);
    const BodyPoses poses = forwardKinematics(ours, q), wanted = forwardKinematics(expanded, there);
    for (const std::string body :
         {"base", "l_arm", "l_hand", "l_tip", "h_hand", "h_tip", "r_arm", "r_hand", "r_tip"})
      EXPECT_TRUE(isApprox(poses[ours.body(body)], wanted[expanded.body(body)], 1e-12)) << body;
    const Eigen::MatrixXd M = massMatrix(ours, q), N = massMatrix(expanded, there);
    EXPECT_NEAR(M.norm(), N.norm(), 1e-10);
    EXPECT_NEAR(energy(ours, q, VectorXd::Zero(ours.nv())).potential,
                energy(expanded, there, VectorXd::Zero(ours.nv())).potential, 1e-9);
  }
  std::vector<std::string> choices, postures;
  for (const CollisionChoice& choice : attached.spec.collisionChoices)
    if (choice.reason == "exclude") choices.push_back(choice.a + "-" + choice.b);
  EXPECT_EQ(choices, (std::vector<std::string>{"l_arm-l_tip", "r_arm-r_tip", "l_tip-base"}));
  for (const PostureSpec& posture : attached.spec.postures) postures.push_back(posture.name);
  EXPECT_EQ(postures, (std::vector<std::string>{"key:l_up", "key:h_up", "key:r_up"}));
  for (const JointSpec& joint : attached.spec.joints)
    EXPECT_EQ(joint.damping, positionCount(joint.type) == 1 ? .2 : 0) << joint.name;
}

// MuJoCo 2.2.2 does not know alignfree, but where the frames of inertias stand: those of a last body on a
// free joint, by one geom or several, a mesh, or given moments.
TEST(MjcfPeers, AgreeOnAlignedBodies) {
  const std::string mesh =
      "<asset><mesh name='m' vertex='0 0 0 1 0 0 0 2 0 0 0 3' scale='.1 .2 .1'/></asset>";
  for (const std::string inside :
       {"<geom type='box' size='.3 .1 .2' pos='1 2 3' euler='10 20 30'/>",
        "<geom type='box' size='.3 .1 .2' pos='1 2 3' euler='10 20 30'/><geom size='.1' pos='-.2 0 .5'/>",
        "<geom type='box' size='.1 .2 .3'/><geom type='box' size='.1 .2 .3' pos='0 0 1'/>",
        "<geom type='mesh' mesh='m' pos='1 2 3' euler='10 20 30'/>",
        "<geom type='mesh' mesh='m' pos='1 2 3' euler='10 20 30'/><geom size='.1'/>",
        "<inertial pos='.1 .2 .3' mass='2' diaginertia='.2 .4 .3' euler='40 50 60'/><geom size='.1'/>",
        "<inertial pos='.1 .2 .3' mass='2' fullinertia='.3 .4 .5 .01 -.02 .03'/>",
        "<inertial pos='.1 .2 .3' mass='2' fullinertia='.5 .4 .3 0 0 0'/>"}) {
    SCOPED_TRACE(inside);
    const double tolerance = inside.find("mesh") == inside.npos ? 1e-9 : 1e-5;  // vertices are floats there
    const auto model = [&](const std::string& compiler, const std::string& joint) {
      return "<mujoco><compiler exactmeshinertia='true'/>" + compiler + mesh +
             "<worldbody><body name='a' pos='3 2 1' euler='-10 70 5'>" + joint + inside +
             "</body></worldbody></mujoco>";
    };
    const auto theirs = bench::loadMujoco(model("", "<freejoint/>"));
    const auto placed = [](const double* p, const double* q) {
      return Pose{rotationFromQuaternion(Eigen::Map<const Quaternion>(q)),
                  Eigen::Map<const Eigen::Vector3d>(p)};
    };
    const Pose X_BI = placed(theirs->body_ipos + 3, theirs->body_iquat + 4);
    const Pose X_WI = placed(theirs->qpos0, theirs->qpos0 + 3) * X_BI;
    const Model bare = compile(parseMjcf(model("", "<freejoint/>"), "m.xml").spec);
    const std::string on = "<compiler alignfree='true'/>";
    for (const std::string& xml : {model(on, "<freejoint/>"), model(on, "<joint type='free'/>"),
                                   model("", "<freejoint align='true'/>")}) {
      const Model ours = compile(parseMjcf(xml, "m.xml").spec);
      const Pose X_WB = forwardKinematics(ours, ours.initialPositions())[ours.body("a")];
      EXPECT_TRUE(isApprox(X_WB, X_WI, tolerance));
      const Body& body = ours[ours.body("a")];
      EXPECT_EQ(body.p_BBcm, Eigen::Vector3d::Zero());
      const Eigen::Vector3d moments = Eigen::Map<const Eigen::Vector3d>(theirs->body_inertia + 3);
      EXPECT_LT((body.I_BBcm_B - Eigen::Matrix3d(moments.asDiagonal())).norm(), tolerance * moments.norm());
      for (std::size_t i = 0; i < ours.shapes().size(); ++i)
        EXPECT_TRUE(isApprox(X_BI * ours.shapes()[i].X_BS, bare.shapes()[i].X_BS, tolerance));
    }
    const Model kept = compile(parseMjcf(model(on, "<freejoint align='false'/>"), "m.xml").spec);
    EXPECT_EQ(kept.initialPositions(), bare.initialPositions());
  }
}

TEST(MjcfPeers, AgreeOnMeshes) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "brick.obj")
      << "v 0 0 0\nv 2 0 0\nv 2 4 0\nv 0 4 0\nv 0 0 6\nv 2 0 6\nv 2 4 6\nv 0 4 6\n"
         "f 1 3 2\nf 1 4 3\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\nf 3 4 8\nf 3 8 7\nf 4 1 "
         "5\nf 4 5 8\n";
  const std::string xml =
      "<mujoco><compiler meshdir='" + folder.path().string() +
      "'/><asset><mesh file='brick.obj' scale='.1 .2 -.1'/></asset><worldbody>"
      "<body name='a'><freejoint/><geom type='mesh' mesh='brick' pos='1 0 0' euler='30 0 10'/>"
      "<geom size='.1'/></body></worldbody></mujoco>";
  std::ofstream(folder.path() / "m.xml") << xml;
  expectSame(xml, readMjcf(folder.path() / "m.xml").spec, 1e-6);
}

// Meshes that stand in the model, and what moves their vertices.
TEST(MjcfPeers, AgreeOnMeshesInTags) {
  for (const std::string mesh : {"", "refpos='.1 .2 .3'", "refquat='.8 .3 -.2 .1'",
                                 "refpos='.1 .2 .3' refquat='.8 .3 -.2 .1' scale='2 2 2'",
                                 "refpos='.1 .2 .3' refquat='1 0 1 0' scale='-2 -3 4'"}) {
    const std::string xml =
        "<mujoco><compiler exactmeshinertia='true'/><asset><mesh name='m' vertex='0 0 0  1 0 0  .2 1.5 0  0 "
        ".3 .7' face='0 2 1  0 1 3  1 2 3  0 3 2' " +
        mesh +
        "/></asset><worldbody><body name='a'><freejoint/><geom type='mesh' mesh='m' pos='1 0 0' "
        "euler='30 0 10'/><geom size='.1'/></body></worldbody></mujoco>";
    SCOPED_TRACE(mesh);
    expectSame(xml, parseMjcf(xml, "m.xml").spec, 1e-5);
  }
}

// Of samples that are concave or open. Without exactmeshinertia, version 2.2.2 counts even more than later
// ones, whose numbers mjcf_reader_test.cpp has.
TEST(MjcfPeers, AgreeOnExactMeshes) {
  const TemporaryFolder folder;
  for (const bool open : {false, true}) {
    std::ofstream(folder.path() / "m.obj") << objText(trianglesOf(profileSample(open)));
    const std::string xml =
        "<mujoco><compiler exactmeshinertia='true' meshdir='" + folder.path().string() +
        "'/><asset><mesh name='m' file='m.obj' scale='.5 -.25 .125'/></asset><worldbody>"
        "<body name='a'><freejoint/><geom type='mesh' mesh='m' pos='1 0 0' euler='30 0 10'/></body>"
        "</worldbody></mujoco>";
    std::ofstream(folder.path() / "m.xml") << xml;
    expectSame(xml, readMjcf(folder.path() / "m.xml").spec, 1e-6);
  }
}

// A wedge whose principal axes are not those of its file, fitted in all ways. MuJoCo 2.2 has no fitscale.
TEST(MjcfPeers, AgreeOnFittedGeoms) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "wedge.obj")
      << "v 0 0 0\nv 2 0 0\nv 0 3 0\nv 0.5 0 5\nv 2.5 0 5\nv 0.5 3 5\n"
         "f 1 3 2\nf 4 5 6\nf 1 2 5\nf 1 5 4\nf 2 3 6\nf 2 6 5\nf 3 1 4\nf 3 4 6\n";
  for (const char* type : {"sphere", "capsule", "cylinder", "box", "ellipsoid"}) {
    const std::string xml = "<mujoco><compiler meshdir='" + folder.path().string() +
                            "'/><asset><mesh file='wedge.obj' scale='.1 .2 .1'/></asset><worldbody>"
                            "<body name='a'><freejoint/><geom type='" +
                            type + "' mesh='wedge' pos='1 0 0' euler='30 0 10'/></body></worldbody></mujoco>";
    std::ofstream(folder.path() / "m.xml") << xml;
    SCOPED_TRACE(type);
    const SceneSpec spec = readMjcf(folder.path() / "m.xml").spec;
    expectSame(xml, spec, 1e-5);
    const bench::MujocoModel peer = bench::loadMujoco(xml);
    const ShapeSpec& shape = spec.bodies.at(0).shapes.at(0);
    const Eigen::Vector3d size = Eigen::Map<const Eigen::Vector3d>(peer->geom_size),
                          &extent = shape.shape.extent;
    const std::string name = type;
    if (name == "box" || name == "ellipsoid") {
      EXPECT_LT((extent / 2 - size).norm(), 1e-5);
    } else {
      EXPECT_NEAR(shape.shape.radius, size[0], 1e-5);
    }
    if (name == "capsule" || name == "cylinder") {
      EXPECT_NEAR(extent.z() / 2, size[1], 1e-5);
    }
    EXPECT_LT((shape.X_BS.p - Eigen::Map<const Eigen::Vector3d>(peer->geom_pos)).norm(), 1e-5);
  }
}

// MuJoCo's own matrix of who touches whom, for geoms that are balls in one place.
TEST(MjcfPeers, AgreeOnContypeAndConaffinity) {
  Rng rng(91);
  for (int round = 0; round < 20; ++round) {
    std::string bodies;
    for (int i = 0; i < 5; ++i) {
      const auto bits = [&] { return std::to_string(rng.index(8)); };
      bodies += "<body name='b" + std::to_string(i) + "'><freejoint/><geom name='g" + std::to_string(i) +
                "' size='.1' contype='" + bits() + "' conaffinity='" + bits() + "'/></body>";
    }
    const std::string xml = "<mujoco><worldbody>" + bodies + "</worldbody></mujoco>";
    const bench::MujocoModel peer = bench::loadMujoco(xml);
    const std::unique_ptr<mjData, MujocoDataDeleter> data(mj_makeData(peer.get()));
    mj_forward(peer.get(), data.get());
    std::set<std::pair<int, int>> wanted, found;
    for (int i = 0; i < data->ncon; ++i)
      wanted.insert(std::minmax({data->contact[i].geom1, data->contact[i].geom2}));
    const std::vector<BodySpec> ours = parseMjcf(xml, "m.xml").spec.bodies;
    for (int i = 0; i < 5; ++i)
      for (int k = i + 1; k < 5; ++k)
        if (mayTouch(ours[static_cast<std::size_t>(i)].shapes[0].mask,
                     ours[static_cast<std::size_t>(k)].shapes[0].mask))
          found.emplace(i, k);
    EXPECT_EQ(found, wanted) << xml;
  }
}

}  // namespace rex::mjcf_test

#else

TEST(MjcfPeer, Agrees) { GTEST_SKIP() << "install libmujoco-dev to compare"; }

#endif
