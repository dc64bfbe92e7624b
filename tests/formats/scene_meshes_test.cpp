#include "formats/scene_meshes.h"

#include <fstream>

#include <gtest/gtest.h>

#include "formats/ors_reader.h"
#include "scene/model.h"
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
      ":4097:21: shape '': mesh: found mesh file number 4097, wanted at most 4096 different ones "
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
  EXPECT_REX_ERROR(readOrs(scene(text + "shape { type=3 mesh='meshes/cloud.ply' meshscale=21 }")),
                   ":21:21: shape '': mesh '" + (folder_.path() / "meshes/cloud.ply").string() +
                       "': all meshes so far: found 6300000 vertices, wanted at most 6000000 in all files "
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
                "found (did you mean 'pyramid.off'?); boxes of 0.1 m replace what is missing; wanted " +
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
                         "is 'dae/base.dae'; boxes of 0.1 m replace what is missing; wanted one of "));
  EXPECT_THAT(toString(file.notes[1]),
              testing::HasSubstr(":2:21: warning: mesh 'x.stl' of the folder of the scene was not found"));
}

// As MeshLab and programs for Collada write what they show as opaque.
TEST_F(SceneMeshes, AreNeverInvisible) {
  const std::filesystem::path meshes = folder_.path() / "meshes";
  std::ofstream(meshes / "two.mtl") << "newmtl clear\nKd 1 0 0\nTr 1\nnewmtl half\nKd 0 1 0\nd .5\n";
  std::ofstream(meshes / "two.obj") << "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                       "usemtl clear\nf 1 2 3\nusemtl half\nf 1 2 4\n";
  std::ofstream(meshes / "clear.dae") << R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>Z_UP</up_axis></asset>
<library_effects><effect id="e"><profile_COMMON><technique sid="t"><lambert>
<diffuse><color>0 0 1 1</color></diffuse>
<transparent opaque="A_ONE"><color>1 1 1 1</color></transparent>
<transparency><float>0</float></transparency>
</lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m" name="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
<accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles material="s" count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="sc"><node><instance_geometry url="#g"><bind_material>
<technique_common><instance_material symbol="s" target="#m"/></technique_common></bind_material>
</instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#sc"/></scene></COLLADA>)";
  const std::filesystem::path file = scene(
      "shape a { type=3 mesh='meshes/two.obj' }\nshape b { type=3 mesh='meshes/two.obj' meshscale=2 }\n"
      "shape c { type=3 mesh='meshes/clear.dae' }");
  const SceneFile read = readOrs(file);
  for (int i = 0; i < 2; ++i) {
    const auto parts = read.spec.worldShapes[static_cast<std::size_t>(i)].shape.mesh.parts();
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_TRUE(parts[0].color->isApprox(Eigen::Vector4f(1, 0, 0, 1)));
    EXPECT_TRUE(parts[1].color->isApprox(Eigen::Vector4f(0, 1, 0, .5f)));
  }
  EXPECT_TRUE(read.spec.worldShapes[2].shape.mesh.parts()[0].color->isApprox(Eigen::Vector4f(0, 0, 1, 1)));
  const std::string fault = "a material: found full transparency, wanted one that can be seen";
  const std::string first = "shape 'a': mesh '" + (meshes / "two.obj").string() + "': " + fault;
  ASSERT_EQ(read.notes.size(), 2u) << "one for each file";
  EXPECT_EQ(toString(read.notes[0]), file.string() + ":1:23: warning: " + first + "; it is drawn opaque");
  EXPECT_EQ(toString(read.notes[1]), file.string() + ":3:23: warning: shape 'c': mesh '" +
                                         (meshes / "clear.dae").string() + "': " + fault +
                                         "; it is drawn opaque");
  EXPECT_REX_ERROR(readOrs(file, {.strict = true}), file.string() + ":1:23: " + first);
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
