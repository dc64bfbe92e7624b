// The figures of the gallery as SVG, which stay in the build folder to be looked at; as PNG gallery_test.cpp
// draws them. And a few small ones as they are to look.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gallery/figures.h"
#include "render/figure_builders.h"
#include "render/image.h"
#include "support/file_text.h"
#include "support/image_difference.h"
#include "support/needs_gnuplot.h"
#include "support/paths.h"

namespace rex::figure_gallery_test {

namespace fs = std::filesystem;

TEST(FigureGallery, DrawsEveryFigureAsSvg) {
  REX_NEEDS_GNUPLOT();
  const fs::path folder = ownFolder() / "tests-out" / "figures";
  fs::create_directories(folder);
  for (const auto& [name, figure] : galleryFigures()) {
    writeFigure(figure, folder / (name + ".svg"));
    const std::string svg = fileText(folder / (name + ".svg"));
    EXPECT_THAT(svg, testing::HasSubstr("width=\"" + std::to_string(figure.width) + '"')) << name;
    EXPECT_THAT(svg, testing::HasSubstr("id=\"gnuplot_plot_1\"")) << name;
    EXPECT_THAT(svg, testing::EndsWith("</svg>\n\n")) << name;
  }
}

// This sees a layer, a colour or a line that is missing or wrong. Where things lie, figure_drawing_test.cpp
// reads back.
void expectGolden(const std::string& name, Figure figure) {
  figure.width = 240, figure.height = 180;
  const fs::path golden = homeFolder() / "tests/golden/render" / (name + ".png");
  const fs::path drawn = ownFolder() / "tests-out" / "figures" / (name + "-actual.png");
  fs::create_directories(drawn.parent_path());
  writeFigure(figure, drawn);
  if (std::getenv("REX_UPDATE_GOLDEN") != nullptr) writeFigure(figure, golden);
  const ImageDifference apart = imageDifference(readPng(golden), readPng(drawn), 32);
  EXPECT_LE(apart.largeShare, figureTolerance().largeShare) << name << ": see " << drawn;
  EXPECT_LE(apart.mean, figureTolerance().mean) << name << ": see " << drawn;
}

TEST(FigureGallery, LooksAsStored) {
  REX_NEEDS_GNUPLOT();
  Figure heat{.xLabel = "x [m]", .yLabel = "y [m]", .colorLabel = "z [m]"};
  heat.heatMap = sampledHeatMap([](double x, double y) { return x * x - y; }, {-1, 1}, {-1, 1}, 20, 20);
  heat.heatMap->contours = 4;
  expectGolden("figure-heat", heat);
  Figure layers{.xLabel = "x [m]", .yLabel = "y [m]", .legend = Legend::kNone};
  layers.series = {{.x = {0, 2, 4}, .y = {0, 3, 2}, .style = SeriesStyle::kLinesPoints},
                   {.x = {0, 4}, .y = {2, 2}, .dashed = true}};
  layers.bands = {{.x = {0, 2, 4}, .low = {-1, 2, 1}, .high = {1, 4, 3}}};
  layers.ellipses = {{.mean = {3, 0}, .covariance = Eigen::Vector2d(0.3, 0.1).asDiagonal()}};
  layers.histograms = {{.edges = {0, 0.5, 1}, .heights = {3, 4}, .color = Color{0, 0.6f, 0.3f}}};
  expectGolden("figure-layers", layers);
  Figure poles = poleFigure({{0.5, 0.5}, {0.5, -0.5}}, {-0.5}, TimeDomain::kDiscrete);
  poles.legend = Legend::kNone;
  expectGolden("figure-poles", poles);
}

}  // namespace rex::figure_gallery_test
