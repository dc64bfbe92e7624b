#include "cli/robot/render_plan.h"

#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace rex::cli::render_plan_test {

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
                   "OpenGL backend: found 'opengl', wanted auto, osmesa");
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

}  // namespace rex::cli::render_plan_test
