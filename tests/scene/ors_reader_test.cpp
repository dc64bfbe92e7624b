#include "scene/ors_reader.h"

#include <filesystem>
#include <fstream>
#include <numbers>

#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex {
namespace {

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
  EXPECT_EQ(read("body a { kinematic }").bodies[0].kind, BodyKind::kKinematic);
  EXPECT_EQ(read("body a { dyntype=2 }").bodies[0].kind, BodyKind::kStatic);
  const ShapeSpec shape = read("body a { type=1 contact color=[0 1 0] }").bodies[0].shapes[0];
  EXPECT_TRUE(shape.contact);
  EXPECT_EQ(shape.color.head<3>(), Eigen::Vector3d(0, 1, 0));
}

TEST(OrsReader, ReadsInertia) {
  EXPECT_FALSE(read("body a { mass=1 }").bodies[0].inertia.has_value());
  EXPECT_EQ(*read("body a { inertia=[1 2 3] }").bodies[0].inertia,
            Eigen::Matrix3d(Eigen::Vector3d(1, 2, 3).asDiagonal()));
  EXPECT_EQ((*read("body a { inertia=[1 2 3 .1 .2 .3] }").bodies[0].inertia)(1, 2), .3);
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

TEST(OrsReader, NotesWhatItIgnores) {
  const SceneFile file = parseOrs("body a { mas=1 gains=[1 1] }\nbody b {}\njoint (a b) { m agent=1 }", "f");
  ASSERT_EQ(file.notes.size(), 4u);
  EXPECT_EQ(toString(file.notes[0]),
            "f:1:10: note: body 'a': unknown attribute 'mas' is ignored (did you mean 'mass'?)");
  EXPECT_EQ(toString(file.notes[1]), "f:1:16: note: body 'a': unknown attribute 'gains' is ignored");
  EXPECT_EQ(toString(file.notes[2]), "f:3:15: note: joint 'a>b': unknown attribute 'm' is ignored");
  EXPECT_EQ(toString(file.notes[3]),
            "f:3:23: note: joint 'a>b': attribute 'agent' is ignored: one agent moves all joints");
}

// QQQ marks the typo in an otherwise right snippet.
TEST(OrsReader, SaysWhatIsWrongWhere) {
  const std::string bodies = "body arm {}\nbody hand {}\n";
  EXPECT_REX_ERROR(
      read("bodyQ a {}"),
      "f:1:1: unknown statement: found 'bodyQ', wanted 'body', 'shape' or 'joint' (did you mean 'body'?)");
  EXPECT_REX_ERROR(read("body { mass=1 }"), "f:1:1: body without a name: wanted 'body NAME { ... }'");
  EXPECT_REX_ERROR(read("body a\n{ mass=1 }"),
                   "f:2:1: a value without a name: found {...}, wanted '{' on the line");
  EXPECT_REX_ERROR(read("body a = 3"), "f:1:10: body 'a': found the number 3, wanted {attributes}");
  EXPECT_REX_ERROR(read("body a {}\nbody b (a) {}"),
                   "f:2:9: body 'b': found parents, wanted none: joints connect bodies");
  EXPECT_REX_ERROR(read("body a { mass=QQQ }"),
                   "f:1:15: body 'a': attribute 'mass': found 'QQQ', wanted a number");
  EXPECT_REX_ERROR(read("body a { mass=-1 }"), "body 'a': attribute 'mass': found -1, wanted a mass >= 0 kg");
  EXPECT_REX_ERROR(read("body a { X=[1 2 3] }"), "attribute 'X': found an array of 3, wanted a pose <T ...>");
  EXPECT_REX_ERROR(read("body a { type=77 }"),
                   "f:1:15: body 'a': unknown type: found the number 77, wanted a number from 0 to 9");
  EXPECT_REX_ERROR(read("body a { type=ST_capsul }"),
                   "unknown type: found 'ST_capsul', wanted a number from 0 to 9 or a name such as 'ST_box' "
                   "(did you mean 'ST_capsule'?)");
  EXPECT_REX_ERROR(
      read("body a { type=0 size=[1 2] }"),
      "f:1:22: body 'a': attribute 'size': found an array of 2, wanted an array of 3 or 4 numbers");
  EXPECT_REX_ERROR(read("body a { type=0 size=[1 2 -3] }"),
                   "attribute 'size': found -3, wanted lengths that are not negative");
  EXPECT_REX_ERROR(read("body a { dyntype=5 }"), "unknown dyntype: found the number 5");
  EXPECT_REX_ERROR(
      read(bodies + "shape (amr) { type=0 }"),
      "f:3:8: shape: unknown parent: found 'amr', wanted the name of an earlier body (did you mean 'arm'?)");
  EXPECT_REX_ERROR(read(bodies + "shape s (arm) { size=[1 1 1] }"),
                   "f:3:1: shape 's': attribute 'type' is missing: wanted type=0 .. type=9");
  EXPECT_REX_ERROR(read(bodies + "shape s (arm hand) { type=0 }"),
                   "f:3:14: shape 's': found 2 parents, wanted one body, or none");
  EXPECT_REX_ERROR(read(bodies + "joint (arm hnad) {}"),
                   "f:3:12: joint 'arm>hnad': unknown parent: found 'hnad', wanted the name of an earlier "
                   "body (did you mean 'hand'?)");
  EXPECT_REX_ERROR(read(bodies + "joint j (arm) {}"),
                   "f:3:1: joint 'j': found 1 bodies, wanted two: joint NAME (FROM TO) {...}");
  EXPECT_REX_ERROR(
      read(bodies + "joint j (arm hand) { type=hingQ }"),
      "unknown type: found 'hingQ', wanted a number from 0 to 14 or a name such as 'hingeX' (did you mean");
  EXPECT_REX_ERROR(read(bodies + "joint j (arm hand) { axis=[0 0 0] }"),
                   "attribute 'axis': found a zero vector, wanted a direction");
  EXPECT_REX_ERROR(read(bodies + "joint j (arm hand) { limits=[1] }"),
                   "attribute 'limits': found an array of 1, wanted an array of 2 numbers");
  EXPECT_REX_ERROR(read(bodies + "joint j (arm hand) { limits=[1 -1] }"),
                   "attribute 'limits': found 1 > -1, wanted pairs 'low high'");
  EXPECT_REX_ERROR(read(bodies + "joint j (arm hand) { type=9 q=1 }"),
                   "attribute 'q': found a number, wanted Q=<T ...>, because this joint has 2 coordinates");
  EXPECT_REX_ERROR(read(bodies + "joint j (arm hand) { X=<T> }"),
                   "attribute 'X' is not supported yet: wanted 'A' and 'B'");
  EXPECT_REX_ERROR(read("Include='other.ors'"), "f:1:1: statement 'Include' is not supported yet");
}

TEST(OrsReader, SaysWhichFileIsMissing) {
  EXPECT_REX_ERROR(
      readOrs(sourcePath("data/robots/mann.ors")),
      "mann.ors: cannot read the scene file: wanted an .ors or .urdf file (did you mean 'man.ors'?)");
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

}  // namespace
}  // namespace rex
