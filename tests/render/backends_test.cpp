// OSMesa and EGL draw the same pixels, side by side, in threads and in processes.
#include <future>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include "base/process.h"
#include "support/expect_error.h"
#include "support/needs_egl.h"
#include "support/needs_osmesa.h"
#include "support/rounds.h"
#include "support/varied_picture.h"

namespace rex::backends_test {

constexpr std::array kEverySmoothing = {AntiAliasing::kNone, AntiAliasing::kFxaa, AntiAliasing::kMsaa4};

RendererOptions optionsFor(GlBackend backend, AntiAliasing smooth, int width = 240, int height = 180) {
  return {.width = width, .height = height, .antiAliasing = smooth, .gl = {.backend = backend}};
}

TEST(Backends, DrawTheSamePixels) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_EGL();
  for (const AntiAliasing smooth : kEverySmoothing) {
    Renderer one(optionsFor(GlBackend::kOsMesa, smooth)), other(optionsFor(GlBackend::kEgl, smooth));
    EXPECT_EQ(drawVaried(one), drawVaried(other));
  }
}

// Renderers that differ, so that one's calls in the other's context would show.
TEST(Backends, TakeTurnsInOneThread) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_EGL();
  RendererOptions plain = optionsFor(GlBackend::kOsMesa, AntiAliasing::kNone);
  RendererOptions smooth = optionsFor(GlBackend::kEgl, AntiAliasing::kFxaa);
  plain.shadow = false;
  Renderer one(plain), other(smooth);
  const Image first = drawVaried(one), second = drawVaried(other);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(drawVaried(one), first);
    EXPECT_EQ(drawVaried(other), second);
  }
  smooth.gl.backend = GlBackend::kOsMesa;
  Renderer third(smooth);
  EXPECT_EQ(drawVaried(third), second);
  EXPECT_EQ(drawVaried(other), second);
}

TEST(Backends, DrawTheSameDepthAndSegmentation) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_EGL();
  Renderer one(optionsFor(GlBackend::kOsMesa, AntiAliasing::kNone));
  Renderer other(optionsFor(GlBackend::kEgl, AntiAliasing::kNone));
  const Picture picture = variedPicture();
  const Camera camera = framing(bounds(picture), kDefaultView, 4. / 3);
  EXPECT_EQ(one.drawDepth(picture, camera), other.drawDepth(picture, camera));
  EXPECT_EQ(one.drawSegmentation(picture, camera), other.drawSegmentation(picture, camera));
}

TEST(Backends, OfEglOutliveEachOther) {
  REX_NEEDS_EGL();
  const RendererOptions options = optionsFor(GlBackend::kEgl, AntiAliasing::kFxaa);
  Renderer lasting(options);
  const Image first = drawVaried(lasting);
  for (int i = 0; i < 3; ++i) {
    Renderer passing(options);
    EXPECT_EQ(drawVaried(passing), first);
  }
  EXPECT_EQ(drawVaried(lasting), first);
  Renderer moved = std::move(lasting);
  EXPECT_EQ(drawVaried(moved), first);
}

TEST(Backends, AreHandedFromThreadToThread) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_EGL();
  for (const GlBackend backend : {GlBackend::kOsMesa, GlBackend::kEgl}) {
    Renderer renderer(optionsFor(backend, AntiAliasing::kFxaa));
    const Image first = drawVaried(renderer);
    const std::string description = renderer.describe();
    const Picture picture = variedPicture();
    const Camera camera = framing(bounds(picture), kDefaultView, 4. / 3);
    const DepthImage depth = renderer.drawDepth(picture, camera);
    for (int i = 0; i < 2; ++i)
      std::async(std::launch::async, [&] {
        EXPECT_EQ(renderer.describe(), description);
        EXPECT_EQ(drawVaried(renderer), first);
        EXPECT_EQ(renderer.drawDepth(picture, camera), depth);
      }).get();
    EXPECT_EQ(drawVaried(renderer), first);
  }
}

// One thread's end must not take the display away from the others.
TEST(Backends, WorkInThreads) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_EGL();
  std::array<std::vector<Image>, 4> drawn;
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < drawn.size(); ++t)
    threads.emplace_back([&images = drawn[t], t] {
      const GlBackend backend = t == 0 ? GlBackend::kOsMesa : GlBackend::kEgl;
      for (std::size_t i = 0; i <= t; ++i) {
        Renderer renderer(optionsFor(backend, AntiAliasing::kMsaa4));
        images.push_back(drawVaried(renderer));
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<Image>& images : drawn)
    for (const Image& image : images) EXPECT_EQ(image, drawn[0][0]);
}

void expectOneHash(const std::vector<const char*>& backends) {
  std::set<std::string> hashes;
  for (const char* backend : backends)
    for (const char* threads : {"0", "1", "2", "3"})
      for (int repeat = 0; repeat < rounds(1, 3); ++repeat) {
        const ProcessResult result =
            runProcess({"env", std::string("LP_NUM_THREADS=") + threads, REX_PICTURE_HASH, backend});
        ASSERT_TRUE(result.ok()) << backend << ' ' << threads << ": " << result.error;
        ASSERT_EQ(result.output.size(), 17u) << result.output;
        hashes.insert(result.output);
      }
  EXPECT_EQ(hashes.size(), 1u);
}

TEST(Backends, GiveOneHashForAnyNumberOfThreads) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_EGL();
  expectOneHash({"osmesa", "egl"});
}

TEST(Backends, DrawAnySize) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_EGL();
  Picture picture{.solids = {{{.type = ShapeType::kSphere, .radius = 1.2}, {}, {0.9f, 0.1f, 0.1f}, "ball"}}};
  picture.ground.visible = false;
  const Camera camera = lookAt({1, -4, 1}, {0, 0, 0});
  for (const AntiAliasing smooth : kEverySmoothing)
    for (const auto& [width, height] : {std::pair{1, 1}, {3, 5}, {1, 40}, {641, 479}}) {
      Renderer one(optionsFor(GlBackend::kOsMesa, smooth, width, height));
      Renderer other(optionsFor(GlBackend::kEgl, smooth, width, height));
      const Image image = one.draw(picture, camera);
      ASSERT_EQ(image.width, width);
      ASSERT_EQ(image.height, height);
      const auto middle = image.at(width / 2, height / 2);
      EXPECT_GT(middle[0], middle[1] + 60) << width << " x " << height;
      EXPECT_EQ(other.draw(picture, camera), image) << width << " x " << height;
      EXPECT_EQ(one.drawSegmentation(picture, camera).at(width / 2, height / 2), 0);
      EXPECT_NEAR(one.drawDepth(picture, camera).at(width / 2, height / 2), 3, 0.2);
    }
}

TEST(Backends, RefuseStrangeSizesAndCameras) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_EGL();
  Camera strange = lookAt({1, -4, 1}, {0, 0, 0});
  strange.X_WC.R(0, 0) = std::nan("");
  Camera mirrored = lookAt({1, -4, 1}, {0, 0, 0});
  mirrored.X_WC.R.col(0) *= -1;
  for (const GlBackend backend : {GlBackend::kOsMesa, GlBackend::kEgl})
    for (const AntiAliasing smooth : kEverySmoothing) {
      EXPECT_REX_ERROR(Renderer(optionsFor(backend, smooth, 0, 480)), "picture size: found 0 x 480");
      EXPECT_REX_ERROR(Renderer(optionsFor(backend, smooth, 640, -1)), "picture size: found 640 x -1");
      Renderer renderer(optionsFor(backend, smooth, 16, 16));
      EXPECT_REX_ERROR(renderer.draw(variedPicture(), strange), "camera: found a pose that is not finite");
      EXPECT_REX_ERROR(renderer.draw(variedPicture(), mirrored),
                       "camera: found a pose whose matrix is not a rotation");
    }
}

TEST(Backends, SayWhatTheyAre) {
  REX_NEEDS_EGL();
  const std::string text = Renderer(optionsFor(GlBackend::kEgl, AntiAliasing::kFxaa)).describe();
  EXPECT_THAT(text, testing::StartsWith("EGL (libEGL.so.1), OpenGL "));
  EXPECT_THAT(text, testing::HasSubstr("llvmpipe"));
  EXPECT_THAT(text, testing::EndsWith(", FXAA"));
}

}  // namespace rex::backends_test
