#include "planning/grid_map.h"

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "render/image.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::grid_map_test {

constexpr const char* kRows = "#..\n.#.\n";

void expectRows(const GridMap& map) {
  ASSERT_EQ(map.width(), 3);
  ASSERT_EQ(map.height(), 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x)
      EXPECT_EQ(map.isBlocked({x, y}), (x == 0 && y == 1) || (x == 1 && y == 0)) << x << " " << y;
  EXPECT_TRUE(map.isBlocked({-1, 0})) << "outside";
  EXPECT_TRUE(map.isBlocked({0, 2}));
}

class GridFile : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_.path() / name, std::ios::binary) << bytes;
    return folder_.path() / name;
  }
  TemporaryFolder folder_;
};

TEST_F(GridFile, ComesAsTextOrPicture) {
  expectRows(parseGridMap(kRows, "a.txt"));
  expectRows(parseGridMap("#..\r\n.#.\r\n\n", "a.txt"));
  expectRows(readGridMap(write("a.txt", kRows)));
  expectRows(readGridMap(write("a.pgm", "P2\n# a comment\n3 2\n10\n0 10 5\n9 4 10\n")));
  expectRows(readGridMap(write("b.pgm", std::string("P5 3 2 255\n\x10\xff\x80\xf0\x7f\xff", 17))));
  Image image(3, 2);
  for (std::uint8_t& byte : image.rgb) byte = 255;
  for (int i = 0; i < 3; ++i) image.pixel(0, 0)[i] = image.pixel(1, 1)[i] = 0;
  writePng(image, folder_.path() / "a.png");
  expectRows(readGridMap(folder_.path() / "a.png"));
}

TEST_F(GridFile, SaysWhatIsWrongAndWhere) {
  EXPECT_REX_ERROR(parseGridMap("#..\n.x.\n", "m.txt"),
                   "m.txt:2:2: grid map: found 'x', wanted '#' for blocked");
  EXPECT_REX_ERROR(parseGridMap("#..\n..\n", "m.txt"),
                   "m.txt:2:3: grid map: found a row of 2 cells, wanted 3");
  EXPECT_REX_ERROR(parseGridMap("\n", "m.txt"), "m.txt:1:1: grid map: found no rows");
  EXPECT_REX_ERROR(parseGridMap("\n#", "m.txt"), "m.txt:1:1: grid map: found a row of 0 cells, wanted 1");
  EXPECT_REX_ERROR(readGridMap(folder_.path()), "grid map: found a file that cannot be read");
  EXPECT_REX_ERROR(readGridMap(folder_.path() / "none.txt"),
                   "none.txt: grid map: found a file that cannot be read");
  EXPECT_REX_ERROR(readGridMap(write("a.pgm", "P6 1 1 255 ")), "a.pgm: grid map: found another format");
  EXPECT_REX_ERROR(readGridMap(write("a.pgm", "P2 3 2 10 0 10 5 9 4")),
                   "found the end of the file, wanted a grey");
  EXPECT_REX_ERROR(readGridMap(write("a.pgm", "P2 3 2 10 0 11")), "found 11, wanted a grey from 0 to 10");
  EXPECT_REX_ERROR(readGridMap(write("a.pgm", "P2 x")), "found no number, wanted a width");
  EXPECT_REX_ERROR(readGridMap(write("a.pgm", "P5 9999999 1 255 ")), "wanted a width from 1 to 1048576");
  EXPECT_REX_ERROR(readGridMap(write("a.pgm", "P5 2 2 255 a")),
                   "found the end of the file, wanted more pixels");
  EXPECT_REX_ERROR(readGridMap(write("a.pgm", "P5 2 2 300 a")), "found two bytes for each pixel, wanted one");
  EXPECT_REX_ERROR(GridMap(0, 3), "grid map: found 0 x 3 cells, wanted at least 1 x 1");
  EXPECT_REX_ERROR(GridMap(100000, 100000), "found 100000 x 100000 cells");
  EXPECT_REX_ERROR(GridMap(2, 2, 1, {0, NAN}), "origin of a grid map: number 1: found nan");
  EXPECT_REX_ERROR(GridMap(2, 2, 0),
                   "size of the cells of a grid map: found 0 m, wanted a positive, finite number of metres");
}

TEST(GridMap, KnowsWhereItsCellsAre) {
  const GridMap map(4, 3, .5, {1, -1});
  EXPECT_EQ(map.center({0, 0}), Eigen::Vector2d(1.25, -.75));
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x) EXPECT_EQ(map.cellAt(map.center({x, y})), (GridCell{x, y}));
  EXPECT_FALSE(map.contains(map.cellAt({.9, 0})));
  EXPECT_FALSE(map.contains(map.cellAt({1e30, 0})));
  EXPECT_FALSE(map.contains(map.cellAt({NAN, 0})));
}

}  // namespace rex::grid_map_test
