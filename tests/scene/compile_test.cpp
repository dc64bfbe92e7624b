#include <numbers>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "formats/ors_reader.h"
#include "scene/model.h"
#include "support/expect_error.h"

namespace rex::compile_test {

Model model(std::string_view text) { return compile(parseOrs(text, "f").spec); }

TEST(Compile, OrdersJointsBreadthFirst) {
  const Model m = model(
      "body r {}\nbody a {}\nbody b {}\nbody a2 {}\nbody b2 {}\nbody root2 {}\n"
      "joint (a a2) {}\njoint (r b) {}\njoint (b b2) {}\njoint (r a) {}\n");
  std::vector<std::string> joints, bodies;
  for (const Joint& joint : m.joints()) joints.push_back(joint.name);
  for (const Body& body : m.bodies()) bodies.push_back(body.name);
  EXPECT_THAT(joints, testing::ElementsAre("r>b", "r>a", "b>b2", "a>a2"));
  EXPECT_THAT(bodies, testing::ElementsAre("world", "r", "root2", "b", "a", "b2", "a2"));
  EXPECT_EQ(m.nq(), 4);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(m.joints()[i].qIndex, static_cast<int>(i));
}

TEST(Compile, AllowsTwoBodiesOfOneNameAndFindsTheFirst) {
  const Model m = model("body a { mass=1 type=1 }\nbody b {}\nbody a { type=0 }\njoint (a b) {}");
  EXPECT_EQ(m[m.body("a")].mass, 1);
  EXPECT_EQ(m.shapes().size(), 2u);
  EXPECT_NE(m.shapes()[0].body, m.shapes()[1].body);
}

TEST(Compile, FindsBodiesByShapeName) {
  const Model m = model("body a {}\nshape tip (a) { type=5 }");
  EXPECT_EQ(m.body("tip"), m.body("a"));
  EXPECT_EQ(m.body("world"), kWorld);
  EXPECT_REX_ERROR(m.body("tpi"), "scene 'f' has no body 'tpi' (did you mean 'tip'?)");
}

TEST(Compile, GivesAMassOnItsOwnTheCourseInertia) {
  const Model m = model("body a { mass=2 }\nbody b { mass=2 inertia=[1 2 3] }");
  EXPECT_EQ(m[m.body("a")].I_BBcm_B, Eigen::Matrix3d(0.4 * Eigen::Matrix3d::Identity()));
  EXPECT_EQ(m[m.body("b")].I_BBcm_B(2, 2), 3);
  EXPECT_EQ(m.mass(), 4);
}

TEST(Compile, KeepsLimitsAndStartingPosture) {
  const Model m = model(
      "body a {}\nbody b {}\nbody c {}\njoint (a b) { limits=[-1 2] q=.5 }\njoint (b c) { type=quatBall }");
  EXPECT_EQ(m.nq(), 5);
  EXPECT_EQ(m.nv(), 4);
  EXPECT_EQ(m.initialPositions(), (Eigen::VectorXd(5) << .5, 1, 0, 0, 0).finished());
  EXPECT_EQ(m.lowerLimits()[0], -1);
  EXPECT_EQ(m.upperLimits()[0], 2);
  EXPECT_EQ(m.upperLimits()[1], std::numeric_limits<double>::infinity());
}

TEST(Compile, LetsAJointMimicAnother) {
  const Model m =
      model("body a {}\nbody b {}\nbody c {}\njoint left (a b) { mimic=right }\njoint right (a c) { q=.3 }");
  EXPECT_EQ(m.nq(), 1);
  EXPECT_EQ(m.initialPositions()[0], .3);
  EXPECT_EQ(m.joints()[0].qIndex, m.joints()[1].qIndex);
}

TEST(Compile, TakesMimicsOfRigidJointsForRigid) {
  const Model m = model(
      "body a {}\nbody b {}\nbody c {}\nbody d {}\njoint j (a b) { type=rigid }\njoint k (b c) { mimic=j }\n"
      "joint l (c d) { q=.3 }");
  EXPECT_EQ(m.joints()[1].type, JointType::kRigid);
  EXPECT_FALSE(m.joints()[1].mimics);
  EXPECT_EQ(m.nq(), 1);
}

constexpr const char* kPair =
    "body a {}\nbody b {}\nbody c {}\njoint right (a c) { type=transX limits=[-1 1] }\n"
    "joint left (a b) { type=transX mimic=right ";

TEST(Compile, NarrowsLimitsToThoseOfJointsThatMimic) {
  const auto limits = [](const std::string& left) {
    const Model m = model(kPair + left + " }");
    return Eigen::Vector2d(m.lowerLimits()[0], m.upperLimits()[0]);
  };
  EXPECT_EQ(limits("mimic_ratio=2 limits=[-.5 .75]"), Eigen::Vector2d(-0.25, 0.375));
  EXPECT_EQ(limits("mimic_ratio=-2 mimic_offset=1 limits=[0 2]"), Eigen::Vector2d(-0.5, 0.5));
  EXPECT_EQ(limits("mimic_ratio=-.5 limits=[-2 .25]"), Eigen::Vector2d(-0.5, 1));
  EXPECT_EQ(limits("mimic_offset=-7"), Eigen::Vector2d(-1, 1));
  EXPECT_EQ(limits("mimic_ratio=0 limits=[-.5 .5]"), Eigen::Vector2d(-1, 1));
  const Model planar = model(
      "body a {}\nbody b {}\nbody c {}\njoint left (a b) { type=transXYPhi mimic=right limits=[-1 5 2 3 -4 "
      "0] }\n"
      "joint right (a c) { type=transXYPhi limits=[-2 4 -3 3 -3 3] }");
  EXPECT_EQ(planar.lowerLimits(), Eigen::Vector3d(-1, 2, -3));
  EXPECT_EQ(planar.upperLimits(), Eigen::Vector3d(4, 3, 0));
}

TEST(Compile, AllowsWhatAllJointsOfACoordinateAllow) {
  SceneSpec spec = parseOrs(std::string(kPair) + "limits=[-1 1] }", "f").spec;
  Rng rng(1);
  int allowed = 0;
  for (int i = 0; i < 200; ++i) {
    JointSpec& left = spec.joints[1];
    left.mimicRatio = rng.normal();
    left.mimicOffset = rng.uniform(-1, 1);
    const Model m = compile(spec);
    for (int k = 0; k < 20; ++k) {
      const double q = rng.uniform(-2, 2);
      const bool isAllowed = std::abs(q) <= 1 && std::abs(left.mimicRatio * q + left.mimicOffset) <= 1;
      EXPECT_EQ(m.lowerLimits()[0] <= q && q <= m.upperLimits()[0], isAllowed) << q;
      allowed += isAllowed;
    }
  }
  EXPECT_GT(allowed, 100);
}

TEST(Compile, RefusesLimitsThatNoPositionKeeps) {
  EXPECT_REX_ERROR(model(std::string(kPair) + "mimic_ratio=2 mimic_offset=3 limits=[0 .5] }"),
                   "f:5:1: joint 'left': limits: found joint 'right' has no position left: -1 > -1.25, "
                   "wanted limits that both joints can satisfy");
}

TEST(Compile, ReadsTheStartFromQ) {
  const Model m = model(
      "body a {}\nbody b {}\nbody c {}\njoint (a b) { Q=<T d(60 1 0 0)> }\njoint (b c) { type=transXYPhi "
      "Q=<T t(1 2 0) d(90 0 0 1)> }");
  EXPECT_NEAR(m.initialPositions()[0], std::numbers::pi / 3, 1e-15);
  EXPECT_LT((m.initialPositions().tail<3>() - Eigen::Vector3d(1, 2, std::numbers::pi / 2)).norm(), 1e-15);
}

TEST(Compile, RefusesWhatIsNoTree) {
  EXPECT_REX_ERROR(model("body a {}\nbody b {}\nbody c {}\njoint (a c) {}\njoint (b c) {}"),
                   "f:5:1: joint 'b>c': body 'c' is already attached to a joint: found joint 'a>c', wanted "
                   "one joint leading to each body");
  EXPECT_REX_ERROR(model("body a {}\nbody b {}\njoint j (a b) {}\njoint j (b a) {}"),
                   "f:4:1: duplicate joint 'j': wanted a name of its own: the first is at f:3:1");
  EXPECT_REX_ERROR(
      model(
          "body r {}\nbody a {}\nbody b {}\nbody tail {}\njoint (b tail) {}\njoint (a b) {}\njoint (b a) {}"),
      "joints form a loop: found");
  SceneSpec loop = parseOrs("body a {}\nbody b {}\njoint (b a) {}", "f").spec;
  loop.joints[0].parent = "a";
  EXPECT_REX_ERROR(compile(loop), "f:3:1: joint 'b>a': joints form a loop: found a > a, wanted a tree");
}

TEST(Compile, RefusesBadNumbersInAnEditedSpec) {
  const SceneSpec good = parseOrs("body a { type=0 }\nbody b {}\njoint j (a b) {}", "f").spec;
  const double nan = std::nan("");
  const auto broken = [&](auto edit) {
    SceneSpec spec = good;
    edit(spec);
    return spec;
  };
  EXPECT_NO_THROW(static_cast<void>(compile(good)));
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.bodies[1].name = "world"; })),
                   "f:2:1: body 'world': found the name of the world itself, wanted another name");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.bodies[0].mass = nan; })),
                   "f:1:1: body 'a': mass: found nan, wanted a finite mass");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.bodies[0].X_WB.p.x() = nan; })),
                   "body 'a': pose: found a number that is not finite");
  EXPECT_REX_ERROR(
      compile(broken([&](SceneSpec& s) { s.bodies[0].inertia = Eigen::Matrix3d::Constant(nan); })),
      "body 'a': inertia: wanted a finite symmetric matrix");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.bodies[0].shapes[0].shape.radius = -1; })),
                   "shape 'a': wanted a finite pose, finite sizes >= 0");
  const auto roundedBox = [&](double radius) {
    return broken([&](SceneSpec& s) {
      s.bodies[0].shapes[0].shape = {
          .type = ShapeType::kRoundedBox, .extent = {0.3, 0.2, 0.4}, .radius = radius};
    });
  };
  EXPECT_NO_THROW(static_cast<void>(compile(roundedBox(0.1))));
  EXPECT_REX_ERROR(compile(roundedBox(0.11)),
                   "shape 'a': radius of the rounded edges: found 0.11 m, wanted at most half of the "
                   "shortest edge, 0.1 m");
  EXPECT_REX_ERROR(
      compile(broken([&](SceneSpec& s) { s.joints[0].mimic = "j"; })),
      "f:3:1: joint 'j': mimic: found 'j', wanted a joint that mimics no other, with one coordinate "
      "like this one, or of the same type and with ratio 1 and offset 0");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.joints[0].axis.setZero(); })),
                   "joint 'j': axis: found a zero or non-finite vector");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.bodies[0].p_BBcm.z() = nan; })),
                   "body 'a': centre of mass: found a number that is not finite");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.bodies[0].buoyancy = HUGE_VAL; })),
                   "body 'a': buoyancy: found inf, wanted a finite number");
  EXPECT_REX_ERROR(
      compile(broken([&](SceneSpec& s) { s.bodies[0].inertia = Eigen::Vector3d(1, -1, 1).asDiagonal(); })),
      "f:1:1: body 'a': inertia: found a negative principal moment");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.joints[0].pitch = nan; })),
                   "joint 'j': pitch: found nan, wanted metres per turn");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.joints[0].maxVelocity = -1; })),
                   "joint 'j': largest velocity: found -1, wanted a number >= 0");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.joints[0].maxEffort = nan; })),
                   "joint 'j': largest effort: found nan");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.joints[0].damping = -1; })),
                   "joint 'j': damping: found -1");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.joints[0].friction = nan; })),
                   "joint 'j': friction: found nan");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.joints[0].armature = -1; })),
                   "joint 'j': armature: found -1, wanted a number >= 0");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.joints[0].stiffness = nan; })),
                   "joint 'j': stiffness: found nan");
  EXPECT_REX_ERROR(
      compile(broken([&](SceneSpec& s) { s.joints[0].springReference = Eigen::Vector2d(1, 2); })),
      "joint 'j': reference of the spring: found 2 numbers, wanted 1");
  EXPECT_REX_ERROR(
      compile(broken([&](SceneSpec& s) { s.joints[0].springReference = Eigen::VectorXd::Constant(1, nan); })),
      "joint 'j': reference of the spring: found nan, wanted numbers");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) {
                     s.joints[0].springReference = Eigen::VectorXd::Constant(1, HUGE_VAL);
                   })),
                   "joint 'j': reference of the spring: found inf, wanted finite numbers");
  EXPECT_REX_ERROR(
      compile(broken([&](SceneSpec& s) {
        s.joints[0].type = JointType::kBall;
        s.joints[0].q0 = s.joints[0].lower = s.joints[0].upper = {};
        s.joints[0].springReference = Eigen::Vector4d::Zero();
      })),
      "joint 'j': reference of the spring: found a quaternion of length zero, wanted another one");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.joints[0].mimicRatio = nan; })),
                   "joint 'j': ratio: found nan");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.joints[0].mimicOffset = nan; })),
                   "joint 'j': offset: found nan");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.joints[0].X_PF.p.y() = nan; })), "joint 'j': frames");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.joints[0].q0 = Eigen::Vector2d(1, 2); })),
                   "joint 'j': initial coordinates: found 2 numbers, wanted 1");
  EXPECT_REX_ERROR(
      compile(broken([&](SceneSpec& s) { s.joints[0].lower = Eigen::VectorXd::Constant(1, nan); })),
      "joint 'j': lower limits: found nan");
  const auto one = [](double number) { return Eigen::VectorXd::Constant(1, number); };
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.joints[0].q0 = one(HUGE_VAL); })),
                   "joint 'j': initial coordinates: found inf, wanted finite numbers");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) {
                     s.joints[0].lower = one(2);
                     s.joints[0].upper = one(1);
                   })),
                   "joint 'j': limits: found 2 > 1, wanted lower <= upper");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.bodies[0].shapes[0].color[1] = 255; })),
                   "shape 'a': colour: found 255, wanted numbers from 0 to 1");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.bodies[0].shapes[0].color[3] = nan; })),
                   "shape 'a': colour: found nan");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.joints[0].parent = "c"; })),
                   "f:3:1: joint 'j': unknown parent: found 'c', wanted the name of a body");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.joints[0].child = "c"; })),
                   "joint 'j': unknown child: found 'c'");
  EXPECT_REX_ERROR(compile(broken([&](SceneSpec& s) { s.joints[0].mimic = "k"; })),
                   "joint 'j': mimic: found 'k', wanted a joint that mimics no other, with one");
}

TEST(Compile, LetsNothingCollideWithWhatStandsForAMesh) {
  SceneSpec spec = parseOrs("body a { type=0 contact }", "f").spec;
  EXPECT_TRUE(compile(spec).shapes()[0].contact);
  spec.bodies[0].shapes[0].meshMissing = true;
  EXPECT_FALSE(compile(spec).shapes()[0].contact);
}

TEST(Compile, LetsJointsHangOnTheWorld) {
  SceneSpec spec;
  spec.bodies = {{.name = "cart", .X_WB = translation(9, 9, 9)}, {.name = "post", .X_WB = {}}};
  spec.joints = {{.name = "rail",
                  .parent = "world",
                  .child = "cart",
                  .type = JointType::kSlider,
                  .X_PF = {},
                  .X_MC = {}}};
  const Model model = compile(spec);
  EXPECT_EQ(model.bodies()[1].name, "post") << "bodies without joints come first";
  EXPECT_EQ(model[model.body("cart")].parent, kWorld);
  EXPECT_EQ(model.joints()[0].parent, kWorld);
  EXPECT_EQ(model.nq(), 1);
}

SceneSpec withPosture(const std::string& joint, const Eigen::VectorXd& q) {
  SceneSpec spec =
      parseOrs("body a {}\nbody b {}\nbody c {}\njoint j (a b) { q=.5 }\njoint k (b c) { type=quatBall }",
               "f")
          .spec;
  spec.postures.push_back({.name = "key:up", .joints = {{joint, q}}, .where = {"m.xml", 3, 4}});
  return spec;
}

TEST(Compile, CompletesNamedPosturesFromThatOfTheFile) {
  const Model m = compile(withPosture("k", Eigen::Vector4d(0, 0, 0, 2)));
  EXPECT_EQ(m.posture("key:up"), (Eigen::VectorXd(5) << .5, 0, 0, 0, 1).finished());
  EXPECT_REX_ERROR(m.posture("up"), "scene 'f' has no posture 'up'");
  EXPECT_REX_ERROR(model("body a {}").posture("key:up"), "scene 'f' has no posture 'key:up'");
}

TEST(Compile, RefusesNamedPosturesThatCannotBe) {
  const auto refuse = [](const std::string& joint, const Eigen::VectorXd& q, const std::string& text) {
    EXPECT_REX_ERROR(compile(withPosture(joint, q)), "m.xml:3:4: posture 'key:up': " + text);
  };
  refuse("i", Eigen::VectorXd::Ones(1), "unknown joint: found 'i', wanted the name of a joint");
  refuse("j", Eigen::VectorXd::Ones(2), "joint 'j': found 2 numbers, wanted 1 finite numbers");
  refuse("j", Eigen::VectorXd::Constant(1, std::nan("")), "joint 'j': found ");
  refuse("k", Eigen::VectorXd::Zero(4), "joint 'k': found a quaternion of length zero");
}

}  // namespace rex::compile_test
