#include "course/recording.h"

#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace rex::recording_test {

Recording recordingOf(int count) {
  Recording recording;
  for (int i = 0; i < count; ++i) recording.add(Eigen::VectorXd::Constant(1, i));
  return recording;
}

TEST(Recording, KeepsShortRunsWhole) {
  const auto postures = recordingOf(5).evenly(120);
  ASSERT_EQ(postures.size(), 5u);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(postures[static_cast<std::size_t>(i)].q[0], i);
}

TEST(Recording, ThinsLongRunsEvenlyWithBothEnds) {
  for (const int count : {121, 4096, 4097, 4098, 100003}) {
    const Recording recording = recordingOf(count);
    EXPECT_EQ(recording.count(), static_cast<std::size_t>(count));
    const auto postures = recording.evenly(120);
    ASSERT_EQ(postures.size(), 120u) << count;
    EXPECT_EQ(postures.front().q[0], 0);
    EXPECT_EQ(postures.back().q[0], count - 1);
    const double gap = (count - 1) / 119.;
    for (std::size_t i = 0; i < postures.size(); ++i) {
      EXPECT_NEAR(postures[i].q[0], gap * static_cast<double>(i), 0.5 * gap + 0.51) << count;
    }
  }
}

Eigen::VectorXd number(double x) { return Eigen::VectorXd::Constant(1, x); }

TEST(Recording, TakesAThirtiethOfASecondWhereNobodySaysMore) {
  EXPECT_FALSE(recordingOf(31).isTimed());
  EXPECT_DOUBLE_EQ(recordingOf(31).duration(), 1);
  EXPECT_DOUBLE_EQ(recordingOf(31).evenly(100)[15].time, .5);
  EXPECT_DOUBLE_EQ(recordingOf(31).evenly(4).back().time, .1) << "what is left out takes no time";
  EXPECT_EQ(Recording().duration(), 0);
}

TEST(Recording, HasTheTimesOfSteps) {
  for (const int count : {50, 20'000}) {
    Recording recording;
    recording.startAt(number(0));
    for (int i = 1; i <= count; ++i) recording.step(number(.01 * i), .01);
    EXPECT_TRUE(recording.isTimed());
    EXPECT_NEAR(recording.duration(), .01 * count, 1e-9);
    const auto postures = recording.evenly(41);
    ASSERT_EQ(postures.size(), 41u);
    for (std::size_t i = 0; i < postures.size(); ++i) {
      EXPECT_NEAR(postures[i].time, .01 * count * static_cast<double>(i) / 40, .051) << count;
      EXPECT_NEAR(postures[i].q[0], postures[i].time, 1e-9) << count;
    }
    EXPECT_EQ(postures.front().time, 0);
    EXPECT_NEAR(postures.back().time, .01 * count, 1e-9);
  }
}

// Ten steps of a second, then a hundred of a hundredth.
TEST(Recording, IsThinnedEvenlyInTime) {
  Recording recording;
  for (int i = 0; i <= 10; ++i) recording.add(number(i), 1);
  for (int i = 1; i <= 100; ++i) recording.step(number(10 + .01 * i), .01);
  const auto postures = recording.evenly(12);
  ASSERT_EQ(postures.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_NEAR(postures[i].q[0], static_cast<double>(i), 1e-9);
  EXPECT_EQ(recording.evenly(30).size(), 11u + 3) << "nothing is shown twice";
}

TEST(Recording, LetsTheFirstPostureThatIsSetTakeThePlaceOfTheStart) {
  Recording recording;
  recording.startAt(number(7));
  EXPECT_EQ(recording.evenly(9).at(0).q[0], 7);
  recording.add(number(1));
  recording.add(number(2));
  EXPECT_EQ(recording.count(), 2u);
  recording.startAt(number(7));
  recording.add(number(1), .5);
  recording.add(number(2), .5);
  auto postures = recording.evenly(9);
  ASSERT_EQ(postures.size(), 2u);
  EXPECT_EQ(postures[0].q[0], 1);
  EXPECT_EQ(postures[1].time, .5);
  recording.startAt(number(7));
  recording.step(number(8), .5);
  EXPECT_EQ(recording.evenly(9).at(0).q[0], 7) << "a step starts there";
}

TEST(Recording, ShowsTheLastOfPosturesAtTheSameTime) {
  Recording recording;
  for (const double x : {1., 2., 3.}) recording.add(number(x));
  recording.step(number(4), .1);
  recording.add(number(5));
  recording.step(number(6), .1);
  const auto postures = recording.evenly(9);
  ASSERT_EQ(postures.size(), 3u);
  EXPECT_EQ(postures[0].q[0], 3);
  EXPECT_EQ(postures[1].q[0], 5);
  EXPECT_EQ(postures[2].q[0], 6);
  EXPECT_NEAR(postures[2].time, .2, 1e-12);
}

TEST(Recording, StartsAgainWhenCleared) {
  Recording recording = recordingOf(9);
  recording.clear();
  EXPECT_TRUE(recording.empty());
  EXPECT_TRUE(recording.evenly(2).empty());
  EXPECT_REX_ERROR(recording.evenly(1), "number of postures: found 1, wanted at least 2");
}

}  // namespace rex::recording_test
