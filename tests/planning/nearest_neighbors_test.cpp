// Answers of the tree against a look at all points.
#include "planning/nearest_neighbors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/cpu_lanes.h"
#include "base/rng.h"
#include "planning/neighbor_kernel_internal.h"
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

// Sorted points, and clusters that are nearer than single precision tells, far from the origin.
TEST(NearestNeighbors, AgreeForPointsThatComeInOrderOrAreHardToTell) {
  Rng rng(3);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(4);
  for (const double spread : {1., 1e-9, 1e30, 1e200}) {
    const Space space = Space::box(-ones, ones);
    NearestNeighbors tree(space);
    std::vector<Eigen::VectorXd> points;
    for (int i = 0; i < 2000; ++i) {
      Eigen::VectorXd q(4);
      for (double& number : q)
        number = spread * (std::floor(rng.uniform(0, 3)) + 1e-3 * i) + (spread < 1 ? 1 : 0);
      points.push_back(q);
      tree.add(q);
    }
    for (int k = 0; k < 100; ++k) {
      const Eigen::VectorXd q =
          points[static_cast<std::size_t>(rng.uniform(0, 2000))] * (k % 2 == 0 ? 1 : 1 + 1e-12);
      double least = std::numeric_limits<double>::infinity();
      int nearest = 0;
      for (int i = 0; i < 2000; ++i) {
        const double squared = (points[static_cast<std::size_t>(i)] - q).squaredNorm();
        if (squared < least) nearest = i;
        least = std::min(least, squared);
      }
      EXPECT_EQ(tree.nearest(q), nearest) << spread;
      EXPECT_EQ(tree.nearest(q, 3).front(), nearest) << spread;
    }
  }
}

// All numbers of lanes give the bits of plain single precision.
TEST(NeighborKernel, GivesTheSameBitsInAllLanes) {
  const NeighborPart parts[] = {{},
                                {NeighborPart::Kind::kCircle, 4},
                                {NeighborPart::Kind::kQuaternion},
                                {},
                                {NeighborPart::Kind::kCircle, 2}};
  const internal::NeighborParts space{parts, 5, 8, false}, lines{parts, 5, 8, true};
  Rng rng(4);
  std::vector<float> numbers(16 * 8), boxes(32 * 8), x(8);
  for (float& number : x) number = static_cast<float>(rng.uniform(-1, 1));
  for (float& number : numbers) number = static_cast<float>(rng.uniform(-1, 1));
  for (int b = 0; b < 2; ++b)
    for (int k = 0; k < 64; ++k) {
      const auto at = static_cast<std::size_t>(128 * b + k);
      boxes[at] = static_cast<float>(rng.uniform(-1, 0.2));
      boxes[at + 64] = boxes[at] + static_cast<float>(rng.uniform(0, 0.5));
    }
  for (const auto& one : {space, lines}) {
    std::vector<float> first;
    unsigned long long within = 0;
    for (const int lanes : {1, 2, 4}) {
      if (lanes > cpuLanes()) continue;
      const auto kernel = kernelFor<internal::NeighborKernel>(lanes);
      std::vector<float> found(32);
      const float least = kernel.ofPoints(one, numbers.data(), 2, x.data(), found.data());
      EXPECT_EQ(least, *std::min_element(found.begin(), found.begin() + 16));
      kernel.ofBoxes(one, boxes.data(), 2, x.data(), found.data() + 16);
      const auto bits = kernel.within(found.data(), 4, 1.5f);
      if (lanes == 1) first = found;
      if (lanes == 1) within = bits;
      EXPECT_EQ(found, first);
      EXPECT_EQ(bits, within);
      for (std::size_t k = 0; k < 32; ++k) EXPECT_EQ(bits >> k & 1, found[k] <= 1.5f);
      float sum = 0;  // of point 9
      for (std::size_t i = 0; i < 8; ++i) {
        const float gap = std::abs(x[i] - numbers[64 + i * 8 + 1]);
        const bool isAngle = !one.isStraight && (i == 1 || i == 7);
        const float way = isAngle ? std::min(gap, (i == 1 ? 4 : 2) - gap) : gap;
        if (!one.isStraight && i >= 2 && i < 6) continue;
        sum += way * way;
      }
      float same = 0, opposite = 0;
      for (std::size_t i = 2; i < 6 && !one.isStraight; ++i) {
        same += std::pow(x[i] - numbers[64 + i * 8 + 1], 2.f);
        opposite += std::pow(x[i] + numbers[64 + i * 8 + 1], 2.f);
      }
      EXPECT_NEAR(found[9], sum + std::min(same, opposite), 1e-5);
    }
  }
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
