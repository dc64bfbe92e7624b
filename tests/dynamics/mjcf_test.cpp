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
#include "dynamics/stepper.h"
#include "formats/mjcf_reader.h"
#include "kinematics/forward_kinematics.h"
#include "support/block_surface.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::mjcf_test {

using Eigen::VectorXd;

struct DataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

// MuJoCo's model in postures of ours. Its joints come in the order of the file, each with coordinates of its
// own: P takes our velocities to all of its.
class Peer {
 public:
  Peer(bench::MujocoModel theirs, const SceneSpec& spec, const Model& ours)
      : model_(std::move(theirs)), data_(mj_makeData(model_.get())), ours_(ours) {
    model_->opt.disableflags |= mjDSBL_CONSTRAINT;
    model_->opt.enableflags |= mjENBL_ENERGY;
    model_->opt.density = model_->opt.viscosity = 0;
    for (const JointSpec& joint : spec.joints)
      if (joint.type != JointType::kRigid) joints_.push_back(jointOf(joint.name));
    EXPECT_EQ(static_cast<int>(joints_.size()), model_->njnt);
    P_ = Eigen::MatrixXd::Zero(model_->nv, ours.nv());
    for (int k = 0; k < model_->njnt; ++k) {
      const Joint& joint = *joints_.at(static_cast<std::size_t>(k));
      P_.block(model_->jnt_dofadr[k], joint.vIndex, joint.nv, joint.nv).diagonal().setConstant(joint.ratio);
    }
  }

  VectorXd start() const {
    VectorXd q(ours_.nq());
    for (int k = 0; k < model_->njnt; ++k) {
      const Joint& joint = *joints_[static_cast<std::size_t>(k)];
      if (!joint.mimics)
        q.segment(joint.qIndex, joint.nq) =
            Eigen::Map<const VectorXd>(model_->qpos0 + model_->jnt_qposadr[k], joint.nq);
    }
    return q;
  }

  void set(const VectorXd& q) { set(q, VectorXd::Zero(ours_.nv())); }
  void set(const VectorXd& q, const VectorXd& v) {
    Eigen::Map<VectorXd>(data_->qvel, model_->nv) = P_ * v;
    for (int k = 0; k < model_->njnt; ++k) {
      const Joint& joint = *joints_[static_cast<std::size_t>(k)];
      double* at = data_->qpos + model_->jnt_qposadr[k];
      for (int i = 0; i < joint.nq; ++i)
        at[i] = joint.nq == 1 ? joint.ratio * q[joint.qIndex] + joint.offset : q[joint.qIndex + i];
    }
    mj_forward(model_.get(), data_.get());
  }

  Eigen::MatrixXd massMatrix() const {
    Eigen::MatrixXd M(model_->nv, model_->nv);
    mj_fullM(model_.get(), M.data(), data_->qM);
    return P_.transpose() * M * P_;
  }
  // Of springs and dampers.
  VectorXd passiveForces() const {
    return P_.transpose() * Eigen::Map<const VectorXd>(data_->qfrc_passive, model_->nv);
  }
  Eigen::Vector3d gravity() const { return Eigen::Map<const Eigen::Vector3d>(model_->opt.gravity); }
  double potentialEnergy() const { return data_->energy[0]; }
  double kineticEnergy() const { return data_->energy[1]; }

  int bodies() const { return model_->nbody; }
  std::string name(int body) const {
    const char* const name = mj_id2name(model_.get(), mjOBJ_BODY, body);
    return name && *name ? name : "body";
  }
  double mass(int body) const { return model_->body_mass[body]; }
  Pose X_WB(int body) const {
    Pose X;
    X.p = Eigen::Map<const Eigen::Vector3d>(data_->xpos + 3 * body);
    X.R = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data_->xmat + 9 * body);
    return X;
  }

 private:
  const Joint* jointOf(const std::string& name) const {
    const auto found = std::find_if(ours_.joints().begin(), ours_.joints().end(),
                                    [&](const Joint& joint) { return joint.name == name; });
    return &*found;
  }

  bench::MujocoModel model_;
  std::unique_ptr<mjData, DataDeleter> data_;
  const Model& ours_;
  std::vector<const Joint*> joints_;
  Eigen::MatrixXd P_;
};

VectorXd randomPositions(Rng& rng, const Model& model) {
  VectorXd q = rng.normalVector(model.nq());
  for (const Joint& joint : model.joints())
    if (joint.nq > joint.nv) q.segment<4>(joint.qIndex + joint.nq - 4).normalize();
  return q;
}

void expectNear(double ours, double theirs, double tolerance) {
  EXPECT_NEAR(ours, theirs, tolerance * std::max(1., std::abs(theirs)));
}

void expectSame(bench::MujocoModel loaded, const SceneSpec& spec, double tolerance = 1e-9, int postures = 5) {
  const Model model = compile(spec);
  Peer peer(std::move(loaded), spec, model);
  EXPECT_LT((model.initialPositions() - peer.start()).norm(), 1e-12);
  for (int body = 1; body < peer.bodies(); ++body)
    EXPECT_NEAR(model[model.body(peer.name(body))].mass, peer.mass(body), tolerance * peer.mass(body))
        << peer.name(body);
  Rng rng(83);
  for (int i = 0; i < postures; ++i) {
    const VectorXd q = i == 0 ? model.initialPositions() : randomPositions(rng, model);
    const VectorXd v = rng.normalVector(model.nv());
    peer.set(q, v);
    const BodyPoses poses = forwardKinematics(model, q);
    for (int body = 1; body < peer.bodies(); ++body)
      EXPECT_TRUE(isApprox(poses[model.body(peer.name(body))], peer.X_WB(body), 1e-9)) << peer.name(body);
    if (model.nv() == 0) continue;
    const Eigen::MatrixXd theirs = peer.massMatrix();
    EXPECT_LE((massMatrix(model, q) - theirs).cwiseAbs().maxCoeff(),
              tolerance * theirs.cwiseAbs().maxCoeff());
    // At such speeds friction is none.
    const VectorXd forces = jointForces(model, q, v, {.friction = true, .frictionSpeed = 1e300});
    EXPECT_LE((forces - peer.passiveForces()).norm(), tolerance * peer.passiveForces().norm());
    const Energy ours = energy(model, q, v, peer.gravity());
    expectNear(ours.potential, peer.potentialEnergy(), tolerance);
    expectNear(ours.kinetic, peer.kineticEnergy(), tolerance);
  }
}

void expectSame(const std::string& xml, const SceneSpec& spec, double tolerance = 1e-9) {
  expectSame(bench::loadMujoco(xml), spec, tolerance);
}

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
  Peer peer(bench::loadMujoco(xml), spec, model);
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
    const std::unique_ptr<mjData, DataDeleter> data(mj_makeData(peer.get()));
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
