// One lane, two and four must give the same bits, and those of proximity().
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "base/cpu_lanes.h"
#include "base/rng.h"
#include "collision/contact_kernel_internal.h"
#include "collision/proximity.h"
#include "geometry/rotation.h"

namespace rex::internal::contact_kernel_test {

// Segments and boxes in eight lanes, with their balls; every other lane has degenerate ones.
struct RandomSolids {
  static constexpr int kCount = 40;

  explicit RandomSolids(Rng& rng, double spread = 0.4)
      : X_WS(kCount * kPoseNumbers), size(kCount * kSizeNumbers) {
    for (int i = 0; i < kCount; ++i) {
      for (int lane = 0; lane < kContactLanes; ++lane) {
        Pose X{expSO3(rng.normalVector(3)), rng.uniformVector(3, -spread, spread)};
        Eigen::Vector3d half = rng.uniformVector(3, 0, 0.4);
        if (lane % 2 == 1) {
          X.R.setIdentity();
          X.p = (X.p * 4).array().round() / 4;
          half = (half * 4).array().round() / 4;
        }
        put(i, lane, X, half, lane % 4 < 2 ? 0 : rng.uniform(0, 0.2));
      }
    }
  }

  void put(int i, int lane, const Pose& X, const Eigen::Vector3d& half, double radius) {
    double* pose = X_WS.data() + i * kPoseNumbers + lane;
    for (int k = 0; k < 9; ++k) pose[k * kContactLanes] = X.R.data()[k];
    for (int k = 0; k < 3; ++k) pose[(9 + k) * kContactLanes] = X.p[k];
    double* numbers = size.data() + i * kSizeNumbers + lane;
    for (int k = 0; k < 3; ++k) numbers[k * kContactLanes] = half[k];
    numbers[3 * kContactLanes] = radius;
  }

  [[nodiscard]] Pose pose(int i, int lane) const {
    const double* numbers = X_WS.data() + i * kPoseNumbers + lane;
    Pose X;
    for (int k = 0; k < 9; ++k) X.R.data()[k] = numbers[k * kContactLanes];
    for (int k = 0; k < 3; ++k) X.p[k] = numbers[(9 + k) * kContactLanes];
    return X;
  }
  [[nodiscard]] Shape shape(int i, int lane, bool isBox) const {
    const double* numbers = size.data() + i * kSizeNumbers + lane;
    const double radius = numbers[3 * kContactLanes];
    Eigen::Vector3d extent;
    for (int k = 0; k < 3; ++k) extent[k] = 2 * numbers[k * kContactLanes];
    return {.type = isBox ? ShapeType::kBox : ShapeType::kCapsule, .extent = extent, .radius = radius};
  }

  // Of a sphere that holds the solids of all lanes.
  [[nodiscard]] double reach(int i) const {
    double most = 0;
    for (int lane = 0; lane < kContactLanes; ++lane) {
      const Shape core = shape(i, lane, true);
      most = std::max(most, core.extent.norm() / 2 + core.radius);
    }
    return most;
  }

  [[nodiscard]] LaneSolids lanes() const { return {X_WS.data(), size.data()}; }

  std::vector<double> X_WS, size;
};

std::vector<CorePair> allPairs(const RandomSolids& solids) {
  std::vector<CorePair> pairs;
  for (int a = 0; a < RandomSolids::kCount; ++a)
    for (int b = a + 1; b < RandomSolids::kCount; ++b)
      pairs.push_back({a, b, static_cast<int>(pairs.size()), solids.reach(a) + solids.reach(b)});
  return pairs;
}

// All that the kernel computes of the pairs, in bytes.
std::vector<double> results(const PairKernel& kernel, const std::vector<CorePair>& pairs,
                            const RandomSolids& solids) {
  const int count = static_cast<int>(pairs.size());
  std::vector<double> all(pairs.size() * kContactLanes);
  kernel.distances(pairs.data(), count, solids.lanes(), all.data());
  for (const CorePair& pair : pairs) {
    LaneProximities found;
    kernel.proximities(pair, kContactLanes, solids.lanes(), found);
    const double* numbers = found.distance;
    all.insert(all.end(), numbers, numbers + sizeof(LaneProximities) / sizeof(double));
    for (const double margin : {-0.1, 0.05, 0.3})
      all.push_back(kernel.hits(&pair, 1, solids.lanes(), margin, 0, false));
  }
  return all;
}

class ContactKernelLanes : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    if (GetParam() > cpuLanes()) GTEST_SKIP() << "this CPU has no AVX2";
  }
};

TEST_P(ContactKernelLanes, GiveTheBitsOfOne) {
  Rng rng(71);
  const RandomSolids solids(rng);
  const std::vector<CorePair> pairs = allPairs(solids);
  const auto one = kernelFor<ContactKernel>(1), more = kernelFor<ContactKernel>(GetParam());
  for (int type = 0; type < 3; ++type) {
    const std::vector<double> wanted = results(one.pairs[type], pairs, solids);
    const std::vector<double> found = results(more.pairs[type], pairs, solids);
    ASSERT_EQ(found.size(), wanted.size());
    EXPECT_EQ(std::memcmp(found.data(), wanted.data(), found.size() * sizeof(double)), 0) << type;
  }
  const std::vector<double> X_BS(solids.size.begin(), solids.size.begin() + 12);
  double wanted[kPoseNumbers], found[kPoseNumbers];
  one.place(solids.X_WS.data(), X_BS.data(), wanted);
  more.place(solids.X_WS.data(), X_BS.data(), found);
  EXPECT_EQ(std::memcmp(found, wanted, sizeof(found)), 0);
}

INSTANTIATE_TEST_SUITE_P(TwoAndFour, ContactKernelLanes, testing::Values(2, 4));

TEST(ContactKernel, AgreesWithProximity) {
  Rng rng(72);
  const RandomSolids solids(rng);
  const auto kernel = kernelFor<ContactKernel>(cpuLanes());
  for (const CorePair& pair : allPairs(solids)) {
    for (int type = 0; type < 3; ++type) {
      LaneProximities found;
      kernel.pairs[type].proximities(pair, kContactLanes, solids.lanes(), found);
      for (int lane = 0; lane < kContactLanes; ++lane) {
        const Shape a = solids.shape(pair.a, lane, type == 2), b = solids.shape(pair.b, lane, type >= 1);
        // Boxes of proximity() have no balls.
        const double sweepA = type == 2 ? a.radius : 0, sweepB = type >= 1 ? b.radius : 0;
        const Proximity wanted = proximity(a, solids.pose(pair.a, lane), b, solids.pose(pair.b, lane));
        EXPECT_NEAR(found.distance[lane], wanted.distance - sweepA - sweepB, 1e-15);
        for (int i = 0; i < 3; ++i) {
          const int at = i * kContactLanes + lane;
          EXPECT_EQ(found.normal_W[at], wanted.normal_W[i]);
          EXPECT_NEAR(found.p_WA[at], wanted.p_WA[i] - sweepA * wanted.normal_W[i], 1e-15);
          EXPECT_NEAR(found.p_WB[at], wanted.p_WB[i] + sweepB * wanted.normal_W[i], 1e-15);
        }
      }
    }
  }
}

// The lanes in which a number is less than the margin, as bits.
unsigned lanesBelow(const double* numbers, double margin) {
  unsigned bits = 0;
  for (int lane = 0; lane < kContactLanes; ++lane) bits |= numbers[lane] < margin ? 1u << lane : 0u;
  return bits;
}

// Margins at which one of the lanes is just hit, or just not: what is left out because of spheres must
// neither depend on the other lanes nor on how anything is rounded.
TEST(ContactKernel, HitsExactlyWhatIsNearer) {
  Rng rng(73);
  for (const double spread : {0., 0.4, 3.}) {
    const RandomSolids solids(rng, spread);
    std::vector<CorePair> pairs = allPairs(solids);
    std::erase_if(pairs, [](const CorePair& pair) { return pair.row % 4 != 0; });
    for (CorePair& pair : pairs) pair.row = 0;
    for (int lanes = 1; lanes <= cpuLanes(); lanes *= 2) {
      const auto kernel = kernelFor<ContactKernel>(lanes);
      for (int type = 0; type < 3; ++type) {
        for (const CorePair& pair : pairs) {
          double distances[kContactLanes];
          kernel.pairs[type].distances(&pair, 1, solids.lanes(), distances);
          std::vector<double> margins{0, -0.1, -kCullSlack};
          for (const double d : distances) {
            for (const double side : {-1e9, 1e9}) margins.push_back(std::nextafter(d, side));
            margins.push_back(d);
          }
          for (const double margin : margins)
            ASSERT_EQ(kernel.pairs[type].hits(&pair, 1, solids.lanes(), margin, 0, false),
                      lanesBelow(distances, margin))
                << type << ' ' << margin << ' ' << lanes;
        }
      }
    }
  }
}

// Any number of a pose, of either solid.
TEST(ContactKernel, GivesNoNumberWhereAPoseHasNone) {
  Rng rng(74);
  const RandomSolids solids(rng);
  const auto kernel = kernelFor<ContactKernel>(cpuLanes());
  constexpr int kLane = 2;
  for (int type = 0; type < 3; ++type) {
    for (const int solid : {0, 1}) {
      for (int k = 0; k < 12; ++k) {
        // The other axes of a segment do not matter.
        if (k < 6 && (type == 0 || (type == 1 && solid == 0))) continue;
        RandomSolids broken = solids;
        broken.X_WS[solid * kPoseNumbers + k * kContactLanes + kLane] = std::nan("");
        LaneProximities found;
        const CorePair pair{0, 1, 0, solids.reach(0) + solids.reach(1)};
        kernel.pairs[type].proximities(pair, kContactLanes, broken.lanes(), found);
        for (int lane = 0; lane < kContactLanes; ++lane)
          EXPECT_EQ(std::isnan(found.distance[lane]), lane == kLane) << type << ' ' << solid << ' ' << k;
        EXPECT_TRUE(kernel.pairs[type].hits(&pair, 1, broken.lanes(), -10, 0, false) >> kLane & 1);
      }
    }
  }
}

}  // namespace rex::internal::contact_kernel_test
