#include "planning/space.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "geometry/rotation.h"
#include "support/expect_error.h"

namespace rex::space_test {

using Kind = SpacePart::Kind;
using std::numbers::pi;

TEST(Space, MeasuresAsTheSlideSays) {
  const Space circle({{.kind = Kind::kCircle}}), chord({{.kind = Kind::kChord}});
  const auto angle = [](double x) { return Eigen::VectorXd::Constant(1, x); };
  EXPECT_NEAR(circle.distance(angle(3), angle(-3)), 2 * pi - 6, 1e-12);
  EXPECT_NEAR(circle.distance(angle(.5), angle(.5 + 6 * pi)), 0, 1e-12);
  EXPECT_NEAR(chord.distance(angle(.2), angle(.2 + pi)), 2, 1e-12);
  EXPECT_NEAR(chord.distance(angle(.2), angle(1.2)), 2 * std::sin(.5), 1e-12);

  const Space se3 = Space::se3({-1, -1, -1}, {1, 1, 1}, 2);
  Eigen::VectorXd a(7), b(7);
  a << 0, 0, 0, 1, 0, 0, 0;
  b << .3, 0, .4, -std::cos(.1), 0, -std::sin(.1), 0;
  EXPECT_NEAR(se3.distance(a, b), std::hypot(.5, 2 * 2 * std::sin(.05)), 1e-12)
      << "opposite quaternions are equal";
}

TEST(Space, HasAMetric) {
  const Space space(
      {{}, {.kind = Kind::kCircle}, {.kind = Kind::kQuaternion, .weight = .5}, {.kind = Kind::kChord}});
  Rng rng(1);
  Eigen::VectorXd a(7), b(7), c(7);
  for (int i = 0; i < 2000; ++i) {
    for (Eigen::VectorXd* q : {&a, &b, &c}) space.sample(rng, *q);
    EXPECT_EQ(space.distance(a, a), 0);
    EXPECT_NEAR(space.distance(a, b), space.distance(b, a), 1e-15);
    EXPECT_LE(space.distance(a, c), space.distance(a, b) + space.distance(b, c) + 1e-12);
  }
}

TEST(Space, LeadsTheShorterWay) {
  const Space space = Space::se3({-1, -1, -1}, {1, 1, 1});
  Rng rng(2);
  Eigen::VectorXd a(7), b(7), middle(7);
  for (int i = 0; i < 200; ++i) {
    space.sample(rng, a), space.sample(rng, b);
    if (i % 2 == 0) b.tail<4>() = (a.tail<4>() + 1e-9 * rng.normalVector(4)).normalized();
    for (const double t : {0., .25, .5, 1.}) {
      space.interpolate(a, b, t, middle);
      const Eigen::Matrix3d A = rotationFromQuaternion(a.tail<4>()), B = rotationFromQuaternion(b.tail<4>());
      const Eigen::Matrix3d wanted = A * expSO3(t * logSO3(A.transpose() * B));
      EXPECT_LT((rotationFromQuaternion(middle.tail<4>()) - wanted).norm(), 1e-7);
      EXPECT_LT((middle.head<3>() - (1 - t) * a.head<3>() - t * b.head<3>()).norm(), 1e-12);
    }
  }
  const Space se2 = Space::se2({-1, -1}, {1, 1});
  Eigen::VectorXd half(3);
  se2.interpolate(Eigen::Vector3d(0, 0, 3), Eigen::Vector3d(1, 0, -3), .5, half);
  EXPECT_NEAR(std::abs(half[2]), pi, 1e-12);
}

// By the sum of many small distances.
TEST(Space, KnowsHowLongItsWaysAre) {
  const Space space({{.lower = -9, .upper = 9, .weight = 2},
                     {.kind = Kind::kCircle},
                     {.kind = Kind::kChord, .weight = 3},
                     {.kind = Kind::kQuaternion, .weight = 2}});
  Rng rng(4);
  Eigen::VectorXd a(space.size()), b(space.size()), last(space.size()), q(space.size());
  for (int k = 0; k < 20; ++k) {
    space.sample(rng, a);
    space.sample(rng, b);
    double sum = 0;
    last = a;
    for (int i = 1; i <= 1000; ++i, last = q) {
      space.interpolate(a, b, i / 1000., q);
      sum += space.distance(last, q);
    }
    EXPECT_NEAR(space.wayLength(a, b), sum, 1e-5 * sum);
    EXPECT_GE(space.wayLength(a, b), space.distance(a, b));
  }
  EXPECT_EQ(space.wayLength(a, a), 0);
}

TEST(Space, UnrollsPaths) {
  const Space space({{}, {.kind = Kind::kCircle}, {.kind = Kind::kChord}, {.kind = Kind::kQuaternion}});
  Eigen::MatrixXd path(7, 3);
  path << 0, 1, -1, 3, -3, 3, -3, 3, .5, 1, -.8, .6, 0, -.6, .8, 0, 0, 0, 0, 0, 0;
  const Eigen::MatrixXd even = unrolled(space, path);
  EXPECT_EQ(even.row(0), path.row(0));
  EXPECT_LT((even.row(1) - Eigen::RowVector3d(3, 2 * pi - 3, 3)).norm(), 1e-14);
  EXPECT_LT((even.row(2) - Eigen::RowVector3d(-3, 3 - 2 * pi, .5 - 2 * pi)).norm(), 1e-14);
  EXPECT_EQ(even.row(3), Eigen::RowVector3d(1, .8, .6));
  EXPECT_EQ(even.row(4), Eigen::RowVector3d(0, .6, .8));
  EXPECT_REX_ERROR(static_cast<void>(unrolled(space, Eigen::MatrixXd::Zero(6, 2))),
                   "configurations of a path: found a vector of size 6, wanted size 7");
}

TEST(Space, SamplesAllOfItself) {
  const Space space({{.lower = 2, .upper = 5}, {.kind = Kind::kCircle}, {.kind = Kind::kQuaternion}});
  Rng rng(3);
  Eigen::VectorXd q(6), mean = Eigen::VectorXd::Zero(6);
  double low = 9, high = -9;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    space.sample(rng, q);
    space.require("sample", q);
    mean += q / kCount;
    low = std::min(low, q[0]), high = std::max(high, q[0]);
  }
  EXPECT_NEAR(mean[0], 3.5, 6 * std::sqrt(.75 / kCount));
  EXPECT_LT(mean.tail<5>().cwiseAbs().maxCoeff(), 6 * pi / std::sqrt(3. * kCount));
  EXPECT_LT(low, 2.01);
  EXPECT_GT(high, 4.99);
}

TEST(Space, SaysWhatIsOutside) {
  const Space space({{.lower = -1, .upper = 2}, {.kind = Kind::kQuaternion}});
  Eigen::VectorXd q(5);
  q << 2.5, 1, 0, 0, 0;
  EXPECT_REX_ERROR(space.require("start", q),
                   "start: number 0: found 2.5, wanted at most 2: it is 0.5 above");
  q[0] = -1.25;
  EXPECT_REX_ERROR(space.require("goal", q),
                   "goal: number 0: found -1.25, wanted at least -1: it is 0.25 below");
  q << 0, 1, 1, 0, 0;
  EXPECT_REX_ERROR(space.require("goal", q), "wanted a unit quaternion: its length is 1.41421");
  q[3] = NAN;
  EXPECT_REX_ERROR(space.require("goal", q), "goal: number 3: found nan, wanted a finite number");
  EXPECT_REX_ERROR(space.require("goal", q.head(2)), "goal: found a vector of size 2, wanted size 5");
  EXPECT_REX_ERROR(Space({{.lower = 1, .upper = 0}}),
                   "bounds of part 0 of a space: found 1 and 0, wanted finite bounds");
  EXPECT_REX_ERROR(Space({{}, {.weight = 0}}),
                   "weight of part 1 of a space: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(Space::box(Eigen::Vector2d(0, 0), Eigen::Vector3d(1, 1, 1)),
                   "upper bounds of a space: found a vector of size 3, wanted size 2");
}

}  // namespace rex::space_test
