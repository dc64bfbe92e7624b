#include "planning/grid_map.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/expect_error.h"

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

TEST(GridMap, IsParsed) {
  expectRows(parseGridMap(kRows, "a.txt"));
  expectRows(parseGridMap("#..\r\n.#.\r\n\n", "a.txt"));
}

TEST(GridMap, SaysWhatIsWrongAndWhere) {
  EXPECT_REX_ERROR(parseGridMap("#..\n.x.\n", "m.txt"),
                   "m.txt:2:2: grid map: found 'x', wanted '#' for blocked");
  EXPECT_REX_ERROR(parseGridMap("#..\n..\n", "m.txt"),
                   "m.txt:2:3: grid map: found a row of 2 cells, wanted 3");
  EXPECT_REX_ERROR(parseGridMap("\n", "m.txt"), "m.txt:1:1: grid map: found no rows");
  EXPECT_REX_ERROR(parseGridMap("\n#", "m.txt"), "m.txt:1:1: grid map: found a row of 0 cells, wanted 1");
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
