// Geoms that are fitted to meshes.
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/mjcf_reader.h"
#include "geometry/rotation.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::mjcf_fit_test {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::HasSubstr;

// A brick of 0.2 x 0.4 x 0.6 with a corner at the origin.
constexpr const char* kBrick =
    "OFF\n8 6 12\n0 0 0\n2 0 0\n2 4 0\n0 4 0\n0 0 6\n2 0 6\n2 4 6\n0 4 6\n4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n"
    "4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

class MjcfFit : public testing::Test {
 protected:
  SceneFile read(const std::string& geom, const std::string& compiler = "",
                 const std::string& body = "") const {
    std::ofstream(folder_.path() / "brick.off") << kBrick;
    std::ofstream(folder_.path() / "m.xml")
        << "<mujoco><compiler " + compiler + "/><asset><mesh name='brick' file='brick.off' scale='.1 .1 .1'/>"
        << "</asset><worldbody><body name='a'>" + geom + "</body>" + body + "</worldbody></mujoco>";
    return readMjcf(folder_.path() / "m.xml");
  }
  ShapeSpec fitted(const std::string& geom, const std::string& compiler = "") const {
    return read(geom, compiler).spec.bodies.at(0).shapes.at(0);
  }
  TemporaryFolder folder_;
};

// The brick is its own inertia box; MuJoCo's other solids are told by its half edges 0.1, 0.2 and 0.3.
TEST_F(MjcfFit, HasTheInertiaOfTheMesh) {
  const ShapeSpec box = fitted("<geom type='box' mesh='brick'/>");
  EXPECT_EQ(box.shape.type, ShapeType::kBox);
  EXPECT_LT((box.shape.extent - Vector3d(.2, .4, .6)).norm(), 1e-6);
  EXPECT_LT((box.X_BS.p - Vector3d(.1, .2, .3)).norm(), 1e-6);
  EXPECT_TRUE(box.X_BS.R.cwiseAbs().isIdentity(1e-6));
  EXPECT_GT(box.X_BS.R.determinant(), 0);
  EXPECT_TRUE(box.contact);
  EXPECT_EQ(box.meshFile, "");
  const ShapeSpec capsule = fitted("<geom type='capsule' mesh='brick'/>");
  EXPECT_NEAR(capsule.shape.radius, .15, 1e-6);
  EXPECT_NEAR(capsule.shape.extent.z(), 2 * (.3 - .15 / 2), 1e-6);
  const ShapeSpec cylinder = fitted("<geom type='cylinder' mesh='brick'/>");
  EXPECT_NEAR(cylinder.shape.radius, .15, 1e-6);
  EXPECT_NEAR(cylinder.shape.extent.z(), .6, 1e-6);
  EXPECT_NEAR(fitted("<geom mesh='brick'/>").shape.radius, .2, 1e-6) << "a sphere is the default type";
  const ShapeSpec ellipsoid = fitted("<geom type='ellipsoid' mesh='brick' fitscale='2' contype='0'/>");
  EXPECT_EQ(ellipsoid.shape.type, ShapeType::kEllipsoid);
  EXPECT_LT((ellipsoid.shape.extent - Vector3d(.4, .8, 1.2)).norm(), 1e-6);
  EXPECT_EQ(ellipsoid.mask.type, 0u);
}

// The principal frame turns with the geom, and z is the longest axis.
TEST_F(MjcfFit, IsPlacedByItsGeom) {
  const ShapeSpec shape = fitted("<geom type='capsule' mesh='brick' pos='1 0 0' euler='90 0 0'/>");
  const Pose X_BG{rotationAboutAxis(M_PI / 2, Vector3d::UnitX()), Vector3d::UnitX()};
  EXPECT_LT((shape.X_BS.p - X_BG * Vector3d(.1, .2, .3)).norm(), 1e-6);
  EXPECT_NEAR(std::abs(shape.X_BS.R.col(2).dot(X_BG.R.col(2))), 1, 1e-6);
}

TEST_F(MjcfFit, IsAroundTheMeshIfAsked) {
  const std::string bounds = "fitaabb='true'";
  EXPECT_LT((fitted("<geom type='box' mesh='brick'/>", bounds).shape.extent - Vector3d(.2, .4, .6)).norm(),
            1e-6);
  EXPECT_NEAR(fitted("<geom mesh='brick'/>", bounds).shape.radius, Vector3d(.1, .2, .3).norm(), 1e-6);
  const double radius = std::hypot(.1, .2);
  const ShapeSpec capsule = fitted("<geom type='capsule' mesh='brick'/>", bounds);
  EXPECT_NEAR(capsule.shape.radius, radius, 1e-6);
  EXPECT_NEAR(capsule.shape.extent.z(), .6, 1e-6) << "its corners are on the rim";
  EXPECT_NEAR(fitted("<geom type='cylinder' mesh='brick'/>", bounds).shape.extent.z(), .6, 1e-6);
}

TEST_F(MjcfFit, WeighsWhatItsSolidWeighs) {
  const SceneFile scene = read("<geom type='capsule' mesh='brick' density='500'/>", "",
                               "<body name='b'><geom type='capsule' size='.15 .225' pos='.1 .2 .3' "
                               "density='500'/></body>");
  const BodySpec &a = scene.spec.bodies.at(0), &b = scene.spec.bodies.at(1);
  EXPECT_NEAR(a.mass, b.mass, 1e-5 * b.mass);
  EXPECT_LT((a.p_BBcm - b.p_BBcm).norm(), 1e-6);
  EXPECT_LT((*a.inertia - *b.inertia).norm(), 1e-5 * b.inertia->norm());
}

TEST_F(MjcfFit, TellsWhatItCannotFit) {
  std::ofstream(folder_.path() / "flat.off") << "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const std::string text =
      "<mujoco><asset><mesh file='flat.off'/></asset><worldbody><body><geom mesh='flat' mass='0'/></body>"
      "</worldbody></mujoco>";
  std::ofstream(folder_.path() / "m.xml") << text;
  const SceneFile scene = readMjcf(folder_.path() / "m.xml");
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_THAT(toString(scene.notes[0]),
              HasSubstr("warning: <geom>: the mesh to fit encloses no volume, so nothing touches it"));
  EXPECT_FALSE(scene.spec.bodies[0].shapes[0].contact);
  std::string heavy = text;
  heavy.replace(heavy.find(" mass='0'"), 9, "");
  EXPECT_REX_ERROR(parseMjcf(heavy, "m.xml"),
                   "<geom>: the mass of a mesh: found a scene that was given as text");
}

}  // namespace rex::mjcf_fit_test
