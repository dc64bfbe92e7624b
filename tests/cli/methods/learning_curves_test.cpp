#include "cli/methods/learning_curves.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace rex::cli::learning_curves_test {

TEST(LearningCurves, TakeTheMedianOfWhatWasReached) {
  const LearningCurve fast{{10, 20, 30}, {8, 1, 0.5}}, slow{{10, 100}, {9, 4}}, done{{10, 20}, {7, 0}};
  const Figure figure = figureOf({fast, slow, done}, 0.5, "three");
  ASSERT_EQ(figure.series.size(), 1u);
  ASSERT_EQ(figure.bands.size(), 1u);
  const Series& median = figure.series[0];
  const Band& band = figure.bands[0];
  EXPECT_EQ(median.x.front(), 10);
  EXPECT_EQ(median.x.back(), 100);
  EXPECT_EQ(median.y.front(), 8);
  const auto at = [&](double evaluations) {
    return static_cast<std::size_t>(std::ranges::upper_bound(median.x, evaluations) - median.x.begin() - 1);
  };
  EXPECT_EQ(median.y[at(25)], 1);
  EXPECT_EQ(band.low[at(25)], 1e-20);  // a logarithmic axis has no 0
  EXPECT_EQ(band.high[at(25)], 9);
  EXPECT_EQ(median.y.back(), 0.5);  // those that have ended keep what they found
  EXPECT_EQ(band.high.back(), 4);
  ASSERT_EQ(figure.horizontalLines.size(), 1u);
  EXPECT_EQ(figure.horizontalLines[0].at, 0.5);
}

TEST(LearningCurves, NeedNoBandForOne) {
  const Figure figure = figureOf({{{5, 6}, {2, 1}}}, -1, "one");
  EXPECT_TRUE(figure.bands.empty());
  EXPECT_TRUE(figure.horizontalLines.empty());
  EXPECT_EQ(figure.series[0].y.back(), 1);
}

}  // namespace rex::cli::learning_curves_test
