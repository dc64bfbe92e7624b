// What a figure refuses, layer by layer, each with the figure and the layer in the message.
#include <array>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/figure.h"
#include "support/expect_error.h"
#include "support/fresh_folder.h"
#include "support/needs_gnuplot.h"

namespace rex::figure_errors_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Figure plain() { return {.title = "F", .xLabel = "x [m]", .yLabel = "y [m]"}; }

void draw(const Figure& figure) { writeFigure(figure, freshFolderOfTest("figure-errors") / "a.png"); }

TEST(FigureErrors, EveryAxisNeedsALabel) {
  Figure figure = plain();
  figure.series = {{.y = {1, 2}}};
  figure.xLabel.clear();
  EXPECT_REX_ERROR(draw(figure),
                   R"(figure 'F': found no xLabel, wanted one, with the unit, such as "distance [m]")");
  figure.xLabel = " \n";
  EXPECT_REX_ERROR(draw(figure), "found no xLabel");
  figure.xLabel = "step", figure.yLabel.clear();
  EXPECT_REX_ERROR(draw(figure), "found no yLabel");
  figure.yLabel = "y", figure.series[0].values = {1, 2};
  EXPECT_REX_ERROR(draw(figure), "found no colorLabel");
  figure.series[0].values.clear(), figure.series[0].z = {1, 2};
  EXPECT_REX_ERROR(draw(figure), "found no zLabel");
}

TEST(FigureErrors, Series) {
  Figure figure = plain();
  figure.zLabel = figure.colorLabel = "z [m]";
  figure.series = {{.y = {1, 2}, .values = {1}}};
  EXPECT_REX_ERROR(draw(figure), "figure 'F', series 0: found 1 values and 2 y, wanted as many values as y");
  figure.series[0].values = {1, kNan};
  EXPECT_REX_ERROR(draw(figure), "series 0: found values[1] = nan, wanted finite numbers");
  figure.series[0].values = {1, 0}, figure.logColor = true;
  EXPECT_REX_ERROR(draw(figure), "series 0: found values[1] = 0, wanted finite numbers above 0");
  figure = plain(), figure.zLabel = "z [m]";
  figure.series = {{.y = {1, 2}, .z = {1, kInfinity}}};
  EXPECT_REX_ERROR(draw(figure), "series 0: found z[1] = inf");
  figure.series[0].z = {1};
  EXPECT_REX_ERROR(draw(figure), "series 0: found 1 z and 2 y");
  figure.series = {{.y = {1, 2}, .z = {1, 2}}, {.label = "flat", .y = {1, 2}}};
  EXPECT_REX_ERROR(draw(figure), "series 'flat': found 0 z and 2 y, wanted as many z as y");
  figure = plain();
  figure.series = {{.y = {1, 2e300}}};
  EXPECT_REX_ERROR(draw(figure), "found y[1] = 2e+300, wanted finite numbers, up to 1e300");
  figure.series = {{.y = {1, 1e-310}}}, figure.logY = true;
  EXPECT_REX_ERROR(draw(figure), "found y[1] = 1e-310, wanted finite numbers above 0");
  figure.logY = false;
  for (const double size : {0., -1., 21., kNan}) {
    figure.series = {{.y = {1}, .size = size}};
    EXPECT_REX_ERROR(draw(figure), "wanted 0 < size <= 20");
  }
}

TEST(FigureErrors, Bands) {
  Figure figure = plain();
  figure.bands = {{.label = "error", .x = {0, 1}, .low = {1, 2}, .high = {2}}};
  EXPECT_REX_ERROR(draw(figure),
                   "figure 'F', band 'error': found 1 high and 2 low, wanted as many high as low");
  figure.bands[0].high = {2, 1};
  EXPECT_REX_ERROR(draw(figure), "band 'error': found low[1] = 2, high[1] = 1, wanted low <= high");
  figure.bands[0].high = {2, kNan};
  EXPECT_REX_ERROR(draw(figure), "found high[1] = nan");
  figure.bands[0].low = {2, kNan};
  EXPECT_REX_ERROR(draw(figure), "found low[1] = nan");
  figure.bands[0].x = {1};
  EXPECT_REX_ERROR(draw(figure), "found 1 x and 2 low, wanted as many x as low");
  figure.bands = {{.low = {0}, .high = {1}}};
  EXPECT_REX_ERROR(draw(figure), "band 0: found one point, wanted at least two");
  figure.bands = {{}};
  EXPECT_REX_ERROR(draw(figure), "band 0: found no points");
  figure.bands = {{.low = {0, 1}, .high = {1, 2}}}, figure.logY = true;
  EXPECT_REX_ERROR(draw(figure), "found low[0] = 0, wanted finite numbers above 0");
}

TEST(FigureErrors, Histograms) {
  Figure figure = plain();
  figure.histograms = {{.edges = {0, 1}, .heights = {1, 2}}};
  EXPECT_REX_ERROR(draw(figure),
                   "histogram 0: found 2 edges and 2 heights, wanted one more edge than heights");
  figure.histograms[0].edges = {0, 1, 1};
  EXPECT_REX_ERROR(draw(figure), "histogram 0: found edges[2] = 1 after 1, wanted ascending edges");
  figure.histograms[0].edges = {0, 1, kNan};
  EXPECT_REX_ERROR(draw(figure), "found edges[2] = nan");
  figure.histograms[0] = {.heights = {kNan}};
  EXPECT_REX_ERROR(draw(figure), "found heights[0] = nan");
  figure.histograms[0] = {};
  EXPECT_REX_ERROR(draw(figure), "histogram 0: found no points");
  figure.histograms[0] = {.heights = {1}}, figure.logY = true;
  EXPECT_REX_ERROR(draw(figure), "histogram 0: found a logarithmic axis, wanted linear axes for this layer");
}

TEST(FigureErrors, Ellipses) {
  Figure figure = plain();
  Eigen::Matrix2d P;
  for (const auto& [a, b, c, d] : {std::array{1., 2., 2., 1.},
                                   {-1., 0., 0., -1.},
                                   {1., 0., 0., 0.},
                                   {1., 0.5, 0.2, 1.},
                                   {kNan, 0., 0., 1.},
                                   {1., kInfinity, kInfinity, 1.},
                                   {1., kNan, kNan, 1.}}) {
    P << a, b, c, d;
    figure.ellipses = {{.label = "L3", .covariance = P}};
    EXPECT_REX_ERROR(draw(figure), "wanted a symmetric and positive definite one");
  }
  P << 1, 2, 2, 1;
  figure.ellipses[0].covariance = P;
  EXPECT_REX_ERROR(draw(figure), "figure 'F', ellipse 'L3': found the covariance [1 2; 2 1], wanted");
  figure.ellipses = {{.mean = {0, kNan}}};
  EXPECT_REX_ERROR(draw(figure), "ellipse 0: found mean[1] = nan");
  figure.ellipses = {{.sigmas = 0}};
  EXPECT_REX_ERROR(draw(figure), "ellipse 0: found sigmas = 0, wanted 0 < sigmas <= 100");
  figure.ellipses = {{}}, figure.logX = true;
  EXPECT_REX_ERROR(draw(figure), "ellipse 0: found a logarithmic axis");
}

TEST(FigureErrors, RegionsAndArrows) {
  Figure figure = plain();
  figure.regions = {{.x = {0, 1}, .y = {0, 1}}};
  EXPECT_REX_ERROR(draw(figure), "region 0: found 2 corners, wanted at least 3");
  figure.regions[0].y = {0, 1, 2};
  EXPECT_REX_ERROR(draw(figure), "region 0: found 2 x and 3 y");
  figure.regions[0].x = {0, 1, kNan};
  EXPECT_REX_ERROR(draw(figure), "region 0: found x[2] = nan");
  figure.regions[0] = {.x = {0, 1, 2}, .y = {kNan, 1, 2}};
  EXPECT_REX_ERROR(draw(figure), "region 0: found y[0] = nan");
  figure = plain();
  figure.arrows = {{.label = "field", .x = {0, 1}, .y = {0, 1}, .dx = {0, 1}, .dy = {1}}};
  EXPECT_REX_ERROR(draw(figure), "arrows 'field': found 1 dy and 2 x, wanted as many dy as x");
  figure.arrows[0].dy = {1, kNan};
  EXPECT_REX_ERROR(draw(figure), "arrows 'field': found dy[1] = nan");
  figure.arrows[0].x = {1, kNan};
  EXPECT_REX_ERROR(draw(figure), "arrows 'field': found x[1] = nan");
  figure.logX = true;
  EXPECT_REX_ERROR(draw(figure), "arrows 'field': found a logarithmic axis");
  figure = plain();
  figure.arrows = {{}};
  EXPECT_REX_ERROR(draw(figure), "arrows 0: found no points");
}

TEST(FigureErrors, HeatMaps) {
  Figure figure = plain();
  figure.colorLabel = "cost [1]";
  figure.heatMap = HeatMap{.values = Eigen::MatrixXd::Ones(1, 5)};
  EXPECT_REX_ERROR(draw(figure), "figure 'F', heat map: found 1 x 5 cells, wanted at least 2 x 2");
  figure.heatMap->values = Eigen::MatrixXd::Ones(3, 4);
  figure.heatMap->values(2, 1) = kNan;
  EXPECT_REX_ERROR(draw(figure), "heat map: found values(2, 1) = nan");
  figure.heatMap->values(2, 1) = 0, figure.logColor = true;
  EXPECT_REX_ERROR(draw(figure), "heat map: found values(2, 1) = 0, wanted finite numbers above 0");
  figure.heatMap->contours = 101;
  EXPECT_REX_ERROR(draw(figure), "heat map: found 101 contours, wanted 0 to 100");
  figure.heatMap->yRange = {2, 1};
  EXPECT_REX_ERROR(draw(figure), "heat map, yRange: found 2 to 1, wanted low < high");
  figure.heatMap->xRange = {0, kNan};
  EXPECT_REX_ERROR(draw(figure), "heat map, xRange: found 0 to nan");
  figure.logX = true;
  EXPECT_REX_ERROR(draw(figure), "heat map: found a logarithmic axis");
  figure = plain();
  figure.colorLabel = "cost [1]";
  figure.heatMap = HeatMap{.values = Eigen::MatrixXd::Ones(3, 4)};
  figure.colorRange = {1, 0};
  EXPECT_REX_ERROR(draw(figure), "figure 'F', range of colours: found 1 to 0, wanted low < high");
}

TEST(FigureErrors, Maps) {
  Figure figure = plain();
  figure.map = OccupancyCells{.occupancy = Eigen::MatrixXd::Constant(3, 3, 0.5)};
  figure.map->occupancy(1, 2) = 1.5;
  EXPECT_REX_ERROR(draw(figure),
                   "figure 'F', map: found occupancy(1, 2) = 1.5, wanted 0 (free) to 1 (occupied)");
  figure.map->occupancy(1, 2) = kNan;
  EXPECT_REX_ERROR(draw(figure), "map: found occupancy(1, 2) = nan");
  figure.map->occupancy.resize(0, 0);
  EXPECT_REX_ERROR(draw(figure), "map: found 0 x 0 cells");
  figure.map->xRange = {1, 1};
  EXPECT_REX_ERROR(draw(figure), "map, xRange: found 1 to 1");
}

TEST(FigureErrors, GuidesAndNotes) {
  Figure figure = plain();
  figure.verticalLines = {{.at = 1}};
  EXPECT_REX_ERROR(draw(figure), "figure 'F': found nothing to draw");
  figure.series = {{.x = {1, 2}, .y = {1, 2}}};
  figure.logX = true;
  figure.verticalLines = {{.at = 0, .label = "now"}};
  EXPECT_REX_ERROR(draw(figure), "vertical line 'now': found at = 0, wanted finite numbers above 0");
  figure.verticalLines.clear();
  figure.horizontalLines = {{.at = kNan}};
  EXPECT_REX_ERROR(draw(figure), "horizontal line 0: found at = nan");
  figure.horizontalLines.clear();
  figure.notes = {{.text = "here", .x = 0}};
  EXPECT_REX_ERROR(draw(figure), "note 'here': found x = 0, wanted finite numbers above 0");
  figure.notes = {{.text = "here", .x = 1, .y = kNan}};
  EXPECT_REX_ERROR(draw(figure), "note 'here': found y = nan");
  figure.notes = {{.text = "here", .x = 1, .z = kNan}};
  EXPECT_REX_ERROR(draw(figure), "note 'here': found z = nan");
}

TEST(FigureErrors, NoFlatLayerInSpace) {
  Figure figure = plain();
  figure.zLabel = "z [m]";
  figure.series = {{.y = {1, 2}, .z = {1, 2}}};
  figure.bands = {{.low = {0}, .high = {1}}};
  EXPECT_REX_ERROR(draw(figure),
                   "figure 'F': found series with z and a layer without, wanted only series and notes");
}

TEST(FigureErrors, RangesThatMissALayer) {
  REX_NEEDS_GNUPLOT();
  Figure figure = plain();
  figure.ellipses = {{.mean = {0, 0}}};  // radius 2
  figure.xRange = {3, 4}, figure.yRange = {-1, 1};
  EXPECT_REX_ERROR(draw(figure), "found no data within x 3 to 4, y -1 to 1");
  figure.xRange = {1.8, 3}, figure.yRange = {1.8, 3};  // the corner of its box
  EXPECT_REX_ERROR(draw(figure), "found no data within");
  figure.xRange = {-0.5, 0.5}, figure.yRange = {-0.5, 0.5};  // all inside
  EXPECT_NO_THROW(draw(figure));
  figure.yRange.reset();
  EXPECT_NO_THROW(draw(figure));
  figure = plain();
  figure.map = OccupancyCells{.occupancy = Eigen::MatrixXd::Zero(3, 3)};
  figure.xRange = {2, 3};
  EXPECT_REX_ERROR(draw(figure), "found no data within x 2 to 3");
  figure.xRange = {0.4, 0.6};
  EXPECT_NO_THROW(draw(figure));
  figure = plain();
  figure.arrows = {{.x = {0}, .y = {0}, .dx = {1}, .dy = {1}}};
  figure.xRange = {2, 3};
  EXPECT_REX_ERROR(draw(figure), "found no data within x 2 to 3");
}

}  // namespace rex::figure_errors_test
