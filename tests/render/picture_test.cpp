#include "render/picture.h"

#include <functional>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "geometry/rotation.h"
#include "support/expect_error.h"

namespace rex::picture_test {

const double kNan = std::numeric_limits<double>::quiet_NaN();

Picture full() {
  Picture picture;
  picture.solids.push_back({{.type = ShapeType::kSphere, .radius = 0.5}, {}, {}, "hand"});
  picture.solids.push_back({{ShapeType::kBox, {1, 1, 1}, 0}, {}, {}, ""});
  picture.polylines.push_back({{{0, 0, 0}, {1, 0, 0}}});
  picture.pointSets.push_back({{{0, 0, 1}}});
  picture.lineSets.push_back({{{{0, 0, 0}, {0, 1, 0}}}});
  picture.axes.push_back({{}, 0.1, "world"});
  picture.arrows.push_back({});
  picture.ellipsoids.push_back({});
  picture.labels.push_back({"here"});
  picture.captions.push_back({"title"});
  return picture;
}

TEST(PictureBounds, HoldOnlyTheCornersOfAMesh) {
  const TriangleMesh mesh({{1, 0, 0}, {2, 0, 0}, {2, 0, 3}}, {}, {});
  Solid solid{.shape = {.type = ShapeType::kPointCloud, .radius = 0.5, .mesh = mesh},
              .X_WS = {expSO3(Eigen::Vector3d(0, 0, std::numbers::pi / 2)), {0, 0, 1}}};
  EXPECT_LT((bounds(solid).low - Eigen::Vector3d(0, 1, 1)).norm(), 1e-12);
  EXPECT_LT((bounds(solid).high - Eigen::Vector3d(0, 2, 4)).norm(), 1e-12);
  solid.shape.type = ShapeType::kSphereSweptConvex;
  EXPECT_LT((bounds(solid).low - Eigen::Vector3d(-0.5, 0.5, 0.5)).norm(), 1e-12);
  solid.shape.mesh = {};
  EXPECT_LT((bounds(solid).low - Eigen::Vector3d(-0.5, -0.5, 0.5)).norm(), 1e-12);
}

TEST(PictureBounds, HoldEverythingThatHasAPlace) {
  Picture picture;
  EXPECT_TRUE(bounds(picture).isEmpty());
  picture.solids.push_back(
      {{ShapeType::kCapsule, {0, 0, 2}, 0.5}, rotation(std::numbers::pi / 2, {0, 1, 0})});
  EXPECT_LT((bounds(picture).high - Eigen::Vector3d(1.5, 0.5, 0.5)).norm(), 1e-12);
  picture.polylines.push_back({{{0, 3, 0}}});
  picture.lineSets.push_back({{{{0, 0, 0}, {0, 0, -2}}}});
  EXPECT_EQ(bounds(picture).low.z(), -2);
  picture.pointSets.push_back({{{0, 0, -4}}});
  picture.axes.push_back({translation(0, 0, 5), 2, ""});
  picture.labels.push_back({"far", {-6, 0, 0}});
  const Bounds box = bounds(picture);
  EXPECT_LT((box.low - Eigen::Vector3d(-6, -0.5, -4)).norm(), 1e-12);
  EXPECT_LT((box.high - Eigen::Vector3d(2, 3, 7)).norm(), 1e-12);
  EXPECT_EQ(box.corner(0), box.low);
  EXPECT_EQ(box.corner(7), box.high);
}

struct Fault {
  std::function<void(Picture&)> make;
  const char* message;
};

TEST(RequireDrawable, NamesWhatIsWrong) {
  EXPECT_NO_THROW(requireDrawable(full()));
  const std::vector<Fault> faults = {
      {[](Picture& p) { p.solids[0].X_WS.p.y() = kNan; }, "solid 'hand', pose: found a number that is not"},
      {[](Picture& p) { p.solids[0].X_WS.p.y() = -2e9; }, "finite, or beyond 1e9, wanted finite numbers"},
      {[](Picture& p) { p.solids[1].X_WS.R(0, 0) = kNan; }, "solid 1, pose: found a number that is not"},
      {[](Picture& p) { p.solids[0].X_WS.R *= 1.001; },
       "solid 'hand', pose: found a matrix that is not a rotation, wanted orthonormal axes, right-handed"},
      {[](Picture& p) { p.solids[0].X_WS.R.col(0) *= -1; },
       "solid 'hand', pose: found a matrix that is not a rot"},
      {[](Picture& p) { p.solids[0].shape.radius = kNan; }, "solid 'hand', size: found a number that is not"},
      {[](Picture& p) { p.solids[1].shape.extent.x() = -1; }, "solid 1, size: found a negative length"},
      {[](Picture& p) { p.solids[0].color.g = NAN; }, "solid 'hand', color"},
      {[](Picture& p) {
         p.solids[0].shape.type = ShapeType::kPointCloud;
         p.solids[0].shape.mesh = TriangleMesh({{2e9f, 0, 0}}, {}, {});
       },
       "solid 'hand', mesh: found a number that is not finite, or beyond 1e9"},
      {[](Picture& p) { p.solids[0].shape.type = ShapeType::kMesh; },
       "solid 'hand': found a mesh without vertices, wanted one as returned by readMesh()"},
      {[](Picture& p) { p.polylines[0].points[1].z() = kNan; }, "polyline 0, point 1: found a number"},
      {[](Picture& p) { p.polylines[0].width = 0; },
       "polyline 0: found a size in pixels that is not positive"},
      {[](Picture& p) { p.lineSets[0].segments[0].second.x() = kNan; },
       "line set 0, segment 0: found a number"},
      {[](Picture& p) { p.lineSets[0].color.r = NAN; }, "line set 0, color"},
      {[](Picture& p) { p.lineSets[0].width = -1; },
       "line set 0: found a size in pixels that is not positive"},
      {[](Picture& p) { p.arrows[0].from.x() = kNan; }, "arrow 0: found a number that is not finite"},
      {[](Picture& p) { p.arrows[0].radius = 0; }, "arrow 0: found a radius that is not positive"},
      {[](Picture& p) { p.ellipsoids[0].X_WE.p.x() = kNan; },
       "ellipsoid 0: found a number that is not finite"},
      {[](Picture& p) { p.ellipsoids[0].radii.x() = -1; }, "ellipsoid 0: found a negative radius"},
      {[](Picture& p) { p.pointSets[0].points[0].z() = kNan; }, "point set 0, point 0"},
      {[](Picture& p) { p.pointSets[0].color.a = NAN; }, "point set 0, color"},
      {[](Picture& p) { p.axes[0].size = kNan; }, "axes 'world': found a number that is not finite"},
      {[](Picture& p) { p.labels[0].p_WQ.x() = kNan; }, "label 'here', point"},
      {[](Picture& p) { p.labels[0].scale = 0; }, "label 'here': found a strange scale, wanted above 0"},
      {[](Picture& p) { p.captions[0].scale = 101; }, "caption 'title': found a strange scale"},
      {[](Picture& p) { p.captions[0].color.r = NAN; }, "caption 'title', color"},
      {[](Picture& p) { p.ground.height = kNan; }, "ground: found a number that is not finite"},
      {[](Picture& p) {
         p.ground.scene.include({0, 2e9, 0});
       },
       "ground: found a number that is not finite"},
      {[](Picture& p) { p.ground.cell = 0; }, "ground: found a cell that is not positive"},
      {[](Picture& p) { p.toLight.setZero(); }, "light: found no direction"},
  };
  for (const Fault& fault : faults) {
    Picture picture = full();
    fault.make(picture);
    EXPECT_REX_ERROR(requireDrawable(picture), fault.message);
  }
}

}  // namespace rex::picture_test
