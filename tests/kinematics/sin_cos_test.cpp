#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "kinematics/sin_cos_internal.h"

namespace rex {
namespace {

void expectAsLibrary(double angle) {
  const SinCos got = sinCos(angle);
  EXPECT_NEAR(got.sine, std::sin(angle), 3e-16) << angle;
  EXPECT_NEAR(got.cosine, std::cos(angle), 3e-16) << angle;
}

TEST(SinCos, AgreesWithTheLibrary) {
  Rng rng(41);
  for (const double range : {1e-9, 1., 10., 1e3, 1e5, 1e9}) {
    for (int i = 0; i < 20000; ++i) expectAsLibrary(rng.uniform(-range, range));
  }
  for (int quarter = -8; quarter <= 8; ++quarter) {
    for (const double offset : {-std::numbers::pi / 4, -1e-12, 0., 1e-300, std::numbers::pi / 4})
      expectAsLibrary(quarter * std::numbers::pi / 2 + offset);
  }
  for (const double edge : {99999.9, 1e5, 1e22}) expectAsLibrary(edge);
}

TEST(SinCos, KeepsNoNumbersForNoAngle) {
  for (const double none :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_TRUE(std::isnan(sinCos(none).sine));
    EXPECT_TRUE(std::isnan(sinCos(none).cosine));
  }
}

}  // namespace
}  // namespace rex
