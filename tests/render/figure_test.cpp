#include "render/figure.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>

#include "base/process.h"
#include "render/figure_internal.h"
#include "render/image.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/fresh_folder.h"
#include "support/needs_gnuplot.h"

namespace rex::figure_test {

namespace fs = std::filesystem;

Figure parabola() {
  Figure figure{.title = "Parabola", .xLabel = "x [m]", .yLabel = "y [m]"};
  Series series{.label = "y = x^2"};
  for (int i = -10; i <= 10; ++i) {
    series.x.push_back(i / 10.0);
    series.y.push_back(i * i / 100.0);
  }
  figure.series.push_back(series);
  return figure;
}

// The curve is where it belongs: its colour is found low in the middle and high at both sides.
TEST(Figure, DrawsTheCurveThatWasGiven) {
  REX_NEEDS_GNUPLOT();
  const fs::path folder = freshFolder("figure");
  Figure figure = parabola();
  figure.series[0].color = Color{1, 0, 0};
  figure.legend = Legend::kNone;
  writeFigure(figure, folder / "a.png");
  const Image image = readPng(folder / "a.png");
  EXPECT_EQ(image.width, 800);
  EXPECT_EQ(image.height, 500);
  int left = image.width, right = 0, leftY = 0, lowest = 0, lowestX = 0;
  for (int x = 0; x < image.width; ++x)
    for (int y = 0; y < image.height; ++y) {
      const auto [r, g, b] = image.at(x, y);
      if (r < 200 || g > 60 || b > 60) continue;
      if (x < left) left = x, leftY = y;
      right = std::max(right, x);
      if (y > lowest) lowest = y, lowestX = x;
    }
  EXPECT_LT(leftY, 120);
  EXPECT_GT(lowest, 380);
  EXPECT_NEAR(lowestX, (left + right) / 2.0, 0.1 * (right - left));
  EXPECT_GT(right - left, 500);
}

TEST(Figure, GivesTheSameBytesTwiceAndHonoursItsSize) {
  REX_NEEDS_GNUPLOT();
  const fs::path folder = freshFolder("figure-twice");
  Figure figure = parabola();
  figure.width = 300, figure.height = 200;
  for (const char* ending : {".png", ".svg"}) {
    writeFigure(figure, folder / (std::string("a") + ending));
    writeFigure(figure, folder / (std::string("b") + ending));
    EXPECT_EQ(fileText(folder / (std::string("a") + ending)), fileText(folder / (std::string("b") + ending)));
  }
  EXPECT_EQ(readPng(folder / "a.png").width, 300);
}

TEST(Figure, DrawsEveryOption) {
  REX_NEEDS_GNUPLOT();
  const fs::path folder = freshFolder("figure-options");
  Figure figure = parabola();
  figure.series.push_back({.y = {0.5, 1, 2}, .style = SeriesStyle::kLinesPoints, .dashed = true});
  figure.series.push_back(
      {.label = "dots", .x = {0.1, 1}, .y = {1e-300, 1e300}, .style = SeriesStyle::kPoints});
  figure.equalAxes = true;
  figure.xRange = {-2, 2};
  figure.yRange = {0, 3};
  for (const Legend legend :
       {Legend::kTopLeft, Legend::kBottomRight, Legend::kBottomLeft, Legend::kOutside, Legend::kNone}) {
    figure.legend = legend;
    EXPECT_NO_THROW(writeFigure(figure, folder / "a.svg"));
  }
  Figure logarithmic{.xLabel = "x [m]",
                     .yLabel = "y [m]",
                     .logX = true,
                     .logY = true,
                     .xRange = std::pair{1e-3, 1e3},
                     .yRange = std::pair{1.0, 2.0}};
  logarithmic.series.push_back({.x = {0.01, 100}, .y = {1, 2}});
  EXPECT_NO_THROW(writeFigure(logarithmic, folder / "b.png"));
  Figure flat{.xLabel = "step", .yLabel = "y [1]"};
  flat.series.push_back({.y = {3, 3, 3}});
  EXPECT_NO_THROW(writeFigure(flat, folder / "flat.png"));
}

TEST(Figure, ShowsALineOfOnePoint) {
  REX_NEEDS_GNUPLOT();
  const fs::path folder = freshFolder("figure-point");
  Figure figure{.xLabel = "step", .yLabel = "y [1]", .series = {{.y = {0.3}, .color = Color{1, 0, 0}}}};
  writeFigure(figure, folder / "a.png");
  const Image image = readPng(folder / "a.png");
  int red = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) red += image.at(x, y)[0] > 200 && image.at(x, y)[1] < 60 ? 1 : 0;
  EXPECT_GT(red, 5);
}

TEST(Figure, RejectsDataItCannotDraw) {
  const fs::path path = freshFolder("figure-data") / "a.png";
  Figure figure = parabola();
  figure.series[0].y[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REX_ERROR(writeFigure(figure, path),
                   "figure 'Parabola', series 'y = x^2': found y[3] = nan, wanted finite numbers");
  figure.series[0].y[3] = -std::numeric_limits<double>::infinity();
  EXPECT_REX_ERROR(writeFigure(figure, path), "found y[3] = -inf");
  figure.series[0].y[3] = 1;
  figure.logX = true;
  EXPECT_REX_ERROR(writeFigure(figure, path), "found x[0] = -1, wanted finite numbers above 0");
  figure.logX = false;
  figure.logY = true;
  EXPECT_REX_ERROR(writeFigure(figure, path), "found y[10] = 0, wanted finite numbers above 0");
  figure.series[0].y.pop_back();
  EXPECT_REX_ERROR(writeFigure(figure, path), "found 21 x and 20 y, wanted as many x as y");
  figure.series[0] = {};
  EXPECT_REX_ERROR(writeFigure(figure, path), "figure 'Parabola', series 0: found no points");
  figure.series.clear();
  EXPECT_REX_ERROR(writeFigure(figure, path),
                   "figure 'Parabola': found nothing to draw, wanted at least one series");
  EXPECT_FALSE(fs::exists(path));
}

TEST(Figure, RejectsShapesItCannotHave) {
  const fs::path path = freshFolder("figure-shape") / "a.png";
  Figure figure = parabola();
  figure.xRange = {1, 1};
  EXPECT_REX_ERROR(writeFigure(figure, path), "'Parabola', range of x: found 1 to 1, wanted low < high");
  figure.xRange = {1, 1 + 1e-12};
  EXPECT_REX_ERROR(writeFigure(figure, path), "range of x: found 1 to 1.000000000001, wanted low < high");
  figure.xRange.reset();
  figure.logY = true;
  figure.yRange = {0, 1};
  EXPECT_REX_ERROR(writeFigure(figure, path), "range of y: found 0 to 1, wanted 0 < low < high");
  figure = parabola();
  figure.height = 20;
  EXPECT_REX_ERROR(writeFigure(figure, path), "found a size of 800 x 20, wanted 100 to 8192 pixels");
  figure = parabola();
  figure.logX = true;
  figure.series[0].x.clear();
  EXPECT_REX_ERROR(writeFigure(figure, path), "found no x, wanted x for the logarithmic axis");
  EXPECT_REX_ERROR(writeFigure(parabola(), "a.gif"),
                   "figure 'a.gif': found the ending '.gif', wanted .png or");
}

TEST(Figure, RejectsRangesThatMissTheData) {
  const fs::path path = freshFolder("figure-range") / "a.png";
  Figure figure = parabola();
  figure.xRange = {5, 6};
  EXPECT_REX_ERROR(writeFigure(figure, path),
                   "figure 'Parabola': found no data within x 5 to 6, y 0 to 1, wanted ranges that meet the "
                   "data: x -1 to 1, y 0 to 1");
  figure.xRange.reset();
  figure.yRange = {-2, -1};
  EXPECT_REX_ERROR(writeFigure(figure, path), "found no data within x -1 to 1, y -2 to -1");
  // Above the curve, though within its width and height.
  figure.xRange = {-0.2, 0.2};
  figure.yRange = {0.5, 0.9};
  EXPECT_REX_ERROR(writeFigure(figure, path), "found no data within x -0.2 to 0.2, y 0.5 to 0.9");
  Figure steep{.xLabel = "x [m]",
               .yLabel = "y [m]",
               .logY = true,
               .xRange = std::pair{0.8, 1.0},
               .yRange = std::pair{1.0, 2.0}};
  steep.series.push_back({.x = {0, 1}, .y = {1, 1e6}});
  EXPECT_REX_ERROR(writeFigure(steep, path),
                   "no data within x 0.8 to 1, y 1 to 2, wanted ranges that meet the "
                   "data: x 0 to 1, y 1 to 1e+06");
}

TEST(Figure, SeesALineBetweenPointsOutsideItsRange) {
  REX_NEEDS_GNUPLOT();
  const fs::path path = freshFolder("figure-crossing") / "a.svg";
  Figure figure{
      .xLabel = "x [m]", .yLabel = "y [m]", .xRange = std::pair{-1.0, 1.0}, .yRange = std::pair{-1.0, 1.0}};
  figure.series.push_back({.x = {-1e300, 1e300}, .y = {-1e300, 1e300}});
  EXPECT_NO_THROW(writeFigure(figure, path));
  figure.series[0] = {.x = {-4, 4}, .y = {-4, 4}, .style = SeriesStyle::kPoints};
  EXPECT_REX_ERROR(writeFigure(figure, path), "found no data within x -1 to 1, y -1 to 1");
  // gnuplot would find no point to fit the y axis to.
  figure.series[0].style = SeriesStyle::kLine;
  figure.yRange.reset();
  EXPECT_REX_ERROR(writeFigure(figure, path), "found no data within x -1 to 1, y -4 to 4");
  figure.yRange = {-1, 1};
  figure.xRange.reset();
  EXPECT_NO_THROW(writeFigure(figure, path));
}

// Axes of all sizes, also without any width, have tics that gnuplot can count.
TEST(Figure, DrawsNumbersOfEverySize) {
  REX_NEEDS_GNUPLOT();
  const fs::path path = freshFolder("figure-sizes") / "a.svg";
  for (const double size : {1e-299, 1e-20, 1., 1e15, 1e300})
    for (const double relative : {0., 1e-16, 1e-9, 1.})
      for (const bool logarithmic : {false, true}) {
        Figure figure{.xLabel = "x [1]", .yLabel = "y [1]", .logY = logarithmic};
        figure.series = {{.x = {-size, -size * (1 - relative)}, .y = {size, size * (1 - relative / 2)}}};
        EXPECT_NO_THROW(writeFigure(figure, path)) << size << " " << relative << " " << logarithmic;
        figure.yRange = AxisRange{size * (1 - 1e-9), size};
        EXPECT_NO_THROW(writeFigure(figure, path)) << size << " " << relative << " " << logarithmic;
      }
}

TEST(Figure, NamesThePathItCannotWrite) {
  REX_NEEDS_GNUPLOT();
  EXPECT_REX_ERROR(writeFigure(parabola(), "/no/such/folder/a.png"),
                   "cannot write '/no/such/folder/a.png': found No such file");
}

// gnuplot is looked up in PATH; here PATH leads to none, then to one that fails, says nothing, or hangs up.
class FigureWithOtherGnuplot : public testing::Test {
 protected:
  void SetUp() override { ::setenv("PATH", folder_.c_str(), 1); }
  void TearDown() override { ::setenv("PATH", path_.c_str(), 1); }
  void installGnuplot(const std::string& script) {
    const fs::path program = folder_ / "gnuplot";
    std::ofstream(program) << "#!/bin/sh\n" << script;
    fs::permissions(program, fs::perms::owner_all);
  }
  std::string path_ = std::getenv("PATH");
  fs::path folder_ = freshFolderOfTest("figure-gnuplot");
};

TEST_F(FigureWithOtherGnuplot, NamesThePackageWhenMissing) {
  EXPECT_REX_ERROR(writeFigure(parabola(), folder_ / "a.png"), "wanted gnuplot, Debian package gnuplot-nox");
}

TEST_F(FigureWithOtherGnuplot, ReportsItsFailureAndLeavesNoFile) {
  installGnuplot("echo half a picture; echo line 3: trouble >&2; exit 1\n");
  EXPECT_REX_ERROR(writeFigure(parabola(), folder_ / "a.png"), "a.png': found gnuplot says: line 3: trouble");
  installGnuplot("kill -9 $$\n");
  EXPECT_REX_ERROR(writeFigure(parabola(), folder_ / "a.png"), "a.png': found signal 9 that ended gnuplot");
  installGnuplot("exec /bin/sleep 600\n");
  EXPECT_REX_ERROR(internal::runGnuplot("plot x", "a.png", 0.2),
                   "a.png': found gnuplot still running, wanted a picture within 0.2 s");
  installGnuplot("exit 0\n");
  EXPECT_REX_ERROR(writeFigure(parabola(), folder_ / "a.png"), "found no complete picture from gnuplot");
  EXPECT_FALSE(fs::exists(folder_ / "a.png"));
}

}  // namespace rex::figure_test
