// Which way is up in Collada meshes, for each kind of scene.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/ors_writer.h"
#include "formats/scene_file.h"
#include "formats/urdf_writer.h"
#include "support/temporary_folder.h"

namespace rex::collada_axis_test {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A tetrahedron with edges of 1, 2 and 3 along x, y and z of the file.
std::string tetrahedron(const std::string& asset) {
  return R"(<?xml version="1.0"?><COLLADA version="1.4.1"><asset>)" + asset +
         R"(</asset><library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="a" count="12">0 0 0 1 0 0 0 2 0 0 0 3</float_array><technique_common>
    <accessor source="#a" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
    <param name="Z" type="float"/></accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 1 2 3 0 3 2</p>
    </triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node>
    <instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
    <scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

constexpr const char* kUrdf =
    "<robot name='r'><link name='a'><visual><origin xyz='1 2 3'/><geometry><mesh "
    "filename='m.dae'/></geometry>"
    "</visual><collision><geometry><mesh filename='m.dae' scale='1 10 100'/></geometry></collision></link>"
    "</robot>";
constexpr const char* kOrs =
    "body a { type=3 mesh='m.dae' contact rel=<T t(1 2 3)> }\nshape (a) { type=3 mesh='m.dae' "
    "meshscale=[1 10 100] }";

class ColladaAxis : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = folder_.path() / name;
    std::ofstream(file) << text;
    return file;
  }
  void useAxis(const std::string& axis) const {
    write("m.dae", tetrahedron(axis.empty() ? "" : "<up_axis>" + axis + "</up_axis>"));
  }
  TemporaryFolder folder_;
};

// Where the ends of the edges along x, y and z of the file are on the body.
Eigen::Matrix3d tips(const ShapeSpec& shape, const Vector3d& scale = Vector3d::Ones()) {
  Eigen::Matrix3d found;
  for (int axis = 0; axis < 3; ++axis) {
    const double length = (axis + 1) * scale[axis];
    for (const Eigen::Vector3f& p : shape.shape.mesh.positions())
      if (std::abs(p.norm() - length) < 1e-5 * length)
        found.col(axis) = shape.X_BS.R * p.cast<double>() / length;
  }
  return found;
}

// Columns: where x, y and z of the file point if its up axis becomes z.
Eigen::Matrix3d turnOf(const std::string& axis) {
  Eigen::Matrix3d turn;
  if (axis == "X_UP")
    turn << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  else if (axis == "Z_UP")
    turn.setIdentity();
  else
    turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return turn;
}

const char* const kAxes[] = {"X_UP", "Y_UP", "Z_UP", ""};

TEST_F(ColladaAxis, IsIgnoredInUrdfAndRespectedInOrs) {
  const Eigen::Matrix3d raw = Eigen::Matrix3d::Identity();
  for (const std::string axis : kAxes) {
    useAxis(axis);
    const std::filesystem::path urdf = write("r.urdf", kUrdf), ors = write("r.ors", kOrs);
    const auto shapeOf = [](const std::filesystem::path& file, UpAxis up, std::size_t i) {
      return readScene(file, {.upAxis = up}).spec.bodies.at(0).shapes.at(i);
    };
    EXPECT_TRUE(tips(shapeOf(urdf, UpAxis::kAsUsual, 0)).isApprox(raw, 1e-6)) << axis;
    EXPECT_TRUE(tips(shapeOf(urdf, UpAxis::kIgnored, 0)).isApprox(raw, 1e-6)) << axis;
    EXPECT_TRUE(tips(shapeOf(urdf, UpAxis::kRespected, 0)).isApprox(turnOf(axis), 1e-6)) << axis;
    EXPECT_TRUE(tips(shapeOf(ors, UpAxis::kAsUsual, 0)).isApprox(turnOf(axis), 1e-6)) << axis;
    EXPECT_TRUE(tips(shapeOf(ors, UpAxis::kRespected, 0)).isApprox(turnOf(axis), 1e-6)) << axis;
    EXPECT_TRUE(tips(shapeOf(ors, UpAxis::kIgnored, 0)).isApprox(raw, 1e-6)) << axis;
    // What is touched is the mesh that is there, scaled along its axes.
    const ShapeSpec touched = shapeOf(urdf, UpAxis::kAsUsual, 1);
    EXPECT_TRUE(tips(touched, {1, 10, 100}).isApprox(raw, 1e-6)) << axis;
    EXPECT_EQ(touched.shape.hull.halfBounds(), touched.shape.mesh.halfBounds());
    EXPECT_EQ(touched.shape.hull.halfBounds(), Vector3d(1, 20, 300));
    EXPECT_LT((shapeOf(ors, UpAxis::kAsUsual, 0).shape.hull.halfBounds() -
               turnOf(axis).cwiseAbs() * Vector3d(1, 2, 3))
                  .norm(),
              1e-6);
  }
}

// One file, read both ways in one scene.
TEST_F(ColladaAxis, BelongsToTheKindOfSceneThatNamesTheMesh) {
  useAxis("Y_UP");
  write("r.urdf", kUrdf);
  const SceneSpec spec =
      readScene(write("all.ors", "body b { type=3 mesh='m.dae' }\nurdf r { file='r.urdf' }\n")).spec;
  ASSERT_EQ(spec.bodies.size(), 2u);
  for (const BodySpec& body : spec.bodies) {
    const bool isOfRobot = body.name != "b";
    EXPECT_TRUE(tips(body.shapes[0]).isApprox(isOfRobot ? Eigen::Matrix3d::Identity() : turnOf("Y_UP"), 1e-6))
        << body.name;
  }
}

// A copy of the shapes by another kind of file looks the same.
TEST_F(ColladaAxis, SurvivesConversion) {
  for (const std::string axis : kAxes) {
    useAxis(axis);
    for (const bool isUrdf : {true, false}) {
      const SceneSpec spec = readScene(write(isUrdf ? "a.urdf" : "a.ors", isUrdf ? kUrdf : kOrs)).spec;
      const std::filesystem::path other = isUrdf ? write("b.ors", writeOrs(spec, folder_.path()))
                                                 : write("b.urdf", writeUrdf(spec, folder_.path()).text);
      const SceneSpec again = readScene(other).spec;
      const auto cornersOf = [](const SceneSpec& one, std::size_t i) {
        const ShapeSpec& shape = one.bodies[0].shapes.at(i);
        std::vector<std::array<long, 3>> all;
        for (const Eigen::Vector3f& p : shape.shape.mesh.positions()) {
          const Vector3d q = shape.X_BS * p.cast<double>() * 1e3;
          all.push_back({std::lround(q.x()), std::lround(q.y()), std::lround(q.z())});
        }
        std::sort(all.begin(), all.end());
        return all;
      };
      for (const std::size_t i : {0u, 1u})
        // A shape of .ors that is drawn and touched becomes two in URDF.
        EXPECT_EQ(cornersOf(spec, i), cornersOf(again, again.bodies[0].shapes.size() > 2 && i == 1 ? 2 : i))
            << axis << isUrdf;
    }
  }
}

TEST_F(ColladaAxis, IsToldWhereTheReadingsDiffer) {
  const auto notesOf = [&](const char* name, const char* text) {
    std::vector<std::string> notes;
    for (const Diagnostic& one : readScene(write(name, text)).notes) notes.push_back(toString(one));
    return notes;
  };
  useAxis("Z_UP");
  EXPECT_THAT(notesOf("r.urdf", kUrdf), IsEmpty());
  EXPECT_THAT(notesOf("r.ors", kOrs), IsEmpty());
  useAxis("X_UP");
  EXPECT_THAT(
      notesOf("r.urdf", kUrdf),
      ElementsAre(HasSubstr("r.urdf:1:87: note: the up axis of the Collada file 'm.dae' is x; that is "
                            "ignored, as in ROS; --up-axis=respected is the other reading")));
  EXPECT_THAT(
      notesOf("r.ors", kOrs),
      ElementsAre(HasSubstr("note: the up axis of the Collada file 'm.dae' is x; that is respected: the "
                            "mesh is turned to z up; --up-axis=ignored is the other reading")));
  useAxis("Y_UP");
  write("n.dae", tetrahedron(""));
  EXPECT_THAT(notesOf("r.ors", "shape { type=3 mesh='m.dae' }\nshape { type=3 mesh='n.dae' }"),
              ElementsAre(HasSubstr("'m.dae' is y; that and of 1 more is respected")));
}

}  // namespace rex::collada_axis_test
