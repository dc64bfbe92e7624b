#include "planning/bug.h"

#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::bug_test {

using Bug = BugWay (*)(const GridMap&, GridCell, GridCell);

GridMap randomMap(Rng& rng, int width, int height, double share) {
  GridMap map(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) map.setBlocked({x, y}, rng.uniform() < share);
  return map;
}

GridCell randomCell(Rng& rng, GridMap& map) {
  const GridCell cell{rng.index(map.width()), rng.index(map.height())};
  map.setBlocked(cell, false);
  return cell;
}

void expectWay(const GridMap& map, const BugWay& way, GridCell start) {
  ASSERT_EQ(way.cells.front(), start);
  for (std::size_t k = 0; k < way.cells.size(); ++k) {
    ASSERT_FALSE(map.isBlocked(way.cells[k]));
    if (k == 0) continue;
    const GridCell a = way.cells[k - 1], b = way.cells[k];
    ASSERT_EQ(std::abs(a.x - b.x) + std::abs(a.y - b.y), 1);
  }
}

// The second opinion: the wavefront knows whether there is a way.
TEST(Bug, ReachesWhatCanBeReachedAndSaysWhatCannot) {
  Rng rng(1);
  int reached = 0, cutOff = 0;
  for (int i = 0; i < 3000; ++i) {
    GridMap map = randomMap(rng, 4 + rng.index(25), 4 + rng.index(20), rng.uniform(.05, .45));
    const GridCell start = randomCell(rng, map), goal = randomCell(rng, map);
    const bool isReachable = wavefront(map, goal, Connectivity::kFour)[map.index(start)] >= 2;
    for (const Bug bug : {&bug1, &bug2}) {
      const BugWay way = bug(map, start, goal);
      expectWay(map, way, start);
      ASSERT_EQ(way.status == BugStatus::kReached, isReachable) << i;
      if (isReachable) {
        EXPECT_EQ(way.cells.back(), goal);
        EXPECT_EQ(way.hits.size(), way.leaves.size());
      }
    }
    (isReachable ? reached : cutOff) += 1;
  }
  EXPECT_GT(reached, 500);
  EXPECT_GT(cutOff, 500);
}

// A box in the way: its outline, walked on the cells around it, bounds both ways (slide 4:11).
TEST(Bug, GoesNoFartherThanItsBound) {
  GridMap map(40, 30);
  for (int y = 8; y <= 20; ++y)
    for (int x = 15; x <= 22; ++x) map.setBlocked({x, y});
  const GridCell start{2, 12}, goal{37, 16};
  const int outline = 2 * (8 + 13) + 4, distance = 35 + 4;
  const BugWay one = bug1(map, start, goal), two = bug2(map, start, goal);
  ASSERT_EQ(one.hits.size(), 1u);
  ASSERT_EQ(two.hits.size(), 1u);
  EXPECT_GT(static_cast<int>(one.cells.size()), distance + outline) << "once around";
  EXPECT_LE(static_cast<int>(one.cells.size()) - 1, distance + 3 * outline / 2 + 2);
  EXPECT_LE(static_cast<int>(two.cells.size()) - 1, distance + outline);
  EXPECT_LT(two.cells.size(), one.cells.size());
}

TEST(Bug, GoesStraightWhereNothingIsInTheWay) {
  const GridMap map(30, 20);
  for (const Bug bug : {&bug1, &bug2}) {
    const BugWay way = bug(map, {25, 3}, {4, 15});
    EXPECT_EQ(way.status, BugStatus::kReached);
    EXPECT_EQ(way.cells.size(), 21u + 12u + 1u);
    EXPECT_TRUE(way.hits.empty());
    EXPECT_EQ(bug(map, {1, 1}, {1, 1}).cells.size(), 1u);
  }
}

TEST(Bug2, KeepsToTheLine) {
  for (const GridCell cell : bug2(GridMap(30, 20), {25, 3}, {4, 15}).cells) {
    const double across = ((cell.x - 25) * 12 + (cell.y - 3) * 21) / std::hypot(12, 21);
    EXPECT_LE(std::abs(across), 1) << cell.x << " " << cell.y;
  }
}

TEST(Bug, SaysThatAClosedRoomIsClosed) {
  GridMap map(11, 11);
  for (int i = 3; i <= 7; ++i)
    for (const GridCell cell : {GridCell{i, 3}, {i, 7}, {3, i}, {7, i}}) map.setBlocked(cell);
  for (const Bug bug : {&bug1, &bug2}) {
    EXPECT_EQ(bug(map, {0, 0}, {5, 5}).status, BugStatus::kUnreachable);
    EXPECT_EQ(bug(map, {5, 5}, {0, 0}).status, BugStatus::kUnreachable);
  }
  GridMap cell(3, 1);
  cell.setBlocked({1, 0});
  EXPECT_EQ(bug1(cell, {0, 0}, {2, 0}).status, BugStatus::kUnreachable);
  EXPECT_EQ(bug2(cell, {0, 0}, {2, 0}).status, BugStatus::kUnreachable);
  EXPECT_REX_ERROR(static_cast<void>(bug1(cell, {1, 0}, {2, 0})), "start: found cell (1, 0), blocked");
  EXPECT_REX_ERROR(static_cast<void>(bug2(cell, {0, 0}, {5, 0})), "goal: found cell (5, 0), outside");
}

}  // namespace rex::bug_test
