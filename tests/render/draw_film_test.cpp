// Films: one frame that shows nothing ends no film, and the ground keeps still.
#include <algorithm>
#include <csignal>

#include <gtest/gtest.h>

#include "base/interruption.h"
#include "render/depth_image.h"
#include "render/film.h"
#include "render/frame_sink.h"
#include "render/renderer.h"
#include "support/expect_error.h"
#include "support/needs_osmesa.h"

namespace rex::draw_film_test {

constexpr int kWidth = 160, kHeight = 120;

Renderer smallRenderer() {
  return Renderer({.width = kWidth, .height = kHeight, .antiAliasing = AntiAliasing::kNone});
}

Picture ballAt(const Eigen::Vector3d& p, double radius, bool ground) {
  Picture picture{.solids = {{.shape = {.type = ShapeType::kSphere, .radius = radius}, .X_WS = {.p = p}}}};
  picture.ground.visible = ground;
  return picture;
}

Picture nothing() {
  Picture picture;
  picture.ground.visible = false;
  return picture;
}

std::vector<Image> drawn(const Film& film) {
  Renderer renderer = smallRenderer();
  MemorySink sink;
  drawFilm(film, framing(film, kDefaultView, 4. / 3), renderer, sink);
  return sink.frames();
}

TEST(DrawFilm, GoesOnAfterAFrameThatShowsNothing) {
  REX_NEEDS_OSMESA();
  const Film lateStart = {{0, nothing()}, {1, ballAt({0, 0, 0}, 1, false)}};
  EXPECT_EQ(drawn(lateStart).size(), 2u);
  // Of a ball far from the other one, smaller than a pixel.
  const Film far = {{0, ballAt({0, 0, 0}, 100, false)}, {1, ballAt({90, 0, 0}, 1e-4, false)}};
  EXPECT_EQ(drawn(far).size(), 2u);
  Renderer renderer = smallRenderer();
  EXPECT_EQ(drawStill(lateStart, framing(lateStart, kDefaultView, 4. / 3), renderer), drawn(lateStart)[1]);
}

TEST(DrawFilm, RefusesAFilmThatShowsNothing) {
  REX_NEEDS_OSMESA();
  Renderer renderer = smallRenderer();
  const Camera away = lookAt({0, -5, 1}, {0, -9, 1});
  const Film film(3, {0, ballAt({0, 0, 0}, 1, true)});
  MemorySink sink;
  const char* message =
      "the film shows nothing: found no solid, line or point in any of 3 frames, wanted a camera that sees "
      "some of them; see framing()";
  EXPECT_REX_ERROR((drawFilm(film, away, renderer, sink), 0), message);
  EXPECT_REX_ERROR(drawStill(film, away, renderer), message);
  EXPECT_REX_ERROR(renderer.draw(film[0].picture, away), "the picture shows nothing of the scene");
  EXPECT_FALSE(renderer.drawFrame(film[0].picture, away).showsSomething);
  EXPECT_FALSE(renderer.drawFrame(nothing(), away).showsSomething);
  MemorySink other;
  EXPECT_REX_ERROR((drawFilm({}, away, renderer, other), 0), "a film without frames");
}

TEST(DrawFilm, StopsForAHeldSignal) {
  REX_NEEDS_OSMESA();
  Renderer renderer = smallRenderer();
  const Film film(3, {0, ballAt({0, 0, 0}, 1, true)});
  MemorySink sink;
  const HeldSignals held;
  std::raise(SIGTERM);
  EXPECT_THROW(drawFilm(film, framing(film, kDefaultView, 4. / 3), renderer, sink), Interrupted);
}

// An unlit wall that fills the picture has one colour in each row, as the background does.
TEST(RendererOfFilms, TakesAWallBeforeTheCameraForAPicture) {
  REX_NEEDS_OSMESA();
  Picture wall{.solids = {{.shape = {.extent = {9, 1, 9}}, .color = {0, 0, 0}}}};
  wall.ground.visible = false;
  wall.toLight = {0, 1, 0};
  Renderer renderer({.width = kWidth, .height = kHeight, .shadow = false});
  const Image image = renderer.draw(wall, lookAt({0, -2, 0}, {0, 0, 0}));
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) ASSERT_EQ(image.at(x, y), image.at(0, y));
}

TEST(RendererOfFilms, TakesColoursOutOfRangeForTheNearest) {
  REX_NEEDS_OSMESA();
  Renderer renderer = smallRenderer();
  const auto image = [&](const Color& color) {
    Picture picture = ballAt({0, 0, 0}, 1, false);
    picture.solids[0].color = color;
    return renderer.draw(picture, framing(bounds(picture), kDefaultView, 4. / 3));
  };
  EXPECT_EQ(image({-1, 0.5f, 2}), image({0, 0.5f, 1}));
}

Image difference(const Film& film) {
  std::vector<Image> frames = drawn(film);
  // What the balls leave free of the two pictures.
  for (std::size_t i = 0; i < frames[0].rgb.size(); ++i)
    frames[0].rgb[i] = static_cast<std::uint8_t>(std::abs(frames[0].rgb[i] - frames[1].rgb[i]));
  return frames[0];
}

TEST(SettleGround, KeepsTheFloorStillWhileTheSceneMoves) {
  REX_NEEDS_OSMESA();
  Film film = {{0, ballAt({0, 0, 0.5}, 0.5, true)}, {1, ballAt({4, 0, 0.5}, 0.5, true)}};
  film[1].picture.ground.height = -0.1;
  const auto changed = [](const Image& apart) {
    return std::count_if(apart.rgb.begin(), apart.rgb.end(), [](int byte) { return byte > 0; });
  };
  const auto before = changed(difference(film));
  settleGround(film);
  EXPECT_EQ(film[0].picture.ground.height, -0.1);
  EXPECT_EQ(film[1].picture.ground.scene.low, bounds(film).low);
  const auto after = changed(difference(film));
  // The balls and their shadows still move.
  EXPECT_LT(after, before / 4);
  Renderer renderer = smallRenderer();
  const Camera camera = framing(film, kDefaultView, 4. / 3);
  DepthImage first = renderer.drawDepth(film[0].picture, camera),
             second = renderer.drawDepth(film[1].picture, camera);
  EXPECT_EQ(first.at(0, 0), second.at(0, 0));
  EXPECT_EQ(first.at(0, kHeight - 1), second.at(0, kHeight - 1));
}

}  // namespace rex::draw_film_test
