#include <numbers>

#include <gtest/gtest.h>

#include "cli/robot/render_plan.h"
#include "support/needs_osmesa.h"

namespace rex::cli::studio_test {

using Eigen::Vector3d;

TEST(Studio, TurnsAboutWhatTheCameraLooksAt) {
  REX_NEEDS_OSMESA();
  const Vector3d target(1, 0.5, 0.5);
  const Picture picture{
      .solids = {
          {.shape = {.type = ShapeType::kSphere, .radius = 0.2}, .X_WS = {.p = target}, .color = {1, 0, 0}},
          {.shape = {.extent = {0.4, 0.4, 0.4}}, .X_WS = {.p = {-2, 0, 0.2}}, .color = {0, 0, 1}}}};
  Studio studio(makeRenderPlan({.cameras = {"3,-2,1@1,0.5,0.5"}, .size = "64x48", .out = "a.png"}),
                bounds(picture));
  const Image first = studio.draw(picture);
  for (const double angle : {0.5, 1.5, 3., 5.}) {
    const Image image = studio.draw(picture, angle);
    const auto middle = image.at(32, 24);
    EXPECT_GT(middle[0], 3 * middle[2]) << angle;
    EXPECT_NE(image, first) << angle;
  }
}

TEST(Studio, TurnsAllCameras) {
  REX_NEEDS_OSMESA();
  const Picture picture{.solids = {{.shape = {.extent = {1, 0.2, 0.4}}, .X_WS = {.p = {0, 0, 0.2}}}}};
  const auto drawn = [&](const std::vector<std::string>& cameras, double angle) {
    return Studio(makeRenderPlan({.cameras = cameras, .size = "64x48", .out = "a.png"}),
                  turningBox(bounds(picture)))
        .draw(picture, angle);
  };
  const Image both = drawn({"front", "left"}, std::numbers::pi / 2);
  EXPECT_EQ(both, contactSheet({{drawn({"front"}, std::numbers::pi / 2), "front (from -y)"},
                                {drawn({"left"}, std::numbers::pi / 2), "left (from +x)"}}));
  EXPECT_NE(both, drawn({"front", "left"}, 0));
}

TEST(Studio, SaysWhatItLooksFrom) {
  REX_NEEDS_OSMESA();
  const auto said = [](const std::vector<std::string>& cameras, Facing facing) {
    const RenderPlan plan = makeRenderPlan({.cameras = cameras, .size = "8x8", .out = "a.png"}, facing);
    return Studio(plan, Bounds()).describe();
  };
  EXPECT_TRUE(said({"front"}, Facing::kPlusX).ends_with("; view: front (from +x)"));
  EXPECT_TRUE(said({"front", "0,1,0"}, Facing::kMinusY).ends_with("; views: front (from -y); 0,1,0"));
  EXPECT_EQ(said({}, Facing::kPlusX).find("view"), std::string::npos);
}

TEST(Studio, ShrinksNothingOnASheet) {
  EXPECT_GE(contactSheet({{Image(900, 30), "wide"}, {Image(900, 30), "too"}}).width, 1800);
  EXPECT_GE(contactSheet({{Image(5, 5), "tiny"}}).width, 5);
}

TEST(TurningBox, HoldsTheSceneHoweverItIsTurned) {
  Bounds scene;
  scene.include({1, 2, 0});
  scene.include({4, 6, 3});
  const Bounds box = turningBox(scene);
  EXPECT_EQ(box.center(), scene.center());
  EXPECT_EQ(box.high.z(), 3);
  EXPECT_DOUBLE_EQ(box.high.x() - box.center().x(), 2.5);
  EXPECT_DOUBLE_EQ(box.high.y() - box.center().y(), 2.5);
}

}  // namespace rex::cli::studio_test
