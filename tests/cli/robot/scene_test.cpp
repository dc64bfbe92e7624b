// `rex scene` as a user meets it.
#include <algorithm>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/rex_command.h"
#include "dynamics/energy.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/forward_dynamics.h"
#include "formats/scene_file.h"
#include "geometry/rotation.h"
#include "kinematics/jacobians.h"
#include "render/image.h"
#include "support/file_text.h"
#include "support/needs_osmesa.h"

namespace rex::cli::scene_test {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kArm =
    "body post { X=<T t(0 0 1)> type=ST_box size=[.1 .1 2] }\n"
    "body upper { mass=2 type=ST_capsule size=[0 0 .4 .05] contact }\n"
    "body lower { mass=1 }\n"
    "shape tip (lower) { type=ST_sphere size=[0 0 0 .1] hidden contact }\n"
    "joint shoulder (post upper) { type=hingeY A=<T t(0 0 1)> B=<T t(0 0 .2)> q=0.25 limits=[-2 2] }\n"
    "joint elbow (upper lower) { type=universal A=<T t(0 0 .2)> }\n";

class SceneCommand : public RexCommand {
 protected:
  void SetUp() override { std::ofstream(in("arm.ors")) << kArm; }
  json jsonOf(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "scene");
    arguments.push_back("--json");
    const ProcessResult result = rex(arguments);
    EXPECT_EQ(result.exitCode, 0) << result.error;
    return json::parse(result.output);
  }
  ProcessResult scene(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "scene");
    return rex(arguments);
  }
};

TEST_F(SceneCommand, InfoListsJointsBodiesAndMass) {
  const json info = jsonOf({"arm.ors", "info"});
  EXPECT_EQ(info["ndof"], 3);
  EXPECT_EQ(info["mass"], 3.0);
  EXPECT_EQ(info["bodies"], json({"post", "upper", "lower"}));
  EXPECT_EQ(info["joints"].size(), 2u);
  const json& elbow = info["joints"][1];
  EXPECT_EQ(elbow["name"], "elbow");
  EXPECT_EQ(elbow["from"], "upper");
  EXPECT_EQ(elbow["to"], "lower");
  EXPECT_EQ(elbow["type"], "universal");
  EXPECT_EQ(elbow["q_index"], 1);
  EXPECT_EQ(elbow["dim"], 2);
  EXPECT_EQ(elbow["low"], json({nullptr, nullptr}));
  EXPECT_EQ(info["joints"][0]["high"], json({2.0}));
  EXPECT_EQ(info["q"], json({0.25, 0.0, 0.0}));
  EXPECT_EQ(info["shapes"][2]["visible"], false);
}

TEST_F(SceneCommand, InfoTellsWhatAJointMimics) {
  std::ofstream(in("mimic.ors"))
      << "body a {}\nbody b {}\nbody c {}\nbody d {}\nbody e {}\njoint j (a b) { type=rigid }\n"
         "joint k (b c) { mimic=j }\njoint l (c d) { limits=[-1 2] }\n"
         "joint m (d e) { mimic=l mimic_ratio=2 mimic_offset=0.5 }\n";
  const json joints = jsonOf({"mimic.ors", "info"})["joints"];
  EXPECT_EQ(joints[1]["mimics"], nullptr) << "rigid: it has nothing to share";
  EXPECT_EQ(joints[2]["mimics"], nullptr);
  EXPECT_EQ(joints[3]["mimics"], json({{"joint", "l"}, {"ratio", 2.0}, {"offset", 0.5}}));
  EXPECT_EQ(joints[3]["low"], json({-1.0})) << "of the joint that it follows";
  EXPECT_EQ(joints[3]["high"], json({2.0}));
}

TEST_F(SceneCommand, InfoShowsTheTreeToPeople) {
  const ProcessResult result = scene({"arm.ors", "info"});
  EXPECT_THAT(result.output, HasSubstr("arm.ors: 3 bodies, 2 joints, 3 degrees of freedom, 3 shapes, 3 kg"));
  EXPECT_THAT(result.output, HasSubstr("    upper    2   shoulder  q0\n"));
  EXPECT_THAT(result.output, HasSubstr("lower  -        sphere\n"));
  EXPECT_THAT(result.output, HasSubstr("0  shoulder  hinge      0.25   -2   2"));
  EXPECT_EQ(scene({"arm.ors"}).output, result.output) << "what it does without a command";
}

TEST_F(SceneCommand, InfoShowsPinsAndSaysWhoKeepsThem) {
  std::ofstream(in("loop.ors"))
      << "body a {}\nbody b {}\njoint (world a) {}\njoint (world b) { A=<T t(0 0 .5)> }\n"
         "pin (a b) { A=[0 0 .4] }\n";
  const ProcessResult result = scene({"loop.ors"});
  EXPECT_THAT(result.output, HasSubstr("pin  at       to  at     gap at the start, m\n"
                                       "a    0 0 0.4  b   0 0 0  0.1\n"));
  EXPECT_THAT(result.error, HasSubstr("pins close loops here: Bullet keeps them closed"));
  const ProcessResult run =
      rex({"simulate", "loop.ors", "--engine", "bullet", "--seconds", "0.01", "--no-film", "-o", "o"});
  EXPECT_THAT(run.error, HasSubstr("pins are open at the start, pulled together at 1 m/s at most:"));
  const json pins = jsonOf({"loop.ors", "info"})["pins"];
  ASSERT_EQ(pins.size(), 1u);
  EXPECT_EQ(pins[0]["b"], "b");
  EXPECT_EQ(pins[0]["p_AP"], json({0.0, 0.0, 0.4}));
  EXPECT_NEAR(pins[0]["gap"].get<double>(), 0.1, 1e-15);
}

TEST_F(SceneCommand, FkAndJacobianAreThoseOfTheLibrary) {
  const Model model = compile(readScene(in("arm.ors")).spec);
  const Eigen::Vector3d q(0.1, -0.7, 1e-8);
  const BodyPoses poses = forwardKinematics(model, q);
  const json fk = jsonOf({"arm.ors", "fk", "--q", "0.1,-0.7,1e-8"});
  EXPECT_EQ(fk["q"], json({0.1, -0.7, 1e-8}));
  ASSERT_EQ(fk["bodies"].size(), 3u);
  for (const json& body : fk["bodies"]) {
    const Pose& X = poses[model.body(body["name"].get<std::string>())];
    const Quaternion quaternion = quaternionFromRotation(X.R);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(body["pos"][i], X.p[i]);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(body["quat_wxyz"][i], quaternion[i]);
  }
  const json J =
      jsonOf({"arm.ors", "jacobian", "--body", "lower", "--point", "0,0.1,0.2", "--q", "0.1,-0.7,1e-8"});
  const BodyId lower = model.body("lower");
  const Eigen::Matrix3Xd pos = positionJacobian(model, poses, lower, {0, 0.1, 0.2});
  const Eigen::Matrix3Xd rot = angularJacobian(model, poses, lower);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      EXPECT_EQ(J["pos"][row][column], pos(row, column));
      EXPECT_EQ(J["rot"][row][column], rot(row, column));
    }
  }
}

constexpr const char* kWall =
    "body wall { type=ST_box size=[.2 2 2] contact }\n"
    "shape (wall) { rel=<T t(0 0 1.5)> type=ST_box size=[.2 2 1] contact }\n"
    "body post { X=<T t(1 0 0)> }\n"
    "body ball { type=ST_sphere size=[0 0 0 .1] contact }\n"
    "joint slide (post ball) { type=transX }\n";

TEST_F(SceneCommand, ContactsAreThoseOfGeometry) {
  std::ofstream(in("wall.ors")) << kWall;
  const json contacts = jsonOf({"wall.ors", "contacts", "--q", "-0.75", "--margin", "0.2"});
  EXPECT_DOUBLE_EQ(contacts["cost"].get<double>(), 1 - (0.25 - 0.1 - 0.1) / 0.2);
  ASSERT_EQ(contacts["pairs"].size(), 1u) << "the upper part of the wall is a metre away";
  const json& pair = contacts["pairs"][0];
  EXPECT_EQ(pair["a"], "wall");
  EXPECT_EQ(pair["b"], "ball");
  EXPECT_NEAR(pair["distance"].get<double>(), 0.05, 1e-12);
  EXPECT_NEAR(pair["pa"][0].get<double>(), 0.1, 1e-12);
  EXPECT_NEAR(pair["pb"][0].get<double>(), 0.15, 1e-12);
  EXPECT_NEAR(jsonOf({"wall.ors", "contacts", "--q", "-0.85"})["pairs"][0]["distance"].get<double>(), -0.05,
              1e-12)
      << "overlap";
  EXPECT_EQ(jsonOf({"wall.ors", "contacts"})["pairs"], json::array()) << "further than half a metre";
  EXPECT_EQ(jsonOf({"wall.ors", "contacts", "--margin", "2"})["pairs"].size(), 2u);
}

// A turret with an arm whose second ball overlaps it at home, and two shelves that touch.
constexpr const char* kShelves =
    "<robot name='r'><link name='world'/>"
    "<link name='shelf2'><collision><geometry><box size='1 1 .02'/></geometry></collision></link>"
    "<link name='shelf3'><collision><geometry><box size='1 1 .02'/></geometry></collision></link>"
    "<link name='turret'><collision><geometry><sphere radius='.1'/></geometry></collision></link>"
    "<link name='arm'><collision><geometry><sphere radius='.1'/></geometry></collision></link>"
    "<link name='hand'><collision><geometry><sphere radius='.1'/></geometry></collision></link>"
    "<joint name='a' type='fixed'><parent link='world'/><child link='shelf2'/><origin xyz='0 0 3'/></joint>"
    "<joint name='b' type='fixed'><parent link='world'/><child link='shelf3'/><origin xyz='0 0 "
    "3.01'/></joint>"
    "<joint name='c' type='continuous'><parent link='world'/><child link='turret'/></joint>"
    "<joint name='d' type='continuous'><parent link='turret'/><child link='arm'/><origin xyz='0 0 "
    ".1'/></joint>"
    "<joint name='e' type='continuous'><parent link='arm'/><child link='hand'/><origin xyz='0 0 "
    ".05'/></joint>"
    "</robot>";

TEST_F(SceneCommand, ContactsSayWhoMayCollideAndWhy) {
  std::ofstream(in("r.urdf")) << kShelves;
  const ProcessResult result = scene({"r.urdf", "contacts", "--pairs"});
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_EQ(result.output,
            "rule all_but_neighbours: 6 of 10 pairs of bodies may collide\n"
            "shelf2 - shelf3  fixed to each other\n"
            "turret - arm     neighbours\n"
            "turret - hand    overlap at home by 0.05 m ('turret' and 'hand')\n"
            "arm - hand       neighbours\n"
            "shelf2 - turret  may collide\n"
            "shelf2 - arm     may collide\n"
            "shelf2 - hand    may collide\n"
            "shelf3 - turret  may collide\n"
            "shelf3 - arm     may collide\n"
            "shelf3 - hand    may collide\n");
  EXPECT_THAT(flat(result.error),
              HasSubstr("r.urdf: warning: 'turret' and 'hand' overlap at home by 0.05 m"));
  const json pairs = jsonOf({"r.urdf", "contacts", "--pairs"});
  EXPECT_EQ(pairs["rule"], "all_but_neighbours");
  ASSERT_EQ(pairs["pairs"].size(), 10u);
  EXPECT_EQ(
      pairs["pairs"][0],
      json({{"a", "shelf2"}, {"b", "shelf3"}, {"may_collide", false}, {"reason", "fixed to each other"}}));
}

TEST_F(SceneCommand, ContactsProposeAnSrdfThatIsReadAgain) {
  std::ofstream(in("r.urdf")) << kShelves;
  const ProcessResult proposed = scene({"r.urdf", "contacts", "--never", "--samples", "200", "--seed", "3"});
  ASSERT_EQ(proposed.exitCode, 0) << proposed.error;
  EXPECT_THAT(proposed.output,
              HasSubstr("<!-- A sample of 200 random postures, seed 3, not a proof: a pair that "
                        "never touched may touch in others. -->\n<robot name=\"r\">\n"));
  EXPECT_THAT(proposed.output, HasSubstr("link1=\"shelf2\" link2=\"arm\" reason=\"Never\""));
  EXPECT_THAT(proposed.output, HasSubstr("link1=\"turret\" link2=\"hand\" reason=\"Always\""));
  EXPECT_EQ(jsonOf({"r.urdf", "contacts", "--never", "--samples", "50"})["postures"], 50);
  std::ofstream(in("r.srdf")) << proposed.output;
  const ProcessResult again = scene({"r.urdf", "contacts", "--pairs"});
  EXPECT_EQ(again.error, "");
  EXPECT_THAT(again.output, HasSubstr("0 of 10 pairs of bodies may collide"));
  EXPECT_THAT(again.output, HasSubstr("turret - hand    disabled: Always\n"));
  std::ofstream(in("none.srdf")) << "<robot name='r'/>";
  EXPECT_THAT(scene({"r.urdf", "contacts", "--pairs", "--srdf", "none.srdf"}).output,
              HasSubstr("6 of 10 pairs"));
}

TEST_F(SceneCommand, ContactsRefuseWhatHasNoMeaning) {
  const auto expectRefusal = [&](std::vector<std::string> arguments, const std::string& message) {
    arguments.insert(arguments.begin(), {"arm.ors", "contacts"});
    const ProcessResult result = scene(arguments);
    EXPECT_EQ(result.exitCode, 64) << message;
    EXPECT_THAT(flat(result.error), HasSubstr(message));
  };
  expectRefusal({"--never", "--samples", "0"}, "--samples: found 0, wanted 1 to 1e+06");
  expectRefusal({"--samples", "10"}, "--samples requires --never");
  expectRefusal({"--pairs", "--never"}, "--pairs excludes --never");
  expectRefusal({"--pairs", "--srdf", "a.srdf"},
                "--srdf: found an .ors file, wanted a .urdf file; in .ors, use statements 'collisions'");
}

TEST_F(SceneCommand, ContactsAlignForPeople) {
  std::ofstream(in("wall.ors")) << kWall;
  EXPECT_EQ(scene({"wall.ors", "contacts", "--q", "-0.75"}).output,
            "2 pairs of shapes may collide (rule four_generations, see --pairs), 1 are nearer than 0.5 m; "
            "contact cost "
            "0.5 with a margin of 0.1 m\n"
            "pair         distance          point of the first         point of the second\n"
            "wall - ball    0.0500    0.1000   0.0000   0.0000    0.1500   0.0000   0.0000\n");
  EXPECT_EQ(scene({"wall.ors", "contacts"}).output,
            "2 pairs of shapes may collide (rule four_generations, see --pairs), 0 are nearer than 0.5 m; "
            "contact cost 0 with a margin of 0.1 m\n");
}

TEST_F(SceneCommand, ContactsRefusesTooManyPairs) {
  const auto refused = [&](int bodies, int shapesEach) {
    std::ofstream file(in("many.ors"));
    for (int i = 0; i < bodies; ++i) {
      file << "body b" << i << " { }\n";
      for (int k = 0; k < shapesEach; ++k)
        file << "shape (b" << i << ") { rel=<T t(" << 10 * i << " 0 0)> type=1 size=[0 0 0 1] contact }\n";
    }
    file.close();
    return scene({"many.ors", "contacts"});
  };
  EXPECT_EQ(refused(632, 1).exitCode, 0);
  const ProcessResult result = refused(634, 1);
  EXPECT_EQ(result.exitCode, 64);
  EXPECT_THAT(flat(result.error),
              HasSubstr("many.ors: too many shapes take part in contacts: found 200661 pairs of "
                        "shapes, wanted at most 200000"));
  EXPECT_EQ(refused(2, 400).exitCode, 0) << "shapes of one body do not collide";
  EXPECT_EQ(refused(2, 448).exitCode, 64);
  EXPECT_THAT(scene({"man", "contacts", "--help"}).output, HasSubstr("more than 200000 pairs"));
}

constexpr const char* kPendulum =
    "body post {}\nbody rod { mass=2 }\njoint pin (post rod) { type=hingeY B=<T t(0 0 -.5)> }\n";

TEST_F(SceneCommand, DynamicsAreThoseOfTheLibrary) {
  const Model model = compile(readScene(in("arm.ors")).spec);
  const Eigen::Vector3d q(0.1, -0.7, 0.2), v(1, 2, -3), u(0, 5, 0.5);
  const json found = jsonOf({"arm.ors", "dynamics", "--q", "0.1,-0.7,0.2", "--v", "1 2 -3", "--u", "0,5,.5"});
  const EquationOfMotion motion = equationOfMotion(model, q, v);
  const Eigen::VectorXd qdd = forwardDynamicsByMassMatrix(model, q, v, u);
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) EXPECT_EQ(found["M"][i][k].get<double>(), motion.M(i, k));
    EXPECT_EQ(found["F"][i].get<double>(), motion.F[i]);
    EXPECT_NEAR(found["qdd"][i].get<double>(), qdd[i], 1e-10 * qdd.norm());
  }
  EXPECT_EQ(found["kinetic"].get<double>(), energy(model, q, v).kinetic);
  EXPECT_EQ(found["potential"].get<double>(), energy(model, q, v).potential);
  EXPECT_EQ(found.size(), 5u);
}

TEST_F(SceneCommand, DynamicsAtRestAreThoseOfTheFile) {
  const json found = jsonOf({"arm.ors", "dynamics"});
  EXPECT_EQ(found, jsonOf({"arm.ors", "dynamics", "--q", "file", "--v", "0", "--u", "shoulder=0"}));
  EXPECT_EQ(found["kinetic"], 0.0);
}

TEST_F(SceneCommand, DynamicsAlignForPeople) {
  std::ofstream(in("pendulum.ors")) << kPendulum;
  EXPECT_EQ(scene({"pendulum.ors", "dynamics", "--q", "0.3", "--v", "pin=2", "--u", "1"}).output,
            "kinetic energy 1.8 J, potential energy -9.37185 J; M qdd + F = u\n"
            "joint          v          u          F        qdd\n"
            "pin            2          1      2.899      -2.11\n"
            "\n"
            "M             v0\n"
            "pin          0.9\n");
  std::istringstream man(scene({"man", "dynamics", "--v", "upArmR>dnArmR=1.5"}).output);
  int lines = 0;
  for (std::string line; std::getline(man, line); ++lines) EXPECT_LE(line.size(), 80u) << line;
  EXPECT_GT(lines, 4 * 27) << "M in bands";
}

TEST_F(SceneCommand, DynamicsNeedMasses) {
  std::ofstream(in("ghost.ors")) << kPendulum << "body flag {}\njoint hinge (rod flag) { type=hingeX }\n";
  for (const char* format : {"--json", "--assets=."}) {
    const ProcessResult result = scene({"ghost.ors", "dynamics", format});
    EXPECT_EQ(result.exitCode, 64);
    EXPECT_THAT(flat(result.error),
                HasSubstr("joint 'hinge' moves no mass: wanted some: give body 'flag' a mass"));
    EXPECT_EQ(result.output, "");
  }
}

TEST_F(SceneCommand, WarnsOfNumbersThatAreTooLarge) {
  std::ofstream(in("huge.ors")) << "body a { X=<T t(1e308 0 0)> }\nbody b { mass=1 }\n"
                                   "joint j (a b) { type=transX A=<T t(1e308 0 0)> }";
  for (const char* verb : {"fk", "dynamics"}) {
    const ProcessResult result = scene({"huge.ors", verb, "--q", "1e308", "--json"});
    EXPECT_EQ(result.exitCode, 0) << result.error;
    EXPECT_THAT(result.error, HasSubstr("warning: some numbers are too large to compute with")) << verb;
    EXPECT_THAT(result.output, HasSubstr("null"));
    EXPECT_EQ(scene({"arm.ors", verb}).error, "");
  }
  const ProcessResult jacobian = scene({"huge.ors", "jacobian", "--body", "b", "--point", "1e308,0,0"});
  EXPECT_EQ(jacobian.exitCode, 0);
}

TEST_F(SceneCommand, PosturesMayBeZeroOrThatOfTheFile) {
  EXPECT_EQ(jsonOf({"arm.ors", "fk", "--q", "0"})["q"], json({0.0, 0.0, 0.0}));
  EXPECT_EQ(jsonOf({"arm.ors", "fk", "--q", "file"})["q"], json({0.25, 0.0, 0.0}));
  EXPECT_EQ(jsonOf({"arm.ors", "fk"})["q"], json({0.25, 0.0, 0.0}));
  EXPECT_EQ(jsonOf({"arm.ors", "fk", "--q", "shoulder=1"})["q"], json({1.0, 0.0, 0.0}));
}

TEST_F(SceneCommand, TextAlignsForPeople) {
  EXPECT_THAT(scene({"arm.ors", "fk", "--q", "0"}).output,
              HasSubstr("upper   0.00000   0.00000   2.20000   1.00000   0.00000"));
  const std::string J = scene({"arm.ors", "jacobian", "--body", "tip", "--q", "0"}).output;
  EXPECT_THAT(J, HasSubstr("shoulder    0.40000   0.00000   0.00000   0.00000   1.00000   0.00000\n"));
  EXPECT_THAT(J, HasSubstr("elbow [1]   0.00000"));
  std::ofstream(in("far.ors")) << "body far { X=<T t(1e30 0 -12345)> }";
  EXPECT_THAT(scene({"far.ors", "fk"}).output, HasSubstr("far       1e+30   0.00000 -1.23e+04"));
}

TEST_F(SceneCommand, TakesJsonBeforeAndBehindTheCommand) {
  const std::string info = scene({"arm.ors", "info", "--json"}).output;
  EXPECT_EQ(scene({"arm.ors", "--json", "info"}).output, info);
  EXPECT_EQ(scene({"arm.ors", "--json"}).output, info);
  EXPECT_EQ(scene({"arm.ors", "convert", "a.urdf", "--json"}).exitCode, 64);
}

TEST_F(SceneCommand, CheckTellsAllThatIsWrong) {
  EXPECT_EQ(scene({"arm.ors", "check"}).output, "arm.ors: loads\n");
  std::ofstream(in("odd.ors")) << "body a { colour=[1 0 0] type=0 }";
  const ProcessResult odd = scene({"odd.ors", "check"});
  EXPECT_EQ(odd.exitCode, 0);
  EXPECT_THAT(odd.output, HasSubstr("odd.ors:1:10: "));
  EXPECT_THAT(odd.output, HasSubstr("color"));
  std::ofstream(in("bad.ors")) << "body a {}\nbody b { X=<T t(0 1)> }";
  const ProcessResult bad = scene({"bad.ors", "check"});
  EXPECT_EQ(bad.exitCode, 1);
  EXPECT_THAT(flat(bad.output),
              HasSubstr("bad.ors:2:20: too few numbers in a pose: found ')', wanted three"));
  std::ofstream(in("loop.ors")) << "body a {}\nbody b {}\njoint (a b) {}\njoint (b a) {}";
  EXPECT_EQ(scene({"loop.ors", "check"}).exitCode, 1);
  const ProcessResult loop = scene({"loop.ors", "check", "--json"});
  const json verdict = json::parse(loop.output);
  EXPECT_EQ(verdict["ok"], false);
  EXPECT_EQ(verdict["messages"].back()["severity"], "error");
  EXPECT_EQ(verdict["messages"].back()["line"], 4);
  EXPECT_THAT(verdict["messages"].back()["text"].get<std::string>(), HasSubstr("loop"));
  EXPECT_EQ(json::parse(scene({"odd.ors", "check", "--json"}).output)["ok"], true);
  const ProcessResult missing = scene({"nowhere.ors", "check", "--json"});
  EXPECT_EQ(missing.exitCode, 1);
  EXPECT_EQ(json::parse(missing.output)["ok"], false);
  std::ofstream(in("both.ors")) << "body a { colour=[1 0 0] type=0 }\nbody b { mass=heavy }";
  EXPECT_THAT(scene({"both.ors", "check"}).output, HasSubstr("both.ors:1:10: warning"));
}

TEST_F(SceneCommand, RenderDrawsChosenShapes) {
  REX_NEEDS_OSMESA();
  for (const std::string shapes : {"visible", "contact", "all"})
    ASSERT_EQ(
        scene({"arm.ors", "render", "--shapes", shapes, "--size", "64x48", "-o", shapes + ".png"}).exitCode,
        0);
  EXPECT_NE(readPng(in("visible.png")), readPng(in("contact.png")));
  EXPECT_NE(readPng(in("visible.png")), readPng(in("all.png")));
  EXPECT_EQ(scene({"arm.ors", "render", "--size", "64x48", "-o", "plain.png"}).exitCode, 0);
  EXPECT_EQ(readPng(in("visible.png")), readPng(in("plain.png")));
}

TEST_F(SceneCommand, ConvertWritesBothFormats) {
  ASSERT_EQ(scene({"man", "convert", "made/man.urdf"}).output, "made/man.urdf\n");
  const ProcessResult back = scene({"made/man.urdf", "convert", "man.ors"});
  ASSERT_EQ(back.exitCode, 0) << back.error;
  const std::string q =
      "0.1,0.2,0.3,0.1,0.2,0.3,0.1,0.2,0.3,0.1,0.2,0.3,0.1,0.2,0.3,0.1,0.2,0.3,0.1,0.2,0.3,0.1,0.2,0.3,"
      "0.1,0.2,0.3";
  const json before = jsonOf({"man", "fk", "--q", q}), after = jsonOf({"man.ors", "fk", "--q", q});
  for (const json& body : before["bodies"]) {
    const auto same = std::find_if(after["bodies"].begin(), after["bodies"].end(),
                                   [&](const json& one) { return one["name"] == body["name"]; });
    ASSERT_NE(same, after["bodies"].end()) << body["name"];
    for (int i = 0; i < 3; ++i)
      ASSERT_NEAR((*same)["pos"][i].get<double>(), body["pos"][i].get<double>(), 1e-12) << body["name"];
  }
  EXPECT_NEAR(jsonOf({"man.ors"})["mass"].get<double>(), jsonOf({"man"})["mass"].get<double>(), 1e-12);
}

TEST_F(SceneCommand, ConvertTakesEndingsInAnyCase) {
  ASSERT_EQ(scene({"arm.ors", "convert", "ARM.URDF"}).output, "ARM.URDF\n");
  EXPECT_THAT(fileText(in("ARM.URDF")), HasSubstr("<robot"));
  ASSERT_EQ(scene({"ARM.URDF", "convert", "ARM.Ors"}).exitCode, 0);
  EXPECT_THAT(fileText(in("ARM.Ors")), HasSubstr("body post"));
}

TEST_F(SceneCommand, ConvertSaysWhereItCannotWrite) {
  std::ofstream(in("file")) << "x";
  std::filesystem::create_directory(in("folder.urdf"));
  for (const std::string out : {"file/a.urdf", "folder.urdf", "/proc/a.ors"}) {
    const ProcessResult result = scene({"arm.ors", "convert", out});
    EXPECT_EQ(result.exitCode, 64) << out;
    EXPECT_THAT(flat(result.error), HasSubstr(out == "file/a.urdf" ? "cannot make the folder" : out));
  }
}

TEST_F(SceneCommand, ConvertTakesMeshesAlong) {
  ASSERT_EQ(scene({"hand", "convert", "here/hand.ors"}).exitCode, 0);
  EXPECT_THAT(fileText(in("here/hand.ors")), HasSubstr("='../"));
  EXPECT_EQ(scene({"here/hand.ors", "info"}).exitCode, 64);
  EXPECT_EQ(scene({"here/hand.ors", "info", "--assets", "/"}).exitCode, 0);
}

TEST_F(SceneCommand, MissingMeshesAreRefusedWithAWayOut) {
  std::ofstream(in("robot.urdf"))
      << "<robot name='r'><link name='a'><visual><geometry>"
         "<mesh filename='package://r/a.stl'/></geometry></visual></link></robot>";
  const ProcessResult refused = scene({"robot.urdf"});
  EXPECT_EQ(refused.exitCode, 64);
  EXPECT_THAT(refused.error, HasSubstr("--allow-missing-meshes draws boxes instead"));
  EXPECT_EQ(scene({"robot.urdf", "--allow-missing-meshes"}).exitCode, 0);
  EXPECT_EQ(scene({"robot.urdf", "fk", "--allow-missing-meshes"}).exitCode, 0) << "also behind the command";
}

TEST_F(SceneCommand, RefusesWhatIsRepairedOnlyIfStrict) {
  std::ofstream(in("robot.urdf"))
      << "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='revolute'><parent link='a'/>"
         "<child link='b'/><limit lower='1' upper='0' velocity='1' effort='1'/></joint></robot>";
  const std::string fault =
      "joint 'j': <limit>: attribute 'lower': found 1 > 0, wanted a lower limit that is "
      "not above the upper";
  const ProcessResult lenient = scene({"robot.urdf", "check"});
  EXPECT_EQ(lenient.exitCode, 0);
  EXPECT_THAT(flat(lenient.output + lenient.error),
              HasSubstr("warning: " + fault + "; the joint has no range"));
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"robot.urdf", "--strict"}, {"robot.urdf", "fk", "--strict"}}) {
    const ProcessResult strict = scene(arguments);
    EXPECT_EQ(strict.exitCode, 64);
    EXPECT_THAT(flat(strict.error), HasSubstr(fault));
  }
}

TEST_F(SceneCommand, SaysWhatIsUsedWrongly) {
  const auto expectRefusal = [&](const std::vector<std::string>& arguments, const std::string& text) {
    const ProcessResult result = scene(arguments);
    EXPECT_EQ(result.exitCode, 64) << text;
    EXPECT_THAT(flat(result.error), HasSubstr(text));
  };
  expectRefusal({"arn.ors"}, "there is no scene 'arn.ors'");
  expectRefusal({"arm.ors", "kinematics"}, "rex scene FILE: unknown command 'kinematics'");
  expectRefusal({"arm.ors", "fk", "--q", "1"}, "--q: found 1 number, wanted 3");
  expectRefusal({"arm.ors", "jacobian"}, "--body is required");
  expectRefusal({"arm.ors", "jacobian", "--body", "uper"},
                "--body: scene 'arm.ors' has no body 'uper' (did you mean 'upper'?)");
  expectRefusal({"arm.ors", "jacobian", "--body", "tip", "--point", "1"},
                "--point: found 1 numbers, wanted three");
  for (const std::string margin : {"0", "-1", "nan", "inf"})
    expectRefusal({"arm.ors", "contacts", "--margin", margin},
                  "--margin: found " + margin + ", wanted 1e-09 to 1e+09");
  expectRefusal({"arm.ors", "dynamics", "--q", "1"}, "--q: found 1 number, wanted 3");
  expectRefusal({"arm.ors", "dynamics", "--v", "1,2"}, "--v: found 2 numbers, wanted 3");
  expectRefusal({"arm.ors", "dynamics", "--u", "1,2,nan"}, "--u: found 'nan', wanted a number");
  expectRefusal({"arm.ors", "dynamics", "--u", "elbow=1"}, "--u: joint 'elbow': found 2 coordinates");
  expectRefusal({"arm.ors", "dynamics", "--v", "sholder=1"}, "(did you mean 'shoulder'?)");
  expectRefusal({"arm.ors", "render", "--shapes", "contacts", "-o", "a.png"},
                "--shapes: found 'contacts', wanted visible, contact or all (did you mean 'contact'?)");
  expectRefusal({"man", "render", "--shapes", "contact", "-o", "a.png"},
                "--shapes contact: found no shape that takes part in contacts");
  std::ofstream(in("ARM.ORS")) << kArm;
  for (const std::string file : {"arm.ors", "ARM.ORS"})
    for (const char* verb : {"fk", "check"})
      expectRefusal({file, verb, "--free-base"}, "--free-base: found an .ors file, wanted a .urdf file");
  std::ofstream(in("m.xml")) << "<mujoco><worldbody><body name='a'/></worldbody></mujoco>";
  EXPECT_EQ(scene({"m.xml", "check"}).exitCode, 0);
  expectRefusal({"m.xml", "fk", "--up-axis", "respect"},
                "--up-axis: found 'respect', wanted respected, ignored (did you mean 'respected'?)");
  expectRefusal({"m.xml", "fk", "--free-base"},
                "--free-base: found an .xml file, wanted a .urdf file; in MJCF, use <freejoint/>");
  expectRefusal({"m.xml", "fk", "--srdf", "m.srdf"},
                "--srdf: found an .xml file, wanted a .urdf file; in MJCF, use <contact>");
  expectRefusal({"arm.ors", "contacts", "--margin", "abc"},
                "contacts: --margin: found 'abc', wanted a number");
  expectRefusal({"arm.ors", "--json=abc"}, "rex scene FILE: --json: found 'abc', wanted no value");
  std::ofstream(in("round.ors")) << "body a {} body b {}\njoint j (a b) { type=quatBall }";
  for (const char* verb : {"fk", "contacts", "dynamics"})
    expectRefusal({"round.ors", verb, "--q", "0,0,0,0"},
                  "--q: found (0, 0, 0, 0) for joint 'j', wanted a quaternion");
  expectRefusal({"arm.ors", "convert", "arm.ors"}, "'arm.ors' is the scene itself: wanted another file");
  expectRefusal(
      {"arm.ors", "convert", "arm.udrf"},
      "cannot write 'arm.udrf': found the ending '.udrf', wanted .ors or .urdf (did you mean '.urdf'?)");
  expectRefusal({"arm.ors", "convert", "arm"}, "cannot write 'arm': found no ending");
  std::ofstream(in("ball.ors")) << "body a {} body b {}\njoint (a b) { type=quatBall }";
  expectRefusal({"ball.ors", "convert", "ball.urdf"}, "ball.ors:2:1: joint 'a>b'");
  std::ofstream(in("bad.ors")) << "body a {";
  expectRefusal({"bad.ors"}, "bad.ors:1:8: '{' is never closed");
}

TEST_F(SceneCommand, DoesWhatItsExamplesSay) {
  for (const char* verb : {"info", "fk", "jacobian", "contacts", "dynamics"}) {
    const std::string help = scene({"man", verb, "--help"}).output;
    EXPECT_THAT(help, HasSubstr("Usage: rex scene FILE " + std::string(verb)));
    EXPECT_THAT(help, HasSubstr("scripts/rex scene "));
  }
  EXPECT_EQ(scene({"pegArm", "jacobian", "--body", "peg", "--point", "0,0,0.3", "--q", "0"}).exitCode, 0);
  EXPECT_EQ(scene({"man", "info"}).exitCode, 0);
  EXPECT_EQ(scene({"pegInAHole", "contacts", "--q", "0.6,0.5,0,0,0,0,0", "--margin", "0.02"}).exitCode, 0);
  EXPECT_EQ(scene({"pegArm", "dynamics", "--q", "0.1,0.2,0.3", "--v", "0,1,0"}).exitCode, 0);
  EXPECT_EQ(jsonOf({"arm3", "dynamics", "--u", "5,0,0"})["M"].size(), 3u);
  EXPECT_EQ(jsonOf({"man", "fk", "--q", "0"})["bodies"].size(), 30u);
}

constexpr const char* kSwing =
    "<mujoco><worldbody><body name='rod'><joint name='turn'/><geom size='.2'/></body></worldbody>"
    "<keyframe><key name='home' qpos='.7'/></keyframe></mujoco>";

TEST_F(SceneCommand, OffersThePosturesOfTheFile) {
  std::ofstream(in("swing.xml")) << kSwing;
  EXPECT_EQ(jsonOf({"swing.xml", "info"})["postures"], json::parse(R"({"key:home": [0.7]})"));
  EXPECT_THAT(scene({"swing.xml"}).output, HasSubstr("\npostures for --q: key:home\n"));
  EXPECT_EQ(jsonOf({"swing.xml", "fk", "--q", "key:home"}), jsonOf({"swing.xml", "fk", "--q", "0.7"}));
  const ProcessResult wrong = scene({"swing.xml", "fk", "--q", "key:hom"});
  EXPECT_EQ(wrong.exitCode, 64);
  EXPECT_THAT(wrong.error, HasSubstr("no posture 'key:hom'"));
  EXPECT_THAT(scene({"swing.xml", "convert", "swing.ors"}).error, HasSubstr("named postures are left out"));
}

TEST_F(SceneCommand, GroupsEqualWarnings) {
  std::ofstream(in("odd.ors")) << "body a { colour=1 }\nbody b { colour=2 }\nbody c { colour=3 }\n";
  const std::string all = scene({"odd.ors", "check"}).output, few = scene({"odd.ors", "info"}).error;
  for (const char* place : {"odd.ors:1:", "odd.ors:2:", "odd.ors:3:"}) EXPECT_THAT(all, HasSubstr(place));
  EXPECT_THAT(few, HasSubstr("odd.ors:1:"));
  EXPECT_THAT(few, HasSubstr("(and 2 more like this)"));
  EXPECT_THAT(few, HasSubstr("`rex scene odd.ors check` shows all 3 findings"));
}

}  // namespace rex::cli::scene_test
