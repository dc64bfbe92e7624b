#include "render/figure_builders.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::figure_builders_test {

using Eigen::Vector2d;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Counted again, bin by bin.
TEST(HistogramOf, CountsEverySampleOnce) {
  Rng rng(1);
  for (int round = 0; round < 20; ++round) {
    std::vector<double> samples;
    const int count = 1 + rng.index(500), bins = 1 + rng.index(30);
    for (int i = 0; i < count; ++i) samples.push_back(round % 2 == 0 ? rng.normal() : rng.index(10));
    const Histogram histogram = sampleHistogram(samples, bins);
    ASSERT_EQ(histogram.heights.size(), static_cast<std::size_t>(bins));
    ASSERT_EQ(histogram.edges.size(), histogram.heights.size() + 1);
    EXPECT_EQ(std::accumulate(histogram.heights.begin(), histogram.heights.end(), 0.), count);
    for (std::size_t k = 0; k < histogram.heights.size(); ++k) {
      const bool last = k + 1 == histogram.heights.size();
      const double low = histogram.edges[k], high = histogram.edges[k + 1];
      const auto within = [&](double s) { return s >= low && (s < high || (last && s <= high)); };
      EXPECT_EQ(histogram.heights[k], std::count_if(samples.begin(), samples.end(), within))
          << "seed 1, " << round;
      EXPECT_NEAR(high - low, (histogram.edges.back() - histogram.edges[0]) / bins, 1e-12);
    }
    EXPECT_EQ(histogram.edges[0],
              *std::min_element(samples.begin(), samples.end()) - (samples.size() == 1 ? 0.5 : 0));
  }
}

TEST(HistogramOf, GivesEqualSamplesOneBinOfWidthOne) {
  const Histogram histogram = sampleHistogram({3, 3, 3}, 1);
  EXPECT_EQ(histogram.edges, (std::vector<double>{2.5, 3.5}));
  EXPECT_EQ(histogram.heights, (std::vector<double>{3}));
}

TEST(HistogramOf, RejectsWhatItCannotCount) {
  EXPECT_REX_ERROR(sampleHistogram({}, 3), "histogram: found no samples, wanted at least one");
  EXPECT_REX_ERROR(sampleHistogram({1}, 0), "bins of a histogram: found 0, wanted 1 to 10000");
  EXPECT_REX_ERROR(sampleHistogram({1, kNan}, 3),
                   "samples of a histogram: number 1: found nan, wanted a finite number");
}

TEST(Normalized, HasAreaOne) {
  const Histogram histogram = normalized({.edges = {0, 1, 4}, .heights = {2, 1}});
  EXPECT_EQ(histogram.heights, (std::vector<double>{0.4, 0.2}));
  EXPECT_REX_ERROR(normalized({.heights = {2, 1}}),
                   "normalized histogram: found an area of 0 between its edges");
}

TEST(HeatMapOf, SamplesAtTheCentresOfCells) {
  const HeatMap heatMap = sampledHeatMap([](double x, double y) { return 10 * x + y; }, {0, 2}, {0, 6}, 2, 3);
  Eigen::MatrixXd wanted(3, 2);
  wanted << 6, 16, 8, 18, 10, 20;
  EXPECT_TRUE(heatMap.values.isApprox(wanted, 1e-12)) << heatMap.values;
  EXPECT_REX_ERROR(sampledHeatMap([](double, double) { return 0; }, {0, 1}, {0, 1}, 1, 5),
                   "columns of a heat map: found 1, wanted 2 to 2000");
  EXPECT_REX_ERROR(sampledHeatMap([](double, double) { return 0; }, {0, 1}, {0, 1}, 5, 2001),
                   "rows of a heat map: found 2001, wanted 2 to 2000");
}

TEST(ArrowsOf, PointAlongTheFieldAndStayInTheirCells) {
  const auto field = [](const Vector2d& p) { return Vector2d(-p.y(), 50 * p.x()); };
  const Arrows arrows = arrowField(field, {-2, 2}, {-30, 30}, 5, 7);
  EXPECT_EQ(arrows.x.size(), 34u);  // the field is zero in the middle
  for (std::size_t i = 0; i < arrows.x.size(); ++i) {
    const Vector2d d(arrows.dx[i], arrows.dy[i]), f = field(Vector2d(arrows.x[i], arrows.y[i]) + d / 2);
    EXPECT_NEAR(d.x() * f.y() - d.y() * f.x(), 0, 1e-9 * d.norm() * f.norm());
    EXPECT_GT(d.dot(f), 0);
    EXPECT_NEAR(std::hypot(d.x() / (4. / 5), d.y() / (60. / 7)), 0.7, 1e-12);
  }
  EXPECT_REX_ERROR(arrowField(field, {0, 1}, {0, 1}, 0, 5), "columns of arrows: found 0, wanted 1 to 200");
  EXPECT_REX_ERROR(arrowField(field, {0, 1}, {0, 1}, 5, 201), "rows of arrows: found 201, wanted 1 to 200");
}

TEST(PoleFigure, ShowsEveryPoleAndTheRegionOfStability) {
  Figure figure = poleFigure({{-3, 1}, {-3, -1}}, {5}, TimeDomain::kContinuous);
  ASSERT_EQ(figure.series.size(), 2u);
  EXPECT_EQ(figure.series[0].y, (std::vector<double>{1, -1}));
  EXPECT_EQ(figure.series[1].x, (std::vector<double>{5}));
  EXPECT_GT(figure.xRange->second, 5);
  EXPECT_LT(figure.xRange->first, -3);
  EXPECT_EQ(*std::max_element(figure.regions[0].x.begin(), figure.regions[0].x.end()), 0);
  figure = poleFigure({0.5}, {}, TimeDomain::kDiscrete);
  ASSERT_EQ(figure.series.size(), 1u);
  EXPECT_GT(figure.yRange->second, 1);
  for (std::size_t i = 0; i < figure.regions[0].x.size(); ++i)
    EXPECT_NEAR(std::hypot(figure.regions[0].x[i], figure.regions[0].y[i]), 1, 1e-12);
  figure = poleFigure({}, {0}, TimeDomain::kContinuous);
  EXPECT_EQ(figure.xRange, AxisRange(-1, 1));
}

TEST(PoleFigure, RejectsWhatHasNoPlace) {
  EXPECT_REX_ERROR(poleFigure({}, {}, TimeDomain::kDiscrete), "pole figure: found no poles and no zeros");
  EXPECT_REX_ERROR(poleFigure({kNan}, {}, TimeDomain::kDiscrete),
                   "poles: real parts: number 0: found nan, wanted a finite number");
  EXPECT_REX_ERROR(poleFigure({1}, {0, {0, kNan}}, TimeDomain::kDiscrete),
                   "zeros: imaginary parts: number 1: found nan");
}

TEST(PointsOfAFigure, HaveTwoNumbers) {
  const std::string wanted = ", wanted two or more, such as the columns of a 2 x n matrix";
  const Eigen::MatrixXd row = Eigen::MatrixXd::Ones(1, 5);
  EXPECT_REX_ERROR(static_cast<void>(through(row)), "points of a figure: found one number for each" + wanted);
  EXPECT_REX_ERROR(static_cast<void>(dots(row)), "points of a figure: found one number for each" + wanted);
  EXPECT_REX_ERROR(static_cast<void>(within(std::vector<Eigen::VectorXd>(1))),
                   "points of a figure: found points without numbers" + wanted);
}

// Lists of vectors, the columns of a matrix, and one vector are the same points.
TEST(PointsOfAFigure, AreTheFirstTwoNumbers) {
  using Numbers = std::vector<double>;
  const std::vector<Eigen::Vector3d> poses{{1, 2, 9}, {3, 4, 9}};
  Eigen::MatrixXd columns(3, 2);
  columns << 1, 3, 2, 4, 9, 9;
  const std::vector<Eigen::VectorXd> lists{columns.col(0), columns.col(1)};
  for (const Series& curve : {through(poses, {.label = "path"}), through(columns, {.label = "path"}),
                              through(columns.topRows(2) + 0 * columns.topRows(2), {.label = "path"}),
                              through(lists, {.label = "path"}), through({{1, 2}, {3, 4}}, {.label = "path"}),
                              through(Vector2d(3, 4), through(Vector2d(1, 2), {.label = "path"}))}) {
    EXPECT_EQ(curve.label, "path");
    EXPECT_EQ(curve.x, (Numbers{1, 3}));
    EXPECT_EQ(curve.y, (Numbers{2, 4}));
    EXPECT_EQ(curve.style, SeriesStyle::kLine);
  }
  EXPECT_EQ(dots(poses).style, SeriesStyle::kPoints);
  EXPECT_EQ(dots(poses).marker, Marker::kDot);
  EXPECT_EQ(dots(poses, {.marker = Marker::kCross}).marker, Marker::kCross);
  EXPECT_EQ(within(columns).x, (Numbers{1, 3}));
  EXPECT_EQ(within(poses, {.label = "wall"}).label, "wall");
}

TEST(OverTime, HasAValueInEachStep) {
  using Numbers = std::vector<double>;
  const Series curve = overTime(Numbers{4, 5, 6}, 0.25, {.dashed = true});
  EXPECT_TRUE(curve.dashed);
  EXPECT_EQ(curve.x, (Numbers{0, 0.25, 0.5}));
  EXPECT_EQ(curve.y, (Numbers{4, 5, 6}));
  const Eigen::Matrix2d rows = (Eigen::Matrix2d() << 1, 2, 3, 4).finished();
  EXPECT_EQ(overTime(rows.row(1), 1).y, (Numbers{3, 4}));
  EXPECT_EQ(overTime(rows.col(1), 1).y, (Numbers{2, 4}));
}

TEST(PlaneFigure, HasMetresInOneScale) {
  const Figure figure = planeFigure({.title = "a room", .width = 900});
  EXPECT_EQ(figure.title, "a room");
  EXPECT_EQ(figure.width, 900);
  EXPECT_TRUE(figure.equalAxes);
  EXPECT_EQ(figure.xLabel, "x [m]");
  EXPECT_EQ(figure.yLabel, "y [m]");
}

}  // namespace rex::figure_builders_test
