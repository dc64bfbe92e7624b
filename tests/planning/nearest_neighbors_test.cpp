// Answers of the tree against a look at all points.
#include "planning/nearest_neighbors.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::nearest_neighbors_test {

using Kind = SpacePart::Kind;

Space mixedSpace() {
  return Space({{.lower = -2, .upper = 2},
                {.kind = Kind::kCircle, .weight = .7},
                {.kind = Kind::kQuaternion, .weight = 1.3},
                {.kind = Kind::kChord, .weight = 2},
                {.lower = 0, .upper = 1, .weight = 3}});
}

std::vector<Space> spaces() {
  return {Space::box(Eigen::VectorXd::Constant(7, -1), Eigen::VectorXd::Constant(7, 1)),
          Space::box(Eigen::VectorXd::Constant(1, -1), Eigen::VectorXd::Constant(1, 1)),
          Space::se2({-1, -1}, {1, 1}, .3), Space::se3({-1, -1, -1}, {1, 1, 1}), mixedSpace()};
}

Eigen::VectorXd sampled(const Space& space, Rng& rng) {
  Eigen::VectorXd q(space.size());
  space.sample(rng, q);
  return q;
}

// All points, nearest first, by the metric of the space.
std::vector<std::pair<double, int>> byDistance(const Space& space, const std::vector<Eigen::VectorXd>& points,
                                               const Eigen::VectorXd& q) {
  std::vector<std::pair<double, int>> all;
  for (std::size_t i = 0; i < points.size(); ++i)
    all.emplace_back(space.distance(q, points[i]), static_cast<int>(i));
  std::sort(all.begin(), all.end());
  return all;
}

TEST(NearestNeighbors, AgreeWithALookAtAllPoints) {
  Rng rng(1);
  for (const Space& space : spaces()) {
    NearestNeighbors tree(space);
    std::vector<Eigen::VectorXd> points;
    for (int i = 0; i < 3000; ++i) {
      points.push_back(sampled(space, rng));
      ASSERT_EQ(tree.add(points.back()), i);
      if (i % 97 != 0) continue;
      const Eigen::VectorXd q = sampled(space, rng);
      const auto all = byDistance(space, points, q);
      EXPECT_EQ(tree.nearest(q), all[0].second);
      const std::vector<int> ten = tree.nearest(q, 10);
      ASSERT_EQ(ten.size(), std::min<std::size_t>(10, all.size()));
      for (std::size_t k = 0; k < ten.size(); ++k) EXPECT_EQ(ten[k], all[k].second);
      const double radius = rng.uniform(0, 1.5);
      const std::vector<int> near = tree.within(q, radius);
      std::size_t inside = 0;
      while (inside < all.size() && all[inside].first <= radius) ++inside;
      ASSERT_EQ(near.size(), inside);
      for (std::size_t k = 0; k < inside; ++k) EXPECT_EQ(near[k], all[k].second);
      std::vector<Neighbor> unsorted;
      tree.within(q, radius, unsorted);
      std::sort(unsorted.begin(), unsorted.end());
      ASSERT_EQ(unsorted.size(), inside);
      for (std::size_t k = 0; k < inside; ++k) EXPECT_NEAR(unsorted[k].distance, all[k].first, 1e-12);
    }
    EXPECT_EQ(tree.count(), 3000);
    EXPECT_EQ(tree.point(1234), points[1234]);
    EXPECT_EQ(tree.nearest(points[77]), 77);
  }
}

// Angles near -pi and pi are near each other, and q and -q are one rotation.
TEST(NearestNeighbors, KnowThatAnglesAndRotationsCloseUp) {
  const Space space = Space::se2({-1, -1}, {1, 1});
  NearestNeighbors tree(space);
  Rng rng(2);
  for (int i = 0; i < 500; ++i) tree.add(Eigen::Vector3d(0, 0, rng.uniform(-2.5, 2.5)));
  const int beyond = tree.add(Eigen::Vector3d(0, 0, 3.1));
  EXPECT_EQ(tree.nearest(Eigen::Vector3d(0, 0, -3.1)), beyond);
  EXPECT_EQ(tree.nearest(Eigen::Vector3d(0, 0, -3.1 + 20 * M_PI)), beyond);
}

TEST(NearestNeighbors, TakeThousandsOfEqualPoints) {
  NearestNeighbors tree(Space::box(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)));
  for (int i = 0; i < 5000; ++i) tree.add(Eigen::Vector2d(.5, .5));
  const int other = tree.add(Eigen::Vector2d(.5, .6));
  EXPECT_EQ(tree.nearest(Eigen::Vector2d(.5, .5)), 0) << "of equals, the first";
  EXPECT_EQ(tree.nearest(Eigen::Vector2d(.5, .7)), other);
  EXPECT_EQ(tree.within(Eigen::Vector2d(.5, .5), 0).size(), 5000u);
}

TEST(NearestNeighbors, RefuseWhatIsNoPoint) {
  NearestNeighbors tree(Space::box(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)));
  EXPECT_REX_ERROR(static_cast<void>(tree.nearest(Eigen::Vector2d(0, 0))),
                   "nearest neighbour: found no points, wanted at least one");
  EXPECT_TRUE(tree.nearest(Eigen::Vector2d(0, 0), 3).empty());
  tree.add(Eigen::Vector2d(0, 0));
  EXPECT_REX_ERROR(static_cast<void>(tree.within(Eigen::Vector2d(0, 0), NAN)),
                   "radius around a configuration: found nan, wanted a number, 0 or more, or infinity");
  EXPECT_REX_ERROR(static_cast<void>(tree.within(Eigen::Vector2d(0, 0), -1)), "found -1");
  EXPECT_REX_ERROR(static_cast<void>(tree.within(Eigen::Vector2d(INFINITY, 0), 1)), "number 0: found inf");
  EXPECT_EQ(tree.within(Eigen::Vector2d(9, 9), INFINITY), std::vector<int>{0});
  EXPECT_TRUE(tree.nearest(Eigen::Vector2d(0, 0), -3).empty());
  EXPECT_REX_ERROR(tree.add(Eigen::Vector3d(0, 0, 0)),
                   "configuration: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(tree.add(Eigen::Vector2d(0, NAN)),
                   "configuration: number 1: found nan, wanted a finite number");
}

}  // namespace rex::nearest_neighbors_test
