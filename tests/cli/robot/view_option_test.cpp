// Options that give points and views.
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "cli/numbers.h"
#include "cli/robot/render_plan.h"
#include "support/expect_error.h"

namespace rex::cli::view_option_test {

using Eigen::Vector3d;

Bounds aroundTheOrigin() {
  Bounds bounds;
  bounds.include({-1, -1, -1});
  bounds.include({1, 1, 1});
  return bounds;
}

Vector3d eyeOf(const std::string& text, Facing facing = Facing::kMinusY) {
  return View(text, facing).camera(aroundTheOrigin(), 1).X_WC.p;
}

// How far from parallel the line of sight is to a direction.
double astray(const std::string& text, const Vector3d& direction) {
  const Camera camera = View(text).camera(aroundTheOrigin(), 1);
  return camera.X_WC.R.col(2).cross(direction.normalized()).norm();
}

TEST(ViewOption, StandsWhereItsNameSays) {
  EXPECT_LT(eyeOf("front").y(), -2);
  EXPECT_GT(eyeOf("back").y(), 2);
  EXPECT_GT(eyeOf("left").x(), 2);
  EXPECT_LT(eyeOf("right").x(), -2);
  EXPECT_GT(eyeOf("top").z(), 2);
  EXPECT_LT(astray("default", kDefaultView), 1e-9);
}

TEST(ViewOption, StandsBeforeARobotThatFacesX) {
  EXPECT_GT(eyeOf("front", Facing::kPlusX).x(), 2);
  EXPECT_LT(eyeOf("back", Facing::kPlusX).x(), -2);
  EXPECT_GT(eyeOf("left", Facing::kPlusX).y(), 2);
  EXPECT_LT(eyeOf("right", Facing::kPlusX).y(), -2);
  EXPECT_GT(eyeOf("top", Facing::kPlusX).z(), 2);
  for (const char* text : {"default", "1,2,3", "4,0,1@0,0,1"})
    EXPECT_EQ(eyeOf(text, Facing::kPlusX), eyeOf(text)) << text;
}

// Whichever way it faces, left is where the camera's right is seen from the front.
TEST(ViewOption, HasLeftAndRightOfTheRobot) {
  for (const Facing facing : {Facing::kMinusY, Facing::kPlusX}) {
    const Camera front = View("front", facing).camera(aroundTheOrigin(), 1);
    EXPECT_GT(front.X_WC.R.col(0).dot(eyeOf("left", facing)), 2);
    EXPECT_LT(front.X_WC.R.col(0).dot(eyeOf("right", facing)), -2);
    EXPECT_LT(eyeOf("front", facing).dot(eyeOf("back", facing)), 0);
  }
}

TEST(ViewOption, SaysOnWhichAxisANameStands) {
  EXPECT_EQ(View("front").label(), "front (from -y)");
  EXPECT_EQ(View("front", Facing::kPlusX).label(), "front (from +x)");
  EXPECT_EQ(View("right", Facing::kPlusX).label(), "right (from -y)");
  EXPECT_EQ(View("right").label(), "right (from -x)");
  EXPECT_EQ(View("top", Facing::kPlusX).label(), "top (from +z)");
  EXPECT_EQ(View("default", Facing::kPlusX).label(), "default");
  EXPECT_EQ(View("1,2,3").label(), "1,2,3");
}

TEST(ViewOption, TakesTheConventionOfTheFormat) {
  EXPECT_EQ(sceneFacing("a/man.ors"), Facing::kMinusY);
  EXPECT_EQ(sceneFacing("MAN.ORS"), Facing::kMinusY);
  EXPECT_EQ(sceneFacing("robot.urdf"), Facing::kPlusX);
}

TEST(ViewOption, TakesADirectionOrAnEyeWithItsTarget) {
  EXPECT_LT(astray("1,2,3", {1, 2, 3}), 1e-9);
  EXPECT_GT(eyeOf("1,2,3").z(), 2);
  EXPECT_EQ(View("1,2,3").direction(), Vector3d(1, 2, 3));
  const Camera camera = View("4,0,1@0,0,1").camera(aroundTheOrigin(), 1);
  EXPECT_EQ(camera.X_WC.p, Vector3d(4, 0, 1));
  EXPECT_LT((camera.X_WC.R.col(2) - Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_EQ(View("4,0,1@0,0,1").direction(), Vector3d(4, 0, 0));
}

TEST(ViewOption, KnowsWhatItLooksAt) {
  EXPECT_EQ(View("4,0,1@0,3,1").target(aroundTheOrigin()), Vector3d(0, 3, 1));
  Bounds bounds = aroundTheOrigin();
  bounds.include({1, 1, 5});
  EXPECT_EQ(View("front").target(bounds), Vector3d(0, 0, 2));
}

TEST(ViewOption, ExplainsWhatItCannotRead) {
  EXPECT_REX_ERROR(View("frnt"), "--camera: found 'frnt', wanted default, front, back, left, right, top");
  EXPECT_REX_ERROR(View("frnt"), "did you mean 'front'?");
  for (const char* text :
       {"", "1,2", "1,2,3,4", "0,0,0", "1,2,x", "1,2,inf", "1,2,3@", "1,2,3@1,2,3", "@1,2,3"})
    EXPECT_REX_ERROR(View(text), "--camera: found '" + std::string(text) + "'");
}

TEST(ParsePoint, TakesThreeNumbers) {
  EXPECT_EQ(parsePoint("1,-2, 0.5", "--point"), Eigen::Vector3d(1, -2, 0.5));
  EXPECT_REX_ERROR(parsePoint("1,2", "--point"), "--point: found 2 numbers, wanted three: x,y,z");
  EXPECT_REX_ERROR(parsePoint("1,2,z", "--point"), "--point: found 'z', wanted a number");
}

}  // namespace rex::cli::view_option_test
