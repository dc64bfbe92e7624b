// The figures of the gallery are drawn with all that they hold. They stay in the build folder, to be looked
// at.
#include <filesystem>
#include <set>

#include <gtest/gtest.h>

#include "gallery/figures.h"
#include "render/png.h"
#include "support/needs_gnuplot.h"

namespace rex {
namespace {

namespace fs = std::filesystem;

TEST(FigureGallery, DrawsEveryFigure) {
  REX_NEEDS_GNUPLOT();
  const fs::path folder = fs::path(REX_BINARY_DIR) / "tests-out" / "figures";
  fs::create_directories(folder);
  for (const auto& [name, figure] : galleryFigures()) {
    writeFigure(figure, folder / (name + ".png"));
    writeFigure(figure, folder / (name + ".svg"));
    const Image image = readPng(folder / (name + ".png"));
    EXPECT_EQ(image.width, figure.width) << name;
    EXPECT_EQ(image.height, figure.height) << name;
  }
}

}  // namespace
}  // namespace rex
