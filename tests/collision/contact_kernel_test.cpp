// One lane, two and four must give the same bits, and those of proximity().
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "base/cpu_lanes.h"
#include "base/rng.h"
#include "collision/contact_kernel_internal.h"
#include "collision/proximity.h"
#include "geometry/rotation.h"

namespace rex::internal {
namespace {

// Segments and boxes in eight lanes, with their balls; every other lane has degenerate ones.
struct RandomSolids {
  static constexpr int kCount = 40;

  explicit RandomSolids(Rng& rng) : X_WS(kCount * kPoseNumbers), size(kCount * kSizeNumbers) {
    for (int i = 0; i < kCount; ++i) {
      for (int lane = 0; lane < kContactLanes; ++lane) {
        Pose X{expSO3(rng.normalVector(3)), rng.uniformVector(3, -0.4, 0.4)};
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

  [[nodiscard]] LaneSolids lanes() const { return {X_WS.data(), size.data()}; }

  std::vector<double> X_WS, size;
};

std::vector<CorePair> allPairs() {
  std::vector<CorePair> pairs;
  for (int a = 0; a < RandomSolids::kCount; ++a)
    for (int b = a + 1; b < RandomSolids::kCount; ++b)
      pairs.push_back({a, b, static_cast<int>(pairs.size()), 1.6});
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
      all.push_back(kernel.hits(&pair, 1, solids.lanes(), margin, 0));
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
  const std::vector<CorePair> pairs = allPairs();
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
  for (const CorePair& pair : allPairs()) {
    for (int type = 0; type < 3; ++type) {
      LaneProximities found;
      kernel.pairs[type].proximities(pair, kContactLanes, solids.lanes(), found);
      for (int lane = 0; lane < kContactLanes; ++lane) {
        const Shape a = solids.shape(pair.a, lane, type == 2), b = solids.shape(pair.b, lane, type >= 1);
        // Boxes of proximity() have no balls.
        const double sweep = (type == 2 ? a.radius : 0) + (type >= 1 ? b.radius : 0);
        const Proximity wanted = proximity(a, solids.pose(pair.a, lane), b, solids.pose(pair.b, lane));
        EXPECT_NEAR(found.distance[lane], wanted.distance - sweep, 1e-15);
        EXPECT_EQ(found.normal_W[lane], wanted.normal_W.x());
      }
    }
  }
}

}  // namespace
}  // namespace rex::internal
