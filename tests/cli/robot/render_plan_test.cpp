#include "cli/robot/render_plan.h"

#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "cli/numbers.h"
#include "support/expect_error.h"
#include "support/needs_osmesa.h"

namespace rex::cli::render_plan_test {

using Eigen::Vector3d;

TEST(RenderPlan, TakesTheProductFromTheEnding) {
  const auto productOf = [](const char* out) { return makeRenderPlan({.out = out}).product; };
  EXPECT_EQ(productOf("a.png"), Product::kPicture);
  EXPECT_EQ(productOf("a.gif"), Product::kFilm);
  EXPECT_EQ(productOf("frames"), Product::kFilm);
  EXPECT_EQ(productOf("a.glb"), Product::kModel);
  EXPECT_EQ(productOf("a.html"), Product::kPage);
  EXPECT_REX_ERROR(productOf("a.pgn"), "-o a.pgn: found the ending '.pgn', wanted .png");
  EXPECT_REX_ERROR(productOf("a.pgn"), "did you mean '.png'?");
}

TEST(RenderPlan, KnowsWhatIsUsual) {
  const RenderPlan still = makeRenderPlan({.out = "a.png"}), film = makeRenderPlan({.out = "a.mp4"}),
                   page = makeRenderPlan({.out = "a.html"});
  EXPECT_EQ(still.renderer.width, 640);
  EXPECT_EQ(still.renderer.height, 480);
  EXPECT_EQ(page.renderer.width, 800);
  EXPECT_EQ(still.renderer.antiAliasing, AntiAliasing::kMsaa4);
  EXPECT_EQ(film.renderer.antiAliasing, AntiAliasing::kFxaa);
  EXPECT_EQ(still.renderer.gl.backend, GlBackend::kAuto);
  EXPECT_EQ(still.show, Show::kColor);
  EXPECT_EQ(still.views.size(), 1u);
  EXPECT_EQ(still.seconds, 2);
}

TEST(RenderPlan, TakesWhatIsAskedFor) {
  const RenderPlan plan = makeRenderPlan({.postures = {"0", "1"},
                                          .seconds = 0.04,
                                          .cameras = {"front", "1,2,3"},
                                          .size = "1x8192",
                                          .show = "depth",
                                          .gl = "egl",
                                          .out = "a.webm"});
  EXPECT_EQ(plan.seconds, 0.04);
  EXPECT_EQ(plan.views[1].name, "1,2,3");
  EXPECT_EQ(plan.renderer.width, 1);
  EXPECT_EQ(plan.renderer.height, 8192);
  EXPECT_EQ(plan.show, Show::kDepth);
  EXPECT_EQ(plan.renderer.gl.backend, GlBackend::kEgl);
  const RenderPlan page = makeRenderPlan({.size = "80x60", .antiAliasing = "none", .out = "a.html"});
  EXPECT_EQ(page.renderer.width, 80);
  EXPECT_EQ(page.renderer.antiAliasing, AntiAliasing::kNone);
}

TEST(RenderPlan, NamesTheAxesOfItsViews) {
  EXPECT_EQ(viewNames(makeRenderPlan({.out = "a.png"})), "");
  EXPECT_EQ(viewNames(makeRenderPlan({.cameras = {"left"}, .out = "a.png"}, Facing::kPlusX)),
            "view: left (from +y)");
  EXPECT_EQ(viewNames(makeRenderPlan({.cameras = {"left", "top"}, .out = "a.png"})),
            "views: left (from +x); top (from +z)");
}

TEST(RenderPlan, RefusesValuesThatItCannotRead) {
  for (const std::string size : {"640", "x", "640x", "x480", "640x480x", "640 x 480", "0x480", "640x0",
                                 "-4x4", "8193x1", "99999999999x1"})
    EXPECT_REX_ERROR(
        makeRenderPlan({.size = size, .out = "a.png"}),
        "--size: found '" + size + "', wanted WIDTHxHEIGHT, 1 to 8192 pixels each, such as 640x480");
  EXPECT_REX_ERROR(makeRenderPlan({.show = "colour", .out = "a.png"}),
                   "--show: found 'colour', wanted color, depth, segmentation (did you mean 'color'?)");
  EXPECT_REX_ERROR(makeRenderPlan({.antiAliasing = "msa4", .out = "a.png"}),
                   "--aa: found 'msa4', wanted none, fxaa, msaa4 (did you mean 'msaa4'?)");
  EXPECT_REX_ERROR(makeRenderPlan({.gl = "opengl", .out = "a.png"}),
                   "OpenGL backend: found 'opengl', wanted auto, egl");
  EXPECT_REX_ERROR(makeRenderPlan({.cameras = {"frnt"}, .out = "a.png"}), "--camera: found 'frnt'");
}

TEST(RenderPlan, RefusesWhatMeansNothing) {
  const auto refuses = [](const RenderOptions& options, const std::string& message) {
    EXPECT_REX_ERROR(makeRenderPlan(options), message);
  };
  refuses({.postures = {"1"}, .motion = "x", .out = "a.png"}, "--motion and --q: wanted only one of them");
  refuses({.postures = {"1"}, .seconds = 1, .out = "a.mp4"}, "--duration: wanted several --q");
  RenderOptions painted{.out = "a.glb"};
  painted.scene.reading.textures = true;
  refuses(painted, "--textures: wanted a picture or film; a .glb has none");
  painted.out = "a.png", painted.show = "depth";
  refuses(painted, "--textures: wanted --show color; depth has none");
  refuses({.motion = "x", .seconds = 1, .out = "a.mp4"}, "--duration: wanted several --q");
  refuses({.postures = {"1"}, .traces = {"a"}, .out = "a.png"},
          "--trace: wanted a motion: several --q, or --motion");
  refuses({.size = "4x3", .out = "a.glb"}, "--size: wanted a picture, film or page; a .glb has no pixels");
  refuses({.antiAliasing = "none", .out = "a.glb"},
          "--aa: wanted a picture, film or page; a .glb has no pixels");
  for (const std::string ending : {".glb", ".html"}) {
    const std::string out = "a" + ending;
    refuses({.show = "color", .out = out},
            "--show: wanted a picture or film; a " + ending + " is seen in colour");
    refuses({.cameras = {"top", "left"}, .out = out},
            "--camera: wanted one, for the initial view of the " + ending + " file");
  }
  for (const std::string show : {"depth", "segmentation"}) {
    refuses({.caption = "a", .show = show, .out = "a.png"},
            "--caption: wanted --show color; " + show + " shows no text");
    refuses({.motion = "x", .traces = {"a"}, .show = show, .out = "a.png"},
            "--trace: wanted --show color; " + show + " shows no lines");
    refuses({.show = show, .antiAliasing = "fxaa", .out = "a.png"},
            "--aa: wanted --show color; " + show + " is not smoothed");
  }
}

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
  EXPECT_EQ(both, captionedSheet({{drawn({"front"}, std::numbers::pi / 2), "front (from -y)"},
                                  {drawn({"left"}, std::numbers::pi / 2), "left (from +x)"}}));
  EXPECT_NE(both, drawn({"front", "left"}, 0));
}

TEST(Studio, DrawsTextsAndLinesAsLargeAsThePicture) {
  REX_NEEDS_OSMESA();
  const Picture line{.ground = {.visible = false},
                     .polylines = {{.points = {{-1, 0, 0}, {1, 0, 0}}, .color = {1, 0, 0}, .width = 6}}};
  const Picture caption{.ground = {.visible = false}, .captions = {{.text = "caption", .scale = 2}}};
  // How much of the picture is darker by what is drawn.
  const auto share = [](const Picture& picture, const std::string& size) {
    const RenderPlan plan = makeRenderPlan({.cameras = {"0,-3,0@0,0,0"}, .size = size, .out = "a.png"});
    const auto drawn = [&](const Picture& shown) { return Studio(plan, Bounds()).draw(shown); };
    const Image with = drawn(picture), without = drawn({.ground = {.visible = false}});
    double changed = 0;
    for (int y = 0; y < with.height; ++y)
      for (int x = 0; x < with.width; ++x) changed += std::abs(with.at(x, y)[1] - without.at(x, y)[1]);
    return changed / (with.width * with.height);
  };
  for (const Picture& picture : {line, caption}) {
    const double usual = share(picture, "640x480");
    EXPECT_GT(usual, 0);
    EXPECT_NEAR(share(picture, "1920x1440") / usual, 1, 0.25);
    EXPECT_NEAR(share(picture, "1920x480") / usual, 1. / 3, 0.1);  // no higher: not larger
  }
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
  EXPECT_GE(captionedSheet({{Image(900, 30), "wide"}, {Image(900, 30), "too"}}).width, 1800);
  EXPECT_GE(captionedSheet({{Image(5, 5), "tiny"}}).width, 5);
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

// Options that give points and views.
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

}  // namespace rex::cli::render_plan_test
