#include "course/walk_pictures.h"

#include <cmath>
#include <filesystem>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/process.h"
#include "course/film.h"
#include "render/image.h"
#include "support/expect_error.h"
#include "support/needs_osmesa.h"
#include "support/temporary_folder.h"

namespace rex::walk_pictures_test {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(FootprintFigure, HasTheSolesOfThePlan) {
  WalkPlan plan{.footsteps = straightFootsteps(3, 0.2, 0.19)};
  plan.footsteps[3].yaw = 2.5;
  const Figure figure = footprintFigure(plan);
  ASSERT_EQ(figure.regions.size(), plan.footsteps.size());
  for (std::size_t i = 0; i < plan.footsteps.size(); ++i) {
    // The hull that the library computes of this sole alone has the same corners.
    const Footstep& foot = plan.footsteps[i];
    WalkPhase phase;
    phase.left = phase.right = foot;
    const SupportPolygon sole = supportPolygon(phase, plan.sole);
    ASSERT_EQ(figure.regions[i].x.size(), 4u);
    ASSERT_EQ(sole.corners.cols(), 4);
    for (int k = 0; k < 4; ++k) {
      const Vector2d corner(figure.regions[i].x[k], figure.regions[i].y[k]);
      EXPECT_LT((sole.corners.colwise() - corner).colwise().norm().minCoeff(), 1e-12) << i << " " << k;
    }
    const Vector2d middle(figure.regions[i].x[0] + figure.regions[i].x[2],
                          figure.regions[i].y[0] + figure.regions[i].y[2]);
    EXPECT_LT((middle / 2 - foot.p).norm(), 1e-12);
  }
  EXPECT_REX_ERROR(static_cast<void>(footprintFigure({})), "footstep");
}

// Where the foot of a leg is: the lower end of its capsule.
Vector3d footOf(const Picture& picture, int which) {
  for (const Solid& solid : picture.solids)
    if (solid.name == "leg" && which-- == 0)
      return solid.X_WS * Vector3d(0, 0, -solid.shape.extent.z() / 2 - solid.shape.radius);
  throw std::logic_error("no leg");
}

TEST(CompassPicture, StandsOnTheSlope) {
  const CompassGait walker{.a = 0.4, .b = 0.5};
  // Both feet on the slope, by the angles: x[0] + x[1] = -2 slope.
  const double stance = 0.2;
  const Vector4d x(stance, -2 * walker.slope - stance, 0, 0);
  const CompassWalk walk{walker, {{x, 0, true}, {x, 1.5, false}}};
  const Vector3d downhill(std::cos(walker.slope), 0, -std::sin(walker.slope));
  for (const int view : {0, 1}) {
    const Picture picture = compassPicture(walk, view);
    const Vector3d blue = footOf(picture, 0), orange = footOf(picture, 1);
    const Vector3d stands = view == 0 ? blue : orange, swings = view == 0 ? orange : blue;
    const Vector3d aside(0, stands.y(), 0);
    EXPECT_LT((stands - aside - walk.views[view].foot * downhill).norm(), 1e-12);
    EXPECT_NEAR(swings.dot(Vector3d(std::sin(walker.slope), 0, std::cos(walker.slope))), 0, 1e-12)
        << "on the slope";
    // The stance leg leans uphill, so the other foot is behind.
    EXPECT_NEAR((swings - stands).dot(downhill), -2 * 0.9 * std::sin(stance + walker.slope), 1e-12);
    EXPECT_GT(blue.y(), orange.y()) << "seen from behind, left is left";
    const Bounds slope = bounds(picture.solids.front());
    EXPECT_EQ(picture.ground.height, slope.low.z());
    EXPECT_LT(slope.low.x(), -0.5);
    EXPECT_GT(slope.high.x(), 1.5 + 0.5);
  }
}

TEST(CompassPicture, RefusesWhatCannotBeDrawn) {
  CompassWalk walk{{}, {CompassView{}}};
  EXPECT_REX_ERROR(static_cast<void>(compassPicture(walk, 1)),
                   "picture of a compass walker: found view 1, wanted one of 1, counted from 0");
  EXPECT_REX_ERROR(static_cast<void>(compassPicture(walk, -1)), "found view -1");
  walk.views[0].x[2] = kNan;
  EXPECT_REX_ERROR(static_cast<void>(compassPicture(walk, 0)), "compass walker: state: number 2: found nan");
  walk.views[0] = {.foot = kNan};
  EXPECT_REX_ERROR(static_cast<void>(compassPicture(walk, 0)), "compass walker: path of the foot: found nan");
  EXPECT_TRUE(compassFilm({}, 1).empty());
}

class WalkFilm : public testing::Test {
 protected:
  std::string in(const std::string& name) const { return (folder_.path() / name).string(); }
  void expectFilm(const std::string& name, int frames) const {
    const auto frame = [&](int i) { return in(fmt::format("{}/{:04}.png", name, i)); };
    EXPECT_TRUE(fs::exists(frame(frames - 1)));
    EXPECT_FALSE(fs::exists(frame(frames)));
    EXPECT_FALSE(readPng(frame(0)) == readPng(frame(frames - 1)));
    EXPECT_GT(readPng(in(name + "_sheet.png")).width, 2 * 96);
    EXPECT_EQ(fs::exists(in(name + ".mp4")), runProcess({"ffmpeg", "-version"}).ok());
  }
  static HumanoidWalk onTheSpot() {
    HumanoidWalk walk;
    walk.plan = {.footsteps = straightFootsteps(1, 0, 0.19), .rest = 0.4};
    const Eigen::Matrix2Xd reference = zmpReference(walk.plan, walk.preview.step);
    for (Eigen::Index k = 0; k < reference.cols(); ++k) {
      walk.zmp.emplace_back(reference.col(k));
      walk.center.emplace_back(reference.col(k));
    }
    return walk;
  }
  FilmOptions small{.width = 96, .height = 72, .moments = 3};

 private:
  TemporaryFolder folder_;
};

TEST_F(WalkFilm, OfACompassWalkerAndAHumanoid) {
  REX_NEEDS_OSMESA();
  CompassWalk fall;
  for (int i = 0; i < 5; ++i) fall.views.push_back({.x = Vector4d(-0.1 * i, 0.1 * i, 0, 0)});
  writeFilm(compassFilm(fall, 1. / 30), in("walker"), small);
  expectFilm("walker", 5);
  small.speed = 6;
  const HumanoidWalk walk = onTheSpot();
  writeFilm(humanoidFilm(walk), in("humanoid"), small);
  // Every twentieth step of 0.01 s.
  expectFilm("humanoid", static_cast<int>((walk.zmp.size() + 19) / 20));
}

TEST_F(WalkFilm, SaysWhatCannotBe) {
  HumanoidWalk walk = onTheSpot();
  walk.zmp[3].x() = kNan;
  EXPECT_REX_ERROR(static_cast<void>(humanoidFilm(walk)), "film of a humanoid: path: number 0: found nan");
  walk.center.pop_back();
  EXPECT_REX_ERROR(static_cast<void>(humanoidFilm(walk)), "film of a humanoid: found a path of");
  walk.plan.footsteps = straightFootsteps(2, 3, 0.19);
  EXPECT_REX_ERROR(static_cast<void>(humanoidFilm(walk)), "wanted a walk that the robot can perform");
}

}  // namespace rex::walk_pictures_test
