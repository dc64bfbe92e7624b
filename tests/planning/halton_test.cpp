#include <gtest/gtest.h>

#include "planning/samplers.h"
#include "support/expect_error.h"

namespace rex::halton_test {

Eigen::VectorXf pointOf(int dimension, int index) {
  Halton halton(dimension, index);
  Eigen::VectorXf point(dimension);
  halton.next(point);
  return point;
}

// The digits of the index in some base, mirrored at the point.
double radicalInverse(long index, int base) {
  double value = 0, weight = 1;
  for (; index > 0; index /= base) value += static_cast<double>(index % base) * (weight /= base);
  return value;
}

TEST(Halton, HasTheValuesOfItsPaper) {
  EXPECT_TRUE(pointOf(3, 0).isApprox(Eigen::Vector3f(0, 0, 0), 1e-6f));
  EXPECT_TRUE(pointOf(3, 1).isApprox(Eigen::Vector3f(1.f / 2, 1.f / 3, 1.f / 5), 1e-6f));
  EXPECT_TRUE(pointOf(3, 2).isApprox(Eigen::Vector3f(1.f / 4, 2.f / 3, 2.f / 5), 1e-6f));
  EXPECT_TRUE(pointOf(3, 6).isApprox(Eigen::Vector3f(3.f / 8, 2.f / 9, 6.f / 25), 1e-6f));
}

TEST(Halton, CountsOnFromAnyPoint) {
  constexpr int kPrimes[] = {2, 3, 5, 7, 11, 13, 17};
  for (const int first : {0, 1, 1000, 123456}) {
    Halton halton(7, first);
    Eigen::VectorXf point(7);
    for (int i = first; i < first + 5000; ++i) {
      halton.next(point);
      for (int j = 0; j < 7; ++j) ASSERT_NEAR(point[j], radicalInverse(i, kPrimes[j]), 1e-7) << i << " " << j;
    }
  }
}

TEST(Halton, SaysWhatIsOutOfRange) {
  EXPECT_REX_ERROR(Halton(0), "dimension of a Halton sequence: found 0, wanted 1 to 32");
  EXPECT_REX_ERROR(Halton(33), "dimension of a Halton sequence: found 33, wanted 1 to 32");
  EXPECT_REX_ERROR(Halton(2, -1), "first point of a Halton sequence: found -1, wanted 0 or more");
}

}  // namespace rex::halton_test
