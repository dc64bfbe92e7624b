#include "formats/ors_writer.h"

#include <fstream>

#include <gtest/gtest.h>

#include "formats/ors_reader.h"
#include "formats/ors_writer_internal.h"
#include "geometry/rotation.h"
#include "kinematics/jacobians.h"
#include "support/expect_error.h"
#include "support/paths.h"
#include "support/random_scene.h"
#include "support/temporary_folder.h"

namespace rex::ors_writer_test {

namespace fs = std::filesystem;

constexpr double kTolerance = 1e-12;

SceneSpec again(const SceneSpec& spec) { return parseOrs(writeOrs(spec), "again").spec; }

void expectNear(const Eigen::MatrixXd& got, const Eigen::MatrixXd& wanted, const std::string& what) {
  ASSERT_EQ(got.rows(), wanted.rows()) << what;
  ASSERT_EQ(got.cols(), wanted.cols()) << what;
  for (Eigen::Index i = 0; i < got.size(); ++i) {
    const double a = got.reshaped()[i], b = wanted.reshaped()[i];
    EXPECT_TRUE(a == b || std::abs(a - b) <= kTolerance) << what << ": " << a << " " << b;
  }
}

void expectSameShape(const ModelShape& got, const ModelShape& wanted) {
  EXPECT_EQ(got.name, wanted.name);
  EXPECT_EQ(got.body, wanted.body);
  EXPECT_TRUE(isApprox(got.X_BS, wanted.X_BS, kTolerance)) << wanted.name;
  EXPECT_EQ(got.shape.type, wanted.shape.type);
  EXPECT_EQ(got.shape.extent, wanted.shape.extent);
  EXPECT_EQ(got.shape.radius, wanted.shape.radius);
  EXPECT_EQ(got.color, wanted.color);
  EXPECT_EQ(got.contact, wanted.contact);
  EXPECT_EQ(got.visible, wanted.visible);
}

void expectSameJoint(const Joint& got, const Joint& wanted) {
  EXPECT_EQ(got.name, wanted.name);
  EXPECT_EQ(got.type, wanted.type) << wanted.name;
  EXPECT_EQ(got.parent, wanted.parent);
  EXPECT_EQ(got.child, wanted.child);
  EXPECT_EQ(got.qIndex, wanted.qIndex);
  EXPECT_EQ(got.mimics, wanted.mimics);
  EXPECT_EQ(got.ratio, wanted.ratio);
  EXPECT_EQ(got.offset, wanted.offset);
  EXPECT_EQ(got.maxVelocity, wanted.maxVelocity);
  EXPECT_EQ(got.maxEffort, wanted.maxEffort);
  EXPECT_EQ(got.damping, wanted.damping);
  EXPECT_EQ(got.friction, wanted.friction);
  EXPECT_EQ(got.armature, wanted.armature);
  EXPECT_EQ(got.stiffness, wanted.stiffness);
  EXPECT_EQ(got.springReference, wanted.springReference);
}

void expectSameBody(const Body& got, const Body& wanted) {
  EXPECT_EQ(got.name, wanted.name);
  EXPECT_EQ(got.parent, wanted.parent);
  EXPECT_EQ(got.kind, wanted.kind);
  EXPECT_EQ(got.mass, wanted.mass);
  EXPECT_EQ(got.p_BBcm, wanted.p_BBcm);
  EXPECT_EQ(got.I_BBcm_B, wanted.I_BBcm_B);
  EXPECT_EQ(got.buoyancy, wanted.buoyancy);
}

void expectSameMotion(const Model& got, const Model& wanted, Rng& rng) {
  for (int k = 0; k < 3; ++k) {
    const Eigen::VectorXd q = k == 0 ? wanted.initialPositions() : randomPositions(rng, wanted.nq());
    const BodyPoses poses = forwardKinematics(got, q), wantedPoses = forwardKinematics(wanted, q);
    for (std::size_t i = 0; i < wanted.bodies().size(); ++i) {
      const auto body = static_cast<BodyId>(i);
      const std::string what = wanted[body].name;
      EXPECT_TRUE(isApprox(poses[body], wantedPoses[body], kTolerance)) << what;
      expectNear(positionJacobian(got, poses, body, {1, 2, 3}),
                 positionJacobian(wanted, wantedPoses, body, {1, 2, 3}), what);
      expectNear(angularJacobian(got, poses, body), angularJacobian(wanted, wantedPoses, body), what);
    }
  }
}

void expectSame(const SceneSpec& gotSpec, const SceneSpec& wantedSpec, Rng& rng) {
  const Model got = compile(gotSpec), wanted = compile(wantedSpec);
  ASSERT_EQ(got.bodies().size(), wanted.bodies().size());
  ASSERT_EQ(got.joints().size(), wanted.joints().size());
  ASSERT_EQ(got.shapes().size(), wanted.shapes().size());
  ASSERT_EQ(got.nq(), wanted.nq());
  for (std::size_t i = 0; i < wanted.bodies().size(); ++i)
    expectSameBody(got.bodies()[i], wanted.bodies()[i]);
  for (std::size_t i = 0; i < wanted.joints().size(); ++i)
    expectSameJoint(got.joints()[i], wanted.joints()[i]);
  for (std::size_t i = 0; i < wanted.shapes().size(); ++i)
    expectSameShape(got.shapes()[i], wanted.shapes()[i]);
  expectNear(got.initialPositions(), wanted.initialPositions(), "initial positions");
  expectNear(got.lowerLimits(), wanted.lowerLimits(), "lower limits");
  expectNear(got.upperLimits(), wanted.upperLimits(), "upper limits");
  expectSameMotion(got, wanted, rng);
}

TEST(OrsWriter, KeepsRandomScenes) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed);
    SceneSpec spec = randomScene(rng, 31);
    addDetails(rng, spec);
    for (BodySpec& body : spec.bodies) body.buoyancy = rng.uniform(-1, 2);
    const SceneSpec got = again(spec);
    expectSame(got, spec, rng);
    for (std::size_t i = 0; i < spec.worldShapes.size(); ++i) {
      EXPECT_EQ(got.worldShapes[i].meshFile, spec.worldShapes[i].meshFile);
      EXPECT_EQ(got.worldShapes[i].meshScale, spec.worldShapes[i].meshScale);
    }
  }
}

// All scenes of the project, and the ones that may lie beside it.
class EveryFile : public testing::TestWithParam<const char*> {};

TEST_P(EveryFile, IsKept) {
  const fs::path folder = sourcePath(GetParam());
  if (!fs::exists(folder)) GTEST_SKIP() << GetParam() << " is not here";
  Rng rng(1);
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".ors") continue;
    SCOPED_TRACE(entry.path());
    const SceneSpec spec = readOrs(entry.path()).spec;
    expectSame(parseOrs(writeOrs(spec, entry.path().parent_path()), "again").spec, spec, rng);
    ++files;
  }
  EXPECT_GT(files, 0);
}

INSTANTIATE_TEST_SUITE_P(OrsWriter, EveryFile, testing::Values("data", "../shared/data/ors"));

TEST(OrsWriter, WritesTextThatPeopleRead) {
  const std::string text =
      "shape floor { type=ST_box size=[4 4 0.1] }\n"
      "\n"
      "body post       { X=<T t(0 0 0.5)> fixed type=ST_cylinder size=[0 0 1 0.05] color=[0 0 1] }\n"
      "body arm        { mass=1 com=[0 0 0.1] inertia=[1 2 3] }\n"
      "shape cap (arm) { type=ST_sphere size=[0 0 0 0.1] rel=<T d(90 1 0 0)> contact hidden }\n"
      "body hand       { }\n"
      "\n"
      "joint (post arm)      { A=<T t(0 0 0.5) d(-30 0 1 0)> q=0.1 limits=[-1 1] }\n"
      "joint grip (arm hand) { type=screw pitch=0.01 mimic=post>arm mimic_ratio=2 }\n";
  EXPECT_EQ(writeOrs(parseOrs(text, "f").spec), text);
}

TEST(OrsWriter, WritesPosesAsShortAsTheyAreExact) {
  using ors::poseText;
  EXPECT_EQ(poseText({}), "<T>");
  EXPECT_EQ(poseText(translation(1, -0.0, .1)), "<T t(1 0 0.1)>");
  EXPECT_EQ(poseText(translation(.1 + .2, 3e-18, 1e300)), "<T t(0.3 0 1e+300)>");
  EXPECT_EQ(poseText(translation(1e-8, 1. / 3, 0)), "<T t(1e-08 0.3333333333333333 0)>");
  EXPECT_EQ(poseText(rotation(std::numbers::pi / 2, {1, 0, 0})), "<T d(90 1 0 0)>");
  EXPECT_EQ(poseText(rotation(std::numbers::pi, {0, 0, 2})), "<T d(180 0 0 1)>");
  EXPECT_EQ(poseText(rotation(-std::numbers::pi / 6, {0, 1, 0})), "<T d(-30 0 1 0)>");
  EXPECT_EQ(poseText(rotation(2 * std::numbers::pi / 3, {1, 1, 1})), "<T q(0.5 0.5 0.5 0.5)>");
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    Pose X = randomPose(rng);
    if (i % 4 == 0) X.R = rotationAboutAxis(std::pow(10, -i / 50.), Eigen::Vector3d::Unit(i % 3));
    const SceneSpec spec = parseOrs("body a { X=" + poseText(X) + " }", "f").spec;
    EXPECT_TRUE(isApprox(spec.bodies[0].X_WB, X, 3e-15)) << poseText(X);
  }
}

TEST(OrsWriter, TellsApartBodiesOfOneName) {
  const SceneSpec spec = parseOrs(
                             "body a {}\nbody b {}\nbody b { type=0 }\nshape one (-1) { type=1 }\n"
                             "shape two (-2) { type=2 }\njoint (a b) {}",
                             "f")
                             .spec;
  ASSERT_EQ(spec.bodies[2].shapes.size(), 3u);
  Rng rng(1);
  expectSame(again(spec), spec, rng);
}

TEST(OrsWriter, KeepsNamesThatLookLikeOtherThings) {
  SceneSpec spec =
      parseOrs("body a {}\nbody b {}\nbody c {}\njoint true (a b) {}\njoint (a c) { mimic=\"true\" }", "f")
          .spec;
  EXPECT_EQ(again(spec).joints[1].mimic, "true");
  spec.joints[0].upper = Eigen::VectorXd::Constant(1, 2);  // only one of the limits
  EXPECT_EQ(again(spec).joints[0].lower[0], -std::numeric_limits<double>::infinity());
}

TEST(OrsWriter, LeavesOutNamesOfShapesThatTheFormatLacks) {
  SceneSpec spec = parseOrs("body a { type=1 }\nshape b (a) { type=2 }\nshape c { type=0 }", "f").spec;
  EXPECT_EQ(again(spec).bodies[0].shapes[1].name, "b");
  spec.bodies[0].shapes[0].name = "//";
  spec.bodies[0].shapes[1].name = "left arm";
  spec.worldShapes[0].name = "the \"floor\"";
  const SceneSpec read = again(spec);
  ASSERT_EQ(read.bodies[0].shapes.size(), 2u);
  EXPECT_EQ(read.bodies[0].shapes[0].shape.type, ShapeType::kSphere);
  EXPECT_EQ(read.bodies[0].shapes[1].name, "");
  ASSERT_EQ(read.worldShapes.size(), 1u);
  EXPECT_EQ(read.worldShapes[0].name, "");
}

TEST(OrsWriter, NamesMeshesAsSeenFromTheFolder) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "meshes");
  std::ofstream(folder.path() / "meshes/a.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  fs::create_directory(folder.path() / "scenes");
  std::ofstream(folder.path() / "scenes/f.ors") << "body a { type=3 mesh='../meshes/a.obj' meshscale=2 }";
  const SceneSpec spec = readOrs(folder.path() / "scenes/f.ors").spec;
  EXPECT_NE(writeOrs(spec).find("mesh='../meshes/a.obj' meshscale=2"), std::string::npos);
  EXPECT_NE(writeOrs(spec, folder.path()).find("mesh='meshes/a.obj'"), std::string::npos);
}

TEST(OrsWriter, WritesTheMeshForWhichAMarkerStands) {
  const std::string text = "shape s { type=ST_mesh contact mesh='gone.obj' }\n";
  SceneSpec spec = parseOrs(text, "f").spec;
  spec.worldShapes[0].shape = {.type = ShapeType::kBox, .extent = Eigen::Vector3d::Constant(0.1)};
  spec.worldShapes[0].meshMissing = true;
  EXPECT_EQ(writeOrs(spec), text);
}

TEST(OrsWriter, LeavesOutTheInertiaThatAMassHasAnyway) {
  SceneSpec spec = parseOrs("body a { mass=3 }", "f").spec;
  spec.bodies[0].inertia = 0.2 * 3 * Eigen::Matrix3d::Identity();
  EXPECT_EQ(writeOrs(spec), "body a { mass=3 }\n");
  spec.bodies[0].inertia = 3 * Eigen::Matrix3d::Identity();
  EXPECT_EQ(writeOrs(spec), "body a { mass=3 inertia=[3 3 3] }\n");
}

TEST(OrsWriter, RefusesWhatTheFormatCannotSay) {
  const SceneSpec good = parseOrs("body a {}\nbody b { type=3 mesh='m.obj' }\njoint j (a b) {}", "f").spec;
  const auto refused = [&](auto spoil) {
    SceneSpec spec = good;
    spoil(spec);
    return [spec] { return writeOrs(spec); };
  };
  EXPECT_REX_ERROR(
      refused([](SceneSpec& s) { s.bodies[1].name = "left arm"; })(),
      "f:2:1: body 'left arm': not a name in .ors: found 'left arm', wanted a word of at most 256 "
      "bytes without blanks and any of ,;()[]{}=!<>\"'#-, not starting with // or /*");
  EXPECT_REX_ERROR(refused([](SceneSpec& s) { s.bodies[0].name = ""; })(),
                   "f:1:1: body '': not a name in .ors");
  EXPECT_REX_ERROR(refused([](SceneSpec& s) { s.bodies[0].name = "-1"; })(), "body '-1': not a name");
  EXPECT_REX_ERROR(refused([](SceneSpec& s) { s.joints[0].name = "a=b"; })(),
                   "f:3:1: joint 'a=b': not a name");
  for (const std::string name : {"//a", "/*", "//"}) {
    EXPECT_REX_ERROR(refused([&](SceneSpec& s) { s.bodies[0].name = name; })(),
                     "body '" + name + "': not a name in .ors");
    EXPECT_REX_ERROR(refused([&](SceneSpec& s) { s.joints[0].name = name; })(),
                     "joint '" + name + "': not a name in .ors");
  }
  EXPECT_REX_ERROR(refused([](SceneSpec& s) {
                     for (int i = 0; i < 1000; ++i) {
                       s.bodies.push_back({.name = "c" + std::to_string(i), .X_WB = {}});
                       s.joints.emplace_back();
                       s.joints.back().parent = "a";
                       s.joints.back().child = s.bodies.back().name;
                     }
                   })(),
                   "written as .ors, it could not be read back: too many joints: wanted at most 1000");
  EXPECT_REX_ERROR(refused([](SceneSpec& s) { s.bodies[0].name = "world"; })(),
                   "body 'world': found the name of the world itself, wanted another name");
  EXPECT_REX_ERROR(refused([](SceneSpec& s) { s.bodies[1].shapes[0].meshFile = ""; })(),
                   "f:2:22: shape 'b': mesh: found no file, wanted a file whose name");
  EXPECT_REX_ERROR(
      refused([](SceneSpec& s) { s.bodies[1].shapes[0].meshFile = "it's.obj"; })(),
      "shape 'b': mesh: found 'it's.obj', wanted a file whose name has at most 256 bytes and no '");
}

}  // namespace rex::ors_writer_test
