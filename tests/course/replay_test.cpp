#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "base/process.h"
#include "course/film.h"
#include "course/simulator.h"
#include "render/figure.h"
#include "support/expect_error.h"
#include "support/fresh_folder.h"
#include "support/needs_osmesa.h"

namespace rex::replay_test {

namespace fs = std::filesystem;

// The arms of the robot swing in `count` postures.
Simulator swinging(int count) {
  Simulator S("man.ors");
  const Eigen::VectorXd q = S.getJointAngles();
  for (int t = 1; t < count; ++t)
    S.setJointAngles(q + Eigen::VectorXd::Constant(q.size(), 0.4 * std::sin(0.05 * t)));
  return S;
}

Figure curve(const std::string& title) {
  Figure figure{.title = title, .xLabel = "step", .yLabel = "y [m]"};
  figure.series.emplace_back();
  for (int i = 0; i < 400; ++i) figure.series[0].y.push_back(std::sin(0.03 * i));
  return figure;
}

TEST(Replay, OfTheManWithThreeFiguresIsSmall) {
  REX_NEEDS_OSMESA();
  if (!runProcess({"gnuplot", "--version"}).ok()) GTEST_SKIP() << "needs gnuplot: install gnuplot-nox";
  const std::string name = (freshFolder("replay") / "swing").string();
  const PictureOptions options{.caption = "The arms swing", .traces = {"handR"}};
  writeReplay(swinging(300), name, options, {curve("a"), curve("b"), curve("c")});
  EXPECT_LT(fs::file_size(name + ".html"), 1'200'000u);
  EXPECT_GT(fs::file_size(name + ".html"), 300'000u);
}

TEST(Replay, ThinsTheRecording) {
  const Film film = makeFilm(swinging(300), {.traces = {"handR"}}, 40);
  ASSERT_EQ(film.size(), 40u);
  EXPECT_NEAR(film.back().time, 39 / 30., 1e-12);
  EXPECT_TRUE(film[0].picture.polylines.empty());
  EXPECT_EQ(film[39].picture.polylines.at(0).points.size(), 40u);
}

// The course of a sine in 12.3 s, far from the posture of the file.
Simulator timed(double tau) {
  Simulator S("man.ors");
  for (double t = 0; t < 12.3 + tau / 2; t += tau)
    S.setJointAngles(Eigen::VectorXd::Constant(S.getJointDimension(), 0.4 + 0.1 * std::sin(t)), tau);
  return S;
}

TEST(Replay, TakesTheTimeOfTheMotionAndBeginsWithIt) {
  for (const double tau : {.001, .01, .1, 1.23}) {
    const Simulator S = timed(tau);
    const Film film = makeFilm(S, {.traces = {"handR"}});
    EXPECT_NEAR(film.back().time, 12.3, .06) << tau;
    EXPECT_EQ(film.front().time, 0);
    EXPECT_EQ(film.size(), tau > .03 ? static_cast<std::size_t>(std::lround(12.3 / tau)) + 1 : 370u);
    EXPECT_EQ(videoRate(film), tau < .03 ? 30 : tau < 1 ? 10 : 1);
    const auto& trace = film.back().picture.polylines.at(0).points;
    ASSERT_EQ(trace.size(), film.size());
    Simulator first("man.ors");
    first.setJointAngles(Eigen::VectorXd::Constant(S.getJointDimension(), 0.4));
    EXPECT_LT((trace[0] - first.kinematicsPos("handR")).norm(), 1e-9) << "the motion, not the file";
  }
}

TEST(Replay, ShowsThirtyFramesPerSecondByDefaultAndHalfAMinuteOfThemAtMost) {
  EXPECT_EQ(makeFilm(swinging(62), {}).size(), 61u);
  EXPECT_DOUBLE_EQ(makeFilm(swinging(62), {}).back().time, 2);
  EXPECT_EQ(makeFilm(swinging(1500), {}).size(), static_cast<std::size_t>(kMostFrames));
  EXPECT_EQ(makeFilm(swinging(3), {}).size(), 2u);
}

TEST(Replay, ShowsThePostureWithoutARecording) {
  REX_NEEDS_OSMESA();
  Simulator S = swinging(3);
  S.clearRecording();
  const std::string name = (freshFolder("replay-still") / "still").string();
  writeReplay(S, name);
  EXPECT_GT(fs::file_size(name + ".html"), 300'000u);
}

TEST(Replay, NamesWhatIsWrong) {
  REX_NEEDS_OSMESA();
  const Simulator S = swinging(3);
  EXPECT_REX_ERROR(writeReplay(S, "unused", {.traces = {"hndR"}}), "did you mean 'handR'");
  EXPECT_REX_ERROR(writeReplay(S, "unused", {}, {}, 1), "number of postures: found 1");
  EXPECT_REX_ERROR(writeReplay(S, "missing/replay"), "missing/replay.html': found No such file");
}

}  // namespace rex::replay_test
