#include <filesystem>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/process.h"
#include "course/cart_pole_pictures.h"
#include "course/film.h"
#include "course/film_internal.h"
#include "course/racer_pictures.h"
#include "render/image.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/needs_osmesa.h"
#include "support/temporary_folder.h"
#include "systems/cart_pole.h"
#include "systems/racer.h"

namespace rex::plant_pictures_test {

namespace fs = std::filesystem;
using Eigen::Matrix4Xd;
using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const Solid& named(const Picture& picture, const std::string& name, int which = 0) {
  for (const Solid& solid : picture.solids)
    if (solid.name == name && which-- == 0) return solid;
  throw std::logic_error("no solid " + name);
}

TEST(CartPolePicture, ShowsCartPoleAndForce) {
  const double angle = 0.5;
  const Picture picture = cartPolePicture(CartPoleView{{0.7, 0, angle, 0}, -6, "held"});
  EXPECT_EQ(named(picture, "cart").shape.extent, Vector3d(1, 0.2, 0.2));
  EXPECT_EQ(named(picture, "cart").X_WS.p, Vector3d(0.7, 0, 1));
  const Solid& pole = named(picture, "pole");
  EXPECT_EQ(pole.shape.extent, Vector3d(0.1, 0.1, 2)) << "2 l";
  EXPECT_LT((pole.X_WS * Vector3d(0, 0, -1) - Vector3d(0.7, 0, 1)).norm(), 1e-15) << "its foot on the cart";
  EXPECT_LT((pole.X_WS * Vector3d(0, 0, 0) - Vector3d(0.7 + std::sin(angle), 0, 1 + std::cos(angle))).norm(),
            1e-15)
      << "falls towards x";
  ASSERT_EQ(picture.arrows.size(), 1u);
  EXPECT_LT((picture.arrows[0].to - picture.arrows[0].from - Vector3d(-0.3, 0, 0)).norm(), 1e-15);
  EXPECT_EQ(picture.arrows[0].from.x(), 0.7 - 0.5) << "at the end that it pulls";
  EXPECT_EQ(picture.captions.at(0).text, "held");
  EXPECT_TRUE(cartPolePicture(CartPoleView{}).arrows.empty());
  EXPECT_LE((cartPolePicture(CartPoleView{.u = 1e9}).arrows[0].to).x(), 3);
}

TEST(CartPolePicture, RailReachesTheCart) {
  for (const double position : {0., 1.4, -3.7, 30.}) {
    const Picture picture = cartPolePicture(CartPoleView{{position, 0, 0, 0}});
    const double middle = named(picture, "rail").X_WS.p.x(),
                 half = named(picture, "rail").shape.extent.x() / 2;
    EXPECT_LE(middle - half, std::min(-2., position - 0.5));
    EXPECT_GE(middle + half, std::max(2., position + 0.5));
    EXPECT_LE(2 * half, 4 + std::abs(position));
  }
}

TEST(RacerPicture, ShowsWheelsAndPendulums) {
  const RacerDynamics racer;
  Matrix4Xd x(4, 2);
  x << 0.3, 0, 0.4, -0.2, 0, 0, 0, 0;
  const Picture picture = racerPicture(RacerView{x, {"before", "after"}, "racers"});
  for (int k = 0; k < 2; ++k) {
    const double lane = 0.3 * k;
    const Eigen::Matrix<double, 3, 2> poses = racer.poses(x.col(k).head<2>());
    const Solid &wheel = named(picture, "wheel", k), &pendulum = named(picture, "pendulum", k);
    EXPECT_EQ(wheel.shape.radius, racer.r);
    EXPECT_LT((wheel.X_WS.p - Vector3d(poses(0, 0), lane, racer.r)).norm(), 1e-15);
    EXPECT_LT((wheel.X_WS.R.col(2).cwiseAbs() - Vector3d::UnitY()).norm(), 1e-15) << "its axis";
    EXPECT_LT((pendulum.X_WS.p - Vector3d(poses(0, 1), lane, poses(1, 1))).norm(), 1e-15);
    EXPECT_LT((pendulum.X_WS * Vector3d(0, 0, -racer.l) - wheel.X_WS.p).norm(), 1e-15)
        << "stands on the axis";
  }
  // Rolled by 0.3 m, a point of the wheel has turned by 6 rad: from top forwards.
  const Vector3d up = named(picture, "cross").X_WS.R.col(2);
  EXPECT_LT((up - Vector3d(std::sin(6), 0, std::cos(6))).norm(), 1e-15);
  EXPECT_EQ(picture.labels.at(1).text, "after");
  EXPECT_EQ(picture.captions.at(0).text, "racers");
}

TEST(PlantPictures, RefuseWhatCannotBeDrawn) {
  EXPECT_REX_ERROR(cartPolePicture(CartPoleView{Vector4d(0, 0, kNan, 0)}),
                   "cart pole: state: number 2: found nan");
  EXPECT_REX_ERROR(cartPolePicture(CartPoleView{.u = kNan}), "cart pole: control u: found nan");
  EXPECT_REX_ERROR(cartPolePicture(CartPoleView{.l = 0}), "cart pole: half the length of the pole: found 0");
  EXPECT_REX_ERROR(racerPicture(RacerView{}), "picture of racers: found none, wanted at least one");
  RacerView view{.x = Matrix4Xd::Zero(4, 2)};
  view.x(1, 1) = kNan;
  EXPECT_REX_ERROR(racerPicture(view), "racer: state: number 5: found nan");
  view.x(1, 1) = 0;
  view.names = {"one"};
  EXPECT_REX_ERROR(racerPicture(view), "picture of racers: found 1 names, wanted 2, or none");
  view.names.clear();
  view.dynamics.r = 0;
  EXPECT_REX_ERROR(racerPicture(view), "racer: radius r: found 0");
}

std::string frameOf(const std::string& film, int number) { return fmt::format("{}/{:04}.png", film, number); }

class PlantFilm : public testing::Test {
 protected:
  std::string in(const std::string& name) const { return (folder_.path() / name).string(); }
  // Falling freely.
  static std::vector<CartPoleView> falling(int count) {
    CartPole cart(0, {.noise = 0});
    std::vector<CartPoleView> views;
    for (int t = 0; t < count; ++t, cart.step(0)) views.push_back({cart.x});
    return views;
  }
  static Film rolling(int count, double step = 0.01) {
    Racer racer(1);
    return makeFilm(count, step, [&](int) {
      const Picture picture = racerPicture(RacerView{racer.getState()});
      racer.stepDynamics(0.01);
      return picture;
    });
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(PlantFilm, HasFramesAContactSheetAndAVideo) {
  REX_NEEDS_OSMESA();
  const auto check = [&](const std::string& name, int frames) {
    EXPECT_TRUE(fs::exists(in(frameOf(name, frames - 1))));
    EXPECT_FALSE(fs::exists(in(frameOf(name, frames))));
    EXPECT_FALSE(readPng(in(frameOf(name, 0))) == readPng(in(frameOf(name, frames - 1))));
    EXPECT_GT(readPng(in(name + "_sheet.png")).width, 3 * 96);
    EXPECT_EQ(fs::exists(in(name + ".mp4")), runProcess({"ffmpeg", "-version"}).ok());
  };
  const FilmOptions small{.width = 96, .height = 72, .moments = 3};
  writeFilm(cartPoleFilm(falling(20)), in("cart"), small);
  check("cart", 10);  // every second
  std::vector<CartPoleView> away = falling(20);
  for (std::size_t k = 11; k < away.size(); ++k) away[k].x[0] = -8.1 - 1000. * static_cast<double>(k);
  writeFilm(cartPoleFilm(away), in("away"), small);
  check("away", 6);
  writeFilm(cartPoleFilm(falling(20)), in("again"), small);
  EXPECT_EQ(fileText(in("cart_sheet.png")), fileText(in("again_sheet.png")));
  writeFilm(rolling(31), in("racer"), small);
  check("racer", 10);  // at 0, 3, 7, 10, ...
  writeFilm(rolling(4, 0.1), in("slow"), small);
  check("slow", 4);
}

TEST(FilmPace, PlaysAtTheSpeedAskedFor) {
  const auto pace = [](int count, double step, double speed = 1) {
    return internal::filmPace(count, step, speed);
  };
  using Frames = std::vector<std::size_t>;
  EXPECT_EQ(pace(31, 0.01).frames, (Frames{0, 3, 7, 10, 13, 17, 20, 23, 27, 30}));
  EXPECT_EQ(pace(31, 0.01).rate, 30);
  EXPECT_EQ(pace(5, 1. / 60).frames, (Frames{0, 2, 4}));
  EXPECT_EQ(pace(5, 1. / 60).rate, 30);
  EXPECT_EQ(pace(3, 0.1).frames, (Frames{0, 1, 2}));
  EXPECT_EQ(pace(3, 0.1).rate, 10);
  EXPECT_EQ(pace(1, 0.1).frames, Frames{0});
  EXPECT_EQ(pace(4, 3, 30).frames, (Frames{0, 1, 2, 3})) << "cars, ten views per second";
  EXPECT_EQ(pace(4, 3, 30).rate, 10);
  EXPECT_EQ(pace(9, 0.1, 12).frames, (Frames{0, 4, 8}));
  EXPECT_EQ(pace(9, 0.1, 12).rate, 30);
  // In steps beyond all measure, a film is still one.
  for (const double step : {1e-320, 1e-300, 1e-20}) {
    EXPECT_EQ(pace(4, step).frames, Frames{0}) << step;
    EXPECT_EQ(pace(4, step).rate, 30) << step;
  }
  EXPECT_EQ(pace(2, 1e300).frames, (Frames{0, 1}));
  EXPECT_EQ(pace(2, 1e300).rate, 1);
}

TEST_F(PlantFilm, SaysWhatCannotBe) {
  const auto refuses = [&](const Film& film, const FilmOptions& options, const char* text) {
    EXPECT_REX_ERROR(writeFilm(film, "x", options), text);
  };
  refuses({}, {}, "film 'x': found no frames, wanted at least one");
  refuses(cartPoleFilm({}), {}, "film 'x': found no frames, wanted at least one");
  refuses(rolling(2, 0), {},
          "film 'x': time between frames: found 0 s, wanted a positive, finite number of seconds");
  refuses(rolling(2, kNan), {}, "film 'x': time between frames: found nan, wanted a positive");
  refuses(rolling(2), {.speed = 0}, "film 'x': speed: found 0, wanted a positive, finite number");
  refuses(rolling(2), {.moments = 1}, "pictures: found 1, wanted at least 2");
  refuses(rolling(2), {.width = 0}, "picture size: found 0 x 480");
  refuses(rolling(2), {.view = Vector3d::Zero()}, "no view direction");
}

TEST_F(PlantFilm, PicturesAreOfTheSizeAskedFor) {
  REX_NEEDS_OSMESA();
  const Picture cart = cartPolePicture(CartPoleView{{0.4, 0, 0.3, 0}, 8, "cart pole"});
  for (const auto& [width, height] : {std::pair{320, 240}, {300, 100}}) {
    writePicture(cart, in("cart.png"), {.width = width, .height = height});
    EXPECT_EQ(readPng(in("cart.png")).width, width);
    EXPECT_EQ(readPng(in("cart.png")).height, height);
  }
  EXPECT_REX_ERROR(writePicture(cart, in("no/folder/x.png")), "x.png");
  EXPECT_REX_ERROR(writePicture(cart, in("x.png"), {.height = 0}), "picture size: found 640 x 0");
  EXPECT_REX_ERROR(writePicture(Picture{}, in("x.png")), "nothing to draw: found no shape, line");
}

}  // namespace rex::plant_pictures_test
