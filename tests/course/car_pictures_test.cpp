#include "course/car_pictures.h"

#include <cmath>
#include <filesystem>
#include <limits>

#include <gtest/gtest.h>

#include "base/process.h"
#include "base/rng.h"
#include "course/car_view.h"
#include "course/film.h"
#include "render/figure.h"
#include "render/image.h"
#include "render/picture.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/needs_gnuplot.h"
#include "support/needs_osmesa.h"
#include "support/temporary_folder.h"

namespace rex::car_pictures_test {

namespace fs = std::filesystem;

Eigen::Matrix3Xd cloud(int count) {
  Rng rng(3);
  Eigen::Matrix3Xd poses(3, count);
  for (auto pose : poses.colwise()) pose = rng.normalVector(3);
  return poses;
}

CarView fullView() {
  CarView view{.car = Eigen::Vector3d(1, 2, M_PI / 2), .estimate = Eigen::Vector3d(1.5, 2.5, 1)};
  view.landmarks = (Eigen::Matrix2Xd(2, 3) << 4, -5, 6, 7, 8, -9).finished();
  view.particles = cloud(40);
  view.poseBeliefs = {{{1.5, 2.5}, (Eigen::Matrix2d() << 4, 0, 0, 0.25).finished()}};
  view.landmarkBeliefs = {{{4, 7}, Eigen::Matrix2d::Identity()}, {{-5, 8}, Eigen::Matrix2d::Zero()}};
  view.paths = {{"true way", view.landmarks, kTruthColor}, {"", view.landmarks, kEstimateColor, true, 4}};
  view.sightings = view.landmarks.leftCols(2);
  view.scan = view.landmarks;
  view.caption = "a car";
  return view;
}

std::size_t countPoints(const Picture& picture, double size) {
  std::size_t count = 0;
  for (const PointSet& set : picture.pointSets)
    if (set.size == size) count += set.points.size();
  return count;
}

TEST(CarPicture, ShowsCarsAndLandmarksWhereTheyAre) {
  const Picture picture = carPicture(fullView());
  // Car, its cabin, three posts, the estimate and its cabin.
  ASSERT_EQ(picture.solids.size(), 7u);
  const Solid& car = picture.solids[0];
  EXPECT_EQ(car.shape.extent, Eigen::Vector3d(3, 1.5, 0.5));
  EXPECT_LT((car.X_WS.p - Eigen::Vector3d(1, 3, 0.3)).norm(), 1e-12) << "1 m ahead, which is along y";
  EXPECT_LT((car.X_WS.R.col(0) - Eigen::Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_EQ(car.color.a, 1);
  for (int i = 0; i < 3; ++i) {
    const Solid& post = picture.solids[static_cast<std::size_t>(2 + i)];
    EXPECT_EQ(post.shape.type, ShapeType::kCylinder);
    EXPECT_EQ(post.shape.radius, 0.1);
    EXPECT_EQ(post.X_WS.p.head<2>(), fullView().landmarks.col(i));
    EXPECT_EQ(post.X_WS.p.z(), post.shape.extent.z() / 2) << "stands on the ground";
  }
  EXPECT_LT(picture.solids[5].color.a, 1);
  EXPECT_EQ(picture.captions.size(), 2u) << "the caption and the named way";
  EXPECT_EQ(picture.captions[1].color, kTruthColor);
  EXPECT_EQ(picture.polylines.at(1).width, 4);
}

TEST(CarPicture, EllipsesHaveTheirSigmas) {
  const Picture picture = carPicture(fullView());
  ASSERT_EQ(picture.ellipsoids.size(), 3u);
  Eigen::Vector3d radii = picture.ellipsoids[2].radii;
  std::sort(radii.begin(), radii.end());
  EXPECT_LT((radii - Eigen::Vector3d(0, 1, 4)).norm(), 1e-12) << "flat; 2 sigma of deviations 0.5 and 2";
  const LineSet& outline = picture.lineSets[1];
  ASSERT_GT(outline.segments.size(), 30u);
  for (const auto& [from, to] : outline.segments) {
    const double u = (from.x() - 1.5) / 4, v = (from.y() - 2.5) / 1;
    EXPECT_NEAR(u * u + v * v, 1, 1e-12);
  }
  EXPECT_LT((outline.segments.front().first - outline.segments.back().second).norm(), 1e-12);
}

TEST(CarPicture, ParticlesPointWhereTheyHeadAndFadeWithTheirWeight) {
  CarView view{.particles = cloud(4)};
  view.weights = Eigen::Vector4d(0.1, 0.8, 0.8, 0.3);
  const Picture picture = carPicture(view);
  ASSERT_EQ(picture.pointSets.size(), 3u) << "one of light, one of middle weight, two heavy ones";
  EXPECT_EQ(picture.pointSets[2].points.size(), 2u);
  EXPECT_LT(picture.pointSets[0].color.a, picture.pointSets[1].color.a);
  EXPECT_EQ(picture.pointSets[2].color.a, 1);
  const auto [from, to] = picture.lineSets[0].segments.at(0);
  EXPECT_EQ(from.head<2>(), view.particles.col(0).head<2>());
  EXPECT_NEAR(std::atan2(to.y() - from.y(), to.x() - from.x()), view.particles(2, 0), 1e-12);
  view.weights.setZero();
  EXPECT_EQ(carPicture(view).pointSets.at(0).points.size(), 4u) << "without any weight all are alike";
}

TEST(CarPicture, DrawsSomeThousandsOfManyParticlesEvenly) {
  CarView view{.particles = cloud(9000)};
  const Picture picture = carPicture(view);
  ASSERT_EQ(countPoints(picture, 3), 3000u);
  EXPECT_EQ(picture.pointSets[0].points[1].head<2>(), view.particles.col(3).head<2>());
  EXPECT_EQ(picture.pointSets[0].points[2999].head<2>(), view.particles.col(8997).head<2>());
}

TEST(CarPicture, LinesLeadFromTheCarToWhatItSees) {
  CarView view = fullView();
  const auto linesOf = [](const CarView& shown) { return carPicture(shown).lineSets.back().segments; };
  ASSERT_EQ(linesOf(view).size(), 2u);
  EXPECT_EQ(linesOf(view)[1].first.head<2>(), Eigen::Vector2d(1, 2));
  EXPECT_EQ(linesOf(view)[1].second.head<2>(), Eigen::Vector2d(-5, 8));
  view.car.reset();
  EXPECT_EQ(linesOf(view)[0].first.head<2>(), Eigen::Vector2d(1.5, 2.5)) << "then from the estimate";
}

TEST(CarPicture, ShowsMapsAndSmallCars) {
  OccupancyMap map(4, 3, 0.5, {1, 2});
  for (const auto& [x, y] : {std::pair{0, 1}, {1, 1}, {3, 2}}) map.setLogOdds(x, y, 5);
  map.setLogOdds(2, 0, -5);
  const CarView view{.car = Eigen::Vector3d(2, 3, 0), .carScale = 0.5, .map = map};
  const Picture picture = carPicture(view);
  ASSERT_EQ(picture.solids.size(), 4u) << "floor, walls, car and cabin";
  const TriangleMesh& floor = picture.solids[0].shape.mesh;
  ASSERT_EQ(floor.parts().size(), 3u) << "free, unknown and occupied";
  const auto areaOf = [&](std::size_t part) {
    double area = 0;
    for (std::size_t k = 0; k < floor.parts()[part].triangleCount; ++k) {
      const auto& corners = floor.triangles()[floor.parts()[part].firstTriangle + k];
      const auto at = [&](int i) { return floor.positions()[corners[i]].cast<double>().eval(); };
      area += (at(1) - at(0)).cross(at(2) - at(0)).z() / 2;
    }
    return area;
  };
  EXPECT_NEAR(areaOf(0), 0.25, 1e-6) << "one cell";
  EXPECT_NEAR(areaOf(1), 8 * 0.25, 1e-6);
  EXPECT_NEAR(areaOf(2), 3 * 0.25, 1e-6);
  const auto shade = [&](std::size_t part) { return floor.parts()[part].color->x(); };
  EXPECT_LT(shade(2), shade(1)) << "occupied is darker than unknown";
  EXPECT_GT(shade(0), shade(1)) << "free is lighter";
  EXPECT_EQ(picture.solids[1].shape.mesh.triangles().size(), 20u) << "two blocks of five sides";
  Bounds walls;
  for (const Eigen::Vector3f& p : picture.solids[1].shape.mesh.positions()) walls.include(p.cast<double>());
  EXPECT_LT(
      (walls.low - Eigen::Vector3d(1, 2.5, 0)).norm() + (walls.high - Eigen::Vector3d(3, 3.5, 0.4)).norm(),
      1e-6);
  EXPECT_EQ(picture.solids[2].shape.extent, Eigen::Vector3d(1.5, 0.75, 0.25));
  const Figure figure = carFigure(view);
  ASSERT_TRUE(figure.map);
  EXPECT_NEAR(figure.map->xRange.first, 1, 1e-12);
  EXPECT_NEAR(figure.map->yRange.second, 3.5, 1e-12);
  EXPECT_NEAR(figure.map->occupancy(1, 0), 1, 0.01);
  EXPECT_NEAR(figure.map->occupancy(0, 2), 0, 0.01);
  EXPECT_EQ(figure.map->occupancy(0, 0), 0.5);
}

TEST(CarPicture, OfNothingIsEmpty) {
  const Picture picture = carPicture(CarView{});
  EXPECT_TRUE(bounds(picture).isEmpty());
  EXPECT_REX_ERROR(writePicture(picture, "x.png"), "nothing to draw: found no shape, line");
}

TEST(CarPicture, SaysWhatCannotBeDrawn) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const auto expect = [](const auto& spoil, const char* text) {
    CarView view = fullView();
    spoil(view);
    EXPECT_REX_ERROR(carPicture(view), text);
    EXPECT_REX_ERROR(carFigure(view), text);
  };
  expect([&](CarView& v) { v.car->x() = kNan; }, "car: number 0: found nan");
  expect([&](CarView& v) { v.estimate->z() = kNan; }, "estimate of the car: number 2: found nan");
  expect([&](CarView& v) { v.landmarks(1, 2) = kNan; }, "landmark 2: number 1: found nan");
  expect([&](CarView& v) { v.landmarks(0, 0) = 2e9; }, "landmark 0: number 0: found 2e+09, wanted at most");
  expect([&](CarView& v) { v.particles(0, 7) = kNan; }, "particle 7: number 0: found nan");
  expect([&](CarView& v) { v.sightings(0, 1) = kNan; }, "sighting 1: number 0: found nan");
  expect([&](CarView& v) { v.scan(0, 1) = kNan; }, "dot of the scan 1: number 0: found nan");
  expect([&](CarView& v) { v.paths[0].points(0, 2) = kNan; },
         "path 'true way', point 2: number 0: found nan");
  expect([](CarView& v) { v.weights.setOnes(3); }, "weights of particles: found a vector of size 3");
  expect([](CarView& v) { v.weights = -Eigen::VectorXd::Ones(40); },
         "weights of particles: number 0: found -1, wanted a finite number, 0 or more");
  expect([](CarView& v) { v.poseBeliefs[0].covariance(0, 1) = 1; }, "belief of a pose 0: found 1 at (0, 1)");
  expect([](CarView& v) { v.landmarkBeliefs[1].covariance(0, 0) = -1; }, "belief of a landmark 1: found");
  expect([&](CarView& v) { v.landmarkBeliefs[0].mean.x() = kNan; }, "belief of a landmark 0: number 0");
  expect([](CarView& v) { v.landmarkBeliefs[0].covariance *= 1e20; },
         "belief of a landmark 0, deviations: number 0: found 1e+10");
  expect([](CarView& v) { v.paths[0].width = 0; },
         "path 'true way', width: found 0, wanted more than 0, at most 50 pixels");
  expect([](CarView& v) { v.sigmas = 0; }, "sigmas: found 0, wanted a positive, finite number");
  expect([&](CarView& v) { v.sigmas = kNan; }, "sigmas: found nan");
  expect([](CarView& v) { v.carScale = 0; }, "scale of the car: found 0, wanted a positive, finite number");
  expect([](CarView& v) { v.car.reset(), v.estimate.reset(); },
         "sightings: found no car and no estimate, wanted one that sees them");
}

class CarFilm : public ::testing::Test {
 protected:
  std::string in(const std::string& name) const { return (folder_.path() / name).string(); }
  // A car that drives ahead.
  static std::vector<CarView> drive(int count) {
    std::vector<CarView> views(static_cast<std::size_t>(count), fullView());
    for (int i = 0; i < count; ++i) views[static_cast<std::size_t>(i)].car->y() += 0.5 * i;
    return views;
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(CarFilm, HasFramesAContactSheetAndAVideo) {
  REX_NEEDS_OSMESA();
  const FilmOptions small{.view = kFromAbove, .width = 96, .height = 72, .moments = 3};
  writeFilm(carFilm(drive(5)), in("film"), small);
  EXPECT_TRUE(fs::exists(in("film/0004.png")));
  EXPECT_FALSE(fs::exists(in("film/0005.png")));
  EXPECT_FALSE(readPng(in("film/0000.png")) == readPng(in("film/0004.png")));
  const Image sheet = readPng(in("film_sheet.png"));
  EXPECT_GT(sheet.width, 3 * 96);
  EXPECT_EQ(fs::exists(in("film.mp4")), runProcess({"ffmpeg", "-version"}).ok());
  writeFilm(carFilm(drive(5)), in("again"), small);
  EXPECT_EQ(fileText(in("film/0004.png")), fileText(in("again/0004.png")));
  EXPECT_EQ(fileText(in("film_sheet.png")), fileText(in("again_sheet.png")));
}

TEST_F(CarFilm, TheCameraDoesNotRunAwayFromGuessesWithoutKnowledge) {
  REX_NEEDS_OSMESA();
  const FilmOptions small{.view = kFromAbove, .width = 96, .height = 72};
  std::vector<CarView> views = drive(2);
  views[1].landmarkBeliefs[0].covariance *= 100;
  writeFilm(carFilm(views), in("some"), small);
  views[1].landmarkBeliefs[0].covariance *= 1e4;
  writeFilm(carFilm(views), in("none"), small);
  EXPECT_EQ(readPng(in("some/0000.png")), readPng(in("none/0000.png")));
}

TEST(PathPoints, ArePositionsOfPoses) {
  const Eigen::Matrix2Xd points = pathPoints({{1, 2, 9}, {3, 4, 9}});
  EXPECT_EQ(points, (Eigen::Matrix2d() << 1, 3, 2, 4).finished());
  EXPECT_EQ(pathPoints({}).cols(), 0);
}

TEST(CarFigure, IsTheMapFromAbove) {
  CarView view = fullView();
  const Figure figure = carFigure(view);
  EXPECT_TRUE(figure.equalAxes);
  EXPECT_EQ(figure.title, "a car");
  ASSERT_EQ(figure.ellipses.size(), 3u);
  EXPECT_EQ(figure.ellipses[0].label, "landmarks, 2 sigma");
  EXPECT_EQ(figure.ellipses[1].label, "") << "one entry in the legend for all";
  EXPECT_EQ(figure.regions.size(), 2u);
  EXPECT_EQ(figure.arrows.at(0).x.size(), 2u);
  const Series& landmarks = figure.series.back();
  EXPECT_EQ(landmarks.x, (std::vector<double>{4, -5, 6}));
  EXPECT_EQ(landmarks.y, (std::vector<double>{7, 8, -9}));
  EXPECT_TRUE(figure.series[figure.series.size() - 2].dashed);
  view.caption = "two\nlines";
  EXPECT_EQ(carFigure(view).title, "two lines");
}

TEST(CarFigure, CanBeDrawn) {
  REX_NEEDS_GNUPLOT();
  CarView view = fullView();
  view.weights = Eigen::VectorXd::LinSpaced(40, 0, 1);
  const std::string svg = encodeSvg(carFigure(view));
  for (const char* label : {"true way", "particles", "poses, 2 sigma", "seen now", "now", "estimate now"})
    EXPECT_NE(svg.find(label), std::string::npos) << label;
  EXPECT_REX_ERROR(encodeSvg(carFigure(CarView{})), "nothing to draw");
}

}  // namespace rex::car_pictures_test
