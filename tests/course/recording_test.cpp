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
  for (int i = 0; i < 5; ++i) EXPECT_EQ(postures[static_cast<std::size_t>(i)][0], i);
}

TEST(Recording, ThinsLongRunsEvenlyWithBothEnds) {
  for (const int count : {121, 4096, 4097, 4098, 100003}) {
    const Recording recording = recordingOf(count);
    EXPECT_EQ(recording.count(), static_cast<std::size_t>(count));
    const auto postures = recording.evenly(120);
    ASSERT_EQ(postures.size(), 120u) << count;
    EXPECT_EQ(postures.front()[0], 0);
    EXPECT_EQ(postures.back()[0], count - 1);
    const double gap = (count - 1) / 119.;
    for (std::size_t i = 0; i < postures.size(); ++i) {
      EXPECT_NEAR(postures[i][0], gap * static_cast<double>(i), 0.5 * gap + 0.51) << count;
    }
  }
}

TEST(Recording, StartsAgainWhenCleared) {
  Recording recording = recordingOf(9);
  recording.clear();
  EXPECT_TRUE(recording.empty());
  EXPECT_TRUE(recording.evenly(2).empty());
  EXPECT_REX_ERROR(recording.evenly(1), "number of postures: found 1, wanted at least 2");
}

}  // namespace rex::recording_test
