// Shortest ways of cars: lengths recorded from an independent implementation, and laws.
#include <cmath>
#include <fstream>
#include <numbers>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/rng.h"
#include "planning/car_curves.h"
#include "support/expect_error.h"
#include "support/paths.h"

namespace rex::curves_test {

using Eigen::Vector3d;
using std::numbers::pi;

// Between headings, whole turns do not count.
double gap(const Vector3d& a, const Vector3d& b) {
  return std::hypot((a - b).head<2>().norm(), std::remainder(a[2] - b[2], 2 * pi));
}

Vector3d randomPose(Rng& rng, double reach) {
  return {rng.uniform(-reach, reach), rng.uniform(-reach, reach), rng.uniform(-7, 7)};
}

Vector3d poseFrom(const nlohmann::json& numbers) {
  return {numbers[0].get<double>(), numbers[1].get<double>(), numbers[2].get<double>()};
}

TEST(Curves, AreAsLongAsRecorded) {
  std::ifstream file(sourcePath("tests/golden/curves.json"));
  ASSERT_TRUE(file);
  const nlohmann::json golden = nlohmann::json::parse(file);
  ASSERT_EQ(golden.at("queries").size(), 130u);
  for (const nlohmann::json& query : golden["queries"]) {
    const Vector3d from = poseFrom(query["start"]), to = poseFrom(query["goal"]);
    EXPECT_NEAR(dubinsLength(from, to, 1), query["dubins"].get<double>(), 1e-9) << query;
    EXPECT_NEAR(reedsSheppLength(from, to, 1), query["reeds_shepp"].get<double>(), 1e-9) << query;
  }
}

TEST(Curves, EndAtTheGoalAndAreAsLongAsSaid) {
  Rng rng(1);
  std::set<std::string> words;
  for (int i = 0; i < 20000; ++i) {
    const double radius = rng.uniform(.1, 3);
    const Vector3d from = randomPose(rng, 4), to = randomPose(rng, 4);
    const Curve dubins = dubinsCurve(from, to, radius), reedsShepp = reedsSheppCurve(from, to, radius);
    for (const Curve& curve : {dubins, reedsShepp}) {
      EXPECT_LT(gap(curve.pose(curve.length()), to), 1e-9) << curve.word();
      EXPECT_EQ(curve.pose(0), from);
      words.insert(curve.word());
    }
    EXPECT_NEAR(dubins.length(), dubinsLength(from, to, radius), 1e-12);
    EXPECT_NEAR(reedsShepp.length(), reedsSheppLength(from, to, radius), 1e-12);
    for (const CurveSegment& segment : dubins.segments()) EXPECT_GE(segment.length, 0);
  }
  for (const char* word : {"LSL", "RSR", "LSR", "RSL", "LRL", "RLR", "LRLR", "RLRL", "LRSL", "RLSR", "LRSR",
                           "RLSL", "LSRL", "RSLR", "RSRL", "LSLR", "LRSLR", "RLSRL"})
    EXPECT_EQ(words.count(word), 1u) << word << " never was the shortest";
}

// The length of the best of many ways that are driven with random segments of the right number never beats
// the shortest way: an upper bound by construction, for all poses that can be reached so.
TEST(Curves, AreNoLongerThanAnyDrivenWay) {
  Rng rng(2);
  for (int i = 0; i < 20000; ++i) {
    std::vector<CurveSegment> forward, both;
    for (int k = 0; k < 4; ++k) {
      const Steering steering = static_cast<Steering>(rng.index(3));
      const double way = rng.uniform(0, 3);
      forward.push_back({steering, way});
      both.push_back({steering, rng.index(2) == 0 ? way : -way});
    }
    const Vector3d from = randomPose(rng, 1);
    const Curve driven(from, .7, forward), shunted(from, .7, both);
    EXPECT_LE(dubinsLength(from, driven.pose(driven.length()), .7), driven.length() + 1e-9);
    EXPECT_LE(reedsSheppLength(from, shunted.pose(shunted.length()), .7), shunted.length() + 1e-9);
  }
}

TEST(Curves, AreMetricsWhereTheyShouldBe) {
  Rng rng(3);
  for (int i = 0; i < 5000; ++i) {
    const Vector3d a = randomPose(rng, 2), b = randomPose(rng, 2), c = randomPose(rng, 2);
    const double ab = reedsSheppLength(a, b, 1);
    EXPECT_NEAR(ab, reedsSheppLength(b, a, 1), 1e-9);
    EXPECT_LE(reedsSheppLength(a, c, 1), ab + reedsSheppLength(b, c, 1) + 1e-9);
    EXPECT_LE(dubinsLength(a, c, 1), dubinsLength(a, b, 1) + dubinsLength(b, c, 1) + 1e-9);
    EXPECT_LE(ab, std::min(dubinsLength(a, b, 1), dubinsLength(b, a, 1)) + 1e-9);
    EXPECT_GE(ab, (a - b).head<2>().norm() - 1e-12);
    const Vector3d scale(3, 3, 1);
    EXPECT_NEAR(reedsSheppLength(scale.cwiseProduct(a), scale.cwiseProduct(b), 3), 3 * ab, 1e-9);
  }
}

TEST(Curves, HandleWhatIsSpecial) {
  const Vector3d origin(0, 0, 0);
  EXPECT_NEAR(dubinsLength(origin, origin, 1), 0, 1e-12);
  EXPECT_NEAR(reedsSheppLength(origin, {0, 0, 2 * pi}, 1), 0, 1e-12);
  EXPECT_NEAR(dubinsLength(origin, {5, 0, 0}, 1), 5, 1e-12);
  EXPECT_NEAR(reedsSheppLength(origin, {-5, 0, 0}, 1), 5, 1e-12);
  EXPECT_NEAR(dubinsLength(origin, {0, 2, pi}, 1), pi, 1e-12);
  EXPECT_NEAR(dubinsLength(origin, {0, -2, -pi}, 1), pi, 1e-12);
  // To turn round on the spot: three arcs of a sixth of a turn, forward, backward, forward.
  EXPECT_NEAR(reedsSheppLength(origin, {0, 0, pi}, 1), pi, 1e-9);
  // Turning by almost nothing, either way, is almost nothing, however rounding falls.
  for (const double angle : {1e-15, -1e-15, 1e-13, -1e-13}) {
    EXPECT_LT(reedsSheppLength(origin, {0, 0, angle}, 1), 1e-6) << angle;
    EXPECT_NEAR(dubinsLength(origin, {4 * std::cos(angle), 4 * std::sin(angle), angle}, 1), 4, 1e-6) << angle;
  }
}

TEST(Curves, GiveThePoseAllAlong) {
  const Curve curve = reedsSheppCurve({0, 0, 0}, {-.3, 1.2, 2}, 1);
  const double length = curve.length();
  Vector3d last = curve.pose(0);
  double way = 0;
  for (int i = 1; i <= 10000; ++i) {
    const Vector3d next = curve.pose(length * i / 10000);
    const double step = (next - last).head<2>().norm();
    EXPECT_LE(std::abs(next[2] - last[2]), length / 10000 + 1e-12) << "never tighter than the radius";
    way += step;
    last = next;
  }
  EXPECT_NEAR(way, length, length / 1000) << "chords are shorter, most where it turns back";
  EXPECT_EQ(curve.word().size(), curve.segments().size());
}

TEST(Curves, RefuseWhatIsNoPoseOrRadius) {
  const Vector3d a(0, 0, 0), bad(0, NAN, 0);
  EXPECT_REX_ERROR(dubinsLength(a, bad, 1), "pose of a car: found (0, nan, 0), wanted x, y and heading");
  EXPECT_REX_ERROR(reedsSheppCurve(bad, a, 1), "pose of a car");
  EXPECT_REX_ERROR(dubinsCurve(a, a, 0),
                   "turning radius: found 0 m, wanted a positive, finite number of metres");
  EXPECT_REX_ERROR(reedsSheppLength(a, a, INFINITY), "turning radius: found inf m");
}

}  // namespace rex::curves_test
