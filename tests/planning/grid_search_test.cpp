#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "planning/grid_map.h"
#include "support/expect_error.h"

namespace rex::grid_search_test {

GridMap randomMap(Rng& rng, int width, int height, double share) {
  GridMap map(width, height, .5);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) map.setBlocked({x, y}, rng.uniform() < share);
  map.setBlocked({0, 0}, false);
  map.setBlocked({width - 1, height - 1}, false);
  return map;
}

// The second opinion: relaxing every pair of neighbours until nothing changes.
std::vector<double> byRelaxing(const GridMap& map, GridCell from, Connectivity connectivity) {
  std::vector<double> distance(map.count(), INFINITY);
  distance[map.index(from)] = 0;
  for (bool isChanged = true; isChanged;) {
    isChanged = false;
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        for (int k = 0; k < 9; ++k) {
          const GridCell a{x, y}, b{x + k % 3 - 1, y + k / 3 - 1};
          const int steps = std::abs(a.x - b.x) + std::abs(a.y - b.y);
          if (steps == 0 || map.isBlocked(a) || map.isBlocked(b)) continue;
          if (steps == 2 && connectivity == Connectivity::kFour) continue;
          const bool isTight = map.isBlocked({a.x, b.y}) || map.isBlocked({b.x, a.y});
          if (steps == 2 && connectivity == Connectivity::kEightWithRoom && isTight) continue;
          const double next = distance[map.index(a)] + map.cellSize() * std::sqrt(steps);
          if (next >= distance[map.index(b)] - 1e-12) continue;
          distance[map.index(b)] = next;
          isChanged = true;
        }
      }
    }
  }
  return distance;
}

constexpr Connectivity kAll[] = {Connectivity::kFour, Connectivity::kEight, Connectivity::kEightWithRoom};

TEST(Wavefront, IsThatOfTheSlides) {
  GridMap map(16, 8);
  for (int x = 4; x <= 11; ++x)
    for (const int y : {3, 4}) map.setBlocked({x, y});
  const std::vector<int> numbers = wavefront(map, {15, 0}, Connectivity::kEight);
  const std::vector<std::pair<int, std::vector<int>>> rows = {
      {7, {18, 17, 16, 15, 14, 13, 12, 11, 10, 9, 9, 9, 9, 9, 9, 9}},
      {6, {17, 17, 16, 15, 14, 13, 12, 11, 10, 9, 8, 8, 8, 8, 8, 8}},
      {5, {17, 16, 16, 15, 14, 13, 12, 11, 10, 9, 8, 7, 7, 7, 7, 7}},
      {4, {17, 16, 15, 15, 1, 1, 1, 1, 1, 1, 1, 1}},
      {3, {17, 16, 15, 14, 1, 1, 1, 1, 1, 1, 1, 1}},
      {2, {17, 16, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 4, 4}},
      {1, {17, 16, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 3}},
      {0, {17, 16, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2}}};
  for (const auto& [y, row] : rows)
    for (std::size_t x = 0; x < row.size(); ++x)
      EXPECT_EQ(numbers[map.index({static_cast<int>(x), y})], row[x]) << x << " " << y;
}

TEST(Wavefront, CountsStepsAndLeavesOutWhatIsCutOff) {
  Rng rng(1);
  for (int i = 0; i < 30; ++i) {
    const GridMap map = randomMap(rng, 20, 15, .35);
    const std::vector<int> numbers = wavefront(map, {0, 0}, Connectivity::kFour);
    const std::vector<double> distances = byRelaxing(map, {0, 0}, Connectivity::kFour);
    for (std::size_t k = 0; k < map.count(); ++k) {
      if (numbers[k] >= 2)
        EXPECT_NEAR((numbers[k] - 2) * map.cellSize(), distances[k], 1e-9);
      else
        EXPECT_TRUE(std::isinf(distances[k]));
    }
  }
}

TEST(GridSearch, FindsTheShortestWays) {
  Rng rng(2);
  int found = 0, cutOff = 0;
  for (int i = 0; i < 60; ++i) {
    const GridMap map = randomMap(rng, 25, 18, .3);
    const GridCell start{0, 0}, goal{24, 17};
    for (const Connectivity connectivity : kAll) {
      const std::vector<double> wanted = byRelaxing(map, start, connectivity);
      const std::vector<double> got = gridDistances(map, start, connectivity);
      for (std::size_t k = 0; k < map.count(); ++k) {
        if (std::isinf(wanted[k]))
          EXPECT_TRUE(std::isinf(got[k]));
        else
          EXPECT_NEAR(got[k], wanted[k], 1e-9);
      }
      const GridPath path = findGridPath(map, start, goal, connectivity);
      if (std::isinf(wanted[map.index(goal)])) {
        ++cutOff;
        EXPECT_TRUE(path.cells.empty() && std::isinf(path.length));
        continue;
      }
      ++found;
      EXPECT_NEAR(path.length, wanted[map.index(goal)], 1e-9);
      ASSERT_EQ(path.cells.front(), start);
      ASSERT_EQ(path.cells.back(), goal);
      double length = 0;
      for (std::size_t k = 1; k < path.cells.size(); ++k) {
        const GridCell a = path.cells[k - 1], b = path.cells[k];
        ASSERT_LE(std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)), 1);
        ASSERT_FALSE(map.isBlocked(b));
        length += map.cellSize() * std::hypot(a.x - b.x, a.y - b.y);
      }
      EXPECT_NEAR(length, path.length, 1e-9);
    }
  }
  EXPECT_GT(found, 30);
  EXPECT_GT(cutOff, 5);
}

TEST(GridSearch, LooksAtLessWithAnEstimate) {
  const GridMap map(100, 100);
  const GridPath path = findGridPath(map, {10, 50}, {90, 50}, Connectivity::kEight);
  EXPECT_EQ(path.cells.size(), 81u);
  EXPECT_LT(path.expanded, 200);
}

TEST(GridSearch, RefusesCellsThatAreNotFree) {
  GridMap map(4, 3);
  map.setBlocked({1, 1});
  EXPECT_REX_ERROR(static_cast<void>(findGridPath(map, {1, 1}, {0, 0}, Connectivity::kFour)),
                   "start: found cell (1, 1), blocked, wanted a free cell of 4 x 3");
  EXPECT_REX_ERROR(static_cast<void>(wavefront(map, {4, 0}, Connectivity::kFour)),
                   "goal: found cell (4, 0), outside");
  EXPECT_REX_ERROR(static_cast<void>(gridDistances(map, {0, -1}, Connectivity::kFour)),
                   "start: found cell (0, -1)");
}

}  // namespace rex::grid_search_test
