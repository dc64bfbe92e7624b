#include "scene/scene_meshes.h"

#include <fstream>

#include <gtest/gtest.h>

#include "scene/model.h"
#include "scene/ors_reader.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::scene_meshes_test {

// A square pyramid of height 3 on the plane z = 0, and as many vertices elsewhere as nowhere.
constexpr const char* kPyramid =
    "OFF\n5 5 8\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n1 1 3\n4 0 3 2 1\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";

class SceneMeshes : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(folder_.path() / "meshes");
    std::ofstream(folder_.path() / "meshes/pyramid.off") << kPyramid;
  }

  std::filesystem::path scene(const std::string& text) const {
    const std::filesystem::path file = folder_.path() / "scene.ors";
    std::ofstream(file) << text;
    return file;
  }

  TemporaryFolder folder_;
};

TEST_F(SceneMeshes, AreReadBesideTheirScene) {
  const SceneSpec spec = readOrs(scene("body a { type=3 mesh='meshes/pyramid.off' meshscale=0.5 }\n"
                                       "shape (a) { type=3 mesh='meshes/pyramid.off' meshscale=0.5 }\n"
                                       "shape { type=7 mesh='meshes/pyramid.off' }\n"
                                       "shape { type=8 mesh='meshes/pyramid.off' size=[0 0 0 .1] }"))
                             .spec;
  const Shape& first = spec.bodies[0].shapes[0].shape;
  EXPECT_EQ(first.mesh.triangles().size(), 6u);
  EXPECT_EQ(first.mesh, spec.bodies[0].shapes[1].shape.mesh) << "one file is read once";
  EXPECT_EQ(halfBounds(spec.worldShapes[0].shape), Eigen::Vector3d(2, 2, 3));
  EXPECT_LT((halfBounds(spec.worldShapes[1].shape) - Eigen::Vector3d(2.1, 2.1, 3.1)).norm(), 1e-12);
  EXPECT_EQ(compile(spec).shapes().size(), 4u);
}

// A file is read once for all its sizes; what has the same size is shared.
TEST_F(SceneMeshes, HaveTheirOwnScale) {
  const SceneSpec spec = readOrs(scene("shape { type=3 mesh='meshes/pyramid.off' meshscale=[1 -2 1] }\n"
                                       "shape { type=3 mesh='meshes/pyramid.off' }\n"
                                       "shape { type=3 mesh='meshes/pyramid.off' meshscale=[1 -2 1] }"))
                             .spec;
  EXPECT_EQ(halfBounds(spec.worldShapes[0].shape), Eigen::Vector3d(2, 4, 3));
  EXPECT_EQ(halfBounds(spec.worldShapes[1].shape), Eigen::Vector3d(2, 2, 3));
  EXPECT_EQ(spec.worldShapes[0].shape.mesh, spec.worldShapes[2].shape.mesh);
}

TEST_F(SceneMeshes, AreNotTooManyTogether) {
  std::string text;
  for (int i = 1; i <= 4097; ++i) text += "shape { type=3 mesh='m" + std::to_string(i) + ".off' }\n";
  EXPECT_REX_ERROR(
      readOrs(scene(text), {.allowMissingMeshes = true}),
      ":4097:21: shape '': mesh: found the 4097th file of meshes, wanted at most 4096 different ones "
      "in a scene");
  std::ofstream cloud(folder_.path() / "meshes/cloud.ply");
  cloud << "ply\nformat ascii 1.0\nelement vertex 300000\nproperty float x\nproperty float y\n"
        << "property float z\nend_header\n";
  for (int i = 0; i < 300'000; ++i) cloud << i % 1000 << " 0 0\n";
  cloud.close();
  text.clear();
  for (int i = 1; i <= 20; ++i)
    text += "shape { type=3 mesh='meshes/cloud.ply' meshscale=" + std::to_string(i) + " }\n";
  EXPECT_EQ(readOrs(scene(text)).spec.worldShapes.size(), 20u);
  EXPECT_REX_ERROR(
      readOrs(scene(text + "shape { type=3 mesh='meshes/cloud.ply' meshscale=21 }")),
      ":21:21: shape '': mesh '" + (folder_.path() / "meshes/cloud.ply").string() +
          "': all meshes up to here: found 6300000 vertices, wanted at most 6000000 in all files "
          "and scales of a scene");
}

TEST_F(SceneMeshes, StandWhereTheFilePutsThem) {
  const SceneSpec spec =
      readOrs(scene("shape { type=3 mesh='meshes/pyramid.off' rel=<T t(5 0 0) d(90 0 0 1)> }")).spec;
  const ShapeSpec& shape = spec.worldShapes[0];
  EXPECT_EQ(shape.X_BS.p, Eigen::Vector3d(5, 0, 0));
  EXPECT_EQ(halfBounds(shape.shape), Eigen::Vector3d(2, 2, 3));
  EXPECT_EQ(shape.meshPath, folder_.path() / "meshes/pyramid.off");
}

TEST_F(SceneMeshes, AreReadOnce) {
  SceneFile file = readOrs(scene("shape { type=3 mesh='meshes/pyramid.off' }"));
  const TriangleMesh mesh = file.spec.worldShapes[0].shape.mesh;
  loadMeshes(file, Assets(folder_.path() / "scene.ors"));
  EXPECT_EQ(file.spec.worldShapes[0].shape.mesh, mesh);
}

TEST_F(SceneMeshes, AreNamesOnlyInText) {
  const SceneSpec spec = parseOrs("body a { type=3 mesh='meshes/pyramid.off' }", "f").spec;
  EXPECT_TRUE(spec.bodies[0].shapes[0].shape.mesh.isEmpty());
  EXPECT_EQ(spec.bodies[0].shapes[0].meshFile, "meshes/pyramid.off");
  EXPECT_EQ(compile(spec).shapes().size(), 1u);
}

TEST_F(SceneMeshes, HaveHullsWhereTheyCollide) {
  const SceneSpec spec = readOrs(scene("body a { type=3 mesh='meshes/pyramid.off' contact }\n"
                                       "shape (a) { type=3 mesh='meshes/pyramid.off' contact }\n"
                                       "shape (a) { type=3 mesh='meshes/pyramid.off' }"))
                             .spec;
  const auto& shapes = spec.bodies[0].shapes;
  EXPECT_EQ(shapes[0].shape.hull.positions().size(), 5u);
  EXPECT_EQ(shapes[0].shape.hull.triangles().size(), 6u);
  EXPECT_EQ(shapes[0].shape.hull, shapes[1].shape.hull) << "one mesh has one hull";
  EXPECT_TRUE(shapes[2].shape.hull.isEmpty());
  EXPECT_EQ(halfBounds(shapes[0].shape), halfBounds(shapes[2].shape));
}

TEST_F(SceneMeshes, AreRefusedWhereTheyCollideWithTooManyVertices) {
  std::ofstream file(folder_.path() / "meshes/fine.obj");
  for (int i = 0; i <= 100'000; ++i) file << "v " << i << " 0 " << i % 2 << '\n';
  for (int i = 3; i <= 100'001; ++i) file << "f " << i - 2 << ' ' << i - 1 << ' ' << i << '\n';
  file.close();
  EXPECT_EQ(readOrs(scene("body a { type=3 mesh='meshes/fine.obj' }")).spec.bodies.size(), 1u);
  EXPECT_REX_ERROR(
      readOrs(scene("body a {}\nshape hat (a) { type=3 mesh='meshes/fine.obj' contact }")),
      "scene.ors:2:29: shape 'hat': mesh in contact: convex hull: found 100001 different points, "
      "wanted at most 100000: a coarser mesh for contact, or none");
}

TEST_F(SceneMeshes, ThatAreMissingMayBecomeBoxes) {
  const SceneFile file = readOrs(scene("body a { type=3 mesh='meshes/pyramit.off' contact size=[1 1 1 .3] }\n"
                                       "shape (a) { type=3 mesh='meshes/pyramid.off' }"),
                                 {.allowMissingMeshes = true});
  const ShapeSpec& shape = file.spec.bodies[0].shapes[0];
  EXPECT_EQ(shape.shape.type, ShapeType::kBox);
  EXPECT_EQ(shape.shape.extent, Eigen::Vector3d::Constant(0.1));
  EXPECT_TRUE(shape.contact && shape.meshMissing);
  EXPECT_EQ(shape.meshFile, "meshes/pyramit.off");
  EXPECT_EQ(file.spec.bodies[0].shapes[1].shape.type, ShapeType::kMesh);
  EXPECT_FALSE(file.spec.bodies[0].shapes[1].meshMissing);
  ASSERT_EQ(file.notes.size(), 1u);
  EXPECT_EQ(file.notes[0].severity, Severity::kWarning);
  EXPECT_EQ(toString(file.notes[0]),
            (folder_.path() / "scene.ors").string() +
                ":1:22: warning: mesh 'pyramit.off' of 'meshes' was not " +
                "found (did you mean 'pyramid.off'?); boxes of 0.1 m stand for what is missing; wanted " +
                (folder_.path() / "meshes/pyramit.off").string());
  EXPECT_EQ(compile(file.spec).shapes().size(), 2u);
}

TEST_F(SceneMeshes, ThatAreMissingShareAWarningInAPackageOrFolder) {
  const auto mesh = [](const std::string& name) { return "shape { type=3 mesh='" + name + "' }\n"; };
  const SceneFile file =
      readOrs(scene(mesh("package://dog/dae/base.dae") + mesh("x.stl") + mesh("package://dog/dae/leg.dae") +
                    mesh("package://dog/hip.stl") + mesh("package://dog/hip.stl")),
              {.allowMissingMeshes = true});
  ASSERT_EQ(file.notes.size(), 2u);
  EXPECT_THAT(
      toString(file.notes[0]),
      testing::HasSubstr("scene.ors:1:21: warning: 3 meshes of package://dog were not found, the first "
                         "is 'dae/base.dae'; boxes of 0.1 m stand for what is missing; wanted one of "));
  EXPECT_THAT(toString(file.notes[1]),
              testing::HasSubstr(":2:21: warning: mesh 'x.stl' of the folder of the scene was not found"));
}

TEST_F(SceneMeshes, ThatAreBrokenAreNeverBoxes) {
  std::ofstream(folder_.path() / "meshes/broken.off") << "OFF\n0 0 0\n";
  EXPECT_REX_ERROR(readOrs(scene("body a { type=3 mesh='meshes/broken.off' }"), {.allowMissingMeshes = true}),
                   "shape 'a': mesh '");
}

TEST_F(SceneMeshes, ThatAreMissingAreNamedWithTheirPlace) {
  EXPECT_REX_ERROR(readOrs(scene("body a {}\nshape hat (a) { type=3 mesh='meshes/pyramit.off' }")),
                   "scene.ors:2:29: shape 'hat': mesh: found no file 'meshes/pyramit.off', wanted " +
                       (folder_.path() / "meshes/pyramit.off").string() + " (did you mean 'pyramid.off'?)");
  EXPECT_REX_ERROR(readOrs(scene("body a { type=3 }")),
                   "shape 'a': attribute 'mesh' is missing: wanted the file of its mesh, in single quotes");
  EXPECT_REX_ERROR(readOrs(scene("body a { type=3 mesh='meshes/pyramid.off' meshscale=0 }")),
                   "scale of the mesh: found (0, 0, 0), wanted numbers from 1e-9 to 1e9, or their negatives");
}

}  // namespace rex::scene_meshes_test
