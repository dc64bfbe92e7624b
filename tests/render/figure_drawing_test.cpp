// What gnuplot drew is read back from the SVG: the tics with their numbers give the scales, so that a drawn
// point has coordinates that the data must agree with.
#include <cmath>
#include <map>

// With sanitizers g++ 12 sees an uninitialized function inside <regex>, where there is none.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <regex>
#pragma GCC diagnostic pop

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "render/figure_builders.h"
#include "render/image.h"
#include "support/file_text.h"
#include "support/fresh_folder.h"
#include "support/needs_gnuplot.h"

namespace rex::figure_drawing_test {

namespace fs = std::filesystem;
using Eigen::Vector2d;

class Drawing {
 public:
  explicit Drawing(const Figure& figure) {
    const fs::path path = freshFolderOfTest("figure-drawing") / "a.svg";
    writeFigure(figure, path);
    svg_ = fileText(path);
    static const std::regex tic(
        "d='M([0-9.]+),([0-9.]+) L([0-9.]+),([0-9.]+)  '/>\\s*<g "
        "transform=\"[^>]*>\\s*<text>([-0-9.e+]+)</text>");
    std::map<double, double> across, up;  // pixels by value
    for (std::sregex_iterator it(svg_.begin(), svg_.end(), tic), end; it != end; ++it) {
      const auto number = [&](int k) { return std::stod((*it)[k]); };
      if (number(1) == number(3)) across[number(5)] = number(1);
      if (number(2) == number(4)) up[number(5)] = number(2);
    }
    EXPECT_GE(across.size(), 2u);
    EXPECT_GE(up.size(), 2u);
    x_ = scaleOf(across), y_ = scaleOf(up);
  }

  /// All points of layer `index`, counted from 1 in the order of drawing, in units of the axes.
  [[nodiscard]] std::vector<Vector2d> points(int index) const {
    const std::size_t begin = svg_.find("id=\"gnuplot_plot_" + std::to_string(index) + "\"");
    if (begin == std::string::npos) return {};
    // Behind the last layer the axes are drawn again, in their own grey.
    const std::size_t end = std::min(svg_.find("id=\"gnuplot_plot_", begin + 1),
                                     svg_.find("<path stroke='rgb( 85,  85,  85)'", begin));
    return pointsIn(svg_.substr(begin, end - begin));
  }

  [[nodiscard]] std::vector<Vector2d> pointsIn(const std::string& part) const {
    static const std::regex pair("([0-9]+\\.[0-9]+),([0-9]+\\.[0-9]+)");
    static const std::regex dashes("stroke-dasharray='[^']*'");
    const std::string drawn = std::regex_replace(part, dashes, "");
    std::vector<Vector2d> points;
    for (std::sregex_iterator it(drawn.begin(), drawn.end(), pair), end; it != end; ++it)
      points.push_back(dataOf(std::stod((*it)[1]), std::stod((*it)[2])));
    return points;
  }
  [[nodiscard]] Vector2d dataOf(double x, double y) const {
    return {(x - x_.offset) / x_.pixels, (y - y_.offset) / y_.pixels};
  }
  [[nodiscard]] const std::string& svg() const { return svg_; }

 private:
  struct Scale {
    double offset = 0, pixels = 1;
  };
  static Scale scaleOf(const std::map<double, double>& tics) {
    const double pixels =
        (tics.rbegin()->second - tics.begin()->second) / (tics.rbegin()->first - tics.begin()->first);
    return {tics.begin()->second - tics.begin()->first * pixels, pixels};
  }
  std::string svg_;
  Scale x_, y_;
};

Figure plain() { return {.xLabel = "x [m]", .yLabel = "y [m]", .legend = Legend::kNone}; }

// The distance to the nearest of the points.
double missOf(const Vector2d& wanted, const std::vector<Vector2d>& points) {
  double miss = 1e9;
  for (const Vector2d& point : points) miss = std::min(miss, (point - wanted).norm());
  return miss;
}

// The series never has a point within the axes, yet crosses them three times.
TEST(FigureDrawing, LinesCrossARangeWithoutPointsInIt) {
  REX_NEEDS_GNUPLOT();
  Figure figure = plain();
  figure.series = {{.x = {0, 1, 2, 3}, .y = {0, 1, 0, 1}}};
  figure.yRange = AxisRange{0.2, 0.8};
  const Drawing drawing(figure);
  const std::vector<Vector2d> points = drawing.points(1);
  ASSERT_EQ(points.size(), 6u);
  for (const Vector2d& wanted :
       {Vector2d(0.2, 0.2), {0.8, 0.8}, {1.2, 0.8}, {1.8, 0.2}, {2.2, 0.2}, {2.8, 0.8}})
    EXPECT_LT(missOf(wanted, points), 0.01) << wanted.transpose();
}

TEST(FigureDrawing, LinesAndPointsLieWhereTheDataSays) {
  REX_NEEDS_GNUPLOT();
  Figure figure = plain();
  Rng rng(1);
  Series series;
  for (int i = 0; i < 20; ++i) {
    series.x.push_back(rng.uniform(-3, 8));
    series.y.push_back(rng.uniform(-20, 5));
  }
  figure.series = {series, series};
  figure.series[1].style = SeriesStyle::kPoints;
  const Drawing drawing(figure);
  for (const int layer : {1, 2}) {
    const std::vector<Vector2d> points = drawing.points(layer);
    ASSERT_EQ(points.size(), series.x.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_NEAR(points[i].x(), series.x[i], 0.01);
      EXPECT_NEAR(points[i].y(), series.y[i], 0.02);
    }
  }
}

TEST(FigureDrawing, BandsReachFromLowToHigh) {
  REX_NEEDS_GNUPLOT();
  Figure figure = plain();
  Band band{.x = {0, 1, 2, 4}, .low = {-1, 0, 1, 0.5}, .high = {1, 2, 1.5, 3}};
  figure.bands = {band};
  const std::vector<Vector2d> points = Drawing(figure).points(1);
  for (std::size_t i = 0; i < band.x.size(); ++i) {
    EXPECT_LT(missOf({band.x[i], band.low[i]}, points), 0.01);
    EXPECT_LT(missOf({band.x[i], band.high[i]}, points), 0.01);
  }
  for (const Vector2d& point : points) {
    EXPECT_GE(point.y(), -1.01);
    EXPECT_LE(point.y(), 3.01);
  }
}

TEST(FigureDrawing, EllipsesSatisfyTheirEquation) {
  REX_NEEDS_GNUPLOT();
  Rng rng(2);
  for (int k = 0; k < 5; ++k) {
    Eigen::Matrix2d A;
    A << rng.normal(), rng.normal(), rng.normal(), rng.normal();
    const CovarianceEllipse ellipse{.mean = {rng.uniform(-5, 5), rng.uniform(-5, 5)},
                                    .covariance = A * A.transpose() + 0.2 * Eigen::Matrix2d::Identity(),
                                    .sigmas = 1 + rng.uniform()};
    Figure figure = plain();
    figure.ellipses = {ellipse};
    const std::vector<Vector2d> points = Drawing(figure).points(1);
    ASSERT_GE(points.size(), 90u);
    Vector2d sum(0, 0);
    for (const Vector2d& point : points) {
      const Vector2d d = point - ellipse.mean;
      EXPECT_NEAR(std::sqrt(d.dot(ellipse.covariance.inverse() * d)), ellipse.sigmas, 0.01);
      sum += d / static_cast<double>(points.size());
    }
    EXPECT_LT(sum.norm(), 0.05);  // all around, not one side of it
  }
}

TEST(FigureDrawing, BarsStandOnTheirEdges) {
  REX_NEEDS_GNUPLOT();
  Figure figure = plain();
  figure.histograms = {{.edges = {-1, 0, 0.5, 2}, .heights = {3, -1, 2}}};
  std::vector<Vector2d> points = Drawing(figure).points(1);
  for (const Vector2d& corner :
       std::vector<Vector2d>{{-1, 0}, {-1, 3}, {0, 3}, {0, -1}, {0.5, -1}, {0.5, 2}, {2, 2}, {2, 0}})
    EXPECT_LT(missOf(corner, points), 0.02) << corner.transpose();
  figure.histograms = {{.heights = {1, 2, 4}}};
  points = Drawing(figure).points(1);
  for (const Vector2d& corner : std::vector<Vector2d>{{-0.4, 1}, {0.6, 2}, {1.4, 2}, {2.4, 4}})
    EXPECT_LT(missOf(corner, points), 0.02) << corner.transpose();
}

TEST(FigureDrawing, ArrowsRegionsAndGuidesLieInTheirPlace) {
  REX_NEEDS_GNUPLOT();
  Figure figure = plain();
  figure.regions = {{.x = {0, 4, 2}, .y = {0, 0, 3}}};
  figure.arrows = {{.x = {1}, .y = {1}, .dx = {2}, .dy = {-0.5}}};
  figure.verticalLines = {{.at = 1.5}};
  figure.horizontalLines = {{.at = 2.5}};
  const Drawing drawing(figure);
  for (const Vector2d& corner : {Vector2d(0, 0), Vector2d(4, 0), Vector2d(2, 3)})
    EXPECT_LT(missOf(corner, drawing.points(1)), 0.02);
  EXPECT_LT(missOf({1, 1}, drawing.points(2)), 0.02);
  EXPECT_LT(missOf({3, 0.5}, drawing.points(2)), 0.02);
  for (const Vector2d& point : drawing.points(3)) EXPECT_NEAR(point.x(), 1.5, 0.01);
  for (const Vector2d& point : drawing.points(4)) EXPECT_NEAR(point.y(), 2.5, 0.01);
  EXPECT_LT(missOf({1.5, 0}, drawing.points(3)), 0.02);
  EXPECT_LT(missOf({4, 2.5}, drawing.points(4)), 0.02);
}

// The circle of radius r is the contour r^2 of x^2 + y^2.
TEST(FigureDrawing, ContoursFollowEqualValues) {
  REX_NEEDS_GNUPLOT();
  Figure figure = plain();
  figure.colorLabel = "square [m^2]";
  figure.colorRange = {0, 2};
  figure.heatMap = sampledHeatMap([](double x, double y) { return x * x + y * y; }, {-2, 2}, {-2, 2}, 80, 80);
  figure.heatMap->contours = 1;
  const std::vector<Vector2d> points = Drawing(figure).points(2);
  ASSERT_GT(points.size(), 100u);
  for (const Vector2d& point : points) EXPECT_NEAR(point.norm(), 1, 0.01);
  EXPECT_LT(missOf({-1, 0}, points), 0.1);
  EXPECT_LT(missOf({0, 1}, points), 0.1);
}

TEST(FigureDrawing, CellsFillTheirRectangleWithRowZeroBelow) {
  REX_NEEDS_GNUPLOT();
  Figure figure = plain();
  figure.map =
      OccupancyCells{.xRange = {-1, 3}, .yRange = {10, 12}, .occupancy = Eigen::MatrixXd::Zero(2, 4)};
  figure.map->occupancy(0, 3) = 1;
  figure.map->occupancy(1, 0) = 0.5;
  const Drawing drawing(figure);
  std::smatch box;
  static const std::regex image(
      "<image [^>]*x='([0-9.]+)' y='([0-9.]+)' width='([0-9.]+)' height='([0-9.]+)'");
  ASSERT_TRUE(std::regex_search(drawing.svg(), box, image));
  const double x = std::stod(box[1]), y = std::stod(box[2]), width = std::stod(box[3]),
               height = std::stod(box[4]);
  EXPECT_LT((drawing.dataOf(x, y) - Vector2d(-1, 12)).norm(), 0.02);
  EXPECT_LT((drawing.dataOf(x + width, y + height) - Vector2d(3, 10)).norm(), 0.02);
  const fs::path path = freshFolder("figure-cells") / "a.png";
  writeFigure(figure, path);
  const Image png = readPng(path);
  const auto grey = [&](double across, double down) {
    const auto [r, g, b] = png.at(static_cast<int>(x + across * width), static_cast<int>(y + down * height));
    EXPECT_EQ(r, g);
    EXPECT_EQ(g, b);
    return r;
  };
  EXPECT_LT(grey(7. / 8, 0.75), 60);        // row 0, column 3: occupied
  EXPECT_NEAR(grey(1. / 8, 0.25), 191, 5);  // row 1, column 0: unknown
  EXPECT_EQ(grey(3. / 8, 0.75), 255);
  EXPECT_EQ(grey(7. / 8, 0.25), 255);
}

TEST(FigureDrawing, ColoursFollowTheValues) {
  REX_NEEDS_GNUPLOT();
  Figure figure = plain();
  figure.colorLabel = "weight [1]";
  figure.series = {{.y = {0, 0, 0}, .values = {1, 2, 3}, .style = SeriesStyle::kPoints}};
  const std::string svg = Drawing(figure).svg();
  // The ends and the middle of the palette of share/gnuplot/style.gp, in this order.
  static const std::regex point("<use xlink:href='#gpPt[0-9]+' transform='[^']*' color='rgb\\(([ 0-9]+),");
  std::vector<int> reds;
  for (std::sregex_iterator it(svg.begin(), svg.end(), point), end; it != end; ++it)
    reds.push_back(std::stoi((*it)[1]));
  ASSERT_EQ(reds.size(), 3u);
  EXPECT_NEAR(reds[0], 0x2D, 3);
  EXPECT_NEAR(reds[1], 0x2F, 3);
  EXPECT_NEAR(reds[2], 0xF7, 3);
}

// No numbers to read back in perspective; but what stands higher is drawn higher.
TEST(FigureDrawing, PathsInSpaceKeepUpUp) {
  REX_NEEDS_GNUPLOT();
  Figure figure = plain();
  figure.zLabel = "z [m]";
  figure.series = {{.x = {0, 0, 1}, .y = {0, 0, 1}, .z = {0, 1, 1}}};
  const fs::path path = freshFolder("figure-space") / "a.svg";
  writeFigure(figure, path);
  const std::string svg = fileText(path);
  std::smatch d;
  const std::string part = svg.substr(svg.find("id=\"gnuplot_plot_1\""));
  static const std::regex line("d='M([0-9.]+),([0-9.]+) L([0-9.]+),([0-9.]+) L([0-9.]+),([0-9.]+)");
  ASSERT_TRUE(std::regex_search(part, d, line));
  EXPECT_NEAR(std::stod(d[1]), std::stod(d[3]), 0.1);
  EXPECT_GT(std::stod(d[2]), std::stod(d[4]) + 50);
}

// Numbers at the tics of an axis, as texts.
std::vector<std::string> tics(const std::string& svg, bool across) {
  static const std::regex tic(
      "d='M([0-9.]+),([0-9.]+) L([0-9.]+),([0-9.]+)  '/>\\s*<g "
      "transform=\"[^>]*>\\s*<text>([-0-9.e+]+)</text>");
  std::vector<std::string> texts;
  for (std::sregex_iterator it(svg.begin(), svg.end(), tic), end; it != end; ++it)
    if (((*it)[1] == (*it)[3]) == across) texts.push_back((*it)[5]);
  return texts;
}

TEST(FigureDrawing, TicsFitTheSizeAndStayWholeForCounts) {
  REX_NEEDS_GNUPLOT();
  using Texts = std::vector<std::string>;
  Figure figure = plain();
  figure.series = {{.y = {0.2, 0.5, 0.9, 1.6}}};
  EXPECT_EQ(tics(Drawing(figure).svg(), true), (Texts{"0", "1", "2", "3"}));
  figure.series = {{.x = {0, 2.5}, .y = {0, 7}}};
  EXPECT_EQ(tics(Drawing(figure).svg(), true), (Texts{"0", "0.5", "1", "1.5", "2", "2.5"}));
  EXPECT_EQ(tics(Drawing(figure).svg(), false), (Texts{"0", "1", "2", "3", "4", "5", "6", "7"}));
  figure.width = 200, figure.height = 140;
  EXPECT_EQ(tics(Drawing(figure).svg(), true), (Texts{"0", "1", "2"}));
  EXPECT_EQ(tics(Drawing(figure).svg(), false), (Texts{"0", "5"}));
  figure.series = {{.y = {1e-9, 1e9}}};
  figure.logY = true;
  EXPECT_EQ(tics(Drawing(figure).svg(), false), (Texts{"1e-06", "1", "1e+06"}));
}

// The legend's text lies in the corner that the curve leaves free.
TEST(FigureDrawing, TheLegendStandsInTheEmptiestCorner) {
  REX_NEEDS_GNUPLOT();
  static const std::regex entry("translate\\(([0-9.]+),([0-9.]+)\\)\"[^>]*>\\s*<text>curve</text>");
  for (const double sign : {1., -1.})
    for (const bool rightFree : {true, false}) {
      Figure figure = plain();
      figure.legend = Legend::kAuto;
      figure.series = {{.label = "curve", .x = {-1, 0, 1}, .y = {sign, -sign, -sign}}};
      if (!rightFree) figure.series[0].y = {-sign, -sign, sign};
      figure.series.push_back({.x = {-1, 1}, .y = {-sign, -sign}});
      const std::string svg = Drawing(figure).svg();
      std::smatch place;
      ASSERT_TRUE(std::regex_search(svg, place, entry));
      EXPECT_EQ(std::stod(place[1]) > 400, rightFree);
      EXPECT_EQ(std::stod(place[2]) < 250, sign > 0);
    }
}

TEST(FigureDrawing, SaysNothingOfTheGnuplotThatDrewIt) {
  REX_NEEDS_GNUPLOT();
  Figure figure = plain();
  figure.series = {{.y = {1, 2}}};
  const std::string svg = Drawing(figure).svg();
  EXPECT_EQ(svg.find("patchlevel"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

}  // namespace rex::figure_drawing_test
