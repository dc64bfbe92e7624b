#include "formats/ors_reader.h"

#include <filesystem>
#include <fstream>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "geometry/rotation.h"
#include "kinematics/forward_kinematics.h"
#include "scene/model.h"
#include "support/expect_error.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::ors_reader_test {

SceneSpec read(std::string_view text) { return parseOrs(text, "f").spec; }

TEST(OrsReader, ReadsABody) {
  const SceneSpec spec =
      read("body a { X=<T t(1 2 3)> type=2 mass=.5 size=[.1 .1 .4 .05] color=[1 0 0] contact fixed }");
  ASSERT_EQ(spec.bodies.size(), 1u);
  const BodySpec& body = spec.bodies[0];
  EXPECT_EQ(body.name, "a");
  EXPECT_EQ(body.X_WB.p, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(body.mass, .5);
  EXPECT_EQ(body.kind, BodyKind::kStatic);
  ASSERT_EQ(body.shapes.size(), 1u);
  EXPECT_EQ(body.shapes[0].name, "a");
  EXPECT_EQ(body.shapes[0].shape.type, ShapeType::kCapsule);
  EXPECT_EQ(body.shapes[0].shape.extent.z(), .4);
  EXPECT_EQ(body.shapes[0].shape.radius, .05);
  EXPECT_EQ(body.shapes[0].color, Eigen::Vector4d(1, 0, 0, 1));
  EXPECT_TRUE(body.shapes[0].contact);
}

TEST(OrsReader, HonoursFlagsAndSharedKeys) {
  EXPECT_EQ(read("body a { fixed! }").bodies[0].kind, BodyKind::kDynamic);
  EXPECT_EQ(read("body a { fixed=false }").bodies[0].kind, BodyKind::kDynamic);
  EXPECT_EQ(read("body a { fixed=0 }").bodies[0].kind, BodyKind::kDynamic);
  EXPECT_EQ(read("body a { fixed=1 }").bodies[0].kind, BodyKind::kStatic);
  EXPECT_EQ(read("body a { fixed mass=0 }").bodies[0].kind, BodyKind::kStatic);  // two names, one value
  EXPECT_EQ(read("body a { kinematic }").bodies[0].kind, BodyKind::kKinematic);
  EXPECT_EQ(read("body a { dyntype=2 }").bodies[0].kind, BodyKind::kStatic);
  const ShapeSpec shape = read("body a { type=1 contact color=[0 1 0] }").bodies[0].shapes[0];
  EXPECT_TRUE(shape.contact);
  EXPECT_EQ(shape.color.head<3>(), Eigen::Vector3d(0, 1, 0));
}

TEST(OrsReader, ReadsInertia) {
  EXPECT_FALSE(read("body a { mass=1 }").bodies[0].inertia.has_value());
  EXPECT_EQ(*read("body a { mass=1 inertia=[1 2 3] }").bodies[0].inertia,
            Eigen::Matrix3d(Eigen::Vector3d(1, 2, 3).asDiagonal()));
  EXPECT_EQ((*read("body a { mass=1 inertia=[1 2 3 .1 .2 .3] }").bodies[0].inertia)(1, 2), .3);
}

TEST(OrsReader, PutsShapesOnTheirBodyOrInTheWorld) {
  const SceneSpec spec =
      read("body a {}\nbody b {}\nshape s (b) { type=ST_box rel=<T t(1 0 0)> }\nshape { type=4 }");
  EXPECT_TRUE(spec.bodies[0].shapes.empty());
  ASSERT_EQ(spec.bodies[1].shapes.size(), 1u);
  EXPECT_EQ(spec.bodies[1].shapes[0].X_BS.p.x(), 1);
  ASSERT_EQ(spec.worldShapes.size(), 1u);
  EXPECT_EQ(spec.worldShapes[0].shape.type, ShapeType::kCylinder);
}

TEST(OrsReader, ReadsJoints) {
  const std::string bodies = "body a {}\nbody b {}\n";
  const auto joint = [&](const std::string& attributes) {
    return read(bodies + "joint j (a b) { " + attributes + " }").joints.at(0);
  };
  const JointSpec hinge = joint("A=<T t(1 0 0)> B=<T t(0 1 0)> Q=<T d(-30 1 0 0)>");
  EXPECT_EQ(hinge.type, JointType::kHinge);
  EXPECT_EQ(hinge.axis, Eigen::Vector3d::UnitX());
  EXPECT_EQ(hinge.X_PF.p, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(hinge.X_MC.p, Eigen::Vector3d(0, 1, 0));
  EXPECT_NEAR(hinge.q0[0], -std::numbers::pi / 6, 1e-15);
  EXPECT_EQ(joint("type=2").axis, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(joint("type=transY q=.5").type, JointType::kSlider);
  EXPECT_EQ(joint("type=transY q=.5").q0[0], .5);
  EXPECT_EQ(joint("type=8").type, JointType::kPlanarXYPhi);
  EXPECT_EQ(joint("fixed").type, JointType::kRigid);
  EXPECT_TRUE(isApprox(joint("type=10 Q=<T t(1 0 0)> q=.1").X_PF,
                       translation(1, 0, 0) * rotation(.1, {1, 0, 0}), 1e-15));
  EXPECT_TRUE(isApprox(joint("type=hingeZ q=.1 limits=[-1 1] fixed").X_PF, rotation(.1, {0, 0, 1}), 1e-15));
  EXPECT_EQ(joint("type=hingeZ q=.1 limits=[-1 1] fixed").lower.size(), 0);
  EXPECT_TRUE(isApprox(joint("fixed Q=<T t(1 2 3)>").X_PF, translation(1, 2, 3), 0));
  EXPECT_TRUE(isApprox(joint("A=<T t(1 0 0)> BinvA").X_MC, translation(-1, 0, 0), 0));
  EXPECT_EQ(joint("A=<T t(1 0 0)> from=<T t(2 0 0)>").X_PF.p.x(), 2);
  EXPECT_EQ(joint("to=<T t(2 0 0)>").X_MC.p.x(), 2);
  const JointSpec turned = joint("axis=[0 0 2]");
  EXPECT_LT((turned.X_PF.R * turned.axis - Eigen::Vector3d::UnitZ()).norm(), 1e-15);
  EXPECT_TRUE(isApprox(turned.X_PF * turned.X_MC, Pose{}, 1e-15));
  const JointSpec limited = joint("type=transXY limits=[-1 1 -2 2]");
  EXPECT_EQ(limited.lower, Eigen::Vector2d(-1, -2));
  EXPECT_EQ(limited.upper, Eigen::Vector2d(1, 2));
  EXPECT_EQ(read(bodies + "joint (a b) {}").joints[0].name, "a>b");
}

TEST(OrsReader, ReadsJointsOfOurOwn) {
  const std::string bodies = "body a {}\nbody b {}\nbody c {}\n";
  const JointSpec screw = read(bodies + "joint (a b) { type=screw pitch=.01 axis=[0 1 0] q=3 }").joints[0];
  EXPECT_EQ(screw.type, JointType::kScrew);
  EXPECT_EQ(screw.pitch, .01);
  EXPECT_LT((screw.X_PF.R * screw.axis - Eigen::Vector3d::UnitY()).norm(), 1e-15);
  const JointSpec cylinder = read(bodies + "joint (a b) { type=cylindrical q=[1 2] }").joints[0];
  EXPECT_EQ(cylinder.type, JointType::kCylindrical);
  EXPECT_EQ(cylinder.q0, Eigen::Vector2d(1, 2));
  const SceneSpec pair = read(bodies +
                              "joint lead (a b) { type=hingeZ ctrl_limits=[2 30 0] damping=.1 friction=.2 }\n"
                              "joint (a c) { mimic=lead mimic_ratio=-2 mimic_offset=.5 }");
  EXPECT_EQ(pair.joints[0].maxVelocity, 2);
  EXPECT_EQ(pair.joints[0].maxEffort, 30);
  EXPECT_EQ(pair.joints[0].damping, .1);
  EXPECT_EQ(pair.joints[0].friction, .2);
  EXPECT_EQ(pair.joints[1].mimic, "lead");
  EXPECT_EQ(pair.joints[1].axis, Eigen::Vector3d::UnitZ());  // the type is that of the joint it follows
  EXPECT_EQ(pair.joints[1].mimicRatio, -2);
  EXPECT_EQ(pair.joints[1].mimicOffset, .5);
  const SceneSpec later = read(bodies + "joint (a c) { mimic=lead }\njoint lead (a b) { type=transY }");
  EXPECT_EQ(later.joints[0].type, JointType::kSlider);
  EXPECT_EQ(later.joints[0].axis, Eigen::Vector3d::UnitY());
  EXPECT_EQ(read(bodies + "joint (world b) {}").joints[0].parent, "world");
  const JointSpec half = read(bodies + "joint (a b) { limits=[-inf 1] axis=[1e200 0 0] }").joints[0];
  EXPECT_EQ(half.lower[0], -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(half.X_PF.R.isIdentity(0));
}

// As the vehicle of an old exercise stands on it, whose joints are hinges about x where sliders were meant.
TEST(OrsReader, TakesABodyCalledWorldForTheWorld) {
  const SceneFile file = parseOrs(
      "body world { X=<T t(0 0 .1)> type=0 size=[.01 .01 .01 0] fixed }\n"
      "body transx { type=0 size=[.01 .01 .01 0] }\nbody transxy { type=0 size=[.01 .01 .01 0] }\n"
      "body car { type=0 size=[.2 .5 .1 0] }\n"
      "joint (world transx) { type=0 }\njoint (-4 transxy) { type=0 A=<T t(0 1 0)> }\n"
      "joint (transxy car) { A=<T d(-90 0 1 0)> B=<T d(90 0 1 0)> type=0 }\n"
      "shape post (-7) { type=1 size=[0 0 0 1] }",
      "car.ors");
  EXPECT_THAT(file.notes, testing::IsEmpty());
  ASSERT_EQ(file.spec.worldShapes.size(), 2u);
  for (const ShapeSpec& shape : file.spec.worldShapes) EXPECT_EQ(shape.X_BS.p, Eigen::Vector3d(0, 0, .1));
  EXPECT_EQ(file.spec.worldShapes[0].name, "world");
  EXPECT_EQ(file.spec.worldShapes[1].name, "post");
  const Model model = compile(file.spec);
  std::vector<std::string> names;
  for (const Body& body : model.bodies()) names.push_back(body.name);
  EXPECT_THAT(names, testing::ElementsAre("world", "transx", "transxy", "car"));
  ASSERT_EQ(model.nq(), 3);
  EXPECT_EQ(model[model.body("transx")].parent, kWorld);
  EXPECT_EQ(model.joints()[0].name, "world>transx");

  const BodyPoses poses = forwardKinematics(model, Eigen::Vector3d(.3, -.5, .7));
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), z = Eigen::Vector3d::UnitZ();
  EXPECT_TRUE(isApprox(poses[kWorld], Pose{}, 0));
  const Pose transx = translation(0, 0, .1) * rotation(.3, x);
  EXPECT_TRUE(isApprox(poses[model.body("transx")], transx, 1e-15));
  const Pose transxy = transx * translation(0, 1, 0) * rotation(-.5, x);
  EXPECT_TRUE(isApprox(poses[model.body("transxy")], transxy, 1e-15));
  EXPECT_TRUE(isApprox(poses[model.body("car")], transxy * rotation(.7, z), 1e-15));
}

// Its pose places what refers to it later; the frame of a joint with X is one in the world all the same.
TEST(OrsReader, PlacesWhatHangsOnABodyCalledWorld) {
  const SceneSpec spec = read(
      "body world { X=<T t(0 0 2)> }\nbody a {}\nbody b { X=<T t(5 0 0)> }\n"
      "joint (world a) { A=<T t(1 0 0)> }\njoint (world b) { X=<T t(4 0 0)> }\n"
      "pin (world a) { A=[1 1 1] B=[1 1 1] }");
  EXPECT_EQ(spec.joints[0].X_PF.p, Eigen::Vector3d(1, 0, 2));
  EXPECT_EQ(spec.joints[1].X_PF.p, Eigen::Vector3d(4, 0, 0));
  EXPECT_EQ(spec.pins[0].p_AP, Eigen::Vector3d(1, 1, 3));
  EXPECT_EQ(spec.pins[0].p_BQ, Eigen::Vector3d(1, 1, 1));
}

TEST(OrsReader, ReadsNumbersAndFlagsAsPeopleWriteThem) {
  EXPECT_EQ(read("body a { mass=1#kg\n}").bodies[0].mass, 1);
  EXPECT_EQ(read("body a { mass=1e-400 }").bodies[0].mass, 0);
  EXPECT_EQ(read("body a { mass=+5 }").bodies[0].mass, 5);
  EXPECT_EQ(read("\xef\xbb\xbf"
                 "body a {}")
                .bodies.size(),
            1u);
  EXPECT_FALSE(read("body a { type=0 contact=no }").bodies[0].shapes[0].contact);
  EXPECT_FALSE(read("body a { type=0 contact=off }").bodies[0].shapes[0].contact);
  EXPECT_TRUE(read("body a { type=0 contact=yes }").bodies[0].shapes[0].contact);
}

TEST(OrsReader, LeavesItsNotesWhenItFails) {
  for (const char* broken : {"body a { mas=1 }\nbody", "Delete body b\nbody a { mass=x1 mas=1 "}) {
    Diagnostics notes;
    EXPECT_THROW(static_cast<void>(parseOrs(broken, "f", {.notesOfFailure = &notes})), Error);
    EXPECT_EQ(notes.size(), 1u);
  }
}

TEST(OrsReader, PlacesJointsByTheirWorldFrame) {
  const std::string bodies = "body a { X=<T t(1 0 0) d(90 0 0 1)> }\nbody b { X=<T t(1 2 3) d(40 1 1 0)> }\n";
  const SceneSpec spec = read(bodies + "joint (a b) { X=<T t(1 1 1) d(30 0 1 0)> }");
  const Pose X_WF = spec.bodies[0].X_WB * spec.joints[0].X_PF;
  EXPECT_TRUE(isApprox(X_WF, translation(1, 1, 1) * rotation(std::numbers::pi / 6, {0, 1, 0}), 1e-15));
  EXPECT_TRUE(isApprox(X_WF * spec.joints[0].X_MC, spec.bodies[1].X_WB, 1e-15));
}

TEST(OrsReader, ReadsWhatElseABodyCanSay) {
  const SceneSpec spec =
      read("body fixed contact post { com=[0 0 1] type=ST_mesh mesh='a.stl' hidden meshscale=2 }");
  EXPECT_EQ(spec.bodies[0].name, "post");
  EXPECT_EQ(spec.bodies[0].kind, BodyKind::kStatic);  // words before the name are flags
  EXPECT_EQ(spec.bodies[0].p_BBcm, Eigen::Vector3d::UnitZ());
  const ShapeSpec shape = spec.bodies[0].shapes.at(0);
  EXPECT_TRUE(shape.contact);
  EXPECT_FALSE(shape.visible);
  EXPECT_EQ(shape.meshScale, Eigen::Vector3d::Constant(2));
  EXPECT_EQ(read("shape { type=3 mesh='a.stl' meshscale=[1 2 3] }").worldShapes[0].meshScale,
            Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(read("shape { type=6 }").worldShapes[0].shape.type, ShapeType::kRoundedBox);
}

TEST(OrsReader, HangsShapesOnFurtherBodiesOfAName) {
  const SceneSpec spec =
      read("body a {}\nbody a {}\nshape (a) { type=0 }\nshape (-2) { type=1 }\nshape (world) { type=4 }");
  ASSERT_EQ(spec.bodies[0].shapes.size(), 1u);
  ASSERT_EQ(spec.bodies[1].shapes.size(), 1u);
  EXPECT_EQ(spec.bodies[1].shapes[0].shape.type, ShapeType::kSphere);
  EXPECT_EQ(spec.worldShapes.size(), 1u);
  EXPECT_EQ(read("body a {}\nbody b {}\njoint (-2 -1) {}").joints[0].name, "a>b");
}

TEST(OrsReader, FindsMeshesWhereChDirLeads) {
  const auto mesh = [](const std::string& text) { return read(text).worldShapes.at(0).meshFile; };
  EXPECT_EQ(mesh("ChDir='parts/../arm/'\nshape { type=3 mesh='a.stl' }"), "arm/a.stl");
  EXPECT_EQ(mesh("ChDir='parts'\nChDir='..'\nshape { type=3 mesh='a.stl' }"), "a.stl");
  EXPECT_EQ(mesh("ChDir='..'\nshape { type=3 mesh='a.stl' }"), "../a.stl");
  EXPECT_EQ(mesh("ChDir='parts'\nshape { type=3 mesh='package://p/a.stl' }"), "package://p/a.stl");
  EXPECT_EQ(mesh("ChDir='parts'\nshape { type=3 mesh='/a.stl' }"), "/a.stl");
  EXPECT_EQ(mesh("ChDir='package://p'\nshape { type=3 mesh='a.stl' }"), "package://p/a.stl");
  EXPECT_EQ(mesh("ChDir='package://p/'\nshape { type=3 mesh='a.stl' }"), "package://p/a.stl");
}

TEST(OrsReader, LoadsAThousandBodiesInAChain) {
  std::string chain = "body b0 { mass=1 }\n";
  for (int i = 1; i < 1000; ++i)
    chain += fmt::format("body b{} {{ mass=1 }}\njoint (b{} b{}) {{}}\n", i, i - 1, i);
  EXPECT_EQ(compile(read(chain)).nq(), 999);
  chain += "body c {}\nbody d {}\njoint (b0 c) {}\njoint (b0 d) {}\n";
  EXPECT_REX_ERROR(read(chain), "f:2003:1: too many joints: wanted at most 1000");
}

TEST(OrsReader, LeavesOutNotesWhenThereAreTooMany) {
  std::string text;
  for (int i = 0; i < 600; ++i) text += fmt::format("body a{:03} {{ colour, sizes, masses }}\n", i);
  const Diagnostics notes = parseOrs(text, "f").notes;
  ASSERT_EQ(notes.size(), 1001u);
  EXPECT_EQ(toString(notes.back()), "f:334:21: note: further notes are left out");
}

// Whatever is done to a scene, it is read or refused with a place.
TEST(OrsReader, SurvivesDamagedScenes) {
  const std::string good =
      "body a { X=<T t(0 0 1) d(90 1 0 0)> type=2 size=[1 1 1 .1] mass=1 inertia=[1 1 1] }\n"
      "body b { com=[0 0 1] dyntype=1 }\nshape s (-1) { type=ST_mesh mesh='m.obj' contact color=[1 0 0] }\n"
      "joint j (a b) { type=free q=[0 0 0 1 0 0 0] limits=[-1 1 -1 1 -1 1 -1 1 -1 1 -1 1 -1 1] }\n"
      "body c {}\njoint k (b c) { axis=[0 0 1] q=.1 }\nbody d {}\njoint (-3 d) { mimic=k mimic_ratio=2 }\n"
      "ChDir='x'\nEdit body a { mass=2 size=[1 2 3] }\nDelete shape s\n";
  EXPECT_EQ(compile(read(good)).nq(), 8);
  Rng rng(1);
  int refused = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text = good;
    for (int k = rng.index(4); k >= 0; --k) {
      const auto from = static_cast<std::size_t>(rng.index(static_cast<int>(good.size())));
      const auto to = static_cast<std::size_t>(rng.index(static_cast<int>(text.size())));
      text.replace(to, static_cast<std::size_t>(rng.index(4)),
                   good.substr(from, static_cast<std::size_t>(rng.index(9))));
    }
    try {
      static_cast<void>(compile(read(text)));
    } catch (const Error& error) {
      ++refused;
      ASSERT_TRUE(std::string_view(error.what()).starts_with("f:")) << error.what() << "\n" << text;
    }
  }
  EXPECT_GT(refused, 1000);
  EXPECT_LT(refused, 19000);
}

TEST(OrsReader, SaysWhichFileIsMissing) {
  EXPECT_REX_ERROR(
      readOrs(sourcePath("data/robots/mann.ors")),
      "mann.ors: cannot read the scene file: found no such file, wanted an .ors, .urdf or .xml file "
      "(did you mean 'man.ors'?)");
  EXPECT_REX_ERROR(readOrs("no/such/folder/x.ors"), "no/such/folder/x.ors: cannot read the scene file");
}

TEST(OrsReader, RefusesFilesThatAreNoScene) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "huge.ors";
  std::ofstream(file) << "body a {}";
  EXPECT_EQ(readOrs(file).spec.bodies.size(), 1u);
  std::filesystem::resize_file(file, (32u << 20) + 1);  // sparse: takes no space
  EXPECT_REX_ERROR(readOrs(file),
                   "huge.ors: scene file too large: found 33554433 bytes, wanted at most 32 MiB");
}

}  // namespace rex::ors_reader_test
