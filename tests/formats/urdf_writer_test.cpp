#include "formats/urdf_writer.h"

#include <algorithm>
#include <map>
#include <span>

#include <gtest/gtest.h>

#include "formats/ors_reader.h"
#include "formats/urdf_reader.h"
#include "kinematics/forward_kinematics.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/random_scene.h"
#include "support/temporary_folder.h"
#include "support/urdf_samples.h"

namespace rex::urdf_writer_test {

constexpr double kTolerance = 1e-12;

// The names of the joints that stand for the coordinates of one.
std::vector<std::string> partsOf(const Joint& joint) {
  const std::map<JointType, std::vector<std::string>> suffixes = {
      {JointType::kCylindrical, {"_turn", "_slide"}}, {JointType::kPlanarXY, {"_x", "_y"}},
      {JointType::kTranslation3, {"_x", "_y", "_z"}}, {JointType::kPlanarPhiXY, {"_phi", "_x", "_y"}},
      {JointType::kUniversal, {"_x", "_y"}},
  };
  const auto found = suffixes.find(joint.type);
  if (found == suffixes.end()) return {joint.name};
  std::vector<std::string> names;
  for (const std::string& suffix : found->second) names.push_back(joint.name + suffix);
  return names;
}

// The posture q of one model as one of another, whose joints have the same names or are parts.
Eigen::VectorXd carried(const Model& from, const Eigen::VectorXd& q, const Model& to) {
  std::map<std::string, const Joint*> byName;
  for (const Joint& joint : to.joints()) byName[joint.name] = &joint;
  Eigen::VectorXd result = Eigen::VectorXd::Constant(to.nq(), 77);
  for (const Joint& joint : from.joints()) {
    if (joint.mimics) continue;
    int at = joint.qIndex;
    if (joint.nq == 0) continue;
    for (const std::string& name : partsOf(joint)) {
      const Joint* part = byName.at(name);
      result.segment(part->qIndex, part->nq) = q.segment(at, part->nq);
      at += part->nq;
    }
  }
  return result;
}

void expectSame(const SceneSpec& first, const SceneSpec& second) {
  const Model a = compile(first), b = compile(second);
  ASSERT_EQ(a.nq(), b.nq());
  Rng rng(71);
  for (int i = 0; i < 5; ++i) {
    const Eigen::VectorXd q = randomPositions(rng, a.nq());
    const BodyPoses posesA = forwardKinematics(a, q), posesB = forwardKinematics(b, carried(a, q, b));
    for (const Body& body : a.bodies())
      EXPECT_TRUE(isApprox(posesA[a.body(body.name)], posesB[b.body(body.name)], kTolerance)) << body.name;
  }
  EXPECT_NEAR(a.mass(), b.mass(), kTolerance);
  for (const Body& body : std::span(a.bodies()).subspan(1)) {
    const Body& other = b[b.body(body.name)];
    EXPECT_EQ(body.mass, other.mass);
    if (body.mass == 0) continue;
    EXPECT_LE((body.p_BBcm - other.p_BBcm).norm(), kTolerance) << body.name;
    EXPECT_LE((body.I_BBcm_B - other.I_BBcm_B).cwiseAbs().maxCoeff(), kTolerance) << body.name;
  }
}

// The joints of one model that have coordinates, and those of another that stand first for them, in q order.
void expectSameOrder(const SceneSpec& first, const SceneSpec& second) {
  const Model a = compile(first), b = compile(second);
  std::vector<std::string> wanted, found;
  for (const Joint& joint : a.joints())
    if (joint.nq > 0 && !joint.mimics) wanted.push_back(partsOf(joint).front());
  for (const Joint& joint : b.joints())
    if (std::find(wanted.begin(), wanted.end(), joint.name) != wanted.end()) found.push_back(joint.name);
  EXPECT_EQ(found, wanted);
}

SceneSpec again(const SceneSpec& spec) { return parseUrdf(writeUrdf(spec).text, "again").spec; }

std::vector<std::string> notesOf(const SceneSpec& spec) {
  std::vector<std::string> notes;
  for (const Diagnostic& note : writeUrdf(spec).notes) notes.push_back(note.message);
  return notes;
}

// Robots of URDF come back whole: no link is added, nothing is noted.
void expectWhole(const std::string& text) {
  const SceneSpec spec = parseUrdf(text, "r.urdf").spec;
  const UrdfText written = writeUrdf(spec);
  EXPECT_TRUE(written.notes.empty()) << toString(written.notes.front());
  const SceneFile read = parseUrdf(written.text, "again.urdf");
  EXPECT_TRUE(read.notes.empty()) << toString(read.notes.front());
  ASSERT_EQ(read.spec.bodies.size(), spec.bodies.size());
  ASSERT_EQ(read.spec.joints.size(), spec.joints.size());
  for (std::size_t i = 0; i < spec.bodies.size(); ++i) {
    ASSERT_EQ(read.spec.bodies[i].shapes.size(), spec.bodies[i].shapes.size()) << spec.bodies[i].name;
    for (std::size_t s = 0; s < spec.bodies[i].shapes.size(); ++s) {
      const ShapeSpec &a = spec.bodies[i].shapes[s], &b = read.spec.bodies[i].shapes[s];
      EXPECT_EQ(a.name, b.name);
      EXPECT_TRUE(isApprox(a.X_BS, b.X_BS, kTolerance));
      EXPECT_EQ(a.shape.type, b.shape.type);
      EXPECT_EQ(a.shape.extent, b.shape.extent);
      EXPECT_EQ(a.shape.radius, b.shape.radius);
      EXPECT_EQ(a.meshFile, b.meshFile);
      EXPECT_EQ(a.meshScale, b.meshScale);
      EXPECT_EQ(a.visible, b.visible);
      EXPECT_EQ(a.contact, b.contact);
      EXPECT_EQ(a.visible ? a.color : b.color, b.color);
    }
  }
  for (std::size_t i = 0; i < spec.joints.size(); ++i) {
    const JointSpec &a = spec.joints[i], &b = read.spec.joints[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.type, b.type);
    EXPECT_EQ(a.lower, b.lower);
    EXPECT_EQ(a.upper, b.upper);
    EXPECT_EQ(a.maxVelocity, b.maxVelocity);
    EXPECT_EQ(a.maxEffort, b.maxEffort);
    EXPECT_EQ(a.damping, b.damping);
    EXPECT_EQ(a.friction, b.friction);
    EXPECT_EQ(a.mimic, b.mimic);
  }
  expectSame(spec, read.spec);
}

TEST(UrdfWriter, KeepsATrickyRobot) { expectWhole(kTrickyRobot); }

TEST(UrdfWriter, KeepsAllKindsOfJointsAndShapes) {
  const std::string ends = "<parent link='a'/><child link='b'/>";
  for (const std::string type : {"fixed", "floating", "planar", "continuous"}) {
    expectWhole("<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='" + type + "'>" +
                ends + "<origin xyz='1 2 3' rpy='.1 .2 .3'/><axis xyz='1 -2 .5'/></joint></robot>");
  }
  expectWhole(
      "<robot name='r'><link name='Kn\xc3\xb6&lt;&amp;&gt;&quot;&#10;'>"
      "<visual name='v'><origin xyz='1 0 0' rpy='0 1.5707963 .3'/><geometry><box size='.1 .2 .3'/></geometry>"
      "<material name='m'><color rgba='.1 .2 .3 .4'/></material></visual>"
      "<collision><geometry><cylinder radius='.1' length='.2'/></geometry></collision>"
      "<visual><geometry><sphere radius='.1'/></geometry></visual>"
      "<visual><geometry><mesh filename='package://p/m.stl' scale='1 -2 "
      "3'/></geometry></visual></link></robot>");
}

TEST(UrdfWriter, KeepsAllFiles) {
  const auto files = urdfFiles();
  if (files.empty()) GTEST_SKIP() << "no .urdf file in data/ and ../shared/data/urdf";
  for (const std::filesystem::path& file : files) {
    SCOPED_TRACE(file.filename());
    const SceneSpec spec = parseUrdf(fileText(file), file.string()).spec;
    expectSame(spec, again(spec));
  }
}

TEST(UrdfWriter, KeepsOrsScenes) {
  for (const std::string name : {"man", "pegArm", "pegInAHole"}) {
    SCOPED_TRACE(name);
    const SceneSpec spec = readOrs(sourcePath("data/robots/" + name + ".ors")).spec, read = again(spec);
    expectSame(spec, read);
    expectSameOrder(spec, read);
    for (const JointSpec& joint : spec.joints) {
      const auto same = [&](const JointSpec& other) { return other.name == joint.name; };
      const auto found = std::find_if(read.joints.begin(), read.joints.end(), same);
      ASSERT_NE(found, read.joints.end()) << joint.name;
      if (positionCount(joint.type) != 1) continue;
      EXPECT_EQ(found->lower, joint.lower) << joint.name;
      EXPECT_EQ(found->upper, joint.upper) << joint.name;
      EXPECT_EQ(found->damping, joint.damping) << joint.name;
      EXPECT_EQ(found->mimic, joint.mimic) << joint.name;
      EXPECT_EQ(found->mimicRatio, joint.mimicRatio) << joint.name;
      EXPECT_EQ(found->mimicOffset, joint.mimicOffset) << joint.name;
    }
  }
}

SceneSpec randomUrdfScene(Rng& rng, int bodies) {
  SceneSpec spec = randomScene(rng, bodies);
  for (JointSpec& joint : spec.joints)
    if (joint.type == JointType::kBall) joint.type = JointType::kHinge;
  replaceCones(spec);
  return spec;
}

TEST(UrdfWriter, KeepsRandomScenes) {
  Rng rng(72);
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    SceneSpec spec = randomUrdfScene(rng, 2 + 2 * i);
    if (i % 2 == 0) spec.bodies[0].X_WB = Pose{};
    if (i % 3 == 0)
      for (JointSpec& joint : spec.joints) joint.X_MC.p.setZero();
    expectSame(spec, again(spec));
    expectSame(spec, again(again(spec)));
    expectSameOrder(spec, again(spec));
  }
}

TEST(UrdfWriter, KeepsMimicsOfAllTypes) {
  Rng rng(73);
  for (const JointType type : kAllJointTypes) {
    const bool isWhole = type == JointType::kPlanarXYPhi || type == JointType::kFree;
    if (isWhole || type == JointType::kBall || type == JointType::kRigid) continue;
    SCOPED_TRACE(static_cast<int>(type));
    SceneSpec spec = randomUrdfScene(rng, 3);
    for (JointSpec& joint : spec.joints) joint.type = type;
    spec.joints[0].mimic = spec.joints[1].name;
    if (positionCount(type) == 1) spec.joints[0].mimicRatio = -2, spec.joints[0].mimicOffset = .3;
    expectSame(spec, again(spec));
  }
}

// Only one of two branches has a joint that needs a link, and only the one whose joint is moved waits for it.
TEST(UrdfWriter, KeepsTheOrderOfCoordinates) {
  const SceneSpec spec = parseOrs(
                             "body a {}\nbody b {}\nbody c {}\nbody d {}\nbody e {}\nbody f {}\n"
                             "joint ab (a b) { B=<T t(0 1 0)> }\njoint ac (a c) {}\njoint af (a f) {}\n"
                             "joint bd (b d) {}\njoint ce (c e) {}",
                             "f")
                             .spec;
  const SceneSpec read = again(spec);
  expectSame(spec, read);
  expectSameOrder(spec, read);
  EXPECT_EQ(read.bodies.size(), 8u);
}

TEST(UrdfWriter, NumbersBodiesOfOneName) {
  const SceneSpec spec = parseOrs("body a {}\nbody a {}\nbody a_2 {}\nbody a {}", "f").spec;
  const UrdfText text = writeUrdf(spec);
  ASSERT_EQ(text.notes.size(), 1u);
  EXPECT_EQ(toString(text.notes[0]), "f:2:1: note: bodies whose name was taken got a number: 2, first 'a'");
  std::vector<std::string> names;
  for (const BodySpec& body : again(spec).bodies) names.push_back(body.name);
  EXPECT_EQ(names, (std::vector<std::string>{"a", "a_3", "a_2", "a_4"}));
}

// Joints only add a link where their frame on the child cannot move to the parent's side.
TEST(UrdfWriter, AddsLinksOnlyWhereItMust) {
  const auto count = [](JointType type, const Pose& X_MC) {
    SceneSpec spec;
    spec.bodies = {{.name = "a", .X_WB = {}}, {.name = "b", .X_WB = {}}};
    JointSpec joint;
    joint.name = "j";
    joint.parent = "a";
    joint.child = "b";
    joint.type = type;
    joint.axis = Eigen::Vector3d::UnitX();
    joint.X_MC = X_MC;
    spec.joints = {joint};
    expectSame(spec, again(spec));
    return again(spec).bodies.size();
  };
  const Pose turned = rotation(.3, {1, 2, 3}), alongX = translation(1, 0, 0), alongY = translation(0, 1, 0);
  EXPECT_EQ(count(JointType::kHinge, turned), 2u);
  EXPECT_EQ(count(JointType::kHinge, alongX * turned), 2u);
  EXPECT_EQ(count(JointType::kHinge, alongY), 3u);
  EXPECT_EQ(count(JointType::kSlider, alongY * turned), 2u);
  EXPECT_EQ(count(JointType::kRigid, alongY * turned), 2u);
  EXPECT_EQ(count(JointType::kPlanarXYPhi, rotation(.3, {1, 2, 0})), 2u);
  EXPECT_EQ(count(JointType::kPlanarXYPhi, turned), 3u);
  EXPECT_EQ(count(JointType::kFree, turned), 3u);
  EXPECT_EQ(count(JointType::kUniversal, Pose{}), 3u);
}

TEST(UrdfWriter, GivesPartsOfJointsTheirLimits) {
  const SceneSpec spec =
      parseOrs("body a {}\nbody b {}\njoint j (a b) { type=trans3 limits=[-1 1 -2 2 -3 3] }", "f").spec;
  const Model model = compile(again(spec));
  EXPECT_EQ(model.lowerLimits(), Eigen::Vector3d(-1, -2, -3));
  EXPECT_EQ(model.upperLimits(), Eigen::Vector3d(1, 2, 3));
}

TEST(UrdfWriter, HangsSeveralRootsOnTheWorld) {
  const SceneSpec spec =
      parseOrs(
          "body a { X=<T t(1 2 3)> type=1 size=[0 0 0 .5] }\nbody b { X=<T d(30 1 1 0)> }\n"
          "shape floor { type=0 size=[1 1 .1 0] }",
          "f")
          .spec;
  const SceneSpec read = again(spec);
  EXPECT_EQ(read.bodies.size(), 2u);
  ASSERT_EQ(read.worldShapes.size(), 1u);
  EXPECT_EQ(read.worldShapes[0].name, "floor");
  expectSame(spec, read);
  EXPECT_EQ(again(parseUrdf("<robot name='r'><link name='a'/></robot>", "f", {.freeBase = true}).spec)
                .joints.at(0)
                .name,
            "world>a");
  EXPECT_NE(writeUrdf(SceneSpec{}).text.find("<link name=\"world\">"), std::string::npos);
}

TEST(UrdfWriter, FindsFreeNames) {
  const SceneSpec spec =
      parseOrs(
          "body a {}\nbody b {}\nbody b_joint {}\nbody j_x {}\njoint j (a b) { type=universal "
          "B=<T t(1 2 3)> }\njoint j_x (a b_joint) {}\njoint b_joint_ (a j_x) {}",
          "f")
          .spec;
  const Model model = compile(again(spec));
  EXPECT_EQ(model.nq(), 4);
  EXPECT_EQ(model.bodies().size(), 7u);  // world, four of ours, two of the chain
}

TEST(UrdfWriter, KeepsCountOfEachName) {
  const SceneSpec spec =
      parseOrs("body a {}\nbody a {}\nbody a_2 {}\nbody a_4 {}\nbody a {}\nbody a_2 {}\nbody a {}", "f").spec;
  std::vector<std::string> names;
  for (const BodySpec& body : again(spec).bodies) names.push_back(body.name);
  EXPECT_EQ(names, (std::vector<std::string>{"a", "a_3", "a_2", "a_4", "a_5", "a_2_2", "a_6"}));
}

TEST(UrdfWriter, BuildsCapsulesOfThreeSolids) {
  const SceneSpec spec =
      parseOrs("body a { type=2 size=[0 0 1 .1] contact }\nbody b { type=2 size=[0 0 0 .1] }", "f").spec;
  const SceneSpec read = again(spec);
  const std::vector<ShapeSpec>& shapes = read.bodies.at(0).shapes;
  ASSERT_EQ(shapes.size(), 6u);
  EXPECT_EQ(shapes[0].shape.type, ShapeType::kCylinder);
  EXPECT_EQ(shapes[0].shape.extent.z(), 1);
  EXPECT_EQ(shapes[1].shape.radius, .1);
  EXPECT_EQ(shapes[1].X_BS.p.z(), .5);
  EXPECT_EQ(shapes[2].X_BS.p.z(), -.5);
  EXPECT_TRUE(shapes[5].contact && !shapes[5].visible);
  EXPECT_EQ(read.bodies.at(1).shapes.size(), 1u);
}

TEST(UrdfWriter, NamesMeshesRelativeToTheFolder) {
  const TemporaryFolder folder;
  ShapeSpec shape{.name = "s", .X_BS = {}, .shape = {.type = ShapeType::kMesh}};
  shape.meshFile = "../m.stl";
  SceneSpec spec;
  spec.bodies.push_back({.name = "a", .X_WB = {}, .shapes = {shape}});
  const auto fileOf = [&](const std::filesystem::path& to) {
    return parseUrdf(writeUrdf(spec, to).text, "f").spec.bodies.at(0).shapes.at(0).meshFile;
  };
  EXPECT_EQ(fileOf(folder.path() / "robots"), "../m.stl");
  spec.bodies[0].shapes[0].meshPath = folder.path() / "meshes" / "m.stl";
  EXPECT_EQ(fileOf(folder.path() / "robots"), "../meshes/m.stl");
  spec.bodies[0].shapes[0].shape.type = ShapeType::kBox;
  spec.bodies[0].shapes[0].meshMissing = true;
  EXPECT_EQ(fileOf(folder.path() / "robots"), "../meshes/m.stl");
  EXPECT_EQ(fileOf({}), spec.bodies[0].shapes[0].meshPath.string());
}

TEST(UrdfWriter, NotesWhatUrdfCannotSay) {
  using Notes = std::vector<std::string>;
  const auto ors = [](const std::string& text) { return parseOrs(text, "f").spec; };
  const auto shape = [&](const std::string& attributes) {
    return notesOf(ors("body a { " + attributes + " }"));
  };
  EXPECT_EQ(shape("type=9 size=[1 1 1 .1]"), Notes{"rounded boxes became boxes: 'a'"});
  EXPECT_EQ(shape("type=2 size=[0 0 1 .1]"), Notes{"capsules became cylinders and spheres: 'a'"});
  EXPECT_EQ(shape("type=2 size=[0 0 1 .1] contact"),
            (Notes{"bodies within four generations may collide when the file is read again: 'a'",
                   "capsules became cylinders and spheres: 'a'"}));
  EXPECT_EQ(shape("type=5 size=[1 1 1 0]"), Notes{"markers are left out: 'a'"});
  EXPECT_EQ(shape("type=7 mesh='a.obj'"), Notes{"point clouds are left out: 'a'"});
  EXPECT_EQ(shape("type=8 mesh='a.obj'"), Notes{"sphere-swept meshes became meshes: 'a'"});
  EXPECT_EQ(shape("type=3"), Notes{"meshes without a file are left out: 'a'"});
  EXPECT_EQ(shape("type=1 size=[1 1 1 0]"), Notes{"shapes without size are left out: 'a'"});
  EXPECT_EQ(notesOf(ors("body a { static }\nbody b { kinematic }")),
            Notes{"kinds of bodies are left out: 2, first 'a'"});
  EXPECT_EQ(notesOf(ors("body a { mass=1 buoyancy=1 }")), Notes{"buoyancies of bodies are left out: 'a'"});
  SceneSpec hidden = ors("body a { type=1 size=[0 0 0 1] }");
  hidden.bodies[0].shapes[0].visible = false;
  EXPECT_EQ(notesOf(hidden), Notes{"shapes neither drawn nor touched are left out: 'a'"});

  const auto joint = [&](const std::string& attributes) {
    return notesOf(ors("body a {}\nbody b {}\njoint j (a b) { " + attributes + " }"));
  };
  EXPECT_EQ(joint("q=1"), Notes{"initial coordinates are left out: 'j'"});
  EXPECT_EQ(joint("armature=1 stiffness=2"),
            (Notes{"armatures of joints are left out: 'j'", "springs of joints are left out: 'j'"}));
  EXPECT_EQ(joint("type=transX"), Notes{"missing limits became 1e9: 4, first 'j'"});
  EXPECT_EQ(joint("type=transXYPhi limits=[0 1 0 1 0 1]"),
            Notes{"limits of planar and free joints are left out: 'j'"});
  EXPECT_EQ(joint("type=universal"), Notes{"joints of types that URDF lacks became chains: 'j'"});
  EXPECT_EQ(joint("q=0"), Notes{});
  const UrdfText text = writeUrdf(ors("body a {}\nbody b {}\njoint j (a b) { q=1 }"));
  EXPECT_EQ(toString(text.notes.at(0)), "f:3:1: note: initial coordinates are left out: 'j'");
}

TEST(UrdfWriter, SaysWhatItCannotWrite) {
  const auto ors = [](const std::string& text) { return parseOrs(text, "f").spec; };
  SceneSpec unplaced;
  EXPECT_REX_ERROR(writeUrdf(ors("body a {}\nbody b {}\nbody c {}\njoint j (a b) {}\njoint j (a c) {}")),
                   "f:5:1: two joints 'j': wanted a name of its own: the first is at f:4:1");
  unplaced.bodies = {{.name = "", .X_WB = {}}};
  EXPECT_REX_ERROR(writeUrdf(unplaced), "a body without a name: wanted a name");
  unplaced.bodies = {{.name = "a\x01", .X_WB = {}}};
  EXPECT_REX_ERROR(writeUrdf(unplaced),
                   "a name in URDF: found 'a\\x01', wanted characters that XML allows, in UTF-8");
  unplaced.bodies = {{.name = "Kn\xf6"
                              "chel",
                      .X_WB = {}}};
  EXPECT_REX_ERROR(writeUrdf(unplaced), "wanted characters that XML allows, in UTF-8");
  EXPECT_REX_ERROR(writeUrdf(ors("body a {}\nbody b {}\njoint j (a b) { type=quatBall }")),
                   "f:3:1: joint 'j': URDF has no ball joint: wanted three hinges, for example");
  EXPECT_REX_ERROR(writeUrdf(ors("body a {}\nshape s (a) { type=ST_cone size=[0 0 1 .3] }")),
                   "f:2:33: shape 's': found a cone, which URDF lacks, wanted a cylinder or a mesh");
  EXPECT_REX_ERROR(writeUrdf(ors("body a {}\nbody b {}\nbody c {}\njoint j (a b) { type=free }\n"
                                 "joint k (b c) { type=free mimic=j }")),
                   "f:5:1: joint 'k': URDF has no mimic of joints with several coordinates: wanted none");
  EXPECT_REX_ERROR(writeUrdf(ors("body a {}\nbody b {}\njoint j (a b) {}\njoint k (b a) {}")),
                   "joints form a loop");
}

TEST(UrdfWriter, RefusesWhatItsReaderRefuses) {
  const auto chains = [](int count) {
    std::string text = "body a {}\n";
    for (int i = 0; i < count; ++i) {
      const std::string name = "b" + std::to_string(i);
      text += "body " + name + " {}\njoint (a " + name + ") { type=universal }\n";
    }
    return parseOrs(text, "f").spec;
  };
  EXPECT_EQ(again(chains(500)).joints.size(), 1000u);
  EXPECT_REX_ERROR(
      writeUrdf(chains(501)),
      "written as .urdf, it could not be read back: <robot>: too many <joint>: found 1002, wanted at most "
      "1000");
  const std::string longest(254, 'b');
  EXPECT_REX_ERROR(
      writeUrdf(
          parseOrs("body a {}\nbody " + longest + " {}\njoint j (a " + longest + ") { B=<T t(1 2 3)> }", "f")
              .spec),
      "written as .urdf, it could not be read back: <link>: attribute 'name': found 260 bytes, wanted at "
      "most 256");
}

}  // namespace rex::urdf_writer_test
